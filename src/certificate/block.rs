//! The curve block and its hash (FORMAT §7).

use std::io::{self, Write};

use sha2::{Digest, Sha256};

use super::FormatError;
use crate::claim::tree::{ByteRead, read_signed_varint, read_varint, write_signed_varint, write_varint};
use crate::curve::{BSpline, Bezier, Curve, Form, MAXIMUM_BITS, MAXIMUM_DEGREE, MAXIMUM_PIECES};
use crate::number::{Integer, RationalVector};

/// Bytes are handed on in portions of about this size.
const PORTION: usize = 1 << 16;

/// Writes the curve block.
pub fn write(curve: &Curve, out: &mut impl Write) -> io::Result<()> {
    let mut bytes = Vec::with_capacity(PORTION + 4096);
    bytes.push(curve.dimension() as u8);
    match curve.form() {
        Form::BSpline(spline) => {
            bytes.push(0);
            write_varint(&Integer::from(spline.degree()), &mut bytes);
            write_varint(&Integer::from(spline.count()), &mut bytes);
            write_vector(spline.knots(), &mut bytes, out)?;
            write_vector(spline.points(), &mut bytes, out)?;
            write_weights(spline.weights(), &mut bytes, out)?;
        }
        Form::Bezier(pieces) => {
            bytes.push(1);
            write_varint(&Integer::from(pieces.len()), &mut bytes);
            for piece in pieces {
                write_varint(&Integer::from(piece.degree()), &mut bytes);
                write_vector(piece.points(), &mut bytes, out)?;
                write_weights(piece.weights(), &mut bytes, out)?;
            }
        }
    }
    out.write_all(&bytes)
}

fn write_vector(vector: &RationalVector, bytes: &mut Vec<u8>, out: &mut impl Write) -> io::Result<()> {
    write_varint(vector.denominator(), bytes);
    for numerator in vector.numerators() {
        write_signed_varint(numerator, bytes);
        if bytes.len() >= PORTION {
            out.write_all(bytes)?;
            bytes.clear();
        }
    }
    Ok(())
}

fn write_weights(weights: Option<&RationalVector>, bytes: &mut Vec<u8>, out: &mut impl Write) -> io::Result<()> {
    match weights {
        None => {
            bytes.push(0);
            Ok(())
        }
        Some(weights) => {
            bytes.push(1);
            write_vector(weights, bytes, out)
        }
    }
}

/// The curve block in memory.
pub fn bytes(curve: &Curve) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(curve, &mut bytes).expect("memory takes all bytes");
    bytes
}

/// The SHA-256 of the curve block.
pub fn curve_sha256(curve: &Curve) -> [u8; 32] {
    sha256(&bytes(curve))
}

/// The SHA-256 of a curve block in memory.
pub fn sha256(block: &[u8]) -> [u8; 32] {
    Sha256::digest(block).into()
}

/// Lower-case hexadecimal digits.
pub fn hexadecimal(hash: &[u8; 32]) -> String {
    let digit = |value: u8| char::from(if value < 10 { b'0' + value } else { b'a' + value - 10 });
    let mut text = String::with_capacity(2 * hash.len());
    for byte in hash {
        text.push(digit(byte >> 4));
        text.push(digit(byte & 15));
    }
    text
}

/// Reads the curve block.
pub fn read(source: &mut impl ByteRead) -> Result<Curve, FormatError> {
    let dimension = usize::from(byte(source)?);
    if dimension != 2 && dimension != 3 {
        return Err(FormatError::malformed("curve block", format!("dimension {dimension}")));
    }
    let form = match byte(source)? {
        0 => {
            let degree = count(source, MAXIMUM_DEGREE, "degree")?;
            let points = count(source, MAXIMUM_PIECES, "number of points")?;
            let knots = read_vector(source, points + degree + 1)?;
            let coordinates = read_vector(source, points * dimension)?;
            let weights = read_weights(source, points)?;
            let spline = BSpline::new(dimension, degree, knots, coordinates, weights);
            Form::BSpline(spline.map_err(|error| FormatError::malformed("curve block", error.to_string()))?)
        }
        1 => {
            let pieces = count(source, MAXIMUM_PIECES, "number of pieces")?;
            let mut read = Vec::new();
            for number in 0..pieces {
                let degree = count(source, MAXIMUM_DEGREE, "degree")?;
                let coordinates = read_vector(source, (degree + 1) * dimension)?;
                let weights = read_weights(source, degree + 1)?;
                let piece = Bezier::new(dimension, coordinates, weights);
                read.push(piece.map_err(|error| {
                    FormatError::malformed(format!("curve block, piece {number}"), error.to_string())
                })?);
            }
            Form::Bezier(read)
        }
        other => return Err(FormatError::malformed("curve block", format!("form {other}"))),
    };
    Curve::new(dimension, form).map_err(|error| FormatError::malformed("curve block", error.to_string()))
}

fn byte(source: &mut impl ByteRead) -> Result<u8, FormatError> {
    let mut byte = [0];
    source.read_exact(&mut byte)?;
    Ok(byte[0])
}

fn count(source: &mut impl ByteRead, limit: usize, what: &str) -> Result<usize, FormatError> {
    let value = read_varint(source, 64)?;
    match value.to_u64() {
        Some(value) if value <= limit as u64 => Ok(value as usize),
        _ => Err(FormatError::malformed(
            "curve block",
            format!("{what} {value}, at most {limit} expected"),
        )),
    }
}

fn read_vector(source: &mut impl ByteRead, count: usize) -> Result<RationalVector, FormatError> {
    let denominator = read_varint(source, MAXIMUM_BITS)?;
    // Space is taken as the numbers come, so that a false count cannot take more than the file holds.
    let mut numerators = Vec::with_capacity(count.min(4096));
    for _ in 0..count {
        numerators.push(read_signed_varint(source, MAXIMUM_BITS)?);
    }
    let stated = denominator.clone();
    match RationalVector::from_parts(numerators, denominator) {
        Some(vector) if *vector.denominator() == stated => Ok(vector),
        _ => Err(FormatError::malformed(
            "curve block",
            "a denominator that is zero or not the least",
        )),
    }
}

fn read_weights(source: &mut impl ByteRead, count: usize) -> Result<Option<RationalVector>, FormatError> {
    match byte(source)? {
        0 => Ok(None),
        1 => read_vector(source, count).map(Some),
        other => Err(FormatError::malformed("curve block", format!("weights flag {other}"))),
    }
}
