//! `knotproof import`: curves out of files of other formats.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use knotproof::curve::{Chain, write_curve};
use knotproof::import::{Format, Imported, ImportedCurve};
use serde::Serialize;

use super::atomic_file::AtomicFile;
use super::failure::Failure;
use super::input::Input;
use super::output::{say, say_json};
use super::reading::Reading;
use super::{Exit, Printing};

/// Curves out of files of other formats, exactly
///
/// Reads SVG, TrueType and OpenType fonts, geomdl JSON, Geomview VECT, STEP, IGES, PDB and mmCIF, and lists the curves in the file, or writes them as curve files. A
/// file's decimals become the fractions they are. What had to be changed is told with each curve. Every command that takes a curve takes these files too.
#[derive(Args)]
pub struct Arguments {
    /// The file; "-" is standard input.
    file: Input,
    /// Write the curve to this curve file, or each of several to a file of its own in this directory; "-" is standard output.
    #[arg(long, short, value_name = "CURVE")]
    output: Option<PathBuf>,
    /// The format [default: as the first bytes show]
    #[arg(long, value_name = "FORMAT", value_parser = PossibleValuesParser::new(Format::ALL.map(Format::name)))]
    format: Option<String>,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    printing: Printing,
}

/// What `--json` prints.
#[derive(Serialize)]
struct ForPrograms {
    format: &'static str,
    curves: Vec<CurveLine>,
    notes: Vec<String>,
}

#[derive(Serialize)]
struct CurveLine {
    name: String,
    dimension: usize,
    pieces: usize,
    degree: usize,
    rational: bool,
    closed: bool,
    notes: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let bytes = arguments.file.bytes()?;
    let format = arguments.format.as_deref();
    let format = format.and_then(|name| Format::ALL.into_iter().find(|format| format.name() == name));
    let imported = arguments.reading.curves(&arguments.file, &bytes, format)?;
    let files = match &arguments.output {
        None => Vec::new(),
        Some(output) if output == Path::new("-") => {
            let [curve] = &imported.curves[..] else {
                let what = format!(
                    "found {} curves, expected one for standard output; choose it by --select",
                    imported.curves.len()
                );
                return Err(Failure::at(&arguments.file, what));
            };
            say(&text(curve))?;
            return Ok(Exit::Success);
        }
        Some(output) => write(&imported, output, &arguments.file)?,
    };
    let lines = imported.curves.iter().enumerate().map(|(i, curve)| {
        let file = files.get(i).map(|file| file.display().to_string());
        line(curve, file)
    });
    if arguments.printing.json {
        say_json(&ForPrograms {
            format: imported.format.name(),
            curves: lines.collect(),
            notes: imported.notes,
        })?;
    } else if !arguments.printing.quiet {
        let mut out = format!("{}: {}\n", arguments.file, imported.format.description());
        for (i, line) in lines.enumerate() {
            // Writing to a string does not fail.
            let _ = writeln!(out, "  {i}: {}", words(&line));
        }
        for note in &imported.notes {
            let _ = writeln!(out, "  {note}");
        }
        say(&out)?;
    }
    Ok(Exit::Success)
}

/// The curve file of a curve.
fn text(curve: &ImportedCurve) -> String {
    write_curve(&curve.curve, Some(&curve.title())) + "\n"
}

/// Writes one curve to a file, several, or any into a directory, to files named by number and name.
fn write(imported: &Imported, output: &Path, input: &Input) -> Result<Vec<PathBuf>, Failure> {
    if !output.is_dir() {
        let [curve] = &imported.curves[..] else {
            let what = format!(
                "found {} curves, expected one for the file {}; name a directory, or choose one by --select",
                imported.curves.len(),
                output.display()
            );
            return Err(Failure::at(input, what));
        };
        write_one(curve, output, input)?;
        return Ok(vec![output.to_path_buf()]);
    }
    let mut files = Vec::new();
    for (i, curve) in imported.curves.iter().enumerate() {
        let name: String = curve
            .name
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' })
            .take(64)
            .collect();
        let file = output.join(format!("{i:04}-{name}.json"));
        write_one(curve, &file, input)?;
        files.push(file);
    }
    Ok(files)
}

fn write_one(curve: &ImportedCurve, path: &Path, input: &Input) -> Result<(), Failure> {
    let target = AtomicFile::new(path)?;
    if let Input::File(file) = input
        && target.replaces(file)
    {
        return Err(Failure::at(
            path.display(),
            "the curve would replace the file it is read from",
        ));
    }
    let mut file = target.begin()?;
    file.write_all(text(curve).as_bytes())
        .map_err(|error| target.failure(&error))?;
    target.finish(file)?;
    Ok(())
}

fn line(curve: &ImportedCurve, file: Option<String>) -> CurveLine {
    let chain: Chain = curve.curve.chain();
    let pieces = || chain.pieces().iter();
    CurveLine {
        name: curve.name.clone(),
        dimension: curve.curve.dimension(),
        pieces: chain.count(),
        degree: pieces().map(|piece| piece.degree()).max().unwrap_or(0),
        rational: pieces().any(|piece| !piece.is_polynomial()),
        closed: curve.curve.is_closed(),
        notes: curve.notes.iter().map(ToString::to_string).collect(),
        file,
    }
}

fn words(line: &CurveLine) -> String {
    let mut text = format!(
        "{}: {}, {} piece{}, degree {}{}, {} coordinates",
        line.name,
        if line.closed { "closed" } else { "open" },
        line.pieces,
        if line.pieces == 1 { "" } else { "s" },
        line.degree,
        if line.rational { ", rational" } else { "" },
        line.dimension
    );
    for note in &line.notes {
        let _ = write!(text, "; {note}");
    }
    if let Some(file) = &line.file {
        let _ = write!(text, " -> {file}");
    }
    text
}
