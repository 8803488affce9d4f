//! The end of a batch, for people.

use std::fmt::Write;
use std::path::Path;

use super::record::{Record, Status};

/// So many records of each outcome are told; the results hold all.
const TOLD: usize = 40;

/// All there is to tell.
pub struct Summary<'s> {
    /// What became of the curves, in order.
    pub records: &'s [Record],
    /// The labels of the claims.
    pub claims: &'s [String],
    /// How many were not begun, or not finished.
    pub interrupted: usize,
    /// Files of folders that hold no curves.
    pub left_out: usize,
    /// How long the batch took.
    pub seconds: f64,
    /// The folder, if there is one.
    pub folder: Option<&'s Path>,
    /// Was the page written?
    pub index: bool,
}

impl Summary<'_> {
    /// The table and the lists below it.
    pub fn text(&self) -> String {
        // Writing into a string does not fail.
        let mut text = String::new();
        let _ = self.write(&mut text);
        text
    }

    fn write(&self, text: &mut String) -> std::fmt::Result {
        self.write_table(text)?;
        for status in [Status::Refuted, Status::Undecided, Status::Failed] {
            let all: Vec<&Record> = self.records.iter().filter(|record| record.status == status).collect();
            if all.is_empty() {
                continue;
            }
            writeln!(text, "\n{}:", status.name())?;
            for record in all.iter().take(TOLD) {
                let claim = record
                    .claim
                    .as_ref()
                    .map_or(String::new(), |claim| format!(", {claim}"));
                writeln!(text, "  {}{claim}: {}", record.subject(), record.first_words())?;
            }
            if all.len() > TOLD {
                writeln!(text, "  … and {} more, all of them in the results", all.len() - TOLD)?;
            }
        }
        writeln!(text)?;
        if self.left_out > 0 {
            writeln!(text, "left out, files of folders in no known format: {}", self.left_out)?;
        }
        if self.interrupted > 0 {
            let again = match self.folder {
                Some(_) => "; --resume goes on with them",
                None => "",
            };
            writeln!(text, "interrupted, not finished: {}{again}", self.interrupted)?;
        }
        if let Some(folder) = self.folder {
            let index = match self.index {
                true => format!(", page {}", folder.join("index.html").display()),
                false => String::new(),
            };
            let results = folder.join(super::RESULTS);
            writeln!(text, "results {}{index}", results.display())?;
        }
        writeln!(text, "{:.1} s", self.seconds)
    }

    fn write_table(&self, text: &mut String) -> std::fmt::Result {
        let unread = self.records.iter().filter(|record| record.claim.is_none()).count();
        let width = self
            .claims
            .iter()
            .map(|claim| claim.chars().count())
            .max()
            .unwrap_or(0)
            .max(5);
        write!(text, "{:width$}  {:>7}", "claim", "curves")?;
        for status in Status::ALL {
            write!(text, "  {:>9}", status.name())?;
        }
        writeln!(text, "  {:>9}", "seconds")?;
        for claim in self.claims {
            let of: Vec<&Record> = self
                .records
                .iter()
                .filter(|record| record.label().as_ref() == Some(claim))
                .collect();
            write!(text, "{claim:width$}  {:>7}", of.len())?;
            for status in Status::ALL {
                let count = of.iter().filter(|record| record.status == status).count();
                write!(text, "  {count:>9}")?;
            }
            let seconds = of.iter().fold(0.0, |sum, record| sum + record.seconds);
            writeln!(text, "  {seconds:>9.1}")?;
        }
        let resumed = self.records.iter().filter(|record| record.resumed).count();
        if resumed > 0 {
            writeln!(text, "taken over from an earlier run, checked again: {resumed}")?;
        }
        if unread > 0 {
            writeln!(text, "files not read: {unread}")?;
        }
        Ok(())
    }
}
