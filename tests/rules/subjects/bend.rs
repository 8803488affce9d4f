//! `bend α β`.

use serde_json::json;

use super::{SEGMENT, channel, channel_curve, segment_curve, step};
use crate::common::case::{Case, Cases, expecting, obligation_at};
use crate::common::document::{Certificate, bezier, polygon};

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("bend");
    let corner = |factors: &str| channel().token(3, &format!("bend {factors}"));
    cases.accept("right-angles", &channel());
    cases.accept("right-angle-other-factors", &corner("7 1000"));
    cases.accept(
        "right-angle-huge-factors",
        &corner(&format!("3{0} 4{0}", "0".repeat(900))),
    );
    cases.reject("zero-witness", &corner("0 0"), expecting("bend", "α, β not both 0"));
    for factors in ["-1 -1", "1 0", "0 1", "1 -1", "-1 1"] {
        cases.reject(
            &format!("right-angle-{}", factors.replace(' ', "-")),
            &corner(factors),
            obligation_at("bend", 3),
        );
    }
    cases.reject(
        "not-adjacent",
        &step().token(4, "bend 1 1"),
        expecting("bend", "adjacent nodes"),
    );

    // Corners that turn by 150°, nearly 180°, and 180°. On two sides of equal length α = β does.
    let turn = |x: &str, y: &str| {
        Certificate::new(polygon(json!([[0, 0], [1, 0], [x, y]])))
            .lower("inf", &["split", "cone 1 0", "bend 1 1", "cone -1 0"])
    };
    cases.accept("turn-by-nearly-180-degrees", &turn("2/10001", "200/10001"));
    cases.reject("turn-by-180-degrees", &turn("0", "0"), obligation_at("bend", 2));
    cases.reject(
        "turn-by-180-degrees-shorter",
        &turn("1/2", "0").token(2, "bend 1 2"),
        obligation_at("bend", 2),
    );
    // A crossing of two sides is more than a bend.
    let bow = polygon(json!([[-1, -1], [1, 1], [1, -1], [-1, 1]]));
    let crossed = Certificate::new(bow).lower(
        "inf",
        &[
            "split",
            "cone 1 1",
            "second",
            "bend 2 3",
            "bend 1 1",
            "split",
            "cone 0 -1",
            "bend 3 2",
            "cone -1 1",
        ],
    );
    cases.reject("crossing-sides", &crossed, expecting("bend", "adjacent nodes"));
    // Within one node: an arc with a control polygon that turns by 90° is no problem for β = 0, one that turns by 180° is.
    let arc = |points| Certificate::new(bezier(json!([points]))).lower("inf", &["bend 1 0"]);
    cases.accept("one-node", &arc(json!([[0, 0], [2, 0], [3, 1]])));
    cases.reject(
        "one-node-right-angle",
        &arc(json!([[0, 0], [2, 0], [2, 1]])),
        obligation_at("bend", 0),
    );
    cases.reject(
        "one-node-turning-back",
        &arc(json!([[0, 0], [2, 0], [1, 0]])),
        obligation_at("bend", 0),
    );

    // Different denominators of the two sides: (2, 0) and (1/1000, 0).
    let scales = Certificate::new(polygon(json!([[0, 0], [2, 0], ["2001/1000", 0]])))
        .lower("inf", &["split", "cone 1 0", "bend 1 1", "cone 1 0"]);
    cases.accept("scales-1--1999", &scales.clone().token(2, "bend 1 -1999"));
    cases.reject(
        "scales-1--2000",
        &scales.clone().token(2, "bend 1 -2000"),
        obligation_at("bend", 2),
    );
    cases.reject(
        "scales-1--2001",
        &scales.token(2, "bend 1 -2001"),
        obligation_at("bend", 2),
    );

    // Runs get no bend, whatever its obligation would be: here all tangents are alike.
    let straight = polygon(json!([[0, 0], [1, 0], [2, 0], [3, 0], [4, 0]]));
    let run = |leaf: &str| Certificate::new(straight.clone()).lower("inf", &[leaf]);
    cases.accept("run-under-cone", &run("cone 1 0"));
    cases.reject("run-with-itself", &run("bend 1 0"), obligation_at("bend", 0));
    let halves = |leaf: &str| Certificate::new(straight.clone()).lower("inf", &["split", "cone 1 0", leaf, "cone 1 0"]);
    cases.accept("two-runs-under-cone", &halves("cone 1 0"));
    cases.reject("two-runs", &halves("bend 1 1"), obligation_at("bend", 2));

    // An end takes its own factor with one sign only.
    let segment = |token: usize, leaf: &str| {
        Certificate::new(segment_curve())
            .critical()
            .lower("inf", &SEGMENT)
            .token(token, leaf)
    };
    cases.accept("end-against-its-piece", &segment(2, "bend 1 0"));
    cases.accept("end-against-its-piece-by-the-piece", &segment(2, "bend 0 1"));
    cases.accept("end-against-its-piece-both", &segment(2, "bend 3 -1"));
    cases.reject(
        "negative-factor-at-the-start",
        &segment(2, "bend -1 3"),
        expecting("bend", "α ≥ 0 at the end at 0"),
    );
    cases.accept("piece-against-its-end-both", &segment(6, "bend -1 3"));
    cases.reject(
        "negative-factor-at-the-end",
        &segment(6, "bend 3 -1"),
        expecting("bend", "β ≥ 0 at the end at M"),
    );
    cases.reject(
        "both-ends-are-not-adjacent",
        &segment(3, "bend 1 1"),
        expecting("bend", "adjacent nodes"),
    );

    // A corner against the piece behind it, and against both of its pieces with the wrong factor.
    let corners = Certificate::new(channel_curve())
        .critical()
        .with("/statement/lower_squared", json!("9"));
    let part = |piece| Node::Part {
        piece,
        index: 0,
        depth: 0,
    };
    let (grown, leaf) = grow_with_leaf(&corners, [Node::Point(Element::Corner(1)), part(1)]);
    cases.accept("corner-against-its-next-piece", &grown.clone().token(leaf, "bend 0 1"));
    cases.reject(
        "corner-against-its-next-piece-by-the-corner",
        &grown.token(leaf, "bend 1 0"),
        obligation_at("bend", leaf),
    );
    cases.list()
}

use crate::common::grow::grow_with_leaf;
use crate::common::tree::{Element, Node};
