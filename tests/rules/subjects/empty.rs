//! Outcome `empty` of the claim `domain`.

use serde_json::{Value, json};

use super::domain::{about, parabola};
use crate::common::case::{Case, Cases, expecting};
use crate::common::document::{Certificate, bezier};

/// The upper half-plane has no point in a box below it: 2x₁ ≥ 0 and −1 − x₁ ≥ 0 contradict each other.
pub fn below() -> Certificate {
    about(
        parabola(),
        json!({ "kind": "empty" }),
        json!({ "rows": [{ "piece": 0, "u": "0" }, { "axis": 1, "side": "high" }], "multipliers": ["1", "2"] }),
    )
    .with("/statement/box", json!([["-1", "-2"], ["3", "-1"]]))
}

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("empty");
    let with = |pointer: &str, value: Value| below().with(pointer, value);
    let rule = |wish| expecting("empty", wish);
    let negative = "a combination that is negative, or 0 with a strict row";
    cases.accept("below", &below());
    cases.accept("multiplied", &with("/evidence/multipliers", json!(["3", "6"])));
    let touching = || with("/statement/box", json!([["-1", "-2"], ["3", "0"]]));
    cases.accept("touching", &touching());
    cases.reject(
        "not-below",
        &with("/statement/box", json!([["-1", "-2"], ["3", "1/1000"]])),
        rule(negative),
    );
    cases.reject(
        "multipliers-zero",
        &with("/evidence/multipliers", json!(["0", "0"])),
        rule("a multiplier other than 0"),
    );
    cases.reject(
        "multiplier-negative",
        &with("/evidence/multipliers", json!(["-1", "-2"])),
        rule("multipliers ≥ 0"),
    );
    cases.reject(
        "multipliers-unequal",
        &with("/evidence/multipliers", json!(["1", "1"])),
        rule("a combination constant in x"),
    );
    cases.reject(
        "multiplier-missing",
        &with("/evidence/multipliers", json!(["1"])),
        rule("as many multipliers as rows"),
    );
    cases.reject(
        "multiplier-more",
        &with("/evidence/multipliers", json!(["1", "2", "0"])),
        rule("as many multipliers as rows"),
    );
    cases.reject(
        "rows-missing",
        &with("/evidence", json!({ "rows": [], "multipliers": [] })),
        |_| true,
    );
    cases.reject(
        "sides-alone",
        &with(
            "/evidence",
            json!({ "rows": [{ "axis": 1, "side": "low" }, { "axis": 1, "side": "high" }], "multipliers": ["1", "1"] }),
        ),
        rule(negative),
    );
    cases.malformed(
        "multiplier-fraction",
        with("/evidence/multipliers", json!(["1/2", "1"])).json(),
        |_| true,
    );

    // Where the only strict row has the multiplier 0 nothing is proved.
    let weak = json!({
        "rows": [{ "piece": 0, "u": "0" }, { "axis": 1, "side": "low" }, { "axis": 1, "side": "high" }],
        "multipliers": ["0", "1", "1"]
    });
    cases.reject("strict-row-unused", &touching().with("/evidence", weak), rule(negative));

    // At an open end the limit of the sign function is only ≥ 0 on K. The curve begins straight and its last point moves: h has the coefficients 0, x₁/2, x₁, so g = x₁.
    let straight = bezier(json!([[[0, 0], [1, 0], [2, 0], [3, 1]]]));
    let hook = |open: bool, u: &str| {
        touching()
            .curve(straight.clone())
            .with("/statement/points", json!([3]))
            .with("/statement/sign", json!("+"))
            .with("/statement/open", json!([open, false]))
            .with("/evidence/rows/0/u", json!(u))
    };
    cases.reject("open-end", &hook(true, "0"), rule("a combination constant in x"));
    let strict = |u: &str, multiplier: &str| hook(true, u).with("/evidence/multipliers", json!(["1", multiplier]));
    cases.accept("behind-the-open-end", &strict("1", "1"));
    cases.reject("at-the-open-end", &strict("0", "1"), rule(negative));
    // A closed end at which the sign function vanishes identically empties K.
    let alone = json!({ "rows": [{ "piece": 0, "u": "0" }], "multipliers": ["1"] });
    cases.accept(
        "zero-at-a-closed-end",
        &hook(false, "0").with("/evidence", alone.clone()),
    );
    cases.reject("zero-at-an-open-end", &hook(true, "0").with("/evidence", alone), |_| {
        true
    });
    cases.list()
}
