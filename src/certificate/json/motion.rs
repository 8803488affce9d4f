//! Statement and evidence of the claim `motion` as texts (FORMAT §14).

use std::io::{self, Read, Write};

use serde::Deserialize;

use super::super::FormatError;
use super::motion_events::{RawEvent, TextEvent, read_events, write_events};
use super::msd::{integers_text, interval, interval_text, vector};
use super::numbers::{Parsed, integer, not_negative, parameter};
use super::raw::{InBlock, Object, Text, required};
use super::read::parse_within;
use crate::claim::motion::{Contact, Content, Criteria, Evidence, FirstFailures, HalfNu, Statement, Track};
use crate::number::RationalExt;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStatement<'a> {
    #[serde(borrow, rename = "claim")]
    _claim: Text<'a>,
    steps: u64,
    #[serde(borrow)]
    denominator: Text<'a>,
    #[serde(borrow)]
    motion_sha256: Text<'a>,
    #[serde(borrow, deserialize_with = "required")]
    curve: Option<Object<RawTrack<'a>>>,
    #[serde(borrow, deserialize_with = "required")]
    polygon: Option<Object<RawTrack<'a>>>,
    #[serde(borrow, deserialize_with = "required")]
    criteria: Option<Object<RawCriteria<'a>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawTrack<'a> {
    #[serde(borrow)]
    embedded_through: Text<'a>,
    #[serde(borrow, deserialize_with = "required")]
    meets_by: Option<Text<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCriteria<'a> {
    #[serde(borrow)]
    display_tolerance: Text<'a>,
    second_differences: Object<RawFailures>,
    #[serde(borrow, deserialize_with = "required")]
    half_nu: Option<Object<RawHalfNu<'a>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawFailures {
    #[serde(deserialize_with = "required")]
    infinity: Option<u64>,
    #[serde(deserialize_with = "required")]
    euclidean: Option<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawHalfNu<'a> {
    #[serde(borrow)]
    nu_squared: Text<'a>,
    #[serde(deserialize_with = "required")]
    infinity: Option<u64>,
    #[serde(deserialize_with = "required")]
    euclidean: Option<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "T: Deserialize<'de>"))]
struct RawEvidence<'a, T> {
    #[serde(borrow, deserialize_with = "required")]
    curve_contact: Option<Object<RawContact<'a>>>,
    #[serde(borrow, deserialize_with = "required")]
    polygon_contact: Option<Object<RawContact<'a>>>,
    events: T,
}

