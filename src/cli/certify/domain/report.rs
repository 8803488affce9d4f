//! What `certify domain` prints of a certificate.

use std::fmt::Write as _;

use knotproof::certificate::Document;
use knotproof::check::domain::Context;
use knotproof::claim::domain::{Content, Evidence, Outcome, Row, Statement};
use knotproof::curve::{Curve, CurveFile};
use knotproof::number::{Rational, RationalExt};
use knotproof::prove::domain::sandwich::Round;
use knotproof::prove::domain::{Problem, Status};
use serde::Serialize;

use crate::cli::certify::report::{Written, last_lines};
use crate::cli::domain_words::{DomainStatementLine, decimals, in_words, quantity, relative_error};
use crate::cli::input::Input;

/// What there is to tell.
pub struct Report<'a> {
    /// The file of the curve.
    pub input: &'a Input,
    /// The curve.
    pub file: &'a CurveFile,
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
    /// Are exact measures of every round asked for?
    pub exact_measure: bool,
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
    statement: Option<DomainStatementLine>,
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
    snapped_joints: usize,
}

#[derive(Serialize)]
struct RoundLine {
    level: usize,
    inequalities: usize,
    vertices: usize,
    facets: usize,
    inner_points: usize,
    /// Between the measures of the inner and the outer polytope of the round.
    #[serde(skip_serializing_if = "Option::is_none")]
    area: Option<[String; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    volume: Option<[String; 2]>,
    /// The same as exact fractions.
    #[serde(skip_serializing_if = "Option::is_none")]
    exact_measures: Option<[String; 2]>,
    relative_error: Option<String>,
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
        // Exact numbers are in the certificate and in the JSON.
        let short = |x: &str| Rational::parse_canonical(x).map_or_else(|_| x.into(), |x| format!("{:.9}", x.to_f64()));
        match self {
            Place::Point(point) => {
                let name = match statement.outcome {
                    Outcome::Ball { .. } => "centre of such a ball",
                    _ => "a position as near",
                };
                let point: Vec<String> = point.iter().map(|x| short(x)).collect();
                format!("{name}: about ({})", point.join(", "))
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
            statement: self
                .document
                .map(|document| DomainStatementLine::new(&document.claim.statement)),
            area: measure.clone().filter(|_| plane),
            volume: measure.filter(|_| !plane),
            place: self
                .document
                .and_then(|document| Place::of(&document.curve, &document.claim)),
            levels: rounds
                .map(|(level, round)| RoundLine::new(level, round, plane, self.exact_measure))
                .collect(),
            seconds: self.seconds,
            certificate: self.written.as_ref().map(|written| written.path.display().to_string()),
            snapped_joints: self.file.snapped,
        }
    }

    /// Lines.
    pub fn for_people(&self) -> String {
        let mut text = String::new();
        let _ = self.write_for_people(&mut text);
        text
    }

    fn write_for_people(&self, text: &mut String) -> std::fmt::Result {
        let domain = &self.problem.domain;
        let name = match &self.file.name {
            Some(name) => format!("{name:?}"),
            None => self.input.to_string(),
        };
        let sign = if domain.sign.name() == "+" {
            "positive"
        } else {
            "negative"
        };
        let subject = format!(
            "convex domain of a control point of {name} for {sign} {}",
            quantity(domain)
        );
        match self.status {
            Status::Certified => writeln!(text, "certified: {subject}")?,
            Status::Undecided(why) => {
                writeln!(text, "undecided: {subject}")?;
                writeln!(text, "  because {why}")?;
            }
        }
        if domain.points.len() > 1 {
            let points: Vec<String> = domain.points.iter().map(usize::to_string).collect();
            writeln!(
                text,
                "  control points {} are one place and move together",
                points.join(", ")
            )?;
        }
        for (end, name) in [(0, "start"), (1, "end")] {
            if domain.open[end] {
                writeln!(
                    text,
                    "  the {name} of the interval is left open: the sign function vanishes there wherever the point is"
                )?;
            }
        }
        let Some(document) = self.document else {
            writeln!(text, "  nothing is proved")?;
            return writeln!(text, "  {:.3} s", self.seconds);
        };
        let so_far = match self.status {
            Status::Certified => "",
            Status::Undecided(_) => "proved so far: ",
        };
        writeln!(text, "  {so_far}{}", in_words(&document.claim.statement))?;
        match (&document.claim.evidence, self.rounds.last()) {
            (Evidence::Sandwich { inner, rows, .. }, Some(round)) => {
                writeln!(text, "  inner polytope: the hull of {} points", inner.points.len())?;
                let parameters = rows.iter().filter(|row| matches!(row, Row::Parameter { .. })).count();
                writeln!(
                    text,
                    "  outer polytope: {parameters} inequalities and {} sides of the box, {} vertices, found in {} rounds",
                    rows.len() - parameters,
                    round.vertices,
                    self.rounds.len()
                )?;
            }
            (Evidence::Empty { rows, .. }, _) => match rows.len() {
                1 => writeln!(text, "  because of one inequality that holds nowhere")?,
                count => writeln!(text, "  because of {count} inequalities that contradict each other")?,
            },
            _ => {}
        }
        if let Some(place) = Place::of(&document.curve, &document.claim) {
            writeln!(text, "  {}", place.in_words(&document.claim.statement))?;
        }
        text.push_str(&last_lines(
            self.file.snapped,
            true,
            self.written.as_ref(),
            self.seconds,
        ));
        Ok(())
    }
}

impl RoundLine {
    fn new(level: usize, round: &Round, plane: bool, exact: bool) -> RoundLine {
        let measures = round.measures.as_ref();
        let interval = measures.map(|[inner, outer]| decimals(inner, outer));
        RoundLine {
            level,
            inequalities: round.inequalities,
            vertices: round.vertices,
            facets: round.facets,
            inner_points: round.inner_points,
            area: interval.clone().filter(|_| plane),
            volume: interval.filter(|_| !plane),
            exact_measures: measures
                .filter(|_| exact)
                .map(|both| both.each_ref().map(Rational::format)),
            relative_error: measures.map(|[inner, outer]| relative_error(inner, outer)),
            seconds: round.seconds,
        }
    }
}
