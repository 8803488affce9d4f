//! Methods in binary64: MP06's Newton method, and the search of this crate's own engine. Their numbers prove nothing.

use super::row::{Row, Standing, Value};
use crate::curve::Curve;
use crate::float::{self, Comparison, DoublyNormalTest};
use crate::number::{Rational, RationalExt};

/// MP06's method tries all pairs of samples; curves of more pieces get no row of it.
const MOST_PIECES: usize = 400;

/// MP06's parameters for Newton's method (its Table 1, test 5): ten samples a piece, ε₁ = ε₂ = 0.4, steps down to 10⁻⁴.
const TEST: DoublyNormalTest = DoublyNormalTest {
    samples: 10,
    first: 0.4,
    second: 0.4,
    comparison: Comparison::Magnitude,
};
const STEP: f64 = 1e-4;

fn number(x: f64) -> Value {
    Rational::from_f64(x).map_or(Value::None, Value::Number)
}

fn row(method: &'static str, key: &'static str, quantity: &str, found: Result<Option<f64>, String>) -> Row {
    let (value, remark) = match found {
        Ok(Some(distance)) => (number(distance), None),
        Ok(None) => (Value::None, Some("no double normal was found".to_string())),
        Err(why) => (Value::None, Some(why)),
    };
    let row = Row::new(method, key, quantity, value, Standing::Binary64);
    match remark {
        Some(remark) => row.remark(remark),
        None => row,
    }
}

/// The rows of both; none of a curve that binary64 cannot hold.
pub(super) fn rows(curve: &Curve) -> Vec<Row> {
    let Ok(rounded) = float::Curve::from_exact(curve) else {
        return Vec::new();
    };
    let mut rows = Vec::new();
    if curve.chain().count() <= MOST_PIECES {
        let found = rounded.newton_separation(&TEST, STEP);
        let starts = found.as_ref().map_or(0, |found| found.starts);
        let distance = found.map(|found| found.separation.map(|separation| separation.distance));
        rows.push(row(
            "MP06",
            "mp06.newton",
            "σ by Newton's method, n = 10, ε₁ = ε₂ = 0.4",
            distance.map_err(|error| error.to_string()),
        ));
        rows.push(Row::new(
            "MP06",
            "mp06.starts",
            "its starts",
            Value::Count(i64::try_from(starts).unwrap_or(i64::MAX)),
            Standing::Binary64,
        ));
    }
    let found = rounded.minimum_separation();
    rows.push(row(
        "knotproof-f64",
        "float.sigma",
        "σ by branch and bound",
        found
            .map(|found| found.map(|separation| separation.distance))
            .map_err(|error| error.to_string()),
    ));
    rows
}
