//! Writing to standard output and standard error.

use std::io::{self, ErrorKind, Write};

use serde::Serialize;

use super::failure::Failure;

/// Writes text to standard output. A reader who has gone away is no failure: the exit code still tells the result.
pub fn say(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::io("standard output", "cannot be written", &error))
        }
        _ => Ok(()),
    }
}

/// Writes a value as one line of JSON to standard output.
pub fn say_json(value: &impl Serialize) -> Result<(), Failure> {
    let mut line = serde_json::to_string(value).map_err(|error| Failure::at("standard output", error.to_string()))?;
    line.push('\n');
    say(&line)
}

/// Writes something worth knowing to standard error.
#[cfg(all(feature = "prove", feature = "import"))]
pub fn remark(text: &str) {
    let _ = writeln!(io::stderr(), "note: {text}");
}

/// Writes an error to standard error; when that is gone there is nobody to tell.
pub fn complain(failure: &Failure) {
    let _ = writeln!(io::stderr(), "error: {failure}");
}
