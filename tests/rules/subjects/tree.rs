//! The cover tree itself: what it covers, and tokens in places that are not for them.

use knotproof::check::{Place, Reason};
use serde_json::json;

use super::{CHANNEL, SEGMENT, channel, channel_curve, segment_curve};
use crate::common::case::{Case, Cases, at_token, reason};
use crate::common::document::Certificate;

/// A segment halved `depth` times at its start.
fn nested(depth: usize) -> Certificate {
    let mut tokens = vec!["split"; depth];
    tokens.extend(vec!["cone 3 4"; 2 * depth + 1]);
    Certificate::new(segment_curve()).lower("inf", &tokens)
}

/// Cases of the tree.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("tree");
    let tree = |tokens: &[&str]| Certificate::new(channel_curve()).lower("9", tokens);
    cases.accept("complete", &channel());
    cases.reject("empty", &tree(&[]), reason(Reason::TokensMissing));
    for i in 1..CHANNEL.len() {
        cases.reject(
            &format!("ends-after-{i}-tokens"),
            &tree(&CHANNEL[..i]),
            reason(Reason::TokensMissing),
        );
    }
    for extra in ["cone 1 0", "split", "far 0 -1", "first"] {
        let tokens = [CHANNEL.as_slice(), &[extra]].concat();
        let name = format!("left-over-{}", extra.replace(' ', "-"));
        cases.reject(&name, &tree(&tokens), |rejection| {
            rejection.reason == Reason::TokensLeft && at_token(rejection, 9)
        });
    }
    // The pair of the two long sides is left out: the next leaf is taken for it.
    let uncovered = [&CHANNEL[..4], &CHANNEL[5..]].concat();
    cases.reject("a-pair-left-out", &tree(&uncovered), |rejection| {
        rejection.reason == Reason::WrongSplit && at_token(rejection, 4)
    });
    // Leaves of the two sides of a right angle exchanged.
    cases.reject(
        "leaves-exchanged",
        &channel().token(6, "cone -1 0").token(8, "cone 0 1"),
        |rejection| at_token(rejection, 6),
    );

    let wrong = reason(Reason::WrongSplit);
    cases.reject("first-of-one-node", &channel().token(0, "first"), wrong.clone());
    cases.reject("second-of-one-node", &channel().token(0, "second"), wrong.clone());
    cases.reject("split-of-two-nodes", &channel().token(2, "split"), wrong);

    // A part is halved up to 120 times.
    cases.accept("depth-1", &nested(1));
    cases.accept("depth-120", &nested(120));
    cases.reject("depth-121", &nested(121), |rejection| {
        rejection.reason == Reason::CannotSplit && at_token(rejection, 120)
    });
    let deep = |token| {
        let mut tokens = vec!["split"; 120];
        tokens.extend(["cone 3 4", token]);
        Certificate::new(segment_curve()).lower("inf", &tokens)
    };
    for token in ["first", "second"] {
        let name = format!("depth-121-by-{token}");
        cases.reject(&name, &deep(token), |rejection| {
            rejection.reason == Reason::CannotSplit && at_token(rejection, 121)
        });
    }

    // Ends and corners are not split, and have no token with themselves.
    let segment = |tokens: &[&str]| Certificate::new(segment_curve()).critical().lower("inf", tokens);
    cases.accept("critical-segment", &segment(&SEGMENT));
    cases.accept("critical-segment-one-leaf", &segment(&["cone 3 4"]));
    cases.reject(
        "split-of-an-end",
        &segment(&["split", "first"]),
        reason(Reason::CannotSplit),
    );
    cases.reject(
        "split-of-the-other-end",
        &segment(&["split", "second", "bend 1 0", "second"]),
        reason(Reason::CannotSplit),
    );
    let with_itself = [&["split", "cone 3 4"], &SEGMENT[1..]].concat();
    cases.reject("token-for-an-end-with-itself", &segment(&with_itself), |rejection| {
        matches!(rejection.place, Place::Pair { .. })
    });
    // The tree of the other convention does not cover ends and corners.
    cases.reject("tree-of-the-other-convention", &channel().critical(), |_| true);

    for (name, token) in [
        ("unknown-rule", "near 0 -1"),
        ("no-rule", ""),
        ("too-few-integers", "far 0"),
        ("too-many-integers", "far 0 -1 0"),
        ("two-spaces", "far  0 -1"),
        ("trailing-space", "far 0 -1 "),
        ("plus-sign", "far 0 +1"),
        ("leading-zero", "far 0 -01"),
        ("minus-zero", "far -0 -1"),
        ("fraction", "far 0 -1/2"),
        ("upper-case", "Far 0 -1"),
        ("integers-after-first", "first 1"),
        ("tab", "far\t0 -1"),
        ("digits-of-another-script", "far 0 -١"),
    ] {
        cases.reject(name, &channel().token(4, token), |rejection| {
            matches!(rejection.reason, Reason::Token(_))
        });
    }
    let too_long = knotproof::number::Integer::from(2).pow(4096);
    cases.reject(
        "witness-of-4097-bits",
        &channel().token(4, &format!("far 0 -{too_long}")),
        |rejection| matches!(rejection.reason, Reason::Token(_)),
    );
    let longest = too_long - knotproof::number::Integer::from(1);
    cases.accept(
        "witness-of-4096-bits",
        &channel().token(4, &format!("far 0 -{longest}")),
    );
    cases.malformed(
        "token-that-is-no-string",
        channel().with("/evidence/tree/4", json!(4)).json(),
        |_| true,
    );
    cases.list()
}
