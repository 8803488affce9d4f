//! What `certify domain` prints of a certificate.

use std::fmt::Write as _;

use knotproof::certificate::Document;
use knotproof::check::domain::Context;
use knotproof::claim::domain::{Content, Evidence, Outcome, Row, Statement};
use knotproof::curve::Curve;
use knotproof::number::{Rational, RationalExt};
use knotproof::prove::domain::sandwich::Round;
use knotproof::prove::domain::{Problem, Status};
use serde::Serialize;

use crate::cli::certify::report::Written;
use crate::cli::domain_words::{DomainLine, decimals, in_words, quantity};

/// What there is to tell.
pub struct Report<'a> {
    /// What was asked.
    pub problem: &'a Problem,
    /// What is proved, if anything.
    pub document: Option<&'a Document<'a, Content>>,
    /// Is it what was asked for?
    pub status: &'a Status,
    /// The rounds of the refinement.
    pub rounds: &'a [Round],
    /// The certificate's file.
    pub written: Option<Written>,
    /// How long it took.
    pub seconds: f64,
}

/// One object of JSON.
#[derive(Serialize)]
pub struct ReportLine<'a> {
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    #[serde(flatten)]
    statement: Option<DomainLine>,
    /// Of the sandwich: between the inner and the outer measure.
    #[serde(skip_serializing_if = "Option::is_none")]
    area: Option<[String; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    volume: Option<[String; 2]>,
    #[serde(flatten)]
    place: Option<Place>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    levels: Vec<RoundLine>,
    seconds: f64,
    certificate: Option<String>,
}

#[derive(Serialize)]
struct RoundLine {
    level: usize,
    inequalities: usize,
    vertices: usize,
    facets: usize,
    inner_points: usize,
    /// Of the inner and of the outer polytope, in binary64: what the refinement saw, not what is proved.
    measure_estimates: [f64; 2],
    relative_error_estimate: f64,
    seconds: f64,
}

/// Where a question's answer is.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Place {
    /// The nearest position, or the centre of the ball; exact.
    Point(Vec<String>),
    /// The shortest way to another sign.
    Move {
        /// A unit vector, in binary64.
        direction: Vec<f64>,
        /// The parameter of the curve where the sign changes, in its own parameter.
        at: Option<String>,
    },
}

impl Place {
    fn of(curve: &Curve, content: &Content) -> Option<Place> {
        match &content.evidence {
            Evidence::Nearest { point, .. } => Some(Place::point(point)),
            Evidence::Ball { center, .. } => Some(Place::point(center)),
            Evidence::Change { row } => {
                let context = Context::new(curve, &content.statement.domain).ok()?;
                let exact = context.row(row)?;
                let normal: Vec<Rational> = exact.affine.linear.into_iter().map(Rational::from_integer).collect();
                // The greatest component first becomes 1: the others fit binary64 then.
                let greatest = normal.iter().max_by_key(|x| x.numer().abs())?.clone();
                let scale = Rational::from_integer(greatest.numer().abs());
                let scaled: Vec<f64> = normal.iter().map(|x| -(x / &scale).to_f64()).collect();
                let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
                let Row::Parameter { piece, u } = row else { return None };
                let parameter = Rational::from_integer((*piece).into()) + u;
                Some(Place::Move {
                    direction: scaled.iter().map(|x| x / length).collect(),
                    at: curve.chain().knot_at(&parameter).map(|knot| knot.format()),
                })
            }
            _ => None,
        }
    }

    fn point(point: &[Rational]) -> Place {
        Place::Point(point.iter().map(Rational::format).collect())
    }

    fn in_words(&self, statement: &Statement) -> String {
        match self {
            Place::Point(point) => {
                let name = match statement.outcome {
                    Outcome::Ball { .. } => "centre of such a ball",
                    _ => "a position as near",
                };
                format!("{name}: ({})", point.join(", "))
            }
            Place::Move { direction, at } => {
                let direction: Vec<String> = direction.iter().map(|x| format!("{x:.6}")).collect();
                let at = at.as_deref().unwrap_or("?");
                format!(
                    "in the direction ({}); the sign changes at the parameter {at}",
                    direction.join(", ")
                )
            }
        }
    }
}

/// The decimal enclosure of a sandwich's measure.
fn measure(statement: &Statement) -> Option<[String; 2]> {
    match &statement.outcome {
        Outcome::Sandwich {
            inner_measure,
            outer_measure,
        } => Some(decimals(inner_measure, outer_measure)),
        _ => None,
    }
}

impl Report<'_> {
    /// One object.
    pub fn for_programs(&self) -> ReportLine<'_> {
        let (status, reason) = match self.status {
            Status::Certified => ("certified", None),
            Status::Undecided(why) => ("undecided", Some(why.as_str())),
        };
        let rounds = self.rounds.iter().enumerate();
        let plane = self.problem.position.len() == 2;
        let measure = self.document.and_then(|document| measure(&document.claim.statement));
        ReportLine {
            status,
            reason,
            statement: self.document.map(|document| DomainLine::new(&document.claim.statement)),
            area: measure.clone().filter(|_| plane),
            volume: measure.filter(|_| !plane),
            place: self
                .document
                .and_then(|document| Place::of(&document.curve, &document.claim)),
            levels: rounds.map(|(level, round)| RoundLine::new(level, round)).collect(),
            seconds: self.seconds,
            certificate: self.written.as_ref().map(|written| written.path.display().to_string()),
        }
    }

    /// Lines.
    pub fn for_people(&self) -> String {
        let mut text = String::new();
        let domain = &self.problem.domain;
        match self.document {
            Some(document) => {
                let _ = writeln!(text, "{}", in_words(&document.claim.statement));
                if let Outcome::Sandwich { .. } = document.claim.statement.outcome
                    && let Some(round) = self.rounds.last()
                {
                    let _ = writeln!(
                        text,
                        "inner polytope on {} points, outer polytope of {} inequalities with {} vertices, {} rounds, {:.3} s",
                        round.inner_points,
                        round.inequalities,
                        round.vertices,
                        self.rounds.len(),
                        self.seconds
                    );
                }
                if let Some(place) = Place::of(&document.curve, &document.claim) {
                    let _ = writeln!(text, "{}", place.in_words(&document.claim.statement));
                }
            }
            None => {
                let _ = writeln!(text, "nothing about the domain for {} is proved", quantity(domain));
            }
        }
        if domain.points.len() > 1 {
            let points: Vec<String> = domain.points.iter().map(usize::to_string).collect();
            let _ = writeln!(
                text,
                "control points {} are one place and move together",
                points.join(", ")
            );
        }
        for (end, name) in [(0, "start"), (1, "end")] {
            if domain.open[end] {
                let _ = writeln!(
                    text,
                    "the {name} of the interval is left open: the sign function vanishes there wherever the point is"
                );
            }
        }
        if let Status::Undecided(why) = self.status {
            let _ = writeln!(text, "undecided: {why}");
        }
        if let Some(written) = &self.written {
            let _ = writeln!(
                text,
                "certificate: {} ({} bytes)",
                written.path.display(),
                written.bytes
            );
        }
        text
    }
}

impl RoundLine {
    fn new(level: usize, round: &Round) -> RoundLine {
        RoundLine {
            level,
            inequalities: round.inequalities,
            vertices: round.vertices,
            facets: round.facets,
            inner_points: round.inner_points,
            measure_estimates: round.measures,
            relative_error_estimate: (round.measures[1] - round.measures[0]) / round.measures[0],
            seconds: round.seconds,
        }
    }
}
