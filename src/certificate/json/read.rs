//! From the texts of the JSON form to a document.

use std::borrow::Cow;

use serde::Deserialize;

use super::super::block::{self, hexadecimal};
use super::super::{Document, FormatError};
use super::raw::{InBlock, Object, RawCurve, RawDocument, RawStatement, RawUpper, Text};
use crate::claim::msd::{Convention, Evidence, Interval, Lower, Side, Statement, Upper};
use crate::claim::tree::canonical_integer;
use crate::curve::{BSpline, Bezier, Curve, Form, MAXIMUM_BITS, MAXIMUM_PIECES};
use crate::number::{Integer, Rational, RationalExt, RationalVector};

type Parsed<T> = Result<T, FormatError>;

fn rational(text: &Text, place: &str) -> Parsed<Rational> {
    let refuse = |what: String| FormatError::malformed(place, what);
    if text.0.len() > 40_000 {
        return Err(refuse("a number of more than 40,000 characters".into()));
    }
    let value = Rational::parse_canonical(&text.0).map_err(|error| {
        refuse(format!(
            "found {:?}, expected a canonical fraction: {error}",
            shortened(&text.0)
        ))
    })?;
    if value.numer().bits() > MAXIMUM_BITS || value.denom().bits() > MAXIMUM_BITS {
        return Err(refuse(format!("a number of more than {MAXIMUM_BITS} bits")));
    }
    Ok(value)
}

fn integer(text: &Text, place: &str) -> Parsed<Integer> {
    canonical_integer(&text.0)
        .filter(|integer| integer.bits() <= MAXIMUM_BITS)
        .ok_or_else(|| {
            FormatError::malformed(
                place,
                format!("found {:?}, expected a canonical integer", shortened(&text.0)),
            )
        })
}

fn shortened(text: &str) -> String {
    text.chars().take(64).collect()
}

fn interval(texts: &[Text; 2], place: &str) -> Parsed<Interval> {
    Ok(Interval {
        start: rational(&texts[0], place)?,
        end: rational(&texts[1], place)?,
    })
}

fn factors(texts: &[Text; 2], place: &str) -> Parsed<[Integer; 2]> {
    Ok([integer(&texts[0], place)?, integer(&texts[1], place)?])
}

fn vector(texts: &[Text], dimension: usize, place: &str) -> Parsed<[Integer; 3]> {
    if texts.len() != dimension {
        return Err(FormatError::malformed(
            place,
            format!("found {} integers, expected {dimension}", texts.len()),
        ));
    }
    let mut vector: [Integer; 3] = Default::default();
    for (component, text) in vector.iter_mut().zip(texts) {
        *component = integer(text, place)?;
    }
    Ok(vector)
}

fn numbers<'t, 'a: 't>(texts: impl Iterator<Item = &'t Text<'a>>, place: &str) -> Parsed<RationalVector> {
    let numbers: Vec<Rational> = texts.map(|text| rational(text, place)).collect::<Parsed<_>>()?;
    let vector = RationalVector::from_rationals_within(&numbers, MAXIMUM_BITS);
    vector
        .ok_or_else(|| FormatError::malformed(place, format!("a common denominator of more than {MAXIMUM_BITS} bits")))
}

fn points(points: &[Vec<Text>], dimension: usize, place: &str) -> Parsed<RationalVector> {
    if let Some(k) = points.iter().position(|point| point.len() != dimension) {
        let what = format!("found {} coordinates, expected {dimension}", points[k].len());
        return Err(FormatError::malformed(format!("{place}[{k}]"), what));
    }
    numbers(points.iter().flatten(), place)
}

