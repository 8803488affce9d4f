//! Cases made from a seed.
//!
//! Curves of degrees 1 to 9 (Bézier curves to 25), planar and spatial; knots clamped and unclamped, uniform, uneven and clustered, of every
//! multiplicity; weights over six orders of magnitude; coordinates small integers, full binary64, large, and far from the origin.
//! Parameters at knots, one unit in the last place beside them, and between. Or curves of a corpus instead of made ones. The same seed
//! gives the same cases everywhere, and the first cases do not depend on how many are asked for.

mod curves;
mod random;
mod removable;

use curves::{Coordinates, Wanted};
use random::Random;

use super::{Case, CaseSide, CasesFile, FloatCurve, Operation};
use crate::curve::{BSpline, Curve, Form, MAXIMUM_DEGREE};

/// The operations that cases can be made for.
pub const GENERATED: [&str; 13] = [
    "point",
    "derivative",
    "curvature",
    "torsion",
    "insert_knot",
    "remove_knot",
    "elevate_degree",
    "split",
    "decompose",
    "nearest_point",
    "curve_distance",
    "msd",
    ONLY_NAMED,
];
/// Made only when it is named: few engines have anything of the kind.
const ONLY_NAMED: &str = "convex_domain";

/// What cases to make.
#[derive(Debug, Clone)]
pub struct Options {
    /// The seed.
    pub seed: u64,
    /// How many cases.
    pub count: usize,
    /// Which operations, by turns: some of [`GENERATED`]; all of them but `convex_domain` when empty.
    pub operations: Vec<&'static str>,
    /// Curves to ask about; made ones when empty.
    pub curves: Vec<FloatCurve>,
}

/// The curves of a corpus in binary64: a B-spline with its numbers rounded, Bézier pieces one by one.
///
/// Curves that are none any more once rounded (knots that fall together) are left out.
pub fn float_curves(curve: &Curve) -> Vec<FloatCurve> {
    let curves = match curve.form() {
        Form::BSpline(spline) => vec![FloatCurve::rounded(spline)],
        Form::Bezier(pieces) => pieces
            .iter()
            .map(|piece| {
                let points = piece.points().to_f64s();
                let points = points.chunks(piece.dimension()).map(<[f64]>::to_vec).collect();
                FloatCurve::bezier(points, piece.weights().map(|weights| weights.to_f64s()))
            })
            .collect(),
    };
    curves.into_iter().filter(|curve| curve.exact().is_ok()).collect()
}

/// Makes the cases. Every one is valid: the strict reader accepts what is written of them.
pub fn generate(options: &Options) -> CasesFile {
    let usual: Vec<&str> = GENERATED.into_iter().filter(|name| *name != ONLY_NAMED).collect();
    let operations: &[&str] = match options.operations.as_slice() {
        [] => &usual,
        some => some,
    };
    let cases = (0..options.count).map(|i| {
        let name = operations[i % operations.len()];
        let mut random = Random::new(options.seed, i as u64);
        let (curve, operation) = case(&mut random, name, &options.curves);
        Case {
            id: format!("{name}-{i}"),
            operation,
            curve,
        }
    });
    CasesFile {
        seed: Some(options.seed),
        cases: cases.collect(),
    }
}

const ANY: Wanted = Wanted {
    dimension: None,
    bezier: 40,
    rational: 45,
    degree: 25,
    spans: 5,
    wild: true,
};
/// Curves for distances: simple enough that an exact enclosure is quick.
const SIMPLE: Wanted = Wanted {
    dimension: None,
    bezier: 70,
    rational: 20,
    degree: 4,
    spans: 3,
    wild: false,
};

