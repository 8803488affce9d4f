//! The polytope as its users see it.

use super::body::Body;
use super::{Clip, HalfSpace, enclosure, measure};
use crate::number::{Integer, Rational, RationalExt};

/// A bounded polygon (D = 2) or polyhedron (D = 3), convex and with interior, exact.
///
/// Vertices are numbered from 0 to [`vertex_count`](Polytope::vertex_count) − 1 and facets likewise; [`clip`](Polytope::clip) may number both anew.
#[derive(Clone, Debug)]
pub struct Polytope<const D: usize> {
    pub(super) body: Box<Body>,
}

/// A facet of a polytope: an edge of a polygon or a face of a polyhedron.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Facet {
    /// The row whose hyperplane it spans: its index in the list given to [`intersect`](super::intersect()), or its label.
    pub row: usize,
    /// Its vertices. In space they are in counter-clockwise order seen from outside; in the plane they are the two ends, in counter-clockwise order around the polygon.
    pub vertices: Vec<usize>,
}

impl<const D: usize> Polytope<D> {
    /// The box of all points with low\[i\] ≤ x\[i\] ≤ high\[i\]; `None` unless low\[i\] < high\[i\] for all i. The side x\[i\] ≥ low\[i\] has the label
    /// 2i, the side x\[i\] ≤ high\[i\] the label 2i + 1.
    pub fn from_box(low: &[Rational; D], high: &[Rational; D]) -> Option<Self> {
        const { assert!(D == 2 || D == 3, "the plane or space") }
        if (0..D).any(|i| low[i] >= high[i]) {
            return None;
        }
        let sides: Vec<_> = (0..2 * D)
            .map(|side| {
                let mut row = [const { Integer::ZERO }; 4];
                if side % 2 == 0 {
                    row[side / 2] = low[side / 2].denom().clone();
                    row[3] = -low[side / 2].numer();
                } else {
                    row[side / 2] = -high[side / 2].denom();
                    row[3] = high[side / 2].numer().clone();
                }
                (row, Some(side))
            })
            .collect();
        Some(Polytope {
            body: Box::new(Body::from_sides(&sides, D)),
        })
    }

    /// Intersects with a half-space; facets it adds bear the label. Time is linear in the number of vertices.
    ///
    /// Unless [`Clip::Cut`] is returned, the polytope is left as it was.
    pub fn clip(&mut self, half_space: &HalfSpace<D>, label: usize) -> Clip {
        if half_space.normal.iter().all(Integer::is_zero) {
            return if half_space.constant.is_negative() {
                Clip::Empty
            } else {
                Clip::Redundant
            };
        }
        self.body.clip(half_space.coefficients(), Some(label))
    }

    /// The number of vertices, at least D + 1.
    pub fn vertex_count(&self) -> usize {
        self.body.vertices.len()
    }

    /// The number of facets, at least D + 1.
    pub fn facet_count(&self) -> usize {
        self.body.facets.len()
    }

    /// The facet of a number.
    ///
    /// # Panics
    /// When there are not so many, as for slices.
    pub fn facet(&self, number: usize) -> Facet {
        let facet = &self.body.facets[number];
        Facet {
            // Sides of the box that stands for the whole space do not belong to a bounded intersection.
            row: self.body.rows[facet.row as usize].label.unwrap_or(usize::MAX),
            vertices: facet.vertices.iter().map(|vertex| *vertex as usize).collect(),
        }
    }

