//! Convex hulls by polarity.
//!
//! With the origin in the interior of the hull, the half-spaces 1 − p·y ≥ 0 of the points p intersect in a polytope whose facets are the
//! hull's vertices and whose vertices are the hull's facets.

use std::fmt;

use super::{HalfSpace, Intersection, Polytope, intersect};
use crate::number::{Integer, Rational, RationalVector};

/// Why there is no hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HullError {
    /// The point given as interior is not in the interior of the hull.
    NotInterior,
}

impl fmt::Display for HullError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the point is not in the interior of the convex hull")
    }
}

impl std::error::Error for HullError {}

/// The vertices of the convex hull of points of the plane, as indices of points in counter-clockwise order. Of equal points the first counts; points
/// inside the hull or within an edge are left out.
///
/// # Errors
/// [`HullError::NotInterior`] when `interior` is not in the hull's interior, in particular when the hull has none.
pub fn hull2(points: &[[Rational; 2]], interior: &[Rational; 2]) -> Result<Vec<usize>, HullError> {
    // The polar of the polar is as oriented as the hull.
    Ok(polar(points, interior)?
        .cycle()
        .into_iter()
        .map(|(_, row)| row)
        .collect())
}

/// The boundary of the convex hull of points of space as triangles of indices of points, counter-clockwise seen from outside. Of equal points the first
/// counts; points inside the hull, within a facet or within an edge are left out. Facets with more than three vertices are cut into triangles.
///
/// # Errors
/// [`HullError::NotInterior`] when `interior` is not in the hull's interior, in particular when the hull has none.
pub fn hull3(points: &[[Rational; 3]], interior: &[Rational; 3]) -> Result<Vec<[usize; 3]>, HullError> {
    let polar = polar(points, interior)?;
    let mut triangles = Vec::new();
    for vertex in 0..polar.vertex_count() {
        let around = polar.facets_around(vertex);
        for pair in around[1..].windows(2) {
            triangles.push([around[0], pair[0], pair[1]].map(|facet| polar.facet(facet).row));
        }
    }
    Ok(triangles)
}

fn polar<const D: usize>(points: &[[Rational; D]], interior: &[Rational; D]) -> Result<Polytope<D>, HullError> {
    let rows: Vec<HalfSpace<D>> = points
        .iter()
        .map(|point| {
            let offset: Vec<Rational> = (0..D).map(|i| &interior[i] - &point[i]).collect();
            let integers = RationalVector::from_rationals(&offset);
            HalfSpace {
                normal: std::array::from_fn(|i| integers.numerators()[i].clone()),
                constant: Integer::clone(integers.denominator()),
            }
        })
        .collect();
    match intersect(&rows) {
        Intersection::Bounded(polytope) => Ok(polytope),
        // Around the origin all these half-spaces have an open neighbourhood in common.
        Intersection::Unbounded | Intersection::Empty | Intersection::Flat(_) => Err(HullError::NotInterior),
    }
}

impl Polytope<3> {
    /// The numbers of the facets around a vertex, counter-clockwise seen from outside.
    ///
    /// # Panics
    /// When there are not so many vertices, as for slices.
    pub fn facets_around(&self, number: usize) -> Vec<usize> {
        // Each facet with the vertices before and after this one.
        let neighbours: Vec<(usize, usize, usize)> = self
            .vertex_facets(number)
            .map(|facet| {
                let vertices = self.facet(facet).vertices;
                let length = vertices.len();
                let at = vertices.iter().position(|vertex| *vertex == number).unwrap_or(0);
                (facet, vertices[(at + length - 1) % length], vertices[(at + 1) % length])
            })
            .collect();
        let mut around = Vec::with_capacity(neighbours.len());
        let mut current = neighbours[0];
        for _ in 0..neighbours.len() {
            around.push(current.0);
            // Counter-clockwise: the facet whose edge away from the vertex is this one's edge towards it.
            if let Some(next) = neighbours.iter().find(|other| other.2 == current.1) {
                current = *next;
            }
        }
        around
    }
}
