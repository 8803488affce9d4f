//! Nodes of a moving curve in binary64, at one or two times.

use std::collections::HashMap;
use std::rc::Rc;

use crate::check::motion::{Matrix, Node, Positions, Shape};
use crate::number::{Integer, Rational, RationalExt};
use crate::prove::vector::{Vector, add, dot, greater_of_each, greatest, lesser_of_each, middle, scale, sub};

/// The positions of control points at a time, relative to the first one of them.
pub struct Snapshot {
    points: Vec<Vector>,
    /// Products with differences of control points are right to this part of the vector's length.
    error: f64,
}

/// Of the greatest coordinate: the error of a difference of split control points is well below it.
const RELATIVE_ERROR: f64 = 1e-14;

/// Denominators of fewer bits have a binary64 that is far from its limits.
const SHORT: u64 = 500;

impl Snapshot {
    /// The positions, which are in units of 1/(2^exponent·denominator).
    pub fn new(positions: &Positions, denominator: &Integer, exponent: u32) -> Snapshot {
        let below = denominator << exponent;
        let points: Vec<Vector> = match positions.narrow() {
            Some(points) if below.bits() < SHORT => {
                let unit = 1.0 / Rational::from_integer(below).to_f64();
                let first = points[0];
                // Differences of positions kept in 64 bits fit.
                let relative = |p: &[i64; 3]| [0, 1, 2].map(|axis| (p[axis] - first[axis]) as f64 * unit);
                points.iter().map(relative).map(|[x, y, z]| [x, y, z, 0.0]).collect()
            }
            _ => {
                let first = positions.get(0);
                (0..positions.len())
                    .map(|i| difference(&positions.get(i), &first, &below))
                    .collect()
            }
        };
        let size = points.iter().fold(0.0, |most: f64, p| most.max(greatest(p)));
        Snapshot {
            points,
            error: size * RELATIVE_ERROR,
        }
    }
}

/// (p − q)/denominator.
pub fn difference(p: &[Integer; 3], q: &[Integer; 3], denominator: &Integer) -> Vector {
    let axis = |axis: usize| Rational::new(&p[axis] - &q[axis], denominator.clone()).to_f64();
    [axis(0), axis(1), axis(2), 0.0]
}

/// A node at one time.
pub struct Placed {
    /// Its hull: control points of a part, the corners of the box of a run.
    pub hull: Vec<Vector>,
    /// Coefficients of D, up to positive factors; of a run those of all its pieces.
    pub tangents: Vec<Vector>,
    /// Does D vanish on some piece of it, or on all of it?
    pub idle: bool,
    /// The diagonal of its box, squared.
    pub diagonal_squared: f64,
    /// See [`Snapshot`].
    pub error: f64,
}

/// The curve at one or two times.
pub struct Geometry<'g, 'c> {
    /// What stays the same.
    pub shape: &'g mut Shape<'c>,
    snapshots: &'g [Snapshot],
    /// Homogeneous control points of pieces at each time, weight last.
    pieces: HashMap<usize, Rc<Vec<Vec<Vector>>>>,
    nodes: HashMap<Node, Rc<Vec<Placed>>>,
}

/// Nodes that are remembered.
const REMEMBERED: usize = 1 << 14;

impl<'g, 'c> Geometry<'g, 'c> {
    /// The curve at the times of the snapshots.
    pub fn new(shape: &'g mut Shape<'c>, snapshots: &'g [Snapshot]) -> Self {
        Geometry {
            shape,
            snapshots,
            pieces: HashMap::new(),
            nodes: HashMap::new(),
        }
    }

    /// A node at each time.
    pub fn node(&mut self, node: &Node) -> Rc<Vec<Placed>> {
        if let Some(known) = self.nodes.get(node) {
            return Rc::clone(known);
        }
        let placed: Vec<Placed> = match *node {
            Node::Run { first, last } => (0..self.snapshots.len())
                .map(|time| self.run(first, last, time))
                .collect(),
            Node::Part { piece, depth, index } => {
                let pieces = self.piece(piece);
                let times = pieces.iter().zip(self.snapshots);
                times
                    .map(|(points, snapshot)| part(points, depth, index, snapshot.error))
                    .collect()
            }
        };
        if self.nodes.len() >= REMEMBERED {
            self.nodes.clear();
        }
        let placed = Rc::new(placed);
        self.nodes.insert(*node, Rc::clone(&placed));
        placed
    }

    fn run(&mut self, first: usize, last: usize, time: usize) -> Placed {
        let places = self.shape.places(&Node::Run { first, last });
        let snapshot = &self.snapshots[time];
        let (low, high) = bounds(&snapshot.points[places]);
        let corners = (0..8).map(|corner: usize| {
            let axis = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
            [axis(0), axis(1), axis(2), 0.0]
        });
        let hull = corners.collect();
        let diagonal = sub(&high, &low);
        let mut tangents = Vec::new();
        let mut idle = false;
        for piece in first..last {
            let of_piece = field(&self.piece(piece)[time]);
            idle |= vanishes(&of_piece);
            tangents.extend(of_piece);
        }
        Placed {
            hull,
            tangents,
            idle,
            diagonal_squared: dot(&diagonal, &diagonal),
            error: self.snapshots[time].error,
        }
    }

