//! Moving curves: motion files, and what is certified of them. The numbers that CPIJ14 print: tests/papers.
#![cfg(feature = "prove")]

#[path = "motion/files.rs"]
mod files;
#[path = "motion/prover.rs"]
mod prover;
