//! The claim `deviation`.

use knotproof::check::Reason;
use serde_json::{Value, json};

use crate::common::case::{Case, Cases, expecting, reason};
use crate::common::document::{Certificate, bezier};

/// The parabola (−1,1), (0,−1), (1,1) is 1 from its polygon, at (0,0); after a halving 1/4.
fn parabola() -> Certificate {
    let mut certificate = Certificate::new(bezier(json!([[[-1, 1], [0, -1], [1, 1]]])));
    certificate.0["statement"] =
        json!({ "claim": "deviation", "subdivisions": 0, "lower_squared": "1", "upper_squared": "1" });
    certificate.0["evidence"] = json!({ "piece": 0, "part": 0, "u": "1/2" });
    certificate
}

/// A rational piece with the weights 1, 1/100, 1: nearly its chord, and far from its polygon.
fn flat() -> Certificate {
    let curve = json!({ "bezier": { "pieces": [{ "points": [["-1", "0"], ["0", "1"], ["1", "0"]], "weights": ["1", "1/100", "1"] }] } });
    parabola()
        .curve(curve)
        .with("/statement/lower_squared", json!("9801/10201"))
        .with("/statement/upper_squared", json!("1"))
}

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("deviation");
    let with = |pointer: &str, value: Value| parabola().with(pointer, value);
    let rule = |wish| expecting("deviation", wish);
    cases.accept("parabola", &parabola());
    cases.accept("rational", &flat());
    cases.accept_bytes("parabola-binary", parabola().binary());
    let halved = |part: u32, u: &str| {
        with("/statement/subdivisions", json!(1))
            .with("/statement/lower_squared", json!("1/16"))
            .with("/statement/upper_squared", json!("1/16"))
            .with("/evidence/part", json!(part))
            .with("/evidence/u", json!(u))
    };
    cases.accept("halved-first-part", &halved(0, "1/2"));
    cases.accept("halved-second-part", &halved(1, "1/2"));
    cases.accept(
        "weaker",
        &with("/statement/lower_squared", json!("0")).with("/statement/upper_squared", json!("2")),
    );
    let lower = "a squared distance of at least lower_squared";
    cases.reject("lower-elsewhere", &with("/evidence/u", json!("1/3")), rule(lower));
    cases.reject("lower-at-a-vertex", &halved(1, "0"), rule(lower));
    cases.reject(
        "lower-too-large",
        &with("/statement/lower_squared", json!("1000001/1000000")).with("/statement/upper_squared", json!("2")),
        rule(lower),
    );
    cases.reject(
        "reversed",
        &with("/statement/upper_squared", json!("1/2")),
        reason(Reason::Reversed),
    );
    let upper = "a squared distance of at most upper_squared by halving";
    let less = with("/statement/lower_squared", json!("0"));
    cases.reject(
        "upper-too-small",
        &less.clone().with("/statement/upper_squared", json!("999999/1000000")),
        rule(upper),
    );
    cases.reject(
        "upper-of-the-halves",
        &less.with("/statement/upper_squared", json!("1/16")),
        rule(upper),
    );
    cases.reject("rational-upper-too-small", &flat().with("/statement/upper_squared", json!("9802/10201")).with("/statement/lower_squared", json!("0")).curve(
        json!({ "bezier": { "pieces": [{ "points": [["-1", "0"], ["0", "1"], ["1", "0"]], "weights": ["1", "1/200", "1"] }] } })), rule(upper));
    cases.reject(
        "no-such-piece",
        &with("/evidence/piece", json!(1)),
        rule("a piece of the curve"),
    );
    cases.reject(
        "no-such-part",
        &with("/evidence/part", json!(1)),
        rule("a part of the piece"),
    );
    cases.reject(
        "no-such-parameter",
        &with("/evidence/u", json!("3/2")),
        rule("a local parameter from 0 to 1"),
    );
    cases.reject(
        "a-negative-parameter",
        &with("/evidence/u", json!("-1/2")),
        rule("a local parameter from 0 to 1"),
    );
    let most = "at most 16 subdivisions and 4,194,304 edges";
    cases.reject(
        "subdivided-too-often",
        &with("/statement/subdivisions", json!(17)),
        rule(most),
    );
    cases.malformed(
        "negative-bound",
        with("/statement/lower_squared", json!("-1")).json(),
        |_| true,
    );
    cases.malformed(
        "without-part",
        parabola().without_field("/evidence", "part").json(),
        |_| true,
    );
    cases.malformed(
        "with-a-tree",
        parabola().with_field("/evidence", "tree", Value::Null).json(),
        |_| true,
    );
    cases.malformed("part-fraction", with("/evidence/part", json!(0.5)).json(), |_| true);
    cases.list()
}
