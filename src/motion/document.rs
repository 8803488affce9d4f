//! The JSON of motion files, with the texts of numbers and steps borrowed.

use std::path::Path;

use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

use super::{Content, MotionError, Move, VERSION};
use crate::curve::{CurveFile, MAXIMUM_BITS, ReadError, ReadOptions, read_curve_with, read_number};
use crate::number::{Meaning, Rational};

/// The top level.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Header<'a> {
    knotproof: String,
    #[serde(default, deserialize_with = "present")]
    pub(super) name: Option<String>,
    #[serde(default, deserialize_with = "present")]
    numbers: Option<String>,
    #[serde(borrow)]
    curve: &'a RawValue,
    #[serde(default, deserialize_with = "present")]
    pub(super) strategy: Option<String>,
    #[serde(default, deserialize_with = "present")]
    pub(super) subdivisions: Option<u32>,
    #[serde(borrow, default, deserialize_with = "present")]
    display_tolerance: Option<&'a RawValue>,
    #[serde(borrow, default, deserialize_with = "present")]
    pub(super) steps: Option<Vec<&'a RawValue>>,
    #[serde(borrow, default, deserialize_with = "present")]
    pub(super) frames: Option<Vec<&'a RawValue>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StepDocument<'a> {
    #[serde(borrow)]
    moves: Vec<MoveDocument<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MoveDocument<'a> {
    point: u64,
    #[serde(borrow)]
    by: Vec<&'a RawValue>,
    #[serde(default, rename = "type", deserialize_with = "present")]
    kind: Option<u8>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LineDocument<'a> {
    #[serde(borrow, default, deserialize_with = "present")]
    moves: Option<Vec<MoveDocument<'a>>>,
    #[serde(borrow, default, deserialize_with = "present")]
    points: Option<Vec<Vec<&'a RawValue>>>,
}

/// A field that may be absent but not null.
fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

/// A value of a text; the path of an error is looked for only when there is one.
fn parse<'a, T: Deserialize<'a>>(text: &'a str) -> Result<T, MotionError> {
    serde_json::from_str(text).map_err(|error| {
        let mut deserializer = serde_json::Deserializer::from_str(text);
        match serde_path_to_error::deserialize::<_, T>(&mut deserializer) {
            Err(located) => {
                let path = located.path().to_string();
                let path = path.trim_end_matches('?').trim_matches('.').to_string();
                MotionError::new(path, located.into_inner().to_string())
            }
            Ok(_) => MotionError::new("", error.to_string()),
        }
    })
}

/// The header of a text, with or without steps.
pub(super) fn parse_header(text: &str) -> Result<Header<'_>, MotionError> {
    #[derive(Deserialize)]
    struct Version {
        knotproof: String,
    }
    let header = parse::<Header>(text);
    let version = match &header {
        Ok(header) => Some(header.knotproof.clone()),
        Err(_) => serde_json::from_str(text).ok().map(|Version { knotproof }| knotproof),
    };
    match version {
        Some(version) if version != VERSION => {
            let what = format!("found version {version:?}, expected {VERSION:?}");
            Err(MotionError::new("knotproof", what))
        }
        _ => header,
    }
}

/// What decimals mean.
pub(super) fn meaning(header: &Header) -> Result<Meaning, MotionError> {
    match header.numbers.as_deref() {
        None | Some("decimal") => Ok(Meaning::Decimal),
        Some("binary64") => Ok(Meaning::Binary64),
        Some(other) => {
            let what = format!("found {other:?}, expected \"decimal\" or \"binary64\"");
            Err(MotionError::new("numbers", what))
        }
    }
}

