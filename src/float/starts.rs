//! Double normals by Newton's method from many starts: a grid on all pairs of pieces (Moore and Peters 2006), or, in the plane, the Delaunay edges of
//! sample points.
//!
//! Samples that are Delaunay neighbours without being neighbours on the curve face each other across its medial axis: the dual of such an edge is a part of
//! the Voronoi diagram, which tends to the medial axis as samples get denser (Amenta and Bern 1998). That gives about one start for each stretch of two
//! strands that face each other, in place of a start for each pair of samples. A double normal with another strand between its ends has no such edge and is
//! missed, now and then even the shortest one (`docs/float.md` has counts): these are good first guesses, not a search.

use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::FloatError;
use super::curve::Curve;
use super::double_normal::{Location, find};
use super::piece::{Pieces, middle};
use super::separation::Separation;

/// Where Newton's method starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Starts {
    /// All pairs of the points 1/n, …, (n − 1)/n of all pieces.
    Grid {
        /// The number n, 2 to 1,000.
        samples: usize,
    },
    /// The Delaunay edges between sample points that are not neighbours on the curve; in the plane only.
    Delaunay {
        /// Samples of each piece, 2 to 1,000.
        samples: usize,
    },
}

/// Double normals found, the shortest first, and the starts it took.
#[derive(Debug, Clone, PartialEq)]
pub struct DoubleNormals {
    /// Those whose parameters differ by more than 10⁻⁶ of a piece.
    pub found: Vec<Separation>,
    /// How often Newton's method was started.
    pub starts: usize,
}

/// A sample and its number along the curve.
struct Sample {
    position: Point2<f64>,
    number: usize,
}

impl HasPosition for Sample {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        self.position
    }
}

impl Curve {
    /// The double normals that Newton's method finds from the given starts. There may be others.
    ///
    /// # Errors
    /// [`FloatError::Argument`] for a number of samples outside its range or more than 20,000,000 starts; [`FloatError::Dimension`] for Delaunay starts
    /// in space.
    pub fn double_normals(&self, starts: Starts) -> Result<DoubleNormals, FloatError> {
        let pieces = Pieces::new(self, &middle(self));
        let pairs = match starts {
            Starts::Grid { samples } => grid(&pieces, samples)?,
            Starts::Delaunay { .. } if self.dimension != 2 => return Err(FloatError::Dimension),
            Starts::Delaunay { samples } => delaunay(&pieces, samples)?,
        };
        let mut found = Vec::new();
        for (s, t) in &pairs {
            found.extend(find(&pieces, *s, *t));
        }
        found.sort_by(|a, b| a.length.total_cmp(&b.length));
        let at = |(piece, u): Location| piece as f64 + u;
        let period = pieces.all.len() as f64;
        let near = |a: Location, b: Location| {
            let apart = (at(a) - at(b)).abs();
            apart < 1e-6 || pieces.closed && period - apart < 1e-6
        };
        let mut distinct: Vec<super::double_normal::Candidate> = Vec::new();
        for candidate in found {
            // Those of about the same length stand together.
            let recent = distinct
                .iter()
                .rev()
                .take_while(|old| old.length > candidate.length * (1.0 - 1e-9));
            let same = |old: &super::double_normal::Candidate| {
                near(old.s, candidate.s) && near(old.t, candidate.t)
                    || near(old.s, candidate.t) && near(old.t, candidate.s)
            };
            if !recent.clone().any(same) {
                distinct.push(candidate);
            }
        }
        let found = distinct
            .iter()
            .map(|candidate| {
                let [s, t] = [candidate.s, candidate.t].map(|(piece, u)| pieces.all[piece].parameter(u));
                Separation {
                    distance: candidate.length,
                    parameters: (s.min(t), s.max(t)),
                    lower: 0.0,
                }
            })
            .collect();
        let starts = pairs.len();
        Ok(DoubleNormals { found, starts })
    }
}

fn check(samples: usize) -> Result<(), FloatError> {
    if (2..=1_000).contains(&samples) {
        return Ok(());
    }
    Err(FloatError::Argument {
        expected: "2 to 1,000 samples of a piece",
    })
}

fn grid(pieces: &Pieces, samples: usize) -> Result<Vec<(Location, Location)>, FloatError> {
    check(samples)?;
    let count = pieces.all.len() * (samples - 1);
    if count * count / 2 > 20_000_000 {
        return Err(FloatError::Argument {
            expected: "samples that make at most 20,000,000 starts",
        });
    }
    let place = |i: usize| (i / (samples - 1), (i % (samples - 1) + 1) as f64 / samples as f64);
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
    Ok(pairs.map(|(i, j)| (place(i), place(j))).collect())
}

fn delaunay(pieces: &Pieces, samples: usize) -> Result<Vec<(Location, Location)>, FloatError> {
    check(samples)?;
    let count = pieces.all.len() * samples;
    // In the middle of each interval: no sample is a joint.
    let place = |i: usize| {
        (
            i / samples,
            (i % samples) as f64 / samples as f64 + 0.5 / samples as f64,
        )
    };
    let all = (0..count)
        .map(|number| {
            let (piece, u) = place(number);
            let [point, ..] = pieces.all[piece].evaluate(u);
            let position = Point2::new(point[0], point[1]);
            Sample { position, number }
        })
        .collect();
    let range = FloatError::Range { place: "points" };
    let triangulation = DelaunayTriangulation::<Sample>::bulk_load(all).map_err(|_| range)?;
    let mut pairs = Vec::new();
    for edge in triangulation.undirected_edges() {
        let [a, b] = edge.vertices().map(|vertex| vertex.data().number);
        let apart = a.abs_diff(b);
        if apart > 1 && !(pieces.closed && apart == count - 1) {
            pairs.push((place(a.min(b)), place(a.max(b))));
        }
    }
    Ok(pairs)
}
