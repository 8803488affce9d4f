//! Evidence about the thickness of a curve, from that about σ and that about the greatest curvature.

use std::borrow::Cow;
use std::io::{Read, Seek, SeekFrom, Write};

use tempfile::SpooledTempFile;

use super::domain::write_with_tree;
pub use super::domain::{CertifyError, Status};
use super::{curvature, msd};
use crate::certificate::{Document, Encoding};
use crate::claim::curvature as curvature_claim;
use crate::claim::msd::{Convention, Lower};
use crate::claim::thickness::{Content, Evidence, Statement};
use crate::curve::Curve;
use crate::number::{Integer, Rational};

/// What to certify, and how hard to try.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which chords σ is about.
    pub convention: Convention,
    /// (upper − lower)/upper of the thickness is to be at most this; above 0 and below 1.
    pub relative_width: Rational,
    /// How many leaves the tree may have; `None` for that of the claim `msd`.
    pub budget: Option<u64>,
    /// A name for the document.
    pub name: Option<String>,
    /// How many joints were moved together on reading.
    pub snapped_joints: Option<u64>,
}

/// What was found of a curve.
pub struct Certified<'c> {
    /// The document; `None` when nothing can be stated.
    pub document: Option<Document<'c, Content>>,
    /// Is what was asked for proved?
    pub status: Status,
    /// Leaves of its tree.
    pub leaves: u64,
    /// The parameters of the shortest double normal found, piece number and local parameter added.
    pub chord: Option<[Rational; 2]>,
    tree: SpooledTempFile,
}

/// Why nothing can be certified.
#[derive(Debug)]
pub enum RefusedCurve {
    /// A piece that is a single point.
    PointPiece(usize),
    /// An open curve in the convention `Smooth`.
    Open,
    /// A temporary file failed, or an error of this program.
    Failed(String),
}

impl std::fmt::Display for RefusedCurve {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            RefusedCurve::PointPiece(piece) => curvature::PointPiece(*piece).fmt(f),
            RefusedCurve::Open => f.write_str(
                "the curve is open and has no thickness; its reach is certified in the convention \"critical\"",
            ),
            RefusedCurve::Failed(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for RefusedCurve {}

impl Certified<'_> {
    /// Writes the certificate to `file`, reads it back and lets the checker replay it. Only `Ok` means that the file is a proof.
    ///
    /// # Errors
    /// [`CertifyError::Refuted`] when the checker does not accept the file, or there is no document.
    pub fn write_checked<F: Read + Write + Seek>(
        &mut self,
        encoding: Encoding,
        file: &mut F,
    ) -> Result<(), CertifyError> {
        let Some(document) = &self.document else {
            return Err(CertifyError::Refuted("nothing was found".into()));
        };
        self.tree.seek(SeekFrom::Start(0))?;
        write_with_tree(document, &mut self.tree, encoding, file)
    }
}

/// Finds bounds of the thickness. `progress` is called with the part of the present search that is done.
///
/// # Errors
/// A curve that has none.
pub fn certify<'c>(curve: &'c Curve, options: &Options, progress: &dyn Fn(f64)) -> Result<Certified<'c>, RefusedCurve> {
    if options.convention == Convention::Smooth && !curve.is_closed() {
        return Err(RefusedCurve::Open);
    }
    let about_curvature = curvature::Options {
        relative_width: options.relative_width.clone(),
        name: None,
        snapped_joints: None,
    };
    let bend = curvature::certify(curve, &about_curvature).map_err(|error| RefusedCurve::PointPiece(error.0))?;
    let zero = Rational::from_integer(Integer::ZERO);
    let mut found = Certified {
        document: None,
        status: bend.status,
        leaves: 0,
        chord: None,
        tree: SpooledTempFile::new(0),
    };
    let document = |statement, evidence| Document {
        tool: super::TOOL.into(),
        name: options.name.clone(),
        snapped_joints: options.snapped_joints,
        curve: Cow::Borrowed(curve),
        claim: Content { statement, evidence },
    };
    if let Some(joint) = bend.corners.first() {
        let statement = Statement {
            convention: options.convention,
            lower_squared: Lower::Finite(zero.clone()),
            upper_squared: Some(zero),
        };
        found.document = Some(document(statement, Evidence::Corner { joint: *joint }));
        found.status = Status::Certified;
        return Ok(found);
    }
    let Some(bend) = bend.document else {
        return Ok(found);
    };
    let distance = distances(curve, options, &bend.claim.statement, progress)?;
    let statement = statement(options, &distance.document.claim.statement, &bend.claim.statement);
    found.status = if close(&statement, &options.relative_width) {
        Status::Certified
    } else {
        match (found.status, distance.status) {
            (Status::Undecided(why), _) => Status::Undecided(why),
            (_, msd::Status::Undecided(why)) => Status::Undecided(why),
            _ => Status::Undecided("the bounds are not as near as asked".into()),
        }
    };
    found.leaves = distance.leaves;
    found.chord = distance.at;
    found.tree = distance.tree;
    found.document = Some(document(
        statement,
        Evidence::Bounds {
            msd: Box::new(distance.document.claim),
            curvature: Box::new(bend.claim),
        },
    ));
    Ok(found)
}

