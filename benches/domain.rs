//! Convex domains: how many inequalities uniform levels and the adaptive refinement need for the same true error, and how long both take.
//!
//! `cargo bench --bench domain` prints two tables in Markdown.

use std::io::Cursor;
use std::time::Instant;

use knotproof::certificate::Encoding;
use knotproof::check::check;
use knotproof::check::domain::Context;
use knotproof::claim::domain::{Evidence, Outcome, Sign};
use knotproof::curve::{Curve, read_curve};
use knotproof::number::{Rational, RationalExt};
use knotproof::prove::domain::levels::{Degree, Levels};
use knotproof::prove::domain::{Bounds, Certified, Options, Problem, Question, certify, write_checked};
use knotproof::prove::linear_program::GoodLp;

/// The curve files, the free point of each, and the sign.
const CURVES: [(&str, usize, Option<Sign>); 6] = [
    ("domain-cubic", 1, None),
    ("domain-quintic-many-vertices", 2, Some(Sign::Positive)),
    ("domain-quintic-late", 2, Some(Sign::Positive)),
    ("domain-quintic-bounded", 2, Some(Sign::Positive)),
    ("domain-nurbs-arc", 2, None),
    ("domain-quintic-spatial", 2, None),
];
/// Uniform levels up to this one.
const LAST_LEVEL: u32 = 13;

fn power_of_ten(exponent: u32) -> Rational {
    Rational::new(1.into(), knotproof::number::Integer::from(10).pow(exponent))
}

fn found<'c>(curve: &'c Curve, problem: &Problem, tolerance: Rational) -> Certified<'c> {
    let options = Options {
        tolerance,
        budget: 100_000,
        name: None,
        snapped_joints: None,
        measure_rounds: false,
        solver: &GoodLp,
    };
    certify(curve, problem, &options)
}

fn measures(certified: &Certified) -> Option<[Rational; 2]> {
    match &certified.document.as_ref()?.claim.statement.outcome {
        Outcome::Sandwich {
            inner_measure,
            outer_measure,
        } => Some([inner_measure.clone(), outer_measure.clone()]),
        _ => None,
    }
}

/// The first level whose true error is within the tolerance, with its inequalities and the seconds of all levels up to it.
fn uniform<const D: usize>(
    curve: &Curve,
    problem: &Problem,
    whole: &Rational,
    tolerance: &Rational,
) -> Option<(u32, usize, f64)> {
    let context = Context::new(curve, &problem.domain).ok()?;
    let mut levels = Levels::<D>::new(&context, Degree::True, |_| true).ok()?;
    let mut seconds = 0.0;
    for _ in 0..=LAST_LEVEL {
        let (level, _) = levels.step(false);
        seconds += level.seconds;
        // Against an upper bound of the domain's own measure.
        if whole - &level.measure[0] <= &level.measure[0] * tolerance {
            return Some((level.level, level.inequalities, seconds));
        }
    }
    None
}

fn main() {
    println!(
        "| curve | tolerance | uniform: level | inequalities | ms | adaptive: rows of the outer polytope | points of the inner one | ms | check ms | bytes |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    for (name, point, sign) in CURVES {
        let path = format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let curve = read_curve(&text)
            .unwrap_or_else(|error| panic!("{path}: {error}"))
            .curve;
        let question = Question {
            point,
            sign,
            interval: None,
            bounds: Bounds::Edge(Rational::from_integer(40.into())),
        };
        let problem = Problem::new(&curve, &question).unwrap_or_else(|error| panic!("{path}: {error}"));
        let fine = found(&curve, &problem, power_of_ten(8));
        let Some([_, whole]) = measures(&fine) else {
            panic!("{name}: nothing found")
        };
        for exponent in [2, 4, 6] {
            let tolerance = power_of_ten(exponent);
            let uniform = match curve.dimension() {
                2 => uniform::<2>(&curve, &problem, &whole, &tolerance),
                _ => uniform::<3>(&curve, &problem, &whole, &tolerance),
            };
            let uniform = uniform.map_or_else(
                || format!("above {LAST_LEVEL} | — | —"),
                |(level, inequalities, seconds)| format!("{level} | {inequalities} | {:.2}", 1e3 * seconds),
            );
            let start = Instant::now();
            let adaptive = found(&curve, &problem, tolerance.clone());
            let seconds = start.elapsed().as_secs_f64();
            let Some([inner, outer]) = measures(&adaptive) else {
                panic!("{name}: nothing found")
            };
            assert!((&outer - &inner).to_f64() <= (&inner * &tolerance).to_f64(), "{name}");
            let Some(document) = &adaptive.document else {
                panic!("{name}: no document")
            };
            let Evidence::Sandwich { inner, rows, .. } = &document.claim.evidence else {
                panic!("{name}")
            };
            let mut file = Cursor::new(Vec::new());
            if let Err(error) = write_checked(document, Encoding::Json, &mut file) {
                panic!("{name}: {error}");
            }
            let start = Instant::now();
            check(file.get_ref().as_slice());
            let checked = start.elapsed().as_secs_f64();
            println!(
                "| {name} | 1e-{exponent} | {uniform} | {} | {} | {:.2} | {:.2} | {} |",
                rows.len(),
                inner.points.len(),
                1e3 * seconds,
                1e3 * checked,
                file.get_ref().len()
            );
        }
    }
}
