//! What a certificate's claim adds to the picture of its curve.

use std::collections::BTreeSet;

use super::segment::length;
use super::{Kind, LeafPair, Point, Scene, Segment, Shape};
use crate::certificate::Document;
use crate::check::chain::Chain;
use crate::check::cover::{Context, replay};
use crate::check::element::{Node, Parameter};
use crate::claim::motion::EventSource;
use crate::claim::msd::{Convention, Lower, Upper};
use crate::claim::tree::{Leaf, TokenSource};
use crate::claim::{Claim, curvature, deviation, domain, embedding, msd, thickness};
use crate::curve::Curve;
use crate::number::{Integer, Rational, RationalExt};

/// Leaves that a report lists; larger trees are drawn without them.
const MOST_LEAVES: usize = 50_000;
/// Samples of a curvature comb, all pieces together, and per piece.
const COMB: [usize; 2] = [3_000, 24];

impl Scene {
    /// The curve of a certificate, with what its claim is about. `tokens` are those of its tree, or the events, if it has any.
    ///
    /// The certificate is taken at its word: check it first.
    pub fn of_certificate<S: EventSource>(document: &Document, tokens: &mut S) -> Scene {
        let mut scene = Scene::of_curve(&document.curve);
        match &document.claim {
            Claim::Msd(content) => {
                scene.leaves = leaves(
                    &document.curve,
                    content.statement.convention,
                    content.evidence.grid,
                    tokens,
                )
                .0;
                scene.double_normal(content);
            }
            Claim::Embedding(content) => scene.isotopic_polygon(&document.curve, content, tokens),
            Claim::Curvature(content) => scene.curvature(content),
            Claim::Thickness(content) => scene.pipe(&document.curve, content, tokens),
            Claim::Deviation(content) => scene.deviation(content),
            Claim::Domain(content) => scene.domain(content),
            Claim::Motion(content) => scene.motion(&document.curve, content, tokens),
            Claim::Values(content) => scene.values(&document.curve, content),
        }
        scene
    }

    fn double_normal(&mut self, content: &msd::Content) {
        let Some(upper) = &content.evidence.upper else { return };
        let (s, t) = ends(upper);
        let chord = [self.point_at(s), self.point_at(t)];
        let squared = content
            .statement
            .upper_squared
            .as_ref()
            .map_or(0.0, RationalExt::to_f64);
        if squared == 0.0 {
            let label = format!("the curve meets itself, at parameters {s:.6} and {t:.6}");
            self.push(Kind::Mark, Shape::Dots(vec![chord[0]]), label);
            return;
        }
        let label = format!("shortest double normal known, at parameters {s:.6} and {t:.6}");
        self.push(Kind::Chord, Shape::Lines(vec![chord]), label);
        self.push(Kind::Mark, Shape::Dots(chord.to_vec()), "its ends".into());
    }

    fn isotopic_polygon<S: TokenSource>(&mut self, curve: &Curve, content: &embedding::Content, tokens: &mut S) {
        let (leaves, ends) = leaves(curve, Convention::Smooth, content.evidence.grid, tokens);
        self.leaves = leaves;
        let mut parameters: Vec<f64> = ends.into_iter().map(|end| as_number(&end)).collect();
        parameters.sort_by(f64::total_cmp);
        let points: Vec<Point> = parameters.iter().map(|parameter| self.point_at(*parameter)).collect();
        let edges = content.statement.edges;
        let label = format!("isotopic polygon, {edges} edges");
        self.push(Kind::Polygon, Shape::Polyline(points.clone(), false), label);
        self.push(Kind::Mark, Shape::Dots(points), "its vertices, on the curve".into());
    }

    fn curvature(&mut self, content: &curvature::Content) {
        self.comb();
        let parameter = content.evidence.piece as f64 + content.evidence.u.to_f64();
        let point = self.point_at(parameter);
        let label = format!("greatest curvature known, at parameter {parameter:.6}");
        self.push(Kind::Mark, Shape::Dots(vec![point]), label);
    }

