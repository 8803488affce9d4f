//! The greatest of many values of which a few change at a time.

/// A tournament of the numbers 0 … count−1: each inner node holds the winner of the two below it.
pub struct Greatest {
    /// The number of leaves, a power of two.
    leaves: usize,
    winners: Vec<u32>,
}

/// No number: it loses to every other.
const NOBODY: u32 = u32::MAX;

impl Greatest {
    /// A tournament of `count` numbers, where `less` compares two of them.
    pub fn new(count: usize, less: impl Fn(usize, usize) -> bool) -> Self {
        let leaves = count.next_power_of_two();
        let mut greatest = Greatest {
            leaves,
            winners: vec![NOBODY; 2 * leaves],
        };
        for i in 0..count {
            greatest.winners[leaves + i] = i as u32;
        }
        greatest.refresh(less);
        greatest
    }

    /// Plays all games.
    pub fn refresh(&mut self, less: impl Fn(usize, usize) -> bool) {
        for node in (1..self.leaves).rev() {
            self.play(node, &less);
        }
    }

    /// Plays the games of one number.
    pub fn update(&mut self, i: usize, less: impl Fn(usize, usize) -> bool) {
        let mut node = (self.leaves + i) / 2;
        while node > 0 {
            self.play(node, &less);
            node /= 2;
        }
    }

    fn play(&mut self, node: usize, less: &impl Fn(usize, usize) -> bool) {
        let (a, b) = (self.winners[2 * node], self.winners[2 * node + 1]);
        self.winners[node] = if b == NOBODY || a != NOBODY && !less(a as usize, b as usize) {
            a
        } else {
            b
        };
    }

    /// The number that has the greatest value; `None` if there are no numbers.
    pub fn winner(&self) -> Option<usize> {
        let winner = self.winners[1];
        (winner != NOBODY).then_some(winner as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_winner_is_the_greatest(
            mut values in proptest::collection::vec(0u32..50, 0..40),
            changes in proptest::collection::vec((any::<proptest::sample::Index>(), 0u32..50), 0..20),
        ) {
            let mut greatest = Greatest::new(values.len(), |i, j| values[i] < values[j]);
            prop_assert_eq!(greatest.winner().map(|i| values[i]), values.iter().copied().max());
            for (index, value) in changes {
                if values.is_empty() {
                    break;
                }
                let i = index.index(values.len());
                values[i] = value;
                greatest.update(i, |i, j| values[i] < values[j]);
                prop_assert_eq!(greatest.winner().map(|i| values[i]), values.iter().copied().max());
            }
        }
    }
}
