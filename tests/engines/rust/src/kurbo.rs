//! kurbo: planar polynomial Bézier curves up to degree 3.

use knotproof_engines::{Answer, Case, Curve, Trouble, number, numbers, run};
use kurbo::{
    CubicBez, Line, ParamCurve, ParamCurveCurvature, ParamCurveDeriv, ParamCurveNearest, PathSeg, Point, QuadBez,
};
use serde_json::json;

const ACCURACY: f64 = 1e-9;
/// Of min_dist, which is slow for small ones.
const PAIR_ACCURACY: f64 = 1e-7;

fn segment(curve: &Curve) -> Result<PathSeg, Trouble> {
    if !curve.is_bezier() || curve.weights.is_some() || curve.dimension() != 2 {
        return Err(Trouble::NotOffered);
    }
    let points: Vec<Point> = curve.points().iter().map(|p| Point::new(p[0], p[1])).collect();
    match points[..] {
        [a, b] => Ok(Line::new(a, b).into()),
        [a, b, c] => Ok(QuadBez::new(a, b, c).into()),
        [a, b, c, d] => Ok(CubicBez::new(a, b, c, d).into()),
        _ => Err(Trouble::NotOffered),
    }
}

fn returned(segment: PathSeg, start: f64, end: f64) -> Curve {
    let points = match segment {
        PathSeg::Line(s) => vec![s.p0, s.p1],
        PathSeg::Quad(s) => vec![s.p0, s.p1, s.p2],
        PathSeg::Cubic(s) => vec![s.p0, s.p1, s.p2, s.p3],
    };
    let order = points.len();
    Curve {
        degree: order - 1,
        knots: numbers([vec![start; order], vec![end; order]].concat()),
        points: points.iter().map(|p| numbers([p.x, p.y])).collect(),
        weights: None,
    }
}

fn derivative(segment: PathSeg, t: f64, order: usize) -> Result<Point, Trouble> {
    Ok(match (segment, order) {
        (PathSeg::Line(s), 1) => s.deriv().eval(t),
        (PathSeg::Quad(s), 1) => s.deriv().eval(t),
        (PathSeg::Quad(s), 2) => s.deriv().deriv().eval(t),
        (PathSeg::Cubic(s), 1) => s.deriv().eval(t),
        (PathSeg::Cubic(s), 2) => s.deriv().deriv().eval(t),
        (PathSeg::Cubic(s), 3) => s.deriv().deriv().deriv().eval(t),
        _ => return Err(Trouble::NotOffered),
    })
}

fn engine(case: &Case) -> Answer {
    let (s, t) = (segment(&case.curve)?, case.parameter);
    Ok(match case.operation.as_str() {
        "point" => {
            let p = s.eval(t);
            json!({ "point": numbers([p.x, p.y]) })
        }
        "derivative" => {
            let p = derivative(s, t, case.order)?;
            json!({ "vector": numbers([p.x, p.y]) })
        }
        "curvature" => json!({ "value": number(match s {
            PathSeg::Line(s) => s.curvature(t),
            PathSeg::Quad(s) => s.curvature(t),
            PathSeg::Cubic(s) => s.curvature(t),
        }) }),
        "elevate_degree" => match (s, case.times) {
            (PathSeg::Quad(s), 1) => json!({ "curve": returned(s.raise().into(), 0.0, 1.0) }),
            _ => return Err(Trouble::NotOffered),
        },
        "split" => {
            json!({ "curves": [returned(s.subsegment(0.0..t), 0.0, t), returned(s.subsegment(t..1.0), t, 1.0)] })
        }
        "nearest_point" => {
            let nearest = s.nearest(Point::new(case.target[0], case.target[1]), ACCURACY);
            json!({ "distance": number(nearest.distance_sq.sqrt()), "parameter": number(nearest.t) })
        }
        "curve_distance" => {
            let other = segment(case.other.as_ref().ok_or(Trouble::NotOffered)?)?;
            let found = s.min_dist(other, PAIR_ACCURACY);
            json!({ "distance": number(found.distance), "parameters": numbers([found.t1, found.t2]) })
        }
        _ => return Err(Trouble::NotOffered),
    })
}

fn main() {
    run("kurbo 0.13.1", engine);
}
