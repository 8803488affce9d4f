//! Certificates put together by hand, as JSON.

use std::io::Cursor;

use knotproof::certificate::{Document, Encoding, MotionHash, curve_sha256, read, write};
use knotproof::claim::motion::{Event, EventSource, write_event};
use knotproof::claim::tree::{Token, write_token};
use knotproof::curve::{Curve, read_curve};
use serde_json::{Map, Value, json};

/// JSON numbers as the strings a certificate wants.
pub fn exact(value: Value) -> Value {
    match value {
        Value::Number(number) => Value::String(number.to_string()),
        Value::Array(items) => items.into_iter().map(exact).collect(),
        other => other,
    }
}

/// A chain of polynomial pieces, each a list of points.
pub fn bezier(pieces: Value) -> Value {
    let pieces: Vec<Value> = exact(pieces)
        .as_array()
        .expect("a list of pieces")
        .iter()
        .map(|points| json!({ "points": points }))
        .collect();
    json!({ "bezier": { "pieces": pieces } })
}

/// A chain of straight pieces through the given points.
pub fn polygon(vertices: Value) -> Value {
    let vertices = vertices.as_array().expect("a list of points").clone();
    bezier(vertices.windows(2).map(|pair| json!([pair[0], pair[1]])).collect())
}

/// The curve of a certificate's `curve` field.
pub fn curve_of(curve: &Value) -> Option<Curve> {
    let mut file = curve.as_object()?.clone();
    file.insert("knotproof".into(), json!("curve/1"));
    read_curve(Value::Object(file).to_string()).ok().map(|file| file.curve)
}

/// The certificate's `curve` field of a curve.
pub fn field_of(curve: &Curve) -> Value {
    let file: Map<String, Value> = serde_json::from_str(&knotproof::curve::write_curve(curve, None)).expect("JSON");
    file.into_iter()
        .filter(|(key, _)| key == "bspline" || key == "bezier")
        .collect::<Map<_, _>>()
        .into()
}

/// What follows the document in the binary form: a tree, or the events of a motion.
fn streamed<S: EventSource>(document: &Document, source: &mut S) -> Vec<u8> {
    let dimension = document.curve.dimension();
    let mut bytes = Vec::new();
    if document.claim.motion().is_none() {
        while let Some(token) = source.next_token().expect("a token") {
            write_token(&token, dimension, &mut bytes);
        }
        return bytes;
    }
    while let Some(event) = source.next_event().expect("an event") {
        write_event(&event, dimension, &mut bytes);
        // A tree ends where no pair is left; of an incomplete one all there is is taken.
        let mut pairs = u64::from(matches!(event, Event::Tree(_) | Event::Edit(..)));
        while pairs > 0 {
            let Some(token) = source.next_token().expect("a token") else {
                break;
            };
            write_token(&token, dimension, &mut bytes);
            pairs = match token {
                Token::Split => pairs + 2,
                Token::First | Token::Second => pairs + 1,
                Token::Leaf(_) => pairs - 1,
            };
        }
    }
    bytes
}

/// A certificate under construction.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate(pub Value);

impl Certificate {
    /// A certificate that says nothing about a curve.
    pub fn new(curve: Value) -> Self {
        let certificate = json!({
            "knotproof": "certificate/1",
            "tool": "by hand",
            "curve": curve,
            "curve_sha256": "0".repeat(64),
            "statement": { "claim": "msd", "convention": "smooth", "lower_squared": "0", "upper_squared": null },
            "evidence": { "grid": 0, "tree": null, "upper": null }
        });
        Certificate(certificate).rehashed()
    }

    /// The certificate in these bytes, of either form.
    pub fn of_bytes(bytes: &[u8]) -> Self {
        let mut text = Vec::new();
        let (document, mut tokens) = read(Cursor::new(bytes)).expect("a certificate");
        let tree = streamed(&document, &mut tokens);
        write(&document, Cursor::new(tree), Encoding::Json, &mut text).expect("writes to memory");
        Certificate(serde_json::from_slice(&text).expect("JSON"))
    }

    /// With `value` at a JSON pointer.
    pub fn with(mut self, pointer: &str, value: Value) -> Self {
        *self.0.pointer_mut(pointer).expect(pointer) = value;
        self
    }

    /// With one more field in the object at a JSON pointer.
    pub fn with_field(mut self, pointer: &str, key: &str, value: Value) -> Self {
        let object = self.0.pointer_mut(pointer).and_then(Value::as_object_mut);
        object.expect(pointer).insert(key.into(), value);
        self
    }

    /// Without a field of the object at a JSON pointer.
    pub fn without_field(mut self, pointer: &str, key: &str) -> Self {
        let object = self.0.pointer_mut(pointer).and_then(Value::as_object_mut);
        object.expect(pointer).remove(key).expect(key);
        self
    }

    /// In the convention `critical`.
    pub fn critical(self) -> Self {
        self.with("/statement/convention", json!("critical"))
    }

    /// With a lower bound and its tree.
    pub fn lower<T: Into<Value> + Clone>(self, lower_squared: &str, tree: &[T]) -> Self {
        let tokens: Vec<Value> = tree.iter().cloned().map(Into::into).collect();
        self.with("/statement/lower_squared", json!(lower_squared))
            .with("/evidence/tree", Value::Array(tokens))
    }

    /// With another token number `i`.
    pub fn token(self, i: usize, token: &str) -> Self {
        self.with(&format!("/evidence/tree/{i}"), json!(token))
    }

    /// With an upper bound and its rule.
    pub fn upper(self, upper_squared: &str, rule: Value) -> Self {
        self.with("/statement/upper_squared", json!(upper_squared))
            .with("/evidence/upper", rule)
    }

    /// With another curve, its hash included.
    pub fn curve(self, curve: Value) -> Self {
        self.with("/curve", curve).rehashed()
    }

    /// With the hash of its curve, if that is a curve.
    pub fn rehashed(self) -> Self {
        let Some(curve) = curve_of(&self.0["curve"]) else {
            return self;
        };
        let hash: String = curve_sha256(&curve).iter().map(|byte| format!("{byte:02x}")).collect();
        self.with("/curve_sha256", json!(hash))
    }

    /// With the hash of its motion, if it can be read.
    pub fn moved(self) -> Self {
        let Ok((document, mut events)) = read(Cursor::new(self.json())) else {
            return self;
        };
        let Some(content) = document.claim.motion() else {
            return self;
        };
        let mut hash = MotionHash::new(&document.curve, &content.statement.denominator);
        while let Some(event) = events.next_event().expect("events that were read") {
            if let Event::Step(displacements) | Event::Begin(displacements) = event {
                hash.include(&displacements);
            }
        }
        self.with("/statement/motion_sha256", json!(hash.finish()))
    }

    /// Its tokens.
    pub fn tokens(&self) -> Vec<String> {
        let tree = self.0["evidence"]["tree"].as_array();
        tree.into_iter()
            .flatten()
            .map(|token| token.as_str().expect("a token").to_string())
            .collect()
    }

    /// As text.
    pub fn json(&self) -> Vec<u8> {
        let mut text = serde_json::to_string_pretty(&self.0).expect("JSON");
        text.push('\n');
        text.into_bytes()
    }

    /// In the binary form; the certificate must be well formed.
    pub fn binary(&self) -> Vec<u8> {
        let (document, mut tokens) = read(Cursor::new(self.json())).expect("well formed");
        let tree = streamed(&document, &mut tokens);
        let mut bytes = Vec::new();
        write(&document, Cursor::new(tree), Encoding::Binary, &mut bytes).expect("writes to memory");
        bytes
    }
}
