//! The curves of the benchmark in the form of each engine.

use std::collections::BTreeMap;

use curvo::prelude::{NurbsCurve2D, NurbsCurve3D};
use knotproof::float::Curve;
use kurbo::CubicBez;
use nalgebra::{Point3 as HomogeneousPoint2, Point4 as HomogeneousPoint3};
use serde::Deserialize;
use truck_geometry::prelude::{BSplineCurve, KnotVec, NurbsCurve, Point2, Point3, Vector3};

/// A curve of `curves.json`.
#[derive(Deserialize)]
pub struct Input {
    pub degree: usize,
    pub knots: Vec<f64>,
    pub points: Vec<Vec<f64>>,
    pub weights: Option<Vec<f64>>,
}

/// The curves, by name.
pub fn inputs() -> BTreeMap<String, Input> {
    serde_json::from_str(include_str!("curves.json")).expect("curves.json")
}

impl Input {
    /// `count` parameters of the domain in an order without pattern: multiples of the golden ratio modulo 1.
    pub fn parameters(&self, count: usize) -> Vec<f64> {
        let (start, end) = (self.knots[self.degree], self.knots[self.points.len()]);
        let share = |i: usize| (i as f64 * 0.618_033_988_749_894_9).fract();
        (0..count).map(|i| start + (end - start) * share(i)).collect()
    }

    /// Whether it has a certain number of coordinates.
    pub fn is_planar(&self) -> bool {
        self.points[0].len() == 2
    }

    /// For this library.
    pub fn knotproof(&self) -> Curve {
        let points = self.points.concat();
        Curve::new(self.points[0].len(), self.degree, self.knots.clone(), points, self.weights.clone()).expect("a curve")
    }

    /// For kurbo.
    pub fn kurbo(&self) -> CubicBez {
        let p = |i: usize| (self.points[i][0], self.points[i][1]);
        CubicBez::new(p(0), p(1), p(2), p(3))
    }

    fn homogeneous(&self) -> impl Iterator<Item = Vec<f64>> {
        self.points.iter().enumerate().map(|(i, point)| {
            let w = self.weights.as_ref().map_or(1.0, |weights| weights[i]);
            point.iter().map(|x| w * x).chain([w]).collect()
        })
    }

    /// For curvo, in the plane.
    pub fn curvo_2(&self) -> NurbsCurve2D<f64> {
        let control = self.homogeneous().map(|p| HomogeneousPoint2::from_slice(&p)).collect();
        NurbsCurve2D::try_new(self.degree, control, self.knots.clone()).expect("a curve")
    }

    /// For curvo, in space.
    pub fn curvo_3(&self) -> NurbsCurve3D<f64> {
        let control = self.homogeneous().map(|p| HomogeneousPoint3::from_slice(&p)).collect();
        NurbsCurve3D::try_new(self.degree, control, self.knots.clone()).expect("a curve")
    }

    fn truck_knots(&self) -> KnotVec {
        KnotVec::try_from(self.knots.clone()).expect("knots")
    }

    /// For truck, polynomial in the plane.
    pub fn truck_2(&self) -> BSplineCurve<Point2> {
        BSplineCurve::new(self.truck_knots(), self.points.iter().map(|p| Point2::new(p[0], p[1])).collect())
    }

    /// For truck, polynomial in space.
    pub fn truck_3(&self) -> BSplineCurve<Point3> {
        BSplineCurve::new(self.truck_knots(), self.points.iter().map(|p| Point3::new(p[0], p[1], p[2])).collect())
    }

    /// For truck, rational in the plane.
    pub fn truck_nurbs(&self) -> NurbsCurve<Vector3> {
        let control = self.homogeneous().map(|p| Vector3::new(p[0], p[1], p[2])).collect();
        NurbsCurve::new(BSplineCurve::new(self.truck_knots(), control))
    }
}
