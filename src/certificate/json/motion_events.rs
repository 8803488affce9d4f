//! The events of a motion as texts (FORMAT §14).

use std::fmt;
use std::io::{self, Read, Write};

use serde::Deserialize;
use serde::de::{Deserializer, SeqAccess, Visitor};

use super::super::bytes::ByteSource;
use super::motion::refuse;
use super::numbers::{Parsed, integer, parameter, shortened};
use super::raw::{Object, Text, optional};
use crate::claim::motion::{Event, EventSource, Move, TrackKind};
use crate::claim::tree::{BinaryTokens, Token, TokenSource, token_text};
use crate::number::{Integer, RationalExt};

/// An event, and the texts of its tokens.
pub type TextEvent = (Event, Vec<String>);

/// A displacement: the number of its point, and its coordinates.
struct RawDisplacement<'a> {
    point: u64,
    by: Vec<Text<'a>>,
}

impl<'de: 'a, 'a> Deserialize<'de> for RawDisplacement<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Lists;
        impl<'de> Visitor<'de> for Lists {
            type Value = RawDisplacement<'de>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a list of the number of a point and its displacement")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
                let missing = || serde::de::Error::invalid_length(0, &"the number of a point");
                let point = list.next_element()?.ok_or_else(missing)?;
                let mut by = Vec::new();
                while let Some(text) = list.next_element()? {
                    by.push(text);
                }
                Ok(RawDisplacement { point, by })
            }
        }
        deserializer.deserialize_seq(Lists)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawEvent<'a> {
    #[serde(default, borrow, deserialize_with = "optional")]
    tree: Option<Text<'a>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    edit: Option<Text<'a>>,
    #[serde(default, deserialize_with = "optional")]
    leaf: Option<u64>,
    #[serde(default, deserialize_with = "optional")]
    tokens: Option<Vec<String>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    end: Option<Text<'a>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    step: Option<Vec<RawDisplacement<'a>>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    begin: Option<Vec<RawDisplacement<'a>>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    go: Option<Text<'a>>,
}

/// Reads a list of events.
pub fn read_events(raw: Vec<Object<RawEvent>>, dimension: usize) -> Parsed<Vec<TextEvent>> {
    let each = raw.into_iter().enumerate();
    each.map(|(number, Object(raw))| event(number, raw, dimension))
        .collect()
}

fn event(number: usize, raw: RawEvent, dimension: usize) -> Parsed<TextEvent> {
    let track = |text: &Text| match TrackKind::from_name(&text.0) {
        Some(kind) => Ok(kind),
        None => refuse(
            number,
            format!("found {:?}, expected \"curve\" or \"polygon\"", shortened(&text.0)),
        ),
    };
    let plain = |event: Event| Ok((event, Vec::new()));
    match raw {
        RawEvent {
            tree: Some(kind),
            tokens: Some(tokens),
            edit: None,
            leaf: None,
            end: None,
            step: None,
            begin: None,
            go: None,
        } => Ok((Event::Tree(track(&kind)?), tokens)),
        RawEvent {
            edit: Some(kind),
            leaf: Some(leaf),
            tokens: Some(tokens),
            tree: None,
            end: None,
            step: None,
            begin: None,
            go: None,
        } => Ok((Event::Edit(track(&kind)?, leaf), tokens)),
        RawEvent {
            end: Some(kind),
            tree: None,
            edit: None,
            leaf: None,
            tokens: None,
            step: None,
            begin: None,
            go: None,
        } => plain(Event::End(track(&kind)?)),
        RawEvent {
            step: Some(displacements),
            tree: None,
            edit: None,
            leaf: None,
            tokens: None,
            end: None,
            begin: None,
            go: None,
        } => plain(Event::Step(displacements_of(number, &displacements, dimension)?)),
        RawEvent {
            begin: Some(displacements),
            tree: None,
            edit: None,
            leaf: None,
            tokens: None,
            end: None,
            step: None,
            go: None,
        } => plain(Event::Begin(displacements_of(number, &displacements, dimension)?)),
        RawEvent {
            go: Some(time),
            tree: None,
            edit: None,
            leaf: None,
            tokens: None,
            end: None,
            step: None,
            begin: None,
        } => plain(go(number, &time)?),
        _ => refuse(
            number,
            "expected the fields of one event: tree and tokens; edit, leaf and tokens; end; step; begin; or go",
        ),
    }
}

