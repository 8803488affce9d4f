//! The paper's algorithm, as a table or as JSON.

use std::fmt::Write as _;

use knotproof::check::domain::Context;
use knotproof::curve::CurveFile;
use knotproof::number::{Rational, RationalExt, decimal_down, decimal_up};
use knotproof::prove::domain::Problem;
use knotproof::prove::domain::levels::{Degree, Level, Levels};
use serde::Serialize;

use super::{Arguments, DegreeName, MOST_LEVELS};
use crate::cli::Exit;
use crate::cli::domain_words::decimals;
use crate::cli::failure::Failure;
use crate::cli::output::{say, say_json};

/// Digits of a measure in a table.
const TABLE_DIGITS: usize = 6;

impl Arguments {
    /// The paper's algorithm.
    pub fn levels<const D: usize>(&self, file: &CurveFile, problem: &Problem) -> Result<Exit, Failure> {
        let context = Context::new(&file.curve, &problem.domain).map_err(|error| Failure::at(&self.curve[0], error))?;
        let degree = match self.degree {
            Some(DegreeName::Paper) => Degree::Paper,
            _ => Degree::True,
        };
        let chain = file.curve.chain();
        let polynomial = |piece: usize| chain.pieces()[piece].is_polynomial();
        let mut levels = Levels::<D>::new(&context, degree, polynomial).map_err(|piece| {
            let what = format!("--degree paper is for polynomial pieces, and piece {piece} is rational");
            Failure::at(&self.curve[0], what)
        })?;
        let tolerance = self.tolerance(false);
        let mut done = Vec::new();
        let reached = loop {
            let (level, _) = levels.step(self.exact_measure);
            let enough = level.relative_error.as_ref().is_some_and(|error| error[1] <= tolerance);
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
        if self.common.printing.json {
            say_json(&LevelsLine {
                status: if reached && !empty { "done" } else { "undecided" },
                statement: DomainOnly::new(problem),
                degree: if degree == Degree::Paper { "paper" } else { "true" },
                first_non_empty: done.iter().find(|level| level.vertices > 0).map(|level| level.level),
                levels: done.iter().map(|level| LevelLine::new(level, D)).collect(),
            })?;
        } else if !self.common.printing.quiet {
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
