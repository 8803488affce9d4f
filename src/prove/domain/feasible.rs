//! A point of K inside the box, or the proof that there is none.
//!
//! Cutting planes (Kelley 1960): the linear program that maximises the least slack of the rows found so far gives a point; where its sign function is not
//! positive, the row at that parameter is added. When the greatest slack is not positive, the program's dual solution is a combination of at most d+1 rows that
//! is a constant ≤ 0.

use num_traits::Zero;

use crate::check::domain::Context;
use crate::check::polynomial::{Bound, NotShown};
use crate::claim::domain::{Evidence, Row};
use crate::number::{Integer, Rational, RationalExt, RationalVector};
use crate::prove::linear_program::{self, FloatSolver, Solution, maximise};

/// How many rows are added at most.
const MOST_CUTS: usize = 400;
/// Points tried are rounded to this part of the box.
const GRIDS: [u32; 2] = [12, 40];

/// What was found.
#[derive(Clone, Debug)]
pub enum Found {
    /// A point of K inside the box.
    Point(Vec<Rational>),
    /// The evidence that there is none.
    Empty(Evidence),
    /// Neither.
    Nothing,
}

/// A row of the program: row − slack·weight ≥ 0.
fn program_row(context: &Context, row: &Row) -> Option<(linear_program::Row, Rational)> {
    let exact = context.row(row)?;
    let weight = exact
        .affine
        .linear
        .iter()
        .map(Integer::abs)
        .max()
        .filter(|weight| !weight.is_zero());
    // A row that does not depend on x is decided by its constant, whatever the weight.
    let weight = weight.unwrap_or_else(|| exact.affine.constant.abs().max(Integer::ONE));
    let mut normal = exact.affine.linear;
    normal.push(-weight);
    let row = linear_program::Row {
        normal,
        constant: exact.affine.constant,
    };
    Some((row, exact.scale))
}

/// Searches a point of K inside the box.
pub fn find(context: &Context, solver: &dyn FloatSolver) -> Found {
    let d = context.dimension;
    let mut rows: Vec<Row> = (0..2 * d)
        .map(|side| Row::Side {
            axis: side / 2,
            high: side % 2 == 1,
        })
        .collect();
    for section in &context.sections {
        for (numerator, halvings) in [(0, 0), (1, 0), (1, 1)] {
            rows.push(Row::Parameter {
                piece: section.piece,
                u: section.local(numerator, halvings),
            });
        }
    }
    let mut program = Vec::new();
    let mut scales = Vec::new();
    let mut objective = vec![Integer::ZERO; d];
    objective.push(Integer::ONE);
    for _ in 0..MOST_CUTS {
        for row in &rows[program.len()..] {
            let Some((row, scale)) = program_row(context, row) else {
                return Found::Nothing;
            };
            program.push(row);
            scales.push(scale);
        }
        let Ok(Solution::Optimal {
            point,
            value,
            basis,
            multipliers,
        }) = maximise(&objective, &program, solver)
        else {
            return Found::Nothing;
        };
        if value <= Rational::zero() {
            return empty(context, &rows, &scales, &basis, &multipliers);
        }
        match violated(context, &point[..d]) {
            Ok(point) => return Found::Point(point),
            Err(Some(row)) if !rows.contains(&row) => rows.push(row),
            Err(_) => return Found::Nothing,
        }
    }
    Found::Nothing
}

/// The point, rounded, if it is in K and inside the box; otherwise a row that it violates, if one is found.
fn violated(context: &Context, point: &[Rational]) -> Result<Vec<Rational>, Option<Row>> {
    let mut cut = None;
    for bits in GRIDS {
        let rounded: Vec<Rational> = point
            .iter()
            .enumerate()
            .map(|(axis, x)| {
                let (low, high) = (&context.domain.bounds.low[axis], &context.domain.bounds.high[axis]);
                // A power of two that is a small part of the box.
                let size = (high - low).to_f64().log2().floor() as i64 - i64::from(bits);
                let grid = Rational::from_f64(2f64.powi(size as i32)).unwrap_or_else(|| high - low);
                (x / &grid).round() * grid
            })
            .collect();
        if !super::sandwich::strictly_in_box(context, &rounded) {
            continue;
        }
        let integers = RationalVector::from_rationals(&rounded);
        match context.show(integers.numerators(), integers.denominator(), Bound::Positive) {
            Ok(()) => return Ok(rounded),
            Err((section, NotShown::At { numerator, halvings })) => {
                let section = &context.sections[section];
                cut = Some(Row::Parameter {
                    piece: section.piece,
                    u: lowest(section, &integers).unwrap_or_else(|| section.local(numerator, halvings)),
                });
            }
            Err((_, NotShown::Limits)) => {}
        }
    }
    Err(cut)
}

/// Roughly where the function of a section is least, among sampled parameters.
fn lowest(section: &crate::check::domain::sign::Section, point: &RationalVector) -> Option<Rational> {
    const SAMPLES: u64 = 64;
    let coefficients = section.at(point.numerators(), point.denominator());
    let greatest = coefficients
        .iter()
        .map(Integer::abs)
        .max()
        .filter(|greatest| !greatest.is_zero())?;
    let floats: Vec<f64> = coefficients
        .iter()
        .map(|c| Rational::new(c.clone(), greatest.clone()).to_f64())
        .collect();
    let value = |u: f64| {
        let mut row = floats.clone();
        for round in (1..row.len()).rev() {
            for k in 0..round {
                row[k] += u * (row[k + 1] - row[k]);
            }
        }
        row[0]
    };
    // Samples, then finer ones around the least.
    let (mut start, mut step, mut best) = (0u64, 1u64 << 24, 0u64);
    for _ in 0..4 {
        let at = |k: u64| (start + k * step) as f64 / (SAMPLES << 24) as f64;
        let least = (0..=SAMPLES).min_by(|a, b| value(at(*a)).total_cmp(&value(at(*b))))?;
        best = start + least * step;
        let next = step / 32;
        start = best.saturating_sub(step).min((SAMPLES << 24) - 64 * next);
        step = next.max(1);
    }
    let low = value(best as f64 / (SAMPLES << 24) as f64) < 0.0;
    low.then(|| section.local(best, (SAMPLES << 24).trailing_zeros() as usize))
}

/// The evidence of a dual solution whose value is not positive.
fn empty(context: &Context, rows: &[Row], scales: &[Rational], basis: &[usize], multipliers: &[Rational]) -> Found {
    let used: Vec<usize> = (0..basis.len()).filter(|i| !multipliers[*i].is_zero()).collect();
    let exact: Vec<Rational> = used.iter().map(|i| &multipliers[*i] / &scales[basis[*i]]).collect();
    let integers = RationalVector::from_rationals(&exact);
    let rows: Vec<Row> = used.iter().map(|i| rows[basis[*i]].clone()).collect();
    let multipliers = integers.numerators().to_vec();
    match context.check_empty(&rows, &multipliers) {
        Ok(()) => Found::Empty(Evidence::Empty { rows, multipliers }),
        // Only rows at open ends bear the combination: they are not strict.
        Err(_) => Found::Nothing,
    }
}
