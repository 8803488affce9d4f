//! Motion files, JSON `motion/1`: a curve and how its control points move, step by step.
//!
//! A motion file is one JSON document, or JSON lines: the same document without its steps on the first line, then one step or frame on each
//! line. Lines are read twice, the first time for the common denominator, so that a long motion needs no memory.
//!
//! | field | meaning |
//! | --- | --- |
//! | `knotproof` | `"motion/1"` |
//! | `name` | free text, optional |
//! | `numbers` | `"decimal"` (the default) or `"binary64"`, of all numbers but those of a curve in a file of its own |
//! | `curve` | a curve as in a file of version `curve/1`, or the path of such a file, relative to this one |
//! | `strategy` | `"free"` (the default): the points named move, and no others; `"c1"`: a C¹ chain of Bézier pieces stays C¹ |
//! | `subdivisions` | α ≤ 16 (default 0): the pieces are halved α times before points are numbered |
//! | `display_tolerance` | ε_d > 0, optional |
//! | `steps` | a list of `{"moves": [{"point": 7, "by": ["0", "1/4"], "type": 2}, …]}`; `type` is optional, and for `c1` only |
//! | `frames` | in place of `steps`: whole frames, from frame 1 on, each a list of all own control points |
//!
//! A line is `{"moves": […]}` or `{"points": […]}`, all of one kind.

mod document;
mod error;
mod points;
mod strategy;

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::curve::{Curve, MAXIMUM_BITS};
use crate::number::{Integer, Meaning, Rational};

use document::Header;
pub use error::MotionError;
pub use points::Points;
pub use strategy::Strategy;

/// The version of motion files that is read.
pub const VERSION: &str = "motion/1";

/// The most steps of a motion.
pub const MAXIMUM_STEPS: u64 = 100_000_000;

/// How often pieces may be halved at most before they move.
pub const MAXIMUM_SUBDIVISIONS: u32 = 16;

/// The displacements of one step: numbers of own control points in increasing order, and what is added to their coordinates, integers over the
/// motion's common denominator; no displacement is zero. The third coordinate is 0 in the plane.
pub type Step = Vec<(u64, [Integer; 3])>;

/// A motion as its file gives it.
#[derive(Debug)]
pub struct Motion {
    /// The file's name, or the curve's.
    pub name: Option<String>,
    /// The curve at time 0, after subdivision.
    pub curve: Curve,
    /// How many joints of the curve were moved together on reading.
    pub snapped: usize,
    /// How displacements are meant.
    pub strategy: Strategy,
    /// How often every piece was halved.
    pub subdivisions: u32,
    /// The display tolerance ε_d, if the file has one; positive.
    pub display_tolerance: Option<Rational>,
    /// What all coordinates, at all times, are integers over.
    pub denominator: Integer,
    /// The number of steps.
    pub steps: u64,
    points: Points,
    meaning: Meaning,
    source: Source,
}

/// Where the texts of steps are.
#[derive(Debug)]
enum Source {
    /// In one document, in memory.
    Document {
        text: String,
        steps: Vec<Range<usize>>,
        frames: bool,
    },
    /// One on each line after the first.
    Lines(PathBuf),
    /// The same in memory.
    LinesInMemory(String),
}

/// How to read a motion.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReadOptions {
    /// As of [`crate::curve::ReadOptions`].
    pub snap_joints: bool,
}

/// Reads a motion file.
///
/// # Errors
/// The first fault found, with its line or JSON path.
pub fn read_motion(path: &Path, options: ReadOptions) -> Result<Motion, MotionError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut file = BufReader::new(File::open(path)?);
    let mut first = Vec::new();
    file.read_until(b'\n', &mut first)?;
    if is_header(utf8(&first)?) {
        return Motion::of_lines(utf8(&first)?, Source::Lines(path.to_path_buf()), folder, options);
    }
    io::Read::read_to_end(&mut file, &mut first)?;
    Motion::of_document(utf8(&first)?, folder, options)
}

/// Reads a motion from memory; paths of curves are relative to `folder`.
///
/// # Errors
/// As [`read_motion`].
pub fn read_motion_text(text: &[u8], folder: &Path, options: ReadOptions) -> Result<Motion, MotionError> {
    let text = utf8(text)?;
    let first = text.split_inclusive('\n').next().unwrap_or_default();
    if is_header(first) {
        return Motion::of_lines(first, Source::LinesInMemory(text.to_string()), folder, options);
    }
    Motion::of_document(text, folder, options)
}

fn utf8(bytes: &[u8]) -> Result<&str, MotionError> {
    std::str::from_utf8(bytes).map_err(|error| {
        let what = format!(
            "found bytes that are not UTF-8 at byte {}, expected JSON",
            error.valid_up_to()
        );
        MotionError::new("", what)
    })
}

