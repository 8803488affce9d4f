//! The curves that are timed, in memory.

// Each bench uses its own part of this file.
#![allow(dead_code)]

#[path = "chains.rs"]
pub mod chains;

use chains::Kind;
use knotproof::curve::{Bezier, Curve, Form, read_curve};
use knotproof::number::{Rational, RationalExt, RationalVector};

/// A curve of the repository.
pub fn file(name: &str) -> Curve {
    let text = std::fs::read(format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"))).expect("a curve file");
    read_curve(text).expect("a curve").curve
}

/// A generated chain of cubic pieces, seed 1.
pub fn generated(kind: Kind, pieces: usize) -> Curve {
    let exact = |x: f64| match kind.decimal() {
        true => Rational::new(((x * 1000.0).round() as i64).into(), 1000.into()),
        false => Rational::from_f64(x).expect("finite"),
    };
    let chain = chains::chain(kind, pieces, 1).expect("a chain");
    let pieces = chain
        .iter()
        .map(|piece| {
            let numbers: Vec<Rational> = piece.iter().flatten().map(|x| exact(*x)).collect();
            Bezier::new(3, RationalVector::from_rationals(&numbers), None).expect("a piece")
        })
        .collect();
    Curve::new(3, Form::Bezier(pieces)).expect("pieces that join")
}
