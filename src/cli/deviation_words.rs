//! Statements about the distance from the control polygon, for programs and for people.

use knotproof::claim::deviation::Statement;
use knotproof::number::RationalExt;
use serde::Serialize;

use super::domain_words::roots;

/// A statement as JSON.
#[derive(Serialize)]
pub struct DeviationLine {
    subdivisions: u32,
    /// Exact fractions.
    lower_squared: String,
    upper_squared: String,
    /// Decimals rounded outward.
    lower: String,
    upper: String,
}

impl DeviationLine {
    /// The statement's own fields, with outward decimals of their roots.
    pub fn new(statement: &Statement) -> DeviationLine {
        let [lower, upper] = roots(&statement.lower_squared, &statement.upper_squared);
        DeviationLine {
            subdivisions: statement.subdivisions,
            lower_squared: statement.lower_squared.format(),
            upper_squared: statement.upper_squared.format(),
            lower,
            upper,
        }
    }
}

/// What a statement says, for people.
pub fn in_words(statement: &Statement) -> String {
    let [lower, upper] = roots(&statement.lower_squared, &statement.upper_squared);
    let between = match lower == upper {
        true => format!("is exactly {lower}"),
        false => format!("is between {lower} and {upper}"),
    };
    format!(
        "the greatest distance between the curve and its control polygon after {} subdivisions {between}",
        statement.subdivisions
    )
}
