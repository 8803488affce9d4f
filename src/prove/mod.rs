//! Finding evidence. Nothing here is trusted: what it finds is written down and replayed by the checker.

mod cone;
mod cover;
pub mod curvature;
pub mod deviation;
pub mod domain;
pub mod embedding;
mod evidence;
mod exact;
mod float_chain;
mod half_plane;
mod leaf;
pub mod linear_program;
pub mod motion;
pub mod msd;
mod newton;
mod node;
mod seeds;
pub mod thickness;
mod tree;
mod upper;
pub mod values;
mod vector;

/// The program that writes certificates.
const TOOL: &str = concat!("knotproof ", env!("CARGO_PKG_VERSION"));
