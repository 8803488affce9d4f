//! `knotproof certify domain`: the convex domain of a control point.

mod levels;
mod report;

use std::time::Instant;

use clap::{Args, ValueEnum};
use knotproof::claim::domain::{Box as Corners, Sign};
use knotproof::curve::CurveFile;
use knotproof::number::{Meaning, Rational, parse_number};
use knotproof::prove::domain::questions::{About, AnswerError, answer, usual_width};
use knotproof::prove::domain::{Bounds, Certified, Options, Problem, Question, Status, certify};
use knotproof::prove::linear_program::GoodLp;
use report::Report;

use super::output_file::{Common, write};
use super::time_limit::search_is_over;
use crate::cli::Exit;
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::cli::output::{say, say_json};

/// Levels of the paper's algorithm at most.
const MOST_LEVELS: u32 = 24;
/// Where a control point may be so that curvature (in the plane) or torsion (in space) keeps its sign
///
/// The output is a polytope inside the convex domain K and one around it, both cut off by a box, and the certified relative error between them. With
/// --degree or --level the algorithm of Ginnis, Karousos and Kaklis (2009) runs instead, level by level, and no certificate is made.
#[derive(Args)]
pub struct Arguments {
    /// The curve, a file of version curve/1 or of a format that `import` reads; "-" is standard input. Several files, or a folder, make a batch.
    #[arg(required = true)]
    pub curve: Vec<Input>,
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
    ///
    /// Of a question, how far apart its bounds may be, relative to the upper one [default: 1e-6; of a question 1e-9]
    #[arg(long, value_name = "TOL", allow_hyphen_values = true, value_parser = tolerance)]
    tol: Option<Rational>,
    /// Which position in the domain and the box is nearest to this point?
    #[arg(long, value_name = "X,Y[,Z]", group = "question", conflicts_with_all = ["degree", "level"], allow_hyphen_values = true, value_parser = coordinates)]
    nearest: Option<Coordinates>,
    /// Which position in the domain and the box makes the integral of |c''|² least?
    #[arg(long, group = "question", conflicts_with_all = ["degree", "level"])]
    fair: bool,
    /// What is the shortest move of the point that changes the sign?
    #[arg(long, group = "question", conflicts_with_all = ["degree", "level"])]
    change: bool,
    /// What is the largest ball (in the plane, disc) in the domain and the box?
    #[arg(long, group = "question", conflicts_with_all = ["degree", "level"])]
    ball: bool,
    /// The paper's algorithm, the sign function written in this degree.
    #[arg(long, value_enum, conflicts_with = "output")]
    degree: Option<DegreeName>,
    /// The paper's algorithm up to this level, whatever the tolerance.
    #[arg(long, value_name = "LEVEL", conflicts_with = "output", value_parser = clap::value_parser!(u32).range(0..=i64::from(MOST_LEVELS)))]
    level: Option<u32>,
    /// Print areas and volumes of the levels (with --json, of the rounds) as exact fractions too.
    #[arg(long)]
    exact_measure: bool,
    /// How many inequalities the outer polytope may have at most.
    #[arg(long, value_name = "ROWS", default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(1..))]
    budget: u32,
    #[command(flatten)]
    pub common: Common,
}

#[derive(Clone, Copy, ValueEnum)]
pub(in crate::cli) enum SignName {
    /// Greater than 0
    #[value(name = "+", alias = "plus")]
    Plus,
    /// Less than 0
    #[value(name = "-", alias = "minus")]
    Minus,
}

