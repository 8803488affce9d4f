//! A dyadic part of a piece, halved by de Casteljau in integers.
//!
//! Halving without division: with the rows b_i^r = b_i^{r−1} + b_{i+1}^{r−1}, each 2^r times the true one, the left half has the
//! coefficients b_0^k·2^{n−k} and the right half b_k^{n−k}·2^k, all over 2^n. So a part at depth e carries 2^{ne} in its denominator (in
//! its weights, if it is rational, where a common factor means nothing).

use std::borrow::Cow;

use super::chain::{Chain, Numbers, ScaleRef, Width, convert, convert_one};
use super::word::Word;
use crate::number::Integer;

/// The greatest number of halvings of a piece.
pub const MAX_DEPTH: u32 = 120;

/// The numbers of a part in one width.
pub struct Block<'c, W: Clone> {
    /// Homogeneous control points, and then the Bernstein coefficients of D, zero vectors included.
    vectors: Cow<'c, [[W; 3]]>,
    /// How many of them are control points.
    count: usize,
    /// Weights, none for a polynomial piece.
    weights: Cow<'c, [W]>,
}

/// The numbers of a part in the width they fit.
pub enum Geometry<'c> {
    /// 64-bit integers.
    Narrow(Block<'c, i64>),
    /// 128-bit integers.
    Wide(Block<'c, i128>),
    /// Integers of any size.
    Large(Block<'c, Integer>),
}

/// The part [index/2^depth, (index+1)/2^depth] of a piece.
pub struct Part<'c> {
    /// Number of the piece.
    pub piece: usize,
    /// Which of the 2^depth parts.
    pub index: u128,
    /// How many times the piece was halved.
    pub depth: u32,
    /// Its numbers.
    pub geometry: Geometry<'c>,
}

impl<'c, W: Word> Block<'c, W> {
    fn whole(numbers: Numbers<'c, W>) -> Self {
        Block {
            vectors: Cow::Borrowed(numbers.vectors),
            count: numbers.points.len(),
            weights: Cow::Borrowed(numbers.weights),
        }
    }

    /// Homogeneous control points.
    pub fn points(&self) -> &[[W; 3]] {
        &self.vectors[..self.count]
    }

    /// Weights, none for a polynomial piece.
    pub fn weights(&self) -> &[W] {
        &self.weights
    }

    /// Bernstein coefficients of D, zero vectors included.
    pub fn tangents(&self) -> &[[W; 3]] {
        &self.vectors[self.count..]
    }

    fn halves(&self) -> Option<(Block<'static, W>, Block<'static, W>)> {
        let mut right = self.vectors.to_vec();
        let mut left = Vec::with_capacity(right.len());
        halve_vectors(&mut right[..self.count], &mut left)?;
        halve_vectors(&mut right[self.count..], &mut left)?;
        let (left_weights, right_weights) = halve_numbers(&self.weights)?;
        let block = |vectors, weights| Block {
            vectors: Cow::Owned(vectors),
            count: self.count,
            weights: Cow::Owned(weights),
        };
        Some((block(left, left_weights), block(right, right_weights)))
    }

    fn widened<V: Word>(&self) -> Block<'static, V> {
        let vectors = self.vectors.iter().map(convert);
        let weights = self.weights.iter().map(convert_one);
        Block {
            vectors: Cow::Owned(vectors.collect::<Option<_>>().expect("the width is greater")),
            count: self.count,
            weights: Cow::Owned(weights.collect::<Option<_>>().expect("the width is greater")),
        }
    }
}

/// Appends the coefficients of the left half to `left`; `row` becomes those of the right half.
fn halve_vectors<W: Word>(row: &mut [[W; 3]], left: &mut Vec<[W; 3]>) -> Option<()> {
    let degree = row.len() - 1;
    for k in 0..=degree {
        let shift = (degree - k) as u32;
        let first = &row[0];
        left.push([
            first[0].doubled(shift)?,
            first[1].doubled(shift)?,
            first[2].doubled(shift)?,
        ]);
        // After this step, the entries 0 … n−k−1 are the next row and entry n−k is the last of the present one.
        for i in 0..degree - k {
            let (a, b) = (&row[i], &row[i + 1]);
            row[i] = [a[0].plus(&b[0])?, a[1].plus(&b[1])?, a[2].plus(&b[2])?];
        }
    }
    // The last entry of row n−k stayed at position k.
    for (k, entry) in row.iter_mut().enumerate() {
        for axis in entry.iter_mut() {
            *axis = axis.doubled(k as u32)?;
        }
    }
    Some(())
}

