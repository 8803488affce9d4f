//! The claim `embedding` from the curve to the accepted certificate: named curves, polygons against exact intersections, random curves, moves
//! within the perturbation radius.
#![cfg(feature = "prove")]

mod common;

use std::io::Cursor;

use common::case::certs;
use common::document::{Certificate, field_of};
use common::python;
use common::tree::leaf_ends as ends;
use knotproof::certificate::Encoding;
use knotproof::check::{Verdict, check};
use knotproof::claim::msd::Upper;
use knotproof::curve::{Bezier, Curve, Form, read_curve};
use knotproof::number::{Rational, RationalExt, RationalVector};
use knotproof::prove::embedding::{Certified, Options, Outcome, certify};
use proptest::collection::vec;
use proptest::prelude::*;
use serde_json::json;

fn named(name: &str) -> Curve {
    let path = certs().join("curves").join(format!("{name}.json"));
    read_curve(std::fs::read(path).expect(name)).expect(name).curve
}

fn outcome(curve: &Curve, budget: Option<u64>) -> Outcome<'_> {
    let options = Options {
        budget,
        ..Options::default()
    };
    certify(curve, &options, &|_| ()).expect("a curve whose pieces are no points")
}

/// The certificate's bytes, accepted by the checker.
fn bytes(certified: &mut Certified, encoding: Encoding) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    certified.write_checked(encoding, &mut file).expect("accepted");
    file.into_inner()
}

fn embedded<'c>(curve: &'c Curve, name: &str) -> Certified<'c> {
    match outcome(curve, None) {
        Outcome::Embedded(certified) => *certified,
        Outcome::MeetsItself(_) => panic!("{name} meets itself"),
        Outcome::Undecided(why) => panic!("{name}: {why}"),
    }
}

#[test]
fn named_curves_are_embedded() {
    let most_edges = [
        ("calpha-2000", 2000),
        ("closed-degree-5", 8),
        ("coincident-ends", 10),
        ("corner-150", 6),
        ("cpij14-experiment-1", 10),
        ("degree-8", 10),
        ("helix-degree-9", 1),
        ("mp06-figure-1", 40),
        ("nurbs-circle", 8),
        ("nurbs-circle-radius-3-2", 8),
        ("nurbs-ellipse", 8),
        ("nurbs-space", 6),
        ("parabola", 1),
        ("planar-degree-4", 6),
        ("segment", 1),
        ("space-degree-6", 6),
        ("space-degree-7", 8),
        ("square", 4),
        ("stadium", 12),
        ("trefoil-24", 24),
        ("triangle", 3),
        ("triangle-acute", 3),
        ("unclamped-periodic", 8),
    ];
    let mut files = Vec::new();
    for (name, most) in most_edges {
        let curve = named(name);
        let mut certified = embedded(&curve, name);
        let statement = certified.document.claim.statement.clone();
        assert!(statement.edges <= most, "{name}: {} edges", statement.edges);
        let zero = Rational::default();
        let radius = &statement.perturbation_radius;
        let standing = name == "coincident-ends";
        assert_eq!(radius.infinity == zero, standing, "{name}");
        // A move by less than ρ changes no coordinate by more.
        assert!(radius.euclidean >= radius.infinity, "{name}");
        for encoding in [Encoding::Json, Encoding::Binary] {
            let file = bytes(&mut certified, encoding);
            // The second checker takes its time for thousands of leaves.
            if certified.leaves < 1000 {
                files.push(file);
            }
        }
    }
    let files: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
    for answer in python::check_bytes(&files) {
        assert!(answer.accepted, "check.py: {}", answer.reason);
    }
}

#[test]
fn named_curves_that_meet_themselves_or_are_not_regular() {
    for name in ["figure-eight", "crossing-at-joints"] {
        let curve = named(name);
        let Outcome::MeetsItself(mut found) = outcome(&curve, None) else {
            panic!("{name} meets itself")
        };
        let mut file = Cursor::new(Vec::new());
        found.write_checked(Encoding::Json, &mut file).expect("accepted");
        assert!(matches!(found.document.claim.evidence.upper, Some(Upper::Touch { .. })));
    }
    let cusp = named("cusp");
    let Outcome::Undecided(why) = outcome(&cusp, None) else {
        panic!("a cusp is neither")
    };
    assert!(why.contains("parameter 0.5"), "{why}");
}

