//! Enclosures against distances known exactly.

use super::*;
use crate::engine::FloatCurve;

fn curve(points: &[[f64; 2]], weights: Option<&[f64]>) -> BSpline {
    let points = points.iter().map(|p| p.to_vec()).collect();
    FloatCurve::bezier(points, weights.map(<[f64]>::to_vec))
        .exact()
        .expect("a curve")
}

fn assert_encloses(found: &Enclosure, distance: f64, scale: f64) {
    let (lower, upper) = (found.lower.to_f64(), found.upper.to_f64());
    assert!(
        lower <= distance + 1e-15 && distance <= upper + 1e-15,
        "{lower} {distance} {upper}"
    );
    assert!(upper - lower <= 1.001 * scale * RELATIVE_WIDTHS[0], "{lower} {upper}");
}

#[test]
fn to_points() {
    let parabola = curve(&[[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]], None);
    let target = |x: i64, y: i64| [Rational::from_integer(x.into()), Rational::from_integer(y.into())];
    let found = to_point(&parabola, &target(1, 3), 3.0);
    assert_encloses(&found, 2.0, 3.0);
    assert_eq!(found.parameters, [Rational::new(1.into(), 2.into())]);
    assert_encloses(&to_point(&parabola, &target(-3, -4), 4.0), 5.0, 4.0);
    assert_encloses(&to_point(&parabola, &target(1, 1), 2.0), 0.0, 2.0);
    // Every point of a quarter of the circle is as near to its centre.
    let quarter = curve(&[[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], Some(&[1.0, 1.0, 2.0]));
    let found = to_point(&quarter, &target(0, 0), 1.0);
    assert_eq!(found.upper_squared, Rational::from_integer(1.into()));
}

#[test]
fn between_curves() {
    let below = curve(&[[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]], None);
    let above = curve(&[[0.0, 4.0], [1.0, 2.0], [2.0, 4.0]], None);
    assert_encloses(&between(&below, &above, 4.0), 2.0, 4.0);
    let crossing = curve(&[[0.0, 1.0], [1.0, -1.0], [2.0, 1.0]], None);
    assert_encloses(&between(&below, &crossing, 2.0), 0.0, 2.0);
    // Two cubics whose distance is at most √(181/1024).
    let a = curve(&[[3.0, 2.0], [0.0, 1.0], [3.0, 4.0], [0.0, 0.0]], None);
    let b = curve(&[[2.0, 1.0], [5.0, 2.0], [2.0, 3.0], [5.0, 2.0]], None);
    let found = between(&a, &b, 5.0);
    assert!(found.upper_squared <= Rational::new(181.into(), 1024.into()));
    assert_encloses(&found, found.upper.to_f64(), 5.0);
    // Weights that grow along a curve: what tells in which direction to halve is the distance, not its product with them.
    let curved = curve(&[[5.0, -5.0], [0.0, 1.0], [3.0, -2.0]], None);
    let weighted = curve(&[[-2.0, 0.0], [3.0, -5.0], [1.0, -4.0]], Some(&[1e-3, 100.0, 1.0]));
    let found = between(&curved, &weighted, 5.0);
    assert_encloses(&found, 1.539_640_136_517_276_7, 5.0);
    // Weights of six orders of magnitude.
    let heavy = curve(&[[0.0, 4.0], [1.0, 2.0], [2.0, 4.0]], Some(&[1e-3, 1e3, 1.0]));
    let found = between(&below, &heavy, 4.0);
    assert_encloses(&found, found.upper.to_f64(), 4.0);
}

#[test]
fn curves_at_constant_distance() {
    // Arcs of two circles around the origin, and two parallel lines: too many parts for the first width, few enough for another.
    let arc = |r: f64| curve(&[[r, 0.0], [r, r], [0.0, r]], Some(&[1.0, 1.0, 2.0]));
    let line = |y: f64| curve(&[[0.0, y], [3.0, y]], None);
    for (a, b) in [(arc(1.0), arc(2.0)), (line(0.0), line(1.0))] {
        let found = between(&a, &b, 3.0);
        let (lower, upper) = (found.lower.to_f64(), found.upper.to_f64());
        assert!(lower <= 1.0 && upper >= 1.0 && lower > 1.0 - 1e-6, "{lower} {upper}");
        assert!(upper < 1.0 + 1e-12, "{upper}");
    }
}
