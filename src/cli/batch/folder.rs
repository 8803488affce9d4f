//! Where a batch leaves its files.

use std::collections::HashMap;
use std::fs::{self, File, OpenOptions};
use std::io::{BufRead, BufReader, ErrorKind, Write};
use std::path::{Path, PathBuf};

use knotproof::show::GENERATOR;
use tempfile::{Builder, TempDir};

use super::RESULTS;
use super::record::Record;
use crate::cli::atomic_file::AtomicFile;
use crate::cli::failure::Failure;

/// The folder of a batch, with a place beside the finished files for those that are not.
pub struct Folder {
    /// The folder that was asked for; without one nothing is kept.
    kept: Option<PathBuf>,
    /// Gone when dropped.
    unfinished: TempDir,
}

impl Folder {
    /// Makes the folder where there is none.
    pub fn new(path: Option<&Path>) -> Result<Folder, Failure> {
        let mut builder = Builder::new();
        builder.prefix(".knotproof-").suffix(".partial");
        let unfinished = match path {
            None => builder.tempdir(),
            Some(path) => {
                fs::create_dir_all(path).map_err(|error| {
                    let what = "cannot be made the folder of a batch";
                    Failure::io(path.display(), what, &error)
                })?;
                builder.tempdir_in(path)
            }
        };
        let shown = path.map_or_else(|| "temporary folder".into(), |path| path.display().to_string());
        Ok(Folder {
            kept: path.map(Path::to_path_buf),
            unfinished: unfinished.map_err(|error| Failure::io(shown, "cannot be written", &error.kind().into()))?,
        })
    }

    /// The folder that was asked for.
    pub fn path(&self) -> Option<&Path> {
        self.kept.as_deref()
    }

    /// Where a file is while it is not finished.
    pub fn unfinished(&self, name: &str) -> PathBuf {
        self.unfinished.path().join(name)
    }

    /// Moves a finished file to its place, if there is one; whatever stands there is replaced.
    pub fn finish(&self, name: &str) -> Result<(), String> {
        let Some(kept) = &self.kept else {
            return fs::remove_file(self.unfinished(name)).map_err(|error| error.to_string());
        };
        let target = kept.join(name);
        fs::rename(self.unfinished(name), &target)
            .map_err(|error| format!("{}: cannot be written: {error}", target.display()))
    }

    /// Writes a file that is there whole or not at all.
    pub fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        let Some(kept) = &self.kept else {
            return Ok(());
        };
        let target = AtomicFile::new(&kept.join(name))?;
        let mut file = target.begin()?;
        file.write_all(text.as_bytes())
            .map_err(|error| target.failure(&error))?;
        target.finish(file)?;
        Ok(())
    }

    /// Refuses to replace files that no batch has written.
    pub fn look_for_foreign_files(&self, page: bool) -> Result<(), Failure> {
        let Some(kept) = &self.kept else {
            return Ok(());
        };
        let ours = |name: &str, is_ours: &dyn Fn(&str) -> bool| {
            let path = kept.join(name);
            let text = match fs::read(&path) {
                Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
                Err(error) => return Err(Failure::io(path.display(), "cannot be replaced", &error)),
                Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
            };
            match text.trim().is_empty() || is_ours(&text) {
                true => Ok(()),
                false => Err(Failure::at(
                    path.display(),
                    "would be replaced, and is no file of a batch; name another folder",
                )),
            }
        };
        ours(RESULTS, &|text| {
            let first = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
            serde_json::from_str::<Record>(first).is_ok()
        })?;
        match page {
            true => ours(super::page::NAME, &|text| text.contains(GENERATOR)),
            false => Ok(()),
        }
    }

    /// The results of an earlier run, by the names of the certificates; lines that are none of ours are left out.
    pub fn earlier(&self) -> HashMap<String, Record> {
        let results = self.kept.as_ref().map(|kept| File::open(kept.join(RESULTS)));
        let Some(Ok(file)) = results else {
            return HashMap::new();
        };
        let mut found = HashMap::new();
        for line in BufReader::new(file).lines().map_while(Result::ok) {
            if let Ok(record) = serde_json::from_str::<Record>(&line)
                && let Some(certificate) = record.certificate.clone()
            {
                found.insert(certificate, record);
            }
        }
        found
    }

    /// The file of results, to which lines are added; emptied before unless `keep`.
    pub fn results(&self, keep: bool) -> Result<Option<File>, Failure> {
        let Some(kept) = &self.kept else {
            return Ok(None);
        };
        let path = kept.join(RESULTS);
        let mut options = OpenOptions::new();
        options.create(true).append(keep).write(true).truncate(!keep);
        let mut file = options
            .open(&path)
            .map_err(|error| Failure::io(path.display(), "cannot be written", &error))?;
        // The last line of a run that was killed may have no end.
        if keep && file.metadata().is_ok_and(|metadata| metadata.len() > 0) {
            writeln!(file).map_err(|error| Failure::io(path.display(), "cannot be written", &error))?;
        }
        Ok(Some(file))
    }

    /// Makes a folder in it.
    pub fn make(&self, name: &str) -> Result<(), Failure> {
        match &self.kept {
            Some(kept) => fs::create_dir_all(kept.join(name))
                .map_err(|error| Failure::io(kept.join(name).display(), "cannot be written", &error)),
            None => Ok(()),
        }
    }
}
