//! The claim `domain`: where control points may be so that curvature or torsion keeps a sign (FORMAT §9, proofs in docs/domain.md).

mod ball;
mod change;
mod combination;
mod fair;
mod nearest;
mod sandwich;
pub mod sign;
pub mod star;

pub use fair::fair_point;

use super::polynomial::{self, Bound, NotShown};
use super::rule::Failure;
use super::{Place, Reason, Rejection};
use crate::claim::domain::{Content, Domain, Evidence, Outcome, Row};
use crate::curve::Curve;
use crate::number::{Integer, Rational, RationalExt, RationalVector};
use sign::{Affine, DomainError, Section};

/// What the obligations are about: the set K ∩ B.
pub struct Context<'a> {
    /// Coordinates.
    pub dimension: usize,
    /// The set as it is stated.
    pub domain: &'a Domain,
    /// The sign functions.
    pub sections: Vec<Section>,
}

/// A row: `affine` times `scale`.
pub struct Exact {
    /// The function up to the factor.
    pub affine: Affine,
    /// A positive factor.
    pub scale: Rational,
    /// Is it greater than 0, not only ≥ 0, on K?
    pub strict: bool,
}

type Checked<T = ()> = Result<T, Failure>;

fn fails<T>(expected: &'static str, found: impl Into<String>) -> Checked<T> {
    Err(Failure {
        expected,
        found: found.into(),
    })
}

/// Checks statement and evidence about a curve.
///
/// # Errors
/// The obligation that does not hold.
pub fn check_domain(curve: &Curve, content: &Content) -> Result<(), Rejection> {
    let domain = &content.statement.domain;
    let context = Context::new(curve, domain).map_err(|error| Rejection {
        place: Place::Statement,
        reason: Reason::Domain(error),
    })?;
    let (rule, outcome) = match (&content.statement.outcome, &content.evidence) {
        (
            Outcome::Sandwich {
                inner_measure,
                outer_measure,
            },
            Evidence::Sandwich { .. },
        ) => (
            "sandwich",
            sandwich::check(&context, &content.evidence, inner_measure, outer_measure),
        ),
        (Outcome::Empty, Evidence::Empty { rows, multipliers }) => {
            ("empty", combination::check_empty(&context, rows, multipliers))
        }
        (
            Outcome::Nearest {
                to,
                lower_squared,
                upper_squared,
            },
            Evidence::Nearest { .. },
        ) => (
            "nearest",
            nearest::check(&context, curve, &content.evidence, to, [lower_squared, upper_squared]),
        ),
        (
            Outcome::Change {
                from,
                lower_squared,
                upper_squared,
            },
            Evidence::Change { row },
        ) => (
            "change",
            change::check(&context, from, [lower_squared, upper_squared], row),
        ),
        (Outcome::Ball { lower, upper }, Evidence::Ball { .. }) => {
            ("ball", ball::check(&context, &content.evidence, [lower, upper]))
        }
        _ => ("outcome", fails("the evidence of the outcome", "that of another")),
    };
    outcome.map_err(|failure| Rejection {
        place: Place::Evidence,
        reason: Reason::Obligation { rule, failure },
    })
}

impl<'a> Context<'a> {
    /// # Errors
    /// A domain that is none.
    pub fn new(curve: &Curve, domain: &'a Domain) -> Result<Self, DomainError> {
        Ok(Context {
            dimension: curve.dimension(),
            domain,
            sections: sign::sections(curve, domain)?,
        })
    }

    /// Shows that the sign functions have a sign at point / denominator.
    ///
    /// # Errors
    /// The section and the parameter where that fails, or that halving did not come to an end.
    pub fn show(&self, point: &[Integer], denominator: &Integer, bound: Bound) -> Result<(), (usize, NotShown)> {
        for (number, section) in self.sections.iter().enumerate() {
            polynomial::show(section.at(point, denominator), bound).map_err(|why| (number, why))?;
        }
        Ok(())
    }

