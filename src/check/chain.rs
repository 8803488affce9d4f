//! The checker's own chain: integer homogeneous control points and fields D, piece by piece.
//!
//! FORMAT §3. A B-spline becomes pieces by blossoming, straight from the definition; `curve` inserts knots instead, and a test
//! compares the two. Coordinates are stored in the narrowest of three widths that holds the piece. Planar
//! curves get a third coordinate 0, which changes no dot product.

use std::cmp::Ordering;

use super::blossom::interval_values;
use super::word::{Word, combine, dot, widening};
use crate::curve::{BSpline, Bezier, Curve, Form};
use crate::number::{Integer, RationalVector};

/// A positive integer `odd · 2^exponent`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scale {
    /// The odd factor.
    pub odd: Integer,
    /// The exponent of two.
    pub exponent: u32,
}

impl Scale {
    /// Takes a positive integer apart.
    pub fn new(value: &Integer) -> Self {
        let exponent =
            u32::try_from(value.trailing_zeros().unwrap_or(0)).expect("bit counts are bounded by the reader");
        Scale {
            odd: value >> exponent,
            exponent,
        }
    }

    /// The scale times `2^bits`.
    pub fn doubled(&self, bits: u32) -> ScaleRef<'_> {
        ScaleRef {
            odd: &self.odd,
            exponent: self.exponent + bits,
        }
    }

    /// The integer itself.
    pub fn value(&self) -> Integer {
        self.doubled(0).value()
    }
}

/// A scale whose odd factor is borrowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ScaleRef<'s> {
    /// The odd factor.
    pub odd: &'s Integer,
    /// The exponent of two.
    pub exponent: u32,
}

/// The odd factor of powers of two.
static ONE: Integer = Integer::ONE;

impl ScaleRef<'_> {
    /// 2^`exponent`.
    pub fn power_of_two(exponent: u32) -> ScaleRef<'static> {
        ScaleRef { odd: &ONE, exponent }
    }

    /// The integer itself.
    pub fn value(&self) -> Integer {
        self.odd << self.exponent
    }
}

/// The vectors of all pieces stored in one width.
#[derive(Default)]
pub struct Storage<W> {
    vectors: Vec<[W; 3]>,
    weights: Vec<W>,
}

/// Which storage holds a piece.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Width {
    /// 64-bit integers.
    Narrow,
    /// 128-bit integers.
    Wide,
    /// Integers of any size.
    Large,
}

/// One piece: where its numbers are and what they are multiples of.
pub struct Piece {
    /// Polynomial degree n.
    pub degree: usize,
    /// Degree of the field D: n−1, or 2n−2 for a rational piece.
    pub tangent_degree: usize,
    /// Has unequal weights.
    pub rational: bool,
    /// The storage its numbers are in.
    pub width: Width,
    points: usize,
    weights: usize,
    /// For a polynomial piece: control points are the stored integers over this.
    pub point_scale: Scale,
    /// D_k is the stored integer vector over this.
    pub tangent_scale: Scale,
}

/// The numbers of a piece in its width: points (homogeneous X_k), weights (rational pieces only), field coefficients.
pub struct Numbers<'c, W> {
    /// X_k, n+1 vectors.
    pub points: &'c [[W; 3]],
    /// w_k, n+1 numbers, or none when polynomial.
    pub weights: &'c [W],
    /// D_k.
    pub tangents: &'c [[W; 3]],
    /// X_k and then D_k.
    pub vectors: &'c [[W; 3]],
}

/// A chain of Bézier pieces in integers.
pub struct Chain {
    /// 2 or 3.
    pub dimension: usize,
    /// The pieces in order.
    pub pieces: Vec<Piece>,
    /// Do the two ends coincide exactly?
    pub closed: bool,
    narrow: Storage<i64>,
    wide: Storage<i128>,
    large: Storage<Integer>,
}

impl Chain {
    /// The chain of a curve, or the number of the first piece whose field D vanishes identically.
    pub fn new(curve: &Curve) -> Result<Self, usize> {
        let (chain, point) = Chain::with_points(curve);
        match point {
            None => Ok(chain),
            Some(piece) => Err(piece),
        }
    }

