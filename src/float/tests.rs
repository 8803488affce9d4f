//! The operations against the exact ones. Errors are in units of 2^-52 times the greatest magnitude of the exact result's coordinates.

use super::generate::{Random, curve, exact, parameter, spline};
use super::*;
use crate::curve::{BSpline, Bezier, Side};
use crate::number::{Rational, RationalExt, RationalVector};
use num_traits::{Signed, Zero};
use proptest::prelude::*;

/// Cases of each property; more for measuring, by the environment variable PROPTEST_CASES.
fn config() -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").is_ok();
    if asked {
        ProptestConfig::default()
    } else {
        ProptestConfig::with_cases(32)
    }
}

/// Below this, products lose digits by underflow: next to 0 there are parameters.
const TINY: f64 = 1e-270;

/// The greatest error of `found` in units of 2^-52·max|`expected`|.
fn units(found: &[f64], expected: &[Rational]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let most = expected.iter().map(|x| x.abs().to_f64()).fold(0.0, f64::max);
    let most = if most > 0.0 { most.max(TINY) } else { 0.0 };
    let error = |(x, y): (&f64, &Rational)| {
        let error = (exact(*x) - y).abs().to_f64();
        if error == 0.0 {
            0.0
        } else {
            error / (f64::EPSILON * most)
        }
    };
    found.iter().zip(expected).map(error).fold(0.0, f64::max)
}

/// The same for control points, with weights each relative to itself.
fn curve_units(found: &Curve, points: &RationalVector, weights: Option<&RationalVector>) -> f64 {
    let points: Vec<Rational> = points.iter().collect();
    let error = units(found.points(), &points);
    let weight_error = match (found.weights(), weights) {
        (None, None) => 0.0,
        (Some(found), Some(expected)) => found
            .iter()
            .zip(expected.iter())
            .map(|(x, y)| units(&[*x], &[y]))
            .fold(0.0, f64::max),
        (Some(found), None) => found.iter().map(|w| (w / found[0] - 1.0).abs()).fold(0.0, f64::max) / f64::EPSILON,
        (None, Some(_)) => f64::INFINITY,
    };
    error.max(weight_error)
}

fn spline_units(found: &Curve, expected: &BSpline) -> f64 {
    assert_eq!(found.degree(), expected.degree());
    assert_eq!(found.knots(), expected.knots().to_f64s());
    curve_units(found, expected.points(), expected.weights())
}

/// Keeps the worst error of a property and shows it when asked to.
fn check(name: &str, error: f64, bound: f64) {
    if std::env::var("KNOTPROOF_SHOW_ERRORS").is_ok() {
        use std::collections::BTreeMap;
        use std::sync::Mutex;
        static WORST: Mutex<BTreeMap<String, f64>> = Mutex::new(BTreeMap::new());
        let mut worst = WORST.lock().unwrap();
        let entry = worst.entry(name.into()).or_insert(0.0);
        if error > *entry {
            *entry = error;
            println!("{name}: {error:.2} units");
        }
        return;
    }
    assert!(error <= bound, "{name}: {error} units, at most {bound} expected");
}

/// An error in units of 2^-52·`expected`, beyond what rounding may do.
fn relative(error: f64, rounding: f64, expected: f64) -> f64 {
    let beyond = error - rounding;
    if beyond <= 0.0 {
        0.0
    } else {
        beyond / (f64::EPSILON * expected)
    }
}

