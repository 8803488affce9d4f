//! Statement and evidence of the claim `curvature` as texts (FORMAT §11).

use serde::Deserialize;

use super::super::FormatError;
use super::numbers::{Parsed, not_negative, parameter, shortened};
use super::raw::{Object, Text};
use super::read::parse_within;
use crate::claim::curvature::{Content, Evidence, Statement};
use crate::number::RationalExt;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStatement<'a> {
    #[serde(borrow)]
    claim: Text<'a>,
    #[serde(borrow)]
    lower_squared: Text<'a>,
    #[serde(borrow)]
    upper_squared: Text<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawEvidence<'a> {
    piece: u32,
    #[serde(borrow)]
    u: Text<'a>,
}

/// Reads both.
pub fn read(statement_text: &str, evidence_text: &str) -> Parsed<Content> {
    let Object(raw): Object<RawStatement> = parse_within(statement_text, "statement")?;
    if raw.claim.0 != "curvature" {
        let what = format!("found {:?}, expected \"curvature\"", shortened(&raw.claim.0));
        return Err(FormatError::malformed("statement.claim", what));
    }
    let statement = Statement {
        lower_squared: not_negative(&raw.lower_squared, "statement.lower_squared")?,
        upper_squared: not_negative(&raw.upper_squared, "statement.upper_squared")?,
    };
    let Object(raw): Object<RawEvidence> = parse_within(evidence_text, "evidence")?;
    let evidence = Evidence {
        piece: raw.piece as usize,
        u: parameter(&raw.u, "evidence.u")?,
    };
    Ok(Content { statement, evidence })
}

/// The statement.
pub fn statement_text(statement: &Statement) -> String {
    format!(
        "{{ \"claim\": \"curvature\",\n    \"lower_squared\": \"{}\",\n    \"upper_squared\": \"{}\" }}",
        statement.lower_squared.format(),
        statement.upper_squared.format()
    )
}

/// The evidence.
pub fn evidence_text(evidence: &Evidence) -> String {
    format!(
        "{{ \"piece\": {}, \"u\": \"{}\" }}",
        evidence.piece,
        evidence.u.format()
    )
}
