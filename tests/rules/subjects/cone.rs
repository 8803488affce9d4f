//! `cone n`.

use knotproof::check::Rejection;
use serde_json::{Value, json};

use super::{channel, step};
use crate::common::case::{Case, Cases, at_token, expecting, obligation_at};
use crate::common::document::{Certificate, bezier, exact, polygon};
use crate::common::grow::grow_with_leaf;
use crate::common::tree::Node;

/// A polygon that comes back to the origin at joint 4 in nearly the direction in which it reached it at joint 1.
fn returning(last: [i64; 2]) -> Value {
    polygon(json!([[-2, -1], [0, 0], [3, 0], [-1, -3], last, [1, 2]]))
}

/// A tree up to the pair of pieces 0 and 3, token 9, that touch in the origin without being adjacent.
const RETURNING: [&str; 10] = [
    "split", "split", "cone 2 1", "cone 4 1", "cone 1 0", "first", "second", "far -3 4", "second", "cone 1 1",
];

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("cone");
    cases.accept("chain-of-gentle-turns", &step());
    cases.accept(
        "huge-witness",
        &step().token(3, &format!("cone 2{0} 1{0}", "0".repeat(1000))),
    );
    cases.reject("zero-witness", &step().token(3, "cone 0 0"), expecting("cone", "n ≠ 0"));
    cases.reject("backwards", &step().token(3, "cone -2 -1"), obligation_at("cone", 3));
    cases.reject(
        "not-adjacent",
        &step().token(4, "cone 1 0"),
        expecting("cone", "adjacent nodes"),
    );
    // 2(v·n)² = (v·v)(n·n) for both sides of a right angle: 45° is not enough.
    cases.reject(
        "exactly-45-degrees",
        &channel().token(3, "cone 1 1"),
        obligation_at("cone", 3),
    );
    cases.reject(
        "tangent-at-45-degrees",
        &step().token(3, "cone 1 0"),
        obligation_at("cone", 3),
    );
    cases.accept("just-below-45-degrees", &step().token(3, "cone 1000000 1"));
    // All tangents of a half circle's control polygon are in a half plane, not in a cone.
    let arch = bezier(json!([[[0, 0], [0, 2], [2, 2], [2, 0]]]));
    cases.reject(
        "half-plane-only",
        &Certificate::new(arch).lower("inf", &["cone 1 0"]),
        obligation_at("cone", 0),
    );

    // Adjacent means sharing a parameter, not a point.
    let crossing = Certificate::new(returning([0, 0])).lower("1", &RETURNING);
    cases.reject(
        "end-points-coincide-but-parameters-differ",
        &crossing,
        expecting("cone", "adjacent nodes"),
    );
    cases.reject(
        "end-points-coincide-bend",
        &crossing.clone().token(9, "bend 1 0"),
        expecting("bend", "adjacent nodes"),
    );

    // Zero coefficients at an end with coincident control points are no tangents.
    let coincident = bezier(json!([[[0, 0], [0, 0], [1, 1], [3, 1]]]));
    cases.accept(
        "coincident-control-points",
        &Certificate::new(coincident).lower("inf", &["cone 2 1"]),
    );
    let cusp = bezier(json!([[[0, 0], [2, 0], [0, 0], [2, 0]]]));
    cases.reject(
        "turning-back",
        &Certificate::new(cusp).lower("inf", &["cone 1 0"]),
        obligation_at("cone", 0),
    );

    closed_cases(&mut cases);
    cases.list()
}

/// Adjacency across the closing point.
fn closed_cases(cases: &mut Cases) {
    // A hexagon, closed at the middle of its bottom side.
    let hexagon = polygon(json!([
        [0, 0],
        [2, 0],
        [4, 3],
        [2, 6],
        [-2, 6],
        [-4, 3],
        [-2, 0],
        [0, 0]
    ]));
    let sides = [0, 6].map(|piece| Node::Part {
        piece,
        index: 0,
        depth: 0,
    });
    let statement = Certificate::new(hexagon).with("/statement/lower_squared", json!("1"));
    let (closed, leaf) = grow_with_leaf(&statement, sides);
    let closed = closed.token(leaf, "cone 1 0");
    cases.accept("across-the-closing-point", &closed);
    // The last point a hair away from the first: open, and those two nodes are not adjacent.
    let open = polygon(json!([
        [0, 0],
        [2, 0],
        [4, 3],
        [2, 6],
        [-2, 6],
        [-4, 3],
        [-2, 0],
        ["-1/1000000", 0]
    ]));
    cases.reject("across-a-gap", &closed.curve(open), closing(leaf));

    // An unclamped spline whose first and last control points are equal: it starts at (1,0) and ends at (-1,0).
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
    let statement = Certificate::new(spline).with("/statement/lower_squared", json!("1"));
    let (open, leaf) = grow_with_leaf(&statement, sides);
    cases.accept("unclamped-and-open", &open);
    cases.reject(
        "equal-end-control-points-of-an-open-spline",
        &open.token(leaf, "cone 1 0"),
        closing(leaf),
    );
}

fn closing(leaf: usize) -> impl Fn(&Rejection) -> bool {
    move |rejection| expecting("cone", "adjacent nodes")(rejection) && at_token(rejection, leaf)
}
