//! The hash of a motion: its first curve, its denominator and its moves (FORMAT §14).

use sha2::{Digest, Sha256};

use super::block::{self, hexadecimal};
use crate::claim::motion::{Move, write_move};
use crate::claim::tree::write_varint;
use crate::curve::Curve;
use crate::number::Integer;

/// The hash of a motion whose moves come one after another.
pub struct MotionHash {
    hasher: Sha256,
    dimension: usize,
    bytes: Vec<u8>,
}

impl MotionHash {
    /// Begins with the curve at time 0 and the denominator Q ≥ 1 of all displacements.
    pub fn new(curve: &Curve, denominator: &Integer) -> Self {
        let mut bytes = block::bytes(curve);
        write_varint(denominator, &mut bytes);
        let mut hasher = Sha256::new();
        hasher.update(&bytes);
        MotionHash {
            hasher,
            dimension: curve.dimension(),
            bytes,
        }
    }

    /// Takes in the next move.
    pub fn include(&mut self, displacements: &Move) {
        self.bytes.clear();
        write_move(displacements, self.dimension, &mut self.bytes);
        self.hasher.update(&self.bytes);
    }

    /// The hash as 64 lower-case hexadecimal digits.
    pub fn finish(self) -> String {
        hexadecimal(&self.hasher.finalize().into())
    }
}
