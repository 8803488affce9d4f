//! Random hard curves for the tests, and their exact counterparts.

use super::Curve;
use crate::curve::BSpline;
use crate::number::{Rational, RationalExt, RationalVector};

/// A small generator of pseudo-random numbers (splitmix64; Steele, Lea, Flood 2014).
pub struct Random(pub u64);

impl Random {
    /// 64 random bits.
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// An integer from 0 to `end` − 1.
    pub fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }

    /// A number from 0 to 1.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 * 2f64.powi(-53)
    }

    /// A number from −1 to 1.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }
}

/// A coordinate: a small integer, a large one with small differences, a decimal, or full 53 bits.
fn coordinate(random: &mut Random, kind: usize) -> f64 {
    let small = random.below(21) as f64 - 10.0;
    match kind {
        0 => small,
        1 => 1e8 + small,
        2 => (random.below(2001) as f64 - 1000.0) / 10.0,
        _ => 10.0 * random.signed(),
    }
}

/// A distance between neighbouring distinct knots: usual, tiny, or none but one unit in the last place.
fn next_knot(random: &mut Random, knot: f64, clustered: bool) -> f64 {
    match random.below(if clustered { 4 } else { 2 }) {
        0 => knot + 1.0,
        1 => knot + random.unit() + 0.01,
        // Beside 0 there are numbers too small to divide by.
        2 => knot.next_up().max(knot + 2f64.powi(-60)),
        _ => knot + 1e-9,
    }
}

/// A curve of degree 1 to `highest`: clamped or not, with interior knots of every multiplicity, weights none, moderate or over six orders of
/// magnitude; one in eight is a Bézier piece of degree up to 25.
pub fn curve(random: &mut Random, highest: usize) -> Curve {
    let dimension = 2 + random.below(2);
    let bezier = random.below(8) == 0;
    let degree = 1 + random.below(if bezier { 25 } else { highest });
    let clustered = random.below(2) == 0;
    let mut knots = Vec::new();
    let mut knot = f64::from(random.below(3) as u32);
    if bezier {
        knots = vec![0.0; degree + 1];
        knots.extend(vec![1.0; degree + 1]);
    } else {
        let clamped = random.below(3) > 0;
        if clamped {
            knots.extend(vec![knot; degree + 1]);
        } else {
            for _ in 0..=degree {
                knots.push(knot);
                knot = next_knot(random, knot, clustered);
            }
        }
        for _ in 0..random.below(6) {
            knot = next_knot(random, knot, clustered);
            knots.extend(vec![knot; 1 + random.below(degree)]);
        }
        if clamped {
            knot = next_knot(random, knot, clustered);
            knots.extend(vec![knot; degree + 1]);
        } else {
            for _ in 0..=degree {
                knot = next_knot(random, knot, clustered);
                knots.push(knot);
            }
        }
    }
    let count = knots.len() - degree - 1;
    let kind = random.below(4);
    let points = (0..count * dimension).map(|_| coordinate(random, kind)).collect();
    let weights = match random.below(3) {
        0 => None,
        1 => Some((0..count).map(|_| 0.5 + random.unit()).collect()),
        _ => Some((0..count).map(|_| 10f64.powf(3.0 * random.signed())).collect()),
    };
    Curve::new(dimension, degree, knots, points, weights).expect("a valid curve")
}

/// A parameter of the domain: at, beside or between knots.
pub fn parameter(random: &mut Random, curve: &Curve) -> f64 {
    let (start, end) = curve.domain();
    let inside = &curve.knots()[curve.degree()..=curve.count()];
    let knot = inside[random.below(inside.len())];
    let t = match random.below(6) {
        0 => knot,
        1 => knot.next_up(),
        2 => knot.next_down(),
        3 => {
            let i = random.below(inside.len() - 1);
            inside[i] + (inside[i + 1] - inside[i]) * random.unit()
        }
        _ => start + (end - start) * random.unit(),
    };
    t.clamp(start, end)
}

/// A float as a fraction.
pub fn exact(x: f64) -> Rational {
    Rational::from_f64(x).expect("finite")
}

fn vector(numbers: &[f64]) -> RationalVector {
    let numbers: Vec<Rational> = numbers.iter().map(|x| exact(*x)).collect();
    RationalVector::from_rationals(&numbers)
}

/// The exact curve with the same numbers.
pub fn spline(curve: &Curve) -> BSpline {
    BSpline::new(
        curve.dimension(),
        curve.degree(),
        vector(curve.knots()),
        vector(curve.points()),
        curve.weights().map(vector),
    )
    .expect("a valid curve")
}