fn curve(raw: RawCurve) -> Parsed<Curve> {
    let refuse = |place: &str, error: crate::curve::CurveError| FormatError::malformed(place, error.to_string());
    let dimension_of = |points: &[Vec<Text>]| points.first().map_or(0, Vec::len);
    match (raw.bspline, raw.bezier) {
        (Some(Object(spline)), None) => {
            let place = "curve.bspline";
            let dimension = dimension_of(&spline.points);
            let data = BSpline::new(
                dimension,
                spline.degree,
                numbers(spline.knots.iter(), "curve.bspline.knots")?,
                points(&spline.points, dimension, "curve.bspline.points")?,
                spline
                    .weights
                    .map(|weights| numbers(weights.iter(), "curve.bspline.weights"))
                    .transpose()?,
            );
            let data = data.map_err(|error| refuse(place, error))?;
            Curve::new(dimension, Form::BSpline(data)).map_err(|error| refuse(place, error))
        }
        (None, Some(Object(chain))) => {
            if chain.pieces.len() > MAXIMUM_PIECES {
                return Err(FormatError::malformed("curve.bezier.pieces", "too many pieces"));
            }
            let dimension = chain.pieces.first().map_or(0, |piece| dimension_of(&piece.0.points));
            let mut pieces = Vec::with_capacity(chain.pieces.len());
            for (i, Object(piece)) in chain.pieces.iter().enumerate() {
                let place = format!("curve.bezier.pieces[{i}]");
                let coordinates = points(&piece.points, dimension, &place)?;
                let weights = piece
                    .weights
                    .as_ref()
                    .map(|weights| numbers(weights.iter(), &place))
                    .transpose()?;
                pieces.push(Bezier::new(dimension, coordinates, weights).map_err(|error| refuse(&place, error))?);
            }
            Curve::new(dimension, Form::Bezier(pieces)).map_err(|error| refuse("curve.bezier", error))
        }
        _ => Err(FormatError::malformed("curve", "expected either bspline or bezier")),
    }
}

/// Everything of a document but the curve.
pub struct Header {
    tool: String,
    name: Option<String>,
    snapped_joints: Option<u64>,
    stated_hash: String,
    statement: Statement,
    grid: u32,
    upper: UpperTexts,
    has_tree: bool,
}

/// The upper rule once the dimension is known.
type UpperTexts = Box<dyn FnOnce(usize) -> Parsed<Option<Upper>>>;

impl Header {
    /// The document about `curve`, whose block has the hash `actual`.
    pub fn into_document(self, curve: Curve, actual: &[u8; 32]) -> Parsed<Document<'static>> {
        let actual = hexadecimal(actual);
        if self.stated_hash != actual {
            return Err(FormatError::Hash {
                stated: shortened(&self.stated_hash),
                actual,
            });
        }
        let upper = (self.upper)(curve.dimension())?;
        Ok(Document {
            tool: self.tool,
            name: self.name,
            snapped_joints: self.snapped_joints,
            curve: Cow::Owned(curve),
            statement: self.statement,
            evidence: Evidence { grid: self.grid, upper },
            has_tree: self.has_tree,
        })
    }
}

fn header_of<C, T>(raw: RawDocument<'_, C, T>) -> Parsed<(Header, C, Option<T>)> {
    if raw.knotproof.0 != "certificate/1" {
        let what = format!("found {:?}, expected \"certificate/1\"", shortened(&raw.knotproof.0));
        return Err(FormatError::malformed("knotproof", what));
    }
    let text = |text: Text| text.0.into_owned();
    let statement = statement(&raw.statement.0)?;
    let evidence = raw.evidence.0;
    let owned = evidence.upper.map(|upper| upper.0.into_owned());
    let header = Header {
        tool: text(raw.tool),
        name: raw.name.map(text),
        snapped_joints: raw.snapped_joints,
        stated_hash: text(raw.curve_sha256),
        statement,
        grid: evidence.grid,
        upper: Box::new(move |dimension| owned.map(|raw| upper(&raw, dimension)).transpose()),
        has_tree: evidence.tree.is_some(),
    };
    Ok((header, raw.curve, evidence.tree))
}

