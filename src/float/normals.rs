//! Starts for Newton's method in the plane: normals of samples, followed through the Delaunay triangulation of the samples.
//!
//! A double normal between c(s) and c(t) lies on the normal of the curve at c(s): the function F(s, t) = (c(s) − c(t))·c'(s) is 0 there, and so is
//! G(s, t) = (c(s) − c(t))·c'(t). Samples cut the square of pairs (s, t) into cells. The walk along the normal of a sample, from one end of the
//! triangulation to the other, crosses the curve wherever F changes sign along this row of the grid, however many strands lie between. Two neighbouring
//! walks show all cells that the curve F = 0 passes between them. A start is kept where G can be 0 in the cell, by how far tangents and
//! chords turn in it. `docs/float.md` has the argument why the cells of all double normals are among them.

use std::collections::{BTreeSet, HashMap};
use std::f64::consts::PI;

use spade::{DelaunayTriangulation, HasPosition, Intersection, LineIntersectionIterator, Point2, Triangulation};

use super::FloatError;
use super::double_normal::Location;
use super::piece::{Pieces, Vector, dot, sub};

/// Between samples the tangent turns by at most this angle, as long as intervals are not shorter than [`SHORTEST`].
const TURN: f64 = PI / 12.0;

/// The shortest interval, of a piece.
const SHORTEST: f64 = 1.0 / 4096.0;

/// Between the two ends of a double normal the tangent turns by 180° at least; what sampling may hide of it is left.
const LEAST_TURN: f64 = PI - 4.0 * TURN;

/// More starts are refused.
const MOST_STARTS: usize = 20_000_000;

/// A point of the curve.
struct Sample {
    piece: usize,
    u: f64,
    point: Vector,
    /// Of length 1; 0 where the derivative is.
    tangent: Vector,
}

/// All samples along the curve: every piece from its start to its end, so that joints occur twice.
struct Samples<'a> {
    pieces: &'a Pieces,
    all: Vec<Sample>,
    /// How far the tangent has turned up to each, in total.
    turned: Vec<f64>,
}

/// A vertex of the triangulation: all samples at one place.
struct Vertex {
    position: Point2<f64>,
    samples: Vec<usize>,
}

