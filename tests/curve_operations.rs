//! The exact operations against independent formulas and against each other.

mod curve_support;

use curve_support::{at, bezier, bspline, fraction, integers, unit, vector};
use knotproof::curve::{BSpline, Bezier, Curve, CurveFault, Form, Joint, OperationError, Side, bernstein};
use knotproof::number::{Integer, Rational, RationalVector};
use num_traits::{One, Signed, Zero};
use proptest::prelude::*;

/// Numbers per case are small: a few dozen cases of each property reach every shape of knot vector.
fn config() -> ProptestConfig {
    ProptestConfig::with_cases(48)
}

/// Σ f_k w_k P_k / Σ f_k w_k.
fn weighted_sum(
    dimension: usize,
    points: &RationalVector,
    weights: Option<&RationalVector>,
    factors: &[Rational],
) -> Vec<Rational> {
    let mut sum = vec![Rational::zero(); dimension + 1];
    for (k, factor) in factors.iter().enumerate() {
        let factor = weights.map_or(factor.clone(), |w| w.get(k) * factor);
        for (axis, x) in sum[..dimension].iter_mut().enumerate() {
            *x += points.get(k * dimension + axis) * &factor;
        }
        sum[dimension] += factor;
    }
    let weight = sum.pop().unwrap();
    sum.iter().map(|x| x / &weight).collect()
}

/// (w X, w) to X.
fn affine(dimension: usize, point: &[Rational]) -> Vec<Rational> {
    match point.get(dimension) {
        Some(w) => point[..dimension].iter().map(|x| x / w).collect(),
        None => point.to_vec(),
    }
}

/// The B-spline basis functions by the recursion of Cox and de Boor, right-continuous.
fn cox_de_boor(spline: &BSpline, t: &Rational) -> Vec<Rational> {
    let knots: Vec<Rational> = spline.knots().iter().collect();
    let mut values: Vec<Rational> = knots
        .windows(2)
        .map(|pair| {
            let inside = pair[0] <= *t && *t < pair[1];
            fraction(i64::from(inside), 1)
        })
        .collect();
    for r in 1..=spline.degree() {
        values = (0..values.len() - 1)
            .map(|i| {
                let mut sum = Rational::zero();
                if !values[i].is_zero() {
                    sum += (t - &knots[i]) / (&knots[i + r] - &knots[i]) * &values[i];
                }
                if !values[i + 1].is_zero() {
                    let (low, high) = (&knots[i + 1], &knots[i + r + 1]);
                    sum += (high - t) / (high - low) * &values[i + 1];
                }
                sum
            })
            .collect();
    }
    values
}

/// A few parameters of the domain, its ends and all its knots among them.
fn parameters(spline: &BSpline) -> Vec<Rational> {
    let (start, end) = spline.domain();
    let mut all: Vec<Rational> = (0..=7).map(|i| at(spline, &fraction(i, 7))).collect();
    all.extend(spline.knots().iter().filter(|t| *t >= start && *t <= end));
    all
}

