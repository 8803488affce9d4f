//! The parts of pieces that leaves name: their hull points, kept up to date while control points move.

use std::collections::HashMap;

use super::obligation::Points;
use super::positions::Positions;
use super::shape::{Matrix, PartRows, Shape};
use crate::number::Integer;

/// Sums of magnitude 2^62 and above are not trusted to 64 bits.
const MOST_BITS: u32 = 62;

/// Where the hull points of a polynomial part come from: every half is made of the whole.
#[derive(Clone, Copy)]
enum Origin {
    /// From its rows.
    Rows,
    /// The left or right half of a piece with its control points as they are.
    OfPiece { right: bool },
    /// The left or right half of another part.
    OfPart { part: usize, right: bool },
}

/// A part, or a whole piece whose hull points are not control points as they are.
pub struct Part {
    /// Its rows.
    pub rows: PartRows,
    origin: Origin,
    /// The first of its hull points in the common list.
    at: usize,
    /// What its hull points are multiplied by there, if it is one number of 64 bits; else 0.
    weight: i64,
    /// Are its hull points there now?
    known: bool,
    /// The leaves `separate` that name it, by number, and some that are gone.
    pub separate: Vec<u64>,
    /// The leaves `monotone` that name it, or a run that it is a piece of.
    pub monotone: Vec<u64>,
}

/// All parts that were ever named, and those they are halves of, found by piece, depth and index.
#[derive(Default)]
pub struct Parts {
    list: Vec<Part>,
    keys: Vec<(usize, u32, u128)>,
    /// Hull points times their weights.
    hull: Vec<[i64; 3]>,
    numbers: HashMap<(usize, u32, u128), usize>,
    of_piece: HashMap<usize, Vec<usize>>,
}

/// A polynomial part's hull points times a weight, all in 64 bits.
#[derive(Clone, Copy)]
pub struct Known<'p> {
    /// The points times the weight.
    pub points: &'p [[i64; 3]],
    /// The weight.
    pub weight: i64,
}

impl Known<'_> {
    /// The bit length of the weight.
    pub fn weight_bits(&self) -> u32 {
        u64::BITS - self.weight.unsigned_abs().leading_zeros()
    }
}

/// The control points of a half times 2^degree, by de Casteljau. All sums are known to fit.
fn halve(whole: &[[i64; 3]], right: bool, half: &mut [[i64; 3]]) {
    let degree = whole.len() - 1;
    let mut row = [[0i64; 3]; 65];
    let row = &mut row[..=degree];
    row.copy_from_slice(whole);
    if right {
        row.reverse();
    }
    for (k, out) in half.iter_mut().enumerate() {
        *out = row[0].map(|x| x << (degree - k));
        for i in 0..degree - k {
            row[i] = [0, 1, 2].map(|axis| row[i][axis] + row[i + 1][axis]);
        }
    }
    if right {
        half.reverse();
    }
}

/// The same for cubic parts, which are most.
fn halve_cubic(b: &[[i64; 3]; 4], right: bool) -> [[i64; 3]; 4] {
    let sum = |p: &[i64; 3], q: &[i64; 3]| [p[0] + q[0], p[1] + q[1], p[2] + q[2]];
    let times = |p: &[i64; 3], bits: u32| [p[0] << bits, p[1] << bits, p[2] << bits];
    let (first, middle, last) = (sum(&b[0], &b[1]), sum(&b[1], &b[2]), sum(&b[2], &b[3]));
    let (before, after) = (sum(&first, &middle), sum(&middle, &last));
    let center = sum(&before, &after);
    if right {
        [center, times(&after, 1), times(&last, 2), times(&b[3], 3)]
    } else {
        [times(&b[0], 3), times(&first, 2), times(&before, 1), center]
    }
}

