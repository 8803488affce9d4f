//! A reproducible source of choices.

/// SplitMix64 (Steele, Lea, Flood 2014): the same everywhere and in all versions, so that a seed names its cases for good.
pub(super) struct Random(u64);

impl Random {
    /// The source of one case: cases do not depend on how many there are.
    pub(super) fn new(seed: u64, index: u64) -> Random {
        let mut outer = Random(seed);
        let base = outer.next();
        Random(base ^ Random(index.wrapping_add(1)).next())
    }

    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `count`; 0 when that is 0.
    pub(super) fn below(&mut self, count: usize) -> usize {
        if count == 0 {
            return 0;
        }
        // The bias of a remainder of 64 bits does not matter for choices as small as these.
        (self.next() % count as u64) as usize
    }

    /// A whole number from `low` to `high`.
    pub(super) fn whole(&mut self, low: i64, high: i64) -> i64 {
        low + self.below((high - low + 1) as usize) as i64
    }

    /// A multiple of 2^-53 in [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// True `percent` times of a hundred.
    pub(super) fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    /// An index, drawn with the given weights.
    pub(super) fn weighted(&mut self, weights: &[usize]) -> usize {
        let mut left = self.below(weights.iter().sum());
        for (i, weight) in weights.iter().enumerate() {
            if left < *weight {
                return i;
            }
            left -= weight;
        }
        0
    }
}
