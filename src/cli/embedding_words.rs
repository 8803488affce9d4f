//! The statement of the claim `embedding` as decimals rounded down, and in words.

use knotproof::claim::embedding::{Radius, Statement};
use knotproof::number::decimal_down;
use serde::Serialize;

/// Digits for programs.
const DIGITS: usize = 12;
/// Digits for people.
const FEW_DIGITS: usize = 6;

/// What `--json` prints of a statement.
#[derive(Serialize)]
pub struct EmbeddingLine {
    edges: u64,
    /// In the norm of greatest coordinates.
    perturbation_radius: String,
    perturbation_radius_euclidean: String,
}

impl EmbeddingLine {
    /// The line of a statement.
    pub fn new(statement: &Statement) -> Self {
        let [infinity, euclidean] = decimals(&statement.perturbation_radius, DIGITS);
        EmbeddingLine {
            edges: statement.edges,
            perturbation_radius: infinity,
            perturbation_radius_euclidean: euclidean,
        }
    }
}

fn decimals(radius: &Radius, digits: usize) -> [String; 2] {
    [&radius.infinity, &radius.euclidean].map(|radius| decimal_down(radius, digits))
}

/// What a statement says, for people.
pub fn in_words(statement: &Statement) -> String {
    let [infinity, euclidean] = decimals(&statement.perturbation_radius, FEW_DIGITS);
    let edges = match statement.edges {
        1 => "1 edge".into(),
        edges => format!("{edges} edges"),
    };
    let moves = if infinity == "0" {
        "nothing is said about moves of its control points".into()
    } else {
        format!(
            "it stays so while no coordinate of a control point changes by {infinity}, or no control point moves by {euclidean}"
        )
    };
    format!("the curve is embedded, and ambient isotopic to an inscribed polygon of {edges}; {moves}")
}