    /// Teeth against the side of the center of curvature, as long as the curvature says.
    fn comb(&mut self) {
        let each = (COMB[0] / self.segments.len()).clamp(2, COMB[1]);
        let mut teeth: Vec<(Point, Point)> = Vec::new();
        for segment in &self.segments {
            for i in 0..=each {
                let jet = segment.jet(i as f64 / each as f64);
                let vector = jet.curvature_vector();
                if vector.iter().all(|x| x.is_finite()) {
                    teeth.push((jet.point, vector));
                }
            }
        }
        let greatest = teeth.iter().map(|(_, vector)| length(vector)).fold(0.0, f64::max);
        if greatest == 0.0 {
            return;
        }
        let unit = 0.15 * self.size() / greatest;
        let lines: Vec<[Point; 2]> = teeth
            .into_iter()
            .map(|(point, vector)| [point, std::array::from_fn(|axis| point[axis] - unit * vector[axis])])
            .collect();
        let outline = lines.iter().map(|[_, end]| *end).collect();
        self.push(
            Kind::Comb,
            Shape::Lines(lines),
            format!("curvature; a tooth as long as 1 stands for {:.4}", 1.0 / unit),
        );
        self.push(Kind::Comb, Shape::Polyline(outline, false), "its outline".into());
    }

    fn pipe<S: TokenSource>(&mut self, curve: &Curve, content: &thickness::Content, tokens: &mut S) {
        if let Lower::Finite(lower) = &content.statement.lower_squared {
            let radius = lower.to_f64().sqrt();
            let segments = self.segments.clone();
            self.push(
                Kind::Pipe,
                Shape::Tube(segments, radius),
                format!("pipe of radius {radius:.6}"),
            );
        }
        match &content.evidence {
            thickness::Evidence::Corner { joint } => {
                let point = self.point_at(*joint as f64);
                self.push(Kind::Mark, Shape::Dots(vec![point]), format!("corner at joint {joint}"));
            }
            thickness::Evidence::Bounds { msd, curvature } => {
                if msd.has_tree {
                    self.leaves = leaves(curve, msd.statement.convention, msd.evidence.grid, tokens).0;
                }
                self.double_normal(msd);
                let parameter = curvature.evidence.piece as f64 + curvature.evidence.u.to_f64();
                let point = self.point_at(parameter);
                let label = format!("greatest curvature known, at parameter {parameter:.6}");
                self.push(Kind::Mark, Shape::Dots(vec![point]), label);
            }
        }
    }

    fn deviation(&mut self, content: &deviation::Content) {
        let parts = 1u64 << content.statement.subdivisions.min(16);
        let (evidence, mut polygon, mut chord) = (&content.evidence, Vec::new(), None);
        for (number, segment) in self.segments.iter().enumerate() {
            for part in 0..parts {
                let at = |j: u64| j as f64 / parts as f64;
                let piece = segment.part(at(part), at(part + 1));
                if (number, part) == (evidence.piece, evidence.part) {
                    let u = evidence.u.to_f64();
                    chord = Some([piece.point(u), on_polygon(&piece, u)]);
                }
                let skip = usize::from(!polygon.is_empty());
                polygon.extend(piece.points.into_iter().skip(skip));
            }
        }
        let label = format!("control polygon after {} subdivisions", content.statement.subdivisions);
        self.push(Kind::Polygon, Shape::Polyline(polygon, false), label);
        if let Some(chord) = chord {
            self.push(
                Kind::Chord,
                Shape::Lines(vec![chord]),
                "where curve and polygon are farthest apart, as far as known".into(),
            );
        }
    }

    fn domain(&mut self, content: &domain::Content) {
        let sign = content.statement.domain.sign.name();
        let mark = |scene: &mut Scene, point: &[Rational], label: &str| {
            let point = point_of(point.iter().map(RationalExt::to_f64));
            scene.push(Kind::Mark, Shape::Dots(vec![point]), label.into());
        };
        match &content.evidence {
            domain::Evidence::Sandwich {
                denominator,
                center,
                inner,
                outer,
                ..
            } => {
                let place = |point: &Vec<Integer>| {
                    let numbers = point.iter();
                    point_of(numbers.map(|x| Rational::new(x.clone(), denominator.clone()).to_f64()))
                };
                self.star(Kind::Outer, outer, &place, "no position outside keeps the sign");
                self.star(
                    Kind::Inner,
                    inner,
                    &place,
                    &format!("every position inside keeps the sign {sign}"),
                );
                self.push(
                    Kind::Mark,
                    Shape::Dots(vec![place(center)]),
                    "a position that keeps it".into(),
                );
            }
            domain::Evidence::Nearest { point, .. } => mark(self, point, "nearest position that keeps the sign"),
            domain::Evidence::Ball { center, .. } => {
                mark(self, center, "center of the greatest ball known");
                if let domain::Outcome::Ball { lower, .. } = &content.statement.outcome {
                    let center = point_of(center.iter().map(RationalExt::to_f64));
                    self.circle(center, lower.to_f64());
                }
            }
            domain::Evidence::Empty { .. } | domain::Evidence::Change { .. } => {}
        }
        if let domain::Outcome::Change { from, .. } = &content.statement.outcome {
            mark(self, from, "the position from which the sign is to change");
        }
    }

