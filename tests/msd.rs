//! The minimum separation distance, from a curve to an accepted certificate: values known by other means, and curves that must not be
//! certified.
#![cfg(feature = "prove")]

use std::io::Cursor;

use knotproof::certificate::Encoding;
use knotproof::claim::msd::{Convention, Lower};
use knotproof::curve::{Curve, read_curve};
use knotproof::number::{Meaning, Rational, RationalExt, parse_number};
use knotproof::prove::msd::{Certified, Options, Status, certify};

fn number(text: &str) -> Rational {
    parse_number(text, Meaning::Decimal).unwrap()
}

fn file(name: &str) -> Curve {
    let path = format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    read_curve(std::fs::read(path).unwrap()).unwrap().curve
}

fn planar(pieces: &[&[(&str, &str)]]) -> Curve {
    let pieces: Vec<String> = pieces
        .iter()
        .map(|points| {
            let points: Vec<String> = points.iter().map(|(x, y)| format!(r#"["{x}","{y}"]"#)).collect();
            format!(r#"{{"points":[{}]}}"#, points.join(","))
        })
        .collect();
    let text = format!(
        r#"{{"knotproof":"curve/1","bezier":{{"pieces":[{}]}}}}"#,
        pieces.join(",")
    );
    read_curve(text).unwrap().curve
}

/// Certifies and lets the checker accept what was written, in both forms.
fn accepted<'c>(curve: &'c Curve, convention: Convention, width: &str, budget: Option<u64>) -> Certified<'c> {
    let options = Options {
        convention,
        relative_width: number(width),
        budget,
        ..Options::default()
    };
    let mut certified = certify(curve, &options, &|_| ()).unwrap();
    for encoding in [Encoding::Json, Encoding::Binary] {
        certified.write_checked(encoding, &mut Cursor::new(Vec::new())).unwrap();
    }
    certified
}

fn lower(certified: &Certified) -> Option<Rational> {
    match &certified.document.claim.statement.lower_squared {
        Lower::Infinite => None,
        Lower::Finite(lower) => Some(lower.clone()),
    }
}

/// Is certified, encloses σ, and is as narrow as asked.
fn encloses(certified: &Certified, sigma: &str, width: &str) {
    assert_eq!(certified.status, Status::Certified);
    let (low, high) = (
        lower(certified).unwrap(),
        certified.document.claim.statement.upper_squared.clone().unwrap(),
    );
    // A decimal that is cut off is at most one unit of its last place below σ.
    let from = number(sigma);
    let places = sigma.split('.').nth(1).map_or(0, str::len);
    let to = &from + number(&format!("1e-{places}"));
    assert!(low <= &to * &to && &from * &from <= high, "{low} {high}");
    let factor = number("1") - number(width);
    assert!(low >= &high * &factor * &factor);
}

#[test]
fn mp06() {
    let curve = file("mp06-figure-1");
    for width in ["1e-1", "1e-6", "1e-12", "1e-15", "1e-30"] {
        let certified = accepted(&curve, Convention::Smooth, width, None);
        encloses(&certified, "0.442675170376606599444313276103389848818804", width);
        let [s, t] = certified.at.unwrap();
        let accuracy = if width == "1e-1" { 1e-2 } else { 1e-5 };
        assert!((s.to_f64() - 0.477_368_614_194_185).abs() < accuracy);
        assert!((t.to_f64() - 2.784_510_932_858_206).abs() < accuracy);
    }
}

#[test]
fn trefoil_attains_it_twice() {
    encloses(
        &accepted(&file("trefoil-24"), Convention::Smooth, "1e-12", None),
        "1.081040191529209999",
        "1e-12",
    );
    encloses(
        &accepted(&file("trefoil-24"), Convention::Smooth, "1e-30", None),
        "1.08104019152920999916790730541",
        "1e-30",
    );
}

#[test]
fn degree_eight() {
    for width in ["1e-12", "1e-30"] {
        encloses(
            &accepted(&file("degree-8"), Convention::Smooth, width, None),
            "0.740919277985580490309213004908",
            width,
        );
    }
}

#[test]
fn circles() {
    for (name, diameter) in [("nurbs-circle", "2"), ("nurbs-circle-radius-3-2", "3")] {
        for width in ["1e-1", "1e-6", "1e-12", "1e-30"] {
            let curve = file(name);
            let certified = accepted(&curve, Convention::Smooth, width, None);
            encloses(&certified, diameter, width);
            // All diameters are double normals: opposite parts take one leaf, whatever the width.
            assert!(certified.leaves < 200, "{} leaves", certified.leaves);
            let diameter = number(diameter);
            assert_eq!(
                certified.document.claim.statement.upper_squared,
                Some(&diameter * &diameter)
            );
        }
    }
    encloses(
        &accepted(&file("nurbs-ellipse"), Convention::Smooth, "1e-12", None),
        "2",
        "1e-12",
    );
}

/// A chain with a conic in it, of the weights 1, 1, 2.
fn with_conic(before: &str, conic: &str, after: &str) -> Curve {
    let text = format!(
        r#"{{"knotproof":"curve/1","bezier":{{"pieces":[{before}{{"points":{conic},"weights":["1","1","2"]}}{after}]}}}}"#
    );
    read_curve(text).unwrap().curve
}

#[test]
fn a_corner_that_is_critical_in_one_direction_exactly() {
    // The corner turns by 3·10⁻⁶, one of its directions is level, and the nearest point is straight below at an irrational parameter.
    let curve = with_conic(
        r#"{"points":[["12","1.242"],["13.806","1.242"],["15.562","1.736"],["17.086","2.649"]]},"#,
        r#"[["17.086","2.649"],["12","3.45"],["6.914","2.649"]]"#,
        r#",{"points":[["6.914","2.649"],["9.262","1.242008"],["12","1.242"]]}"#,
    );
    let certified = accepted(&curve, Convention::Critical, "1e-9", None);
    // (2·2.649 + √2·3.45)/(2 + √2) − 1.242.
    encloses(&certified, "1.7387850634", "1e-9");
}

#[test]
fn nearly_parallel_strands() {
    let curve = planar(&[
        &[("18.263", "23.994"), ("14.218", "23.994")],
        &[
            ("14.218", "23.994"),
            ("14.135", "16.246"),
            ("7.795", "9.977"),
            ("0", "9.942"),
        ],
        &[("0", "9.942"), ("0", "6.038")],
        &[("0", "6.038"), ("0.071", "6.038")],
        &[
            ("0.071", "6.038"),
            ("10.054", "6.038"),
            ("18.192", "14.082"),
            ("18.263", "23.994"),
        ],
    ]);
    for convention in [Convention::Smooth, Convention::Critical] {
        encloses(&accepted(&curve, convention, "1e-9", None), "4.0460493377", "1e-9");
    }
}

#[test]
fn a_right_angled_zigzag() {
    let zigzag = [("23", "18"), ("27/2", "17/2"), ("17/2", "27/2"), ("1", "6")];
    let sides: Vec<[(&str, &str); 2]> = zigzag.windows(2).map(|side| [side[0], side[1]]).collect();
    let curve = planar(&sides.iter().map(|side| &side[..]).collect::<Vec<_>>());
    for convention in [Convention::Smooth, Convention::Critical] {
        let certified = accepted(&curve, convention, "1e-12", None);
        assert_eq!(certified.status, Status::Certified);
        // The side between the corners is orthogonal to both others.
        assert_eq!(certified.document.claim.statement.upper_squared, Some(number("50")));
    }
}

#[test]
fn sharp_corners_of_equal_control_points() {
    let spike = |tip: &str, end: &str| {
        planar(&[
            &[("0", "0"), ("2", "0"), ("3", "0"), ("3", "0")],
            &[("3", "0"), ("3", "0"), ("2", tip), ("0", end)],
            &[("0", end), ("-1", "1/4"), ("0", "0")],
        ])
    };
    for (tip, end) in [("1", "2"), ("1/10", "1/2"), ("1/100", "1/3")] {
        for convention in [Convention::Smooth, Convention::Critical] {
            let curve = spike(tip, end);
            let certified = accepted(&curve, convention, "1e-9", None);
            assert_eq!(certified.status, Status::Certified, "{tip} {convention:?}");
        }
    }
    // The tip turned by 180°.
    let curve = spike("0", "1/3");
    assert!(matches!(
        accepted(&curve, Convention::Smooth, "1e-9", None).status,
        Status::Undecided(_)
    ));
}

#[test]
fn no_double_normal() {
    for name in ["segment", "parabola", "triangle", "triangle-acute"] {
        let curve = file(name);
        let certified = accepted(&curve, Convention::Smooth, "1e-12", None);
        assert_eq!(certified.status, Status::Certified, "{name}");
        assert_eq!(
            certified.document.claim.statement.lower_squared,
            Lower::Infinite,
            "{name}"
        );
        assert_eq!(certified.document.claim.statement.upper_squared, None, "{name}");
    }
}

#[test]
fn polygons() {
    for convention in [Convention::Smooth, Convention::Critical] {
        for width in ["1e-12", "1e-30"] {
            encloses(&accepted(&file("square"), convention, width, None), "1", width);
        }
    }
    // The least height of a 3-4-5 triangle is 12/5.
    encloses(
        &accepted(&file("triangle"), Convention::Critical, "1e-12", None),
        "2.4",
        "1e-12",
    );
    encloses(
        &accepted(&file("triangle-acute"), Convention::Critical, "1e-12", None),
        "11.2",
        "1e-12",
    );
}

#[test]
fn corners_coincident_points_and_parallel_sides() {
    encloses(
        &accepted(&file("stadium"), Convention::Smooth, "1e-12", None),
        "2",
        "1e-12",
    );
    encloses(
        &accepted(&file("coincident-ends"), Convention::Smooth, "1e-12", None),
        "3.5",
        "1e-12",
    );
    let curve = file("corner-150");
    let corner = accepted(&curve, Convention::Smooth, "1e-12", None);
    assert_eq!(corner.status, Status::Certified);
    let curve = file("corner-150");
    let corner = accepted(&curve, Convention::Critical, "1e-12", None);
    encloses(&corner, "3.55263453245", "1e-12");
    // An open end over a segment: the nearest point of the other piece is inside it.
    let hook = planar(&[
        &[("0", "0"), ("4", "0")],
        &[("4", "0"), ("4", "1")],
        &[("4", "1"), ("1", "1")],
    ]);
    encloses(&accepted(&hook, Convention::Critical, "1e-12", None), "1", "1e-12");
}

#[test]
fn rational_and_high_degree() {
    for name in [
        "planar-degree-4",
        "closed-degree-5",
        "space-degree-6",
        "space-degree-7",
        "nurbs-space",
        "helix-degree-9",
        "unclamped-periodic",
        "cpij14-experiment-1",
    ] {
        for convention in [Convention::Smooth, Convention::Critical] {
            let curve = file(name);
            let certified = accepted(&curve, convention, "1e-9", None);
            assert_eq!(certified.status, Status::Certified, "{name}");
        }
    }
}

#[test]
fn a_chain_of_two_thousand_pieces() {
    // The value by elimination, piece pair by piece pair (docs/BENCHMARKS.md).
    let curve = file("calpha-2000");
    encloses(
        &accepted(&curve, Convention::Smooth, "1e-12", None),
        "3.19932491312631486768741081874",
        "1e-12",
    );
}

#[test]
fn a_curve_that_crosses_itself_has_distance_zero() {
    // The last three cross at parameters that are not simple fractions.
    let curves = [
        file("crossing-at-joints"),
        file("figure-eight"),
        planar(&[&[("0", "0"), ("7", "5"), ("-3", "5"), ("5", "0.3")]]),
        planar(&[
            &[("0", "0"), ("3", "1")],
            &[("3", "1"), ("3", "2")],
            &[("3", "2"), ("0.5", "-1.7")],
        ]),
        planar(&[
            &[("0", "0"), ("1", "3"), ("2", "-3"), ("3", "0.1")],
            &[("3", "0.1"), ("4", "4"), ("0", "4"), ("0.1", "-1")],
        ]),
    ];
    for (i, curve) in curves.iter().enumerate() {
        for convention in [Convention::Smooth, Convention::Critical] {
            let certified = accepted(curve, convention, "1e-12", Some(100_000));
            assert_eq!(certified.status, Status::Certified, "curve {i}");
            assert_eq!(lower(&certified).unwrap(), number("0"), "curve {i}");
            assert_eq!(
                certified.document.claim.statement.upper_squared,
                Some(number("0")),
                "curve {i}"
            );
        }
    }
}

#[test]
fn what_touches_or_retraces_is_never_given_a_positive_bound() {
    let curves = [
        // There and back again.
        planar(&[
            &[("0", "0"), ("1", "0")],
            &[("1", "0"), ("1", "1")],
            &[("1", "1"), ("0.5", "0")],
            &[("0.5", "0"), ("0", "0")],
        ]),
        // A parabola that touches a line, and two that touch each other.
        planar(&[
            &[("-1", "1"), ("0", "-1"), ("1", "1")],
            &[("1", "1"), ("3", "0")],
            &[("3", "0"), ("-2", "0")],
        ]),
        // y = (x²−2)² touches y = 0 at x = √2.
        planar(&[
            &[("0", "4"), ("0.5", "4"), ("1", "4/3"), ("1.5", "-4"), ("2", "4")],
            &[("2", "4"), ("3", "0")],
            &[("3", "0"), ("1", "0")],
        ]),
        planar(&[
            &[("-1", "1"), ("0", "-1"), ("1", "1")],
            &[("1", "1"), ("3", "-1")],
            &[("3", "-1"), ("1", "-1")],
            &[("1", "-1"), ("0", "1"), ("-1", "-1")],
        ]),
        // A corner of 180°.
        planar(&[&[("0", "0"), ("1", "0")], &[("1", "0"), ("0.5", "0")]]),
    ];
    for (i, curve) in curves.iter().enumerate() {
        for convention in [Convention::Smooth, Convention::Critical] {
            let certified = accepted(curve, convention, "1e-6", Some(20_000));
            assert_eq!(lower(&certified), Some(number("0")), "curve {i}");
        }
    }
}

#[test]
fn a_cusp_is_named() {
    for convention in [Convention::Smooth, Convention::Critical] {
        let curve = file("cusp");
        let certified = accepted(&curve, convention, "1e-12", None);
        assert_eq!(lower(&certified), Some(number("0")));
        let Status::Undecided(why) = &certified.status else {
            panic!("a cusp was certified")
        };
        assert!(why.contains("0.5"), "{why}");
    }
}

#[test]
fn a_small_budget_still_gives_a_proved_interval() {
    let curve = file("mp06-figure-1");
    let sigma = number("0.4426751703766065994443");
    let mut last = number("0");
    for budget in [5, 60, 90] {
        let certified = accepted(&curve, Convention::Smooth, "1e-12", Some(budget));
        assert!(matches!(certified.status, Status::Undecided(_)));
        assert!(certified.leaves <= budget);
        let bound = lower(&certified).unwrap();
        assert!(bound >= last && bound < &sigma * &sigma);
        assert!(certified.document.claim.statement.upper_squared.clone().unwrap() > &sigma * &sigma);
        last = bound;
    }
    assert!(last > number("0.1"));
}

#[test]
fn the_certificate_does_not_depend_on_the_number_of_threads() {
    for name in ["trefoil-24", "unclamped-periodic"] {
        let curve = file(name);
        let bytes = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut out = Vec::new();
                certify(&curve, &Options::default(), &|_| ())
                    .unwrap()
                    .write(Encoding::Binary, &mut out)
                    .unwrap();
                out
            })
        };
        assert_eq!(bytes(1), bytes(3));
    }
}
