//! curvo.

use curvo::prelude::*;
use knotproof_engines::{Answer, Case, Curve, Trouble, number, numbers, refused, run};
use nalgebra::{Point2, Point3, Point4};
use serde_json::json;

/// The same for curves in the plane and in space.
macro_rules! adapter {
    ($module:ident, $curve:ty, $homogeneous:ty, $point:ty) => {
        mod $module {
            use super::*;

            fn curve(asked: &Curve) -> Result<$curve, Trouble> {
                let control = asked.homogeneous().iter().map(|p| <$homogeneous>::from_slice(p)).collect();
                <$curve>::try_new(asked.degree, control, asked.knots()).map_err(refused)
            }

            fn returned(made: &$curve) -> Curve {
                let control = made.control_points().iter().map(|p| p.coords.iter().copied().collect()).collect();
                Curve::from_homogeneous(made.degree(), made.knots().to_vec(), control)
            }

            pub fn answer(case: &Case) -> Answer {
                let (mut made, t) = (curve(&case.curve)?, case.parameter);
                Ok(match case.operation.as_str() {
                    "point" => json!({ "point": numbers(made.point_at(t).iter().copied()) }),
                    "derivative" => {
                        let all = made.rational_derivatives(t, case.order);
                        json!({ "vector": numbers(all[case.order].iter().copied()) })
                    }
                    "curvature" => {
                        json!({ "value": number(made.curvature_at(t).map_err(refused)?.kappa()) })
                    }
                    "insert_knot" => {
                        for _ in 0..case.times {
                            made.try_add_knot(t).map_err(refused)?;
                        }
                        json!({ "curve": returned(&made) })
                    }
                    "remove_knot" => {
                        for _ in 0..case.times {
                            if made.try_remove_knot(t, None).map_err(refused)? == 0 {
                                return Err(refused("try_remove_knot removed no knot"));
                            }
                        }
                        json!({ "curve": returned(&made) })
                    }
                    "elevate_degree" => {
                        let target = case.curve.degree + case.times;
                        json!({ "curve": returned(&made.try_elevate_degree(target).map_err(refused)?) })
                    }
                    "split" => {
                        let (a, b) = made.try_split(t).map_err(refused)?;
                        json!({ "curves": [returned(&a), returned(&b)] })
                    }
                    "decompose" => {
                        let pieces = made.try_decompose().map_err(refused)?;
                        json!({ "curves": pieces.iter().map(returned).collect::<Vec<_>>() })
                    }
                    "nearest_point" => {
                        let target = <$point>::from_slice(&case.target);
                        let found = made.find_closest_point(&target).map_err(refused)?;
                        json!({ "distance": number((found - target).norm()) })
                    }
                    _ => return Err(Trouble::NotOffered),
                })
            }
        }
    };
}

adapter!(plane, NurbsCurve2D<f64>, Point3<f64>, Point2<f64>);
adapter!(space, NurbsCurve3D<f64>, Point4<f64>, Point3<f64>);

fn engine(case: &Case) -> Answer {
    match case.curve.dimension() {
        2 => plane::answer(case),
        _ => space::answer(case),
    }
}

fn main() {
    run("curvo 0.3.3", engine);
}
