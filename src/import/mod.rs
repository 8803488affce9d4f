//! Curves out of files of other formats, exactly.
//!
//! A file's decimals become the fractions they are, never by way of binary64 unless [`Options::meaning`] asks for it. What a format
//! cannot say exactly (an arc whose centre is no fraction, a rotation by 30°) is approximated with a stated bound, told in the
//! curve's [`Note`]s, or refused under [`Options::exact`].
//!
//! ```
//! use knotproof::import::{Options, import};
//!
//! let svg = br#"<svg xmlns="http://www.w3.org/2000/svg"><circle id="ring" cx="12" cy="12" r="10"/></svg>"#;
//! let drawing = import(svg, &Options::default())?;
//! assert_eq!(drawing.curves[0].name, "ring");
//! assert!(drawing.curves[0].curve.is_closed());
//! assert_eq!(drawing.curves[0].notes, []);
//! # Ok::<(), knotproof::import::ImportError>(())
//! ```

mod build;
mod detect;
mod error;
mod font;
mod geomdl;
mod iges;
mod note;
mod protein;
mod step;
mod svg;
mod text;
mod vect;

pub use detect::{Format, detect};
pub use error::{ImportError, Place};
pub use note::Note;

use crate::curve::{Curve, ReadOptions, read_curve_with};
use crate::number::Meaning;

/// The greatest size of a file in bytes.
pub const MAXIMUM_BYTES: usize = 1 << 28;

/// How to read a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Whether decimals mean themselves, or their nearest binary64. Formats that store numbers in binary have one meaning only.
    pub meaning: Meaning,
    /// Refuse what would have to be approximated.
    pub exact: bool,
    /// Move the end of a path to its start where rounding the file's decimals explains that they differ: by at most half a unit of the
    /// last decimal for each piece, and always by one unit.
    pub weld: bool,
    /// C¹ cubics through the points of a polygon file, in place of the polygon.
    pub smooth: bool,
}

impl Default for Options {
    /// Decimals as they are written, everything else off.
    fn default() -> Self {
        Options {
            meaning: Meaning::Decimal,
            exact: false,
            weld: false,
            smooth: false,
        }
    }
}

/// The curves of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Imported {
    /// The format it was read as.
    pub format: Format,
    /// The curves, in the order of the file.
    pub curves: Vec<ImportedCurve>,
    /// What of the file is not among the curves, in words with numbers.
    pub notes: Vec<String>,
}

/// A curve of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ImportedCurve {
    /// What the file calls it; where the file has no names, its kind and its number from 0.
    pub name: String,
    /// Names that it shares with others, such as that of its glyph.
    pub aliases: Vec<String>,
    /// The curve.
    pub curve: Curve,
    /// What reading changed or came upon.
    pub notes: Vec<Note>,
}

impl ImportedCurve {
    /// The name with what was changed, as a certificate carries it.
    pub fn title(&self) -> String {
        let changes = self.notes.iter().filter(|note| note.is_change());
        let notes: Vec<String> = changes.map(Note::to_string).collect();
        match notes.is_empty() {
            true => self.name.clone(),
            false => format!("{} [{}]", self.name, notes.join("; ")),
        }
    }
}

impl Imported {
    /// The indices of the curves meant by `what`: those of that name; else those that share it; else the one of that number, from 0.
    pub fn select(&self, what: &str) -> Vec<usize> {
        let of = |test: &dyn Fn(&ImportedCurve) -> bool| -> Vec<usize> {
            let found = self.curves.iter().enumerate().filter(|(_, curve)| test(curve));
            found.map(|(i, _)| i).collect()
        };
        let named = of(&|curve| curve.name == what);
        if !named.is_empty() {
            return named;
        }
        let shared = of(&|curve| curve.aliases.iter().any(|alias| alias == what));
        if !shared.is_empty() {
            return shared;
        }
        let number = what.parse::<usize>().ok().filter(|number| *number < self.curves.len());
        number.into_iter().collect()
    }
}

/// Reads a file of whatever format its first bytes show.
///
/// # Errors
/// An unknown format, and the first fault found, with its place.
pub fn import(bytes: &[u8], options: &Options) -> Result<Imported, ImportError> {
    match detect(bytes) {
        Some(format) => import_as(format, bytes, options),
        None if bytes.starts_with(b"wOFF") || bytes.starts_with(b"wOF2") => Err(ImportError::whole(
            "found a compressed web font, expected TrueType or OpenType: decompress it first",
        )),
        None => Err(ImportError::whole(format!(
            "found no format that is known, expected one of {}",
            Format::ALL.map(Format::description).join(", ")
        ))),
    }
}

/// Reads a file of a format.
///
/// # Errors
/// The first fault found, with its place.
pub fn import_as(format: Format, bytes: &[u8], options: &Options) -> Result<Imported, ImportError> {
    if bytes.len() > MAXIMUM_BYTES {
        return Err(ImportError::whole(format!(
            "found {} bytes, expected at most {MAXIMUM_BYTES}",
            bytes.len()
        )));
    }
    let text = || {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        std::str::from_utf8(bytes).map_err(|error| {
            // What stands before the fault is UTF-8.
            let valid = std::str::from_utf8(&bytes[..error.valid_up_to()]).unwrap_or("");
            ImportError::at(valid, valid.len(), "found bytes that are not UTF-8, expected text")
        })
    };
    match format {
        Format::Curve => curve_file(bytes),
        Format::Geomdl => geomdl::read(text()?, options),
        Format::Svg => svg::read(text()?, options),
        Format::Font => font::read(bytes, options),
        Format::Vect => vect::read(text()?, options),
        Format::Step => step::read(&latin(bytes), options),
        Format::Iges => iges::read(&latin(bytes), options),
        Format::Pdb => protein::read_pdb(&latin(bytes), options),
        Format::Mmcif => protein::read_mmcif(text()?, options),
    }
}

/// Text of formats that allow ASCII only and whose files have other letters in names and comments: these become question marks, so
/// that columns stay columns.
fn latin(bytes: &[u8]) -> String {
    bytes
        .iter()
        .map(|b| if b.is_ascii() { char::from(*b) } else { '?' })
        .collect()
}

/// The curve of a curve file.
fn curve_file(bytes: &[u8]) -> Result<Imported, ImportError> {
    let file = read_curve_with(bytes, ReadOptions::default()).map_err(|error| ImportError {
        message: error.fault.to_string(),
        place: Some(Place::Path(error.path)),
    })?;
    Ok(Imported {
        format: Format::Curve,
        curves: vec![ImportedCurve {
            name: file.name.unwrap_or_else(|| "curve".into()),
            aliases: Vec::new(),
            curve: file.curve,
            notes: Vec::new(),
        }],
        notes: Vec::new(),
    })
}
