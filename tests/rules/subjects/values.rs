//! The claim `values`: every operation with its exact result, and beside it what is nearly so.

use knotproof::check::{Place, Rejection};
use serde_json::{Value, json};

use crate::common::case::{Case, Cases, expecting};
use crate::common::document::{Certificate, bezier, exact};

/// A certificate with these entries and witnesses.
fn certificate(curve: Value, entries: Value, witnesses: Value) -> Certificate {
    let mut certificate = Certificate::new(curve);
    certificate.0["statement"] = json!({ "claim": "values", "entries": entries });
    certificate.0["evidence"] = json!({ "witnesses": witnesses });
    certificate
}

/// y = x² for x from −1 to 1, x = 2u − 1.
fn parabola() -> Value {
    bezier(json!([[[-1, 1], [0, -1], [1, 1]]]))
}

/// A B-spline in the plane or in space, polynomial.
fn spline(degree: u32, knots: Value, points: Value) -> Value {
    let points: Vec<Value> = points.as_array().expect("points").iter().cloned().map(exact).collect();
    json!({ "bspline": { "degree": degree, "knots": exact(knots), "points": points } })
}

/// The parabola with the knot 1/2.
fn inserted() -> Value {
    spline(
        2,
        json!([0, 0, 0, "1/2", 1, 1, 1]),
        json!([[-1, 1], ["-1/2", 0], ["1/2", 0], [1, 1]]),
    )
}

/// The parabola as a B-spline.
fn parabola_spline() -> Value {
    spline(2, json!([0, 0, 0, 1, 1, 1]), json!([[-1, 1], [0, -1], [1, 1]]))
}

/// A quarter of the unit circle, with the weights 1, 1, 2.
fn quarter() -> Value {
    json!({ "bezier": { "pieces": [{ "points": [["1", "0"], ["1", "1"], ["0", "1"]], "weights": ["1", "1", "2"] }] } })
}

/// (t, t², t³) for t from 0 to 1.
fn twisted() -> Value {
    bezier(json!([[[0, 0, 0], ["1/3", 0, 0], ["2/3", "1/3", 0], [1, 1, 1]]]))
}

/// A corner at the double knot 1: from (0,0) to (2,0) and to (2,2), quadratics.
fn corner() -> Value {
    spline(
        2,
        json!([0, 0, 0, 1, 1, 2, 2, 2]),
        json!([[0, 0], [1, 0], [2, 0], [2, 1], [2, 2]]),
    )
}

/// An unclamped quadratic spline of two pieces, on [2, 4].
fn unclamped() -> Value {
    spline(2, json!([0, 1, 2, 3, 4, 5, 6]), json!([[0, 0], [2, 0], [2, 2], [0, 2]]))
}

fn point(parameter: &str, point: Value) -> Value {
    json!({ "operation": "point", "parameter": parameter, "point": exact(point) })
}

fn derivative(parameter: &str, order: u32, side: &str, vector: Value) -> Value {
    json!({ "operation": "derivative", "parameter": parameter, "order": order, "side": side, "vector": exact(vector) })
}

fn curvature(parameter: &str, side: &str, squared: &str) -> Value {
    json!({ "operation": "curvature", "parameter": parameter, "side": side, "value_squared": squared })
}

fn torsion(parameter: &str, side: &str, value: &str) -> Value {
    json!({ "operation": "torsion", "parameter": parameter, "side": side, "value": value })
}

fn knot(operation: &str, parameter: &str, times: u32, curve: Value) -> Value {
    json!({ "operation": operation, "parameter": parameter, "times": times, "curve": curve })
}

fn elevation(times: u32, curve: Value) -> Value {
    json!({ "operation": "elevate_degree", "times": times, "curve": curve })
}

fn nearest(target: Value, lower: &str, upper: &str) -> Value {
    json!({ "operation": "nearest_point", "target": exact(target), "lower_squared": lower, "upper_squared": upper })
}

fn distance(other: Value, lower: &str, upper: &str) -> Value {
    json!({ "operation": "curve_distance", "other": other, "lower_squared": lower, "upper_squared": upper })
}

/// Of one entry that needs no witness.
fn one(curve: Value, entry: Value) -> Certificate {
    certificate(curve, json!([entry]), json!([]))
}

