//! Statement and evidence of the claim `values` as texts (FORMAT §15).

use std::fmt::Write;

use serde::Deserialize;
use serde_json::value::RawValue;

use super::super::FormatError;
use super::numbers::{Parsed, not_negative, parameter, rational, shortened};
use super::raw::{AtMost, Object, RawCurve, Text, required};
use super::read::{curve_at, parse_within};
use super::write::curve_text;
use crate::claim::tree::{parse_token, token_text};
use crate::claim::values::{
    Content, Entry, Evidence, MOST_ENTRIES, MOST_TOKENS, Operation, Outcome, Side, Statement, Witness,
};
use crate::curve::Curve;
use crate::number::{Rational, RationalExt};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStatement<'a> {
    #[serde(borrow, rename = "claim")]
    _claim: Text<'a>,
    #[serde(borrow)]
    entries: AtMost<&'a RawValue, MOST_ENTRIES>,
}

/// The one field that every entry has.
#[derive(Deserialize)]
struct RawOperation<'a> {
    #[serde(borrow)]
    operation: Text<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPoint<'a> {
    #[serde(borrow, rename = "operation")]
    _operation: Text<'a>,
    #[serde(borrow)]
    parameter: Text<'a>,
    #[serde(borrow)]
    point: AtMost<Text<'a>, 3>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawDerivative<'a> {
    #[serde(borrow, rename = "operation")]
    _operation: Text<'a>,
    #[serde(borrow)]
    parameter: Text<'a>,
    order: u32,
    #[serde(borrow)]
    side: Text<'a>,
    #[serde(borrow)]
    vector: AtMost<Text<'a>, 3>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCurvature<'a> {
    #[serde(borrow, rename = "operation")]
    _operation: Text<'a>,
    #[serde(borrow)]
    parameter: Text<'a>,
    #[serde(borrow)]
    side: Text<'a>,
    #[serde(borrow)]
    value_squared: Text<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawTorsion<'a> {
    #[serde(borrow, rename = "operation")]
    _operation: Text<'a>,
    #[serde(borrow)]
    parameter: Text<'a>,
    #[serde(borrow)]
    side: Text<'a>,
    #[serde(borrow)]
    value: Text<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawKnot<'a> {
    #[serde(borrow, rename = "operation")]
    _operation: Text<'a>,
    #[serde(borrow)]
    parameter: Text<'a>,
    times: u32,
    #[serde(borrow)]
    curve: Object<RawCurve<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawElevation<'a> {
    #[serde(borrow, rename = "operation")]
    _operation: Text<'a>,
    times: u32,
    #[serde(borrow)]
    curve: Object<RawCurve<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSplit<'a> {
    #[serde(borrow, rename = "operation")]
    _operation: Text<'a>,
    #[serde(borrow)]
    parameter: Text<'a>,
    #[serde(borrow)]
    curves: AtMost<Object<RawCurve<'a>>, 2>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawDecomposition<'a> {
    #[serde(borrow, rename = "operation")]
    _operation: Text<'a>,
    #[serde(borrow)]
    curve: Object<RawCurve<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawNearest<'a> {
    #[serde(borrow, rename = "operation")]
    _operation: Text<'a>,
    #[serde(borrow)]
    target: AtMost<Text<'a>, 3>,
    #[serde(borrow)]
    lower_squared: Text<'a>,
    #[serde(borrow)]
    upper_squared: Text<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawDistance<'a> {
    #[serde(borrow, rename = "operation")]
    _operation: Text<'a>,
    #[serde(borrow)]
    other: Object<RawCurve<'a>>,
    #[serde(borrow)]
    lower_squared: Text<'a>,
    #[serde(borrow)]
    upper_squared: Text<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawEvidence<'a> {
    #[serde(borrow)]
    witnesses: AtMost<&'a RawValue, MOST_ENTRIES>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawNearestWitness<'a> {
    #[serde(borrow)]
    parameter: Text<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawDistanceWitness<'a> {
    #[serde(borrow)]
    parameters: AtMost<Text<'a>, 2>,
    #[serde(borrow, deserialize_with = "required")]
    tree: Option<AtMost<Text<'a>, MOST_TOKENS>>,
}

/// Reads both.
pub fn read(statement_text: &str, evidence_text: &str, dimension: usize) -> Parsed<Content> {
    let Object(raw): Object<RawStatement> = parse_within(statement_text, "statement")?;
    let texts = raw.entries.0.iter().enumerate();
    let entries: Vec<Entry> = texts
        .map(|(i, text)| entry(text.get(), dimension, &format!("statement.entries[{i}]")))
        .collect::<Parsed<_>>()?;
    let Object(raw): Object<RawEvidence> = parse_within(evidence_text, "evidence")?;
    let needing: Vec<&Operation> = entries
        .iter()
        .map(|entry| &entry.operation)
        .filter(|operation| needs_witness(operation))
        .collect();
    if raw.witnesses.0.len() != needing.len() {
        let what = format!("found {} witnesses, expected {}", raw.witnesses.0.len(), needing.len());
        return Err(FormatError::malformed("evidence.witnesses", what));
    }
    let mut tokens_left = MOST_TOKENS;
    let witnesses = needing
        .iter()
        .zip(&raw.witnesses.0)
        .enumerate()
        .map(|(i, (operation, text))| {
            let place = format!("evidence.witnesses[{i}]");
            witness(operation, text.get(), dimension, &mut tokens_left, &place)
        })
        .collect::<Parsed<_>>()?;
    Ok(Content {
        statement: Statement { entries },
        evidence: Evidence { witnesses },
    })
}

fn needs_witness(operation: &Operation) -> bool {
    matches!(
        operation,
        Operation::NearestPoint { .. } | Operation::CurveDistance { .. }
    )
}

fn entry(text: &str, dimension: usize, place: &str) -> Parsed<Entry> {
    let Object(RawOperation { operation: name }) = parse_within(text, place)?;
    let at = |field: &str| format!("{place}.{field}");
    let result = |Object(raw): Object<RawCurve>| -> Parsed<Outcome> {
        Ok(Outcome::Curve(Box::new(curve_at(raw, &at("curve"))?)))
    };
    let distance = |lower: &Text, upper: &Text| -> Parsed<Outcome> {
        Ok(Outcome::DistanceSquared {
            lower: not_negative(lower, &at("lower_squared"))?,
            upper: not_negative(upper, &at("upper_squared"))?,
        })
    };
    let (operation, outcome) = match name.0.as_ref() {
        "point" => {
            let Object(raw): Object<RawPoint> = parse_within(text, place)?;
            let operation = Operation::Point {
                parameter: parameter(&raw.parameter, &at("parameter"))?,
            };
            (
                operation,
                Outcome::Point(position(&raw.point, dimension, &at("point"))?),
            )
        }
        "derivative" => {
            let Object(raw): Object<RawDerivative> = parse_within(text, place)?;
            let operation = Operation::Derivative {
                parameter: parameter(&raw.parameter, &at("parameter"))?,
                order: raw.order,
                side: side(&raw.side, &at("side"))?,
            };
            let vector = position(&raw.vector, dimension, &at("vector"))?;
            (operation, Outcome::Vector(vector))
        }
        "curvature" => {
            let Object(raw): Object<RawCurvature> = parse_within(text, place)?;
            let operation = Operation::Curvature {
                parameter: parameter(&raw.parameter, &at("parameter"))?,
                side: side(&raw.side, &at("side"))?,
            };
            let squared = not_negative(&raw.value_squared, &at("value_squared"))?;
            (operation, Outcome::ValueSquared(squared))
        }
        "torsion" => {
            let Object(raw): Object<RawTorsion> = parse_within(text, place)?;
            let operation = Operation::Torsion {
                parameter: parameter(&raw.parameter, &at("parameter"))?,
                side: side(&raw.side, &at("side"))?,
            };
            (operation, Outcome::Value(rational(&raw.value, &at("value"))?))
        }
        "insert_knot" | "remove_knot" => {
            let Object(raw): Object<RawKnot> = parse_within(text, place)?;
            let (parameter, times) = (parameter(&raw.parameter, &at("parameter"))?, raw.times);
            let operation = match name.0.as_ref() {
                "insert_knot" => Operation::InsertKnot { parameter, times },
                _ => Operation::RemoveKnot { parameter, times },
            };
            (operation, result(raw.curve)?)
        }
        "elevate_degree" => {
            let Object(raw): Object<RawElevation> = parse_within(text, place)?;
            (Operation::ElevateDegree { times: raw.times }, result(raw.curve)?)
        }
        "split" => {
            let Object(raw): Object<RawSplit> = parse_within(text, place)?;
            let operation = Operation::Split {
                parameter: parameter(&raw.parameter, &at("parameter"))?,
            };
            let curves = raw.curves.0.into_iter().enumerate();
            let curves: Vec<Curve> = curves
                .map(|(i, Object(raw))| curve_at(raw, &at(&format!("curves[{i}]"))))
                .collect::<Parsed<_>>()?;
            let curves: [Curve; 2] = curves
                .try_into()
                .map_err(|_| FormatError::malformed(at("curves"), "expected two curves"))?;
            (operation, Outcome::Curves(Box::new(curves)))
        }
        "decompose" => {
            let Object(raw): Object<RawDecomposition> = parse_within(text, place)?;
            (Operation::Decompose, result(raw.curve)?)
        }
        "nearest_point" => {
            let Object(raw): Object<RawNearest> = parse_within(text, place)?;
            let target = position(&raw.target, dimension, &at("target"))?;
            (
                Operation::NearestPoint { target },
                distance(&raw.lower_squared, &raw.upper_squared)?,
            )
        }
        "curve_distance" => {
            let Object(raw): Object<RawDistance> = parse_within(text, place)?;
            let outcome = distance(&raw.lower_squared, &raw.upper_squared)?;
            let other = Box::new(curve_at(raw.other.0, &at("other"))?);
            (Operation::CurveDistance { other }, outcome)
        }
        other => {
            let what = format!("found {:?}, expected an operation", shortened(other));
            return Err(FormatError::malformed(at("operation"), what));
        }
    };
    Ok(Entry { operation, outcome })
}

fn side(text: &Text, place: &str) -> Parsed<Side> {
    match text.0.as_ref() {
        "left" => Ok(Side::Left),
        "right" => Ok(Side::Right),
        other => {
            let what = format!("found {:?}, expected \"left\" or \"right\"", shortened(other));
            Err(FormatError::malformed(place, what))
        }
    }
}

fn position(texts: &AtMost<Text, 3>, dimension: usize, place: &str) -> Parsed<Vec<Rational>> {
    if texts.0.len() != dimension {
        let what = format!("found {} coordinates, expected {dimension}", texts.0.len());
        return Err(FormatError::malformed(place, what));
    }
    let coordinates = texts.0.iter().enumerate();
    coordinates
        .map(|(axis, text)| rational(text, &format!("{place}[{axis}]")))
        .collect()
}

fn witness(
    operation: &Operation,
    text: &str,
    dimension: usize,
    tokens_left: &mut usize,
    place: &str,
) -> Parsed<Witness> {
    if let Operation::NearestPoint { .. } = operation {
        let Object(raw): Object<RawNearestWitness> = parse_within(text, place)?;
        let parameter = parameter(&raw.parameter, &format!("{place}.parameter"))?;
        return Ok(Witness::Nearest { parameter });
    }
    let Object(raw): Object<RawDistanceWitness> = parse_within(text, place)?;
    let AtMost(texts) = &raw.parameters;
    let [s, t] = texts.as_slice() else {
        return Err(FormatError::malformed(
            format!("{place}.parameters"),
            "expected two parameters",
        ));
    };
    let parameters = [
        parameter(s, &format!("{place}.parameters[0]"))?,
        parameter(t, &format!("{place}.parameters[1]"))?,
    ];
    let tree = match raw.tree {
        None => None,
        Some(AtMost(tokens)) => {
            *tokens_left = tokens_left.checked_sub(tokens.len()).ok_or_else(|| {
                FormatError::malformed(
                    format!("{place}.tree"),
                    format!("more than {MOST_TOKENS} tokens in all"),
                )
            })?;
            let tokens = tokens.iter().enumerate().map(|(i, token)| {
                parse_token(&token.0, dimension)
                    .map_err(|error| FormatError::malformed(format!("{place}.tree[{i}]"), error.to_string()))
            });
            Some(tokens.collect::<Parsed<_>>()?)
        }
    };
    Ok(Witness::Distance { parameters, tree })
}

/// The statement.
pub fn statement_text(statement: &Statement) -> String {
    let mut text = String::from("{ \"claim\": \"values\", \"entries\": [");
    for (i, entry) in statement.entries.iter().enumerate() {
        text.push_str(if i == 0 { "\n    { " } else { ",\n    { " });
        entry_text(entry, &mut text);
        text.push_str(" }");
    }
    text.push_str("\n  ] }");
    text
}

fn entry_text(entry: &Entry, out: &mut String) {
    // Writing into a string does not fail.
    let _ = write!(out, "\"operation\": \"{}\"", entry.operation.name());
    let _ = match &entry.operation {
        Operation::Point { parameter } | Operation::Split { parameter } => {
            write!(out, ", \"parameter\": \"{}\"", parameter.format())
        }
        Operation::Derivative { parameter, order, side } => write!(
            out,
            ", \"parameter\": \"{}\", \"order\": {order}, \"side\": \"{}\"",
            parameter.format(),
            side.name()
        ),
        Operation::Curvature { parameter, side } | Operation::Torsion { parameter, side } => write!(
            out,
            ", \"parameter\": \"{}\", \"side\": \"{}\"",
            parameter.format(),
            side.name()
        ),
        Operation::InsertKnot { parameter, times } | Operation::RemoveKnot { parameter, times } => {
            write!(out, ", \"parameter\": \"{}\", \"times\": {times}", parameter.format())
        }
        Operation::ElevateDegree { times } => write!(out, ", \"times\": {times}"),
        Operation::Decompose => Ok(()),
        Operation::NearestPoint { target } => write!(out, ", \"target\": {}", list(target)),
        Operation::CurveDistance { other } => {
            out.push_str(", \"other\": ");
            curve_text(other, out);
            Ok(())
        }
    };
    let _ = match &entry.outcome {
        Outcome::Point(point) => write!(out, ", \"point\": {}", list(point)),
        Outcome::Vector(vector) => write!(out, ", \"vector\": {}", list(vector)),
        Outcome::ValueSquared(squared) => write!(out, ", \"value_squared\": \"{}\"", squared.format()),
        Outcome::Value(value) => write!(out, ", \"value\": \"{}\"", value.format()),
        Outcome::Curve(curve) => {
            out.push_str(", \"curve\": ");
            curve_text(curve, out);
            Ok(())
        }
        Outcome::Curves(curves) => {
            out.push_str(", \"curves\": [");
            curve_text(&curves[0], out);
            out.push_str(", ");
            curve_text(&curves[1], out);
            out.push(']');
            Ok(())
        }
        Outcome::DistanceSquared { lower, upper } => write!(
            out,
            ", \"lower_squared\": \"{}\", \"upper_squared\": \"{}\"",
            lower.format(),
            upper.format()
        ),
    };
}

fn list(numbers: &[Rational]) -> String {
    let texts: Vec<String> = numbers.iter().map(|x| format!("\"{}\"", x.format())).collect();
    format!("[{}]", texts.join(", "))
}

/// The evidence; vectors of tokens have `dimension` components.
pub fn evidence_text(evidence: &Evidence, dimension: usize) -> String {
    let witnesses = evidence.witnesses.iter().map(|witness| match witness {
        Witness::Nearest { parameter } => format!("{{ \"parameter\": \"{}\" }}", parameter.format()),
        Witness::Distance { parameters, tree } => {
            let tree = match tree {
                None => "null".into(),
                Some(tokens) => {
                    let texts = tokens
                        .iter()
                        .map(|token| format!("\"{}\"", token_text(token, dimension)));
                    format!("[{}]", texts.collect::<Vec<_>>().join(", "))
                }
            };
            format!("{{ \"parameters\": {}, \"tree\": {tree} }}", list(parameters))
        }
    });
    let witnesses: Vec<String> = witnesses.collect();
    match witnesses.as_slice() {
        [] => "{ \"witnesses\": [] }".into(),
        _ => format!("{{ \"witnesses\": [\n    {}\n  ] }}", witnesses.join(",\n    ")),
    }
}
