//! The criteria of CPIJ14 and of ½ν, frame by frame.

use super::polynomial_pieces;
use crate::check::motion::{Criteria, Greatests, Positions, Shape, note, nu_squared};
use crate::claim::motion::{Criteria as Stated, FirstFailures, HalfNu, Move};
use crate::curve::{Curve, Form};
use crate::motion::Motion;
use crate::number::{Integer, Rational};

/// The values at a frame. Euclidean norms are squared, so that all are exact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Measures {
    /// The number of the frame, from 0.
    pub frame: u64,
    /// The greatest second difference ‖Δ₂P_k‖ of control points of a piece, in the norm of greatest coordinates, and squared in the Euclidean one.
    pub second: [Rational; 2],
    /// The greatest N∞(n)·‖Δ₂P_k‖, and the greatest displacement of an own control point since time 0.
    pub greatest: Greatests,
    /// What CPIJ14 print, in the ∞-norm: the greatest ‖Δ₂P_k‖, without N∞, plus the displacement of the point that attains it. Of curves given as polynomial Bézier pieces.
    pub as_printed: Option<Rational>,
}

/// When the criterion as printed first fails.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AsPrinted {
    /// Is it evaluated at all?
    pub evaluated: bool,
    /// The first frame at which it fails, if there is one.
    pub first: Option<u64>,
}

/// Evaluates the criteria at every frame.
pub struct Measurer<'m> {
    shape: Shape<'m>,
    criteria: Criteria,
    stated: Stated,
    curve: &'m Curve,
    denominator: &'m Integer,
    start: Positions,
    as_printed: AsPrinted,
    kept: Vec<Measures>,
    most: u64,
}

impl<'m> Measurer<'m> {
    /// The criteria at time 0; `None` if a piece is rational.
    pub fn new(
        motion: &'m Motion,
        polygon: &Curve,
        positions: &Positions,
        tolerance: &Rational,
        most: u64,
    ) -> Option<Self> {
        let mut shape = Shape::new(&motion.curve);
        let criteria = Criteria::new(&mut shape, positions, &motion.denominator)?;
        let nu_squared = nu_squared(&Shape::new(polygon), positions, &motion.denominator);
        let mut measurer = Measurer {
            shape,
            criteria,
            stated: Stated {
                display_tolerance: tolerance.clone(),
                second_differences: FirstFailures::default(),
                half_nu: nu_squared.map(|nu_squared| HalfNu {
                    nu_squared,
                    failures: FirstFailures::default(),
                }),
            },
            curve: &motion.curve,
            denominator: &motion.denominator,
            start: positions.clone(),
            as_printed: AsPrinted {
                evaluated: polynomial_pieces(&motion.curve),
                first: None,
            },
            kept: Vec::new(),
            most,
        };
        measurer.note(positions, 0);
        Some(measurer)
    }

    /// Takes account of a move, which led to these positions at this frame.
    pub fn update(&mut self, positions: &Positions, displacements: &Move, frame: u64) {
        self.criteria.update(&self.shape, positions, displacements);
        self.note(positions, frame);
    }

    fn note(&mut self, positions: &Positions, frame: u64) {
        let greatest = self.criteria.greatest();
        let tolerance = &self.stated.display_tolerance;
        note(&mut self.stated.second_differences, greatest.reach(tolerance), frame);
        if let Some(half_nu) = &mut self.stated.half_nu {
            note(&mut half_nu.failures, greatest.reach_half(&half_nu.nu_squared), frame);
        }
        let keep = frame < self.most;
        let look = self.as_printed.evaluated && (keep || self.as_printed.first.is_none());
        let as_printed = look.then(|| as_printed(self.curve, &self.start, positions, self.denominator));
        if let Some(value) = &as_printed
            && self.as_printed.first.is_none()
            && value >= tolerance
        {
            self.as_printed.first = Some(frame);
        }
        if keep {
            let second = self.criteria.unweighted();
            self.kept.push(Measures {
                frame,
                second: second.map(|found| found.map(|(value, _)| value).unwrap_or_default()),
                greatest,
                as_printed,
            });
        }
    }

    /// What the statement says, the values kept, and the criterion as printed.
    pub fn finish(self) -> (Option<Stated>, Vec<Measures>, AsPrinted) {
        (Some(self.stated), self.kept, self.as_printed)
    }
}

/// The greatest second difference inside a piece plus the displacement of its middle point, both in the ∞-norm; where several points attain it, the greatest sum.
fn as_printed(curve: &Curve, start: &Positions, positions: &Positions, denominator: &Integer) -> Rational {
    let Form::Bezier(pieces) = curve.form() else {
        return Rational::default();
    };
    let norm = |v: [Integer; 3]| v.into_iter().map(|x| x.abs()).max().unwrap_or_default();
    let mut best: Option<(Integer, Integer)> = None;
    let mut first = 0;
    for piece in pieces {
        for k in first + 1..first + piece.degree() {
            let [p, q, r] = [k - 1, k, k + 1].map(|place| positions.get(place));
            let second = norm(std::array::from_fn(|axis| &p[axis] - &q[axis] - &q[axis] + &r[axis]));
            if best.as_ref().is_some_and(|(known, _)| second < *known) {
                continue;
            }
            let q_start = start.get(k);
            let moved = norm(std::array::from_fn(|axis| &q[axis] - &q_start[axis]));
            if best.as_ref().is_none_or(|best| (&second, &moved) > (&best.0, &best.1)) {
                best = Some((second, moved));
            }
        }
        first += piece.degree();
    }
    let (second, moved) = best.unwrap_or_default();
    Rational::new(second + moved, denominator.clone())
}
