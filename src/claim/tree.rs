//! Tokens of a cover tree and their binary spelling (FORMAT §5, §7).

use std::io::{self, Read};

use crate::number::Integer;

/// The most bits a witness may have.
pub const MAX_WITNESS_BITS: u64 = 4096;

/// A leaf: its rule and its integers. Vectors have a third component 0 in the plane.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Leaf {
    /// `far n`.
    Far([Integer; 3]),
    /// `not_normal α β`.
    NotNormal([Integer; 2]),
    /// `cone n`.
    Cone([Integer; 3]),
    /// `bend α β`.
    Bend([Integer; 2]),
    /// `separate n`.
    Separate([Integer; 3]),
    /// `monotone n`.
    Monotone([Integer; 3]),
    /// `turn p q`.
    Turn(Box<[[Integer; 3]; 2]>),
    /// `pedal z₁ z₂ r l m`.
    Pedal(Box<[Integer; 5]>),
}

impl Leaf {
    /// The rule's name.
    pub fn rule(&self) -> &'static str {
        match self {
            Leaf::Far(_) => "far",
            Leaf::NotNormal(_) => "not_normal",
            Leaf::Cone(_) => "cone",
            Leaf::Bend(_) => "bend",
            Leaf::Separate(_) => "separate",
            Leaf::Monotone(_) => "monotone",
            Leaf::Turn(_) => "turn",
            Leaf::Pedal(_) => "pedal",
        }
    }

    /// Its integers, in a space of the given dimension.
    pub fn integers(&self, dimension: usize) -> impl Iterator<Item = &Integer> {
        let (first, second): (&[Integer], &[Integer]) = match self {
            Leaf::Far(n) | Leaf::Cone(n) | Leaf::Separate(n) | Leaf::Monotone(n) => (&n[..dimension], &[]),
            Leaf::NotNormal(factors) | Leaf::Bend(factors) => (factors, &[]),
            Leaf::Turn(vectors) => (&vectors[0][..dimension], &vectors[1][..dimension]),
            Leaf::Pedal(witness) => (&**witness, &[]),
        };
        first.iter().chain(second)
    }
}

/// One token of a cover tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Token {
    /// Split a pair (A, A).
    Split,
    /// Split the first node of a pair.
    First,
    /// Split the second node of a pair.
    Second,
    /// The pair is excluded by a rule.
    Leaf(Leaf),
}

/// Where tokens come from, one at a time.
pub trait TokenSource {
    /// The next token, or `None` at the end of the evidence.
    fn next_token(&mut self) -> Result<Option<Token>, TokenError>;
}

/// Why no token could be read.
#[derive(Debug)]
pub enum TokenError {
    /// The source failed.
    Io(io::Error),
    /// The source ended inside a token.
    Truncated,
    /// Not a token.
    Malformed(String),
}

impl std::fmt::Display for TokenError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            TokenError::Io(error) => write!(f, "reading failed: {error}"),
            TokenError::Truncated => write!(f, "the file ends inside a token"),
            TokenError::Malformed(what) => write!(f, "not a token: {what}"),
        }
    }
}

impl std::error::Error for TokenError {}

impl From<io::Error> for TokenError {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::UnexpectedEof {
            TokenError::Truncated
        } else {
            TokenError::Io(error)
        }
    }
}

/// Tokens in their binary spelling.
pub struct BinaryTokens<R> {
    source: R,
    dimension: usize,
}

impl<R: ByteRead> BinaryTokens<R> {
    /// Reads from `source`; vectors have `dimension` components.
    pub fn new(source: R, dimension: usize) -> Self {
        BinaryTokens { source, dimension }
    }

    /// The source, and the number of components of vectors.
    pub(super) fn parts(&mut self) -> (&mut R, usize) {
        (&mut self.source, self.dimension)
    }

    fn vector(&mut self) -> Result<[Integer; 3], TokenError> {
        let mut vector: [Integer; 3] = Default::default();
        for component in vector.iter_mut().take(self.dimension) {
            *component = self.integer()?;
        }
        Ok(vector)
    }

