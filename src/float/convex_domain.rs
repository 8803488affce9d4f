//! Where a control point may be so that curvature or torsion keeps one sign: polygons and polyhedra of Ginnis, Karousos and Kaklis (2009) in binary64.
//!
//! The sign is that of h_t(d), which is affine in the free point d. After ℓ midpoint subdivisions its Bernstein coefficients are half-planes, or half-spaces,
//! whose intersection lies inside the domain and grows with ℓ. The coefficients are those of the true degree (`docs/domain.md`).
//!
//! Every row carries a bound of its rounding errors. Nothing is cut off by less than that, and what is left must have a point that satisfies all rows by more.

use super::FloatError;
use super::curve::Curve;
use super::piece::{Homogeneous, Pieces, binomials, middle};
use super::solid::{ConvexSolid, Cut};
use super::tree::halve;

/// A half-space n·q + c ≥ 0 of points q relative to the free point: n (of three coordinates), c, and what its rounding errors are relative to.
pub(super) type Row = [f64; 5];

/// Rounding errors of a row are below this part of its last number: some ten operations in a determinant, a difference quotient for each axis, and one
/// mean a level.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
const MOST_ROWS: usize = 4_000_000;

/// The value of a row.
pub(super) fn value(row: &Row, q: &[f64; 3]) -> f64 {
    row[0] * q[0] + row[1] * q[1] + row[2] * q[2] + row[3]
}

/// How far the value of a row may be off.
pub(super) fn error(row: &Row) -> f64 {
    ROUNDING * row[4]
}

impl Curve {
    /// The polygon of level `level` (0 to 16) for control point `index`, within the square of half width `half_width` about the point's present position:
    /// the vertices counter-clockwise. `positive` asks for positive curvature (turning left), otherwise for negative. An empty polygon has no vertices.
    ///
    /// # Errors
    /// [`FloatError::Dimension`] in space; [`FloatError::Argument`] for an index, level or width out of range, or a degree of 1;
    /// [`FloatError::Doubtful`] where rounding leaves open whether the polygon has an interior; [`FloatError::Budget`] for more than 4,000,000 half-planes.
    pub fn convex_domain(
        &self,
        index: usize,
        half_width: f64,
        level: u32,
        positive: bool,
    ) -> Result<Vec<[f64; 2]>, FloatError> {
        let rows = self.rows::<2>(index, half_width, level, positive)?;
        let w = half_width;
        let mut polygon = vec![[-w, -w, 0.0], [w, -w, 0.0], [w, w, 0.0], [-w, w, 0.0]];
        for row in &rows {
            polygon = clip(polygon, row);
            if polygon.is_empty() {
                return Ok(Vec::new());
            }
        }
        certain(&polygon, &rows)?;
        let center = [self.points[2 * index], self.points[2 * index + 1]];
        Ok(polygon.iter().map(|q| [q[0] + center[0], q[1] + center[1]]).collect())
    }

    /// The same in space, where the sign is that of the torsion, within a cube. An empty polyhedron has no vertices.
    ///
    /// # Errors
    /// As for [`Curve::convex_domain`]: [`FloatError::Dimension`] in the plane, [`FloatError::Argument`] for a degree below 3, and
    /// [`FloatError::Doubtful`] also where rounding leaves open which edges a half-space cuts.
    pub fn convex_domain_in_space(
        &self,
        index: usize,
        half_width: f64,
        level: u32,
        positive: bool,
    ) -> Result<ConvexSolid, FloatError> {
        let rows = self.rows::<3>(index, half_width, level, positive)?;
        let mut solid = ConvexSolid::cube(half_width);
        for row in &rows {
            match solid.cut(row) {
                Cut::Done => {}
                Cut::Empty => return Ok(ConvexSolid::default()),
                Cut::Doubtful => return Err(FloatError::Doubtful),
            }
        }
        certain(&solid.vertices, &rows)?;
        for q in &mut solid.vertices {
            for axis in 0..3 {
                q[axis] += self.points[3 * index + axis];
            }
        }
        Ok(solid)
    }

