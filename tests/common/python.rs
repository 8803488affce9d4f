//! The second checker, `certs/checkers/python/check.py`.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use super::case::certs;

/// What it says of a file.
#[derive(Debug)]
pub struct Answer {
    /// Accepted?
    pub accepted: bool,
    /// Its reason for a rejection.
    pub reason: String,
}

/// Its answers on files of these contents.
pub fn check_bytes(files: &[&[u8]]) -> Vec<Answer> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let paths: Vec<PathBuf> = (0..files.len()).map(|i| folder.path().join(format!("{i}"))).collect();
    for (path, bytes) in paths.iter().zip(files) {
        std::fs::write(path, bytes).expect("writes a temporary file");
    }
    check_files(&paths)
}

/// Its answers on files.
pub fn check_files(paths: &[PathBuf]) -> Vec<Answer> {
    paths.chunks(400).flat_map(run).collect()
}

fn run(paths: &[PathBuf]) -> Vec<Answer> {
    let script: &Path = &certs().join("checkers/python/check.py");
    let output = Command::new("python3")
        .arg("-B")
        .arg(script)
        .arg("--json")
        .args(paths)
        .output()
        .unwrap_or_else(|error| {
            panic!("these tests run the second checker with `python3` (3.11 or newer), which did not start: {error}")
        });
    let text = String::from_utf8_lossy(&output.stdout);
    let answers: Vec<Answer> = text
        .lines()
        .map(|line| {
            let report: Value = serde_json::from_str(line).unwrap_or_else(|_| panic!("check.py printed {line:?}"));
            Answer {
                accepted: report["verdict"] == "accepted",
                reason: format!("{} {}", report["verdict"], report["reason"]),
            }
        })
        .collect();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(
        answers.len(),
        paths.len(),
        "check.py did not answer for every file: {complaint}"
    );
    answers
}
