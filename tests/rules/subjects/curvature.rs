//! The claim `curvature`.

use knotproof::check::Reason;
use serde_json::{Value, json};

use crate::common::case::{Case, Cases, expecting, reason};
use crate::common::document::{Certificate, bezier, exact, polygon};

/// The parabola y = x − x²/2 for x from 0 to 2, of greatest curvature 1 in the middle.
fn parabola() -> Value {
    bezier(json!([[[0, 0], [1, 1], [2, 0]]]))
}

/// A quarter of the unit circle.
fn quarter() -> Value {
    json!({ "bezier": { "pieces": [{ "points": exact(json!([[1, 0], [1, 1], [0, 1]])), "weights": ["1", "1", "2"] }] } })
}

/// (u², u⁴): half of the parabola y = x², which begins with two coincident control points and has the curvature 2 there.
fn slow_start() -> Value {
    let points = json!([["0", "0"], ["0", "0"], ["1/6", "0"], ["1/2", "0"], ["1", "1"]]);
    json!({ "bezier": { "pieces": [{ "points": points }] } })
}

/// A certificate that the greatest squared curvature is in an interval.
pub fn about(curve: Value, [lower, upper]: [&str; 2], piece: u32, u: &str) -> Certificate {
    let mut certificate = Certificate::new(curve);
    certificate.0["statement"] = json!({ "claim": "curvature", "lower_squared": lower, "upper_squared": upper });
    certificate.0["evidence"] = json!({ "piece": piece, "u": u });
    certificate
}

/// The greatest curvature of the parabola, exactly.
pub fn vertex() -> Certificate {
    about(parabola(), ["1", "1"], 0, "1/2")
}

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("curvature");
    let attained = || expecting("curvature", "a squared curvature of at least lower_squared");
    let bounded = || expecting("curvature", "a squared curvature of at most upper_squared by halving");
    let regular = || expecting("curvature", "a squared length of D positive by halving");
    cases.accept("parabola", &vertex());
    cases.accept_bytes("parabola-binary", vertex().binary());
    let mut longer = vertex().binary();
    longer.push(0);
    cases.reject_bytes("parabola-binary-and-a-token", longer, reason(Reason::TokensLeft));
    cases.accept("wide", &about(parabola(), ["1/2", "7"], 0, "2/5"));
    cases.accept("lower-zero", &about(parabola(), ["0", "1"], 0, "0"));
    cases.reject(
        "lower-at-another-place",
        &about(parabola(), ["1", "1"], 0, "1/3"),
        attained(),
    );
    let with = |pointer: &str, value: Value| vertex().with(pointer, value);
    let [lower, upper] = ["/statement/lower_squared", "/statement/upper_squared"];
    cases.reject(
        "lower-slightly-greater",
        &with(lower, json!("1000001/1000000")).with(upper, json!("2")),
        attained(),
    );
    cases.reject(
        "upper-slightly-smaller",
        &with(upper, json!("999999/1000000")).with(lower, json!("0")),
        bounded(),
    );
    cases.reject("reversed", &with(upper, json!("1/2")), reason(Reason::Reversed));
    cases.reject(
        "no-such-piece",
        &with("/evidence/piece", json!(1)),
        expecting("curvature", "a piece of the curve"),
    );
    for (name, u) in [("before-the-piece", "-1/2"), ("behind-the-piece", "3/2")] {
        let place = expecting("curvature", "a local parameter from 0 to 1");
        cases.reject(name, &with("/evidence/u", json!(u)), place);
    }
    cases.malformed("lower-negative", with(lower, json!("-1")).json(), |_| true);
    cases.malformed("upper-null", with(upper, Value::Null).json(), |_| true);
    cases.malformed("without-u", vertex().without_field("/evidence", "u").json(), |_| true);
    cases.malformed(
        "another-field",
        vertex().with_field("/evidence", "tree", Value::Null).json(),
        |_| true,
    );
    let long = |bits: u32| {
        let power = knotproof::number::Integer::ONE << (bits - 1);
        format!("{}/{}", &power - knotproof::number::Integer::ONE, power)
    };
    cases.accept("long-parameter", &about(parabola(), ["0", "1"], 0, &long(4096)));
    cases.malformed(
        "parameter-too-long",
        about(parabola(), ["0", "1"], 0, &long(4097)).json(),
        |_| true,
    );

    cases.accept("circle", &about(quarter(), ["1", "1"], 0, "1/3"));
    cases.reject(
        "circle-smaller",
        &about(quarter(), ["0", "999999/1000000"], 0, "1/3"),
        bounded(),
    );
    cases.reject(
        "circle-greater",
        &about(quarter(), ["1000001/1000000", "2"], 0, "1/3"),
        attained(),
    );
    let square = polygon(json!([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]));
    cases.accept("corners-do-not-count", &about(square.clone(), ["0", "0"], 3, "0"));
    cases.reject("straight", &about(square, ["1/1000000", "1"], 3, "0"), attained());
    let tilted = json!({ "bezier": { "pieces": [
        { "points": [["0", "0", "0"], ["1", "3/5", "4/5"], ["2", "0", "0"]] }] } });
    cases.accept("in-space", &about(tilted.clone(), ["1", "1"], 0, "1/2"));
    cases.reject("in-space-smaller", &about(tilted, ["0", "99/100"], 0, "1/2"), bounded());

    // The second piece is bent more.
    let two = || bezier(json!([[[0, 0], [1, 1], [2, 0]], [[2, 0], [3, -3], [4, 0]]]));
    cases.accept("two-pieces", &about(two(), ["9", "9"], 1, "1/2"));
    cases.reject("one-of-two-pieces", &about(two(), ["1", "1"], 0, "1/2"), bounded());

    cases.accept("coincident-points", &about(slow_start(), ["256/125", "4"], 0, "1/2"));
    cases.reject(
        "coincident-points-smaller",
        &about(slow_start(), ["256/125", "399/100"], 0, "1/2"),
        bounded(),
    );
    cases.reject(
        "where-D-vanishes",
        &about(slow_start(), ["0", "4"], 0, "0"),
        expecting("curvature", "a parameter where D does not vanish"),
    );
    let points = json!([["0", "0"], ["0", "0"], ["1/3", "0"], ["1", "1"]]);
    let half_cusp = json!({ "bezier": { "pieces": [{ "points": points }] } });
    cases.reject("unbounded", &about(half_cusp, ["0", "1000000"], 0, "1/2"), bounded());
    let points = json!([["1", "-1"], ["-1/3", "1"], ["-1/3", "-1"], ["1", "1"]]);
    let cusp = json!({ "bezier": { "pieces": [{ "points": points }] } });
    cases.reject("cusp", &about(cusp, ["0", "1000000"], 0, "0"), regular());
    let back = bezier(json!([[[0, 0], [2, 0], [1, 0]]]));
    cases.reject("turning-back-on-a-line", &about(back, ["0", "0"], 0, "0"), regular());
    let point = bezier(json!([[[0, 0], [1, 0]], [[1, 0], [1, 0]]]));
    cases.reject(
        "piece-that-is-a-point",
        &about(point, ["0", "0"], 0, "0"),
        reason(Reason::PointPiece { piece: 1 }),
    );
    cases.list()
}
