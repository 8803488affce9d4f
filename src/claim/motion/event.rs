//! The events of a motion, and their binary spelling (FORMAT §14).

use std::io;

use super::MAX_TIME_EXPONENT;
use crate::claim::tree::{
    BinaryTokens, ByteRead, TokenError, TokenSource, read_signed_varint, read_varint, write_signed_varint, write_varint,
};
use crate::number::Integer;

/// The most bits of a displacement's coordinate, as of all numbers in a certificate.
const MAX_DISPLACEMENT_BITS: u64 = 65_536;

/// What an event is about: the curve, or the polygon of its own control points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TrackKind {
    /// The moving curve.
    Curve,
    /// The moving polygon of its own control points.
    Polygon,
}

impl TrackKind {
    /// Both.
    pub const BOTH: [TrackKind; 2] = [TrackKind::Curve, TrackKind::Polygon];

    /// Its name in a certificate.
    pub fn name(self) -> &'static str {
        match self {
            TrackKind::Curve => "curve",
            TrackKind::Polygon => "polygon",
        }
    }

    /// The track of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        TrackKind::BOTH.into_iter().find(|kind| kind.name() == name)
    }
}

/// Displacements of own control points between two frames, in units of 1/Q: numbers increase strictly, none is zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Move(Entries);

/// `Wide` only when some coordinate does not fit in 64 bits.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Entries {
    Narrow(Vec<(u64, [i64; 3])>),
    Wide(Vec<(u64, [Integer; 3])>),
}

/// Why something is not a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MoveError {
    /// The number of a point is not above the one before.
    Order {
        /// The number.
        point: u64,
    },
    /// A displacement is zero.
    Zero {
        /// The number of its point.
        point: u64,
    },
}

impl std::fmt::Display for MoveError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            MoveError::Order { point } => write!(f, "point {point} of a move: expected numbers that increase"),
            MoveError::Zero { point } => write!(f, "point {point} of a move: expected a displacement other than zero"),
        }
    }
}

impl std::error::Error for MoveError {}

impl Default for Move {
    fn default() -> Self {
        Move(Entries::Narrow(Vec::new()))
    }
}

impl Move {
    /// A move of no point.
    pub fn new() -> Self {
        Move::default()
    }

    /// How many points move.
    pub fn len(&self) -> usize {
        match &self.0 {
            Entries::Narrow(entries) => entries.len(),
            Entries::Wide(entries) => entries.len(),
        }
    }

    /// Does no point move?
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of the last point that moves.
    pub fn last_point(&self) -> Option<u64> {
        match &self.0 {
            Entries::Narrow(entries) => entries.last().map(|entry| entry.0),
            Entries::Wide(entries) => entries.last().map(|entry| entry.0),
        }
    }

    /// The points and displacements, if all coordinates fit in 64 bits.
    pub fn narrow(&self) -> Option<&[(u64, [i64; 3])]> {
        match &self.0 {
            Entries::Narrow(entries) => Some(entries),
            Entries::Wide(_) => None,
        }
    }

    /// The points and displacements; the third coordinate is 0 in the plane.
    pub fn iter(&self) -> impl Iterator<Item = (u64, [Integer; 3])> + '_ {
        let (narrow, wide) = match &self.0 {
            Entries::Narrow(entries) => (entries.as_slice(), [].as_slice()),
            Entries::Wide(entries) => ([].as_slice(), entries.as_slice()),
        };
        let narrow = narrow.iter().map(|(point, by)| (*point, by.map(Integer::from)));
        narrow.chain(wide.iter().cloned())
    }

    /// The numbers of the points.
    pub fn points(&self) -> impl Iterator<Item = u64> + '_ {
        let (narrow, wide) = match &self.0 {
            Entries::Narrow(entries) => (entries.as_slice(), [].as_slice()),
            Entries::Wide(entries) => ([].as_slice(), entries.as_slice()),
        };
        let wide = wide.iter().map(|entry| entry.0);
        narrow.iter().map(|entry| entry.0).chain(wide)
    }

    /// Appends a displacement.
    ///
    /// # Errors
    /// A number that is not above the last one, a displacement zero.
    pub fn push(&mut self, point: u64, by: [Integer; 3]) -> Result<(), MoveError> {
        if self.last_point().is_some_and(|last| last >= point) {
            return Err(MoveError::Order { point });
        }
        if by.iter().all(Integer::is_zero) {
            return Err(MoveError::Zero { point });
        }
        if let Entries::Narrow(entries) = &mut self.0 {
            if let [Some(x), Some(y), Some(z)] = [by[0].to_i64(), by[1].to_i64(), by[2].to_i64()] {
                entries.push((point, [x, y, z]));
                return Ok(());
            }
            let wide = entries.iter().map(|(point, by)| (*point, by.map(Integer::from)));
            self.0 = Entries::Wide(wide.collect());
        }
        if let Entries::Wide(entries) = &mut self.0 {
            entries.push((point, by));
        }
        Ok(())
    }
}