/// Is the line a whole header without steps, so that the steps are on the lines after it?
fn is_header(line: &str) -> bool {
    document::parse_header(line).is_ok_and(|header| header.steps.is_none() && header.frames.is_none())
}

impl Motion {
    fn of_document(text: &str, folder: &Path, options: ReadOptions) -> Result<Motion, MotionError> {
        let header = document::parse_header(text)?;
        let (steps, frames) = match (&header.steps, &header.frames) {
            (Some(steps), None) => (steps, false),
            (None, Some(frames)) => (frames, true),
            (Some(_), Some(_)) => {
                return Err(MotionError::new(
                    "",
                    "found both steps and frames, expected one of them",
                ));
            }
            (None, None) => {
                let what = "found neither steps nor frames, expected one of them, or steps on lines after the first";
                return Err(MotionError::new("", what));
            }
        };
        let base = text.as_ptr() as usize;
        let place = |raw: &&serde_json::value::RawValue| {
            let start = raw.get().as_ptr() as usize - base;
            start..start + raw.get().len()
        };
        let source = Source::Document {
            text: text.to_string(),
            steps: steps.iter().map(place).collect(),
            frames,
        };
        Motion::new(&header, source, folder, options)
    }

    fn of_lines(first: &str, source: Source, folder: &Path, options: ReadOptions) -> Result<Motion, MotionError> {
        Motion::new(&document::parse_header(first)?, source, folder, options)
    }

    fn new(header: &Header, source: Source, folder: &Path, options: ReadOptions) -> Result<Motion, MotionError> {
        let meaning = document::meaning(header)?;
        let file = document::curve(header, folder, options.snap_joints)?;
        let subdivisions = header.subdivisions.unwrap_or(0);
        let curve = points::subdivided(file.curve, subdivisions)?;
        let strategy = Strategy::of(header.strategy.as_deref())?;
        let points = Points::of(&curve);
        if strategy == Strategy::C1 {
            points.require_c1(&curve)?;
            if header.frames.is_some() {
                let what = "found frames, expected steps: frames say of every point where it is";
                return Err(MotionError::new("strategy", what));
            }
        }
        let mut motion = Motion {
            name: header.name.clone().or(file.name),
            snapped: file.snapped,
            strategy,
            subdivisions,
            display_tolerance: document::display_tolerance(header, meaning)?,
            denominator: points.denominator(),
            steps: 0,
            curve,
            points,
            meaning,
            source,
        };
        motion.measure()?;
        Ok(motion)
    }

    /// The first pass: looks at every step, counts them, and finds the common denominator.
    fn measure(&mut self) -> Result<(), MotionError> {
        let mut denominator = self.denominator.clone();
        let mut steps = 0;
        let mut kind = None;
        for text in self.texts()? {
            let (place, text) = text?;
            let content = self.parse(&text, &place)?;
            let is_frame = matches!(content, Content::Frame(_));
            if *kind.get_or_insert(is_frame) != is_frame {
                return Err(MotionError::new(
                    place,
                    "found moves beside frames, expected all lines of one kind",
                ));
            }
            for number in content.numbers() {
                if (&denominator % number.denom()).is_zero() {
                    continue;
                }
                denominator = denominator.lcm(number.denom());
                if denominator.bits() > MAXIMUM_BITS {
                    let what = format!("found a common denominator above {MAXIMUM_BITS} bits, expected a smaller one");
                    return Err(MotionError::new(place, what));
                }
            }
            steps += 1;
            if steps > MAXIMUM_STEPS {
                let what = format!("found more than {MAXIMUM_STEPS} steps, expected fewer");
                return Err(MotionError::new(place, what));
            }
        }
        // Joints go to midpoints.
        let halves = u32::from(self.strategy == Strategy::C1);
        self.denominator = denominator << halves;
        self.steps = steps;
        Ok(())
    }

    /// The own control points of the curve.
    pub fn points(&self) -> &Points {
        &self.points
    }

