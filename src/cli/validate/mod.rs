//! `knotproof validate`: holds the results of an engine against exact ones.

mod msd;
pub mod proved;

use std::collections::HashMap;
use std::fmt::Write as _;
use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use knotproof::engine::{Case, Engine, FileError, ResultEntry, ResultsFile, read_cases, read_results};
use knotproof::validate::{
    KnotproofF64, Outcome, Report, Tolerances, Truth, Verdict, annotations, junit, sarif, truth,
};
use serde::Serialize;

use super::failure::Failure;
use super::input::{Input, standard_input_once};
use super::output::{say, say_json};
use super::{Exit, Printing};

/// How many findings are shown to people before the rest is only counted.
const SHOWN: usize = 20;

/// Hold the results of a floating-point engine against exact ones
///
/// An answer is right, so many units in the last place off, or wrong, outside the tolerance of its operation, with the exact value beside it.
/// The exit code is 0 when at least one answer is right and none wrong or missing, 1 when one is, 2 for files that cannot be used, 3 when there was nothing to judge.
#[derive(Args)]
pub struct Arguments {
    /// The engine's answers, a file of version results/1 ("-" is standard input), then certificates of the claims values and msd, which are checked first and
    /// then held against the results. With --engine certificates alone.
    #[arg(value_name = "RESULTS] [CERT", required_unless_present = "engine")]
    files: Vec<Input>,
    /// Judge an engine of this program, which needs no file of results.
    #[arg(long, value_name = "ENGINE", value_parser = [KnotproofF64::NAME])]
    engine: Option<String>,
    /// The cases that were answered, a file of version cases/1; their exact results are computed.
    #[arg(long, value_name = "CASES")]
    cases: Option<Input>,
    /// Tolerances of the operations in units in the last place, a file of version tolerances/1.
    #[arg(long, value_name = "FILE")]
    tolerances: Option<Input>,
    /// Write the judgements as JUnit XML to this file.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write wrong and missing answers as SARIF 2.1.0 to this file.
    #[arg(long, value_name = "FILE")]
    sarif: Option<PathBuf>,
    /// What is printed on standard output.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    #[command(flatten)]
    printing: Printing,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A table, and the wrong answers
    Text,
    /// Annotations of GitHub Actions
    Github,
}

#[derive(Serialize)]
struct ForPrograms<'a> {
    engine: &'a str,
    outcome: &'static str,
    operations: Vec<OperationLine>,
    findings: Vec<FindingLine<'a>>,
}

#[derive(Serialize)]
struct OperationLine {
    operation: &'static str,
    cases: usize,
    right: usize,
    wrong: usize,
    refused: usize,
    not_offered: usize,
    missing: usize,
    unjudged: usize,
    worst_ulps: f64,
}

#[derive(Serialize)]
struct FindingLine<'a> {
    id: &'a str,
    operation: &'static str,
    kind: &'static str,
    text: String,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let named = [arguments.cases.as_ref(), arguments.tolerances.as_ref()];
    standard_input_once(named.into_iter().flatten().chain(&arguments.files))?;
    let (results, certificates) = match (&arguments.engine, arguments.files.as_slice()) {
        (None, [results, certificates @ ..]) => (Some(results), certificates),
        (_, certificates) => (None, certificates),
    };
    if certificates.is_empty() && arguments.cases.is_none() {
        return Err(Failure::new(
            "nothing to judge by: name certificates of the claims values and msd, or --cases CASES",
        ));
    }
    let mut cases = match &arguments.cases {
        None => Vec::new(),
        Some(file) => read(file, |text| read_cases(text))?.cases,
    };
    let read_answers = results.map(|file| read(file, |text| read_results(text))).transpose()?;
    let tolerances = match &arguments.tolerances {
        None => Tolerances::default(),
        Some(file) => read(file, |text| Tolerances::read(text))?,
    };
    let mut proved: HashMap<String, Truth> = HashMap::new();
    for certificate in certificates {
        let found = match proved::cases(certificate)? {
            Ok(found) => found,
            Err(rejection) => {
                if !arguments.printing.quiet {
                    say(&format!("rejected: {certificate}: {rejection}\n"))?;
                }
                return Ok(Exit::Refuted);
            }
        };
        for certified in found {
            if proved.insert(certified.case.id.clone(), certified.truth).is_none() {
                cases.push(certified.case);
            }
        }
    }
    // Certificates of other claims have nothing to ask.
    let answers = match read_answers {
        Some(answers) => answers,
        None => of_engine(&KnotproofF64, &cases),
    };
    let exact = |case: &Case| match proved.get(&case.id) {
        Some(truth) => truth.clone(),
        None => truth(case, &msd::bounds),
    };
    let name = results.map_or_else(|| answers.engine.clone(), Input::to_string);
    let report = Report::new(&cases, &answers, &tolerances, exact).map_err(|unknown| {
        let what = format!(
            "results[{}].id: found {:?}, expected the id of a case",
            unknown.index, unknown.id
        );
        Failure::at(&name, what)
    })?;
    if let Some(path) = &arguments.junit {
        let text = junit(&report).map_err(|error| Failure::at(path.display(), error))?;
        write(path, &text)?;
    }
    if let Some(path) = &arguments.sarif {
        write(path, &sarif(&report, &name))?;
    }
    if arguments.printing.json {
        say_json(&for_programs(&report))?;
    } else if arguments.format == Format::Github {
        say(&annotations(&report, &name))?;
    } else if !arguments.printing.quiet {
        say(&for_people(&report))?;
    }
    Ok(match report.outcome() {
        Outcome::Passed => Exit::Success,
        Outcome::Failed => Exit::Refuted,
        Outcome::NothingJudged => Exit::Undecided,
    })
}

