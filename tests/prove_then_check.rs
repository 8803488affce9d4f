//! Properties of proving and checking together, on random small curves: the search ends, what it writes is accepted, and agrees with
//! double normals found by sampling and Newton's method.
#![cfg(feature = "prove")]

mod common;
mod sampling;

use std::io::Cursor;
use std::sync::mpsc;
use std::time::Duration;

use common::polygon::Polygon;
use knotproof::certificate::Encoding;
use knotproof::check::{Verdict, check};
use knotproof::claim::msd::{Convention, Lower, Statement};
use knotproof::curve::{BSpline, Bezier, Curve, Form};
use knotproof::number::{Rational, RationalExt, RationalVector};
use knotproof::prove::msd::{CertifyError, Options, Status, certify};
use proptest::collection::vec;
use proptest::prelude::*;
use sampling::FloatCurve;

fn integers(numbers: impl IntoIterator<Item = i64>) -> RationalVector {
    let numbers: Vec<Rational> = numbers.into_iter().map(|n| Rational::from_integer(n.into())).collect();
    RationalVector::from_rationals(&numbers)
}

/// A chain of Bézier pieces with small integer coordinates, so that points coincide and pieces cross, overlap and turn back. Each piece is
/// given by the control points after its first; a closed chain ends in the point in which it starts.
fn chain(pieces: &[(Vec<Vec<i64>>, Vec<i64>)], start: &[i64], closed: bool) -> Option<Curve> {
    let dimension = start.len();
    let mut last = start.to_vec();
    let mut list = Vec::new();
    for (i, (points, weights)) in pieces.iter().enumerate() {
        let mut all = vec![last.clone()];
        all.extend(points.iter().map(|point| point[..dimension].to_vec()));
        if closed && i + 1 == pieces.len() {
            *all.last_mut()? = start.to_vec();
        }
        last = all.last()?.clone();
        let weights = weights
            .iter()
            .any(|w| *w != 1)
            .then(|| integers(weights[..all.len()].iter().copied()));
        list.push(Bezier::new(dimension, integers(all.into_iter().flatten()), weights).ok()?);
    }
    Curve::new(dimension, Form::Bezier(list)).ok()
}

/// A B-spline with clamped or uniform knots; a closed one repeats its first control points at the end.
fn spline(
    degree: usize,
    mut points: Vec<Vec<i64>>,
    weights: Option<Vec<i64>>,
    dimension: usize,
    closed: bool,
) -> Option<Curve> {
    let mut weights = weights.map(|weights| weights[..points.len()].to_vec());
    if closed {
        points.extend_from_within(..degree);
        if let Some(weights) = &mut weights {
            weights.extend_from_within(..degree);
        }
    }
    let count = points.len();
    let knots: Vec<i64> = match closed {
        true => (0..(count + degree + 1) as i64).collect(),
        false => (0..=(count + degree) as i64)
            .map(|i| (i - degree as i64).clamp(0, (count - degree) as i64))
            .collect(),
    };
    let coordinates = points.iter().flat_map(|point| point[..dimension].to_vec());
    let spline = BSpline::new(
        dimension,
        degree,
        integers(knots),
        integers(coordinates),
        weights.map(integers),
    );
    spline.ok().map(Curve::from)
}

fn point() -> impl Strategy<Value = Vec<i64>> {
    vec(-4i64..=4, 3)
}

fn weights() -> impl Strategy<Value = Vec<i64>> {
    prop_oneof![Just(vec![1; 12]), vec(1i64..=3, 12)]
}

fn curves(highest: usize) -> impl Strategy<Value = Curve> {
    let pieces = vec((vec(point(), 1..=highest), weights()), 1..=4);
    let chains = (pieces, point(), 2usize..=3, any::<bool>())
        .prop_filter_map("a chain", |(pieces, start, dimension, closed)| {
            chain(&pieces, &start[..dimension], closed)
        });
    let splines = (
        1..=highest,
        vec(point(), 6..=8),
        proptest::option::of(weights()),
        2usize..=3,
        any::<bool>(),
    )
        .prop_filter_map("a spline", |(degree, points, weights, dimension, closed)| {
            spline(degree, points, weights, dimension, closed)
        });
    prop_oneof![2 => chains, 1 => splines]
}

