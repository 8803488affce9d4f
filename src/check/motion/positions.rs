//! Where the own control points are at a time, in units of 1/Q.

use crate::claim::motion::Move;
use crate::curve::{Curve, Form, MAXIMUM_BITS};
use crate::number::{Integer, RationalVector};

/// Coordinates of this magnitude and above are not kept in 64 bits, so that differences of two that are kept fit.
const NARROW_LIMIT: u64 = 1 << 62;

/// Why a motion cannot be followed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MotionError {
    /// A coordinate at time 0 is not an integer over the denominator.
    Denominator {
        /// The number of its own control point.
        point: usize,
    },
    /// A move names a point that does not exist.
    Point {
        /// Its number.
        point: u64,
        /// How many there are.
        count: usize,
    },
    /// A coordinate of a frame has more than 65,536 bits.
    Size {
        /// The number of its own control point.
        point: u64,
    },
    /// A closed curve, or its polygon, does not stay closed.
    Opens,
}

impl std::fmt::Display for MotionError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            MotionError::Denominator { point } => {
                write!(
                    f,
                    "expected coordinates that are integers over the denominator, own control point {point} has others"
                )
            }
            MotionError::Point { point, count } => {
                write!(f, "found own control point {point}, expected a number below {count}")
            }
            MotionError::Size { point } => {
                write!(
                    f,
                    "expected coordinates of at most 65,536 bits, own control point {point} has longer ones"
                )
            }
            MotionError::Opens => f.write_str("expected a curve and polygon that stay closed, found ends apart"),
        }
    }
}

impl std::error::Error for MotionError {}

/// The positions of all own control points.
///
/// Behind those of a closed chain of Bézier pieces the first stands once more, so that the points of every piece stand in a row.
#[derive(Clone, Debug)]
pub struct Positions {
    narrow: Vec<[i64; 3]>,
    /// In place of `narrow` when some coordinate is too large for it.
    wide: Vec<[Integer; 3]>,
    /// Number of own control points.
    count: usize,
    /// At least the bit length of every coordinate in `narrow`.
    magnitude: u64,
}

fn too_long(position: &[Integer; 3]) -> bool {
    position.iter().any(|x| x.bits() > MAXIMUM_BITS)
}

/// The coordinates of the own control points of a curve, point by point, each curve piece's over its own denominator.
fn own_coordinates(curve: &Curve) -> Vec<(Vec<Integer>, Integer)> {
    let dimension = curve.dimension();
    let points = |vector: &RationalVector, skip: usize| -> Vec<(Vec<Integer>, Integer)> {
        let points = vector.numerators().chunks(dimension).skip(skip);
        points
            .map(|point| (point.to_vec(), vector.denominator().clone()))
            .collect()
    };
    match curve.form() {
        Form::BSpline(spline) => points(spline.points(), 0),
        Form::Bezier(pieces) => {
            let each = pieces.iter().enumerate();
            each.flat_map(|(i, piece)| points(piece.points(), usize::from(i > 0)))
                .collect()
        }
    }
}

impl Positions {
    /// The positions at time 0 over the denominator Q ≥ 1.
    ///
    /// # Errors
    /// [`MotionError::Denominator`], [`MotionError::Size`].
    pub fn new(curve: &Curve, denominator: &Integer) -> Result<Self, MotionError> {
        let mut wide = Vec::new();
        for (point, (coordinates, below)) in own_coordinates(curve).into_iter().enumerate() {
            let mut position: [Integer; 3] = Default::default();
            for (axis, x) in coordinates.iter().enumerate() {
                let (quotient, rest) = (x * denominator).div_rem(&below);
                if !rest.is_zero() {
                    return Err(MotionError::Denominator { point });
                }
                position[axis] = quotient;
            }
            if too_long(&position) {
                let point = point as u64;
                return Err(MotionError::Size { point });
            }
            wide.push(position);
        }
        let round = matches!(curve.form(), Form::Bezier(_)) && curve.is_closed();
        let count = wide.len() - usize::from(round);
        let mut positions = Positions {
            narrow: Vec::new(),
            wide,
            count,
            magnitude: 0,
        };
        positions.narrow_if_possible();
        Ok(positions)
    }

    /// Number of own control points.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Number of positions: one more than of own control points if the first stands at the end again.
    pub fn len(&self) -> usize {
        self.narrow.len().max(self.wide.len())
    }

    /// Are there none? A curve has some.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All positions, if they are kept in 64 bits.
    pub fn narrow(&self) -> Option<&[[i64; 3]]> {
        self.wide.is_empty().then_some(&self.narrow)
    }

    /// At least the bit length of every coordinate, if they are kept in 64 bits.
    pub fn bits(&self) -> u32 {
        u64::BITS - self.magnitude.leading_zeros()
    }

