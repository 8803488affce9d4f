//! Hull points of a node in one width, and the gap between two hulls along a vector.
//!
//! Every obligation about two hulls comes down to n·p − n·q for p∈H(A), q∈H(B). Hull points are integers over a positive weight. A box and
//! a polynomial part have one weight for all their points, so that the least n·p and the greatest n·q decide; otherwise all pairs are
//! compared. Where both have one weight, the common factor of the two is kept apart.

use std::borrow::Cow;

use super::chain::{ScaleRef, convert_one};
use super::cover::Context;
use super::element::{Node, point_location};
use super::part::{Block, Geometry};
use super::word::{Word, dot};

/// Where the hull points are.
enum Shape<'s, W: Clone> {
    /// The corners of a box.
    Box([[W; 3]; 2]),
    /// Points with one weight for all.
    Shared(Cow<'s, [[W; 3]]>),
    /// Points with a weight each.
    Each(Cow<'s, [[W; 3]]>, Vec<W>),
}

/// The hull points of a node.
pub struct Hull<'s, W: Clone> {
    shape: Shape<'s, W>,
    /// The weight of all points; not used when each has its own.
    scale: ScaleRef<'s>,
}

impl<'s, W: Word> Hull<'s, W> {
    /// The hull of a node; `None` if it does not fit this width.
    pub fn new(context: &'s Context, node: &'s Node) -> Option<Self> {
        match node {
            Node::Run { number, .. } => Some(Hull {
                shape: Shape::Box(context.boxes.get(*number)?),
                scale: context.grid_scale(),
            }),
            Node::Point(element) => {
                let (piece, end) = point_location(context.chain, *element);
                let (point, weight) = context.chain.end_point(piece, end);
                Some(Hull {
                    shape: Shape::Each(
                        vec![super::word::vector(&point)?].into(),
                        vec![W::from_integer(&weight)?],
                    ),
                    scale: context.grid_scale(),
                })
            }
            Node::Part(part) => {
                let shape = match &part.geometry {
                    Geometry::Narrow(block) => Shape::of_block(block, W::of_narrow(block.points())?),
                    Geometry::Wide(block) => Shape::of_block(block, W::of_wide(block.points())?),
                    Geometry::Large(block) => Shape::of_block(block, W::of_large(block.points())?),
                }?;
                Some(Hull {
                    shape,
                    scale: part.point_scale(context.chain),
                })
            }
        }
    }

    /// Points of a section of a piece: integers over `scale`, or over a weight each when there are weights.
    pub fn of_points(points: Cow<'s, [[W; 3]]>, weights: Vec<W>, scale: ScaleRef<'s>) -> Self {
        let shape = if weights.is_empty() {
            Shape::Shared(points)
        } else {
            Shape::Each(points, weights)
        };
        Hull { shape, scale }
    }

    /// The least (`greatest` false) or greatest n·p with its weight, or all of them where weights differ.
    fn extremes(&self, n: &[W; 3], greatest: bool, shared: &W) -> Option<Extremes<W>> {
        match &self.shape {
            Shape::Box([low, high]) => {
                let zero = W::zero();
                let mut corner = low.clone();
                for axis in 0..3 {
                    if (n[axis] > zero) == greatest {
                        corner[axis] = high[axis].clone();
                    }
                }
                Some(Extremes::One(dot(n, &corner)?, shared.clone()))
            }
            Shape::Shared(points) => {
                let mut best = dot(n, &points[0])?;
                for point in &points[1..] {
                    let value = dot(n, point)?;
                    if (value > best) == greatest {
                        best = value;
                    }
                }
                Some(Extremes::One(best, shared.clone()))
            }
            Shape::Each(points, weights) => {
                let values = points
                    .iter()
                    .zip(weights)
                    .map(|(point, weight)| Some((dot(n, point)?, weight.clone())));
                Some(Extremes::Many(values.collect::<Option<_>>()?))
            }
        }
    }

    /// All hull points as integers and weights; a box is not asked for its corners.
    pub fn points(&self) -> impl Iterator<Item = (&[W; 3], Option<&W>)> {
        let (points, weights): (&[[W; 3]], &[W]) = match &self.shape {
            Shape::Box(_) => (&[], &[]),
            Shape::Shared(points) => (points, &[]),
            Shape::Each(points, weights) => (points, weights),
        };
        points.iter().enumerate().map(move |(k, point)| (point, weights.get(k)))
    }

    /// The weight that all points share, unless each has its own.
    pub fn shared_scale(&self) -> Option<ScaleRef<'s>> {
        match self.shape {
            Shape::Each(..) => None,
            _ => Some(self.scale),
        }
    }
}

impl<'s, W: Word> Shape<'s, W> {
    fn of_block<S: Word>(block: &Block<'_, S>, points: Cow<'s, [[W; 3]]>) -> Option<Self> {
        Some(if block.weights().is_empty() {
            Shape::Shared(points)
        } else {
            Shape::Each(points, block.weights().iter().map(convert_one).collect::<Option<_>>()?)
        })
    }
}

