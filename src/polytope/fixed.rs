//! Numbers between −8 and 8 in steps of 2⁻¹²⁰, called *units*: the second of three layers, between binary64 and exact integers.
//!
//! Truncation errors of fixed-point numbers are absolute, so bounds on them are sums of small integers, without any case of underflow or
//! overflow. The bounds used elsewhere follow from two facts. A coefficient is at most 1 unit off ([`scale`]). A product of x and y
//! whose errors are e and f units is off by at most |x|·f + |y|·e + e·f·2⁻¹²⁰ + 1 units ([`multiply`] drops less than one).

use crate::number::Integer;

/// Number of binary digits after the point.
pub(super) const FRACTION: u32 = 120;
/// The number 1.
pub(super) const UNIT: i128 = 1 << FRACTION;
/// Coordinates of a vertex, the greatest of them at least ½ and at most 1, are off by at most so many units, 2⁻⁶⁰ in all.
pub(super) const MOST_ERROR: i128 = 1 << 60;

/// x · y, truncated towards zero; |x| and |y| are below 8 and the product below 64.
#[inline]
pub(super) fn multiply(x: i128, y: i128) -> i128 {
    const LOW: u128 = u64::MAX as u128;
    let (a, b) = (x.unsigned_abs(), y.unsigned_abs());
    let (a1, a0, b1, b0) = (a >> 64, a & LOW, b >> 64, b & LOW);
    // The high parts are below 2^59, so nothing here reaches 2^128.
    let middle = a1 * b0 + a0 * b1 + ((a0 * b0) >> 64);
    let high = a1 * b1 + (middle >> 64);
    let magnitude = ((high << (128 - FRACTION)) | ((middle & LOW) >> (FRACTION - 64))) as i128;
    if (x < 0) == (y < 0) { magnitude } else { -magnitude }
}

/// The numbers times a common power of two, rounded down to units, so that the greatest magnitude is at least ½ and at most 1; all zero if
/// they are. Each result is less than 1 unit too small.
pub(super) fn scale(numbers: [&Integer; 4]) -> [i128; 4] {
    let bits = numbers.iter().map(|number| number.bits()).max().unwrap_or(0);
    numbers.map(|number| {
        let shifted = if bits <= u64::from(FRACTION) {
            number.to_i128().map(|value| value << (u64::from(FRACTION) - bits))
        } else {
            // Memory bounds integers far below 2^(2^32).
            (number >> (bits - u64::from(FRACTION)) as u32).to_i128()
        };
        shifted.unwrap_or(0)
    })
}

/// The numbers times a common power of two, rounded to nearest, so that the greatest magnitude is at least ½ and at most 1; all zero
/// if they are. Each result is off by at most 2⁻⁵⁴.
pub(super) fn to_binary64(numbers: [&Integer; 4]) -> [f64; 4] {
    let parts = numbers.map(Integer::to_f64_exponent);
    let greatest = parts.iter().filter(|part| part.0 != 0.0).map(|part| part.1).max();
    parts.map(|(mantissa, exponent)| {
        // 2^-1000 is far below the error bound; and above it the power and the product are exact.
        match greatest.map(|greatest| exponent - greatest) {
            Some(down @ -1000..=0) => mantissa * power_of_two(down),
            _ => 0.0,
        }
    })
}

/// 2^exponent for −1022 ≤ exponent ≤ 0.
fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// A point in the plane (third coordinate 0) or in space by fixed-point homogeneous coordinates, the weight last: the greatest magnitude is
/// at least ½ and at most 1, the weight is not negative, and all coordinates are within `error` units of those of the point times one positive number.
#[derive(Clone, Debug)]
pub(super) struct FixedPoint {
    pub(super) coordinates: [i128; 4],
    pub(super) error: i128,
}

impl FixedPoint {
    /// From exact homogeneous coordinates with a positive weight.
    pub(super) fn from_exact(exact: &[Integer; 4]) -> Self {
        let [x, y, z, w] = exact;
        FixedPoint {
            coordinates: scale([x, y, z, w]),
            error: 1,
        }
    }

