//! `knotproof certify domain`: the convex domain of a control point.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};
use knotproof::check::domain::Context;
use knotproof::claim::domain::{Box as Corners, Outcome, Sign};
use knotproof::curve::CurveFile;
use knotproof::number::{Meaning, Rational, RationalExt, decimal_down, decimal_up, parse_number};
use knotproof::prove::domain::levels::{Degree, Level, Levels};
use knotproof::prove::domain::sandwich::Round;
use knotproof::prove::domain::{
    Bounds, Certified, CertifyError, Options, Problem, Question, Status, certify, write_checked,
};
use knotproof::prove::linear_program::GoodLp;
use serde::Serialize;
use tempfile::SpooledTempFile;

use super::output_file::{Format, Target, encoding};
use super::report::Written;
use crate::cli::domain_words::{DomainLine, decimals, in_words, quantity};
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::cli::output::{say, say_json};
use crate::cli::{Exit, Printing};

/// Levels of the paper's algorithm at most.
const MOST_LEVELS: u32 = 24;
/// Digits of a measure in a table.
const TABLE_DIGITS: usize = 6;

/// Where a control point may be so that curvature (in the plane) or torsion (in space) keeps its sign
///
/// The output is a polytope inside the convex domain K and one around it, both cut off by a box, and the certified relative error between them. With
/// --degree or --level the algorithm of Ginnis, Karousos and Kaklis (2009) runs instead, level by level, and no certificate is made.
#[derive(Args)]
pub struct Arguments {
    /// The curve, a file of version curve/1; "-" is standard input.
    curve: Input,
    /// The free control point, from 0; of Bézier pieces each joint counts once.
    #[arg(long, value_name = "INDEX")]
    point: usize,
    /// The box is a square or cube of this edge length centred at the point.
    #[arg(long = "box", value_name = "EDGE", required_unless_present = "box_from", allow_hyphen_values = true, value_parser = number)]
    edge: Option<Rational>,
    /// The least coordinates of the box, separated by commas.
    #[arg(long, value_name = "X,Y[,Z]", requires = "box_to", conflicts_with = "edge", allow_hyphen_values = true, value_parser = coordinates)]
    box_from: Option<Coordinates>,
    /// The greatest coordinates of the box.
    #[arg(long, value_name = "X,Y[,Z]", requires = "box_from", allow_hyphen_values = true, value_parser = coordinates)]
    box_to: Option<Coordinates>,
    /// The sign that curvature or torsion is to have [default: the one it has]
    #[arg(long, value_enum, allow_hyphen_values = true)]
    sign: Option<SignName>,
    /// Only a part of the curve, in its own parameter (knots; piece numbers of Bézier pieces).
    #[arg(long, value_names = ["A", "B"], num_args = 2, allow_hyphen_values = true, value_parser = number)]
    interval: Option<Vec<Rational>>,
    /// How large measure(outer \ inner)/measure(inner) may be; of the levels, measure(next \ last)/measure(last).
    #[arg(long, value_name = "TOL", default_value = "1e-6", allow_hyphen_values = true, value_parser = tolerance)]
    tol: Rational,
    /// The paper's algorithm, the sign function written in this degree.
    #[arg(long, value_enum)]
    degree: Option<DegreeName>,
    /// The paper's algorithm up to this level, whatever the tolerance.
    #[arg(long, value_name = "LEVEL", value_parser = clap::value_parser!(u32).range(0..=i64::from(MOST_LEVELS)))]
    level: Option<u32>,
    /// Print areas and volumes of the levels as exact fractions too.
    #[arg(long)]
    exact_measure: bool,
    /// How many inequalities the outer polytope may have at most.
    #[arg(long, value_name = "ROWS", default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(1..))]
    budget: u32,
    /// Write the certificate to this file. It is there only when whole, and accepted by the checker.
    #[arg(long, short, value_name = "CERT", conflicts_with_all = ["degree", "level"])]
    output: Option<PathBuf>,
    /// The form of the certificate [default: binary when the name of CERT ends in ".bin", else json]
    #[arg(long, value_enum, requires = "output")]
    format: Option<Format>,
    /// Where a Bézier piece does not start exactly where the one before ends, move its start there.
    #[arg(long)]
    snap_joints: bool,
    #[command(flatten)]
    printing: Printing,
}