    fn factors(&mut self) -> Result<[Integer; 2], TokenError> {
        Ok([self.integer()?, self.integer()?])
    }

    fn integer(&mut self) -> Result<Integer, TokenError> {
        read_signed_varint(&mut self.source, MAX_WITNESS_BITS)
    }
}

fn unit_vector(axis: usize, negative: bool) -> [Integer; 3] {
    std::array::from_fn(|i| {
        Integer::from(if i != axis {
            0
        } else if negative {
            -1
        } else {
            1
        })
    })
}

fn unit_factors(code: u8) -> [Integer; 2] {
    let one = Integer::from(if code & 1 == 0 { 1 } else { -1 });
    if code & 2 == 0 {
        [one, Integer::default()]
    } else {
        [Integer::default(), one]
    }
}

impl<R: ByteRead> TokenSource for BinaryTokens<R> {
    fn next_token(&mut self) -> Result<Option<Token>, TokenError> {
        let mut byte = [0u8];
        if let Err(error) = self.source.read_exact(&mut byte) {
            return if error.kind() == io::ErrorKind::UnexpectedEof {
                Ok(None)
            } else {
                Err(error.into())
            };
        }
        let axes = 2 * self.dimension as u8;
        Ok(Some(match byte[0] {
            0x00 => Token::Split,
            0x01 => Token::First,
            0x02 => Token::Second,
            0x03 => Token::Leaf(Leaf::Far(self.vector()?)),
            0x04 => Token::Leaf(Leaf::NotNormal(self.factors()?)),
            0x05 => Token::Leaf(Leaf::Cone(self.vector()?)),
            0x06 => Token::Leaf(Leaf::Bend(self.factors()?)),
            0x07 => Token::Leaf(Leaf::Separate(self.vector()?)),
            0x08 => Token::Leaf(Leaf::Monotone(self.vector()?)),
            0x09 => Token::Leaf(Leaf::Turn(Box::new([self.vector()?, self.vector()?]))),
            0x0a => {
                let mut witness: Box<[Integer; 5]> = Default::default();
                for integer in witness.iter_mut() {
                    *integer = self.integer()?;
                }
                Token::Leaf(Leaf::Pedal(witness))
            }
            code if (0x10..0x10 + axes).contains(&code) => {
                let code = code - 0x10;
                Token::Leaf(Leaf::Far(unit_vector(usize::from(code / 2), code & 1 == 1)))
            }
            code if (0x30..0x30 + axes).contains(&code) => {
                let code = code - 0x30;
                Token::Leaf(Leaf::Separate(unit_vector(usize::from(code / 2), code & 1 == 1)))
            }
            code @ 0x20..=0x23 => Token::Leaf(Leaf::NotNormal(unit_factors(code - 0x20))),
            code => return Err(TokenError::Malformed(format!("byte {code:#04x}"))),
        }))
    }
}

/// Appends a token in its binary spelling, the shortest one.
pub fn write_token(token: &Token, dimension: usize, out: &mut Vec<u8>) {
    let leaf = match token {
        Token::Split => return out.push(0x00),
        Token::First => return out.push(0x01),
        Token::Second => return out.push(0x02),
        Token::Leaf(leaf) => leaf,
    };
    let code = match leaf {
        Leaf::Far(n) => match unit_code(&n[..dimension]) {
            Some(code) => return out.push(0x10 + code),
            None => 0x03,
        },
        Leaf::NotNormal(factors) => match unit_code(factors) {
            Some(code) => return out.push(0x20 + code),
            None => 0x04,
        },
        Leaf::Cone(_) => 0x05,
        Leaf::Bend(_) => 0x06,
        Leaf::Separate(n) => match unit_code(&n[..dimension]) {
            Some(code) => return out.push(0x30 + code),
            None => 0x07,
        },
        Leaf::Monotone(_) => 0x08,
        Leaf::Turn(_) => 0x09,
        Leaf::Pedal(_) => 0x0a,
    };
    out.push(code);
    for integer in leaf.integers(dimension) {
        write_signed_varint(integer, out);
    }
}