/// The answers of an engine of this program.
fn of_engine(engine: &dyn Engine, cases: &[Case]) -> ResultsFile {
    let results = cases.iter().map(|case| ResultEntry {
        id: case.id.clone(),
        answer: engine.answer(case),
    });
    ResultsFile {
        engine: engine.name(),
        results: results.collect(),
    }
}

fn read<T>(input: &Input, parse: impl Fn(&[u8]) -> Result<T, FileError>) -> Result<T, Failure> {
    let mut text = Vec::new();
    input
        .open()?
        .read_to_end(&mut text)
        .map_err(|error| input.unreadable(&error))?;
    parse(&text).map_err(|error| Failure::at(input, error))
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    fs::write(path, text).map_err(|error| Failure::io(path.display(), "cannot be written", &error))
}

fn outcome(report: &Report) -> &'static str {
    match report.outcome() {
        Outcome::Passed => "passed",
        Outcome::Failed => "failed",
        Outcome::NothingJudged => "nothing judged",
    }
}

fn for_programs(report: &Report) -> ForPrograms<'_> {
    let operations = report
        .by_operation()
        .into_iter()
        .map(|(operation, counts)| OperationLine {
            operation,
            cases: counts.cases,
            right: counts.right,
            wrong: counts.wrong,
            refused: counts.refused,
            not_offered: counts.not_offered,
            missing: counts.missing,
            unjudged: counts.unjudged,
            worst_ulps: counts.worst_ulps,
        });
    let findings = report.findings.iter().filter_map(|finding| {
        let kind = match &finding.verdict {
            Verdict::Wrong(wrong) => wrong.kind.name(),
            Verdict::Missing => "missing",
            _ => return None,
        };
        Some(FindingLine {
            id: &finding.id,
            operation: finding.operation,
            kind,
            text: finding.verdict.to_string(),
        })
    });
    ForPrograms {
        engine: &report.engine,
        outcome: outcome(report),
        operations: operations.collect(),
        findings: findings.collect(),
    }
}

fn for_people(report: &Report) -> String {
    let mut text = format!("{}: {}\n", outcome(report), report.engine);
    let _ = writeln!(
        text,
        "  {:<16}{:>7}{:>8}{:>7}{:>9}{:>13}{:>9}{:>10}  worst units",
        "operation", "cases", "right", "wrong", "refused", "not offered", "missing", "unjudged"
    );
    for (operation, c) in report.by_operation() {
        let worst = if c.right > 0 {
            format!("{:.3}", c.worst_ulps)
        } else {
            "-".into()
        };
        let _ = writeln!(
            text,
            "  {operation:<16}{:>7}{:>8}{:>7}{:>9}{:>13}{:>9}{:>10}  {worst}",
            c.cases, c.right, c.wrong, c.refused, c.not_offered, c.missing, c.unjudged
        );
    }
    let bad = |finding: &&knotproof::validate::Finding| matches!(finding.verdict, Verdict::Wrong(_) | Verdict::Missing);
    for finding in report.findings.iter().filter(bad).take(SHOWN) {
        let _ = writeln!(text, "  {}: {}", finding.id, finding.verdict);
    }
    let count = report.findings.iter().filter(bad).count();
    if count > SHOWN {
        let _ = writeln!(
            text,
            "  and {} more; --json, --junit and --sarif have them all",
            count - SHOWN
        );
    }
    text
}