#[derive(Clone, Copy, ValueEnum)]
enum SignName {
    /// Greater than 0
    #[value(name = "+", alias = "plus")]
    Plus,
    /// Less than 0
    #[value(name = "-", alias = "minus")]
    Minus,
}

#[derive(Clone, Copy, ValueEnum)]
enum DegreeName {
    /// Its own degree, d(n−d)
    True,
    /// The degree of the paper's products, 2n−3 or 3n−6
    Paper,
}

/// Coordinates, as one argument.
#[derive(Clone)]
struct Coordinates(Vec<Rational>);

fn number(text: &str) -> Result<Rational, String> {
    parse_number(text, Meaning::Decimal).map_err(|error| error.to_string())
}

fn coordinates(text: &str) -> Result<Coordinates, String> {
    text.split(',').map(number).collect::<Result<_, _>>().map(Coordinates)
}

fn tolerance(text: &str) -> Result<Rational, String> {
    let value = number(text)?;
    if value <= Rational::from_integer(0.into()) {
        return Err("expected a tolerance greater than 0".into());
    }
    Ok(value)
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let target = Target::new(arguments.output.as_deref(), &arguments.curve)?;
    let file = arguments.curve.read_curve(arguments.snap_joints)?;
    let problem = arguments.problem(&file)?;
    if arguments.degree.is_some() || arguments.level.is_some() {
        return match file.curve.dimension() {
            2 => arguments.levels::<2>(&file, &problem),
            _ => arguments.levels::<3>(&file, &problem),
        };
    }
    let options = Options {
        tolerance: arguments.tol.clone(),
        budget: arguments.budget as usize,
        name: file.name.clone(),
        snapped_joints: (file.snapped > 0).then_some(file.snapped as u64),
        solver: &GoodLp,
    };
    let start = Instant::now();
    let certified = certify(&file.curve, &problem, &options);
    let written = match &certified.document {
        None => None,
        Some(document) => match &target {
            Some(target) => {
                let encoding = encoding(arguments.format, target.path());
                Some(target.write(|file| write_checked(document, encoding, file).map_err(|error| failure(&error)))?)
            }
            None => {
                let mut nowhere = SpooledTempFile::new(1 << 26);
                write_checked(document, knotproof::certificate::Encoding::Json, &mut nowhere)
                    .map_err(|error| failure(&error))?;
                None
            }
        },
    };
    let report = Report {
        arguments,
        problem: &problem,
        certified: &certified,
        written,
        seconds: start.elapsed().as_secs_f64(),
    };
    if arguments.printing.json {
        say_json(&report.for_programs())?;
    } else if !arguments.printing.quiet {
        say(&report.for_people())?;
    }
    Ok(match certified.status {
        Status::Certified => Exit::Success,
        Status::Undecided(_) => Exit::Undecided,
    })
}

fn failure(error: &CertifyError) -> Failure {
    match error {
        CertifyError::Io(error) => Failure::io("the certificate", "cannot be written", error),
        CertifyError::Refuted(_) => Failure::new(format!("{error}; this is an error of knotproof, please report it")),
    }
}

impl Arguments {
    fn problem(&self, file: &CurveFile) -> Result<Problem, Failure> {
        let bounds = match (&self.edge, &self.box_from, &self.box_to) {
            (Some(edge), _, _) => Bounds::Edge(edge.clone()),
            (None, Some(low), Some(high)) => Bounds::Corners(Corners {
                low: low.0.clone(),
                high: high.0.clone(),
            }),
            _ => return Err(Failure::new("expected --box, or --box-from and --box-to")),
        };
        let question = Question {
            point: self.point,
            sign: self.sign.map(|sign| match sign {
                SignName::Plus => Sign::Positive,
                SignName::Minus => Sign::Negative,
            }),
            interval: self
                .interval
                .as_ref()
                .and_then(|ends| <[Rational; 2]>::try_from(ends.clone()).ok()),
            bounds,
        };
        Problem::new(&file.curve, &question).map_err(|error| Failure::at(&self.curve, error))
    }

