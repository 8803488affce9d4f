//! Parameters at which a curve is asked about: the same for the same curve.

use crate::check::values::pieces::Pieces;
use crate::claim::values::Side;
use crate::number::{Integer, Rational, RationalExt};

/// Of a curve with more pieces, so many are sampled.
const MOST_PIECES: usize = 64;
/// The most bits of a parameter in a certificate.
const MOST_BITS: u64 = 4096;

/// A parameter and the sides from which it is looked at.
pub struct Sample {
    /// The parameter.
    pub parameter: Rational,
    /// One or both.
    pub sides: &'static [Side],
}

/// Numbers of at most [`MOST_PIECES`] pieces, evenly spread, the first and the last among them.
pub fn chosen(count: usize) -> Vec<usize> {
    let most = MOST_PIECES.min(count);
    let mut numbers: Vec<usize> = (0..most).map(|k| k * (count - 1) / (most - 1).max(1)).collect();
    numbers.dedup();
    numbers
}

/// The binary64 nearest to a number, exactly, if it lies strictly between two others; else the number itself.
pub fn rounded_between(x: Rational, low: &Rational, high: &Rational) -> Rational {
    match Rational::from_f64(x.to_f64()) {
        Some(rounded) if *low < rounded && rounded < *high => rounded,
        _ => x,
    }
}

/// low + (high − low)·p/q as a binary64 strictly between, where there is one.
pub fn between(low: &Rational, high: &Rational, p: usize, q: usize) -> Rational {
    let fraction = Rational::new(Integer::from(p), Integer::from(q));
    rounded_between(low + (high - low) * fraction, low, high)
}

/// The k-th local parameter p/q of a piece: 1/2, 1/3, 1/4, 2/3, 3/4, 1/9, 1/8, …: the sequences of van der Corput to the bases 2 and 3 in turn.
fn local(k: usize) -> (usize, usize) {
    let base = if k.is_multiple_of(2) { 2 } else { 3 };
    let (mut rest, mut p, mut q) = (k / 2 + 1, 0, 1);
    while rest > 0 {
        p = p * base + rest % base;
        q *= base;
        rest /= base;
    }
    (p, q)
}

/// The ends of the chosen pieces, the binary64 numbers beside them, and `each` parameters inside each piece.
pub fn samples(pieces: &Pieces, each: usize) -> Vec<Sample> {
    let count = pieces.pieces.len();
    let mut found = Vec::new();
    let mut add = |parameter: Rational, sides| {
        if parameter.numer().bits().max(parameter.denom().bits()) <= MOST_BITS {
            found.push(Sample { parameter, sides });
        }
    };
    let numbers = chosen(count);
    for &i in &numbers {
        let (low, high) = (&pieces.ends[i], &pieces.ends[i + 1]);
        let sides: &[Side] = if i == 0 {
            &[Side::Right]
        } else {
            &[Side::Left, Side::Right]
        };
        if i > 0
            && let Some(before) = neighbour(low, &pieces.ends[i - 1], low, false)
        {
            add(before, &[Side::Right]);
        }
        add(low.clone(), sides);
        if let Some(behind) = neighbour(low, low, high, true) {
            add(behind, &[Side::Right]);
        }
        for k in 0..each {
            let (p, q) = local(k);
            add(between(low, high, p, q), &[Side::Right]);
        }
        if i + 1 == count {
            if let Some(before) = neighbour(high, low, high, false) {
                add(before, &[Side::Right]);
            }
            add(high.clone(), &[Side::Left]);
        }
    }
    found
}

/// The binary64 next above or below a knot, if it is strictly between two parameters.
fn neighbour(knot: &Rational, low: &Rational, high: &Rational, above: bool) -> Option<Rational> {
    let near = knot.to_f64();
    let candidates = match above {
        true => [near, near.next_up()],
        false => [near, near.next_down()],
    };
    let exact = candidates.into_iter().filter_map(Rational::from_f64);
    let mut beside = exact.filter(|x| if above { x > knot } else { x < knot });
    beside.find(|x| low < x && x < high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn local_parameters() {
        let first: Vec<(usize, usize)> = (0..7).map(local).collect();
        assert_eq!(first, [(1, 2), (1, 3), (1, 4), (2, 3), (3, 4), (1, 9), (1, 8)]);
    }

    #[test]
    fn neighbours_are_one_ulp_away() {
        let number = |x: f64| Rational::from_f64(x).expect("finite");
        let (zero, one, two) = (number(0.0), number(1.0), number(2.0));
        assert_eq!(neighbour(&one, &zero, &two, true), Some(number(1.0 + f64::EPSILON)));
        assert_eq!(
            neighbour(&one, &zero, &two, false),
            Some(number(1.0 - f64::EPSILON / 2.0))
        );
        let third = &one / number(3.0);
        let below = neighbour(&third, &zero, &two, false).expect("one");
        assert!(below < third && third < neighbour(&third, &zero, &two, true).expect("one"));
        assert_eq!(neighbour(&one, &one, &number(1.0 + f64::EPSILON), true), None);
    }

    #[test]
    fn pieces_are_spread() {
        assert_eq!(chosen(1), [0]);
        assert_eq!(chosen(3), [0, 1, 2]);
        let many = chosen(1000);
        assert_eq!((many.len(), many[0], many[63]), (64, 0, 999));
    }
}