/// The coefficients of the left and of the right half.
fn halve_numbers<W: Word>(coefficients: &[W]) -> Option<(Vec<W>, Vec<W>)> {
    if coefficients.is_empty() {
        return Some((Vec::new(), Vec::new()));
    }
    let mut right: Vec<[W; 3]> = coefficients.iter().map(|x| [x.clone(), W::zero(), W::zero()]).collect();
    let mut left = Vec::with_capacity(right.len());
    halve_vectors(&mut right, &mut left)?;
    let first = |vectors: Vec<[W; 3]>| vectors.into_iter().map(|[x, _, _]| x).collect();
    Some((first(left), first(right)))
}

impl<'c> Part<'c> {
    /// A whole piece.
    pub fn whole(chain: &'c Chain, piece: usize) -> Self {
        let geometry = match chain.pieces[piece].width {
            Width::Narrow => Geometry::Narrow(Block::whole(chain.narrow_numbers(piece))),
            Width::Wide => Geometry::Wide(Block::whole(chain.wide_numbers(piece))),
            Width::Large => Geometry::Large(Block::whole(chain.large_numbers(piece))),
        };
        Part {
            piece,
            index: 0,
            depth: 0,
            geometry,
        }
    }

    /// The two halves, or `None` at [`MAX_DEPTH`].
    pub fn halves(&self) -> Option<(Part<'static>, Part<'static>)> {
        if self.depth >= MAX_DEPTH {
            return None;
        }
        let (left, right) = self.geometry.halves();
        let part = |index, geometry| Part {
            piece: self.piece,
            index,
            depth: self.depth + 1,
            geometry,
        };
        Some((part(2 * self.index, left), part(2 * self.index + 1, right)))
    }

    /// What the control points of a polynomial part are multiples of.
    pub fn point_scale<'s>(&self, chain: &'s Chain) -> ScaleRef<'s> {
        let piece = &chain.pieces[self.piece];
        piece.point_scale.doubled(piece.degree as u32 * self.depth)
    }

    /// What the tangents are multiples of.
    pub fn tangent_scale<'s>(&self, chain: &'s Chain) -> ScaleRef<'s> {
        let piece = &chain.pieces[self.piece];
        piece.tangent_scale.doubled(piece.tangent_degree as u32 * self.depth)
    }
}

