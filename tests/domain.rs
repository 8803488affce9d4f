//! Convex domains on the curves of the corpus: what the prover finds is certified, and agrees with derivatives computed another way.
#![cfg(feature = "prove")]

use std::io::Cursor;

use knotproof::certificate::Encoding;
use knotproof::check::domain::Context;
use knotproof::check::polynomial::Bound;
use knotproof::claim::domain::{Box as Corners, Domain, Evidence, Outcome, Row, Sign};
use knotproof::curve::{BSpline, Bezier, Curve, Form, read_curve};
use knotproof::number::{Integer, Rational, RationalVector};
use knotproof::polytope::{HalfSpace, Intersection, intersect};
use knotproof::prove::domain::levels::{Degree, Levels};
use knotproof::prove::domain::{
    Bounds, Certified, Options, Problem, Question, QuestionError, Status, certify, write_checked,
};
use knotproof::prove::linear_program::{FloatSolver, GoodLp};

fn fraction(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn zero() -> Rational {
    fraction(0, 1)
}

fn curve(name: &str) -> Curve {
    let path = format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect(&path);
    read_curve(&text).expect(name).curve
}

/// The curves, the free point and the sign of each.
const CURVES: [(&str, usize, Option<Sign>); 8] = [
    ("domain-cubic", 1, None),
    ("domain-quintic-bounded", 2, Some(Sign::Positive)),
    ("domain-quintic-many-vertices", 2, Some(Sign::Positive)),
    ("domain-quintic-late", 2, Some(Sign::Positive)),
    ("domain-quintic-spatial", 2, None),
    ("domain-nurbs-arc", 2, None),
    ("domain-spiral-12", 6, None),
    ("domain-helix-nurbs", 4, None),
];

fn question(point: usize, sign: Option<Sign>, edge: i64) -> Question {
    Question {
        point,
        sign,
        interval: None,
        bounds: Bounds::Edge(fraction(edge, 1)),
    }
}

fn options(solver: &dyn FloatSolver) -> Options<'_> {
    Options {
        tolerance: fraction(1, 10_000),
        budget: 20_000,
        name: None,
        snapped_joints: None,
        measure_rounds: false,
        solver,
    }
}

/// A generator of small numbers, the same in every run.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }

    fn fraction(&mut self) -> Rational {
        fraction(self.below(1001) as i64, 1000)
    }
}

/// The curve with the listed points at `x`.
fn moved(curve: &Curve, listed: &[usize], x: &[Rational]) -> Curve {
    let d = curve.dimension();
    let place = |points: &RationalVector, first: usize| {
        let mut numbers: Vec<Rational> = points.iter().collect();
        for index in listed {
            if let Some(k) = index.checked_sub(first).filter(|k| *k < numbers.len() / d) {
                numbers[k * d..(k + 1) * d].clone_from_slice(x);
            }
        }
        RationalVector::from_rationals(&numbers)
    };
    match curve.form() {
        Form::BSpline(spline) => {
            let points = place(spline.points(), 0);
            let spline = BSpline::new(
                d,
                spline.degree(),
                spline.knots().clone(),
                points,
                spline.weights().cloned(),
            );
            Curve::new(d, Form::BSpline(spline.expect("valid"))).expect("valid")
        }
        Form::Bezier(pieces) => {
            let mut first = 0;
            let pieces = pieces.iter().map(|piece| {
                let points = place(piece.points(), first);
                first += piece.degree() + 1;
                Bezier::new(d, points, piece.weights().cloned()).expect("valid")
            });
            Curve::new(d, Form::Bezier(pieces.collect())).expect("valid")
        }
    }
}

/// det(c', …, c^(d)) on a piece, from exact derivatives; for the sign − negated.
fn determinant(curve: &Curve, piece: usize, u: &Rational, sign: Sign) -> Rational {
    let d = curve.dimension();
    let v = curve.chain().pieces()[piece].derivatives(u, d).expect("inside");
    let (a, b) = (&v[1], &v[2]);
    let value = if d == 2 {
        &a[0] * &b[1] - &a[1] * &b[0]
    } else {
        let c = &v[3];
        &a[0] * (&b[1] * &c[2] - &b[2] * &c[1]) - &a[1] * (&b[0] * &c[2] - &b[2] * &c[0])
            + &a[2] * (&b[0] * &c[1] - &b[1] * &c[0])
    };
    if sign == Sign::Negative { -value } else { value }
}

