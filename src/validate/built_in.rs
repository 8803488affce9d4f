//! The engine of this library.

use crate::curve::Side;
use crate::engine::{Answer, Case, CaseSide, Engine, FloatCurve, Operation, Returned};
use crate::float::{Curve, FloatError};

/// The binary64 engine of this library, [`float`](crate::float).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct KnotproofF64;

impl KnotproofF64 {
    /// Its name without the version, as commands take it.
    pub const NAME: &'static str = "knotproof-f64";
}

/// A knot whose removal moves the curve by more than this share of its coordinates is not removed.
const REMOVAL: f64 = 1e-9;

impl Engine for KnotproofF64 {
    fn name(&self) -> String {
        format!("{} {}", KnotproofF64::NAME, env!("CARGO_PKG_VERSION"))
    }

    fn answer(&self, case: &Case) -> Answer {
        match answer(case) {
            Ok(returned) => Answer::Ok(returned),
            Err(error) => Answer::Refused(error.to_string()),
        }
    }
}

fn curve(asked: &FloatCurve) -> Result<Curve, FloatError> {
    Curve::new(
        asked.dimension(),
        asked.degree,
        asked.knots.clone(),
        asked.points.concat(),
        asked.weights.clone(),
    )
}

fn returned(made: &Curve) -> FloatCurve {
    FloatCurve {
        degree: made.degree(),
        knots: made.knots().to_vec(),
        points: made.points().chunks(made.dimension()).map(<[f64]>::to_vec).collect(),
        weights: made.weights().map(<[f64]>::to_vec),
    }
}

fn side(side: CaseSide) -> Side {
    match side {
        CaseSide::Left => Side::Before,
        CaseSide::Right => Side::After,
    }
}

fn answer(case: &Case) -> Result<Returned, FloatError> {
    let made = curve(&case.curve)?;
    let coordinates = |point: [f64; 3]| point[..made.dimension()].to_vec();
    let one = |made: Curve| Returned::Curve(returned(&made));
    Ok(match &case.operation {
        Operation::Point { parameter } => Returned::Point(coordinates(made.point(*parameter)?)),
        Operation::Derivative {
            parameter,
            order,
            side: at,
        } => Returned::Vector(coordinates(made.derivative(*parameter, side(*at), *order)?)),
        Operation::Curvature { parameter, side: at } => Returned::Value(made.curvature(*parameter, side(*at))?),
        Operation::Torsion { parameter, side: at } => Returned::Value(made.torsion(*parameter, side(*at))?),
        Operation::InsertKnot { parameter, times } => one(made.insert_knot(*parameter, *times)?),
        Operation::RemoveKnot { parameter, times } => {
            let scale = case
                .curve
                .points
                .iter()
                .flatten()
                .fold(0.0_f64, |most, x| most.max(x.abs()));
            one(made.remove_knot(*parameter, *times, REMOVAL * scale)?)
        }
        Operation::ElevateDegree { times } => one(made.elevate_degree(*times)?),
        Operation::Split { parameter } => {
            let (a, b) = made.split(*parameter)?;
            Returned::Curves(vec![returned(&a), returned(&b)])
        }
        Operation::Decompose => Returned::Curves(made.decompose()?.iter().map(returned).collect()),
        Operation::NearestPoint { target } => {
            let mut point = [0.0; 3];
            for (slot, x) in point.iter_mut().zip(target) {
                *slot = *x;
            }
            let found = made.nearest_point(point)?;
            Returned::Distance {
                distance: Some(found.distance),
                parameters: vec![found.parameter],
            }
        }
        Operation::CurveDistance { other } => {
            let found = made.distance_to(&curve(other)?)?;
            Returned::Distance {
                distance: Some(found.distance),
                parameters: vec![found.parameter, found.other_parameter],
            }
        }
        Operation::Msd => {
            let found = made.minimum_separation()?;
            Returned::Distance {
                distance: found.map(|found| found.distance),
                parameters: found.map_or(Vec::new(), |found| vec![found.parameters.0, found.parameters.1]),
            }
        }
        Operation::ConvexDomain {
            point,
            half_width,
            level,
            positive,
        } => Returned::Vertices(if made.dimension() == 2 {
            let polygon = made.convex_domain(*point, *half_width, *level, *positive)?;
            polygon.iter().map(|vertex| vertex.to_vec()).collect()
        } else {
            let solid = made.convex_domain_in_space(*point, *half_width, *level, *positive)?;
            solid.vertices.iter().map(|vertex| vertex.to_vec()).collect()
        }),
    })
}
