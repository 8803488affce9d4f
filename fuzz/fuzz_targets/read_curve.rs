//! Whatever the bytes, the reader returns; what it accepts has a chain and survives writing.
#![no_main]

use knotproof::curve::{ReadOptions, read_curve, read_curve_with, write_curve};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let _ = read_curve_with(bytes, ReadOptions { snap_joints: true }).map_err(|e| e.to_string());
    let Ok(file) = read_curve(bytes) else { return };
    // Decomposing some thousands of control points of high degree takes longer than a fuzzer should wait.
    if bytes.len() < 4096 {
        assert!(file.curve.chain().count() > 0);
    }
    let again = read_curve(write_curve(&file.curve, file.name.as_deref())).expect("written by us");
    assert_eq!(again.curve, file.curve);
    assert_eq!(again.name, file.name);
});
