//! Certifying what stays true of a moving curve and of the polygon of its control points.
//!
//! The tree of the first frame is kept. Leaves that do not hold at the next frame are replaced by trees that hold at both; where there are none, time is halved. What cannot be
//! followed at the smallest steps of time is a meeting, or undecided.

mod contact;
mod follow;
mod geometry;
mod measures;
mod search;

use std::borrow::Cow;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};

use tempfile::SpooledTempFile;

use super::evidence::{IN_MEMORY, write_checked};
use super::msd::CertifyError;
use crate::certificate::{Document, Encoding, MotionHash, write};
use crate::check::chain::Chain;
use crate::check::motion::{MotionError as PositionError, Positions, Shape, polygon};
use crate::claim::motion::{Contact, Content, Event, Evidence, Move, Statement, Track, TrackKind, write_event};
use crate::claim::tree::{Token, write_token};
use crate::curve::{Curve, Form};
use crate::motion::{Motion, MotionError, Step};
use crate::number::Rational;
use follow::{Follower, Stretch};
use measures::Measurer;
pub use measures::{AsPrinted, Measures};

/// What to certify, and how hard to try.
#[derive(Clone, Debug)]
pub struct Options {
    /// Follow the curve.
    pub curve: bool,
    /// Follow the polygon of its own control points.
    pub polygon: bool,
    /// ε_d, in place of that of the file.
    pub display_tolerance: Option<Rational>,
    /// How many leaves a tree may have; `None` for 500,000 and 64 for each piece.
    pub budget: Option<u64>,
    /// For so many frames at most the values of the criteria are kept.
    pub frames_kept: u64,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            curve: true,
            polygon: true,
            display_tolerance: None,
            budget: None,
            frames_kept: 10_000,
        }
    }
}

/// What became of a track.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Followed {
    /// The curve or the polygon.
    pub kind: TrackKind,
    /// What is stated of it; `None` if it could not be shown to be embedded at time 0.
    pub track: Option<Track>,
    /// Why it meets itself.
    pub contact: Option<Contact>,
    /// Why nothing more is known of it, if it neither came to the end nor met itself.
    pub undecided: Option<String>,
    /// Leaves of its table at the end.
    pub leaves: u64,
    /// Leaves that were replaced.
    pub edits: u64,
}

/// A certificate about a motion.
pub struct Certified<'m> {
    /// The document; `None` if nothing can be stated.
    pub document: Option<Document<'m, Content>>,
    /// What became of curve and polygon, in this order, as far as asked for.
    pub followed: Vec<Followed>,
    /// The criteria at each frame from 0 on, as far as kept.
    pub measures: Vec<Measures>,
    /// When the criterion as CPIJ14 print it first fails.
    pub as_printed: AsPrinted,
    events: SpooledTempFile,
}

/// Why a motion cannot be certified.
#[derive(Debug)]
pub enum Error {
    /// The motion's file.
    Motion(MotionError),
    /// A piece is a single point.
    PointPiece {
        /// Its number.
        piece: usize,
    },
    /// A step that opens a closed curve.
    Step {
        /// Its number, from 1: that of the frame it leads to.
        step: u64,
        /// What is wrong.
        error: PositionError,
    },
    /// The polygon has too many edges.
    Edges,
    /// The temporary file that holds the events.
    Io(io::Error),
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Error::Motion(error) => error.fmt(f),
            Error::PointPiece { piece } => write!(f, "{}", CertifyError::PointPiece { piece: *piece }),
            Error::Step { step, error } => write!(f, "step {step}: {error}"),
            Error::Edges => f.write_str("the control polygon has more than 4,000,000 edges"),
            Error::Io(error) => write!(f, "a temporary file: {error}"),
        }
    }
}

impl std::error::Error for Error {}

impl From<MotionError> for Error {
    fn from(error: MotionError) -> Self {
        Error::Motion(error)
    }
}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        Error::Io(error)
    }
}

