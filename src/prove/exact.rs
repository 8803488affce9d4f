//! Finding a leaf where binary64 does not suffice: exact differences and products, rounded only for the choice of a witness.
//!
//! The witness is then put to the checker's own rule, so that nothing depends on the rounding.

use super::half_plane::{Rectangle, Signs, choose};
use super::vector::{Vector, dot, quantised, scale, sub};
use crate::check::cover::Context;
use crate::check::element::Node;
use crate::check::hull::{Gap, Hull};
use crate::check::tangents::Tangents;
use crate::check::word::{Word, dot as exact_dot};
use crate::claim::msd::Lower;
use crate::claim::tree::Leaf;
use crate::number::Integer;

/// x·2^-shift as a float.
fn float(x: &Integer, shift: i64) -> f64 {
    let (mantissa, exponent) = x.to_f64_exponent();
    mantissa * 2f64.powi((exponent - shift).clamp(-1070, 1000) as i32)
}

/// A chord between hull points, exactly and rounded.
struct Difference {
    exact: [Integer; 3],
    rounded: Vector,
}

/// All differences of hull points. The rounded ones have a common scale, and their true lengths are 2^scale times theirs.
fn differences(gap: &Gap<Integer>) -> (Vec<Difference>, i64) {
    let mut found: Vec<([Integer; 3], Integer)> = Vec::new();
    let all = gap.all_differences(|x, unit| {
        found.push((x.clone(), unit.clone()));
        Some(true)
    });
    debug_assert!(all.is_some());
    let (common, common_exponent) = gap.common.value().to_f64_exponent();
    let exponent = |x: &Integer, unit: &Integer| x.to_f64_exponent().1 - unit.to_f64_exponent().1;
    let most = found
        .iter()
        .flat_map(|(x, unit)| x.iter().filter(|x| !x.is_zero()).map(move |x| exponent(x, unit)))
        .max()
        .unwrap_or(0);
    let rounded = |x: &Integer, unit: &Integer| {
        let (unit_mantissa, unit_exponent) = unit.to_f64_exponent();
        float(x, unit_exponent + most) / unit_mantissa
    };
    let differences = found
        .into_iter()
        .map(|(exact, unit)| {
            let [x, y, z] = [0, 1, 2].map(|i| rounded(&exact[i], &unit) / common);
            Difference {
                exact,
                rounded: [x, y, z, 0.0],
            }
        })
        .collect();
    (differences, most - common_exponent)
}

/// Looks for any leaf that excludes the pair (A, B), or (A, A) when `b` is `None`; `length` is √lower_squared, rounded up.
pub fn leaf<'c>(
    context: &Context<'c>,
    a: &Node<'c>,
    b: Option<&Node<'c>>,
    lower: &Lower,
    length: f64,
    signs: [Signs; 2],
) -> Option<Leaf> {
    let holds = |leaf: &Leaf| context.obligation(a, b, leaf, lower).is_ok();
    let adjacent = b.is_none_or(|b| context.adjacent(a, b));
    if adjacent {
        cone(context, a, b)
            .filter(&holds)
            .or_else(|| bend(context, a, b, signs[1]).filter(&holds))
            .or_else(|| turn(context, a, b).filter(&holds))
    } else {
        let b = b?;
        let (hull_a, hull_b) = (Hull::<Integer>::new(context, a)?, Hull::new(context, b)?);
        let gap = Gap::new(&hull_a, &hull_b)?;
        let (differences, exponent) = differences(&gap);
        far(&differences, exponent, lower, length, &holds)
            .or_else(|| not_normal(context, a, b, &differences, signs[0]).filter(&holds))
    }
}

/// Looks for a leaf that excludes common points of the pair (A, B), or of (A, A) when `b` is `None`.
pub fn apart<'c>(context: &Context<'c>, a: &Node<'c>, b: Option<&Node<'c>>) -> Option<Leaf> {
    let holds = |leaf: &Leaf| context.apart(a, b, leaf).is_ok();
    let Some(other) = b.filter(|b| !context.adjacent(a, b)) else {
        let directions = directions(context, a, b)?;
        let n = super::vector::inner_direction(&directions);
        let leaf = |bits| Leaf::Monotone(quantised(&n, bits).map(Into::into));
        return [6u32, 20, 50].into_iter().map(leaf).find(holds);
    };
    let (hull_a, hull_b) = (Hull::<Integer>::new(context, a)?, Hull::new(context, other)?);
    let (differences, _) = differences(&Gap::new(&hull_a, &hull_b)?);
    let mean = differences.iter().fold([0.0; 4], |sum, difference| {
        super::vector::add(&sum, &difference.rounded)
    });
    let rounded: Vec<Vector> = differences.iter().map(|difference| difference.rounded).collect();
    let leaf = |n: &Vector, bits| Leaf::Separate(quantised(n, bits).map(Into::into));
    let nearest = super::vector::inner_direction(&rounded);
    let candidates = [6u32, 20, 50]
        .into_iter()
        .flat_map(|bits| [leaf(&nearest, bits), leaf(&mean, bits)]);
    candidates.into_iter().find(holds)
}

