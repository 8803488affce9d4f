//! `touch`.

use serde_json::{Value, json};

use crate::common::case::{Case, Cases, expecting};
use crate::common::document::{Certificate, bezier, polygon};

fn rule(s: &str, t: &str) -> Value {
    json!({ "rule": "touch", "s": s, "t": t })
}

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("touch");
    let returning = polygon(json!([[-2, -1], [0, 0], [3, 0], [-1, -3], [0, 0], [1, 2]]));
    let at = |s: &str, t: &str| Certificate::new(returning.clone()).upper("0", rule(s, t));
    cases.accept("two-joints", &at("1", "4"));
    cases.accept("two-joints-in-the-convention-critical", &at("1", "4").critical());
    cases.accept(
        "any-bound",
        &at("1", "4").with("/statement/upper_squared", json!("1/1000")),
    );
    cases.accept(
        "a-side-and-a-joint",
        &Certificate::new(polygon(json!([[0, 0], [4, 0], [4, 2], [1, 0]]))).upper("0", rule("1/4", "3")),
    );
    let different = expecting("touch", "c(s) = c(t)");
    cases.reject("different-points", &at("1", "3"), different.clone());
    cases.reject("nearly-equal-points", &at("1", "4000000001/1000000000"), different);
    cases.reject("reversed", &at("4", "1"), expecting("touch", "s < t"));
    cases.reject("one-parameter", &at("1", "1"), expecting("touch", "s < t"));
    cases.reject(
        "beyond-the-end",
        &at("1", "6"),
        expecting("touch", "two parameters of the curve"),
    );
    let square = polygon(json!([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]));
    cases.reject(
        "closing-point",
        &Certificate::new(square).upper("0", rule("0", "4")),
        expecting("touch", "two parameters of the curve"),
    );
    // The same in space, and inside of curved pieces.
    let loop_of_a_cubic = bezier(json!([[[0, 0, 1], [3, 2, 1], [-2, 2, 1], [1, 0, 1]]]));
    cases.reject(
        "not-quite-the-double-point",
        &Certificate::new(loop_of_a_cubic).upper("0", rule("1/8", "7/8")),
        expecting("touch", "c(s) = c(t)"),
    );
    let folded = polygon(json!([[0, 0, 0], [3, 0, 3], [1, 0, 1]]));
    cases.accept(
        "folded-segment",
        &Certificate::new(folded).upper("0", rule("2/3", "3/2")),
    );
    cases.list()
}
