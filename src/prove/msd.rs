//! Certifying the minimum separation distance: bounds from above, then a tree from below, then the certificate.

use std::borrow::Cow;
use std::io::{self, Read, Seek, SeekFrom, Write};

use tempfile::SpooledTempFile;

use super::cover::{Aim, Event, Goal, Stuck};
use super::evidence::{IN_MEMORY, write_checked};
use super::float_chain::FloatChain;
use super::newton::Candidate;
use super::node::run_cones;
use super::seeds;
use super::tree::{Curve as SearchCurve, Failure, search};
use super::upper::{Bounds, UpperBound, few_bits_between, raw_product};
use crate::certificate::{Document, Encoding, write};
use crate::check::chain::Chain;
use crate::check::cover::Context;
use crate::claim::msd::{Content, Convention, Evidence, Lower, Statement};
use crate::curve::Curve;
use crate::number::{Integer, Rational, RationalExt};

/// What to certify, and how hard to try.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which chords count at corners and ends.
    pub convention: Convention,
    /// How far apart the bounds of σ may be, relative to the upper one; above 0 and below 1.
    pub relative_width: Rational,
    /// How many leaves the tree may have; `None` for 500,000 and 64 for each piece.
    pub budget: Option<u64>,
    /// A name to put into the certificate.
    pub name: Option<String>,
    /// How many joints the reader moved together.
    pub snapped_joints: Option<u64>,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            convention: Convention::Smooth,
            relative_width: Rational::new(1.into(), Integer::from(10).pow(12)),
            budget: None,
            name: None,
            snapped_joints: None,
        }
    }
}

/// How far the proof went.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// The bounds are as near as asked, or there is certainly no double normal, or σ is certainly 0.
    Certified,
    /// They are not; with the reason in words.
    Undecided(String),
}

/// A certificate and what it says.
pub struct Certified<'c> {
    /// How far the proof went.
    pub status: Status,
    /// The document; what it states is proved whatever the status.
    pub document: Document<'c, Content>,
    /// Leaves of its tree.
    pub leaves: u64,
    /// The parameters of the shortest double normal found, piece number and local parameter added.
    pub at: Option<[Rational; 2]>,
    pub(super) tree: SpooledTempFile,
}

/// Why no certificate was written.
#[derive(Debug)]
pub enum CertifyError {
    /// Writing failed.
    Io(io::Error),
    /// A piece of the curve is a single point and has no tangent; nothing can be certified.
    PointPiece {
        /// Its number.
        piece: usize,
    },
    /// The checker did not accept what the search found; nothing was written. This is an error of this program.
    Refuted(String),
}

impl std::fmt::Display for CertifyError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            CertifyError::Io(error) => write!(f, "writing failed: {error}"),
            CertifyError::PointPiece { piece } => {
                write!(
                    f,
                    "piece {piece} is a single point and has no tangent; leave it out of the curve"
                )
            }
            CertifyError::Refuted(why) => {
                write!(f, "the checker refuses the evidence found, nothing was written ({why})")
            }
        }
    }
}

impl std::error::Error for CertifyError {}

impl From<io::Error> for CertifyError {
    fn from(error: io::Error) -> Self {
        CertifyError::Io(error)
    }
}

impl Certified<'_> {
    /// Writes the certificate.
    ///
    /// # Errors
    /// Those of `out` and of the temporary file that holds a large tree.
    pub fn write(&mut self, encoding: Encoding, out: &mut impl Write) -> io::Result<()> {
        self.tree.seek(SeekFrom::Start(0))?;
        write(&self.document, &mut self.tree, encoding, out)
    }

    /// Writes the certificate to `file`, reads it back and lets the checker replay it. Only `Ok` means that the file is a proof.
    ///
    /// # Errors
    /// [`CertifyError::Refuted`] when the checker does not accept the file, which must then be thrown away.
    pub fn write_checked<F: Read + Write + Seek>(
        &mut self,
        encoding: Encoding,
        file: &mut F,
    ) -> Result<(), CertifyError> {
        let statement = &self.document.claim.statement;
        write_checked(&self.document, &mut self.tree, encoding, file, |claim| {
            claim.msd().is_some_and(|content| content.statement == *statement)
        })
    }
}

