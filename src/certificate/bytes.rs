//! A buffered source of bytes that can hash what passes.

use std::io::{self, Read};

use sha2::{Digest, Sha256};

use crate::claim::tree::ByteRead;

/// The buffer's size at first, so that little is prepared for a small certificate.
const FIRST_BUFFER: usize = 1 << 12;
/// Its size after some time.
const BUFFER: usize = 1 << 16;

/// Reads through a buffer of its own; the bytes between [`ByteSource::start_hash`] and [`ByteSource::end_hash`] are hashed.
pub struct ByteSource<R> {
    inner: R,
    buffer: Vec<u8>,
    start: usize,
    end: usize,
    hashed: usize,
    hasher: Option<Sha256>,
}

impl<R: Read> ByteSource<R> {
    /// Reads from `inner`.
    pub fn new(inner: R) -> Self {
        ByteSource {
            inner,
            buffer: vec![0; FIRST_BUFFER],
            start: 0,
            end: 0,
            hashed: 0,
            hasher: None,
        }
    }

    /// Hashes from here on.
    pub fn start_hash(&mut self) {
        self.hashed = self.start;
        self.hasher = Some(Sha256::new());
    }

    /// The hash of all bytes read since [`ByteSource::start_hash`].
    pub fn end_hash(&mut self) -> [u8; 32] {
        self.hash_consumed();
        self.hasher.take().map_or([0; 32], |hasher| hasher.finalize().into())
    }

    fn hash_consumed(&mut self) {
        if let Some(hasher) = &mut self.hasher {
            hasher.update(&self.buffer[self.hashed..self.start]);
        }
        self.hashed = self.start;
    }

    fn refill(&mut self) -> io::Result<()> {
        self.hash_consumed();
        if self.end == self.buffer.len() && self.end < BUFFER {
            self.buffer.resize(4 * self.end, 0);
        }
        self.start = 0;
        self.hashed = 0;
        self.end = 0;
        self.end = loop {
            match self.inner.read(&mut self.buffer) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                other => break other?,
            }
        };
        Ok(())
    }
}

impl<R: Read> Read for ByteSource<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        if self.start == self.end {
            self.refill()?;
        }
        let count = out.len().min(self.end - self.start);
        out[..count].copy_from_slice(&self.buffer[self.start..self.start + count]);
        self.start += count;
        Ok(count)
    }

    #[inline]
    fn read_exact(&mut self, out: &mut [u8]) -> io::Result<()> {
        if out.len() == 1 && self.start < self.end {
            out[0] = self.buffer[self.start];
            self.start += 1;
            return Ok(());
        }
        let mut done = 0;
        while done < out.len() {
            match self.read(&mut out[done..])? {
                0 => return Err(io::ErrorKind::UnexpectedEof.into()),
                count => done += count,
            }
        }
        Ok(())
    }
}

impl<R: Read> ByteRead for ByteSource<R> {
    fn ahead(&self) -> &[u8] {
        &self.buffer[self.start..self.end]
    }
    fn skip(&mut self, count: usize) {
        self.start += count;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_exactly_what_was_read() {
        let data: Vec<u8> = (0..200_000u32).map(|i| (i * 7 % 251) as u8).collect();
        let mut source = ByteSource::new(data.as_slice());
        let mut skip = [0; 100];
        source.read_exact(&mut skip).unwrap();
        source.start_hash();
        let mut part = vec![0; 150_000];
        source.read_exact(&mut part).unwrap();
        let hash = source.end_hash();
        let mut rest = Vec::new();
        source.read_to_end(&mut rest).unwrap();
        assert_eq!(hash, <[u8; 32]>::from(Sha256::digest(&data[100..150_100])));
        assert_eq!(rest, &data[150_100..]);
    }
}
