//! The parts of pieces that leaves name: their hull points, kept up to date while control points move.

use std::collections::HashMap;

use super::positions::Positions;
use super::shape::{Matrix, PartRows, Shape};

/// A part, or a whole piece whose hull points are not control points as they are.
pub struct Part {
    /// Its rows.
    pub rows: PartRows,
    /// Hull points times their weights, if they fit in 64 bits.
    hull: Vec<[i64; 3]>,
    /// The leaves `separate` that name it, by number, and some that are gone.
    pub separate: Vec<u64>,
    /// The leaves `monotone` that name it, or a run that it is a piece of.
    pub monotone: Vec<u64>,
}

impl Part {
    /// Hull points times their weights, if they are known.
    pub fn known(&self) -> Option<&[[i64; 3]]> {
        (!self.hull.is_empty()).then_some(&self.hull)
    }

    fn refresh(&mut self, positions: &Positions) {
        self.hull.clear();
        let (Matrix::Narrow(entries, bits), Some(points)) = (&self.rows.hull, positions.narrow()) else {
            return;
        };
        // Then no sum of products, in whatever order, is beyond 2^62.
        if bits + positions.bits() > 62 {
            return;
        }
        let points = &points[self.rows.first..self.rows.first + self.rows.count];
        for row in entries.chunks(self.rows.count) {
            let mut sum = [0i64; 3];
            for (factor, point) in row.iter().zip(points) {
                for axis in 0..3 {
                    sum[axis] += factor * point[axis];
                }
            }
            self.hull.push(sum);
        }
    }
}

/// All parts that were ever named, found by piece, depth and index.
#[derive(Default)]
pub struct Parts {
    list: Vec<Part>,
    keys: Vec<(usize, u32, u128)>,
    numbers: HashMap<(usize, u32, u128), usize>,
    of_piece: HashMap<usize, Vec<usize>>,
}

impl Parts {
    /// The number of a part, which is made if it is not there.
    pub fn number(&mut self, shape: &mut Shape, positions: &Positions, key: (usize, u32, u128)) -> usize {
        if let Some(number) = self.numbers.get(&key) {
            return *number;
        }
        let (piece, depth, index) = key;
        let number = self.list.len();
        let mut part = Part {
            rows: shape.part_rows(piece, depth, index),
            hull: Vec::new(),
            separate: Vec::new(),
            monotone: Vec::new(),
        };
        part.refresh(positions);
        self.list.push(part);
        self.keys.push(key);
        self.numbers.insert(key, number);
        self.of_piece.entry(piece).or_default().push(number);
        number
    }

    /// The number of a part that is there.
    pub fn find(&self, key: (usize, u32, u128)) -> Option<usize> {
        self.numbers.get(&key).copied()
    }

    /// Piece, depth and index of a part.
    pub fn key(&self, number: usize) -> (usize, u32, u128) {
        self.keys[number]
    }

    /// A part.
    pub fn get(&self, number: usize) -> &Part {
        &self.list[number]
    }

    /// A part, to be changed.
    pub fn get_mut(&mut self, number: usize) -> &mut Part {
        &mut self.list[number]
    }

    /// The parts of a piece.
    pub fn of_piece(&self, piece: usize) -> &[usize] {
        self.of_piece.get(&piece).map_or(&[], Vec::as_slice)
    }

    /// Computes the hull points of all parts.
    pub fn refresh(&mut self, positions: &Positions) {
        self.list.iter_mut().for_each(|part| part.refresh(positions));
    }

    /// Computes the hull points of the parts of a piece.
    pub fn update(&mut self, piece: usize, positions: &Positions) {
        for number in self.of_piece.get(&piece).into_iter().flatten() {
            self.list[*number].refresh(positions);
        }
    }
}
