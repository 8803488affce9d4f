//! An end from the keyboard, or from whoever asks the program to end.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// The exit code after the second request, when nothing is finished.
const UNUSABLE: i32 = 2;

/// From now on Ctrl-C ends the batch after what is there was written; a second one ends it at once.
pub fn listen() {
    // Where it cannot be had, Ctrl-C ends the program as usual; finished files are whole all the same.
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::SeqCst) {
            process::exit(UNUSABLE);
        }
    });
}

/// Has an end been asked for?
pub fn asked() -> bool {
    ASKED.load(Ordering::SeqCst)
}
