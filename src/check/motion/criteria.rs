//! The criteria that look at single frames: second differences with the displacement so far, and half of ν (FORMAT §14).
//!
//! What a move touches is computed anew, and the greatest values are kept in tournaments: a frame costs what it moves. The second difference at p_k changes by
//! γ_{k−1} − 2γ_k + γ_{k+1}, γ = 0 for points that do not move: the cases of the literature (a single point, chains of two, three or more neighbours, the points moved along to keep a
//! joint smooth) are this one formula.

use super::greatest::Greatest;
use super::positions::Positions;
use super::shape::{Matrix, PartRows, Shape};
use crate::check::word::{Word, vector};
use crate::claim::motion::{FirstFailures, Move};
use crate::number::{Integer, Rational};

/// N∞(n) = ⌊n/2⌋⌈n/2⌉/(2n).
pub fn bound_factor(degree: usize) -> Rational {
    let (down, up) = (Integer::from(degree / 2), Integer::from(degree.div_ceil(2)));
    Rational::new(down * up, Integer::from(2 * degree))
}

/// Where the control points of a piece come from.
enum Source {
    /// Positions in a row.
    Direct,
    Rows(Box<PartRows>),
}

/// The measures in one width: in the norm of greatest coordinates, and squared in the Euclidean one.
struct Measures<W> {
    /// Of each piece the greatest second difference of its control points, times their weight.
    second: [Vec<W>; 2],
    second_greatest: [Greatest; 2],
    /// Of each own control point the displacement since time 0.
    moved: [Vec<W>; 2],
    moved_greatest: [Greatest; 2],
}

enum Widths {
    Short(Measures<i128>),
    Long(Measures<Integer>),
}

/// The greatest values at a frame, as lengths: in the Euclidean norm their squares.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Greatests {
    /// N∞ times a second difference.
    pub second: [Rational; 2],
    /// A displacement since time 0.
    pub moved: [Rational; 2],
}

/// The measures of a motion at a frame.
pub struct Criteria {
    sources: Vec<Source>,
    /// N∞ over the weight and the denominator, for each piece.
    factors: Vec<Rational>,
    degrees: Vec<usize>,
    denominator: Integer,
    start: Positions,
    widths: Widths,
}

/// Greatest coordinate and squared length.
fn norms<W: Word>(v: &[W; 3]) -> Option<[W; 2]> {
    let zero = W::zero();
    let (mut most, mut square) = (W::zero(), W::zero());
    for x in v {
        let magnitude = if *x < zero { zero.minus(x)? } else { x.clone() };
        square = square.plus(&magnitude.times(&magnitude)?)?;
        most = most.max(magnitude);
    }
    Some([most, square])
}

fn position<W: Word>(positions: &Positions, place: usize) -> Option<[W; 3]> {
    match positions.narrow() {
        Some(points) => {
            let [x, y, z] = points[place].map(|x| W::from_i128(i128::from(x)));
            Some([x?, y?, z?])
        }
        None => vector(&positions.get(place)),
    }
}

fn difference<W: Word>(p: &[W; 3], q: &[W; 3]) -> Option<[W; 3]> {
    Some([p[0].minus(&q[0])?, p[1].minus(&q[1])?, p[2].minus(&q[2])?])
}

/// The control points of a piece, times their weight.
fn control_points<W: Word>(shape: &Shape, source: &Source, piece: usize, positions: &Positions) -> Option<Vec<[W; 3]>> {
    let at = &shape.pieces[piece];
    let points: Vec<[W; 3]> = (at.first..=at.last)
        .map(|place| position(positions, place))
        .collect::<Option<_>>()?;
    match source {
        Source::Direct => Some(points),
        Source::Rows(rows) => {
            let entries: Vec<W> = match &rows.hull {
                Matrix::Narrow(entries, _) => entries
                    .iter()
                    .map(|x| W::from_i128(i128::from(*x)))
                    .collect::<Option<_>>()?,
                Matrix::Large(entries) => entries.iter().map(W::from_integer).collect::<Option<_>>()?,
            };
            let sum = |row: &[W]| {
                let mut sum = [W::zero(), W::zero(), W::zero()];
                for (factor, point) in row.iter().zip(&points) {
                    for axis in 0..3 {
                        sum[axis] = sum[axis].plus(&factor.times(&point[axis])?)?;
                    }
                }
                Some(sum)
            };
            entries.chunks(rows.count).map(sum).collect()
        }
    }
}

