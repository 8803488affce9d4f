//! The JSON form, and the header of the binary form (FORMAT §4).

use std::borrow::Cow;
use std::io::{self, Read, Write};

use serde::Deserialize;
use serde::de::{self, Deserializer, Visitor};

use super::block::{self, hexadecimal};
use super::{Document, FormatError};
use crate::claim::msd::{Convention, Evidence, Interval, Lower, Side, Statement, Upper};
use crate::claim::tree::{BinaryTokens, TokenSource, canonical_integer, token_text};
use crate::curve::{BSpline, Bezier, Curve, Form, MAXIMUM_BITS, MAXIMUM_PIECES};
use crate::number::{Integer, Rational, RationalExt, RationalVector};

/// A JSON string, borrowed where it has no escapes.
struct Text<'a>(Cow<'a, str>);

impl<'de: 'a, 'a> Deserialize<'de> for Text<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Strings;
        impl<'de> Visitor<'de> for Strings {
            type Value = Text<'de>;
            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str("a string")
            }
            fn visit_borrowed_str<E: de::Error>(self, text: &'de str) -> Result<Self::Value, E> {
                Ok(Text(Cow::Borrowed(text)))
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Self::Value, E> {
                Ok(Text(Cow::Owned(text.to_owned())))
            }
        }
        deserializer.deserialize_str(Strings)
    }
}

/// `"binary"` in the header of the binary form.
struct InBlock;

impl<'de> Deserialize<'de> for InBlock {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = Text::deserialize(deserializer)?;
        if text.0 == "binary" { Ok(InBlock) } else { Err(de::Error::custom("expected \"binary\"")) }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "C: Deserialize<'de>, T: Deserialize<'de>"))]
struct RawDocument<'a, C, T> {
    #[serde(borrow)]
    knotproof: Text<'a>,
    #[serde(borrow)]
    tool: Text<'a>,
    #[serde(default, borrow, deserialize_with = "optional")]
    name: Option<Text<'a>>,
    #[serde(default, deserialize_with = "optional")]
    snapped_joints: Option<u64>,
    curve: C,
    #[serde(borrow)]
    curve_sha256: Text<'a>,
    #[serde(borrow)]
    statement: RawStatement<'a>,
    #[serde(borrow)]
    evidence: RawEvidence<'a, T>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStatement<'a> {
    #[serde(borrow)]
    claim: Text<'a>,
    #[serde(borrow)]
    convention: Text<'a>,
    #[serde(borrow)]
    lower_squared: Text<'a>,
    #[serde(borrow, deserialize_with = "required")]
    upper_squared: Option<Text<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "T: Deserialize<'de>"))]
struct RawEvidence<'a, T> {
    grid: u32,
    #[serde(deserialize_with = "required")]
    tree: Option<T>,
    #[serde(borrow, deserialize_with = "required")]
    upper: Option<RawUpper<'a>>,
}

/// A field that may be missing but not null.
fn optional<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

/// A field that may be null but not missing.
fn required<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    Option::deserialize(deserializer)
}

