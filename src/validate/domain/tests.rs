//! Answers about convex domains, right and wrong ones.

use super::*;
use crate::engine::{Answer, Case, Engine, Operation, Returned};
use crate::validate::{KnotproofF64, Tolerances, Truth, judge, truth};

const PLANE: [[f64; 2]; 4] = [[-4.0, 0.0], [0.0, 0.0], [4.0, 3.0], [5.0, 8.0]];
const SPACE: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [3.0, 1.0, 1.0],
    [5.0, 4.0, 3.0],
    [4.0, 8.0, 7.0],
    [1.0, 10.0, 12.0],
    [-3.0, 9.0, 18.0],
];

fn case(points: Vec<Vec<f64>>, weights: Option<Vec<f64>>, point: usize, level: u32, positive: bool) -> Case {
    Case {
        id: "a".into(),
        operation: Operation::ConvexDomain {
            point,
            half_width: 10.0,
            level,
            positive,
        },
        curve: FloatCurve::bezier(points, weights),
    }
}

fn plane(level: u32, positive: bool) -> Case {
    case(PLANE.iter().map(|p| p.to_vec()).collect(), None, 1, level, positive)
}

fn space(level: u32) -> Case {
    case(SPACE.iter().map(|p| p.to_vec()).collect(), None, 2, level, true)
}

fn exact(case: &Case) -> Truth {
    truth(case, &|_| Err("not asked for".into()))
}

fn vertices(case: &Case) -> Vec<Vec<f64>> {
    match KnotproofF64.answer(case) {
        Answer::Ok(Returned::Vertices(vertices)) => vertices,
        other => panic!("{other:?}"),
    }
}

fn verdict(case: &Case, vertices: Vec<Vec<f64>>) -> Verdict {
    let answer = Answer::Ok(Returned::Vertices(vertices));
    judge(&case.operation, &exact(case), &answer, &Tolerances::default())
}

/// The fault of an answer.
fn wrong(case: &Case, vertices: Vec<Vec<f64>>) -> Wrong {
    match verdict(case, vertices) {
        Verdict::Wrong(wrong) => wrong,
        other => panic!("{other}"),
    }
}

#[test]
fn polytopes_of_the_engine_are_right_to_many_digits() {
    let weighted = case(
        SPACE.iter().map(|p| p.to_vec()).collect(),
        Some(vec![1.0, 2.0, 2.0, 1.0, 2.0, 1.0]),
        2,
        1,
        true,
    );
    for case in [plane(0, true), plane(3, true), space(0), space(2), weighted] {
        let found = vertices(&case);
        assert!(found.len() > case.curve.dimension());
        match verdict(&case, found) {
            Verdict::Right { ulps } => assert!(ulps < 1e6, "{ulps}"),
            other => panic!("{other}"),
        }
    }
}

#[test]
fn the_polygon_of_level_0_is_known() {
    // In the square from -10 to 10 the cubic's three coefficients leave an area of 85.1 (the four of the paper's degree 119.1).
    let Truth::Domain(exact) = exact(&plane(0, true)) else {
        panic!("a polygon was expected");
    };
    let body = exact.body.expect("an interior");
    let area = body.facets.iter().fold(Rational::zero(), |sum, edge| {
        let (a, b) = (&body.points[edge[0]], &body.points[edge[1]]);
        sum + &a[0] * &b[1] - &a[1] * &b[0]
    });
    let area = area.to_f64() / 2.0;
    assert!((area - 85.1).abs() < 1e-12, "{area}");
    // Three coefficients and four sides.
    assert_eq!(exact.rows.len(), 7);
}

#[test]
fn faults_are_found_with_a_witness() {
    for case in [plane(2, true), space(1)] {
        let found = vertices(&case);
        let center: Vec<f64> = (0..case.curve.dimension())
            .map(|axis| found.iter().map(|v| v[axis]).sum::<f64>() / found.len() as f64)
            .collect();
        let scaled =
            |v: &Vec<f64>, by: f64| -> Vec<f64> { v.iter().zip(&center).map(|(x, c)| c + by * (x - c)).collect() };
        // One vertex too far out; the unit of the place is its own, so that rounding does not count.
        let mut moved = found.clone();
        moved[1] = scaled(&moved[1], 1.001);
        let fault = wrong(&case, moved);
        assert_eq!((fault.place.as_str(), fault.kind), ("vertex 1", Kind::OtherValue));
        assert!(fault.expected.contains("≥ 0") && fault.ulps > 1e10, "{fault}");
        // All a little too far in: nothing is outside, and the exact vertices are missed.
        let fault = wrong(&case, found.iter().map(|v| scaled(v, 0.999)).collect());
        assert!(fault.expected.starts_with("the vertex ("), "{fault}");
        // By less than the tolerance that is right, and points inside do no harm.
        let mut near: Vec<Vec<f64>> = found.iter().map(|v| scaled(v, 1.0 - 1e-9)).collect();
        near.push(center.clone());
        assert!(matches!(verdict(&case, near), Verdict::Right { ulps } if ulps > 1e3));
        // Nothing, and nothing with an interior.
        assert_eq!(wrong(&case, Vec::new()).found, "no vertices");
        assert_eq!(
            wrong(&case, vec![center.clone(); 4]).found,
            "vertices without an interior"
        );
        let mut infinite = found.clone();
        infinite[0][0] = f64::NAN;
        assert_eq!(wrong(&case, infinite).kind, Kind::NotFinite);
        assert_eq!(wrong(&case, vec![vec![0.0]]).kind, Kind::OtherForm);
    }
}

#[test]
fn empty_polytopes() {
    // The other sign leaves nothing of this level.
    let case = plane(0, false);
    assert_eq!(vertices(&case), Vec::<Vec<f64>>::new());
    assert!(matches!(verdict(&case, Vec::new()), Verdict::Right { ulps: 0.0 }));
    let fault = wrong(&case, vertices(&plane(0, true)));
    assert!(fault.expected.contains("≥ 0"), "{fault}");
    // Three fixed points that turn the other way: no place of the free one helps.
    let points = [[0.0, 0.0], [1.0, 0.0], [2.0, -1.0], [3.0, 0.0], [4.0, 2.0], [4.5, 4.0]];
    let case = super::tests::case(points.iter().map(|p| p.to_vec()).collect(), None, 4, 1, true);
    assert_eq!(vertices(&case), Vec::<Vec<f64>>::new());
    assert!(matches!(verdict(&case, Vec::new()), Verdict::Right { .. }));
}

#[test]
fn distances_of_a_cube() {
    let corner = |i: usize| {
        (0..3)
            .map(|axis| Rational::from_integer(((i >> axis & 1) as i64).into()))
            .collect()
    };
    let cube = Body::around(&(0..8).map(corner).collect::<Vec<_>>()).expect("a cube");
    for (point, distance) in [
        ([0.5, 0.5, 0.5], 0.0),
        ([1.0, 0.5, 0.0], 0.0),
        ([0.25, 0.75, 3.0], 2.0),
        ([4.0, 5.0, 0.5], 5.0),
        ([-1.0, -2.0, 3.0], 3.0),
    ] {
        assert_eq!(cube.distance(&exactly(&point)), distance, "{point:?}");
    }
    assert_eq!(Body::around(&vec![corner(0); 5]), None);
}
