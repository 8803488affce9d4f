//! The boxes of runs, on the grid 2^-g, rounded outward (FORMAT §5, hull points of a run).
//!
//! Runs are numbered in depth-first order: the left half of run r, if it is a run, is r+1, and with k elements in the left half
//! (which then holds k−1 runs) the right half is r+k.

use super::chain::Chain;
use super::element::{Element, Elements, point_location};
use super::word::Word;
use crate::number::Integer;

/// A box: its least and greatest coordinates, in units of 2^-g.
pub type GridBox<W> = [[W; 3]; 2];

/// The boxes of all runs of a curve.
pub enum Boxes {
    /// All of them fit in 64 bits.
    Narrow(Vec<GridBox<i64>>),
    /// They do not.
    Large(Vec<GridBox<Integer>>),
}

impl Boxes {
    /// The number of the left half of a run.
    pub fn left(run: usize) -> usize {
        run + 1
    }

    /// The number of the right half of a run whose left half has `elements` elements.
    pub fn right(run: usize, elements: usize) -> usize {
        run + elements
    }

    /// Computes the boxes on the grid 2^-`grid`.
    pub fn new(chain: &Chain, elements: &Elements, grid: u32) -> Self {
        let runs = elements.count().saturating_sub(1);
        let mut narrow = Vec::with_capacity(runs);
        if fill::<i64>(chain, elements, grid, 0, elements.count(), &mut narrow).is_some() {
            return Boxes::Narrow(narrow);
        }
        let mut large = Vec::with_capacity(runs);
        fill::<Integer>(chain, elements, grid, 0, elements.count(), &mut large)
            .expect("unbounded integers do not overflow");
        Boxes::Large(large)
    }

    /// The box of a run, in any width that holds it.
    #[inline]
    pub fn get<W: Word>(&self, run: usize) -> Option<GridBox<W>> {
        match self {
            Boxes::Narrow(boxes) => {
                let [low, high] = &boxes[run];
                Some([super::chain::convert(low)?, super::chain::convert(high)?])
            }
            Boxes::Large(boxes) => {
                let [low, high] = &boxes[run];
                Some([super::chain::convert(low)?, super::chain::convert(high)?])
            }
        }
    }

    /// The greatest bit length in the box of a run.
    pub fn bits(&self, run: usize) -> u32 {
        match self {
            Boxes::Narrow(boxes) => boxes[run].iter().flatten().map(Word::bit_length).max().unwrap_or(0),
            Boxes::Large(boxes) => boxes[run].iter().flatten().map(Word::bit_length).max().unwrap_or(0),
        }
    }
}

/// Fills in the boxes of the run `first … last−1` and of all below it, and returns the box of these elements.
fn fill<W: Word>(
    chain: &Chain,
    elements: &Elements,
    grid: u32,
    first: usize,
    last: usize,
    boxes: &mut Vec<GridBox<W>>,
) -> Option<GridBox<W>> {
    if last - first == 1 {
        return element_box(chain, elements.get(first), grid);
    }
    let number = boxes.len();
    boxes.push(std::array::from_fn(|_| std::array::from_fn(|_| W::zero())));
    let middle = (first + last) / 2;
    let [mut low, mut high] = fill(chain, elements, grid, first, middle, boxes)?;
    let [other_low, other_high] = fill(chain, elements, grid, middle, last, boxes)?;
    for (mine, other) in low.iter_mut().zip(other_low) {
        if other < *mine {
            *mine = other;
        }
    }
    for (mine, other) in high.iter_mut().zip(other_high) {
        if other > *mine {
            *mine = other;
        }
    }
    boxes[number] = [low.clone(), high.clone()];
    Some([low, high])
}

