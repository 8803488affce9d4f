//! The sign functions in binary64, seen from a point of K: where does a ray from it leave K, and at which parameter?

use smallvec::SmallVec;

use crate::check::domain::Context;
use crate::check::polynomial::halves;
use crate::number::{Integer, Rational, RationalExt};

type Coefficients = SmallVec<[f64; 16]>;

/// A section, or a part of one, on which all coefficients at the center are positive.
struct Part {
    section: usize,
    /// Where it begins in the section, and how long it is.
    start: f64,
    width: f64,
    /// The linear part: one list of Bernstein coefficients for each axis.
    linear: Vec<Vec<f64>>,
    /// The coefficients at the center.
    center: Vec<f64>,
}

/// The sign functions as functions of x − center.
pub struct Parts(Vec<Part>);

/// Where a ray meets the boundary of K.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The point on the boundary is center + (x − center)/`ratio`; at most 0 when the ray never leaves K.
    pub ratio: f64,
    /// The number of the section.
    pub section: usize,
    /// The parameter in the section, from 0 to 1.
    pub at: f64,
}

/// A section's coefficients: at the center, then the columns of the linear part.
fn columns(context: &Context, number: usize, center: &[Integer], denominator: &Integer) -> Vec<Vec<Integer>> {
    let section = &context.sections[number];
    let mut columns = vec![section.at(center, denominator)];
    for axis in 0..context.dimension {
        let column = section.coefficients.iter().map(|c| &c.linear[axis] * denominator);
        columns.push(column.collect());
    }
    columns
}

impl Parts {
    /// From the sections that depend on x. The center must be a point of K; `None` if halving does not show that.
    pub fn new(context: &Context, center: &[Integer], denominator: &Integer) -> Option<Parts> {
        let mut parts = Vec::new();
        for number in 0..context.sections.len() {
            let whole = columns(context, number, center, denominator);
            let mut rest = vec![(whole, 0.0, 1.0)];
            while let Some((columns, start, width)) = rest.pop() {
                if columns[0].iter().all(Integer::is_positive) {
                    if columns[1..].iter().flatten().any(|x| !x.is_zero()) {
                        parts.push(Part::new(number, start, width, &columns));
                    }
                    continue;
                }
                if width < 1e-12 {
                    return None;
                }
                let (left, right) = columns.iter().map(|column| halves(column)).unzip();
                rest.push((right, start + width / 2.0, width / 2.0));
                rest.push((left, start, width / 2.0));
            }
        }
        Some(Parts(parts))
    }

    /// Where the ray from the center along `arm` leaves K first, with a ratio at most a `tolerance`th part too small.
    pub fn hit(&self, arm: &[f64], tolerance: f64) -> Hit {
        let mut best = Hit {
            ratio: 0.0,
            section: 0,
            at: 0.0,
        };
        let mut stack: Vec<(Coefficients, Coefficients, f64, f64)> = Vec::new();
        for part in &self.0 {
            let numerator: Coefficients = (0..part.center.len())
                .map(|k| {
                    -arm.iter()
                        .zip(&part.linear)
                        .map(|(y, column)| y * column[k])
                        .sum::<f64>()
                })
                .collect();
            stack.push((numerator, SmallVec::from_slice(&part.center), part.start, part.width));
            while let Some((numerator, center, start, width)) = stack.pop() {
                let last = center.len() - 1;
                for (end, at) in [(0, start), (last, start + width)] {
                    let ratio = numerator[end] / center[end];
                    if ratio > best.ratio {
                        best = Hit {
                            ratio,
                            section: part.section,
                            at,
                        };
                    }
                }
                // A quotient of polynomials with positive denominator is at most the greatest quotient of coefficients.
                let enough = best.ratio * (1.0 + tolerance) + tolerance * 1e-3;
                let within = (0..=last).all(|k| numerator[k] <= enough * center[k]);
                if within || width < 1e-14 {
                    continue;
                }
                let (left, right) = halved(&numerator);
                let (center_left, center_right) = halved(&center);
                let half = width / 2.0;
                let right = (right, center_right, start + half, half);
                let left = (left, center_left, start, half);
                // First the half that promises more.
                if promise(&left.0, &left.1) > promise(&right.0, &right.1) {
                    stack.extend([right, left]);
                } else {
                    stack.extend([left, right]);
                }
            }
        }
        best
    }
}

fn promise(numerator: &[f64], center: &[f64]) -> f64 {
    let ratios = numerator.iter().zip(center).map(|(p, q)| p / q);
    ratios.fold(f64::NEG_INFINITY, f64::max)
}

fn halved(coefficients: &[f64]) -> (Coefficients, Coefficients) {
    let mut right: Coefficients = SmallVec::from_slice(coefficients);
    let mut left = Coefficients::with_capacity(coefficients.len());
    for round in (0..coefficients.len()).rev() {
        left.push(right[0]);
        for k in 0..round {
            right[k] = (right[k] + right[k + 1]) / 2.0;
        }
    }
    // right[k] holds the k-th point of round n − k: the right half as it is.
    (left, right)
}

impl Part {
    fn new(section: usize, start: f64, width: f64, columns: &[Vec<Integer>]) -> Part {
        let greatest = columns.iter().flatten().map(Integer::abs).max().unwrap_or(Integer::ONE);
        let float = |column: &Vec<Integer>| {
            let scaled = column
                .iter()
                .map(|x| Rational::new(x.clone(), greatest.clone()).to_f64());
            scaled.collect()
        };
        Part {
            section,
            start,
            width,
            linear: columns[1..].iter().map(float).collect(),
            center: float(&columns[0]),
        }
    }
}
