//! `knotproof show`: pictures and reports.

use std::ffi::OsStr;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use knotproof::certificate::{self, Document};
use knotproof::check::{Verdict, check};
use knotproof::curve::{Curve, read_curve};
#[cfg(feature = "import")]
use knotproof::import::{Format, detect};
use knotproof::show::{Picture, Report, Scene, View, html, svg};
use serde::Serialize;

use super::atomic_file::AtomicFile;
use super::check::statement;
use super::failure::Failure;
use super::input::Input;
use super::output::{say, say_json};
#[cfg(feature = "import")]
use super::reading::Reading;
use super::{Exit, Printing};

/// Draw a curve, or what a certificate proves, as SVG or as an HTML report
///
/// A certificate is checked first; of a rejected one nothing is drawn. The HTML report is one file without references to a network: a view that
/// turns, the statement, the leaves of the cover tree, and the certificate with the checker, which checks it again in the page.
#[derive(Args)]
pub struct Arguments {
    /// A certificate, a curve, or a file of another format with a curve; "-" is standard input.
    #[arg(value_name = "FILE")]
    file: Input,
    /// Where to: a name that ends in .svg or .html. Without it an SVG drawing goes to standard output.
    #[arg(long, short, value_name = "PICTURE")]
    output: Option<PathBuf>,
    /// A view of a drawing: xy, xz, yz, x-y for a plane with y downward as in SVG files, or the direction towards the eye, as in 1,-2,1; may be given several times [default: xy, xz and yz]
    #[arg(long, value_name = "VIEW", allow_hyphen_values = true)]
    view: Vec<View>,
    /// The heading [default: the curve's name, or the file's]
    #[arg(long)]
    title: Option<String>,
    #[cfg(feature = "import")]
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    printing: Printing,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Line<'a> {
    file: String,
    picture: &'a Path,
    bytes: u64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Svg,
    Html,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let target = match &arguments.output {
        None if arguments.printing.json => {
            return Err(Failure::new("--json: name a file for the picture with -o"));
        }
        None => None,
        Some(path) => Some((AtomicFile::new(path)?, form(path)?)),
    };
    if let (Some((target, _)), Input::File(file)) = (&target, &arguments.file)
        && target.replaces(file)
    {
        return Err(Failure::at(
            target.path().display(),
            "the picture would replace what it shows",
        ));
    }
    let mut bytes = Vec::new();
    let mut source = arguments.file.open()?;
    source
        .read_to_end(&mut bytes)
        .map_err(|error| arguments.file.unreadable(&error))?;
    let subject = match subject(arguments, &bytes)? {
        Ok(subject) => subject,
        Err(reason) => {
            if !arguments.printing.quiet {
                say(&format!("rejected: {}: {reason}; nothing is drawn\n", arguments.file))?;
            }
            return Ok(Exit::Refuted);
        }
    };
    let form = target.as_ref().map_or(Form::Svg, |(_, form)| *form);
    let text = subject.draw(arguments.title.as_deref(), &arguments.view, form, &bytes);
    let Some((target, _)) = target else {
        say(&text)?;
        return Ok(Exit::Success);
    };
    let mut file = target.begin()?;
    file.write_all(text.as_bytes())
        .map_err(|error| target.failure(&error))?;
    let bytes = target.finish(file)?;
    if arguments.printing.json {
        say_json(&Line {
            file: arguments.file.to_string(),
            picture: target.path(),
            bytes,
        })?;
    } else if !arguments.printing.quiet {
        say(&format!("{}: {bytes} bytes\n", target.path().display()))?;
    }
    Ok(Exit::Success)
}

fn form(path: &Path) -> Result<Form, Failure> {
    match path.extension().and_then(OsStr::to_str) {
        Some("svg") => Ok(Form::Svg),
        Some("html" | "htm") => Ok(Form::Html),
        _ => Err(Failure::at(
            path.display(),
            "expected a name that ends in .svg or .html",
        )),
    }
}

/// What is drawn, and what is said of it.
struct Subject {
    name: String,
    scene: Scene,
    statement: Vec<String>,
    is_certificate: bool,
    binary: bool,
    /// From a file in which y grows downwards.
    upside_down: bool,
}