fn certified<'c>(curve: &'c Curve, problem: &Problem) -> Certified<'c> {
    let found = certify(curve, problem, &options(&GoodLp));
    let document = found.document.as_ref().expect("a document");
    for encoding in [Encoding::Json, Encoding::Binary] {
        write_checked(document, encoding, &mut Cursor::new(Vec::new())).expect("accepted");
    }
    found
}

fn affine(points: &[Vec<Integer>], denominator: &Integer, weights: &[i64]) -> Vec<Rational> {
    let total: i64 = weights.iter().sum();
    (0..points[0].len())
        .map(|axis| {
            let sum: Integer = points
                .iter()
                .zip(weights)
                .map(|(p, w)| &p[axis] * Integer::from(*w))
                .sum();
            Rational::new(sum, denominator * Integer::from(total))
        })
        .collect()
}

#[test]
fn every_curve_is_certified_to_the_tolerance() {
    for (name, point, sign) in CURVES {
        let curve = curve(name);
        let problem = Problem::new(&curve, &question(point, sign, 40)).expect(name);
        let found = certified(&curve, &problem);
        assert_eq!(found.status, Status::Certified, "{name}");
        let Outcome::Sandwich {
            inner_measure,
            outer_measure,
        } = &found.document.expect(name).claim.statement.outcome
        else {
            panic!("{name}")
        };
        assert!(
            (outer_measure - inner_measure) / inner_measure <= fraction(1, 10_000),
            "{name}"
        );
    }
}

/// Inner ⊂ K ⊂ outer, by derivatives that neither the prover nor the checker computes.
#[test]
fn derivatives_confirm_both_polytopes() {
    let mut random = Numbers(1);
    for (name, point, sign) in CURVES {
        let curve = curve(name);
        let problem = Problem::new(&curve, &question(point, sign, 40)).expect(name);
        let document = certified(&curve, &problem).document.expect(name);
        let domain = &document.claim.statement.domain;
        let Evidence::Sandwich {
            denominator,
            inner,
            rows,
            cell_rows,
            ..
        } = &document.claim.evidence
        else {
            panic!("{name}")
        };
        let pieces = curve.chain().count();
        for _ in 0..60 {
            // Well inside the hull: every point of it with a positive weight.
            let weights: Vec<i64> = inner.points.iter().map(|_| 1 + random.below(9).pow(3) as i64).collect();
            let x = affine(&inner.points, denominator, &weights);
            let with = moved(&curve, &domain.points, &x);
            let (piece, u) = (random.below(pieces as u64) as usize, random.fraction());
            let excluded = (domain.open[0] && piece == 0 && u == zero())
                || (domain.open[1] && piece + 1 == pieces && u == fraction(1, 1));
            if !excluded {
                assert!(
                    determinant(&with, piece, &u, domain.sign) > zero(),
                    "{name}: {x:?} at {piece}, {u}"
                );
            }
        }
        // What a row cuts off is not in K.
        let context = Context::new(&curve, domain).expect(name);
        let mut cut = 0;
        for _ in 0..60 {
            let x: Vec<Rational> = (0..curve.dimension())
                .map(|axis| {
                    let (low, high) = (&domain.bounds.low[axis], &domain.bounds.high[axis]);
                    low + random.fraction() * (high - low)
                })
                .collect();
            let at = RationalVector::from_rationals(&x);
            for row in cell_rows.iter().map(|row| &rows[*row]) {
                let Row::Parameter { piece, u } = row else { continue };
                let exact = context.row(row).expect("a row");
                let value = exact.affine.at(at.numerators(), at.denominator());
                let with = moved(&curve, &domain.points, &x);
                let derivative = determinant(&with, *piece, u, domain.sign);
                if exact.strict {
                    assert_eq!(value.sign(), derivative.numer().sign(), "{name}: {x:?} at {piece}, {u}");
                }
                cut += usize::from(value.is_negative());
            }
        }
        assert!(cut > 0, "{name}: the rows cut nothing off");
    }
}

