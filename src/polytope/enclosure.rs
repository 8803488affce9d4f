//! Area and volume between two fractions of bounded size.
//!
//! Vertices are rounded to a common grid. The determinants of rounded differences are exact integers, and how far their sum is from that of
//! the true ones follows from the rounding errors alone; when it is too far, the grid is refined.

use ethnum::I256;

use super::body::Body;
use super::measure::boundary;
use super::vertex::{Row, Vertex};
use crate::number::{Integer, Rational, RationalExt};

/// A coordinate difference of the grid takes at most so many bits in the fast path: a determinant of differences of such, less than 3! · 2^(3 · 73), and
/// the sum of as many as memory holds stay within 255 bits.
const FAST_BITS: u64 = 72;

/// The area or volume, see [`Polytope::measure_enclosure`](super::Polytope::measure_enclosure).
pub(super) fn measure(body: &Body, bits: u32) -> [Rational; 2] {
    let simplices: Vec<[u32; 3]> = boundary(body).collect();
    // Bits of the extent on the grid: those asked for, those lost in the sum of errors, and some for a shape that is not round.
    let mut wanted = i64::from(bits) + i64::from(simplices.len().ilog2()) + 14;
    let mut shift = wanted - exponent(body);
    loop {
        let grid = Grid::new(body, shift);
        let (sum, error) = grid.sum(&simplices, body.dimension);
        let low = &sum - &error;
        if low.is_positive() && (&error << (bits + 2)) <= low {
            // Outward to bits + 4 binary digits; a rounding changes the value by at most 2^-(bits + 3) of it.
            let scale = shift * body.dimension as i64;
            let factor = Integer::from(if body.dimension == 2 { 2 } else { 6 });
            let cut = sum.bits() as i64 - i64::from(bits) - 7;
            let low = shifted(&low, -cut).div_floor(&factor);
            let high = shifted_up(&(sum + error), -cut).div_ceil(&factor);
            return [low, high].map(|value| dyadic(value, cut - scale));
        }
        // Too coarse: by what the error exceeds its bound, or twice as fine when nothing is known yet.
        let lacking = error.bits() as i64 + i64::from(bits) + 3 - low.bits() as i64;
        let more = if low.is_positive() {
            lacking.max(1)
        } else {
            wanted.max(32)
        };
        wanted += more;
        shift += more;
    }
}

/// ⌊value · 2^shift⌋.
fn shifted(value: &Integer, shift: i64) -> Integer {
    // Memory bounds integers far below 2^(2^32).
    let bits = shift.unsigned_abs() as u32;
    if shift >= 0 { value << bits } else { value >> bits }
}

/// ⌈value · 2^shift⌉.
fn shifted_up(value: &Integer, shift: i64) -> Integer {
    -shifted(&-value, shift)
}

/// value · 2^exponent.
fn dyadic(value: Integer, exponent: i64) -> Rational {
    let power = Integer::ONE << exponent.unsigned_abs() as u32;
    if exponent >= 0 {
        Rational::from_integer(value * power)
    } else {
        Rational::new(value, power)
    }
}

/// About the binary logarithm of the greatest difference of coordinates, at most that of the greatest coordinate.
fn exponent(body: &Body) -> i64 {
    let [mut low, mut high] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    let mut greatest = i64::MIN;
    for vertex in &body.vertices {
        let [numerators @ .., weight] = vertex.point.coordinates;
        for i in 0..body.dimension {
            let quotient = numerators[i] as f64 / weight.max(1) as f64;
            low[i] = low[i].min(quotient);
            high[i] = high[i].max(quotient);
        }
        if weight <= vertex.point.error {
            // Too far away to be seen in these numbers.
            let [numerators @ .., weight] = vertex.homogeneous(&body.rows, body.dimension);
            let bits = numerators.iter().map(|x| x.bits() as i64).max().unwrap_or(0);
            greatest = greatest.max(bits - weight.bits() as i64);
        }
    }
    let extent = (0..3).fold(0.0_f64, |extent, i| extent.max(high[i] - low[i]));
    // Differences drown in rounding errors below this.
    let floor = (0..3).fold(1e-300_f64, |floor, i| {
        floor.max(1e-14 * high[i].abs().max(low[i].abs()))
    });
    greatest.max(extent.max(if floor.is_finite() { floor } else { 1e-300 }).log2().ceil() as i64)
}

