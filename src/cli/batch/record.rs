//! What became of one claim about one curve.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::cli::Exit;

/// An outcome.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Proved, as asked.
    Certified,
    /// The contrary is proved.
    Refuted,
    /// Neither.
    Undecided,
    /// There is no answer: the file cannot be read, the claim makes no sense for the curve, or the search broke down.
    Failed,
}

impl Status {
    /// All of them, in the order in which they are told.
    pub const ALL: [Status; 4] = [Status::Certified, Status::Refuted, Status::Undecided, Status::Failed];

    /// In one word.
    pub fn name(self) -> &'static str {
        match self {
            Status::Certified => "certified",
            Status::Refuted => "refuted",
            Status::Undecided => "undecided",
            Status::Failed => "failed",
        }
    }

    /// The exit code of it alone.
    pub fn exit(self) -> Exit {
        match self {
            Status::Certified => Exit::Success,
            Status::Refuted => Exit::Refuted,
            Status::Undecided => Exit::Undecided,
            Status::Failed => Exit::Unusable,
        }
    }
}

/// A line of the results.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Record {
    /// The file, as it was given.
    pub input: String,
    /// The curve's name in the file; nothing when the file could not be read.
    pub curve: Option<String>,
    /// The claim; nothing when the file could not be read.
    pub claim: Option<String>,
    /// The claim's options.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub options: Vec<String>,
    /// What became of it.
    pub status: Status,
    /// The exit code of it alone.
    pub exit_code: u8,
    /// The statement of the certificate, as `check --json` prints it.
    pub statement: Option<Value>,
    /// The statement in words.
    pub words: Option<String>,
    /// Why it is not certified, as `certify` says it.
    pub reason: Option<String>,
    /// What there is to know, in plain words and in the file's coordinates.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
    /// What reading changed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// Of the exact curve.
    pub curve_sha256: Option<String>,
    /// The certificate, which the checker accepted; relative to the folder.
    pub certificate: Option<String>,
    /// Its size.
    pub bytes: Option<u64>,
    /// Leaves of its tree.
    pub leaves: Option<u64>,
    /// The drawing, relative to the folder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
    /// The report, relative to the folder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub report: Option<String>,
    /// How long it took.
    pub seconds: f64,
    /// Was it taken over from an earlier run?
    #[serde(default)]
    pub resumed: bool,
}

impl Record {
    /// A record of which nothing but the outcome is known.
    pub fn new(input: &str, status: Status) -> Record {
        let mut record = Record {
            input: input.into(),
            curve: None,
            claim: None,
            options: Vec::new(),
            status,
            exit_code: 0,
            statement: None,
            words: None,
            reason: None,
            remarks: Vec::new(),
            notes: Vec::new(),
            curve_sha256: None,
            certificate: None,
            bytes: None,
            leaves: None,
            picture: None,
            report: None,
            seconds: 0.0,
            resumed: false,
        };
        record.set(status);
        record
    }

    /// Sets the outcome.
    pub fn set(&mut self, status: Status) {
        self.status = status;
        self.exit_code = status.exit().code();
    }

    /// The claim with its options.
    pub fn label(&self) -> Option<String> {
        self.claim.as_ref().map(|claim| label(claim, &self.options))
    }

    /// The file and the curve's name in it.
    pub fn subject(&self) -> String {
        match &self.curve {
            Some(curve) => format!("{} {curve}", self.input),
            None => self.input.clone(),
        }
    }

    /// Adds what may explain that nothing good is proved.
    pub fn suspect(&mut self, suspicion: Option<&String>) {
        if matches!(self.status, Status::Refuted | Status::Undecided) {
            self.remarks.extend(suspicion.cloned());
        }
    }

    /// What a reader wants to know first: the plain words, else the reason, else the statement; of what is undecided, also the part that is proved.
    pub fn first_words(&self) -> String {
        let mut parts = self.remarks.clone();
        match self.status {
            Status::Certified => parts.extend(self.words.clone()),
            _ if parts.is_empty() => parts.extend(self.reason.clone().or_else(|| self.words.clone())),
            _ => {}
        }
        let words = parts.join("; ");
        match &self.words {
            Some(proved) if self.status == Status::Undecided && !proved.starts_with("nothing") => {
                format!("{words}; proved: {proved}")
            }
            _ => words,
        }
    }
}

/// A claim with its options, for people.
pub fn label(claim: &str, options: &[String]) -> String {
    options
        .iter()
        .fold(claim.to_string(), |text, option| text + " " + option)
}

/// The exit code of a batch: of something that failed, else of something refuted, else of something undecided, else 0.
pub fn worst(records: impl IntoIterator<Item = Status>) -> Exit {
    let rank = |status: &Status| match status {
        Status::Certified => 0,
        Status::Undecided => 1,
        Status::Refuted => 2,
        Status::Failed => 3,
    };
    records.into_iter().max_by_key(rank).map_or(Exit::Success, Status::exit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_decides() {
        use Status::{Certified, Failed, Refuted, Undecided};
        for (all, exit) in [
            (&[][..], Exit::Success),
            (&[Certified, Certified], Exit::Success),
            (&[Undecided, Certified], Exit::Undecided),
            (&[Certified, Refuted, Undecided], Exit::Refuted),
            (&[Refuted, Failed, Undecided], Exit::Unusable),
        ] {
            assert_eq!(worst(all.iter().copied()), exit, "{all:?}");
        }
    }
}