impl Parts {
    /// The number of a part, which is made if it is not there.
    pub fn number(&mut self, shape: &mut Shape, positions: &Positions, key: (usize, u32, u128)) -> usize {
        if let Some(number) = self.numbers.get(&key) {
            return *number;
        }
        let (piece, depth, index) = key;
        let rows = shape.part_rows(piece, depth, index);
        let right = index % 2 == 1;
        let origin = if rows.tangents.is_some() || depth == 0 {
            Origin::Rows
        } else if depth == 1 && shape.pieces[piece].direct {
            Origin::OfPiece { right }
        } else {
            let part = self.number(shape, positions, (piece, depth - 1, index / 2));
            Origin::OfPart { part, right }
        };
        let degree = rows.count as u32 - 1;
        let doubled = |weight: i64| {
            weight
                .checked_mul(1i64.checked_shl(degree)?)
                .filter(|weight| *weight > 0)
        };
        let weight = match origin {
            Origin::Rows if rows.weights.len() > 1 => None,
            Origin::Rows => rows.weights.first().and_then(Integer::to_i64),
            Origin::OfPiece { .. } => doubled(1),
            Origin::OfPart { part, .. } => doubled(self.list[part].weight),
        };
        let number = self.list.len();
        self.list.push(Part {
            origin,
            at: self.hull.len(),
            weight: weight.unwrap_or(0),
            known: false,
            rows,
            separate: Vec::new(),
            monotone: Vec::new(),
        });
        self.hull.resize(self.hull.len() + degree as usize + 1, [0; 3]);
        self.keys.push(key);
        self.numbers.insert(key, number);
        self.of_piece.entry(piece).or_default().push(number);
        self.compute(number, positions);
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

    /// A part, to be changed.
    pub fn get_mut(&mut self, number: usize) -> &mut Part {
        &mut self.list[number]
    }

    /// The hull points of a polynomial part in 64 bits, if they fit.
    pub fn known(&self, number: usize) -> Option<Known<'_>> {
        let part = &self.list[number];
        (part.known && part.weight > 0).then(|| Known {
            points: &self.hull[part.at..part.at + part.rows.count],
            weight: part.weight,
        })
    }

    /// What the hull points of a part are computed from.
    pub fn points(&self, number: usize) -> Points<'_> {
        match self.known(number) {
            Some(known) => Points::Known(known),
            None => Points::Part(&self.list[number].rows),
        }
    }

    /// The parts of a piece, each after the one it is a half of.
    pub fn of_piece(&self, piece: usize) -> &[usize] {
        self.of_piece.get(&piece).map_or(&[], Vec::as_slice)
    }

    /// Computes the hull points of all parts.
    pub fn refresh(&mut self, positions: &Positions) {
        (0..self.list.len()).for_each(|number| self.compute(number, positions));
    }

    /// Computes the hull points of the parts of a piece.
    pub fn update(&mut self, piece: usize, positions: &Positions) {
        for i in 0..self.of_piece(piece).len() {
            let number = self.of_piece(piece)[i];
            self.compute(number, positions);
        }
    }

    fn compute(&mut self, number: usize, positions: &Positions) {
        let part = &self.list[number];
        let bits = u64::BITS - part.weight.unsigned_abs().leading_zeros();
        // A hull point is a convex combination of positions, times the weight, and so is every sum on the way.
        let fits = part.weight > 0 && bits + positions.bits() <= MOST_BITS;
        let known = match positions.narrow() {
            Some(points) if fits => self.compute_in_64_bits(number, &points[part.rows.first..][..part.rows.count]),
            _ => false,
        };
        self.list[number].known = known;
    }

    fn compute_in_64_bits(&mut self, number: usize, positions: &[[i64; 3]]) -> bool {
        let part = &self.list[number];
        let count = part.rows.count;
        let (before, from_here) = self.hull.split_at_mut(part.at);
        let half = &mut from_here[..count];
        let (whole, right) = match part.origin {
            Origin::OfPiece { right } => (positions, right),
            Origin::OfPart { part, right } => {
                let part = &self.list[part];
                if !part.known {
                    return false;
                }
                (&before[part.at..part.at + count], right)
            }
            Origin::Rows => {
                let Matrix::Narrow(entries, _) = &part.rows.hull else {
                    return false;
                };
                for (sum, row) in half.iter_mut().zip(entries.chunks(count)) {
                    *sum = [0; 3];
                    for (factor, point) in row.iter().zip(positions) {
                        (0..3).for_each(|axis| sum[axis] += factor * point[axis]);
                    }
                }
                return true;
            }
        };
        match (
            <&[[i64; 3]; 4]>::try_from(whole),
            <&mut [[i64; 3]; 4]>::try_from(&mut *half),
        ) {
            (Ok(whole), Ok(half)) => *half = halve_cubic(whole, right),
            _ => halve(whole, right, half),
        }
        true
    }
}
