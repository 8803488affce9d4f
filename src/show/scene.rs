//! What is drawn: items of a few kinds, in the curve's coordinates.

use super::segment::length;
use super::{Point, Segment};
use crate::curve::Curve;

/// What an item shows; decides its colours and line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// The pipe around the curve.
    Pipe,
    /// The outer one of two domains.
    Outer,
    /// The inner one of two domains.
    Inner,
    /// A frame of a motion that is not the first.
    Frame,
    /// The control polygon.
    ControlPolygon,
    /// Curvature as a comb.
    Comb,
    /// The curve.
    Curve,
    /// A polygon that is isotopic to the curve, or close to it.
    Polygon,
    /// A double normal, a shortest chord, a distance.
    Chord,
    /// Points where pieces meet.
    Joint,
    /// Points that the claim names.
    Mark,
}

impl Kind {
    /// All kinds, in the order in which they are drawn.
    pub const ALL: [Kind; 11] = [
        Kind::Pipe,
        Kind::Outer,
        Kind::Inner,
        Kind::Frame,
        Kind::ControlPolygon,
        Kind::Comb,
        Kind::Curve,
        Kind::Polygon,
        Kind::Chord,
        Kind::Joint,
        Kind::Mark,
    ];

    /// Its name in style sheets.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Pipe => "pipe",
            Kind::Outer => "outer",
            Kind::Inner => "inner",
            Kind::Frame => "frame",
            Kind::ControlPolygon => "control",
            Kind::Comb => "comb",
            Kind::Curve => "curve",
            Kind::Polygon => "polygon",
            Kind::Chord => "chord",
            Kind::Joint => "joint",
            Kind::Mark => "mark",
        }
    }
}

/// The form of an item.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A curve of Bézier pieces.
    Path(Vec<Segment>),
    /// All points within a distance of a curve.
    Tube(Vec<Segment>, f64),
    /// Segments between points.
    Lines(Vec<[Point; 2]>),
    /// A polygon, open or closed.
    Polyline(Vec<Point>, bool),
    /// The inside of a planar polygon.
    Area(Vec<Point>),
    /// Points.
    Dots(Vec<Point>),
}

/// One thing drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// What it shows.
    pub kind: Kind,
    /// Its form.
    pub shape: Shape,
    /// What it is, for the legend.
    pub label: String,
}

/// A leaf of a cover tree: two parameter ranges of the chain (piece i is [i, i+1]) and the rule that excludes what they exclude.
#[derive(Clone, Debug, PartialEq)]
pub struct LeafPair {
    /// The first range.
    pub a: [f64; 2],
    /// The second one; the same as the first for a node with itself.
    pub b: [f64; 2],
    /// The rule.
    pub rule: &'static str,
}

/// What is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Coordinates of a point, 2 or 3.
    pub dimension: usize,
    /// The curve's pieces.
    pub segments: Vec<Segment>,
    /// What is drawn, in any order.
    pub items: Vec<Item>,
    /// The leaves of the cover tree, if there is one.
    pub leaves: Vec<LeafPair>,
    /// Later frames of a motion, each as the curve's pieces, and their times.
    pub frames: Vec<(f64, Vec<Segment>)>,
}

impl Scene {
    /// The curve with its control polygon and its joints.
    pub fn of_curve(curve: &Curve) -> Scene {
        let chain = curve.chain();
        let segments: Vec<Segment> = chain.pieces().iter().map(Segment::new).collect();
        let mut scene = Scene {
            dimension: curve.dimension(),
            segments: segments.clone(),
            items: Vec::new(),
            leaves: Vec::new(),
            frames: Vec::new(),
        };
        let polygon = own_points(curve);
        let joints: Vec<Point> = segments
            .iter()
            .map(|segment| segment.points[0])
            .chain(segments.last().map(|segment| segment.points[segment.points.len() - 1]))
            .collect();
        let count = segments.len();
        let pieces = if count == 1 { "piece" } else { "pieces" };
        scene.push(Kind::Curve, Shape::Path(segments), format!("curve, {count} {pieces}"));
        let points = polygon.len();
        scene.push(
            Kind::ControlPolygon,
            Shape::Polyline(polygon, false),
            format!("control polygon, {points} points"),
        );
        scene.push(Kind::Joint, Shape::Dots(joints), "ends of the pieces".into());
        scene
    }

    /// Adds an item.
    pub fn push(&mut self, kind: Kind, shape: Shape, label: String) {
        self.items.push(Item { kind, shape, label });
    }

    /// The items in the order in which they are drawn.
    pub fn drawn(&self) -> Vec<&Item> {
        let mut items: Vec<&Item> = self.items.iter().collect();
        items.sort_by_key(|item| item.kind);
        items
    }

    /// Points whose box contains everything drawn (a tube's radius apart).
    pub fn extent(&self) -> Vec<Point> {
        let mut points = Vec::new();
        for item in &self.items {
            match &item.shape {
                Shape::Path(segments) | Shape::Tube(segments, _) => {
                    points.extend(segments.iter().flat_map(|segment| segment.samples(33)));
                }
                Shape::Lines(lines) => points.extend(lines.iter().flatten()),
                Shape::Polyline(more, _) | Shape::Area(more) | Shape::Dots(more) => points.extend(more),
            }
        }
        points
    }

    /// The length of the diagonal of the curve's box.
    pub fn size(&self) -> f64 {
        let points: Vec<Point> = self.segments.iter().flat_map(|segment| segment.samples(9)).collect();
        let side = |axis: usize| {
            let values = points.iter().map(|point| point[axis]);
            let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            });
            high - low
        };
        length(&[side(0), side(1), side(2)])
    }

    /// The radius of the widest tube drawn, 0 without one.
    pub fn tube_radius(&self) -> f64 {
        let radii = self.items.iter().map(|item| match item.shape {
            Shape::Tube(_, radius) => radius,
            _ => 0.0,
        });
        radii.fold(0.0, f64::max)
    }

    /// The piece and local parameter of a parameter of the chain, from 0 to the number of pieces; more on a closed curve is in the next round.
    pub fn locate(&self, parameter: f64) -> (usize, f64) {
        let last = self.segments.len() - 1;
        let count = self.segments.len() as f64;
        let parameter = if parameter > count {
            parameter - count
        } else {
            parameter
        };
        let piece = (parameter.floor().max(0.0) as usize).min(last);
        (piece, (parameter - piece as f64).clamp(0.0, 1.0))
    }

    /// The point at a parameter of the chain.
    pub fn point_at(&self, parameter: f64) -> Point {
        let (piece, u) = self.locate(parameter);
        self.segments[piece].point(u)
    }
}

/// The control points that a user moves: a B-spline's own, or those of the pieces, a joint's once.
pub(super) fn own_points(curve: &Curve) -> Vec<Point> {
    use crate::curve::Form;
    let triples = |flat: Vec<f64>| -> Vec<Point> {
        flat.chunks(curve.dimension())
            .map(|point| std::array::from_fn(|axis| point.get(axis).copied().unwrap_or(0.0)))
            .collect()
    };
    match curve.form() {
        Form::BSpline(spline) => triples(spline.points().to_f64s()),
        Form::Bezier(pieces) => {
            let mut points = Vec::new();
            for (i, piece) in pieces.iter().enumerate() {
                points.extend(triples(piece.points().to_f64s()).into_iter().skip(usize::from(i > 0)));
            }
            points
        }
    }
}