    /// The chain of a curve, which may have pieces that are points, and the number of the first such piece.
    pub fn with_points(curve: &Curve) -> (Self, Option<usize>) {
        let mut chain = Chain {
            dimension: curve.dimension(),
            pieces: Vec::new(),
            closed: false,
            narrow: Storage::default(),
            wide: Storage::default(),
            large: Storage::default(),
        };
        let mut point = None;
        match curve.form() {
            Form::Bezier(pieces) => {
                let (count, size) = (pieces.len(), pieces.iter().map(|piece| 2 * piece.degree() + 1).sum());
                chain.pieces.reserve_exact(count);
                chain.narrow.vectors.reserve(size);
                for piece in pieces {
                    let pushed = chain.push_bezier(piece);
                    point = point.or(pushed.err());
                }
            }
            Form::BSpline(spline) => {
                for (values, has_weights) in blossom_pieces(spline, chain.dimension) {
                    let pushed = chain.push_homogeneous(&values, has_weights);
                    point = point.or(pushed.err());
                }
            }
        }
        chain.closed = chain.ends_coincide();
        (chain, point)
    }

    /// Number of pieces M.
    pub fn count(&self) -> usize {
        self.pieces.len()
    }

    fn push_bezier(&mut self, piece: &Bezier) -> Result<(), usize> {
        let dimension = self.dimension;
        let numerators = piece.points.numerators();
        let weights = piece.weights.as_ref().filter(|weights| {
            let numbers = weights.numerators();
            numbers.iter().any(|weight| *weight != numbers[0])
        });
        let axis = |k: usize, i: usize| {
            if i < dimension {
                numerators[k * dimension + i].clone()
            } else {
                Integer::default()
            }
        };
        match weights {
            None => {
                // The common case without big integers in between.
                let narrow: Option<Vec<[i64; 3]>> = (0..=piece.degree())
                    .map(|k| {
                        let axis = |i: usize| {
                            if i < dimension {
                                numerators[k * dimension + i].to_i64()
                            } else {
                                Some(0)
                            }
                        };
                        Some([axis(0)?, axis(1)?, axis(2)?])
                    })
                    .collect();
                match narrow {
                    Some(points) => self.push_polynomial(&points, piece.points.denominator()),
                    None => {
                        let points: Vec<[Integer; 3]> = (0..=piece.degree())
                            .map(|k| [axis(k, 0), axis(k, 1), axis(k, 2)])
                            .collect();
                        self.push_polynomial(&points, piece.points.denominator())
                    }
                }
            }
            Some(weights) => {
                // With P = p/q and w = v/r: X = w·P = v·p/(q·r) and w = v·q/(q·r).
                let points: Vec<[Integer; 3]> = weights
                    .numerators()
                    .iter()
                    .enumerate()
                    .map(|(k, v)| [0, 1, 2].map(|i| v * &axis(k, i)))
                    .collect();
                let scaled: Vec<Integer> = weights
                    .numerators()
                    .iter()
                    .map(|v| v * piece.points.denominator())
                    .collect();
                self.push_rational(&points, &scaled, &(piece.points.denominator() * weights.denominator()))
            }
        }
    }

    /// A piece given by homogeneous coordinates, points with their weights or points alone.
    fn push_homogeneous(&mut self, values: &RationalVector, has_weights: bool) -> Result<(), usize> {
        let dimension = self.dimension;
        let stride = dimension + usize::from(has_weights);
        let rows: Vec<&[Integer]> = values.numerators().chunks(stride).collect();
        let point = |row: &[Integer]| {
            [0, 1, 2].map(|i| {
                if i < dimension {
                    row[i].clone()
                } else {
                    Integer::default()
                }
            })
        };
        let points: Vec<[Integer; 3]> = rows.iter().map(|row| point(row)).collect();
        if !has_weights {
            return self.push_polynomial(&points, values.denominator());
        }
        let weights: Vec<Integer> = rows.iter().map(|row| row[dimension].clone()).collect();
        if weights.iter().any(|weight| *weight != weights[0]) {
            return self.push_rational(&points, &weights, values.denominator());
        }
        // P = X/w with one w for all points.
        let affine: Vec<Integer> = rows.iter().flat_map(|row| row[..dimension].to_vec()).collect();
        let affine = RationalVector::from_parts(affine, weights[0].clone()).expect("weights are positive");
        let points: Vec<[Integer; 3]> = affine.numerators().chunks(dimension).map(point).collect();
        self.push_polynomial(&points, affine.denominator())
    }

