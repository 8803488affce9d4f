//! Right and wrong answers side by side.

use crate::engine::{Answer, Case, CaseSide, FloatCurve, Operation, Returned};
use crate::validate::{Kind, MsdBounds, Tolerances, Verdict, judge, truth};

/// (0,0), (1,2), (2,−1), (3,3), (4,0), cubic, with the knot ½.
fn cubic() -> FloatCurve {
    FloatCurve {
        degree: 3,
        knots: vec![0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0],
        points: [[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [3.0, 3.0], [4.0, 0.0]]
            .map(|p| p.to_vec())
            .to_vec(),
        weights: None,
    }
}

fn quarter() -> FloatCurve {
    let points = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|p| p.to_vec()).to_vec();
    FloatCurve::bezier(points, Some(vec![1.0, 1.0, 2.0]))
}

#[track_caller]
fn verdict(curve: FloatCurve, operation: Operation, returned: Returned) -> Verdict {
    let case = Case {
        id: "a".into(),
        operation,
        curve,
    };
    let none = |_: &crate::curve::Curve| Ok(MsdBounds::None);
    judge(
        &case.operation,
        &truth(&case, &none),
        &Answer::Ok(returned),
        &Tolerances::default(),
    )
}

#[track_caller]
fn right(curve: FloatCurve, operation: Operation, returned: Returned) -> f64 {
    match verdict(curve, operation, returned) {
        Verdict::Right { ulps } => ulps,
        other => panic!("{other}"),
    }
}

#[track_caller]
fn wrong(curve: FloatCurve, operation: Operation, returned: Returned, kind: Kind) -> String {
    match verdict(curve, operation, returned) {
        Verdict::Wrong(wrong) if wrong.kind == kind => wrong.to_string(),
        other => panic!("{other}"),
    }
}

#[test]
fn points() {
    let at = || Operation::Point { parameter: 0.25 };
    assert_eq!(right(cubic(), at(), Returned::Point(vec![1.1875, 1.03125])), 0.0);
    // The largest coordinate is 4: one unit is 2^-50.
    let off = right(cubic(), at(), Returned::Point(vec![1.1875, 1.03125 + f64::EPSILON]));
    assert_eq!(off, 0.25);
    let told = wrong(cubic(), at(), Returned::Point(vec![1.0625, 1.371]), Kind::OtherValue);
    assert!(told.contains("19/16") && told.contains("33/32"), "{told}");
    wrong(cubic(), at(), Returned::Point(vec![1.1875]), Kind::OtherForm);
    wrong(cubic(), at(), Returned::Vector(vec![1.1875, 1.03125]), Kind::OtherForm);
    wrong(cubic(), at(), Returned::Point(vec![f64::NAN, 1.03125]), Kind::NotFinite);
    // Far beyond what binary64 can hold the difference of.
    wrong(cubic(), at(), Returned::Point(vec![-1e308, 1e308]), Kind::OtherValue);
}

#[test]
fn derivatives_on_either_side() {
    // Two lines with a corner at 1.
    let corner = || FloatCurve {
        degree: 1,
        knots: vec![0.0, 0.0, 1.0, 2.0, 2.0],
        points: [[0.0, 0.0], [1.0, 0.0], [1.0, 3.0]].map(|p| p.to_vec()).to_vec(),
        weights: None,
    };
    for side in [CaseSide::Left, CaseSide::Right] {
        let at = || Operation::Derivative {
            parameter: 1.0,
            order: 1,
            side,
        };
        right(corner(), at(), Returned::Vector(vec![1.0, 0.0]));
        right(corner(), at(), Returned::Vector(vec![0.0, 3.0]));
        let told = wrong(corner(), at(), Returned::Vector(vec![0.5, 1.5]), Kind::OtherValue);
        assert!(told.contains("(1, 0) or (0, 3)"), "{told}");
    }
    let beside = || Operation::Derivative {
        parameter: 1.0_f64.next_up(),
        order: 1,
        side: CaseSide::Left,
    };
    right(corner(), beside(), Returned::Vector(vec![1.0, 0.0]));
    let inside = || Operation::Derivative {
        parameter: 0.75,
        order: 1,
        side: CaseSide::Left,
    };
    wrong(corner(), inside(), Returned::Vector(vec![0.0, 3.0]), Kind::OtherValue);
}

