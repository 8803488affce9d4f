//! `pedal z₁ z₂ r l m`.

use serde_json::{Value, json};

use crate::common::case::{Case, Cases, expecting};
use crate::common::document::{Certificate, bezier, exact};

fn arc(points: Value) -> Value {
    json!({ "points": exact(points), "weights": ["1", "1", "2"] })
}

/// Quarters of circles of radius 3 and 1 around the origin, joined by a radius.
fn channel() -> Value {
    chain(json!([
        arc(json!([[3, 0], [3, 3], [0, 3]])),
        { "points": exact(json!([[0, 3], [0, 1]])) },
        arc(json!([[0, 1], [1, 1], [1, 0]]))
    ]))
}

/// The unit circle in four quarters.
fn disk() -> Value {
    chain(json!([
        arc(json!([[1, 0], [1, 1], [0, 1]])),
        arc(json!([[0, 1], [-1, 1], [-1, 0]])),
        arc(json!([[-1, 0], [-1, -1], [0, -1]])),
        arc(json!([[0, -1], [1, -1], [1, 0]]))
    ]))
}

fn chain(pieces: Value) -> Value {
    json!({ "bezier": { "pieces": pieces } })
}

/// The channel's tree with the same leaf wherever the two arcs face each other.
fn facing(lower: &str, leaf: &str) -> Certificate {
    let tree = [
        "split",
        "split",
        "cone -2 3",
        "bend 1 1",
        "cone -3 1",
        "first",
        "second",
        "first",
        "far 1 0",
        "not_normal -2 -3",
        leaf,
        "second",
        "bend 1 3",
        leaf,
        "split",
        "cone 0 -3",
        "first",
        "not_normal -1 0",
        "second",
        "bend 1 1",
        "not_normal -1 0",
        "split",
        "cone 3 -2",
        "bend 1 1",
        "cone 1 -3",
    ];
    Certificate::new(channel()).lower(lower, &tree)
}