/// 2i for the unit vector along axis i, 2i+1 for its opposite.
fn unit_code(vector: &[Integer]) -> Option<u8> {
    let mut found = None;
    for (axis, component) in vector.iter().enumerate() {
        match (component.to_i64()?, found) {
            (0, _) => {}
            (1, None) => found = Some(2 * axis as u8),
            (-1, None) => found = Some(2 * axis as u8 + 1),
            _ => return None,
        }
    }
    found
}

/// A token as a word or words of text, as in the JSON form.
pub fn token_text(token: &Token, dimension: usize) -> String {
    match token {
        Token::Split => "split".into(),
        Token::First => "first".into(),
        Token::Second => "second".into(),
        Token::Leaf(leaf) => {
            let mut text = leaf.rule().to_string();
            for integer in leaf.integers(dimension) {
                text.push(' ');
                text.push_str(&integer.to_string());
            }
            text
        }
    }
}

/// The token of a text, as in the JSON form.
pub fn parse_token(text: &str, dimension: usize) -> Result<Token, TokenError> {
    let malformed = || TokenError::Malformed(format!("{:?}", text.chars().take(80).collect::<String>()));
    let mut words = text.split(' ');
    let rule = words.next().unwrap_or_default();
    let integers: Vec<Integer> = words
        .map(|word| canonical_integer(word).ok_or_else(malformed))
        .collect::<Result<_, _>>()?;
    let count = match rule {
        "split" | "first" | "second" => 0,
        "far" | "cone" | "separate" | "monotone" => dimension,
        "not_normal" | "bend" => 2,
        "turn" => 2 * dimension,
        "pedal" => 5,
        _ => return Err(malformed()),
    };
    if integers.len() != count || integers.iter().any(|integer| integer.bits() > MAX_WITNESS_BITS) {
        return Err(malformed());
    }
    let vector_from = |start: usize| {
        let components = integers.iter().skip(start).take(dimension);
        let mut vector: [Integer; 3] = Default::default();
        vector
            .iter_mut()
            .zip(components)
            .for_each(|(to, from)| to.clone_from(from));
        vector
    };
    let vector = || vector_from(0);
    let factors = || std::array::from_fn(|i| integers[i].clone());
    Ok(match rule {
        "split" => Token::Split,
        "first" => Token::First,
        "second" => Token::Second,
        "far" => Token::Leaf(Leaf::Far(vector())),
        "cone" => Token::Leaf(Leaf::Cone(vector())),
        "not_normal" => Token::Leaf(Leaf::NotNormal(factors())),
        "separate" => Token::Leaf(Leaf::Separate(vector())),
        "monotone" => Token::Leaf(Leaf::Monotone(vector())),
        "turn" => Token::Leaf(Leaf::Turn(Box::new([vector(), vector_from(dimension)]))),
        "pedal" => Token::Leaf(Leaf::Pedal(Box::new(std::array::from_fn(|i| integers[i].clone())))),
        _ => Token::Leaf(Leaf::Bend(factors())),
    })
}

/// An integer in its canonical spelling (FORMAT §1), of at most 20,000 digits.
pub fn canonical_integer(text: &str) -> Option<Integer> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let canonical = digits == "0" && text == "0"
        || digits.starts_with(|c: char| ('1'..='9').contains(&c)) && digits.bytes().all(|c| c.is_ascii_digit());
    if canonical && digits.len() <= 20_000 {
        text.parse().ok()
    } else {
        None
    }
}

/// Appends an unsigned varint (FORMAT §7); the number must not be negative.
pub fn write_varint(value: &Integer, out: &mut Vec<u8>) {
    if let Some(mut small) = value.to_u64() {
        while small >= 0x80 {
            out.push((small & 0x7f) as u8 | 0x80);
            small >>= 7;
        }
        out.push(small as u8);
        return;
    }
    let bytes = value.magnitude_bytes_le();
    let groups = value.bits().div_ceil(7) as usize;
    for group in 0..groups {
        let bit = 7 * group;
        let low = u16::from(bytes[bit / 8]) | u16::from(bytes.get(bit / 8 + 1).copied().unwrap_or(0)) << 8;
        let septet = (low >> (bit % 8)) as u8 & 0x7f;
        out.push(if group + 1 < groups { septet | 0x80 } else { septet });
    }
}

