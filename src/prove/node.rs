//! Nodes of the search in binary64, and how they are split.

use super::cone::Cone;
use super::float_chain::{FloatChain, UNIT};
use super::vector::{Vector, dot, greater, greater_of_each, greatest, lesser_of_each, middle, sub};
use crate::check::cover::Context;
use crate::check::element::{Element, Node as ExactNode, corner_pieces, point_location};
use crate::check::part::Part as ExactPart;

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Elements `first … last−1`; `number` is the run's number.
    Run {
        /// Number of the run.
        number: usize,
        /// First element.
        first: usize,
        /// One past the last.
        last: usize,
    },
    /// A corner or an end.
    Point(Element),
    /// Part `index` of 2^`depth` of a piece.
    Part {
        /// The piece.
        piece: usize,
        /// Its number.
        index: u128,
        /// How often it was halved.
        depth: u32,
    },
}

/// A node with its geometry.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// What it is.
    pub kind: Kind,
    /// Least coordinates of its hull.
    pub low: Vector,
    /// Greatest coordinates of its hull.
    pub high: Vector,
    /// Error bound of hull coordinates.
    pub error: f64,
    /// The error bound, and 4·[`UNIT`] of the greatest magnitude of a coordinate: room for the rounding of products with hull points.
    pub margin: f64,
    /// Error bound of tangent components.
    pub tangent_error: f64,
    /// Is an end of the curve in it?
    pub has_end: bool,
    /// Where its coefficients are: homogeneous points, then tangents.
    start: usize,
    /// Where its hull points are; the same for a polynomial piece.
    hull: usize,
    points: u32,
    tangents: u32,
}

impl Node {
    /// A node to be overwritten.
    pub const NONE: Node = Node {
        kind: Kind::Run {
            number: 0,
            first: 0,
            last: 0,
        },
        low: [0.0; 4],
        high: [0.0; 4],
        error: 0.0,
        margin: 0.0,
        tangent_error: 0.0,
        has_end: false,
        start: 0,
        hull: 0,
        points: 0,
        tangents: 0,
    };

    /// Is it a run?
    pub fn is_run(&self) -> bool {
        matches!(self.kind, Kind::Run { .. })
    }

    /// Is it a corner or an end?
    pub fn is_point(&self) -> bool {
        matches!(self.kind, Kind::Point(_))
    }

    /// How often its piece was halved, 0 for other nodes.
    pub fn depth(&self) -> u32 {
        if let Kind::Part { depth, .. } = self.kind {
            depth
        } else {
            0
        }
    }

    /// The diagonal of its box, squared.
    pub fn diagonal_squared(&self) -> f64 {
        let d = sub(&self.high, &self.low);
        dot(&d, &d)
    }

    /// The middle of its parameter range, if it is on one piece.
    pub fn middle(&self) -> Option<(usize, f64)> {
        match self.kind {
            Kind::Part { piece, index, depth } => Some((piece, (index as f64 + 0.5) / 2f64.powi(depth as i32))),
            _ => None,
        }
    }
}

/// Curve data for the search and a stack of coefficients.
///
/// Coefficients have one numbering: first those of the chain's pieces, then those on the stack.
pub struct Nodes<'s> {
    /// The exact curve.
    pub context: &'s Context<'s>,
    /// The curve in floats.
    pub floats: &'s FloatChain,
    /// Cones of runs.
    pub run_cones: &'s [Cone],
    /// 2^-grid.
    pub grid_unit: f64,
    /// The chain's own coefficients.
    fixed: &'s [Vector],
    stack: Vec<Vector>,
    /// How much of the stack is in use; what is above it is left from before.
    height: usize,
}

/// The cones of all runs, numbered as the boxes are.
pub fn run_cones(context: &Context, floats: &FloatChain) -> Vec<Cone> {
    fn fill(context: &Context, floats: &FloatChain, first: usize, last: usize, cones: &mut Vec<Cone>) -> Cone {
        if last - first == 1 {
            return match context.elements.get(first) {
                Element::Piece(piece) => floats.pieces[piece].cone,
                point => Cone::around(point_tangents(context, floats, point).iter()),
            };
        }
        let number = cones.len();
        cones.push(Cone::FULL);
        let middle = (first + last) / 2;
        let left = fill(context, floats, first, middle, cones);
        let right = fill(context, floats, middle, last, cones);
        cones[number] = left.merged(&right);
        cones[number]
    }
    let mut cones = Vec::with_capacity(context.elements.count());
    fill(context, floats, 0, context.elements.count(), &mut cones);
    cones
}

