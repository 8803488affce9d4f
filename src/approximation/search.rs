//! The nearest pair of parts that answers a question, best first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::ops::Range;

use super::polygon::Polygon;
use super::segment::Point;
use crate::number::{Integer, Rational};

/// An axis-parallel box.
#[derive(Clone, Debug)]
pub(super) struct Bounding {
    pub low: Point,
    pub high: Point,
}

impl Bounding {
    fn of<'p>(mut points: impl Iterator<Item = &'p Point>) -> Bounding {
        let first = points.next().expect("a point");
        let mut bounding = Bounding {
            low: first.clone(),
            high: first.clone(),
        };
        for point in points {
            for i in 0..3 {
                if point[i] < bounding.low[i] {
                    bounding.low[i] = point[i].clone();
                } else if point[i] > bounding.high[i] {
                    bounding.high[i] = point[i].clone();
                }
            }
        }
        bounding
    }

    /// The squared distance of two boxes.
    fn squared_distance(&self, other: &Bounding) -> Integer {
        (0..3).fold(Integer::ZERO, |sum, i| {
            let gap = (&self.low[i] - &other.high[i]).max(&other.low[i] - &self.high[i]);
            if gap.is_positive() { sum + &gap * &gap } else { sum }
        })
    }

    /// All differences of a point of one box and a point of the other are in this one.
    pub(super) fn minus(&self, other: &Bounding) -> Bounding {
        Bounding {
            low: std::array::from_fn(|i| &self.low[i] - &other.high[i]),
            high: std::array::from_fn(|i| &self.high[i] - &other.low[i]),
        }
    }

    /// All sums of a point of one box and a point of the other are in this one.
    pub(super) fn plus(&self, other: &Bounding) -> Bounding {
        Bounding {
            low: std::array::from_fn(|i| &self.low[i] + &other.low[i]),
            high: std::array::from_fn(|i| &self.high[i] + &other.high[i]),
        }
    }

    /// The square of the greatest length of a vector in the box.
    pub(super) fn greatest_squared(&self) -> Integer {
        (0..3).fold(Integer::ZERO, |sum, i| {
            let x = self.low[i].abs().max(self.high[i].abs());
            sum + &x * &x
        })
    }

    /// A lower bound of |v·w| for all v and w in two boxes.
    pub(super) fn least_product(&self, other: &Bounding) -> Integer {
        let (mut low, mut high) = (Integer::ZERO, Integer::ZERO);
        for i in 0..3 {
            let products = [
                &self.low[i] * &other.low[i],
                &self.low[i] * &other.high[i],
                &self.high[i] * &other.low[i],
                &self.high[i] * &other.high[i],
            ];
            low += products.iter().min().expect("four products");
            high += products.iter().max().expect("four products");
        }
        low.max(-high).max(Integer::ZERO)
    }
}

/// A run of parts.
pub(super) struct Node {
    pub parts: Range<usize>,
    /// All control points are in it.
    pub points: Bounding,
    /// All values of the derivative are in it, and of the discrete derivative.
    pub derivative: Bounding,
    children: Option<[usize; 2]>,
}

/// Runs of parts, halved down to single parts; the first is the whole.
pub(super) struct Tree {
    nodes: Vec<Node>,
}

impl Tree {
    pub(super) fn new(polygon: &Polygon) -> Tree {
        let mut tree = Tree { nodes: Vec::new() };
        tree.add(polygon, 0..polygon.parts.len());
        tree
    }

    fn add(&mut self, polygon: &Polygon, range: Range<usize>) -> usize {
        let parts = &polygon.parts[range.clone()];
        let index = self.nodes.len();
        self.nodes.push(Node {
            parts: range.clone(),
            points: Bounding::of(parts.iter().flat_map(|part| &part.points)),
            derivative: Bounding::of(parts.iter().flat_map(|part| &part.derivative)),
            children: None,
        });
        if parts.len() > 1 {
            let middle = range.start + parts.len() / 2;
            let children = [
                self.add(polygon, range.start..middle),
                self.add(polygon, middle..range.end),
            ];
            self.nodes[index].children = Some(children);
        }
        index
    }

    /// The answer of least key, ties by the order in which they were found. `discard` tells pairs of runs without an answer; `answers` adds those of a
    /// pair of parts i ≤ j with their keys, squared distances of their points in units of the integers.
    pub(super) fn least<T>(
        &self,
        discard: impl Fn(&Node, &Node) -> bool,
        mut answers: impl FnMut(usize, usize, &mut Vec<(Rational, T)>),
    ) -> Option<(Rational, T)> {
        let mut queue = BinaryHeap::new();
        let mut best: Option<(Rational, T)> = None;
        let mut found = Vec::new();
        let mut order = 0_u64;
        queue.push(Waiting {
            key: Integer::ZERO,
            order,
            pair: (0, 0),
        });
        while let Some(Waiting { key, pair, .. }) = queue.pop() {
            if best
                .as_ref()
                .is_some_and(|(least, _)| *least <= Rational::from_integer(key.clone()))
            {
                break;
            }
            let (a, b) = (&self.nodes[pair.0], &self.nodes[pair.1]);
            if discard(a, b) {
                continue;
            }
            let pairs = match (a.children, b.children) {
                (None, None) => {
                    answers(a.parts.start, b.parts.start, &mut found);
                    for (key, answer) in found.drain(..) {
                        if best.as_ref().is_none_or(|(least, _)| key < *least) {
                            best = Some((key, answer));
                        }
                    }
                    continue;
                }
                (Some([l, r]), _) if pair.0 == pair.1 => vec![(l, l), (l, r), (r, r)],
                (Some([l, r]), None) => vec![(l, pair.1), (r, pair.1)],
                (Some([l, r]), _) if a.parts.len() >= b.parts.len() => vec![(l, pair.1), (r, pair.1)],
                (_, Some([l, r])) => vec![(pair.0, l), (pair.0, r)],
            };
            for pair in pairs {
                order += 1;
                let (a, b) = (&self.nodes[pair.0], &self.nodes[pair.1]);
                let key = a.points.squared_distance(&b.points);
                queue.push(Waiting { key, order, pair });
            }
        }
        best
    }
}

/// A pair of runs with a lower bound of its keys.
#[derive(PartialEq, Eq)]
struct Waiting {
    key: Integer,
    order: u64,
    pair: (usize, usize),
}

impl Ord for Waiting {
    /// The least key is the greatest, as a heap has it; then the one that came last, which is the deeper.
    fn cmp(&self, other: &Self) -> Ordering {
        (&other.key, self.order).cmp(&(&self.key, other.order))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