/// The greatest second difference of a piece in both norms.
fn second_differences<W: Word>(shape: &Shape, source: &Source, piece: usize, positions: &Positions) -> Option<[W; 2]> {
    let points: Vec<[W; 3]> = control_points(shape, source, piece, positions)?;
    let mut greatest = [W::zero(), W::zero()];
    for three in points.windows(3) {
        let (before, after) = (difference(&three[1], &three[0])?, difference(&three[2], &three[1])?);
        for (most, found) in greatest.iter_mut().zip(norms(&difference(&after, &before)?)?) {
            if found > *most {
                *most = found;
            }
        }
    }
    Some(greatest)
}

/// Is the number of piece i less than that of piece j, each times its factor (or the square of that)?
fn less<W: Word>(values: &[W], factors: &[Rational], squared: bool, i: usize, j: usize) -> bool {
    if factors[i] == factors[j] {
        return values[i] < values[j];
    }
    let times = |value: &W, factor: &Rational| {
        let factor = if squared { factor * factor } else { factor.clone() };
        factor * Rational::from_integer(value.to_integer())
    };
    times(&values[i], &factors[i]) < times(&values[j], &factors[j])
}

impl<W: Word> Measures<W> {
    fn new(criteria: &Parts, shape: &Shape, positions: &Positions) -> Option<Self> {
        let mut second = [Vec::new(), Vec::new()];
        for (piece, source) in criteria.sources.iter().enumerate() {
            let found = second_differences(shape, source, piece, positions)?;
            second.iter_mut().zip(found).for_each(|(all, one)| all.push(one));
        }
        let mut moved = [Vec::new(), Vec::new()];
        for place in 0..positions.count() {
            let found = displacement(criteria.start, positions, place)?;
            moved.iter_mut().zip(found).for_each(|(all, one)| all.push(one));
        }
        let of_second = |norm: usize| {
            let values = &second[norm];
            Greatest::new(values.len(), |i, j| less(values, criteria.factors, norm == 1, i, j))
        };
        let of_moved = |norm: usize| Greatest::new(moved[norm].len(), |i, j| moved[norm][i] < moved[norm][j]);
        Some(Measures {
            second_greatest: [of_second(0), of_second(1)],
            moved_greatest: [of_moved(0), of_moved(1)],
            second,
            moved,
        })
    }

    /// Takes account of a move; `None` if a number does not fit.
    fn update(&mut self, criteria: &Parts, shape: &Shape, positions: &Positions, displacements: &Move) -> Option<()> {
        let all = 4 * displacements.len() >= positions.count();
        for point in displacements.points() {
            let found = displacement(criteria.start, positions, point as usize)?;
            for (norm, found) in found.into_iter().enumerate() {
                let values = &mut self.moved[norm];
                values[point as usize] = found;
                if !all {
                    self.moved_greatest[norm].update(point as usize, |i, j| values[i] < values[j]);
                }
            }
        }
        let mut pieces: Vec<usize> = if all {
            (0..shape.pieces.len()).collect()
        } else {
            let places = displacements
                .points()
                .flat_map(|point| positions.places(point as usize));
            places.flat_map(|place| shape.pieces_at(place)).collect()
        };
        pieces.sort_unstable();
        pieces.dedup();
        for piece in pieces {
            let found = second_differences(shape, &criteria.sources[piece], piece, positions)?;
            for (norm, found) in found.into_iter().enumerate() {
                let values = &mut self.second[norm];
                values[piece] = found;
                if !all {
                    self.second_greatest[norm].update(piece, |i, j| less(values, criteria.factors, norm == 1, i, j));
                }
            }
        }
        if all {
            for norm in 0..2 {
                let values = &self.moved[norm];
                self.moved_greatest[norm].refresh(|i, j| values[i] < values[j]);
                let values = &self.second[norm];
                self.second_greatest[norm].refresh(|i, j| less(values, criteria.factors, norm == 1, i, j));
            }
        }
        Some(())
    }

