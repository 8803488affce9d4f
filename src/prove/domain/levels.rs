//! The algorithm of Ginnis, Karousos and Kaklis (2009): the polytope of all Bernstein coefficients ≥ 0, level by level.

use std::time::Instant;

use num_traits::Zero;

use crate::check::domain::Context;
use crate::check::polynomial::halves;
use crate::number::{Integer, Rational};
use crate::polytope::{HalfSpace, Intersection, Polytope, intersect};

/// In which degree the sign function is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Degree {
    /// Its own: d(n−d), of a rational piece (d+1)(n−d).
    True,
    /// That of the products in the paper: 2n−3 in the plane, 3n−6 in space. Polynomial pieces only.
    Paper,
}

/// A level of the algorithm.
#[derive(Clone, Debug)]
pub struct Level {
    /// How often every knot interval was halved.
    pub level: u32,
    /// Coefficients that have to be ≥ 0; those at shared ends count twice.
    pub inequalities: usize,
    /// Vertices of the polytope.
    pub vertices: usize,
    /// Facets of the polytope.
    pub facets: usize,
    /// The area or volume, enclosed; [0, 0] when the polytope is empty or flat.
    pub measure: [Rational; 2],
    /// The same exactly, if asked for.
    pub exact_measure: Option<Rational>,
    /// The measure of this polytope without the one before, enclosed; `None` while that one is empty.
    pub absolute_error: Option<[Rational; 2]>,
    /// The same relative to the one before.
    pub relative_error: Option<[Rational; 2]>,
    /// Seconds that this level took.
    pub seconds: f64,
}

/// Measures are enclosed to this many bits.
const MEASURE_BITS: u32 = 64;

/// What the algorithm goes on with.
pub struct Levels<'a, const D: usize> {
    context: &'a Context<'a>,
    /// For each part of a section the coefficients of each coordinate, then the constants.
    parts: Vec<Vec<Vec<Integer>>>,
    level: u32,
    last: Option<[Rational; 2]>,
}

impl<'a, const D: usize> Levels<'a, D> {
    /// Before level 0.
    ///
    /// # Errors
    /// The number of a rational piece where the paper's degree is asked for.
    pub fn new(context: &'a Context<'a>, degree: Degree, polynomial: impl Fn(usize) -> bool) -> Result<Self, usize> {
        let mut parts = Vec::new();
        for section in &context.sections {
            let mut columns: Vec<Vec<Integer>> = (0..D)
                .map(|axis| section.coefficients.iter().map(|c| c.linear[axis].clone()).collect())
                .collect();
            columns.push(section.coefficients.iter().map(|c| c.constant.clone()).collect());
            if degree == Degree::Paper {
                if !polynomial(section.piece) {
                    return Err(section.piece);
                }
                // From d(n−d) to 2n−3 or 3n−6.
                let by = if D == 2 { 1 } else { 3 };
                for column in &mut columns {
                    for _ in 0..by {
                        *column = elevated(column);
                    }
                }
            }
            parts.push(columns);
        }
        Ok(Levels {
            context,
            parts,
            level: 0,
            last: None,
        })
    }

    /// How many rows the present level has.
    pub fn inequalities(&self) -> usize {
        self.parts.iter().map(|part| part[0].len()).sum()
    }

    /// The rows of the present level.
    pub fn rows(&self) -> Vec<HalfSpace<D>> {
        let mut rows = Vec::new();
        for part in &self.parts {
            for k in 0..part[0].len() {
                rows.push(HalfSpace {
                    normal: std::array::from_fn(|axis| part[axis][k].clone()),
                    constant: part[D][k].clone(),
                });
            }
        }
        rows
    }

    /// The area or volume, enclosed, of the polytope that the sign at the ends of the present level's parts cuts out of the box: it contains the whole domain, and
    /// costs nothing but rows that the level has anyway. `None` when it has no interior.
    pub fn outer_measure(&self) -> Option<[Rational; 2]> {
        let ends = self.parts.iter().flat_map(|part| {
            let last = part[0].len() - 1;
            [0, last].map(|k| HalfSpace {
                normal: std::array::from_fn(|axis| part[axis][k].clone()),
                constant: part[D][k].clone(),
            })
        });
        match intersect(&ends.chain(self.sides()).collect::<Vec<_>>()) {
            Intersection::Bounded(polytope) => Some(polytope.measure_enclosure(MEASURE_BITS)),
            _ => None,
        }
    }

    /// The sides of the box.
    fn sides(&self) -> Vec<HalfSpace<D>> {
        let names = (0..D).flat_map(|axis| [false, true].map(|high| crate::claim::domain::Row::Side { axis, high }));
        let sides = names.filter_map(|side| {
            let affine = self.context.row(&side)?.affine;
            Some(HalfSpace {
                normal: affine.linear.try_into().ok()?,
                constant: affine.constant,
            })
        });
        sides.collect()
    }

    /// Computes the polytope of the present level, and halves every part for the next.
    pub fn step(&mut self, exact: bool) -> (Level, Option<Polytope<D>>) {
        let start = Instant::now();
        let mut rows = self.rows();
        let inequalities = rows.len();
        rows.extend(self.sides());
        let polytope = match intersect(&rows) {
            Intersection::Bounded(polytope) => Some(polytope),
            _ => None,
        };
        let zero = || [Rational::zero(), Rational::zero()];
        let measure = polytope
            .as_ref()
            .map_or_else(zero, |polytope| polytope.measure_enclosure(MEASURE_BITS));
        let before = self.last.take().filter(|last| !last[0].is_zero());
        let absolute_error = before.as_ref().map(|[low, high]| {
            let least = &measure[0] - high;
            // A level contains the one before.
            [least.max(Rational::zero()), &measure[1] - low]
        });
        let relative_error = match (&absolute_error, &before) {
            (Some([least, greatest]), Some([low, high])) => Some([least / high, greatest / low]),
            _ => None,
        };
        let level = Level {
            level: self.level,
            inequalities,
            vertices: polytope.as_ref().map_or(0, Polytope::vertex_count),
            facets: polytope.as_ref().map_or(0, Polytope::facet_count),
            exact_measure: exact.then(|| polytope.as_ref().map_or_else(Rational::zero, Polytope::measure)),
            measure: measure.clone(),
            absolute_error,
            relative_error,
            seconds: start.elapsed().as_secs_f64(),
        };
        self.last = Some(measure);
        self.level += 1;
        self.parts = self
            .parts
            .iter()
            .flat_map(|part| {
                let (left, right): (Vec<_>, Vec<_>) = part.iter().map(|column| halves(column)).unzip();
                [left, right]
            })
            .collect();
        (level, polytope)
    }
}

/// The coefficients of the same polynomial in the next degree, times that degree.
fn elevated(coefficients: &[Integer]) -> Vec<Integer> {
    let next = coefficients.len();
    (0..=next)
        .map(|k| {
            let mut sum = Integer::ZERO;
            if k > 0 {
                sum += Integer::from(k) * &coefficients[k - 1];
            }
            if k < next {
                sum += Integer::from(next - k) * &coefficients[k];
            }
            sum
        })
        .collect()
}