impl Certified<'_> {
    /// Writes the certificate to `file`, reads it back and lets the checker replay it. Only `Ok` means that the file is a proof.
    ///
    /// # Errors
    /// [`CertifyError::Refuted`] when there is no document, or when the checker does not accept the file, which must then be thrown away.
    pub fn write_checked<F: Read + Write + Seek>(
        &mut self,
        encoding: Encoding,
        file: &mut F,
    ) -> Result<(), CertifyError> {
        let Some(document) = &self.document else {
            return Err(CertifyError::Refuted("nothing is stated".into()));
        };
        write_checked(document, &mut self.events, encoding, file, |claim| {
            claim
                .motion()
                .is_some_and(|content| content.statement == document.claim.statement)
        })
    }

    /// Writes the certificate.
    ///
    /// # Errors
    /// Those of `out` and of the temporary file that holds the events; an error of the kind `NotFound` when there is no document.
    pub fn write(&mut self, encoding: Encoding, out: &mut impl Write) -> io::Result<()> {
        let Some(document) = &self.document else {
            return Err(io::Error::new(io::ErrorKind::NotFound, "nothing is stated"));
        };
        self.events.seek(SeekFrom::Start(0))?;
        write(document, &mut self.events, encoding, out)
    }
}

/// The events found so far, in their binary spelling.
struct Events {
    out: BufWriter<SpooledTempFile>,
    bytes: Vec<u8>,
    dimension: usize,
}

impl Events {
    fn push(&mut self, event: &Event, tokens: &[Token]) -> io::Result<()> {
        self.bytes.clear();
        write_event(event, self.dimension, &mut self.bytes);
        for token in tokens {
            write_token(token, self.dimension, &mut self.bytes);
        }
        self.out.write_all(&self.bytes)
    }
}

/// A step as a move.
fn displacements(step: Step) -> Result<Move, MotionError> {
    let mut found = Move::new();
    for (point, by) in step {
        found
            .push(point, by)
            .map_err(|error| MotionError::new("", error.to_string()))?;
    }
    Ok(found)
}