impl From<SignName> for Sign {
    fn from(name: SignName) -> Sign {
        match name {
            SignName::Plus => Sign::Positive,
            SignName::Minus => Sign::Negative,
        }
    }
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
pub(in crate::cli) struct Coordinates(pub Vec<Rational>);

pub(in crate::cli) fn number(text: &str) -> Result<Rational, String> {
    parse_number(text, Meaning::Decimal).map_err(|error| error.to_string())
}

pub(in crate::cli) fn coordinates(text: &str) -> Result<Coordinates, String> {
    text.split(',').map(number).collect::<Result<_, _>>().map(Coordinates)
}

pub(in crate::cli) fn tolerance(text: &str) -> Result<Rational, String> {
    let value = number(text)?;
    if value <= Rational::from_integer(0.into()) {
        return Err("expected a tolerance greater than 0".into());
    }
    Ok(value)
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let target = arguments.common.target(&arguments.curve[0])?;
    let file = arguments.common.read(&arguments.curve[0])?;
    let problem = arguments.problem(&file)?;
    if arguments.degree.is_some() || arguments.level.is_some() {
        return match file.curve.dimension() {
            2 => arguments.levels::<2>(&file, &problem),
            _ => arguments.levels::<3>(&file, &problem),
        };
    }
    let about = arguments.about();
    let options = Options {
        tolerance: arguments.tolerance(about.is_some()),
        budget: arguments.budget as usize,
        name: file.name.clone(),
        snapped_joints: (file.snapped > 0).then_some(file.snapped as u64),
        measure_rounds: arguments.common.printing.json,
        solver: &GoodLp,
    };
    let start = Instant::now();
    let found = match &about {
        None => certify(&file.curve, &problem, &options),
        Some(about) => arguments.answer(&file, &problem, about, &options)?,
    };
    search_is_over();
    let written = match &found.document {
        None => None,
        Some(document) => write(document, target.as_ref(), arguments.common.format)?,
    };
    let report = Report {
        exact_measure: arguments.exact_measure,
        input: &arguments.curve[0],
        file: &file,
        problem: &problem,
        document: found.document.as_ref(),
        status: &found.status,
        rounds: &found.rounds,
        written,
        seconds: start.elapsed().as_secs_f64(),
    };
    if arguments.common.printing.json {
        say_json(&report.for_programs())?;
    } else if !arguments.common.printing.quiet {
        say(&report.for_people())?;
    }
    Ok(match found.status {
        Status::Certified => Exit::Success,
        Status::Undecided(_) => Exit::Undecided,
    })
}

impl Arguments {
    fn tolerance(&self, question: bool) -> Rational {
        match &self.tol {
            Some(tolerance) => tolerance.clone(),
            None if question => usual_width(),
            None => Rational::new(1.into(), 1_000_000.into()),
        }
    }

    /// The question about the domain, if there is one.
    fn about(&self) -> Option<About> {
        match &self.nearest {
            Some(point) => Some(About::Nearest(point.0.clone())),
            None if self.fair => Some(About::Fair),
            None if self.change => Some(About::Change),
            None if self.ball => Some(About::Ball),
            None => None,
        }
    }

    /// The answer to a question, which can be that the domain is empty.
    fn answer<'c>(
        &self,
        file: &'c CurveFile,
        problem: &Problem,
        about: &About,
        options: &Options,
    ) -> Result<Certified<'c>, Failure> {
        match answer(&file.curve, problem, about, options) {
            Ok(found) => Ok(Certified {
                document: Some(found.document),
                status: found.status,
                rounds: Vec::new(),
            }),
            Err(AnswerError::Empty(_)) => Ok(certify(&file.curve, problem, options)),
            Err(error @ (AnswerError::NoPoint | AnswerError::Unsolved(_))) => Ok(Certified {
                document: None,
                status: Status::Undecided(error.to_string()),
                rounds: Vec::new(),
            }),
            Err(error @ AnswerError::Refuted(_)) => Err(Failure::new(format!(
                "{error}; this is an error of knotproof, please report it"
            ))),
            Err(error) => Err(Failure::at(&self.curve[0], error)),
        }
    }

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
            sign: self.sign.map(Sign::from),
            interval: self
                .interval
                .as_ref()
                .and_then(|ends| <[Rational; 2]>::try_from(ends.clone()).ok()),
            bounds,
        };
        Problem::new(&file.curve, &question).map_err(|error| Failure::at(&self.curve[0], error))
    }
}