/// The tangents of a corner or an end: the first or last non-zero coefficients of the pieces there.
fn point_tangents(context: &Context, floats: &FloatChain, element: Element) -> Vec<Vector> {
    let chain = context.chain;
    let outgoing = |piece: usize| floats.tangents(piece).iter().find(|v| dot(v, v) > 0.0).copied();
    let incoming = |piece: usize| floats.tangents(piece).iter().rfind(|v| dot(v, v) > 0.0).copied();
    let found = match element {
        Element::Piece(_) => unreachable!("a piece is not a point element"),
        Element::Start => [outgoing(0), None],
        Element::End => [incoming(chain.count() - 1), None],
        Element::Corner(joint) => {
            let (before, after) = corner_pieces(chain, joint);
            [incoming(before), outgoing(after)]
        }
    };
    found.into_iter().flatten().collect()
}

impl<'s> Nodes<'s> {
    /// An empty stack.
    pub fn new(context: &'s Context<'s>, floats: &'s FloatChain, run_cones: &'s [Cone]) -> Self {
        let grid_unit = 2f64.powi(-(context.grid.min(1000) as i32));
        Nodes {
            context,
            floats,
            run_cones,
            grid_unit,
            fixed: floats.coefficients(),
            stack: Vec::with_capacity(256),
            height: 0,
        }
    }

    /// The height of the stack, to return to.
    pub fn mark(&self) -> usize {
        self.height
    }

    /// Forgets everything above a mark.
    pub fn release(&mut self, mark: usize) {
        self.height = mark;
    }

    /// Takes room on the stack; returns its place there.
    fn take(&mut self, count: usize) -> usize {
        let place = self.height;
        self.height += count;
        if self.stack.len() < self.height {
            self.stack.resize(self.height, [0.0; 4]);
        }
        place
    }

    /// `count` vectors from `start` on, in the numbering of all coefficients.
    #[inline]
    fn vectors(&self, start: usize, count: u32) -> &[Vector] {
        match start.checked_sub(self.fixed.len()) {
            None => &self.fixed[start..start + count as usize],
            Some(place) => &self.stack[place..place + count as usize],
        }
    }

    /// The node of all elements.
    pub fn whole(&mut self) -> Node {
        self.of_elements(0, 0, self.context.elements.count())
    }

    /// The node of the elements `first … last−1`, which is run `number` if there are at least two.
    pub fn of_elements(&mut self, number: usize, first: usize, last: usize) -> Node {
        let mut node = Node::NONE;
        self.write_elements(number, first, last, &mut node);
        node
    }

    /// The same, written where it is to be: nodes are large, and moving them takes time.
    #[inline]
    fn write_elements(&mut self, number: usize, first: usize, last: usize, node: &mut Node) {
        if last - first >= 2 {
            let elements = &self.context.elements;
            let is_end = |i: usize| matches!(elements.get(i), Element::Start | Element::End);
            [node.low, node.high] = self.run_box(number);
            node.kind = Kind::Run { number, first, last };
            node.error = 0.0;
            node.margin = 4.0 * UNIT * reach(&node.low, &node.high);
            node.tangent_error = 0.0;
            node.has_end = is_end(first) || is_end(last - 1);
            (node.start, node.hull, node.points, node.tangents) = (0, 0, 0, 0);
            return;
        }
        match self.context.elements.get(first) {
            Element::Piece(piece) => self.write_part(piece, 0, 0, self.floats.start(piece), node),
            point => *node = self.point(point),
        }
    }

    /// The box of a run in floats: exact up to 2^53 grid units, rounded outward beyond.
    #[inline]
    fn run_box(&self, number: usize) -> [Vector; 2] {
        if let crate::check::boxes::Boxes::Narrow(boxes) = &self.context.boxes {
            let [low, high] = &boxes[number];
            // All six at once: bits above the 53rd of a magnitude, or of its complement.
            let bits = low.iter().chain(high).fold(0, |bits, x| bits | (x ^ (x >> 63)));
            if bits >> 53 == 0 {
                let vector = |v: &[i64; 3]| {
                    let [x, y, z] = v.map(|x| x as f64 * self.grid_unit);
                    [x, y, z, 0.0]
                };
                return [vector(low), vector(high)];
            }
        }
        self.large_run_box(number)
    }

