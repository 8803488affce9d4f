//! CPJ12's numbers: ε from the quadratic (3), m₁, m₂, m and E, with every comparison exact.

use super::difference::{Bounds, Norm, PieceMeasures, bounds, whole};
use super::power::least_power;
use super::{ApproximationError, MOST_SUBDIVISIONS};
use crate::number::{Integer, Rational, sqrt_enclosure};

/// √ is enclosed this closely.
const ROOT_BITS: u32 = 160;

/// What the user of CPJ12's algorithm gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameters {
    /// δ > 0, the tolerance of the estimate.
    pub delta: Rational,
    /// ε_d > 0, the tolerance of the candidate test and of the derivative.
    pub epsilon_d: Rational,
    /// The norm of ‖Δ₂P‖ and ‖Δ₂(ΔP)‖; CPJ12 print the ∞-norm.
    pub norm: Norm,
}

/// CPJ12's numbers for a curve. A number of subdivisions is `None` where there is nothing to approximate and the formula takes log 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// The bounds of the curve in the norm asked for.
    pub bounds: Bounds,
    /// ε, the positive root of ½ε² + 2ℓ₀²ε/K = δ, enclosed; 0 where K = 0 and (3) divides by it.
    pub epsilon: [Rational; 2],
    /// m₁, equation (1), with half the root for its ε, as printed. It may be negative.
    pub m1: Option<i64>,
    /// m₁ with the root itself, the reading that forgets to halve.
    pub m1_whole_root: Option<i64>,
    /// m₂, equation (2), as printed.
    pub m2: Option<i64>,
    /// m₂ by the bound that is proved, Q/4^m ≤ ε_d: never more than `m2` for degrees n ≥ 2, and one less for many cubics.
    pub m2_proved: Option<i64>,
    /// m = max(m₁, m₂, 0).
    pub subdivisions: u32,
    /// The edges of the polygon after m subdivisions; `None` beyond 2^64.
    pub edges: Option<u64>,
    /// E = ε²/2 + ℓ₀²/2^(2m−1), enclosed.
    pub error: [Rational; 2],
}

/// Computes them.
///
/// # Errors
/// [`ApproximationError::Tolerance`]; [`ApproximationError::TooMany`] when m is above 2^31.
pub fn plan(pieces: &[PieceMeasures], parameters: &Parameters) -> Result<Plan, ApproximationError> {
    let Parameters { delta, epsilon_d, norm } = parameters;
    for (name, tolerance) in [("delta", delta), ("epsilon-d", epsilon_d)] {
        if !tolerance.numer().is_positive() {
            return Err(ApproximationError::Tolerance { name });
        }
    }
    let bounds = bounds(pieces, *norm);
    let two = whole(2);
    let square = epsilon_d * epsilon_d;
    // 4^m ≥ X/(2ε_d) and 4^m ≥ Q/ε_d.
    let m2 = least_power(&(&bounds.derivative_printed_squared / (&square * whole(4))), 4);
    let m2_proved = least_power(&(&bounds.derivative_squared / &square), 4);
    let m1 = |factor: &Rational| subdivisions_for(&bounds, delta, factor);
    let (m1, m1_whole_root) = (m1(&two), m1(&whole(1)));
    let most = m1.max(m2).unwrap_or(0).max(0);
    let subdivisions = u32::try_from(most)
        .ok()
        .filter(|m| *m < 1 << 31)
        .ok_or(ApproximationError::TooMany)?;
    let edges = pieces.iter().fold(0, |sum, piece| sum + piece.degree as u64);
    let epsilon = positive_root(&bounds, delta);
    let edge_part = &two * &bounds.longest_edge_squared / power_of_four(subdivisions);
    let error = epsilon.clone().map(|epsilon| &epsilon * &epsilon / &two + &edge_part);
    Ok(Plan {
        epsilon,
        m1,
        m1_whole_root,
        m2,
        m2_proved,
        subdivisions,
        edges: 1_u64
            .checked_shl(subdivisions)
            .and_then(|parts| parts.checked_mul(edges)),
        error,
        bounds,
    })
}

impl Plan {
    /// Whether the polygon is small enough to be made.
    pub fn is_feasible(&self) -> bool {
        self.subdivisions <= MOST_SUBDIVISIONS && self.edges.is_some_and(|edges| edges <= super::MOST_EDGES)
    }
}

/// The least m with ε ≥ `factor`·K/4^m for the positive root ε of (3): then x = factor·K/4^m has ½x² + 2ℓ₀²x/K ≤ δ, in which K stands squared only.
fn subdivisions_for(bounds: &Bounds, delta: &Rational, factor: &Rational) -> Option<i64> {
    let quadratic = factor * factor / whole(2) * &bounds.distance_squared;
    let linear = whole(2) * factor * &bounds.longest_edge_squared;
    // Each of the two terms alone has to be at most δ; then a step or two are left.
    let mut m = least_power(&(&quadratic / delta), 4)?.max(least_power(&(&linear / delta), 2)?);
    let at = |m: i64| {
        let power = power_of_four(m.unsigned_abs() as u32);
        let x = if m < 0 { power } else { whole(1) / power };
        &quadratic * &x * &x + &linear * x
    };
    while at(m) > *delta {
        m += 1;
    }
    Some(m)
}

/// ε = √(b² + 2δ) − b with b = 2ℓ₀²/K, enclosed as 2δ/(√(b² + 2δ) + b), which does not cancel.
fn positive_root(bounds: &Bounds, delta: &Rational) -> [Rational; 2] {
    if bounds.distance_squared.numer().is_zero() {
        return [Rational::default(), Rational::default()];
    }
    let double = whole(2) * delta;
    let edge = &bounds.longest_edge_squared;
    let b_squared = whole(4) * edge * edge / &bounds.distance_squared;
    let b = sqrt_enclosure(&b_squared, ROOT_BITS);
    let root = sqrt_enclosure(&(b_squared + &double), ROOT_BITS);
    [&double / (root.1 + b.1), double / (root.0 + b.0)]
}

fn power_of_four(m: u32) -> Rational {
    Rational::from_integer(Integer::ONE << (2 * m))
}
