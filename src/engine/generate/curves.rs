//! Curves made at random.

use super::random::Random;
use crate::engine::FloatCurve;

/// What kind of curve is wanted.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    /// Of how many coordinates; any when nothing.
    pub(super) dimension: Option<usize>,
    /// A Bézier curve on [0, 1], so often of a hundred.
    pub(super) bezier: usize,
    /// With weights, so often of a hundred.
    pub(super) rational: usize,
    /// The highest degree.
    pub(super) degree: usize,
    /// The most spans.
    pub(super) spans: usize,
    /// Whether knots may be unclamped and clustered, coordinates large.
    pub(super) wild: bool,
}

/// How coordinates are drawn.
#[derive(Clone, Copy)]
pub(super) enum Coordinates {
    Small,
    Dyadic,
    Full,
    Large,
    FarAway,
}

impl Coordinates {
    pub(super) fn choose(random: &mut Random, wild: bool) -> Coordinates {
        match random.weighted(if wild { &[50, 15, 15, 10, 10] } else { &[65, 20, 15] }) {
            0 => Coordinates::Small,
            1 => Coordinates::Dyadic,
            2 => Coordinates::Full,
            3 => Coordinates::Large,
            _ => Coordinates::FarAway,
        }
    }

    pub(super) fn draw(self, random: &mut Random) -> f64 {
        match self {
            Coordinates::Small => random.whole(-5, 5) as f64,
            Coordinates::Dyadic => random.whole(-128, 128) as f64 / 16.0,
            Coordinates::Full => 2.0 * random.unit() - 1.0,
            Coordinates::Large => random.whole(-(1 << 40), 1 << 40) as f64,
            // Far from the origin: differences of neighbours lose half of the digits.
            Coordinates::FarAway => (1 << 26) as f64 + random.unit(),
        }
    }

    pub(super) fn point(self, random: &mut Random, dimension: usize) -> Vec<f64> {
        (0..dimension).map(|_| self.draw(random)).collect()
    }
}

/// A curve of the kind wanted; it is valid.
pub(super) fn curve(random: &mut Random, wanted: Wanted) -> FloatCurve {
    let dimension = wanted
        .dimension
        .unwrap_or_else(|| if random.chance(60) { 2 } else { 3 });
    let coordinates = Coordinates::choose(random, wanted.wild);
    let bezier = random.chance(wanted.bezier);
    let degree = degree(random, bezier, wanted.degree);
    let knots = if bezier {
        let mut knots = vec![0.0; degree + 1];
        knots.extend(vec![1.0; degree + 1]);
        knots
    } else {
        knots(random, degree, wanted)
    };
    let count = knots.len() - degree - 1;
    let points = (0..count).map(|_| coordinates.point(random, dimension)).collect();
    let weights = random.chance(wanted.rational).then(|| weights(random, count));
    FloatCurve {
        degree,
        knots,
        points,
        weights,
    }
}

/// A curve whose control points lie near a parabola, or a twisted cubic, so that its curvature or torsion has one sign more often than not: the curve, and
/// whether that sign is positive.
pub(super) fn turning(random: &mut Random) -> (FloatCurve, bool) {
    let dimension = if random.chance(60) { 2 } else { 3 };
    let degree = dimension + random.weighted(&[40, 35, 25]);
    let spans = if random.chance(60) {
        1
    } else {
        random.whole(2, 3) as usize
    };
    let mut knots = vec![0.0; degree + 1];
    knots.extend((1..spans).map(|i| i as f64 / spans as f64));
    knots.extend(vec![1.0; degree + 1]);
    let count = degree + spans;
    // Whole numbers, or full ones.
    let noise = |random: &mut Random, whole: bool| match whole {
        true => random.whole(-1, 1) as f64,
        false => 2.0 * random.unit() - 1.0,
    };
    let (whole, mirrored) = (random.chance(50), random.chance(50));
    let points = (0..count).map(|k| {
        let t = k as f64 - (count / 2) as f64;
        let mut point: Vec<f64> = [6.0 * t, 4.0 * t * t, 2.0 * t * t * t][..dimension]
            .iter()
            .map(|x| x + noise(random, whole))
            .collect();
        if mirrored {
            point[0] = -point[0];
        }
        point
    });
    let points = points.collect();
    let weights = random
        .chance(25)
        .then(|| (0..count).map(|_| random.whole(2, 4) as f64).collect());
    let curve = FloatCurve {
        degree,
        knots,
        points,
        weights,
    };
    (curve, !mirrored)
}

