//! Experiment 1 and Example 4 of CPIJ14, every printed number beside the exact one. The table is in docs/paper-notes.md.
//!
//! Computed here from the definitions, on the motion that the file describes; `certify motion` computes them in another way.

use std::path::Path;

use knotproof::motion::{Motion, ReadOptions, read_motion};
use knotproof::number::{Integer, Rational, RationalExt, exact_sqrt};

type Point = [Rational; 2];

fn fraction(numerator: i64, denominator: i64) -> Rational {
    Rational::new(Integer::from(numerator), Integer::from(denominator))
}

fn motion() -> Motion {
    read_motion(
        Path::new("certs/motions/cpij14-experiment-1.json"),
        ReadOptions::default(),
    )
    .expect("a motion")
}

/// All own control points in all frames.
fn frames(motion: &Motion) -> Vec<Vec<Point>> {
    let coordinates = motion.points().coordinates();
    let mut frame: Vec<Point> = coordinates.chunks(2).map(|p| [p[0].clone(), p[1].clone()]).collect();
    let mut frames = vec![frame.clone()];
    for step in motion.moves().expect("steps") {
        for (point, by) in step.expect("a step") {
            for axis in 0..2 {
                frame[point as usize][axis] += Rational::new(by[axis].clone(), motion.denominator.clone());
            }
        }
        frames.push(frame.clone());
    }
    frames
}

fn minus(p: &Point, q: &Point) -> Point {
    [&p[0] - &q[0], &p[1] - &q[1]]
}

fn squared(v: &Point) -> Rational {
    &v[0] * &v[0] + &v[1] * &v[1]
}

fn infinity(v: &Point) -> Rational {
    let size = |x: &Rational| if x.numer().is_negative() { -x } else { x.clone() };
    size(&v[0]).max(size(&v[1]))
}

/// The greatest second difference inside a piece: in the ∞-norm, squared in the Euclidean one, and the points that attain the latter.
fn second_differences(frame: &[Point]) -> (Rational, Rational, Vec<usize>) {
    let all: Vec<(usize, Point)> = (1..frame.len() - 1)
        .filter(|j| j % 3 != 0)
        .map(|j| {
            (
                j,
                minus(&minus(&frame[j + 1], &frame[j]), &minus(&frame[j], &frame[j - 1])),
            )
        })
        .collect();
    let greatest = all.iter().map(|(_, v)| squared(v)).max().expect("points");
    let attained = all.iter().filter(|(_, v)| squared(v) == greatest);
    let attained = attained.map(|(j, _)| *j).collect();
    (
        all.iter().map(|(_, v)| infinity(v)).max().expect("points"),
        greatest,
        attained,
    )
}

fn displacement(frames: &[Vec<Point>], i: usize) -> (Rational, Rational) {
    let all = || frames[i].iter().zip(&frames[0]).map(|(p, q)| minus(p, q));
    let greatest = all().map(|v| infinity(&v)).max();
    (
        greatest.expect("points"),
        all().map(|v| squared(&v)).max().expect("points"),
    )
}

/// N∞(3) = 1/3 times the second difference, and the greatest displacement, in one norm.
fn value(frames: &[Vec<Point>], i: usize) -> Rational {
    let (second, second_squared, _) = second_differences(&frames[i]);
    let (moved, moved_squared) = displacement(frames, i);
    // In this motion the two norms agree in every frame: all that counts is vertical.
    assert_eq!(exact_sqrt(&second_squared), Some(second.clone()));
    assert_eq!(exact_sqrt(&moved_squared), Some(moved.clone()));
    second * fraction(1, 3) + moved
}

#[test]
fn the_curve_is_a_c1_chain_of_14_cubics() {
    let motion = motion();
    assert_eq!(motion.points().count(), 43);
    assert_eq!(motion.steps, 10);
    let kinds: Vec<u8> = [0, 1, 2, 3, 4, 39, 40, 41, 42]
        .map(|j| motion.points().kind(j))
        .to_vec();
    // p_u and p_v are next to a joint: type 1, where the paper says type 2. The joint p_j is the type 2 point.
    assert_eq!(kinds, [3, 3, 1, 2, 1, 2, 1, 3, 3]);
}

#[test]
fn the_ends_of_the_motion_as_printed() {
    let frames = frames(&motion());
    let at = |i: usize, j: usize| frames[i][j].clone();
    let point = |x: i64, n: i64, d: i64| [fraction(x, 1), fraction(n, d)];
    // p_v = (2, 3/2) → (2, 3) and p_j = (3, 3/4) → (3, 3/2), as printed.
    assert_eq!((at(0, 40), at(10, 40)), (point(2, 3, 2), point(2, 3, 1)));
    assert_eq!((at(0, 39), at(10, 39)), (point(3, 3, 4), point(3, 3, 2)));
    // Σγ_v = (0, 3/2), as printed. The entries of γ_v are printed negative, with the sum (0, −3/2), and those of γ_u positive:
    // the motion described is the one with all signs turned.
    assert_eq!(minus(&at(10, 40), &at(0, 40)), [fraction(0, 1), fraction(3, 2)]);
    assert_eq!(minus(&at(10, 2), &at(0, 2)), [fraction(0, 1), fraction(-3, 2)]);
    // With the printed signs p_v would end at (2, 0).
    let printed = [5, 4, 4, 4, 3, 2, 1, 1, 1, 5].map(|k| fraction(-k, 20));
    let sum = printed.iter().fold(fraction(3, 2), |sum, x| sum + x);
    assert_eq!(sum, fraction(0, 1));
    // The polygon passes twice through (2, 3) at step 10, and p_u, p_v are its only pair of equal vertices.
    assert_eq!(at(10, 2), at(10, 40));
    for (i, frame) in frames.iter().enumerate() {
        let equal = (0..43)
            .flat_map(|a| (0..a).map(move |b| (a, b)))
            .filter(|(a, b)| frame[*a] == frame[*b]);
        assert_eq!(equal.count(), usize::from(i == 10), "frame {i}");
    }
}

