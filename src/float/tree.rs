//! Parts of a curve for branch and bound: runs of pieces above, halves of pieces below, made when they are needed.

use super::piece::{Homogeneous, Pieces, Vector, affine, dot, sub};

/// Halvings of a piece before giving up.
const DEEPEST: u32 = 40;

/// A part of the curve on the range [start, start + length] of the parameter i + u of piece i.
struct Node {
    start: f64,
    length: f64,
    /// Where its control points are, and those of its tangents.
    points: (u32, u32),
    tangents: (u32, u32),
    low: Vector,
    high: Vector,
    /// The greatest extent of its box.
    size: f64,
    /// Halvings; 0 for whole pieces and runs.
    depth: u32,
    /// Left and right half; 0 before they are made.
    children: (u32, u32),
    /// A run of two or more pieces.
    run: bool,
}

/// All parts made so far.
pub(super) struct Tree {
    nodes: Vec<Node>,
    root: u32,
    /// Affine control points, or the corners of the box of a run.
    points: Vec<Vector>,
    /// The homogeneous control points beside them.
    lifted: Vec<Homogeneous>,
    tangents: Vec<Vector>,
    closed: bool,
    count: f64,
    rational: Vec<bool>,
}

impl Tree {
    /// The runs and whole pieces of a curve.
    pub(super) fn new(pieces: &Pieces) -> Tree {
        let mut tree = Tree {
            nodes: Vec::with_capacity(64),
            root: 0,
            points: Vec::with_capacity(256),
            lifted: Vec::with_capacity(256),
            tangents: Vec::with_capacity(256),
            closed: pieces.closed,
            count: pieces.all.len() as f64,
            rational: pieces.all.iter().map(|piece| piece.rational).collect(),
        };
        for (i, piece) in pieces.all.iter().enumerate() {
            tree.push(i as f64, 1.0, 0, &piece.control, &piece.tangents());
        }
        tree.root = tree.runs(0, pieces.all.len());
        tree
    }

    pub(super) fn root(&self) -> u32 {
        self.root
    }

    fn push(&mut self, start: f64, length: f64, depth: u32, control: &[Homogeneous], tangents: &[Vector]) -> u32 {
        let (first, first_tangent) = (self.points.len() as u32, self.tangents.len() as u32);
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for c in control {
            let point = affine(c);
            for axis in 0..3 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
            self.points.push(point);
            self.lifted.push(*c);
        }
        self.tangents.extend_from_slice(tangents);
        let extent = sub(&high, &low);
        self.nodes.push(Node {
            start,
            length,
            points: (first, self.points.len() as u32),
            tangents: (first_tangent, self.tangents.len() as u32),
            low,
            high,
            size: extent[0].max(extent[1]).max(extent[2]),
            depth,
            children: (0, 0),
            run: false,
        });
        self.nodes.len() as u32 - 1
    }

    fn runs(&mut self, from: usize, to: usize) -> u32 {
        if to - from == 1 {
            return from as u32;
        }
        let between = from + (to - from) / 2;
        let children = (self.runs(from, between), self.runs(between, to));
        let (a, b) = (&self.nodes[children.0 as usize], &self.nodes[children.1 as usize]);
        let low: Vector = std::array::from_fn(|i| a.low[i].min(b.low[i]));
        let high: Vector = std::array::from_fn(|i| a.high[i].max(b.high[i]));
        let first = self.points.len() as u32;
        for corner in 0..8 {
            let point: Vector = std::array::from_fn(|i| if corner >> i & 1 == 0 { low[i] } else { high[i] });
            self.points.push(point);
            self.lifted.push([point[0], point[1], point[2], 1.0]);
        }
        let extent = sub(&high, &low);
        self.nodes.push(Node {
            start: from as f64,
            length: (to - from) as f64,
            points: (first, first + 8),
            tangents: (0, 0),
            low,
            high,
            size: extent[0].max(extent[1]).max(extent[2]),
            depth: 0,
            children,
            run: true,
        });
        self.nodes.len() as u32 - 1
    }

    fn node(&self, i: u32) -> &Node {
        &self.nodes[i as usize]
    }

    fn hull(&self, node: &Node) -> &[Vector] {
        &self.points[node.points.0 as usize..node.points.1 as usize]
    }

    fn tangents(&self, node: &Node) -> &[Vector] {
        &self.tangents[node.tangents.0 as usize..node.tangents.1 as usize]
    }

    pub(super) fn size(&self, i: u32) -> f64 {
        self.node(i).size
    }

    pub(super) fn depth(&self, i: u32) -> u32 {
        self.node(i).depth
    }

    pub(super) fn can_split(&self, i: u32) -> bool {
        self.node(i).depth < DEEPEST
    }

    /// The two halves.
    pub(super) fn children(&mut self, i: u32) -> (u32, u32) {
        let node = self.node(i);
        if node.children != (0, 0) {
            return node.children;
        }
        let (start, half, depth) = (node.start, node.length / 2.0, node.depth + 1);
        let mut right = self.lifted[node.points.0 as usize..node.points.1 as usize].to_vec();
        let mut right_tangents = self.tangents(node).to_vec();
        let left = halve(&mut right);
        let left_tangents = halve(&mut right_tangents);
        if !self.rational[start as usize] {
            // The weights are sums of halves of 1, exactly 1.
            debug_assert!(left.iter().all(|c| c[3] == 1.0));
        }
        let first = self.push(start, half, depth, &left, &left_tangents);
        let second = self.push(start + half, half, depth, &right, &right_tangents);
        self.nodes[i as usize].children = (first, second);
        (first, second)
    }