#[test]
fn the_sign_function_is_the_determinant_of_derivatives_times_a_power_of_the_weight() {
    let mut random = Numbers(2);
    for (name, point, _) in CURVES {
        let curve = curve(name);
        let problem = Problem::new(&curve, &question(point, Some(Sign::Positive), 40)).expect(name);
        let context = Context::new(&curve, &problem.domain).expect(name);
        let d = curve.dimension();
        for section in &context.sections {
            let chain = curve.chain();
            let degree = chain.pieces()[section.piece].degree();
            let rational = !chain.pieces()[section.piece].is_polynomial();
            let expected = if rational {
                (d + 1) * (degree - d)
            } else {
                d * (degree - d)
            };
            let removed: usize = section.removed.iter().sum();
            assert_eq!(section.coefficients.len(), expected + 1 - removed, "{name}");
            // The quotient of the two is the same wherever the point is.
            let u = fraction(1 + random.below(99) as i64, 100);
            let mut quotient = None;
            for _ in 0..4 {
                let x: Vec<Rational> = (0..d).map(|_| fraction(random.below(41) as i64 - 20, 3)).collect();
                let at = RationalVector::from_rationals(&x);
                let (row, _) = section.row(&u).expect("inside");
                let value = Rational::new(row.at(at.numerators(), at.denominator()), at.denominator().clone());
                let derivative = determinant(
                    &moved(&curve, &problem.domain.points, &x),
                    section.piece,
                    &u,
                    Sign::Positive,
                );
                if derivative == zero() {
                    assert_eq!(value, zero(), "{name}");
                    continue;
                }
                let found = value / derivative;
                assert!(found > zero(), "{name}");
                assert_eq!(*quotient.get_or_insert(found.clone()), found, "{name}");
            }
        }
    }
}

#[test]
fn the_papers_degree_is_the_same_function_and_has_its_counts() {
    for (name, point, n) in [("domain-cubic", 1, 3), ("domain-quintic-many-vertices", 2, 5)] {
        let curve = curve(name);
        let problem = Problem::new(&curve, &question(point, Some(Sign::Positive), 40)).expect(name);
        let context = Context::new(&curve, &problem.domain).expect(name);
        let mut paper = Levels::<2>::new(&context, Degree::Paper, |_| true).expect("polynomial");
        let mut own = Levels::<2>::new(&context, Degree::True, |_| true).expect("polynomial");
        assert_eq!(own.rows().len(), 2 * n - 3, "{name}");
        same_function(&own.rows(), &paper.rows());
        for level in 0..6 {
            assert_eq!(paper.step(false).0.inequalities, (2 * n - 2) << level, "{name}");
            own.step(false);
        }
    }
    let curve = curve("domain-quintic-spatial");
    let problem = Problem::new(&curve, &question(2, None, 40)).expect("a question");
    let context = Context::new(&curve, &problem.domain).expect("a domain");
    let mut paper = Levels::<3>::new(&context, Degree::Paper, |_| true).expect("polynomial");
    let own = Levels::<3>::new(&context, Degree::True, |_| true).expect("polynomial");
    assert_eq!(own.rows().len(), 3 * 5 - 8);
    same_function(&own.rows(), &paper.rows());
    for level in 0..4 {
        assert_eq!(paper.step(false).0.inequalities, (3 * 5 - 5) << level);
    }
    // Rational pieces have no such form.
    let rational = self::curve("domain-nurbs-arc");
    let problem = Problem::new(&rational, &question(2, None, 40)).expect("a question");
    let context = Context::new(&rational, &problem.domain).expect("a domain");
    assert_eq!(Levels::<2>::new(&context, Degree::Paper, |_| false).err(), Some(0));
}

