//! As check_certificate, of the binary form alone.
#![no_main]

use knotproof::check::{Verdict, check};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if bytes.len() > 1 << 14 {
        return;
    }
    let mut file = b"KNOTCRT1".to_vec();
    file.extend(bytes.strip_prefix(b"KNOTCRT1").unwrap_or(bytes));
    if let Verdict::Rejected { rejection, .. } = check(&file[..]) {
        assert!(!rejection.to_string().is_empty());
    }
});
