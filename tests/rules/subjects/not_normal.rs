//! `not_normal α β`.

use serde_json::json;

use super::{STEP, channel, step};
use crate::common::case::{Case, Cases, expecting, obligation_at};
use crate::common::document::{Certificate, polygon};
use crate::common::grow::grow_with_leaf;
use crate::common::tree::{Element, Node};

/// An open channel in the convention `critical`, its right side at x = 6, ending at (end, 3), with the number of its leaf for both
/// ends.
fn ends(end: i64) -> (Certificate, usize) {
    let curve = polygon(json!([[0, 0], [6, 0], [6, 3], [end, 3]]));
    let statement = Certificate::new(curve)
        .critical()
        .with("/statement/lower_squared", json!("9"));
    grow_with_leaf(&statement, [Node::Point(Element::Start), Node::Point(Element::End)])
}

/// An open polygon whose two ends see each other behind their backs: a critical chord from (0,0) to (-1,3).
fn critical_ends() -> (Certificate, usize) {
    let curve = polygon(json!([[0, 0], [6, 0], [6, 9], [-7, 9], [-7, 3], [-1, 3]]));
    let statement = Certificate::new(curve)
        .critical()
        .with("/statement/lower_squared", json!("9"));
    grow_with_leaf(&statement, [Node::Point(Element::Start), Node::Point(Element::End)])
}

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("not_normal");
    let leaf = |factors: &str| step().token(4, &format!("not_normal {factors}"));
    for factors in ["-1 0", "0 -1", "-5 -7", "-2 1"] {
        cases.accept(&format!("factors-{}", factors.replace(' ', "-")), &leaf(factors));
    }
    cases.accept(
        "huge-factors",
        &leaf(&format!("-1{} -1{}", "0".repeat(600), "0".repeat(1200))),
    );
    cases.reject(
        "huge-factors-that-cancel",
        &leaf(&format!("-1{0} 1{0}", "0".repeat(600))),
        obligation_at("not_normal", 4),
    );
    for factors in ["1 0", "0 1", "-1 1", "1 -1", "-1 2"] {
        cases.reject(
            &format!("factors-{}", factors.replace(' ', "-")),
            &leaf(factors),
            obligation_at("not_normal", 4),
        );
    }
    cases.reject("zero-witness", &leaf("0 0"), expecting("not_normal", "α, β not both 0"));
    cases.reject(
        "of-adjacent-nodes-that-touch",
        &step().token(3, "not_normal -1 0"),
        obligation_at("not_normal", 3),
    );
    cases.reject(
        "of-a-node-with-itself",
        &step().token(1, "not_normal -1 0"),
        expecting("not_normal", "two different nodes"),
    );
    cases.reject(
        "of-a-double-normal",
        &channel().token(4, "not_normal 1 1"),
        obligation_at("not_normal", 4),
    );

    // The two sides' tangents have different denominators: (2, 0) and (1/1000, 0).
    let scales = polygon(json!([[0, 0], [2, 0], [3, 1], ["3001/1000", 1]]));
    let scaled = |factors: &str| leaf(factors).curve(scales.clone());
    for (factors, holds) in [
        ("-1 1000", true),
        ("-1 1999", true),
        ("-1 2000", false),
        ("-1 3000", false),
    ] {
        let name = format!("scales-{}", factors.replace(' ', "-"));
        if holds {
            cases.accept(&name, &scaled(factors));
        } else {
            cases.reject(&name, &scaled(factors), obligation_at("not_normal", 4));
        }
    }

    // Runs take one factor only: the pairs of their tangents are too many.
    let long = polygon(json!([
        [0, 0],
        [1, 0],
        [2, 0],
        [3, 0],
        [4, 1],
        [5, 1],
        [6, 1],
        [7, 1],
        [8, 1]
    ]));
    let statement = Certificate::new(long).with("/statement/lower_squared", json!("inf"));
    let (long, leaf) = grow_with_leaf(&statement, [Node::Run(0, 2), Node::Run(6, 8)]);
    for (factors, holds) in [("-1 0", true), ("0 -1", true), ("-1 -1", false), ("-1 -2", false)] {
        let (name, certificate) = (
            format!("runs-{}", factors.replace(' ', "-")),
            long.clone().token(leaf, &format!("not_normal {factors}")),
        );
        if holds {
            cases.accept(&name, &certificate);
        } else {
            cases.reject(&name, &certificate, obligation_at("not_normal", leaf));
        }
    }

    // Criticality at an open end is an inequality: the chord of both ends, from (0,0) to (end, 3).
    let [(inward, i), (outward, o)] = [1, -1].map(ends);
    let at = |(certificate, leaf): (&Certificate, usize), factors: &str| {
        certificate.clone().token(leaf, &format!("not_normal {factors}"))
    };
    let (inward, outward) = ((&inward, i), (&outward, o));
    cases.accept("ends-leaning-in", &at(inward, "-1 0"));
    cases.reject(
        "ends-leaning-in-wrong-sign",
        &at(inward, "1 0"),
        expecting("not_normal", "α ≤ 0 at an end of the curve"),
    );
    // Here the end at 0 is critical, by the inequality, and only the other end is not.
    cases.accept("ends-leaning-out", &at(outward, "0 -1"));
    cases.reject(
        "positive-factor-at-the-start",
        &at(outward, "1 0"),
        expecting("not_normal", "α ≤ 0 at an end of the curve"),
    );
    cases.reject(
        "positive-factor-beside-another-at-the-start",
        &at(outward, "1 -1"),
        expecting("not_normal", "α ≤ 0 at an end of the curve"),
    );
    cases.reject(
        "positive-factor-at-the-end",
        &at(inward, "0 1"),
        expecting("not_normal", "β ≤ 0 at an end of the curve"),
    );
    cases.reject(
        "positive-factor-beside-another-at-the-end",
        &at(inward, "-1 1"),
        expecting("not_normal", "β ≤ 0 at an end of the curve"),
    );
    // Two critical ends: neither sign of either factor excludes their chord.
    let (both, leaf) = critical_ends();
    cases.accept("critical-ends-under-far", &both);
    for factors in ["1 0", "-1 0", "0 1", "0 -1", "1 1", "-1 -1", "1 -1", "-1 1"] {
        let name = format!("critical-ends-{}", factors.replace(' ', "-"));
        cases.reject(&name, &at((&both, leaf), factors), obligation_at("not_normal", leaf));
    }
    // In the convention `smooth` the ends are ordinary.
    assert_eq!(STEP[4], "not_normal -1 0");
    cases.list()
}
