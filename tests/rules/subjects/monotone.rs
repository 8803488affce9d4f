//! `monotone n`, and the margins of its leaves.

use serde_json::{Value, json};

use super::embedding::{embedded_channel, embedding, moving};
use super::separate::{arch, beyond_infinity};
use crate::common::case::{Case, Cases, at_token, expecting, obligation_at};
use crate::common::document::{bezier, exact, polygon};

/// A polygon that comes back to the origin, the end of piece 0, at the start of piece 3.
const RETURNING: [&str; 10] = [
    "split",
    "split",
    "monotone 2 1",
    "monotone 4 1",
    "monotone 1 0",
    "first",
    "second",
    "separate -3 4",
    "second",
    "monotone 1 1",
];

/// A hexagon, closed in the middle of its bottom side. Token 14 is for its first side and the last one.
fn hexagon(last: Value) -> Value {
    polygon(json!([[0, 0], [2, 0], [4, 3], [2, 6], [-2, 6], [-4, 3], [-2, 0], last]))
}

const HEXAGON: [&str; 24] = [
    "split",
    "split",
    "monotone 1 0",
    "second",
    "monotone 1 0",
    "separate -5 -7",
    "monotone 0 1",
    "second",
    "first",
    "separate 0 -1",
    "second",
    "monotone -2 3",
    "separate 1 0",
    "first",
    "monotone 3 -2",
    "separate 1 0",
    "split",
    "monotone -3 -2",
    "first",
    "separate 0 1",
    "second",
    "monotone 0 -1",
    "separate -5 7",
    "monotone 3 -2",
];

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("monotone");
    let channel = moving(&embedded_channel(), "0", "0");
    cases.accept("corner", &channel.clone().token(3, "monotone 1 1"));
    cases.accept("nearly-along-one-side", &channel.clone().token(3, "monotone 1000000 1"));
    let huge = format!("monotone 1{0} 1{0}", "0".repeat(1000));
    cases.accept("huge-witness", &channel.clone().token(3, &huge));
    cases.reject(
        "along-one-side",
        &channel.clone().token(3, "monotone 1 0"),
        obligation_at("monotone", 3),
    );
    cases.reject(
        "backwards",
        &channel.clone().token(3, "monotone -1 -1"),
        obligation_at("monotone", 3),
    );
    cases.reject(
        "zero-witness",
        &channel.clone().token(3, "monotone 0 0"),
        expecting("monotone", "n ≠ 0"),
    );
    cases.reject(
        "not-adjacent",
        &channel.token(4, "monotone 0 1"),
        expecting("monotone", "adjacent nodes"),
    );
    // More than a right angle between tangents is no obstacle, half a turn is.
    let wide = |x: i64| {
        embedding(
            polygon(json!([[0, 0], [-x, 1], [0, 2]])),
            &["monotone 0 1"],
            1,
            ["0", "0"],
        )
    };
    cases.accept("sharp-corner", &wide(1000));
    let back = embedding(
        polygon(json!([[0, 0], [2, 0], [1, 0]])),
        &["monotone 1 0"],
        1,
        ["0", "0"],
    );
    cases.reject("turning-back", &back, obligation_at("monotone", 0));

    // Adjacent means sharing a parameter, not a point.
    let returning = polygon(json!([[-2, -1], [0, 0], [3, 0], [-1, -3], [0, 0], [1, 2]]));
    cases.reject(
        "end-points-coincide-but-parameters-differ",
        &embedding(returning, &RETURNING, 5, ["0", "0"]),
        expecting("monotone", "adjacent nodes"),
    );
    closed(&mut cases);
    margins(&mut cases);
    cases.list()
}

/// Adjacency across the closing point.
fn closed(cases: &mut Cases) {
    let certificate = embedding(hexagon(json!([0, 0])), &HEXAGON, 7, ["1/2", "69/100"]);
    cases.accept("across-the-closing-point", &certificate);
    let open = certificate
        .with("/statement/edges", json!(7))
        .curve(hexagon(json!(["-1/1000000", 0])));
    cases.reject("across-a-gap", &moving(&open, "0", "0"), |rejection| {
        expecting("monotone", "adjacent nodes")(rejection) && at_token(rejection, 14)
    });

    // An unclamped spline whose first and last control points are equal: it starts at (1,0) and ends at (−1,0).
    let points = json!([
        [0, 0],
        [2, 0],
        [4, 1],
        [3, 4],
        [0, 5],
        [-3, 4],
        [-4, 1],
        [-2, 0],
        [0, 0]
    ]);
    let knots: Vec<String> = (0..12).map(|i| i.to_string()).collect();
    let spline = json!({ "bspline": { "degree": 2, "knots": knots, "points": exact(points) } });
    let tree = ["split", "monotone 1 7", "second", "second", "first", "monotone 1 0"];
    let whole = embedding(spline, &tree, 5, ["0", "0"]);
    cases.reject(
        "equal-end-control-points-of-an-open-spline",
        &whole,
        expecting("monotone", "adjacent nodes"),
    );
}

/// Margins.
fn margins(cases: &mut Cases) {
    // Halved, D has coefficients like (P₂−P₀)/2 with Σ|m_j| = 1: 4/9 of the leaf with n = (2, −1), where 1/4 would be without that.
    cases.accept("shared-control-points", &arch("4/27", "separate -1 0"));
    cases.reject(
        "shared-control-points-moved-farther",
        &arch("149/1000", "separate -1 0"),
        beyond_infinity,
    );
    // A quarter of a circle: D = 2w₀w₁(P₁−P₀), w₀w₂(P₂−P₀), 2w₁w₂(P₂−P₁).
    let quarter = json!({ "bezier": { "pieces": [
        { "points": [["1", "0"], ["1", "1"], ["0", "1"]], "weights": ["1", "1", "2"] }
    ] } });
    let certificate = embedding(quarter, &["monotone -1 1"], 1, ["1/4", "353/1000"]);
    cases.accept("rational", &certificate);
    cases.reject(
        "rational-moved-farther",
        &moving(&certificate, "251/1000", "353/1000"),
        beyond_infinity,
    );
    // Two pieces of the same direction.
    let two = bezier(json!([[[0, 0], [1, 1], [2, 0]], [[2, 0], [3, -1], [4, 0]]]));
    let certificate = embedding(two, &["monotone 1 0"], 1, ["1/2", "1/2"]);
    cases.accept("joint", &certificate);
    cases.reject(
        "joint-moved-farther",
        &moving(&certificate, "501/1000", "1/2"),
        beyond_infinity,
    );
}
