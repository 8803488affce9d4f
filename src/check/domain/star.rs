//! Polytopes around a center, as unions of simplices (FORMAT §9).
//!
//! Why it works. Seen from the center, every cell (d points with a positive determinant) covers a cone of directions, all cells with the same
//! orientation. The boundaries cancel, so the cells' images on the sphere of directions form a cycle, and its degree, the number of
//! cells that cover a generic direction, is the same everywhere. The sum of the first cell's vectors is inside that cell's cone; if it is in no
//! other closed cone the degree is 1. So the cones cover every direction once, and the simplices (center, cell) have disjoint interiors.

use std::collections::HashMap;

use crate::claim::domain::Star;
use crate::number::{Integer, Rational};

/// What is wrong with a star.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StarError {
    /// It has no cells.
    NoCells,
    /// A cell names a point that is not there, or one twice.
    Point {
        /// The cell.
        cell: usize,
    },
    /// A determinant is not positive.
    Orientation {
        /// The cell.
        cell: usize,
    },
    /// The boundary does not cancel at an edge (or point, in the plane) of a cell.
    Boundary {
        /// The cell.
        cell: usize,
    },
    /// The first cell's directions are covered by another cell too.
    Covered {
        /// That cell.
        cell: usize,
    },
}

/// The determinant of d vectors of d numbers.
pub fn determinant(vectors: &[&[Integer]]) -> Integer {
    match vectors {
        [a, b] => &a[0] * &b[1] - &a[1] * &b[0],
        [a, b, c] => {
            &a[0] * (&b[1] * &c[2] - &b[2] * &c[1])
                + &a[1] * (&b[2] * &c[0] - &b[0] * &c[2])
                + &a[2] * (&b[0] * &c[1] - &b[1] * &c[0])
        }
        _ => unreachable!("curves have two or three coordinates"),
    }
}

/// Checks a star around `center`, all over `denominator`; returns its measure.
///
/// # Errors
/// What keeps it from being one.
pub fn measure(star: &Star, center: &[Integer], denominator: &Integer) -> Result<Rational, StarError> {
    let d = center.len();
    if star.cells.is_empty() {
        return Err(StarError::NoCells);
    }
    let arms: Vec<Vec<Integer>> = star
        .points
        .iter()
        .map(|point| point.iter().zip(center).map(|(x, c)| x - c).collect())
        .collect();
    let mut sum = Integer::ZERO;
    for (number, cell) in star.cells.iter().enumerate() {
        let distinct = (0..d).all(|i| cell[i] < arms.len() && !cell[..i].contains(&cell[i]));
        if !distinct {
            return Err(StarError::Point { cell: number });
        }
        let vectors: Vec<&[Integer]> = cell.iter().map(|v| arms[*v].as_slice()).collect();
        let size = determinant(&vectors);
        if !size.is_positive() {
            return Err(StarError::Orientation { cell: number });
        }
        sum += size;
    }
    boundary_cancels(star, d)?;
    covers_once(star, &arms)?;
    let factorial = Integer::from(if d == 2 { 2 } else { 6 });
    Ok(Rational::new(sum, denominator.pow(d as u32) * factorial))
}

/// The oriented faces of a cell as pairs; in the plane a start is (v, 0) and an end (0, v), so that one list serves both.
fn faces(cell: &[usize]) -> Vec<(usize, usize)> {
    match *cell {
        [a, b] => vec![(a + 1, 0), (0, b + 1)],
        [a, b, c] => vec![(a, b), (b, c), (c, a)],
        _ => unreachable!("curves have two or three coordinates"),
    }
}

fn boundary_cancels(star: &Star, d: usize) -> Result<(), StarError> {
    let mut balance: HashMap<(usize, usize), i64> = HashMap::with_capacity(d * star.cells.len());
    for (a, b) in star.cells.iter().flat_map(|cell| faces(cell)) {
        if a < b {
            *balance.entry((a, b)).or_default() += 1;
        } else {
            *balance.entry((b, a)).or_default() -= 1;
        }
    }
    let open = |(a, b): &(usize, usize)| balance[&(*a.min(b), *a.max(b))] != 0;
    match star.cells.iter().position(|cell| faces(cell).iter().any(open)) {
        Some(cell) => Err(StarError::Boundary { cell }),
        None => Ok(()),
    }
}

fn covers_once(star: &Star, arms: &[Vec<Integer>]) -> Result<(), StarError> {
    let first = &star.cells[0];
    let direction: Vec<Integer> = (0..first.len())
        .map(|axis| first.iter().map(|v| &arms[*v][axis]).sum())
        .collect();
    let contains = |cell: &Vec<usize>| {
        (0..cell.len()).all(|i| {
            let mut vectors: Vec<&[Integer]> = cell.iter().map(|v| arms[*v].as_slice()).collect();
            vectors[i] = &direction;
            !determinant(&vectors).is_negative()
        })
    };
    match star.cells.iter().skip(1).position(contains) {
        Some(before) => Err(StarError::Covered { cell: before + 1 }),
        None => Ok(()),
    }
}
