//! Runs the adapters on generated cases and writes docs/ENGINES.md; `tests/engines/run.sh` calls it.

mod page;
mod run;
#[path = "../../../src/cli/validate/msd.rs"]
mod shortest;
mod shrink;

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::Parser;
use knotproof::curve::read_curve;
use knotproof::engine::generate::{Options, float_curves, generate};
use knotproof::engine::{Case, Engine, FloatCurve, Operation, ResultEntry, ResultsFile};
use knotproof::validate::{Kind, KnotproofF64, Report, Tolerances, Truth, Verdict, Wrong};
use rayon::prelude::*;

/// Runs engines on generated cases and reports what they get wrong.
#[derive(Parser)]
struct Arguments {
    /// The seed of the cases.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How many cases with made curves.
    #[arg(long, default_value_t = 4000)]
    count: usize,
    /// Further cases about these curves.
    #[arg(long, num_args = 1..)]
    curves: Vec<PathBuf>,
    /// How many of those.
    #[arg(long, default_value_t = 240)]
    curve_count: usize,
    /// How many cases about pairs of plane cubics on a small grid.
    #[arg(long, default_value_t = 40)]
    pair_count: usize,
    /// A command that answers a file of cases, run in the directory of the adapters; often.
    #[arg(long = "engine")]
    engines: Vec<String>,
    /// Where the adapters are.
    #[arg(long, default_value = "tests/engines")]
    adapters: PathBuf,
    /// The most rounds of shrinking.
    #[arg(long, default_value_t = 14)]
    rounds: usize,
    /// The page to write.
    #[arg(long)]
    output: PathBuf,
}

/// What an engine gets wrong in one way.
pub struct Fault {
    /// How many cases.
    pub count: usize,
    /// The smallest of them found.
    pub case: Case,
    /// The answer to it.
    pub wrong: Wrong,
}

/// Operation, way of being wrong, whether the curve is rational, whether its knots are unclamped, whether it is about two cubic Bézier curves: those would
/// all shrink to lines, and cubics are what drawings consist of.
pub type Group = (&'static str, Kind, bool, bool, bool);

/// One engine's report, and its faults.
pub struct Found {
    /// The judgements of all cases.
    pub report: Report,
    /// The smallest case of each group.
    pub faults: BTreeMap<Group, Fault>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments = Arguments::parse();
    let mut cases = generate(&Options {
        seed: arguments.seed,
        count: arguments.count,
        operations: Vec::new(),
        curves: Vec::new(),
    })
    .cases;
    let mut curves = Vec::new();
    for path in &arguments.curves {
        curves.extend(float_curves(&read_curve(std::fs::read(path)?)?.curve));
    }
    if !curves.is_empty() {
        let options = Options {
            seed: arguments.seed,
            count: arguments.curve_count,
            operations: Vec::new(),
            curves,
        };
        cases.extend(generate(&options).cases.into_iter().map(|mut case| {
            case.id = format!("corpus-{}", case.id);
            case
        }));
    }
    let pairs = Options {
        seed: arguments.seed,
        count: arguments.pair_count,
        operations: vec!["curve_distance"],
        curves: cubics(2 * arguments.pair_count),
    };
    if arguments.pair_count > 0 {
        cases.extend(generate(&pairs).cases.into_iter().map(|mut case| {
            case.id = format!("cubics-{}", case.id);
            case
        }));
    }
    eprintln!("{} cases; their exact results …", cases.len());
    let truths: Vec<Truth> = cases.par_iter().map(truth).collect();
    let tolerances = Tolerances::default();
    let places: BTreeMap<&str, usize> = cases
        .iter()
        .enumerate()
        .map(|(i, case)| (case.id.as_str(), i))
        .collect();
    let judged = |results: &ResultsFile| -> Result<Report, String> {
        let report = Report::new(&cases, results, &tolerances, |case| {
            truths[places[case.id.as_str()]].clone()
        })
        .map_err(|unknown| format!("{}: unknown id {}", results.engine, unknown.id))?;
        let total = report.total();
        eprintln!(
            "{}: {} right, {} wrong, {} refused, {} not offered, {} missing, {} unjudged",
            report.engine, total.right, total.wrong, total.refused, total.not_offered, total.missing, total.unjudged
        );
        Ok(report)
    };
    let examine = |command: &String| -> Result<Found, String> {
        let engine = run::Adapter::new(command, &arguments.adapters);
        let report = judged(&engine.answers(&cases)?)?;
        let mut faults = faults(&cases, &report);
        shrink::shrink(&engine, &mut faults, &tolerances, arguments.rounds)?;
        eprintln!("{}: {} ways of being wrong", report.engine, faults.len());
        Ok(Found { report, faults })
    };
    let own = judged(&ResultsFile {
        engine: KnotproofF64.name(),
        results: cases
            .iter()
            .map(|case| ResultEntry {
                id: case.id.clone(),
                answer: KnotproofF64.answer(case),
            })
            .collect(),
    })?;
    let faults = faults(&cases, &own);
    let mut found = vec![Found { report: own, faults }];
    let others: Result<Vec<Found>, String> = arguments.engines.par_iter().map(examine).collect();
    found.extend(others?);
    let page = page::page(&found, &cases, arguments.seed);
    std::fs::write(&arguments.output, page)?;
    Ok(())
}

/// Plane cubic Bézier curves with whole coordinates from 0 to 5: multiples of the golden ratio modulo 1, so that none is picked.
fn cubics(count: usize) -> Vec<FloatCurve> {
    let coordinate = |k: usize| (6.0 * (k as f64 * 0.618_033_988_749_894_9).fract()).floor();
    let point = |k: usize| vec![coordinate(2 * k), coordinate(2 * k * k + 1)];
    let curve = |i: usize| FloatCurve::bezier((4 * i + 1..4 * i + 5).map(point).collect(), None);
    (0..count).map(curve).collect()
}

/// The ways of being wrong, each with the smallest of its cases.
fn faults(cases: &[Case], report: &Report) -> BTreeMap<Group, Fault> {
    let mut faults: BTreeMap<Group, Fault> = BTreeMap::new();
    for (case, finding) in cases.iter().zip(&report.findings) {
        let Verdict::Wrong(wrong) = &finding.verdict else {
            continue;
        };
        let fault = faults.entry(group(case, wrong)).or_insert_with(|| Fault {
            count: 0,
            case: case.clone(),
            wrong: wrong.clone(),
        });
        fault.count += 1;
        if shrink::size(case) < shrink::size(&fault.case) {
            fault.case = case.clone();
            fault.wrong = wrong.clone();
        }
    }
    faults
}

/// The exact result of a case.
pub fn truth(case: &Case) -> Truth {
    knotproof::validate::truth(case, &shortest::bounds)
}

/// The group of a wrong answer.
pub fn group(case: &Case, wrong: &Wrong) -> Group {
    (
        case.operation.name(),
        wrong.kind,
        case.curve.weights.is_some(),
        !case.curve.is_clamped(),
        match &case.operation {
            Operation::CurveDistance { other } => [&case.curve, other]
                .iter()
                .all(|curve| curve.degree == 3 && curve.is_bezier()),
            _ => false,
        },
    )
}