    /// One position.
    pub fn get(&self, i: usize) -> [Integer; 3] {
        match self.wide.is_empty() {
            true => self.narrow[i].map(Integer::from),
            false => self.wide[i].clone(),
        }
    }

    /// The places at which a point stands: its number, and of the first one perhaps the end.
    pub fn places(&self, point: usize) -> impl Iterator<Item = usize> + use<> {
        let again = (point == 0 && self.len() > self.count).then_some(self.count);
        std::iter::once(point).chain(again)
    }

    fn narrow_if_possible(&mut self) {
        if self.wide.is_empty() {
            return;
        }
        let all: Option<Vec<[i64; 3]>> = self
            .wide
            .iter()
            .map(|position| {
                let axis = |i: usize| position[i].to_i64().filter(|x| x.unsigned_abs() < NARROW_LIMIT);
                Some([axis(0)?, axis(1)?, axis(2)?])
            })
            .collect();
        if let Some(all) = all {
            self.magnitude = all.iter().flatten().fold(0, |bits, x| bits | x.unsigned_abs());
            self.narrow = all;
            self.wide = Vec::new();
        }
    }

    fn widen(&mut self) {
        if self.wide.is_empty() {
            self.wide = self.narrow.iter().map(|position| position.map(Integer::from)).collect();
            self.narrow = Vec::new();
        }
    }

    /// Moves the points.
    ///
    /// # Errors
    /// [`MotionError::Point`], and nothing is moved; [`MotionError::Size`].
    pub fn apply(&mut self, displacements: &Move) -> Result<(), MotionError> {
        self.displace(displacements, &Integer::ONE)?;
        let long = |point: &u64| !self.wide.is_empty() && too_long(&self.wide[*point as usize]);
        match displacements.points().find(long) {
            None => Ok(()),
            Some(point) => Err(MotionError::Size { point }),
        }
    }

    /// The positions on the way of a move, at numerator/2^exponent of it, in units of 1/(2^exponent·Q).
    ///
    /// # Errors
    /// [`MotionError::Point`].
    pub fn between(&self, displacements: &Move, numerator: u64, exponent: u32) -> Result<Positions, MotionError> {
        self.on_the_way(displacements, &Integer::from(numerator), &(Integer::ONE << exponent))
    }

    /// The positions at numerator/denominator of the way of a move, in units of 1/(denominator·Q).
    ///
    /// # Errors
    /// [`MotionError::Point`].
    pub fn on_the_way(
        &self,
        displacements: &Move,
        numerator: &Integer,
        denominator: &Integer,
    ) -> Result<Positions, MotionError> {
        let mut positions = self.clone();
        positions.widen();
        for x in positions.wide.iter_mut().flatten() {
            *x = &*x * denominator;
        }
        positions.displace(displacements, numerator)?;
        positions.narrow_if_possible();
        Ok(positions)
    }

    fn displace(&mut self, displacements: &Move, factor: &Integer) -> Result<(), MotionError> {
        if let Some(point) = displacements.last_point().filter(|last| *last >= self.count as u64) {
            let count = self.count;
            return Err(MotionError::Point { point, count });
        }
        if self.wide.is_empty()
            && factor.is_one()
            && displacements.narrow().is_some_and(|entries| self.try_narrow(entries))
        {
            return Ok(());
        }
        self.widen();
        for (point, by) in displacements.iter() {
            for place in self.places(point as usize) {
                for axis in 0..3 {
                    let x = &mut self.wide[place][axis];
                    *x = &*x + &by[axis] * factor;
                }
            }
        }
        self.narrow_if_possible();
        Ok(())
    }

    /// Moves the points in 64 bits, or moves none.
    fn try_narrow(&mut self, entries: &[(u64, [i64; 3])]) -> bool {
        let mut magnitude = self.magnitude;
        for (done, (point, by)) in entries.iter().enumerate() {
            let position = &mut self.narrow[*point as usize];
            let moved: [i64; 3] = std::array::from_fn(|axis| position[axis].saturating_add(by[axis]));
            let bits = moved[0].unsigned_abs() | moved[1].unsigned_abs() | moved[2].unsigned_abs();
            if bits >= NARROW_LIMIT {
                // Nothing overflowed so far: it can be taken back exactly.
                for (point, by) in &entries[..done] {
                    let position = &mut self.narrow[*point as usize];
                    (0..3).for_each(|axis| position[axis] -= by[axis]);
                }
                return false;
            }
            *position = moved;
            magnitude |= bits;
        }
        self.magnitude = magnitude;
        if self.narrow.len() > self.count {
            self.narrow[self.count] = self.narrow[0];
        }
        true
    }
}
