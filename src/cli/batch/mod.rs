//! `knotproof batch`, and `certify` of many curves: in parallel, each in a process of its own, so that one failure does not end the rest.

mod child;
mod folder;
mod interrupt;
pub mod options;
mod page;
pub mod progress;
mod record;
pub mod subjects;
mod summary;
mod words;
mod worker;

use std::collections::HashMap;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Instant;

use clap::Args;

use self::folder::Folder;
use self::options::{Many, Show};
use self::progress::Progress;
use self::record::{Record, Status, label, worst};
use self::subjects::{Source, Subject, subjects};
use self::summary::Summary;
use super::certify::output_file::Format;
use super::certify::specification::Specification;
use super::failure::Failure;
use super::input::{Input, standard_input_once};
use super::output::{say, say_json};
use super::pool;
#[cfg(feature = "import")]
use super::reading::Reading;
use super::{Exit, Printing};

/// The results in a batch's folder.
pub const RESULTS: &str = "results.jsonl";

/// Prove claims about many curves: every curve of files and folders
///
/// Each curve is read, certified, and its certificate checked again; with --show it is drawn, and the page index.html lists all. One curve that cannot be read, is
/// refused, takes too long or breaks the search down does not end the rest. The exit code is 2 when something failed, else 1 when something is refuted, else 3 when
/// something is undecided, else 0.
#[derive(Args)]
pub struct Arguments {
    /// Files with curves, of version curve/1 or of a format that `import` reads, and folders of such files; "-" is standard input.
    #[arg(value_name = "FILE", required = true)]
    files: Vec<Input>,
    /// Claims, separated by commas, with options as `certify` takes them: "embedding,msd --rel-width 1e-9". May be given several times.
    #[arg(long = "claim", visible_alias = "claims", value_name = "CLAIMS", default_value = "embedding,msd", value_parser = Specification::parse_all)]
    claims: Vec<Vec<Specification>>,
    /// The folder for certificates, results, pictures and reports. It is made where there is none.
    #[arg(long, short, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// The form of the certificates [default: json]
    #[arg(long, value_enum, requires = "output")]
    format: Option<Format>,
    /// Where a Bézier piece does not start exactly where the one before ends, move its start there.
    #[arg(long)]
    snap_joints: bool,
    #[cfg(feature = "import")]
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    many: Many,
    #[command(flatten)]
    printing: Printing,
}

/// What a batch is to do.
pub struct Order<'a> {
    /// Files and folders.
    pub inputs: &'a [Input],
    /// The claims.
    pub specifications: Vec<Specification>,
    /// The folder.
    pub output: Option<&'a Path>,
    /// The form of the certificates.
    pub format: Option<Format>,
    /// How curve files are read.
    pub snap_joints: bool,
    /// How files of other formats are read.
    #[cfg(feature = "import")]
    pub reading: &'a Reading,
    /// Options of batches.
    pub many: &'a Many,
    /// What is printed.
    pub printing: Printing,
}

/// A batch that runs.
struct Batch<'a> {
    order: &'a Order<'a>,
    folder: Folder,
    /// The claims in the names of files.
    short_labels: Vec<String>,
    /// Threads of each search.
    threads: usize,
    /// Results of an earlier run, by the names of certificates.
    earlier: HashMap<String, Record>,
}

/// Where results go as they come.
struct Streams {
    folder: Option<File>,
    file: Option<(PathBuf, File)>,
    standard_output: bool,
}

/// Runs the subcommand.
pub fn run(arguments: Arguments) -> Result<Exit, Failure> {
    let specifications: Vec<Specification> = arguments.claims.into_iter().flatten().collect();
    if specifications.iter().any(|each| each.claim == "motion") {
        return Err(Failure::new(
            "--claim: motion is about motion files, not curves; use certify motion FILE...",
        ));
    }
    perform(Order {
        inputs: &arguments.files,
        specifications,
        output: arguments.output.as_deref(),
        format: arguments.format,
        snap_joints: arguments.snap_joints,
        #[cfg(feature = "import")]
        reading: &arguments.reading,
        many: &arguments.many,
        printing: arguments.printing,
    })
}

