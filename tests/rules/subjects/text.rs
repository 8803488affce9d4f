//! The JSON form: versions, fields, spellings, damage.

use knotproof::certificate::FormatError;
use serde_json::{Value, json};

use super::curve::NOT_CANONICAL;
use super::{channel, channel_root};
use crate::common::case::{Case, Cases};
use crate::common::document::Certificate;

fn malformed(error: &FormatError) -> bool {
    matches!(error, FormatError::Malformed { .. })
}

/// Cases of the text.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("text");
    let both = || channel().upper("9", channel_root());
    cases.accept("plain", &both());
    cases.accept(
        "with-a-name",
        &both()
            .with_field("", "name", json!("Kanal \u{1F9F5} \"quoted\" \\ \u{0}"))
            .with_field("", "snapped_joints", json!(3)),
    );
    for (name, version) in [
        ("version-2", "certificate/2"),
        ("version-of-a-curve", "curve/1"),
        ("no-version", ""),
        ("version-with-a-space", "certificate/1 "),
    ] {
        cases.malformed(name, both().with("/knotproof", json!(version)).json(), malformed);
    }
    for (pointer, place) in [
        ("", "document"),
        ("/statement", "statement"),
        ("/evidence", "evidence"),
        ("/evidence/upper", "upper"),
        ("/curve", "curve"),
        ("/curve/bezier", "bezier"),
        ("/curve/bezier/pieces/0", "piece"),
    ] {
        cases.malformed(
            &format!("unknown-field-in-{place}"),
            both().with_field(pointer, "comment", json!("?")).json(),
            malformed,
        );
    }
    for (pointer, key) in [
        ("", "knotproof"),
        ("", "tool"),
        ("", "curve"),
        ("", "curve_sha256"),
        ("", "statement"),
        ("", "evidence"),
        ("/statement", "claim"),
        ("/statement", "convention"),
        ("/statement", "lower_squared"),
        ("/statement", "upper_squared"),
        ("/evidence", "grid"),
        ("/evidence", "tree"),
        ("/evidence", "upper"),
        ("/evidence/upper", "rule"),
        ("/evidence/upper", "s"),
        ("/evidence/upper", "s_side"),
        ("/evidence/upper", "t"),
        ("/evidence/upper", "t_side"),
    ] {
        cases.malformed(
            &format!("missing-{}{}", pointer.replace('/', "-"), format_args!("-{key}")),
            both().without_field(pointer, key).json(),
            malformed,
        );
    }
    for (name, pointer, value) in [
        ("claim-of-another-kind", "/statement/claim", json!("curvature")),
        ("unknown-convention", "/statement/convention", json!("Smooth")),
        ("lower-null", "/statement/lower_squared", Value::Null),
        ("lower-in-words", "/statement/lower_squared", json!("Infinity")),
        ("lower-negative", "/statement/lower_squared", json!("-1")),
        ("lower-as-a-number", "/statement/lower_squared", json!(9)),
        ("upper-inf", "/statement/upper_squared", json!("inf")),
        ("upper-as-a-number", "/statement/upper_squared", json!(9)),
        ("grid-negative", "/evidence/grid", json!(-1)),
        ("grid-as-a-string", "/evidence/grid", json!("0")),
        ("grid-fractional", "/evidence/grid", json!(0.0)),
        ("grid-huge", "/evidence/grid", json!(1u64 << 40)),
        ("grid-null", "/evidence/grid", Value::Null),
        ("tree-a-string", "/evidence/tree", json!("split")),
        ("tree-binary", "/evidence/tree", json!("binary")),
        ("tree-an-object", "/evidence/tree", json!({})),
        ("curve-binary", "/curve", json!("binary")),
        ("unknown-rule", "/evidence/upper/rule", json!("Root")),
        ("unknown-side", "/evidence/upper/s_side", json!("behind")),
        ("upper-rule-a-string", "/evidence/upper", json!("root")),
        ("tool-null", "/tool", Value::Null),
        ("hash-too-short", "/curve_sha256", json!("0123")),
        ("hash-null", "/curve_sha256", Value::Null),
    ] {
        cases.malformed(name, both().with(pointer, value).json(), |_| true);
    }
    let hash = both().0["curve_sha256"].as_str().expect("a hash").to_uppercase();
    cases.malformed(
        "hash-in-upper-case",
        both().with("/curve_sha256", json!(hash)).json(),
        |_| true,
    );
    for (name, key, value) in [
        ("name-null", "name", Value::Null),
        ("name-a-number", "name", json!(1)),
        ("snapped-joints-null", "snapped_joints", Value::Null),
        ("snapped-joints-negative", "snapped_joints", json!(-1)),
        ("snapped-joints-fractional", "snapped_joints", json!(1.0)),
        ("snapped-joints-a-string", "snapped_joints", json!("1")),
    ] {
        cases.malformed(name, both().with_field("", key, value).json(), malformed);
    }
    for (name, text) in NOT_CANONICAL {
        cases.malformed(
            &format!("lower-{name}"),
            both()
                .with(
                    "/statement/lower_squared",
                    json!(if text == "inf" { "-inf" } else { text }),
                )
                .json(),
            malformed,
        );
        cases.malformed(
            &format!("parameter-{name}"),
            both().with("/evidence/upper/s", json!(text)).json(),
            malformed,
        );
    }
    let joints = |count: &str| {
        let text = String::from_utf8(both().json()).expect("UTF-8");
        text.replacen("\"tool\":", &format!("\"snapped_joints\": {count}, \"tool\":"), 1)
            .into_bytes()
    };
    cases.accept_bytes("most-snapped-joints", joints("18446744073709551615"));
    cases.malformed("too-many-snapped-joints", joints("18446744073709551616"), malformed);
    lists_for_objects(&mut cases, &both());
    damage(&mut cases, &both());
    cases.list()
}

