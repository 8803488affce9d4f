//! Where a control point of a planar curve may be so that its curvature keeps one sign: polygons of Ginnis, Karousos and Kaklis (2009) in binary64.
//!
//! The sign of the curvature is that of h_t(d), which is affine in the free point d. After ℓ midpoint subdivisions its Bernstein coefficients are half-planes
//! whose intersection lies inside the domain and grows with ℓ. The coefficients are those of the true degree (`docs/domain.md`).

use super::FloatError;
use super::curve::Curve;
use super::piece::{Homogeneous, Pieces, binomials, middle};
use super::tree::halve;

/// A half-plane a·x + b·y + c ≥ 0.
type Row = [f64; 3];

impl Curve {
    /// The polygon of level `level` (0 to 16) for control point `index`, within the square of half width `half_width` about the point's present position:
    /// the vertices counter-clockwise. `positive` asks for positive curvature (turning left), otherwise for negative. An empty polygon has no vertices.
    ///
    /// # Errors
    /// [`FloatError::Dimension`] in space; [`FloatError::Argument`] for an index, level or width out of range, or a degree of 1;
    /// [`FloatError::Budget`] for more than 4,000,000 half-planes.
    pub fn convex_domain(
        &self,
        index: usize,
        half_width: f64,
        level: u32,
        positive: bool,
    ) -> Result<Vec<[f64; 2]>, FloatError> {
        if self.dimension != 2 {
            return Err(FloatError::Dimension);
        }
        if index >= self.count() || level > 16 || !(half_width > 0.0 && half_width < 2f64.powi(300)) || self.degree < 2
        {
            return Err(FloatError::Argument {
                expected: "a control point, a level of at most 16, a positive width, a degree of at least 2",
            });
        }
        let center = [self.points[2 * index], self.points[2 * index + 1]];
        let w = half_width;
        // Relative to the middle of the curve, where rounding is least.
        let origin = middle(self);
        let (x, y) = (center[0] - origin[0], center[1] - origin[1]);
        let mut polygon = vec![[x - w, y - w], [x + w, y - w], [x + w, y + w], [x - w, y + w]];
        for row in self.rows(index, w, level, if positive { 1.0 } else { -1.0 })? {
            polygon = clip(&polygon, &row);
            if polygon.is_empty() {
                break;
            }
        }
        Ok(polygon.iter().map(|p| [p[0] + origin[0], p[1] + origin[1]]).collect())
    }

    /// The half-planes, relative to the middle of the curve.
    fn rows(&self, index: usize, unit: f64, level: u32, sign: f64) -> Result<Vec<Row>, FloatError> {
        let origin = middle(self);
        // h at the present point and a unit beside it on either axis gives the affine function.
        let at = |dx: f64, dy: f64| {
            let mut moved = self.clone();
            moved.points[2 * index] += dx;
            moved.points[2 * index + 1] += dy;
            (
                Pieces::new(&moved, &origin),
                [moved.points[2 * index], moved.points[2 * index + 1]],
            )
        };
        let ((here, point), (right, beside), (up, above)) = (at(0.0, 0.0), at(unit, 0.0), at(0.0, unit));
        let (x, y) = (point[0] - origin[0], point[1] - origin[1]);
        let (dx, dy) = (beside[0] - point[0], above[1] - point[1]);
        let mut rows = Vec::new();
        for (i, piece) in here.all.iter().enumerate() {
            let own = determinant(&piece.control, piece.rational);
            let one = determinant(&right.all[i].control, piece.rational);
            let two = determinant(&up.all[i].control, piece.rational);
            let affine = own.iter().zip(one.iter().zip(&two)).map(|(c, (a, b))| {
                let (a, b) = (sign * (a - c) / dx, sign * (b - c) / dy);
                [a, b, sign * c - a * x - b * y]
            });
            let mut parts = vec![affine.collect::<Vec<Row>>()];
            if rows.len() + (parts[0].len() << level) > 4_000_000 {
                return Err(FloatError::Budget);
            }
            for _ in 0..level {
                parts = parts
                    .into_iter()
                    .flat_map(|mut right| {
                        let left = halve(&mut right);
                        [left, right]
                    })
                    .collect();
            }
            rows.extend(parts.into_iter().flatten());
        }
        Ok(rows)
    }
}

/// The Bernstein coefficients of a positive multiple of det(p, p', p'') of homogeneous points (X, Y, w): the determinant of three curves of degree n − 2,
/// or for polynomial pieces the product of two difference curves.
fn determinant(control: &[Homogeneous], rational: bool) -> Vec<f64> {
    let n = control.len() - 3;
    let row = binomials(n);
    let minor = |p: &Homogeneous, q: &Homogeneous, r: &Homogeneous| {
        p[0] * (q[1] * r[3] - r[1] * q[3]) - p[1] * (q[0] * r[3] - r[0] * q[3]) + p[3] * (q[0] * r[1] - r[0] * q[1])
    };
    if rational {
        let total = binomials(3 * n);
        let mut sum = vec![0.0; 3 * n + 1];
        for i in 0..=n {
            for j in 0..=n {
                for k in 0..=n {
                    sum[i + j + k] += row[i] * row[j] * row[k] * minor(&control[i], &control[j + 1], &control[k + 2]);
                }
            }
        }
        return sum.iter().zip(&total).map(|(x, c)| x / c).collect();
    }
    let total = binomials(2 * n);
    let mut sum = vec![0.0; 2 * n + 1];
    let difference = |i: usize| [control[i + 1][0] - control[i][0], control[i + 1][1] - control[i][1]];
    for i in 0..=n {
        for j in 0..=n {
            let (a, b) = (difference(i), difference(j + 1));
            sum[i + j] += row[i] * row[j] * (a[0] * b[1] - a[1] * b[0]);
        }
    }
    sum.iter().zip(&total).map(|(x, c)| x / c).collect()
}

/// A convex polygon cut with a half-plane (Sutherland and Hodgman 1974); points on its border stay.
fn clip(polygon: &[[f64; 2]], row: &Row) -> Vec<[f64; 2]> {
    let value = |p: &[f64; 2]| row[0] * p[0] + row[1] * p[1] + row[2];
    let values: Vec<f64> = polygon.iter().map(value).collect();
    if values.iter().all(|v| *v >= 0.0) {
        return polygon.to_vec();
    }
    let mut result = Vec::with_capacity(polygon.len() + 1);
    for (i, p) in polygon.iter().enumerate() {
        let j = (i + 1) % polygon.len();
        let (a, b) = (values[i], values[j]);
        if a >= 0.0 {
            result.push(*p);
        }
        if (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0) {
            let u = a / (a - b);
            let q = &polygon[j];
            result.push([p[0] + u * (q[0] - p[0]), p[1] + u * (q[1] - p[1])]);
        }
    }
    // A polygon without area has no interior to offer.
    if result.len() < 3 { Vec::new() } else { result }
}