/// A certificate with all operations on the parabola with a knot.
pub fn everything() -> Certificate {
    let split = json!({ "operation": "split", "parameter": "1/2", "curves": [
        spline(2, json!([0, 0, 0, "1/2", "1/2", "1/2"]), json!([[-1, 1], ["-1/2", 0], [0, 0]])),
        spline(2, json!(["1/2", "1/2", "1/2", 1, 1, 1]), json!([[0, 0], ["1/2", 0], [1, 1]])) ] });
    let halves = bezier(json!([[[-1, 1], ["-1/2", 0], [0, 0]], [[0, 0], ["1/2", 0], [1, 1]]]));
    certificate(
        inserted(),
        json!([
            point("1/4", json!(["-1/2", "1/4"])),
            derivative("1/2", 2, "left", json!([0, 8])),
            curvature("1/4", "right", "1/2"),
            knot(
                "insert_knot",
                "1/4",
                1,
                spline(
                    2,
                    json!([0, 0, 0, "1/4", "1/2", 1, 1, 1]),
                    json!([[-1, 1], ["-3/4", "1/2"], ["-1/4", 0], ["1/2", 0], [1, 1]])
                )
            ),
            knot("remove_knot", "1/2", 1, parabola_spline()),
            split,
            json!({ "operation": "decompose", "curve": halves }),
            nearest(json!([0, -1]), "1", "1"),
            distance(bezier(json!([[[-1, -1], [1, -1]]])), "1", "1"),
        ]),
        json!([
            { "parameter": "1/2" },
            { "parameters": ["1/2", "1/2"], "tree": ["first", "far 0 1", "far 0 1"] }
        ]),
    )
}

/// The entry is rejected for this.
fn wish(rule: &'static str, wish: &'static str) -> impl Fn(&Rejection) -> bool + Clone {
    let by = expecting(rule, wish);
    move |rejection| by(rejection) && matches!(rejection.place, Place::Entry { .. })
}

const EXACT: &str = "the exact value";
const NO_SIDE: &str = "a parameter of the curve, and a side on which there is the curve";
const SAME: &str = "the same curve";
const KNOTS: &str = "the knots that the operation makes";

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("values");
    cases.accept("everything", &everything());
    cases.accept_bytes("everything-binary", everything().binary());
    cases.accept("nothing", &certificate(parabola(), json!([]), json!([])));
    numbers(&mut cases);
    curves(&mut cases);
    distances(&mut cases);
    documents(&mut cases);
    cases.list()
}