/// One event. The tokens of a tree or an edit follow from the same source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// The track's leaves become those of a complete tree.
    Tree(TrackKind),
    /// A leaf, by its number, is replaced by a complete tree for its pair.
    Edit(TrackKind, u64),
    /// Nothing more is shown of the track.
    End(TrackKind),
    /// The next move, as a whole.
    Step(Move),
    /// The next move, to be gone through in parts.
    Begin(Move),
    /// The current time becomes numerator/2^exponent of the move that has begun.
    Go {
        /// Odd, or 1 with exponent 0.
        numerator: u64,
        /// At most [`MAX_TIME_EXPONENT`].
        exponent: u32,
    },
}

/// Where events come from, one at a time.
pub trait EventSource: TokenSource {
    /// The next event, or `None` at the end of the evidence.
    ///
    /// # Errors
    /// Those of the source, and anything that is not an event.
    fn next_event(&mut self) -> Result<Option<Event>, TokenError>;

    /// Does the present event have tokens left over?
    fn tokens_left(&self) -> bool;
}

const STEP: u8 = 0x40;
const BEGIN: u8 = 0x41;
const GO: u8 = 0x42;
const TREE: u8 = 0x43;
const EDIT: u8 = 0x45;
const END: u8 = 0x47;

fn track_of(code: u8, first: u8) -> TrackKind {
    TrackKind::BOTH[usize::from(code - first)]
}

fn malformed(what: impl Into<String>) -> TokenError {
    TokenError::Malformed(what.into())
}

fn read_u64<R: ByteRead>(source: &mut R, what: &str) -> Result<u64, TokenError> {
    let value = read_varint(source, 64)?;
    value
        .to_u64()
        .ok_or_else(|| malformed(format!("{what} of more than 64 bits")))
}

fn read_move<R: ByteRead>(source: &mut R, dimension: usize) -> Result<Move, TokenError> {
    let count = read_u64(source, "a number of displacements")?;
    let mut read = Move::new();
    for _ in 0..count {
        let difference = read_u64(source, "the number of a point")?;
        let point = match read.last_point() {
            None => difference,
            Some(last) => last
                .checked_add(difference)
                .ok_or_else(|| malformed("the number of a point of more than 64 bits"))?,
        };
        let mut by: [Integer; 3] = Default::default();
        for coordinate in by.iter_mut().take(dimension) {
            *coordinate = read_signed_varint(source, MAX_DISPLACEMENT_BITS)?;
        }
        read.push(point, by).map_err(|error| malformed(error.to_string()))?;
    }
    Ok(read)
}

impl<R: ByteRead> EventSource for BinaryTokens<R> {
    fn next_event(&mut self) -> Result<Option<Event>, TokenError> {
        let (source, dimension) = self.parts();
        let mut byte = [0u8];
        if let Err(error) = source.read_exact(&mut byte) {
            return match error.kind() {
                io::ErrorKind::UnexpectedEof => Ok(None),
                _ => Err(error.into()),
            };
        }
        Ok(Some(match byte[0] {
            STEP => Event::Step(read_move(source, dimension)?),
            BEGIN => Event::Begin(read_move(source, dimension)?),
            GO => {
                let numerator = read_u64(source, "a numerator")?;
                let exponent = read_u64(source, "an exponent")?;
                match u32::try_from(exponent) {
                    Ok(exponent) if exponent <= MAX_TIME_EXPONENT => Event::Go { numerator, exponent },
                    _ => return Err(malformed(format!("an exponent above {MAX_TIME_EXPONENT}"))),
                }
            }
            code @ (0x43 | 0x44) => Event::Tree(track_of(code, TREE)),
            code @ (0x45 | 0x46) => {
                let leaf = read_u64(source, "the number of a leaf")?;
                Event::Edit(track_of(code, EDIT), leaf)
            }
            code @ (0x47 | 0x48) => Event::End(track_of(code, END)),
            code => return Err(malformed(format!("an event that begins with the byte {code:#04x}"))),
        }))
    }