#[test]
fn a_transversal_crossing_is_enclosed() {
    // The crossing of this loop is at no simple fraction.
    let file = json!({ "knotproof": "curve/1", "bezier": { "pieces": [
        { "points": [[0, 0], [7, 5], [-3, 6], [5, 0]] }
    ] } });
    let curve = read_curve(file.to_string()).expect("a curve").curve;
    let Outcome::MeetsItself(mut found) = outcome(&curve, None) else {
        panic!("a loop")
    };
    assert!(found.document.claim.evidence.upper.is_some());
    let mut file = Cursor::new(Vec::new());
    found.write_checked(Encoding::Binary, &mut file).expect("accepted");
}

#[test]
fn a_small_budget_is_kept() {
    let Outcome::Undecided(why) = outcome(&named("trefoil-24"), Some(5)) else {
        panic!("5 leaves are not enough")
    };
    assert!(why.contains("budget of 5 leaves"), "{why}");
}

#[test]
fn threads_do_not_change_the_certificate() {
    let curve = named("calpha-2000");
    let [alone, together] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        pool.install(|| bytes(&mut embedded(&curve, "calpha-2000"), Encoding::Binary))
    });
    assert!(alone == together);
}

/// The control points of the curve between the ends of the leaves' nodes, equal neighbours once.
fn control_polygon(curve: &Curve, tokens: &[String]) -> Vec<Vec<f64>> {
    let chain = curve.chain();
    let whole = |i: usize| Rational::from_integer(i.into());
    let mut points: Vec<Vec<Rational>> = Vec::new();
    for cell in ends(curve, tokens).windows(2) {
        for (i, piece) in chain.pieces().iter().enumerate() {
            let (start, end) = (cell[0].clone().max(whole(i)), cell[1].clone().min(whole(i + 1)));
            if start >= end {
                continue;
            }
            let (start, end) = (start - whole(i), end - whole(i));
            let mut section = piece.clone();
            if end < whole(1) {
                section = section.split(&end).expect("inside").0;
            }
            if start > whole(0) {
                section = section.split(&(start / end)).expect("inside").1;
            }
            points.extend((0..=section.degree()).map(|k| section.point(k)));
        }
    }
    points.dedup();
    let float = |point: &Vec<Rational>| point.iter().map(RationalExt::to_f64).collect();
    points.iter().map(float).collect()
}

/// The points of a curve at the ends of the leaves' nodes, in their order, `finer` parts in each gap.
fn inscribed(curve: &Curve, tokens: &[String], finer: i64) -> Vec<Vec<f64>> {
    let ends = ends(curve, tokens);
    let mut parameters = vec![ends[0].clone()];
    for pair in ends.windows(2) {
        for k in 1..=finer {
            parameters.push(&pair[0] + (&pair[1] - &pair[0]) * Rational::new(k.into(), finer.into()));
        }
    }
    let chain = curve.chain();
    let point = |s: &Rational| -> Vec<f64> {
        let (piece, u) = chain.locate(s).expect("on the curve");
        let point = chain.pieces()[piece].evaluate(&u).expect("on the piece");
        point.iter().map(RationalExt::to_f64).collect()
    };
    parameters.iter().map(point).collect()
}

/// The distance of two segments, by alternating projections; convex, so that it converges.
fn distance(a: [&[f64]; 2], b: [&[f64]; 2]) -> f64 {
    let at = |s: [&[f64]; 2], t: f64| -> Vec<f64> { s[0].iter().zip(s[1]).map(|(x, y)| x + t * (y - x)).collect() };
    let project = |p: &[f64], s: [&[f64]; 2]| {
        let (mut along, mut square) = (0.0, 0.0);
        for i in 0..p.len() {
            let d = s[1][i] - s[0][i];
            along += (p[i] - s[0][i]) * d;
            square += d * d;
        }
        (along / square).clamp(0.0, 1.0)
    };
    let (mut p, mut q) = (at(a, 0.5), at(b, 0.5));
    for _ in 0..400 {
        q = at(b, project(&p, b));
        p = at(a, project(&q, a));
    }
    p.iter().zip(&q).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt()
}

#[test]
fn inscribed_polygons_are_embedded_and_have_the_edges_stated() {
    for name in ["mp06-figure-1", "trefoil-24", "nurbs-circle", "space-degree-7"] {
        let curve = named(name);
        let mut certified = embedded(&curve, name);
        let certificate = Certificate::of_bytes(&bytes(&mut certified, Encoding::Json));
        for finer in [1, 3] {
            let points = inscribed(&curve, &certificate.tokens(), finer);
            let edges = points.len() - 1;
            let stated = certified.document.claim.statement.edges as usize;
            assert_eq!(edges, stated * finer as usize, "{name}");
            no_edges_meet(&curve, &points, name);
        }
    }
}

