//! From the JSON document to a curve.

use serde_json::value::RawValue;

use super::document::{BSplineDocument, BezierDocument, Document, Points};
use super::error::{ReadError, ReadFault};
use super::{CurveFile, MAXIMUM_TOTAL_BITS, ReadOptions};
use crate::curve::data::joins;
use crate::curve::{BSpline, Bezier, Curve, CurveError, CurveFault, Form, MAXIMUM_BITS, MAXIMUM_PIECES};
use crate::number::{Integer, MAXIMUM_LENGTH, Meaning, Rational, RationalExt, RationalVector, parse_number};

/// The longest canonical fraction whose numerator and denominator have [`MAXIMUM_BITS`], 19,729 digits each.
const MAXIMUM_CANONICAL_LENGTH: usize = 2 * 19_729 + 2;

pub(super) fn convert(document: Document<'_>, options: ReadOptions) -> Result<CurveFile, ReadError> {
    if document.knotproof != super::VERSION {
        return Err(super::version_error(document.knotproof));
    }
    let meaning = match document.numbers.as_deref() {
        None | Some("decimal") => Meaning::Decimal,
        Some("binary64") => Meaning::Binary64,
        Some(other) => {
            let found = other.to_string();
            return Err(refuse("numbers", ReadFault::Meaning { found }));
        }
    };
    let mut numbers = Numbers { meaning, bits: 0 };
    let mut snapped = 0;
    let curve = match (document.bspline, document.bezier) {
        (None, None) => return Err(refuse("", ReadFault::NoForm)),
        (Some(_), Some(_)) => return Err(refuse("", ReadFault::TwoForms)),
        (Some(spline), None) => Curve::from(numbers.bspline(&spline)?),
        (None, Some(bezier)) => {
            let mut pieces = numbers.pieces(&bezier)?;
            if options.snap_joints {
                snapped = snap(&mut pieces, document.closed == Some(true))?;
            }
            let dimension = pieces.first().map_or(2, Bezier::dimension);
            Curve::new(dimension, Form::Bezier(pieces)).map_err(|e| refuse_curve("bezier.", e))?
        }
    };
    match document.closed {
        Some(true) if !curve.is_closed() => Err(refuse("closed", ReadFault::NotClosed)),
        Some(false) if curve.is_closed() => Err(refuse("closed", ReadFault::NotOpen)),
        _ => Ok(CurveFile {
            name: document.name,
            curve,
            snapped,
        }),
    }
}

fn refuse(path: impl Into<String>, fault: ReadFault) -> ReadError {
    ReadError {
        path: path.into(),
        fault,
    }
}

fn refuse_curve(prefix: &str, error: CurveError) -> ReadError {
    refuse(format!("{prefix}{}", error.place), ReadFault::Curve(error.fault))
}

/// Reads numbers and keeps account of their size.
struct Numbers {
    meaning: Meaning,
    bits: u64,
}

impl Numbers {
    fn bspline(&mut self, document: &BSplineDocument<'_>) -> Result<BSpline, ReadError> {
        let prefix = || "bspline.".to_string();
        check_points(&prefix, &document.points)?;
        let vector = |numbers: &mut Self, list: &[&RawValue], name: &str| {
            numbers.vector(list, &|i| format!("bspline.{name}[{i}]"))
        };
        let knots = vector(self, &document.knots, "knots")?;
        let points = self.points(&prefix, &document.points)?;
        let weights = match &document.weights {
            Some(weights) => Some(vector(self, weights, "weights")?),
            None => None,
        };
        let dimension = document.points.dimension;
        BSpline::new(dimension, document.degree, knots, points, weights).map_err(|e| refuse_curve("bspline.", e))
    }

    fn pieces(&mut self, document: &BezierDocument<'_>) -> Result<Vec<Bezier>, ReadError> {
        let found = document.pieces.len();
        if found > MAXIMUM_PIECES {
            let fault = CurveFault::TooMany { found };
            return Err(refuse("bezier.pieces", ReadFault::Curve(fault)));
        }
        let mut pieces = Vec::with_capacity(found);
        for (i, piece) in document.pieces.iter().enumerate() {
            let prefix = || format!("bezier.pieces[{i}].");
            check_points(&prefix, &piece.points)?;
            let points = self.points(&prefix, &piece.points)?;
            let weights = match &piece.weights {
                Some(list) => Some(self.vector(list, &|k| format!("{}weights[{k}]", prefix()))?),
                None => None,
            };
            let piece = Bezier::new(piece.points.dimension, points, weights).map_err(|e| refuse_curve(&prefix(), e))?;
            pieces.push(piece);
        }
        Ok(pieces)
    }

    fn points(&mut self, prefix: &dyn Fn() -> String, points: &Points<'_>) -> Result<RationalVector, ReadError> {
        let d = points.dimension;
        self.vector(&points.flat, &|i| format!("{}points[{}][{}]", prefix(), i / d, i % d))
    }

