//! Values that are certified: found by the prover, and replayed by the checker before they are used.

use std::io::Cursor;

use knotproof::certificate::Encoding;
use knotproof::claim::msd::{Convention, Lower, Statement, Upper};
use knotproof::curve::Curve;
use knotproof::number::Rational;
use knotproof::prove::domain::write_checked;
use knotproof::prove::{deviation, msd};

use crate::table::Exact;

/// A certified minimum separation distance.
pub struct Separation {
    pub statement: Statement,
    /// Parameters between which the ends of a double normal lie that is as short as stated, number of the piece and local parameter added.
    pub ends: Option<[[Rational; 2]; 2]>,
}

impl Separation {
    /// No double normal at all?
    pub fn is_infinite(&self) -> bool {
        self.statement.lower_squared == Lower::Infinite
    }

    /// σ² in an interval.
    pub fn squared(&self) -> [Rational; 2] {
        match (&self.statement.lower_squared, &self.statement.upper_squared) {
            (Lower::Finite(low), Some(high)) => [low.clone(), high.clone()],
            found => panic!("not bounded: {found:?}"),
        }
    }

    /// σ.
    pub fn sigma(&self) -> Exact {
        let [low, high] = self.squared();
        Exact::root_between(&low, &high)
    }
}

/// Certifies σ to a relative width of 10⁻³⁰.
pub fn separation(curve: &Curve, convention: Convention) -> Separation {
    let options = msd::Options {
        convention,
        relative_width: crate::exact::number("1e-30"),
        ..msd::Options::default()
    };
    let mut certified = msd::certify(curve, &options, &|_| ()).expect("certified");
    certified
        .write_checked(Encoding::Binary, &mut Cursor::new(Vec::new()))
        .expect("accepted by the checker");
    let content = &certified.document.claim;
    let ends = match &content.evidence.upper {
        Some(Upper::Miranda { s, t, .. }) => {
            Some([s, t].map(|interval| [interval.start.clone(), interval.end.clone()]))
        }
        _ => None,
    };
    Separation {
        statement: content.statement.clone(),
        ends,
    }
}

/// The greatest distance between a curve and its control polygon after subdivision, at equal parameters.
pub fn deviation(curve: &Curve, subdivisions: u32) -> Exact {
    let options = deviation::Options {
        subdivisions,
        relative_width: crate::exact::number("1e-9"),
        name: None,
        snapped_joints: None,
    };
    let found = deviation::certify(curve, &options).expect("a curve");
    let document = found.document.expect("certified");
    write_checked(&document, Encoding::Json, &mut Cursor::new(Vec::new())).expect("accepted by the checker");
    let statement = document.claim.statement;
    Exact::root_between(&statement.lower_squared, &statement.upper_squared)
}
