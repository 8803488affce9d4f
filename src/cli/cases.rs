//! `knotproof cases`: makes cases for engines.

use std::collections::HashSet;
use std::fs;
use std::path::PathBuf;

use clap::Args;
use knotproof::engine::generate::{GENERATED, Options, float_curves, generate};
use knotproof::engine::{Case, CasesFile, write_cases};

use super::Exit;
use super::failure::Failure;
use super::input::{Input, standard_input_once};
use super::output::{complain, say};

/// Make cases for floating-point engines, from a seed or about the curves of a corpus
///
/// The cases are written as JSON, version cases/1 (docs/schema/cases.schema.json). The same seed gives the same cases everywhere.
#[derive(Args)]
pub struct Arguments {
    /// The seed.
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// How many cases.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    count: u32,
    /// Ask about these curves, files of version curve/1, rounded to binary64; without them curves are made.
    #[arg(long, value_name = "CURVE", num_args = 1..)]
    curves: Vec<Input>,
    /// Ask what these certificates of the claims values and msd prove; entries whose curve or numbers do not survive rounding to binary64 are left out.
    #[arg(long, value_name = "CERT", num_args = 1.., conflicts_with_all = ["curves", "ops", "seed", "count"])]
    certificates: Vec<Input>,
    /// Only these operations, separated by commas [default: all but convex_domain]
    #[arg(long, value_name = "OPERATIONS", value_delimiter = ',', value_parser = clap::builder::PossibleValuesParser::new(GENERATED))]
    ops: Vec<String>,
    /// Write the cases to this file [default: standard output]
    #[arg(long, short, value_name = "CASES")]
    output: Option<PathBuf>,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    standard_input_once(arguments.curves.iter().chain(&arguments.certificates))?;
    let cases = if arguments.certificates.is_empty() {
        made(arguments)?
    } else {
        match proved(&arguments.certificates)? {
            Some(cases) => cases,
            None => return Ok(Exit::Refuted),
        }
    };
    let text = write_cases(&cases);
    match &arguments.output {
        None => say(&text)?,
        Some(path) => fs::write(path, text).map_err(|e| Failure::io(path.display(), "cannot be written", &e))?,
    }
    Ok(Exit::Success)
}

/// The cases of certificates; nothing when one is rejected.
fn proved(certificates: &[Input]) -> Result<Option<CasesFile>, Failure> {
    let mut cases: Vec<Case> = Vec::new();
    for certificate in certificates {
        match super::validate::proved::cases(certificate)? {
            Ok(found) => cases.extend(found.into_iter().map(|certified| certified.case)),
            Err(rejection) => {
                complain(&Failure::at(certificate, format!("rejected: {rejection}")));
                return Ok(None);
            }
        }
    }
    let mut seen = HashSet::new();
    cases.retain(|case| seen.insert(case.id.clone()));
    if cases.is_empty() {
        return Err(Failure::new(
            "--certificates: nothing in them can be asked of an engine",
        ));
    }
    Ok(Some(CasesFile { seed: None, cases }))
}

fn made(arguments: &Arguments) -> Result<CasesFile, Failure> {
    let mut curves = Vec::new();
    for input in &arguments.curves {
        curves.extend(float_curves(&input.read_curve(false)?.curve));
    }
    if curves.is_empty() && !arguments.curves.is_empty() {
        return Err(Failure::new(
            "--curves: none of the curves is one any more when its numbers are rounded to binary64",
        ));
    }
    let operations = GENERATED
        .into_iter()
        .filter(|name| arguments.ops.iter().any(|asked| asked == name));
    Ok(generate(&Options {
        seed: arguments.seed,
        count: arguments.count as usize,
        operations: operations.collect(),
        curves,
    }))
}
