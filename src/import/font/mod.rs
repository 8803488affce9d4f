//! Glyph outlines of TrueType and OpenType fonts, in font units, each contour a curve.
//!
//! Tables and charstrings are read by `read-fonts`, whose numbers are integers, 2.14 and 16.16 fixed point; outlines are put together
//! here, so that nothing is rounded. Variable fonts are read at their default instance, hinting is not applied.

mod postscript;
mod truetype;

use std::collections::HashMap;

use read_fonts::types::GlyphId;
use read_fonts::{FontRef, TableProvider};

use super::build::{RawPath, finish};
use super::error::{ImportError, Place, curve_fault};
use super::{Format, Imported, ImportedCurve, Options};

/// The most pieces of all glyphs together, parts of composite glyphs counted each time they occur.
const MOST_PIECES: usize = 4_000_000;
/// The most characters told of one glyph.
const MOST_CHARACTERS: usize = 16;
/// The most pairs of a character and a glyph looked at.
const MOST_PAIRS: usize = 1_200_000;

/// What can be drawn: one glyph's contours by its number, and how many pieces may still come.
trait Outlines {
    /// The contours of a glyph, closed.
    fn contours(&self, glyph: u32, budget: &mut usize) -> Result<Vec<RawPath>, String>;
}

/// Reads the outlines of all glyphs.
pub(super) fn read(bytes: &[u8], options: &Options) -> Result<Imported, ImportError> {
    let whole = |error: &dyn std::fmt::Display| ImportError::whole(format!("not a readable font: {error}"));
    let font = FontRef::from_index(bytes, 0).map_err(|error| whole(&error))?;
    let count = u32::from(font.maxp().map_err(|error| whole(&error))?.num_glyphs());
    let mut names = postscript::names(&font);
    let outlines: Box<dyn Outlines> = match font.glyf() {
        Ok(_) => Box::new(truetype::Glyphs::new(&font).map_err(|error| whole(&error))?),
        Err(_) => Box::new(postscript::Glyphs::new(&font).map_err(|error| whole(&error))?),
    };
    if let Ok(post) = font.post() {
        names.extend(
            post.glyph_names()
                .map(|(glyph, name)| (glyph.to_u32(), name.to_string())),
        );
    }
    let characters = characters(&font, count);
    let mut budget = MOST_PIECES;
    let mut curves = Vec::new();
    for glyph in 0..count {
        let name = names.remove(&glyph).filter(|name| !name.is_empty());
        let name = name.unwrap_or_else(|| format!("glyph{glyph}"));
        let fault = |message: String| ImportError {
            place: Some(Place::Glyph(name.clone())),
            message,
        };
        let contours = outlines.contours(glyph, &mut budget).map_err(fault)?;
        let mut aliases = vec![name.clone()];
        for character in characters.get(&glyph).into_iter().flatten() {
            aliases.push(format!("U+{:04X}", u32::from(*character)));
            aliases.push(character.to_string());
        }
        for (contour, path) in contours.into_iter().enumerate() {
            let finished = finish(path, options).map_err(|error| fault(curve_fault(&error)))?;
            if let Some((curve, notes)) = finished {
                curves.push(ImportedCurve {
                    name: format!("{name}/{contour}"),
                    aliases: aliases.clone(),
                    curve,
                    notes,
                });
            }
        }
    }
    let mut notes = Vec::new();
    if font.fvar().is_ok() {
        notes.push("a variable font, read at its default instance".to_string());
    }
    if bytes.starts_with(b"ttcf") {
        notes.push("a collection, of which the first font was read".to_string());
    }
    Ok(Imported {
        format: Format::Font,
        curves,
        notes,
    })
}

/// The characters that each glyph stands for.
fn characters(font: &FontRef, count: u32) -> HashMap<u32, Vec<char>> {
    let mut of: HashMap<u32, Vec<char>> = HashMap::new();
    let Ok(map) = font.cmap() else {
        return of;
    };
    let Some((_, _, table)) = map.best_subtable() else {
        return of;
    };
    let pairs: Vec<(u32, GlyphId)> = table.iter().take(MOST_PAIRS).collect();
    for (code, glyph) in pairs {
        let Some(character) = char::from_u32(code).filter(|_| glyph.to_u32() < count) else {
            continue;
        };
        let list = of.entry(glyph.to_u32()).or_default();
        if list.len() < MOST_CHARACTERS && !list.contains(&character) {
            list.push(character);
        }
    }
    of
}
