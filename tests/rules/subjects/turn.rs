//! `turn p q`.

use serde_json::{Value, json};

use super::step;
use crate::common::case::{Case, Cases, expecting, obligation_at};
use crate::common::document::{Certificate, bezier};

/// There and nearly back, with two equal control points at the corner on both sides: D goes down to 0 there.
fn needle(end: Value) -> Value {
    bezier(json!([
        [[0, 0], [2, 0], [3, 0], [3, 0]],
        [[3, 0], [3, 0], [2, end[0].clone()], [0, end[1].clone()]]
    ]))
}

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("turn");
    let sharp = |leaf: &str| {
        Certificate::new(needle(json!(["1/10", "3/10"]))).lower("inf", &["split", "cone 1 0", leaf, "cone -1 0"])
    };
    cases.accept("needle", &sharp("turn 200 0 -201 0"));
    cases.accept("needle-other-vectors", &sharp("turn 200 55 -201 3"));
    cases.accept(
        "needle-huge-vectors",
        &sharp(&format!("turn 200{0} 0 -201{0} 0", "0".repeat(900))),
    );
    // What `bend` compares are lengths of D, which near such a corner have no common measure.
    for factors in ["1 1", "2 1", "1 2", "201 200"] {
        cases.reject(
            &format!("needle-bend-{}", factors.replace(' ', "-")),
            &sharp(&format!("bend {factors}")),
            obligation_at("bend", 2),
        );
    }
    let along = expecting("turn", "p·v > 0 and q·w > 0 throughout");
    cases.reject("first-vector-backward", &sharp("turn -200 0 -201 0"), along.clone());
    cases.reject("second-vector-forward", &sharp("turn 200 0 201 0"), along.clone());
    cases.reject("first-vector-across", &sharp("turn 0 1 -201 0"), along);
    let zero = expecting("turn", "p, q not 0");
    cases.reject("first-vector-zero", &sharp("turn 0 0 -201 0"), zero.clone());
    cases.reject("second-vector-zero", &sharp("turn 200 0 0 0"), zero);
    let product = expecting("turn", "((q·w)v + (p·v)w)·x > 0 throughout");
    cases.reject("one-vector-too-long", &sharp("turn 200 0 -210 0"), product.clone());
    cases.reject("product-zero", &sharp("turn 200 0 -200 0"), product.clone());
    cases.reject("other-vector-too-long", &sharp("turn 201 0 -200 0"), product.clone());

    let back =
        Certificate::new(needle(json!([0, 0]))).lower("inf", &["split", "cone 1 0", "turn 200 0 -201 0", "cone -1 0"]);
    cases.reject("turn-by-180-degrees", &back, product);
    cases.reject(
        "not-adjacent",
        &step().token(4, "turn 1 0 1 0"),
        expecting("turn", "adjacent nodes"),
    );

    // In space, with a corner out of the plane.
    let space = bezier(json!([
        [[0, 0, 0], [2, 0, 0], [3, 0, 0], [3, 0, 0]],
        [[3, 0, 0], [3, 0, 0], [2, 0, "1/10"], [0, 0, "3/10"]]
    ]));
    let spatial =
        |leaf: &str| Certificate::new(space.clone()).lower("inf", &["split", "cone 1 0 0", leaf, "cone -1 0 0"]);
    cases.accept("needle-in-space", &spatial("turn 200 0 0 -201 0 0"));
    cases.reject(
        "needle-in-space-across",
        &spatial("turn 200 0 0 -201 0 -300000"),
        expecting("turn", "p·v > 0 and q·w > 0 throughout"),
    );
    // A run is not for this rule.
    let three = bezier(json!([[[0, 0], [1, 0]], [[1, 0], [2, 0]], [[2, 0], [3, 1]]]));
    cases.reject(
        "run",
        &Certificate::new(three).lower("inf", &["split", "cone 1 0", "turn 1 0 1 0", "cone 1 0"]),
        expecting("turn", "parts, corners or ends"),
    );
    cases.list()
}