    fn vector(&mut self, list: &[&RawValue], path: &dyn Fn(usize) -> String) -> Result<RationalVector, ReadError> {
        let mut numbers = Vec::with_capacity(list.len());
        for (i, raw) in list.iter().enumerate() {
            let number = read_number(raw, self.meaning).map_err(|fault| refuse(path(i), fault))?;
            let found = number.numer().bits().max(number.denom().bits());
            if found > MAXIMUM_BITS {
                let fault = CurveFault::TooManyBits { found };
                return Err(refuse(path(i), ReadFault::Curve(fault)));
            }
            numbers.push(number);
        }
        let denominator = denominator_bits(&numbers).map_err(|(i, found)| {
            let fault = CurveFault::TooManyBits { found };
            refuse(path(i), ReadFault::Curve(fault))
        })?;
        let own: u64 = numbers.iter().map(|x| x.numer().bits()).sum();
        self.bits += own + denominator * numbers.len() as u64;
        if self.bits > MAXIMUM_TOTAL_BITS {
            let fault = ReadFault::TooLarge {
                found: self.bits,
                limit: MAXIMUM_TOTAL_BITS,
            };
            return Err(refuse(path(numbers.len() - 1), fault));
        }
        Ok(RationalVector::from_rationals(&numbers))
    }
}

/// The number of a JSON value, a string or a literal.
pub(crate) fn read_number(raw: &RawValue, meaning: Meaning) -> Result<Rational, ReadFault> {
    let text = raw.get();
    match text.as_bytes().first() {
        Some(b'"') if text.contains('\\') => {
            let plain: String = serde_json::from_str(text).map_err(|_| not_a_number("a broken string"))?;
            parse(&plain, meaning)
        }
        Some(b'"') => parse(&text[1..text.len() - 1], meaning),
        Some(b'[') => Err(not_a_number("a list")),
        Some(b'{') => Err(not_a_number("an object")),
        Some(b't' | b'f' | b'n') => Err(not_a_number(text)),
        _ => parse(text, meaning),
    }
}

fn parse(text: &str, meaning: Meaning) -> Result<Rational, ReadFault> {
    // What the writer writes may be longer than what people may.
    if (MAXIMUM_LENGTH + 1..=MAXIMUM_CANONICAL_LENGTH).contains(&text.len())
        && let Ok(number) = Rational::parse_canonical(text)
    {
        return Ok(number);
    }
    parse_number(text, meaning).map_err(ReadFault::Number)
}

fn not_a_number(found: &str) -> ReadFault {
    ReadFault::NotANumber {
        found: found.to_string(),
    }
}

/// Points there, 2 or 3 coordinates each, all the same.
fn check_points(prefix: &dyn Fn() -> String, points: &Points<'_>) -> Result<(), ReadError> {
    let (place, fault) = if points.count == 0 {
        let fault = CurveFault::PointCount { found: 0, expected: 2 };
        ("points".to_string(), fault)
    } else if points.dimension != 2 && points.dimension != 3 {
        let found = points.dimension;
        ("points[0]".to_string(), CurveFault::Dimension { found })
    } else if let Some((k, found)) = points.mixed {
        let expected = points.dimension;
        let fault = CurveFault::MixedDimensions { found, expected };
        (format!("points[{k}]"), fault)
    } else {
        return Ok(());
    };
    Err(refuse(format!("{}{place}", prefix()), ReadFault::Curve(fault)))
}

/// The size of the least common denominator, or the first number with which it exceeds the accepted size and the size
/// then, found without computing anything much larger.
fn denominator_bits(numbers: &[Rational]) -> Result<u64, (usize, u64)> {
    let mut least = Integer::ONE;
    for (i, number) in numbers.iter().enumerate() {
        let denominator = number.denom();
        if *denominator == least || (&least % denominator).is_zero() {
            continue;
        }
        least = least.lcm(denominator);
        if least.bits() > MAXIMUM_BITS {
            return Err((i, least.bits()));
        }
    }
    Ok(least.bits())
}

/// Moves the start of each piece to the end of the one before, and of the first to that of the last when `closed`.
fn snap(pieces: &mut [Bezier], closed: bool) -> Result<usize, ReadError> {
    let mut snapped = 0;
    let start = usize::from(!closed);
    for i in start..pieces.len() {
        let before = if i == 0 { pieces.len() - 1 } else { i - 1 };
        let (a, b) = (&pieces[before], &pieces[i]);
        if a.dimension() != b.dimension() || joins(a, b) {
            continue;
        }
        let d = a.dimension();
        let mut points: Vec<Rational> = b.points().iter().collect();
        points.splice(..d, a.point(a.degree()));
        let points = RationalVector::from_rationals(&points);
        let piece = Bezier::new(d, points, b.weights().cloned())
            .map_err(|e| refuse_curve(&format!("bezier.pieces[{i}]."), e))?;
        pieces[i] = piece;
        snapped += 1;
    }
    Ok(snapped)
}
