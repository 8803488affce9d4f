//! The binary form (FORMAT §7).

use std::io::{self, Read, Write};

use super::block;
use super::bytes::ByteSource;
use super::json;
use super::{Document, FormatError};
use crate::claim::AsClaim;
use crate::claim::tree::BinaryTokens;

/// The first eight bytes.
pub const MAGIC: &[u8] = b"KNOTCRT1";
/// The longest header in bytes.
const MAX_HEADER: u32 = 1 << 24;

/// Writes the binary form; `tree` holds the tokens.
pub fn write<C: AsClaim, R: Read, W: Write>(document: &Document<C>, mut tree: R, out: &mut W) -> io::Result<()> {
    let curve = block::bytes(&document.curve);
    let header = json::header(document, &block::sha256(&curve))?;
    let length = u32::try_from(header.len()).ok().filter(|length| *length <= MAX_HEADER);
    let length = length.ok_or_else(|| {
        io::Error::new(
            io::ErrorKind::InvalidInput,
            "the header of the certificate is above 16 MiB",
        )
    })?;
    out.write_all(MAGIC)?;
    out.write_all(&length.to_le_bytes())?;
    out.write_all(&header)?;
    out.write_all(&curve)?;
    if document.has_tree() {
        io::copy(&mut tree, out)?;
    }
    Ok(())
}

/// Reads the binary form behind its first eight bytes, up to the tree.
pub fn read<R: Read>(
    mut source: ByteSource<R>,
) -> Result<(Document<'static>, BinaryTokens<ByteSource<R>>), FormatError> {
    let mut length = [0; 4];
    source.read_exact(&mut length)?;
    let length = u32::from_le_bytes(length);
    if length > MAX_HEADER {
        return Err(FormatError::malformed(
            "header",
            format!("{length} bytes, at most {MAX_HEADER} expected"),
        ));
    }
    let mut header = Vec::new();
    source.by_ref().take(u64::from(length)).read_to_end(&mut header)?;
    if header.len() < length as usize {
        return Err(FormatError::Truncated);
    }
    let header = json::read_header(&header)?;
    source.start_hash();
    let curve = block::read(&mut source)?;
    let actual = source.end_hash();
    let (document, _) = header.into_document(curve, &actual)?;
    let dimension = document.curve.dimension();
    Ok((document, BinaryTokens::new(source, dimension)))
}