    fn unweighted(&self, criteria: &Parts, degrees: &[usize]) -> [Option<(Rational, usize)>; 2] {
        let one = degrees.iter().all(|degree| *degree == degrees[0]) && degrees[0] >= 2;
        [0, 1].map(|norm| {
            let value = |piece: usize| {
                let factor = &criteria.factors[piece] / bound_factor(degrees[piece]);
                let factor = if norm == 1 { &factor * &factor } else { factor };
                (
                    factor * Rational::from_integer(self.second[norm][piece].to_integer()),
                    piece,
                )
            };
            if one {
                // The same factor everywhere: the winner with N∞ is the winner without.
                return self.second_greatest[norm].winner().map(value);
            }
            let curved = (0..degrees.len()).filter(|piece| degrees[*piece] >= 2);
            curved.map(value).max_by(|a, b| a.0.cmp(&b.0))
        })
    }

    fn greatest(&self, criteria: &Parts) -> Greatests {
        let unit = Rational::new(Integer::ONE, criteria.denominator.clone());
        let scaled = |value: &W, factor: &Rational, norm: usize| {
            let factor = if norm == 1 { factor * factor } else { factor.clone() };
            factor * Rational::from_integer(value.to_integer())
        };
        let second = |norm: usize| {
            let winner = self.second_greatest[norm].winner();
            winner.map_or_else(Rational::default, |i| {
                scaled(&self.second[norm][i], &criteria.factors[i], norm)
            })
        };
        let moved = |norm: usize| {
            let winner = self.moved_greatest[norm].winner();
            winner.map_or_else(Rational::default, |i| scaled(&self.moved[norm][i], &unit, norm))
        };
        Greatests {
            second: [second(0), second(1)],
            moved: [moved(0), moved(1)],
        }
    }
}

fn displacement<W: Word>(start: &Positions, positions: &Positions, place: usize) -> Option<[W; 2]> {
    norms(&difference(&position(positions, place)?, &position(start, place)?)?)
}

/// What the measures of either width are computed with.
struct Parts<'p> {
    sources: &'p [Source],
    factors: &'p [Rational],
    denominator: &'p Integer,
    start: &'p Positions,
}

impl Criteria {
    /// The measures at time 0; `None` if a piece is rational.
    pub fn new(shape: &mut Shape, positions: &Positions, denominator: &Integer) -> Option<Self> {
        let mut sources = Vec::new();
        let mut factors = Vec::new();
        for piece in 0..shape.pieces.len() {
            let at = shape.pieces[piece];
            let (source, weight) = if at.direct {
                (Source::Direct, Integer::ONE)
            } else {
                let rows = shape.part_rows(piece, 0, 0);
                if rows.tangents.is_some() {
                    return None;
                }
                let weight = rows.weights[0].clone();
                (Source::Rows(Box::new(rows)), weight)
            };
            sources.push(source);
            factors.push(bound_factor(at.last - at.first) / Rational::from_integer(weight * denominator));
        }
        let degrees = shape.pieces.iter().map(|at| at.last - at.first).collect();
        let mut criteria = Criteria {
            degrees,
            sources,
            factors,
            denominator: denominator.clone(),
            start: positions.clone(),
            widths: Widths::Long(Measures {
                second: Default::default(),
                second_greatest: [0; 2].map(|_| Greatest::new(0, |_, _| false)),
                moved: Default::default(),
                moved_greatest: [0; 2].map(|_| Greatest::new(0, |_, _| false)),
            }),
        };
        criteria.widths = criteria.anew(shape, positions);
        Some(criteria)
    }