fn numbers(cases: &mut Cases) {
    cases.accept("point", &one(parabola(), point("1/4", json!(["-1/2", "1/4"]))));
    cases.reject(
        "point-moved",
        &one(parabola(), point("1/4", json!(["-1/2", "1000000000001/4000000000000"]))),
        wish("point", EXACT),
    );
    cases.accept("point-rational", &one(quarter(), point("1/2", json!(["3/5", "4/5"]))));
    cases.reject(
        "point-without-its-weight",
        &one(quarter(), point("1/2", json!(["3/4", "1"]))),
        wish("point", EXACT),
    );
    cases.accept("point-at-the-end", &one(parabola(), point("1", json!([1, 1]))));
    for (name, parameter) in [("behind", "10000001/10000000"), ("before", "-1/10000000")] {
        cases.reject(
            &format!("point-{name}-the-domain"),
            &one(parabola(), point(parameter, json!([1, 1]))),
            wish("point", NO_SIDE),
        );
    }
    cases.accept("point-unclamped", &one(unclamped(), point("3", json!([2, 1]))));
    cases.reject(
        "point-outside-the-domain-of-unclamped-knots",
        &one(unclamped(), point("1", json!([1, 0]))),
        wish("point", NO_SIDE),
    );
    cases.accept(
        "derivatives",
        &certificate(
            parabola(),
            json!([
                derivative("1/4", 1, "left", json!([2, -2])),
                derivative("1/4", 2, "right", json!([0, 8])),
                derivative("1/4", 3, "right", json!([0, 0])),
                derivative("0", 1, "right", json!([2, -4])),
                derivative("1", 1, "left", json!([2, 4]))
            ]),
            json!([]),
        ),
    );
    cases.accept(
        "derivative-by-the-knots",
        &one(unclamped(), derivative("3", 1, "left", json!([0, 2]))),
    );
    cases.reject(
        "derivative-by-the-local-parameter",
        &one(
            spline(2, json!([0, 0, 0, 2, 2, 2]), json!([[-1, 1], [0, -1], [1, 1]])),
            derivative("0", 1, "right", json!([2, -4])),
        ),
        wish("derivative", EXACT),
    );
    cases.accept(
        "derivative-rational",
        &one(quarter(), derivative("0", 1, "right", json!([0, 2]))),
    );
    cases.accept(
        "derivative-of-order-64",
        &one(parabola(), derivative("1/3", 64, "right", json!([0, 0]))),
    );
    cases.reject(
        "derivative-of-order-65",
        &one(parabola(), derivative("1/3", 65, "right", json!([0, 0]))),
        wish("derivative", "an order from 1 to 64"),
    );
    cases.reject(
        "derivative-of-order-0",
        &one(parabola(), derivative("1/4", 0, "right", json!(["-1/2", "1/4"]))),
        wish("derivative", "an order from 1 to 64"),
    );
    cases.accept(
        "derivative-at-a-corner",
        &certificate(
            corner(),
            json!([
                derivative("1", 1, "left", json!([2, 0])),
                derivative("1", 1, "right", json!([0, 2]))
            ]),
            json!([]),
        ),
    );
    cases.reject(
        "derivative-from-the-other-side",
        &one(corner(), derivative("1", 1, "right", json!([2, 0]))),
        wish("derivative", EXACT),
    );
    for (parameter, side) in [("0", "left"), ("1", "right")] {
        cases.reject(
            &format!("derivative-{side}-of-the-domain"),
            &one(parabola(), derivative(parameter, 2, side, json!([0, 8]))),
            wish("derivative", NO_SIDE),
        );
    }
    cases.accept("curvature", &one(parabola(), curvature("1/2", "left", "4")));
    cases.accept("curvature-of-a-circle", &one(quarter(), curvature("1/3", "right", "1")));
    cases.reject(
        "curvature-not-squared",
        &one(parabola(), curvature("1/2", "left", "2")),
        wish("curvature", EXACT),
    );
    cases.accept("curvature-in-space", &one(twisted(), curvature("0", "right", "4")));
    let cusp = bezier(json!([[[0, 0], [1, 1], [0, 1], [1, 0]]]));
    cases.reject(
        "curvature-at-a-cusp",
        &one(cusp, curvature("1/2", "left", "0")),
        wish("curvature", "a derivative that is not zero"),
    );
    cases.accept("torsion", &one(twisted(), torsion("1", "left", "3/19")));
    cases.reject(
        "torsion-of-the-other-sign",
        &one(twisted(), torsion("1", "left", "-3/19")),
        wish("torsion", EXACT),
    );
    cases.reject(
        "torsion-in-the-plane",
        &one(parabola(), torsion("1/2", "left", "0")),
        wish("torsion", "a curve in space"),
    );
    cases.reject(
        "torsion-of-a-straight-curve",
        &one(
            bezier(json!([[[0, 0, 0], [1, 1, 1], [2, 2, 2]]])),
            torsion("1/2", "left", "0"),
        ),
        wish("torsion", "first and second derivatives that are independent"),
    );
}

