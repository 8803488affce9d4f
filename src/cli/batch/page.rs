//! The page of a batch.

use knotproof::show::{Cell, Index, Row, index, thumbnail};

use super::record::{Record, Status};
use super::subjects::{Source, Subject};
use crate::cli::pool::guarded;

/// Its name in the folder.
pub const NAME: &str = "index.html";

/// A page with a row for each subject, and a column for each claim.
pub fn page(
    subjects: &[Subject],
    tasks: &[(usize, Option<usize>)],
    records: &[Option<Record>],
    claims: &[String],
) -> String {
    let mut rows: Vec<Row> = subjects
        .iter()
        .map(|subject| Row {
            thumbnail: match &subject.source {
                // A picture is no reason to do without the page.
                Source::Curve(_, curve, _) => guarded(|| thumbnail(curve, subject.upside_down)).unwrap_or_default(),
                _ => String::new(),
            },
            file: subject.input.clone(),
            name: subject.curve.clone().unwrap_or_default(),
            notes: subject.notes.join("; "),
            cells: vec![None; claims.len()],
        })
        .collect();
    for ((subject, claim), record) in tasks.iter().zip(records) {
        if let (Some(record), Some(cell)) = (record, rows[*subject].cells.get_mut(claim.unwrap_or_default())) {
            *cell = Some(cell_of(record));
        }
    }
    let count = |status: Status| {
        records
            .iter()
            .flatten()
            .filter(|record| record.status == status)
            .count()
    };
    let counts: Vec<String> = Status::ALL
        .iter()
        .filter(|status| count(**status) > 0)
        .map(|status| format!("{} {}", count(*status), status.name()))
        .collect();
    let answers = records.iter().flatten().count();
    let summary = format!("{} curves, {answers} answers: {}", subjects.len(), counts.join(", "));
    index(&Index {
        title: &format!("{} of {}", claims.join(", "), files(subjects)),
        summary: &summary,
        columns: claims,
        outcomes: &Status::ALL.map(Status::name),
        rows: &rows,
    })
}

/// How many files, or the name of the only one.
fn files(subjects: &[Subject]) -> String {
    let mut names: Vec<&str> = subjects.iter().map(|subject| subject.input.as_str()).collect();
    names.dedup();
    match names[..] {
        [name] => name.into(),
        _ => format!("{} files", names.len()),
    }
}

fn cell_of(record: &Record) -> Cell {
    let places = [
        ("certificate", &record.certificate),
        ("picture", &record.picture),
        ("report", &record.report),
    ];
    let links = places
        .iter()
        .filter_map(|(name, place)| Some((*name, (*place).clone()?)));
    Cell {
        outcome: record.status.name().into(),
        words: record.first_words(),
        links: links.collect(),
    }
}