    fn anew(&self, shape: &Shape, positions: &Positions) -> Widths {
        let (parts, fits) = (self.parts(), "unbounded integers do not overflow");
        match Measures::new(&parts, shape, positions) {
            Some(short) => Widths::Short(short),
            None => Widths::Long(Measures::new(&parts, shape, positions).expect(fits)),
        }
    }

    fn parts(&self) -> Parts<'_> {
        Parts {
            sources: &self.sources,
            factors: &self.factors,
            denominator: &self.denominator,
            start: &self.start,
        }
    }

    /// Takes account of a move that made these positions of the ones before.
    pub fn update(&mut self, shape: &Shape, positions: &Positions, displacements: &Move) {
        let parts = Parts {
            sources: &self.sources,
            factors: &self.factors,
            denominator: &self.denominator,
            start: &self.start,
        };
        let updated = match &mut self.widths {
            Widths::Short(measures) => measures.update(&parts, shape, positions, displacements),
            Widths::Long(measures) => measures.update(&parts, shape, positions, displacements),
        };
        if updated.is_none() {
            self.widths = self.anew(shape, positions);
        }
    }

    /// The second differences P_{k−1} − 2P_k + P_{k+1}, k = 1 … n−1, of a piece of degree n.
    pub fn second_differences(&self, shape: &Shape, positions: &Positions, piece: usize) -> Vec<[Rational; 3]> {
        let points: Option<Vec<[Integer; 3]>> = control_points(shape, &self.sources[piece], piece, positions);
        let points = points.unwrap_or_default();
        let weight = match &self.sources[piece] {
            Source::Direct => Integer::ONE,
            Source::Rows(rows) => rows.weights[0].clone(),
        };
        let below = weight * &self.denominator;
        let axis = |three: &[[Integer; 3]], i: usize| {
            let numerator = &three[0][i] - &three[1][i] - &three[1][i] + &three[2][i];
            Rational::new(numerator, below.clone())
        };
        points
            .windows(3)
            .map(|three| [0, 1, 2].map(|i| axis(three, i)))
            .collect()
    }

    /// The greatest second difference without N∞, in each norm (in the Euclidean one its square), and a piece that attains it.
    pub fn unweighted(&self) -> [Option<(Rational, usize)>; 2] {
        match &self.widths {
            Widths::Short(measures) => measures.unweighted(&self.parts(), &self.degrees),
            Widths::Long(measures) => measures.unweighted(&self.parts(), &self.degrees),
        }
    }

    /// The greatest values at the present frame.
    pub fn greatest(&self) -> Greatests {
        match &self.widths {
            Widths::Short(measures) => measures.greatest(&self.parts()),
            Widths::Long(measures) => measures.greatest(&self.parts()),
        }
    }
}

impl Greatests {
    /// In each norm: do second differences and displacement together reach the display tolerance?
    pub fn reach(&self, tolerance: &Rational) -> [bool; 2] {
        let infinity = &self.second[0] + &self.moved[0] >= *tolerance;
        // √a + √b ≥ ε if and only if ε ≤ 0, or 2√(ab) ≥ ε² − a − b.
        let (a, b) = (&self.second[1], &self.moved[1]);
        let rest = tolerance * tolerance - a - b;
        let four = Rational::from_integer(4.into());
        let euclidean =
            !tolerance.numer().is_positive() || !rest.numer().is_positive() || four * a * b >= &rest * &rest;
        [infinity, euclidean]
    }

    /// In each norm: has some control point moved by half of ν or more?
    pub fn reach_half(&self, nu_squared: &Rational) -> [bool; 2] {
        let four = Rational::from_integer(4.into());
        [
            &four * &self.moved[0] * &self.moved[0] >= *nu_squared,
            &four * &self.moved[1] >= *nu_squared,
        ]
    }
}

/// Notes a failure at a frame, unless an earlier one is known.
pub fn note(first: &mut FirstFailures, fails: [bool; 2], frame: u64) {
    for (known, fails) in [&mut first.infinity, &mut first.euclidean].into_iter().zip(fails) {
        if known.is_none() && fails {
            *known = Some(frame);
        }
    }
}