    /// The paper's algorithm.
    fn levels<const D: usize>(&self, file: &CurveFile, problem: &Problem) -> Result<Exit, Failure> {
        let context = Context::new(&file.curve, &problem.domain).map_err(|error| Failure::at(&self.curve, error))?;
        let degree = match self.degree {
            Some(DegreeName::Paper) => Degree::Paper,
            _ => Degree::True,
        };
        let chain = file.curve.chain();
        let polynomial = |piece: usize| chain.pieces()[piece].is_polynomial();
        let mut levels = Levels::<D>::new(&context, degree, polynomial).map_err(|piece| {
            let what = format!("--degree paper is for polynomial pieces, and piece {piece} is rational");
            Failure::at(&self.curve, what)
        })?;
        let mut done = Vec::new();
        let reached = loop {
            let (level, _) = levels.step(self.exact_measure);
            let enough = level.relative_error.as_ref().is_some_and(|error| error[1] <= self.tol);
            let last = level.level;
            done.push(level);
            match self.level {
                Some(wanted) if last == wanted => break true,
                None if enough => break true,
                None if last == MOST_LEVELS
                    || done.iter().map(|level| level.inequalities).sum::<usize>() > self.budget as usize * 4 =>
                {
                    break false;
                }
                _ => {}
            }
        };
        let empty = done.iter().all(|level| level.vertices == 0);
        if self.printing.json {
            say_json(&LevelsLine {
                status: if reached && !empty { "done" } else { "undecided" },
                statement: DomainOnly::new(problem),
                degree: if degree == Degree::Paper { "paper" } else { "true" },
                first_non_empty: done.iter().find(|level| level.vertices > 0).map(|level| level.level),
                levels: done.iter().map(|level| LevelLine::new(level, D)).collect(),
            })?;
        } else if !self.printing.quiet {
            say(&table(&done, D))?;
        }
        Ok(if reached && !empty {
            Exit::Success
        } else {
            Exit::Undecided
        })
    }
}

#[derive(Serialize)]
struct LevelsLine {
    status: &'static str,
    #[serde(flatten)]
    statement: DomainOnly,
    degree: &'static str,
    first_non_empty: Option<u32>,
    levels: Vec<LevelLine>,
}

#[derive(Serialize)]
struct DomainOnly {
    points: Vec<usize>,
    sign: &'static str,
    interval: Vec<String>,
    open: [bool; 2],
}

impl DomainOnly {
    fn new(problem: &Problem) -> DomainOnly {
        DomainOnly {
            points: problem.domain.points.clone(),
            sign: problem.domain.sign.name(),
            interval: problem.domain.interval.iter().map(Rational::format).collect(),
            open: problem.domain.open,
        }
    }
}