/// Two lists of Bernstein coefficients, of different degrees, are one function up to a positive factor.
fn same_function<const D: usize>(own: &[HalfSpace<D>], elevated: &[HalfSpace<D>]) {
    let value = |rows: &[HalfSpace<D>], u: &Rational, axis: usize| {
        let coefficient = |row: &HalfSpace<D>| row.normal.get(axis).unwrap_or(&row.constant).clone();
        let basis = knotproof::curve::bernstein(rows.len() - 1, u);
        let terms = rows
            .iter()
            .zip(basis)
            .map(|(row, b)| Rational::from_integer(coefficient(row)) * b);
        terms.fold(zero(), |sum, term| sum + term)
    };
    let mut quotient = None;
    for k in 0..=12 {
        for axis in 0..=D {
            let u = fraction(k, 12);
            let (a, b) = (value(own, &u, axis), value(elevated, &u, axis));
            if a == zero() {
                assert_eq!(b, zero());
                continue;
            }
            let found = b / a;
            assert!(found > zero());
            assert_eq!(*quotient.get_or_insert(found.clone()), found);
        }
    }
}

#[test]
fn levels_grow_and_stay_inside() {
    for (name, point, sign) in CURVES {
        let curve = curve(name);
        let problem = Problem::new(&curve, &question(point, sign, 40)).expect(name);
        match curve.dimension() {
            2 => grows::<2>(name, &curve, &problem),
            _ => grows::<3>(name, &curve, &problem),
        }
    }
}

fn grows<const D: usize>(name: &str, curve: &Curve, problem: &Problem) {
    let context = Context::new(curve, &problem.domain).expect(name);
    let mut levels = Levels::<D>::new(&context, Degree::True, |_| true).expect(name);
    let mut before: Option<Vec<[Rational; D]>> = None;
    let mut least = zero();
    for _ in 0..5 {
        let rows = levels.rows();
        let (level, polytope) = levels.step(true);
        if let Some(vertices) = &before {
            // Monotonicity: every vertex of a level satisfies all inequalities of the next.
            for row in &rows {
                assert!(
                    vertices.iter().all(|v| row.value(v) >= zero()),
                    "{name}, level {}",
                    level.level
                );
            }
        }
        let exact = level.exact_measure.expect("asked for");
        assert!(level.measure[0] <= exact && exact <= level.measure[1], "{name}");
        assert!(exact >= least, "{name}");
        least = exact;
        if let Some(polytope) = polytope {
            let vertices: Vec<[Rational; D]> = (0..polytope.vertex_count()).map(|v| polytope.vertex(v)).collect();
            for vertex in &vertices {
                let at = RationalVector::from_rationals(vertex);
                assert!(
                    context
                        .show(at.numerators(), at.denominator(), Bound::NonNegative)
                        .is_ok(),
                    "{name}"
                );
            }
            before = Some(vertices);
        }
    }
}

#[test]
fn the_late_domain_has_two_empty_levels() {
    let curve = curve("domain-quintic-late");
    let problem = Problem::new(&curve, &question(2, Some(Sign::Positive), 40)).expect("a question");
    let context = Context::new(&curve, &problem.domain).expect("a domain");
    let mut levels = Levels::<2>::new(&context, Degree::Paper, |_| true).expect("polynomial");
    let counts: Vec<usize> = (0..3).map(|_| levels.step(false).0.vertices).collect();
    assert_eq!(counts[..2], [0, 0]);
    assert!(counts[2] > 0);
}

#[test]
fn the_bounded_domain_needs_no_box() {
    let curve = curve("domain-quintic-bounded");
    let problem = Problem::new(&curve, &question(2, Some(Sign::Positive), 400)).expect("a question");
    let document = certified(&curve, &problem).document.expect("a document");
    let Evidence::Sandwich { rows, cell_rows, .. } = &document.claim.evidence else {
        panic!()
    };
    assert!(cell_rows.iter().all(|row| matches!(rows[*row], Row::Parameter { .. })));
}