    fn large_run_box(&self, number: usize) -> [Vector; 2] {
        let outward = |x: &i64, up: bool| {
            let nearest = *x as f64;
            let slack = if x.unsigned_abs() >> 53 == 0 {
                0.0
            } else {
                nearest.abs() * UNIT
            };
            (if up { nearest + slack } else { nearest - slack }) * self.grid_unit
        };
        match &self.context.boxes {
            crate::check::boxes::Boxes::Narrow(boxes) => {
                let [low, high] = &boxes[number];
                let vector = |v: &[i64; 3], up| [outward(&v[0], up), outward(&v[1], up), outward(&v[2], up), 0.0];
                [vector(low, false), vector(high, true)]
            }
            crate::check::boxes::Boxes::Large(boxes) => {
                let [low, high] = &boxes[number];
                let scale = self.context.grid_scale();
                let wide = |x: f64, up: bool| {
                    if up {
                        x + x.abs() * 8.0 * UNIT
                    } else {
                        x - x.abs() * 8.0 * UNIT
                    }
                };
                let vector = |v: &[crate::number::Integer; 3], up| {
                    let [x, y, z] = [0, 1, 2].map(|i| wide(super::float_chain::quotient(&v[i], scale), up));
                    [x, y, z, 0.0]
                };
                [vector(low, false), vector(high, true)]
            }
        }
    }

    fn point(&mut self, element: Element) -> Node {
        let (piece, end) = point_location(self.context.chain, element);
        let points = self.floats.points(piece);
        let homogeneous = if end { points[points.len() - 1] } else { points[0] };
        let point = super::vector::scale(&homogeneous, 1.0 / homogeneous[3]);
        let (error, weight_error, _) = self.floats.errors(piece, 0);
        let error = affine_error(error, weight_error, homogeneous[3], super::vector::greatest(&point));
        let tangents = point_tangents(self.context, self.floats, element);
        let tangent_error = match element {
            Element::Corner(joint) => {
                let (before, after) = corner_pieces(self.context.chain, joint);
                self.floats.errors(before, 0).2.max(self.floats.errors(after, 0).2)
            }
            _ => self.floats.errors(piece, 0).2,
        };
        let place = self.take(1 + tangents.len());
        self.stack[place] = point;
        self.stack[place + 1..][..tangents.len()].copy_from_slice(&tangents);
        let start = self.fixed.len() + place;
        Node {
            kind: Kind::Point(element),
            low: point,
            high: point,
            error,
            margin: error + 4.0 * UNIT * reach(&point, &point),
            tangent_error,
            has_end: !matches!(element, Element::Corner(_)),
            start,
            hull: start,
            points: 1,
            tangents: tangents.len() as u32,
        }
    }

    /// Writes a part whose coefficients start at `start`.
    fn write_part(&mut self, piece: usize, index: u128, depth: u32, start: usize, node: &mut Node) {
        let data = &self.floats.pieces[piece];
        node.points = data.degree as u32 + 1;
        node.tangents = data.tangent_degree as u32 + 1;
        let (error, weight_error, tangent_error) = self.floats.errors(piece, depth);
        (node.hull, node.error) = if data.rational {
            self.affine_hull(start, node.points, error, weight_error)
        } else {
            (start, error)
        };
        let all = self.vectors(node.hull, node.points);
        let (mut low, mut high) = (all[0], all[0]);
        for point in &all[1..] {
            low = lesser_of_each(point, &low);
            high = greater_of_each(point, &high);
        }
        (node.low, node.high) = (low, high);
        node.kind = Kind::Part { piece, index, depth };
        node.margin = node.error + 4.0 * UNIT * reach(&low, &high);
        node.tangent_error = tangent_error;
        node.has_end = false;
        node.start = start;
    }

    /// Puts the affine points of a rational part on the stack; returns where they are and the error bound of their coordinates.
    #[inline(never)]
    fn affine_hull(&mut self, start: usize, points: u32, error: f64, weight_error: f64) -> (usize, f64) {
        let place = self.take(points as usize);
        let (mut least_weight, mut greatest) = (f64::INFINITY, 0.0f64);
        for k in 0..points as usize {
            let homogeneous = self.vectors(start, points)[k];
            let point = super::vector::scale(&homogeneous, 1.0 / homogeneous[3]);
            least_weight = least_weight.min(homogeneous[3]);
            greatest = greatest.max(super::vector::greatest(&point));
            self.stack[place + k] = point;
        }
        let error = affine_error(error, weight_error, least_weight, greatest);
        (self.fixed.len() + place, error)
    }

