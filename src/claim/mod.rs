//! Claims: statements and their evidence, as plain data. Nothing here computes.

pub mod msd;
pub mod tree;