    /// The point common to two lines or three planes with coefficients as [`scale`] gives them; `None` when these numbers do not tell it with
    /// an error of at most [`MOST_ERROR`], or not the sign of its weight.
    pub(super) fn meet(rows: [&[i128; 4]; 3], dimension: usize) -> Option<Self> {
        let coordinates = match dimension {
            2 => meet_lines(rows[0], rows[1], |x, y| multiply(*x, *y), |x, y| x - y),
            _ => meet_planes(rows, |x, y| multiply(*x, *y), |x, y| x - y, |x, y| x + y),
        };
        // A 2 × 2 minor is at most 2, and off by 2 · (1 + 1 + 1) units and a trifle, so by at most 7. A 3 × 3 minor is the sum of three products of
        // a coefficient with one of these: at most 6, and off by 3 · (7 + 2 + 1) units and a trifle, so by at most 31.
        const ERROR: i128 = 31;
        let greatest = coordinates.iter().map(|x| x.abs()).max().unwrap_or(0);
        if greatest == 0 {
            return None;
        }
        // The leading bit goes to position FRACTION − 1.
        let up = greatest.leading_zeros() as i32 - (128 - FRACTION as i32);
        let (coordinates, error) = if up >= 0 {
            (coordinates.map(|x| x << up), ERROR << up)
        } else {
            (coordinates.map(|x| x >> -up), (ERROR >> -up) + 2)
        };
        let weight = coordinates[3];
        if error > MOST_ERROR || weight.abs() <= error {
            return None;
        }
        let coordinates = if weight > 0 {
            coordinates
        } else {
            coordinates.map(|x| -x)
        };
        Some(FixedPoint { coordinates, error })
    }

    /// The coordinates in binary64, each at most 2⁻⁵³ off.
    pub(super) fn to_binary64(&self) -> [f64; 4] {
        // Rounding to nearest is off by at most 2^-54 for numbers up to 1, and the numbers themselves by 2^-60; the factor is exact.
        self.coordinates.map(|x| x as f64 / UNIT as f64)
    }

    /// The sign of Σ rowᵢ · coordinateᵢ, for a row as [`scale`] gives it; `None` when the errors leave it open.
    pub(super) fn side(&self, row: &[i128; 4]) -> Option<i8> {
        let sum: i128 = (0..4).map(|i| multiply(row[i], self.coordinates[i])).sum();
        // Per term: |row| · error + |coordinate| · 1 + error · 2^-120 + 1, less than error + 3.
        let bound = 4 * (self.error + 3);
        (sum.abs() > bound).then_some(if sum > 0 { 1 } else { -1 })
    }
}

/// Homogeneous coordinates (x, y, 0, w) of the point common to two lines (a, b, ·, c): their cross product.
pub(super) fn meet_lines<T: Default>(
    a: &[T; 4],
    b: &[T; 4],
    product: impl Fn(&T, &T) -> T,
    difference: impl Fn(T, T) -> T,
) -> [T; 4] {
    let minor = |i: usize, j: usize| difference(product(&a[i], &b[j]), product(&a[j], &b[i]));
    [minor(1, 3), minor(3, 0), T::default(), minor(0, 1)]
}

