//! The rows of the certified claims.

use std::io::Cursor;

use super::{CompareError, Options, Row, Standing, Value};
use crate::approximation::MOST_EDGES;
use crate::certificate::Encoding;
use crate::claim::msd::{Convention, Lower, Statement};
use crate::curve::Curve;
use crate::number::{Integer, Rational};
use crate::prove::domain::{Status, write_checked};
use crate::prove::{curvature, deviation, embedding, msd, thickness};

const METHOD: &str = "certified";
/// Above so many edges the deviation is certified for the control polygon without subdivision.
const MOST_DEVIATION_EDGES: u64 = 20_000;

/// What the certified claims say.
pub(super) struct Certified {
    /// Of σ in the convention `smooth`.
    pub separation: Statement,
    pub rows: Vec<Row>,
}

fn failed(error: impl std::fmt::Display) -> CompareError {
    CompareError::Failed(error.to_string())
}

fn sink() -> Cursor<Vec<u8>> {
    Cursor::new(Vec::new())
}

fn msd_failure(error: msd::CertifyError) -> CompareError {
    match error {
        msd::CertifyError::PointPiece { piece } => CompareError::PointPiece { piece },
        error => failed(error),
    }
}

/// Certifies all claims but the deviation.
pub(super) fn certify(curve: &Curve, options: &Options, progress: &dyn Fn(f64)) -> Result<Certified, CompareError> {
    let mut rows = Vec::new();
    let separation = separation(curve, options, progress, &mut rows)?;
    embedding(curve, progress, &mut rows)?;
    let options = curvature::Options {
        relative_width: options.relative_width.clone(),
        name: None,
        snapped_joints: None,
    };
    curvature(curve, &options, &mut rows)?;
    thickness(curve, &options.relative_width, progress, &mut rows)?;
    Ok(Certified { separation, rows })
}

fn row(key: &'static str, quantity: &str, value: Value, status: Option<&str>) -> Row {
    match status {
        None => Row::new(METHOD, key, quantity, value, Standing::Certified),
        Some(why) => Row::new(METHOD, key, quantity, value, Standing::Undecided).remark(why),
    }
}

fn separation(
    curve: &Curve,
    options: &Options,
    progress: &dyn Fn(f64),
    rows: &mut Vec<Row>,
) -> Result<Statement, CompareError> {
    let options = msd::Options {
        relative_width: options.relative_width.clone(),
        ..msd::Options::default()
    };
    let mut found = msd::certify(curve, &options, progress).map_err(msd_failure)?;
    found
        .write_checked(Encoding::Binary, &mut sink())
        .map_err(msd_failure)?;
    let statement = found.document.claim.statement.clone();
    let value = match &statement.lower_squared {
        Lower::Infinite => Value::Infinite,
        Lower::Finite(lower) => Value::RootBetween(lower.clone(), statement.upper_squared.clone()),
    };
    let why = match &found.status {
        msd::Status::Certified => None,
        msd::Status::Undecided(why) => Some(why.as_str()),
    };
    rows.push(row("certified.sigma", "σ, convention smooth", value, why));
    Ok(statement)
}

fn embedding(curve: &Curve, progress: &dyn Fn(f64), rows: &mut Vec<Row>) -> Result<(), CompareError> {
    let (edges, radius) = ("edges of an isotopic inscribed polygon", "perturbation radius, ∞-norm");
    let euclidean = "perturbation radius, Euclidean";
    let keys = [
        ("certified.edges", edges),
        ("certified.radius_infinity", radius),
        ("certified.radius_euclidean", euclidean),
    ];
    let outcome = embedding::certify(curve, &embedding::Options::default(), progress).map_err(msd_failure)?;
    match outcome {
        embedding::Outcome::Embedded(mut found) => {
            found
                .write_checked(Encoding::Binary, &mut sink())
                .map_err(msd_failure)?;
            let statement = &found.document.claim.statement;
            let values = [
                Value::Count(i64::try_from(statement.edges).unwrap_or(i64::MAX)),
                Value::Between(statement.perturbation_radius.infinity.clone(), None),
                Value::Between(statement.perturbation_radius.euclidean.clone(), None),
            ];
            let control = found.control_polygon_edges.and_then(|edges| i64::try_from(edges).ok());
            let control = Row::new(
                METHOD,
                "certified.control_polygon_edges",
                "edges of an isotopic control polygon",
                control.map_or(Value::None, Value::Count),
                Standing::Proved,
            );
            rows.push(control.if_none("not shown: pieces are rational"));
            rows.extend(
                keys.iter()
                    .zip(values)
                    .map(|((key, quantity), value)| row(key, quantity, value, None)),
            );
        }
        embedding::Outcome::MeetsItself(mut found) => {
            found
                .write_checked(Encoding::Binary, &mut sink())
                .map_err(msd_failure)?;
            let met = Row::new(METHOD, keys[0].0, keys[0].1, Value::None, Standing::Certified);
            rows.push(met.remark("the curve meets itself"));
        }
        embedding::Outcome::Undecided(why) => rows.push(row(keys[0].0, keys[0].1, Value::None, Some(&why))),
    }
    Ok(())
}

