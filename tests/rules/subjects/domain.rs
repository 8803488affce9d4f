//! The set K ∩ B of the claim `domain`: points, sign, interval, open ends, box; and the two smallest examples.

use knotproof::check::domain::sign::DomainError;
use knotproof::check::{Reason, Rejection};
use serde_json::{Value, json};

use crate::common::case::{Case, Cases, expecting, reason};
use crate::common::document::{Certificate, bezier, exact};

/// The parabola (0,0), x, (2,0): h is 2·(−x₁) for the sign +, so K is the upper half-plane for the sign −.
pub fn parabola() -> Value {
    bezier(json!([[[0, 0], [1, 1], [2, 0]]]))
}

/// A certificate about `curve` with this outcome; sign −, the only control point 1, the whole first piece, the box [−1,3] × [−1,1].
pub fn about(curve: Value, outcome: Value, evidence: Value) -> Certificate {
    let mut certificate = Certificate::new(curve);
    certificate.0["statement"] = json!({
        "claim": "domain", "points": [1], "sign": "-", "interval": ["0", "1"], "open": [false, false],
        "box": [["-1", "-1"], ["3", "1"]], "outcome": outcome
    });
    certificate.0["evidence"] = evidence;
    certificate
}

/// K ∩ B of [`parabola`] is [−1,3] × (0,1], exactly between two equal rectangles.
pub fn rectangle() -> Certificate {
    let corners = exact(json!([[-2, 0], [6, 0], [6, 2], [-2, 2]]));
    about(
        parabola(),
        json!({ "kind": "sandwich", "inner_measure": "4", "outer_measure": "4" }),
        json!({
            "denominator": "2", "center": ["2", "1"],
            "inner": { "points": corners, "cells": [[0, 1], [1, 2], [2, 3], [3, 0]] },
            "outer": { "points": corners, "cells": [[0, 1, 0], [1, 2, 1], [2, 3, 2], [3, 0, 3]] },
            "rows": [
                { "piece": 0, "u": "1/2" }, { "axis": 0, "side": "high" },
                { "axis": 1, "side": "high" }, { "axis": 0, "side": "low" }
            ]
        }),
    )
}

/// The twisted cubic 0, x, (1,0,0), (1,1,0): h is x₂, K the upper half-space; K ∩ [−1,1]³ is exactly a block.
pub fn block() -> Certificate {
    let corners: Vec<Value> = (0..8)
        .map(|k| {
            exact(json!([
                if k & 1 == 0 { -2 } else { 2 },
                if k & 2 == 0 { -2 } else { 2 },
                if k & 4 == 0 { 0 } else { 2 }
            ]))
        })
        .collect();
    // Counter-clockwise from outside, with the row of the side.
    let sides: [([usize; 4], usize); 6] = [
        ([0, 2, 3, 1], 0),
        ([4, 5, 7, 6], 1),
        ([0, 1, 5, 4], 2),
        ([2, 6, 7, 3], 3),
        ([0, 4, 6, 2], 4),
        ([1, 3, 7, 5], 5),
    ];
    let triangles = |row: bool| -> Vec<Value> {
        sides
            .iter()
            .flat_map(|([a, b, c, d], number)| {
                [[a, b, c], [a, c, d]].map(|t| {
                    if row {
                        json!([t[0], t[1], t[2], number])
                    } else {
                        json!(t)
                    }
                })
            })
            .collect()
    };
    let curve = bezier(json!([[[0, 0, 0], [0, 0, 1], [1, 0, 0], [1, 1, 0]]]));
    let mut certificate = about(
        curve,
        json!({ "kind": "sandwich", "inner_measure": "4", "outer_measure": "4" }),
        json!({
            "denominator": "2", "center": ["0", "0", "1"],
            "inner": { "points": corners, "cells": triangles(false) },
            "outer": { "points": corners, "cells": triangles(true) },
            "rows": [
                { "piece": 0, "u": "0" }, { "axis": 2, "side": "high" }, { "axis": 1, "side": "low" },
                { "axis": 1, "side": "high" }, { "axis": 0, "side": "low" }, { "axis": 0, "side": "high" }
            ]
        }),
    );
    certificate.0["statement"]["sign"] = json!("+");
    certificate.0["statement"]["box"] = exact(json!([[-1, -1, -1], [1, 1, 1]]));
    certificate
}

