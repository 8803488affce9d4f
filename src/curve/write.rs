//! The canonical writer of curve files.

use std::fmt::Write;

use super::{BSpline, Bezier, Curve, Form, read};
use crate::number::{RationalExt, RationalVector};

/// The curve as a canonical `curve/1` JSON text on one line: no spaces, every number a string with a reduced fraction.
///
/// Reading the text gives back an equal curve and the name.
pub fn write_curve(curve: &Curve, name: Option<&str>) -> String {
    let mut text = format!("{{\"knotproof\":{:?}", read::VERSION);
    if let Some(name) = name {
        // A JSON value made of one string cannot fail to be written.
        let _ = write!(text, ",\"name\":{}", serde_json::Value::from(name));
    }
    match curve.form() {
        Form::BSpline(spline) => write_bspline(&mut text, spline),
        Form::Bezier(pieces) => {
            text.push_str(",\"bezier\":{\"pieces\":[");
            for (i, piece) in pieces.iter().enumerate() {
                if i > 0 {
                    text.push(',');
                }
                write_bezier(&mut text, piece);
            }
            text.push_str("]}");
        }
    }
    text.push('}');
    text
}

fn write_bspline(text: &mut String, spline: &BSpline) {
    let _ = write!(text, ",\"bspline\":{{\"degree\":{},\"knots\":", spline.degree());
    write_list(text, spline.knots());
    text.push_str(",\"points\":");
    write_points(text, spline.dimension(), spline.points());
    write_weights(text, spline.weights());
    text.push('}');
}

fn write_bezier(text: &mut String, piece: &Bezier) {
    text.push_str("{\"points\":");
    write_points(text, piece.dimension(), piece.points());
    write_weights(text, piece.weights());
    text.push('}');
}

fn write_weights(text: &mut String, weights: Option<&RationalVector>) {
    if let Some(weights) = weights {
        text.push_str(",\"weights\":");
        write_list(text, weights);
    }
}

fn write_points(text: &mut String, dimension: usize, points: &RationalVector) {
    for (i, number) in points.iter().enumerate() {
        text.push_str(match (i, i % dimension) {
            (0, _) => "[[\"",
            (_, 0) => "\"],[\"",
            _ => "\",\"",
        });
        text.push_str(&number.format());
    }
    text.push_str("\"]]");
}

fn write_list(text: &mut String, numbers: &RationalVector) {
    for (i, number) in numbers.iter().enumerate() {
        text.push_str(if i == 0 { "[\"" } else { "\",\"" });
        text.push_str(&number.format());
    }
    text.push_str("\"]");
}