impl HasPosition for Vertex {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// The starts, in order.
pub(super) fn starts(pieces: &Pieces, intervals: usize) -> Result<Vec<(Location, Location)>, FloatError> {
    let samples = Samples::new(pieces, intervals);
    let range = FloatError::Range { place: "points" };
    let triangulation = DelaunayTriangulation::<Vertex>::bulk_load(samples.vertices()).map_err(|_| range)?;
    let loose = samples.loose(&triangulation);
    let mut cells = BTreeSet::new();
    let mut before: Option<Vec<usize>> = None;
    for i in 0..samples.all.len() {
        let row = samples.crossed(i, &triangulation, &loose);
        if let Some(before) = before.filter(|_| samples.is_interval(i - 1)) {
            samples.between_rows(i - 1, &before, &row, &mut cells);
        }
        if cells.len() > MOST_STARTS {
            return Err(FloatError::Argument {
                expected: "samples that make at most 20,000,000 starts",
            });
        }
        before = Some(row);
    }
    let middle = |i: usize| {
        let (a, b) = (&samples.all[i], &samples.all[i + 1]);
        (a.piece, (a.u + b.u) / 2.0)
    };
    Ok(cells.into_iter().map(|(i, j)| (middle(i), middle(j))).collect())
}

impl<'a> Samples<'a> {
    fn new(pieces: &'a Pieces, intervals: usize) -> Samples<'a> {
        let mut all: Vec<Sample> = Vec::new();
        for (piece, of) in pieces.all.iter().enumerate() {
            let sample = |u: f64| {
                let [point, derivative, _] = of.evaluate(u);
                let tangent = unit(&derivative);
                Sample {
                    piece,
                    u,
                    point,
                    tangent,
                }
            };
            all.push(sample(0.0));
            for k in 1..=intervals {
                // Halved until the curve turns little: those still to come, the next one last.
                let mut ends = vec![sample(k as f64 / intervals as f64)];
                while let (Some(from), Some(to)) = (all.last(), ends.pop()) {
                    let middle = sample((from.u + to.u) / 2.0);
                    let turn = angle(&from.tangent, &middle.tangent) + angle(&middle.tangent, &to.tangent);
                    if turn > TURN && to.u - from.u > SHORTEST {
                        ends.push(to);
                        ends.push(middle);
                    } else {
                        all.push(to);
                    }
                }
            }
        }
        let mut turned = vec![0.0];
        for pair in all.windows(2) {
            turned.push(turned[turned.len() - 1] + angle(&pair[0].tangent, &pair[1].tangent));
        }
        Samples { pieces, all, turned }
    }

    /// Whether sample i and the next one are the ends of an interval, rather than two sides of a joint.
    fn is_interval(&self, i: usize) -> bool {
        i + 1 < self.all.len() && self.all[i].piece == self.all[i + 1].piece
    }

    /// The samples by their places.
    fn vertices(&self) -> Vec<Vertex> {
        let mut places: HashMap<[u64; 2], usize> = HashMap::new();
        let mut vertices: Vec<Vertex> = Vec::new();
        for (i, sample) in self.all.iter().enumerate() {
            // No negative zero.
            let [x, y, _] = sample.point.map(|x| x + 0.0);
            let place = *places.entry([x.to_bits(), y.to_bits()]).or_insert(vertices.len());
            match vertices.get_mut(place) {
                Some(vertex) => vertex.samples.push(i),
                None => vertices.push(Vertex {
                    position: Point2::new(x, y),
                    samples: vec![i],
                }),
            }
        }
        vertices
    }

    /// The intervals that are no edges of the triangulation, because another strand is near: they are tried with every normal.
    fn loose(&self, triangulation: &DelaunayTriangulation<Vertex>) -> Vec<usize> {
        let mut found = vec![false; self.all.len()];
        for edge in triangulation.undirected_edges() {
            let [a, b] = edge.vertices();
            for i in &a.data().samples {
                let other = &b.data().samples;
                found[*i] |= other.contains(&(i + 1));
                if *i > 0 && other.contains(&(i - 1)) {
                    found[i - 1] = true;
                }
            }
        }
        (0..self.all.len())
            .filter(|i| self.is_interval(*i) && !found[*i])
            .collect()
    }

    /// F of sample i with sample j, up to the speed.
    fn side(&self, i: usize, j: usize) -> f64 {
        let (a, b) = (&self.all[i], &self.all[j]);
        dot(&sub(&a.point, &b.point), &a.tangent)
    }

    /// The intervals, numbered by their first samples, that the normal of sample i crosses.
    fn crossed(&self, i: usize, triangulation: &DelaunayTriangulation<Vertex>, loose: &[usize]) -> Vec<usize> {
        let sample = &self.all[i];
        let [x, y, _] = sample.point;
        let [tx, ty, _] = sample.tangent;
        if (tx, ty) == (0.0, 0.0) {
            return Vec::new();
        }
        let mut near: Vec<usize> = loose.to_vec();
        let mut beside = |vertex: &Vertex| {
            for j in &vertex.samples {
                near.extend(j.checked_sub(1));
                near.push(*j);
            }
        };
        // Beyond the whole curve, to both sides.
        let far = 4.0 * self.pieces.scale;
        let (from, to) = (
            Point2::new(x - far * ty, y + far * tx),
            Point2::new(x + far * ty, y - far * tx),
        );
        for met in LineIntersectionIterator::new(triangulation, from, to) {
            match met {
                // Also the intervals beside: a vertex may lie on the line up to rounding.
                Intersection::EdgeIntersection(edge) | Intersection::EdgeOverlap(edge) => {
                    beside(edge.from().data());
                    beside(edge.to().data());
                }
                Intersection::VertexIntersection(vertex) => beside(vertex.data()),
            }
        }
        near.sort_unstable();
        near.dedup();
        near.retain(|j| self.is_interval(*j) && (self.side(i, *j) > 0.0) != (self.side(i, j + 1) > 0.0));
        near
    }

    /// The cells between the rows of samples i and i + 1 that F = 0 passes, as far as G can be 0 there.
    fn between_rows(&self, i: usize, one: &[usize], two: &[usize], cells: &mut BTreeSet<(usize, usize)>) {
        let mut first = 0;
        while first < self.all.len() {
            let piece = self.all[first].piece;
            let end = first + self.all[first..].partition_point(|sample| sample.piece == piece);
            let part = |row: &[usize]| {
                let from = row.partition_point(|j| *j < first);
                (from, from + row[from..].partition_point(|j| *j < end))
            };
            let ((a, a_end), (b, b_end)) = (part(one), part(two));
            let mut events: Vec<usize> = [&one[a..a_end], &two[b..b_end]].concat();
            events.sort_unstable();
            let mut differs = (self.side(i, first) > 0.0) != (self.side(i + 1, first) > 0.0);
            let mut from = first;
            for event in events {
                if differs {
                    (from..event).for_each(|j| self.keep(i, j, cells));
                }
                self.keep(i, event, cells);
                (differs, from) = (!differs, event + 1);
            }
            if differs {
                (from..end - 1).for_each(|j| self.keep(i, j, cells));
            }
            first = end;
        }
    }

    /// Keeps a cell where G can be 0 and that is not too near to the diagonal for a double normal.
    fn keep(&self, i: usize, j: usize, cells: &mut BTreeSet<(usize, usize)>) {
        let (low, high) = (i.min(j), i.max(j));
        if low == high || cells.contains(&(low, high)) {
            return;
        }
        let turn = self.turned[high + 1] - self.turned[low];
        let all = self.turned[self.turned.len() - 1];
        let closing = angle(&self.all[self.all.len() - 1].tangent, &self.all[0].tangent);
        let other = all + closing - (self.turned[high] - self.turned[low + 1]);
        if turn < LEAST_TURN || self.pieces.closed && other < LEAST_TURN {
            return;
        }
        let length = |k: usize| {
            let x = sub(&self.all[k].point, &self.all[k + 1].point);
            dot(&x, &x).sqrt()
        };
        let reach = length(i) + length(j);
        let turn = self.turned[j + 1] - self.turned[j];
        let mut possible = false;
        let mut signs = [false; 2];
        for a in [i, i + 1] {
            for b in [j, j + 1] {
                let chord = sub(&self.all[a].point, &self.all[b].point);
                let size = dot(&chord, &chord).sqrt();
                let cosine = dot(&chord, &self.all[b].tangent) / size;
                // The angles between chord and tangent in the cell differ by no more than chord and tangent turn.
                possible |= size <= reach || cosine.abs().asin() <= 0.5 * ((reach / size).asin() + turn);
                signs[usize::from(cosine > 0.0)] = true;
            }
        }
        if possible || signs == [true, true] {
            cells.insert((low, high));
        }
    }
}

fn unit(vector: &Vector) -> Vector {
    let length = dot(vector, vector).sqrt();
    if length > 0.0 {
        vector.map(|x| x / length)
    } else {
        [0.0; 3]
    }
}

/// The angle between two vectors of length 1 in the plane, 0 where one is 0.
fn angle(a: &Vector, b: &Vector) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).atan2(dot(a, b)).abs()
}