    /// The rows of a level, without those that are 0 everywhere.
    fn rows<const D: usize>(&self, index: usize, w: f64, level: u32, positive: bool) -> Result<Vec<Row>, FloatError> {
        if self.dimension != D {
            return Err(FloatError::Dimension);
        }
        if index >= self.count() || level > 16 || !(w > 0.0 && w < 2f64.powi(300)) || self.degree < D {
            return Err(FloatError::Argument {
                expected: "a control point, a level of at most 16, a positive width, a degree of at least 2 in the plane and 3 in space",
            });
        }
        // Relative to the middle of the curve, where rounding is least.
        let origin = middle(self);
        let here = Pieces::new(self, &origin);
        // h at the present point and a unit beside it on each axis gives the affine function.
        let mut steps = [0.0; D];
        let moved: [Pieces; D] = std::array::from_fn(|axis| {
            let mut moved = self.clone();
            let x = &mut moved.points[D * index + axis];
            *x += w;
            steps[axis] = *x - self.points[D * index + axis];
            Pieces::new(&moved, &origin)
        });
        if steps.iter().any(|step| *step <= 0.0) {
            return Err(FloatError::Doubtful);
        }
        let sign = if positive { 1.0 } else { -1.0 };
        let mut rows = Vec::new();
        for (i, piece) in here.all.iter().enumerate() {
            let columns = moved.each_ref().map(|moved| &moved.all[i].control);
            let form = Form {
                dimension: D,
                rational: piece.rational,
            };
            let own = form.coefficients(&piece.control, true);
            let beside = columns.map(|control| form.coefficients(control, true));
            let sizes = form.coefficients(&largest(&piece.control, &columns), false);
            let whole: Vec<Row> = (0..own.len())
                .map(|k| {
                    let mut row = [0.0, 0.0, 0.0, sign * own[k], sizes[k]];
                    for axis in 0..D {
                        row[axis] = sign * (beside[axis][k] - own[k]) / steps[axis];
                    }
                    row
                })
                .collect();
            if rows.len() + (whole.len() << level) > MOST_ROWS {
                return Err(FloatError::Budget);
            }
            let mut parts = vec![whole];
            for _ in 0..level {
                parts = parts
                    .into_iter()
                    .flat_map(|mut right| {
                        let left = halve(&mut right);
                        [left, right]
                    })
                    .collect();
            }
            // A row without any rounding in it, as of three fixed points on a line, says nothing.
            rows.extend(
                parts
                    .into_iter()
                    .flatten()
                    .filter(|row| row[..4].iter().any(|x| *x != 0.0)),
            );
        }
        Ok(rows)
    }
}

/// Magnitudes of control points wherever the free point is in the box; the weights as they are.
fn largest<const D: usize>(control: &[Homogeneous], moved: &[&Vec<Homogeneous>; D]) -> Vec<Homogeneous> {
    let each = control.iter().enumerate().map(|(k, p)| {
        let mut most = p.map(f64::abs);
        for other in moved {
            for axis in 0..3 {
                most[axis] += (other[k][axis] - p[axis]).abs();
            }
        }
        most
    });
    each.collect()
}

/// Is there a point that satisfies all rows, whatever rounding did?
fn certain(vertices: &[[f64; 3]], rows: &[Row]) -> Result<(), FloatError> {
    let mut center = [0.0; 3];
    for q in vertices {
        for axis in 0..3 {
            center[axis] += q[axis] / vertices.len() as f64;
        }
    }
    match rows.iter().all(|row| value(row, &center) > error(row)) {
        true => Ok(()),
        false => Err(FloatError::Doubtful),
    }
}

/// How the sign function is written on a piece.
struct Form {
    dimension: usize,
    rational: bool,
}

