//! Answers of engines.

use super::FloatCurve;

/// What an engine returned for a case. Numbers may be infinite or NaN: the judge calls them wrong.
#[derive(Debug, Clone, PartialEq)]
pub enum Returned {
    /// A point.
    Point(Vec<f64>),
    /// A derivative.
    Vector(Vec<f64>),
    /// A curvature or torsion.
    Value(f64),
    /// A curve.
    Curve(FloatCurve),
    /// Several curves, in the order of the parameter.
    Curves(Vec<FloatCurve>),
    /// A distance, or nothing when the engine says there is none.
    Distance {
        /// The distance.
        distance: Option<f64>,
        /// Where it is attained, when the engine tells: one parameter, or one of each curve.
        parameters: Vec<f64>,
    },
    /// The vertices of a polygon.
    Vertices(Vec<Vec<f64>>),
}

impl Returned {
    /// The name of the result's field in files.
    pub fn field(&self) -> &'static str {
        match self {
            Returned::Point(_) => "point",
            Returned::Vector(_) => "vector",
            Returned::Value(_) => "value",
            Returned::Curve(_) => "curve",
            Returned::Curves(_) => "curves",
            Returned::Distance { .. } => "distance",
            Returned::Vertices(_) => "vertices",
        }
    }
}

/// An engine's answer to one case.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// It returned something.
    Ok(Returned),
    /// It raised an error, of this text.
    Refused(String),
    /// It has no such operation.
    NotOffered,
}

/// One entry of a file of results.
#[derive(Debug, Clone, PartialEq)]
pub struct ResultEntry {
    /// The id of the case.
    pub id: String,
    /// The answer.
    pub answer: Answer,
}

/// A file of results.
#[derive(Debug, Clone, PartialEq)]
pub struct ResultsFile {
    /// The engine's name and version.
    pub engine: String,
    /// At least one entry, ids all different.
    pub results: Vec<ResultEntry>,
}
