//! `critical_interval`.

use knotproof::check::Reason;
use serde_json::{Value, json};

use crate::common::case::{Case, Cases, expecting, reason};
use crate::common::document::{Certificate, bezier, exact, polygon};

fn rule(s: &str, t: [&str; 2], regular: [i64; 2]) -> Value {
    json!({ "rule": "critical_interval", "s": s, "t": t, "regular": exact(json!(regular)) })
}

/// The right triangle with sides 3, 4, 5; the foot of its altitude 12/5 is at 1 + 16/25.
fn triangle() -> Value {
    polygon(json!([[0, 0], [4, 0], [0, 3], [0, 0]]))
}

const J: [&str; 2] = ["3/2", "7/4"];
const ALONG: [i64; 2] = [-4, 3];

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("critical_interval");
    let on = |curve: Value, upper: &str, rule: Value| Certificate::new(curve).critical().upper(upper, rule);
    let altitude = |s: &str, t, regular| on(triangle(), "25/4", rule(s, t, regular));
    cases.accept("altitude", &altitude("0", J, ALONG));
    cases.reject(
        "other-convention",
        &altitude("0", J, ALONG).with("/statement/convention", json!("smooth")),
        reason(Reason::WrongConvention),
    );
    cases.reject(
        "bound-below",
        &on(triangle(), "156/25", rule("0", J, ALONG)),
        expecting("critical_interval", "upper_squared ≥ |E−q|² for all hull points"),
    );
    cases.reject(
        "not-a-corner",
        &altitude("1/2", J, ALONG),
        expecting("critical_interval", "a corner or an end"),
    );
    cases.reject(
        "not-a-parameter",
        &altitude("3", J, ALONG),
        expecting("critical_interval", "a parameter of the curve"),
    );
    let regular = expecting("critical_interval", "m·w > 0 for all tangents of the interval");
    cases.reject("zero-witness", &altitude("0", J, [0, 0]), regular.clone());
    cases.reject("witness-reversed", &altitude("0", J, [4, -3]), regular);
    let signs = expecting("critical_interval", "opposite signs at the ends of the interval");
    cases.reject("foot-outside", &altitude("0", ["3/2", "8/5"], ALONG), signs.clone());
    cases.reject("foot-on-the-edge", &altitude("0", ["3/2", "41/25"], ALONG), signs);
    let interval = expecting("critical_interval", "an interval of the curve");
    cases.reject(
        "reversed-interval",
        &altitude("0", ["7/4", "3/2"], ALONG),
        interval.clone(),
    );
    cases.reject("too-long", &altitude("0", ["5/4", "5/2"], ALONG), interval);
    cases.reject(
        "corner-inside",
        &altitude("0", ["3/2", "17/8"], ALONG),
        expecting("critical_interval", "no corner inside"),
    );
    let outside = expecting("critical_interval", "s outside the interval");
    cases.reject("s-inside", &altitude("1", ["3/4", "7/4"], ALONG), outside.clone());
    cases.reject("s-at-the-edge", &altitude("1", ["1", "3/2"], ALONG), outside.clone());
    cases.reject(
        "s-inside-modulo-the-period",
        &altitude("0", ["5/2", "13/4"], [0, -1]),
        outside.clone(),
    );
    cases.reject(
        "s-at-the-edge-modulo-the-period",
        &altitude("0", ["5/2", "3"], [0, -1]),
        outside,
    );

    let not = expecting("critical_interval", "a chord critical at s for all of the interval");
    // A blunt corner below its foot: the chord is critical at the corner as long as it stays within the wedge of normals.
    let blunt = polygon(json!([[0, 0], [4, 1], [4, 4], [-4, 4], [-4, 1], [0, 0]]));
    let corner = |t| on(blunt.clone(), "25", rule("0", t, [-1, 0]));
    cases.accept("foot-of-a-corner", &corner(["39/16", "41/16"]));
    cases.accept("chord-critical-up-to-the-edge", &corner(["19/8", "41/16"]));
    cases.reject(
        "chord-critical-in-a-part-only",
        &corner(["37/16", "41/16"]),
        not.clone(),
    );
    // A corner that both sides pass going up is no turning point of the distance to a vertical side.
    let flat = polygon(json!([[0, 0], [4, 1], [8, 3], [8, 9], [-8, 9]]));
    cases.reject(
        "corner-with-products-of-one-sign",
        &on(flat, "200", rule("1", ["51/16", "53/16"], [-1, 0])),
        not.clone(),
    );

    // An end.
    let hook = |start: i64| polygon(json!([[start, 0], [6, 0], [6, 4], [-6, 4]]));
    let foot = |start: i64| on(hook(start), "20", rule("0", ["39/16", "41/16"], [-1, 0]));
    cases.reject("end-facing-the-foot", &foot(0), not.clone());
    let slanted = polygon(json!([[0, 0], [6, -1], [6, 4], [-6, 4]]));
    cases.accept(
        "end-with-the-foot-behind",
        &on(slanted, "17", rule("0", ["79/32", "81/32"], [-1, 0])),
    );
    let away = polygon(json!([[0, 0], [6, 1], [6, 4], [-6, 4]]));
    cases.reject(
        "end-with-the-foot-ahead",
        &on(away, "17", rule("0", ["79/32", "81/32"], [-1, 0])),
        not,
    );

    // J across a smooth joint.
    let arc = bezier(json!([
        [[0, 0], [6, -1]],
        [[6, -1], [6, 4]],
        [[6, 4], ["1/2", 4]],
        [["1/2", 4], [-6, 4]]
    ]));
    cases.accept(
        "smooth-joint-inside",
        &on(arc, "18", rule("0", ["191/64", "25/8"], [-1, 0])),
    );
    cases.list()
}
