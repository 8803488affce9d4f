//! Arcs of circles and ellipses as rational quadratics.

use super::angle::Rotation;
use crate::import::build::{Point, RawPiece};
use crate::import::text::{abs, ratio, whole};
use crate::number::{Rational, simplest_between, sqrt_enclosure};

/// A centre that is no fraction is replaced by one at a relative distance below 2 to the power −CENTRE_BITS.
const CENTRE_BITS: u32 = 40;

/// An elliptic arc as SVG describes it: end points, half axes, the direction of the first one, and two flags.
#[derive(Debug, Clone)]
pub(super) struct Arc<'a> {
    pub(super) start: &'a Point,
    pub(super) end: &'a Point,
    /// The half axes; signs do not count.
    pub(super) radii: [&'a Rational; 2],
    /// From the x axis to the first axis.
    pub(super) rotation: &'a Rotation,
    /// Of the arcs of the ellipse between the end points, the longer one.
    pub(super) large: bool,
    /// In the direction from the x axis to the y axis.
    pub(super) sweep: bool,
}

/// The pieces of an arc, and a bound of their distance from it when they are not it.
pub(super) struct Drawn {
    pub(super) pieces: Vec<RawPiece>,
    pub(super) bound: Option<Rational>,
}

type Vector = [Rational; 2];

fn dot(a: &Vector, b: &Vector) -> Rational {
    &a[0] * &b[0] + &a[1] * &b[1]
}

fn cross(a: &Vector, b: &Vector) -> Rational {
    &a[0] * &b[1] - &a[1] * &b[0]
}

fn add(a: &Vector, b: &Vector) -> Vector {
    [&a[0] + &b[0], &a[1] + &b[1]]
}

fn subtract(a: &Vector, b: &Vector) -> Vector {
    [&a[0] - &b[0], &a[1] - &b[1]]
}

fn scaled(a: &Vector, factor: &Rational) -> Vector {
    [&a[0] * factor, &a[1] * factor]
}

/// By 90° from the x axis to the y axis.
fn quarter(a: &Vector) -> Vector {
    [-&a[1], a[0].clone()]
}

/// Draws an arc. A radius 0 makes it a line, ends that coincide nothing, radii that are too small are enlarged together, all this
/// as SVG prescribes.
///
/// Axes turned by an angle that is no multiple of 90° are turned by one near it instead.
///
/// # Errors
/// In words, when such axes differ in length so much that the error of the angle is all that matters.
pub(super) fn draw(arc: &Arc) -> Result<Drawn, String> {
    let exact = |pieces| Ok(Drawn { pieces, bound: None });
    let radii = arc.radii.map(abs);
    if arc.start == arc.end {
        return exact(Vec::new());
    }
    if radii.iter().any(|radius| radius.numer().is_zero()) {
        return exact(vec![RawPiece::polynomial([arc.start.clone(), arc.end.clone()])]);
    }
    // Of a circle the rotation does not matter.
    let (cosine, sine, turn) = match radii[0] == radii[1] {
        true => (whole(1), whole(0), whole(0)),
        false => {
            let Rotation { cosine, sine, error } = arc.rotation;
            (cosine.clone(), sine.clone(), error.clone())
        }
    };
    // The frame in which the ellipse is the unit circle.
    let inward = |p: &Point| {
        [
            (&cosine * &p[0] + &sine * &p[1]) / &radii[0],
            (&cosine * &p[1] - &sine * &p[0]) / &radii[1],
        ]
    };
    let outward = |p: &Vector| -> Point {
        let [x, y] = [&p[0] * &radii[0], &p[1] * &radii[1]];
        vec![&cosine * &x - &sine * &y, &sine * &x + &cosine * &y]
    };
    let (p, q) = (inward(arc.start), inward(arc.end));
    let chord = subtract(&q, &p);
    let square = dot(&chord, &chord);
    // What the error of the angle makes of the chord.
    let (least, greatest) = sqrt_enclosure(&square, CENTRE_BITS);
    let (x, y) = (&arc.end[0] - &arc.start[0], &arc.end[1] - &arc.start[1]);
    let (smaller, larger) = match radii[0] < radii[1] {
        true => (&radii[0], &radii[1]),
        false => (&radii[1], &radii[0]),
    };
    let slack = &turn * (abs(&x) + abs(&y)) / smaller;
    if slack >= least {
        return Err(
            "found an elliptic arc whose turned axes differ by a factor of more than 10^10, expected axes nearer to each other in length".into(),
        );
    }
    let (shortest, longest) = match slack.numer().is_zero() {
        true => (square.clone(), square.clone()),
        false => {
            let (shortest, longest) = (&least - &slack, &greatest + &slack);
            (&shortest * &shortest, &longest * &longest)
        }
    };
    // The centre is the middle plus h times the chord turned by 90°, h² = 1/d² − 1/4; where the radii do not reach they are enlarged, and it is the middle.
    let height_squared = |square: &Rational| match whole(1) / square - ratio(1, 4) {
        height if height.numer().is_positive() => height,
        _ => whole(0),
    };
    let lower = sqrt_enclosure(&height_squared(&longest), CENTRE_BITS).0;
    let upper = sqrt_enclosure(&height_squared(&shortest), CENTRE_BITS).1;
    let width = &upper - &lower;
    let mut height = simplest_between(&lower, &upper);
    if arc.large == arc.sweep {
        height = -height;
    }
    let middle = scaled(&add(&p, &q), &ratio(1, 2));
    let centre = add(&middle, &scaled(&quarter(&chord), &height));
    let mut pieces = walk(
        &centre,
        &subtract(&p, &centre),
        &subtract(&q, &centre),
        arc.sweep,
        &outward,
    );
    // The ends are those of the file, whatever way the numbers took.
    if let Some(last) = pieces.last_mut().and_then(|piece| piece.points.last_mut()) {
        last.clone_from(arc.end);
    }
    let moved = !width.numer().is_zero() || !turn.numer().is_zero();
    let bound = moved.then(|| {
        let deviation = Deviation {
            chord: greatest + &slack,
            chord_error: slack,
            lower,
            upper,
            turn,
        };
        deviation.bound() * larger
    });
    Ok(Drawn { pieces, bound })
}

