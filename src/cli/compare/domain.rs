//! The convex domain of a control point among what is compared.

use clap::{Args, value_parser};
use knotproof::claim::domain::Box as Corners;
use knotproof::compare::{DomainComparison, DomainOptions, MOST_LEVELS};
use knotproof::number::Rational;
use knotproof::prove::domain::Bounds;
use knotproof::prove::domain::levels::Degree;
use serde::Serialize;

use crate::cli::certify::domain::{Coordinates, SignName, coordinates, number, tolerance};
use crate::cli::domain_words::{DomainLine, quantity, texts};
use crate::cli::failure::Failure;

/// Levels without a tolerance, and with one.
const USUAL_LEVELS: [u32; 2] = [5, 12];

/// Which domain, and how far.
#[derive(Args)]
pub struct DomainArguments {
    /// Compare the convex domain of this control point too, from 0; of Bézier pieces each joint counts once.
    #[arg(long, value_name = "INDEX", help_heading = "Convex domain")]
    point: Option<usize>,
    /// The box is a square or cube of this edge length centred at the point [default: twice the longest side of the box of all control points]
    #[arg(long = "box", value_name = "EDGE", requires = "point", help_heading = "Convex domain", allow_hyphen_values = true, value_parser = number)]
    edge: Option<Rational>,
    /// The least coordinates of the box, separated by commas.
    #[arg(long, value_name = "X,Y[,Z]", requires_all = ["point", "box_to"], conflicts_with = "edge", help_heading = "Convex domain", allow_hyphen_values = true, value_parser = coordinates)]
    box_from: Option<Coordinates>,
    /// The greatest coordinates of the box.
    #[arg(long, value_name = "X,Y[,Z]", requires_all = ["point", "box_from"], help_heading = "Convex domain", allow_hyphen_values = true, value_parser = coordinates)]
    box_to: Option<Coordinates>,
    /// The sign that curvature or torsion is to have [default: the one it has]
    #[arg(
        long,
        value_enum,
        requires = "point",
        help_heading = "Convex domain",
        allow_hyphen_values = true
    )]
    sign: Option<SignName>,
    /// Only a part of the curve, in its own parameter (knots; piece numbers of Bézier pieces).
    #[arg(long, value_names = ["A", "B"], num_args = 2, requires = "point", help_heading = "Convex domain", allow_hyphen_values = true, value_parser = number)]
    interval: Option<Vec<Rational>>,
    /// The last level of the algorithm [default: 5; with --tol 12]
    #[arg(long, value_name = "LEVEL", requires = "point", help_heading = "Convex domain", value_parser = value_parser!(u32).range(0..=i64::from(MOST_LEVELS)))]
    levels: Option<u32>,
    /// Stop as the paper does, where measure(next \ last)/measure(last), its (20), is at most this.
    #[arg(long, value_name = "TOL", requires = "point", help_heading = "Convex domain", allow_hyphen_values = true, value_parser = tolerance)]
    tol: Option<Rational>,
}

impl DomainArguments {
    /// Where the paper's algorithm stops.
    pub fn tolerance(&self) -> Option<&Rational> {
        self.tol.as_ref()
    }

    /// What is asked of the library; nothing without a control point.
    pub fn options(&self) -> Result<Option<DomainOptions>, Failure> {
        let Some(point) = self.point else {
            return Ok(None);
        };
        let bounds = match (&self.edge, &self.box_from, &self.box_to) {
            (Some(edge), _, _) => Some(Bounds::Edge(edge.clone())),
            (None, Some(low), Some(high)) => Some(Bounds::Corners(Corners {
                low: low.0.clone(),
                high: high.0.clone(),
            })),
            (None, None, None) => None,
            _ => return Err(Failure::new("expected --box-from and --box-to together")),
        };
        let ends = self.interval.as_ref();
        Ok(Some(DomainOptions {
            point,
            bounds,
            sign: self.sign.map(Into::into),
            interval: ends.and_then(|ends| <[Rational; 2]>::try_from(ends.clone()).ok()),
            levels: self.levels.unwrap_or(USUAL_LEVELS[usize::from(self.tol.is_some())]),
            tolerance: self.tol.clone(),
        }))
    }
}

/// The set as JSON.
#[derive(Serialize)]
pub struct ComparedDomainLine {
    #[serde(flatten)]
    domain: DomainLine,
    degree: &'static str,
}

impl ComparedDomainLine {
    /// From a comparison.
    pub fn new(found: &DomainComparison) -> ComparedDomainLine {
        ComparedDomainLine {
            domain: DomainLine::new(&found.problem.domain),
            degree: degree(found),
        }
    }
}

fn degree(found: &DomainComparison) -> &'static str {
    match found.degree {
        Degree::Paper => "paper",
        Degree::True => "true",
    }
}

/// A line for people.
pub fn words(found: &DomainComparison) -> String {
    let domain = &found.problem.domain;
    let corner = |numbers: &[Rational]| format!("({})", texts(numbers).join(", "));
    format!(
        "convex domain of the control point {}, {} {}, box {} to {}, {} degree of the sign function",
        corner(&found.problem.position),
        quantity(domain),
        domain.sign.name(),
        corner(&domain.bounds.low),
        corner(&domain.bounds.high),
        match found.degree {
            Degree::Paper => "the paper's",
            Degree::True => "the true",
        }
    )
}
