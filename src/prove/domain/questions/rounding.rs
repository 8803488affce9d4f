//! Short numbers next to long ones.

use crate::number::{Integer, Rational, RationalExt};

/// The greatest number at most `x` with `bits` leading bits, for x ≥ 0.
pub fn down(x: &Rational, bits: u32) -> Rational {
    on_grid(x, bits, |x, shift| x.floor_shifted(shift), Integer::div_floor)
}

/// The least number at least `x` with about `bits` leading bits, for x ≥ 0.
pub fn up(x: &Rational, bits: u32) -> Rational {
    on_grid(x, bits, |x, shift| x.ceil_shifted(shift), Integer::div_ceil)
}

fn on_grid(
    x: &Rational,
    bits: u32,
    shifted: impl Fn(&Rational, u32) -> Integer,
    divided: impl Fn(&Integer, &Integer) -> Integer,
) -> Rational {
    let exponent = i64::from(bits) - (x.numer().bits() as i64 - x.denom().bits() as i64);
    let shift = u32::try_from(exponent.unsigned_abs()).unwrap_or(u32::MAX);
    if exponent >= 0 {
        Rational::new(shifted(x, shift), Integer::ONE << shift)
    } else {
        let unit = Integer::ONE << shift;
        Rational::from_integer(divided(x.numer(), &(x.denom() * &unit)) * unit)
    }
}

/// How many leading bits keep a rounding below a small part of a tolerance.
pub fn bits_for(tolerance: &Rational) -> u32 {
    let bits = tolerance.denom().bits() as i64 - tolerance.numer().bits() as i64;
    u32::try_from(bits.clamp(0, 4096)).unwrap_or(0) + 8
}

/// A difference in binary64.
pub fn difference(a: &[Rational], b: &[Rational]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| (x - y).to_f64()).collect()
}

/// |a|.
pub fn length(a: &[f64]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// origin + arm, on a grid of the greatest power of two that is at most `grid`; `None` for what is not finite.
pub fn offset(origin: &[Rational], arm: &[f64], grid: f64) -> Option<Vec<Rational>> {
    let exponent = grid.log2().floor();
    if !exponent.is_finite() || exponent.abs() > 1000.0 {
        return None;
    }
    let grid = Rational::from_f64(2f64.powi(exponent as i32))?;
    let on_grid = |(x, y): (&Rational, &f64)| Some(((x + Rational::from_f64(*y)?) / &grid).round() * &grid);
    origin.iter().zip(arm).map(on_grid).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn outward(p in 0_i64.., q in 1_i64.., shift in 0_u32..200, bits in 2_u32..80) {
            for x in [Rational::new(Integer::from(p) << shift, q.into()), Rational::new(p.into(), Integer::from(q) << shift)] {
                let (low, high) = (down(&x, bits), up(&x, bits));
                prop_assert!(low <= x && x <= high);
                let width = &x * Rational::new(Integer::from(4), Integer::ONE << bits);
                prop_assert!(high - &low <= width);
                prop_assert!(low.numer().bits() <= u64::from(bits) + 1 || low.is_integer());
            }
        }
    }
}