/// Low degrees more often, Bézier curves now and then of a degree up to 25.
fn degree(random: &mut Random, bezier: bool, most: usize) -> usize {
    if bezier && most > 9 && random.chance(10) {
        return random.whole(10, most as i64) as usize;
    }
    let all = [10, 20, 30, 12, 8, 5, 5, 5, 5];
    1 + random.weighted(&all[..most.min(9)])
}

fn weights(random: &mut Random, count: usize) -> Vec<f64> {
    match random.weighted(&[40, 30, 30]) {
        0 => (0..count).map(|_| random.whole(1, 4) as f64).collect(),
        // Six orders of magnitude.
        1 => (0..count).map(|_| 10_f64.powi(random.whole(-3, 3) as i32)).collect(),
        _ => (0..count).map(|_| 10_f64.powf(6.0 * random.unit() - 3.0)).collect(),
    }
}

/// Clamped or unclamped knots over uniform, uneven or clustered breakpoints, interior ones of any multiplicity up to the degree.
fn knots(random: &mut Random, degree: usize, wanted: Wanted) -> Vec<f64> {
    let breakpoints = breakpoints(random, wanted);
    let unclamped = wanted.wild && random.chance(25);
    let mut knots = Vec::new();
    let (start, end) = (breakpoints[0], breakpoints[breakpoints.len() - 1]);
    let gap = 2_f64.powi(random.whole(-2, 1) as i32);
    if unclamped {
        // The start occurs `m` times, other knots lie before it.
        let m = random.whole(1, degree as i64) as usize;
        for j in 0..=degree - m {
            if j < degree + 1 - m {
                knots.push(start - gap * (degree + 1 - m - j) as f64);
            }
        }
        knots.extend(vec![start; m]);
    } else {
        knots.extend(vec![start; degree + 1]);
    }
    let simple = random.chance(60);
    for t in &breakpoints[1..breakpoints.len() - 1] {
        let m = if simple {
            1
        } else {
            random.whole(1, degree as i64) as usize
        };
        knots.extend(vec![*t; m]);
    }
    if unclamped {
        let m = random.whole(1, degree as i64) as usize;
        knots.extend(vec![end; m]);
        knots.extend((1..=degree + 1 - m).map(|j| end + gap * j as f64));
    } else {
        knots.extend(vec![end; degree + 1]);
    }
    knots
}

fn breakpoints(random: &mut Random, wanted: Wanted) -> Vec<f64> {
    let spans = 1 + random.below(wanted.spans);
    let kinds: &[usize] = if wanted.wild { &[25, 35, 15, 15, 10] } else { &[40, 60] };
    match random.weighted(kinds) {
        0 => (0..=spans).map(|i| i as f64).collect(),
        1 => (0..=spans).map(|i| i as f64 / spans as f64).collect(),
        2 => sums(0.0, (0..spans).map(|_| random.whole(1, 16) as f64 / 8.0)),
        // Clusters: gaps down to 2^-30 beside gaps of about 1.
        3 => {
            let gaps = (0..spans).map(|_| {
                let exponent = if random.chance(50) { -random.whole(8, 30) } else { 0 };
                2_f64.powi(exponent as i32)
            });
            sums(0.0, gaps)
        }
        _ => {
            let gaps: Vec<f64> = (0..spans).map(|_| 0.01 + random.unit()).collect();
            sums(10.0 * random.unit() - 5.0, gaps.into_iter())
        }
    }
}

fn sums(start: f64, gaps: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut at = start;
    let mut breakpoints = vec![start];
    for gap in gaps {
        at += gap;
        breakpoints.push(at);
    }
    breakpoints
}
