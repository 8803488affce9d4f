//! Whether leaves hold: in 64 bits where that is certain not to overflow, else in any width.

use super::super::obligation::{Points, goes, separated};
use super::super::positions::Positions;
use super::{Direction, Monotone, NO_ROW, Number, Separate, Table};

impl Table<'_> {
    /// May n·(p − q) be computed in 64 bits for all positions p, q?
    fn short(&self, direction: &Direction, positions: &Positions) -> bool {
        positions.narrow().is_some() && u32::from(direction.bits) + positions.bits() < 62
    }

    fn points(&self, number: Number, positions: &Positions) -> Points<'_> {
        let number = number as usize;
        match number.checked_sub(self.runs.count()) {
            Some(part) => self.parts.points(part),
            None => {
                let span = self.runs.span(number);
                let (first, last) = (
                    self.shape.pieces[span.start].first,
                    self.shape.pieces[span.end - 1].last,
                );
                match (span.len(), positions.narrow()) {
                    (1, _) => Points::Direct(first, last),
                    (_, Some(_)) => Points::Bounds(self.runs.bounds(number)),
                    (_, None) => Points::Span(first, last),
                }
            }
        }
    }

    /// Does a leaf `separate` hold?
    pub(super) fn holds_apart(&self, leaf: &Separate, positions: &Positions) -> bool {
        self.apart_in_64_bits(leaf, positions).unwrap_or_else(|| {
            let [a, b] = [leaf.a, leaf.b].map(|node| self.points(node, positions));
            separated(a, b, positions, &leaf.direction.exact())
        })
    }

    /// Whether a leaf `separate` holds, if that can be seen in 64 bits.
    fn apart_in_64_bits(&self, leaf: &Separate, positions: &Positions) -> Option<bool> {
        let runs = self.runs.count();
        let points = positions.narrow()?;
        // The bits that weights may have.
        let room = 62u32.checked_sub(u32::from(leaf.direction.bits) + positions.bits() + 1)?;
        let n = &leaf.direction.n;
        if (leaf.a as usize) < runs && (leaf.b as usize) < runs {
            // The box of a piece contains its control points, so that this is enough.
            let (a, b) = (self.runs.bounds(leaf.a as usize), self.runs.bounds(leaf.b as usize));
            let gap = |axis: usize| n[axis] * (a[leaf.corners.0[axis] as usize] - b[leaf.corners.1[axis] as usize]);
            if gap(0) + gap(1) + gap(2) > 0 {
                return Some(true);
            }
        }
        // The least or greatest n·p of a node times its weight, the weight, and the bits of that.
        let extreme = |number: Number, corners: &[u8; 3], greatest: bool| {
            let number = number as usize;
            if let Some(part) = number.checked_sub(runs) {
                let known = self.parts.known(part)?;
                let bits = known.weight_bits();
                return (bits <= room).then(|| (best_product(known.points, n, greatest), known.weight, bits));
            }
            let span = self.runs.span(number);
            if span.len() == 1 {
                let piece = &self.shape.pieces[span.start];
                let points = &points[piece.first..=piece.last];
                return Some((best_product(points, n, greatest), 1, 1));
            }
            let bounds = self.runs.bounds(number);
            let corner = corners.map(|i| bounds[i as usize]);
            Some((product(&corner, n), 1, 1))
        };
        let (low, weight_a, bits_a) = extreme(leaf.a, &leaf.corners.0, false)?;
        let (high, weight_b, bits_b) = extreme(leaf.b, &leaf.corners.1, true)?;
        (bits_a + bits_b <= room).then(|| low * weight_b > high * weight_a)
    }

    /// Does a leaf `monotone` hold?
    pub(super) fn holds_forward(&self, leaf: &Monotone, positions: &Positions) -> bool {
        if leaf.rows[0] != NO_ROW
            && let Some(points) = positions.narrow()
            && self.short(&leaf.direction, positions)
            && leaf
                .rows
                .iter()
                .all(|row| *row == NO_ROW || increases(&points[row.0 as usize..=row.1 as usize], &leaf.direction.n))
        {
            return true;
        }
        let nodes = std::iter::once(&leaf.a).chain(&leaf.b).zip(leaf.parts);
        nodes.into_iter().all(|(node, part)| match (part, node) {
            (Some(part), _) => self.part_goes(&leaf.direction, part as usize, positions),
            _ => node
                .pieces()
                .all(|piece| self.piece_goes(&leaf.direction, piece, positions)),
        })
    }

    fn part_goes(&self, direction: &Direction, part: usize, positions: &Positions) -> bool {
        if let Some(known) = self.parts.known(part)
            && u32::from(direction.bits) + positions.bits() + known.weight_bits() < 62
            && increases(known.points, &direction.n)
        {
            return true;
        }
        goes(self.parts.points(part), positions, &direction.exact())
    }

    /// Does a piece go in a direction?
    pub(super) fn piece_goes(&self, direction: &Direction, piece: usize, positions: &Positions) -> bool {
        let shape = &self.shape.pieces[piece];
        if !shape.direct {
            let part = self.parts.find((piece, 0, 0));
            return part.is_some_and(|part| self.part_goes(direction, part, positions));
        }
        if self.short(direction, positions)
            && let Some(points) = positions.narrow()
            && increases(&points[shape.first..=shape.last], &direction.n)
        {
            return true;
        }
        goes(Points::Direct(shape.first, shape.last), positions, &direction.exact())
    }
}

/// n·p.
#[inline]
fn product(p: &[i64; 3], n: &[i64; 3]) -> i64 {
    p[0] * n[0] + p[1] * n[1] + p[2] * n[2]
}

/// The least or the greatest n·p. All products are known to fit.
#[inline]
fn best_product(points: &[[i64; 3]], n: &[i64; 3], greatest: bool) -> i64 {
    let mut best = product(&points[0], n);
    for point in &points[1..] {
        let value = product(point, n);
        best = if greatest { best.max(value) } else { best.min(value) };
    }
    best
}

/// Does n·P increase strictly along the points? All products are known to fit.
#[inline]
fn increases(points: &[[i64; 3]], n: &[i64; 3]) -> bool {
    let mut before = product(&points[0], n);
    let mut holds = true;
    for point in &points[1..] {
        let here = product(point, n);
        holds &= here > before;
        before = here;
    }
    holds
}
