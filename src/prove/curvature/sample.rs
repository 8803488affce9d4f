//! Where the curvature is greatest among samples, in binary64.

use rayon::prelude::*;

use crate::curve::Bezier;
use crate::number::{Integer, Rational, RationalExt};

/// Samples between the ends of a piece, for each degree and one more.
const SAMPLES: usize = 8;

/// The piece and the local parameter of the greatest of all samples; piece 0 and 1/2 when none is finite.
pub fn greatest(pieces: &[Bezier]) -> (usize, Rational) {
    let best = pieces
        .par_iter()
        .enumerate()
        .map(|(i, piece)| {
            let count = SAMPLES * (piece.degree() + 1);
            let control = Control::new(piece);
            let values = (0..=count).map(|k| (control.squared(k as f64 / count as f64), k));
            let (value, k) = values.fold((f64::NEG_INFINITY, 0), |a, b| if b.0 > a.0 { b } else { a });
            (value, i, k, count)
        })
        .reduce(
            || (f64::NEG_INFINITY, usize::MAX, 1, 2),
            // The first of equal ones, in whatever order they come.
            |a, b| if b.0 > a.0 || b.0 == a.0 && b.1 < a.1 { b } else { a },
        );
    match best {
        (_, usize::MAX, ..) => (0, Rational::new(Integer::ONE, Integer::from(2))),
        (_, piece, k, count) => (piece, Rational::new(Integer::from(k), Integer::from(count))),
    }
}

/// Homogeneous control points, relative to the first.
pub struct Control(Vec<[f64; 4]>);

impl Control {
    /// Those of a piece.
    pub fn new(piece: &Bezier) -> Control {
        let d = piece.dimension();
        let first = piece.point(0);
        let weights = piece.weights().map(|weights| weights.to_f64s());
        let control = (0..=piece.degree()).map(|k| {
            let weight = weights.as_ref().map_or(1.0, |weights| weights[k]);
            let mut homogeneous = [0.0, 0.0, 0.0, weight];
            for (axis, (x, origin)) in piece.point(k).iter().zip(&first).enumerate().take(d) {
                homogeneous[axis] = (x - origin).to_f64() * weight;
            }
            homogeneous
        });
        Control(control.collect())
    }

    /// c' and c''.
    fn derivatives(&self, u: f64) -> [[f64; 3]; 2] {
        let n = self.0.len() - 1;
        let mut row = self.0.clone();
        let combine = |a: f64, p: &[f64; 4], b: f64, q: &[f64; 4]| [0, 1, 2, 3].map(|i| a * p[i] + b * q[i]);
        let zero = [0.0; 4];
        let (mut first, mut second) = (zero, zero);
        for rest in (0..=n).rev() {
            if rest == 2 {
                let twice = combine(-2.0, &row[1], 1.0, &row[2]);
                second = combine((n * (n - 1)) as f64, &combine(1.0, &row[0], 1.0, &twice), 0.0, &zero);
            }
            if rest == 1 {
                first = combine(-(n as f64), &row[0], n as f64, &row[1]);
            }
            for k in 0..rest {
                row[k] = combine(1.0 - u, &row[k], u, &row[k + 1]);
            }
        }
        let (point, weight) = (row[0], row[0][3]);
        let velocity = [0, 1, 2].map(|i| (first[i] - first[3] * point[i] / weight) / weight);
        let acceleration =
            [0, 1, 2].map(|i| (second[i] - 2.0 * first[3] * velocity[i] - second[3] * point[i] / weight) / weight);
        [velocity, acceleration]
    }

    /// |c'|².
    pub fn speed(&self, u: f64) -> f64 {
        self.derivatives(u)[0].iter().map(|x| x * x).sum()
    }

    /// κ².
    fn squared(&self, u: f64) -> f64 {
        let [v, a] = self.derivatives(u);
        let cross = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| v[i] * a[j] - v[j] * a[i]);
        let bend: f64 = cross.iter().map(|x| x * x).sum();
        let speed: f64 = v.iter().map(|x| x * x).sum();
        bend / (speed * speed * speed)
    }
}
