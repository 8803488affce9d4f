//! From the texts of the JSON form to a document.

use std::borrow::Cow;

use serde::Deserialize;

use super::super::block::{self, hexadecimal};
use super::super::{Document, FormatError};
use super::motion_events::TextEvent;
use super::numbers::{Parsed, numbers, points, shortened};
use super::raw::{InBlock, Object, RawClaim, RawCurve, RawDocument, Text};
use super::{curvature, deviation, domain, embedding, motion, msd, thickness, values};
use crate::claim::Claim;
use crate::curve::{BSpline, Bezier, Curve, Form, MAXIMUM_PIECES};

fn curve(raw: RawCurve) -> Parsed<Curve> {
    let refuse = |place: &str, error: crate::curve::CurveError| FormatError::malformed(place, error.to_string());
    let dimension_of = |points: &[Vec<Text>]| points.first().map_or(0, Vec::len);
    match (raw.bspline, raw.bezier) {
        (Some(Object(spline)), None) => {
            let place = "curve.bspline";
            let dimension = dimension_of(&spline.points);
            let data = BSpline::new(
                dimension,
                spline.degree,
                numbers(spline.knots.iter(), "curve.bspline.knots")?,
                points(&spline.points, dimension, "curve.bspline.points")?,
                spline
                    .weights
                    .map(|weights| numbers(weights.iter(), "curve.bspline.weights"))
                    .transpose()?,
            );
            let data = data.map_err(|error| refuse(place, error))?;
            Curve::new(dimension, Form::BSpline(data)).map_err(|error| refuse(place, error))
        }
        (None, Some(Object(chain))) => {
            if chain.pieces.len() > MAXIMUM_PIECES {
                return Err(FormatError::malformed("curve.bezier.pieces", "too many pieces"));
            }
            let dimension = chain.pieces.first().map_or(0, |piece| dimension_of(&piece.0.points));
            let mut pieces = Vec::with_capacity(chain.pieces.len());
            for (i, Object(piece)) in chain.pieces.iter().enumerate() {
                let place = format!("curve.bezier.pieces[{i}]");
                let coordinates = points(&piece.points, dimension, &place)?;
                let weights = piece
                    .weights
                    .as_ref()
                    .map(|weights| numbers(weights.iter(), &place))
                    .transpose()?;
                pieces.push(Bezier::new(dimension, coordinates, weights).map_err(|error| refuse(&place, error))?);
            }
            Curve::new(dimension, Form::Bezier(pieces)).map_err(|error| refuse("curve.bezier", error))
        }
        _ => Err(FormatError::malformed("curve", "expected either bspline or bezier")),
    }
}

/// Reads a curve whose own place is `place`.
pub fn curve_at(raw: RawCurve, place: &str) -> Parsed<Curve> {
    curve(raw).map_err(|error| match error {
        FormatError::Malformed { place: within, what } => {
            FormatError::malformed(format!("{place}{}", within.trim_start_matches("curve")), what)
        }
        other => other,
    })
}

/// What a claim streams, as far as it is in the JSON form.
pub enum Texts {
    /// The tokens of a tree.
    Tokens(Vec<String>),
    /// The events of a motion.
    Events(Vec<TextEvent>),
}

/// Everything of a document but the curve.
pub struct Header<'a> {
    tool: String,
    name: Option<String>,
    snapped_joints: Option<u64>,
    stated_hash: String,
    claim: String,
    statement: &'a str,
    evidence: &'a str,
    /// Is this the header of the binary form?
    block: bool,
}