enum Extremes<W> {
    One(W, W),
    Many(Vec<(W, W)>),
}

impl<W> Extremes<W> {
    fn as_slice(&self) -> Candidates<'_, W> {
        match self {
            Extremes::One(value, weight) => Candidates {
                one: Some((value, weight)),
                many: &[],
            },
            Extremes::Many(values) => Candidates {
                one: None,
                many: values,
            },
        }
    }
}

#[derive(Clone)]
struct Candidates<'e, W> {
    one: Option<(&'e W, &'e W)>,
    many: &'e [(W, W)],
}

impl<'e, W> Iterator for Candidates<'e, W> {
    type Item = (&'e W, &'e W);
    fn next(&mut self) -> Option<Self::Item> {
        if let Some(one) = self.one.take() {
            return Some(one);
        }
        let (first, rest) = self.many.split_first()?;
        self.many = rest;
        Some((&first.0, &first.1))
    }
}

/// Two hulls, with their weights brought together.
pub struct Gap<'h, W: Clone> {
    a: &'h Hull<'h, W>,
    b: &'h Hull<'h, W>,
    weight_a: W,
    weight_b: W,
    /// The factor taken out of the weights on both sides.
    pub common: ScaleRef<'h>,
}

/// The factors s, t and the common scale c with a = c·s and b = c·t.
pub fn bring_together<'s, W: Word>(a: ScaleRef<'s>, b: ScaleRef<'s>) -> Option<(W, W, ScaleRef<'s>)> {
    let exponent = a.exponent.min(b.exponent);
    let one = W::from_i128(1)?;
    if a.odd == b.odd {
        let common = ScaleRef { odd: a.odd, exponent };
        return Some((
            one.doubled(a.exponent - exponent)?,
            one.doubled(b.exponent - exponent)?,
            common,
        ));
    }
    let factor = |scale: ScaleRef| W::from_integer(scale.odd)?.doubled(scale.exponent - exponent);
    Some((factor(a)?, factor(b)?, ScaleRef::power_of_two(exponent)))
}

impl<'h, W: Word> Gap<'h, W> {
    /// Prepares two hulls.
    pub fn new(a: &'h Hull<'h, W>, b: &'h Hull<'h, W>) -> Option<Self> {
        let value = |scale: Option<ScaleRef>| scale.map_or(W::from_i128(1), |scale| W::from_integer(&scale.value()));
        let (weight_a, weight_b, common) = match (a.shared_scale(), b.shared_scale()) {
            (Some(scale_a), Some(scale_b)) => bring_together(scale_a, scale_b)?,
            (scale_a, scale_b) => (value(scale_a)?, value(scale_b)?, ScaleRef::power_of_two(0)),
        };
        Some(Gap {
            a,
            b,
            weight_a,
            weight_b,
            common,
        })
    }

    /// Calls `test` with integers G, w, v such that n·p − n·q = G/(w·v·common), for pairs (p, q) among which are the
    /// least of these differences; stops at the first `false`.
    pub fn all(&self, n: &[W; 3], mut test: impl FnMut(W, &W, &W) -> Option<bool>) -> Option<bool> {
        let lows = self.a.extremes(n, false, &self.weight_a)?;
        let highs = self.b.extremes(n, true, &self.weight_b)?;
        for (low, weight_a) in lows.as_slice() {
            for (high, weight_b) in highs.as_slice() {
                let gap = low.times(weight_b)?.minus(&high.times(weight_a)?)?;
                if !test(gap, weight_a, weight_b)? {
                    return Some(false);
                }
            }
        }
        Some(true)
    }

    /// Is n·p > n·q for all p∈H(A), q∈H(B)?
    pub fn positive(&self, n: &[W; 3]) -> Option<bool> {
        let zero = W::zero();
        self.all(n, |gap, _, _| Some(gap > zero))
    }
}

impl<W: Word> Gap<'_, W> {
    /// Calls `test` with integer vectors x and integers u > 0 such that p − q = x/(u·common), for all hull points p, q; stops at the
    /// first `false`. Boxes have no list of points: for them the answer is `false`.
    pub fn all_differences(&self, mut test: impl FnMut(&[W; 3], &W) -> Option<bool>) -> Option<bool> {
        if matches!(self.a.shape, Shape::Box(_)) || matches!(self.b.shape, Shape::Box(_)) {
            return Some(false);
        }
        for (p, weight_p) in self.a.points() {
            for (q, weight_q) in self.b.points() {
                let (w, v) = (weight_p.unwrap_or(&self.weight_a), weight_q.unwrap_or(&self.weight_b));
                let axis = |i: usize| p[i].times(v)?.minus(&q[i].times(w)?);
                if !test(&[axis(0)?, axis(1)?, axis(2)?], &w.times(v)?)? {
                    return Some(false);
                }
            }
        }
        Some(true)
    }
}