fn curves(cases: &mut Cases) {
    let moved = |mut curve: Value| {
        curve["bspline"]["points"][1][1] = json!("1/1000000000000");
        curve
    };
    cases.accept("insert", &one(parabola(), knot("insert_knot", "1/2", 1, inserted())));
    cases.reject(
        "insert-and-move",
        &one(parabola(), knot("insert_knot", "1/2", 1, moved(inserted()))),
        wish("insert_knot", SAME),
    );
    cases.reject(
        "insert-elsewhere",
        &one(parabola(), knot("insert_knot", "1/3", 1, inserted())),
        wish("insert_knot", KNOTS),
    );
    cases.reject(
        "insert-too-rarely",
        &one(parabola(), knot("insert_knot", "1/2", 2, inserted())),
        wish("insert_knot", KNOTS),
    );
    cases.reject(
        "insert-outside",
        &one(parabola(), knot("insert_knot", "2", 1, inserted())),
        wish("insert_knot", "a knot in the domain"),
    );
    for times in [0, 65] {
        cases.reject(
            &format!("insert-{times}-times"),
            &one(parabola(), knot("insert_knot", "1/2", times, inserted())),
            wish("insert_knot", "times from 1 to 64"),
        );
    }
    cases.reject(
        "insert-into-two-pieces",
        &one(
            bezier(json!([[[0, 0], [1, 0]], [[1, 0], [1, 1]]])),
            knot(
                "insert_knot",
                "1/2",
                1,
                spline(1, json!([0, 0, "1/2", 1, 1]), json!([[0, 0], ["1/2", 0], [1, 0]])),
            ),
        ),
        wish("insert_knot", "a B-spline or a single Bézier piece"),
    );
    let weighted = |weights: Value| {
        let mut curve = spline(
            2,
            json!([0, 0, 0, "1/2", 1, 1, 1]),
            json!([[1, 0], [1, "1/2"], ["1/3", 1], [0, 1]]),
        );
        curve["bspline"]["weights"] = weights;
        curve
    };
    cases.accept(
        "insert-rational",
        &one(
            quarter(),
            knot("insert_knot", "1/2", 1, weighted(json!(["1", "1", "3/2", "2"]))),
        ),
    );
    cases.accept(
        "insert-rational-times-a-factor",
        &one(
            quarter(),
            knot("insert_knot", "1/2", 1, weighted(json!(["2", "2", "3", "4"]))),
        ),
    );
    cases.reject(
        "insert-rational-other-weights",
        &one(
            quarter(),
            knot("insert_knot", "1/2", 1, weighted(json!(["1", "1", "3/2", "3"]))),
        ),
        wish("insert_knot", SAME),
    );
    cases.accept(
        "remove",
        &one(inserted(), knot("remove_knot", "1/2", 1, parabola_spline())),
    );
    cases.reject(
        "remove-and-move",
        &one(inserted(), knot("remove_knot", "1/2", 1, moved(parabola_spline()))),
        wish("remove_knot", SAME),
    );
    cases.reject(
        "remove-twice",
        &one(inserted(), knot("remove_knot", "1/2", 2, parabola_spline())),
        wish("remove_knot", "a knot inside the domain, so often"),
    );
    cases.reject(
        "remove-a-corner",
        &one(
            corner(),
            knot(
                "remove_knot",
                "1",
                1,
                spline(2, json!([0, 0, 0, 1, 2, 2, 2]), json!([[0, 0], [1, 0], [2, 1], [2, 2]])),
            ),
        ),
        wish("remove_knot", SAME),
    );
    let elevated = || {
        spline(
            3,
            json!([0, 0, 0, 0, 1, 1, 1, 1]),
            json!([[-1, 1], ["-1/3", "-1/3"], ["1/3", "-1/3"], [1, 1]]),
        )
    };
    cases.accept("elevate", &one(parabola(), elevation(1, elevated())));
    cases.reject(
        "elevate-and-move",
        &one(parabola(), elevation(1, moved(elevated()))),
        wish("elevate_degree", SAME),
    );
    cases.reject(
        "elevate-too-little",
        &one(parabola(), elevation(2, elevated())),
        wish("elevate_degree", "the degree that the operation makes"),
    );
    cases.accept(
        "elevate-at-a-knot",
        &one(inserted(), elevation(1, elevated_with_knot(2))),
    );
    cases.reject(
        "elevate-without-the-knot",
        &one(inserted(), elevation(1, elevated_with_knot(1))),
        wish("elevate_degree", KNOTS),
    );
    cases.accept(
        "elevate-unclamped",
        &one(unclamped(), elevation(1, unclamped_elevated())),
    );
    let mut other_ends = unclamped_elevated();
    other_ends["bspline"]["knots"][0] = json!("0");
    cases.reject(
        "elevate-unclamped-with-other-knots",
        &one(unclamped(), elevation(1, other_ends)),
        wish("elevate_degree", KNOTS),
    );
    splits(cases);
}

/// The parabola as a cubic with the knot 1/2 once or twice.
fn elevated_with_knot(times: usize) -> Value {
    match times {
        1 => spline(
            3,
            json!([0, 0, 0, 0, "1/2", 1, 1, 1, 1]),
            json!([[-1, 1], ["-2/3", "1/3"], [0, "-1/3"], ["2/3", "1/3"], [1, 1]]),
        ),
        _ => spline(
            3,
            json!([0, 0, 0, 0, "1/2", "1/2", 1, 1, 1, 1]),
            json!([
                [-1, 1],
                ["-2/3", "1/3"],
                ["-1/3", 0],
                ["1/3", 0],
                ["2/3", "1/3"],
                [1, 1]
            ]),
        ),
    }
}