/// Does all that is ordered.
pub fn perform(order: Order) -> Result<Exit, Failure> {
    standard_input_once(order.inputs)?;
    let start = Instant::now();
    let (subjects, left_out) = subjects(&order)?;
    if subjects.is_empty() {
        let folders: Vec<String> = order.inputs.iter().map(ToString::to_string).collect();
        return Err(Failure::at(folders.join(", "), "found no file with curves"));
    }
    let folder = Folder::new(order.output)?;
    folder.look_for_foreign_files(order.many.show.is_some())?;
    let earlier = match order.many.resume {
        true => folder.earlier(),
        false => HashMap::new(),
    };
    if let Some(show) = order.many.show {
        if show >= Show::Pictures {
            folder.make(worker::PICTURES)?;
        }
        if show == Show::Reports {
            folder.make(worker::REPORTS)?;
        }
    }
    let mut streams = Streams::new(&order, &folder)?;
    interrupt::listen();
    let workers = pool::workers(order.many.jobs);
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let batch = Batch {
        order: &order,
        folder,
        short_labels: short_labels(&order.specifications),
        threads: (cores / workers).max(1),
        earlier,
    };
    let tasks = tasks(&subjects, order.specifications.len());
    let progress = Progress::new(tasks.len(), order.printing.quiet);
    let mut records: Vec<Option<Record>> = tasks.iter().map(|_| None).collect();
    let mut failure = None;
    let work = |i: usize| batch.task(&subjects[tasks[i].0], tasks[i].1);
    pool::each(tasks.len(), workers, work, |i, record| {
        let Some(record) = record else {
            return;
        };
        progress.done(record.status.name());
        let told = match streams.standard_output {
            true => progress.aside(|| streams.tell(&record)),
            false => streams.tell(&record),
        };
        failure = failure.take().or(told.err());
        records[i] = Some(record);
    });
    drop(progress);
    if let Some(failure) = failure {
        return Err(failure);
    }
    let interrupted = records.iter().filter(|record| record.is_none()).count();
    let claims: Vec<String> = order
        .specifications
        .iter()
        .map(|each| label(&each.claim, &each.shown()))
        .collect();
    if order.many.show.is_some() {
        let page = page::page(&subjects, &tasks, &records, &claims);
        batch.folder.write(page::NAME, &page)?;
    }
    let records: Vec<Record> = records.into_iter().flatten().collect();
    batch.finish(&records, interrupted)?;
    if !order.printing.quiet && !streams.standard_output {
        say(&Summary {
            records: &records,
            claims: &claims,
            interrupted,
            left_out,
            seconds: start.elapsed().as_secs_f64(),
            folder: batch.folder.path(),
            index: order.many.show.is_some(),
        }
        .text())?;
    }
    let undone = (interrupted > 0).then_some(Status::Undecided);
    Ok(worst(records.iter().map(|record| record.status).chain(undone)))
}

/// Each subject with each claim; once where it could not be read.
fn tasks(subjects: &[Subject], claims: usize) -> Vec<(usize, Option<usize>)> {
    let mut tasks = Vec::new();
    for (i, subject) in subjects.iter().enumerate() {
        match subject.source {
            Source::Unreadable(_) => tasks.push((i, None)),
            _ => tasks.extend((0..claims).map(|claim| (i, Some(claim)))),
        }
    }
    tasks
}

/// The names of the claims, with a number where there are several of a name.
fn short_labels(specifications: &[Specification]) -> Vec<String> {
    let mut labels: Vec<String> = Vec::new();
    for each in specifications {
        let mut label = each.claim.clone();
        let mut count = 1;
        while labels.contains(&label) {
            count += 1;
            label = format!("{}-{count}", each.claim);
        }
        labels.push(label);
    }
    labels
}

impl Batch<'_> {
    /// One task, whatever happens in it.
    fn task(&self, subject: &Subject, claim: Option<usize>) -> Option<Record> {
        if interrupt::asked() {
            return None;
        }
        let failed = |reason: String| {
            let mut record = match claim {
                Some(claim) => self.begin(subject, &self.order.specifications[claim]),
                None => Record::new(&subject.input, Status::Failed),
            };
            record.reason = Some(reason);
            Some(record)
        };
        if let Source::Unreadable(reason) = &subject.source {
            return failed(reason.clone());
        }
        match pool::guarded(|| self.perform(subject, claim.unwrap_or_default())) {
            Ok(record) => record,
            Err(panic) => failed(panic),
        }
    }

    /// Puts the results in order, after a run that was not interrupted.
    fn finish(&self, records: &[Record], interrupted: usize) -> Result<(), Failure> {
        if interrupted > 0 {
            return Ok(());
        }
        let mut text = String::new();
        for record in records {
            text.push_str(&line(record)?);
        }
        self.folder.write(RESULTS, &text)
    }
}

fn line(record: &Record) -> Result<String, Failure> {
    let mut line = serde_json::to_string(record).map_err(|error| Failure::at("results", error))?;
    line.push('\n');
    Ok(line)
}

impl Streams {
    fn new(order: &Order, folder: &Folder) -> Result<Streams, Failure> {
        let dash = order.many.jsonl.as_deref() == Some(Path::new("-"));
        let file = match &order.many.jsonl {
            Some(path) if !dash => {
                let file = File::create(path);
                let file = file.map_err(|error| Failure::io(path.display(), "cannot be written", &error))?;
                Some((path.clone(), file))
            }
            _ => None,
        };
        Ok(Streams {
            folder: folder.results(order.many.resume)?,
            file,
            standard_output: order.printing.json || dash,
        })
    }

    fn tell(&mut self, record: &Record) -> Result<(), Failure> {
        let line = line(record)?;
        if let Some(file) = &mut self.folder {
            let written = file.write_all(line.as_bytes());
            written.map_err(|error| Failure::io(RESULTS, "cannot be written", &error))?;
        }
        if let Some((path, file)) = &mut self.file {
            let written = file.write_all(line.as_bytes());
            written.map_err(|error| Failure::io(path.display(), "cannot be written", &error))?;
        }
        match self.standard_output {
            true => say_json(record),
            false => Ok(()),
        }
    }
}
