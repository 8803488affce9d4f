//! What a polygon tells of the minimum separation distance: the readings of CPJ12's λ_c, and an interval of σ that is proved.

use std::collections::BTreeMap;

use super::difference::whole;
use super::polygon::{Polygon, casteljau, linear};
use super::search::{Bounding, Node, Tree};
use super::segment::{Point, closest, dot, from_point, subtract};
use crate::number::{Integer, Rational, sqrt_enclosure};

/// √ is enclosed this closely.
const ROOT_BITS: u32 = 96;
/// So many pairs of parts are looked at, at most, to show that there is a double normal.
const MOST_CELLS: usize = 20_000;

/// Two edges of a polygon with their nearest points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// The squared distance of the edges, exact.
    pub squared: Rational,
    /// The numbers of the edges, from 0 along the curve.
    pub edges: [usize; 2],
    /// The parameters of the nearest points on the polygon, number of the piece and local parameter added.
    pub at: [Rational; 2],
}

/// Which chord the candidate test of CPJ12 §4.1 is about; the text writes c(s₀) − c(t₀) for the parameters of the polygon's nearest points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chord {
    /// c(s₀) − c(t₀), points of the curve.
    Curve,
    /// L(s₀) − L(t₀), points of the polygon.
    Polygon,
}

/// An interval that contains the minimum separation distance σ of the convention `smooth`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Separation {
    /// λ²: the least squared distance of two parts' polygons that were not shown to be without a double normal; `None` when all were, so that σ is infinite.
    pub distance_squared: Option<Rational>,
    /// An upper bound of η ≥ |c − L|, rounded up.
    pub eta: Rational,
    /// λ − 2η or 0, rounded down: at most σ. `None` when σ is infinite.
    pub lower: Option<Rational>,
    /// λ + 2η, rounded up, when a double normal was shown to be as short: at least σ.
    pub upper: Option<Rational>,
}

impl Polygon {
    /// CPJ12 §4.2: the least distance of disjoint edges, which share no vertex. `None` when all edges have neighbours only.
    ///
    /// Two edges with one edge between them are disjoint, so this is at most the shortest edge and tends to 0 with subdivision.
    pub fn nearest_disjoint_edges(&self) -> Option<Pair> {
        let tree = Tree::new(self);
        let found = tree.least(
            |_, _| false,
            |i, j, found| self.disjoint_edges(i, j, |pair, _, _| found.push((pair.squared.clone(), pair))),
        );
        found.map(|(_, pair)| self.in_units(pair))
    }

    /// CPJ12 Figure 6: the least distance of disjoint edges whose nearest points pass the test |⟨c(s₀), c(t₀)⟩_d| ≤ ε_d both ways. `None` when no pair
    /// passes. The form is 0/0 for a chord of length 0, which is taken to pass.
    pub fn nearest_candidates(&self, epsilon_d: &Rational, chord: Chord) -> Option<Pair> {
        let tree = Tree::new(self);
        // Chords are in units of the denominator, derivatives also of 2^-m.
        let unit = Rational::new(self.denominator.clone(), Integer::ONE << self.subdivisions);
        let allowed = epsilon_d * unit;
        let allowed_squared = &allowed * &allowed;
        let found = tree.least(
            |a, b| no_candidates(&allowed_squared, a, b),
            |i, j, found| {
                self.disjoint_edges(i, j, |pair, u, v| {
                    if self.is_candidate(&allowed_squared, chord, (i, &u), (j, &v)) {
                        found.push((pair.squared.clone(), pair));
                    }
                });
            },
        );
        found.map(|(_, pair)| self.in_units(pair))
    }

