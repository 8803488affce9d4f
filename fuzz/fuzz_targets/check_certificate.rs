//! Whatever the bytes, the checker answers, with a verdict or a reason.
#![no_main]

use knotproof::check::{Verdict, check};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // High degrees and deep trees are legitimate but slow.
    if bytes.len() > 1 << 14 {
        return;
    }
    match check(bytes) {
        Verdict::Rejected { rejection, .. } => assert!(!rejection.to_string().is_empty()),
        Verdict::Malformed(error) => assert!(!error.to_string().is_empty()),
        Verdict::Accepted { .. } => {}
    }
});
