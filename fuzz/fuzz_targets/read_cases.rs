//! The reader of cases returns, whatever the bytes; what it accepts survives writing.
#![no_main]

use knotproof::engine::{read_cases, write_cases};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match read_cases(bytes) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(file) => assert_eq!(read_cases(write_cases(&file)).expect("written by us"), file),
    }
});