#[test]
fn curvature_and_torsion() {
    let at = || Operation::Curvature {
        parameter: 0.5,
        side: CaseSide::Left,
    };
    right(quarter(), at(), Returned::Value(1.0));
    right(quarter(), at(), Returned::Value(-1.0));
    wrong(quarter(), at(), Returned::Value(0.99), Kind::OtherValue);
    wrong(quarter(), at(), Returned::Value(f64::INFINITY), Kind::NotFinite);
    let line = FloatCurve::bezier(vec![vec![1.0, 1.0], vec![1.0, 1.0], vec![2.0, 2.0]], None);
    let start = Operation::Curvature {
        parameter: 0.0,
        side: CaseSide::Left,
    };
    assert!(matches!(
        verdict(line, start, Returned::Value(0.0)),
        Verdict::Unjudged(_)
    ));
    // (t, t², t³) has torsion 3 / (9t⁴ + 9t² + 1): 3 at 0.
    let points = [
        [0.0, 0.0, 0.0],
        [1.0 / 4.0, 0.0, 0.0],
        [0.5, 0.25, 0.0],
        [0.75, 0.75, 1.0],
    ];
    let twisted = || FloatCurve::bezier(points.map(|p| p.to_vec()).to_vec(), None);
    let at = || Operation::Torsion {
        parameter: 0.0,
        side: CaseSide::Right,
    };
    // c' = (3/4, 0, 0), c'' = (0, 3/2, 0), c''' = (0, ·, 6): 6 · 9/8 / (9/8)².
    right(twisted(), at(), Returned::Value(6.0 / 1.125));
    wrong(twisted(), at(), Returned::Value(-6.0 / 1.125), Kind::OtherValue);
}

#[test]
fn inserted_and_removed_knots() {
    let insert = || Operation::InsertKnot {
        parameter: 0.5,
        times: 1,
    };
    let exact = quarter().exact().unwrap();
    let half = crate::number::Rational::new(1.into(), 2.into());
    let inserted = FloatCurve::rounded(&exact.insert_knot(&half, 1).unwrap());
    right(quarter(), insert(), Returned::Curve(inserted.clone()));
    // The same curve without the knot, and a curve that is not a circle.
    wrong(quarter(), insert(), Returned::Curve(quarter()), Kind::OtherForm);
    let mut bent = inserted.clone();
    bent.points[1] = vec![0.9, 0.4];
    wrong(quarter(), insert(), Returned::Curve(bent), Kind::OtherValue);
    let mut broken = inserted.clone();
    broken.weights = Some(vec![1.0, -1.0, 1.0, 2.0]);
    wrong(quarter(), insert(), Returned::Curve(broken), Kind::NotACurve);
    let mut broken = inserted.clone();
    broken.points[0][0] = f64::NAN;
    wrong(quarter(), insert(), Returned::Curve(broken), Kind::NotFinite);
    let remove = || Operation::RemoveKnot {
        parameter: 0.5,
        times: 1,
    };
    // Binary64 holds the cubic with its knot exactly, so that the knot can be taken out again; the circle's is rounded.
    let inserted = FloatCurve::rounded(&cubic().exact().unwrap().insert_knot(&half, 1).unwrap());
    right(inserted.clone(), remove(), Returned::Curve(cubic()));
    wrong(inserted.clone(), remove(), Returned::Curve(inserted), Kind::OtherForm);
}

#[test]
fn other_parametrisations_and_degrees() {
    let elevate = || Operation::ElevateDegree { times: 1 };
    let mut elevated = FloatCurve::rounded(&cubic().exact().unwrap().elevate(1).unwrap());
    right(cubic(), elevate(), Returned::Curve(elevated.clone()));
    for knot in &mut elevated.knots {
        *knot = 3.0 * *knot - 1.0;
    }
    right(cubic(), elevate(), Returned::Curve(elevated.clone()));
    wrong(cubic(), elevate(), Returned::Curve(cubic()), Kind::OtherForm);
    elevated.knots[5..7].fill(0.75);
    wrong(cubic(), elevate(), Returned::Curve(elevated), Kind::OtherValue);
}

