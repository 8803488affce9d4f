//! The distance between curves and their control polygons: certified, compared with samples and with the bound by second differences.
#![cfg(feature = "prove")]

use std::io::Cursor;

use knotproof::certificate::Encoding;
use knotproof::check::chain::Chain;
use knotproof::check::deviation::parts;
use knotproof::curve::{Curve, read_curve};
use knotproof::number::{Integer, Rational};
use knotproof::prove::deviation::{Certified, DeviationError, Options, certify, nairn_peters_lutterkort};
use knotproof::prove::domain::{Status, write_checked};

fn fraction(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn curve(name: &str) -> Curve {
    let path = format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    read_curve(std::fs::read(&path).expect(&path)).expect(name).curve
}

fn certified(curve: &Curve, subdivisions: u32) -> Certified<'_> {
    let options = Options {
        subdivisions,
        relative_width: fraction(1, 1_000_000),
        name: None,
        snapped_joints: None,
    };
    let found = certify(curve, &options).expect("a curve");
    assert_eq!(found.status, Status::Certified);
    for encoding in [Encoding::Json, Encoding::Binary] {
        let document = found.document.as_ref().expect("a document");
        write_checked(document, encoding, &mut Cursor::new(Vec::new())).expect("accepted");
    }
    found
}

const CURVES: [&str; 8] = [
    "mp06-figure-1",
    "trefoil-24",
    "degree-8",
    "closed-degree-5",
    "nurbs-circle",
    "nurbs-space",
    "stadium",
    "helix-degree-9",
];

#[test]
fn samples_are_within_the_upper_bound_and_the_bound_of_second_differences_is_none_below_it() {
    for name in CURVES {
        let curve = curve(name);
        let chain = Chain::new(&curve).unwrap_or_else(|_| panic!("{name}"));
        let mut before: Option<Rational> = None;
        for subdivisions in 0..3 {
            let found = certified(&curve, subdivisions);
            let statement = found.document.expect(name).claim.statement;
            let width = (&statement.upper_squared - &statement.lower_squared) / &statement.upper_squared;
            assert!(width <= fraction(1, 1_000_000), "{name}");
            for piece in 0..chain.pieces.len().min(6) {
                for part in parts(&chain, piece, subdivisions) {
                    for k in 0..=10 {
                        assert!(part.squared_at(&fraction(k, 10)) <= statement.upper_squared, "{name}");
                    }
                }
            }
            // Nairn, Peters and Lutterkort's bound holds, and falls by four each time, squared by sixteen.
            let polynomial = chain.pieces.iter().all(|piece| !piece.rational);
            assert_eq!(found.bound_squared.is_some(), polynomial, "{name}");
            if let Some(bound) = found.bound_squared {
                assert!(bound >= statement.lower_squared, "{name}");
                if let Some(before) = before {
                    assert!(&bound * fraction(16, 1) <= before, "{name}");
                }
                before = Some(bound);
            }
        }
    }
}

#[test]
fn the_parabola_attains_the_bound_exactly() {
    let parabola = curve("parabola");
    for subdivisions in 0..4 {
        let found = certified(&parabola, subdivisions);
        let statement = found.document.expect("a document").claim.statement;
        let exact = Rational::new(Integer::ONE, Integer::ONE << (4 * subdivisions));
        assert_eq!(statement.lower_squared, exact);
        assert_eq!(statement.upper_squared, exact);
        assert_eq!(found.bound_squared, Some(exact));
        assert_eq!(found.edges, 2 << subdivisions);
    }
}

#[test]
fn a_rational_piece_breaks_the_bound_of_second_differences() {
    let flat = r#"{ "knotproof": "curve/1", "bezier": { "pieces": [
        { "points": [[-1, 0], [0, 1], [1, 0]], "weights": [1, "1/100", 1] } ] } }"#;
    let flat = read_curve(flat).expect("valid").curve;
    let found = certified(&flat, 0);
    assert_eq!(found.bound_squared, None);
    // The polynomial formula would say 1/2: second difference 2, N∞(2) = 1/4.
    let wrong = nairn_peters_lutterkort(2) * fraction(2, 1);
    let statement = found.document.expect("a document").claim.statement;
    assert!(statement.lower_squared > &wrong * &wrong * fraction(3, 1));
}

#[test]
fn the_factors_of_the_first_degrees() {
    let factors: Vec<Rational> = (1..=6).map(nairn_peters_lutterkort).collect();
    let expected = [(0, 1), (1, 4), (1, 3), (1, 2), (3, 5), (3, 4)].map(|(p, q)| fraction(p, q));
    assert_eq!(factors, expected);
}

#[test]
fn too_many_edges_are_refused() {
    let options = Options {
        subdivisions: 17,
        relative_width: fraction(1, 10),
        name: None,
        snapped_joints: None,
    };
    assert_eq!(
        certify(&curve("parabola"), &options).err(),
        Some(DeviationError::TooMany)
    );
}
