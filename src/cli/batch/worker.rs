//! One claim about one curve: certified, checked, put into words, drawn.

use std::ffi::OsString;
use std::fs;
use std::time::Instant;

use knotproof::certificate::{Document, curve_sha256};
use knotproof::check::{Verdict, check};
use serde_json::Value;

use super::Batch;
use super::child::{self, Ran};
use super::options::Show;
use super::record::{Record, Status};
use super::subjects::{Source, Subject};
use super::words;
use crate::cli::certify::output_file::Format;
use crate::cli::certify::specification::Specification;
use crate::cli::check::{hexadecimal, statement};
use crate::cli::show::drawings;

/// The folder of drawings in a batch's folder.
pub const PICTURES: &str = "pictures";
/// The folder of reports.
pub const REPORTS: &str = "reports";

/// An accepted certificate.
struct Accepted {
    document: Box<Document<'static>>,
    leaves: u64,
    bytes: Vec<u8>,
}

impl Batch<'_> {
    /// What becomes of a claim about a subject; nothing when the batch was to end before.
    pub fn perform(&self, subject: &Subject, number: usize) -> Option<Record> {
        let start = Instant::now();
        let specification = &self.order.specifications[number];
        let mut record = self.begin(subject, specification);
        let name = self.certificate_name(subject, number);
        if let Some(earlier) = self.earlier.get(&name)
            && self.take_over(earlier, subject, &name, &mut record)
        {
            record.suspect(subject.suspicion.as_ref());
            record.seconds = start.elapsed().as_secs_f64();
            return Some(record);
        }
        let ran = match self.certify(subject, specification, &name) {
            Ok(Some(ran)) => ran,
            Ok(None) => return None,
            Err(error) => {
                record.set(Status::Failed);
                record.reason = Some(format!("no process could be started: {error}"));
                return Some(record);
            }
        };
        if let Err(reason) = self.judge(&ran, subject, &name, &mut record) {
            record.set(Status::Failed);
            record.reason = Some(reason);
        }
        record.suspect(subject.suspicion.as_ref());
        record.seconds = start.elapsed().as_secs_f64();
        Some(record)
    }

    /// A record that says what it is about.
    pub fn begin(&self, subject: &Subject, specification: &Specification) -> Record {
        let mut record = Record::new(&subject.input, Status::Failed);
        record.curve = subject.curve.clone();
        record.claim = Some(specification.claim.clone());
        record.options = specification.shown();
        record.notes = subject.notes.clone();
        if let Source::Curve(_, _, sha256) = &subject.source {
            record.curve_sha256 = Some(hexadecimal(sha256));
        }
        record
    }

    /// The name of a certificate in the folder.
    fn certificate_name(&self, subject: &Subject, number: usize) -> String {
        let ending = match self.order.format {
            Some(Format::Binary) => "bin",
            _ => "json",
        };
        format!("{}.{}.cert.{ending}", subject.base, self.short_labels[number])
    }

    /// Takes over what an earlier run found out, if its certificate is there, is about this curve, and is accepted.
    fn take_over(&self, earlier: &Record, subject: &Subject, name: &str, record: &mut Record) -> bool {
        let same = earlier.claim == record.claim
            && earlier.options == record.options
            && earlier.curve_sha256.is_some()
            && earlier.curve_sha256 == record.curve_sha256
            && matches!(earlier.status, Status::Certified | Status::Refuted);
        let Some(folder) = self.folder.path().filter(|_| same) else {
            return false;
        };
        let Ok(accepted) = fs::read(folder.join(name))
            .map_err(|error| error.to_string())
            .and_then(|bytes| accept(bytes, subject))
        else {
            return false;
        };
        record.set(earlier.status);
        record.resumed = true;
        self.describe(accepted, subject, name, record).is_ok()
    }

    /// Runs the search in a process of its own.
    fn certify(&self, subject: &Subject, specification: &Specification, name: &str) -> std::io::Result<Option<Ran>> {
        let mut arguments: Vec<OsString> = vec!["certify".into(), specification.claim.clone().into()];
        arguments.extend(specification.options.iter().cloned());
        let input = match &subject.source {
            Source::Curve(file, ..) => {
                arguments.push("-".into());
                &file[..]
            }
            Source::Motion(path) => {
                // A name that begins with "-" is no option.
                arguments.push(match path.is_absolute() {
                    true => path.into(),
                    false => std::path::Path::new(".").join(path).into(),
                });
                &[]
            }
            Source::Unreadable(_) => return Ok(None),
        };
        arguments.extend(["--json".into(), "-o".into(), self.folder.unfinished(name).into()]);
        if self.order.snap_joints {
            arguments.push("--snap-joints".into());
        }
        if let Some(limit) = self.order.many.time_limit {
            arguments.push(format!("--time-limit={}", limit.as_secs_f64()).into());
        }
        child::run(&arguments, input, self.threads)
    }

    /// Reads what the search said, and lets the checker read the certificate that it wrote.
    fn judge(&self, ran: &Ran, subject: &Subject, name: &str, record: &mut Record) -> Result<(), String> {
        let status = match ran.status.code() {
            Some(0) => Status::Certified,
            Some(1) => Status::Refuted,
            Some(3) => Status::Undecided,
            Some(2) => return Err(complaint(&ran.err, subject)),
            _ => {
                let last = ran
                    .err
                    .lines()
                    .rfind(|line| !line.trim().is_empty())
                    .unwrap_or_default();
                return Err(format!("the search broke down ({}): {last}", ran.status));
            }
        };
        let line = ran.out.lines().last().unwrap_or_default();
        let told: Value = serde_json::from_str(line).map_err(|error| format!("the search said {line:?}: {error}"))?;
        record.set(status);
        record.reason = told["reason"].as_str().map(String::from);
        if let (Source::Curve(_, curve, _), Some(reason)) = (&subject.source, &record.reason) {
            record.remarks.extend(words::of_reason(curve, reason));
        }
        if told["certificate"].is_null() {
            return match status {
                Status::Undecided => Ok(()),
                _ => Err("the search wrote no certificate".into()),
            };
        }
        let bytes = fs::read(self.folder.unfinished(name)).map_err(|error| format!("{name}: {error}"))?;
        let accepted = accept(bytes, subject)?;
        self.folder.finish(name)?;
        self.describe(accepted, subject, name, record)
    }

    /// What an accepted certificate says, in words and pictures.
    fn describe(&self, accepted: Accepted, subject: &Subject, name: &str, record: &mut Record) -> Result<(), String> {
        let Accepted {
            document,
            leaves,
            bytes,
        } = accepted;
        let stated = statement(&document);
        record.words = Some(stated.words().to_string());
        record.statement = Some(serde_json::to_value(&stated).map_err(|error| error.to_string())?);
        record.leaves = Some(leaves);
        record.bytes = Some(bytes.len() as u64);
        record.remarks.extend(words::of_proof(&document.curve, &document));
        if self.folder.path().is_none() {
            return Ok(());
        }
        record.certificate = Some(name.to_string());
        let show = self.order.many.show.filter(|show| *show >= Show::Pictures);
        if let Some(show) = show {
            let title = format!("{} {}", subject.input, subject.curve.as_deref().unwrap_or_default());
            let (picture, report) = drawings(
                title.trim(),
                &document,
                &bytes,
                show == Show::Reports,
                subject.upside_down,
            )?;
            let stem = name.rsplit_once(".cert.").map_or(name, |(stem, _)| stem);
            let place = format!("{PICTURES}/{stem}.svg");
            self.folder
                .write(&place, &picture)
                .map_err(|failure| failure.to_string())?;
            record.picture = Some(place);
            if let Some(report) = report {
                let place = format!("{REPORTS}/{stem}.html");
                self.folder
                    .write(&place, &report)
                    .map_err(|failure| failure.to_string())?;
                record.report = Some(place);
            }
        }
        Ok(())
    }
}

/// Lets the checker read a certificate, which must be about the subject's curve.
fn accept(bytes: Vec<u8>, subject: &Subject) -> Result<Accepted, String> {
    match check(&bytes[..]) {
        Verdict::Accepted { document, leaves } => match &subject.source {
            Source::Curve(_, _, sha256) if curve_sha256(&document.curve) != *sha256 => {
                Err("the certificate is about another curve".into())
            }
            _ => Ok(Accepted {
                document,
                leaves,
                bytes,
            }),
        },
        Verdict::Rejected { rejection, .. } => Err(format!("the checker rejects the certificate: {rejection}")),
        Verdict::Malformed(error) => Err(format!("the checker cannot read the certificate: {error}")),
    }
}

/// What a refusal says, without the names that the batch gave to the process.
fn complaint(err: &str, subject: &Subject) -> String {
    // The parser of arguments goes on with a usage after an empty line.
    let text = err.trim().split("\n\n").next().unwrap_or_default();
    let text = text.strip_prefix("error: ").unwrap_or(text);
    let file = &subject.input;
    let names = ["standard input: ".into(), format!("{file}: "), format!("./{file}: ")];
    let text = names.iter().find_map(|name| text.strip_prefix(name)).unwrap_or(text);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
