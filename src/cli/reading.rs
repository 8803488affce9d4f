//! Options of reading files of other formats, and the one curve that a command is about.

use clap::{Args, ValueEnum};
use knotproof::curve::CurveFile;
use knotproof::import::{Format, Imported, ImportedCurve, Options, import, import_as};
use knotproof::number::Meaning;

use super::failure::Failure;
use super::input::Input;

/// How many names of curves an error tells.
const NAMES_TOLD: usize = 8;

/// How files of other formats are read.
#[derive(Args, Clone, Default)]
pub struct Reading {
    /// Of a file with several curves, the one of this name or number (from 0): an SVG element's id, a glyph's name or character, "NAME/2" for its third part. May be given more than once where several curves are wanted.
    #[arg(long, value_name = "NAME_OR_NUMBER")]
    pub select: Vec<String>,
    /// What decimals mean in files other than curve/1, which say it themselves [default: decimal]
    #[arg(long, value_enum, value_name = "MEANING")]
    numbers: Option<Numbers>,
    /// Move path ends together that differ by no more than rounding the file's decimals explains.
    #[arg(long)]
    weld: bool,
    /// Refuse arcs and rotations that would have to be approximated.
    #[arg(long)]
    exact: bool,
    /// C1 cubics through the points of polygon files, in place of the polygons.
    #[arg(long)]
    smooth: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum Numbers {
    /// The decimal value itself
    Decimal,
    /// The nearest binary64
    Binary64,
}

impl Reading {
    fn options(&self) -> Options {
        Options {
            meaning: match self.numbers {
                Some(Numbers::Binary64) => Meaning::Binary64,
                _ => Meaning::Decimal,
            },
            exact: self.exact,
            weld: self.weld,
            smooth: self.smooth,
        }
    }

    /// All curves of a file, or those selected.
    pub fn curves(&self, input: &Input, bytes: &[u8], format: Option<Format>) -> Result<Imported, Failure> {
        let options = self.options();
        let read = match format {
            Some(format) => import_as(format, bytes, &options),
            None => import(bytes, &options),
        };
        let mut imported = read.map_err(|error| Failure::at(input, error))?;
        if imported.curves.is_empty() {
            let notes = imported.notes.join("; ");
            let notes = if notes.is_empty() { notes } else { format!(" ({notes})") };
            let format = imported.format.description();
            return Err(Failure::at(
                input,
                format!("found no curve in the {format} file{notes}"),
            ));
        }
        if !self.select.is_empty() {
            let mut chosen = Vec::new();
            for what in &self.select {
                let found = imported.select(what);
                if found.is_empty() {
                    let found = names(&imported.curves);
                    return Err(Failure::at(
                        input,
                        format!("--select: found no curve {what:?} among {found}"),
                    ));
                }
                chosen.extend(found.into_iter().filter(|i| !chosen.contains(i)).collect::<Vec<_>>());
            }
            let mut curves: Vec<Option<ImportedCurve>> = imported.curves.into_iter().map(Some).collect();
            imported.curves = chosen.into_iter().filter_map(|i| curves[i].take()).collect();
        }
        Ok(imported)
    }

    /// The one curve of a file, with its notes.
    pub fn one_curve(&self, input: &Input, bytes: &[u8]) -> Result<(CurveFile, Vec<String>), Failure> {
        let mut imported = self.curves(input, bytes, None)?;
        let curve = match imported.curves.pop() {
            Some(curve) if imported.curves.is_empty() => curve,
            last => {
                imported.curves.extend(last);
                let found = names(&imported.curves);
                let what = format!(
                    "found {found}, expected one; choose it by --select NAME_OR_NUMBER (certify takes all with --all)"
                );
                return Err(Failure::at(input, what));
            }
        };
        let file = CurveFile {
            name: Some(curve.title()),
            curve: curve.curve,
            snapped: 0,
        };
        Ok((file, curve.notes.iter().map(ToString::to_string).collect()))
    }
}

/// How many curves there are, and the first names.
fn names(curves: &[ImportedCurve]) -> String {
    let first: Vec<&str> = curves
        .iter()
        .take(NAMES_TOLD)
        .map(|curve| curve.name.as_str())
        .collect();
    let more = if curves.len() > first.len() { ", …" } else { "" };
    let s = if curves.len() == 1 { "" } else { "s" };
    format!("{} curve{s} ({}{more})", curves.len(), first.join(", "))
}
