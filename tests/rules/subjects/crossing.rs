//! `crossing`.

use serde_json::{Value, json};

use crate::common::case::{Case, Cases, expecting};
use crate::common::document::{Certificate, bezier, exact, polygon};

fn rule(s: [&str; 2], t: [&str; 2], first: [i64; 2], second: [i64; 2]) -> Value {
    json!({ "rule": "crossing", "s": s, "t": t, "first": exact(json!(first)), "second": exact(json!(second)) })
}

const I: [&str; 2] = ["1/4", "3/4"];
const J: [&str; 2] = ["9/4", "11/4"];

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("crossing");
    let bow = polygon(json!([[-1, -1], [1, 1], [1, -1], [-1, 1]]));
    let with = |rule: Value| Certificate::new(bow.clone()).upper("0", rule);
    let plain = rule(I, J, [1, 1], [1, -1]);
    cases.accept("two-diagonals", &with(plain.clone()));
    cases.accept(
        "two-diagonals-in-the-convention-critical",
        &with(plain.clone()).critical(),
    );
    cases.accept("slanted-vectors", &with(rule(I, J, [2, 1], [1, -2])));
    let face = expecting("crossing", "one strict sign on each face");
    cases.reject(
        "first-vector-reversed",
        &with(rule(I, J, [-1, -1], [1, -1])),
        face.clone(),
    );
    cases.reject(
        "second-vector-reversed",
        &with(rule(I, J, [1, 1], [-1, 1])),
        face.clone(),
    );
    cases.reject("vectors-exchanged", &with(rule(I, J, [1, -1], [1, 1])), face.clone());
    let dependent = expecting("crossing", "independent n₁, n₂");
    cases.reject(
        "dependent-vectors",
        &with(rule(I, J, [1, 1], [2, 2])),
        dependent.clone(),
    );
    cases.reject("zero-witness", &with(rule(I, J, [0, 0], [1, -1])), dependent.clone());
    cases.reject("zero-witnesses", &with(rule(I, J, [0, 0], [0, 0])), dependent);
    cases.reject(
        "no-crossing-inside",
        &with(rule(["5/8", "3/4"], J, [1, 1], [1, -1])),
        face.clone(),
    );
    // c(s₁) on the other diagonal: the sign is not strict.
    cases.reject(
        "crossing-on-a-face",
        &with(rule(["1/4", "1/2"], J, [1, 1], [1, -1])),
        face.clone(),
    );
    let intervals = expecting("crossing", "two intervals of the curve");
    cases.reject(
        "reversed-interval",
        &with(rule(["3/4", "1/4"], J, [1, 1], [1, -1])),
        intervals.clone(),
    );
    cases.reject(
        "empty-interval",
        &with(rule(["1/2", "1/2"], J, [1, 1], [1, -1])),
        intervals.clone(),
    );
    cases.reject(
        "too-long-an-interval",
        &with(rule(["1/4", "11/8"], J, [1, 1], [1, -1])),
        intervals.clone(),
    );
    cases.reject(
        "interval-beyond-the-end",
        &with(rule(I, ["9/4", "13/4"], [1, 1], [1, -1])),
        intervals,
    );
    let apart = expecting("crossing", "disjoint intervals in order");
    cases.reject("intervals-exchanged", &with(rule(J, I, [1, -1], [1, 1])), apart.clone());
    cases.reject(
        "intervals-that-touch",
        &with(rule(["1/2", "1"], ["1", "3/2"], [1, 1], [1, -1])),
        apart.clone(),
    );
    cases.reject("one-interval-twice", &with(rule(I, I, [1, 1], [1, -1])), apart.clone());

    // Two arcs that touch without crossing, and two that miss.
    let arcs = |height: i64| {
        bezier(json!([
            [[-1, 1], [0, -1], [1, 1]],
            [[1, 1], [9, 0]],
            [[9, 0], [1, -1]],
            [[1, -1], [0, height], [-1, -1]]
        ]))
    };
    for (name, height) in [("touching-arcs", 1), ("arcs-apart", 0)] {
        let certificate = Certificate::new(arcs(height)).upper("0", rule(I, ["13/4", "15/4"], [1, 0], [1, 0]));
        cases.reject(name, &certificate.clone(), expecting("crossing", "independent n₁, n₂"));
        cases.reject(
            &format!("{name}-independent"),
            &certificate.with("/evidence/upper/second", json!(["1", "1"])),
            face.clone(),
        );
    }
    // In space two diagonals pass each other.
    let passing = polygon(json!([[-1, -1, 0], [1, 1, 0], [1, -1, 1], [-1, 1, 1]]));
    let spatial = json!({ "rule": "crossing", "s": I, "t": J, "first": ["1", "1", "0"], "second": ["1", "-1", "0"] });
    cases.reject(
        "in-space",
        &Certificate::new(passing).upper("0", spatial),
        expecting("crossing", "a planar curve"),
    );
    // Closed: an interval across the closing point, and one that goes round to the other.
    let closed = polygon(json!([[0, 0], [1, 1], [1, -1], [-1, 1], [-1, -1], [0, 0]]));
    let around =
        |t: [&str; 2], s: [&str; 2]| Certificate::new(closed.clone()).upper("0", rule(s, t, [-1, 1], [-1, -1]));
    cases.accept("across-the-closing-point", &around(["19/4", "21/4"], ["9/4", "11/4"]));
    cases.reject(
        "round-to-the-other-interval",
        &around(["19/4", "21/4"], ["1/8", "1/4"]),
        apart,
    );
    cases.list()
}