    /// All facets in the order of their numbers.
    pub fn facets(&self) -> impl ExactSizeIterator<Item = Facet> + '_ {
        (0..self.facet_count()).map(|number| self.facet(number))
    }

    /// The coordinates of a vertex.
    ///
    /// # Panics
    /// When there are not so many, as for slices.
    pub fn vertex(&self, number: usize) -> [Rational; D] {
        let (numerators, weight) = self.vertex_homogeneous(number);
        numerators.map(|numerator| Rational::new(numerator, weight.clone()))
    }

    /// A vertex as integers over one positive integer, not reduced.
    ///
    /// # Panics
    /// When there are not so many, as for slices.
    pub fn vertex_homogeneous(&self, number: usize) -> ([Integer; D], Integer) {
        let mut exact = self.body.vertices[number].homogeneous(&self.body.rows, D);
        let weight = std::mem::take(&mut exact[3]);
        (std::array::from_fn(|i| std::mem::take(&mut exact[i])), weight)
    }

    /// A vertex in binary64, and a bound on the error of each coordinate: 0 where all are exact, +∞ where one is beyond the range.
    ///
    /// # Panics
    /// When there are not so many, as for slices.
    pub fn vertex_approximation(&self, number: usize) -> ([f64; D], f64) {
        let point = &self.body.vertices[number].point;
        let [numerators @ .., weight] = point.coordinates.map(|x| x as f64);
        let error = point.error as f64;
        if weight > error * 64.0 {
            let coordinates: [f64; D] = std::array::from_fn(|i| numerators[i] / weight);
            let greatest = coordinates.iter().fold(0.0_f64, |greatest, x| greatest.max(x.abs()));
            // |X/W − x| ≤ error · (1 + |x|) / W for the fixed-point numbers X and W; their conversion and the quotient add at most 2^-51 |X/W|. The
            // factor is for 63/64 ≤ true over computed weight, and for the rounding here.
            let bound = 1.1 * (error * (1.0 + 1.1 * greatest) / weight + greatest * 2.0 * f64::EPSILON);
            return (coordinates, bound);
        }
        let exact = self.vertex(number);
        let coordinates = exact.each_ref().map(RationalExt::to_f64);
        let mut bound = 0.0_f64;
        for (exact, rounded) in exact.iter().zip(coordinates) {
            bound = bound.max(match Rational::from_f64(rounded) {
                None => f64::INFINITY,
                Some(value) if value == *exact => 0.0,
                // Half a unit in the last place, and half the least number below the normal ones.
                Some(_) => (rounded.abs() * f64::EPSILON).max(f64::from_bits(1)),
            });
        }
        (coordinates, bound)
    }

    /// The numbers of the facets that contain a vertex: D of them or, in space, more.
    ///
    /// # Panics
    /// When there are not so many vertices, as for slices.
    pub fn vertex_facets(&self, number: usize) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.body.vertices[number].facets.iter().map(|facet| *facet as usize)
    }

    /// The rows of the facets that contain a vertex, ascending. Rows that only touch the polytope there are not among them.
    ///
    /// # Panics
    /// When there are not so many vertices, as for slices.
    pub fn incident_rows(&self, number: usize) -> Vec<usize> {
        let mut rows: Vec<usize> = self.vertex_facets(number).map(|facet| self.facet(facet).row).collect();
        rows.sort_unstable();
        rows
    }

    /// A point of the interior: the centroid of D + 1 vertices that do not lie in one hyperplane.
    pub fn interior_point(&self) -> [Rational; D] {
        let point = self.body.interior_point();
        std::array::from_fn(|i| point[i].clone())
    }

    /// The area or volume. The fraction can be huge: some hundred bits for each vertex. See [`measure_enclosure`](Polytope::measure_enclosure).
    pub fn measure(&self) -> Rational {
        measure::measure(&self.body)
    }

    /// Two dyadic fractions, the first positive, between which the area or volume lies, and which differ by at most 2^−bits times the first.
    pub fn measure_enclosure(&self, bits: u32) -> [Rational; 2] {
        enclosure::measure(&self.body, bits)
    }
}

impl Polytope<2> {
    /// The vertices in counter-clockwise order, each with the row of the edge that leads to the next.
    pub fn cycle(&self) -> Vec<(usize, usize)> {
        let mut cycle = Vec::with_capacity(self.vertex_count());
        let mut vertex = 0;
        for _ in 0..self.vertex_count() {
            let mut edges = self.vertex_facets(vertex).map(|facet| self.facet(facet));
            if let Some(edge) = edges.find(|edge| edge.vertices[0] == vertex) {
                cycle.push((vertex, edge.row));
                vertex = edge.vertices[1];
            }
        }
        cycle
    }
}
