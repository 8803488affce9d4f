//! What `certify msd` prints.

use std::fmt::Write;
use std::path::PathBuf;

use knotproof::claim::msd::{Lower, Upper};
use knotproof::curve::{Chain, CurveFile, Form};
use knotproof::number::{Meaning, Rational, RationalExt, decimal_down, parse_number};
use knotproof::prove::msd::{Certified, Status};
use serde::Serialize;

use crate::cli::bounds::{Bounds, in_words, leaves_in_words, relative_width};
use crate::cli::input::Input;

/// Significant digits of parameters printed for people.
const PARAMETER_DIGITS: usize = 12;

/// A certificate that was written.
pub struct Written {
    /// Where.
    pub path: PathBuf,
    /// Its size.
    pub bytes: u64,
}

/// The last lines for people: joints that were moved, what became of the evidence if there is any, and the time.
pub fn last_lines(snapped: usize, has_evidence: bool, written: Option<&Written>, seconds: f64) -> String {
    let moved = (snapped > 0)
        .then(|| format!("  joints moved by --snap-joints: {snapped}; all this is about the curve so changed\n"));
    let evidence = match written {
        _ if !has_evidence => String::new(),
        Some(written) => format!(
            "  certificate: {}, {} bytes, accepted by the checker\n",
            written.path.display(),
            written.bytes
        ),
        None => "  the evidence was accepted by the checker and not kept; -o CERT writes it\n".into(),
    };
    format!("{}{evidence}  {seconds:.3} s\n", moved.unwrap_or_default())
}

/// All there is to tell of a run.
pub struct Report<'r> {
    /// Where the curve was read from.
    pub input: &'r Input,
    /// The curve.
    pub file: &'r CurveFile,
    /// What was proved.
    pub certified: &'r Certified<'r>,
    /// The relative width asked for, as it was written.
    pub width_asked: &'r str,
    /// How long the search, the check and the writing took.
    pub seconds: f64,
    /// The certificate's file.
    pub written: Option<Written>,
}

/// The object of `--json`.
#[derive(Serialize)]
pub struct ForPrograms {
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    claim: &'static str,
    convention: &'static str,
    #[serde(flatten)]
    bounds: Bounds,
    relative_width: Option<String>,
    relative_width_asked: String,
    at: Option<[String; 2]>,
    at_pieces: Option<[OnPiece; 2]>,
    upper_rule: Option<&'static str>,
    leaves: u64,
    seconds: f64,
    certificate: Option<String>,
    snapped_joints: usize,
}

#[derive(Serialize)]
struct OnPiece {
    piece: usize,
    local: String,
}

/// One end of the double normal.
struct End {
    knot: Rational,
    piece: usize,
    local: Rational,
}