    fn push_polynomial<W: Word>(&mut self, points: &[[W; 3]], denominator: &Integer) -> Result<(), usize> {
        let scale = Scale::new(denominator);
        let degree = points.len() - 1;
        self.push(degree, degree - 1, points, &[], scale.clone(), scale)
    }

    fn push_rational(
        &mut self,
        points: &[[Integer; 3]],
        weights: &[Integer],
        denominator: &Integer,
    ) -> Result<(), usize> {
        let degree = weights.len() - 1;
        let (_, multiple) = rational_field_factors(degree);
        let tangent_scale = Scale::new(&(denominator * denominator * multiple));
        self.push(
            degree,
            2 * degree - 2,
            points,
            weights,
            Scale::new(&Integer::from(1)),
            tangent_scale,
        )
    }

    fn push<W: Word>(
        &mut self,
        degree: usize,
        tangent_degree: usize,
        points: &[[W; 3]],
        weights: &[W],
        point_scale: Scale,
        tangent_scale: Scale,
    ) -> Result<(), usize> {
        let mut piece = Piece {
            degree,
            tangent_degree,
            rational: !weights.is_empty(),
            width: Width::Narrow,
            points: 0,
            weights: 0,
            point_scale,
            tangent_scale,
        };
        let start = if let Some(start) = self.narrow.push(points, weights) {
            start
        } else if let Some(start) = self.wide.push(points, weights) {
            piece.width = Width::Wide;
            start
        } else {
            piece.width = Width::Large;
            self.large
                .push(points, weights)
                .expect("unbounded integers do not overflow")
        };
        (piece.points, piece.weights) = start;
        let number = self.pieces.len();
        self.pieces.push(piece);
        let vanishes = match self.pieces[number].width {
            Width::Narrow => all_zero(self.narrow_numbers(number).tangents),
            Width::Wide => all_zero(self.wide_numbers(number).tangents),
            Width::Large => all_zero(self.large_numbers(number).tangents),
        };
        if vanishes { Err(number) } else { Ok(()) }
    }

    /// The numbers of a piece stored in 64 bits.
    pub fn narrow_numbers(&self, piece: usize) -> Numbers<'_, i64> {
        self.narrow.numbers(&self.pieces[piece])
    }

    /// The numbers of a piece stored in 128 bits.
    pub fn wide_numbers(&self, piece: usize) -> Numbers<'_, i128> {
        self.wide.numbers(&self.pieces[piece])
    }

    /// The numbers of a piece stored in integers of any size.
    pub fn large_numbers(&self, piece: usize) -> Numbers<'_, Integer> {
        self.large.numbers(&self.pieces[piece])
    }

    /// The piece's numbers in any width that holds them.
    pub fn numbers_as<W: Word>(&self, piece: usize) -> Option<OwnedNumbers<W>> {
        match self.pieces[piece].width {
            Width::Narrow => self.narrow_numbers(piece).widened(),
            Width::Wide => self.wide_numbers(piece).widened(),
            Width::Large => self.large_numbers(piece).widened(),
        }
    }

    /// The affine point where a piece starts (`end` false) or ends, as integers (X, w) with w > 0: X/w.
    pub fn end_point(&self, piece: usize, end: bool) -> ([Integer; 3], Integer) {
        let numbers: OwnedNumbers<Integer> = self.numbers_as(piece).expect("unbounded integers do not overflow");
        let k = if end { numbers.points.len() - 1 } else { 0 };
        let weight = if numbers.weights.is_empty() {
            self.pieces[piece].point_scale.value()
        } else {
            numbers.weights[k].clone()
        };
        (numbers.points[k].clone(), weight)
    }

    /// The outgoing direction at the start of a piece (`end` false) or the incoming direction at its end: the first or last D_k ≠ 0,
    /// as integers over the piece's `tangent_scale`.
    pub fn end_direction(&self, piece: usize, end: bool) -> [Integer; 3] {
        let numbers: OwnedNumbers<Integer> = self.numbers_as(piece).expect("unbounded integers do not overflow");
        let mut nonzero = numbers.tangents.iter().filter(|v| v.iter().any(|x| !x.vanishes()));
        let found = if end { nonzero.next_back() } else { nonzero.next() };
        found.expect("pieces whose field vanishes are refused").clone()
    }

    /// Is the joint between piece `before` and piece `after` smooth (parallel directions, positive dot product)?
    pub fn smooth_joint(&self, before: usize, after: usize) -> bool {
        let (a, b) = (self.end_direction(before, true), self.end_direction(after, false));
        let bits = a.iter().chain(&b).map(Word::bit_length).max().unwrap_or(0);
        widening!(2 * bits + 3, W => smooth::<W>(&a, &b))
    }

    fn ends_coincide(&self) -> bool {
        let ((p, v), (q, w)) = (self.end_point(0, false), self.end_point(self.count() - 1, true));
        (0..3).all(|i| &p[i] * &w == &q[i] * &v)
    }
}

