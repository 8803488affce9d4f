//! The curve files under `certs/curves`, and values that papers and books print.

mod curve_support;

use curve_support::{fraction, integers};
use knotproof::curve::{Chain, Curve, Form, Joint, Side, read_curve, write_curve};
use knotproof::number::Rational;
use num_traits::Zero;
use std::path::Path;

fn directory() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("certs/curves")
}

fn curve(name: &str) -> Curve {
    let json = std::fs::read(directory().join(name)).expect(name);
    read_curve(&json)
        .unwrap_or_else(|error| panic!("{name}: {error}"))
        .curve
}

fn joints(chain: &Chain<'_>) -> Vec<Joint> {
    (0..chain.count()).filter_map(|i| chain.joint(i)).collect()
}

fn corners(name: &str) -> usize {
    let curve = curve(name);
    joints(&curve.chain())
        .iter()
        .filter(|joint| **joint == Joint::Corner)
        .count()
}

/// All parameters i + j/12 of a chain.
fn everywhere(chain: &Chain<'_>) -> impl Iterator<Item = Vec<Rational>> {
    (0..=12 * chain.count() as i64).map(|j| chain.evaluate(&fraction(j, 12)).unwrap())
}

fn square(x: &Rational) -> Rational {
    x * x
}

#[test]
fn every_file_is_a_named_curve() {
    let mut count = 0;
    for entry in std::fs::read_dir(directory()).unwrap() {
        let path = entry.unwrap().path();
        let json = std::fs::read(&path).unwrap();
        let file = read_curve(&json).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert!(file.name.is_some_and(|name| name.len() > 10), "{}", path.display());
        assert_eq!(read_curve(write_curve(&file.curve, None)).unwrap().curve, file.curve);
        count += 1;
    }
    assert!(count >= 20);
}

#[test]
fn maekawa_patrikalakis_figure_1() {
    let curve = curve("mp06-figure-1.json");
    let chain = curve.chain();
    let f = fraction;
    // The Bézier points of the paper, as fractions.
    let first = [
        f(0, 1),
        f(0, 1),
        f(0, 1),
        f(-1, 1),
        f(1, 1),
        f(0, 1),
        f(7, 4),
        f(13, 4),
        f(1, 1),
        f(77, 24),
        f(79, 24),
        f(31, 12),
    ];
    assert_eq!(chain.pieces()[0].points().iter().collect::<Vec<_>>(), first);
    let second: Vec<Rational> = (1..=2).flat_map(|k| chain.pieces()[1].point(k)).collect();
    // (2 P2 + P3)/3 and (P2 + 2 P3)/3.
    assert_eq!(second, [f(14, 3), f(10, 3), f(25, 6), f(29, 6), f(7, 6), f(19, 3)]);
    assert_eq!(chain.count(), 5);
    assert_eq!(chain.piece(1).unwrap().knots, (f(1, 5), f(2, 5)));
    assert_eq!(chain.knot_at(&f(5, 2)), Some(f(1, 2)));
    assert!(chain.closed());
    // The closing point is only G1: from (0,0,0) towards (−1,1,0), and from (3.5,−3.5,0) to the origin.
    assert_eq!(joints(&chain), [Joint::Smooth; 5]);
    let spline = match curve.form() {
        Form::BSpline(spline) => spline,
        Form::Bezier(_) => panic!("a B-spline"),
    };
    let (start, end) = spline.domain();
    assert_ne!(
        spline.derivatives(&start, Side::After, 1).unwrap()[1],
        spline.derivatives(&end, Side::Before, 1).unwrap()[1]
    );
}

#[test]
fn trefoil_has_24_smooth_pieces() {
    let curve = curve("trefoil-24.json");
    assert_eq!(joints(&curve.chain()), [Joint::Smooth; 24]);
}

#[test]
fn conics_lie_on_their_equations() {
    for (name, a, b) in [
        ("nurbs-circle.json", fraction(1, 1), fraction(1, 1)),
        ("nurbs-circle-radius-3-2.json", fraction(3, 2), fraction(3, 2)),
        ("nurbs-ellipse.json", fraction(3, 1), fraction(1, 1)),
    ] {
        let curve = curve(name);
        let chain = curve.chain();
        for point in everywhere(&chain) {
            let sum = square(&(&point[0] / &a)) + square(&(&point[1] / &b));
            assert_eq!(sum, fraction(1, 1), "{name}");
        }
        assert_eq!(joints(&chain), [Joint::Smooth; 4], "{name}");
    }
}

#[test]
fn quarter_circle_of_piegl_and_tiller() {
    // The NURBS Book, section 4.3: c(u) = ((1 − u²)/(1 + u²), 2u/(1 + u²)) and its derivatives at both ends.
    let curve = curve("nurbs-circle.json");
    let chain = curve.chain();
    let quarter = &chain.pieces()[0];
    let f = fraction;
    assert_eq!(quarter.evaluate(&f(1, 2)).unwrap(), [f(3, 5), f(4, 5)]);
    let start = quarter.derivatives(&f(0, 1), 2).unwrap();
    assert_eq!(start[1], [f(0, 1), f(2, 1)]);
    assert_eq!(start[2], [f(-4, 1), f(0, 1)]);
    let end = quarter.derivatives(&f(1, 1), 2).unwrap();
    assert_eq!(end[1], [f(-1, 1), f(0, 1)]);
    assert_eq!(end[2], [f(1, 1), f(-1, 1)]);
}

