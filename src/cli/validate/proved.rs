//! What certificates prove of engines' cases.

use knotproof::check::{Verdict, check};
use knotproof::validate::{Certified, certified};

use crate::cli::failure::Failure;
use crate::cli::input::{Input, Noting};

/// The cases of a certificate with their exact results, or why the checker rejects it.
pub fn cases(input: &Input) -> Result<Result<Vec<Certified>, String>, Failure> {
    let mut source = Noting::new(input.open()?);
    let verdict = check(&mut source);
    if let Some(error) = source.into_error() {
        return Err(input.unreadable(&error));
    }
    Ok(match verdict {
        Verdict::Accepted { document, .. } => Ok(certified(&document)),
        Verdict::Rejected { rejection, .. } => Err(format!("{}: {}", rejection.place, rejection.reason)),
        Verdict::Malformed(error) => Err(error.to_string()),
    })
}