fn curvature(curve: &Curve, options: &curvature::Options, rows: &mut Vec<Row>) -> Result<(), CompareError> {
    let found = curvature::certify(curve, options).map_err(|error| CompareError::PointPiece { piece: error.0 })?;
    let mut value = Value::None;
    if let Some(document) = &found.document {
        write_checked(document, Encoding::Binary, &mut sink()).map_err(failed)?;
        let statement = &document.claim.statement;
        value = Value::RootBetween(statement.lower_squared.clone(), Some(statement.upper_squared.clone()));
    }
    rows.push(row(
        "certified.curvature",
        "greatest curvature",
        value,
        reason(&found.status),
    ));
    Ok(())
}

fn thickness(
    curve: &Curve,
    relative_width: &Rational,
    progress: &dyn Fn(f64),
    rows: &mut Vec<Row>,
) -> Result<(), CompareError> {
    let (convention, quantity) = match curve.is_closed() {
        true => (Convention::Smooth, "thickness, the radius of the thickest pipe"),
        false => (Convention::Critical, "reach, the ends included"),
    };
    let options = thickness::Options {
        convention,
        relative_width: relative_width.clone(),
        budget: None,
        name: None,
        snapped_joints: None,
    };
    let mut found = thickness::certify(curve, &options, progress).map_err(failed)?;
    let mut value = Value::None;
    if let Some(document) = &found.document {
        let statement = &document.claim.statement;
        value = match &statement.lower_squared {
            Lower::Infinite => Value::Infinite,
            Lower::Finite(lower) => Value::RootBetween(lower.clone(), statement.upper_squared.clone()),
        };
        found.write_checked(Encoding::Binary, &mut sink()).map_err(failed)?;
    }
    rows.push(row("certified.thickness", quantity, value, reason(&found.status)));
    Ok(())
}

/// The deviation of the control polygon after `subdivisions`, or without subdivision when that is too much: the bound by second differences and the
/// certified interval.
pub(super) fn deviation_rows(curve: &Curve, subdivisions: u32) -> Result<Vec<Row>, CompareError> {
    let edges = curve
        .chain()
        .pieces()
        .iter()
        .fold(0, |sum, piece| sum + piece.degree() as u64);
    if edges > MOST_EDGES {
        return Ok(Vec::new());
    }
    let subdivisions = match edges.checked_shl(subdivisions) {
        Some(all) if subdivisions <= 16 && all <= MOST_DEVIATION_EDGES => subdivisions,
        _ => 0,
    };
    let options = deviation::Options {
        subdivisions,
        relative_width: Rational::new(Integer::ONE, Integer::from(10).pow(6)),
        name: None,
        snapped_joints: None,
    };
    let found = deviation::certify(curve, &options).map_err(failed)?;
    let mut rows = Vec::new();
    let after = format!("max |c − L| after {subdivisions} subdivisions");
    if let Some(bound) = &found.bound_squared {
        rows.push(Row::new(
            "NPL99",
            "npl99.deviation",
            format!("{after}, at most"),
            Value::root(bound.clone()),
            Standing::Proved,
        ));
    }
    let mut value = Value::None;
    if let Some(document) = &found.document {
        write_checked(document, Encoding::Binary, &mut sink()).map_err(failed)?;
        let statement = &document.claim.statement;
        value = Value::RootBetween(statement.lower_squared.clone(), Some(statement.upper_squared.clone()));
    }
    rows.push(row("certified.deviation", &after, value, reason(&found.status)));
    Ok(rows)
}

fn reason(status: &Status) -> Option<&str> {
    match status {
        Status::Certified => None,
        Status::Undecided(why) => Some(why),
    }
}
