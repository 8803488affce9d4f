//! `knotproof compare`: the numbers of papers beside certified ones, as a table.

mod domain;
mod peers;
mod picture;

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};
use knotproof::compare::{Comparison, Options, Row, Standing, Value, compare};
use knotproof::curve::CurveFile;
use knotproof::number::{Meaning, Rational, RationalExt, parse_number};
use serde::Serialize;

use crate::cli::atomic_file::AtomicFile;
use crate::cli::certify::progress::Progress;
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::cli::output::{say, say_json};
use crate::cli::{Exit, Printing};

/// What papers compute of a curve, beside what is certified
///
/// For a polynomial curve: the numbers of Cassidy, Peters and Jordan (2012), of the method before theirs, and what their polygon proves; for every curve: σ, embedding, curvature, thickness and the
/// deviation of the control polygon, certified and replayed by the checker. With --point also the levels of Ginnis, Karousos and Kaklis (2009) for the convex domain of that control point, beside the certified
/// domain. "as printed" stands at numbers of a paper's formulas that are not proved of the curve. The exit code is 3 when a certified
/// row is undecided.
#[derive(Args)]
pub struct Arguments {
    /// The curve, a file of version curve/1 or of a format that `import` reads; "-" is standard input.
    curve: Input,
    /// δ, the tolerance of the estimate of the minimum separation distance: a positive decimal or fraction.
    #[arg(long, value_name = "TOLERANCE", default_value = "0.25", allow_hyphen_values = true, value_parser = parse_tolerance)]
    delta: Rational,
    /// ε_d, the tolerance of the test for double normals: a positive decimal or fraction.
    #[arg(long, value_name = "TOLERANCE", default_value = "0.01", allow_hyphen_values = true, value_parser = parse_tolerance)]
    epsilon_d: Rational,
    #[command(flatten)]
    domain: domain::DomainArguments,
    #[command(flatten)]
    peers: peers::PeerArguments,
    /// The form of the table.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Draw the bounds on one axis, and the errors of the levels, as SVG to this file.
    #[arg(long, value_name = "FILE.svg")]
    picture: Option<PathBuf>,
    /// Where a Bézier piece does not start exactly where the one before ends, move its start there.
    #[arg(long)]
    snap_joints: bool,
    #[cfg(feature = "import")]
    #[command(flatten)]
    reading: crate::cli::reading::Reading,
    /// What is printed.
    #[command(flatten)]
    printing: Printing,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Columns for people
    Text,
    /// A table of Markdown
    Markdown,
    /// Comma-separated values with a header
    Csv,
    /// One JSON object, the same as with --json
    Json,
}

fn parse_tolerance(text: &str) -> Result<Rational, String> {
    let value = parse_number(text, Meaning::Decimal).map_err(|error| error.to_string())?;
    match value.numer().is_positive() {
        true => Ok(value),
        false => Err("expected a positive number".into()),
    }
}

/// The object of JSON.
#[derive(Serialize)]
struct ForPrograms<'r> {
    curve: Option<&'r str>,
    delta: String,
    epsilon_d: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    domain: Option<domain::ComparedDomainLine>,
    rows: Vec<RowLine<'r>>,
    seconds: f64,
}

/// A row of it.
#[derive(Serialize)]
struct RowLine<'r> {
    method: &'r str,
    key: &'r str,
    quantity: &'r str,
    standing: &'static str,
    /// A decimal at most the number, or "inf".
    lower: Option<String>,
    /// A decimal at least the number, or "inf".
    upper: Option<String>,
    /// The number as a fraction, where it is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<String>,
    /// Its bounds as squared fractions, where it is a root.
    #[serde(skip_serializing_if = "Option::is_none")]
    squared: Option<[Option<String>; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    remark: Option<&'r str>,
}