/// What is uncertain about an arc in the frame in which its ellipse is the unit circle.
struct Deviation {
    /// The length d of the chord is at most this.
    chord: Rational,
    /// The chord differs by at most this.
    chord_error: Rational,
    /// The centre's height over the chord divided by d, in [`lower`, `upper`].
    lower: Rational,
    upper: Rational,
    /// The angle of the axes differs by at most this.
    turn: Rational,
}

impl Deviation {
    /// How far the arc drawn and the one asked for are from each other, divided by the larger half axis.
    ///
    /// Both start in the same point P of the plane. With x a point of one of the arcs seen from its start in the frame, it is in the plane P + R S x, R the turn of the axes and S the scaling by the half axes, so that for points x, y of the two arcs
    /// |R S x − R′ S y| ≤ (|R − R′| |x| + |x − y|) |S|, with |R − R′| at most the angle between them and |x| at most a diameter. As complex numbers x = c a and y = c′ a′, c and c′ the chords, a and a′ points of arcs over the chord from 0 to 1:
    /// |x − y| ≤ |c − c′| |a| + |c′| |a − a′|, where |a| is at most the diameter 2 √(1/4 + h²).
    ///
    /// Let the arcs of a and a′ be parametrised by the angle from the bisector of the chord, in proportion. Points of equal parameter differ at most by the distance of the centres (≤ the difference of h), plus that of the radii (no more), plus
    /// a radius times half the difference of the angles, which are 2 arccot 2h with the derivative −4/(1 + 4h²).
    fn bound(&self) -> Rational {
        let relative = sqrt_enclosure(&(&self.upper * &self.upper + ratio(1, 4)), CENTRE_BITS).1;
        let radius = &relative * &self.chord;
        let width = &self.upper - &self.lower;
        let slope = whole(2) / (whole(1) + whole(4) * &self.lower * &self.lower);
        width * (whole(2) * &self.chord + slope * &radius)
            + whole(2) * &self.turn * radius
            + whole(2) * &self.chord_error * relative
    }
}