#[test]
fn the_distance_of_polygon_and_curve() {
    let frames = frames(&motion());
    let (second, _, attained) = second_differences(&frames[0]);
    // N∞(3)·5/4 = 5/12, as printed. It is attained at p_u and p_v.
    assert_eq!(second.clone() * fraction(1, 3), fraction(5, 12));
    assert_eq!(attained, [2, 40]);
    // α = ⌈−½·log₂(ε_d / (5/12))⌉ = −1, as 4 < 1.9167/(5/12) < 16: no subdivision is needed.
    let ratio = fraction(19_167, 10_000) / fraction(5, 12);
    assert!(ratio > fraction(4, 1) && ratio < fraction(16, 1));
    // 1.9167 is 23/12 rounded, which is 5/12 + 3/2.
    assert_eq!(fraction(5, 12) + fraction(3, 2), fraction(23, 12));
    assert!((fraction(23, 12) - fraction(19_167, 10_000)).to_f64().abs() < 0.5e-4);
    // "Note that this distance is actually attained": the true distance is certified to be smaller.
    let motion = motion();
    let options = knotproof::prove::deviation::Options {
        subdivisions: 0,
        relative_width: fraction(1, 1_000_000),
        name: None,
        snapped_joints: None,
    };
    let found = knotproof::prove::deviation::certify(&motion.curve, &options).expect("a curve");
    let statement = found.document.expect("certified").claim.statement;
    assert!(statement.upper_squared < fraction(5, 12) * fraction(5, 12));
    assert_eq!(format!("{:.4}", statement.lower_squared.to_f64().sqrt()), "0.3889");
}

#[test]
fn half_nu() {
    let frames = frames(&motion());
    // ν is attained by the vertex 20 and the edge 21, 22, (25, 4) to (25, 3): ν² = 1, ½ν = ½ as printed.
    let polygon = &frames[0];
    let mut nu_squared: Option<Rational> = None;
    for vertex in 0..43 {
        for edge in (0..42).filter(|edge| vertex != *edge && vertex != edge + 1) {
            let along = minus(&polygon[edge + 1], &polygon[edge]);
            let from = minus(&polygon[vertex], &polygon[edge]);
            let dot = &along[0] * &from[0] + &along[1] * &from[1];
            let share = (dot / squared(&along)).clamp(fraction(0, 1), fraction(1, 1));
            let foot = [&from[0] - &along[0] * &share, &from[1] - &along[1] * &share];
            let distance = squared(&foot);
            nu_squared = Some(nu_squared.map_or(distance.clone(), |least| least.min(distance)));
        }
    }
    assert_eq!(nu_squared, Some(fraction(1, 1)));
    // "would have guaranteed that the first 5 time steps were permissible": displacements reach ½ at step 3, ν itself at step 5.
    let moved: Vec<Rational> = (0..=10).map(|i| displacement(&frames, i).0).collect();
    let twentieths = [0, 5, 9, 13, 17, 20, 22, 23, 24, 25, 30];
    assert_eq!(moved, twentieths.map(|k| fraction(k, 20)));
    assert_eq!(moved.iter().position(|x| *x >= fraction(1, 2)), Some(3));
    assert_eq!(moved.iter().position(|x| *x >= fraction(1, 1)), Some(5));
}

#[test]
fn the_criterion_of_second_differences() {
    let frames = frames(&motion());
    let tolerance = fraction(19_167, 10_000);
    // Step 9: printed 0.65 + 1.25 = 1.9; right are 5/8 + 5/4 = 15/8.
    assert_eq!(second_differences(&frames[9]).0 * fraction(1, 3), fraction(5, 8));
    assert_eq!(displacement(&frames, 9).0, fraction(5, 4));
    assert_eq!(value(&frames, 9), fraction(15, 8));
    // Step 10: printed 0.667 + 1.5 = 2.167; 2/3 + 3/2 = 13/6 rounds to it.
    assert_eq!(second_differences(&frames[10]).0 * fraction(1, 3), fraction(2, 3));
    assert_eq!(displacement(&frames, 10).0, fraction(3, 2));
    assert_eq!(value(&frames, 10), fraction(13, 6));
    // The greatest second difference is at p_u and p_v in every frame.
    assert!(frames.iter().all(|frame| second_differences(frame).2 == [2, 40]));
    // The first step that fails is the tenth, with 1.9167 and with 23/12.
    for tolerance in [tolerance.clone(), fraction(23, 12)] {
        let first = (0..=10).position(|i| value(&frames, i) >= tolerance);
        assert_eq!(first, Some(10));
    }
    // Without the factor N∞, as the inequality is printed, it fails at step 2, and at step 9 it would read 1.875 + 1.25 = 3.125.
    let printed = |i: usize| second_differences(&frames[i]).0 + displacement(&frames, i).0;
    assert_eq!((0..=10).position(|i| printed(i) >= tolerance), Some(2));
    assert_eq!(printed(9), fraction(25, 8));
}
