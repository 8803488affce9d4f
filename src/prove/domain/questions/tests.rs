use proptest::prelude::*;

use super::*;
use crate::claim::domain::Sign;
use crate::curve::read_curve;
use crate::number::RationalExt;
use crate::prove::domain::{Bounds, Question};
use crate::prove::linear_program::{FloatSolver, GoodLp};

/// A solver that is always wrong.
struct Liar;

impl FloatSolver for Liar {
    fn solve(&self, objective: &[f64], _rows: &[(Vec<f64>, f64)]) -> Option<Vec<f64>> {
        Some(vec![1e9; objective.len()])
    }
}

fn options(tolerance: &str, solver: &'static dyn FloatSolver) -> Options<'static> {
    Options {
        tolerance: number(tolerance),
        budget: 500,
        name: None,
        snapped_joints: None,
        measure_rounds: false,
        solver,
    }
}

fn number(text: &str) -> Rational {
    crate::number::parse_number(text, crate::number::Meaning::Decimal).unwrap()
}

fn bezier(points: &[Vec<i64>], weights: Option<&[i64]>) -> Curve {
    let weights = weights.map_or(String::new(), |weights| format!(r#", "weights": {weights:?}"#));
    let json =
        format!(r#"{{ "knotproof": "curve/1", "bezier": {{ "pieces": [{{ "points": {points:?}{weights} }}] }} }}"#);
    read_curve(&json).unwrap().curve
}

/// A clamped spline on the knots 0, 1, 2, …
fn spline(degree: usize, points: &[Vec<i64>], weights: Option<&[i64]>) -> Curve {
    let weights = weights.map_or(String::new(), |weights| format!(r#", "weights": {weights:?}"#));
    let inner = points.len() - degree;
    let knots = [vec![0; degree], (0..=inner).collect(), vec![inner; degree]].concat();
    let json = format!(
        r#"{{ "knotproof": "curve/1", "bspline": {{ "degree": {degree}, "knots": {knots:?}, "points": {points:?}{weights} }} }}"#
    );
    read_curve(&json).unwrap().curve
}

fn ask(point: usize, sign: Sign, low: &[i64], high: &[i64]) -> Question {
    let corner = |corner: &[i64]| corner.iter().map(|x| Rational::from_integer((*x).into())).collect();
    Question {
        point,
        sign: Some(sign),
        interval: None,
        bounds: Bounds::Corners(crate::claim::domain::Box {
            low: corner(low),
            high: corner(high),
        }),
    }
}

/// The bounds in binary64, of squares or of the radius, after the checker has accepted them.
fn bounds(answer: &Answer) -> [f64; 2] {
    let [low, high] = exact_bounds(answer);
    [low.to_f64(), high.to_f64()]
}

fn exact_bounds(answer: &Answer) -> [Rational; 2] {
    match &answer.document.claim.statement.outcome {
        Outcome::Nearest {
            lower_squared,
            upper_squared,
            ..
        }
        | Outcome::Change {
            lower_squared,
            upper_squared,
            ..
        } => [lower_squared.clone(), upper_squared.clone()],
        Outcome::Ball { lower, upper } => [lower.clone(), upper.clone()],
        other => panic!("another outcome: {other:?}"),
    }
}

/// The answer's bounds contain a number and are as close as was asked for.
fn assert_found(curve: &Curve, question: &Question, about: &About, expected: &str) {
    let problem = Problem::new(curve, question).unwrap();
    for (solver, tolerance) in [
        (&GoodLp as &'static dyn FloatSolver, "1e-9"),
        (&Liar, "1e-12"),
        (&(), "1/100"),
    ] {
        let options = options(tolerance, solver);
        let answer = answer(curve, &problem, about, &options).unwrap_or_else(|error| panic!("{about:?}: {error}"));
        assert_eq!(
            answer.status,
            Status::Certified,
            "{about:?} {tolerance} {:?}",
            bounds(&answer)
        );
        let [low, high] = exact_bounds(&answer);
        assert!(
            low <= number(expected) && number(expected) <= high,
            "{about:?} {:?}",
            bounds(&answer)
        );
        assert!(
            &high - &low <= &high * &options.tolerance,
            "{about:?} {:?}",
            bounds(&answer)
        );
    }
}

fn nearest(point: &[&str]) -> About {
    About::Nearest(point.iter().map(|x| number(x)).collect())
}

/// A parabola's middle point: K is the half-plane below its chord.
#[test]
fn half_plane() {
    let curve = bezier(&[vec![0, 0], vec![2, -1], vec![4, 0]], None);
    let question = ask(1, Sign::Positive, &[0, -3], &[4, 1]);
    assert_found(&curve, &question, &nearest(&["1", "1/2"]), "1/4");
    assert_found(&curve, &question, &nearest(&["1", "-1"]), "0");
    // Beyond a corner of K ∩ B, with two sides active.
    assert_found(&curve, &question, &nearest(&["7", "4"]), "25");
    assert_found(&curve, &question, &nearest(&["7", "-2"]), "9");
    assert_found(&curve, &question, &About::Change, "1");
    assert_found(&curve, &question, &About::Ball, "3/2");
    // From a point on the boundary itself.
    assert_found(&curve, &question, &nearest(&["3", "0"]), "0");
}

/// The first point of a cubic whose other legs are (1, 0) and (0, 1): cl K is y ≥ 0 for x ≤ 0 and y ≥ x²/4 for x ≥ 0.
fn parabola(position: [i64; 2]) -> Curve {
    bezier(&[position.to_vec(), vec![0, 0], vec![1, 0], vec![1, 1]], None)
}

#[test]
fn bounded_by_a_parabola() {
    let question = ask(0, Sign::Positive, &[-10, -10], &[10, 10]);
    let curve = parabola([0, 3]);
    // (2, 1) is the parabola's point nearest to (3, 0).
    assert_found(&curve, &question, &nearest(&["3", "0"]), "2");
    // And, from within, to (0, 3).
    assert_found(&curve, &question, &About::Change, "8");
    assert_found(&curve, &question, &nearest(&["-3", "-1/3"]), "1/9");
    // From a position outside K the center must be found first.
    let outside = parabola([3, 0]);
    assert_found(&outside, &question, &nearest(&["3", "0"]), "2");
    let problem = Problem::new(&outside, &question).unwrap();
    let error = answer(&outside, &problem, &About::Change, &options("1e-9", &GoodLp)).err();
    assert_eq!(error, Some(AnswerError::Outside));
    // A ball between y = 0 and two sides of the box; one between the parabola at (3/2, 9/16), its normal (−3, 4)/5, and two sides.
    assert_found(&curve, &ask(0, Sign::Positive, &[-10, -2], &[0, 18]), &About::Ball, "5");
    let mut question = question;
    question.bounds = Bounds::Corners(crate::claim::domain::Box {
        low: vec![number("-5/2"), number("-1")],
        high: vec![number("10"), number("81/16")],
    });
    assert_found(&curve, &question, &About::Ball, "5/2");
}

/// ∫|c''|² of a cubic is least, as a function of its first point, at 2P1 − P2 − (P1 − 2P2 + P3)/2.
#[test]
fn fair() {
    let question = ask(0, Sign::Positive, &[-10, -10], &[10, 10]);
    // Here at (−1/2, −1/2), whose distance to K is 1/2.
    assert_found(&parabola([0, 3]), &question, &About::Fair, "1/4");
    let rational = bezier(&[vec![0, 3], vec![0, 0], vec![1, 0], vec![1, 1]], Some(&[1, 2, 1, 1]));
    let problem = Problem::new(&rational, &question).unwrap();
    let error = answer(&rational, &problem, &About::Fair, &options("1e-9", &GoodLp)).err();
    assert_eq!(error, Some(AnswerError::NoFairPoint));
}

#[test]
fn wrong_questions() {
    let curve = parabola([0, 3]);
    let question = ask(0, Sign::Positive, &[-10, -10], &[10, 10]);
    let problem = Problem::new(&curve, &question).unwrap();
    let options = options("1e-9", &GoodLp);
    let fails =
        |curve: &Curve, problem: &Problem, about: &About| answer(curve, problem, about, &options).err().unwrap();
    let error = fails(&curve, &problem, &nearest(&["1", "2", "3"]));
    assert_eq!(error, AnswerError::Dimension { found: 3, expected: 2 });
    assert_eq!(
        error.to_string(),
        "the point asked about has 3 coordinates, the curve has 2"
    );
    // The curvature at the end is that of the fixed points: never negative.
    let negative = Problem::new(&curve, &ask(0, Sign::Negative, &[-10, -10], &[10, 10])).unwrap();
    for about in [nearest(&["1", "2"]), About::Fair, About::Ball] {
        assert!(
            matches!(fails(&curve, &negative, &about), AnswerError::Empty(_)),
            "{about:?}"
        );
    }
    // The second half of a spline that the first point does not reach.
    let spline = read_curve(
        r#"{ "knotproof": "curve/1", "bspline": { "degree": 2, "knots": [0, 0, 0, 1, 2, 2, 2], "points": [[0, 0], [1, 0], [2, 1], [2, 3]] } }"#,
    );
    let spline = spline.unwrap().curve;
    let mut question = question;
    question.interval = Some([number("1"), number("2")]);
    let far = Problem::new(&spline, &question).unwrap();
    assert_eq!(fails(&spline, &far, &About::Change), AnswerError::Constant);
    assert_found(&spline, &question, &About::Ball, "10");
}

/// Torsion: the half-space of one free point of a cubic.
#[test]
fn half_space() {
    let curve = bezier(&[vec![0, 0, 5], vec![0, 0, 0], vec![1, 0, 0], vec![0, 1, 0]], None);
    let sign = [Sign::Positive, Sign::Negative]
        .into_iter()
        .find(|sign| Problem::new(&curve, &ask(0, *sign, &[-9; 3], &[9; 3])).is_ok_and(|problem| problem.has_sign));
    let question = ask(0, sign.unwrap(), &[-9; 3], &[9; 3]);
    assert_found(&curve, &question, &nearest(&["1", "2", "-3"]), "9");
    assert_found(&curve, &question, &nearest(&["12", "2", "-4"]), "25");
    assert_found(&curve, &question, &About::Change, "25");
    assert_found(&curve, &question, &About::Ball, "9/2");
}

/// The center that is found is near two planes; points pulled towards it must stay on their positive side.
#[test]
fn thin_domain() {
    let points = [
        [0, 1, -4],
        [8, 1, 3],
        [-5, -3, 6],
        [7, -4, -8],
        [5, -6, 2],
        [-4, -2, 6],
        [-6, -6, 1],
    ]
    .map(|p| p.to_vec());
    let curve = spline(3, &points, Some(&[2, 3, 2, 1, 1, 1, 1]));
    let question = ask(3, Sign::Positive, &[-10; 3], &[10; 3]);
    assert_found(&curve, &question, &nearest(&["-1", "-1", "1/2"]), "253/4");
}

/// A convex arc of degree 9, and bounds that the budget does not bring close.
#[test]
fn high_degree() {
    let points: Vec<Vec<i64>> = (0..10_i64).map(|k| vec![k - 5, (k - 5) * (k - 5)]).collect();
    let curve = bezier(&points, None);
    let question = ask(4, Sign::Positive, &[-30, -30], &[30, 30]);
    let problem = Problem::new(&curve, &question).unwrap();
    for about in [nearest(&["20", "7"]), About::Fair, About::Change, About::Ball] {
        let ask = |tolerance: &str, budget: usize| {
            let mut options = options(tolerance, &GoodLp);
            options.budget = budget;
            answer(&curve, &problem, &about, &options).unwrap()
        };
        let close = ask("1e-12", 500);
        assert_eq!(close.status, Status::Certified, "{about:?} {:?}", bounds(&close));
        let [low, high] = bounds(&close);
        let early = ask("1e-12", 7);
        let [lower, upper] = bounds(&early);
        assert!(
            lower <= low && high <= upper,
            "{about:?} [{lower}, {upper}] around [{low}, {high}]"
        );
        if matches!(about, About::Nearest(_) | About::Ball) {
            assert!(matches!(early.status, Status::Undecided(_)), "{about:?}");
        }
    }
}

/// Random curves with a random question; many have no domain.
fn questions(d: usize) -> impl Strategy<Value = (Curve, Question, Vec<Rational>)> {
    let point = move || prop::collection::vec(-8_i64..9, d);
    let points = prop::collection::vec(point(), d + 1..d + 5);
    let weights = prop::option::of(prop::collection::vec(1_i64..4, d + 5));
    let choices = (any::<prop::sample::Index>(), any::<bool>(), any::<bool>());
    (points, weights, choices, point()).prop_filter_map("a curve", move |(points, weights, choices, target)| {
        let (index, negative, pieces) = choices;
        let weights = weights.as_ref().map(|weights| &weights[..points.len()]);
        let distinct = points.windows(2).all(|pair| pair[0] != pair[1]);
        let sign = if negative { Sign::Negative } else { Sign::Positive };
        let target = target.iter().map(|x| Rational::new((*x).into(), 2.into())).collect();
        let question = ask(index.index(points.len()), sign, &vec![-10; d], &vec![10; d]);
        let curve = || match pieces {
            true => spline(d, &points, weights),
            false => bezier(&points, weights),
        };
        distinct.then(|| (curve(), question, target))
    })
}

/// The rows of many parameters as (normal, constant) of length 1, and the sides of the box.
fn sampled_rows(curve: &Curve, problem: &Problem, count: usize) -> Vec<(Vec<f64>, f64)> {
    let context = Context::new(curve, &problem.domain).unwrap();
    let parameters = context.sections.iter().flat_map(|section| {
        (0..=count).map(|k| Row::Parameter {
            piece: section.piece,
            u: &section.ends[0] + Rational::new(k.into(), count.into()) * (&section.ends[1] - &section.ends[0]),
        })
    });
    let rows = sides(&context).chain(parameters).filter_map(|row| {
        let affine = context.row(&row)?.affine;
        let size = affine.linear.iter().map(Integer::abs).max()?;
        if size.is_zero() {
            return None;
        }
        let float = |x: &Integer| Rational::new(x.clone(), size.clone()).to_f64();
        let normal: Vec<f64> = affine.linear.iter().map(float).collect();
        let length = rounding::length(&normal);
        Some((
            normal.iter().map(|a| a / length).collect(),
            float(&affine.constant) / length,
        ))
    });
    rows.collect()
}

fn slack((normal, constant): &(Vec<f64>, f64), x: &[f64]) -> f64 {
    normal.iter().zip(x).map(|(a, x)| a * x).sum::<f64>() + constant
}

/// The squared distance in the plane from a point to the polygon of rows, over all vertices and feet of perpendiculars.
fn brute_force_distance(rows: &[(Vec<f64>, f64)], target: &[f64]) -> f64 {
    let mut candidates = vec![target.to_vec()];
    for (i, row) in rows.iter().enumerate() {
        let s = slack(row, target);
        candidates.push(target.iter().zip(&row.0).map(|(y, a)| y - s * a).collect());
        for other in &rows[..i] {
            let det = row.0[0] * other.0[1] - row.0[1] * other.0[0];
            if det.abs() > 1e-9 {
                let x = (row.0[1] * other.1 - other.0[1] * row.1) / det;
                let y = (other.0[0] * row.1 - row.0[0] * other.1) / det;
                candidates.push(vec![x, y]);
            }
        }
    }
    let feasible = candidates
        .into_iter()
        .filter(|x| rows.iter().all(|row| slack(row, x) >= -1e-7));
    let squares = feasible.map(|x| x.iter().zip(target).map(|(x, y)| (x - y) * (x - y)).sum());
    squares.fold(f64::INFINITY, f64::min)
}

/// Asks everything about a random domain; nothing may fail but for a reason.
fn answers(curve: &Curve, question: &Question, target: &[Rational]) -> Option<(Problem, Vec<[f64; 2]>)> {
    let problem = Problem::new(curve, question).ok()?;
    let options = options("1e-9", &GoodLp);
    let mut found = Vec::new();
    for about in [About::Nearest(target.to_vec()), About::Ball, About::Change, About::Fair] {
        match answer(curve, &problem, &about, &options) {
            Ok(answer) => {
                let [low, high] = bounds(&answer);
                assert_eq!(answer.status, Status::Certified, "{about:?} [{low}, {high}]");
                found.push([low, high]);
            }
            Err(AnswerError::Empty(_) | AnswerError::NoPoint) if matches!(about, About::Nearest(_)) => return None,
            Err(AnswerError::Outside | AnswerError::Constant) if about == About::Change => {}
            Err(AnswerError::NoFairPoint) if about == About::Fair => {}
            Err(error) => panic!("{about:?}: {error}"),
        }
    }
    Some((problem, found))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn random_planar_domains((curve, question, target) in questions(2)) {
        if let Some((problem, found)) = answers(&curve, &question, &target) {
            let rows = sampled_rows(&curve, &problem, 150);
            let floats: Vec<f64> = target.iter().map(RationalExt::to_f64).collect();
            let [low, high] = found[0];
            // The polygon of the samples is around the domain, and close to it.
            let estimate = brute_force_distance(&rows, &floats);
            prop_assert!(estimate <= high + 1e-4, "{estimate} of [{low}, {high}]");
            prop_assert!(low.sqrt() <= estimate.sqrt() + 0.3, "{estimate} of [{low}, {high}]");
        }
    }

    #[test]
    fn random_spatial_domains((curve, question, target) in questions(3), samples in prop::collection::vec(prop::collection::vec(-1.0..1.0_f64, 3), 400)) {
        if let Some((problem, found)) = answers(&curve, &question, &target) {
            let rows = sampled_rows(&curve, &problem, 400);
            let floats: Vec<f64> = target.iter().map(RationalExt::to_f64).collect();
            for point in samples {
                let point: Vec<f64> = point.iter().map(|x| 10.0 * x).collect();
                let least = rows.iter().map(|row| slack(row, &point)).fold(f64::INFINITY, f64::min);
                // Samples of the domain are not nearer, and no ball around them is larger.
                if least > 0.05 {
                    let square: f64 = point.iter().zip(&floats).map(|(x, y)| (x - y) * (x - y)).sum();
                    prop_assert!(square.sqrt() > found[0][0].sqrt() - 0.1, "{point:?}: {square} of {:?}", found[0]);
                    prop_assert!(least < found[1][1] + 0.1, "{point:?}: {least} of {:?}", found[1]);
                }
            }
        }
    }
}
