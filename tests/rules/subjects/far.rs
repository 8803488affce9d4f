//! `far n`.

use serde_json::{Value, json};

use super::channel;
use crate::common::case::{Case, Cases, expecting, obligation_at};
use crate::common::document::{Certificate, polygon};
use crate::common::grow::grow_with_leaf;
use crate::common::tree::Node;

/// A channel of eight pieces and height 31/3: three pieces below, two beside, three above.
fn ladder_curve() -> Value {
    polygon(json!([
        [0, 0],
        [1, 0],
        [2, 0],
        [3, 0],
        [3, 5],
        [3, "31/3"],
        [2, "31/3"],
        [1, "31/3"],
        [0, "31/3"]
    ]))
}

/// Its tree, with a leaf for the two pieces lowest on the left and the two uppermost.
fn ladder() -> (Certificate, usize) {
    let statement = Certificate::new(ladder_curve()).with("/statement/lower_squared", json!("100"));
    grow_with_leaf(&statement, [Node::Run(0, 2), Node::Run(6, 8)])
}

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("far");
    let far = |n: &str| channel().token(4, &format!("far {n}"));
    cases.accept("attained", &channel());
    cases.accept("longer-witness", &far("0 -7"));
    cases.accept(
        "slanted-witness",
        &far("1 -100").with("/statement/lower_squared", json!("8")),
    );
    cases.reject("slanted-witness-too-weak", &far("1 -100"), obligation_at("far", 4));
    cases.reject(
        "lower-bound-above",
        &channel().with("/statement/lower_squared", json!("9000001/1000000")),
        obligation_at("far", 4),
    );
    cases.reject(
        "negative-gap-whose-square-suffices",
        &far("0 1"),
        obligation_at("far", 4),
    );
    cases.reject("orthogonal-witness", &far("1 0"), obligation_at("far", 4));
    cases.reject("zero-witness", &far("0 0"), obligation_at("far", 4));
    cases.reject(
        "of-a-node-with-itself",
        &channel().token(1, "far 1 0"),
        expecting("far", "two different nodes"),
    );
    cases.reject(
        "of-adjacent-nodes",
        &channel().token(3, "far 0 -1"),
        obligation_at("far", 3),
    );
    let infinite = channel().with("/statement/lower_squared", json!("inf"));
    cases.reject(
        "lower-inf-beside-a-far-leaf",
        &infinite,
        expecting("far", "no far leaf under a statement of no double normal"),
    );
    cases.reject(
        "whole-curve",
        &Certificate::new(super::channel_curve()).lower("9", &["far 1 0"]),
        obligation_at("far", 0),
    );

    // Witnesses whose squared length wraps to 0, or to something small, in some width of machine integer.
    for bits in [15u32, 16, 31, 32, 33, 62, 63, 64, 127, 128, 255, 256, 4094] {
        let n = format!("0 -{}", power_of_two(bits));
        cases.accept(&format!("witness-of-2-to-the-{bits}"), &far(&n));
        let above = far(&n).with("/statement/lower_squared", json!("10"));
        cases.reject(
            &format!("witness-of-2-to-the-{bits}-too-weak"),
            &above,
            obligation_at("far", 4),
        );
    }

    // The box of a run reaches to the grid: 10 for height 31/3 on the grid of integers, 41/4 on that of quarters.
    let (ladder, leaf) = ladder();
    cases.accept("run-on-the-grid-of-integers", &ladder);
    let finer = |grid: u32| {
        ladder
            .clone()
            .with("/statement/lower_squared", json!("1681/16"))
            .with("/evidence/grid", json!(grid))
    };
    cases.accept("run-on-the-grid-of-quarters", &finer(2));
    cases.reject("run-on-too-coarse-a-grid", &finer(1), obligation_at("far", leaf));
    cases.reject(
        "run-on-the-grid-never-attains",
        &ladder
            .clone()
            .with("/statement/lower_squared", json!("961/9"))
            .with("/evidence/grid", json!(60)),
        obligation_at("far", leaf),
    );
    cases.list()
}

/// 2^bits in decimal.
fn power_of_two(bits: u32) -> String {
    knotproof::number::Integer::from(2).pow(bits).to_string()
}
