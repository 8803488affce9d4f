//! `critical_root`.

use knotproof::check::Reason;
use serde_json::{Value, json};

use super::channel_curve;
use crate::common::case::{Case, Cases, expecting, reason};
use crate::common::document::{Certificate, bezier, polygon};

fn rule(s: &str, t: &str) -> Value {
    json!({ "rule": "critical_root", "s": s, "t": t })
}

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("critical_root");
    let on = |curve: &Value, s: &str, t: &str, upper: &str| {
        Certificate::new(curve.clone()).critical().upper(upper, rule(s, t))
    };
    let channel = channel_curve();
    cases.accept("both-ends", &on(&channel, "0", "3", "9"));
    cases.accept("both-corners", &on(&channel, "1", "2", "9"));
    cases.accept("middles-of-two-sides", &on(&channel, "1/2", "5/2", "9"));
    cases.reject(
        "other-convention",
        &on(&channel, "0", "3", "9").with("/statement/convention", json!("smooth")),
        reason(Reason::WrongConvention),
    );
    cases.reject(
        "bound-below",
        &on(&channel, "0", "3", "8999999/1000000"),
        expecting("critical_root", "upper_squared ≥ |chord|²"),
    );
    let not = expecting("critical_root", "a critical chord");
    cases.reject("slanted-chord", &on(&channel, "1/3", "5/2", "10"), not.clone());
    cases.reject(
        "reversed",
        &on(&channel, "3", "0", "9"),
        expecting("critical_root", "s < t"),
    );
    cases.reject(
        "one-parameter",
        &on(&channel, "1", "1", "9"),
        expecting("critical_root", "s < t"),
    );
    cases.reject(
        "beyond-the-end",
        &on(&channel, "0", "4", "9"),
        expecting("critical_root", "two parameters of the curve"),
    );

    // Open ends: critical when the other end of the chord lies behind.
    let ends = |end: i64| polygon(json!([[0, 0], [6, 0], [6, 9], [-7, 9], [-7, 3], [end, 3]]));
    cases.accept("ends-behind-each-other", &on(&ends(-1), "0", "5", "10"));
    cases.reject("ends-before-each-other", &on(&ends(1), "0", "5", "10"), not.clone());
    let hook = |end: i64| polygon(json!([[0, 0], [6, 0], [6, 3], [end, 3]]));
    cases.reject(
        "only-the-start-is-critical",
        &on(&hook(-1), "0", "3", "10"),
        not.clone(),
    );
    cases.reject("neither-end-is-critical", &on(&hook(1), "0", "3", "10"), not.clone());

    // Corners: the two products have opposite signs, or one vanishes.
    let diamond = polygon(json!([[0, -1], [2, 0], [0, 1], [-2, 0], [0, -1]]));
    cases.accept("opposite-corners", &on(&diamond, "0", "2", "4"));
    cases.accept("corners-of-the-long-diagonal", &on(&diamond, "1", "3", "16"));
    cases.reject("neighbouring-corners", &on(&diamond, "0", "1", "5"), not.clone());
    let square = polygon(json!([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]));
    cases.accept("corners-of-one-side", &on(&square, "0", "1", "1"));
    cases.reject(
        "corner-and-middle-of-its-side",
        &on(&square, "0", "1/2", "1"),
        not.clone(),
    );
    cases.reject(
        "start-and-end-of-a-closed-curve",
        &on(&square, "0", "4", "1"),
        expecting("critical_root", "two parameters of the curve"),
    );
    // A corner whose two sides run the same way past the chord is not critical.
    let past = polygon(json!([[-2, 0], [0, 1], [2, 3], [2, 9], [-2, 9]]));
    cases.reject(
        "corner-with-products-of-one-sign",
        &on(&past, "1", "3", "1000"),
        not.clone(),
    );

    // A cusp has no tangent.
    let cusp = bezier(json!([
        [[-1, 1], [1, "-1/3"], [-1, "-1/3"], [1, 1]],
        [[1, 1], [1, 4]],
        [[1, 4], [-1, 4]]
    ]));
    cases.reject(
        "derivative-vanishes",
        &on(&cusp, "1/2", "5/2", "17"),
        expecting("critical_root", "a tangent direction"),
    );
    cases.list()
}
