//! Whatever the bytes, the checker answers, with a verdict or a reason.
//!
//! Run it with `cargo +nightly fuzz run check_certificate fuzz/corpus/check_certificate certs/accept`.
#![no_main]

use knotproof::check::{Verdict, check};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // High degrees and deep trees are legitimate but slow.
    if bytes.len() > 1 << 14 {
        return;
    }
    if let Verdict::Rejected { rejection, .. } = check(bytes) {
        let _ = rejection.to_string();
    }
});
