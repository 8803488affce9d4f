//! Strict readers of cases and results.

use std::collections::HashSet;
use std::fmt;

use serde::de::{DeserializeOwned, Error, Visitor};
use serde::{Deserialize, Deserializer};

use super::{
    Answer, CASES_VERSION, Case, CaseSide, CasesFile, FileError, FloatCurve, MOST_LEVELS, OPERATIONS, Operation,
    RESULTS_VERSION, ResultEntry, ResultsFile, Returned,
};
use crate::curve::MAXIMUM_DEGREE;
use crate::number::{Meaning, Rational, RationalExt, parse_number};

/// The greatest number of cases or results in a file.
pub const MOST_ENTRIES: usize = 1_000_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCases {
    knotproof: String,
    #[serde(default)]
    seed: Option<u64>,
    cases: Vec<RawCase>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCase {
    id: String,
    operation: String,
    curve: RawCurve,
    #[serde(default)]
    parameter: Option<f64>,
    #[serde(default)]
    order: Option<usize>,
    #[serde(default)]
    side: Option<CaseSide>,
    #[serde(default)]
    times: Option<usize>,
    #[serde(default)]
    target: Option<Vec<f64>>,
    #[serde(default)]
    other: Option<RawCurve>,
    #[serde(default)]
    point: Option<usize>,
    #[serde(default, rename = "box")]
    half_width: Option<f64>,
    #[serde(default)]
    level: Option<u32>,
    #[serde(default)]
    sign: Option<Sign>,
}

#[derive(Deserialize, Clone, Copy, PartialEq)]
enum Sign {
    #[serde(rename = "+")]
    Positive,
    #[serde(rename = "-")]
    Negative,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCurve {
    degree: usize,
    knots: Vec<Number>,
    points: Vec<Vec<Number>>,
    #[serde(default)]
    weights: Option<Vec<Number>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawResults {
    knotproof: String,
    engine: String,
    results: Vec<RawResult>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawResult {
    id: String,
    status: Status,
    #[serde(default)]
    message: Option<String>,
    #[serde(default)]
    point: Option<Vec<Number>>,
    #[serde(default)]
    vector: Option<Vec<Number>>,
    #[serde(default)]
    value: Option<Number>,
    #[serde(default)]
    curve: Option<RawCurve>,
    #[serde(default)]
    curves: Option<Vec<RawCurve>>,
    #[serde(default, deserialize_with = "present")]
    distance: Option<Option<Number>>,
    #[serde(default)]
    parameter: Option<Number>,
    #[serde(default)]
    parameters: Option<Vec<Number>>,
    #[serde(default)]
    vertices: Option<Vec<Vec<Number>>>,
}

#[derive(Deserialize, Clone, Copy, PartialEq)]
#[serde(rename_all = "snake_case")]
enum Status {
    Ok,
    Refused,
    NotOffered,
}

/// A field that says null is there all the same.
fn present<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Option<Number>>, D::Error> {
    Option::deserialize(deserializer).map(Some)
}

/// A binary64: a JSON number, a hexadecimal float in a string, or the name of a value that JSON cannot write.
#[derive(Clone, Copy)]
struct Number(f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Numbers;
        impl Visitor<'_> for Numbers {
            type Value = Number;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, or a string with a hexadecimal float, \"NaN\", \"Infinity\" or \"-Infinity\"")
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Number, E> {
                Ok(Number(value))
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Number, E> {
                Ok(Number(value as f64))
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<Number, E> {
                Ok(Number(value as f64))
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Number, E> {
                match text {
                    "NaN" => return Ok(Number(f64::NAN)),
                    "Infinity" => return Ok(Number(f64::INFINITY)),
                    "-Infinity" => return Ok(Number(f64::NEG_INFINITY)),
                    _ => {}
                }
                let unsigned = text.trim_start_matches('-');
                if !unsigned.starts_with("0x") && !unsigned.starts_with("0X") {
                    return Err(E::invalid_value(serde::de::Unexpected::Str(text), &self));
                }
                let exact = parse_number(text, Meaning::Decimal).map_err(E::custom)?;
                let value = exact.to_f64();
                if Rational::from_f64(value).as_ref() != Some(&exact) {
                    return Err(E::custom(format!(
                        "found {text:?}, expected a number that binary64 holds"
                    )));
                }
                Ok(Number(value))
            }
        }
        deserializer.deserialize_any(Numbers)
    }
}

fn numbers(raw: Vec<Number>) -> Vec<f64> {
    raw.into_iter().map(|number| number.0).collect()
}

impl From<RawCurve> for FloatCurve {
    fn from(raw: RawCurve) -> FloatCurve {
        FloatCurve {
            degree: raw.degree,
            knots: numbers(raw.knots),
            points: raw.points.into_iter().map(numbers).collect(),
            weights: raw.weights.map(numbers),
        }
    }
}

/// Reads a file of cases, version `cases/1`.
///
/// # Errors
/// The first fault with its JSON path: other versions, unknown, missing or duplicate fields, duplicate ids, an unknown operation, parameters that an
/// operation does not take or lacks, a curve that is none, a parameter outside its domain, no case at all.
pub fn read_cases(json: impl AsRef<[u8]>) -> Result<CasesFile, FileError> {
    let raw: RawCases = document(json.as_ref(), CASES_VERSION)?;
    version(&raw.knotproof, CASES_VERSION)?;
    check_count("cases", raw.cases.len())?;
    let mut ids = HashSet::new();
    let mut cases = Vec::with_capacity(raw.cases.len());
    for (i, raw) in raw.cases.into_iter().enumerate() {
        if !ids.insert(raw.id.clone()) {
            return Err(duplicate("cases", i, &raw.id));
        }
        let case = case(raw).map_err(|error| {
            let dot = if error.path.is_empty() { "" } else { "." };
            FileError::new(format!("cases[{i}]{dot}{}", error.path), error.what)
        })?;
        cases.push(case);
    }
    Ok(CasesFile { seed: raw.seed, cases })
}

/// Reads a file of results, version `results/1`.
///
/// # Errors
/// As [`read_cases`]; an entry with `"status": "ok"` must have exactly one result, any other none. Numbers that are not finite are no
/// error when written as the strings "NaN", "Infinity" and "-Infinity": the judge calls them wrong.
pub fn read_results(json: impl AsRef<[u8]>) -> Result<ResultsFile, FileError> {
    let raw: RawResults = document(json.as_ref(), RESULTS_VERSION)?;
    version(&raw.knotproof, RESULTS_VERSION)?;
    check_count("results", raw.results.len())?;
    let mut ids = HashSet::new();
    let mut results = Vec::with_capacity(raw.results.len());
    for (i, raw) in raw.results.into_iter().enumerate() {
        if !ids.insert(raw.id.clone()) {
            return Err(duplicate("results", i, &raw.id));
        }
        let id = raw.id.clone();
        let answer = answer(raw).map_err(|what| FileError::new(format!("results[{i}]"), what))?;
        results.push(ResultEntry { id, answer });
    }
    Ok(ResultsFile {
        engine: raw.engine,
        results,
    })
}

fn duplicate(list: &str, i: usize, id: &str) -> FileError {
    FileError::new(
        format!("{list}[{i}].id"),
        format!("found the id {id:?} again, expected each id once"),
    )
}

fn check_count(list: &str, count: usize) -> Result<(), FileError> {
    match count {
        0 => Err(FileError::new(list, "found an empty list, expected at least one entry")),
        1..=MOST_ENTRIES => Ok(()),
        _ => Err(FileError::new(
            list,
            format!("found {count} entries, expected at most {MOST_ENTRIES}"),
        )),
    }
}

fn version(found: &str, expected: &str) -> Result<(), FileError> {
    if found == expected {
        return Ok(());
    }
    Err(FileError::new(
        "knotproof",
        format!("found version {found:?}, expected {expected:?}"),
    ))
}

fn document<T: DeserializeOwned>(json: &[u8], expected: &str) -> Result<T, FileError> {
    #[derive(Deserialize)]
    struct Version {
        knotproof: String,
    }
    let mut deserializer = serde_json::Deserializer::from_slice(json);
    let parsed = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = error.path().to_string();
        let what = error.into_inner().to_string();
        (path.trim_end_matches('?').trim_matches('.').to_string(), what)
    });
    let parsed = parsed.and_then(|document| match deserializer.end() {
        Ok(()) => Ok(document),
        Err(error) => Err((String::new(), error.to_string())),
    });
    parsed.map_err(|(path, what)| {
        // Of another version every field may differ: that is the first thing to tell.
        if let Ok(Version { knotproof }) = serde_json::from_slice(json)
            && let Err(error) = version(&knotproof, expected)
        {
            return error;
        }
        FileError::new(path, what)
    })
}

fn case(raw: RawCase) -> Result<Case, FileError> {
    let given = [
        ("parameter", raw.parameter.is_some()),
        ("order", raw.order.is_some()),
        ("side", raw.side.is_some()),
        ("times", raw.times.is_some()),
        ("target", raw.target.is_some()),
        ("other", raw.other.is_some()),
        ("point", raw.point.is_some()),
        ("box", raw.half_width.is_some()),
        ("level", raw.level.is_some()),
        ("sign", raw.sign.is_some()),
    ];
    let wanted: &[&str] = match raw.operation.as_str() {
        "point" | "split" => &["parameter"],
        "derivative" => &["parameter", "order", "side"],
        "curvature" | "torsion" => &["parameter", "side"],
        "insert_knot" | "remove_knot" => &["parameter", "times"],
        "elevate_degree" => &["times"],
        "decompose" | "msd" => &[],
        "nearest_point" => &["target"],
        "curve_distance" => &["other"],
        "convex_domain" => &["point", "box", "level", "sign"],
        other => {
            let what = format!("found {other:?}, expected one of {}", OPERATIONS.join(", "));
            return Err(FileError::new("operation", what));
        }
    };
    for (name, is_given) in given {
        if is_given != wanted.contains(&name) {
            let what = if is_given {
                "is not a parameter of"
            } else {
                "is missing in"
            };
            return Err(FileError::new(name, format!("{what} the operation {}", raw.operation)));
        }
    }
    let curve = FloatCurve::from(raw.curve);
    let exact = exact("curve", &curve)?;
    if let Some(parameter) = raw.parameter {
        let (start, end) = exact.domain();
        let inside = Rational::from_f64(parameter).is_some_and(|t| start <= t && t <= end);
        if !inside {
            let what = format!("found {parameter}, expected a number of the domain {start} to {end}");
            return Err(FileError::new("parameter", what));
        }
    }
    check_small("order", raw.order)?;
    check_small("times", raw.times)?;
    let parameter = raw.parameter.unwrap_or_default();
    let (order, times) = (raw.order.unwrap_or_default(), raw.times.unwrap_or_default());
    let side = raw.side.unwrap_or(CaseSide::Right);
    let operation = match raw.operation.as_str() {
        "point" => Operation::Point { parameter },
        "derivative" => Operation::Derivative { parameter, order, side },
        "curvature" => Operation::Curvature { parameter, side },
        "torsion" if exact.dimension() == 3 => Operation::Torsion { parameter, side },
        "torsion" => {
            return Err(FileError::new(
                "curve",
                "found a planar curve, expected one in space for torsion",
            ));
        }
        "insert_knot" => Operation::InsertKnot { parameter, times },
        "remove_knot" => Operation::RemoveKnot { parameter, times },
        "elevate_degree" => Operation::ElevateDegree { times },
        "split" => Operation::Split { parameter },
        "decompose" => Operation::Decompose,
        "nearest_point" => {
            let target = raw.target.unwrap_or_default();
            if target.len() != exact.dimension() {
                let what = format!("found {} coordinates, expected {}", target.len(), exact.dimension());
                return Err(FileError::new("target", what));
            }
            Operation::NearestPoint { target }
        }
        "curve_distance" => {
            let other = raw.other.map(FloatCurve::from).unwrap_or_else(|| curve.clone());
            let dimension = self::exact("other", &other)?.dimension();
            if dimension != exact.dimension() {
                let what = format!("found {dimension} coordinates, expected {}", exact.dimension());
                return Err(FileError::new("other.points", what));
            }
            Operation::CurveDistance { other: Box::new(other) }
        }
        "msd" => Operation::Msd,
        _ => {
            let point = raw.point.unwrap_or_default();
            if point >= exact.count() {
                let what = format!("found {point}, expected an index below {}", exact.count());
                return Err(FileError::new("point", what));
            }
            let half_width = raw.half_width.unwrap_or_default();
            if !(half_width.is_finite() && half_width > 0.0) {
                return Err(FileError::new(
                    "box",
                    format!("found {half_width}, expected a positive number"),
                ));
            }
            let level = raw.level.unwrap_or_default();
            if level > MOST_LEVELS {
                let what = format!("found {level}, expected a number from 0 to {MOST_LEVELS}");
                return Err(FileError::new("level", what));
            }
            if curve.degree < exact.dimension() {
                let what = format!("found {}, expected at least {}", curve.degree, exact.dimension());
                return Err(FileError::new("curve.degree", what));
            }
            Operation::ConvexDomain {
                point,
                half_width,
                level,
                positive: raw.sign == Some(Sign::Positive),
            }
        }
    };
    Ok(Case {
        id: raw.id,
        operation,
        curve,
    })
}

fn exact(place: &str, curve: &FloatCurve) -> Result<crate::curve::BSpline, FileError> {
    curve.exact().map_err(|error| {
        let dot = if error.path.is_empty() { "" } else { "." };
        FileError::new(format!("{place}{dot}{}", error.path), error.what)
    })
}

/// Orders and repetitions: from 1 to the highest degree.
fn check_small(name: &str, found: Option<usize>) -> Result<(), FileError> {
    match found {
        None | Some(1..=MAXIMUM_DEGREE) => Ok(()),
        Some(found) => Err(FileError::new(
            name,
            format!("found {found}, expected 1 to {MAXIMUM_DEGREE}"),
        )),
    }
}

fn answer(raw: RawResult) -> Result<Answer, String> {
    let parameters = match (raw.parameter, raw.parameters) {
        (Some(_), Some(_)) => return Err("found both parameter and parameters, expected one of them".into()),
        (Some(parameter), None) => vec![parameter.0],
        (None, parameters) => numbers(parameters.unwrap_or_default()),
    };
    let mut found: Vec<Returned> = Vec::new();
    found.extend(raw.point.map(|p| Returned::Point(numbers(p))));
    found.extend(raw.vector.map(|v| Returned::Vector(numbers(v))));
    found.extend(raw.value.map(|v| Returned::Value(v.0)));
    found.extend(raw.curve.map(|c| Returned::Curve(c.into())));
    found.extend(
        raw.curves
            .map(|c| Returned::Curves(c.into_iter().map(FloatCurve::from).collect())),
    );
    found.extend(
        raw.vertices
            .map(|v| Returned::Vertices(v.into_iter().map(numbers).collect())),
    );
    found.extend(raw.distance.map(|distance| Returned::Distance {
        distance: distance.map(|distance| distance.0),
        parameters,
    }));
    let names = || found.iter().map(Returned::field).collect::<Vec<_>>().join(" and ");
    match (raw.status, found.len()) {
        (Status::Ok, 1) => Ok(Answer::Ok(found.swap_remove(0))),
        (Status::Ok, 0) => Err("found status \"ok\" without a result, expected one of point, vector, value, curve, curves, distance, vertices".into()),
        (Status::Ok, _) => Err(format!("found {}, expected one result", names())),
        (_, 1..) => Err(format!("found {} with a status that is not \"ok\", expected no result", names())),
        (Status::Refused, 0) => Ok(Answer::Refused(raw.message.unwrap_or_default())),
        (Status::NotOffered, 0) => Ok(Answer::NotOffered),
    }
}

#[cfg(test)]
#[path = "read_tests.rs"]
mod tests;
