//! The two methods of Moore and Peters (2006) for the global separation, as they print them.
//!
//! Both sample every Bézier piece at 1/n, …, (n − 1)/n and keep the chords that pass the doubly normal test (10), (11). The one calls the shortest of
//! them the result, with n in the thousands; the other starts Newton's method from each, with n = 10. Neither bounds its error; the engine's own
//! method is [`Curve::minimum_separation`].

use super::FloatError;
use super::curve::Curve;
use super::double_normal::step;
use super::piece::{Piece, Pieces, Vector, dot, middle, sub};
use super::separation::Separation;

/// How the products of the doubly normal test are compared with ε₁ and ε₂.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// As printed, without an absolute value: strongly negative products pass.
    Printed,
    /// Their magnitudes.
    Magnitude,
}

/// The parameters of the doubly normal test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoublyNormalTest {
    /// The number n of intervals of every piece, at least 2.
    pub samples: usize,
    /// ε₁ of inequality (10).
    pub first: f64,
    /// ε₂ of inequality (11).
    pub second: f64,
    /// How the products are compared.
    pub comparison: Comparison,
}

/// What a method found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// The shortest chord with the parameters of its ends, or nothing when none was found.
    pub separation: Option<Separation>,
    /// The chords that passed the doubly normal test: for Newton's method, its starts.
    pub starts: usize,
}

/// A sample: piece, local parameter, point and unit tangent.
struct Sample {
    piece: usize,
    u: f64,
    point: Vector,
    tangent: Vector,
}

impl DoublyNormalTest {
    /// The test on the chord from p to q.
    fn passes(&self, p: &Sample, q: &Sample) -> Option<f64> {
        let x = sub(&q.point, &p.point);
        let square = dot(&x, &x);
        // Compared as squares: nearly all chords fail, and need no root.
        let below = |product: f64, limit: f64| {
            let small = product * product < limit * limit * square;
            match self.comparison {
                Comparison::Printed => small || product < 0.0,
                Comparison::Magnitude => small,
            }
        };
        let passes = square > 0.0 && below(dot(&x, &p.tangent), self.first) && below(-dot(&x, &q.tangent), self.second);
        passes.then(|| square.sqrt())
    }

    fn samples(&self, pieces: &Pieces) -> Result<Vec<Sample>, FloatError> {
        if self.samples < 2 || self.samples > 100_000 {
            return Err(FloatError::Argument {
                expected: "2 to 100,000 samples",
            });
        }
        let mut all = Vec::with_capacity(self.samples * pieces.all.len());
        for (i, piece) in pieces.all.iter().enumerate() {
            for k in 1..self.samples {
                let u = k as f64 / self.samples as f64;
                let [point, first, _] = piece.evaluate(u);
                let speed = dot(&first, &first).sqrt();
                if speed == 0.0 {
                    return Err(FloatError::Irregular);
                }
                all.push(Sample {
                    piece: i,
                    u,
                    point,
                    tangent: first.map(|x| x / speed),
                });
            }
        }
        Ok(all)
    }
}

impl Curve {
    /// The shortest chord that passes the doubly normal test, all pairs of samples tried in both orders ("Initial Estimate Algorithm").
    ///
    /// # Errors
    /// [`FloatError::Argument`] for a number of samples outside 2 … 100,000; [`FloatError::Irregular`] where the derivative vanishes at a sample.
    pub fn sampled_separation(&self, test: &DoublyNormalTest) -> Result<Found, FloatError> {
        let pieces = Pieces::new(self, &middle(self));
        let samples = test.samples(&pieces)?;
        let mut best: Option<(f64, usize, usize)> = None;
        let mut starts = 0;
        for (i, p) in samples.iter().enumerate() {
            for (j, q) in samples.iter().enumerate().skip(i + 1) {
                for length in [test.passes(p, q), test.passes(q, p)].into_iter().flatten() {
                    starts += 1;
                    if best.is_none_or(|best| length < best.0) {
                        best = Some((length, i, j));
                    }
                }
            }
        }
        let separation = best.map(|(distance, i, j)| {
            let [s, t] = [i, j].map(|k| pieces.all[samples[k].piece].parameter(samples[k].u));
            Separation {
                distance,
                parameters: (s, t),
                lower: 0.0,
            }
        });
        Ok(Found { separation, starts })
    }

    /// The shortest double normal that Newton's method finds from the chords that pass the test, until a step is shorter than `tolerance` (the paper
    /// takes 10⁻⁴ and n = 10, ε₁ = ε₂ = 0.4). Iterations stay on the two pieces they start on; one that leaves them is given up.
    ///
    /// # Errors
    /// As for [`Curve::sampled_separation`], and [`FloatError::Argument`] when `tolerance` is not positive.
    pub fn newton_separation(&self, test: &DoublyNormalTest, tolerance: f64) -> Result<Found, FloatError> {
        if tolerance <= 0.0 || tolerance.is_nan() {
            return Err(FloatError::Argument {
                expected: "a positive tolerance",
            });
        }
        let pieces = Pieces::new(self, &middle(self));
        let samples = test.samples(&pieces)?;
        let mut found = Found {
            separation: None,
            starts: 0,
        };
        for (i, p) in samples.iter().enumerate() {
            for q in &samples[i + 1..] {
                if test.passes(p, q).is_none() && test.passes(q, p).is_none() {
                    continue;
                }
                found.starts += 1;
                let (one, two) = (&pieces.all[p.piece], &pieces.all[q.piece]);
                let Some((u, v, distance)) = newton(one, two, (p.u, q.u), tolerance, p.piece == q.piece) else {
                    continue;
                };
                if found.separation.is_none_or(|best| distance < best.distance) {
                    found.separation = Some(Separation {
                        distance,
                        parameters: (one.parameter(u), two.parameter(v)),
                        lower: 0.0,
                    });
                }
            }
        }
        Ok(found)
    }
}

/// Equations (3) to (9) on two pieces.
fn newton(a: &Piece, b: &Piece, start: (f64, f64), tolerance: f64, same: bool) -> Option<(f64, f64, f64)> {
    let (mut u, mut v) = start;
    for _ in 0..50 {
        let ([p, p1, p2], [q, q1, q2]) = (a.evaluate(u), b.evaluate(v));
        let x = sub(&p, &q);
        let cross = dot(&p1, &q1);
        let jacobian = [
            [dot(&p1, &p1) + dot(&x, &p2), -cross],
            [cross, dot(&x, &q2) - dot(&q1, &q1)],
        ];
        let speeds = [dot(&p1, &p1).sqrt(), dot(&q1, &q1).sqrt()];
        let [du, dv] = step(&jacobian, [dot(&x, &p1), dot(&x, &q1)], speeds);
        (u, v) = (u - du, v - dv);
        if !(0.0..=1.0).contains(&u) || !(0.0..=1.0).contains(&v) {
            return None;
        }
        if du.hypot(dv) < tolerance {
            let x = sub(&a.evaluate(u)[0], &b.evaluate(v)[0]);
            let distance = dot(&x, &x).sqrt();
            // On one piece the iteration may end in a point with itself.
            let trivial = same && (u - v).abs() < 10.0 * tolerance;
            return (!trivial).then_some((u, v, distance));
        }
    }
    None
}