/// Homogeneous coordinates of the point common to three planes: their cross product in four dimensions, that is the 3 × 3 minors with
/// alternating signs, from the 2 × 2 minors of the first two.
pub(super) fn meet_planes<T>(
    [a, b, c]: [&[T; 4]; 3],
    product: impl Fn(&T, &T) -> T,
    difference: impl Fn(T, T) -> T,
    sum: impl Fn(T, T) -> T,
) -> [T; 4] {
    let minor = |i: usize, j: usize| difference(product(&a[i], &b[j]), product(&a[j], &b[i]));
    let (xy, xz, xw) = (minor(0, 1), minor(0, 2), minor(0, 3));
    let (yz, yw, zw) = (minor(1, 2), minor(1, 3), minor(2, 3));
    // c_i · m_jk − c_j · m_ik + c_k · m_ij, and its negative.
    let [cx, cy, cz, cw] = c;
    let plus =
        |p: &T, jk: &T, q: &T, ik: &T, r: &T, ij: &T| sum(difference(product(p, jk), product(q, ik)), product(r, ij));
    let minus = |p: &T, jk: &T, q: &T, ik: &T, r: &T, ij: &T| {
        difference(difference(product(q, ik), product(p, jk)), product(r, ij))
    };
    [
        plus(cy, &zw, cz, &yw, cw, &yz),
        minus(cx, &zw, cz, &xw, cw, &xz),
        plus(cx, &yw, cy, &xw, cw, &xy),
        minus(cx, &yz, cy, &xz, cz, &xy),
    ]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::number::{Rational, RationalExt};

    /// Rows of similar size, many of them nearly parallel, with coefficients of up to 200 bits.
    fn rows() -> impl Strategy<Value = [[Integer; 4]; 4]> {
        let row = || prop::array::uniform4(-(1_i64 << 40)..1 << 40);
        (prop::array::uniform4(row()), row(), 0_u32..150, 0_u32..60).prop_map(|(rows, common, shift, near)| {
            rows.map(|row| {
                let mut i = 0;
                row.map(|coefficient| {
                    i += 1;
                    let common = Integer::from(common[i - 1]) << near;
                    ((common + Integer::from(coefficient)) << shift) + Integer::from(i as i64)
                })
            })
        })
    }

    fn borrowed(row: &[Integer; 4]) -> [&Integer; 4] {
        row.each_ref()
    }

    /// Asserts that the numbers over 2^-FRACTION are within `error` units of those of `exact` times one positive number, by the exact scale.
    fn assert_near(fixed: &[i128; 4], exact: &[Rational; 4], error: i128) {
        for (fixed, exact) in fixed.iter().zip(exact) {
            let off = Rational::from_integer(Integer::from(*fixed)) - exact;
            let error = Rational::from_integer(Integer::from(error));
            assert!(off <= error && -off <= error);
        }
    }

    /// The numbers times the power of two by which [`scale`] multiplies them, in units.
    fn scaled(exact: &[Integer; 4]) -> [Rational; 4] {
        let bits = exact.iter().map(Integer::bits).max().unwrap_or(0) as u32;
        exact
            .each_ref()
            .map(|x| Rational::new(x << FRACTION, Integer::ONE << bits))
    }

    fn meet(rows: &[[Integer; 4]; 4], dimension: usize) -> [Integer; 4] {
        let exact = if dimension == 2 {
            meet_lines(&rows[0], &rows[1], |x, y| x * y, |x, y| x - y)
        } else {
            let planes = [&rows[0], &rows[1], &rows[2]];
            meet_planes(planes, |x, y| x * y, |x, y| x - y, |x, y| x + y)
        };
        if exact[3].is_negative() {
            exact.map(|x| -x)
        } else {
            exact
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn products(x in -(1_i128 << 122)..1 << 122, y in -(1_i128 << 122)..1 << 122) {
            let exact = Integer::from(x) * Integer::from(y);
            let truncated = exact.abs() >> FRACTION;
            let truncated = if exact.is_negative() { -truncated } else { truncated };
            prop_assert_eq!(Integer::from(multiply(x, y)), truncated);
        }

        #[test]
        fn coefficients(rows in rows()) {
            let exact = scaled(&rows[0]);
            assert_near(&scale(borrowed(&rows[0])), &exact, 1);
            let rounded = to_binary64(borrowed(&rows[0]));
            for (rounded, exact) in rounded.iter().zip(&exact) {
                let off = Rational::from_f64(*rounded).unwrap() - exact / (Integer::ONE << FRACTION);
                let bound = Rational::new(Integer::ONE, Integer::ONE << 54);
                prop_assert!(off <= bound && -off <= bound);
            }
            let greatest = rounded.iter().fold(0.0_f64, |greatest, x| greatest.max(x.abs()));
            prop_assert!((0.5..=1.0).contains(&greatest));
        }

        #[test]
        fn points_and_sides(rows in rows(), dimension in 2_usize..=3) {
            let mut rows = rows;
            if dimension == 2 {
                rows.iter_mut().for_each(|row| row[2] = Integer::ZERO);
            }
            // The rows as the fixed-point numbers are meant: each at the scale of its greatest coefficient.
            let fixed = rows.each_ref().map(|row| scale(borrowed(row)));
            let exact = meet(&rows, dimension);
            let found = FixedPoint::meet([&fixed[0], &fixed[1], &fixed[2]], dimension);
            let points = found.into_iter().chain((exact[3].is_positive()).then(|| FixedPoint::from_exact(&exact)));
            for point in points {
                prop_assert!(exact[3].is_positive());
                // The bound of the binary64 layer counts on this.
                prop_assert!(point.error <= 1 << 60);
                // Some positive factor brings the exact coordinates within the error of all computed ones: the factors that do so for one are an interval.
                let mut range: [Option<Rational>; 2] = [None, None];
                for (computed, exact) in point.coordinates.iter().zip(&exact) {
                    let ends = [-point.error, point.error].map(|error| Rational::from_integer(Integer::from(computed + error)));
                    if exact.is_zero() {
                        prop_assert!(computed.abs() <= point.error);
                        continue;
                    }
                    let mut ends = ends.map(|end| end / exact);
                    ends.sort();
                    let [low, high] = ends;
                    let [least, greatest] = range;
                    range = [
                        Some(least.map_or(low.clone(), |least| least.max(low))),
                        Some(greatest.map_or(high.clone(), |greatest| greatest.min(high))),
                    ];
                }
                let [Some(least), Some(greatest)] = range else { panic!("a weight is not zero") };
                prop_assert!(least <= greatest && greatest.numer().is_positive());
                // All rows, the common ones included: their sign is 0 and must stay open.
                for (row, fixed) in rows.iter().zip(&fixed) {
                    let value: Integer = (0..4).map(|i| &row[i] * &exact[i]).sum();
                    if let Some(side) = point.side(fixed) {
                        prop_assert_eq!(side, value.sign() as i8);
                    }
                }
            }
        }
    }
}