impl<'r> RowLine<'r> {
    fn new(row: &'r Row) -> RowLine<'r> {
        let (lower, upper) = row.value.decimals();
        RowLine {
            method: row.method,
            key: &row.key,
            quantity: &row.quantity,
            standing: row.standing.name(),
            lower,
            upper,
            exact: match &row.value {
                Value::Count(count) => Some(count.to_string()),
                Value::Number(x) => Some(x.format()),
                _ => None,
            },
            squared: match &row.value {
                Value::RootBetween(lower, upper) => Some([Some(lower.format()), upper.as_ref().map(Rational::format)]),
                _ => None,
            },
            remark: row.remark.as_deref(),
        }
    }
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let picture = arguments.picture.as_deref().map(AtomicFile::new).transpose()?;
    if let (Some(picture), Input::File(curve)) = (&picture, &arguments.curve)
        && picture.replaces(curve)
    {
        return Err(Failure::at(
            picture.path().display(),
            "the picture would replace the curve",
        ));
    }
    #[cfg(feature = "import")]
    let (file, _) = arguments
        .curve
        .read_curve_with(arguments.snap_joints, &arguments.reading)?;
    #[cfg(not(feature = "import"))]
    let file = arguments.curve.read_curve(arguments.snap_joints)?;
    let options = Options {
        delta: arguments.delta.clone(),
        epsilon_d: arguments.epsilon_d.clone(),
        domain: arguments.domain.options()?,
        peers: arguments.peers.options(),
        ..Options::default()
    };
    let start = Instant::now();
    let progress = Progress::new(arguments.printing.quiet);
    let comparison = compare(&file.curve, &options, &|part| progress.at(part))
        .map_err(|error| Failure::at(&arguments.curve, error))?;
    drop(progress);
    let Comparison { rows, domain } = &comparison;
    let seconds = start.elapsed().as_secs_f64();
    if let Some(target) = &picture {
        let chart = picture::chart(title(arguments, &file), &comparison, arguments.domain.tolerance());
        let mut file = target.begin()?;
        file.write_all(chart.svg().as_bytes())
            .map_err(|error| target.failure(&error))?;
        target.finish(file)?;
    }
    let json = arguments.printing.json || arguments.format == Format::Json;
    if json {
        say_json(&ForPrograms {
            curve: file.name.as_deref(),
            delta: options.delta.format(),
            epsilon_d: options.epsilon_d.format(),
            domain: domain.as_ref().map(domain::ComparedDomainLine::new),
            rows: rows.iter().map(RowLine::new).collect(),
            seconds,
        })?;
    } else if !arguments.printing.quiet {
        say(&match arguments.format {
            Format::Markdown => markdown(rows),
            Format::Csv => csv(rows),
            _ => words(arguments, &file, &comparison, seconds),
        })?;
    }
    match rows.iter().any(|row| row.standing == Standing::Undecided) {
        true => Ok(Exit::Undecided),
        false => Ok(Exit::Success),
    }
}

/// The heading of the picture.
fn title(arguments: &Arguments, file: &CurveFile) -> String {
    match &file.name {
        Some(name) => format!("Bounds for {name}"),
        None => format!("Bounds for {}", arguments.curve),
    }
}

/// A value for people.
fn value(row: &Row) -> String {
    match row.value.decimals() {
        (None, _) => "–".into(),
        (Some(lower), Some(upper)) if lower == upper => lower,
        (Some(lower), Some(upper)) => format!("{lower} … {upper}"),
        (Some(lower), None) => format!("at least {lower}"),
    }
}

fn words(arguments: &Arguments, file: &CurveFile, comparison: &Comparison, seconds: f64) -> String {
    let rows = &comparison.rows;
    let name = match &file.name {
        Some(name) => format!("{name:?}"),
        None => arguments.curve.to_string(),
    };
    let (delta, epsilon_d) = (arguments.delta.format(), arguments.epsilon_d.format());
    let mut text = format!("{name}, δ = {delta}, ε_d = {epsilon_d}\n");
    if let Some(domain) = &comparison.domain {
        let _ = writeln!(text, "{}", domain::words(domain));
    }
    let width = |of: &dyn Fn(&Row) -> usize| rows.iter().map(of).max().unwrap_or(0);
    let quantities = width(&|row| columns(&row.quantity));
    let values = width(&|row| value(row).chars().count());
    let mut method = "";
    for row in rows {
        if row.method != method {
            method = row.method;
            let _ = writeln!(text, "{method}");
        }
        let (quantity, value, standing) = (&row.quantity, value(row), row.standing.name());
        let space = " ".repeat(quantities - columns(quantity));
        let _ = write!(text, "  {quantity}{space}  {value:values$}  {standing}");
        if let Some(remark) = &row.remark {
            let _ = write!(text, ": {remark}");
        }
        text.push('\n');
    }
    let _ = writeln!(text, "{seconds:.3} s");
    text
}

/// The columns that a text takes: the tilde of m̃ stands above its letter.
fn columns(text: &str) -> usize {
    text.chars().filter(|c| *c != '\u{303}').count()
}

fn markdown(rows: &[Row]) -> String {
    let mut text = String::from("| method | quantity | value | standing | remark |\n| --- | --- | --- | --- | --- |\n");
    for row in rows {
        let cells = [
            row.method,
            &row.quantity,
            &value(row),
            row.standing.name(),
            row.remark.as_deref().unwrap_or(""),
        ]
        .map(|cell| cell.replace('|', "∣"));
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    text
}

fn csv(rows: &[Row]) -> String {
    let mut text = String::from("method,key,quantity,standing,lower,upper,remark\n");
    for row in rows {
        let (lower, upper) = row.value.decimals();
        let cells = [
            row.method,
            row.key.as_ref(),
            &row.quantity,
            row.standing.name(),
            lower.as_deref().unwrap_or(""),
            upper.as_deref().unwrap_or(""),
            row.remark.as_deref().unwrap_or(""),
        ]
        .map(quoted);
        let _ = writeln!(text, "{}", cells.join(","));
    }
    text
}

/// A cell in the quotes that RFC 4180 asks for.
fn quoted(cell: &str) -> String {
    match cell.contains([',', '"', '\n']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.into(),
    }
}