    /// ν²: the square of the least distance of a vertex from an edge that it does not belong to. `None` when there is none.
    pub fn vertex_clearance_squared(&self) -> Option<Rational> {
        let last = self.edges - 1;
        let found = Tree::new(self).least(
            |_, _| false,
            |i, j, found| {
                let pairs: &[(usize, usize)] = if i == j { &[(i, j)] } else { &[(i, j), (j, i)] };
                for (i, j) in pairs {
                    let (part, other) = (&self.parts[*i], &self.parts[*j]);
                    for (k, vertex) in part.points.iter().enumerate() {
                        // Vertex v is the end of the edges v − 1 and v.
                        let v = part.first_edge + k;
                        for (l, edge) in other.points.windows(2).enumerate() {
                            let e = other.first_edge + l;
                            let closing = self.closed && (v == 0 && e == last || v == last + 1 && e == 0);
                            if v == e || v == e + 1 || closing {
                                continue;
                            }
                            let (squared, _) = from_point(vertex, &edge[0], &subtract(&edge[1], &edge[0]));
                            found.push((squared, ()));
                        }
                    }
                }
            },
        );
        found.map(|(squared, ())| squared / self.unit_squared())
    }

    /// The interval of σ that the polygon proves (docs/approximation.md, Theorems 6 and 7).
    pub fn separation(&self) -> Separation {
        let eta = sqrt_enclosure(&self.distance_bound_squared(), ROOT_BITS).1;
        let tree = Tree::new(self);
        let found = tree.least(
            |a, b| a.parts != b.parts && without_double_normal(a, b),
            |i, j, found| {
                // Parts that touch have a chord of length 0, which the boxes of chords contain.
                let touch = i == j || self.adjacent(i, j);
                if !touch {
                    found.push((self.squared_distance(i, j), (i, j)));
                } else if !self.acute(i, j) {
                    found.push((Rational::default(), (i, j)));
                }
            },
        );
        let Some((squared, cell)) = found else {
            return Separation {
                distance_squared: None,
                eta,
                lower: None,
                upper: None,
            };
        };
        let squared = squared / self.unit_squared();
        let (below, above) = sqrt_enclosure(&squared, ROOT_BITS);
        let two = whole(2);
        let reach = &above + &two * &two * &eta;
        let exists = self.has_double_normal(cell, &(&reach * &reach * self.unit_squared()));
        Separation {
            distance_squared: Some(squared),
            lower: Some((below - &two * &eta).max(Rational::default())),
            upper: exists.then(|| above + &two * &eta),
            eta,
        }
    }

    fn unit_squared(&self) -> Rational {
        Rational::from_integer(&self.denominator * &self.denominator)
    }

    /// The same pairs as the searches visit, in units.
    #[cfg(test)]
    pub(super) fn disjoint_edges_for_tests(&self, i: usize, j: usize, mut visit: impl FnMut(Pair)) {
        self.disjoint_edges(i, j, |pair, _, _| visit(self.in_units(pair)));
    }

    fn in_units(&self, mut pair: Pair) -> Pair {
        pair.squared /= self.unit_squared();
        pair
    }

    /// All pairs of disjoint edges of two parts i ≤ j, each once, with the local parameters of their nearest points.
    fn disjoint_edges(&self, i: usize, j: usize, mut visit: impl FnMut(Pair, Rational, Rational)) {
        let (first, second) = (&self.parts[i], &self.parts[j]);
        let last = self.edges - 1;
        for (k, p) in first.points.windows(2).enumerate() {
            let e = first.first_edge + k;
            for (l, q) in second.points.windows(2).enumerate() {
                let f = second.first_edge + l;
                if f <= e + 1 || self.closed && e == 0 && f == last {
                    continue;
                }
                let near = closest([&p[0], &p[1]], [&q[0], &q[1]]);
                let u = (whole(k) + near.s) / whole(first.degree());
                let v = (whole(l) + near.t) / whole(second.degree());
                let pair = Pair {
                    squared: near.squared,
                    edges: [e, f],
                    at: [self.global(i, &u), self.global(j, &v)],
                };
                visit(pair, u, v);
            }
        }
    }

