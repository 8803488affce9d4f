//! What papers compute of a curve beside what is certified, as plain rows.
//!
//! [`compare`] makes the rows of CPJ12 (Cassidy, Peters, Jordan 2012), of the method before it, of MP06's Newton method (Moore, Peters 2006) and of the binary64 engine, of the polygon and of the certified claims. Rows of other
//! methods can be put beside them: a [`Row`] holds nothing but its words and its numbers. Of a control point it adds the levels of GKK09 (Ginnis, Karousos, Kaklis 2009) beside the certified
//! area or volume of the convex domain.

mod certified;
mod domain;
mod floating;
mod peers;
mod polygonal;
mod row;

pub use domain::{DomainComparison, DomainOptions, LevelComparison, MOST_INEQUALITIES, MOST_LEVELS};
pub use peers::PeerOptions;
pub use row::{Row, Standing, Value};

use crate::approximation::ApproximationError;
use crate::curve::Curve;
use crate::number::{Integer, Rational};
use crate::prove::domain::QuestionError;

/// What to compare.
#[derive(Clone, Debug)]
pub struct Options {
    /// CPJ12's δ > 0, the tolerance of the estimate.
    pub delta: Rational,
    /// CPJ12's ε_d > 0, the tolerance of the candidate test.
    pub epsilon_d: Rational,
    /// (upper − lower)/upper of the certified intervals, above 0 and below 1.
    pub relative_width: Rational,
    /// The control point whose convex domain is compared too.
    pub domain: Option<DomainOptions>,
    /// Whether and how interval methods of other projects are run.
    pub peers: Option<PeerOptions>,
}

/// What was computed.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// All rows.
    pub rows: Vec<Row>,
    /// The levels of GKK09 as numbers, when a control point was named; the rows have them too.
    pub domain: Option<DomainComparison>,
}

impl Default for Options {
    /// The tolerances of CPJ12's example, δ = 1/4 and ε_d = 1/100; widths of 1e-9.
    fn default() -> Self {
        Options {
            delta: Rational::new(Integer::ONE, Integer::from(4)),
            epsilon_d: Rational::new(Integer::ONE, Integer::from(100)),
            relative_width: Rational::new(Integer::ONE, Integer::from(10).pow(9)),
            domain: None,
            peers: None,
        }
    }
}

/// Why there are no rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CompareError {
    /// A tolerance is refused.
    Tolerance(ApproximationError),
    /// A piece is a single point; nothing is certified about it.
    PointPiece {
        /// Its number.
        piece: usize,
    },
    /// The control point, its box, interval or sign is refused.
    Question(QuestionError),
    /// A temporary file failed, or the checker did not accept what was found, which is an error of this program.
    Failed(String),
}

impl std::fmt::Display for CompareError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            CompareError::Tolerance(error) => error.fmt(f),
            CompareError::PointPiece { piece } => {
                write!(f, "piece {piece} is a single point; leave it out of the curve")
            }
            CompareError::Question(error) => error.fmt(f),
            CompareError::Failed(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for CompareError {}

/// Computes all rows. What stands as certified has been replayed by the checker. `progress` is called with the part of the present search that is done.
///
/// # Errors
/// [`CompareError`].
pub fn compare(curve: &Curve, options: &Options, progress: &dyn Fn(f64)) -> Result<Comparison, CompareError> {
    let chain = curve.chain();
    let asked = options.domain.as_ref().map(|domain| domain.problem(curve));
    let problem = asked.transpose().map_err(CompareError::Question)?;
    let certified = certified::certify(curve, options, progress)?;
    let polygonal = polygonal::rows(&chain, options, &certified)?;
    let deviation = certified::deviation_rows(curve, polygonal.subdivisions)?;
    let mut rows = polygonal.rows;
    rows.extend(floating::rows(curve));
    if let Some(peers) = &options.peers {
        rows.extend(peers::rows(curve, peers));
    }
    rows.extend(deviation);
    rows.extend(certified.rows);
    let domain = match options.domain.as_ref().zip(problem) {
        None => None,
        Some((asked, problem)) => Some(domain::compare(curve, asked, problem, &mut rows)?),
    };
    Ok(Comparison { rows, domain })
}
