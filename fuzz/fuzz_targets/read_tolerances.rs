//! The reader of tolerances returns, whatever the bytes.
#![no_main]

use knotproof::engine::OPERATIONS;
use knotproof::validate::Tolerances;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match Tolerances::read(bytes) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(tolerances) => assert!(OPERATIONS.iter().all(|name| tolerances.ulps(name) >= 0.0)),
    }
});