/// The pieces from `from` to `to` around the centre, in its frame: quarters, and a last one of at most 120°.
fn walk(centre: &Vector, from: &Vector, to: &Vector, sweep: bool, outward: &dyn Fn(&Vector) -> Point) -> Vec<RawPiece> {
    let square = dot(from, from);
    let mut at = from.clone();
    let mut pieces = Vec::new();
    // At most three quarters stand before the last piece.
    for _ in 0..4 {
        let (cosine, sine) = (dot(&at, to), cross(&at, to));
        let forward = if sweep { sine } else { -sine };
        if forward.numer().is_positive() && !(whole(2) * &cosine + &square).numer().is_negative() {
            pieces.push(piece(centre, &at, to, &cosine, &square, outward));
            break;
        }
        let next = match sweep {
            true => quarter(&at),
            false => scaled(&quarter(&at), &whole(-1)),
        };
        pieces.push(piece(centre, &at, &next, &whole(0), &square, outward));
        at = next;
    }
    pieces
}

/// One piece from centre + u to centre + v, |u|² = |v|² = `square`, u·v = `cosine` > −`square`: the middle control point is
/// centre + (u + v)/(1 + cos θ), the weights are 1, 1, 2/(1 + cos θ).
fn piece(
    centre: &Vector,
    u: &Vector,
    v: &Vector,
    cosine: &Rational,
    square: &Rational,
    outward: &dyn Fn(&Vector) -> Point,
) -> RawPiece {
    let sum = square + cosine;
    let middle = scaled(&add(u, v), &(square / &sum));
    let points = [u, &middle, v].map(|vector| outward(&add(centre, vector)));
    RawPiece {
        points: points.into(),
        weights: Some(vec![whole(1), whole(1), whole(2) * square / sum]),
    }
}

#[cfg(test)]
mod tests {
    use super::super::angle::rotation;
    use super::*;
    use crate::curve::{Curve, Form};
    use crate::import::Options;
    use crate::import::build::{RawPath, finish};
    use crate::number::RationalExt;
    use proptest::prelude::*;

    fn point(x: i64, y: i64) -> Point {
        vec![whole(x), whole(y)]
    }

    fn drawn(start: &Point, end: &Point, radii: [i64; 2], degrees: i64, large: bool, sweep: bool) -> Drawn {
        draw(&Arc {
            start,
            end,
            radii: [&whole(radii[0]), &whole(radii[1])],
            rotation: &rotation(&whole(degrees)),
            large,
            sweep,
        })
        .unwrap()
    }

    fn curve(pieces: Vec<RawPiece>) -> Curve {
        let path = RawPath {
            pieces,
            ..RawPath::default()
        };
        finish(path, &Options::default()).unwrap().unwrap().0
    }

    #[test]
    fn a_quarter_of_a_circle() {
        let Drawn { pieces, bound } = drawn(&point(4, 0), &point(0, 4), [4, 4], 0, false, true);
        assert_eq!(bound, None);
        let [piece] = &pieces[..] else { panic!("{pieces:?}") };
        assert_eq!(piece.points, [point(4, 0), point(4, 4), point(0, 4)]);
        assert_eq!(piece.weights, Some(vec![whole(1), whole(1), whole(2)]));
        // The other way round it is three quarters around another centre, or the same one.
        for (large, sweep, count, middle) in [
            (true, true, 3, point(8, 4)),
            (false, false, 1, point(0, 0)),
            (true, false, 3, point(4, -4)),
        ] {
            let Drawn { pieces, bound } = drawn(&point(4, 0), &point(0, 4), [4, 4], 0, large, sweep);
            assert_eq!((pieces.len(), bound), (count, None));
            if count == 1 {
                assert_eq!(pieces[0].points[1], middle);
            }
        }
    }

    #[test]
    fn radii_too_small_are_enlarged_and_stay_exact() {
        let Drawn { pieces, bound } = drawn(&point(0, 0), &point(10, 0), [1, 1], 0, false, false);
        assert_eq!((pieces.len(), bound), (2, None));
        // With a negative sense the half circle lies on the side of positive y.
        assert_eq!(pieces[0].points[2], point(5, 5));
        let Drawn { pieces, bound } = drawn(&point(0, 0), &point(10, 0), [2, 1], 90, true, true);
        assert_eq!((pieces.len(), bound), (2, None));
        assert_eq!(pieces[0].points[2], point(5, -10));
    }

