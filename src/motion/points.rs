//! The own control points of a curve: those that a motion moves.

use super::{Content, MAXIMUM_SUBDIVISIONS, MotionError, Strategy};
use crate::curve::{Bezier, Curve, Form, MAXIMUM_PIECES};
use crate::number::{Integer, Rational};

/// The own control points of a curve, in their order (docs/FORMAT.md §10): of a B-spline its control points; of Bézier pieces those of piece 0,
/// then of each further piece all but the first, of a closed chain without the last point of the last piece.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Points {
    dimension: usize,
    coordinates: Vec<Rational>,
    /// For every point: is it a joint of Bézier pieces, the closing point of a closed chain included?
    joints: Vec<bool>,
    /// Does the chain of Bézier pieces come round, so that the last point is beside the first?
    round: bool,
}

impl Points {
    /// The own control points of a curve.
    pub fn of(curve: &Curve) -> Points {
        let dimension = curve.dimension();
        match curve.form() {
            Form::BSpline(spline) => Points {
                dimension,
                coordinates: spline.points().iter().collect(),
                joints: vec![false; spline.count()],
                round: false,
            },
            Form::Bezier(pieces) => {
                let round = curve.is_closed();
                let mut coordinates: Vec<Rational> = pieces[0].points().iter().take(dimension).collect();
                let mut joints = vec![round];
                for piece in pieces {
                    coordinates.extend(piece.points().iter().skip(dimension));
                    joints.extend(std::iter::repeat_n(false, piece.degree() - 1));
                    joints.push(true);
                }
                if round {
                    coordinates.truncate(coordinates.len() - dimension);
                    joints.pop();
                } else if let Some(last) = joints.last_mut() {
                    *last = false;
                }
                Points {
                    dimension,
                    coordinates,
                    joints,
                    round,
                }
            }
        }
    }

    /// Coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// How many points there are.
    pub fn count(&self) -> usize {
        self.joints.len()
    }

    /// The coordinates at time 0, one point after another.
    pub fn coordinates(&self) -> &[Rational] {
        &self.coordinates
    }

    /// The coordinates at time 0 as integers over a multiple of [`Points::denominator`].
    pub fn over(&self, denominator: &Integer) -> Vec<Integer> {
        let over = |x: &Rational| x.numer() * denominator.div_exact(x.denom());
        self.coordinates.iter().map(over).collect()
    }

    /// The least common denominator of the coordinates.
    pub fn denominator(&self) -> Integer {
        self.coordinates.iter().fold(Integer::ONE, |lcm, x| lcm.lcm(x.denom()))
    }

    /// The types of CPIJ14 §6.1 of a point: 1 next to a joint, 2 a joint, 3 neither.
    ///
    /// # Panics
    /// When there is no such point.
    pub fn kind(&self, point: usize) -> u8 {
        if self.joints[point] {
            2
        } else if self.joints_beside(point).next().is_some() {
            1
        } else {
            3
        }
    }

    /// The points before and after one, where there are such.
    fn beside(&self, point: usize) -> [Option<usize>; 2] {
        let count = self.count();
        let before = match point {
            0 => self.round.then(|| count - 1),
            _ => Some(point - 1),
        };
        let after = match point + 1 {
            after if after < count => Some(after),
            _ => self.round.then_some(0),
        };
        [before, after]
    }