/// Certifies the minimum separation distance of a curve. `progress` is called with the part of the present search that is done.
///
/// # Errors
/// [`CertifyError::PointPiece`], and those of the temporary file that holds a large tree.
pub fn certify<'c>(curve: &'c Curve, options: &Options, progress: &dyn Fn(f64)) -> Result<Certified<'c>, CertifyError> {
    let document = Document {
        tool: super::TOOL.into(),
        name: options.name.clone(),
        snapped_joints: options.snapped_joints,
        curve: Cow::Borrowed(curve),
        claim: Content {
            statement: Statement {
                convention: options.convention,
                lower_squared: Lower::Finite(Rational::from_integer(0.into())),
                upper_squared: None,
            },
            evidence: Evidence { grid: 0, upper: None },
            has_tree: false,
        },
    };
    let nothing = |status| Certified {
        status,
        document: document.clone(),
        leaves: 0,
        at: None,
        tree: SpooledTempFile::new(IN_MEMORY),
    };
    let chain = match Chain::new(curve) {
        Ok(chain) => chain,
        Err(piece) => {
            return Err(CertifyError::PointPiece { piece });
        }
    };
    let floats = FloatChain::new(&chain);
    let grid = grid(&floats);
    let context = Context::new(&chain, options.convention, grid);
    let run_cones = run_cones(&context, &floats);
    let bounds = Bounds {
        chain: &chain,
        floats: &floats,
        convention: options.convention,
    };
    let search_curve = SearchCurve {
        context: &context,
        floats: &floats,
        run_cones: &run_cones,
    };
    let mut work = Work {
        options,
        curve: search_curve,
        bounds,
        progress,
        upper: None,
        knots: &|parameter| curve.chain().knot_at(parameter),
    };
    let found = work.run()?;
    let mut certified = nothing(found.status);
    certified.document.claim.statement.lower_squared = found.lower;
    certified.document.claim.evidence.grid = grid;
    if let Some(upper) = found.upper {
        certified.document.claim.statement.upper_squared = Some(upper.squared);
        certified.document.claim.evidence.upper = Some(upper.rule);
        certified.at = Some(upper.at);
    }
    if let Some((tree, leaves)) = found.tree {
        certified.tree = tree;
        certified.leaves = leaves;
        certified.document.claim.has_tree = true;
    }
    Ok(certified)
}

/// The statement that σ is 0 in the convention `smooth`: the curve meets itself.
pub(super) fn meets_itself<'c>(
    curve: &'c Curve,
    name: Option<String>,
    snapped: Option<u64>,
    upper: UpperBound,
) -> Certified<'c> {
    Certified {
        status: Status::Certified,
        document: Document {
            tool: super::TOOL.into(),
            name,
            snapped_joints: snapped,
            curve: Cow::Borrowed(curve),
            claim: Content {
                statement: Statement {
                    convention: Convention::Smooth,
                    lower_squared: zero_lower(),
                    upper_squared: Some(upper.squared),
                },
                evidence: Evidence {
                    grid: 0,
                    upper: Some(upper.rule),
                },
                has_tree: false,
            },
        },
        leaves: 0,
        at: Some(upper.at),
        tree: SpooledTempFile::new(IN_MEMORY),
    }
}

/// A grid on which boxes of runs are rounded by a small part of a piece's size, without needless bits.
pub(super) fn grid(floats: &FloatChain) -> u32 {
    let mut size = 0.0;
    let mut reach = 0.0f64;
    for piece in 0..floats.pieces.len() {
        let points = floats.points(piece);
        let (p, q) = (points[0], points[points.len() - 1]);
        let weight = p[3].min(q[3]);
        size += (0..3)
            .map(|i| (p[i] / p[3] - q[i] / q[3]).abs())
            .fold(floats.pieces[piece].greatest_tangent / weight.max(1.0), f64::max);
        reach = reach.max(floats.pieces[piece].greatest_point / weight);
    }
    let mean = size / floats.pieces.len() as f64;
    let fine = (200.0 / mean).log2().ceil();
    let room = (2f64.powi(40) / reach).log2().floor();
    let exponent = fine.min(room);
    if exponent.is_nan() {
        0
    } else {
        exponent.clamp(0.0, 4000.0) as u32
    }
}

/// What a search has found.
struct Found {
    status: Status,
    lower: Lower,
    upper: Option<UpperBound>,
    tree: Option<(SpooledTempFile, u64)>,
}

struct Work<'w> {
    options: &'w Options,
    curve: SearchCurve<'w>,
    bounds: Bounds<'w>,
    progress: &'w dyn Fn(f64),
    upper: Option<UpperBound>,
    /// The curve's own knots, for messages.
    knots: &'w dyn Fn(&Rational) -> Option<Rational>,
}

/// What one attempt at a lower bound came to.
enum Attempt {
    Proved(SpooledTempFile, u64),
    Event(Event),
}

