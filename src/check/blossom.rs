//! The Bézier points of a B-spline's knot intervals, by the blossom (FORMAT §3).

use crate::curve::BSpline;
use crate::number::Integer;

/// For every non-empty knot interval in order: the p+1 Bézier points, `stride` numbers each, of the spline with the control points
/// `coordinates` (`stride` numbers each, as many as the spline has), and the positive integer that they are multiplied by.
///
/// In integers: in round r all values of an interval are brought over the least common multiple of that round's knot differences,
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
        let mut values = Vec::with_capacity((p + 1) * stride);
        for k in 0..=p {
            let mut d: Vec<Integer> = coordinates[(j - p) * stride..(j + 1) * stride].to_vec();
            for r in 1..=p {
                let argument = if r <= p - k { &knots[j] } else { &knots[j + 1] };
                for i in (r..=p).rev() {
                    let share = &shares[r - 1][i - r];
                    let before = (&knots[i + 1 + j - r] - argument) * share;
                    let after = (argument - &knots[i + j - p]) * share;
                    for axis in 0..stride {
                        d[i * stride + axis] = &before * &d[(i - 1) * stride + axis] + &after * &d[i * stride + axis];
                    }
                }
            }
            values.extend_from_slice(&d[p * stride..]);
        }
        let whole = multiples
            .iter()
            .fold(Integer::from(1), |product, multiple| product * multiple);
        (values, whole)
    })
}
