//! Holding answers of floating-point engines against exact results.
//!
//! [`truth()`] computes the exact result of a case, [`judge()`] says whether an answer is wrong, with an exact witness, or how many units in the last
//! place it is off; a [`Report`] has the judgements of all answers of one engine. Curves are compared as curves modulo affine reparametrisation; either
//! one-sided value counts at a knot. The rules and units are described in `docs/validate.md`.

mod built_in;
mod certified;
mod condition;
mod distance;
mod domain;
mod github;
mod judge;
mod junit;
mod report;
mod sarif;
mod structure;
mod tolerance;
mod truth;
mod verdict;
mod words;

pub use built_in::KnotproofF64;
pub use certified::{Certified, certified};
pub use domain::ExactDomain;
pub use github::annotations;
pub use judge::judge;
pub use junit::junit;
pub use report::{Counts, Finding, Outcome, Report, UnknownId};
pub use sarif::sarif;
pub use structure::{Expected, Multiplicity};
pub use tolerance::{TOLERANCES_VERSION, Tolerances};
pub use truth::{Enclosed, ExactVector, MsdBounds, MsdOracle, Truth, truth};
pub use verdict::{Kind, Verdict, Wrong};