/// A solver that answers what it likes.
struct Liar(fn(usize) -> Option<Vec<f64>>);

impl FloatSolver for Liar {
    fn solve(&self, objective: &[f64], _rows: &[(Vec<f64>, f64)]) -> Option<Vec<f64>> {
        (self.0)(objective.len())
    }
}

#[test]
fn an_empty_domain_is_proved_with_few_rows_whatever_the_float_solver_says() {
    let curve = curve("domain-quintic-empty");
    let problem = Problem::new(&curve, &question(2, Some(Sign::Positive), 40)).expect("a question");
    let liars: [&dyn FloatSolver; 5] = [
        &GoodLp,
        &Liar(|_| None),
        &Liar(|n| Some(vec![0.0; n])),
        &Liar(|n| Some(vec![f64::NAN; n])),
        &Liar(|n| Some(vec![1e300; n])),
    ];
    for solver in liars {
        let found = certify(&curve, &problem, &options(solver));
        assert_eq!(found.status, Status::Certified);
        let document = found.document.expect("a document");
        assert_eq!(document.claim.statement.outcome, Outcome::Empty);
        let Evidence::Empty { rows, .. } = &document.claim.evidence else {
            panic!()
        };
        assert_eq!(rows.len(), 3);
        assert!(rows.iter().all(|row| matches!(row, Row::Parameter { .. })));
        write_checked(&document, Encoding::Json, &mut Cursor::new(Vec::new())).expect("accepted");
    }
    // Where the domain is not empty no solver makes it so.
    let other = self::curve("domain-quintic-late");
    let problem = Problem::new(&other, &question(2, Some(Sign::Positive), 40)).expect("a question");
    for solver in liars {
        let found = certify(&other, &problem, &options(solver));
        assert_eq!(found.status, Status::Certified);
        assert!(matches!(
            found.document.expect("a document").claim.statement.outcome,
            Outcome::Sandwich { .. }
        ));
    }
}

#[test]
fn random_quintics_are_decided_and_agree_with_their_levels() {
    let mut random = Numbers(7);
    let (mut empty, mut full) = (0, 0);
    for _ in 0..60 {
        let points: Vec<Rational> = (0..12).map(|_| fraction(random.below(17) as i64 - 8, 1)).collect();
        let piece = Bezier::new(2, RationalVector::from_rationals(&points), None).expect("valid");
        let curve = Curve::new(2, Form::Bezier(vec![piece])).expect("valid");
        let Ok(problem) = Problem::new(&curve, &question(2, Some(Sign::Negative), 40)) else {
            continue;
        };
        let found = certify(&curve, &problem, &options(&GoodLp));
        let Some(document) = found.document else { continue };
        write_checked(&document, Encoding::Json, &mut Cursor::new(Vec::new())).expect("accepted");
        let context = Context::new(&curve, &problem.domain).expect("a domain");
        let mut levels = Levels::<2>::new(&context, Degree::True, |_| true).expect("polynomial");
        let last = (0..6).map(|_| levels.step(false).0).last().expect("a level");
        match &document.claim.statement.outcome {
            Outcome::Empty => {
                assert_eq!(last.vertices, 0, "{points:?}");
                empty += 1;
            }
            Outcome::Sandwich { outer_measure, .. } => {
                assert!(last.measure[0] <= *outer_measure, "{points:?}");
                full += 1;
            }
            _ => panic!("another outcome"),
        }
    }
    assert!(empty >= 10 && full >= 10, "{empty} empty, {full} not");
}