/// Runs in a thread of its own, as long as is patience.
fn within<T: Send + 'static>(seconds: u64, what: &str, work: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || sender.send(work()));
    match receiver.recv_timeout(Duration::from_secs(seconds)) {
        Ok(result) => result,
        Err(mpsc::RecvTimeoutError::Timeout) => panic!("no end within {seconds} s: {what}"),
        Err(mpsc::RecvTimeoutError::Disconnected) => panic!("panicked: {what}"),
    }
}

fn text(curve: &Curve) -> String {
    knotproof::curve::write_curve(curve, None)
}

/// The certificate on a number of threads, and whether the search came to an end.
fn proved(curve: &Curve, convention: Convention, threads: usize) -> (Vec<u8>, Status) {
    let owned = curve.clone();
    let what = format!("{convention:?} {}", text(curve));
    within(60, &what, move || {
        let options = Options {
            convention,
            relative_width: Rational::new(1.into(), 1000.into()),
            budget: Some(3000),
            ..Options::default()
        };
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a pool");
        pool.install(|| {
            let mut found = certify(&owned, &options, &|_| ()).expect("certifies");
            let mut file = Cursor::new(Vec::new());
            found
                .write_checked(Encoding::Binary, &mut file)
                .expect("the checker accepts what the search wrote");
            (file.into_inner(), found.status)
        })
    })
}

fn statement(bytes: &[u8]) -> Statement {
    match check(bytes) {
        Verdict::Accepted { document, .. } => document
            .claim
            .msd()
            .expect("a certificate of the claim msd")
            .statement
            .clone(),
        Verdict::Rejected { rejection, .. } => panic!("rejected: {rejection}"),
        Verdict::Malformed(error) => panic!("malformed: {error}"),
    }
}

/// The vertices of a polygon.
fn vertices(curve: &Curve) -> Option<Vec<Vec<Rational>>> {
    let chain = curve.chain();
    if chain
        .pieces()
        .iter()
        .any(|piece| piece.degree() != 1 || !piece.is_polynomial() || piece.point(0) == piece.point(1))
    {
        return None;
    }
    let mut vertices = vec![chain.pieces()[0].point(0)];
    vertices.extend(chain.pieces().iter().map(|piece| piece.point(1)));
    Some(vertices)
}

/// The statement against what is known otherwise.
fn consistent(curve: &Curve, statement: &Statement) {
    let critical = statement.convention == Convention::Critical;
    if let Some(vertices) = vertices(curve) {
        match (Polygon::new(&vertices).squared(critical), &statement.lower_squared) {
            (Some(truth), Lower::Finite(lower)) => {
                assert!(*lower <= truth, "σ² = {truth}, {statement:?}, {}", text(curve))
            }
            (Some(truth), Lower::Infinite) => {
                panic!("σ² = {truth}, {statement:?}, {}", text(curve))
            }
            (None, _) => assert!(
                statement.upper_squared.is_none(),
                "no double normal, {statement:?}, {}",
                text(curve)
            ),
        }
        let truth = Polygon::new(&vertices).squared(critical);
        if let (Some(truth), Some(upper)) = (truth, &statement.upper_squared) {
            assert!(*upper >= truth, "σ² = {truth}, {statement:?}, {}", text(curve));
        }
    }
    let lower = match &statement.lower_squared {
        Lower::Infinite => f64::INFINITY,
        Lower::Finite(lower) => lower.to_f64().sqrt(),
    };
    let floats = FloatCurve::new(curve);
    for (length, at) in floats.double_normals(critical) {
        assert!(
            length >= lower * (1.0 - 1e-9),
            "a double normal of length {length} at {at:?}, {statement:?}, {}",
            text(curve)
        );
    }
}

fn holds(curve: &Curve) {
    for convention in [Convention::Smooth, Convention::Critical] {
        let (bytes, _) = proved(curve, convention, 1);
        consistent(curve, &statement(&bytes));
        let (again, _) = proved(curve, convention, 2);
        assert!(
            bytes == again,
            "another certificate on two threads: {convention:?} {}",
            text(curve)
        );
    }
}

/// Has every piece a tangent? Nothing can be certified of a curve with a piece that is a point.
fn has_tangents(curve: &Curve) -> bool {
    curve
        .chain()
        .pieces()
        .iter()
        .all(|piece| piece.start_direction().is_some())
}