impl Form {
    /// The Bernstein coefficients of a positive multiple of det((w, X), (w, X)', …), of polynomial pieces det(X', …): a determinant of curves of degree n − d.
    /// Not `signed`, all differences are sums.
    fn coefficients(&self, control: &[Homogeneous], signed: bool) -> Vec<f64> {
        let d = self.dimension;
        // Degree of the curves, and how many there are.
        let n = control.len() - 1 - d;
        let count = if self.rational { d + 1 } else { d };
        let minus = if signed { -1.0 } else { 1.0 };
        let vectors: Vec<[f64; 4]> = match self.rational {
            true => control.iter().map(|p| [p[3], p[0], p[1], p[2]]).collect(),
            false => {
                let difference = |pair: &[Homogeneous]| {
                    let x: [f64; 3] = std::array::from_fn(|axis| pair[1][axis] + minus * pair[0][axis]);
                    [x[0], x[1], x[2], 0.0]
                };
                control.windows(2).map(difference).collect()
            }
        };
        let (row, total) = (binomials(n), binomials(count * n));
        let mut sum = vec![0.0; count * n + 1];
        let mut at = vec![0; count];
        loop {
            let columns: Vec<&[f64; 4]> = at.iter().enumerate().map(|(j, i)| &vectors[i + j]).collect();
            let factor: f64 = at.iter().map(|i| row[*i]).product();
            sum[at.iter().sum::<usize>()] += factor * determinant(&columns, minus);
            // The next index, the last place first.
            let Some(place) = at.iter().rposition(|i| *i < n) else {
                break;
            };
            at[place] += 1;
            at[place + 1..].fill(0);
        }
        sum.iter().zip(&total).map(|(x, c)| x / c).collect()
    }
}

/// A determinant of the first coordinates, or with 1 for `minus` the permanent.
fn determinant(columns: &[&[f64; 4]], minus: f64) -> f64 {
    let two = |a: &[f64; 4], b: &[f64; 4], i: usize, j: usize| a[i] * b[j] + minus * a[j] * b[i];
    let three = |a: &[f64; 4], b: &[f64; 4], c: &[f64; 4], [i, j, k]: [usize; 3]| {
        a[i] * two(b, c, j, k) + minus * a[j] * two(b, c, i, k) + a[k] * two(b, c, i, j)
    };
    match columns {
        [a, b] => two(a, b, 0, 1),
        [a, b, c] => three(a, b, c, [0, 1, 2]),
        [a, b, c, d] => {
            a[0] * three(b, c, d, [1, 2, 3])
                + minus * a[1] * three(b, c, d, [0, 2, 3])
                + a[2] * three(b, c, d, [0, 1, 3])
                + minus * a[3] * three(b, c, d, [0, 1, 2])
        }
        _ => 0.0,
    }
}

/// A convex polygon cut with a half-plane (Sutherland and Hodgman 1974), moved outward by its rounding error; what is outside by twice that is cut off.
fn clip(polygon: Vec<[f64; 3]>, row: &Row) -> Vec<[f64; 3]> {
    let slack = error(row);
    let values: Vec<f64> = polygon.iter().map(|q| value(row, q) + slack).collect();
    let out = |v: f64| v < -slack;
    if !values.iter().any(|v| out(*v)) {
        return polygon;
    }
    let mut result: Vec<[f64; 3]> = Vec::with_capacity(polygon.len() + 1);
    for (i, p) in polygon.iter().enumerate() {
        let j = (i + 1) % polygon.len();
        let (a, b) = (values[i], values[j]);
        if !out(a) {
            result.push(*p);
        }
        if out(a) != out(b) {
            result.push(between(p, &polygon[j], a, b));
        }
    }
    result.dedup();
    if result.len() > 1 && result.first() == result.last() {
        result.pop();
    }
    // A polygon without area has no interior to offer.
    if result.len() < 3 { Vec::new() } else { result }
}

/// Where a function with the values a and b at both ends is 0; an end, when it has one sign.
pub(super) fn between(p: &[f64; 3], q: &[f64; 3], a: f64, b: f64) -> [f64; 3] {
    let u = (a / (a - b)).clamp(0.0, 1.0);
    std::array::from_fn(|axis| p[axis] + u * (q[axis] - p[axis]))
}
