//! What a certificate of the claim `values` adds to the picture of its curve.

use super::{Kind, Point, Scene, Shape};
use crate::claim::values::{Content, Operation, Outcome, Witness};
use crate::curve::Curve;
use crate::number::{Rational, RationalExt};

impl Scene {
    /// The points asked for, the targets and other curves, and nearest points known.
    pub(super) fn values(&mut self, curve: &Curve, content: &Content) {
        let entries = &content.statement.entries;
        let points: Vec<Point> = entries
            .iter()
            .filter_map(|entry| match &entry.outcome {
                Outcome::Point(point) => Some(rounded(point)),
                _ => None,
            })
            .collect();
        if !points.is_empty() {
            let label = format!("points asked for, {}", points.len());
            self.push(Kind::Mark, Shape::Dots(points), label);
        }
        let distances = entries.iter().filter_map(|entry| match &entry.outcome {
            Outcome::DistanceSquared { upper, .. } => Some((&entry.operation, upper.to_f64().sqrt())),
            _ => None,
        });
        for ((operation, length), witness) in distances.zip(&content.evidence.witnesses) {
            let chord = match (operation, witness) {
                (Operation::NearestPoint { target }, Witness::Nearest { parameter }) => {
                    self.at_knot(curve, parameter).map(|point| [point, rounded(target)])
                }
                (Operation::CurveDistance { other }, Witness::Distance { parameters, .. }) => {
                    let scene = Scene::of_curve(other);
                    let chord = self
                        .at_knot(curve, &parameters[0])
                        .zip(scene.at_knot(other, &parameters[1]));
                    self.push(Kind::Frame, Shape::Path(scene.segments), "the other curve".into());
                    chord.map(|(p, q)| [p, q])
                }
                _ => None,
            };
            if let Some(chord) = chord {
                let label = format!("shortest distance known, {length:.6}");
                self.push(Kind::Chord, Shape::Lines(vec![chord]), label);
                self.push(Kind::Mark, Shape::Dots(chord.to_vec()), "its ends".into());
            }
        }
    }

    /// The point at a knot value of the curve that is shown.
    fn at_knot(&self, curve: &Curve, knot: &Rational) -> Option<Point> {
        let parameter = curve.chain().parameter_at(knot)?;
        Some(self.point_at(parameter.to_f64()))
    }
}

fn rounded(position: &[Rational]) -> Point {
    let mut point = [0.0; 3];
    for (to, x) in point.iter_mut().zip(position) {
        *to = x.to_f64();
    }
    point
}