/// The subject of a file, or why its certificate is rejected.
fn subject(arguments: &Arguments, bytes: &[u8]) -> Result<Result<Subject, String>, Failure> {
    let input = &arguments.file;
    #[cfg(feature = "import")]
    if let Some(format) = detect(bytes).filter(|format| *format != Format::Curve) {
        let (file, notes) = arguments.reading.one_curve(input, bytes)?;
        let name = file.name.clone().unwrap_or_else(|| input.to_string());
        return Ok(Ok(Subject {
            upside_down: format == Format::Svg,
            statement: notes,
            ..of_curve(name, &file.curve)
        }));
    }
    let name = |name: Option<&String>| name.cloned().unwrap_or_else(|| input.to_string());
    let document = match check(bytes) {
        Verdict::Accepted { document, .. } => document,
        Verdict::Rejected { rejection, .. } => return Ok(Err(rejection.to_string())),
        Verdict::Malformed(error) => {
            let Ok(file) = read_curve(bytes) else {
                // A file that says it is a curve is told what is wrong with it as such.
                if String::from_utf8_lossy(bytes).contains("\"curve/1\"") {
                    input.read_curve(false)?;
                }
                return Ok(Err(error.to_string()));
            };
            return Ok(Ok(of_curve(name(file.name.as_ref()), &file.curve)));
        }
    };
    let name = name(document.name.as_ref());
    Ok(Ok(
        of_certificate(name, &document, bytes).map_err(|what| Failure::at(input, what))?
    ))
}

fn of_curve(name: String, curve: &Curve) -> Subject {
    Subject {
        name,
        scene: Scene::of_curve(curve),
        statement: Vec::new(),
        is_certificate: false,
        binary: false,
        upside_down: false,
    }
}

/// The subject of a certificate that was accepted.
fn of_certificate(name: String, document: &Document, bytes: &[u8]) -> Result<Subject, String> {
    let (_, mut tokens) = certificate::read(bytes).map_err(|error| error.to_string())?;
    let stated = statement(document);
    let mut lines = vec![format!("Proved: {}.", stated.words())];
    let exact = serde_json::to_value(&stated).map_err(|error| error.to_string())?;
    let mut fields = Vec::new();
    flatten("", &exact, &mut fields);
    lines.push(format!("In numbers: {}.", fields.join(", ")));
    Ok(Subject {
        name,
        scene: Scene::of_certificate(document, &mut tokens),
        statement: lines,
        is_certificate: true,
        binary: bytes.starts_with(b"KNOTCRT1"),
        upside_down: false,
    })
}

/// A drawing, and a report if it is wanted, of a certificate that was accepted.
pub fn drawings(
    title: &str,
    document: &Document,
    bytes: &[u8],
    report: bool,
    upside_down: bool,
) -> Result<(String, Option<String>), String> {
    let subject = || -> Result<Subject, String> {
        let subject = of_certificate(title.into(), document, bytes)?;
        Ok(Subject { upside_down, ..subject })
    };
    let picture = subject()?.draw(None, &[], Form::Svg, bytes);
    let report = match report {
        true => Some(subject()?.draw(None, &[], Form::Html, bytes)),
        false => None,
    };
    Ok((picture, report))
}

/// Field names with their values, nested ones with a point.
fn flatten(prefix: &str, value: &serde_json::Value, fields: &mut Vec<String>) {
    match value {
        serde_json::Value::Object(map) => {
            for (name, value) in map {
                let prefix = if prefix.is_empty() {
                    name.clone()
                } else {
                    format!("{prefix}.{name}")
                };
                flatten(&prefix, value, fields);
            }
        }
        serde_json::Value::String(text) => fields.push(format!("{prefix} = {text}")),
        serde_json::Value::Null => {}
        other => fields.push(format!("{prefix} = {}", other.to_string().replace('"', ""))),
    }
}

impl Subject {
    fn draw(self, title: Option<&str>, views: &[View], form: Form, bytes: &[u8]) -> String {
        let title = title.map_or(self.name, String::from);
        match form {
            Form::Svg => {
                let views = match views {
                    [] if self.upside_down => vec![View::downward()],
                    [] => View::usual(self.scene.dimension),
                    views => views.to_vec(),
                };
                let picture = Picture {
                    title,
                    caption: self.statement,
                    views,
                };
                svg(&self.scene, &picture)
            }
            Form::Html => html(
                &self.scene,
                &Report {
                    title: &title,
                    statement: &self.statement,
                    certificate: self.is_certificate.then_some(bytes),
                    file_name: if self.binary {
                        "certificate.bin"
                    } else {
                        "certificate.json"
                    },
                },
            ),
        }
    }
}
