//! truck-geometry.

use knotproof_engines::{Answer, Case, Curve, Trouble, number, numbers, refused, run};
use serde_json::json;
use truck_geometry::prelude::*;

/// The same for curves in the plane and in space; polynomial ones have weights 1.
macro_rules! adapter {
    ($module:ident, $homogeneous:ty, $point:ty, [$($axis:literal)*]) => {
        mod $module {
            use super::*;

            type Nurbs = NurbsCurve<$homogeneous>;

            fn curve(asked: &Curve) -> std::result::Result<Nurbs, Trouble> {
                let control = asked.homogeneous().iter().map(|p| <$homogeneous>::new($(p[$axis]),*)).collect();
                let knots = KnotVec::try_from(asked.knots()).map_err(refused)?;
                Ok(Nurbs::new(BSplineCurve::try_new(knots, control).map_err(refused)?))
            }

            fn of_spline(made: &BSplineCurve<$homogeneous>) -> Curve {
                let control = made.control_points().iter().map(|p| vec![$(p[$axis]),*]).collect();
                Curve::from_homogeneous(made.degree(), made.knot_vec().iter().copied().collect(), control)
            }

            fn returned(made: &Nurbs) -> Curve {
                of_spline(made.non_rationalized())
            }

            fn coordinates(p: impl std::ops::Index<usize, Output = f64>) -> Vec<serde_json::Value> {
                let all = [$($axis),*];
                numbers((0..all.len() - 1).map(|i| p[i]))
            }

            pub fn answer(case: &Case) -> Answer {
                let (mut made, t) = (curve(&case.curve)?, case.parameter);
                Ok(match (case.operation.as_str(), case.order) {
                    ("point", _) => json!({ "point": coordinates(made.subs(t)) }),
                    ("derivative", 1) => json!({ "vector": coordinates(made.der(t)) }),
                    ("derivative", 2) => json!({ "vector": coordinates(made.der2(t)) }),
                    ("insert_knot", _) => {
                        for _ in 0..case.times {
                            made.add_knot(t);
                        }
                        json!({ "curve": returned(&made) })
                    }
                    ("remove_knot", _) => {
                        for _ in 0..case.times {
                            let index = made.knot_vec().iter().rposition(|knot| *knot == t);
                            let index = index.ok_or_else(|| refused("the knot is not there"))?;
                            made.try_remove_knot(index).map_err(refused)?;
                        }
                        json!({ "curve": returned(&made) })
                    }
                    ("elevate_degree", _) => {
                        for _ in 0..case.times {
                            made.elevate_degree();
                        }
                        json!({ "curve": returned(&made) })
                    }
                    ("split", _) => {
                        let second = made.cut(t);
                        json!({ "curves": [returned(&made), returned(&second)] })
                    }
                    ("decompose", _) => {
                        let pieces = made.non_rationalized().bezier_decomposition();
                        json!({ "curves": pieces.iter().map(of_spline).collect::<Vec<_>>() })
                    }
                    ("nearest_point", _) => {
                        let mut target = <$point>::origin();
                        for (i, x) in case.target.iter().enumerate() {
                            target[i] = *x;
                        }
                        let found = made.search_nearest_parameter(target, None, 100);
                        let at = found.ok_or_else(|| refused("search_nearest_parameter returned None"))?;
                        json!({ "distance": number(made.subs(at).distance(target)), "parameter": number(at) })
                    }
                    _ => return Err(Trouble::NotOffered),
                })
            }
        }
    };
}

adapter!(plane, Vector3, Point2, [0 1 2]);
adapter!(space, Vector4, Point3, [0 1 2 3]);

fn engine(case: &Case) -> Answer {
    match case.curve.dimension() {
        2 => plane::answer(case),
        _ => space::answer(case),
    }
}

fn main() {
    run("truck-geometry 0.5.0", engine);
}