/// [`unclamped`] as a cubic: its control points are blossoms at three consecutive knots of 1, 2, 2, 3, 3, 4, 4, 5 (with one more at each end).
fn unclamped_elevated() -> Value {
    let curve = crate::common::document::curve_of(&unclamped()).expect("a curve");
    let knotproof::curve::Form::BSpline(spline) = curve.form() else {
        panic!("a spline");
    };
    let elevated = spline.elevate(1).expect("a cubic");
    crate::common::document::field_of(&elevated.into())
}

fn splits(cases: &mut Cases) {
    let first = || {
        spline(
            2,
            json!([0, 0, 0, "1/2", "1/2", "1/2"]),
            json!([[-1, 1], ["-1/2", 0], [0, 0]]),
        )
    };
    let second = || {
        spline(
            2,
            json!(["1/2", "1/2", "1/2", 1, 1, 1]),
            json!([[0, 0], ["1/2", 0], [1, 1]]),
        )
    };
    let split =
        |parameter: &str, curves: Value| json!({ "operation": "split", "parameter": parameter, "curves": curves });
    cases.accept("split", &one(parabola(), split("1/2", json!([first(), second()]))));
    cases.accept(
        "split-at-a-knot",
        &one(inserted(), split("1/2", json!([first(), second()]))),
    );
    cases.reject(
        "split-in-the-wrong-order",
        &one(parabola(), split("1/2", json!([second(), first()]))),
        wish("split", KNOTS),
    );
    cases.reject(
        "split-elsewhere",
        &one(parabola(), split("1/3", json!([first(), second()]))),
        wish("split", KNOTS),
    );
    cases.reject(
        "split-at-the-end",
        &one(parabola(), split("1", json!([first(), second()]))),
        wish("split", "a parameter inside the domain"),
    );
    let bent = spline(
        2,
        json!(["1/2", "1/2", "1/2", 1, 1, 1]),
        json!([[0, 0], ["1/2", "1/9"], [1, 1]]),
    );
    cases.reject(
        "split-and-bend",
        &one(parabola(), split("1/2", json!([first(), bent]))),
        wish("split", SAME),
    );
    let decompose = |curve: Value| json!({ "operation": "decompose", "curve": curve });
    let halves = |y: &str| bezier(json!([[[-1, 1], ["-1/2", 0], [0, 0]], [[0, 0], ["1/2", y], [1, 1]]]));
    cases.accept("decompose", &one(inserted(), decompose(halves("0"))));
    cases.reject(
        "decompose-and-move",
        &one(inserted(), decompose(halves("1/1000000000"))),
        wish("decompose", SAME),
    );
    let alike = "a piece of the curve's degree for every non-empty interval";
    cases.reject(
        "decompose-into-one",
        &one(inserted(), decompose(parabola())),
        wish("decompose", alike),
    );
    cases.reject(
        "decompose-into-a-spline",
        &one(inserted(), decompose(inserted())),
        wish("decompose", "Bézier pieces"),
    );
}

