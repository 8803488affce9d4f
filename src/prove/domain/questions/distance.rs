//! Distances to the planes h_t = 0: where is the nearest one?

use crate::check::domain::Context;
use crate::check::domain::sign::Section;
use crate::check::polynomial::{self, Bound, NotShown, scaled_product, unscaled};
use crate::number::{Integer, Rational, RationalExt, RationalVector};

/// Samples of a section for each coefficient.
const SAMPLES: usize = 12;
/// Steps of the golden section search.
const STEPS: usize = 60;

/// The plane of a parameter.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// The number of the section.
    pub section: usize,
    /// The parameter in the section, from 0 to 1.
    pub at: f64,
    /// How far it is on the positive side, roughly.
    pub distance: f64,
}

/// The sign functions in binary64, as functions of x − origin.
pub struct Distances {
    sections: Vec<Sampled>,
}

struct Sampled {
    section: usize,
    /// Bernstein coefficients at the origin, then of each axis.
    columns: Vec<Vec<f64>>,
}

impl Distances {
    /// From the sections that depend on x.
    pub fn new(context: &Context, origin: &[Rational]) -> Distances {
        let integers = RationalVector::from_rationals(origin);
        let over = integers.denominator();
        let sampled = |(section, sign): (usize, &Section)| {
            let mut columns = vec![sign.at(integers.numerators(), over)];
            for axis in 0..context.dimension {
                columns.push(sign.coefficients.iter().map(|c| &c.linear[axis] * over).collect());
            }
            let greatest = columns[1..].iter().flatten().map(Integer::abs).max()?;
            let float = |x: &Integer| Rational::new(x.clone(), greatest.clone()).to_f64();
            (!greatest.is_zero()).then(|| Sampled {
                section,
                columns: columns
                    .iter()
                    .map(|column| column.iter().map(float).collect())
                    .collect(),
            })
        };
        Distances {
            sections: context.sections.iter().enumerate().filter_map(sampled).collect(),
        }
    }

    /// The plane nearest to origin + arm, or farthest beyond it, roughly.
    pub fn nearest(&self, arm: &[f64]) -> Option<Plane> {
        let planes = self.sections.iter().map(|section| section.nearest(arm));
        planes.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// The same near a parameter of one section.
    pub fn nearest_around(&self, arm: &[f64], section: usize, at: f64) -> Option<Plane> {
        let sampled = self.sections.iter().find(|sampled| sampled.section == section)?;
        let values = sampled.at(arm);
        let step = 1.0 / (SAMPLES * values.len()) as f64;
        Some(sampled.least_between(&values, (at - step).max(0.0), (at + step).min(1.0)))
    }
}

impl Sampled {
    fn at(&self, arm: &[f64]) -> Vec<f64> {
        let value = |k: usize| {
            let terms = arm.iter().zip(&self.columns[1..]).map(|(y, column)| y * column[k]);
            terms.fold(self.columns[0][k], |sum, term| sum + term)
        };
        (0..self.columns[0].len()).map(value).collect()
    }

    /// The distance of the plane at a parameter; far away where there is none.
    fn distance(&self, values: &[f64], at: f64) -> f64 {
        let normal = self.columns[1..].iter().map(|column| evaluate(column, at).powi(2));
        let quotient = evaluate(values, at) / normal.sum::<f64>().sqrt();
        if quotient.is_nan() { f64::INFINITY } else { quotient }
    }

    fn nearest(&self, arm: &[f64]) -> Plane {
        let values = self.at(arm);
        let count = SAMPLES * values.len();
        let at = |k: usize| k as f64 / count as f64;
        let samples: Vec<f64> = (0..=count).map(|k| self.distance(&values, at(k))).collect();
        let least =
            |k: &usize| (*k == 0 || samples[*k] <= samples[k - 1]) && (*k == count || samples[*k] <= samples[k + 1]);
        let minima = (0..=count).filter(least);
        let refined = minima.map(|k| self.least_between(&values, at(k.saturating_sub(1)), at((k + 1).min(count))));
        let none = Plane {
            section: self.section,
            at: 0.5,
            distance: f64::INFINITY,
        };
        refined.min_by(|a, b| a.distance.total_cmp(&b.distance)).unwrap_or(none)
    }

    /// The least distance in an interval, its ends included, by golden section.
    fn least_between(&self, values: &[f64], from: f64, to: f64) -> Plane {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let f = |at: f64| self.distance(values, at);
        let (mut a, mut b) = (from, to);
        let (mut c, mut d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
        let (mut at_c, mut at_d) = (f(c), f(d));
        for _ in 0..STEPS {
            if at_c <= at_d {
                (b, d, at_d) = (d, c, at_c);
                c = b - GOLDEN * (b - a);
                at_c = f(c);
            } else {
                (a, c, at_c) = (c, d, at_d);
                d = a + GOLDEN * (b - a);
                at_d = f(d);
            }
        }
        let candidates = [from, to, c, d].map(|at| (at, f(at)));
        let (at, distance) =
            candidates.into_iter().fold(
                (from, f64::INFINITY),
                |best, next| if next.1 < best.1 { next } else { best },
            );
        Plane {
            section: self.section,
            at,
            distance,
        }
    }
}

/// The value of a polynomial, by de Casteljau.
fn evaluate(coefficients: &[f64], at: f64) -> f64 {
    let mut row: smallvec::SmallVec<[f64; 32]> = smallvec::SmallVec::from_slice(coefficients);
    for round in (1..row.len()).rev() {
        for k in 0..round {
            row[k] += at * (row[k + 1] - row[k]);
        }
    }
    row[0]
}

/// Tries to show, as the checker does, that the planes of all sections are at least √`radius_squared` away from a point of K.
///
/// # Errors
/// The section and the parameter in it where one is nearer, or `None` when halving does not come to an end.
pub fn show_ball(context: &Context, point: &[Rational], radius_squared: &Rational) -> Result<(), Option<(usize, f64)>> {
    let integers = RationalVector::from_rationals(point);
    for (number, section) in context.sections.iter().enumerate() {
        let polynomial = ball_polynomial(section, &integers, radius_squared);
        match polynomial::show(polynomial, Bound::NonNegative) {
            Ok(()) => {}
            Err(NotShown::At { numerator, halvings }) => {
                return Err(Some((number, numerator as f64 / 2f64.powi(halvings as i32))));
            }
            Err(NotShown::Limits) => return Err(None),
        }
    }
    Ok(())
}

/// g(u; x)² − r²·|A(u)|², up to a positive factor.
fn ball_polynomial(section: &Section, point: &RationalVector, radius_squared: &Rational) -> Vec<Integer> {
    let values = section.at(point.numerators(), point.denominator());
    let over = point.denominator();
    let factor = radius_squared.numer() * over * over;
    let squares = scaled_product(&values, &values);
    let mut sum: Vec<Integer> = squares.iter().map(|x| x * radius_squared.denom()).collect();
    for axis in 0..point.len() {
        let column: Vec<Integer> = section.coefficients.iter().map(|c| c.linear[axis].clone()).collect();
        for (total, square) in sum.iter_mut().zip(scaled_product(&column, &column)) {
            *total -= square * &factor;
        }
    }
    unscaled(sum).0
}
