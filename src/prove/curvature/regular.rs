//! Parameters where a curve is not regular, so that its curvature has no bound that could be proved.

use rayon::prelude::*;

use super::sample::Control;
use crate::check::chain::Chain;
use crate::check::curvature::Field;
use crate::check::polynomial::NotShown;
use crate::number::{Integer, Meaning, Rational, RationalExt, parse_number};

/// Samples among which the least speed is looked for.
const SAMPLES: usize = 512;
/// How often an interval around the least speed is made smaller.
const ROUNDS: usize = 80;
/// Digits of a parameter that is told.
const DIGITS: usize = 12;

/// What is not regular.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Irregular {
    /// The derivative vanishes at a parameter, exactly.
    Vanishes(Rational),
    /// The derivative vanishes, or nearly does, near a parameter.
    Nearly(Rational),
    /// The curvature grows beyond all bounds towards an end of a piece whose control points coincide there.
    Unbounded(Rational),
}

impl Irregular {
    /// The global parameter.
    pub fn parameter(&self) -> &Rational {
        match self {
            Irregular::Vanishes(s) | Irregular::Nearly(s) | Irregular::Unbounded(s) => s,
        }
    }

    /// A sentence that names the parameter in the curve's own knots.
    pub fn in_words(&self, pieces: &crate::curve::Chain) -> String {
        let knot = pieces.knot_at(self.parameter());
        let knot = knot.as_ref().unwrap_or(self.parameter());
        // Short parameters exactly, others to the nearest decimal.
        let exact = knot.format();
        let text = if exact.len() <= DIGITS {
            exact
        } else {
            let nearest = format!("{:.*e}", DIGITS - 1, knot.to_f64());
            match parse_number(&nearest, Meaning::Decimal) {
                Ok(nearest) => crate::number::decimal_down(&nearest, DIGITS),
                Err(_) => nearest,
            }
        };
        match self {
            Irregular::Vanishes(_) => {
                format!("the curve is not regular: its derivative vanishes at the parameter {text}")
            }
            Irregular::Nearly(_) => format!(
                "the curve is not regular, or nearly so: its derivative vanishes or is too small near the parameter {text}"
            ),
            Irregular::Unbounded(_) => format!(
                "the curvature is unbounded: control points coincide, and the derivative vanishes, at the parameter {text}"
            ),
        }
    }
}

/// The first of them along the curve.
pub fn first_irregular(chain: &Chain, pieces: &crate::curve::Chain) -> Option<Irregular> {
    (0..chain.pieces.len()).into_par_iter().find_map_first(|i| {
        let global = |u: Rational| Rational::from_integer(Integer::from(i)) + u;
        let field = Field::new(chain, i);
        match field.show_regular() {
            Err(NotShown::At { numerator, halvings }) => {
                let u = Rational::new(Integer::from(numerator), Integer::ONE << halvings as u32);
                return Some(Irregular::Vanishes(global(u)));
            }
            Err(NotShown::Limits) => {
                let u = slowest(&Control::new(&pieces.pieces()[i]));
                return Some(Irregular::Nearly(global(u)));
            }
            Ok(()) => {}
        }
        // Towards an end κ is of the order u^(y − 3z).
        let bends = field.straight_ends()?;
        let end = (0..2).find(|end| bends[*end] < 3 * field.zeros()[*end])?;
        Some(Irregular::Unbounded(global(Rational::from_integer(Integer::from(end)))))
    })
}

/// The local parameter of least speed, in binary64.
fn slowest(control: &Control) -> Rational {
    let step = 1.0 / SAMPLES as f64;
    let samples = (0..=SAMPLES).map(|k| k as f64 * step);
    let mut best = samples.fold((f64::INFINITY, 0.5), |best, u| {
        let speed = control.speed(u);
        if speed < best.0 { (speed, u) } else { best }
    });
    let mut step = step;
    for _ in 0..ROUNDS {
        for u in [best.1 - step, best.1 + step] {
            let u = u.clamp(0.0, 1.0);
            let speed = control.speed(u);
            if speed < best.0 {
                best = (speed, u);
            }
        }
        step *= 0.7;
    }
    Rational::from_f64(best.1).unwrap_or_else(|| Rational::new(Integer::ONE, Integer::from(2)))
}