/// Does the polygon of a B-spline that is closed at time 0 stay closed in all frames?
fn polygon_stays_closed(motion: &Motion) -> Result<bool, MotionError> {
    let Form::BSpline(spline) = motion.curve.form() else {
        return Ok(true);
    };
    let points = motion.points().over(&motion.denominator);
    let (dimension, last) = (spline.dimension(), spline.count() - 1);
    if points[..dimension] != points[last * dimension..] {
        return Ok(true);
    }
    for step in motion.moves()? {
        let step = step?;
        let of = |point: usize| step.iter().find(|entry| entry.0 == point as u64).map(|entry| &entry.1);
        if of(0) != of(last) {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Certifies a motion. `progress` is called with the part of the steps that is done.
///
/// # Errors
/// [`Error`].
pub fn certify<'m>(motion: &'m Motion, options: &Options, progress: &dyn Fn(f64)) -> Result<Certified<'m>, Error> {
    let curve = &motion.curve;
    Chain::new(curve).map_err(|piece| Error::PointPiece { piece })?;
    let outside = |error| Error::Step { step: 0, error };
    let mut positions = Positions::new(curve, &motion.denominator).map_err(outside)?;
    let polygon = polygon(curve).ok_or(Error::Edges)?;
    let mut events = Events {
        out: BufWriter::new(SpooledTempFile::new(IN_MEMORY)),
        bytes: Vec::new(),
        dimension: curve.dimension(),
    };
    let mut hash = MotionHash::new(curve, &motion.denominator);
    let tolerance = options.display_tolerance.as_ref().or(motion.display_tolerance.as_ref());
    let mut measurer =
        tolerance.and_then(|tolerance| Measurer::new(motion, &polygon, &positions, tolerance, options.frames_kept));
    let mut active = Vec::new();
    let mut followed = Vec::new();
    for (kind, wanted, followed_curve) in [
        (TrackKind::Curve, options.curve, curve),
        (TrackKind::Polygon, options.polygon, &polygon),
    ] {
        if !wanted {
            continue;
        }
        if kind == TrackKind::Polygon && !polygon_stays_closed(motion)? {
            followed.push(unfollowed(
                kind,
                "the polygon, closed at time 0, does not stay closed".into(),
            ));
            continue;
        }
        let budget = options
            .budget
            .unwrap_or(500_000 + 64 * followed_curve.chain().count() as u64);
        match Follower::plant(
            kind,
            followed_curve,
            &positions,
            &motion.denominator,
            budget,
            &mut events,
        )? {
            Ok(follower) => active.push(follower),
            Err(why) => followed.push(unfollowed(kind, format!("at time 0 {why}"))),
        }
    }
    let mut shape = Shape::new(curve);
    for (frame, step) in motion.moves()?.enumerate() {
        let frame = frame as u64;
        progress(frame as f64 / motion.steps.max(1) as f64);
        let displacements = displacements(step?)?;
        hash.include(&displacements);
        let mut next = positions.clone();
        let fails = |error| Error::Step { step: frame + 1, error };
        next.apply(&displacements).map_err(fails)?;
        shape.stays_closed(&next).map_err(fails)?;
        let stretch = Stretch {
            frame,
            denominator: &motion.denominator,
            positions: &positions,
            next: &next,
            displacements: &displacements,
        };
        followed.extend(stretch.go(&mut active, &mut events)?);
        if let Some(measurer) = &mut measurer {
            measurer.update(&next, &displacements, frame + 1);
        }
        positions = next;
        for follower in &mut active {
            follower.replant_if_grown(&positions, &mut events)?;
        }
    }
    progress(1.0);
    followed.extend(active.iter().map(|follower| follower.arrived(motion.steps)));
    followed.sort_by_key(|followed| followed.kind as u8);
    let of = |kind: TrackKind| followed.iter().find(|followed| followed.kind == kind);
    let track = |kind| of(kind).and_then(|followed| followed.track.clone());
    let contact = |kind| of(kind).and_then(|followed| followed.contact.clone());
    let (criteria, measures, as_printed) = match measurer {
        Some(measurer) => measurer.finish(),
        None => Default::default(),
    };
    let stated = followed.iter().any(|followed| followed.track.is_some()) || criteria.is_some();
    let document = stated.then(|| Document {
        tool: super::TOOL.into(),
        name: motion.name.clone(),
        snapped_joints: (motion.snapped > 0).then_some(motion.snapped as u64),
        curve: Cow::Borrowed(curve),
        claim: Content {
            statement: Statement {
                steps: motion.steps,
                denominator: motion.denominator.clone(),
                motion_sha256: hash.finish(),
                curve: track(TrackKind::Curve),
                polygon: track(TrackKind::Polygon),
                criteria,
            },
            evidence: Evidence {
                curve_contact: contact(TrackKind::Curve),
                polygon_contact: contact(TrackKind::Polygon),
            },
        },
    });
    let events = events.out.into_inner().map_err(|error| Error::Io(error.into_error()))?;
    Ok(Certified {
        document,
        followed,
        measures,
        as_printed,
        events,
    })
}

fn unfollowed(kind: TrackKind, why: String) -> Followed {
    Followed {
        kind,
        track: None,
        contact: None,
        undecided: Some(why),
        leaves: 0,
        edits: 0,
    }
}

/// The curve or polygon in words.
fn name(kind: TrackKind) -> &'static str {
    match kind {
        TrackKind::Curve => "the curve",
        TrackKind::Polygon => "the polygon",
    }
}

/// Is the curve made of Bézier pieces, all of them polynomial?
fn polynomial_pieces(curve: &Curve) -> bool {
    match curve.form() {
        Form::Bezier(pieces) => pieces.iter().all(|piece| piece.is_polynomial()),
        Form::BSpline(_) => false,
    }
}
