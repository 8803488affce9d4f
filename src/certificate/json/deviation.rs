//! Statement and evidence of the claim `deviation` as texts (FORMAT §13).

use serde::Deserialize;

use super::numbers::{Parsed, not_negative, parameter};
use super::raw::{Object, Text};
use super::read::parse_within;
use crate::claim::deviation::{Content, Evidence, Statement};
use crate::number::RationalExt;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStatement<'a> {
    #[serde(borrow, rename = "claim")]
    _claim: Text<'a>,
    subdivisions: u32,
    #[serde(borrow)]
    lower_squared: Text<'a>,
    #[serde(borrow)]
    upper_squared: Text<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawEvidence<'a> {
    piece: u32,
    part: u32,
    #[serde(borrow)]
    u: Text<'a>,
}

/// Reads both.
pub fn read(statement_text: &str, evidence_text: &str) -> Parsed<Content> {
    let Object(raw): Object<RawStatement> = parse_within(statement_text, "statement")?;
    let statement = Statement {
        subdivisions: raw.subdivisions,
        lower_squared: not_negative(&raw.lower_squared, "statement.lower_squared")?,
        upper_squared: not_negative(&raw.upper_squared, "statement.upper_squared")?,
    };
    let Object(raw): Object<RawEvidence> = parse_within(evidence_text, "evidence")?;
    let evidence = Evidence {
        piece: raw.piece as usize,
        part: u64::from(raw.part),
        u: parameter(&raw.u, "evidence.u")?,
    };
    Ok(Content { statement, evidence })
}

/// The statement.
pub fn statement_text(statement: &Statement) -> String {
    format!(
        "{{ \"claim\": \"deviation\", \"subdivisions\": {},\n    \"lower_squared\": \"{}\",\n    \"upper_squared\": \"{}\" }}",
        statement.subdivisions,
        statement.lower_squared.format(),
        statement.upper_squared.format()
    )
}

/// The evidence.
pub fn evidence_text(evidence: &Evidence) -> String {
    format!(
        "{{ \"piece\": {}, \"part\": {}, \"u\": \"{}\" }}",
        evidence.piece,
        evidence.part,
        evidence.u.format()
    )
}
