//! Why a file of another format was refused.

use std::fmt;

use crate::curve::{CurveError, Position};

/// The reason a file was refused, with its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ImportError {
    /// Where; nothing for the whole file.
    pub place: Option<Place>,
    /// What was found and what was expected.
    pub message: String,
}

/// A place in a file of another format.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// A line and a column.
    Position(Position),
    /// An entity of a STEP or an IGES file, by its number.
    Entity(u64),
    /// A glyph of a font, by its name or "glyph" and its index.
    Glyph(String),
    /// A JSON path.
    Path(String),
}

impl ImportError {
    /// An error that concerns the whole file.
    pub(super) fn whole(message: impl Into<String>) -> ImportError {
        ImportError {
            place: None,
            message: message.into(),
        }
    }

    /// An error at a byte of a text.
    pub(super) fn at(text: &str, offset: usize, message: impl Into<String>) -> ImportError {
        ImportError {
            place: Some(Place::Position(position(text, offset))),
            message: message.into(),
        }
    }

    /// An error at an entity.
    pub(super) fn entity(number: u64, message: impl Into<String>) -> ImportError {
        ImportError {
            place: Some(Place::Entity(number)),
            message: message.into(),
        }
    }
}

/// The line and column of a byte of a text.
pub(super) fn position(text: &str, offset: usize) -> Position {
    let before = &text.as_bytes()[..offset.min(text.len())];
    let line_start = before.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1);
    Position {
        line: 1 + before.iter().filter(|b| **b == b'\n').count(),
        column: 1 + before.len() - line_start,
    }
}

/// What is wrong with a curve, with the place inside it.
pub(super) fn curve_fault(error: &CurveError) -> String {
    format!("not a curve: {error}")
}

impl fmt::Display for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            None => {}
            Some(Place::Position(at)) => write!(f, "{at}: ")?,
            Some(Place::Entity(number)) => write!(f, "entity #{number}: ")?,
            Some(Place::Glyph(name)) => write!(f, "glyph {name}: ")?,
            Some(Place::Path(path)) if path.is_empty() => {}
            Some(Place::Path(path)) => write!(f, "{path}: ")?,
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for ImportError {}