fn case(random: &mut Random, name: &str, corpus: &[FloatCurve]) -> (FloatCurve, Operation) {
    if name == ONLY_NAMED
        && let Some(case) = domain(random, corpus)
    {
        return case;
    }
    let wanted = match name {
        "torsion" => Wanted {
            dimension: Some(3),
            ..ANY
        },
        "curvature" => Wanted { degree: 9, ..ANY },
        "elevate_degree" | "decompose" => Wanted { bezier: 20, ..ANY },
        "nearest_point" => Wanted { degree: 6, ..SIMPLE },
        "curve_distance" => SIMPLE,
        "msd" => Wanted {
            bezier: 30,
            rational: 0,
            ..SIMPLE
        },
        _ => ANY,
    };
    let curve = pick(random, corpus, wanted);
    let operation = match name {
        "derivative" => Operation::Derivative {
            parameter: parameter(random, &curve, false),
            order: 1 + random.weighted(&[60, 30, 10]),
            side: side(random),
        },
        "curvature" => Operation::Curvature {
            parameter: parameter(random, &curve, false),
            side: side(random),
        },
        "torsion" if curve.dimension() == 3 => Operation::Torsion {
            parameter: parameter(random, &curve, false),
            side: side(random),
        },
        "insert_knot" => match insertion(random, &curve) {
            Some(operation) => operation,
            None => Operation::ElevateDegree { times: 1 },
        },
        "remove_knot" => return removable::case(random),
        "elevate_degree" => {
            let most = (MAXIMUM_DEGREE - curve.degree).min(3);
            let times = 1 + random.below(most);
            Operation::ElevateDegree { times }
        }
        "split" => Operation::Split {
            parameter: parameter(random, &curve, true),
        },
        "decompose" => Operation::Decompose,
        "nearest_point" => {
            let coordinates = Coordinates::choose(random, false);
            let target = coordinates.point(random, curve.dimension());
            Operation::NearestPoint { target }
        }
        "curve_distance" => {
            let dimension = Some(curve.dimension());
            let other = pick(random, corpus, Wanted { dimension, ..wanted });
            if other.dimension() == curve.dimension() {
                Operation::CurveDistance { other: Box::new(other) }
            } else {
                Operation::CurveDistance {
                    other: Box::new(curve.clone()),
                }
            }
        }
        "msd" => Operation::Msd,
        // Points, and what a curve of the corpus does not admit.
        _ => Operation::Point {
            parameter: parameter(random, &curve, false),
        },
    };
    (curve, operation)
}

/// A control point of a curve that turns, or twists, one way for the most part; nothing when the corpus has none of a sufficient degree.
fn domain(random: &mut Random, corpus: &[FloatCurve]) -> Option<(FloatCurve, Operation)> {
    let fitting: Vec<&FloatCurve> = corpus
        .iter()
        .filter(|curve| curve.degree >= curve.dimension())
        .collect();
    let (curve, positive) = match fitting.len() {
        0 if corpus.is_empty() => curves::turning(random),
        0 => return None,
        count => (fitting[random.below(count)].clone(), random.chance(50)),
    };
    let size = curve.points.iter().flatten().fold(1.0_f64, |most, x| most.max(x.abs()));
    let half_width =
        2_f64.powi(size.log2().ceil() as i32 - random.whole(0, 4) as i32) * random.whole(3, 5) as f64 / 4.0;
    let operation = Operation::ConvexDomain {
        point: random.below(curve.points.len()),
        half_width,
        level: random.weighted(&[20, 25, 25, 20, 10]) as u32,
        positive: if random.chance(85) { positive } else { !positive },
    };
    Some((curve, operation))
}

fn side(random: &mut Random) -> CaseSide {
    if random.chance(50) {
        CaseSide::Left
    } else {
        CaseSide::Right
    }
}

/// A curve of the corpus, or a made one.
fn pick(random: &mut Random, corpus: &[FloatCurve], wanted: Wanted) -> FloatCurve {
    let fitting: Vec<&FloatCurve> = corpus
        .iter()
        .filter(|curve| wanted.dimension.is_none_or(|dimension| curve.dimension() == dimension))
        .collect();
    match fitting.len() {
        0 if corpus.is_empty() => curves::curve(random, wanted),
        0 => corpus[random.below(corpus.len())].clone(),
        count => fitting[random.below(count)].clone(),
    }
}

/// A parameter of the domain: at a knot, beside one, or between; strictly `inside` when that is asked for.
fn parameter(random: &mut Random, curve: &FloatCurve, inside: bool) -> f64 {
    let domain = &curve.knots[curve.degree..curve.knots.len() - curve.degree];
    let (start, end) = (domain[0], domain[domain.len() - 1]);
    let knot = domain[random.below(domain.len())];
    let at = match random.weighted(&[25, 10, 10, 15, 40]) {
        0 => knot,
        // Beside 0 by a unit of the domain's length: the numbers next to 0 itself are too small for any curve.
        1 if knot == 0.0 => (end - start) * f64::EPSILON,
        2 if knot == 0.0 => (start - end) * f64::EPSILON,
        1 => knot.next_up(),
        2 => knot.next_down(),
        3 => start + (end - start) * random.whole(1, 7) as f64 / 8.0,
        _ => start + (end - start) * random.unit(),
    };
    let at = at.clamp(start, end);
    if inside && (at == start || at == end) {
        // The middle of a domain of neighbouring numbers is one of its ends: such domains are not made.
        return start + (end - start) / 2.0;
    }
    at
}

fn insertion(random: &mut Random, curve: &FloatCurve) -> Option<Operation> {
    let parameter = parameter(random, curve, true);
    let present = curve.knots.iter().filter(|t| **t == parameter).count();
    let room = curve.degree.saturating_sub(present);
    (room > 0).then(|| Operation::InsertKnot {
        parameter,
        times: 1 + random.below(room),
    })
}

/// A valid curve from exact numbers over binary64, when it is one.
fn representing(spline: &BSpline) -> Option<FloatCurve> {
    FloatCurve::representing(spline)
}

#[cfg(test)]
mod tests;