    /// The middle of a part of a piece, as piece and local parameter.
    pub(super) fn middle(&self, i: u32) -> Option<(usize, f64)> {
        let node = self.node(i);
        let middle = node.start + node.length / 2.0;
        (!node.run).then(|| (node.start as usize, middle - node.start.floor()))
    }

    /// Whether two parts are farther apart than they are large.
    pub(super) fn is_far(&self, i: u32, j: u32) -> bool {
        let (a, b) = (self.node(i), self.node(j));
        let apart: Vector = std::array::from_fn(|k| (a.low[k] + a.high[k] - b.low[k] - b.high[k]) / 2.0);
        let size = a.size.max(b.size);
        dot(&apart, &apart) > size * size
    }

    /// Whether two parts share an end parameter.
    pub(super) fn adjacent(&self, i: u32, j: u32) -> bool {
        let (a, b) = (self.node(i), self.node(j));
        let meets = |first: &Node, second: &Node| {
            let end = first.start + first.length;
            end == second.start || self.closed && end == self.count && second.start == 0.0
        };
        meets(a, b) || meets(b, a)
    }

    /// A lower bound of the distance of two parts.
    pub(super) fn distance(&self, i: u32, j: u32) -> f64 {
        let (a, b) = (self.node(i), self.node(j));
        let gap: Vector = std::array::from_fn(|k| (a.low[k] - b.high[k]).max(b.low[k] - a.high[k]).max(0.0));
        let of_boxes = dot(&gap, &gap).sqrt();
        if a.run || b.run {
            return of_boxes;
        }
        // Along the line of the means of the end points, second-order accurate at a double normal.
        let (p, q) = (self.hull(a), self.hull(b));
        let (p0, p1, q0, q1) = (&p[0], &p[p.len() - 1], &q[0], &q[q.len() - 1]);
        let along: Vector = std::array::from_fn(|k| (q0[k] - p0[k]) + (q1[k] - p1[k]));
        let most = p.iter().map(|x| dot(x, &along)).fold(f64::NEG_INFINITY, f64::max);
        let least = q.iter().map(|x| dot(x, &along)).fold(f64::INFINITY, f64::min);
        of_boxes.max((least - most) / dot(&along, &along).sqrt())
    }

    /// Whether no chord between the parts is orthogonal to the tangents of one of them.
    pub(super) fn not_normal(&self, i: u32, j: u32) -> bool {
        let (a, b) = (self.node(i), self.node(j));
        self.one_sided(a, b, self.tangents(a)) || self.one_sided(a, b, self.tangents(b))
    }

    /// Whether v·(p − q) has one strict sign for all points of the hulls and all tangents v ≠ 0.
    fn one_sided(&self, a: &Node, b: &Node, tangents: &[Vector]) -> bool {
        let mut sign = 0.0;
        for v in tangents {
            if *v == [0.0; 3] {
                continue;
            }
            let range = |hull: &[Vector]| {
                let products = hull.iter().map(|x| dot(x, v));
                products.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                    (low.min(x), high.max(x))
                })
            };
            let ((least_a, most_a), (least_b, most_b)) = (range(self.hull(a)), range(self.hull(b)));
            let own = if least_a > most_b {
                1.0
            } else if most_a < least_b {
                -1.0
            } else {
                return false;
            };
            if sign * own < 0.0 {
                return false;
            }
            sign = own;
        }
        sign != 0.0
    }

    /// Whether any two tangents of both parts make an acute angle: then a chord makes one with the tangents at its ends. For one part, or neighbours.
    pub(super) fn is_acute(&self, i: u32, j: u32) -> bool {
        let (a, b) = (self.node(i), self.node(j));
        if a.run || b.run {
            return false;
        }
        let among = |x: &[Vector], y: &[Vector]| x.iter().all(|v| y.iter().all(|w| acute(v, w)));
        let (v, w) = (self.tangents(a), self.tangents(b));
        let some = |x: &[Vector]| x.iter().any(|v| *v != [0.0; 3]);
        some(v) && some(w) && among(v, w) && (i == j || among(v, v) && among(w, w))
    }

    /// Whether for all tangents v of one neighbour and w of the other, of equal length, v + w makes acute angles with all of them: then no chord is
    /// orthogonal to both, whatever the corner between them.
    pub(super) fn is_bend(&self, i: u32, j: u32) -> bool {
        let (a, b) = (self.node(i), self.node(j));
        if a.run || b.run {
            return false;
        }
        let unit = |x: &[Vector]| -> Vec<Vector> {
            let lengths = x.iter().map(|v| dot(v, v).sqrt());
            let all = x.iter().zip(lengths).filter(|(_, length)| *length > 0.0);
            all.map(|(v, length)| v.map(|x| x / length)).collect()
        };
        let (v, w) = (unit(self.tangents(a)), unit(self.tangents(b)));
        if v.is_empty() || w.is_empty() {
            return false;
        }
        v.iter().all(|v0| {
            w.iter().all(|w0| {
                let sum: Vector = std::array::from_fn(|k| v0[k] + w0[k]);
                v.iter().chain(&w).all(|x| dot(&sum, x) > 1e-12)
            })
        })
    }
}

fn acute(v: &Vector, w: &Vector) -> bool {
    dot(v, w) > 0.0 || *v == [0.0; 3] || *w == [0.0; 3]
}

/// The left half by de Casteljau's algorithm; the right one takes the place of the whole.
pub(super) fn halve<const N: usize>(row: &mut [[f64; N]]) -> Vec<[f64; N]> {
    let n = row.len();
    let mut left = Vec::with_capacity(n);
    for round in 1..=n {
        left.push(row[0]);
        for j in 0..n - round {
            row[j] = std::array::from_fn(|k| 0.5 * (row[j][k] + row[j + 1][k]));
        }
    }
    left
}