#[test]
fn stadium_is_at_distance_one_from_its_axis() {
    let curve = curve("stadium.json");
    let chain = curve.chain();
    assert_eq!(chain.count(), 6);
    for point in everywhere(&chain) {
        // The nearest point of the axis from (−2, 0) to (2, 0).
        let x = point[0].clone().clamp(fraction(-2, 1), fraction(2, 1));
        assert_eq!(square(&(&point[0] - x)) + square(&point[1]), fraction(1, 1));
    }
    assert_eq!(joints(&chain), [Joint::Smooth; 6]);
}

#[test]
fn polygons_have_their_sides_and_corners() {
    for (name, squared) in [
        ("segment.json", vec![25]),
        ("square.json", vec![1, 1, 1, 1]),
        ("triangle.json", vec![16, 25, 9]),
        ("triangle-acute.json", vec![196, 225, 169]),
    ] {
        let curve = curve(name);
        let chain = curve.chain();
        let sides: Vec<Rational> = chain
            .pieces()
            .iter()
            .map(|p| p.point(0).iter().zip(p.point(1)).map(|(a, b)| square(&(a - b))).sum())
            .collect();
        assert_eq!(sides, integers(&squared).iter().collect::<Vec<_>>(), "{name}");
        assert_eq!(chain.closed(), name != "segment.json", "{name}");
        assert_eq!(corners(name), if chain.closed() { sides.len() } else { 0 }, "{name}");
    }
}

#[test]
fn parabola_and_cusp_lie_on_their_equations() {
    for point in everywhere(&curve("parabola.json").chain()) {
        assert_eq!(point[1], square(&point[0]));
    }
    let cusp = curve("cusp.json");
    let chain = cusp.chain();
    for point in everywhere(&chain) {
        assert_eq!(square(&point[1]), square(&point[0]) * &point[0]);
    }
    let half = fraction(1, 2);
    assert!(
        chain.pieces()[0]
            .hodograph()
            .evaluate(&half)
            .unwrap()
            .iter()
            .all(Rational::is_zero)
    );
}

#[test]
fn figures_eight_cross_at_the_origin() {
    let origin = [fraction(0, 1), fraction(0, 1)];
    for (name, first, second) in [
        ("figure-eight.json", fraction(1, 2), fraction(5, 2)),
        ("crossing-at-joints.json", fraction(0, 1), fraction(2, 1)),
    ] {
        let curve = curve(name);
        let chain = curve.chain();
        assert_eq!(chain.evaluate(&first).unwrap(), origin, "{name}");
        assert_eq!(chain.evaluate(&second).unwrap(), origin, "{name}");
        assert_eq!(joints(&chain), [Joint::Smooth; 4], "{name}");
        let tangent = |t: &Rational| {
            let (i, u) = chain.locate(t).unwrap();
            chain.pieces()[i].derivatives(&u, 1).unwrap().swap_remove(1)
        };
        let (v, w) = (tangent(&first), tangent(&second));
        assert!(!(&v[0] * &w[1] - &v[1] * &w[0]).is_zero(), "{name}");
    }
}

#[test]
fn space_curves_are_what_they_say() {
    let helix = curve("helix-degree-9.json");
    assert_eq!((helix.dimension(), helix.chain().pieces()[0].degree()), (3, 9));
    assert!(!helix.is_closed());
    let space = curve("nurbs-space.json");
    let Form::BSpline(spline) = space.form() else {
        panic!("a B-spline")
    };
    let weights: Vec<Rational> = spline.weights().unwrap().iter().collect();
    let ratio = weights.iter().max().unwrap() / weights.iter().min().unwrap();
    assert_eq!(ratio, fraction(100, 1));
}

#[test]
fn unclamped_periodic_spline_closes_with_two_derivatives() {
    let curve = curve("unclamped-periodic.json");
    let Form::BSpline(spline) = curve.form() else {
        panic!("a B-spline")
    };
    let (start, end) = spline.domain();
    assert_eq!(
        spline.derivatives(&start, Side::After, 2),
        spline.derivatives(&end, Side::Before, 2)
    );
    let count = spline.count();
    assert_ne!(spline.points().get(0), spline.points().get(2 * count - 2));
    assert_eq!(joints(&curve.chain()), [Joint::Smooth; 8]);
}

#[test]
fn coincident_ends_are_smooth_nevertheless() {
    let curve = curve("coincident-ends.json");
    let chain = curve.chain();
    assert_eq!(chain.pieces()[0].point(0), chain.pieces()[0].point(1));
    assert_eq!(joints(&chain), [Joint::Smooth; 3]);
}

#[test]
fn corners_turn_by_about_150_degrees() {
    let curve = curve("corner-150.json");
    let chain = curve.chain();
    assert_eq!(joints(&chain), [Joint::Corner, Joint::Corner, Joint::Smooth]);
    for i in [0, 1] {
        let v = chain.pieces()[(i + 2) % 3].end_direction().unwrap();
        let w = chain.pieces()[i].start_direction().unwrap();
        let dot = |a: &[Rational], b: &[Rational]| -> Rational { a.iter().zip(b).map(|(x, y)| x * y).sum() };
        let product = dot(&v, &w);
        // The squared cosine is 3/4 at 150 degrees; 49/66 = 0.742… turns by 149.5 degrees.
        assert!(product < Rational::zero());
        assert_eq!(square(&product) / (dot(&v, &v) * dot(&w, &w)), fraction(49, 66));
    }
}
