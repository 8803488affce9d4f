//! Certifying that a curve is embedded, or that it meets itself.

use std::borrow::Cow;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};

use tempfile::SpooledTempFile;

use super::cover::{Aim, Event, Goal, Stuck};
use super::evidence::{IN_MEMORY, write_checked};
use super::float_chain::FloatChain;
use super::msd::{self, CertifyError, grid};
use super::node::run_cones;
use super::tree::{Curve as SearchCurve, Failure, search};
use super::upper::Bounds;
use crate::certificate::{Document, Encoding, write};
use crate::check::chain::Chain;
use crate::check::cover::Context;
use crate::check::embedding::{Measured, measure};
use crate::claim::embedding::{Content, Evidence, Radius, Statement};
use crate::claim::msd::{Convention, Lower};
use crate::claim::tree::{BinaryTokens, ByteRead};
use crate::curve::Curve;
use crate::number::{Integer, Rational, RationalExt, sqrt_enclosure};

/// How hard to try.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// How many leaves the tree may have; `None` for 500,000 and 64 for each piece.
    pub budget: Option<u64>,
    /// A name to put into the certificate.
    pub name: Option<String>,
    /// How many joints the reader moved together.
    pub snapped_joints: Option<u64>,
}

/// A certificate that a curve is embedded.
pub struct Certified<'c> {
    /// The document.
    pub document: Document<'c, Content>,
    /// Leaves of its tree.
    pub leaves: u64,
    /// Edges of the control polygon of the cells, which is ambient isotopic to the curve too (docs/embedding.md, Theorem 4); `None` where the tree does
    /// not show it, which happens with rational pieces only.
    pub control_polygon_edges: Option<u64>,
    tree: SpooledTempFile,
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
            claim.embedding().is_some_and(|content| content.statement == *statement)
        })
    }
}

/// What became of a search.
pub enum Outcome<'c> {
    /// The curve is embedded.
    Embedded(Box<Certified<'c>>),
    /// The curve meets itself: a certificate of the claim `msd` that σ is 0.
    MeetsItself(Box<msd::Certified<'c>>),
    /// Neither was proved, for this reason.
    Undecided(String),
}

/// How often a piece is halved at most: parts of 2^-60 that are not told apart are taken for a double point.
const MAX_DEPTH: u32 = 60;

/// Proves that a curve is embedded or that it meets itself. `progress` is called with the part of the search that is done.
///
/// # Errors
/// [`CertifyError::PointPiece`], and those of the temporary file that holds a large tree.
pub fn certify<'c>(curve: &'c Curve, options: &Options, progress: &dyn Fn(f64)) -> Result<Outcome<'c>, CertifyError> {
    let chain = Chain::new(curve).map_err(|piece| CertifyError::PointPiece { piece })?;
    let floats = FloatChain::new(&chain);
    let grid = grid(&floats);
    let context = Context::new(&chain, Convention::Smooth, grid);
    let run_cones = run_cones(&context, &floats);
    let search_curve = SearchCurve {
        context: &context,
        floats: &floats,
        run_cones: &run_cones,
    };
    let budget = options.budget.unwrap_or(500_000 + 64 * chain.count() as u64);
    let goal = Goal {
        aim: Aim::CommonPoints,
        lower: Lower::Finite(Rational::default()),
        length: 0.0,
        slack: f64::INFINITY,
        max_depth: MAX_DEPTH,
        budget,
        diagonal: false,
    };
    let mut tree = SpooledTempFile::new(IN_MEMORY);
    match search(&search_curve, &goal, &mut tree, progress) {
        Ok(_) => {}
        Err(Failure::Io(error)) => return Err(error.into()),
        Err(Failure::Event(Event::Stuck(stuck))) => {
            let bounds = Bounds {
                chain: &chain,
                floats: &floats,
                convention: Convention::Smooth,
            };
            let found = if stuck.adjacent {
                None
            } else {
                bounds.crossing(stuck.s, stuck.t)
            };
            return Ok(match found {
                Some(upper) => {
                    let (name, snapped) = (options.name.clone(), options.snapped_joints);
                    Outcome::MeetsItself(Box::new(msd::meets_itself(curve, name, snapped, upper)))
                }
                None => Outcome::Undecided(describe(curve, &stuck)),
            });
        }
        Err(Failure::Event(_)) => {
            return Ok(Outcome::Undecided(format!("the budget of {budget} leaves ran out")));
        }
    }
    tree.seek(SeekFrom::Start(0))?;
    let mut tokens = BinaryTokens::new(Unread(BufReader::new(&mut tree)), curve.dimension());
    let measured = measure(curve, &chain, grid, &mut tokens).map_err(|why| CertifyError::Refuted(why.to_string()))?;
    let document = Document {
        tool: super::TOOL.into(),
        name: options.name.clone(),
        snapped_joints: options.snapped_joints,
        curve: Cow::Borrowed(curve),
        claim: Content {
            statement: Statement {
                edges: measured.edges,
                perturbation_radius: radius(&measured),
            },
            evidence: Evidence { grid },
        },
    };
    Ok(Outcome::Embedded(Box::new(Certified {
        document,
        leaves: measured.leaves,
        control_polygon_edges: measured.control_polygon_edges,
        tree,
    })))
}

/// A reader of whose bytes none are offered ahead.
struct Unread<R>(R);

impl<R: Read> Read for Unread<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer)
    }
}

impl<R: Read> ByteRead for Unread<R> {
    fn ahead(&self) -> &[u8] {
        &[]
    }
    fn skip(&mut self, _: usize) {}
}

/// The radii measured, rounded down to few bits.
fn radius(measured: &Measured) -> Radius {
    let euclidean = sqrt_enclosure(&measured.euclidean_squared, 64).0;
    Radius {
        infinity: rounded_down(&measured.infinity),
        euclidean: rounded_down(&euclidean),
    }
}

/// A fraction of at most 40 bits over a power of two that is at most x, and near it.
fn rounded_down(x: &Rational) -> Rational {
    if x.numer().is_zero() {
        return Rational::default();
    }
    let shift = 40 + x.denom().bits() as i64 - x.numer().bits() as i64;
    let (up, down) = (shift.max(0) as u32, (-shift).max(0) as u32);
    let mantissa = (x.numer() << up).div_floor(&(x.denom() << down));
    Rational::new(mantissa << down, Integer::ONE << up)
}

/// Where the search came to an end, in words.
fn describe(curve: &Curve, stuck: &Stuck) -> String {
    let at = |(piece, u): (usize, f64)| {
        let parameter = Rational::from_f64(u).map(|u| Rational::from_integer(piece.into()) + u);
        let knot = parameter
            .and_then(|parameter| curve.chain().knot_at(&parameter))
            .map_or(f64::NAN, |knot| knot.to_f64());
        format!("parameter {knot:.12} (piece {piece} at {u:.12})")
    };
    // Next to a corner of 180° the parts on both sides that are not neighbours are the first to be stuck.
    let count = curve.chain().count() as f64;
    let between = (stuck.t.0 as f64 + stuck.t.1) - (stuck.s.0 as f64 + stuck.s.1);
    let between = between.abs();
    let around = curve.is_closed() && count - between < 1e-6;
    if stuck.adjacent || between < 1e-6 || around {
        let place = at(stuck.s);
        format!("the derivative vanishes or the curve turns back at about {place}")
    } else {
        let (s, t, apart) = (at(stuck.s), at(stuck.t), stuck.distance);
        format!("the points at about {s} and {t}, {apart:.3e} apart, could not be told from a double point")
    }
}