fn displacements_of(number: usize, raw: &[RawDisplacement], dimension: usize) -> Parsed<Move> {
    let mut read = Move::new();
    for displacement in raw {
        let point = displacement.point;
        if displacement.by.len() != dimension {
            let found = displacement.by.len();
            return refuse(
                number,
                format!("point {point}: found {found} coordinates, expected {dimension}"),
            );
        }
        let mut by: [Integer; 3] = Default::default();
        for (coordinate, text) in by.iter_mut().zip(&displacement.by) {
            *coordinate = integer(text, &format!("evidence.events[{number}], point {point}"))?;
        }
        if let Err(error) = read.push(point, by) {
            return refuse(number, error.to_string());
        }
    }
    Ok(read)
}

fn go(number: usize, text: &Text) -> Parsed<Event> {
    let time = parameter(text, &format!("evidence.events[{number}].go"))?;
    let exponent = time.denom().bits() - 1;
    match time.numer().to_u64() {
        Some(numerator) if time.denom().is_power_of_two() && exponent <= 60 => Ok(Event::Go {
            numerator,
            exponent: exponent as u32,
        }),
        _ => refuse(
            number,
            "expected a fraction above 0 whose denominator is a power of two, at most 2^60",
        ),
    }
}

/// Writes the list of events, whose binary spelling `events` holds, behind `text`; what is not written yet is left in `text`.
pub fn write_events<R: Read, W: Write>(events: R, dimension: usize, text: &mut String, out: &mut W) -> io::Result<()> {
    let mut source = BinaryTokens::new(ByteSource::new(events), dimension);
    let invalid = |error| io::Error::new(io::ErrorKind::InvalidData, error);
    text.push('[');
    let mut first = true;
    while let Some(event) = source.next_event().map_err(invalid)? {
        text.push_str(if first { "\n      { " } else { ",\n      { " });
        first = false;
        match &event {
            Event::Tree(kind) => text.push_str(&format!("\"tree\": \"{}\", \"tokens\": ", kind.name())),
            Event::Edit(kind, leaf) => {
                text.push_str(&format!(
                    "\"edit\": \"{}\", \"leaf\": {leaf}, \"tokens\": ",
                    kind.name()
                ));
            }
            Event::End(kind) => text.push_str(&format!("\"end\": \"{}\"", kind.name())),
            Event::Step(displacements) => {
                text.push_str("\"step\": ");
                displacements_text(displacements, dimension, text);
            }
            Event::Begin(displacements) => {
                text.push_str("\"begin\": ");
                displacements_text(displacements, dimension, text);
            }
            Event::Go { numerator, exponent } => {
                let time = crate::number::Rational::new((*numerator).into(), Integer::ONE << *exponent);
                text.push_str(&format!("\"go\": \"{}\"", time.format()));
            }
        }
        if matches!(event, Event::Tree(_) | Event::Edit(..)) {
            write_tokens(&mut source, dimension, text, out)?;
        }
        text.push_str(" }");
        flush(text, out)?;
    }
    text.push_str("\n    ]");
    Ok(())
}

fn flush<W: Write>(text: &mut String, out: &mut W) -> io::Result<()> {
    if text.len() > 1 << 16 {
        out.write_all(text.as_bytes())?;
        text.clear();
    }
    Ok(())
}

/// Writes the tokens of one tree, which ends where no pair is left.
fn write_tokens<S: TokenSource, W: Write>(
    source: &mut S,
    dimension: usize,
    text: &mut String,
    out: &mut W,
) -> io::Result<()> {
    let invalid = |error| io::Error::new(io::ErrorKind::InvalidData, error);
    text.push('[');
    let (mut pairs, mut first) = (1u64, true);
    while pairs > 0 {
        let token = source.next_token().map_err(invalid)?;
        let token = token.ok_or_else(|| io::Error::from(io::ErrorKind::UnexpectedEof))?;
        pairs = match token {
            Token::Split => pairs + 2,
            Token::First | Token::Second => pairs + 1,
            Token::Leaf(_) => pairs - 1,
        };
        text.push_str(if first { "\"" } else { ", \"" });
        first = false;
        text.push_str(&token_text(&token, dimension));
        text.push('"');
        flush(text, out)?;
    }
    text.push(']');
    Ok(())
}

fn displacements_text(displacements: &Move, dimension: usize, text: &mut String) {
    text.push('[');
    for (i, (point, by)) in displacements.iter().enumerate() {
        text.push_str(if i == 0 { "[" } else { ", [" });
        text.push_str(&point.to_string());
        for coordinate in &by[..dimension] {
            text.push_str(&format!(", \"{coordinate}\""));
        }
        text.push(']');
    }
    text.push(']');
}