impl Report<'_> {
    /// One object for programs.
    pub fn for_programs(&self) -> ForPrograms {
        let statement = &self.certified.document.claim.statement;
        let ends = self.ends();
        let (status, reason) = match &self.certified.status {
            Status::Certified => ("certified", None),
            Status::Undecided(reason) => ("undecided", Some(reason.clone())),
        };
        ForPrograms {
            status,
            reason,
            claim: "msd",
            convention: statement.convention.name(),
            bounds: Bounds::new(statement),
            relative_width: relative_width(statement),
            relative_width_asked: self.width_asked.into(),
            at: ends.as_ref().map(|ends| ends.each_ref().map(|end| end.knot.format())),
            at_pieces: ends.map(|ends| {
                ends.map(|end| OnPiece {
                    piece: end.piece,
                    local: end.local.format(),
                })
            }),
            upper_rule: self
                .certified
                .document
                .claim
                .evidence
                .upper
                .as_ref()
                .map(|rule| describe(rule).0),
            leaves: self.certified.leaves,
            seconds: self.seconds,
            certificate: self.written.as_ref().map(|written| written.path.display().to_string()),
            snapped_joints: self.file.snapped,
        }
    }

    /// Some lines for people.
    pub fn for_people(&self) -> String {
        // Writing into a string does not fail.
        let mut text = String::new();
        let _ = self.write_for_people(&mut text);
        text
    }

    fn write_for_people(&self, text: &mut String) -> std::fmt::Result {
        let Certified {
            status,
            document,
            leaves,
            ..
        } = self.certified;
        let statement = &document.claim.statement;
        let name = match &self.file.name {
            Some(name) => format!("{name:?}"),
            None => self.input.to_string(),
        };
        let convention = statement.convention.name();
        let subject = format!("minimum separation distance σ of {name} ({convention} convention)");
        match status {
            Status::Certified => writeln!(text, "certified: {subject}")?,
            Status::Undecided(reason) => {
                writeln!(text, "undecided: {subject}")?;
                writeln!(text, "  because {reason}")?;
            }
        }
        let so_far = if matches!(status, Status::Certified) {
            ""
        } else {
            "proved so far: "
        };
        match relative_width(statement) {
            Some(width) => writeln!(text, "  {so_far}{}, relative width {width}", in_words(statement))?,
            None => writeln!(text, "  {so_far}{}", in_words(statement))?,
        }
        if let Some(ends) = self.ends() {
            self.write_ends(&ends, text)?;
        }
        if let Some(rule) = &document.claim.evidence.upper {
            let (rule, what) = describe(rule);
            writeln!(text, "  upper bound: {what} (rule {rule})")?;
        }
        let empty = matches!(&statement.lower_squared, Lower::Finite(lower) if lower.numer().is_zero());
        if !empty {
            writeln!(text, "  lower bound: a cover tree with {}", leaves_in_words(*leaves))?;
        }
        let has_evidence = !empty || statement.upper_squared.is_some();
        text.push_str(&last_lines(
            self.file.snapped,
            has_evidence,
            self.written.as_ref(),
            self.seconds,
        ));
        Ok(())
    }

    fn write_ends(&self, ends: &[End; 2], text: &mut String) -> std::fmt::Result {
        let parameters = match self.file.curve.form() {
            Form::BSpline(_) => "knot values",
            Form::Bezier(_) => "parameters",
        };
        let [s, t] = ends.each_ref().map(|end| parameter(&end.knot));
        let [on_s, on_t] = ends
            .each_ref()
            .map(|end| format!("piece {} at {}", end.piece, parameter(&end.local)));
        writeln!(
            text,
            "  where: {parameters} {s} and {t} ({on_s}, {on_t}, pieces counted from 0)"
        )
    }

    /// Both ends of the double normal, if one was found.
    fn ends(&self) -> Option<[End; 2]> {
        let [s, t] = self.certified.at.as_ref()?;
        let chain = self.file.curve.chain();
        Some([end(&chain, s)?, end(&chain, t)?])
    }
}

/// The end at a global parameter; on a closed curve parameters count modulo the number of pieces.
fn end(chain: &Chain, parameter: &Rational) -> Option<End> {
    let count = Rational::from_integer(chain.count().into());
    let parameter = if chain.closed() && *parameter >= count {
        parameter - count
    } else {
        parameter.clone()
    };
    let (piece, local) = chain.locate(&parameter)?;
    Some(End {
        knot: chain.knot_at(&parameter)?,
        piece,
        local,
    })
}

/// A parameter for people, to the nearest decimal.
pub fn parameter(x: &Rational) -> String {
    let nearest = format!("{:.*e}", PARAMETER_DIGITS - 1, x.to_f64());
    // Beyond binary64 there is no nearest one.
    let nearest = parse_number(&nearest, Meaning::Decimal);
    decimal_down(nearest.as_ref().unwrap_or(x), PARAMETER_DIGITS)
}

/// A rule's name, and what it proves.
fn describe(rule: &Upper) -> (&'static str, &'static str) {
    match rule {
        Upper::Miranda { .. } => (
            "miranda",
            "a double normal, enclosed by signs around a box of parameters",
        ),
        Upper::Root { .. } => ("root", "an exact double normal"),
        Upper::Touch { .. } => ("touch", "the curve passes twice through a point, at exact parameters"),
        Upper::Crossing { .. } => ("crossing", "the curve crosses itself inside a box of parameters"),
        Upper::CriticalRoot { .. } => ("critical_root", "an exact critical chord"),
        Upper::CriticalInterval { .. } => (
            "critical_interval",
            "a critical chord from a corner or an end, enclosed by signs around an interval",
        ),
    }
}
