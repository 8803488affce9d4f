//! `root`.

use serde_json::{Value, json};

use super::{channel, channel_curve};
use crate::common::case::{Case, Cases, expecting, obligation};
use crate::common::document::{Certificate, bezier, polygon};

fn rule(s: &str, s_side: &str, t: &str, t_side: &str) -> Value {
    json!({ "rule": "root", "s": s, "s_side": s_side, "t": t, "t_side": t_side })
}

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("root");
    let at = |s: &str, s_side: &str, t: &str, t_side: &str| {
        Certificate::new(channel_curve()).upper("9", rule(s, s_side, t, t_side))
    };
    let inside = rule("1/2", "after", "5/2", "after");
    cases.accept("middles-of-two-sides", &channel().upper("9", inside.clone()));
    cases.accept("bound-above", &channel().upper("10", inside.clone()));
    cases.reject(
        "bound-below",
        &Certificate::new(channel_curve()).upper("899999/100000", inside.clone()),
        expecting("root", "upper_squared ≥ |chord|²"),
    );
    cases.accept("both-ends", &at("0", "after", "3", "before"));
    cases.accept("corners-from-the-right-sides", &at("1", "before", "2", "after"));
    let not_orthogonal = expecting("root", "a chord orthogonal to the tangent");
    cases.reject(
        "corner-from-the-wrong-side",
        &at("1", "after", "2", "after"),
        not_orthogonal.clone(),
    );
    cases.reject(
        "other-corner-from-the-wrong-side",
        &at("1", "before", "2", "before"),
        not_orthogonal.clone(),
    );
    cases.reject(
        "slanted-chord",
        &at("1/3", "after", "5/2", "after"),
        not_orthogonal.clone(),
    );
    cases.reject(
        "no-piece-before-the-start",
        &at("0", "before", "3", "before"),
        expecting("root", "a piece on the side named"),
    );
    cases.reject(
        "no-piece-after-the-end",
        &at("0", "after", "3", "after"),
        expecting("root", "a piece on the side named"),
    );
    cases.reject(
        "before-inside-a-piece",
        &at("1/2", "before", "5/2", "after"),
        obligation("root"),
    );
    cases.reject(
        "before-inside-another-piece",
        &at("1/2", "after", "5/2", "before"),
        obligation("root"),
    );
    let order = expecting("root", "s < t");
    cases.reject("reversed", &at("5/2", "after", "1/2", "after"), order.clone());
    cases.reject("one-parameter", &at("1/2", "after", "1/2", "after"), order.clone());
    cases.reject("one-joint-from-both-sides", &at("1", "before", "1", "after"), order);
    let outside = expecting("root", "two parameters of the curve");
    cases.reject("beyond-the-end", &at("1/2", "after", "7/2", "after"), outside.clone());
    cases.reject(
        "before-the-start",
        &at("-1/2", "after", "5/2", "after"),
        outside.clone(),
    );

    // On a closed curve 0 and M are one parameter, and M is not written.
    let square = polygon(json!([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]));
    let closed = |s: &str, s_side: &str, t: &str, t_side: &str| {
        Certificate::new(square.clone()).upper("1", rule(s, s_side, t, t_side))
    };
    cases.accept("closed-start-from-both-sides", &closed("0", "before", "1", "after"));
    cases.accept("closed-start-from-after", &closed("0", "after", "3", "before"));
    cases.reject(
        "closed-start-and-end",
        &closed("0", "after", "4", "before"),
        outside.clone(),
    );
    cases.reject("closed-end", &closed("1", "after", "4", "before"), outside);

    // A cusp: D vanishes at 1/2, and every product with it.
    let cusp = Certificate::new(bezier(json!([
        [[-1, 1], [1, "-1/3"], [-1, "-1/3"], [1, 1]],
        [[1, 1], [1, 4]],
        [[1, 4], [-1, 4]]
    ])));
    let no_direction = expecting("root", "a tangent direction");
    cases.reject(
        "derivative-vanishes-inside",
        &cusp.clone().upper("17", rule("1/2", "after", "5/2", "after")),
        no_direction.clone(),
    );
    cases.reject(
        "derivative-vanishes-inside-second",
        &cusp.upper("17", rule("1/8", "after", "1/2", "after")),
        not_orthogonal.clone(),
    );

    // Coincident control points at the start: D vanishes there, the direction does not.
    let coincident = |direction: [i64; 2]| {
        let [x, y] = direction;
        let arc = bezier(json!([
            [[0, 0], [0, 0], [x, y]],
            [[x, y], [9, 9]],
            [[9, 9], [9, -9]],
            [[9, -9], [3, 0]],
            [[3, 0], [3, 5]]
        ]));
        Certificate::new(arc).upper("9", rule("0", "after", "4", "after"))
    };
    cases.accept("coincident-control-points", &coincident([0, 1]));
    cases.reject(
        "coincident-control-points-not-orthogonal",
        &coincident([1, 1]),
        not_orthogonal,
    );
    cases.accept("coincident-points-of-the-curve", &crossing_root());
    // Rational: a unit quarter and its opposite, exactly 2 apart.
    cases.accept("rational", &circle("0", "2", "4"));
    cases.accept("rational-inside", &circle("1/3", "7/3", "4"));
    cases.reject(
        "rational-bound-below",
        &circle("1/3", "7/3", "3999999999/1000000000"),
        expecting("root", "upper_squared ≥ |chord|²"),
    );
    cases.reject(
        "rational-slanted",
        &circle("1/3", "9/4", "4"),
        expecting("root", "a chord orthogonal to the tangent"),
    );
    cases.list()
}

/// A chord of length zero counts.
fn crossing_root() -> Certificate {
    let bow = polygon(json!([[-1, -1], [1, 1], [1, -1], [-1, 1]]));
    Certificate::new(bow).upper("0", rule("1/2", "after", "5/2", "after"))
}

fn circle(s: &str, t: &str, upper: &str) -> Certificate {
    let quarter =
        |points: Value| json!({ "points": crate::common::document::exact(points), "weights": ["1", "1", "2"] });
    let quarter_back =
        |points: Value| json!({ "points": crate::common::document::exact(points), "weights": ["1", "1", "2"] });
    let pieces = [
        quarter(json!([[1, 0], [1, 1], [0, 1]])),
        quarter_back(json!([[0, 1], [-1, 1], [-1, 0]])),
        quarter(json!([[-1, 0], [-1, -1], [0, -1]])),
        quarter_back(json!([[0, -1], [1, -1], [1, 0]])),
    ];
    Certificate::new(json!({ "bezier": { "pieces": pieces } })).upper(upper, rule(s, "after", t, "after"))
}
