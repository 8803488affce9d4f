//! The curves that a batch is about.

use std::collections::HashSet;
use std::path::PathBuf;

use knotproof::certificate::curve_sha256;
use knotproof::curve::{Curve, CurveFile};
#[cfg(feature = "import")]
use knotproof::{
    curve::write_curve,
    import::{Format, detect},
};

use super::Order;
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::cli::pool::guarded;

/// So many characters of a name go into the name of a file.
const NAME_LENGTH: usize = 80;

/// A curve, or what could not be read as one.
pub struct Subject {
    /// The file, as it was given.
    pub input: String,
    /// The curve's name in the file.
    pub curve: Option<String>,
    /// The beginning of the names of its files in the folder; no other subject has it.
    pub base: String,
    /// What reading changed or came upon.
    pub notes: Vec<String>,
    /// One of them that may explain why nothing good is proved.
    pub suspicion: Option<String>,
    /// In files of this format y grows downwards.
    pub upside_down: bool,
    /// The curve itself.
    pub source: Source,
}

/// What is certified.
pub enum Source {
    /// A curve: a curve file of it, the curve, and its hash.
    Curve(Vec<u8>, Box<Curve>, [u8; 32]),
    /// A motion, which is read by the process that certifies it, for it may refer to other files.
    Motion(PathBuf),
    /// Nothing, for this reason.
    Unreadable(String),
}

/// All subjects of an order, and how many files of its folders were left out.
pub fn subjects(order: &Order) -> Result<(Vec<Subject>, usize), Failure> {
    let motions = order.specifications.iter().any(|each| each.claim == "motion");
    let mut all = Vec::new();
    let mut left_out = 0;
    for input in order.inputs {
        match input {
            Input::File(path) if path.is_dir() => {
                for file in input.files_in(path)? {
                    let input = Input::File(file);
                    let known = motions || is_known(&input);
                    match known {
                        true => read(order, &input, motions, &mut all),
                        false => left_out += 1,
                    }
                }
            }
            input => read(order, input, motions, &mut all),
        }
    }
    name(&mut all);
    Ok((all, left_out))
}

fn read(order: &Order, input: &Input, motions: bool, all: &mut Vec<Subject>) {
    let subject = |curve, notes, upside_down, source| Subject {
        input: input.to_string(),
        curve,
        base: stem(input),
        notes,
        suspicion: None,
        upside_down,
        source,
    };
    if motions {
        let source = match input {
            Input::File(path) => Source::Motion(path.clone()),
            Input::Standard => Source::Unreadable("a batch reads no motion from standard input; name a file".into()),
        };
        all.push(subject(None, Vec::new(), false, source));
        return;
    }
    match guarded(|| curves(order, input)) {
        Ok(Ok(curves)) => all.extend(curves.into_iter().map(|curve| {
            let source = Source::Curve(curve.file, Box::new(curve.curve), curve.sha256);
            let mut subject = subject(Some(curve.name), curve.notes, curve.upside_down, source);
            subject.suspicion = curve.suspicion;
            if curve.several
                && let Some(name) = &subject.curve
            {
                subject.base = format!("{}-{name}", subject.base);
            }
            subject
        })),
        Ok(Err(failure)) => {
            // The file is named beside the reason.
            let text = failure.to_string();
            let reason = text.strip_prefix(&format!("{input}: ")).unwrap_or(&text).to_string();
            all.push(subject(None, Vec::new(), false, Source::Unreadable(reason)));
        }
        Err(reason) => all.push(subject(None, Vec::new(), false, Source::Unreadable(reason))),
    }
}

struct Read {
    name: String,
    file: Vec<u8>,
    curve: Curve,
    sha256: [u8; 32],
    notes: Vec<String>,
    suspicion: Option<String>,
    several: bool,
    upside_down: bool,
}

/// Does a file of a folder hold curves?
#[cfg(feature = "import")]
fn is_known(input: &Input) -> bool {
    input.bytes().is_ok_and(|bytes| detect(&bytes).is_some())
}

/// Does a file of a folder hold curves?
#[cfg(not(feature = "import"))]
fn is_known(input: &Input) -> bool {
    matches!(input, Input::File(path) if path.extension().is_some_and(|ending| ending == "json"))
}

/// The curve of a curve file.
fn own(order: &Order, input: &Input, bytes: Vec<u8>) -> Result<Vec<Read>, Failure> {
    let CurveFile { name, curve, .. } = input.curve_file(&bytes, order.snap_joints)?;
    Ok(vec![Read {
        name: name.unwrap_or_else(|| stem(input)),
        sha256: curve_sha256(&curve),
        file: bytes,
        curve,
        notes: Vec::new(),
        suspicion: None,
        several: false,
        upside_down: false,
    }])
}

/// The curves of a file.
#[cfg(not(feature = "import"))]
fn curves(order: &Order, input: &Input) -> Result<Vec<Read>, Failure> {
    own(order, input, input.bytes()?)
}

/// The curves of a file.
#[cfg(feature = "import")]
fn curves(order: &Order, input: &Input) -> Result<Vec<Read>, Failure> {
    let bytes = input.bytes()?;
    match detect(&bytes) {
        None | Some(Format::Curve) => own(order, input, bytes),
        Some(format) => {
            let imported = order.reading.curves(input, &bytes, None)?;
            let several = imported.curves.len() > 1;
            let read = imported.curves.into_iter().map(|curve| Read {
                file: write_curve(&curve.curve, Some(&curve.title())).into_bytes(),
                name: curve.name,
                sha256: curve_sha256(&curve.curve),
                curve: curve.curve,
                notes: curve.notes.iter().map(ToString::to_string).collect(),
                suspicion: curve
                    .notes
                    .iter()
                    .find(|note| !note.is_change())
                    .map(ToString::to_string),
                several,
                upside_down: format == Format::Svg,
            });
            Ok(read.collect())
        }
    }
}

/// A file's name without its ending.
fn stem(input: &Input) -> String {
    match input {
        Input::Standard => "standard-input".into(),
        Input::File(path) => path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
    }
}

/// Makes file names of the bases, and no two the same, on file systems that do not tell A from a neither.
fn name(subjects: &mut [Subject]) {
    let mut taken = HashSet::new();
    for subject in subjects {
        let plain: String = subject
            .base
            .chars()
            .map(|c| {
                if c.is_ascii_alphanumeric() || "_.".contains(c) {
                    c
                } else {
                    '-'
                }
            })
            .take(NAME_LENGTH)
            .collect();
        let plain = match plain.trim_matches(['.', '-']) {
            "" => "curve",
            plain => plain,
        };
        let mut base = plain.to_string();
        let mut count = 1;
        while !taken.insert(base.to_ascii_lowercase()) {
            count += 1;
            base = format!("{plain}-{count}");
        }
        subject.base = base;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_plain_and_differ() {
        let mut subjects: Vec<Subject> = ["a", "A", "a/0 ü", "..", "", "a-2", "x.svg"]
            .map(|base| Subject {
                input: String::new(),
                curve: None,
                base: base.into(),
                notes: Vec::new(),
                suspicion: None,
                upside_down: false,
                source: Source::Unreadable(String::new()),
            })
            .into();
        name(&mut subjects);
        let bases: Vec<&str> = subjects.iter().map(|subject| subject.base.as_str()).collect();
        assert_eq!(bases, ["a", "A-2", "a-0", "curve", "curve-2", "a-2-2", "x.svg"]);
    }
}
