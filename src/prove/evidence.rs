//! Writing a certificate with its tree, and having the checker read it back.

use std::io::{self, Read, Seek, SeekFrom, Write};

use tempfile::SpooledTempFile;

use super::msd::CertifyError;
use crate::certificate::{Document, Encoding, write};
use crate::check::{Verdict, check};
use crate::claim::{AsClaim, Claim};

/// Trees up to this size stay in memory.
pub const IN_MEMORY: usize = 1 << 26;

/// Writes a document with its tree to `file`, reads it back and lets the checker replay it; `same` says whether what was read is the claim
/// that was meant.
pub fn write_checked<C: AsClaim, F: Read + Write + Seek>(
    document: &Document<C>,
    tree: &mut SpooledTempFile,
    encoding: Encoding,
    file: &mut F,
    same: impl Fn(&Claim) -> bool,
) -> Result<(), CertifyError> {
    {
        let mut out = io::BufWriter::with_capacity(1 << 16, &mut *file);
        tree.seek(SeekFrom::Start(0))?;
        write(document, tree, encoding, &mut out)?;
        out.flush()?;
    }
    file.seek(SeekFrom::Start(0))?;
    match check(&mut *file) {
        Verdict::Accepted { document, .. } if same(&document.claim) => Ok(()),
        Verdict::Accepted { .. } => Err(CertifyError::Refuted("another statement was read back".into())),
        Verdict::Malformed(error) => Err(CertifyError::Refuted(error.to_string())),
        Verdict::Rejected { rejection, .. } => Err(CertifyError::Refuted(rejection.to_string())),
    }
}