/// The circle's tree with the same leaf wherever two parts are opposite.
fn opposite(lower: &str, leaf: &str) -> Certificate {
    let tree = [
        "split",
        "split",
        "split",
        "cone -2 3",
        "bend 1 1",
        "cone -3 1",
        "first",
        "second",
        "not_normal -1 -1",
        leaf,
        "second",
        "bend 1 1",
        "not_normal -1 0",
        "split",
        "cone -3 -2",
        "bend 1 1",
        "cone -1 -3",
        "first",
        "second",
        leaf,
        "first",
        "second",
        "not_normal 1 1",
        "bend 1 1",
        "second",
        leaf,
        "not_normal 1 0",
        "second",
        "first",
        "second",
        "not_normal -1 -1",
        leaf,
        "second",
        "bend 1 1",
        "not_normal -1 0",
        leaf,
        "split",
        "split",
        "cone 2 -3",
        "bend 1 1",
        "cone 3 -1",
        "first",
        "second",
        "not_normal -1 -1",
        leaf,
        "second",
        "bend 1 1",
        "not_normal -1 0",
        "split",
        "cone 3 2",
        "bend 1 1",
        "cone 1 3",
    ];
    Certificate::new(disk()).lower(lower, &tree)
}

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("pedal");
    cases.accept("concentric-arcs", &facing("4", "pedal 0 0 1 3 -1"));
    cases.accept("concentric-arcs-less", &facing("3", "pedal 0 0 10 29 -11"));
    let zeros = "0".repeat(700);
    cases.accept(
        "concentric-arcs-huge-witness",
        &facing("4", &format!("pedal 0 0 1{zeros} 3{zeros} -1{zeros}")),
    );
    cases.accept("opposite-arcs", &opposite("4", "pedal 0 0 1 1 1"));
    cases.accept("opposite-arcs-unequal", &opposite("2", "pedal 0 0 10 5 10"));

    let length = expecting("pedal", "l+m > 0 and (l+m)² ≥ r²·lower_squared");
    cases.reject(
        "concentric-arcs-above",
        &facing("4000001/1000000", "pedal 0 0 1 3 -1"),
        length.clone(),
    );
    cases.reject(
        "opposite-arcs-above",
        &opposite("4000001/1000000", "pedal 0 0 1 1 1"),
        length.clone(),
    );
    cases.reject("negative-sum", &facing("4", "pedal 0 0 1 1 -3"), length.clone());
    cases.reject("too-short-a-sum", &facing("4", "pedal 0 0 1 3 -2"), length);
    let signs = expecting("pedal", "r > 0, l and m not 0");
    for (name, leaf) in [
        ("scale-zero", "pedal 0 0 0 3 -1"),
        ("scale-negative", "pedal 0 0 -1 3 -1"),
        ("first-zero", "pedal 0 0 1 0 2"),
        ("second-zero", "pedal 0 0 1 2 0"),
    ] {
        cases.reject(name, &facing("4", leaf), signs.clone());
    }
    let far = expecting("pedal", "all tangents as far from z as stated");
    let near = expecting("pedal", "all tangents as near to z as stated");
    cases.reject("outer-too-far", &facing("4", "pedal 0 0 1000 3001 -1000"), far.clone());
    cases.reject("inner-too-near", &facing("4", "pedal 0 0 1000 3000 -999"), near.clone());
    cases.reject("parts-exchanged", &facing("4", "pedal 0 0 1 -1 3"), near);
    cases.reject(
        "beside-the-center",
        &facing("4", "pedal 1 0 1000 3000 -1000"),
        far.clone(),
    );
    cases.reject(
        "opposite-too-far",
        &opposite("4", "pedal 0 0 1000 1001 1000"),
        far.clone(),
    );
    cases.reject(
        "opposite-second-too-far",
        &opposite("4", "pedal 0 0 1000 1000 1001"),
        far,
    );
    // Arcs on one side of z are nearer to each other than the sum of their distances.
    cases.reject(
        "sum-on-one-side",
        &facing("4", "pedal 0 0 1 3 -1").token(10, "pedal 0 0 1 3 1"),
        expecting("pedal", "(p−z)·(q−z) ≤ 0 for all hull points"),
    );

    // A line through the center crosses the arc: its tangent is at distance 0 from the center, and the chord is 0.
    let crossed = chain(json!([
        { "points": exact(json!([[4, 4], [0, 0]])) },
        { "points": exact(json!([[0, 0], [3, 0]])) },
        arc(json!([[3, 0], [3, 3], [0, 3]]))
    ]));
    cases.reject(
        "line-through-the-center",
        &Certificate::new(crossed).lower("4", &["split", "cone -1 -1", "second", "bend 1 2", "pedal 0 0 1 -1 3"]),
        expecting(
            "pedal",
            "the nearer part's hull points nearer to z than the other's tangents",
        ),
    );

    cases.reject(
        "no-double-normal",
        &facing("inf", "pedal 0 0 1 3 -1").token(8, "pedal 0 0 1 3 -1"),
        expecting("pedal", "no pedal leaf under a statement of no double normal"),
    );
    cases.reject(
        "one-node",
        &facing("4", "pedal 0 0 1 3 -1").token(2, "pedal 0 0 1 3 -1"),
        expecting("pedal", "two different nodes"),
    );
    cases.reject(
        "run",
        &facing("4", "pedal 0 0 1 3 -1").token(5, "pedal 0 0 1 3 -1"),
        expecting("pedal", "two parts of pieces"),
    );
    let space = bezier(json!([
        [[3, 0, 0], [3, 3, 0]],
        [[3, 3, 0], [0, 3, 1]],
        [[0, 3, 1], [1, 3, 1]]
    ]));
    cases.reject(
        "space",
        &Certificate::new(space).lower("1", &["split", "cone 0 1 0", "second", "bend 1 1", "pedal 0 0 1 3 -1"]),
        expecting("pedal", "a planar curve"),
    );
    cases.list()
}
