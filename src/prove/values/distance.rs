//! The distance between two curves.

use super::float_curve::{FloatCurve, Place, Vector, dot, squared, sub};
use super::{Bracket, Width, exact_parameter};
use crate::check::values::distance::{Node, Nodes, is_far};
use crate::check::values::nearest::squared_distance;
use crate::check::values::pieces::Pieces;
use crate::claim::tree::{Leaf, Token};
use crate::claim::values::Witness;
use crate::number::{Integer, Rational, RationalExt};
use crate::prove::deviation::{rounded_down, rounded_up};

/// Samples of each curve.
const SAMPLES: usize = 600;
/// Pairs of samples that are followed to a minimum.
const FOLLOWED: usize = 12;
/// How often a smaller distance is looked for, or a weaker bound tried.
const ATTEMPTS: usize = 24;
/// Tokens of a tree at most.
const MOST_TOKENS: usize = 40_000;
/// Steps towards the nearest points of two hulls.
const STEPS: usize = 24;

/// A pair of points and its exact squared distance.
struct Found {
    squared: Rational,
    parameters: [Rational; 2],
    places: [Place; 2],
}

/// A node with its hull points in binary64 and where it is.
#[derive(Clone)]
struct FloatNode {
    node: Node,
    hull: Vec<Vector>,
    /// Number of the first piece, and the interval of local parameters of a part.
    piece: usize,
    from: f64,
    to: f64,
}

/// Why there is no tree.
enum NoTree {
    /// Points that are closer.
    Closer(Place, Place),
    /// It would have too many tokens.
    TooLong,
}

impl FloatNode {
    fn new(node: Node, piece: usize, from: f64, to: f64) -> FloatNode {
        let mut hull = Vec::new();
        let rounded = |point: &[Rational]| {
            let mut vector = [0.0; 3];
            for (axis, x) in point.iter().enumerate() {
                vector[axis] = x.to_f64();
            }
            vector
        };
        match &node {
            Node::Part { part, .. } => hull.extend((0..=part.degree()).map(|k| rounded(&part.control_point(k)))),
            Node::Run { corners, .. } => {
                let [low, high] = [rounded(&corners[0]), rounded(&corners[1])];
                hull.extend((0..8).map(|bits| [0, 1, 2].map(|i| if bits >> i & 1 == 0 { low[i] } else { high[i] })));
            }
        }
        FloatNode {
            node,
            hull,
            piece,
            from,
            to,
        }
    }

    fn whole(nodes: &mut Nodes) -> FloatNode {
        FloatNode::new(nodes.whole(), 0, 0.0, 1.0)
    }

    fn halves(&self, nodes: &mut Nodes) -> Option<[FloatNode; 2]> {
        let [a, b] = nodes.halves(&self.node)?;
        let middle = (self.from + self.to) / 2.0;
        Some(match &self.node {
            Node::Run { first, behind, .. } => [
                FloatNode::new(a, *first, 0.0, 1.0),
                FloatNode::new(b, usize::midpoint(*first, *behind), 0.0, 1.0),
            ],
            Node::Part { .. } => [
                FloatNode::new(a, self.piece, self.from, middle),
                FloatNode::new(b, self.piece, middle, self.to),
            ],
        })
    }

    fn diameter(&self) -> f64 {
        let spread = |axis: usize| {
            let along = || self.hull.iter().map(move |point| point[axis]);
            along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
        };
        (0..3).map(spread).fold(0.0, f64::max)
    }

    /// The hull point with the least product.
    fn least(&self, n: &Vector) -> &Vector {
        let by = |a: &&Vector, b: &&Vector| dot(a, n).total_cmp(&dot(b, n));
        self.hull.iter().min_by(by).expect("a node has hull points")
    }

    fn is_run(&self) -> bool {
        matches!(self.node, Node::Run { .. })
    }

    fn middle(&self) -> Place {
        (self.piece, (self.from + self.to) / 2.0)
    }
}

/// The nearly shortest vector from the hull of `b` to that of `a`, by Gilbert's steps, and how far it keeps them apart.
fn separating(a: &FloatNode, b: &FloatNode) -> (f64, Vector) {
    let mut x = sub(&a.hull[0], &b.hull[0]);
    let mut best = (f64::NEG_INFINITY, x);
    for _ in 0..STEPS {
        let length = dot(&x, &x).sqrt();
        let opposite = x.map(|y| -y);
        let support = sub(a.least(&x), b.least(&opposite));
        let reached = dot(&support, &x) / length;
        if reached > best.0 {
            best = (reached, x);
        }
        let step = sub(&x, &support);
        let square = dot(&step, &step);
        if square <= 0.0 || reached.is_nan() || length - reached <= 1e-13 * length {
            break;
        }
        let fraction = (dot(&x, &step) / square).clamp(0.0, 1.0);
        if fraction <= 0.0 {
            break;
        }
        x = [0, 1, 2].map(|i| x[i] - fraction * step[i]);
    }
    best
}

/// Integers of so many bits nearly along a vector.
fn quantised(x: &Vector, bits: i32) -> Option<[i64; 3]> {
    let greatest = x.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
    let factor = 2f64.powi(bits) / greatest;
    (factor.is_finite() && greatest > 0.0).then(|| x.map(|y| (y * factor).round() as i64))
}

struct Search<'s> {
    float: [&'s FloatCurve; 2],
    dimension: usize,
    upper: f64,
    lower: &'s Rational,
    lower_float: f64,
    /// Between the nearest points known.
    chord: Vector,
}

