//! The moving control polygon of Cassidy, Peters, Ilies and Jordan (2014): second differences kept up to date as points move.
//!
//! A composite Bézier curve of pieces of degree d has the polygon p_0 … p_w, w a multiple of d; the joints are p_d, p_{2d}, …. The polygon drawn at
//! the start stays within ‖Δ₂X‖·N∞(d) + max_k ‖Σ_j γ_{k,j}‖ of the moved curve.

use super::FloatError;
use super::cassidy::polygon_constant;
use super::piece::{Vector, dot};

/// A polygon, how far its points have moved, and its second differences.
#[derive(Debug, Clone)]
pub struct MovingPolygon {
    degree: usize,
    closed: bool,
    points: Vec<Vector>,
    /// Σ_j γ_{k,j}.
    displacements: Vec<Vector>,
    /// Δ₂ inside pieces; 0 at joints and ends.
    differences: Vec<Vector>,
    /// The greatest ‖Δ₂‖² and where it is.
    greatest: (f64, usize),
}

/// How far the polygon drawn at the start may be from the curve now.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// ‖Δ₂X‖, the greatest length of a second difference inside a piece.
    pub second_difference: f64,
    /// The greatest displacement of a control point.
    pub displacement: f64,
    /// N∞(d)·‖Δ₂X‖ + the greatest displacement.
    pub bound: f64,
    /// What the paper compares with ε_d in its example: ‖Δ₂X‖ + the displacement of the point that attains it.
    pub printed: f64,
}

impl MovingPolygon {
    /// A polygon of pieces of degree `degree`, with z = 0 in the plane. With `closed`, the last point is the first one and the closing joint is a joint.
    ///
    /// # Errors
    /// [`FloatError::Argument`] when the degree is 0 or above 64, the points are not a multiple of the degree and one more, or, with `closed`, the ends
    /// differ; [`FloatError::Range`] for numbers that are not finite.
    pub fn new(degree: usize, closed: bool, points: Vec<[f64; 3]>) -> Result<MovingPolygon, FloatError> {
        let expected = "pieces of degree 1 to 64, ends that agree on a closed polygon";
        let fits = (1..=64).contains(&degree) && points.len() > degree && (points.len() - 1).is_multiple_of(degree);
        if !fits || closed && points[0] != points[points.len() - 1] {
            return Err(FloatError::Argument { expected });
        }
        if points.iter().flatten().any(|x| !x.is_finite()) {
            return Err(FloatError::Range { place: "points" });
        }
        let count = points.len();
        let mut polygon = MovingPolygon {
            degree,
            closed,
            displacements: vec![[0.0; 3]; count],
            differences: vec![[0.0; 3]; count],
            points,
            greatest: (0.0, 0),
        };
        for k in 0..count {
            if !polygon.is_joint_or_end(k) {
                let p = &polygon.points;
                polygon.differences[k] = std::array::from_fn(|i| p[k - 1][i] - 2.0 * p[k][i] + p[k + 1][i]);
            }
        }
        polygon.find_greatest();
        Ok(polygon)
    }

    /// The points now.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The second differences now: 0 at joints and ends.
    pub fn second_differences(&self) -> &[[f64; 3]] {
        &self.differences
    }

    /// The bounds now.
    pub fn drift(&self) -> Drift {
        let norm = |x: &Vector| dot(x, x).sqrt();
        let second_difference = self.greatest.0.sqrt();
        let displacement = self.displacements.iter().map(norm).fold(0.0, f64::max);
        Drift {
            second_difference,
            displacement,
            bound: polygon_constant(self.degree) * second_difference + displacement,
            printed: second_difference + norm(&self.displacements[self.greatest.1]),
        }
    }

    /// Moves points each by its own vector, and nothing else (§5 of the paper). A point named twice moves by the sum.
    ///
    /// # Errors
    /// [`FloatError::Argument`] for an index out of range, [`FloatError::Range`] for a vector that is not finite; nothing is moved then.
    pub fn step(&mut self, moves: &[(usize, [f64; 3])]) -> Result<(), FloatError> {
        let moves = self.collected(moves)?;
        self.displace(&moves);
        Ok(())
    }