fn domain(error: DomainError) -> impl Fn(&Rejection) -> bool + Clone {
    reason(Reason::Domain(error))
}

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("domain");
    cases.accept("half-plane", &rectangle());
    cases.accept("half-space", &block());
    cases.accept_bytes("half-plane-binary", rectangle().binary());

    let center = "a sign function positive by halving";
    let with = |pointer: &str, value: Value| rectangle().with(&format!("/statement/{pointer}"), value);
    cases.reject(
        "the-other-sign",
        &with("sign", json!("+")),
        expecting("sandwich", center),
    );
    cases.reject(
        "the-other-sign-in-space",
        &block().with("/statement/sign", json!("-")),
        expecting("sandwich", center),
    );
    cases.reject("no-points", &with("points", json!([])), domain(DomainError::Points));
    cases.reject(
        "a-point-twice",
        &with("points", json!([1, 1])),
        domain(DomainError::Points),
    );
    cases.reject(
        "points-decreasing",
        &with("points", json!([1, 0])),
        domain(DomainError::Points),
    );
    cases.reject(
        "a-point-that-is-not-there",
        &with("points", json!([3])),
        domain(DomainError::Points),
    );
    cases.reject(
        "another-point",
        &with("points", json!([0])),
        expecting("sandwich", "a sign function non-negative by halving"),
    );
    cases.reject(
        "interval-reversed",
        &with("interval", json!(["1", "0"])),
        domain(DomainError::Interval),
    );
    cases.reject(
        "interval-empty",
        &with("interval", json!(["1", "1"])),
        domain(DomainError::Interval),
    );
    cases.reject(
        "interval-before-the-curve",
        &with("interval", json!(["-1/2", "1"])),
        domain(DomainError::Interval),
    );
    cases.reject(
        "interval-behind-the-curve",
        &with("interval", json!(["0", "3/2"])),
        domain(DomainError::Interval),
    );
    let side = "rows of the sections and the box";
    cases.accept("part-of-the-curve", &with("interval", json!(["1/3", "6/7"])));
    cases.reject(
        "row-outside-the-interval",
        &with("interval", json!(["3/5", "6/7"])),
        expecting("sandwich", side),
    );
    cases.accept("open-where-nothing-vanishes", &with("open", json!([true, true])));
    cases.reject(
        "box-flat",
        &with("box", json!([["-1", "1"], ["3", "1"]])),
        domain(DomainError::Box(1)),
    );
    cases.reject(
        "box-reversed",
        &with("box", json!([["3", "-1"], ["-1", "1"]])),
        domain(DomainError::Box(0)),
    );
    cases.reject(
        "smaller-box",
        &with("box", json!([["-1", "-1"], ["3", "1/4"]])),
        expecting("sandwich", "the center in the box"),
    );
    cases.reject(
        "slightly-smaller-box",
        &with("box", json!([["-1", "-1"], ["3", "3/4"]])),
        expecting("sandwich", "inner points in the box"),
    );
    cases.reject(
        "larger-box",
        &with("box", json!([["-1", "-1"], ["3", "2"]])),
        expecting("sandwich", "rows at most 0 at their cells"),
    );

    // A parameter of 4,097 bits.
    let long = |bits: usize| {
        let numerator = knotproof::number::Integer::ONE << (bits as u32 - 1);
        format!("{}/{}", &numerator - knotproof::number::Integer::ONE, numerator)
    };
    cases.accept(
        "long-parameter",
        &rectangle().with("/evidence/rows/0/u", json!(long(4096))),
    );
    let too_long = rectangle().with("/evidence/rows/0/u", json!(long(4097)));
    cases.malformed("parameter-too-long", too_long.json(), |_| true);
    let interval = with("interval", json!(["0", long(4097)]));
    cases.malformed("interval-too-long", interval.json(), |_| true);

    // A curve that begins with three collinear fixed points has no curvature at 0, wherever its last point is.
    let straight = bezier(json!([[[0, 0], [1, 0], [2, 0], [3, 1]]]));
    let hook = |open: Value| {
        rectangle()
            .curve(straight.clone())
            .with("/statement/points", json!([3]))
            .with("/statement/sign", json!("+"))
            .with("/statement/open", open)
    };
    cases.accept("open-at-a-zero", &hook(json!([true, false])));
    cases.accept(
        "row-at-the-open-end",
        &hook(json!([true, false])).with("/evidence/rows/0/u", json!("0")),
    );
    cases.reject(
        "closed-at-a-zero",
        &hook(json!([false, false])),
        expecting("sandwich", center),
    );
    cases.reject(
        "open-at-the-other-end",
        &hook(json!([false, true])),
        expecting("sandwich", center),
    );

    // Two pieces that share their joint: its two copies move together.
    let joined = || bezier(json!([[[0, 0], [0, 1]], [[0, 1], [1, 2], [2, 0]]]));
    let joint = |points: Value| rectangle().curve(joined()).with("/statement/points", points);
    cases.reject("one-copy-of-a-joint", &joint(json!([1])), domain(DomainError::Joint(0)));
    cases.reject(
        "the-other-copy-of-a-joint",
        &joint(json!([2])),
        domain(DomainError::Joint(0)),
    );
    // A straight piece has no curvature: the sign function vanishes on it.
    let second = |interval: Value| {
        let moved = bezier(json!([[[0, 0], [0, 0], [1, 0]], [[1, 0], [1, 2], [3, 0]]]));
        rectangle()
            .curve(moved)
            .with("/statement/points", json!([4]))
            .with("/statement/interval", interval)
            .with("/evidence/rows/0/piece", json!(1))
    };
    cases.accept("second-piece-alone", &second(json!(["1", "2"])));
    cases.reject(
        "with-a-straight-piece",
        &second(json!(["0", "2"])),
        expecting("sandwich", center),
    );
    cases.list()
}