    /// (x·D)² ≤ ε_d²·|x|² at both ends.
    fn is_candidate(
        &self,
        allowed_squared: &Rational,
        chord: Chord,
        first: (usize, &Rational),
        second: (usize, &Rational),
    ) -> bool {
        let point = |(part, u): (usize, &Rational)| match chord {
            Chord::Curve => casteljau(&self.parts[part].points, u),
            Chord::Polygon => linear(&self.parts[part].points, u).expect("a local parameter"),
        };
        let (p, q) = (point(first), point(second));
        let chord: [Rational; 3] = std::array::from_fn(|i| &p[i] - &q[i]);
        let product = |v: &[Rational; 3], w: &[Rational; 3]| &v[0] * &w[0] + &v[1] * &w[1] + &v[2] * &w[2];
        let allowed = allowed_squared * product(&chord, &chord);
        [first, second].into_iter().all(|(part, u)| {
            let derivative = linear(&self.parts[part].derivative, u).expect("a local parameter");
            let along = product(&chord, &derivative);
            &along * &along <= allowed
        })
    }

    /// The squared distance of the polygons of two parts.
    fn squared_distance(&self, i: usize, j: usize) -> Rational {
        let mut least: Option<Rational> = None;
        for p in self.parts[i].points.windows(2) {
            for q in self.parts[j].points.windows(2) {
                let squared = closest([&p[0], &p[1]], [&q[0], &q[1]]).squared;
                if least.as_ref().is_none_or(|least| squared < *least) {
                    least = Some(squared);
                }
            }
        }
        least.unwrap_or_default()
    }

    fn adjacent(&self, i: usize, j: usize) -> bool {
        let (i, j) = (i.min(j), i.max(j));
        j == i + 1 || self.closed && i == 0 && j == self.parts.len() - 1
    }

    /// All derivatives on two parts make acute angles with each other, and none is 0.
    fn acute(&self, i: usize, j: usize) -> bool {
        let both: Vec<&Point> = self.parts[i]
            .derivative
            .iter()
            .chain(&self.parts[j].derivative)
            .collect();
        both.iter()
            .enumerate()
            .all(|(k, v)| both[..=k].iter().all(|w| dot(v, w).is_positive()))
    }

    /// Whether the pairs of parts nearer than a bound that hang together with `cell` contain a local minimum of the distance inside.
    fn has_double_normal(&self, cell: (usize, usize), bound_squared: &Rational) -> bool {
        let count = self.parts.len();
        let mut seen: BTreeMap<(usize, usize), bool> = BTreeMap::new();
        let mut waiting = vec![cell];
        while let Some((i, j)) = waiting.pop() {
            let (i, j) = (i.min(j), i.max(j));
            if seen.contains_key(&(i, j)) {
                continue;
            }
            if seen.len() == MOST_CELLS {
                return false;
            }
            let near = i == j || self.adjacent(i, j) || self.squared_distance(i, j) <= *bound_squared;
            seen.insert((i, j), near);
            if !near {
                continue;
            }
            let at_end = |i: usize| !self.closed && (i == 0 || i == count - 1);
            let smooth = |i: usize| self.acute(i, i) && self.smooth[i] && self.smooth[(i + 1) % count];
            if i == j || self.adjacent(i, j) || at_end(i) || at_end(j) || !smooth(i) || !smooth(j) {
                return false;
            }
            for k in [count - 1, 0, 1] {
                for l in [count - 1, 0, 1] {
                    waiting.push(((i + k) % count, (j + l) % count));
                }
            }
        }
        true
    }
}

/// Some x·(αc'(s) + βc'(t)) has one sign for all chords x = c(s) − c(t) between two runs, so that not both x·c'(s) and x·c'(t) are 0.
fn without_double_normal(a: &Node, b: &Node) -> bool {
    let chords = a.points.minus(&b.points);
    let positive = |derivative: &Bounding| chords.least_product(derivative).is_positive();
    positive(&a.derivative)
        || positive(&b.derivative)
        || positive(&a.derivative.plus(&b.derivative))
        || positive(&a.derivative.minus(&b.derivative))
}

/// No pair of edges of two runs passes the candidate test, by boxes.
fn no_candidates(allowed_squared: &Rational, a: &Node, b: &Node) -> bool {
    let chords = a.points.minus(&b.points);
    let allowed = allowed_squared * Rational::from_integer(chords.greatest_squared());
    [&a.derivative, &b.derivative].into_iter().any(|derivative| {
        let least = chords.least_product(derivative);
        Rational::from_integer(&least * &least) > allowed
    })
}
