//! Statement and evidence of the claim `embedding` as texts (FORMAT §10).

use std::io::{self, Read, Write};

use serde::Deserialize;

use super::super::FormatError;
use super::numbers::{Parsed, rational};
use super::raw::{InBlock, Object, Text};
use super::read::parse_within;
use super::tree::write_tree;
use crate::claim::embedding::{Content, Evidence, Radius, Statement};
use crate::number::{Rational, RationalExt};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStatement<'a> {
    #[serde(borrow, rename = "claim")]
    _claim: Text<'a>,
    edges: u64,
    #[serde(borrow)]
    perturbation_radius: Object<RawRadius<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawRadius<'a> {
    #[serde(borrow)]
    infinity: Text<'a>,
    #[serde(borrow)]
    euclidean: Text<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawEvidence<T> {
    grid: u32,
    tree: T,
}

/// Reads both, and the texts of the tokens unless they are in the tree block.
pub fn read(statement_text: &str, evidence_text: &str, block: bool) -> Parsed<(Content, Vec<String>)> {
    let Object(raw): Object<RawStatement> = parse_within(statement_text, "statement")?;
    let Object(radius) = &raw.perturbation_radius;
    let statement = Statement {
        edges: raw.edges,
        perturbation_radius: Radius {
            infinity: length(&radius.infinity, "statement.perturbation_radius.infinity")?,
            euclidean: length(&radius.euclidean, "statement.perturbation_radius.euclidean")?,
        },
    };
    let (grid, tree) = if block {
        let Object(raw): Object<RawEvidence<InBlock>> = parse_within(evidence_text, "evidence")?;
        (raw.grid, Vec::new())
    } else {
        let Object(raw): Object<RawEvidence<Vec<String>>> = parse_within(evidence_text, "evidence")?;
        (raw.grid, raw.tree)
    };
    let content = Content {
        statement,
        evidence: Evidence { grid },
    };
    Ok((content, tree))
}

fn length(text: &Text, place: &str) -> Parsed<Rational> {
    let value = rational(text, place)?;
    if value.numer().is_negative() {
        return Err(FormatError::malformed(place, "negative"));
    }
    Ok(value)
}

/// Writes the statement.
pub fn write_statement(statement: &Statement, out: &mut String) {
    let Radius { infinity, euclidean } = &statement.perturbation_radius;
    out.push_str(&format!(
        "{{ \"claim\": \"embedding\", \"edges\": {},\n    \"perturbation_radius\": {{ \"infinity\": \"{}\", \"euclidean\": \"{}\" }} }}",
        statement.edges,
        infinity.format(),
        euclidean.format()
    ));
}

/// Writes the evidence; `tree` holds the tokens in their binary spelling, and `None` stands for the tree block.
pub fn write_evidence<R: Read, W: Write>(
    content: &Content,
    dimension: usize,
    tree: Option<R>,
    out: &mut W,
) -> io::Result<()> {
    let mut text = format!("{{\n    \"grid\": {},\n    \"tree\": ", content.evidence.grid);
    match tree {
        None => text.push_str("\"binary\""),
        Some(tree) => write_tree(tree, dimension, &mut text, out)?,
    }
    text.push_str(" }");
    out.write_all(text.as_bytes())
}
