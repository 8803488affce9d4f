//! The rules: one obligation, one file.

pub mod bend;
pub mod cone;
pub mod critical;
pub mod crossing;
pub mod far;
pub mod miranda;
pub mod monotone;
pub mod not_normal;
pub mod pedal;
pub mod root;
pub mod separate;
pub mod turn;

use crate::number::Integer;

/// An obligation that does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// What should hold.
    pub expected: &'static str,
    /// What was found.
    pub found: String,
}

/// Whether an obligation holds.
pub type Outcome = Result<(), Failure>;

fn fails(expected: &'static str, found: String) -> Outcome {
    Err(Failure { expected, found })
}

fn is_zero_vector(v: &[Integer; 3]) -> bool {
    v.iter().all(Integer::is_zero)
}

fn is_zero_pair(v: &[Integer; 2]) -> bool {
    v.iter().all(Integer::is_zero)
}
