//! Polynomials by their Bernstein coefficients on [0, 1], up to a positive factor, in integers.

use crate::number::Integer;

/// How often a polynomial is halved at most.
const MOST_HALVINGS: usize = 60;
/// How many parts of a polynomial are looked at, at most.
const MOST_PARTS: usize = 4096;

/// Which sign is to be shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Every coefficient of every part ≥ 0.
    NonNegative,
    /// Every coefficient of every part > 0.
    Positive,
}

impl Bound {
    fn holds(self, coefficient: &Integer) -> bool {
        match self {
            Bound::NonNegative => !coefficient.is_negative(),
            Bound::Positive => coefficient.is_positive(),
        }
    }
}

/// Why a sign is not shown by halving.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotShown {
    /// The polynomial has the wrong sign at numerator / 2^halvings.
    At {
        /// The numerator of that place.
        numerator: u64,
        /// How often the polynomial was halved.
        halvings: usize,
    },
    /// The limits of halving were reached.
    Limits,
}

/// The halves of a polynomial, each up to a positive factor (de Casteljau).
pub fn halves(coefficients: &[Integer]) -> (Vec<Integer>, Vec<Integer>) {
    let degree = coefficients.len() - 1;
    let mut row = coefficients.to_vec();
    let mut left = Vec::with_capacity(row.len());
    let mut right = vec![Integer::ZERO; row.len()];
    for round in 0..=degree {
        // Sums of 2^round coefficients stand for their means.
        let shift = (degree - round) as u32;
        left.push(&row[0] << shift);
        right[degree - round] = &row[degree - round] << shift;
        for k in 0..degree - round {
            row[k] = &row[k] + &row[k + 1];
        }
    }
    (left, right)
}

/// Shows by halving that the polynomial has a sign on [0, 1] (FORMAT §9).
///
/// Sound because a polynomial lies in the convex hull of its Bernstein coefficients on every part; the limits only bound the work.
///
/// # Errors
/// A place where the sign is wrong, or that the limits of halving were reached.
pub fn show(coefficients: Vec<Integer>, bound: Bound) -> Result<(), NotShown> {
    let mut parts = vec![(coefficients, 0u64, 0usize)];
    let mut looked_at = 0;
    while let Some((part, position, halvings)) = parts.pop() {
        looked_at += 1;
        if looked_at > MOST_PARTS {
            return Err(NotShown::Limits);
        }
        let last = part.len() - 1;
        for (end, numerator) in [(0, position), (last, position + 1)] {
            if !bound.holds(&part[end]) {
                return Err(NotShown::At { numerator, halvings });
            }
        }
        if part.iter().all(|coefficient| bound.holds(coefficient)) {
            continue;
        }
        if halvings == MOST_HALVINGS {
            return Err(NotShown::Limits);
        }
        let (left, right) = halves(&part);
        parts.push((right, 2 * position + 1, halvings + 1));
        parts.push((left, 2 * position, halvings + 1));
    }
    Ok(())
}

/// Coefficients times the binomials of the degree, so that products are convolutions.
pub fn scaled(coefficients: &[Integer]) -> Vec<Integer> {
    let degree = (coefficients.len() - 1) as u32;
    let factors = (0..=degree).map(|k| Integer::binomial(degree, k));
    factors.zip(coefficients).map(|(binomial, x)| binomial * x).collect()
}

/// The product of polynomials, all given by their coefficients times binomials.
pub fn convolution(a: &[Integer], b: &[Integer]) -> Vec<Integer> {
    let mut product = vec![Integer::ZERO; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate().filter(|(_, x)| !x.is_zero()) {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

/// The product, times the binomials of its own degree: Σ C(m,i) C(n,j) a_i b_j for every i + j.
pub fn scaled_product(a: &[Integer], b: &[Integer]) -> Vec<Integer> {
    convolution(&scaled(a), &scaled(b))
}

/// From coefficients times the binomials of the degree to coefficients times one positive integer, which is returned too.
pub fn unscaled(scaled: Vec<Integer>) -> (Vec<Integer>, Integer) {
    let degree = scaled.len() - 1;
    let binomials: Vec<Integer> = (0..=degree)
        .map(|k| Integer::binomial(degree as u32, k as u32))
        .collect();
    let multiple = binomials.iter().fold(Integer::ONE, |lcm, binomial| lcm.lcm(binomial));
    let coefficients = scaled
        .iter()
        .zip(&binomials)
        .map(|(coefficient, binomial)| coefficient * multiple.div_exact(binomial))
        .collect();
    (coefficients, multiple)
}