fn element_box<W: Word>(chain: &Chain, element: Element, grid: u32) -> Option<GridBox<W>> {
    let mut bounds: Option<GridBox<Integer>> = None;
    match element {
        Element::Piece(piece) => {
            let data = &chain.pieces[piece];
            let denominator = data.point_scale.value();
            if !data.rational
                && data.width == super::chain::Width::Narrow
                && let Some(denominator) = denominator.to_i64()
                && let Some(bounds) = narrow_box(chain.narrow_numbers(piece).points, denominator, grid)
            {
                return Some([super::chain::convert(&bounds[0])?, super::chain::convert(&bounds[1])?]);
            }
            let numbers: super::chain::OwnedNumbers<Integer> =
                chain.numbers_as(piece).expect("unbounded integers do not overflow");
            for (k, point) in numbers.points.iter().enumerate() {
                include(&mut bounds, point, numbers.weights.get(k).unwrap_or(&denominator), grid);
            }
        }
        point => {
            let (piece, end) = point_location(chain, point);
            let (point, weight) = chain.end_point(piece, end);
            include(&mut bounds, &point, &weight, grid);
        }
    }
    let [low, high] = bounds.expect("every element has a point");
    Some([super::word::vector(&low)?, super::word::vector(&high)?])
}

/// The box of 64-bit points over one denominator, if the products fit in 128 bits.
fn narrow_box(points: &[[i64; 3]], denominator: i64, grid: u32) -> Option<GridBox<i128>> {
    let mut bounds = [[0i128; 3]; 2];
    for axis in 0..3 {
        let low = points.iter().map(|point| point[axis]).min()?;
        let high = points.iter().map(|point| point[axis]).max()?;
        // ⌈x⌉ = −⌊−x⌋. Division in 64 bits is several times as fast.
        if let (Some(low), Some(high)) = (low.doubled(grid), high.doubled(grid).and_then(i64::checked_neg)) {
            let floor = |x: i64| x.checked_div_euclid(denominator).map(i128::from);
            bounds[0][axis] = floor(low)?;
            bounds[1][axis] = -floor(high)?;
            continue;
        }
        let (low, high) = (i128::from(low).doubled(grid)?, i128::from(high).doubled(grid)?);
        let denominator = i128::from(denominator);
        bounds[0][axis] = low.div_euclid(denominator);
        // The least integer has no negative.
        bounds[1][axis] = -high.checked_neg()?.div_euclid(denominator);
    }
    Some(bounds)
}

/// Extends a box by the point `point`/`weight`.
fn include(bounds: &mut Option<GridBox<Integer>>, point: &[Integer; 3], weight: &Integer, grid: u32) {
    let low = point.each_ref().map(|x| (x << grid).div_floor(weight));
    let high = point.each_ref().map(|x| (x << grid).div_ceil(weight));
    match bounds {
        None => *bounds = Some([low, high]),
        Some([least, greatest]) => {
            for axis in 0..3 {
                if low[axis] < least[axis] {
                    least[axis] = low[axis].clone();
                }
                if high[axis] > greatest[axis] {
                    greatest[axis] = high[axis].clone();
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_are_rounded_outward() {
        // x from −1/3 to 2/3 in units of 1/4: ⌊−4/3⌋ = −2 and ⌈8/3⌉ = 3.
        let bounds = narrow_box(&[[-1, 0, 6], [2, 3, 6]], 3, 2).unwrap();
        assert_eq!(bounds, [[-2, 0, 8], [3, 4, 8]]);
        let mut large = None;
        for point in [[-1, 0, 6], [2, 3, 6]] {
            include(&mut large, &point.map(Integer::from), &Integer::from(3), 2);
        }
        assert_eq!(large.unwrap(), bounds.map(|corner| corner.map(Integer::from)));
    }

    #[test]
    fn the_least_integer_does_not_wrap() {
        let bounds = narrow_box(&[[i64::MIN, 0, i64::MAX]], 1, 64);
        assert_eq!(bounds, None);
        let bounds = narrow_box(&[[i64::MIN, 0, i64::MAX]], 1, 60).unwrap();
        assert_eq!(bounds[0], bounds[1]);
        assert_eq!(bounds[0][0], i128::from(i64::MIN) << 60);
    }
}
