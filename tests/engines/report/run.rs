//! Adapters as child processes.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use knotproof::engine::{Case, CasesFile, ResultsFile, read_results, write_cases};
use tempfile::TempDir;

/// A command that reads cases and writes results.
pub struct Adapter {
    command: Vec<String>,
    directory: PathBuf,
}

impl Adapter {
    pub fn new(command: &str, directory: &Path) -> Adapter {
        Adapter {
            command: command.split_whitespace().map(str::to_string).collect(),
            directory: directory.to_path_buf(),
        }
    }

    /// The answers to the cases.
    pub fn answers(&self, cases: &[Case]) -> Result<ResultsFile, String> {
        let own = |error: std::io::Error| format!("{}: {error}", self.command.join(" "));
        let folder = TempDir::new().map_err(own)?;
        let (asked, written) = (folder.path().join("cases.json"), folder.path().join("results.json"));
        let file = CasesFile {
            seed: None,
            cases: cases.to_vec(),
        };
        std::fs::write(&asked, write_cases(&file)).map_err(own)?;
        let (program, rest) = self.command.split_first().ok_or("an empty command")?;
        let status = Command::new(program)
            .args(rest)
            .args([&asked, &written])
            .current_dir(&self.directory)
            .stdout(Stdio::null())
            .status()
            .map_err(own)?;
        if !status.success() {
            return Err(format!("{}: {status}", self.command.join(" ")));
        }
        let text = std::fs::read(&written).map_err(own)?;
        read_results(text).map_err(|error| format!("{}: {error}", self.command.join(" ")))
    }
}