/// Edges without a common vertex are apart.
fn no_edges_meet(curve: &Curve, points: &[Vec<f64>], name: &str) {
    let edges = points.len() - 1;
    let edge = |i: usize| [points[i].as_slice(), points[i + 1].as_slice()];
    for i in 0..edges {
        for j in i + 2..edges {
            if !(curve.is_closed() && i == 0 && j + 1 == edges) {
                let apart = distance(edge(i), edge(j));
                assert!(apart > 1e-6, "{name}: edges {i} and {j} are {apart} apart");
            }
        }
    }
}

#[test]
fn control_polygons_are_embedded_and_have_the_edges_told() {
    for name in [
        "mp06-figure-1",
        "trefoil-24",
        "nurbs-circle",
        "nurbs-space",
        "space-degree-7",
        "coincident-ends",
    ] {
        let curve = named(name);
        let mut certified = embedded(&curve, name);
        let certificate = Certificate::of_bytes(&bytes(&mut certified, Encoding::Json));
        let points = control_polygon(&curve, &certificate.tokens());
        assert_eq!(certified.control_polygon_edges, Some(points.len() as u64 - 1), "{name}");
        no_edges_meet(&curve, &points, name);
    }
}

#[test]
fn a_control_polygon_that_goes_back_is_not_told_to_be_isotopic() {
    // Small weights in the middle: the D_k increase along x, P₂ − P₁ does not. With equal weights the same polygon needs a finer tree.
    let points = [vec![2, 1], vec![1, 1], vec![3, 0]];
    let curve = chain(&[0, 0], &[points.to_vec()], &[10, 1, 1, 10], 2).expect("a piece");
    let certified = embedded(&curve, "small weights");
    assert_eq!(certified.document.claim.statement.edges, 1);
    assert_eq!(certified.control_polygon_edges, None);
    let curve = chain(&[0, 0], &[points.to_vec()], &[1; 4], 2).expect("a piece");
    let edges = embedded(&curve, "equal weights").control_polygon_edges;
    assert!(edges.is_some_and(|edges| edges > 3), "{edges:?}");
}

fn integers(numbers: impl IntoIterator<Item = i64>) -> RationalVector {
    let numbers: Vec<Rational> = numbers.into_iter().map(|n| Rational::from_integer(n.into())).collect();
    RationalVector::from_rationals(&numbers)
}

/// A chain of pieces, each given by its control points after the first.
fn chain(start: &[i64], pieces: &[Vec<Vec<i64>>], weights: &[i64], dimension: usize) -> Option<Curve> {
    let mut last = start.to_vec();
    let mut list = Vec::new();
    for points in pieces {
        let mut all = vec![last];
        all.extend(points.iter().cloned());
        last = all.last()?.clone();
        let weights = weights
            .iter()
            .any(|w| *w != 1)
            .then(|| integers(weights[..all.len()].iter().copied()));
        let coordinates = all.iter().flat_map(|point| point[..dimension].to_vec());
        list.push(Bezier::new(dimension, integers(coordinates), weights).ok()?);
    }
    Curve::new(dimension, Form::Bezier(list)).ok()
}