/// Vertices rounded to multiples of 2^−shift.
struct Grid {
    /// Differences from vertex 0, in units of the grid.
    points: Vec<[Integer; 3]>,
    /// Bounds on the errors of the vertices in units of the grid.
    errors: Vec<i64>,
}

impl Grid {
    fn new(body: &Body, shift: i64) -> Self {
        let mut errors = Vec::with_capacity(body.vertices.len());
        let mut points: Vec<[Integer; 3]> = body
            .vertices
            .iter()
            .map(|vertex| {
                let (point, off) = on_grid(vertex, shift)
                    .unwrap_or_else(|| (on_grid_exactly(vertex, &body.rows, body.dimension, shift), 1));
                errors.push(off);
                point
            })
            .collect();
        let origin = points[0].clone();
        for point in &mut points {
            for (coordinate, origin) in point.iter_mut().zip(&origin) {
                *coordinate -= origin;
            }
        }
        Grid { points, errors }
    }

    /// The sum of the determinants, and a bound on its error.
    fn sum(&self, simplices: &[[u32; 3]], dimension: usize) -> (Integer, Integer) {
        let extents = self.points.iter().flatten().map(Integer::bits);
        if extents.max().unwrap_or(0) <= FAST_BITS {
            return self.sum_in_256_bits(simplices, dimension);
        }
        let sum = simplices.iter().fold(Integer::ZERO, |sum, simplex| {
            let [a, b, c] = simplex.map(|vertex| &self.points[vertex as usize]);
            sum + determinant(a, b, c, dimension, |x, y| x * y, |x, y| x - y)
        });
        // A determinant of order d is a sum of d! products of d entries; of entries off by e and at most D it is off by at most
        // d! · ((D + e)^d − D^d).
        let extent = self
            .points
            .iter()
            .flatten()
            .map(Integer::abs)
            .max()
            .unwrap_or(Integer::ZERO);
        let error = Integer::from(self.errors.iter().copied().max().unwrap_or(0)) << 1;
        let (order, products) = if dimension == 2 { (2, 2) } else { (3, 6) };
        let one = ((&extent + &error).pow(order) - extent.pow(order)) * Integer::from(products);
        (sum, one * Integer::from(simplices.len()))
    }

    /// The same for entries of at most [`FAST_BITS`] bits, the bound by the size of each determinant's entries.
    fn sum_in_256_bits(&self, simplices: &[[u32; 3]], dimension: usize) -> (Integer, Integer) {
        let points: Vec<[i128; 3]> = self
            .points
            .iter()
            .map(|point| point.each_ref().map(|x| x.to_i128().unwrap_or(0)))
            .collect();
        let size = |v: &[i128; 3]| v.iter().map(|x| x.abs()).max().unwrap_or(0) as f64;
        let mut sum = I256::ZERO;
        let mut error = 0.0;
        for simplex in simplices {
            // det(a, b, c) = det(a, b − a, c − a), where the differences are short.
            let [a, b, c] = simplex.map(|vertex| points[vertex as usize]);
            let difference = |v: [i128; 3]| std::array::from_fn(|i| v[i] - a[i]);
            let (b, c): ([i128; 3], [i128; 3]) = (difference(b), difference(c));
            let wide = [a, b, c].map(|v| v.map(I256::from));
            sum += determinant(&wide[0], &wide[1], &wide[2], dimension, |x, y| x * y, |x, y| x - y);
            // Each entry is a difference of two coordinates, and d! products as below; here the entries of each vector have their own size.
            let greatest = simplex.map(|vertex| self.errors[vertex as usize]);
            let off = (greatest.into_iter().max().unwrap_or(0) + self.errors[0]) as f64 * 2.0;
            let (p, q, r) = (size(&a), size(&b), size(&c));
            error += if dimension == 2 {
                2.0 * off * (p + q + off)
            } else {
                6.0 * off * (p * q + p * r + q * r + off * (p + q + r + off))
            };
        }
        let bytes = sum.unsigned_abs().to_le_bytes();
        // All terms are positive and below 2^230, so rounding errors stay far below this factor for as many as memory holds.
        let error = Rational::from_f64(error * 1.001).map_or(Integer::ZERO, |error| error.ceil_shifted(0));
        (Integer::from_magnitude_bytes_le(sum < 0, &bytes), error)
    }
}