#[test]
fn copies_of_a_point_move_together() {
    let closed = curve("unclamped-periodic");
    let Form::BSpline(spline) = closed.form() else { panic!() };
    let period = spline.count() - spline.degree();
    let problem = Problem::new(&closed, &question(0, None, 1))
        .or_else(|_| Problem::new(&closed, &question(0, Some(Sign::Positive), 1)));
    assert_eq!(problem.expect("a question").domain.points, [0, period]);
    let piece = |points: [i64; 6]| {
        let points = RationalVector::from_rationals(&points.map(|x| fraction(x, 1)));
        Bezier::new(2, points, None).expect("valid")
    };
    let lens = Form::Bezier(vec![piece([0, 0, 2, -2, 4, 0]), piece([4, 0, 2, 2, 0, 0])]);
    let lens = Curve::new(2, lens).expect("valid");
    let points = |point: usize| {
        Problem::new(&lens, &question(point, None, 1))
            .expect("a question")
            .domain
            .points
    };
    assert_eq!(
        [points(0), points(1), points(2), points(3)],
        [vec![0, 5], vec![1], vec![2, 3], vec![4]]
    );
    assert_eq!(
        Problem::new(&lens, &question(4, None, 1)).err(),
        Some(QuestionError::Point { found: 4, count: 4 })
    );
}

#[test]
fn a_row_of_the_levels_beside_the_box_gives_the_polytope() {
    // The square cut by the half-plane of a parabola: half of it, exactly.
    let piece = Bezier::new(
        2,
        RationalVector::from_rationals(&[0, 0, 1, 1, 2, 0].map(|x| fraction(x, 1))),
        None,
    )
    .expect("valid");
    let parabola = Curve::new(2, Form::Bezier(vec![piece])).expect("valid");
    let question = Question {
        bounds: Bounds::Corners(Corners {
            low: vec![fraction(0, 1), fraction(-1, 1)],
            high: vec![fraction(2, 1), fraction(1, 1)],
        }),
        ..question(1, None, 1)
    };
    let problem = Problem::new(&parabola, &question).expect("a question");
    let domain: &Domain = &problem.domain;
    assert_eq!(domain.sign, Sign::Negative);
    let context = Context::new(&parabola, domain).expect("a domain");
    let (level, _) = Levels::<2>::new(&context, Degree::True, |_| true)
        .expect("polynomial")
        .step(true);
    assert_eq!(level.exact_measure, Some(fraction(2, 1)));
    assert!(matches!(intersect::<2>(&[]), Intersection::Unbounded));
}

#[test]
fn questions_without_answer_say_so() {
    let cubic = curve("domain-cubic");
    let ask = |question: &Question| Problem::new(&cubic, question).expect_err("no answer");
    assert_eq!(ask(&question(4, None, 20)), QuestionError::Point { found: 4, count: 4 });
    assert_eq!(ask(&question(1, None, 0)), QuestionError::Box);
    assert_eq!(ask(&question(1, None, -3)), QuestionError::Box);
    let corners = |low: [i64; 2], high: [i64; 2]| Question {
        bounds: Bounds::Corners(Corners {
            low: low.map(|x| fraction(x, 1)).to_vec(),
            high: high.map(|x| fraction(x, 1)).to_vec(),
        }),
        ..question(1, None, 1)
    };
    assert_eq!(ask(&corners([1, 1], [2, 2])), QuestionError::Excluded);
    assert_eq!(ask(&corners([1, 1], [-2, 2])), QuestionError::Box);
    let interval = |a: i64, b: i64| Question {
        interval: Some([fraction(a, 2), fraction(b, 2)]),
        ..question(1, None, 1)
    };
    for (a, b) in [(1, 1), (2, 1), (-1, 1), (0, 3)] {
        assert!(
            matches!(ask(&interval(a, b)), QuestionError::Interval { .. }),
            "{a} {b}"
        );
    }
    let flat = Question {
        bounds: Bounds::Corners(Corners {
            low: vec![zero()],
            high: vec![zero()],
        }),
        ..question(1, None, 1)
    };
    assert_eq!(ask(&flat), QuestionError::Dimension { found: 1, expected: 2 });
    let both = curve("domain-quintic-many-vertices");
    assert_eq!(
        Problem::new(&both, &question(2, None, 20)).err(),
        Some(QuestionError::Sign)
    );
    let polygon = curve("square");
    assert!(matches!(
        Problem::new(&polygon, &question(1, None, 20)),
        Err(QuestionError::Degree {
            piece: 0,
            degree: 1,
            least: 2
        })
    ));
}