    /// Moves points so that a C¹ curve stays C¹ (§6): next to a joint (type 1) the joint moves to the middle of its neighbours, a joint (type 2) takes its
    /// neighbours with it, other points (type 3) move alone. The pieces must have equal parameter lengths and start C¹.
    ///
    /// # Errors
    /// As for [`MovingPolygon::step`].
    pub fn smooth_step(&mut self, moves: &[(usize, [f64; 3])]) -> Result<(), FloatError> {
        let moves = self.collected(moves)?;
        let mut all: Vec<(usize, Vector)> = Vec::new();
        let mut joints: Vec<usize> = Vec::new();
        for (k, vector) in moves {
            if let Some((before, after)) = self.joint_neighbours(k) {
                all.extend([(before, vector), (after, vector)]);
                joints.push(k);
            } else {
                all.push((k, vector));
                joints.extend(
                    [k.wrapping_sub(1), k + 1]
                        .into_iter()
                        .filter(|j| self.joint_neighbours(*j).is_some()),
                );
            }
        }
        let mut all = self.collected(&all)?;
        joints.sort_unstable();
        joints.dedup();
        let moved =
            |all: &[(usize, Vector)], k: usize| all.binary_search_by_key(&k, |m| m.0).map_or([0.0; 3], |i| all[i].1);
        let mut middles = Vec::new();
        for joint in joints {
            let Some((before, after)) = self.joint_neighbours(joint) else {
                continue;
            };
            let (a, b) = (moved(&all, before), moved(&all, after));
            middles.push((joint, std::array::from_fn(|i| (a[i] + b[i]) / 2.0)));
        }
        all.extend(middles);
        let all = self.collected(&all)?;
        self.displace(&all);
        Ok(())
    }

    /// Moves in order of the points, one for each; the two ends of a closed polygon alike.
    fn collected(&self, moves: &[(usize, Vector)]) -> Result<Vec<(usize, Vector)>, FloatError> {
        let last = self.points.len() - 1;
        let mut all: Vec<(usize, Vector)> = Vec::with_capacity(moves.len());
        for (k, vector) in moves {
            if *k > last {
                return Err(FloatError::Argument {
                    expected: "indices of control points",
                });
            }
            if vector.iter().any(|x| !x.is_finite()) {
                return Err(FloatError::Range { place: "moves" });
            }
            all.push((if self.closed && *k == last { 0 } else { *k }, *vector));
        }
        all.sort_by_key(|m| m.0);
        let mut result: Vec<(usize, Vector)> = Vec::with_capacity(all.len());
        for (k, vector) in all {
            match result.last_mut() {
                Some((same, sum)) if *same == k => *sum = std::array::from_fn(|i| sum[i] + vector[i]),
                _ => result.push((k, vector)),
            }
        }
        if self.closed && result.first().is_some_and(|m| m.0 == 0) {
            result.push((last, result[0].1));
        }
        Ok(result)
    }

    /// Whether a second difference is not taken here.
    fn is_joint_or_end(&self, k: usize) -> bool {
        k.is_multiple_of(self.degree)
    }

    /// The neighbours of a joint.
    fn joint_neighbours(&self, k: usize) -> Option<(usize, usize)> {
        let last = self.points.len() - 1;
        if k > last || !self.is_joint_or_end(k) {
            return None;
        }
        match (k == 0 || k == last, self.closed) {
            (false, _) => Some((k - 1, k + 1)),
            (true, true) => Some((last - 1, 1)),
            (true, false) => None,
        }
    }

    /// Applies moves in order of the points, chain by chain of neighbours: a chain of one changes three second differences, one of u points u + 2.
    fn displace(&mut self, moves: &[(usize, Vector)]) {
        let mut rescan = false;
        for chain in moves.chunk_by(|a, b| a.0 + 1 == b.0) {
            let (first, last) = (chain[0].0, chain[chain.len() - 1].0);
            for (k, vector) in chain {
                for i in 0..3 {
                    self.points[*k][i] += vector[i];
                    self.displacements[*k][i] += vector[i];
                }
            }
            for k in first.saturating_sub(1)..=(last + 1).min(self.points.len() - 1) {
                if self.is_joint_or_end(k) {
                    continue;
                }
                let at = |j: usize| {
                    if (first..=last).contains(&j) {
                        chain[j - first].1
                    } else {
                        [0.0; 3]
                    }
                };
                let (before, own, after) = (at(k.wrapping_sub(1)), at(k), at(k + 1));
                for i in 0..3 {
                    self.differences[k][i] += before[i] - 2.0 * own[i] + after[i];
                }
                let square = dot(&self.differences[k], &self.differences[k]);
                if square >= self.greatest.0 {
                    self.greatest = (square, k);
                } else if k == self.greatest.1 {
                    // It has become smaller: another one may be the greatest now.
                    rescan = true;
                }
            }
        }
        if rescan {
            self.find_greatest();
        }
    }