impl Work<'_> {
    fn budget(&self) -> u64 {
        let pieces = self.curve.context.chain.count() as u64;
        self.options.budget.unwrap_or(500_000 + 64 * pieces)
    }

    fn run(&mut self) -> Result<Found, CertifyError> {
        let steps = 10_000 + 400 * self.curve.context.elements.count() as u64;
        let seeds::Found { candidates, suspicious } = seeds::find(
            &mut self.curve.nodes(),
            steps.min(self.budget().saturating_mul(40).max(10_000)),
        );
        if suspicious {
            // A point that is not regular makes every positive bound impossible; it is found faster alone.
            let goal = Goal {
                diagonal: true,
                ..self.goal(&Lower::Infinite, &self.options.relative_width)
            };
            if let Err(Failure::Event(Event::Stuck(stuck))) = search(&self.curve, &goal, &mut io::sink(), &|_| ()) {
                // Where a curve turns back it often meets itself.
                let goal = Goal {
                    aim: Aim::CommonPoints,
                    lower: zero_lower(),
                    length: 0.0,
                    slack: f64::INFINITY,
                    max_depth: 60,
                    diagonal: false,
                    ..goal
                };
                if let Err(Failure::Event(Event::Stuck(meeting))) = search(&self.curve, &goal, &mut io::sink(), &|_| ())
                    && !meeting.adjacent
                    && let Some(upper) = self.bounds.crossing(meeting.s, meeting.t)
                {
                    self.upper = Some(upper);
                    return Ok(self.found(Status::Certified, zero_lower(), None));
                }
                let why = self.describe(&stuck);
                return Ok(self.found(Status::Undecided(why), zero_lower(), None));
            }
        }
        // A candidate that cannot be proved may be none, so the bound tried first is the one below the shortest that can.
        let mut unproved: Option<f64> = None;
        for candidate in &candidates {
            if let Some(upper) = self.bounds.prove(candidate, &self.options.relative_width) {
                self.upper = Some(upper);
                break;
            }
            unproved = unproved.or(Some(candidate.squared));
        }
        // Is the bound tried the one below what is unproved?
        let mut resigned = false;
        for _ in 0..64 {
            let zero = self.upper.as_ref().is_some_and(|upper| upper.squared.numer().is_zero());
            if zero {
                return Ok(self.found(Status::Certified, zero_lower(), None));
            }
            let lower = match (&self.upper, unproved) {
                (_, Some(squared)) if resigned => match Rational::from_f64(squared) {
                    Some(squared) => Lower::Finite(below(&squared, &self.options.relative_width)),
                    None => zero_lower(),
                },
                (Some(upper), _) => Lower::Finite(below(&upper.squared, &self.options.relative_width)),
                (None, _) => Lower::Infinite,
            };
            let why = match self.attempt(&lower, &self.options.relative_width)? {
                Attempt::Proved(tree, leaves) => {
                    let status = if resigned {
                        Status::Undecided("no double normal could be proved to exist".into())
                    } else {
                        Status::Certified
                    };
                    return Ok(self.found(status, lower, Some((tree, leaves))));
                }
                Attempt::Event(Event::Shorter(candidate)) => {
                    if self.improve(&candidate) {
                        resigned = false;
                        unproved = None;
                        continue;
                    }
                    if unproved.is_none_or(|known| candidate.squared < known * (1.0 - 1e-15)) {
                        unproved = Some(candidate.squared);
                        resigned = true;
                        continue;
                    }
                    "a shorter double normal may exist that could not be isolated".into()
                }
                Attempt::Event(Event::Stuck(stuck)) => {
                    if self.improve_at(&stuck) {
                        resigned = false;
                        unproved = None;
                        continue;
                    }
                    self.describe(&stuck)
                }
                Attempt::Event(Event::Budget) => format!("the budget of {} leaves ran out", self.budget()),
            };
            if resigned || unproved.is_none() {
                return self.ladder(&why);
            }
            resigned = true;
        }
        self.ladder("the search found ever shorter double normals")
    }

    /// Takes a candidate for the upper bound if it can be proved and is shorter than what is.
    fn improve(&mut self, candidate: &Candidate) -> bool {
        let found = self.bounds.prove(candidate, &self.options.relative_width);
        self.take_shorter(found)
    }

    /// Looks for a double normal or a double point near a pair that nothing separates.
    fn improve_at(&mut self, stuck: &Stuck) -> bool {
        if stuck.adjacent {
            return false;
        }
        let candidate = Candidate {
            s: stuck.s,
            t: stuck.t,
            squared: stuck.distance * stuck.distance,
        };
        let found = self.bounds.crossing(stuck.s, stuck.t);
        self.take_shorter(found) || self.improve(&candidate)
    }

    fn take_shorter(&mut self, found: Option<UpperBound>) -> bool {
        match found {
            Some(found) if self.upper.as_ref().is_none_or(|known| found.squared < known.squared) => {
                self.upper = Some(found);
                true
            }
            _ => false,
        }
    }

    fn found(&mut self, status: Status, lower: Lower, tree: Option<(SpooledTempFile, u64)>) -> Found {
        Found {
            status,
            lower,
            upper: self.upper.take(),
            tree,
        }
    }

    fn goal(&self, lower: &Lower, relative_width: &Rational) -> Goal {
        let length = match lower {
            Lower::Infinite => f64::INFINITY,
            Lower::Finite(squared) => squared.to_f64().sqrt() * (1.0 + 4.0 * f64::EPSILON),
        };
        let halvings = 30.0 - 0.75 * self.options.relative_width.to_f64().log2();
        Goal {
            aim: Aim::DoubleNormals,
            lower: lower.clone(),
            length,
            max_depth: halvings.clamp(40.0, 118.0) as u32,
            budget: self.budget(),
            diagonal: false,
            slack: length * relative_width.to_f64(),
        }
    }

    fn attempt(&self, lower: &Lower, relative_width: &Rational) -> Result<Attempt, CertifyError> {
        let goal = self.goal(lower, relative_width);
        let mut tree = SpooledTempFile::new(IN_MEMORY);
        match search(&self.curve, &goal, &mut tree, self.progress) {
            Ok(leaves) => Ok(Attempt::Proved(tree, leaves)),
            Err(Failure::Event(event)) => Ok(Attempt::Event(event)),
            Err(Failure::Io(error)) => Err(error.into()),
        }
    }

    fn describe(&self, stuck: &Stuck) -> String {
        let at = |(piece, u): (usize, f64)| {
            let parameter = Rational::from_f64(u).map(|u| Rational::from_integer(piece.into()) + u);
            let knot = parameter
                .and_then(|parameter| (self.knots)(&parameter))
                .map_or(f64::NAN, |knot| knot.to_f64());
            format!("parameter {knot:.12} (piece {piece} at {u:.12})")
        };
        if stuck.adjacent {
            format!(
                "the derivative vanishes or the curve turns back at about {}",
                at(stuck.s)
            )
        } else {
            let apart = stuck.distance;
            format!(
                "the points at about {} and {}, {apart:.3e} apart, could not be told from a double normal or a double point",
                at(stuck.s),
                at(stuck.t)
            )
        }
    }

    /// Lower bounds in growing order, as far as they can be proved.
    fn ladder(&mut self, why: &str) -> Result<Found, CertifyError> {
        let status = Status::Undecided(why.into());
        let best = self.upper.as_ref().map(|upper| upper.squared.clone());
        let reach: f64 = {
            let nodes = &mut self.curve.nodes();
            let whole = nodes.whole();
            whole.diagonal_squared()
        };
        let Some(start) = best.or_else(|| Rational::from_f64(reach)) else {
            return Ok(self.found(status, zero_lower(), None));
        };
        let mut proved: Option<(Lower, SpooledTempFile, u64)> = None;
        // Small fractions of the upper bound's square, and then relative widths of 10^-k.
        let one = Rational::from_integer(1.into());
        let coarse =
            [40u32, 30, 20, 14, 10, 7, 5, 3, 2, 1].map(|bits| &one - Rational::new(1.into(), Integer::from(1) << bits));
        let fine = (1..=30u32).map(|k| Rational::new(1.into(), Integer::from(10).pow(k)));
        for width in coarse.into_iter().chain(fine) {
            if width <= self.options.relative_width {
                break;
            }
            let lower = Lower::Finite(below(&start, &width));
            match self.attempt(&lower, &width)? {
                Attempt::Proved(tree, leaves) => {
                    // Where the number of leaves grows steadily, the next step's is foreseeable.
                    let before = proved.as_ref().map_or(leaves, |(_, _, leaves)| *leaves);
                    proved = Some((lower, tree, leaves));
                    if leaves > 2 * before && leaves.saturating_mul(leaves / before.max(1)) > self.budget() {
                        break;
                    }
                }
                Attempt::Event(_) => break,
            }
        }
        Ok(match proved {
            Some((lower, tree, leaves)) => self.found(status, lower, Some((tree, leaves))),
            None => self.found(status, zero_lower(), None),
        })
    }
}

fn zero_lower() -> Lower {
    Lower::Finite(Rational::from_integer(0.into()))
}

/// A fraction of few bits between (1−w)²x and (1−w+(1−w)w/20)²x.
fn below(squared: &Rational, relative_width: &Rational) -> Rational {
    let one = Rational::from_integer(1.into());
    let factor = &one - relative_width;
    let nearer = &factor + &factor * relative_width / Rational::from_integer(20.into());
    let (low, high) = (
        raw_product(&[squared, &factor, &factor]),
        raw_product(&[squared, &nearer, &nearer]),
    );
    few_bits_between(&low, &high, 0.1 * relative_width.to_f64())
}
