//! Outlines of the tables `CFF ` and `CFF2`: cubics in 16.16 fixed point.

use std::collections::HashMap;

use read_fonts::FontRef;
use read_fonts::ps::cff::CffFontRef;
use read_fonts::ps::charstring::CommandSink;
use read_fonts::types::{Fixed, GlyphId, Tag};

use super::Outlines;
use crate::import::build::{Point, RawPath, RawPiece};
use crate::import::text::ratio;

/// The outlines of a font.
pub(super) struct Glyphs<'a>(CffFontRef<'a>);

/// The table with the outlines.
fn table<'a>(font: &FontRef<'a>) -> Option<CffFontRef<'a>> {
    let data = [b"CFF ", b"CFF2"]
        .into_iter()
        .find_map(|tag| font.table_data(Tag::new(tag)))?;
    CffFontRef::new(data.as_bytes(), 0, None).ok()
}

impl<'a> Glyphs<'a> {
    pub(super) fn new(font: &FontRef<'a>) -> Result<Glyphs<'a>, &'static str> {
        table(font)
            .map(Glyphs)
            .ok_or("found none of the tables glyf, CFF and CFF2, expected one of them")
    }
}

/// The names of the glyphs, as far as the table tells them.
pub(super) fn names(font: &FontRef) -> HashMap<u32, String> {
    let mut names = HashMap::new();
    let Some(table) = table(font).filter(|table| !table.is_cid()) else {
        return names;
    };
    let Some(charset) = table.charset() else {
        return names;
    };
    for (glyph, sid) in charset.iter() {
        if let Some(name) = table.string(sid).and_then(|name| std::str::from_utf8(name).ok()) {
            names.insert(glyph.to_u32(), name.to_string());
        }
    }
    names
}

impl Outlines for Glyphs<'_> {
    fn contours(&self, glyph: u32, budget: &mut usize) -> Result<Vec<RawPath>, String> {
        let glyph = GlyphId::new(glyph);
        let fault = |error: &dyn std::fmt::Display| format!("not a readable outline: {error}");
        let index = self
            .0
            .subfont_index(glyph)
            .ok_or("found no private data of the glyph")?;
        let subfont = self.0.subfont(index, &[]).map_err(|error| fault(&error))?;
        let mut pen = Pen {
            done: Vec::new(),
            open: RawPath::default(),
            start: point(Fixed::ZERO, Fixed::ZERO),
            at: point(Fixed::ZERO, Fixed::ZERO),
            left: *budget,
            full: false,
        };
        self.0
            .evaluate_charstring(&subfont, glyph, &[], &mut pen)
            .map_err(|error| fault(&error))?;
        pen.end();
        if pen.full {
            return Err("found too many pieces in all glyphs together".into());
        }
        *budget = pen.left;
        Ok(pen.done)
    }
}

fn point(x: Fixed, y: Fixed) -> Point {
    [x, y].map(|value| ratio(i64::from(value.to_bits()), 1 << 16)).into()
}

/// Takes what a charstring draws.
struct Pen {
    done: Vec<RawPath>,
    open: RawPath,
    start: Point,
    at: Point,
    left: usize,
    /// Whether there was more than the budget allows.
    full: bool,
}

impl Pen {
    fn push(&mut self, piece: RawPiece) {
        match self.left.checked_sub(1) {
            Some(left) => {
                self.left = left;
                self.open.pieces.push(piece);
            }
            None => self.full = true,
        }
    }

    /// Contours of fonts are closed, whether the charstring says so or not.
    fn end(&mut self) {
        if self.at != self.start {
            let piece = RawPiece::polynomial([self.at.clone(), self.start.clone()]);
            self.push(piece);
            self.at.clone_from(&self.start);
        }
        if !self.open.pieces.is_empty() {
            self.done.push(std::mem::take(&mut self.open));
        }
    }
}

impl CommandSink for Pen {
    fn move_to(&mut self, x: Fixed, y: Fixed) {
        self.end();
        self.start = point(x, y);
        self.at.clone_from(&self.start);
    }

    fn line_to(&mut self, x: Fixed, y: Fixed) {
        let from = std::mem::replace(&mut self.at, point(x, y));
        let to = self.at.clone();
        self.push(RawPiece::polynomial([from, to]));
    }

    fn curve_to(&mut self, cx0: Fixed, cy0: Fixed, cx1: Fixed, cy1: Fixed, x: Fixed, y: Fixed) {
        let from = std::mem::replace(&mut self.at, point(x, y));
        let to = self.at.clone();
        self.push(RawPiece::polynomial([from, point(cx0, cy0), point(cx1, cy1), to]));
    }

    fn close(&mut self) {
        self.end();
    }
}
