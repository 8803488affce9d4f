//! Statement and evidence of the claim `msd` as texts (FORMAT §4, §6).

use std::io::{self, Read, Write};

use serde::Deserialize;

use super::super::FormatError;
use super::numbers::{Parsed, integer, rational, shortened};
use super::raw::{InBlock, Object, Text, required};
use super::read::parse_within;
use super::tree::write_tree;
use super::write::string;
use crate::claim::msd::{Content, Convention, Evidence, Interval, Lower, Side, Statement, Upper};
use crate::number::{Integer, RationalExt};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStatement<'a> {
    #[serde(borrow)]
    claim: Text<'a>,
    #[serde(borrow)]
    convention: Text<'a>,
    #[serde(borrow)]
    lower_squared: Text<'a>,
    #[serde(borrow, deserialize_with = "required")]
    upper_squared: Option<Text<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "T: Deserialize<'de>"))]
struct RawEvidence<'a, T> {
    grid: u32,
    #[serde(deserialize_with = "required")]
    tree: Option<T>,
    #[serde(borrow, deserialize_with = "required")]
    upper: Option<Object<RawUpper<'a>>>,
}

#[derive(Deserialize)]
#[serde(tag = "rule", rename_all = "snake_case", deny_unknown_fields)]
enum RawUpper<'a> {
    Miranda {
        #[serde(borrow)]
        s: [Text<'a>; 2],
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        first: [Text<'a>; 2],
        #[serde(borrow)]
        second: [Text<'a>; 2],
        #[serde(borrow)]
        regular: [Vec<Text<'a>>; 2],
        subdivisions: u32,
    },
    Root {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        s_side: Text<'a>,
        #[serde(borrow)]
        t: Text<'a>,
        #[serde(borrow)]
        t_side: Text<'a>,
    },
    Touch {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        t: Text<'a>,
    },
    Crossing {
        #[serde(borrow)]
        s: [Text<'a>; 2],
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        first: Vec<Text<'a>>,
        #[serde(borrow)]
        second: Vec<Text<'a>>,
    },
    CriticalRoot {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        t: Text<'a>,
    },
    CriticalInterval {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        regular: Vec<Text<'a>>,
    },
}

/// Reads both, and the texts of the tokens unless they are in the tree block.
pub fn read(
    statement_text: &str,
    evidence_text: &str,
    block: bool,
    dimension: usize,
) -> Parsed<(Content, Vec<String>)> {
    let Object(raw) = parse_within(statement_text, "statement")?;
    let statement = statement(&raw)?;
    let (grid, raw_upper, tree, has_tree) = if block {
        let Object(raw): Object<RawEvidence<InBlock>> = parse_within(evidence_text, "evidence")?;
        (raw.grid, raw.upper, Vec::new(), raw.tree.is_some())
    } else {
        let Object(raw): Object<RawEvidence<Vec<String>>> = parse_within(evidence_text, "evidence")?;
        let has_tree = raw.tree.is_some();
        (raw.grid, raw.upper, raw.tree.unwrap_or_default(), has_tree)
    };
    let upper = raw_upper.map(|Object(raw)| upper(&raw, dimension)).transpose()?;
    let content = Content {
        statement,
        evidence: Evidence { grid, upper },
        has_tree,
    };
    Ok((content, tree))
}

fn statement(raw: &RawStatement) -> Parsed<Statement> {
    if raw.claim.0 != "msd" {
        let what = format!("found {:?}, expected \"msd\"", shortened(&raw.claim.0));
        return Err(FormatError::malformed("statement.claim", what));
    }
    let convention = Convention::from_name(&raw.convention.0).ok_or_else(|| {
        let what = format!(
            "found {:?}, expected \"smooth\" or \"critical\"",
            shortened(&raw.convention.0)
        );
        FormatError::malformed("statement.convention", what)
    })?;
    let bound = |text: &Text, place: &str| {
        let value = rational(text, place)?;
        if value.numer().is_negative() {
            Err(FormatError::malformed(place, "negative"))
        } else {
            Ok(value)
        }
    };
    Ok(Statement {
        convention,
        lower_squared: match raw.lower_squared.0.as_ref() {
            "inf" => Lower::Infinite,
            _ => Lower::Finite(bound(&raw.lower_squared, "statement.lower_squared")?),
        },
        upper_squared: raw
            .upper_squared
            .as_ref()
            .map(|text| bound(text, "statement.upper_squared"))
            .transpose()?,
    })
}

fn upper(raw: &RawUpper, dimension: usize) -> Parsed<Upper> {
    let (at_s, at_t) = ("evidence.upper.s", "evidence.upper.t");
    let side = |text: &Text, place: &str| {
        Side::from_name(&text.0).ok_or_else(|| FormatError::malformed(place, "expected \"before\" or \"after\""))
    };
    Ok(match raw {
        RawUpper::Miranda {
            s,
            t,
            first,
            second,
            regular,
            subdivisions,
        } => Upper::Miranda {
            s: interval(s, at_s)?,
            t: interval(t, at_t)?,
            first: factors(first, "evidence.upper.first")?,
            second: factors(second, "evidence.upper.second")?,
            regular: [
                vector(&regular[0], dimension, "evidence.upper.regular[0]")?,
                vector(&regular[1], dimension, "evidence.upper.regular[1]")?,
            ],
            subdivisions: *subdivisions,
        },
        RawUpper::Root { s, s_side, t, t_side } => Upper::Root {
            s: (rational(s, at_s)?, side(s_side, "evidence.upper.s_side")?),
            t: (rational(t, at_t)?, side(t_side, "evidence.upper.t_side")?),
        },
        RawUpper::Touch { s, t } => Upper::Touch {
            s: rational(s, at_s)?,
            t: rational(t, at_t)?,
        },
        RawUpper::Crossing { s, t, first, second } => Upper::Crossing {
            s: interval(s, at_s)?,
            t: interval(t, at_t)?,
            first: vector(first, dimension, "evidence.upper.first")?,
            second: vector(second, dimension, "evidence.upper.second")?,
        },
        RawUpper::CriticalRoot { s, t } => Upper::CriticalRoot {
            s: rational(s, at_s)?,
            t: rational(t, at_t)?,
        },
        RawUpper::CriticalInterval { s, t, regular } => Upper::CriticalInterval {
            s: rational(s, at_s)?,
            t: interval(t, at_t)?,
            regular: vector(regular, dimension, "evidence.upper.regular")?,
        },
    })
}

pub(super) fn interval(texts: &[Text; 2], place: &str) -> Parsed<Interval> {
    Ok(Interval {
        start: rational(&texts[0], place)?,
        end: rational(&texts[1], place)?,
    })
}

fn factors(texts: &[Text; 2], place: &str) -> Parsed<[Integer; 2]> {
    Ok([integer(&texts[0], place)?, integer(&texts[1], place)?])
}

pub(super) fn vector(texts: &[Text], dimension: usize, place: &str) -> Parsed<[Integer; 3]> {
    if texts.len() != dimension {
        return Err(FormatError::malformed(
            place,
            format!("found {} integers, expected {dimension}", texts.len()),
        ));
    }
    let mut vector: [Integer; 3] = Default::default();
    for (component, text) in vector.iter_mut().zip(texts) {
        *component = integer(text, place)?;
    }
    Ok(vector)
}

/// Writes the statement.
pub fn write_statement(statement: &Statement, out: &mut String) {
    let lower = match &statement.lower_squared {
        Lower::Infinite => "inf".to_string(),
        Lower::Finite(value) => value.format(),
    };
    let upper = statement
        .upper_squared
        .as_ref()
        .map_or("null".to_string(), |value| string(&value.format()));
    out.push_str(&format!(
        "{{ \"claim\": \"msd\", \"convention\": \"{}\",\n    \"lower_squared\": \"{lower}\",\n    \"upper_squared\": {upper} }}",
        statement.convention.name()
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
        _ if !content.has_tree => text.push_str("null"),
        None => text.push_str("\"binary\""),
        Some(tree) => write_tree(tree, dimension, &mut text, out)?,
    }
    text.push_str(",\n    \"upper\": ");
    match &content.evidence.upper {
        None => text.push_str("null"),
        Some(upper) => text.push_str(&upper_text(upper, dimension)),
    }
    text.push_str(" }");
    out.write_all(text.as_bytes())
}

pub(super) fn interval_text(interval: &Interval) -> String {
    format!("[\"{}\", \"{}\"]", interval.start.format(), interval.end.format())
}

pub(super) fn integers_text(integers: &[Integer]) -> String {
    let texts: Vec<String> = integers.iter().map(|x| format!("\"{x}\"")).collect();
    format!("[{}]", texts.join(", "))
}

fn upper_text(upper: &Upper, dimension: usize) -> String {
    let (interval, integers) = (interval_text, integers_text);
    match upper {
        Upper::Miranda {
            s,
            t,
            first,
            second,
            regular,
            subdivisions,
        } => format!(
            "{{ \"rule\": \"miranda\", \"s\": {}, \"t\": {},\n      \"first\": {}, \"second\": {}, \"regular\": [{}, {}], \"subdivisions\": {subdivisions} }}",
            interval(s),
            interval(t),
            integers(first),
            integers(second),
            integers(&regular[0][..dimension]),
            integers(&regular[1][..dimension]),
        ),
        Upper::Root { s, t } => format!(
            "{{ \"rule\": \"root\", \"s\": \"{}\", \"s_side\": \"{}\", \"t\": \"{}\", \"t_side\": \"{}\" }}",
            s.0.format(),
            s.1.name(),
            t.0.format(),
            t.1.name()
        ),
        Upper::Touch { s, t } => format!(
            "{{ \"rule\": \"touch\", \"s\": \"{}\", \"t\": \"{}\" }}",
            s.format(),
            t.format()
        ),
        Upper::Crossing { s, t, first, second } => format!(
            "{{ \"rule\": \"crossing\", \"s\": {}, \"t\": {}, \"first\": {}, \"second\": {} }}",
            interval(s),
            interval(t),
            integers(&first[..dimension]),
            integers(&second[..dimension])
        ),
        Upper::CriticalRoot { s, t } => {
            format!(
                "{{ \"rule\": \"critical_root\", \"s\": \"{}\", \"t\": \"{}\" }}",
                s.format(),
                t.format()
            )
        }
        Upper::CriticalInterval { s, t, regular } => format!(
            "{{ \"rule\": \"critical_interval\", \"s\": \"{}\", \"t\": {}, \"regular\": {} }}",
            s.format(),
            interval(t),
            integers(&regular[..dimension])
        ),
    }
}