/// The values of an object in a list are not the object.
fn lists_for_objects(cases: &mut Cases, plain: &Certificate) {
    for (name, pointer, order) in [
        (
            "statement",
            "/statement",
            ["claim", "convention", "lower_squared", "upper_squared"].as_slice(),
        ),
        ("evidence", "/evidence", &["grid", "tree", "upper"]),
        ("upper", "/evidence/upper", &["rule", "s", "s_side", "t", "t_side"]),
        ("bezier", "/curve/bezier", &["pieces"]),
        ("piece", "/curve/bezier/pieces/1", &["points"]),
        (
            "document",
            "",
            &["knotproof", "tool", "curve", "curve_sha256", "statement", "evidence"],
        ),
    ] {
        let object = plain.0.pointer(pointer).expect(pointer);
        let mut list: Vec<Value> = order.iter().map(|key| object[*key].clone()).collect();
        if name == "piece" {
            list.push(Value::Null);
        }
        if name == "document" {
            list.splice(2..2, [Value::Null, Value::Null]);
        }
        cases.malformed(
            &format!("list-for-{name}"),
            plain.clone().with(pointer, list.into()).json(),
            |_| true,
        );
    }
}

/// Files that were damaged on the way.
fn damage(cases: &mut Cases, plain: &Certificate) {
    let text = plain.json();
    cases.malformed("empty-file", Vec::new(), |_| true);
    for (name, length) in [
        ("one-byte", 1),
        ("half", text.len() / 2),
        ("all-but-two-bytes", text.len() - 2),
    ] {
        cases.malformed(&format!("truncated-{name}"), text[..length].to_vec(), |_| true);
    }
    let with = |before: &[u8], after: &[u8]| [before, &text, after].concat();
    cases.accept_bytes("spaces-around", with(b" \n\t", b"\r\n "));
    cases.malformed("trailing-text", with(b"", b"x"), malformed);
    cases.malformed("trailing-nul", with(b"", b"\0"), malformed);
    cases.malformed("trailing-document", with(b"", &text), malformed);
    cases.malformed("byte-order-mark", with(b"\xef\xbb\xbf", b""), malformed);
    cases.malformed("leading-comma", with(b",", b""), malformed);
    let replaced = |from: &str, to: &str| {
        let text = String::from_utf8(text.clone()).expect("UTF-8");
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1).into_bytes()
    };
    cases.malformed(
        "repeated-field",
        replaced("\"tool\":", "\"tool\": \"other\", \"tool\":"),
        malformed,
    );
    cases.malformed(
        "repeated-statement-field",
        replaced("\"claim\":", "\"claim\": \"msd\", \"claim\":"),
        malformed,
    );
    cases.malformed(
        "repeated-rule",
        replaced("\"rule\":", "\"rule\": \"touch\", \"rule\":"),
        malformed,
    );
    cases.malformed(
        "repeated-upper-field",
        replaced("\"s_side\":", "\"s_side\": \"after\", \"s_side\":"),
        malformed,
    );
    cases.malformed(
        "repeated-grid",
        replaced("\"grid\":", "\"grid\": 7, \"grid\":"),
        malformed,
    );
    cases.malformed("trailing-comma", replaced("\"split\",", "\"split\",,"), malformed);
    cases.malformed("single-quotes", replaced("\"split\"", "'split'"), malformed);
    cases.malformed("comment", replaced("\"tool\":", "/* by hand */ \"tool\":"), malformed);
    cases.malformed("not-a-number", replaced("\"grid\": 0", "\"grid\": NaN"), malformed);
    cases.malformed("grid-minus-zero", replaced("\"grid\": 0", "\"grid\": -0"), malformed);
    cases.malformed(
        "grid-with-an-exponent",
        replaced("\"grid\": 0", "\"grid\": 0e0"),
        malformed,
    );
    cases.malformed(
        "grid-with-leading-zero",
        replaced("\"grid\": 0", "\"grid\": 00"),
        malformed,
    );
    cases.malformed("lone-surrogate", replaced("by hand", "by \\ud800 hand"), malformed);
    cases.malformed("control-character", replaced("by hand", "by \u{1} hand"), malformed);
    cases.accept_bytes("escaped-letters", replaced("certificate/1", "certificate\\/\\u0031"));
    let mut invalid = text.clone();
    let place = text.windows(7).position(|window| window == b"by hand").expect("there");
    invalid[place] = 0xff;
    cases.malformed("not-utf-8", invalid, |_| true);
    cases.malformed(
        "nested-lists",
        [b"[".repeat(100_000), b"]".repeat(100_000)].concat(),
        |_| true,
    );
}