fn distances(cases: &mut Cases) {
    let near = |target: Value, lower: &str, upper: &str, t: &str| {
        certificate(
            parabola(),
            json!([nearest(target, lower, upper)]),
            json!([{ "parameter": t }]),
        )
    };
    cases.accept("nearest", &near(json!([0, -1]), "1", "1", "1/2"));
    // Of the points at the height 1/2 the squared distance to (0, 1) is 3/4.
    cases.accept(
        "nearest-between",
        &near(json!([0, 1]), "749/1000", "751/1000", "853/1000"),
    );
    cases.reject(
        "nearest-lower-too-large",
        &near(json!([0, 1]), "751/1000", "94/125", "853/1000"),
        wish(
            "nearest_point",
            "a squared distance of at least lower_squared by halving",
        ),
    );
    let upper = "a point of a squared distance of at most upper_squared";
    cases.reject(
        "nearest-upper-too-small",
        &near(json!([0, -1]), "1", "1", "500001/1000000"),
        wish("nearest_point", upper),
    );
    cases.reject(
        "nearest-outside",
        &near(json!([0, -1]), "1", "2", "3/2"),
        wish("nearest_point", NO_SIDE),
    );
    cases.accept(
        "nearest-rational",
        &certificate(
            quarter(),
            json!([nearest(json!([0, 0]), "1", "1")]),
            json!([{ "parameter": "1/3" }]),
        ),
    );
    cases.reject(
        "nearest-rational-lower-too-large",
        &certificate(
            quarter(),
            json!([nearest(json!([0, 0]), "1000000001/1000000000", "2")]),
            json!([{ "parameter": "1/3" }]),
        ),
        wish(
            "nearest_point",
            "a squared distance of at least lower_squared by halving",
        ),
    );
    let far = |lower: &str, upper: &str, parameters: Value, tree: Value| {
        let segment = bezier(json!([[[-1, -1], [1, -1]]]));
        certificate(
            parabola(),
            json!([distance(segment, lower, upper)]),
            json!([{ "parameters": parameters, "tree": tree }]),
        )
    };
    let tree = || json!(["first", "far 0 1", "far 0 1"]);
    let middle = || json!(["1/2", "1/2"]);
    cases.accept("distance", &far("1", "1", middle(), tree()));
    cases.accept(
        "distance-by-the-second",
        &far(
            "1",
            "1",
            middle(),
            json!(["second", "first", "far 0 1", "far 0 2", "first", "far 0 3", "far 0 1"]),
        ),
    );
    cases.accept("distance-without-a-lower-bound", &far("0", "1", middle(), Value::Null));
    let leaf = "nodes that are far along n";
    cases.reject(
        "distance-lower-too-large",
        &far("1000000001/1000000000", "2", middle(), tree()),
        wish("curve_distance", leaf),
    );
    cases.reject(
        "distance-of-the-hulls",
        &far("1", "1", middle(), json!(["far 0 1"])),
        wish("curve_distance", leaf),
    );
    cases.reject(
        "distance-along-nothing",
        &far("1", "1", middle(), json!(["first", "far 0 0", "far 0 1"])),
        wish("curve_distance", leaf),
    );
    cases.reject(
        "distance-along-the-opposite",
        &far("1", "1", middle(), json!(["first", "far 0 -1", "far 0 1"])),
        wish("curve_distance", leaf),
    );
    let end = "a tree that ends with its tokens";
    for (name, tokens) in [
        ("missing", json!(["first", "far 0 1"])),
        ("none", json!([])),
        ("left", json!(["first", "far 0 1", "far 0 1", "far 0 1"])),
    ] {
        cases.reject(
            &format!("distance-tokens-{name}"),
            &far("1", "1", middle(), tokens),
            wish("curve_distance", end),
        );
    }
    let kind = "a token first, second or far";
    for (name, token) in [("split", "split"), ("separate", "separate 0 1"), ("cone", "cone 0 1")] {
        cases.reject(
            &format!("distance-token-{name}"),
            &far("1", "1", middle(), json!(["first", token, "far 0 1"])),
            wish("curve_distance", kind),
        );
    }
    let points = "points of a squared distance of at most upper_squared";
    cases.reject(
        "distance-upper-too-small",
        &far("1", "1", json!(["1/2", "500001/1000000"]), tree()),
        wish("curve_distance", points),
    );
    let presence = "a tree when and only when lower_squared is not 0";
    cases.reject(
        "distance-without-a-tree",
        &far("1", "1", middle(), Value::Null),
        wish("curve_distance", presence),
    );
    cases.reject(
        "distance-zero-with-a-tree",
        &far("0", "1", middle(), tree()),
        wish("curve_distance", presence),
    );
    runs(cases);
    let crossing = |upper: &str| {
        certificate(
            parabola(),
            json!([distance(bezier(json!([[[-1, 0], [1, 0]]])), "0", upper)]),
            json!([{ "parameters": ["1/2", "1/2"], "tree": null }]),
        )
    };
    cases.accept("distance-of-curves-that-meet", &crossing("0"));
    let space = bezier(json!([[[0, 0, 5], [1, 0, 5]]]));
    cases.reject(
        "distance-in-space-from-the-plane",
        &certificate(
            parabola(),
            json!([distance(space, "0", "100")]),
            json!([{ "parameters": ["1/2", "1/2"], "tree": null }]),
        ),
        wish("curve_distance", "a curve of the same dimension"),
    );
    let still = bezier(json!([[[5, 5], [5, 5]]]));
    cases.reject(
        "distance-from-a-piece-that-is-a-point",
        &certificate(
            parabola(),
            json!([distance(still, "0", "100")]),
            json!([{ "parameters": ["1/2", "1/2"], "tree": null }]),
        ),
        wish("curve_distance", "pieces that are not points"),
    );
}