impl Geometry<'_> {
    fn halves(&self) -> (Geometry<'static>, Geometry<'static>) {
        match self {
            Geometry::Narrow(block) => match block.halves() {
                Some((left, right)) => (Geometry::Narrow(left), Geometry::Narrow(right)),
                None => Geometry::Wide(block.widened()).halves(),
            },
            Geometry::Wide(block) => match block.halves() {
                Some((left, right)) => (Geometry::Wide(left), Geometry::Wide(right)),
                None => Geometry::Large(block.widened()).halves(),
            },
            Geometry::Large(block) => {
                let (left, right) = block.halves().expect("unbounded integers do not overflow");
                (Geometry::Large(left), Geometry::Large(right))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::check::section::{Section, section};
    use crate::curve::{Bezier, Curve, Form};
    use crate::number::{Rational, RationalVector};

    /// A planar curve of one piece; large coordinates leave 64 bits on the way.
    fn piece(coordinates: Vec<i64>, weights: Option<Vec<i64>>) -> Curve {
        let vector = |numbers: Vec<i64>, denominator: i64| {
            RationalVector::from_parts(numbers.into_iter().map(Integer::from).collect(), denominator.into()).unwrap()
        };
        let bezier = Bezier::new(2, vector(coordinates, 3), weights.map(|weights| vector(weights, 5))).unwrap();
        Curve::new(2, Form::Bezier(vec![bezier])).unwrap()
    }

    /// Points as fractions, whatever the integers stand for.
    fn points(part: &Part, chain: &Chain) -> Vec<[Rational; 2]> {
        fn of<W: Word>(block: &Block<W>, scale: &Integer) -> Vec<[Rational; 2]> {
            let weight = |k: usize| block.weights().get(k).map_or(scale.clone(), Word::to_integer);
            let fraction = |x: &W, k: usize| Rational::new(x.to_integer(), weight(k));
            block
                .points()
                .iter()
                .enumerate()
                .map(|(k, p)| [fraction(&p[0], k), fraction(&p[1], k)])
                .collect()
        }
        let scale = part.point_scale(chain).value();
        match &part.geometry {
            Geometry::Narrow(block) => of(block, &scale),
            Geometry::Wide(block) => of(block, &scale),
            Geometry::Large(block) => of(block, &scale),
        }
    }

    fn tangents(part: &Part, chain: &Chain) -> Vec<[Rational; 2]> {
        fn of<W: Word>(block: &Block<W>, scale: &Integer) -> Vec<[Rational; 2]> {
            let fraction = |x: &W| Rational::new(x.to_integer(), scale.clone());
            block
                .tangents()
                .iter()
                .map(|v| [fraction(&v[0]), fraction(&v[1])])
                .collect()
        }
        let scale = part.tangent_scale(chain).value();
        match &part.geometry {
            Geometry::Narrow(block) => of(block, &scale),
            Geometry::Wide(block) => of(block, &scale),
            Geometry::Large(block) => of(block, &scale),
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// Halving down a path gives the section that blossoms give directly, in every width.
        #[test]
        fn halves_are_sections(
            coordinates in proptest::collection::vec(prop_oneof![-9i64..9, -(1i64 << 61)..(1i64 << 61)], 8),
            weights in proptest::option::of(proptest::collection::vec(1i64..50, 4)),
            path in proptest::collection::vec(any::<bool>(), 0..12),
        ) {
            prop_assume!(coordinates.chunks(2).any(|p| p != &coordinates[..2]));
            let curve = piece(coordinates, weights);
            let chain = Chain::new(&curve).unwrap();
            let mut part = Part::whole(&chain, 0);
            for right in &path {
                let (left_half, right_half) = part.halves().unwrap();
                part = if *right { right_half } else { left_half };
            }
            let unit = Integer::from(1) << part.depth;
            let start = Rational::new(Integer::from(part.index), unit.clone());
            let end = Rational::new(Integer::from(part.index) + Integer::from(1), unit);
            let direct = section::<Integer>(&chain, &Section { piece: 0, start, end }).unwrap();
            let hull = direct.hull();
            let scale = hull.shared_scale().map(|scale| scale.value());
            for ((p, weight), [x, y]) in hull.points().zip(points(&part, &chain)) {
                let weight = weight.cloned().or_else(|| scale.clone()).unwrap();
                prop_assert_eq!([Rational::new(p[0].clone(), weight.clone()), Rational::new(p[1].clone(), weight)], [x, y]);
            }
            let field_scale = direct.field_scale.value();
            for (v, [x, y]) in direct.fields.iter().zip(tangents(&part, &chain)) {
                let fraction = |x: &Integer| Rational::new(x.clone(), field_scale.clone());
                prop_assert_eq!([fraction(&v[0]), fraction(&v[1])], [x, y]);
            }
        }
    }

    #[test]
    fn parts_are_halved_120_times_and_no_more() {
        let curve = piece(vec![0, 0, 1, 2, 5, 1, 7, 7], None);
        let chain = Chain::new(&curve).unwrap();
        let mut part = Part::whole(&chain, 0);
        for _ in 0..MAX_DEPTH {
            part = part.halves().unwrap().1;
        }
        assert!(part.halves().is_none());
        assert_eq!(
            points(&part, &chain)[3],
            [Rational::new(7.into(), 3.into()), Rational::new(7.into(), 3.into())]
        );
    }
}