    /// Is point / denominator in the box?
    pub fn in_box(&self, point: &[Integer], denominator: &Integer) -> bool {
        let bounds = &self.domain.bounds;
        let at_most = |x: &Rational, y: &Integer| x.numer() * denominator <= y * x.denom();
        let at_least = |x: &Rational, y: &Integer| x.numer() * denominator >= y * x.denom();
        let low = bounds.low.iter().zip(point).all(|(x, y)| at_most(x, y));
        low && bounds.high.iter().zip(point).all(|(x, y)| at_least(x, y))
    }

    /// The function of a row, if there is that row.
    pub fn row(&self, row: &Row) -> Option<Exact> {
        match row {
            Row::Parameter { piece, u } => {
                let section = self.sections.iter().find(|section| section.piece == *piece)?;
                let (affine, scale) = section.row(u)?;
                let strict = !section.excludes(u);
                Some(Exact { affine, scale, strict })
            }
            Row::Side { axis, high } => {
                let bounds = &self.domain.bounds;
                let bound = if *high {
                    bounds.high.get(*axis)?
                } else {
                    bounds.low.get(*axis)?
                };
                // ±(x − p/q) = ±(q·x − p)/q
                let sign = Integer::from(if *high { -1 } else { 1 });
                let mut linear = vec![Integer::ZERO; self.dimension];
                linear[*axis] = &sign * bound.denom();
                let affine = Affine {
                    linear,
                    constant: -(&sign * bound.numer()),
                };
                let scale = Rational::new(Integer::ONE, bound.denom().clone());
                Some(Exact {
                    affine,
                    scale,
                    strict: false,
                })
            }
        }
    }

    /// Does a combination of rows prove that K ∩ B is empty?
    ///
    /// # Errors
    /// What it lacks.
    pub fn check_empty(&self, rows: &[Row], multipliers: &[Integer]) -> Result<(), Failure> {
        combination::check_empty(self, rows, multipliers)
    }

    fn rows(&self, rows: &[Row]) -> Checked<Vec<Exact>> {
        rows.iter()
            .enumerate()
            .map(|(i, row)| match self.row(row) {
                Some(row) => Ok(row),
                None => fails(
                    "rows of the sections and the box",
                    format!("row {i}, which is none of them"),
                ),
            })
            .collect()
    }

    /// A point of B shown to be in K (positive) or cl K (non-negative).
    fn point(&self, point: &[Rational], bound: Bound, name: &'static str) -> Checked {
        let integers = RationalVector::from_rationals(point);
        if !self.in_box(integers.numerators(), integers.denominator()) {
            return fails("a point of the box", format!("the {name} outside it"));
        }
        self.shown(integers.numerators(), integers.denominator(), bound, || name.into())
    }

    fn shown(&self, point: &[Integer], denominator: &Integer, bound: Bound, name: impl Fn() -> String) -> Checked {
        self.show(point, denominator, bound).map_err(|(section, why)| {
            let expected = match bound {
                Bound::Positive => "a sign function positive by halving",
                Bound::NonNegative => "a sign function non-negative by halving",
            };
            let found = match why {
                NotShown::At { numerator, halvings } => {
                    let u = self.sections[section].local(numerator, halvings);
                    format!(
                        "the wrong sign at {} of piece {}",
                        u.format(),
                        self.sections[section].piece
                    )
                }
                NotShown::Limits => format!("no end of halving on piece {}", self.sections[section].piece),
            };
            Failure {
                expected,
                found: format!("{}: {found}", name()),
            }
        })
    }
}

impl Section {
    /// The local parameter of the piece that is numerator / 2^halvings of the section.
    pub fn local(&self, numerator: u64, halvings: usize) -> Rational {
        let part = Rational::new(Integer::from(numerator), Integer::ONE << halvings as u32);
        &self.ends[0] + part * (&self.ends[1] - &self.ends[0])
    }
}
