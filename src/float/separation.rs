//! The minimum separation distance: branch and bound over pairs of parts of the curve, with Newton's method for upper bounds.
//!
//! A pair of parts is dropped when its hulls are farther apart than the shortest double normal known, when no chord between them can be orthogonal to
//! the tangents of one of them, or, for neighbours, when all tangents make acute angles. What is left is split, the nearest pair first. Hulls are those of
//! Bézier control points, so that the bounds converge quadratically. All of it in binary64 without rounding control: a result, not a proof.

use std::collections::BinaryHeap;

use super::FloatError;
use super::bound::Least;
use super::curve::Curve;
use super::double_normal::{Candidate, find};
use super::piece::{Pieces, middle};
use super::tree::Tree;

/// A shortest double normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
    /// Its length.
    pub distance: f64,
    /// The parameters of its two ends, the smaller one first.
    pub parameters: (f64, f64),
    /// Down to this length the search has excluded a shorter one, up to rounding: `distance` less 10⁻¹³ of it, or less where the search ended early; 0
    /// where nothing was excluded.
    pub lower: f64,
}

/// Relative width at which the search ends.
const WIDTH: f64 = 1e-13;
/// Pairs before the search ends early.
const BUDGET: usize = 300_000;
/// Relative width that a search may leave that ends early.
const GREATEST_WIDTH: f64 = 1e-6;

impl Curve {
    /// The shortest double normal: a chord between different parameters that is orthogonal to a one-sided tangent at each end (the convention `smooth` of
    /// `docs/msd.md`). Nothing when there is none, 0 when the curve meets itself. A curve whose ends coincide up to rounding is closed.
    ///
    /// # Errors
    /// [`FloatError::Budget`] when 300,000 pairs do not suffice to bring [`Separation::lower`] within 10⁻⁶ of the distance, for instance at a cusp.
    pub fn minimum_separation(&self) -> Result<Option<Separation>, FloatError> {
        let pieces = Pieces::new(self, &middle(self));
        let mut search = Search {
            tree: Tree::new(&pieces),
            pieces: &pieces,
            best: None,
            limit: f64::INFINITY,
            heap: BinaryHeap::new(),
        };
        let lower = search.run()?;
        let Some(best) = search.best else {
            return Ok(None);
        };
        let [s, t] = [best.s, best.t].map(|(piece, u)| pieces.all[piece].parameter(u));
        let distance = self.accurate_distance(s, self, t)?;
        Ok(Some(Separation {
            distance,
            parameters: (s.min(t), s.max(t)),
            lower: lower.min(distance),
        }))
    }
}

struct Search<'a> {
    tree: Tree,
    pieces: &'a Pieces,
    best: Option<Candidate>,
    /// Bounds from here on need no splitting.
    limit: f64,
    heap: BinaryHeap<Least<(u32, u32)>>,
}

impl Search<'_> {
    /// Searches until nothing shorter is left; the lower bound reached.
    fn run(&mut self) -> Result<f64, FloatError> {
        let root = self.tree.root();
        self.consider(root, root, 0.0);
        // Shorter chords are rounding of 0.
        let nothing = 8.0 * f64::EPSILON * self.pieces.scale;
        let mut budget = BUDGET;
        while let Some(Least(lower, (a, b))) = self.heap.pop() {
            if lower >= self.limit || self.limit <= nothing {
                break;
            }
            budget -= 1;
            if budget == 0 || !self.tree.can_split(a) && !self.tree.can_split(b) {
                // As for a circle, all of whose diameters are double normals.
                let near = lower.is_normal() && lower >= self.limit * (1.0 - GREATEST_WIDTH);
                return if near { Ok(lower) } else { Err(FloatError::Budget) };
            }
            self.try_newton(a, b, lower);
            self.split(a, b, lower);
        }
        Ok(self.limit)
    }

    fn split(&mut self, a: u32, b: u32, lower: f64) {
        if a == b {
            let (left, right) = self.tree.children(a);
            self.consider(left, left, lower);
            self.consider(left, right, lower);
            self.consider(right, right, lower);
        } else if self.tree.size(a) >= self.tree.size(b) && self.tree.can_split(a) || !self.tree.can_split(b) {
            let (left, right) = self.tree.children(a);
            self.consider(left, b, lower);
            self.consider(right, b, lower);
        } else {
            let (left, right) = self.tree.children(b);
            self.consider(a, left, lower);
            self.consider(a, right, lower);
        }
    }

    /// Drops a pair or keeps it for later.
    fn consider(&mut self, a: u32, b: u32, lower: f64) {
        let lower = if a == b {
            if self.tree.is_acute(a, a) {
                return;
            }
            lower
        } else if self.tree.adjacent(a, b) {
            if self.tree.is_acute(a, b) || self.tree.is_bend(a, b) {
                return;
            }
            lower
        } else {
            let lower = lower.max(self.tree.distance(a, b));
            if lower >= self.limit || self.tree.not_normal(a, b) {
                return;
            }
            lower
        };
        self.heap.push(Least(lower, (a, b)));
    }

    /// Newton's method from the middle of a pair: at every other level from those farther apart than they are large, rarely from others, which may cross.
    fn try_newton(&mut self, a: u32, b: u32, lower: f64) {
        let depth = self.tree.depth(a) + self.tree.depth(b);
        let often = if self.tree.is_far(a, b) { 2 } else { 6 };
        if a == b || lower >= 0.999_999 * self.limit || !depth.is_multiple_of(often) {
            return;
        }
        let (Some(s), Some(t)) = (self.tree.middle(a), self.tree.middle(b)) else {
            return;
        };
        if let Some(found) = find(self.pieces, s, t)
            && self.best.is_none_or(|best| found.length < best.length)
        {
            self.limit = found.length * (1.0 - WIDTH);
            self.best = Some(found);
        }
    }
}