/// Bounds of σ: rough ones where they show that σ/2 is not the smaller number, else as asked.
fn distances<'c>(
    curve: &'c Curve,
    options: &Options,
    kappa: &curvature_claim::Statement,
    progress: &dyn Fn(f64),
) -> Result<msd::Certified<'c>, RefusedCurve> {
    let about = |relative_width| msd::Options {
        convention: options.convention,
        relative_width,
        budget: options.budget,
        name: None,
        snapped_joints: None,
    };
    let certify = |relative_width| {
        msd::certify(curve, &about(relative_width), progress).map_err(|error| match error {
            msd::CertifyError::PointPiece { piece } => RefusedCurve::PointPiece(piece),
            other => RefusedCurve::Failed(other.to_string()),
        })
    };
    let tenth = Rational::new(Integer::ONE, Integer::from(10));
    let rough = certify(tenth.clone().max(options.relative_width.clone()))?;
    let four = Rational::from_integer(Integer::from(4));
    let enough = match &rough.document.claim.statement.lower_squared {
        Lower::Infinite => true,
        Lower::Finite(lower) => lower * &kappa.lower_squared >= four,
    };
    if enough || tenth <= options.relative_width {
        return Ok(rough);
    }
    certify(options.relative_width.clone())
}

/// What follows from both.
fn statement(options: &Options, sigma: &crate::claim::msd::Statement, kappa: &curvature_claim::Statement) -> Statement {
    let four = Rational::from_integer(Integer::from(4));
    let radius = |squared: &Rational| (!squared.numer().is_zero()).then(|| squared.recip());
    let least_chord = match &sigma.lower_squared {
        Lower::Infinite => None,
        Lower::Finite(lower) => Some(lower / &four),
    };
    // Of the two numbers the smaller, where nothing stands for an infinite or unbounded one.
    let smaller = |a: Option<Rational>, b: Option<Rational>| match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    };
    let lower = smaller(least_chord, radius(&kappa.upper_squared));
    let most_chord = sigma.upper_squared.as_ref().map(|upper| upper / &four);
    Statement {
        convention: options.convention,
        lower_squared: lower.map_or(Lower::Infinite, Lower::Finite),
        upper_squared: smaller(most_chord, radius(&kappa.lower_squared)),
    }
}

fn close(statement: &Statement, relative_width: &Rational) -> bool {
    match (&statement.lower_squared, &statement.upper_squared) {
        (Lower::Infinite, _) => true,
        (Lower::Finite(lower), Some(upper)) => {
            let rest = Rational::from_integer(Integer::ONE) - relative_width;
            *lower >= upper * &rest * &rest
        }
        _ => false,
    }
}
