//! The span of a parameter, in constant time for knots that are not too uneven.

use super::curve::Curve;

/// The non-empty spans of a curve, and for equal parts of the domain the first span that meets each.
pub(super) struct Locator {
    /// The distinct knots of the domain.
    breaks: Vec<f64>,
    /// For each part the number of a span, not after that of any parameter in it.
    parts: Vec<u32>,
    /// Parts per unit.
    scale: f64,
}

/// Steps from the span found in the table, before a binary search.
const STEPS: usize = 4;

impl Locator {
    /// For the domain of a curve.
    pub(super) fn new(curve: &Curve) -> Locator {
        let mut breaks = curve.knots[curve.degree..=curve.count()].to_vec();
        breaks.dedup();
        let spans = breaks.len() - 1;
        let count = if spans == 1 { 1 } else { 2 * spans };
        let (start, end) = (breaks[0], breaks[spans]);
        let mut locator = Locator {
            parts: vec![0; count],
            scale: count as f64 / (end - start),
            breaks,
        };
        let mut i = 0;
        for part in 0..count {
            // Rounding is monotone: a parameter of this part is not before a knot of an earlier one.
            while i + 1 < spans && locator.part(locator.breaks[i + 1]) < part {
                i += 1;
            }
            locator.parts[part] = i as u32;
        }
        locator
    }

    #[inline(always)]
    fn part(&self, t: f64) -> usize {
        (((t - self.breaks[0]) * self.scale) as i32 as usize).min(self.parts.len() - 1)
    }

    /// How many spans there are.
    pub(super) fn count(&self) -> usize {
        self.breaks.len() - 1
    }

    /// The two ends of the domain.
    #[inline(always)]
    pub(super) fn domain(&self) -> (f64, f64) {
        (self.breaks[0], self.breaks[self.breaks.len() - 1])
    }

    /// The two ends of a span.
    #[inline(always)]
    pub(super) fn ends(&self, i: usize) -> (f64, f64) {
        (self.breaks[i], self.breaks[i + 1])
    }

    /// The number of the span of t, which is in the domain: the span that begins at t where t is a knot, but the last one at the end.
    #[inline(always)]
    pub(super) fn span(&self, t: f64) -> usize {
        let first = self.parts[self.part(t)] as usize;
        // Without the last one: at the end of the domain the walk stops there.
        let ends = &self.breaks[first + 1..self.breaks.len() - 1];
        let mut steps = 0;
        while steps < ends.len() && ends[steps] <= t {
            steps += 1;
            if steps > STEPS {
                return first + ends.partition_point(|end| *end <= t);
            }
        }
        first + steps
    }
}