    /// The homogeneous control points of a piece at each time.
    pub fn piece(&mut self, piece: usize) -> Rc<Vec<Vec<Vector>>> {
        if let Some(known) = self.pieces.get(&piece) {
            return Rc::clone(known);
        }
        let at = self.shape.pieces[piece];
        let points: Vec<Vec<Vector>> = if at.direct {
            let whole = |snapshot: &Snapshot| snapshot.points[at.first..=at.last].to_vec();
            let weighted = |points: Vec<Vector>| points.into_iter().map(|[x, y, z, _]| [x, y, z, 1.0]).collect();
            self.snapshots.iter().map(whole).map(weighted).collect()
        } else {
            let rows = self.shape.part_rows(piece, 0, 0);
            let entries: Vec<f64> = match &rows.hull {
                Matrix::Narrow(entries, _) => entries.iter().map(|x| *x as f64).collect(),
                Matrix::Large(entries) => {
                    let most = entries.iter().map(Integer::bits).max().unwrap_or(0);
                    let unit = Integer::ONE << most as u32;
                    let share = |x: &Integer| Rational::new(x.clone(), unit.clone()).to_f64();
                    entries.iter().map(share).collect()
                }
            };
            let homogeneous = |snapshot: &Snapshot, row: &[f64]| {
                let points = &snapshot.points[at.first..=at.last];
                let terms = row.iter().zip(points);
                terms.fold([0.0; 4], |sum, (factor, point)| {
                    let [x, y, z, _] = scale(point, *factor);
                    add(&sum, &[x, y, z, *factor])
                })
            };
            let times = self.snapshots.iter();
            times
                .map(|snapshot| {
                    entries
                        .chunks(rows.count)
                        .map(|row| homogeneous(snapshot, row))
                        .collect()
                })
                .collect()
        };
        let points = Rc::new(points);
        self.pieces.insert(piece, Rc::clone(&points));
        points
    }
}

fn vanishes(tangents: &[Vector]) -> bool {
    tangents.iter().all(|v| dot(v, v) == 0.0)
}

fn bounds(points: &[Vector]) -> (Vector, Vector) {
    points.iter().fold((points[0], points[0]), |(low, high), p| {
        (lesser_of_each(&low, p), greater_of_each(&high, p))
    })
}

fn affine([x, y, z, w]: &Vector) -> Vector {
    [x / w, y / w, z / w, 0.0]
}

/// A part of a piece.
fn part(points: &[Vector], depth: u32, index: u128, error: f64) -> Placed {
    let mut points = points.to_vec();
    for level in (0..depth).rev() {
        points = half(points, index >> level & 1 == 1);
    }
    let hull: Vec<Vector> = points.iter().map(affine).collect();
    let (low, high) = bounds(&hull);
    let diagonal = sub(&high, &low);
    let tangents = field(&points);
    Placed {
        idle: vanishes(&tangents),
        tangents,
        hull,
        diagonal_squared: dot(&diagonal, &diagonal),
        error,
    }
}

fn half(mut row: Vec<Vector>, right: bool) -> Vec<Vector> {
    if right {
        row.reverse();
    }
    let mut found = Vec::with_capacity(row.len());
    for remaining in (0..row.len()).rev() {
        found.push(row[0]);
        for i in 0..remaining {
            row[i] = middle(&row[i], &row[i + 1]);
        }
    }
    if right {
        found.reverse();
    }
    found
}

/// Positive multiples of the Bernstein coefficients of D, from homogeneous control points (FORMAT §3).
fn field(points: &[Vector]) -> Vec<Vector> {
    let n = points.len() - 1;
    if points.iter().all(|p| p[3] == points[0][3]) {
        return points.windows(2).map(|pair| sub(&pair[1], &pair[0])).collect();
    }
    let mut binomials = vec![1.0];
    for i in 0..n {
        binomials.push(binomials[i] * (n - i) as f64 / (i + 1) as f64);
    }
    (0..=2 * n - 2)
        .map(|k| {
            let mut sum = [0.0; 4];
            for i in (k + 1).saturating_sub(n)..=k / 2 {
                let j = k + 1 - i;
                let factor = (k + 1 - 2 * i) as f64 * binomials[i] * binomials[j];
                let term = sub(&scale(&points[j], points[i][3]), &scale(&points[i], points[j][3]));
                sum = add(&sum, &scale(&term, factor));
            }
            [sum[0], sum[1], sum[2], 0.0]
        })
        .collect()
}

/// Point and derivative of a piece with these homogeneous control points at a local parameter.
pub fn evaluate(points: &[Vector], u: f64) -> (Vector, Vector) {
    let n = points.len() - 1;
    let mut row = points.to_vec();
    for round in (1..n).rev() {
        for k in 0..=round {
            row[k] = add(&row[k], &scale(&sub(&row[k + 1], &row[k]), u));
        }
    }
    let derivative = scale(&sub(&row[1], &row[0]), n as f64);
    let point = add(&row[0], &scale(&sub(&row[1], &row[0]), u));
    let here = affine(&point);
    let [x, y, z, w] = derivative;
    let turned = sub(&[x, y, z, 0.0], &scale(&here, w));
    (here, scale(&turned, 1.0 / point[3]))
}