fn side(random: &mut Random) -> Side {
    if random.below(2) == 0 {
        Side::Before
    } else {
        Side::After
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn points(seed: u64) {
        let mut random = Random(seed);
        let curve = curve(&mut random, 9);
        let (reference, evaluator) = (spline(&curve), Evaluator::new(&curve));
        let d = curve.dimension();
        for _ in 0..8 {
            let t = parameter(&mut random, &curve);
            let expected = reference.evaluate(&exact(t)).unwrap();
            check("point", units(&curve.point(t).unwrap()[..d], &expected), 1.0);
            check("point, prepared", units(&evaluator.point(t).unwrap()[..d], &expected), 16.0);
        }
    }

    // Where the terms cancel: a curve moved so that the point at some parameter is nearly the origin.
    #[test]
    fn points_near_the_origin(seed: u64) {
        let mut random = Random(seed);
        let mut curve = curve(&mut random, 7);
        let d = curve.dimension();
        let t = parameter(&mut random, &curve);
        let at = curve.point(t).unwrap();
        for point in curve.points.chunks_mut(d) {
            for (x, origin) in point.iter_mut().zip(at) {
                *x -= origin;
            }
        }
        let (reference, evaluator) = (spline(&curve), Evaluator::new(&curve));
        let (start, end) = curve.domain();
        let step = 10f64.powi(-(random.below(15) as i32)) * (end - start);
        for t in [t, (t + step).min(end), (t - step).max(start), t.next_up().min(end)] {
            let expected = reference.evaluate(&exact(t)).unwrap();
            let most = expected.iter().map(|x| x.abs().to_f64()).fold(0.0, f64::max);
            if most > f64::EPSILON * curve.magnitude() {
                check("point, near the origin", units(&curve.point(t).unwrap()[..d], &expected), 1.0);
                check("point, prepared, near the origin", units(&evaluator.point(t).unwrap()[..d], &expected), 16.0);
            }
        }
    }

    #[test]
    fn points_of_one_piece(seed: u64) {
        let mut random = Random(seed);
        let points: Vec<f64> = (0..8).map(|_| random.signed()).collect();
        let (start, length) = (random.signed(), random.unit() + 0.1);
        let mut knots = vec![start; 4];
        knots.extend(vec![start + length; 4]);
        let end = knots[7];
        let curve = Curve::new(2, 3, knots, points, None).unwrap();
        let (reference, cubic) = (spline(&curve), BezierEvaluator::<4, 2>::new(&curve).unwrap());
        let mut parameters: Vec<f64> = (0..30).map(|_| (start + length * random.unit()).min(end)).collect();
        parameters[random.below(30)] = end;
        parameters[random.below(30)] = start;
        let mut found = vec![[0.0; 2]; 30];
        cubic.points_at(&parameters, &mut found).unwrap();
        for (t, found) in parameters.iter().zip(&found) {
            prop_assert_eq!(&cubic.point(*t).unwrap(), found);
            check("point, of one piece", units(found, &reference.evaluate(&exact(*t)).unwrap()), 16.0);
        }
        for outside in [start.next_down(), end.next_up(), f64::NAN] {
            prop_assert_eq!(cubic.point(outside), Err(FloatError::OutsideDomain));
            let place = random.below(30);
            parameters[place] = outside;
            prop_assert_eq!(cubic.points_at(&parameters, &mut found), Err(FloatError::OutsideDomain));
            prop_assert_eq!(curve.points_at(&parameters, &mut vec![0.0; 60]), Err(FloatError::OutsideDomain));
            prop_assert_eq!(Evaluator::new(&curve).points_at(&parameters, &mut vec![0.0; 60]), Err(FloatError::OutsideDomain));
            parameters[place] = start;
        }
        prop_assert!(cubic.points_at(&parameters, &mut found[1..]).is_err());
        prop_assert!(BezierEvaluator::<3, 2>::new(&curve).is_err() && BezierEvaluator::<4, 3>::new(&curve).is_err());
    }

    #[test]
    fn spans_are_found(seed: u64) {
        let mut random = Random(seed);
        let mut knots = vec![0.0, 0.0];
        for _ in 0..1 + random.below(40) {
            knots.push(knots[knots.len() - 1] + 10f64.powf(-9.0 * random.unit()));
        }
        knots.push(knots[knots.len() - 1]);
        let count = knots.len() - 2;
        let points = (0..2 * count).map(|_| random.signed()).collect();
        let curve = Curve::new(2, 1, knots, points, None).unwrap();
        let locator = super::locate::Locator::new(&curve);
        for knot in &curve.knots {
            for t in [*knot, knot.next_up(), knot.next_down()] {
                if let Ok(k) = curve.span(t, Side::After) {
                    prop_assert_eq!(locator.span(t) + 1, k);
                }
            }
        }
    }

    #[test]
    fn derivatives(seed: u64) {
        let mut random = Random(seed);
        let curve = curve(&mut random, 9);
        let reference = spline(&curve);
        let t = parameter(&mut random, &curve);
        let side = side(&mut random);
        let order = random.below(5.min(curve.degree()) + 2);
        let expected = reference.derivatives(&exact(t), side, order).unwrap();
        if let Ok(found) = curve.derivatives(t, side, order) {
            let errors = curve.derivative_errors(t, side, order).unwrap();
            for ((found, expected), rounding) in found.iter().zip(&expected).zip(errors) {
                let most = expected.iter().map(|x| x.abs().to_f64()).fold(0.0, f64::max);
                let error = found.iter().zip(expected).map(|(x, y)| (exact(*x) - y).abs().to_f64());
                check("derivative", relative(error.fold(0.0, f64::max), rounding, most), 1.0);
            }
        }
    }

    #[test]
    fn curvature_and_torsion(seed: u64) {
        let mut random = Random(seed);
        let curve = curve(&mut random, 9);
        let t = parameter(&mut random, &curve);
        let side = side(&mut random);
        let mut all = spline(&curve).derivatives(&exact(t), side, 3).unwrap();
        for vector in &mut all {
            vector.resize(3, Rational::zero());
        }
        let dot = |a: &[Rational], b: &[Rational]| a.iter().zip(b).map(|(x, y)| x * y).fold(Rational::zero(), |s, x| s + x);
        let cross = |a: &[Rational], b: &[Rational]| -> Vec<Rational> {
            (0..3).map(|i| &a[(i + 1) % 3] * &b[(i + 2) % 3] - &a[(i + 2) % 3] * &b[(i + 1) % 3]).collect()
        };
        let normal = cross(&all[1], &all[2]);
        let (speed, square) = (dot(&all[1], &all[1]), dot(&normal, &normal));
        match curve.curvature_and_noise(t, side) {
            Err(FloatError::Irregular) => {
                // Nearly 0, in comparison with what it is made of.
                let errors = curve.derivative_errors(t, side, 1).unwrap();
                prop_assert!(speed.to_f64().sqrt() <= 2f64.powi(54) * errors[1], "{}", speed.to_f64());
            }
            Err(error) => prop_assert!(matches!(error, FloatError::Range { .. }), "{error}"),
            Ok((found, noise)) => {
                let expected = square.clone() / (&speed * &speed * &speed);
                let natural = (dot(&all[2], &all[2]) / (&speed * &speed)).to_f64().sqrt();
                let root = expected.to_f64().sqrt();
                // κ − κ₀ from the difference of the squares.
                let error = (exact(found) * exact(found) - &expected).abs().to_f64() / (found + root).max(f64::MIN_POSITIVE);
                let error = relative(error, noise * natural, root);
                check("curvature", error, 2.0);
            }
        }
        if curve.dimension() == 3 && !square.is_zero() && let Ok((found, noise)) = curve.torsion_and_noise(t, side) {
            let natural = (dot(&all[3], &all[3]) / &square).to_f64().sqrt();
            let expected = dot(&normal, &all[3]) / square;
            let error = (exact(found) - &expected).abs().to_f64();
            check("torsion", relative(error, noise * natural, expected.abs().to_f64()), 2.0);
        }
    }

    // A derivative that is exactly 0, on rational curves whose numbers leave nothing exact on the way to it.
    #[test]
    fn no_curvature_where_the_derivative_vanishes(seed: u64) {
        let mut random = Random(seed);
        let mut decimal = || (1 + random.below(99)) as f64 / 10.0;
        let weights: Vec<f64> = (0..7).map(|_| decimal()).collect();
        let mut points: Vec<f64> = (0..21).map(|_| decimal()).collect();
        // Two equal control points at the start, and on one side of a knot of full multiplicity.
        let (start, knot) = (decimal(), decimal());
        points.copy_within(0..3, 3);
        points.copy_within(9..12, 12);
        let knots = [vec![start; 4], vec![start + knot; 3], vec![start + knot + decimal(); 4]].concat();
        let curve = Curve::new(3, 3, knots, points, Some(weights)).unwrap();
        let knot = curve.knots()[4];
        // A cusp in the middle: with weights v, 2v, 2v, v it is where P₃ − P₀ = 2(P₁ − P₂).
        let (v, a) = (decimal(), decimal() / 10.0 + 0.25);
        let cusp = vec![0.0, 0.0, a, decimal(), a - 0.5, 0.0, 1.0, 0.0];
        let mut cusp = cusp;
        cusp[5] = cusp[3];
        let cusp = Curve::new(2, 3, [vec![0.0; 4], vec![1.0; 4]].concat(), cusp, Some(vec![v, 2.0 * v, 2.0 * v, v])).unwrap();
        for (curve, t, side) in [(&curve, start, Side::After), (&curve, knot, Side::After), (&cusp, 0.5, Side::After)] {
            let speed = &spline(curve).derivatives(&exact(t), side, 1).unwrap()[1];
            prop_assert!(speed.iter().all(Zero::is_zero), "{speed:?}");
            prop_assert_eq!(curve.curvature(t, side), Err(FloatError::Irregular));
            if curve.dimension() == 3 {
                prop_assert_eq!(curve.torsion(t, side), Err(FloatError::Irregular));
            }
            // Beside it the curve is regular.
            prop_assert!(curve.curvature(t + 1e-9, side).is_ok());
        }
        prop_assert!(curve.curvature(knot, Side::Before).is_ok());
    }

    #[test]
    fn insertion_split_and_decomposition(seed: u64) {
        let mut random = Random(seed);
        let curve = curve(&mut random, 9);
        let reference = spline(&curve);
        let t = parameter(&mut random, &curve);
        let room = curve.degree().saturating_sub(curve.multiplicity(t));
        let times = random.below(room + 1);
        let expected = reference.insert_knot(&exact(t), times).unwrap();
        check("insert_knot", spline_units(&curve.insert_knot(t, times).unwrap(), &expected), 1.0);
        if let Ok((left, right)) = curve.split(t) {
            let (before, after) = reference.split(&exact(t)).unwrap();
            check("split", spline_units(&left, &before).max(spline_units(&right, &after)), 1.0);
        }
        let pieces = curve.decompose().unwrap();
        let exact_curve = crate::curve::Curve::from(reference);
        let chain = exact_curve.chain();
        prop_assert_eq!(pieces.len(), chain.count());
        for (i, (found, expected)) in pieces.iter().zip(chain.pieces()).enumerate() {
            let (start, end) = chain.piece(i).unwrap().knots;
            prop_assert_eq!(found.domain(), (start.to_f64(), end.to_f64()));
            check("decompose", curve_units(found, expected.points(), expected.weights()), 1.0);
        }
    }

    #[test]
    fn elevation(seed: u64) {
        let mut random = Random(seed);
        let curve = curve(&mut random, 6);
        let times = 1 + random.below(3);
        let expected = spline(&curve).elevate(times).unwrap();
        check("elevate_degree", spline_units(&curve.elevate_degree(times).unwrap(), &expected), 1.0);
    }

    #[test]
    fn removal_of_an_inserted_knot(seed: u64) {
        let mut random = Random(seed);
        let degree = 1 + random.below(5);
        // With knots 0 to 9 and points that are multiples of 2520, insertion of an integer is exact in binary64.
        let mut knots = vec![0.0; degree + 1];
        for knot in 1..9 {
            knots.extend(vec![f64::from(knot); random.below(degree + 1).min(degree)]);
        }
        knots.extend(vec![9.0; degree + 1]);
        let count = knots.len() - degree - 1;
        let points = (0..3 * count).map(|_| 2520.0 * (random.below(41) as f64 - 20.0)).collect();
        let curve = Curve::new(3, degree, knots, points, None).unwrap();
        let t = 1.0 + random.below(8) as f64;
        if curve.multiplicity(t) < degree {
            let inserted = curve.insert_knot(t, 1).unwrap();
            prop_assert_eq!(inserted.remove_knot(t, 1, 0.0).unwrap(), curve.clone());
        }
        // A knot that is needed is not removed.
        let mut moved = curve.insert_knot(t, degree - curve.multiplicity(t)).unwrap();
        let first = moved.knots.partition_point(|knot| *knot < t);
        moved.points[3 * (first - 1)] += 1.0;
        let refused = matches!(moved.remove_knot(t, 1, 1e-9), Err(FloatError::NotRemovable { .. }));
        prop_assert!(refused);
    }

    #[test]
    fn rounded_insertions_are_removed(seed: u64) {
        let mut random = Random(seed);
        let curve = curve(&mut random, 5);
        let (start, end) = curve.domain();
        let t = start + (end - start) * (0.2 + 0.6 * random.unit());
        if curve.multiplicity(t) == 0 {
            let inserted = curve.insert_knot(t, 1).unwrap();
            let scale = curve.magnitude();
            if let Ok(removed) = inserted.remove_knot(t, 1, 1e-9 * scale) {
                let u = exact(parameter(&mut random, &curve));
                let (a, b) = (spline(&removed).evaluate(&u).unwrap(), spline(&curve).evaluate(&u).unwrap());
                for (x, y) in a.iter().zip(&b) {
                    prop_assert!((x - y).abs().to_f64() <= 1e-8 * scale);
                }
            }
        }
    }

    #[test]
    fn a_chain_becomes_one_spline(seed: u64) {
        let mut random = Random(seed);
        let dimension = 2 + random.below(2);
        let mut start: Option<Vec<Rational>> = None;
        let pieces: Vec<Bezier> = (0..1 + random.below(3))
            .map(|_| {
                let degree = 1 + random.below(4);
                let mut points: Vec<Rational> = (0..dimension * (degree + 1)).map(|_| exact(random.below(9) as f64)).collect();
                if let Some(start) = &start {
                    points[..dimension].clone_from_slice(start);
                }
                start = Some(points[dimension * degree..].to_vec());
                let weights: Vec<Rational> = (0..=degree).map(|_| exact(1.0 + random.below(4) as f64)).collect();
                let weights = (random.below(2) == 0).then(|| RationalVector::from_rationals(&weights));
                Bezier::new(dimension, RationalVector::from_rationals(&points), weights).unwrap()
            })
            .collect();
        let count = pieces.len();
        let chain = crate::curve::Curve::new(dimension, crate::curve::Form::Bezier(pieces)).unwrap();
        let curve = Curve::from_exact(&chain).unwrap();
        for _ in 0..5 {
            let t = count as f64 * random.unit();
            let expected = chain.chain().evaluate(&exact(t)).unwrap();
            let found = curve.point(t).unwrap();
            let scale = curve.magnitude();
            for (x, y) in found.iter().zip(&expected) {
                prop_assert!((exact(*x) - y).abs().to_f64() <= 16.0 * f64::EPSILON * scale);
            }
        }
    }
}

#[test]
fn knots_one_unit_apart() {
    let t = 0.3f64;
    let knots = vec![
        0.0,
        0.0,
        0.0,
        0.0,
        t,
        t.next_up(),
        t.next_up().next_up(),
        1.0,
        1.0,
        1.0,
        1.0,
    ];
    let points = vec![0.0, 0.0, 1.0, 3.0, 2.0, -1.0, 3.0, 3.0, 4.0, 0.0, 5.0, 1.0, 6.0, 7.0];
    let curve = Curve::new(2, 3, knots, points, None).unwrap();
    let reference = spline(&curve);
    let elevated = curve.elevate_degree(2).unwrap();
    assert!(spline_units(&elevated, &reference.elevate(2).unwrap()) <= 1.0);
    for order in 0..=3 {
        let found = curve.derivative(t.next_up(), Side::Before, order).unwrap();
        let expected = reference.derivatives(&exact(t.next_up()), Side::Before, order).unwrap();
        assert!(units(&found[..2], &expected[order]) <= 1.0, "order {order}");
    }
}

#[test]
fn batches_are_single_points() {
    let mut random = Random(7);
    for _ in 0..40 {
        let curve = curve(&mut random, 9);
        let parameters: Vec<f64> = (0..30).map(|_| parameter(&mut random, &curve)).collect();
        let mut points = vec![0.0; 30 * curve.dimension()];
        curve.points_at(&parameters, &mut points).unwrap();
        let evaluator = Evaluator::new(&curve);
        for (t, point) in parameters.iter().zip(points.chunks(curve.dimension())) {
            assert_eq!(point, &evaluator.point(*t).unwrap()[..curve.dimension()]);
        }
        assert!(curve.points_at(&parameters, &mut points[1..]).is_err());
    }
}

#[test]
fn refusals() {
    let line = |knots: Vec<f64>, points: Vec<f64>, weights| Curve::new(2, 1, knots, points, weights);
    let fine = vec![0.0, 0.0, 1.0, 1.0];
    let points = vec![0.0, 0.0, 1.0, 1.0];
    let curve = line(fine.clone(), points.clone(), None).unwrap();
    for t in [-1e-300, 1.0f64.next_up(), f64::NAN, f64::INFINITY] {
        assert_eq!(curve.point(t), Err(FloatError::OutsideDomain));
        assert_eq!(curve.insert_knot(t, 1), Err(FloatError::OutsideDomain));
        assert_eq!(curve.split(t), Err(FloatError::OutsideDomain));
    }
    assert!(matches!(
        line(vec![0.0, 0.0, f64::NAN, 1.0], points.clone(), None),
        Err(FloatError::Range { .. })
    ));
    assert!(matches!(
        line(fine.clone(), vec![0.0, 0.0, 1e200, 1.0], None),
        Err(FloatError::Range { .. })
    ));
    assert!(matches!(
        line(vec![0.0, 0.0, 0.0, 0.0], points.clone(), None),
        Err(FloatError::Curve(_))
    ));
    assert!(matches!(
        line(vec![0.0, 1.0, 0.5, 2.0], points.clone(), None),
        Err(FloatError::Curve(_))
    ));
    assert!(matches!(
        line(fine.clone(), points.clone(), Some(vec![1.0, -1.0])),
        Err(FloatError::Curve(_))
    ));
    assert!(matches!(
        line(fine.clone(), points.clone(), Some(vec![1.0, f64::NAN])),
        Err(FloatError::Range { .. })
    ));
    assert!(matches!(
        line(fine, points[1..].to_vec(), None),
        Err(FloatError::Curve(_))
    ));
    let refused = FloatError::Multiplicity {
        multiplicity: 2,
        greatest: 1,
    };
    assert_eq!(curve.insert_knot(0.5, 2), Err(refused.clone()));
    assert_eq!(
        curve.insert_knot(0.5, 1).unwrap().remove_knot(0.5, 2, 0.0),
        Err(refused)
    );
    assert_eq!(curve.elevate_degree(64), Err(FloatError::Degree { degree: 65 }));
    assert_eq!(curve.torsion(0.5, Side::After), Err(FloatError::Dimension));
    let point = line(vec![0.0, 0.0, 1.0, 1.0], vec![1.0; 4], None).unwrap();
    assert_eq!(point.curvature(0.5, Side::After), Err(FloatError::Irregular));
}
