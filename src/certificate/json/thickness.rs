//! Statement and evidence of the claim `thickness` as texts (FORMAT §12).

use std::io::{self, Read, Write};

use serde::Deserialize;
use serde_json::value::RawValue;

use super::super::FormatError;
use super::numbers::{Parsed, not_negative};
use super::raw::{Object, Text, optional, required};
use super::read::parse_within;
use super::{curvature, msd};
use crate::claim::msd::{Convention, Lower};
use crate::claim::thickness::{Content, Evidence, Statement};
use crate::number::RationalExt;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStatement<'a> {
    #[serde(borrow, rename = "claim")]
    _claim: Text<'a>,
    #[serde(borrow)]
    convention: Text<'a>,
    #[serde(borrow)]
    lower_squared: Text<'a>,
    #[serde(borrow, deserialize_with = "required")]
    upper_squared: Option<Text<'a>>,
}

/// A claim within the evidence.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPart<'a> {
    #[serde(borrow)]
    statement: &'a RawValue,
    #[serde(borrow)]
    evidence: &'a RawValue,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawEvidence<'a> {
    #[serde(default, deserialize_with = "optional")]
    corner: Option<u32>,
    #[serde(default, borrow, deserialize_with = "optional")]
    msd: Option<&'a RawValue>,
    #[serde(default, borrow, deserialize_with = "optional")]
    curvature: Option<&'a RawValue>,
}

/// Reads both, and the texts of the tokens unless they are in the tree block.
pub fn read(
    statement_text: &str,
    evidence_text: &str,
    block: bool,
    dimension: usize,
) -> Parsed<(Content, Vec<String>)> {
    let Object(raw): Object<RawStatement> = parse_within(statement_text, "statement")?;
    let statement = Statement {
        convention: Convention::from_name(&raw.convention.0)
            .ok_or_else(|| FormatError::malformed("statement.convention", "expected \"smooth\" or \"critical\""))?,
        lower_squared: match raw.lower_squared.0.as_ref() {
            "inf" => Lower::Infinite,
            _ => Lower::Finite(not_negative(&raw.lower_squared, "statement.lower_squared")?),
        },
        upper_squared: raw
            .upper_squared
            .as_ref()
            .map(|text| not_negative(text, "statement.upper_squared"))
            .transpose()?,
    };
    let Object(raw): Object<RawEvidence> = parse_within(evidence_text, "evidence")?;
    let (evidence, tokens) = match (raw.corner, raw.msd, raw.curvature) {
        (Some(joint), None, None) => {
            let joint = joint as usize;
            (Evidence::Corner { joint }, Vec::new())
        }
        (None, Some(msd_text), Some(curvature_text)) => {
            let Object(part): Object<RawPart> = parse_within(msd_text.get(), "evidence.msd")?;
            let (msd, tokens) = msd::read(part.statement.get(), part.evidence.get(), block, dimension)
                .map_err(|error| within("evidence.msd", error))?;
            let Object(part): Object<RawPart> = parse_within(curvature_text.get(), "evidence.curvature")?;
            let curvature = curvature::read(part.statement.get(), part.evidence.get())
                .map_err(|error| within("evidence.curvature", error))?;
            let (msd, curvature) = (Box::new(msd), Box::new(curvature));
            (Evidence::Bounds { msd, curvature }, tokens)
        }
        _ => {
            let what = "expected either corner, or msd and curvature";
            return Err(FormatError::malformed("evidence", what));
        }
    };
    Ok((Content { statement, evidence }, tokens))
}

/// The place of an error in a part of the document.
fn within(part: &str, error: FormatError) -> FormatError {
    match error {
        FormatError::Malformed { place, what } => FormatError::malformed(format!("{part}.{place}"), what),
        other => other,
    }
}

/// The statement.
pub fn statement_text(statement: &Statement) -> String {
    let lower = match &statement.lower_squared {
        Lower::Infinite => "inf".to_string(),
        Lower::Finite(value) => value.format(),
    };
    let upper = statement
        .upper_squared
        .as_ref()
        .map_or("null".to_string(), |value| format!("\"{}\"", value.format()));
    format!(
        "{{ \"claim\": \"thickness\", \"convention\": \"{}\",\n    \"lower_squared\": \"{lower}\",\n    \"upper_squared\": {upper} }}",
        statement.convention.name()
    )
}

/// Writes the evidence; `tree` holds the tokens in their binary spelling, and `None` stands for the tree block.
pub fn write_evidence<R: Read, W: Write>(
    evidence: &Evidence,
    dimension: usize,
    tree: Option<R>,
    out: &mut W,
) -> io::Result<()> {
    let (msd, curvature) = match evidence {
        Evidence::Corner { joint } => return write!(out, "{{ \"corner\": {joint} }}"),
        Evidence::Bounds { msd, curvature } => (msd, curvature),
    };
    let mut text = String::from("{ \"msd\": { \"statement\": ");
    msd::write_statement(&msd.statement, &mut text);
    text.push_str(",\n  \"evidence\": ");
    out.write_all(text.as_bytes())?;
    msd::write_evidence(msd, dimension, tree, out)?;
    write!(
        out,
        " }},\n  \"curvature\": {{ \"statement\": {},\n  \"evidence\": {} }} }}",
        curvature::statement_text(&curvature.statement),
        curvature::evidence_text(&curvature.evidence)
    )
}
