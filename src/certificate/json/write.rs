//! From a document to the text of the JSON form.

use std::io::{self, Read, Write};

use super::super::Document;
use super::super::block::{self, hexadecimal};
use super::{curvature, deviation, domain, embedding, motion, msd, thickness, values};
use crate::claim::{AsClaim, ClaimRef};
use crate::curve::{Curve, Form};
use crate::number::{RationalExt, RationalVector};

/// The header of the binary form.
pub fn header<C: AsClaim>(document: &Document<C>, hash: &[u8; 32]) -> io::Result<Vec<u8>> {
    let mut text = String::new();
    preamble(document, &mut text);
    text.push_str("  \"curve\": \"binary\",\n");
    let mut out = Vec::new();
    rest(document, hash, None::<io::Empty>, text, &mut out)?;
    Ok(out)
}

/// Writes the JSON form; `tree` holds the tokens in their binary spelling.
pub fn write<C: AsClaim, R: Read, W: Write>(document: &Document<C>, tree: R, out: &mut W) -> io::Result<()> {
    let mut text = String::new();
    preamble(document, &mut text);
    text.push_str("  \"curve\": ");
    curve_text(&document.curve, &mut text);
    text.push_str(",\n");
    rest(document, &block::curve_sha256(&document.curve), Some(tree), text, out)
}

/// What follows the curve; `text` comes before it.
fn rest<C: AsClaim, R: Read, W: Write>(
    document: &Document<C>,
    hash: &[u8; 32],
    tree: Option<R>,
    mut text: String,
    out: &mut W,
) -> io::Result<()> {
    text.push_str(&format!(
        "  \"curve_sha256\": \"{}\",\n  \"statement\": ",
        hexadecimal(hash)
    ));
    let between = ",\n  \"evidence\": ";
    match document.claim.as_claim() {
        ClaimRef::Msd(content) => {
            msd::write_statement(&content.statement, &mut text);
            text.push_str(between);
            out.write_all(text.as_bytes())?;
            msd::write_evidence(content, document.curve.dimension(), tree, out)?;
        }
        ClaimRef::Embedding(content) => {
            embedding::write_statement(&content.statement, &mut text);
            text.push_str(between);
            out.write_all(text.as_bytes())?;
            embedding::write_evidence(content, document.curve.dimension(), tree, out)?;
        }
        ClaimRef::Motion(content) => {
            text.push_str(&motion::statement_text(&content.statement));
            text.push_str(between);
            out.write_all(text.as_bytes())?;
            motion::write_evidence(&content.evidence, document.curve.dimension(), tree, out)?;
        }
        ClaimRef::Domain(content) => {
            domain::write_statement(&content.statement, &mut text);
            text.push_str(between);
            domain::write_evidence(&content.evidence, &mut text);
            out.write_all(text.as_bytes())?;
        }
        ClaimRef::Deviation(content) => {
            text.push_str(&deviation::statement_text(&content.statement));
            text.push_str(between);
            text.push_str(&deviation::evidence_text(&content.evidence));
            out.write_all(text.as_bytes())?;
        }
        ClaimRef::Thickness(content) => {
            text.push_str(&thickness::statement_text(&content.statement));
            text.push_str(between);
            out.write_all(text.as_bytes())?;
            thickness::write_evidence(&content.evidence, document.curve.dimension(), tree, out)?;
        }
        ClaimRef::Values(content) => {
            text.push_str(&values::statement_text(&content.statement));
            text.push_str(between);
            text.push_str(&values::evidence_text(&content.evidence, document.curve.dimension()));
            out.write_all(text.as_bytes())?;
        }
        ClaimRef::Curvature(content) => {
            text.push_str(&curvature::statement_text(&content.statement));
            text.push_str(between);
            text.push_str(&curvature::evidence_text(&content.evidence));
            out.write_all(text.as_bytes())?;
        }
    }
    out.write_all(b" }\n")
}

/// A text as a JSON string.
pub fn string(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn preamble<C>(document: &Document<C>, out: &mut String) {
    out.push_str("{\n  \"knotproof\": \"certificate/1\",\n");
    out.push_str(&format!("  \"tool\": {},\n", string(&document.tool)));
    if let Some(name) = &document.name {
        out.push_str(&format!("  \"name\": {},\n", string(name)));
    }
    if let Some(snapped) = document.snapped_joints {
        out.push_str(&format!("  \"snapped_joints\": {snapped},\n"));
    }
}

/// A curve as it stands in a certificate.
pub fn curve_text(curve: &Curve, out: &mut String) {
    let dimension = curve.dimension();
    match curve.form() {
        Form::BSpline(spline) => {
            out.push_str(&format!(
                "{{ \"bspline\": {{\n    \"degree\": {},\n    \"knots\": ",
                spline.degree()
            ));
            list(spline.knots(), out);
            out.push_str(",\n    \"points\": ");
            point_list(spline.points(), dimension, out);
            if let Some(weights) = spline.weights() {
                out.push_str(",\n    \"weights\": ");
                list(weights, out);
            }
            out.push_str(" } }");
        }
        Form::Bezier(pieces) => {
            out.push_str("{ \"bezier\": { \"pieces\": [");
            for (i, piece) in pieces.iter().enumerate() {
                out.push_str(if i == 0 {
                    "\n    { \"points\": "
                } else {
                    ",\n    { \"points\": "
                });
                point_list(piece.points(), dimension, out);
                if let Some(weights) = piece.weights() {
                    out.push_str(", \"weights\": ");
                    list(weights, out);
                }
                out.push_str(" }");
            }
            out.push_str("\n  ] } }");
        }
    }
}

fn list(numbers: &RationalVector, out: &mut String) {
    for (i, number) in numbers.iter().enumerate() {
        out.push_str(if i == 0 { "[\"" } else { "\", \"" });
        out.push_str(&number.format());
    }
    out.push_str("\"]");
}

fn point_list(points: &RationalVector, dimension: usize, out: &mut String) {
    for (i, number) in points.iter().enumerate() {
        out.push_str(match (i, i % dimension) {
            (0, _) => "[[\"",
            (_, 0) => "\"], [\"",
            _ => "\", \"",
        });
        out.push_str(&number.format());
    }
    out.push_str("\"]]");
}