fn assert_same(a: &BSpline, b: &BSpline) {
    assert_eq!(a.domain(), b.domain());
    for t in parameters(a) {
        assert_eq!(a.evaluate(&t), b.evaluate(&t), "at {t}");
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn bezier_points_agree(piece in bezier(9), u in unit()) {
        let point = piece.evaluate(&u).unwrap();
        let sum = weighted_sum(
            piece.dimension(), piece.points(), piece.weights(), &bernstein(piece.degree(), &u));
        prop_assert_eq!(&point, &sum);
        let blossom = piece.blossom(&vec![u; piece.degree()]);
        prop_assert_eq!(point, affine(piece.dimension(), &blossom));
    }

    #[test]
    fn bspline_points_agree(spline in bspline(5), u in unit()) {
        let t = at(&spline, &u);
        let point = spline.evaluate(&t).unwrap();
        for side in [Side::Before, Side::After] {
            let blossom = spline.blossom(&t, side, &vec![t.clone(); spline.degree()]).unwrap();
            prop_assert_eq!(&point, &affine(spline.dimension(), &blossom));
        }
        if t < spline.domain().1 {
            let sum = weighted_sum(
                spline.dimension(), spline.points(), spline.weights(), &cox_de_boor(&spline, &t));
            prop_assert_eq!(&point, &sum);
        }
        let curve = Curve::from(spline);
        let chain = curve.chain();
        let parameter = chain.parameter_at(&t).unwrap();
        prop_assert_eq!(chain.evaluate(&parameter).unwrap(), point);
        prop_assert_eq!(chain.knot_at(&parameter).unwrap(), t);
    }

    #[test]
    fn blossoms_are_symmetric(spline in bspline(4), u in prop::collection::vec(unit(), 4)) {
        let p = spline.degree();
        let t = at(&spline, &fraction(1, 3));
        let arguments: Vec<Rational> = u[..p].iter().map(|u| at(&spline, u)).collect();
        let mut reversed = arguments.clone();
        reversed.reverse();
        prop_assert_eq!(
            spline.blossom(&t, Side::After, &arguments).unwrap(),
            spline.blossom(&t, Side::After, &reversed).unwrap());
    }

    #[test]
    fn control_points_are_blossoms(spline in bspline(5)) {
        let (p, d) = (spline.degree(), spline.dimension());
        let knots: Vec<Rational> = spline.knots().iter().collect();
        for k in (p..spline.count()).filter(|&k| knots[k] < knots[k + 1]) {
            for i in k - p..=k {
                let blossom = spline.blossom(&knots[k], Side::After, &knots[i + 1..=i + p]).unwrap();
                let point: Vec<Rational> = (0..d).map(|axis| spline.points().get(i * d + axis)).collect();
                prop_assert_eq!(affine(d, &blossom), point);
                if let Some(weights) = spline.weights() {
                    prop_assert_eq!(&blossom[d], &weights.get(i));
                }
            }
        }
    }

    #[test]
    fn chains_join_and_cover_the_domain(spline in bspline(6)) {
        let curve = Curve::from(spline.clone());
        let chain = curve.chain();
        let (start, end) = spline.domain();
        prop_assert_eq!(&chain.piece(0).unwrap().knots.0, &start);
        prop_assert_eq!(&chain.piece(chain.count() - 1).unwrap().knots.1, &end);
        prop_assert_eq!(chain.closed(), spline.evaluate(&start) == spline.evaluate(&end));
        prop_assert_eq!(chain.closed(), curve.is_closed());
        for i in 1..chain.count() {
            let (before, after) = (chain.piece(i - 1).unwrap(), chain.piece(i).unwrap());
            prop_assert_eq!(&before.knots.1, &after.knots.0);
            prop_assert_eq!(before.bezier.point(before.bezier.degree()), after.bezier.point(0));
        }
        // The pieces are a curve of their own.
        prop_assert!(Curve::new(chain.dimension(), Form::Bezier(chain.pieces().to_vec())).is_ok());
    }

    #[test]
    fn derivatives_are_limits(piece in bezier(6), u in unit(), order in 1usize..5) {
        let h = Rational::new(Integer::ONE, Integer::ONE << 200);
        let near = if u.is_one() { &u - &h } else { &u + &h };
        let step = &near - &u;
        let (a, b) = (piece.derivatives(&u, order).unwrap(), piece.derivatives(&near, order).unwrap());
        prop_assert_eq!(&a[0], &piece.evaluate(&u).unwrap());
        let small = Rational::new(Integer::ONE, Integer::ONE << 100);
        for k in 1..=order {
            for axis in 0..piece.dimension() {
                let quotient = (&b[k - 1][axis] - &a[k - 1][axis]) / &step;
                prop_assert!((quotient - &a[k][axis]).abs() < small);
            }
        }
    }

    #[test]
    fn polynomial_derivatives_give_taylor_sums(piece in bezier(8), u in unit(), v in unit()) {
        let piece = Bezier::new(piece.dimension(), piece.points().clone(), None).unwrap();
        let n = piece.degree();
        let derivatives = piece.derivatives(&u, n + 1).unwrap();
        prop_assert!(derivatives[n + 1].iter().all(Rational::is_zero));
        let mut sum = vec![Rational::zero(); piece.dimension()];
        let mut factor = Rational::one();
        for (k, derivative) in derivatives.iter().enumerate() {
            for (x, y) in sum.iter_mut().zip(derivative) {
                *x += y * &factor;
            }
            factor = factor * (&v - &u) / fraction(k as i64 + 1, 1);
        }
        prop_assert_eq!(sum, piece.evaluate(&v).unwrap());
    }

    #[test]
    fn hodographs_are_the_derivative(piece in bezier(6), u in unit()) {
        let derivative = piece.derivatives(&u, 1).unwrap().swap_remove(1);
        let hodograph = piece.hodograph();
        let field = hodograph.evaluate(&u).unwrap();
        let n = piece.degree();
        let factor = match piece.weights() {
            Some(weights) if !piece.is_polynomial() => {
                prop_assert_eq!(hodograph.degree(), 2 * n - 2);
                let b = bernstein(n, &u);
                let w = (0..=n).fold(Rational::zero(), |sum, k| sum + weights.get(k) * &b[k]);
                (&w * &w).recip()
            }
            _ => {
                prop_assert_eq!(hodograph.degree(), n - 1);
                fraction(n as i64, 1)
            }
        };
        let scaled: Vec<Rational> = field.iter().map(|x| x * &factor).collect();
        prop_assert_eq!(derivative, scaled);
    }

    #[test]
    fn end_directions_are_the_first_coefficients(piece in bezier(4), repeat in 0usize..4) {
        // Repeat the first point, so that the first differences vanish.
        let d = piece.dimension();
        let repeat = repeat.min(piece.degree() - 1);
        let mut points: Vec<Rational> = piece.points().iter().collect();
        for k in 1..=repeat {
            for axis in 0..d {
                points[k * d + axis] = points[axis].clone();
            }
        }
        let backward: Vec<Rational> = points.chunks(d).rev().flatten().cloned().collect();
        let weights = piece.weights().cloned();
        let piece = Bezier::new(d, vector(&points), weights.clone()).unwrap();
        let field = piece.hodograph();
        let first = (0..=field.degree()).map(|k| field.coefficient(k))
            .find(|v| !v.iter().all(Rational::is_zero));
        prop_assert_eq!(unsigned(piece.start_direction()), unsigned(first));
        let piece = Bezier::new(d, vector(&backward), weights).unwrap();
        let field = piece.hodograph();
        let last = (0..=field.degree()).rev().map(|k| field.coefficient(k))
            .find(|v| !v.iter().all(Rational::is_zero));
        prop_assert_eq!(unsigned(piece.end_direction()), unsigned(last));
    }

    #[test]
    fn insertion_keeps_the_curve(spline in bspline(5), u in unit(), v in unit()) {
        let (s, t) = (at(&spline, &u), at(&spline, &v));
        let room = spline.degree().saturating_sub(spline.multiplicity(&t));
        let inserted = spline.insert_knot(&t, room).unwrap();
        prop_assert_eq!(inserted.count(), spline.count() + room);
        assert_same(&spline, &inserted);
        if spline.multiplicity(&t) <= spline.degree() {
            prop_assert_eq!(inserted.multiplicity(&t), spline.degree());
        }
        let full = matches!(inserted.insert_knot(&t, 1), Err(OperationError::Multiplicity { .. }));
        prop_assert!(full);
        if inserted.multiplicity(&s) < spline.degree() {
            let refined = inserted.refine(std::slice::from_ref(&s)).unwrap();
            prop_assert_eq!(refined.multiplicity(&s), inserted.multiplicity(&s) + 1);
            assert_same(&spline, &refined);
        }
        // The result is valid as given data too.
        prop_assert_eq!(revalidated(&inserted), inserted);
    }

    #[test]
    fn elevation_keeps_the_curve(spline in bspline(4), by in 0usize..4) {
        let elevated = spline.elevate(by).unwrap();
        prop_assert_eq!(elevated.degree(), spline.degree() + by);
        prop_assert_eq!(revalidated(&elevated), elevated.clone());
        let (start, end) = spline.domain();
        for t in spline.knots().iter().filter(|t| *t > start && *t < end) {
            prop_assert_eq!(elevated.multiplicity(&t), spline.multiplicity(&t) + by);
        }
        let (a, b) = (Curve::from(spline), Curve::from(elevated));
        let (a, b) = (a.chain(), b.chain());
        prop_assert_eq!(a.count(), b.count());
        for i in 0..a.count() {
            let (x, y) = (a.piece(i).unwrap(), b.piece(i).unwrap());
            prop_assert_eq!(&x.knots, &y.knots);
            prop_assert_eq!(&x.bezier.elevate(by).unwrap(), y.bezier);
        }
    }

    #[test]
    fn bezier_elevation_keeps_the_curve(piece in bezier(6), by in 0usize..5, u in unit()) {
        let elevated = piece.elevate(by).unwrap();
        prop_assert_eq!(elevated.degree(), piece.degree() + by);
        prop_assert_eq!(elevated.evaluate(&u), piece.evaluate(&u));
    }

    #[test]
    fn bezier_splitting_keeps_the_curve(piece in bezier(8), at in 1i64..12, u in unit()) {
        let at = fraction(at, 12);
        let (left, right) = piece.split(&at).unwrap();
        prop_assert_eq!(left.evaluate(&u), piece.evaluate(&(&u * &at)));
        prop_assert_eq!(right.evaluate(&u), piece.evaluate(&(&at + &u * (Rational::one() - &at))));
        prop_assert_eq!(left.point(left.degree()), right.point(0));
    }

    #[test]
    fn bspline_splitting_keeps_the_curve(spline in bspline(5), at_ in 1i64..12) {
        let t = at(&spline, &fraction(at_, 12));
        let (left, right) = spline.split(&t).unwrap();
        let (start, end) = spline.domain();
        prop_assert_eq!(left.domain(), (start.clone(), t.clone()));
        prop_assert_eq!(right.domain(), (t.clone(), end.clone()));
        prop_assert_eq!(revalidated(&left), left.clone());
        prop_assert_eq!(revalidated(&right), right.clone());
        for s in parameters(&spline) {
            if s <= t {
                prop_assert_eq!(left.evaluate(&s), spline.evaluate(&s));
            }
            if s >= t {
                prop_assert_eq!(right.evaluate(&s), spline.evaluate(&s));
            }
        }
        prop_assert_eq!(spline.split(&start), Err(OperationError::OutsideDomain));
        prop_assert_eq!(spline.split(&end), Err(OperationError::OutsideDomain));
    }

    #[test]
    fn bspline_derivatives_are_limits(spline in bspline(4), u in unit()) {
        let t = at(&spline, &u);
        let (start, end) = spline.domain();
        let small = Rational::new(Integer::ONE, Integer::ONE << 100);
        for (side, sign) in [(Side::Before, -1), (Side::After, 1)] {
            if (sign < 0 && t == start) || (sign > 0 && t == end) {
                continue;
            }
            let step = Rational::new(Integer::from(sign), Integer::ONE << 200);
            let here = spline.derivatives(&t, side, 3).unwrap();
            let near = spline.derivatives(&(&t + &step), side, 3).unwrap();
            prop_assert_eq!(&here[0], &spline.evaluate(&t).unwrap());
            for k in 1..=3 {
                for axis in 0..spline.dimension() {
                    let quotient = (&near[k - 1][axis] - &here[k - 1][axis]) / &step;
                    prop_assert!((quotient - &here[k][axis]).abs() < small);
                }
            }
        }
    }

    #[test]
    fn periodic_splines_close_smoothly(
        p in 1usize..5,
        steps in prop::collection::vec(0i64..4, 1..8),
        seed in prop::collection::vec(
            (curve_support::coordinate(), curve_support::coordinate(), curve_support::weight()), 8),
        rational in any::<bool>(),
    ) {
        let m = steps.len();
        let mut knots = vec![fraction(-2, 3)];
        for step in &steps {
            knots.push(&knots[knots.len() - 1] + fraction(*step, 2));
        }
        let points: Vec<Rational> = seed[..m].iter().flat_map(|(x, y, _)| [x.clone(), y.clone()]).collect();
        let weights: Vec<Rational> = seed[..m].iter().map(|s| s.2.clone()).collect();
        let spline = BSpline::periodic(2, p, &knots, &points, rational.then_some(&weights[..]));
        let (first, last) = (&knots[0], &knots[m]);
        // The greatest multiplicity in a period, and that of the closing knot.
        let multiplicity = |t: &Rational| knots[..m].iter().filter(|s| *s == t).count();
        let closing = multiplicity(first) + if first == last { 0 } else { multiplicity(last) };
        let interior = knots[..m].iter().filter(|t| *t != first && *t != last).map(multiplicity).max();
        if first == last || closing > p || interior > Some(p) {
            prop_assert!(spline.is_err());
            return Ok(());
        }
        let spline = spline.unwrap();
        let (start, end) = spline.domain();
        prop_assert_eq!((&start, &end), (first, last));
        prop_assert_eq!(
            spline.derivatives(&start, Side::After, p - closing).unwrap(),
            spline.derivatives(&end, Side::Before, p - closing).unwrap());
        let elevated = spline.elevate(1).unwrap();
        prop_assert_eq!(&elevated.derivatives(&end, Side::Before, p).unwrap(), &spline.derivatives(&end, Side::Before, p).unwrap());
        prop_assert!(Curve::from(elevated).is_closed());
    }
}

/// A direction up to a positive factor.
fn unsigned(direction: Option<Vec<Rational>>) -> Option<Vec<Rational>> {
    let direction = direction?;
    let size = direction.iter().find(|x| !x.is_zero())?.abs();
    Some(direction.iter().map(|x| x / &size).collect())
}

fn revalidated(spline: &BSpline) -> BSpline {
    BSpline::new(
        spline.dimension(),
        spline.degree(),
        spline.knots().clone(),
        spline.points().clone(),
        spline.weights().cloned(),
    )
    .expect("a valid result")
}

/// Points without a pattern that a wrong formula could share.
fn scattered(count: usize) -> Vec<Rational> {
    (0..count as i64)
        .map(|i| fraction((i * i * 37 + i * 11) % 101 - 50, 1 + i % 5))
        .collect()
}

#[test]
fn degree_25_agrees() {
    let p = 25;
    let weights: Vec<Rational> = scattered(p + 1).iter().map(|x| x * x + fraction(1, 2)).collect();
    let piece = Bezier::new(3, vector(&scattered(3 * (p + 1))), Some(vector(&weights))).unwrap();
    let u = fraction(3, 7);
    let sum = weighted_sum(3, piece.points(), piece.weights(), &bernstein(p, &u));
    assert_eq!(piece.evaluate(&u).unwrap(), sum);
    let (left, right) = piece.split(&u).unwrap();
    assert_eq!(left.point(p), sum);
    assert_eq!(right.point(0), sum);

    let mut knots = vec![0; p + 1];
    knots.extend([1, 1, 1, 2, 4]);
    knots.extend([7; 26]);
    let spline = BSpline::new(2, p, integers(&knots), vector(&scattered(2 * 31)), None).unwrap();
    let t = fraction(5, 2);
    let sum = weighted_sum(2, spline.points(), None, &cox_de_boor(&spline, &t));
    assert_eq!(spline.evaluate(&t).unwrap(), sum);
    assert_same(&spline, &spline.insert_knot(&t, 2).unwrap());
    let curve = Curve::from(spline);
    let chain = curve.chain();
    assert_eq!(chain.count(), 4);
    assert_eq!(chain.evaluate(&chain.parameter_at(&t).unwrap()).unwrap(), sum);
}

#[test]
fn elevation_is_refused_above_the_highest_degree() {
    let spline = BSpline::new(2, 1, integers(&[0, 0, 1, 1]), integers(&[0, 0, 3, 4]), None).unwrap();
    assert_eq!(spline.elevate(63).unwrap().degree(), 64);
    assert_eq!(spline.elevate(64), Err(OperationError::Degree { degree: 65 }));
    assert!(matches!(spline.elevate(usize::MAX), Err(OperationError::Degree { .. })));
}

#[test]
fn degree_elevation_of_a_parabola() {
    // Farin, Curves and Surfaces for CAGD: the quadratic (0, 0), (1, 2), (2, 0) as a cubic.
    let piece = Bezier::new(2, integers(&[0, 0, 1, 2, 2, 0]), None).unwrap();
    let f = fraction;
    let cubic = [f(0, 1), f(0, 1), f(2, 3), f(4, 3), f(4, 3), f(4, 3), f(2, 1), f(0, 1)];
    assert_eq!(piece.elevate(1).unwrap().points(), &vector(&cubic));
}

#[test]
fn outside_parameters_are_refused() {
    let piece = Bezier::new(2, integers(&[0, 0, 1, 2, 2, 0]), None).unwrap();
    let outside = Err(OperationError::OutsideDomain);
    for u in [fraction(-1, 9), fraction(10, 9)] {
        assert_eq!(piece.evaluate(&u), outside);
        assert_eq!(piece.derivatives(&u, 1), Err(OperationError::OutsideDomain));
        assert_eq!(piece.split(&u), Err(OperationError::OutsideDomain));
        assert_eq!(piece.hodograph().evaluate(&u), outside);
        let spline = BSpline::new(2, 2, integers(&[0, 0, 0, 1, 1, 1]), piece.points().clone(), None).unwrap();
        assert_eq!(spline.evaluate(&u), outside);
        assert_eq!(spline.insert_knot(&u, 1), Err(OperationError::OutsideDomain));
        let curve = Curve::from(spline);
        assert_eq!(curve.chain().evaluate(&u), outside);
        assert_eq!(curve.chain().parameter_at(&u), None);
        assert_eq!(curve.chain().knot_at(&u), None);
    }
}

#[test]
fn bezier_chains_have_integer_knots() {
    let piece = |numbers: &[i64]| Bezier::new(2, integers(numbers), None).unwrap();
    let pieces = vec![piece(&[0, 0, 1, 0]), piece(&[1, 0, 1, 1]), piece(&[1, 1, 0, 0])];
    let curve = Curve::new(2, Form::Bezier(pieces)).unwrap();
    let chain = curve.chain();
    assert!(chain.closed());
    assert_eq!(chain.piece(1).unwrap().knots, (fraction(1, 1), fraction(2, 1)));
    assert_eq!(chain.piece(3), None);
    let t = fraction(7, 3);
    assert_eq!(chain.locate(&t), Some((2, fraction(1, 3))));
    assert_eq!(chain.locate(&fraction(2, 1)), Some((2, fraction(0, 1))));
    assert_eq!(chain.locate(&fraction(3, 1)), Some((2, fraction(1, 1))));
    assert_eq!(chain.knot_at(&t), Some(t.clone()));
    assert_eq!(chain.parameter_at(&t), Some(t));
    assert_eq!(chain.joint(0), Some(Joint::Corner));
    assert_eq!(chain.joint(3), None);
}

#[test]
fn equal_weights_are_dropped_from_chains_only() {
    let weights = Some(integers(&[3, 3]));
    let piece = Bezier::new(2, integers(&[0, 0, 1, 0]), weights).unwrap();
    let curve = Curve::new(2, Form::Bezier(vec![piece.clone()])).unwrap();
    assert_eq!(curve.form(), &Form::Bezier(vec![piece]));
    assert_eq!(curve.chain().pieces()[0].weights(), None);
    assert_eq!(curve.chain(), curve.clone().into_chain());
}

#[test]
fn curves_of_mixed_dimensions_are_refused() {
    let piece = Bezier::new(2, integers(&[0, 0, 1, 0]), None).unwrap();
    let error = Curve::new(3, Form::Bezier(vec![piece])).unwrap_err();
    assert_eq!(error.place, "pieces[0].points");
    assert_eq!(error.fault, CurveFault::MixedDimensions { found: 2, expected: 3 });
    let error = Bezier::new(3, integers(&[0, 0, 1, 0]), None).unwrap_err();
    assert_eq!(error.fault, CurveFault::MixedDimensions { found: 1, expected: 3 });
    let error = Bezier::new(4, integers(&[0, 0, 1, 0]), None).unwrap_err();
    assert_eq!(error.fault, CurveFault::Dimension { found: 4 });
    let error = Curve::new(2, Form::Bezier(Vec::new())).unwrap_err();
    assert_eq!(error.fault, CurveFault::NoPieces);
}

#[test]
fn periodic_splines_need_one_knot_more_than_points() {
    let f = |n: i64| fraction(n, 1);
    let points = [f(0), f(0), f(1), f(0), f(0), f(1)];
    let error = BSpline::periodic(2, 2, &[f(0), f(1), f(2)], &points, None).unwrap_err();
    assert_eq!(error.fault, CurveFault::KnotCount { found: 3, expected: 4 });
    let knots = [f(0), f(1), f(2), f(3)];
    let error = BSpline::periodic(2, 2, &knots, &points, Some(&[f(1)])).unwrap_err();
    assert_eq!(error.fault, CurveFault::WeightCount { found: 1, expected: 3 });
    let error = BSpline::periodic(2, 0, &knots, &points, None).unwrap_err();
    assert_eq!(error.fault, CurveFault::Degree { found: 0 });
    let error = BSpline::periodic(2, 2, &knots[..1], &[], None).unwrap_err();
    assert_eq!(error.fault, CurveFault::PointCount { found: 0, expected: 1 });
    // The uniform quadratic on a triangle is a closed parabola chain through the midpoints of its sides.
    let spline = BSpline::periodic(2, 2, &knots, &points, None).unwrap();
    assert_eq!(spline.knots(), &integers(&[-2, -1, 0, 1, 2, 3, 4, 5]));
    assert_eq!(spline.evaluate(&f(0)).unwrap(), [fraction(1, 2), f(0)]);
    assert_eq!(spline.evaluate(&f(1)).unwrap(), [fraction(1, 2), fraction(1, 2)]);
}

#[test]
fn joints_are_classified() {
    let joint = |a: &[i64], b: &[i64]| {
        let piece = |numbers: &[i64]| Bezier::new(2, integers(numbers), None).unwrap();
        let curve = Curve::new(2, Form::Bezier(vec![piece(a), piece(b)])).unwrap();
        curve.chain().joint(1)
    };
    // Different speeds, the same direction.
    assert_eq!(joint(&[0, 0, 1, 0], &[1, 0, 5, 0]), Some(Joint::Smooth));
    assert_eq!(joint(&[0, 0, 1, 0], &[1, 0, 1, 1]), Some(Joint::Corner));
    // A turn by 180 degrees: parallel, negative dot product.
    assert_eq!(joint(&[0, 0, 1, 0], &[1, 0, 0, 0]), Some(Joint::Corner));
    // Coincident points: the first direction that does not vanish counts.
    assert_eq!(joint(&[0, 0, 1, 0, 1, 0], &[1, 0, 1, 0, 4, 0]), Some(Joint::Smooth));
    assert_eq!(joint(&[0, 0, 1, 0], &[1, 0, 1, 0]), Some(Joint::Undirected));
}