/// Appends a signed varint: 2n for n ≥ 0, −2n−1 for n < 0.
pub fn write_signed_varint(value: &Integer, out: &mut Vec<u8>) {
    if let Some(small) = value.to_i64() {
        // The usual zigzag form, whose value as an unsigned number is 2n or −2n−1.
        let mut zigzag = ((small << 1) ^ (small >> 63)) as u64;
        while zigzag >= 0x80 {
            out.push((zigzag & 0x7f) as u8 | 0x80);
            zigzag >>= 7;
        }
        out.push(zigzag as u8);
        return;
    }
    let doubled = value << 1u32;
    write_varint(
        &if doubled.sign().is_lt() {
            -doubled - Integer::from(1)
        } else {
            doubled
        },
        out,
    );
}

/// A source of bytes that may have some in memory.
pub trait ByteRead: Read {
    /// The bytes that are in memory, as many as there happen to be.
    fn ahead(&self) -> &[u8];
    /// Passes over bytes that are in memory.
    fn skip(&mut self, count: usize);
}

impl ByteRead for &[u8] {
    fn ahead(&self) -> &[u8] {
        self
    }
    fn skip(&mut self, count: usize) {
        *self = &self[count..];
    }
}

/// Reads a varint of at most 63 bits that is in memory as a whole; `None`, with nothing read, if it is not one.
#[inline(always)]
fn read_short_varint<R: ByteRead>(source: &mut R) -> Option<u64> {
    let ahead = source.ahead();
    let mut value = 0;
    let mut shift = 0;
    for (i, byte) in ahead[..ahead.len().min(9)].iter().enumerate() {
        value |= u64::from(byte & 0x7f) << shift;
        if *byte < 0x80 {
            if *byte == 0 && i > 0 {
                return None;
            }
            source.skip(i + 1);
            return Some(value);
        }
        shift += 7;
    }
    None
}

/// Reads an unsigned varint of at most `max_bits` bits, at least 64.
pub fn read_varint<R: ByteRead>(source: &mut R, max_bits: u64) -> Result<Integer, TokenError> {
    if let Some(short) = read_short_varint(source) {
        return Ok(Integer::from(short));
    }
    let mut small = 0u64;
    let mut bits = 0u64;
    let mut large: Vec<u8> = Vec::new();
    loop {
        let mut byte = [0u8];
        source.read_exact(&mut byte)?;
        let (septet, more) = (u64::from(byte[0] & 0x7f), byte[0] & 0x80 != 0);
        if !more && septet == 0 && bits > 0 {
            return Err(TokenError::Malformed("a padded varint".into()));
        }
        if bits > max_bits + 7 {
            return Err(TokenError::Malformed(format!("a number above {max_bits} bits")));
        }
        if bits < 56 {
            small |= septet << bits;
        } else {
            if large.is_empty() {
                large.extend_from_slice(&small.to_le_bytes()[..7]);
            }
            // From here on, septets are appended bit by bit group.
            push_septet(&mut large, bits, septet as u8);
        }
        bits += 7;
        if !more {
            let value = if large.is_empty() {
                Integer::from(small)
            } else {
                Integer::from_magnitude_bytes_le(false, &large)
            };
            if value.bits() > max_bits {
                return Err(TokenError::Malformed(format!("a number above {max_bits} bits")));
            }
            return Ok(value);
        }
    }
}

/// Adds seven bits at position `bit` to little-endian bytes.
fn push_septet(bytes: &mut Vec<u8>, bit: u64, septet: u8) {
    let index = (bit / 8) as usize;
    let wide = u16::from(septet) << (bit % 8);
    for (offset, part) in wide.to_le_bytes().into_iter().enumerate() {
        if bytes.len() <= index + offset {
            bytes.push(0);
        }
        bytes[index + offset] |= part;
    }
}

