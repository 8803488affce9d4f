//! The JSON files of geomdl (NURBS-Python): one or several B-spline or NURBS curves.
//!
//! Control points are affine there, weights stand apart; knots are kept as they are.

use serde::Deserialize;
use serde_json::value::RawValue;

use super::build::{Point, spline};
use super::error::{ImportError, Place, curve_fault};
use super::text::number;
use super::{Format, Imported, ImportedCurve, Options};
use crate::curve::MAXIMUM_DEGREE;
use crate::number::{Meaning, Rational};

#[derive(Deserialize)]
struct Document<'a> {
    #[serde(borrow)]
    shape: Shape<'a>,
}

/// Fields that are not named here tell how to draw the curve, not which it is.
#[derive(Deserialize)]
struct Shape<'a> {
    #[serde(rename = "type")]
    _type: String,
    #[serde(borrow)]
    data: Vec<Spline<'a>>,
}

#[derive(Deserialize)]
struct Spline<'a> {
    #[serde(default)]
    name: Option<String>,
    degree: usize,
    #[serde(borrow)]
    knotvector: Vec<&'a RawValue>,
    #[serde(borrow)]
    control_points: ControlPoints<'a>,
}

#[derive(Deserialize)]
struct ControlPoints<'a> {
    #[serde(borrow)]
    points: Vec<Vec<&'a RawValue>>,
    #[serde(borrow, default)]
    weights: Option<Vec<&'a RawValue>>,
}

/// Reads a file of curves.
pub(super) fn read(text: &str, options: &Options) -> Result<Imported, ImportError> {
    // Anything but curves is refused before its data is looked at.
    #[derive(Deserialize)]
    struct Kind {
        shape: KindShape,
    }
    #[derive(Deserialize)]
    struct KindShape {
        r#type: String,
    }
    let at = |path: &str, message: String| ImportError {
        place: Some(Place::Path(path.to_string())),
        message,
    };
    if let Ok(Kind { shape }) = serde_json::from_str(text)
        && shape.r#type != "curve"
    {
        return Err(at(
            "shape.type",
            format!("found {:?}, expected \"curve\"", shape.r#type),
        ));
    }
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let document: Document = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = error.path().to_string();
        at(
            path.trim_end_matches('?').trim_matches('.'),
            error.into_inner().to_string(),
        )
    })?;
    deserializer.end().map_err(|error| at("", error.to_string()))?;
    let mut curves = Vec::new();
    for (i, data) in document.shape.data.iter().enumerate() {
        let path = format!("shape.data[{i}]");
        if data.degree > MAXIMUM_DEGREE {
            let message = format!("found the degree {}, expected at most {MAXIMUM_DEGREE}", data.degree);
            return Err(at(&format!("{path}.degree"), message));
        }
        let list = |name: &str, values: &[&RawValue]| -> Result<Vec<Rational>, ImportError> {
            let value = |(k, value): (usize, &&RawValue)| {
                value_of(value, options.meaning).map_err(|message| at(&format!("{path}.{name}[{k}]"), message))
            };
            values.iter().enumerate().map(value).collect()
        };
        let knots = list("knotvector", &data.knotvector)?;
        let points: Result<Vec<Point>, ImportError> = data
            .control_points
            .points
            .iter()
            .enumerate()
            .map(|(k, point)| list(&format!("control_points.points[{k}]"), point))
            .collect();
        let weights = data.control_points.weights.as_ref();
        let weights = weights
            .map(|weights| list("control_points.weights", weights))
            .transpose()?;
        let curve = spline(data.degree, &knots, &points?, weights.as_deref());
        curves.push(ImportedCurve {
            name: data.name.clone().unwrap_or_else(|| format!("curve{i}")),
            aliases: Vec::new(),
            curve: curve.map_err(|error| at(&path, curve_fault(&error)))?,
            notes: Vec::new(),
        });
    }
    Ok(Imported {
        format: Format::Geomdl,
        curves,
        notes: Vec::new(),
    })
}

/// The value of a JSON number.
fn value_of(value: &RawValue, meaning: Meaning) -> Result<Rational, String> {
    number(value.get(), meaning)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Form;
    use crate::import::text::ratio;

    fn file(more: &str) -> String {
        format!(
            r#"{{"shape": {{"type": "curve", "count": 1, "data": [{{"type": "spline", "rational": true, "dimension": 2,
            "degree": 2, "knotvector": [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], "delta": 0.01,
            "control_points": {{"points": [[0.1, 0.0], [1.0, 1e-1], [2.0, 0.0]] {more}}}}}]}}}}"#
        )
    }

    #[test]
    fn decimals_are_exact() {
        let read = read(&file(r#", "weights": [1.0, 0.3, 1.0]"#), &Options::default()).unwrap();
        let Form::BSpline(spline) = read.curves[0].curve.form() else {
            panic!()
        };
        assert_eq!(spline.points().get(0), ratio(1, 10));
        assert_eq!(spline.weights().unwrap().get(1), ratio(3, 10));
        assert_eq!(spline.degree(), 2);
        // Equal weights are none.
        let same = super::read(&file(r#", "weights": [2.0, 2.0, 2.0]"#), &Options::default()).unwrap();
        let Form::BSpline(spline) = same.curves[0].curve.form() else {
            panic!()
        };
        assert_eq!(spline.weights(), None);
    }

    #[test]
    fn faults_with_their_path() {
        let good = file("");
        for (from, to, expected) in [
            ("0.1,", "\"x\",", "shape.data[0].control_points.points[0][0]: found"),
            ("\"curve\"", "\"surface\"", "shape.type: found \"surface\""),
            ("\"degree\": 2", "\"degree\": 99", "shape.data[0].degree: found"),
            (
                "[0.0, 0.0, 0.0, ",
                "[0.0, 0.0, 2.0, ",
                "shape.data[0]: not a curve: knots",
            ),
            ("[2.0, 0.0]", "[2.0]", "shape.data[0]: not a curve: points[2]"),
            ("\"degree\": 2,", "", "missing field `degree`"),
            ("}]}}", "}]}} x", "trailing"),
        ] {
            let text = good.replace(from, to);
            assert_ne!(text, good);
            let error = read(&text, &Options::default()).unwrap_err().to_string();
            assert!(error.contains(expected), "{to}: {error}");
        }
    }
}
