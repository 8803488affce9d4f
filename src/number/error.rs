//! What can be wrong with the text of a number.

use std::error::Error;
use std::fmt;

/// Why a text was refused as a number. Texts are quoted in part when they are long.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NumberError {
    /// The text is empty.
    Empty,
    /// A character, or the end of the text, stands where the number cannot go on.
    Unexpected {
        /// The text, shortened.
        text: String,
        /// Where, in characters, the first being 1; one past the last for the end of the text.
        position: usize,
        /// What stands there; `None` for the end of the text.
        found: Option<char>,
    },
    /// NaN or an infinity.
    NotFinite {
        /// The text, shortened.
        text: String,
    },
    /// A fraction whose denominator is zero.
    ZeroDenominator {
        /// The text, shortened.
        text: String,
    },
    /// More characters than a number may have.
    TooLong {
        /// The text, shortened.
        text: String,
        /// Its length in bytes.
        length: usize,
        /// The largest length allowed.
        limit: usize,
    },
    /// A decimal or binary exponent beyond what a number may have.
    ExponentTooLarge {
        /// The text, shortened.
        text: String,
        /// The largest magnitude allowed.
        limit: u32,
    },
    /// A decimal that rounds to no finite binary64.
    Overflow {
        /// The text, shortened.
        text: String,
    },
    /// A number that is not written in its one canonical form.
    NotCanonical {
        /// The text, shortened.
        text: String,
        /// What is not canonical about it.
        reason: &'static str,
    },
}

impl NumberError {
    pub(crate) fn unexpected(text: &str, offset: usize) -> Self {
        NumberError::Unexpected {
            text: quote(text),
            position: text[..offset].chars().count() + 1,
            found: text[offset..].chars().next(),
        }
    }

    /// The error of text[start..end], which should consist of digits, at least one, and does not.
    pub(crate) fn not_digits(text: &str, start: usize, end: usize) -> Self {
        if text.is_empty() {
            return NumberError::Empty;
        }
        let digits = &text[start..end];
        let offset = digits.find(|character: char| !character.is_ascii_digit());
        NumberError::unexpected(text, start + offset.unwrap_or(digits.len()))
    }

    pub(crate) fn not_canonical(text: &str, reason: &'static str) -> Self {
        NumberError::NotCanonical {
            text: quote(text),
            reason,
        }
    }
}

/// At most 40 characters of a text.
pub(crate) fn quote(text: &str) -> String {
    const SHOWN: usize = 40;
    match text.char_indices().nth(SHOWN) {
        Some((offset, _)) => format!("{}…", &text[..offset]),
        None => text.to_owned(),
    }
}

impl fmt::Display for NumberError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NumberError::Empty => write!(formatter, "a number is expected, the text is empty"),
            NumberError::Unexpected {
                text,
                position,
                found: Some(found),
            } => {
                write!(
                    formatter,
                    "{text:?} is not a number: unexpected {found:?} at character {position}"
                )
            }
            NumberError::Unexpected { text, found: None, .. } => {
                write!(formatter, "{text:?} is not a number: it ends where a digit is expected")
            }
            NumberError::NotFinite { text } => {
                write!(formatter, "{text:?} is not a finite number")
            }
            NumberError::ZeroDenominator { text } => {
                write!(formatter, "the denominator of {text:?} is zero")
            }
            NumberError::TooLong { text, length, limit } => {
                write!(
                    formatter,
                    "the number {text:?} is {length} characters long, the limit is {limit}"
                )
            }
            NumberError::ExponentTooLarge { text, limit } => {
                write!(formatter, "the exponent of {text:?} is beyond ±{limit}")
            }
            NumberError::Overflow { text } => {
                write!(formatter, "{text:?} is beyond the largest finite binary64")
            }
            NumberError::NotCanonical { text, reason } => {
                write!(formatter, "{text:?} is not a canonical number: it has {reason}")
            }
        }
    }
}

impl Error for NumberError {}
