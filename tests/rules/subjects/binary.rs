//! The binary form.

use knotproof::check::Reason;
use serde_json::json;

use super::{channel, channel_root};
use crate::common::case::{Case, Cases};
use crate::common::document::Certificate;

/// Where the curve block begins.
fn block(bytes: &[u8]) -> usize {
    12 + u32::from_le_bytes(bytes[8..12].try_into().expect("four bytes")) as usize
}

/// Cases of the binary form.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("binary");
    let plain = channel().upper("9", channel_root()).binary();
    let curve = block(&plain);
    let tree = plain.len() - 9 - "1 0 1 1 0 1 1 1 -1 0".split(' ').count();
    cases.accept_bytes("plain", plain.clone());
    let without_tree = Certificate::new(super::channel_curve())
        .upper("9", channel_root())
        .binary();
    cases.accept_bytes("without-a-tree", without_tree.clone());
    cases.reject_bytes(
        "trailing-byte-without-a-tree",
        with_tail(&without_tree, &[0]),
        |rejection| rejection.reason == Reason::TokensLeft,
    );
    for (name, length) in [("magic", 7), ("length", 10), ("header", 100), ("curve", curve + 9)] {
        cases.malformed(&format!("truncated-{name}"), plain[..length].to_vec(), |_| true);
    }
    cases.reject_bytes("truncated-tree", plain[..plain.len() - 1].to_vec(), |_| true);
    cases.reject_bytes("truncated-before-the-tree", plain[..tree].to_vec(), |_| true);
    cases.reject_bytes("trailing-byte", with_tail(&plain, &[0]), |rejection| {
        rejection.reason == Reason::TokensLeft
    });
    cases.reject_bytes("trailing-unknown-byte", with_tail(&plain, &[0xff]), |_| true);
    cases.reject_bytes("trailing-copy", with_tail(&plain, &plain), |_| true);
    let edited = |place: usize, byte: u8| {
        let mut bytes = plain.clone();
        bytes[place] = byte;
        bytes
    };
    cases.malformed("magic-of-version-2", edited(7, b'2'), |_| true);
    cases.malformed("magic-in-lower-case", edited(0, b'k'), |_| true);
    cases.malformed(
        "header-of-4-gigabytes",
        [&plain[..8], &[0xff; 4], &plain[12..]].concat(),
        |_| true,
    );
    cases.malformed("header-longer-than-the-file", edited(10, 1), |_| true);
    cases.malformed("header-one-byte-short", edited(8, plain[8] - 1), |_| true);
    cases.malformed("header-one-byte-long", edited(8, plain[8] + 1), |_| true);
    cases.malformed("dimension-4", edited(curve, 4), |_| true);
    cases.malformed("dimension-3", edited(curve, 3), |_| true);
    cases.malformed("unknown-form", edited(curve + 1, 2), |_| true);
    cases.malformed("form-of-a-spline", edited(curve + 1, 0), |_| true);
    cases.malformed("more-pieces", edited(curve + 2, 4), |_| true);
    cases.malformed("fewer-pieces", edited(curve + 2, 2), |_| true);
    cases.malformed("no-pieces", edited(curve + 2, 0), |_| true);
    cases.malformed("degree-0", edited(curve + 3, 0), |_| true);
    cases.malformed("denominator-0", edited(curve + 4, 0), |_| true);
    cases.malformed("denominator-2", edited(curve + 4, 2), |_| true);
    cases.malformed("weights-flag-2", edited(curve + 9, 2), |_| true);
    // Counts that no file holds must not take memory.
    let huge: Vec<u8> = [&plain[..curve + 2], &[0xff; 9], &[0x01]].concat();
    cases.malformed("number-of-pieces-of-64-bits", huge, |_| true);
    let padded: Vec<u8> = [&plain[..curve + 3], &[0x81, 0x00], &plain[curve + 4..]].concat();
    cases.malformed("padded-degree", padded, |_| true);

    // Tokens: every code, both spellings.
    let tokens = |tail: &[u8]| [&plain[..tree], tail].concat();
    let split: &[u8] = &[
        0x00, 0x05, 2, 0, 0x02, 0x06, 2, 2, 0x13, 0x00, 0x05, 0, 2, 0x06, 2, 2, 0x05, 1, 0,
    ];
    assert_eq!(tokens(split), plain);
    let with_far = |far: &[u8]| tokens(&[&split[..8], far, &split[9..]].concat());
    cases.accept_bytes("long-spelling-of-a-unit-vector", with_far(&[0x03, 0, 1]));
    cases.reject_bytes("unit-vector-of-another-axis", with_far(&[0x11]), |_| true);
    cases.reject_bytes("unit-vector-of-the-third-axis-in-the-plane", with_far(&[0x14]), |_| {
        true
    });
    cases.reject_bytes("zero-vector", with_far(&[0x03, 0, 0]), |_| true);
    cases.reject_bytes("padded-zero", with_far(&[0x03, 0x80, 0, 1]), |_| true);
    cases.reject_bytes("padded-witness", with_far(&[0x03, 0, 0x81, 0]), |_| true);
    cases.reject_bytes("unknown-code", with_far(&[0x07]), |_| true);
    cases.reject_bytes("code-0x24", with_far(&[0x24]), |_| true);
    let witness = |bits: usize| {
        // The signed varint of 1 − 2^bits, which is negative: 2^(bits+1) − 3.
        let value = knotproof::number::Integer::from(2).pow(bits as u32 + 1) - knotproof::number::Integer::from(3);
        let mut bytes = vec![0x03, 0];
        knotproof::claim::tree::write_varint(&value, &mut bytes);
        bytes
    };
    cases.accept_bytes("witness-of-4096-bits", with_far(&witness(4096)));
    cases.reject_bytes("witness-of-4097-bits", with_far(&witness(4097)), |_| true);
    cases.reject_bytes(
        "witness-without-end",
        with_far(&[&[0x03, 0][..], &[0xff; 20_000]].concat()),
        |_| true,
    );
    let not_normal = super::step().binary();
    cases.accept_bytes("step", not_normal.clone());
    let short = not_normal
        .iter()
        .rposition(|byte| *byte == 0x21)
        .expect("the short code of not_normal -1 0");
    cases.accept_bytes(
        "long-spelling-of-factors",
        [&not_normal[..short], &[0x04, 1, 0], &not_normal[short + 1..]].concat(),
    );
    cases.reject_bytes(
        "other-short-factors",
        [&not_normal[..short], &[0x20], &not_normal[short + 1..]].concat(),
        |_| true,
    );

    // The header says what is in the blocks.
    let header = |from: &str, to: &str| {
        let text = std::str::from_utf8(&plain[12..curve]).expect("UTF-8");
        assert!(text.contains(from), "{from}");
        let text = text.replacen(from, to, 1);
        [
            &plain[..8],
            &(text.len() as u32).to_le_bytes(),
            text.as_bytes(),
            &plain[curve..],
        ]
        .concat()
    };
    cases.malformed(
        "tree-in-the-header",
        header("\"tree\": \"binary\"", "\"tree\": [\"split\"]"),
        |_| true,
    );
    cases.malformed(
        "tree-of-another-name",
        header("\"tree\": \"binary\"", "\"tree\": \"json\""),
        |_| true,
    );
    cases.malformed(
        "curve-in-the-header",
        header("\"curve\": \"binary\"", "\"curve\": { \"bezier\": { \"pieces\": [] } }"),
        |_| true,
    );
    cases.reject_bytes(
        "no-tree-said-but-there",
        header("\"tree\": \"binary\"", "\"tree\": null"),
        |_| true,
    );
    cases.malformed("version-2", header("certificate/1", "certificate/2"), |_| true);
    let hash = json!(channel().0["curve_sha256"]).as_str().expect("a hash").to_string();
    cases.malformed("hash-of-another-curve", header(&hash, &"0".repeat(64)), |_| true);
    cases.list()
}

fn with_tail(bytes: &[u8], tail: &[u8]) -> Vec<u8> {
    [bytes, tail].concat()
}
