//! The checker behind three functions, for HTML reports: `input` makes room for a certificate, `check` checks what was put there,
//! `answer` says why. They work on one certificate at a time.

use std::sync::Mutex;

use knotproof::check::{Verdict, check as check_certificate};

static INPUT: Mutex<Vec<u8>> = Mutex::new(Vec::new());
static ANSWER: Mutex<String> = Mutex::new(String::new());

/// Where a certificate of `length` bytes is to be put.
#[unsafe(no_mangle)]
pub extern "C" fn input(length: usize) -> *mut u8 {
    let mut input = INPUT.lock().expect("one thread");
    input.clear();
    input.resize(length, 0);
    input.as_mut_ptr()
}

/// Is the certificate accepted?
#[unsafe(no_mangle)]
pub extern "C" fn check() -> bool {
    let input = INPUT.lock().expect("one thread");
    let (accepted, words) = match check_certificate(input.as_slice()) {
        Verdict::Accepted { leaves, .. } if leaves > 0 => (true, format!("accepted: {leaves} leaves replayed")),
        Verdict::Accepted { .. } => (true, "accepted".to_string()),
        Verdict::Rejected { rejection, .. } => (false, format!("rejected: {rejection}")),
        Verdict::Malformed(error) => (false, format!("rejected: {error}")),
    };
    *ANSWER.lock().expect("one thread") = words;
    accepted
}

/// Where the answer in words is, UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    ANSWER.lock().expect("one thread").as_ptr()
}

/// How many bytes it has.
#[unsafe(no_mangle)]
pub extern "C" fn answer_length() -> usize {
    ANSWER.lock().expect("one thread").len()
}
