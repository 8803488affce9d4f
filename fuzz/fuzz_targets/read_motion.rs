//! The reader of motions returns, whatever the bytes, and so does going through all frames.
#![no_main]

use std::path::Path;

use knotproof::motion::{ReadOptions, read_motion_text};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // A path in it could be that of any file.
    let text = String::from_utf8_lossy(bytes);
    if text.contains("\"curve\": \"") || text.contains("\"curve\":\"") {
        return;
    }
    match read_motion_text(bytes, Path::new("nowhere"), ReadOptions::default()) {
        Err(error) => assert!(!error.to_string().is_empty()),
        // All steps were looked at; the second reading finds the same.
        Ok(motion) => {
            for step in motion.moves().expect("from memory") {
                step.expect("read before");
            }
        }
    }
});
