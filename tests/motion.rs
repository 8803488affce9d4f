//! Moving curves: motion files, and the numbers that CPIJ14 print.
#![cfg(feature = "prove")]

#[path = "motion/cpij14.rs"]
mod cpij14;
#[path = "motion/files.rs"]
mod files;
#[path = "motion/prover.rs"]
mod prover;
