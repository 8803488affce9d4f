//! The reader of results returns, whatever the bytes; what it accepts survives writing.
#![no_main]

use knotproof::engine::{read_results, write_results};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match read_results(bytes) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(file) => {
            // NaN is not equal to itself; its text is.
            let text = write_results(&file);
            assert_eq!(write_results(&read_results(&text).expect("written by us")), text);
        }
    }
});
