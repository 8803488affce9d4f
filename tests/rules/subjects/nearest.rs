//! Outcome `nearest` of the claim `domain`.

use serde_json::{Value, json};

use super::domain::{about, parabola};
use crate::common::case::{Case, Cases, expecting};
use crate::common::document::{Certificate, bezier};

/// From (0,−1) to the upper half-plane: exactly 1, at (0,0).
pub fn from_below() -> Certificate {
    about(
        parabola(),
        json!({ "kind": "nearest", "to": ["0", "-1"], "lower_squared": "1", "upper_squared": "1" }),
        json!({
            "center": ["1", "1/2"], "point": ["0", "0"], "base": ["0", "0"],
            "rows": [{ "piece": 0, "u": "1/3" }], "multipliers": ["1/2"]
        }),
    )
}

/// The fair position of the parabola's middle point is (1,0): all three points on a line.
pub fn fair() -> Certificate {
    about(
        parabola(),
        json!({ "kind": "nearest", "to": "fair", "lower_squared": "0", "upper_squared": "0" }),
        json!({ "center": ["1", "1/2"], "point": ["1", "0"], "base": ["1", "0"], "rows": [], "multipliers": [] }),
    )
}

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("nearest");
    let with = |pointer: &str, value: Value| from_below().with(pointer, value);
    let rule = |wish| expecting("nearest", wish);
    cases.accept("from-below", &from_below());
    cases.accept(
        "weaker",
        &with("/statement/outcome/lower_squared", json!("1/2")).with("/statement/outcome/upper_squared", json!("2")),
    );
    cases.accept("fair", &fair());
    let lower = "0 ≤ lower_squared ≤ the bound of the multipliers";
    cases.reject(
        "lower-too-large",
        &with("/statement/outcome/lower_squared", json!("1000001/1000000")),
        rule(lower),
    );
    cases.reject(
        "lower-negative",
        &with("/statement/outcome/lower_squared", json!("-1")),
        rule(lower),
    );
    cases.reject(
        "upper-too-small",
        &with("/statement/outcome/upper_squared", json!("999999/1000000")),
        rule("upper_squared at least the point's squared distance"),
    );
    cases.reject(
        "nearer-target",
        &with("/statement/outcome/to", json!(["0", "-1/2"])),
        |_| true,
    );
    cases.reject(
        "farther-target",
        &with("/statement/outcome/to", json!(["0", "-2"])),
        |_| true,
    );
    cases.reject(
        "point-outside",
        &with("/evidence/point", json!(["0", "-1/2"])),
        rule("a sign function non-negative by halving"),
    );
    cases.reject(
        "point-outside-the-box",
        &with("/evidence/point", json!(["-2", "0"])),
        rule("a point of the box"),
    );
    cases.reject(
        "center-on-the-boundary",
        &with("/evidence/center", json!(["1", "0"])),
        rule("a sign function positive by halving"),
    );
    cases.reject(
        "center-outside-the-box",
        &with("/evidence/center", json!(["1", "2"])),
        rule("a point of the box"),
    );
    let stationary = "base minus target equal to the combination of normals";
    cases.reject(
        "another-base",
        &with("/evidence/base", json!(["0", "1/2"])),
        rule(stationary),
    );
    cases.reject(
        "multiplier-zero",
        &with("/evidence/multipliers", json!(["0"])),
        rule(stationary),
    );
    cases.reject(
        "multiplier-missing",
        &with("/evidence/multipliers", json!([])),
        rule("as many multipliers as rows"),
    );
    cases.reject(
        "multiplier-negative",
        &with("/evidence/multipliers", json!(["-1/2"])).with("/evidence/base", json!(["0", "-2"])),
        rule("multipliers ≥ 0"),
    );
    // A base within the half-plane gives a weaker bound: |z−y|² − 2λ·2z₁ with z = (0,1), λ = 1.
    let far = with("/evidence/base", json!(["0", "1"])).with("/evidence/multipliers", json!(["1"]));
    cases.accept(
        "base-within",
        &far.clone().with("/statement/outcome/lower_squared", json!("0")),
    );
    cases.reject("base-within-claims-more", &far, rule(lower));
    let low = "1/4";
    cases.accept(
        "base-outside",
        &with("/evidence/base", json!(["0", "-3/4"]))
            .with("/evidence/multipliers", json!(["1/8"]))
            .with("/statement/outcome/lower_squared", json!("7/16")),
    );
    cases.accept("another-row", &with("/evidence/rows/0/u", json!(low)));
    cases.reject(
        "fair-far",
        &fair()
            .with("/statement/outcome/upper_squared", json!("0"))
            .with("/evidence/point", json!(["2", "0"])),
        rule("upper_squared at least the point's squared distance"),
    );
    cases.reject(
        "fair-base-elsewhere",
        &fair().with("/evidence/base", json!(["1", "1/2"])),
        rule(stationary),
    );
    let weights = json!({ "bezier": { "pieces": [{ "points": [["0", "0"], ["1", "1"], ["2", "0"]], "weights": ["1", "2", "1"] }] } });
    let polynomial = "a polynomial curve whose second derivative depends on the points";
    cases.reject("fair-of-a-rational-curve", &fair().curve(weights), rule(polynomial));
    // Two pieces: the fair position weighs both; the first is free of the point.
    let two = bezier(json!([[[-2, 0], [-1, 1], [0, 0]], [[0, 0], [1, 1], [2, 0]]]));
    cases.accept(
        "fair-of-the-second-piece",
        &fair()
            .curve(two)
            .with("/statement/points", json!([4]))
            .with("/statement/interval", json!(["1", "2"])),
    );
    cases.malformed(
        "target-unknown",
        with("/statement/outcome/to", json!("fairest")).json(),
        |_| true,
    );
    cases.malformed(
        "target-of-three",
        with("/statement/outcome/to", json!(["0", "0", "0"])).json(),
        |_| true,
    );
    cases.malformed(
        "without-base",
        from_below().without_field("/evidence", "base").json(),
        |_| true,
    );
    cases.list()
}