/// So many cases, unless the environment asks for more.
fn usual_cases(usual: u32) -> u32 {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|text| text.parse().ok());
    asked.unwrap_or(usual)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: usual_cases(96), max_shrink_iters: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn certificates_are_accepted_and_consistent(curve in curves(5).prop_filter("a point", has_tangents)) {
        holds(&curve);
    }

    #[test]
    fn polygons_agree_with_their_exact_truth(curve in curves(1).prop_filter("a point", has_tangents)) {
        holds(&curve);
    }

    /// Blossoms in the checker, knot insertion in `curve`.
    #[test]
    fn both_ways_to_the_pieces_agree(curve in curves(5)) {
        pieces_agree(&curve);
    }
}

fn pieces_agree(curve: &Curve) {
    let inserted = curve.chain();
    let Ok(blossomed) = knotproof::check::chain::Chain::new(curve) else {
        let point = |piece: &Bezier| (1..=piece.degree()).all(|k| piece.point(k) == piece.point(0));
        assert!(inserted.pieces().iter().any(point));
        return;
    };
    assert_eq!(blossomed.pieces.len(), inserted.count());
    assert_eq!(blossomed.closed, inserted.closed());
    for (i, piece) in inserted.pieces().iter().enumerate() {
        let numbers = blossomed
            .numbers_as::<knotproof::number::Integer>(i)
            .expect("unbounded integers do not overflow");
        assert_eq!(numbers.points.len(), piece.degree() + 1);
        assert_eq!(numbers.weights.is_empty(), piece.is_polynomial());
        let shared = blossomed.pieces[i].point_scale.value();
        for k in 0..=piece.degree() {
            let weight = numbers.weights.get(k).unwrap_or(&shared);
            let own: Vec<Rational> = (0..curve.dimension())
                .map(|axis| Rational::new(numbers.points[k][axis].clone(), weight.clone()))
                .collect();
            assert_eq!(own, piece.point(k), "piece {i}, point {k}: {}", text(curve));
            if let Some(weights) = piece.weights().filter(|_| !piece.is_polynomial()) {
                let ratio = Rational::new(weight.clone(), numbers.weights[0].clone());
                assert_eq!(ratio, weights.get(k) / weights.get(0), "piece {i}, weight {k}");
            }
        }
    }
}

#[test]
fn pieces_of_the_example_curves_agree() {
    for entry in std::fs::read_dir(common::case::certs().join("curves")).expect("a folder") {
        let json = std::fs::read(entry.expect("an entry").path()).expect("a file");
        pieces_agree(&knotproof::curve::read_curve(json).expect("a curve").curve);
    }
}

/// Curves that once went wrong.
mod regressions {
    use super::*;

    fn of(pieces: &[&[[i64; 2]]]) -> Curve {
        let pieces = pieces
            .iter()
            .map(|points| Bezier::new(2, integers(points.concat()), None).expect("a piece"));
        Curve::new(2, Form::Bezier(pieces.collect())).expect("a chain")
    }

    #[test]
    fn newton_steps_beyond_the_end() {
        holds(&of(&[
            &[[-1, 1], [0, -1], [1, 1]],
            &[[1, 1], [1, 3], [1, 3]],
            &[[1, 3], [0, 5], [-1, 3]],
        ]));
    }

    /// The checker refuses such a curve whatever is stated, so nothing may be called certified.
    #[test]
    fn a_piece_that_is_a_point() {
        let curve = of(&[&[[0, 0], [3, 0]], &[[3, 0], [3, 0]], &[[3, 0], [3, 2]]]);
        let refused = certify(&curve, &Options::default(), &|_| ()).err();
        assert!(
            matches!(refused, Some(CertifyError::PointPiece { piece: 1 })),
            "{refused:?}"
        );
    }

    #[test]
    fn cusp() {
        holds(&of(&[&[[-3, 3], [3, -1], [-3, -1], [3, 3]]]));
    }

    #[test]
    fn overlapping_sides() {
        holds(&of(&[&[[0, 0], [3, 0]], &[[3, 0], [1, 0]], &[[1, 0], [1, 2]]]));
    }

    #[test]
    fn a_curve_traced_twice() {
        holds(&of(&[&[[0, 0], [2, 3], [4, 0]], &[[4, 0], [2, 3], [0, 0]]]));
    }
}
