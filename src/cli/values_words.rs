//! Statements about results of operations, for programs and for people.

use knotproof::claim::values::{Operation, Outcome, Statement};
use knotproof::number::{Rational, RationalExt};
use serde::Serialize;

use super::domain_words::roots;

/// A statement as JSON.
#[derive(Serialize)]
pub struct ValuesLine {
    entries: usize,
    operations: Vec<OperationLine>,
    distances: Vec<DistanceLine>,
}

/// How many entries of an operation there are.
#[derive(Serialize)]
struct OperationLine {
    operation: &'static str,
    entries: usize,
}

/// An interval of a distance.
#[derive(Serialize)]
struct DistanceLine {
    entry: usize,
    operation: &'static str,
    /// Exact fractions.
    lower_squared: String,
    upper_squared: String,
    /// Decimals rounded outward.
    lower: String,
    upper: String,
}

/// Operations in the order of their first entries, and how many entries there are of each.
fn counts(statement: &Statement) -> Vec<(&'static str, usize)> {
    let mut counts: Vec<(&'static str, usize)> = Vec::new();
    for entry in &statement.entries {
        let name = entry.operation.name();
        match counts.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => counts.push((name, 1)),
        }
    }
    counts
}

impl ValuesLine {
    /// The number of entries of each operation, and the distances with outward decimals.
    pub fn new(statement: &Statement) -> ValuesLine {
        let operations = counts(statement).into_iter();
        let distances = statement.entries.iter().enumerate().filter_map(|(entry, found)| {
            let Outcome::DistanceSquared {
                lower: lower_squared,
                upper: upper_squared,
            } = &found.outcome
            else {
                return None;
            };
            let [lower, upper] = roots(lower_squared, upper_squared);
            Some(DistanceLine {
                entry,
                operation: found.operation.name(),
                lower_squared: lower_squared.format(),
                upper_squared: upper_squared.format(),
                lower,
                upper,
            })
        });
        ValuesLine {
            entries: statement.entries.len(),
            operations: operations
                .map(|(operation, entries)| OperationLine { operation, entries })
                .collect(),
            distances: distances.collect(),
        }
    }
}

/// What a statement says, for people.
pub fn in_words(statement: &Statement) -> String {
    let counts: Vec<String> = counts(statement)
        .into_iter()
        .map(|(name, count)| format!("{count} {name}"))
        .collect();
    let mut words = match counts.as_slice() {
        [] => "exact results of no operation".to_string(),
        counts => format!("exact results of operations: {}", counts.join(", ")),
    };
    for entry in &statement.entries {
        let Outcome::DistanceSquared { lower, upper } = &entry.outcome else {
            continue;
        };
        let to = match &entry.operation {
            Operation::CurveDistance { .. } => "the other curve".to_string(),
            Operation::NearestPoint { target } => {
                let texts: Vec<String> = target.iter().map(RationalExt::format).collect();
                format!("({})", texts.join(", "))
            }
            _ => continue,
        };
        words += &format!("; the distance to {to} is {}", distance_in_words(lower, upper));
    }
    words
}

/// A distance of which the square is between two numbers.
fn distance_in_words(lower_squared: &Rational, upper_squared: &Rational) -> String {
    let [lower, upper] = roots(lower_squared, upper_squared);
    if lower == upper {
        return format!("exactly {lower}");
    }
    match lower_squared == upper_squared {
        true => format!("exactly the square root of {}", lower_squared.format()),
        false => format!("between {lower} and {upper}"),
    }
}