    #[test]
    fn special_cases() {
        let Drawn { pieces, .. } = drawn(&point(1, 1), &point(1, 1), [5, 5], 0, true, true);
        assert!(pieces.is_empty());
        let Drawn { pieces, .. } = drawn(&point(1, 1), &point(2, 1), [0, 5], 0, true, true);
        assert_eq!(pieces, [RawPiece::polynomial([point(1, 1), point(2, 1)])]);
        let turned = Arc {
            start: &point(0, 0),
            end: &point(1, 0),
            radii: [&whole(2), &whole(3)],
            rotation: &rotation(&whole(30)),
            large: false,
            sweep: true,
        };
        let bound = draw(&turned).unwrap().bound.unwrap();
        assert!(bound > whole(0) && bound < ratio(1, 1_000_000_000));
        // A chord along the longer axis of a needle.
        let needle = Arc {
            end: &vec![turned.rotation.cosine.clone(), turned.rotation.sine.clone()],
            radii: [&whole(10_000_000_000_000), &whole(1)],
            ..turned.clone()
        };
        assert!(draw(&needle).is_err());
        let round = Arc {
            radii: [&whole(3), &whole(-3)],
            ..turned
        };
        assert!(draw(&round).is_ok());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn arcs_lie_on_their_ellipse_between_their_ends(
            x in -20i64..20, y in -20i64..20, a in 1i64..30, b in 1i64..30, degrees in 0i64..360, quarters: bool, large: bool, sweep: bool,
        ) {
            prop_assume!((x, y) != (0, 0));
            let (start, end) = (point(0, 0), point(x, y));
            let degrees = if quarters { degrees / 90 * 90 } else { degrees };
            let Drawn { pieces, bound } = drawn(&start, &end, [a, b], degrees, large, sweep);
            prop_assert!(pieces.len() <= 4);
            prop_assert_eq!(&pieces[0].points[0], &start);
            prop_assert_eq!(pieces.last().unwrap().points.last().unwrap(), &end);
            let bound = bound.map_or(0.0, |bound| bound.to_f64());
            // The ellipse by SVG's own formulas in binary64, F.6.5.
            let (mut rx, mut ry) = (a as f64, b as f64);
            let (sine, cosine) = (degrees as f64).to_radians().sin_cos();
            let frame = |x: f64, y: f64| (cosine * x + sine * y, cosine * y - sine * x);
            let (x1, y1) = frame(-x as f64 / 2.0, -y as f64 / 2.0);
            let reach = x1 * x1 / rx / rx + y1 * y1 / ry / ry;
            prop_assert!(bound < if (reach - 1.0).abs() < 1e-6 { 1e-3 } else { 1e-5 }, "{}", bound);
            if reach > 1.0 {
                rx *= reach.sqrt();
                ry *= reach.sqrt();
            }
            let under = (rx * rx * ry * ry) / (rx * rx * y1 * y1 + ry * ry * x1 * x1) - 1.0;
            let factor = under.max(0.0).sqrt() * if large == sweep { -1.0 } else { 1.0 };
            let centre = (factor * rx * y1 / ry - x1, -factor * ry * x1 / rx - y1);
            let curve = curve(pieces);
            let Form::Bezier(list) = curve.form() else { panic!() };
            let chain = curve.chain();
            let mut turned = 0.0;
            let mut before: Option<f64> = None;
            for k in 0..=(list.len() as i64 * 8) {
                let p: Vec<f64> = chain.evaluate(&ratio(k, 8)).unwrap().iter().map(|c| c.to_f64()).collect();
                let (u, v) = frame(p[0], p[1]);
                let (u, v) = ((u - centre.0) / rx, (v - centre.1) / ry);
                // Near a half circle the centre of binary64 is off by the root of its rounding.
                prop_assert!((u.hypot(v) - 1.0).abs() < 1e-6 + bound, "{} {}", u, v);
                let angle = v.atan2(u);
                if let Some(before) = before {
                    let step = (angle - before).rem_euclid(std::f64::consts::TAU);
                    turned += if step > std::f64::consts::PI { step - std::f64::consts::TAU } else { step };
                }
                before = Some(angle);
            }
            prop_assert!(turned > 0.0 && sweep || turned < 0.0 && !sweep);
            let half = std::f64::consts::PI;
            let fits = if large { turned.abs() > half - 1e-5 } else { turned.abs() < half + 1e-5 };
            prop_assert!(fits, "turned by {}", turned);
        }
    }
}