/// Runs are boxes: a bent polygon beside another.
fn runs(cases: &mut Cases) {
    let far = |lower: &str, tokens: Value| {
        certificate(
            bezier(json!([[[0, 0], [1, 1]], [[1, 1], [2, 0]]])),
            json!([distance(
                bezier(json!([[[0, 5], [1, 4]], [[1, 4], [2, 5]], [[2, 5], [3, 4]]])),
                lower,
                "9"
            )]),
            json!([{ "parameters": ["1", "1"], "tree": tokens }]),
        )
    };
    cases.accept("distance-of-runs", &far("9", json!(["far 0 -1"])));
    cases.accept(
        "distance-of-halves-of-runs",
        &far("9", json!(["second", "far 0 -1", "first", "far 0 -1", "far 0 -1"])),
    );
    cases.reject(
        "distance-of-runs-greater",
        &far("901/100", json!(["far 0 -1"])),
        wish("curve_distance", "nodes that are far along n"),
    );
}

fn documents(cases: &mut Cases) {
    let with = |pointer: &str, value: Value| everything().with(pointer, value);
    cases.malformed(
        "unknown-operation",
        with("/statement/entries/0/operation", json!("points")).json(),
        |_| true,
    );
    cases.malformed(
        "field-of-another-operation",
        everything()
            .with_field("/statement/entries/0", "side", json!("left"))
            .json(),
        |_| true,
    );
    cases.malformed(
        "without-side",
        everything().without_field("/statement/entries/1", "side").json(),
        |_| true,
    );
    cases.malformed(
        "side-before",
        with("/statement/entries/1/side", json!("before")).json(),
        |_| true,
    );
    cases.malformed(
        "three-coordinates",
        with("/statement/entries/0/point", json!(["-1/2", "1/4", "0"])).json(),
        |_| true,
    );
    cases.malformed(
        "squared-curvature-negative",
        with("/statement/entries/2/value_squared", json!("-1/2")).json(),
        |_| true,
    );
    cases.malformed(
        "order-a-string",
        with("/statement/entries/1/order", json!("2")).json(),
        |_| true,
    );
    cases.malformed("entry-null", with("/statement/entries/0", Value::Null).json(), |_| true);
    cases.malformed(
        "without-witnesses",
        with("/evidence/witnesses", json!([])).json(),
        |_| true,
    );
    cases.malformed(
        "one-witness-more",
        with(
            "/evidence/witnesses",
            json!([{ "parameter": "1/2" }, { "parameters": ["1/2", "1/2"], "tree": ["first", "far 0 1", "far 0 1"] }, { "parameter": "1/2" }]),
        )
        .json(),
        |_| true,
    );
    cases.malformed(
        "witnesses-exchanged",
        with(
            "/evidence/witnesses",
            json!([{ "parameters": ["1/2", "1/2"], "tree": ["first", "far 0 1", "far 0 1"] }, { "parameter": "1/2" }]),
        )
        .json(),
        |_| true,
    );
    cases.malformed(
        "tree-left-out",
        everything().without_field("/evidence/witnesses/1", "tree").json(),
        |_| true,
    );
    cases.malformed(
        "three-parts",
        with(
            "/statement/entries/5/curves",
            json!([parabola_spline(), parabola_spline(), parabola_spline()]),
        )
        .json(),
        |_| true,
    );
    cases.malformed(
        "result-with-decreasing-knots",
        with(
            "/statement/entries/4/curve/bspline/knots",
            json!(["0", "0", "0", "1", "1", "1/2"]),
        )
        .json(),
        |_| true,
    );
    let long = format!("1/{}", "1".repeat(1300));
    cases.malformed(
        "parameter-too-long",
        with("/statement/entries/0/parameter", json!(long)).json(),
        |_| true,
    );
}
