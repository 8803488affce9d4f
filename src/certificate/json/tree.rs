//! A cover tree as texts (FORMAT §5).

use std::io::{self, Read, Write};

use super::super::bytes::ByteSource;
use crate::claim::tree::{BinaryTokens, TokenSource, token_text};

/// Writes the list of tokens, whose binary spelling `tree` holds, behind `text`; what is not written yet is left in `text`.
pub fn write_tree<R: Read, W: Write>(tree: R, dimension: usize, text: &mut String, out: &mut W) -> io::Result<()> {
    let mut tokens = BinaryTokens::new(ByteSource::new(tree), dimension);
    text.push('[');
    let mut first = true;
    while let Some(token) = tokens
        .next_token()
        .map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))?
    {
        text.push_str(if first { "\n      \"" } else { ",\n      \"" });
        first = false;
        text.push_str(&token_text(&token, dimension));
        text.push('"');
        if text.len() > 1 << 16 {
            out.write_all(text.as_bytes())?;
            text.clear();
        }
    }
    text.push_str("\n    ]");
    Ok(())
}