#[derive(Deserialize)]
#[serde(tag = "rule", rename_all = "snake_case", deny_unknown_fields)]
enum RawUpper<'a> {
    Miranda {
        #[serde(borrow)]
        s: [Text<'a>; 2],
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        first: [Text<'a>; 2],
        #[serde(borrow)]
        second: [Text<'a>; 2],
        #[serde(borrow)]
        regular: [Vec<Text<'a>>; 2],
        subdivisions: u32,
    },
    Root {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        s_side: Text<'a>,
        #[serde(borrow)]
        t: Text<'a>,
        #[serde(borrow)]
        t_side: Text<'a>,
    },
    Touch {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        t: Text<'a>,
    },
    Crossing {
        #[serde(borrow)]
        s: [Text<'a>; 2],
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        first: Vec<Text<'a>>,
        #[serde(borrow)]
        second: Vec<Text<'a>>,
    },
    CriticalRoot {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        t: Text<'a>,
    },
    CriticalInterval {
        #[serde(borrow)]
        s: Text<'a>,
        #[serde(borrow)]
        t: [Text<'a>; 2],
        #[serde(borrow)]
        regular: Vec<Text<'a>>,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCurve<'a> {
    #[serde(default, borrow, deserialize_with = "optional")]
    bspline: Option<RawSpline<'a>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    bezier: Option<RawPieces<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSpline<'a> {
    degree: usize,
    #[serde(borrow)]
    knots: Vec<Text<'a>>,
    #[serde(borrow)]
    points: Vec<Vec<Text<'a>>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    weights: Option<Vec<Text<'a>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPieces<'a> {
    #[serde(borrow)]
    pieces: Vec<RawPiece<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPiece<'a> {
    #[serde(borrow)]
    points: Vec<Vec<Text<'a>>>,
    #[serde(default, borrow, deserialize_with = "optional")]
    weights: Option<Vec<Text<'a>>>,
}

type Parsed<T> = Result<T, FormatError>;

fn rational(text: &Text, place: &str) -> Parsed<Rational> {
    let refuse = |what: String| FormatError::malformed(place, what);
    if text.0.len() > 40_000 {
        return Err(refuse("a number of more than 40,000 characters".into()));
    }
    let value = Rational::parse_canonical(&text.0)
        .map_err(|error| refuse(format!("found {:?}, expected a canonical fraction: {error}", shortened(&text.0))))?;
    if value.numer().bits() > MAXIMUM_BITS || value.denom().bits() > MAXIMUM_BITS {
        return Err(refuse(format!("a number of more than {MAXIMUM_BITS} bits")));
    }
    Ok(value)
}

fn integer(text: &Text, place: &str) -> Parsed<Integer> {
    canonical_integer(&text.0)
        .ok_or_else(|| FormatError::malformed(place, format!("found {:?}, expected a canonical integer", shortened(&text.0))))
}

fn shortened(text: &str) -> String {
    text.chars().take(60).collect()
}

fn interval(texts: &[Text; 2], place: &str) -> Parsed<Interval> {
    Ok(Interval { start: rational(&texts[0], place)?, end: rational(&texts[1], place)? })
}

fn factors(texts: &[Text; 2], place: &str) -> Parsed<[Integer; 2]> {
    Ok([integer(&texts[0], place)?, integer(&texts[1], place)?])
}

fn vector(texts: &[Text], dimension: usize, place: &str) -> Parsed<[Integer; 3]> {
    if texts.len() != dimension {
        return Err(FormatError::malformed(place, format!("found {} integers, expected {dimension}", texts.len())));
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
    vector.ok_or_else(|| FormatError::malformed(place, format!("a common denominator of more than {MAXIMUM_BITS} bits")))
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
        (Some(spline), None) => {
            let place = "curve.bspline";
            let dimension = dimension_of(&spline.points);
            let data = BSpline::new(
                dimension,
                spline.degree,
                numbers(spline.knots.iter(), "curve.bspline.knots")?,
                points(&spline.points, dimension, "curve.bspline.points")?,
                spline.weights.map(|weights| numbers(weights.iter(), "curve.bspline.weights")).transpose()?,
            );
            let data = data.map_err(|error| refuse(place, error))?;
            Curve::new(dimension, Form::BSpline(data)).map_err(|error| refuse(place, error))
        }
        (None, Some(chain)) => {
            if chain.pieces.len() > MAXIMUM_PIECES {
                return Err(FormatError::malformed("curve.bezier.pieces", "too many pieces"));
            }
            let dimension = chain.pieces.first().map_or(0, |piece| dimension_of(&piece.points));
            let mut pieces = Vec::with_capacity(chain.pieces.len());
            for (i, piece) in chain.pieces.iter().enumerate() {
                let place = format!("curve.bezier.pieces[{i}]");
                let coordinates = points(&piece.points, dimension, &place)?;
                let weights = piece.weights.as_ref().map(|weights| numbers(weights.iter(), &place)).transpose()?;
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
    pub fn into_document(self, curve: Curve, actual: &[u8; 32]) -> Parsed<Document> {
        let actual = hexadecimal(actual);
        if self.stated_hash != actual {
            return Err(FormatError::Hash { stated: shortened(&self.stated_hash), actual });
        }
        let upper = (self.upper)(curve.dimension())?;
        Ok(Document {
            tool: self.tool,
            name: self.name,
            snapped_joints: self.snapped_joints,
            curve,
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
    let statement = statement(&raw.statement)?;
    let owned = raw.evidence.upper.map(RawUpper::into_owned);
    let header = Header {
        tool: text(raw.tool),
        name: raw.name.map(text),
        snapped_joints: raw.snapped_joints,
        stated_hash: text(raw.curve_sha256),
        statement,
        grid: raw.evidence.grid,
        upper: Box::new(move |dimension| owned.map(|raw| upper(&raw, dimension)).transpose()),
        has_tree: raw.evidence.tree.is_some(),
    };
    Ok((header, raw.curve, raw.evidence.tree))
}

fn statement(raw: &RawStatement) -> Parsed<Statement> {
    if raw.claim.0 != "msd" {
        let what = format!("found {:?}, expected \"msd\"", shortened(&raw.claim.0));
        return Err(FormatError::malformed("statement.claim", what));
    }
    let convention = Convention::from_name(&raw.convention.0).ok_or_else(|| {
        let what = format!("found {:?}, expected \"smooth\" or \"critical\"", shortened(&raw.convention.0));
        FormatError::malformed("statement.convention", what)
    })?;
    let bound = |text: &Text, place: &str| {
        let value = rational(text, place)?;
        if value.numer().is_negative() { Err(FormatError::malformed(place, "negative")) } else { Ok(value) }
    };
    Ok(Statement {
        convention,
        lower_squared: match raw.lower_squared.0.as_ref() {
            "inf" => Lower::Infinite,
            _ => Lower::Finite(bound(&raw.lower_squared, "statement.lower_squared")?),
        },
        upper_squared: raw.upper_squared.as_ref().map(|text| bound(text, "statement.upper_squared")).transpose()?,
    })
}

impl RawUpper<'_> {
    /// The same without borrowing.
    fn into_owned(self) -> RawUpper<'static> {
        fn one(text: Text) -> Text<'static> {
            Text(Cow::Owned(text.0.into_owned()))
        }
        fn two(texts: [Text; 2]) -> [Text<'static>; 2] {
            texts.map(one)
        }
        fn many(texts: Vec<Text>) -> Vec<Text<'static>> {
            texts.into_iter().map(one).collect()
        }
        match self {
            RawUpper::Miranda { s, t, first, second, regular, subdivisions } => RawUpper::Miranda {
                s: two(s),
                t: two(t),
                first: two(first),
                second: two(second),
                regular: regular.map(many),
                subdivisions,
            },
            RawUpper::Root { s, s_side, t, t_side } => {
                RawUpper::Root { s: one(s), s_side: one(s_side), t: one(t), t_side: one(t_side) }
            }
            RawUpper::Touch { s, t } => RawUpper::Touch { s: one(s), t: one(t) },
            RawUpper::Crossing { s, t, first, second } => {
                RawUpper::Crossing { s: two(s), t: two(t), first: many(first), second: many(second) }
            }
            RawUpper::CriticalRoot { s, t } => RawUpper::CriticalRoot { s: one(s), t: one(t) },
            RawUpper::CriticalInterval { s, t, regular } => {
                RawUpper::CriticalInterval { s: one(s), t: two(t), regular: many(regular) }
            }
        }
    }
}

fn upper(raw: &RawUpper, dimension: usize) -> Parsed<Upper> {
    let (at_s, at_t) = ("evidence.upper.s", "evidence.upper.t");
    let side = |text: &Text, place: &str| {
        Side::from_name(&text.0).ok_or_else(|| FormatError::malformed(place, "expected \"before\" or \"after\""))
    };
    Ok(match raw {
        RawUpper::Miranda { s, t, first, second, regular, subdivisions } => Upper::Miranda {
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
        RawUpper::Touch { s, t } => Upper::Touch { s: rational(s, at_s)?, t: rational(t, at_t)? },
        RawUpper::Crossing { s, t, first, second } => Upper::Crossing {
            s: interval(s, at_s)?,
            t: interval(t, at_t)?,
            first: vector(first, dimension, "evidence.upper.first")?,
            second: vector(second, dimension, "evidence.upper.second")?,
        },
        RawUpper::CriticalRoot { s, t } => Upper::CriticalRoot { s: rational(s, at_s)?, t: rational(t, at_t)? },
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
        if error.is_eof() { FormatError::Truncated } else { FormatError::malformed(place, error.to_string()) }
    })?;
    deserializer.end().map_err(|error| FormatError::malformed("end of the document", error.to_string()))?;
    Ok(value)
}

/// Reads the JSON form; the tokens come back as texts.
pub fn read(text: &[u8]) -> Parsed<(Document, Vec<String>)> {
    let raw: RawDocument<RawCurve, Vec<String>> = parse(text)?;
    let (header, raw_curve, tree) = header_of(raw)?;
    let curve = curve(raw_curve)?;
    let hash = block::curve_sha256(&curve);
    Ok((header.into_document(curve, &hash)?, tree.unwrap_or_default()))
}

/// Reads the header of the binary form.
pub fn read_header(text: &[u8]) -> Parsed<Header> {
    let raw: RawDocument<InBlock, InBlock> = parse(text)?;
    header_of(raw).map(|(header, _, _)| header)
}

/// The header of the binary form.
pub fn header(document: &Document) -> String {
    let mut text = String::new();
    preamble(document, &mut text);
    text.push_str("  \"curve\": \"binary\",\n");
    statement_and_evidence(document, &mut text);
    text.push_str(if document.has_tree { "    \"tree\": \"binary\",\n" } else { "    \"tree\": null,\n" });
    conclusion(document, &mut text);
    text
}

/// Writes the JSON form; `tree` holds the tokens in their binary spelling.
pub fn write<R: Read, W: Write>(document: &Document, tree: R, out: &mut W) -> io::Result<()> {
    let mut text = String::new();
    preamble(document, &mut text);
    text.push_str("  \"curve\": ");
    curve_text(&document.curve, &mut text);
    text.push_str(",\n");
    statement_and_evidence(document, &mut text);
    out.write_all(text.as_bytes())?;
    text.clear();
    if document.has_tree {
        let dimension = document.curve.dimension();
        let mut tokens = BinaryTokens::new(tree, dimension);
        text.push_str("    \"tree\": [");
        let mut first = true;
        while let Some(token) = tokens.next_token().map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))? {
            text.push_str(if first { "\n      \"" } else { ",\n      \"" });
            first = false;
            text.push_str(&token_text(&token, dimension));
            text.push('"');
            if text.len() > 1 << 16 {
                out.write_all(text.as_bytes())?;
                text.clear();
            }
        }
        text.push_str("\n    ],\n");
    } else {
        text.push_str("    \"tree\": null,\n");
    }
    conclusion(document, &mut text);
    out.write_all(text.as_bytes())
}

fn string(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn preamble(document: &Document, out: &mut String) {
    out.push_str("{\n  \"knotproof\": \"certificate/1\",\n");
    out.push_str(&format!("  \"tool\": {},\n", string(&document.tool)));
    if let Some(name) = &document.name {
        out.push_str(&format!("  \"name\": {},\n", string(name)));
    }
    if let Some(snapped) = document.snapped_joints {
        out.push_str(&format!("  \"snapped_joints\": {snapped},\n"));
    }
}

fn curve_text(curve: &Curve, out: &mut String) {
    let dimension = curve.dimension();
    match curve.form() {
        Form::BSpline(spline) => {
            out.push_str(&format!("{{ \"bspline\": {{\n    \"degree\": {},\n    \"knots\": ", spline.degree()));
            list(spline.knots(), out);
            out.push_str(",\n    \"points\": ");
            point_list(spline.points(), dimension, out);
            if let Some(weights) = spline.weights() {
                out.push_str(",\n    \"weights\": ");
                list(weights, out);
            }
            out.push_str(" } }");
        }
        Form::Bezier(pieces) => {
            out.push_str("{ \"bezier\": { \"pieces\": [");
            for (i, piece) in pieces.iter().enumerate() {
                out.push_str(if i == 0 { "\n    { \"points\": " } else { ",\n    { \"points\": " });
                point_list(piece.points(), dimension, out);
                if let Some(weights) = piece.weights() {
                    out.push_str(", \"weights\": ");
                    list(weights, out);
                }
                out.push_str(" }");
            }
            out.push_str("\n  ] } }");
        }
    }
}

fn list(numbers: &RationalVector, out: &mut String) {
    for (i, number) in numbers.iter().enumerate() {
        out.push_str(if i == 0 { "[\"" } else { "\", \"" });
        out.push_str(&number.format());
    }
    out.push_str("\"]");
}

fn point_list(points: &RationalVector, dimension: usize, out: &mut String) {
    for (i, number) in points.iter().enumerate() {
        out.push_str(match (i, i % dimension) {
            (0, _) => "[[\"",
            (_, 0) => "\"], [\"",
            _ => "\", \"",
        });
        out.push_str(&number.format());
    }
    out.push_str("\"]]");
}

fn statement_and_evidence(document: &Document, out: &mut String) {
    let statement = &document.statement;
    let lower = match &statement.lower_squared {
        Lower::Infinite => "inf".to_string(),
        Lower::Finite(value) => value.format(),
    };
    let upper = statement.upper_squared.as_ref().map_or("null".to_string(), |value| string(&value.format()));
    out.push_str(&format!("  \"curve_sha256\": \"{}\",\n", hexadecimal(&block::curve_sha256(&document.curve))));
    out.push_str(&format!(
        "  \"statement\": {{ \"claim\": \"msd\", \"convention\": \"{}\",\n    \"lower_squared\": \"{lower}\",\n    \"upper_squared\": {upper} }},\n",
        statement.convention.name()
    ));
    out.push_str(&format!("  \"evidence\": {{\n    \"grid\": {},\n", document.evidence.grid));
}

fn conclusion(document: &Document, out: &mut String) {
    out.push_str("    \"upper\": ");
    match &document.evidence.upper {
        None => out.push_str("null"),
        Some(upper) => out.push_str(&upper_text(upper, document.curve.dimension())),
    }
    out.push_str(" } }\n");
}

fn upper_text(upper: &Upper, dimension: usize) -> String {
    let interval = |i: &Interval| format!("[\"{}\", \"{}\"]", i.start.format(), i.end.format());
    let integers = |v: &[Integer]| {
        let texts: Vec<String> = v.iter().map(|x| format!("\"{x}\"")).collect();
        format!("[{}]", texts.join(", "))
    };
    match upper {
        Upper::Miranda { s, t, first, second, regular, subdivisions } => format!(
            "{{ \"rule\": \"miranda\", \"s\": {}, \"t\": {},\n      \"first\": {}, \"second\": {}, \"regular\": [{}, {}], \"subdivisions\": {subdivisions} }}",
            interval(s),
            interval(t),
            integers(first),
            integers(second),
            integers(&regular[0][..dimension]),
            integers(&regular[1][..dimension]),
        ),
        Upper::Root { s, t } => format!(
            "{{ \"rule\": \"root\", \"s\": \"{}\", \"s_side\": \"{}\", \"t\": \"{}\", \"t_side\": \"{}\" }}",
            s.0.format(),
            s.1.name(),
            t.0.format(),
            t.1.name()
        ),
        Upper::Touch { s, t } => format!("{{ \"rule\": \"touch\", \"s\": \"{}\", \"t\": \"{}\" }}", s.format(), t.format()),
        Upper::Crossing { s, t, first, second } => format!(
            "{{ \"rule\": \"crossing\", \"s\": {}, \"t\": {}, \"first\": {}, \"second\": {} }}",
            interval(s),
            interval(t),
            integers(&first[..dimension]),
            integers(&second[..dimension])
        ),
        Upper::CriticalRoot { s, t } => {
            format!("{{ \"rule\": \"critical_root\", \"s\": \"{}\", \"t\": \"{}\" }}", s.format(), t.format())
        }
        Upper::CriticalInterval { s, t, regular } => format!(
            "{{ \"rule\": \"critical_interval\", \"s\": \"{}\", \"t\": {}, \"regular\": {} }}",
            s.format(),
            interval(t),
            integers(&regular[..dimension])
        ),
    }
}