fn statement(raw: &RawStatement) -> Parsed<Statement> {
    if raw.claim.0 != "msd" {
        let what = format!("found {:?}, expected \"msd\"", shortened(&raw.claim.0));
        return Err(FormatError::malformed("statement.claim", what));
    }
    let convention = Convention::from_name(&raw.convention.0).ok_or_else(|| {
        let what = format!(
            "found {:?}, expected \"smooth\" or \"critical\"",
            shortened(&raw.convention.0)
        );
        FormatError::malformed("statement.convention", what)
    })?;
    let bound = |text: &Text, place: &str| {
        let value = rational(text, place)?;
        if value.numer().is_negative() {
            Err(FormatError::malformed(place, "negative"))
        } else {
            Ok(value)
        }
    };
    Ok(Statement {
        convention,
        lower_squared: match raw.lower_squared.0.as_ref() {
            "inf" => Lower::Infinite,
            _ => Lower::Finite(bound(&raw.lower_squared, "statement.lower_squared")?),
        },
        upper_squared: raw
            .upper_squared
            .as_ref()
            .map(|text| bound(text, "statement.upper_squared"))
            .transpose()?,
    })
}

fn upper(raw: &RawUpper, dimension: usize) -> Parsed<Upper> {
    let (at_s, at_t) = ("evidence.upper.s", "evidence.upper.t");
    let side = |text: &Text, place: &str| {
        Side::from_name(&text.0).ok_or_else(|| FormatError::malformed(place, "expected \"before\" or \"after\""))
    };
    Ok(match raw {
        RawUpper::Miranda {
            s,
            t,
            first,
            second,
            regular,
            subdivisions,
        } => Upper::Miranda {
            s: interval(s, at_s)?,
            t: interval(t, at_t)?,
            first: factors(first, "evidence.upper.first")?,
            second: factors(second, "evidence.upper.second")?,
            regular: [
                vector(&regular[0], dimension, "evidence.upper.regular[0]")?,
                vector(&regular[1], dimension, "evidence.upper.regular[1]")?,
            ],
            subdivisions: *subdivisions,
        },
        RawUpper::Root { s, s_side, t, t_side } => Upper::Root {
            s: (rational(s, at_s)?, side(s_side, "evidence.upper.s_side")?),
            t: (rational(t, at_t)?, side(t_side, "evidence.upper.t_side")?),
        },
        RawUpper::Touch { s, t } => Upper::Touch {
            s: rational(s, at_s)?,
            t: rational(t, at_t)?,
        },
        RawUpper::Crossing { s, t, first, second } => Upper::Crossing {
            s: interval(s, at_s)?,
            t: interval(t, at_t)?,
            first: vector(first, dimension, "evidence.upper.first")?,
            second: vector(second, dimension, "evidence.upper.second")?,
        },
        RawUpper::CriticalRoot { s, t } => Upper::CriticalRoot {
            s: rational(s, at_s)?,
            t: rational(t, at_t)?,
        },
        RawUpper::CriticalInterval { s, t, regular } => Upper::CriticalInterval {
            s: rational(s, at_s)?,
            t: interval(t, at_t)?,
            regular: vector(regular, dimension, "evidence.upper.regular")?,
        },
    })
}

fn parse<'a, T: Deserialize<'a>>(text: &'a [u8]) -> Parsed<T> {
    let mut deserializer = serde_json::Deserializer::from_slice(text);
    let value = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let place = error.path().to_string();
        let error = error.into_inner();
        if error.is_eof() {
            FormatError::Truncated
        } else {
            FormatError::malformed(place, error.to_string())
        }
    })?;
    deserializer
        .end()
        .map_err(|error| FormatError::malformed("end of the document", error.to_string()))?;
    Ok(value)
}

/// Reads the JSON form; the tokens come back as texts.
pub fn read(text: &[u8]) -> Parsed<(Document<'static>, Vec<String>)> {
    let Object(raw): Object<RawDocument<Object<RawCurve>, Vec<String>>> = parse(text)?;
    let (header, Object(raw_curve), tree) = header_of(raw)?;
    let curve = curve(raw_curve)?;
    let hash = block::curve_sha256(&curve);
    Ok((header.into_document(curve, &hash)?, tree.unwrap_or_default()))
}

/// Reads the header of the binary form.
pub fn read_header(text: &[u8]) -> Parsed<Header> {
    let Object(raw): Object<RawDocument<InBlock, InBlock>> = parse(text)?;
    header_of(raw).map(|(header, _, _)| header)
}
