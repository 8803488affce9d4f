//! `separate n`, and the margins of its leaves.

use knotproof::check::{Reason, Rejection};
use serde_json::{Value, json};

use super::embedding::{embedded_channel, embedding, moving};
use crate::common::case::{Case, Cases, expecting, obligation_at};
use crate::common::document::{Certificate, bezier, polygon};

/// Two straight runs; the boxes of their elements 0 … 2 and 4 … 5 are [0,3]×[−1,2] and [5,6]×[1,3] shifted by `shift`.
fn two_runs(shift: i64) -> Value {
    polygon(json!([
        [0, 2],
        [1, 1],
        [2, 0],
        [3, -1],
        [6 + shift, 1],
        [6 + shift, 2],
        [5 + shift, 3]
    ]))
}

/// Token 4 is for both runs.
const TWO_RUNS: [&str; 6] = [
    "split",
    "monotone 1 0",
    "second",
    "monotone 1 0",
    "separate -1 -1",
    "monotone 0 1",
];

/// A cubic arch in three parts: [0,1/4] and [1/2,1] are separated by token 3.
pub fn arch(radius: &str, separate: &str) -> Certificate {
    let curve = bezier(json!([[[0, 0], [0, 2], [2, 2], [2, 0]]]));
    let tree = [
        "split",
        "monotone 1 1",
        "first",
        separate,
        "monotone 2 -1",
        "monotone 1 -1",
    ];
    embedding(curve, &tree, 3, [radius, "0"])
}

pub fn beyond_infinity(rejection: &Rejection) -> bool {
    rejection.reason == Reason::Radius { norm: "infinity" }
}

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("separate");
    let channel = moving(&embedded_channel(), "0", "0");
    cases.accept("sides-of-a-channel", &channel);
    cases.accept("slanted", &channel.clone().token(4, "separate 1 -2"));
    let huge = format!("separate 0 -1{}", "0".repeat(1000));
    cases.accept("huge-witness", &channel.clone().token(4, &huge));
    cases.reject(
        "zero-witness",
        &channel.clone().token(4, "separate 0 0"),
        obligation_at("separate", 4),
    );
    cases.reject(
        "backwards",
        &channel.clone().token(4, "separate 0 1"),
        obligation_at("separate", 4),
    );
    cases.reject(
        "too-slanted",
        &channel.clone().token(4, "separate 4 -3"),
        obligation_at("separate", 4),
    );
    // min n·p = max n·q: the hulls touch the same line.
    cases.reject(
        "along-the-gap",
        &channel.clone().token(4, "separate 3 -4"),
        obligation_at("separate", 4),
    );
    cases.reject(
        "neighbours",
        &channel.clone().token(3, "separate -1 -1"),
        obligation_at("separate", 3),
    );
    cases.reject(
        "one-node",
        &channel.token(1, "separate -1 0"),
        expecting("separate", "two different nodes"),
    );

    // Runs are separated by their boxes, and their margins are those of the control points: here 5/2 where the corners would give 1/2.
    let runs = |shift, radius: [&str; 2]| embedding(two_runs(shift), &TWO_RUNS, 3, radius);
    cases.accept("runs-by-their-control-points", &runs(0, ["1/2", "1/2"]));
    cases.reject("runs-moved-farther", &runs(0, ["501/1000", "1/2"]), beyond_infinity);
    cases.reject("boxes-that-touch", &runs(-1, ["0", "0"]), obligation_at("separate", 4));

    // Both parts depend on the same control points: the coefficients of n·p − n·q are taken together, Σ|m_j| = 7/4.
    cases.accept("shared-control-points", &arch("2/21", "separate -2 1"));
    cases.reject(
        "shared-control-points-moved-farther",
        &arch("191/2000", "separate -2 1"),
        beyond_infinity,
    );
    cases.accept("arch", &arch("4/27", "separate -1 0"));
    cases.list()
}
