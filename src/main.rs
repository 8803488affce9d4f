//! The command line of knotproof.
fn main() {}
