//! What several test programs share: certificates made by hand, cases with their expected verdict, the second checker,
//! a walk over cover trees, and the exact truth about polygons.
#![allow(dead_code, reason = "every test program uses a part of its own")]

pub mod case;
pub mod document;
pub mod grow;
pub mod polygon;
pub mod python;
pub mod tree;
