//! From a document to the text of the JSON form.

use std::io::{self, Read, Write};

use super::super::Document;
use super::super::block::{self, hexadecimal};
use super::super::bytes::ByteSource;
use crate::claim::msd::{Interval, Lower, Upper};
use crate::claim::tree::{BinaryTokens, TokenSource, token_text};
use crate::curve::{Curve, Form};
use crate::number::{Integer, RationalExt, RationalVector};

/// The header of the binary form.
pub fn header(document: &Document, hash: &[u8; 32]) -> String {
    let mut text = String::new();
    preamble(document, &mut text);
    text.push_str("  \"curve\": \"binary\",\n");
    statement_and_evidence(document, hash, &mut text);
    text.push_str(if document.has_tree {
        "    \"tree\": \"binary\",\n"
    } else {
        "    \"tree\": null,\n"
    });
    conclusion(document, &mut text);
    text
}

/// Writes the JSON form; `tree` holds the tokens in their binary spelling.
pub fn write<R: Read, W: Write>(document: &Document, tree: R, out: &mut W) -> io::Result<()> {
    let mut text = String::new();
    preamble(document, &mut text);
    text.push_str("  \"curve\": ");
    curve_text(&document.curve, &mut text);
    text.push_str(",\n");
    statement_and_evidence(document, &block::curve_sha256(&document.curve), &mut text);
    out.write_all(text.as_bytes())?;
    text.clear();
    if document.has_tree {
        let dimension = document.curve.dimension();
        let mut tokens = BinaryTokens::new(ByteSource::new(tree), dimension);
        text.push_str("    \"tree\": [");
        let mut first = true;
        while let Some(token) = tokens
            .next_token()
            .map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))?
        {
            text.push_str(if first { "\n      \"" } else { ",\n      \"" });
            first = false;
            text.push_str(&token_text(&token, dimension));
            text.push('"');
            if text.len() > 1 << 16 {
                out.write_all(text.as_bytes())?;
                text.clear();
            }
        }
        text.push_str("\n    ],\n");
    } else {
        text.push_str("    \"tree\": null,\n");
    }
    conclusion(document, &mut text);
    out.write_all(text.as_bytes())
}

fn string(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn preamble(document: &Document, out: &mut String) {
    out.push_str("{\n  \"knotproof\": \"certificate/1\",\n");
    out.push_str(&format!("  \"tool\": {},\n", string(&document.tool)));
    if let Some(name) = &document.name {
        out.push_str(&format!("  \"name\": {},\n", string(name)));
    }
    if let Some(snapped) = document.snapped_joints {
        out.push_str(&format!("  \"snapped_joints\": {snapped},\n"));
    }
}

fn curve_text(curve: &Curve, out: &mut String) {
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

fn statement_and_evidence(document: &Document, hash: &[u8; 32], out: &mut String) {
    let statement = &document.statement;
    let lower = match &statement.lower_squared {
        Lower::Infinite => "inf".to_string(),
        Lower::Finite(value) => value.format(),
    };
    let upper = statement
        .upper_squared
        .as_ref()
        .map_or("null".to_string(), |value| string(&value.format()));
    out.push_str(&format!("  \"curve_sha256\": \"{}\",\n", hexadecimal(hash)));
    out.push_str(&format!(
        "  \"statement\": {{ \"claim\": \"msd\", \"convention\": \"{}\",\n    \"lower_squared\": \"{lower}\",\n    \"upper_squared\": {upper} }},\n",
        statement.convention.name()
    ));
    out.push_str(&format!(
        "  \"evidence\": {{\n    \"grid\": {},\n",
        document.evidence.grid
    ));
}

fn conclusion(document: &Document, out: &mut String) {
    out.push_str("    \"upper\": ");
    match &document.evidence.upper {
        None => out.push_str("null"),
        Some(upper) => out.push_str(&upper_text(upper, document.curve.dimension())),
    }
    out.push_str(" } }\n");
}

fn upper_text(upper: &Upper, dimension: usize) -> String {
    let interval = |i: &Interval| format!("[\"{}\", \"{}\"]", i.start.format(), i.end.format());
    let integers = |v: &[Integer]| {
        let texts: Vec<String> = v.iter().map(|x| format!("\"{x}\"")).collect();
        format!("[{}]", texts.join(", "))
    };
    match upper {
        Upper::Miranda {
            s,
            t,
            first,
            second,
            regular,
            subdivisions,
        } => format!(
            "{{ \"rule\": \"miranda\", \"s\": {}, \"t\": {},\n      \"first\": {}, \"second\": {}, \"regular\": [{}, {}], \"subdivisions\": {subdivisions} }}",
            interval(s),
            interval(t),
            integers(first),
            integers(second),
            integers(&regular[0][..dimension]),
            integers(&regular[1][..dimension]),
        ),
        Upper::Root { s, t } => format!(
            "{{ \"rule\": \"root\", \"s\": \"{}\", \"s_side\": \"{}\", \"t\": \"{}\", \"t_side\": \"{}\" }}",
            s.0.format(),
            s.1.name(),
            t.0.format(),
            t.1.name()
        ),
        Upper::Touch { s, t } => format!(
            "{{ \"rule\": \"touch\", \"s\": \"{}\", \"t\": \"{}\" }}",
            s.format(),
            t.format()
        ),
        Upper::Crossing { s, t, first, second } => format!(
            "{{ \"rule\": \"crossing\", \"s\": {}, \"t\": {}, \"first\": {}, \"second\": {} }}",
            interval(s),
            interval(t),
            integers(&first[..dimension]),
            integers(&second[..dimension])
        ),
        Upper::CriticalRoot { s, t } => {
            format!(
                "{{ \"rule\": \"critical_root\", \"s\": \"{}\", \"t\": \"{}\" }}",
                s.format(),
                t.format()
            )
        }
        Upper::CriticalInterval { s, t, regular } => format!(
            "{{ \"rule\": \"critical_interval\", \"s\": \"{}\", \"t\": {}, \"regular\": {} }}",
            s.format(),
            interval(t),
            integers(&regular[..dimension])
        ),
    }
}