/// `far` along the shortest vector of the convex hull of the differences.
fn far(
    differences: &[Difference],
    exponent: i64,
    lower: &Lower,
    length: f64,
    holds: &impl Fn(&Leaf) -> bool,
) -> Option<Leaf> {
    if *lower == Lower::Infinite {
        return None;
    }
    let length = length * 2f64.powi((-exponent).clamp(-1000, 1000) as i32) * (1.0 - 1e-12);
    let mut x = differences.iter().fold([0.0; 4], |sum, difference| {
        super::vector::add(&sum, &difference.rounded)
    });
    x = scale(&x, 1.0 / differences.len() as f64);
    for _ in 0..40 {
        let norm = dot(&x, &x).sqrt();
        let support = differences
            .iter()
            .map(|d| d.rounded)
            .min_by(|p, q| dot(p, &x).total_cmp(&dot(q, &x)))?;
        if dot(&support, &x) >= length * norm {
            let found = [4u32, 12, 26, 50]
                .into_iter()
                .map(|bits| Leaf::Far(quantised(&x, bits).map(Into::into)))
                .find(holds);
            if found.is_some() {
                return found;
            }
        }
        let step = sub(&x, &support);
        let square = dot(&step, &step);
        let fraction = if square > 0.0 {
            (dot(&x, &step) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        if fraction <= 0.0 || norm < length {
            return None;
        }
        x = sub(&x, &scale(&step, fraction));
    }
    None
}

/// Least and greatest of the products x·v over all v of the tangents, in units of their scales, as floats over 2^shift.
fn range(x: &[Integer; 3], tangents: &Tangents<Integer>, shift: i64) -> [f64; 2] {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for (vectors, scale) in tangents.groups() {
        let (odd, odd_exponent) = scale.odd.to_f64_exponent();
        for v in vectors {
            let product = exact_dot(x, v).expect("unbounded integers do not overflow");
            let value = float(&product, shift + odd_exponent + i64::from(scale.exponent)) / odd;
            range = [range[0].min(value), range[1].max(value)];
        }
    }
    range
}

/// Factors for rectangles of products of `xs` with the tangents of both sides.
fn factors<'x>(
    xs: impl Iterator<Item = &'x [Integer; 3]> + Clone,
    of_a: &Tangents<Integer>,
    of_b: &Tangents<Integer>,
    signs: Signs,
) -> Option<[Integer; 2]> {
    let size = |tangents: &Tangents<Integer>| {
        let bits = |(vectors, scale): (&[[Integer; 3]], crate::check::chain::ScaleRef)| {
            let most = vectors.iter().flatten().map(Word::bit_length).max().unwrap_or(0);
            i64::from(most) - scale.odd.bits() as i64 - i64::from(scale.exponent)
        };
        tangents.groups().map(bits).max().unwrap_or(0)
    };
    let shift = size(of_a).max(size(of_b));
    let rectangles: Vec<Rectangle> = xs
        .map(|x| {
            let shift = shift + x.iter().map(|c| c.bits() as i64).max().unwrap_or(0);
            Rectangle {
                a: range(x, of_a, shift),
                b: range(x, of_b, shift),
            }
        })
        .collect();
    choose(&rectangles, [0.0, 0.0], signs).map(|factors| factors.map(Into::into))
}

fn not_normal(context: &Context, a: &Node, b: &Node, differences: &[Difference], signs: Signs) -> Option<Leaf> {
    let (of_a, of_b) = (Tangents::new(context, a)?, Tangents::new(context, b)?);
    factors(differences.iter().map(|d| &d.exact), &of_a, &of_b, signs).map(Leaf::NotNormal)
}

fn bend(context: &Context, a: &Node, b: Option<&Node>, signs: Signs) -> Option<Leaf> {
    let of_a = Tangents::new(context, a)?;
    let of_b = Tangents::new(context, b.unwrap_or(a))?;
    let path: Vec<&[Integer; 3]> = of_a.of_pieces().chain(of_b.of_pieces()).flatten().collect();
    if path.is_empty() {
        return None;
    }
    factors(path.iter().copied(), &of_a, &of_b, signs).map(Leaf::Bend)
}

/// `turn` with vectors along the tangents of each node, of the same length: near 180° their lengths must agree well.
fn turn(context: &Context, a: &Node, b: Option<&Node>) -> Option<Leaf> {
    let along = |node: &Node| {
        let directions: Vec<Vector> = directions(context, node, None)?
            .iter()
            .map(|v| scale(v, 1.0 / dot(v, v).sqrt()))
            .collect();
        let n = super::vector::inner_direction(&directions);
        let n = scale(&n, f64::from(1 << 24) / dot(&n, &n).sqrt());
        Some([0, 1, 2].map(|i| Integer::from(n[i].round() as i64)))
    };
    Some(Leaf::Turn(Box::new([along(a)?, along(b.unwrap_or(a))?])))
}

/// The tangents of one node or of two, each as a float vector of some length.
fn directions(context: &Context, a: &Node, b: Option<&Node>) -> Option<Vec<Vector>> {
    let mut directions = Vec::new();
    for node in std::iter::once(a).chain(b) {
        for v in Tangents::<Integer>::new(context, node)?.all() {
            let shift = v.iter().map(|c| c.bits() as i64).max().unwrap_or(0);
            let [x, y, z] = [0, 1, 2].map(|i| float(&v[i], shift));
            directions.push([x, y, z, 0.0]);
        }
    }
    Some(directions)
}

fn cone(context: &Context, a: &Node, b: Option<&Node>) -> Option<Leaf> {
    let directions = directions(context, a, b)?;
    let cone = super::cone::Cone::around(directions.iter());
    let bits = if cone.cosine > 0.83 { 6 } else { 20 };
    (cone.cosine > std::f64::consts::FRAC_1_SQRT_2).then(|| Leaf::Cone(quantised(&cone.axis, bits).map(Into::into)))
}
