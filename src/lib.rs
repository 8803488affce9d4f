//! Exact spline geometry with certificates.
pub mod curve;
pub mod number;
