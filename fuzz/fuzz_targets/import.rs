//! Whatever the bytes, every reader of another format returns; what it accepts is written and read back the same.
//!
//! The first byte chooses the reader, so that each is reached. Run it with
//! `cargo +nightly fuzz run import fuzz/corpus/import -- -max_len=4096`.
#![no_main]

use knotproof::curve::{read_curve, write_curve};
use knotproof::import::{Format, Options, import_as};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Some((first, rest)) = bytes.split_first() else { return };
    let format = Format::ALL[usize::from(*first) % Format::ALL.len()];
    let options = Options {
        weld: first & 0x80 != 0,
        smooth: first & 0x40 != 0,
        ..Options::default()
    };
    match import_as(format, rest, &options) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(imported) => {
            for curve in imported.curves.iter().take(16) {
                let again = read_curve(write_curve(&curve.curve, Some(&curve.title()))).expect("written by us");
                assert_eq!(again.curve, curve.curve);
            }
        }
    }
});