#[derive(Serialize)]
struct LevelLine {
    level: u32,
    inequalities: usize,
    vertices: usize,
    facets: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    area: Option<[String; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    volume: Option<[String; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact_measure: Option<String>,
    absolute_error: Option<[String; 2]>,
    relative_error: Option<[String; 2]>,
    seconds: f64,
}

impl LevelLine {
    fn new(level: &Level, dimension: usize) -> LevelLine {
        let interval = |[low, high]: &[Rational; 2]| decimals(low, high);
        let measure = interval(&level.measure);
        let (area, volume) = match dimension {
            2 => (Some(measure), None),
            _ => (None, Some(measure)),
        };
        LevelLine {
            level: level.level,
            inequalities: level.inequalities,
            vertices: level.vertices,
            facets: level.facets,
            area,
            volume,
            exact_measure: level.exact_measure.as_ref().map(Rational::format),
            absolute_error: level.absolute_error.as_ref().map(interval),
            relative_error: level.relative_error.as_ref().map(interval),
            seconds: level.seconds,
        }
    }
}

fn table(levels: &[Level], dimension: usize) -> String {
    let measure = if dimension == 2 { "area ≥" } else { "volume ≥" };
    let mut text = format!(
        "{:>5} {:>12} {:>8} {:>7} {:>14} {:>12} {:>12} {:>9}\n",
        "level", "inequalities", "vertices", "facets", measure, "abs.error ≤", "rel.error ≤", "seconds"
    );
    for level in levels {
        let up = |error: &Option<[Rational; 2]>| error.as_ref().map_or("–".into(), |error| decimal_up(&error[1], 5));
        let _ = writeln!(
            text,
            "{:>5} {:>12} {:>8} {:>7} {:>14} {:>12} {:>12} {:>9.4}",
            level.level,
            level.inequalities,
            level.vertices,
            level.facets,
            decimal_down(&level.measure[0], TABLE_DIGITS),
            up(&level.absolute_error),
            up(&level.relative_error),
            level.seconds
        );
    }
    match levels.iter().find(|level| level.vertices > 0) {
        Some(level) => {
            let _ = writeln!(text, "first level that is not empty: {}", level.level);
        }
        None => text.push_str("all levels are empty; that says nothing about the domain itself\n"),
    }
    if let Some(exact) = levels.last().and_then(|level| level.exact_measure.as_ref()) {
        let _ = writeln!(text, "exact measure of the last: {}", exact.format());
    }
    text
}

struct Report<'a> {
    arguments: &'a Arguments,
    problem: &'a Problem,
    certified: &'a Certified<'a>,
    written: Option<Written>,
    seconds: f64,
}

#[derive(Serialize)]
struct ReportLine<'a> {
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    #[serde(flatten)]
    statement: Option<DomainLine>,
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
    estimates: [f64; 2],
    seconds: f64,
}

impl Report<'_> {
    fn for_programs(&self) -> ReportLine<'_> {
        let (status, reason) = match &self.certified.status {
            Status::Certified => ("certified", None),
            Status::Undecided(why) => ("undecided", Some(why.as_str())),
        };
        let rounds = self.certified.rounds.iter().enumerate();
        ReportLine {
            status,
            reason,
            statement: self
                .certified
                .document
                .as_ref()
                .map(|document| DomainLine::new(&document.claim.statement)),
            levels: rounds.map(|(level, round)| RoundLine::new(level, round)).collect(),
            seconds: self.seconds,
            certificate: self.written.as_ref().map(|written| written.path.display().to_string()),
        }
    }

    fn for_people(&self) -> String {
        let mut text = String::new();
        let domain = &self.problem.domain;
        if domain.points.len() > 1 && self.arguments.printing.quiet {
            return text;
        }
        match &self.certified.document {
            Some(document) => {
                let _ = writeln!(text, "{}", in_words(&document.claim.statement));
                if let Outcome::Sandwich { .. } = document.claim.statement.outcome
                    && let Some(round) = self.certified.rounds.last()
                {
                    let _ = writeln!(
                        text,
                        "inner polytope on {} points, outer polytope of {} inequalities with {} vertices, {} rounds, {:.3} s",
                        round.inner_points,
                        round.inequalities,
                        round.vertices,
                        self.certified.rounds.len(),
                        self.seconds
                    );
                }
            }
            None => {
                let _ = writeln!(text, "nothing about the domain for {} is proved", quantity(domain));
            }
        }
        for (end, name) in [(0, "start"), (1, "end")] {
            if domain.open[end] {
                let _ = writeln!(
                    text,
                    "the {name} of the interval is left open: the sign function vanishes there wherever the point is"
                );
            }
        }
        if let Status::Undecided(why) = &self.certified.status {
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
            estimates: round.measures,
            seconds: round.seconds,
        }
    }
}
