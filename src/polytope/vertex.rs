//! Rows and vertices in three layers of precision, and the side of a row a vertex is on.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::fixed::{FixedPoint, meet_lines, meet_planes, scale};
use crate::number::Integer;

/// Coefficients n and c of a half-space n·x + c ≥ 0, c last; the third is 0 in the plane.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub(super) exact: [Integer; 4],
    pub(super) fixed: [i128; 4],
    /// The caller's name of the row; `None` for the sides of a box that stands for the whole space.
    pub(super) label: Option<usize>,
}

impl Row {
    pub(super) fn new(coefficients: [&Integer; 4], label: Option<usize>) -> Self {
        Row {
            exact: coefficients.map(Integer::clone),
            fixed: scale(coefficients),
            label,
        }
    }
}

/// A vertex: the rows whose hyperplanes meet in it and in nothing else, two in the plane and three in space.
#[derive(Clone, Debug)]
pub(super) struct Vertex {
    /// In the plane, the third repeats the second.
    pub(super) rows: [u32; 3],
    pub(super) point: FixedPoint,
    /// Homogeneous coordinates with a positive weight, once they have been needed.
    pub(super) exact: Option<Box<[Integer; 4]>>,
    /// All facets that contain it, in no order.
    pub(super) facets: SmallVec<[u32; 4]>,
}

impl Vertex {
    pub(super) fn new(rows: &[Row], of: [u32; 3], facets: SmallVec<[u32; 4]>, dimension: usize) -> Self {
        let [a, b, c] = of.map(|row| &rows[row as usize]);
        match FixedPoint::meet([&a.fixed, &b.fixed, &c.fixed], dimension) {
            Some(point) => Vertex {
                rows: of,
                point,
                exact: None,
                facets,
            },
            None => {
                let exact = meet([a, b, c], dimension);
                Vertex {
                    rows: of,
                    point: FixedPoint::from_exact(&exact),
                    exact: Some(Box::new(exact)),
                    facets,
                }
            }
        }
    }

    /// Exact homogeneous coordinates, the weight last and positive, not reduced.
    pub(super) fn homogeneous(&self, rows: &[Row], dimension: usize) -> [Integer; 4] {
        match &self.exact {
            Some(exact) => exact.as_ref().clone(),
            None => meet(self.rows.map(|row| &rows[row as usize]), dimension),
        }
    }

    /// The sign of the row's value: 1 inside the open half-space, 0 on its boundary, −1 outside.
    pub(super) fn side(
        &mut self,
        coefficients: [&Integer; 4],
        fixed: &[i128; 4],
        rows: &[Row],
        dimension: usize,
    ) -> i8 {
        if let Some(side) = self.point.side(fixed) {
            return side;
        }
        if self.exact.is_none() {
            self.exact = Some(Box::new(self.homogeneous(rows, dimension)));
        }
        let Some(exact) = &self.exact else { return 0 };
        let sum: Integer = (0..4).map(|i| coefficients[i] * &exact[i]).sum();
        sum.sign() as i8
    }
}

/// Homogeneous coordinates, the weight last and positive, of the one point common to the hyperplanes.
fn meet([a, b, c]: [&Row; 3], dimension: usize) -> [Integer; 4] {
    let coordinates = if dimension == 2 {
        meet_lines(&a.exact, &b.exact, |x, y| x * y, |x, y| x - y)
    } else {
        meet_planes([&a.exact, &b.exact, &c.exact], |x, y| x * y, |x, y| x - y, |x, y| x + y)
    };
    if coordinates[3].sign() == Ordering::Less {
        coordinates.map(|coordinate| -coordinate)
    } else {
        coordinates
    }
}