fn determinant<T>(
    a: &[T; 3],
    b: &[T; 3],
    c: &[T; 3],
    dimension: usize,
    product: impl Fn(&T, &T) -> T,
    difference: impl Fn(T, T) -> T,
) -> T {
    let minor = |i: usize, j: usize| difference(product(&a[i], &b[j]), product(&a[j], &b[i]));
    if dimension == 2 {
        return minor(0, 1);
    }
    // c₂ m₀₁ − (c₁ m₀₂ − c₀ m₁₂).
    let rest = difference(product(&c[1], &minor(0, 2)), product(&c[0], &minor(1, 2)));
    difference(product(&c[2], &minor(0, 1)), rest)
}

/// The fixed-point coordinates on the grid and a bound on the error in its units; `None` when they are not good enough or the numbers get too long.
fn on_grid(vertex: &Vertex, shift: i64) -> Option<([Integer; 3], i64)> {
    let point = &vertex.point;
    let [numerators @ .., weight] = point.coordinates;
    // Numerators have at most 121 bits.
    if !(0..=130).contains(&shift) || weight <= point.error << 10 {
        return None;
    }
    let greatest = numerators.iter().map(|x| x.abs()).max().unwrap_or(0) as f64;
    // |X/W − x| ≤ error · (1 + |x|) / W for the fixed-point numbers X and W; the factor is for W being off by a 1024th at most and for the rounding here.
    let off = point.error as f64 * (1.0 + greatest / weight as f64) / weight as f64;
    let off = off * 1.01 * 2_f64.powi(shift as i32);
    if off > 1e6 {
        return None;
    }
    let coordinates = numerators.map(|numerator| {
        let quotient = (I256::from(numerator) << shift as u32) / I256::from(weight);
        let bytes = quotient.unsigned_abs().to_le_bytes();
        match i128::try_from(quotient) {
            Ok(quotient) => Integer::from(quotient),
            Err(_) => Integer::from_magnitude_bytes_le(quotient < 0, &bytes),
        }
    });
    // One more for the truncated quotient, one for the truncation to an integer here.
    Some((coordinates, off as i64 + 2))
}

/// The exact coordinates, rounded down to the grid.
fn on_grid_exactly(vertex: &Vertex, rows: &[Row], dimension: usize, shift: i64) -> [Integer; 3] {
    let [x, y, z, weight] = vertex.homogeneous(rows, dimension);
    let (up, down) = (shift.max(0) as u32, (-shift).max(0) as u32);
    let weight = weight << down;
    [x, y, z].map(|numerator| (numerator << up).div_floor(&weight))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::polytope::{HalfSpace, Polytope};

    /// The sum on grids too coarse for a good answer is as near the true one as its bound says, in the fast path and in the other.
    fn assert_sums<const D: usize>(rows: &[([i64; D], i64)], shift: i64) {
        let bound =
            |value: i64| -> [Rational; D] { std::array::from_fn(|_| Rational::from_integer(Integer::from(value))) };
        let mut polytope: Polytope<D> = Polytope::from_box(&bound(-3), &bound(3)).unwrap();
        for (normal, constant) in rows {
            let row = HalfSpace {
                normal: normal.map(Integer::from),
                constant: Integer::from(*constant),
            };
            polytope.clip(&row, 9);
        }
        let simplices: Vec<[u32; 3]> = boundary(&polytope.body).collect();
        for shift in [shift, shift + 75] {
            let (sum, error) = Grid::new(&polytope.body, shift).sum(&simplices, D);
            let factor = Integer::from(if D == 2 { 2 } else { 6 }) << (shift as u32 * D as u32);
            let off = polytope.measure() * factor - sum;
            assert!(off.numer().abs() <= &error * off.denom());
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn sums(
            rows in prop::collection::vec((prop::array::uniform3(-20_i64..=20), 1_i64..40), 1..8),
            shift in 0_i64..12,
        ) {
            assert_sums::<3>(&rows, shift);
            let planar: Vec<([i64; 2], i64)> = rows.iter().map(|([x, y, _], c)| ([*x, *y], *c)).collect();
            assert_sums::<2>(&planar, shift);
        }
    }
}