#[test]
fn knots_of_multiplicity_degree_plus_one() {
    // The parabola (0,0), (1,2), (2,0) with the knot ½ three times, the point there twice.
    let parabola = || FloatCurve::bezier([[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]].map(|p| p.to_vec()).to_vec(), None);
    let insert = || Operation::InsertKnot {
        parameter: 0.5,
        times: 2,
    };
    let points = [[0.0, 0.0], [0.5, 1.0], [1.0, 1.0], [1.0, 1.0], [1.5, 1.0], [2.0, 0.0]];
    let mut inserted = FloatCurve {
        degree: 2,
        knots: vec![0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0],
        points: points.map(|p| p.to_vec()).to_vec(),
        weights: None,
    };
    assert_eq!(right(parabola(), insert(), Returned::Curve(inserted.clone())), 0.0);
    inserted.points[3][1] = 1.25;
    let told = wrong(parabola(), insert(), Returned::Curve(inserted), Kind::OtherValue);
    assert!(told.contains("parameter 1/2"), "{told}");
}

#[test]
fn parts() {
    let half = crate::number::Rational::new(1.into(), 2.into());
    let (a, b) = cubic().exact().unwrap().split(&half).unwrap();
    let parts = || vec![FloatCurve::rounded(&a), FloatCurve::rounded(&b)];
    let split = || Operation::Split { parameter: 0.5 };
    right(cubic(), split(), Returned::Curves(parts()));
    right(cubic(), Operation::Decompose, Returned::Curves(parts()));
    let mut moved = parts();
    for knot in &mut moved[1].knots {
        *knot = 2.0 * *knot - 1.0;
    }
    right(cubic(), split(), Returned::Curves(moved));
    let mut swapped = parts();
    swapped.reverse();
    wrong(cubic(), split(), Returned::Curves(swapped), Kind::OtherValue);
    wrong(
        cubic(),
        split(),
        Returned::Curves(parts()[..1].to_vec()),
        Kind::OtherForm,
    );
    wrong(
        cubic(),
        Operation::Decompose,
        Returned::Curves(vec![cubic()]),
        Kind::OtherForm,
    );
    wrong(cubic(), split(), Returned::Curve(cubic()), Kind::OtherForm);
}

#[test]
fn distances() {
    let nearest = || Operation::NearestPoint { target: vec![3.0, 4.0] };
    let distance = |distance: Option<f64>| Returned::Distance {
        distance,
        parameters: Vec::new(),
    };
    right(quarter(), nearest(), distance(Some(4.0)));
    right(quarter(), nearest(), distance(Some(4.0 + 1e-9)));
    wrong(quarter(), nearest(), distance(Some(4.01)), Kind::OtherValue);
    wrong(quarter(), nearest(), distance(Some(3.99)), Kind::OtherValue);
    wrong(quarter(), nearest(), distance(None), Kind::OtherForm);
    wrong(quarter(), nearest(), distance(Some(f64::NAN)), Kind::NotFinite);
    right(quarter(), Operation::Msd, distance(None));
    wrong(quarter(), Operation::Msd, distance(Some(1.0)), Kind::OtherValue);
}

#[test]
fn refusals_are_not_wrong() {
    let case = Case {
        id: "a".into(),
        operation: Operation::Decompose,
        curve: cubic(),
    };
    let none = |_: &crate::curve::Curve| Ok(MsdBounds::None);
    let truth = truth(&case, &none);
    let of = |answer: Answer| judge(&case.operation, &truth, &answer, &Tolerances::default());
    assert_eq!(of(Answer::NotOffered), Verdict::NotOffered);
    assert_eq!(of(Answer::Refused("no".into())), Verdict::Refused("no".into()));
}
