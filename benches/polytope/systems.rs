//! Systems of half-spaces as convex domains of control points give them: the Bernstein coefficients of curvature or torsion of a Bézier curve, each an
//! affine function of one free control point, on all parts after midpoint subdivisions, and the sides of a box.

use knotproof::number::Integer;
use knotproof::polytope::HalfSpace;

/// A curve with one free control point.
pub struct Case<const D: usize> {
    /// Short name, with the level.
    pub name: &'static str,
    /// Control points.
    pub points: [[i64; D]; 6],
    /// Index of the free one.
    pub free: usize,
    /// Midpoint subdivisions.
    pub level: u32,
}

/// Half the edge length of the box around the free point.
const HALF_BOX: i64 = 10;

impl<const D: usize> Case<D> {
    /// All coefficients of all 2^level parts, ends of neighbouring parts twice, then the sides of the box.
    pub fn rows(&self) -> Vec<HalfSpace<D>> {
        // An affine function, by its values at the origin and at the unit points.
        let at = |axis: Option<usize>| {
            let mut points = self.points;
            points[self.free] = std::array::from_fn(|i| i64::from(Some(i) == axis));
            subdivide(sign_function(&points), self.level)
        };
        let origin = at(None);
        let units: [Vec<Integer>; D] = std::array::from_fn(|axis| at(Some(axis)));
        // The sign is that of the curve as it is at its start.
        let value = |row: &HalfSpace<D>| -> Integer {
            let here = self.points[self.free];
            (0..D).map(|i| &row.normal[i] * Integer::from(here[i])).sum::<Integer>() + &row.constant
        };
        let mut rows: Vec<HalfSpace<D>> = (0..origin.len())
            .map(|i| HalfSpace {
                normal: std::array::from_fn(|axis| &units[axis][i] - &origin[i]),
                constant: origin[i].clone(),
            })
            .collect();
        if value(&rows[0]).is_negative() {
            for row in &mut rows {
                row.normal = row.normal.each_ref().map(|x| -x);
                row.constant = -&row.constant;
            }
        }
        for axis in 0..D {
            for sign in [1, -1] {
                rows.push(HalfSpace {
                    normal: std::array::from_fn(|i| Integer::from(if i == axis { sign } else { 0 })),
                    constant: Integer::from(HALF_BOX - sign * self.points[self.free][axis]),
                });
            }
        }
        rows
    }
}

/// Bernstein coefficients of det(c', c'') or det(c', c'', c''') times a positive number: degree 2n − 3 or 3n − 6.
fn sign_function<const D: usize>(points: &[[i64; D]]) -> Vec<Integer> {
    let mut differences: Vec<Vec<[i64; D]>> = vec![points.to_vec()];
    for order in 0..D {
        let last = &differences[order];
        let next = last
            .windows(2)
            .map(|pair| std::array::from_fn(|i| pair[1][i] - pair[0][i]));
        differences.push(next.collect());
    }
    let columns = &differences[1..];
    let degree: usize = columns.iter().map(|column| column.len() - 1).sum();
    let binomial = |n: usize, k: usize| Integer::binomial(n as u32, k as u32);
    // Products of the columns' Bernstein forms; C(degree, K) divides the K-th, so all are brought to their common multiple.
    let common = (0..=degree).fold(Integer::ONE, |common, k| common.lcm(&binomial(degree, k)));
    let mut sums = vec![Integer::ZERO; degree + 1];
    let third = if D == 3 { columns[2].len() } else { 1 };
    for i in 0..columns[0].len() {
        for j in 0..columns[1].len() {
            for k in 0..third {
                let (a, b) = (columns[0][i], columns[1][j]);
                let mut factor = binomial(columns[0].len() - 1, i) * binomial(columns[1].len() - 1, j);
                let determinant = if D == 2 {
                    a[0] * b[1] - a[1] * b[0]
                } else {
                    let c = columns[2][k];
                    factor *= binomial(third - 1, k);
                    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
                    c[D - 1] * minor(0, 1) - c[1] * minor(0, D - 1) + c[0] * minor(1, D - 1)
                };
                sums[i + j + k] += factor * Integer::from(determinant);
            }
        }
    }
    (0..=degree)
        .map(|k| &sums[k] * common.div_exact(&binomial(degree, k)))
        .collect()
}

/// The coefficients on all parts after midpoint subdivisions, times a power of two.
fn subdivide(coefficients: Vec<Integer>, level: u32) -> Vec<Integer> {
    let degree = coefficients.len() - 1;
    let mut all = coefficients;
    for _ in 0..level {
        let mut next = Vec::with_capacity(2 * all.len());
        for part in all.chunks(degree + 1) {
            // De Casteljau's triangle without the divisions: line k is 2^k times what it should be.
            let mut line = part.to_vec();
            let (mut left, mut right) = (Vec::new(), Vec::new());
            for k in 0..=degree {
                let missing = (degree - k) as u32;
                left.push(&line[0] << missing);
                right.push(&line[line.len() - 1] << missing);
                line = line.windows(2).map(|pair| &pair[0] + &pair[1]).collect();
            }
            right.reverse();
            next.append(&mut left);
            next.append(&mut right);
        }
        all = next;
    }
    all
}