    fn find_greatest(&mut self) {
        self.greatest = (0.0, 0);
        for (k, x) in self.differences.iter().enumerate() {
            let square = dot(x, x);
            if square > self.greatest.0 {
                self.greatest = (square, k);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::float::generate::Random;
    use proptest::prelude::*;

    /// Experiment 1 of the paper: control points from (0, 6) to (25, 3) and their reflection in y = 3.
    fn experiment() -> Vec<Vector> {
        let half = [
            (0.0, 6.0),
            (1.0, 5.0),
            (2.0, 4.5),
            (3.0, 5.25),
            (4.0, 6.0),
            (5.0, 7.0),
            (6.0, 8.0),
            (7.0, 9.0),
            (9.0, 10.0),
            (11.0, 11.0),
            (13.0, 12.0),
            (15.0, 13.0),
            (17.0, 13.35),
            (19.0, 13.7),
            (21.0, 13.0),
            (22.0, 12.0),
            (23.0, 11.0),
            (24.0, 10.0),
            (24.5, 8.0),
            (25.0, 6.0),
            (25.0, 4.0),
            (25.0, 3.0),
        ];
        let mirrored = half.iter().rev().skip(1).map(|(x, y)| (*x, 6.0 - y));
        half.iter().copied().chain(mirrored).map(|(x, y)| [x, y, 0.0]).collect()
    }

    #[test]
    fn the_experiment_starts_within_5_12() {
        let polygon = MovingPolygon::new(3, false, experiment()).unwrap();
        // "The maximal distance between the curve and the control polygon is 5/12": that is N∞(3)·5/4, from Δ₂ at (24, 10) … (24.5, 8).
        let drift = polygon.drift();
        assert_eq!(drift.displacement, 0.0);
        assert!((drift.bound - drift.second_difference / 3.0).abs() < 1e-15);
    }

    #[test]
    fn a_joint_takes_its_neighbours_along() {
        let mut polygon = MovingPolygon::new(3, false, experiment()).unwrap();
        polygon.smooth_step(&[(3, [0.0, -1.0, 0.0])]).unwrap();
        assert_eq!(
            polygon.points()[2..5].iter().map(|p| p[1]).collect::<Vec<_>>(),
            [3.5, 4.25, 5.0]
        );
        polygon.smooth_step(&[(2, [0.0, 1.0, 0.0])]).unwrap();
        assert_eq!(
            polygon.points()[2..5].iter().map(|p| p[1]).collect::<Vec<_>>(),
            [4.5, 4.75, 5.0]
        );
        assert_eq!(polygon.points()[..2], experiment()[..2]);
        assert!(polygon.smooth_step(&[(99, [0.0; 3])]).is_err());
        assert!(polygon.step(&[(1, [f64::NAN, 0.0, 0.0])]).is_err());
    }

    proptest! {
        #[test]
        fn what_is_kept_is_what_would_be_computed(seed: u64) {
            let mut random = Random(seed);
            let (degree, pieces, closed) = (1 + random.below(4), 1 + random.below(4), random.below(2) == 0);
            let count = degree * pieces + 1;
            let mut points: Vec<Vector> =
                (0..count).map(|_| std::array::from_fn(|_| random.below(65) as f64 / 8.0)).collect();
            if closed {
                points[count - 1] = points[0];
            }
            let mut polygon = MovingPolygon::new(degree, closed, points.clone()).unwrap();
            for _ in 0..6 {
                let moves: Vec<(usize, Vector)> = (0..random.below(5))
                    .map(|_| (random.below(count), std::array::from_fn(|_| random.below(17) as f64 / 16.0 - 0.5)))
                    .collect();
                if random.below(2) == 0 {
                    polygon.step(&moves).unwrap();
                } else {
                    polygon.smooth_step(&moves).unwrap();
                }
            }
            // All numbers are small multiples of a power of two: sums are exact.
            let fresh = MovingPolygon::new(degree, closed, polygon.points().to_vec()).unwrap();
            prop_assert_eq!(fresh.second_differences(), polygon.second_differences());
            prop_assert_eq!(fresh.drift().second_difference, polygon.drift().second_difference);
            for (k, point) in polygon.points().iter().enumerate() {
                for i in 0..3 {
                    prop_assert_eq!(points[k][i] + polygon.displacements[k][i], point[i]);
                }
            }
        }
    }
}