fn smooth<W: Word>(a: &[Integer; 3], b: &[Integer; 3]) -> Option<bool> {
    let (a, b) = (super::word::vector::<W>(a)?, super::word::vector::<W>(b)?);
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        if a[i].times(&b[j])? != a[j].times(&b[i])? {
            return Some(false);
        }
    }
    Some(dot(&a, &b)?.sign() == Ordering::Greater)
}

fn all_zero<W: Word>(vectors: &[[W; 3]]) -> bool {
    vectors.iter().all(|v| v.iter().all(W::vanishes))
}

/// A piece's numbers, owned, in one width.
pub struct OwnedNumbers<W> {
    /// X_k.
    pub points: Vec<[W; 3]>,
    /// w_k, empty for a polynomial piece.
    pub weights: Vec<W>,
    /// D_k.
    pub tangents: Vec<[W; 3]>,
}

impl<S: Word> Numbers<'_, S> {
    fn widened<W: Word>(&self) -> Option<OwnedNumbers<W>> {
        let vectors = |from: &[[S; 3]]| -> Option<Vec<[W; 3]>> { from.iter().map(convert).collect() };
        Some(OwnedNumbers {
            points: vectors(self.points)?,
            weights: self.weights.iter().map(convert_one).collect::<Option<_>>()?,
            tangents: vectors(self.tangents)?,
        })
    }
}

/// One number in another width.
#[inline]
pub fn convert_one<S: Word, W: Word>(from: &S) -> Option<W> {
    match from.to_i128() {
        Some(value) => W::from_i128(value),
        None => W::from_integer(&from.to_integer()),
    }
}

/// One vector in another width.
#[inline]
pub fn convert<S: Word, W: Word>(from: &[S; 3]) -> Option<[W; 3]> {
    Some([convert_one(&from[0])?, convert_one(&from[1])?, convert_one(&from[2])?])
}

impl<W: Word> Storage<W> {
    /// Appends a piece; `None`, with nothing appended, when a number does not fit.
    fn push<S: Word>(&mut self, points: &[[S; 3]], weights: &[S]) -> Option<(usize, usize)> {
        let start = (self.vectors.len(), self.weights.len());
        let pushed = self.try_push(points, weights, start);
        if pushed.is_none() {
            self.vectors.truncate(start.0);
            self.weights.truncate(start.1);
        }
        pushed.map(|()| start)
    }

    fn try_push<S: Word>(&mut self, points: &[[S; 3]], weights: &[S], start: (usize, usize)) -> Option<()> {
        for point in points {
            self.vectors.push(convert(point)?);
        }
        for weight in weights {
            self.weights.push(convert_one(weight)?);
        }
        if weights.is_empty() {
            for k in start.0..start.0 + points.len() - 1 {
                let (p, q) = (&self.vectors[k], &self.vectors[k + 1]);
                let difference = [q[0].minus(&p[0])?, q[1].minus(&p[1])?, q[2].minus(&p[2])?];
                self.vectors.push(difference);
            }
        } else {
            let field = rational_field(&self.vectors[start.0..], &self.weights[start.1..])?;
            self.vectors.extend(field);
        }
        Some(())
    }