#[derive(Deserialize)]
#[serde(tag = "rule", rename_all = "snake_case", deny_unknown_fields)]
enum RawContact<'a> {
    Touch {
        #[serde(borrow)]
        time: Text<'a>,
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        t: Text<'a>,
    },
    Crossing {
        #[serde(borrow)]
        time: Text<'a>,
        #[serde(borrow)]
        s: [Text<'a>; 2],
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        first: Vec<Text<'a>>,
        #[serde(borrow)]
        second: Vec<Text<'a>>,
    },
    Passage {
        #[serde(borrow)]
        times: [Text<'a>; 2],
        #[serde(borrow)]
        s: [Text<'a>; 2],
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        first: Vec<Text<'a>>,
        #[serde(borrow)]
        second: Vec<Text<'a>>,
        #[serde(borrow)]
        third: Vec<Text<'a>>,
    },
}

/// Reads both, and the events unless they are in the event block.
pub fn read(
    statement_text: &str,
    evidence_text: &str,
    block: bool,
    dimension: usize,
) -> Parsed<(Content, Vec<TextEvent>)> {
    let Object(raw): Object<RawStatement> = parse_within(statement_text, "statement")?;
    let statement = Statement {
        steps: raw.steps,
        denominator: integer(&raw.denominator, "statement.denominator")?,
        motion_sha256: raw.motion_sha256.0.into_owned(),
        curve: track(&raw.curve, "statement.curve")?,
        polygon: track(&raw.polygon, "statement.polygon")?,
        criteria: raw.criteria.as_ref().map(|Object(raw)| criteria(raw)).transpose()?,
    };
    let (contacts, events) = if block {
        let Object(raw): Object<RawEvidence<InBlock>> = parse_within(evidence_text, "evidence")?;
        ([raw.curve_contact, raw.polygon_contact], Vec::new())
    } else {
        let Object(raw): Object<RawEvidence<Vec<Object<RawEvent>>>> = parse_within(evidence_text, "evidence")?;
        (
            [raw.curve_contact, raw.polygon_contact],
            read_events(raw.events, dimension)?,
        )
    };
    let read = |raw: &Option<Object<RawContact>>, place: &str| {
        let raw = raw.as_ref();
        raw.map(|Object(raw)| contact(raw, dimension, place)).transpose()
    };
    let evidence = Evidence {
        curve_contact: read(&contacts[0], "evidence.curve_contact")?,
        polygon_contact: read(&contacts[1], "evidence.polygon_contact")?,
    };
    Ok((Content { statement, evidence }, events))
}

fn track(raw: &Option<Object<RawTrack>>, place: &str) -> Parsed<Option<Track>> {
    let Some(Object(raw)) = raw else { return Ok(None) };
    let by = raw.meets_by.as_ref();
    Ok(Some(Track {
        embedded_through: parameter(&raw.embedded_through, &format!("{place}.embedded_through"))?,
        meets_by: by
            .map(|text| parameter(text, &format!("{place}.meets_by")))
            .transpose()?,
    }))
}

fn criteria(raw: &RawCriteria) -> Parsed<Criteria> {
    let Object(second) = &raw.second_differences;
    let half_nu = raw.half_nu.as_ref().map(|Object(raw)| -> Parsed<HalfNu> {
        Ok(HalfNu {
            nu_squared: not_negative(&raw.nu_squared, "statement.criteria.half_nu.nu_squared")?,
            failures: FirstFailures {
                infinity: raw.infinity,
                euclidean: raw.euclidean,
            },
        })
    });
    Ok(Criteria {
        display_tolerance: not_negative(&raw.display_tolerance, "statement.criteria.display_tolerance")?,
        second_differences: FirstFailures {
            infinity: second.infinity,
            euclidean: second.euclidean,
        },
        half_nu: half_nu.transpose()?,
    })
}

fn contact(raw: &RawContact, dimension: usize, place: &str) -> Parsed<Contact> {
    let at = |field: &str| format!("{place}.{field}");
    let one = |text: &Text, field: &str| parameter(text, &at(field));
    Ok(match raw {
        RawContact::Touch { time, s, t } => Contact::Touch {
            time: one(time, "time")?,
            s: one(s, "s")?,
            t: one(t, "t")?,
        },
        RawContact::Crossing {
            time,
            s,
            t,
            first,
            second,
        } => Contact::Crossing {
            time: one(time, "time")?,
            s: interval(s, &at("s"))?,
            t: interval(t, &at("t"))?,
            first: vector(first, dimension, &at("first"))?,
            second: vector(second, dimension, &at("second"))?,
        },
        RawContact::Passage {
            times,
            s,
            t,
            first,
            second,
            third,
        } => Contact::Passage {
            times: [one(&times[0], "times")?, one(&times[1], "times")?],
            s: interval(s, &at("s"))?,
            t: interval(t, &at("t"))?,
            vectors: [
                vector(first, dimension, &at("first"))?,
                vector(second, dimension, &at("second"))?,
                vector(third, dimension, &at("third"))?,
            ],
        },
    })
}

fn optional_text<T>(value: Option<T>, text: impl Fn(T) -> String) -> String {
    value.map_or("null".into(), text)
}

fn failures_text(failures: &FirstFailures) -> String {
    let first = |value: Option<u64>| optional_text(value, |frame| frame.to_string());
    format!(
        "\"infinity\": {}, \"euclidean\": {}",
        first(failures.infinity),
        first(failures.euclidean)
    )
}

/// The statement.
pub fn statement_text(statement: &Statement) -> String {
    let track = |track: &Option<Track>| {
        optional_text(track.as_ref(), |track| {
            format!(
                "{{ \"embedded_through\": \"{}\", \"meets_by\": {} }}",
                track.embedded_through.format(),
                optional_text(track.meets_by.as_ref(), |by| format!("\"{}\"", by.format()))
            )
        })
    };
    let criteria = optional_text(statement.criteria.as_ref(), |criteria| {
        let half_nu = optional_text(criteria.half_nu.as_ref(), |half_nu| {
            let nu_squared = half_nu.nu_squared.format();
            format!(
                "{{ \"nu_squared\": \"{nu_squared}\", {} }}",
                failures_text(&half_nu.failures)
            )
        });
        format!(
            "{{ \"display_tolerance\": \"{}\", \"second_differences\": {{ {} }},\n      \"half_nu\": {half_nu} }}",
            criteria.display_tolerance.format(),
            failures_text(&criteria.second_differences)
        )
    });
    format!(
        "{{ \"claim\": \"motion\", \"steps\": {}, \"denominator\": \"{}\",\n    \"motion_sha256\": {},\n    \"curve\": {},\n    \"polygon\": {},\n    \"criteria\": {criteria} }}",
        statement.steps,
        statement.denominator,
        super::write::string(&statement.motion_sha256),
        track(&statement.curve),
        track(&statement.polygon)
    )
}

fn contact_text(contact: &Contact, dimension: usize) -> String {
    match contact {
        Contact::Touch { time, s, t } => format!(
            "{{ \"rule\": \"touch\", \"time\": \"{}\", \"s\": \"{}\", \"t\": \"{}\" }}",
            time.format(),
            s.format(),
            t.format()
        ),
        Contact::Crossing {
            time,
            s,
            t,
            first,
            second,
        } => format!(
            "{{ \"rule\": \"crossing\", \"time\": \"{}\", \"s\": {}, \"t\": {}, \"first\": {}, \"second\": {} }}",
            time.format(),
            interval_text(s),
            interval_text(t),
            integers_text(&first[..dimension]),
            integers_text(&second[..dimension])
        ),
        Contact::Passage { times, s, t, vectors } => format!(
            "{{ \"rule\": \"passage\", \"times\": [\"{}\", \"{}\"], \"s\": {}, \"t\": {},\n      \"first\": {}, \"second\": {}, \"third\": {} }}",
            times[0].format(),
            times[1].format(),
            interval_text(s),
            interval_text(t),
            integers_text(&vectors[0][..dimension]),
            integers_text(&vectors[1][..dimension]),
            integers_text(&vectors[2][..dimension])
        ),
    }
}

/// Writes the evidence; `events` holds the events in their binary spelling, and `None` stands for the event block.
pub fn write_evidence<R: Read, W: Write>(
    evidence: &Evidence,
    dimension: usize,
    events: Option<R>,
    out: &mut W,
) -> io::Result<()> {
    let contact =
        |contact: &Option<Contact>| optional_text(contact.as_ref(), |contact| contact_text(contact, dimension));
    let mut text = format!(
        "{{\n    \"curve_contact\": {},\n    \"polygon_contact\": {},\n    \"events\": ",
        contact(&evidence.curve_contact),
        contact(&evidence.polygon_contact)
    );
    match events {
        None => text.push_str("\"binary\""),
        Some(events) => write_events(events, dimension, &mut text, out)?,
    }
    text.push_str(" }");
    out.write_all(text.as_bytes())
}

/// What is not an event.
pub fn refuse<T>(number: usize, what: impl Into<String>) -> Parsed<T> {
    Err(FormatError::malformed(format!("evidence.events[{number}]"), what))
}
