//! A search for near points in binary64; nothing of it is trusted.

use super::ExactPiece;
use crate::number::RationalExt;

/// Samples in each direction, for curves against points.
const SAMPLES: usize = 64;
/// The same for curves against curves.
const PAIR_SAMPLES: usize = 20;
/// How many of the nearest samples are followed.
const STARTS: usize = 3;

/// The homogeneous control points of a piece, rounded.
pub(super) struct FloatPiece(Vec<[f64; 4]>);

impl FloatPiece {
    pub(super) fn new(piece: &ExactPiece) -> FloatPiece {
        let point = |exact: &Vec<crate::number::Rational>| {
            let mut point = [0.0; 4];
            let (weight, coordinates) = exact.split_last().expect("a weight");
            for (slot, x) in point.iter_mut().zip(coordinates) {
                *slot = x.to_f64();
            }
            point[3] = weight.to_f64();
            point
        };
        FloatPiece(piece.control.iter().map(point).collect())
    }

    fn point(&self, u: f64) -> [f64; 3] {
        let mut control = self.0.clone();
        for round in 1..control.len() {
            for j in 0..control.len() - round {
                for axis in 0..4 {
                    control[j][axis] = control[j][axis] * (1.0 - u) + control[j + 1][axis] * u;
                }
            }
        }
        let [x, y, z, w] = control[0];
        [x / w, y / w, z / w]
    }

    fn is_point(&self) -> bool {
        self.0.len() == 1
    }
}

/// A pair of parameters with the squared distance there.
#[derive(Clone, Copy)]
pub(super) struct Start {
    pub(super) u: f64,
    pub(super) v: f64,
    pub(super) squared: f64,
}

pub(super) fn at(a: &FloatPiece, b: &FloatPiece, u: f64, v: f64) -> Start {
    let (p, q) = (a.point(u), b.point(v));
    let squared = (0..3)
        .map(|axis| (p[axis] - q[axis]).powi(2))
        .fold(0.0, |sum, x| sum + x);
    Start { u, v, squared }
}

/// The nearest samples of a grid.
pub(super) fn starts(a: &FloatPiece, b: &FloatPiece) -> Vec<Start> {
    let (m, n) = match (a.is_point(), b.is_point()) {
        (false, false) => (PAIR_SAMPLES, PAIR_SAMPLES),
        (first, second) => (if first { 0 } else { SAMPLES }, if second { 0 } else { SAMPLES }),
    };
    let share = |i: usize, of: usize| if of == 0 { 0.0 } else { i as f64 / of as f64 };
    let mut all: Vec<Start> = (0..=m)
        .flat_map(|i| (0..=n).map(move |j| (i, j)))
        .map(|(i, j)| at(a, b, share(i, m), share(j, n)))
        .collect();
    all.sort_by(|x, y| x.squared.total_cmp(&y.squared));
    all.truncate(STARTS);
    all
}

/// Goes downhill in ever smaller steps.
pub(super) fn descend(a: &FloatPiece, b: &FloatPiece, start: Start) -> Start {
    let mut best = start;
    let mut step = 0.03;
    while step > 1e-17 {
        let mut moved = false;
        for (x, y) in [
            (1.0, 0.0),
            (-1.0, 0.0),
            (0.0, 1.0),
            (0.0, -1.0),
            (1.0, 1.0),
            (-1.0, -1.0),
            (1.0, -1.0),
            (-1.0, 1.0),
        ] {
            let next = at(
                a,
                b,
                (best.u + x * step).clamp(0.0, 1.0),
                (best.v + y * step).clamp(0.0, 1.0),
            );
            if next.squared < best.squared {
                best = next;
                moved = true;
            }
        }
        step *= if moved { 1.2 } else { 0.5 };
    }
    best
}
