//! The JSON document of a curve file, with the texts of its numbers borrowed.

use std::fmt;

use serde::de::{DeserializeSeed, Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

use super::error::{Position, ReadError, ReadFault};

/// The top level. Version and meaning of the numbers are judged by the converter.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document<'a> {
    pub(super) knotproof: String,
    #[serde(default, deserialize_with = "present")]
    pub(super) name: Option<String>,
    #[serde(default, deserialize_with = "present")]
    pub(super) numbers: Option<String>,
    #[serde(default, deserialize_with = "present")]
    pub(super) closed: Option<bool>,
    #[serde(borrow, default, deserialize_with = "present")]
    pub(super) bspline: Option<BSplineDocument<'a>>,
    #[serde(borrow, default, deserialize_with = "present")]
    pub(super) bezier: Option<BezierDocument<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BSplineDocument<'a> {
    pub(super) degree: usize,
    #[serde(borrow)]
    pub(super) knots: Vec<&'a RawValue>,
    #[serde(borrow)]
    pub(super) points: Points<'a>,
    #[serde(borrow, default, deserialize_with = "present")]
    pub(super) weights: Option<Vec<&'a RawValue>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BezierDocument<'a> {
    #[serde(borrow)]
    pub(super) pieces: Vec<PieceDocument<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PieceDocument<'a> {
    #[serde(borrow)]
    pub(super) points: Points<'a>,
    #[serde(borrow, default, deserialize_with = "present")]
    pub(super) weights: Option<Vec<&'a RawValue>>,
}

/// A field that may be absent but not null.
fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

/// A list of points, flat: one allocation instead of one a point.
#[derive(Default)]
pub(super) struct Points<'a> {
    pub(super) flat: Vec<&'a RawValue>,
    /// The number of coordinates of the first point.
    pub(super) dimension: usize,
    /// The number of points.
    pub(super) count: usize,
    /// The first point with another number of coordinates, and that number.
    pub(super) mixed: Option<(usize, usize)>,
}

impl<'de: 'a, 'a> Deserialize<'de> for Points<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(PointsVisitor(Points::default()))
    }
}

struct PointsVisitor<'a>(Points<'a>);

impl<'de: 'a, 'a> Visitor<'de> for PointsVisitor<'a> {
    type Value = Points<'a>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of points")
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut list: A) -> Result<Self::Value, A::Error> {
        let points = &mut self.0;
        while let Some(found) = list.next_element_seed(PointVisitor(&mut points.flat))? {
            if points.count == 0 {
                points.dimension = found;
            } else if found != points.dimension && points.mixed.is_none() {
                points.mixed = Some((points.count, found));
            }
            points.count += 1;
        }
        Ok(self.0)
    }
}

/// Appends the coordinates of one point and returns their number.
struct PointVisitor<'v, 'a>(&'v mut Vec<&'a RawValue>);

impl<'de: 'a, 'a> DeserializeSeed<'de> for PointVisitor<'_, 'a> {
    type Value = usize;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<usize, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de: 'a, 'a> Visitor<'de> for PointVisitor<'_, 'a> {
    type Value = usize;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of coordinates")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<usize, A::Error> {
        let start = self.0.len();
        while let Some(number) = list.next_element::<&'a RawValue>()? {
            self.0.push(number);
        }
        Ok(self.0.len() - start)
    }
}

/// The document of a text.
pub(super) fn parse(json: &str) -> Result<Document<'_>, ReadError> {
    // The path of an error costs time: it is looked for only when there is one.
    serde_json::from_str(json).map_err(|_| locate(json))
}

/// The error of a text that is not a document.
fn locate(json: &str) -> ReadError {
    #[derive(Deserialize)]
    struct Version {
        knotproof: String,
    }
    if let Ok(Version { knotproof }) = serde_json::from_str(json)
        && knotproof != super::VERSION
    {
        return super::version_error(knotproof);
    }
    let mut deserializer = serde_json::Deserializer::from_str(json);
    let result = serde_path_to_error::deserialize::<_, Document<'_>>(&mut deserializer);
    match result {
        Err(error) => {
            let path = error.path().to_string();
            // Before the first value and after a broken one there is no path to tell.
            let path = path.trim_end_matches('?').trim_matches('.');
            read_error(path.to_string(), &error.into_inner())
        }
        Ok(_) => {
            let error = deserializer.end().err();
            let error = error.unwrap_or_else(|| Error::custom("not a curve file"));
            read_error(String::new(), &error)
        }
    }
}

fn read_error(path: String, error: &serde_json::Error) -> ReadError {
    let at = Position {
        line: error.line(),
        column: error.column(),
    };
    let text = error.to_string();
    // The position is kept apart.
    let message = match text.rfind(" at line ") {
        Some(end) => text[..end].to_string(),
        None => text,
    };
    // serde words these errors in one way only, and offers nothing but their text.
    let fault = if !error.is_data() {
        ReadFault::Syntax { message, at }
    } else if message.starts_with("unknown field") {
        ReadFault::UnknownField { message, at }
    } else if message.starts_with("missing field") {
        ReadFault::MissingField { message, at }
    } else if message.starts_with("duplicate field") {
        ReadFault::DuplicateField { message, at }
    } else {
        ReadFault::WrongType { message, at }
    };
    ReadError { path, fault }
}