    fn circle(&mut self, center: Point, radius: f64) {
        if self.dimension != 2 {
            return;
        }
        let points = (0..120).map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / 120.0;
            [center[0] + radius * angle.cos(), center[1] + radius * angle.sin(), 0.0]
        });
        self.push(
            Kind::Inner,
            Shape::Area(points.collect()),
            format!("ball of radius {radius:.6}"),
        );
    }

    fn star(&mut self, kind: Kind, star: &domain::Star, place: &dyn Fn(&Vec<Integer>) -> Point, label: &str) {
        let points: Vec<Point> = star.points.iter().map(place).collect();
        if self.dimension == 2 {
            let area = around(&star.cells).into_iter().map(|i| points[i]).collect();
            self.push(kind, Shape::Area(area), label.into());
            return;
        }
        let mut edges = BTreeSet::new();
        for cell in &star.cells {
            for i in 0..cell.len() {
                let (a, b) = (cell[i], cell[(i + 1) % cell.len()]);
                edges.insert((a.min(b), a.max(b)));
            }
        }
        let lines = edges.into_iter().map(|(a, b)| [points[a], points[b]]).collect();
        self.push(kind, Shape::Lines(lines), label.into());
    }
}

/// The vertices of a planar star's boundary in their order.
fn around(cells: &[Vec<usize>]) -> Vec<usize> {
    let next: std::collections::HashMap<usize, usize> = cells.iter().map(|cell| (cell[0], cell[1])).collect();
    let Some(first) = cells.first() else { return Vec::new() };
    let mut order = vec![first[0]];
    let mut at = first[1];
    while at != first[0] && order.len() <= cells.len() {
        order.push(at);
        match next.get(&at) {
            Some(after) => at = *after,
            None => break,
        }
    }
    order
}

fn point_of(coordinates: impl Iterator<Item = f64>) -> Point {
    let mut point = [0.0; 3];
    for (axis, x) in coordinates.take(3).enumerate() {
        point[axis] = x;
    }
    point
}

/// The point of a part's control polygon at a parameter.
fn on_polygon(part: &Segment, u: f64) -> Point {
    let edges = part.points.len() - 1;
    let k = ((u * edges as f64) as usize).min(edges - 1);
    let v = u * edges as f64 - k as f64;
    let (from, to) = (part.points[k], part.points[k + 1]);
    std::array::from_fn(|axis| from[axis] + v * (to[axis] - from[axis]))
}

/// Parameters of the two ends of the chord that an upper bound is about.
fn ends(upper: &Upper) -> (f64, f64) {
    let middle = |interval: &msd::Interval| (interval.start.to_f64() + interval.end.to_f64()) / 2.0;
    match upper {
        Upper::Miranda { s, t, .. } | Upper::Crossing { s, t, .. } => (middle(s), middle(t)),
        Upper::Root { s, t } => (s.0.to_f64(), t.0.to_f64()),
        Upper::Touch { s, t } | Upper::CriticalRoot { s, t } => (s.to_f64(), t.to_f64()),
        Upper::CriticalInterval { s, t, .. } => (s.to_f64(), middle(t)),
    }
}

/// The leaves of a tree, none when there are too many to list, and the parameters where their nodes end.
fn leaves<S: TokenSource>(
    curve: &Curve,
    convention: Convention,
    grid: u32,
    tokens: &mut S,
) -> (Vec<LeafPair>, std::collections::HashSet<Parameter>) {
    let mut listed = Vec::new();
    let mut ends = std::collections::HashSet::new();
    let Ok(chain) = Chain::new(curve) else {
        return (listed, ends);
    };
    let context = Context::new(&chain, convention, grid);
    let range = |node: &Node| {
        [
            node.start(&chain, &context.elements),
            node.end(&chain, &context.elements),
        ]
    };
    let list = |a: &Node, b: Option<&Node>, leaf: &Leaf| {
        let (a, b) = (range(a), range(b.unwrap_or(a)));
        ends.extend(a.iter().chain(&b).copied());
        if listed.len() <= MOST_LEAVES {
            listed.push(LeafPair {
                a: a.map(|end| as_number(&end)),
                b: b.map(|end| as_number(&end)),
                rule: leaf.rule(),
            });
        }
        Ok(())
    };
    // A tree that does not replay was not checked; what was read of it is shown.
    let _ = replay(&context, list, tokens);
    if listed.len() > MOST_LEAVES {
        listed.clear();
    }
    (listed, ends)
}

fn as_number(parameter: &Parameter) -> f64 {
    parameter.piece as f64 + parameter.numerator as f64 * 0.5f64.powi(parameter.depth as i32)
}