impl Search<'_> {
    fn leaf(&self, a: &FloatNode, b: &FloatNode) -> Option<Token> {
        let opposite = |n: &Vector| n.map(|x| -x);
        let gap = |n: &Vector| dot(a.least(n), n) - dot(b.least(&opposite(n)), n);
        let wanted = self.lower_float.sqrt() * (1.0 - 1e-13);
        let along_chord = gap(&self.chord) / dot(&self.chord, &self.chord).sqrt();
        let direction = if along_chord >= wanted {
            self.chord
        } else {
            let (reached, direction) = separating(a, b);
            if reached < wanted {
                return None;
            }
            direction
        };
        [3, 7, 14, 24, 44].into_iter().find_map(|bits| {
            let n = quantised(&direction, bits)?;
            let rounded = n.map(|x| x as f64);
            if gap(&rounded) < wanted * dot(&rounded, &rounded).sqrt() {
                return None;
            }
            let n = n.map(Integer::from);
            is_far(&a.node, &b.node, &n[..self.dimension], self.lower).then_some(Token::Leaf(Leaf::Far(n)))
        })
    }

    fn tree(&self, nodes: [&mut Nodes; 2]) -> Result<Vec<Token>, NoTree> {
        let [here, there] = nodes;
        let mut stack = vec![(FloatNode::whole(here), FloatNode::whole(there))];
        let mut tokens = Vec::new();
        while let Some((a, b)) = stack.pop() {
            if tokens.len() + stack.len() >= MOST_TOKENS {
                return Err(NoTree::TooLong);
            }
            let (s, t) = (a.middle(), b.middle());
            if squared(&self.float[0].point(s), &self.float[1].point(t)) < self.upper * (1.0 - 1e-12) {
                return Err(NoTree::Closer(s, t));
            }
            if let Some(leaf) = self.leaf(&a, &b) {
                tokens.push(leaf);
                continue;
            }
            let first = match (a.is_run(), b.is_run()) {
                (true, false) => true,
                (false, true) => false,
                _ => a.diameter() >= b.diameter(),
            };
            let halves = match first {
                true => a.halves(here).map(|[x, y]| [(x, b.clone()), (y, b)]),
                false => b.halves(there).map(|[x, y]| [(a.clone(), x), (a, y)]),
            };
            let Some([x, y]) = halves else {
                return Err(NoTree::TooLong);
            };
            tokens.push(if first { Token::First } else { Token::Second });
            stack.push(y);
            stack.push(x);
        }
        Ok(tokens)
    }
}

/// An interval for the squared distance of two curves, and its witness.
pub fn distance([here, there]: [&Pieces; 2], [float, other]: [&FloatCurve; 2], width: &Width) -> (Bracket, Witness) {
    let exact = |places: [Place; 2]| {
        let parameters = [exact_parameter(here, places[0]), exact_parameter(there, places[1])];
        let (p, q) = (here.point(&parameters[0]).ok()?, there.point(&parameters[1]).ok()?);
        Some(Found {
            squared: squared_distance(&p, &q),
            parameters,
            places,
        })
    };
    let points = |float: &FloatCurve| -> Vec<(Place, Vector)> {
        let places = float.samples(SAMPLES).into_iter();
        places.map(|place| (place, float.point(place))).collect()
    };
    let (ours, theirs) = (points(float), points(other));
    // The nearest of theirs to each of ours.
    let mut pairs: Vec<(f64, Place, Place)> = ours
        .iter()
        .filter_map(|(s, p)| {
            let distances = theirs.iter().map(|(t, q)| (squared(p, q), *s, *t));
            distances.min_by(|a, b| a.0.total_cmp(&b.0))
        })
        .collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut best = pairs
        .iter()
        .take(FOLLOWED)
        .flat_map(|(_, s, t)| {
            let (_, u, v) = float.approach(other, *s, *t);
            [[*s, *t], [u, v]]
        })
        .chain([[(0, 0.0), (0, 0.0)]])
        .filter_map(exact)
        .min_by(|a, b| a.squared.cmp(&b.squared))
        .expect("the starts of curves are points of them");
    let mut nodes = [Nodes::new(here), Nodes::new(there)];
    let one = Rational::from_integer(Integer::ONE);
    let mut share = &width.relative / Rational::from_integer(Integer::from(2));
    for _ in 0..ATTEMPTS {
        if width.is_negligible(&best.squared) || share >= one {
            break;
        }
        let lower = rounded_down(&(&best.squared * (&one - &share)));
        let places = best.places;
        let search = Search {
            float: [float, other],
            dimension: here.dimension,
            upper: best.squared.to_f64(),
            lower: &lower,
            lower_float: lower.to_f64(),
            chord: sub(&float.point(places[0]), &other.point(places[1])),
        };
        let [ours, theirs] = &mut nodes;
        match search.tree([ours, theirs]) {
            Ok(tokens) => {
                let upper = rounded_up(&best.squared);
                let witness = Witness::Distance {
                    parameters: best.parameters,
                    tree: Some(tokens),
                };
                return (Bracket { lower, upper }, witness);
            }
            Err(NoTree::Closer(s, t)) => {
                let (_, u, v) = float.approach(other, s, t);
                let found = [[s, t], [u, v]].into_iter().filter_map(exact);
                match found.min_by(|a, b| a.squared.cmp(&b.squared)) {
                    Some(found) if found.squared < best.squared => best = found,
                    _ => share *= Rational::from_integer(Integer::from(64)),
                }
            }
            Err(NoTree::TooLong) => share *= Rational::from_integer(Integer::from(64)),
        }
    }
    let upper = rounded_up(&best.squared);
    let witness = Witness::Distance {
        parameters: best.parameters,
        tree: None,
    };
    let lower = Rational::from_integer(Integer::ZERO);
    (Bracket { lower, upper }, witness)
}