/// The curve, from the document or from a file of its own.
pub(super) fn curve(header: &Header, folder: &Path, snap_joints: bool) -> Result<CurveFile, MotionError> {
    let text = header.curve.get();
    let options = ReadOptions { snap_joints };
    if !text.starts_with('"') {
        let within = |error: ReadError| MotionError::new(error.path, error.fault.to_string()).within("curve");
        return read_curve_with(text, options).map_err(within);
    }
    let path: String = parse(text).map_err(|error| error.within("curve"))?;
    let path = folder.join(path);
    let of_file = |what: String| MotionError::new("curve", format!("{}: {what}", path.display()));
    let text = std::fs::read(&path).map_err(|error| of_file(format!("cannot be read: {error}")))?;
    read_curve_with(&text, options).map_err(|error| of_file(error.to_string()))
}

/// The display tolerance, positive.
pub(super) fn display_tolerance(header: &Header, meaning: Meaning) -> Result<Option<Rational>, MotionError> {
    let Some(raw) = header.display_tolerance else {
        return Ok(None);
    };
    let tolerance = number(raw, meaning).map_err(|what| MotionError::new("display_tolerance", what))?;
    if !tolerance.numer().is_positive() {
        let what = format!("found {tolerance}, expected a positive number");
        return Err(MotionError::new("display_tolerance", what));
    }
    Ok(Some(tolerance))
}

fn number(raw: &RawValue, meaning: Meaning) -> Result<Rational, String> {
    let number = read_number(raw, meaning).map_err(|fault| fault.to_string())?;
    if number.numer().bits().max(number.denom().bits()) > MAXIMUM_BITS {
        return Err(format!(
            "found a number above {MAXIMUM_BITS} bits, expected a smaller one"
        ));
    }
    Ok(number)
}

/// A step: an entry of `steps` or of `frames`, or a line of either kind.
pub(super) fn parse_step(
    text: &str,
    frames: Option<bool>,
    dimension: usize,
    meaning: Meaning,
) -> Result<Content, MotionError> {
    match frames {
        Some(false) => moves(parse::<StepDocument>(text)?.moves, dimension, meaning),
        Some(true) => frame(&parse::<Vec<Vec<&RawValue>>>(text)?, "", dimension, meaning),
        None => {
            let line = parse::<LineDocument>(text)?;
            match (line.moves, line.points) {
                (Some(list), None) => moves(list, dimension, meaning),
                (None, Some(points)) => frame(&points, "points", dimension, meaning),
                (Some(_), Some(_)) => Err(MotionError::new(
                    "",
                    "found both moves and points, expected one of them",
                )),
                (None, None) => Err(MotionError::new(
                    "",
                    "found neither moves nor points, expected one of them",
                )),
            }
        }
    }
}

fn moves(list: Vec<MoveDocument>, dimension: usize, meaning: Meaning) -> Result<Content, MotionError> {
    let mut moves = Vec::with_capacity(list.len());
    for (i, entry) in list.into_iter().enumerate() {
        let by = vector(&entry.by, &|| format!("moves[{i}].by"), dimension, meaning)?;
        moves.push(Move {
            point: entry.point,
            by,
            kind: entry.kind,
        });
    }
    Ok(Content::Moves(moves))
}

fn frame(points: &[Vec<&RawValue>], field: &str, dimension: usize, meaning: Meaning) -> Result<Content, MotionError> {
    let mut coordinates = Vec::with_capacity(points.len() * dimension);
    for (i, point) in points.iter().enumerate() {
        coordinates.extend(vector(point, &|| format!("{field}[{i}]"), dimension, meaning)?);
    }
    Ok(Content::Frame(coordinates))
}

fn vector(
    list: &[&RawValue],
    place: &dyn Fn() -> String,
    dimension: usize,
    meaning: Meaning,
) -> Result<Vec<Rational>, MotionError> {
    if list.len() != dimension {
        let what = format!("found {} coordinates, expected {dimension}", list.len());
        return Err(MotionError::new(place(), what));
    }
    let numbers = list.iter().enumerate();
    numbers
        .map(|(axis, raw)| number(raw, meaning).map_err(|what| MotionError::new(format!("{}[{axis}]", place()), what)))
        .collect()
}