    fn numbers(&self, piece: &Piece) -> Numbers<'_, W> {
        let count = piece.degree + 1;
        let vectors = &self.vectors[piece.points..=piece.points + count + piece.tangent_degree];
        let (points, tangents) = vectors.split_at(count);
        let weights = if piece.rational {
            &self.weights[piece.weights..piece.weights + count]
        } else {
            &[]
        };
        Numbers {
            points,
            weights,
            tangents,
            vectors,
        }
    }
}

/// The terms (i, j, factor) of one coefficient of D.
pub(super) type Terms = Vec<(usize, usize, Integer)>;

/// For degree n: the factors (k−2i+1)·C(n,i)·C(n,k−i+1)·L/C(2n−2,k), listed by k and then i, and L = lcm of the C(2n−2,k).
pub(super) fn rational_field_factors(degree: usize) -> (Vec<Terms>, Integer) {
    let n = degree as u32;
    let top = 2 * n - 2;
    let multiple = (0..=top).fold(Integer::from(1), |lcm, k| lcm.lcm(&Integer::binomial(top, k)));
    let factors = (0..=top)
        .map(|k| {
            let share = multiple.div_exact(&Integer::binomial(top, k));
            ((k + 1).saturating_sub(n)..=k / 2)
                .map(|i| {
                    let j = k - i + 1;
                    let factor =
                        Integer::from(k + 1 - 2 * i) * Integer::binomial(n, i) * Integer::binomial(n, j) * &share;
                    (i as usize, j as usize, factor)
                })
                .collect()
        })
        .collect();
    (factors, multiple)
}

/// The coefficients of D of a rational piece times L, for integer homogeneous control points (FORMAT §3).
fn rational_field<W: Word>(points: &[[W; 3]], weights: &[W]) -> Option<Vec<[W; 3]>> {
    let (factors, _) = rational_field_factors(weights.len() - 1);
    factors
        .iter()
        .map(|terms| {
            let mut sum = [W::zero(), W::zero(), W::zero()];
            for (i, j, factor) in terms {
                let factor = W::from_integer(factor)?;
                let minus = W::zero().minus(&weights[*j])?;
                let term = combine(&weights[*i], &points[*j], &minus, &points[*i])?;
                for axis in 0..3 {
                    sum[axis] = sum[axis].plus(&factor.times(&term[axis])?)?;
                }
            }
            Some(sum)
        })
        .collect()
}

/// Homogeneous Bézier points (and weights) of every non-empty knot interval (FORMAT §3).
fn blossom_pieces(spline: &BSpline, dimension: usize) -> Vec<(RationalVector, bool)> {
    let weights = spline.weights();
    let stride = dimension + usize::from(weights.is_some());
    let count = spline.points().len() / dimension;
    let coordinates = spline.points().numerators();
    // (wP, w) over the product of both denominators, as in push_bezier.
    let homogeneous: Vec<Integer> = (0..count)
        .flat_map(|k| {
            let point = &coordinates[k * dimension..(k + 1) * dimension];
            let weight = weights.map(|weights| &weights.numerators()[k]);
            let scaled: Vec<Integer> = match weight {
                None => point.to_vec(),
                Some(w) => point
                    .iter()
                    .map(|x| x * w)
                    .chain([w * spline.points().denominator()])
                    .collect(),
            };
            scaled
        })
        .collect();
    let denominator = match weights {
        None => spline.points().denominator().clone(),
        Some(weights) => spline.points().denominator() * weights.denominator(),
    };
    interval_values(spline, &homogeneous, stride)
        .map(|(values, multiple)| {
            let values = RationalVector::from_parts(values, &denominator * multiple);
            (values.expect("knot differences are positive"), weights.is_some())
        })
        .collect()
}
