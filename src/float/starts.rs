//! Double normals by Newton's method from many starts: a grid on all pairs of pieces (Moore and Peters 2006), or, in the plane, the places where normals
//! followed through a Delaunay triangulation of samples meet the curve nearly at right angles (`normals.rs`).

use super::FloatError;
use super::curve::Curve;
use super::double_normal::{Location, find};
use super::normals;
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
    /// The places where the normals of samples, followed through the Delaunay triangulation of all samples, meet the curve nearly at right angles; in the
    /// plane only. `docs/float.md` says why none is missed where the samples are dense enough.
    Delaunay {
        /// Least number of intervals of each piece, 1 to 1,000; more are made where the curve turns by more than 15° in one.
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
            Starts::Delaunay { samples } => {
                check(samples, 1)?;
                normals::starts(&pieces, samples)?
            }
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

fn check(samples: usize, least: usize) -> Result<(), FloatError> {
    if (least..=1_000).contains(&samples) {
        return Ok(());
    }
    Err(FloatError::Argument {
        expected: "1, or for a grid 2, to 1,000 samples of a piece",
    })
}

fn grid(pieces: &Pieces, samples: usize) -> Result<Vec<(Location, Location)>, FloatError> {
    check(samples, 2)?;
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