impl Header<'_> {
    /// The document about `curve`, whose block has the hash `actual`, and the texts of its tree's tokens or of its events.
    pub fn into_document(self, curve: Curve, actual: &[u8; 32]) -> Parsed<(Document<'static>, Texts)> {
        let actual = hexadecimal(actual);
        if self.stated_hash != actual {
            return Err(FormatError::Hash {
                stated: shortened(&self.stated_hash),
                actual,
            });
        }
        let dimension = curve.dimension();
        let mut motion_events = None;
        let (claim, tokens) = match self.claim.as_str() {
            "msd" => {
                let (content, tokens) = msd::read(self.statement, self.evidence, self.block, dimension)?;
                (Claim::Msd(content), tokens)
            }
            "domain" => {
                let content = domain::read(self.statement, self.evidence, dimension)?;
                (Claim::Domain(content), Vec::new())
            }
            "deviation" => {
                let content = deviation::read(self.statement, self.evidence)?;
                (Claim::Deviation(content), Vec::new())
            }
            "curvature" => {
                let content = curvature::read(self.statement, self.evidence)?;
                (Claim::Curvature(content), Vec::new())
            }
            "thickness" => {
                let (content, tokens) = thickness::read(self.statement, self.evidence, self.block, dimension)?;
                (Claim::Thickness(content), tokens)
            }
            "values" => {
                let content = values::read(self.statement, self.evidence, dimension)?;
                (Claim::Values(content), Vec::new())
            }
            "embedding" => {
                let (content, tokens) = embedding::read(self.statement, self.evidence, self.block)?;
                (Claim::Embedding(content), tokens)
            }
            "motion" => {
                let (content, events) = motion::read(self.statement, self.evidence, self.block, dimension)?;
                motion_events = Some(events);
                (Claim::Motion(Box::new(content)), Vec::new())
            }
            other => {
                let what = format!(
                    "found {:?}, expected \"msd\", \"domain\", \"embedding\", \"curvature\", \"thickness\", \"deviation\", \"motion\" or \"values\"",
                    shortened(other)
                );
                return Err(FormatError::malformed("statement.claim", what));
            }
        };
        let document = Document {
            tool: self.tool,
            name: self.name,
            snapped_joints: self.snapped_joints,
            curve: Cow::Owned(curve),
            claim,
        };
        let texts = motion_events.map_or(Texts::Tokens(tokens), Texts::Events);
        Ok((document, texts))
    }
}

fn header_of<C>(raw: RawDocument<'_, C>, block: bool) -> Parsed<(Header<'_>, C)> {
    if raw.knotproof.0 != "certificate/1" {
        let what = format!("found {:?}, expected \"certificate/1\"", shortened(&raw.knotproof.0));
        return Err(FormatError::malformed("knotproof", what));
    }
    let text = |text: Text| text.0.into_owned();
    let Object(claim): Object<RawClaim> = parse_within(raw.statement.get(), "statement")?;
    let header = Header {
        tool: text(raw.tool),
        name: raw.name.map(text),
        snapped_joints: raw.snapped_joints,
        stated_hash: text(raw.curve_sha256),
        claim: text(claim.claim),
        statement: raw.statement.get(),
        evidence: raw.evidence.get(),
        block,
    };
    Ok((header, raw.curve))
}

/// Reads JSON; the place of an error in the whole of it is ".".
fn parse<'a, T: Deserialize<'a>>(text: &'a [u8]) -> Parsed<T> {
    let mut deserializer = serde_json::Deserializer::from_slice(text);
    let value = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let place = error.path().to_string();
        let error = error.into_inner();
        if error.is_eof() {
            FormatError::Truncated
        } else {
            FormatError::malformed(place, error.to_string())
        }
    })?;
    deserializer
        .end()
        .map_err(|error| FormatError::malformed("end of the document", error.to_string()))?;
    Ok(value)
}

/// An error about the whole of the text is one about the document.
fn in_document(error: FormatError) -> FormatError {
    match error {
        FormatError::Malformed { place, what } if place == "." => FormatError::malformed("document", what),
        other => other,
    }
}

/// Reads a part of the document, whose own place is `within`.
pub fn parse_within<'a, T: Deserialize<'a>>(text: &'a str, within: &str) -> Parsed<T> {
    parse(text.as_bytes()).map_err(|error| match error {
        FormatError::Malformed { place, what } if place == "." => FormatError::malformed(within, what),
        FormatError::Malformed { place, what } => FormatError::malformed(format!("{within}.{place}"), what),
        other => other,
    })
}

/// Reads the JSON form; tokens or events come back as texts.
pub fn read(text: &[u8]) -> Parsed<(Document<'static>, Texts)> {
    let Object(raw): Object<RawDocument<Object<RawCurve>>> = parse(text).map_err(in_document)?;
    let (header, Object(raw_curve)) = header_of(raw, false)?;
    let curve = curve(raw_curve)?;
    let hash = block::curve_sha256(&curve);
    header.into_document(curve, &hash)
}

/// Reads the header of the binary form.
pub fn read_header(text: &[u8]) -> Parsed<Header<'_>> {
    let Object(raw): Object<RawDocument<InBlock>> = parse(text).map_err(in_document)?;
    header_of(raw, true).map(|(header, _)| header)
}