    fn joints_beside(&self, point: usize) -> impl Iterator<Item = usize> + '_ {
        self.beside(point).into_iter().flatten().filter(|k| self.joints[*k])
    }

    /// Refuses a curve that strategy `c1` cannot keep C¹.
    pub(super) fn require_c1(&self, curve: &Curve) -> Result<(), MotionError> {
        let refuse = |what: String| Err(MotionError::new("strategy", what));
        let Form::Bezier(pieces) = curve.form() else {
            return refuse("found a B-spline, expected Bézier pieces for c1: give a number of subdivisions".into());
        };
        if let Some(i) = pieces.iter().position(|piece| !piece.is_polynomial()) {
            return refuse(format!("found weights in piece {i}, expected polynomial pieces for c1"));
        }
        let joints = 1..pieces.len() + usize::from(self.round);
        for joint in joints {
            let (before, after) = (&pieces[joint - 1], &pieces[joint % pieces.len()]);
            let (n, m) = (before.degree(), after.degree());
            if n != m || n < 2 {
                return refuse(format!(
                    "found pieces of degrees {n} and {m} at joint {joint}, expected one degree of at least 2 for c1"
                ));
            }
            let difference = |piece: &Bezier, k: usize| -> Vec<Rational> {
                let (p, q) = (piece.point(k), piece.point(k + 1));
                q.into_iter().zip(p).map(|(q, p)| q - p).collect()
            };
            if difference(before, n - 1) != difference(after, 0) {
                return refuse(format!(
                    "found different end edges at joint {joint}, expected an exactly C¹ chain of equal spans for c1"
                ));
            }
        }
        Ok(())
    }

    /// Does a step speak of points that there are, each once, of their types?
    pub(super) fn check(&self, content: &Content, strategy: Strategy) -> Result<(), MotionError> {
        let count = self.count();
        let moves = match content {
            Content::Frame(coordinates) => {
                let found = coordinates.len() / self.dimension;
                if found != count {
                    return Err(MotionError::new("", format!("found {found} points, expected {count}")));
                }
                return Ok(());
            }
            Content::Moves(moves) => moves,
        };
        let mut order: Vec<usize> = (0..moves.len()).collect();
        order.sort_by_key(|i| (moves[*i].point, *i));
        if let Some(pair) = order
            .windows(2)
            .find(|pair| moves[pair[0]].point == moves[pair[1]].point)
        {
            let what = format!("found point {} twice, expected it once", moves[pair[1]].point);
            return Err(MotionError::new(format!("moves[{}].point", pair[1]), what));
        }
        for (i, entry) in moves.iter().enumerate() {
            let point = usize::try_from(entry.point).ok().filter(|point| *point < count);
            let Some(point) = point else {
                let what = format!("found point {}, expected one from 0 to {}", entry.point, count - 1);
                return Err(MotionError::new(format!("moves[{i}].point"), what));
            };
            let Some(kind) = entry.kind else { continue };
            let place = format!("moves[{i}].type");
            if strategy != Strategy::C1 {
                return Err(MotionError::new(
                    place,
                    "found a type, expected none without the strategy c1",
                ));
            }
            let expected = self.kind(point);
            if kind != expected {
                let what = format!("found type {kind}, expected {expected} for point {point}");
                return Err(MotionError::new(place, what));
            }
        }
        Ok(())
    }

    /// The displacements of all points that a step moves under strategy `c1` (CPIJ14 §6): the two neighbours of a joint get its displacement beside their own,
    /// then every joint goes to the midpoint of its neighbours. `step` is in increasing order and over an even multiple of its denominator.
    pub(super) fn keep_c1(&self, step: super::Step) -> super::Step {
        let mut moved: std::collections::BTreeMap<usize, [Integer; 3]> = std::collections::BTreeMap::new();
        let mut add = |point: usize, by: &[Integer; 3]| {
            let sum = moved.entry(point).or_default();
            for (x, y) in sum.iter_mut().zip(by) {
                *x = &*x + y;
            }
        };
        for (point, by) in &step {
            let point = *point as usize;
            if self.joints[point] {
                self.beside(point)
                    .into_iter()
                    .flatten()
                    .for_each(|beside| add(beside, by));
            } else {
                add(point, by);
            }
        }
        let joints: std::collections::BTreeSet<usize> =
            moved.keys().flat_map(|point| self.joints_beside(*point)).collect();
        for joint in joints {
            let mut sum: [Integer; 3] = Default::default();
            for beside in self.beside(joint).into_iter().flatten() {
                if let Some(by) = moved.get(&beside) {
                    for (x, y) in sum.iter_mut().zip(by) {
                        *x = &*x + y;
                    }
                }
            }
            moved.insert(joint, sum.map(|x| x >> 1u32));
        }
        moved.into_iter().map(|(point, by)| (point as u64, by)).collect()
    }
}

/// The curve with every piece halved α times, as Bézier pieces; as it is for α = 0.
pub(super) fn subdivided(curve: Curve, times: u32) -> Result<Curve, MotionError> {
    if times == 0 {
        return Ok(curve);
    }
    let refuse = |what: String| MotionError::new("subdivisions", what);
    if times > MAXIMUM_SUBDIVISIONS {
        return Err(refuse(format!(
            "found {times}, expected at most {MAXIMUM_SUBDIVISIONS}"
        )));
    }
    let chain = curve.chain();
    let count = chain
        .count()
        .checked_shl(times)
        .filter(|count| *count <= MAXIMUM_PIECES);
    if count.is_none() {
        return Err(refuse(format!(
            "found {times}, expected at most {MAXIMUM_PIECES} pieces after it"
        )));
    }
    let half = Rational::new(Integer::ONE, Integer::from(2));
    let mut pieces = chain.pieces().to_vec();
    for _ in 0..times {
        let mut halves = Vec::with_capacity(2 * pieces.len());
        for piece in &pieces {
            let (left, right) = piece.split(&half).map_err(|error| refuse(error.to_string()))?;
            halves.extend([left, right]);
        }
        pieces = halves;
    }
    Curve::new(curve.dimension(), Form::Bezier(pieces)).map_err(|error| refuse(error.to_string()))
}