/// Reads a signed varint of at most `max_bits` bits.
#[inline]
pub fn read_signed_varint<R: ByteRead>(source: &mut R, max_bits: u64) -> Result<Integer, TokenError> {
    if let Some(short) = read_short_varint(source) {
        // ⌊short/2⌋, or its complement −⌊short/2⌋−1.
        return Ok(Integer::from((short >> 1) as i64 ^ -((short & 1) as i64)));
    }
    read_long_signed_varint(source, max_bits)
}

#[cold]
#[inline(never)]
fn read_long_signed_varint<R: ByteRead>(source: &mut R, max_bits: u64) -> Result<Integer, TokenError> {
    let value = read_varint(source, max_bits + 1)?;
    if let Some(small) = value.to_u64() {
        let magnitude = i64::try_from(small >> 1).expect("half of a 64-bit number");
        return Ok(Integer::from(if small & 1 == 0 { magnitude } else { -magnitude - 1 }));
    }
    let half = &value >> 1u32;
    let value = if (&half << 1u32) == value {
        half
    } else {
        -half - Integer::from(1)
    };
    // −2^bits has one bit more than its varint suggests.
    if value.bits() > max_bits {
        Err(TokenError::Malformed(format!("a number above {max_bits} bits")))
    } else {
        Ok(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn varints_round_trip(bytes in proptest::collection::vec(any::<u8>(), 0..40), negative: bool) {
            let value = Integer::from_magnitude_bytes_le(negative, &bytes);
            let mut out = Vec::new();
            write_signed_varint(&value, &mut out);
            let mut source = out.as_slice();
            prop_assert_eq!(read_signed_varint(&mut source, 1000).unwrap(), value);
            prop_assert!(source.is_empty());
        }

        #[test]
        fn tokens_round_trip(kind in 0..9u8, a: i64, b in -3i64..3, c in -100i64..100, planar: bool) {
            let dimension = if planar { 2 } else { 3 };
            let vector = [a.into(), b.into(), if planar { 0.into() } else { c.into() }];
            let factors = [Integer::from(b), Integer::from(c)];
            let token = match kind {
                0 => Token::Split,
                1 => Token::First,
                2 => Token::Second,
                3 => Token::Leaf(Leaf::Far(vector)),
                4 => Token::Leaf(Leaf::NotNormal(factors)),
                5 => Token::Leaf(Leaf::Cone(vector)),
                7 => Token::Leaf(Leaf::Separate(vector)),
                8 => Token::Leaf(Leaf::Monotone(vector)),
                _ => Token::Leaf(Leaf::Bend(factors)),
            };
            let mut bytes = Vec::new();
            write_token(&token, dimension, &mut bytes);
            let mut tokens = BinaryTokens::new(bytes.as_slice(), dimension);
            prop_assert_eq!(tokens.next_token().unwrap(), Some(token.clone()));
            prop_assert_eq!(tokens.next_token().unwrap(), None);
            prop_assert_eq!(parse_token(&token_text(&token, dimension), dimension).unwrap(), token);
        }
    }

    #[test]
    fn unit_witnesses_take_one_byte() {
        for (text, byte) in [
            ("far 0 -1 0", 0x13),
            ("not_normal 0 -1", 0x23),
            ("not_normal 1 0", 0x20),
            ("separate 0 0 -1", 0x35),
        ] {
            let mut bytes = Vec::new();
            write_token(&parse_token(text, 3).unwrap(), 3, &mut bytes);
            assert_eq!(bytes, [byte]);
        }
    }

    #[test]
    fn other_spellings_are_refused() {
        for text in [
            "",
            "far",
            "far 1 2",
            "far 1 2 3 4",
            "far 01 0 0",
            "far +1 0 0",
            "far 1  0 0",
            "far -0 0 1",
            "bend 1 x",
            "Split",
            "split ",
        ] {
            assert!(parse_token(text, 3).is_err(), "{text:?}");
        }
        assert!(read_varint(&mut [0x80u8, 0x00].as_slice(), 64).is_err());
        assert!(matches!(
            read_varint(&mut [0x80u8].as_slice(), 64),
            Err(TokenError::Truncated)
        ));
        assert!(read_varint(&mut [0xffu8; 30].as_slice(), 64).is_err());
    }
}
