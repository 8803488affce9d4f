//! Floating-point engines and the two files they speak.
//!
//! An engine answers cases. A case is an operation on a curve whose numbers are all binary64 ([`Case`], [`Operation`]); an answer is
//! what the engine returned ([`Answer`]). In Rust an engine implements [`Engine`]; a program in another language reads `cases.json` and writes
//! `results.json` ([`read_cases`], [`write_cases`], [`read_results`], [`write_results`]). [`generate`] makes cases from a seed.
//! What an answer is worth is judged in `validate`, never here.
//!
//! ```
//! use knotproof::engine::{Answer, read_cases, read_results};
//!
//! let cases = read_cases(r#"{ "knotproof": "cases/1", "cases": [ { "id": "a", "operation": "point", "parameter": 0.5,
//!     "curve": { "degree": 1, "knots": [0, 0, 1, 1], "points": [[0, 0], [2, 1]] } } ] }"#)?;
//! let results = read_results(r#"{ "knotproof": "results/1", "engine": "mine 1.0",
//!     "results": [ { "id": "a", "status": "ok", "point": [1, "0x1p-1"] } ] }"#)?;
//! assert_eq!(cases.cases[0].id, results.results[0].id);
//! assert!(matches!(results.results[0].answer, Answer::Ok(_)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod answer;
mod case;
mod curve;
mod error;
pub mod generate;
mod read;
mod write;

pub use answer::{Answer, ResultEntry, ResultsFile, Returned};
pub use case::{Case, CaseSide, CasesFile, MOST_LEVELS, OPERATIONS, Operation};
pub use curve::FloatCurve;
pub use error::FileError;
pub use read::{MOST_ENTRIES, read_cases, read_results};
pub use write::{write_cases, write_results};

/// The version of files of cases.
pub const CASES_VERSION: &str = "cases/1";
/// The version of files of results.
pub const RESULTS_VERSION: &str = "results/1";

/// Something that computes in floating point.
pub trait Engine {
    /// Its name and version, as `scipy 1.14.1`.
    fn name(&self) -> String;

    /// What it returns for a case. It must not panic: what it cannot do is [`Answer::Refused`] or [`Answer::NotOffered`].
    fn answer(&self, case: &Case) -> Answer;
}
