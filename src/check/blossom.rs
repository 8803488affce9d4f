//! The Bézier points of a B-spline's knot intervals, by the blossom (FORMAT §3).

use super::word::{Word, widening};
use crate::curve::BSpline;
use crate::number::Integer;

/// For every non-empty knot interval in order: the p+1 Bézier points, `stride` numbers each, of the spline with the control points
/// `coordinates` (`stride` numbers each, as many as the spline has), and the positive integer that they are multiplied by.
///
/// In integers, of a width that holds them: in round r all values of an interval are brought over the least common multiple of that round's knot differences,
/// which depends on the interval alone; so the p+1 blossom values of an interval have one denominator.
pub fn interval_values<'s>(
    spline: &'s BSpline,
    coordinates: &'s [Integer],
    stride: usize,
) -> impl Iterator<Item = (Vec<Integer>, Integer)> + 's {
    let p = spline.degree();
    let knots = spline.knots().numerators();
    let intervals = (p..spline.count()).filter(|j| knots[*j] != knots[*j + 1]);
    intervals.map(move |j| {
        // Knot differences are differences of numerators: their common denominator cancels in λ.
        let difference = |i: usize, r: usize| &knots[i + 1 + j - r] - &knots[i + j - p];
        let multiples: Vec<Integer> = (1..=p)
            .map(|r| (r..=p).fold(Integer::from(1), |lcm, i| lcm.lcm(&difference(i, r))))
            .collect();
        let shares: Vec<Vec<Integer>> = (1..=p)
            .map(|r| (r..=p).map(|i| multiples[r - 1].div_exact(&difference(i, r))).collect())
            .collect();
        let interval = KnotInterval {
            degree: p,
            stride,
            knots: &knots[j - p..=j + p + 1],
            shares: &shares,
        };
        let control = &coordinates[(j - p) * stride..(j + 1) * stride];
        let values = widening!(0, W => blossom_values::<W>(&interval, control));
        let whole = multiples
            .iter()
            .fold(Integer::from(1), |product, multiple| product * multiple);
        (values, whole)
    })
}

/// What the blossom values of a knot interval are made of.
struct KnotInterval<'k> {
    degree: usize,
    /// Numbers for each control point.
    stride: usize,
    /// The knots j−p … j+p+1 around the interval from knot j to knot j+1.
    knots: &'k [Integer],
    /// For round r and index i, at [r−1][i−r]: the round's common multiple of knot differences over the difference of i.
    shares: &'k [Vec<Integer>],
}

/// The p+1 blossom values of a knot interval, times the common multiples of all rounds.
fn blossom_values<W: Word>(interval: &KnotInterval, control: &[Integer]) -> Option<Vec<Integer>> {
    let (p, stride) = (interval.degree, interval.stride);
    let words = |numbers: &[Integer]| numbers.iter().map(W::from_integer).collect::<Option<Vec<W>>>();
    let (knots, control) = (words(interval.knots)?, words(control)?);
    let shares = interval.shares.iter().map(|shares| words(shares));
    let shares = shares.collect::<Option<Vec<_>>>()?;
    let mut values = Vec::with_capacity((p + 1) * stride);
    for k in 0..=p {
        let mut d = control.clone();
        for r in 1..=p {
            let argument = if r <= p - k { &knots[p] } else { &knots[p + 1] };
            for i in (r..=p).rev() {
                let share = &shares[r - 1][i - r];
                let before = knots[i + 1 + p - r].minus(argument)?.times(share)?;
                let after = argument.minus(&knots[i])?.times(share)?;
                for axis in 0..stride {
                    let earlier = before.times(&d[(i - 1) * stride + axis])?;
                    d[i * stride + axis] = earlier.plus(&after.times(&d[i * stride + axis])?)?;
                }
            }
        }
        values.extend(d[p * stride..].iter().map(Word::to_integer));
    }
    Some(values)
}