    /// The steps, in order, read anew.
    ///
    /// # Errors
    /// When the file cannot be opened again.
    pub fn moves(&self) -> Result<Moves<'_>, MotionError> {
        Ok(Moves {
            motion: self,
            texts: self.texts()?,
            before: None,
            number: 0,
        })
    }

    fn texts(&self) -> Result<Texts<'_>, MotionError> {
        fn line<'l>((number, line): (usize, io::Result<String>)) -> Result<(String, Cow<'l, str>), MotionError> {
            Ok((format!("line {}", number + 1), Cow::Owned(line?)))
        }
        Ok(match &self.source {
            Source::Document { text, steps, frames } => {
                let field = if *frames { "frames" } else { "steps" };
                let texts = steps.iter().enumerate();
                Box::new(
                    texts.map(move |(i, range)| Ok((format!("{field}[{i}]"), Cow::Borrowed(&text[range.clone()])))),
                )
            }
            Source::Lines(path) => {
                let lines = BufReader::new(File::open(path)?).lines();
                Box::new(lines.enumerate().skip(1).map(line))
            }
            Source::LinesInMemory(text) => {
                let lines = text.lines().map(|line| Ok(line.to_string()));
                Box::new(lines.enumerate().skip(1).map(line))
            }
        })
    }

    fn parse(&self, text: &str, place: &str) -> Result<Content, MotionError> {
        let frames = match self.source {
            Source::Document { frames, .. } => Some(frames),
            _ => None,
        };
        let content = document::parse_step(text, frames, self.points.dimension(), self.meaning)
            .map_err(|error| error.within(place))?;
        self.points
            .check(&content, self.strategy)
            .map_err(|error| error.within(place))?;
        Ok(content)
    }
}

/// Texts of steps with their places.
type Texts<'m> = Box<dyn Iterator<Item = Result<(String, Cow<'m, str>), MotionError>> + 'm>;

/// What a step says.
#[derive(Debug)]
enum Content {
    /// The points that move.
    Moves(Vec<Move>),
    /// The coordinates of all own control points, one after another.
    Frame(Vec<Rational>),
}

/// One entry of a step.
#[derive(Debug)]
struct Move {
    point: u64,
    by: Vec<Rational>,
    /// 1 next to a joint, 2 a joint, 3 neither.
    kind: Option<u8>,
}

impl Content {
    fn numbers(&self) -> Box<dyn Iterator<Item = &Rational> + '_> {
        match self {
            Content::Moves(moves) => Box::new(moves.iter().flat_map(|entry| &entry.by)),
            Content::Frame(coordinates) => Box::new(coordinates.iter()),
        }
    }
}

/// The steps of a motion; see [`Motion::moves`].
pub struct Moves<'m> {
    motion: &'m Motion,
    texts: Texts<'m>,
    /// The frame before, as integers over the common denominator, if frames are given.
    before: Option<Vec<Integer>>,
    number: u64,
}

impl Iterator for Moves<'_> {
    type Item = Result<Step, MotionError>;

    fn next(&mut self) -> Option<Self::Item> {
        let step = self.texts.next()?.and_then(|(place, text)| {
            let content = self.motion.parse(&text, &place)?;
            self.step(content).ok_or_else(|| MotionError::changed(&place))
        });
        self.number += 1;
        if self.number > self.motion.steps {
            return Some(Err(MotionError::changed("")));
        }
        Some(step)
    }
}

impl Moves<'_> {
    /// The displacements of a step; `None` if a number is not over the common denominator, as when the file was changed between two readings.
    fn step(&mut self, content: Content) -> Option<Step> {
        let motion = self.motion;
        let over = |x: &Rational| {
            let product = x.numer() * &motion.denominator;
            (&product % x.denom()).is_zero().then(|| product.div_exact(x.denom()))
        };
        let dimension = motion.points.dimension();
        let vector = |coordinates: &[Integer]| -> [Integer; 3] {
            std::array::from_fn(|axis| coordinates.get(axis).cloned().unwrap_or_default())
        };
        let still = |by: &[Integer; 3]| by.iter().all(Integer::is_zero);
        match content {
            Content::Moves(moves) => {
                let mut step = Vec::with_capacity(moves.len());
                for entry in moves {
                    let by: Option<Vec<Integer>> = entry.by.iter().map(over).collect();
                    step.push((entry.point, vector(&by?)));
                }
                step.sort_unstable_by_key(|(point, _)| *point);
                let mut step = match motion.strategy {
                    Strategy::Free => step,
                    Strategy::C1 => motion.points.keep_c1(step),
                };
                step.retain(|(_, by)| !still(by));
                Some(step)
            }
            Content::Frame(coordinates) => {
                let here: Option<Vec<Integer>> = coordinates.iter().map(over).collect();
                let here = here?;
                let first = || motion.points.over(&motion.denominator);
                let before = self.before.take().unwrap_or_else(first);
                let differences: Vec<Integer> = here.iter().zip(&before).map(|(x, y)| x - y).collect();
                self.before = Some(here);
                let step = differences.chunks(dimension).enumerate();
                let step = step.map(|(point, by)| (point as u64, vector(by)));
                Some(step.filter(|(_, by)| !still(by)).collect())
            }
        }
    }
}