/// Twice the area of a triangle.
fn turn(a: &[i64; 2], b: &[i64; 2], c: &[i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn on_segment(p: &[i64; 2], a: &[i64; 2], b: &[i64; 2]) -> bool {
    turn(a, b, p) == 0 && (0..2).all(|i| p[i] >= a[i].min(b[i]) && p[i] <= a[i].max(b[i]))
}

fn meet(a: [&[i64; 2]; 2], b: [&[i64; 2]; 2]) -> bool {
    let [p, q, r, s] = [a[0], a[1], b[0], b[1]];
    let opposite = |x: i64, y: i64| x.signum() * y.signum() < 0;
    opposite(turn(p, q, r), turn(p, q, s)) && opposite(turn(r, s, p), turn(r, s, q))
        || on_segment(p, r, s)
        || on_segment(q, r, s)
        || on_segment(r, p, q)
        || on_segment(s, p, q)
}

/// Is an open or closed polygon simple? Neighbours have their vertex in common and nothing else.
fn simple(vertices: &[[i64; 2]]) -> bool {
    let edges = vertices.len() - 1;
    let closed = vertices[0] == vertices[edges];
    let edge = |i: usize| [&vertices[i], &vertices[i + 1]];
    (0..edges).all(|i| {
        (i + 1..edges).all(|j| {
            let around = closed && i == 0 && j + 1 == edges;
            match (i + 1 == j, around) {
                (false, false) => !meet(edge(i), edge(j)),
                (true, _) => {
                    !on_segment(edge(j)[1], edge(i)[0], edge(i)[1]) && !on_segment(edge(i)[0], edge(j)[0], edge(j)[1])
                }
                (false, true) => {
                    !on_segment(edge(i)[1], edge(j)[0], edge(j)[1]) && !on_segment(edge(j)[0], edge(i)[0], edge(i)[1])
                }
            }
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    /// Polygons of small integers cross, touch and overlap often; an exact test of all pairs of edges is the judge.
    #[test]
    fn polygons(mut vertices in vec([-4i64..=4, -4i64..=4], 3..9), closed: bool) {
        if closed {
            vertices.push(vertices[0]);
        }
        vertices.dedup();
        prop_assume!(vertices.len() > 3);
        let pieces: Vec<Vec<Vec<i64>>> = vertices[1..].iter().map(|vertex| vec![vertex.to_vec()]).collect();
        let curve = chain(&vertices[0], &pieces, &[1; 2], 2).expect("edges");
        let truth = simple(&vertices);
        match outcome(&curve, Some(20_000)) {
            Outcome::Embedded(mut certified) => {
                prop_assert!(truth);
                bytes(&mut certified, Encoding::Binary);
            }
            Outcome::MeetsItself(mut found) => {
                prop_assert!(!truth);
                found.write_checked(Encoding::Binary, &mut Cursor::new(Vec::new())).expect("accepted");
            }
            Outcome::Undecided(why) => prop_assert!(!truth, "{}", why),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// On random curves the search ends, what it finds is accepted, and where it finds an embedding no crossing is found.
    #[test]
    fn random_curves(
        start in vec(-4i64..=4, 3),
        pieces in vec(vec(vec(-4i64..=4, 3), 1..5), 1..4),
        weights in prop_oneof![Just(vec![1; 6]), vec(1i64..=3, 6)],
        dimension in 2usize..=3,
        closed: bool,
    ) {
        let mut pieces = pieces;
        if closed {
            *pieces.last_mut().expect("a piece").last_mut().expect("a point") = start.clone();
        }
        let Some(curve) = chain(&start, &pieces, &weights, dimension) else { return Ok(()) };
        let options = Options { budget: Some(20_000), ..Options::default() };
        match certify(&curve, &options, &|_| ()) {
            Ok(Outcome::Embedded(mut certified)) => {
                bytes(&mut certified, Encoding::Json);
                let options = knotproof::prove::msd::Options { budget: Some(500), ..Default::default() };
                let msd = knotproof::prove::msd::certify(&curve, &options, &|_| ()).expect("no points");
                let upper = &msd.document.claim.statement.upper_squared;
                prop_assert!(upper.as_ref().is_none_or(|upper| !upper.numer().is_zero()));
            }
            Ok(Outcome::MeetsItself(mut found)) => {
                found.write_checked(Encoding::Json, &mut Cursor::new(Vec::new())).expect("accepted");
            }
            Ok(Outcome::Undecided(_)) | Err(_) => {}
        }
    }

    /// Where there are no runs, every move within the radius leaves every leaf's obligation true: the same tree proves the moved curve.
    #[test]
    fn moves_within_the_radius(
        points in vec(vec(-9i64..=9, 3), 3..8),
        weights in prop_oneof![Just(vec![1; 8]), vec(1i64..=3, 8)],
        dimension in 2usize..=3,
        moves in vec([-999i64..=999, -999i64..=999, -999i64..=999], 8),
        corners: bool,
    ) {
        let Some(curve) = chain(&points[0], &[points[1..].to_vec()], &weights, dimension) else { return Ok(()) };
        prop_assume!(!curve.is_closed());
        let Ok(Outcome::Embedded(mut certified)) = certify(&curve, &Options::default(), &|_| ()) else { return Ok(()) };
        let radius = certified.document.claim.statement.perturbation_radius.clone();
        let certificate = Certificate::of_bytes(&bytes(&mut certified, Encoding::Json));
        let Form::Bezier(pieces) = curve.form() else { unreachable!("a chain") };
        let thousandth = |x: i64| Rational::new(x.into(), 1000.into());
        let coordinates: Vec<Rational> = pieces[0].points().iter().enumerate().map(|(i, x)| {
            let step = moves[i / dimension][i % dimension];
            let step = if corners { 999 * (2 * i64::from(step > 0) - 1) } else { step };
            x + thousandth(step) * &radius.infinity
        }).collect();
        let moved = Bezier::new(dimension, RationalVector::from_rationals(&coordinates), pieces[0].weights().cloned());
        let moved = Curve::new(dimension, Form::Bezier(vec![moved.expect("a piece")])).expect("a curve");
        let still = json!({ "infinity": "0", "euclidean": "0" });
        let again = certificate.with("/statement/perturbation_radius", still).curve(field_of(&moved));
        let verdict = check(again.json().as_slice());
        prop_assert!(matches!(verdict, Verdict::Accepted { .. }), "{}", common::case::describe(&verdict));
    }
}
