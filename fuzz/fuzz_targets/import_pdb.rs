//! The reader of this format returns, whatever the bytes.
#![no_main]

use knotproof::import::Format;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| knotproof_fuzz::import(Format::Pdb, bytes));