    fn tokens_left(&self) -> bool {
        // In this spelling a tree ends where it is complete.
        false
    }
}

/// Appends a move in its binary spelling, without the byte that says which event it is of.
pub fn write_move(displacements: &Move, dimension: usize, out: &mut Vec<u8>) {
    write_varint(&Integer::from(displacements.len() as u64), out);
    let mut before = 0;
    for (point, by) in displacements.iter() {
        write_varint(&Integer::from(point - before), out);
        before = point;
        for coordinate in &by[..dimension] {
            write_signed_varint(coordinate, out);
        }
    }
}

/// Appends an event in its binary spelling; the tokens of a tree or an edit are to follow.
pub fn write_event(event: &Event, dimension: usize, out: &mut Vec<u8>) {
    match event {
        Event::Tree(kind) => out.push(TREE + *kind as u8),
        Event::Edit(kind, leaf) => {
            out.push(EDIT + *kind as u8);
            write_varint(&Integer::from(*leaf), out);
        }
        Event::End(kind) => out.push(END + *kind as u8),
        Event::Step(displacements) => {
            out.push(STEP);
            write_move(displacements, dimension, out);
        }
        Event::Begin(displacements) => {
            out.push(BEGIN);
            write_move(displacements, dimension, out);
        }
        Event::Go { numerator, exponent } => {
            out.push(GO);
            write_varint(&Integer::from(*numerator), out);
            write_varint(&Integer::from(*exponent), out);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn round_trip(event: &Event, dimension: usize) -> Event {
        let mut bytes = Vec::new();
        write_event(event, dimension, &mut bytes);
        let mut source = BinaryTokens::new(bytes.as_slice(), dimension);
        let read = source.next_event().unwrap().unwrap();
        assert_eq!(source.next_event().unwrap(), None);
        read
    }

    proptest! {
        #[test]
        fn events_round_trip(
            points in proptest::collection::btree_set(any::<u64>(), 0..20),
            coordinates in proptest::collection::vec(prop_oneof![-5i64..5, any::<i64>()], 60),
            wide: bool,
            leaf: u64,
            numerator: u64,
            exponent in 0u32..=60,
        ) {
            let mut displacements = Move::new();
            for (point, by) in points.iter().zip(coordinates.chunks(3)) {
                let by: [Integer; 3] = std::array::from_fn(|i| Integer::from(by[i]));
                let by = if wide { by.map(|x| x << 70u32) } else { by };
                let zero = by.iter().all(Integer::is_zero);
                prop_assert_eq!(displacements.push(*point, by).is_err(), zero);
            }
            let events = [
                Event::Step(displacements.clone()),
                Event::Begin(displacements),
                Event::Go { numerator, exponent },
                Event::Edit(TrackKind::Polygon, leaf),
                Event::Tree(TrackKind::Curve),
                Event::End(TrackKind::Polygon),
            ];
            for event in &events {
                prop_assert_eq!(&round_trip(event, 3), event);
            }
        }
    }

    #[test]
    fn what_is_not_an_event() {
        for bytes in [
            [0x49].as_slice(),
            &[0x00],
            // A displacement missing, one of zero, a number twice, an exponent of 61.
            &[0x40, 2, 0, 2, 0],
            &[0x40, 1, 0, 0, 0],
            &[0x40, 2, 5, 2, 0, 0, 2, 0],
            &[0x42, 1, 61],
            &[0x45],
        ] {
            let mut source = BinaryTokens::new(bytes, 2);
            assert!(source.next_event().is_err(), "{bytes:?}");
        }
    }
}
