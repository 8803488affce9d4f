//! The document: curve, statement and evidence, in its JSON and its binary form (FORMAT §4, §7).
//!
//! The tree is not part of [`Document`]: it is streamed, token by token, on reading and on writing.

mod binary;
mod block;
mod bytes;
mod json;
mod motion_hash;

use std::borrow::Cow;
use std::fmt;
use std::io::{self, Read, Write};

use crate::claim::motion::{Event, EventSource};
use crate::claim::tree::{BinaryTokens, Token, TokenError, TokenSource, parse_token};
use crate::claim::{AsClaim, Claim, ClaimRef};
use crate::curve::Curve;
use bytes::ByteSource;

pub use block::curve_sha256;
pub use motion_hash::MotionHash;

/// Which of the two forms a certificate is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Readable, for small certificates.
    Json,
    /// Compact and streamed, for large ones.
    Binary,
}

/// A certificate without its tree, about one claim or, as read, any.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Document<'c, C = Claim> {
    /// The program that wrote it.
    pub tool: String,
    /// A free text; proves nothing.
    pub name: Option<String>,
    /// How many joints were moved together on reading the curve; proves nothing.
    pub snapped_joints: Option<u64>,
    /// The curve.
    pub curve: Cow<'c, Curve>,
    /// What is claimed, and why.
    pub claim: C,
}

/// Why a file is not a certificate.
#[derive(Debug)]
pub enum FormatError {
    /// Reading failed.
    Io(io::Error),
    /// The file ends too early.
    Truncated,
    /// Neither the JSON form nor the binary form; with the place and what was found.
    Malformed {
        /// JSON path, or part of the binary form.
        place: String,
        /// What is wrong there.
        what: String,
    },
    /// `curve_sha256` is not the hash of the curve.
    Hash {
        /// The hash in the file.
        stated: String,
        /// The hash of the curve in the file.
        actual: String,
    },
}

impl FormatError {
    pub(crate) fn malformed(place: impl Into<String>, what: impl Into<String>) -> Self {
        FormatError::Malformed {
            place: place.into(),
            what: what.into(),
        }
    }
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FormatError::Io(error) => write!(f, "reading failed: {error}"),
            FormatError::Truncated => write!(f, "the file ends too early"),
            FormatError::Malformed { place, what } => write!(f, "{place}: {what}"),
            FormatError::Hash { stated, actual } => {
                write!(f, "curve_sha256 is {stated}, but the curve's hash is {actual}")
            }
        }
    }
}

impl std::error::Error for FormatError {}

impl From<io::Error> for FormatError {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::UnexpectedEof {
            FormatError::Truncated
        } else {
            FormatError::Io(error)
        }
    }
}

impl From<TokenError> for FormatError {
    fn from(error: TokenError) -> Self {
        match error {
            TokenError::Io(error) => FormatError::Io(error),
            TokenError::Truncated => FormatError::Truncated,
            TokenError::Malformed(what) => FormatError::malformed("binary form", what),
        }
    }
}

/// The tree, or the events, of a certificate that is being read.
pub enum Tokens<R> {
    /// Tokens as texts, already in memory.
    Json(std::vec::IntoIter<String>, usize),
    /// Events, already in memory, and the tokens of the present one as texts.
    Events(
        std::vec::IntoIter<(Event, Vec<String>)>,
        std::vec::IntoIter<String>,
        usize,
    ),
    /// Tokens still in the file.
    Binary(BinaryTokens<ByteSource<R>>),
}

impl<R: Read> TokenSource for Tokens<R> {
    fn next_token(&mut self) -> Result<Option<Token>, TokenError> {
        match self {
            Tokens::Json(texts, dimension) => texts.next().map(|text| parse_token(&text, *dimension)).transpose(),
            Tokens::Events(_, texts, dimension) => texts.next().map(|text| parse_token(&text, *dimension)).transpose(),
            Tokens::Binary(tokens) => tokens.next_token(),
        }
    }
}

impl<R: Read> EventSource for Tokens<R> {
    fn next_event(&mut self) -> Result<Option<Event>, TokenError> {
        match self {
            Tokens::Json(..) => Err(TokenError::Malformed("a token in place of an event".into())),
            Tokens::Events(events, tokens, _) => Ok(events.next().map(|(event, texts)| {
                *tokens = texts.into_iter();
                event
            })),
            Tokens::Binary(tokens) => tokens.next_event(),
        }
    }

    fn tokens_left(&self) -> bool {
        match self {
            Tokens::Json(texts, _) | Tokens::Events(_, texts, _) => texts.len() > 0,
            Tokens::Binary(tokens) => tokens.tokens_left(),
        }
    }
}

/// The largest JSON certificate that is read, in bytes.
pub const MAX_JSON_BYTES: u64 = 1 << 30;

/// Reads a certificate of either form up to its tree.
pub fn read<R: Read>(mut source: R) -> Result<(Document<'static>, Tokens<R>), FormatError> {
    let mut magic = Vec::new();
    source
        .by_ref()
        .take(binary::MAGIC.len() as u64)
        .read_to_end(&mut magic)?;
    if magic == binary::MAGIC {
        let (document, tokens) = binary::read(ByteSource::new(source))?;
        return Ok((document, Tokens::Binary(tokens)));
    }
    let mut text = magic;
    source.take(MAX_JSON_BYTES).read_to_end(&mut text)?;
    if text.len() as u64 >= MAX_JSON_BYTES {
        return Err(FormatError::malformed("file", "larger than 1 GiB"));
    }
    let (document, texts) = json::read(&text)?;
    let dimension = document.curve.dimension();
    let tokens = match texts {
        json::Texts::Tokens(texts) => Tokens::Json(texts.into_iter(), dimension),
        json::Texts::Events(events) => Tokens::Events(events.into_iter(), Vec::new().into_iter(), dimension),
    };
    Ok((document, tokens))
}

impl<C: AsClaim> Document<'_, C> {
    fn has_tree(&self) -> bool {
        match self.claim.as_claim() {
            ClaimRef::Msd(content) => content.has_tree,
            ClaimRef::Domain(_) | ClaimRef::Curvature(_) | ClaimRef::Deviation(_) | ClaimRef::Values(_) => false,
            ClaimRef::Embedding(_) | ClaimRef::Motion(_) => true,
            ClaimRef::Thickness(content) => content.has_tree(),
        }
    }
}

/// Writes a certificate; `tree` holds its tokens, or its events, in their binary spelling, and is not read if the document has neither.
///
/// # Errors
/// Those of `tree` and `out`; in the binary form, a header above 16 MiB.
pub fn write<C: AsClaim, R: Read, W: Write>(
    document: &Document<C>,
    tree: R,
    encoding: Encoding,
    out: &mut W,
) -> io::Result<()> {
    match encoding {
        Encoding::Json => json::write(document, tree, out),
        Encoding::Binary => binary::write(document, tree, out),
    }
}