    /// Writes the two halves of a node; `false` for a corner or an end, which has none.
    pub fn halves(&mut self, node: &Node, [left, right]: &mut [Node; 2]) -> bool {
        use crate::check::boxes::Boxes;
        match node.kind {
            Kind::Run { number, first, last } => {
                let middle = (first + last) / 2;
                self.write_elements(Boxes::left(number), first, middle, left);
                self.write_elements(Boxes::right(number, middle - first), middle, last, right);
            }
            Kind::Point(_) => return false,
            Kind::Part { piece, index, depth } => {
                let (points, tangents) = (node.points as usize, node.tangents as usize);
                let size = points + tangents;
                let place = self.take(2 * size);
                let (below, above) = self.stack.split_at_mut(place);
                let from = match node.start.checked_sub(self.fixed.len()) {
                    None => &self.fixed[node.start..node.start + size],
                    Some(place) => &below[place..place + size],
                };
                let (first, second) = above[..2 * size].split_at_mut(size);
                halve(&from[..points], &mut first[..points], &mut second[..points]);
                halve(&from[points..], &mut first[points..], &mut second[points..]);
                let start = self.fixed.len() + place;
                self.write_part(piece, 2 * index, depth + 1, start, left);
                self.write_part(piece, 2 * index + 1, depth + 1, start + size, right);
            }
        }
        true
    }

    /// Hull points of a part, a corner or an end.
    #[inline]
    pub fn hull(&self, node: &Node) -> &[Vector] {
        self.vectors(node.hull, node.points)
    }

    /// Tangents of a part, a corner or an end, zero vectors included.
    #[inline]
    pub fn tangents(&self, node: &Node) -> &[Vector] {
        self.vectors(node.start + node.points as usize, node.tangents)
    }

    /// A cone around the tangents of a node.
    pub fn cone(&self, node: &Node) -> Cone {
        match node.kind {
            Kind::Run { number, .. } => self.run_cones[number],
            Kind::Part { piece, depth: 0, .. } => self.floats.pieces[piece].cone,
            _ => match <&[Vector; 3]>::try_from(self.tangents(node)) {
                // Without loops for cubics.
                Ok(tangents) => Cone::around(tangents.iter()),
                Err(_) => Cone::around(self.tangents(node).iter()),
            },
        }
    }

    /// Is this node all of the curve?
    pub fn is_whole(&self, node: &Node) -> bool {
        let count = self.context.elements.count();
        match node.kind {
            Kind::Run { first, last, .. } => first == 0 && last == count,
            Kind::Part { depth, .. } => depth == 0 && count == 1,
            Kind::Point(_) => false,
        }
    }

    /// The same node for the checker's exact arithmetic.
    pub fn exact(&self, node: &Node) -> ExactNode<'s> {
        match node.kind {
            Kind::Run { number, first, last } => ExactNode::Run { number, first, last },
            Kind::Point(element) => ExactNode::Point(element),
            Kind::Part { piece, index, depth } => {
                let mut part = ExactPart::whole(self.context.chain, piece);
                for level in (0..depth).rev() {
                    let (left, right) = part.halves().expect("the search does not go deeper than the checker");
                    part = if index >> level & 1 == 0 { left } else { right };
                }
                ExactNode::Part(part)
            }
        }
    }
}

/// De Casteljau at the middle. Cubics and their derivatives have code of their own, without loops.
fn halve(from: &[Vector], left: &mut [Vector], right: &mut [Vector]) {
    match from.len() {
        3 => halve_fixed::<3>(from, left, right),
        4 => halve_fixed::<4>(from, left, right),
        _ => {
            right.copy_from_slice(from);
            halve_row(left, right);
        }
    }
}

#[inline]
fn halve_fixed<const N: usize>(from: &[Vector], left: &mut [Vector], right: &mut [Vector]) {
    let (mut first, mut row) = ([[0.0; 4]; N], [[0.0; 4]; N]);
    row.copy_from_slice(from);
    halve_row(&mut first, &mut row);
    left.copy_from_slice(&first);
    right.copy_from_slice(&row);
}

/// Halves `row`, which becomes the right half.
#[inline(always)]
fn halve_row(left: &mut [Vector], row: &mut [Vector]) {
    let count = row.len();
    for k in 0..count {
        left[k] = row[0];
        for i in 0..count - 1 - k {
            row[i] = middle(&row[i], &row[i + 1]);
        }
    }
}

/// The greatest magnitude of a coordinate of a box.
fn reach(low: &Vector, high: &Vector) -> f64 {
    greater(greatest(low), greatest(high))
}

fn affine_error(error: f64, weight_error: f64, least_weight: f64, greatest: f64) -> f64 {
    let weight = least_weight - weight_error;
    if weight <= 0.0 {
        return f64::INFINITY;
    }
    (error + greatest * weight_error) / weight * (1.0 + 4.0 * UNIT) + 2.0 * UNIT * greatest
}
