//! Statement and evidence of the claim `embedding`: edges, radii, tokens, and what both claims have in common.

use knotproof::check::{Place, Reason, Rejection};
use serde_json::{Value, json};

use super::{channel, channel_curve, segment_curve};
use crate::common::case::{Case, Cases, expecting, reason};
use crate::common::document::{Certificate, bezier, exact, polygon};

/// A certificate of the claim.
pub fn embedding(curve: Value, tree: &[&str], edges: u64, radius: [&str; 2]) -> Certificate {
    Certificate::new(curve)
        .with(
            "/statement",
            json!({
                "claim": "embedding", "edges": edges,
                "perturbation_radius": { "infinity": radius[0], "euclidean": radius[1] }
            }),
        )
        .with("/evidence", json!({ "grid": 0, "tree": tree }))
}

/// With other radii.
pub fn moving(certificate: &Certificate, infinity: &str, euclidean: &str) -> Certificate {
    let radius = json!({ "infinity": infinity, "euclidean": euclidean });
    certificate.clone().with("/statement/perturbation_radius", radius)
}

/// A tree for the channel. Token 4 is for the two long sides, 3 and 7 for its corners, the others for one side each.
pub const CHANNEL: [&str; 9] = [
    "split",
    "monotone 1 0",
    "second",
    "monotone 1 1",
    "separate 0 -1",
    "split",
    "monotone 0 1",
    "monotone -1 1",
    "monotone -1 0",
];

/// The channel is embedded. At its corners the short side has the product 3 with a vector of norm 2 or √2, and Σ|m_j| = 2.
pub fn embedded_channel() -> Certificate {
    embedding(channel_curve(), &CHANNEL, 3, ["3/4", "53/50"])
}

/// A closed square.
fn square() -> Certificate {
    let curve = polygon(json!([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]));
    let tree = [
        "split",
        "split",
        "monotone 1 0",
        "monotone 1 1",
        "monotone 0 1",
        "first",
        "second",
        "separate 0 -1",
        "monotone 1 -1",
        "second",
        "monotone -1 1",
        "separate 1 0",
        "split",
        "monotone -1 0",
        "monotone -1 -1",
        "monotone 0 -1",
    ];
    embedding(curve, &tree, 4, ["1/4", "353/1000"])
}

fn radius(norm: &'static str) -> impl Fn(&Rejection) -> bool {
    move |rejection| rejection.place == Place::Statement && rejection.reason == Reason::Radius { norm }
}

fn edges(stated: u64, found: u64) -> impl Fn(&Rejection) -> bool {
    reason(Reason::Edges { stated, found })
}

/// Cases of the claim.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("embedding");
    let channel = embedded_channel();
    cases.accept("channel", &channel);
    cases.accept_bytes("channel-binary", channel.binary());
    let segment = embedding(segment_curve(), &["monotone 3 4"], 1, ["25/14", "5/2"]);
    cases.accept("segment", &segment);
    cases.reject(
        "segment-moved-farther",
        &moving(&segment, "25/14", "2501/1000"),
        radius("euclidean"),
    );

    for (name, count) in [("one-edge-more", 4), ("one-edge-less", 2), ("no-edges", 0)] {
        cases.reject(
            name,
            &channel.clone().with("/statement/edges", json!(count)),
            edges(count, 3),
        );
    }
    cases.accept("square", &square());
    cases.reject(
        "square-as-if-open",
        &square().with("/statement/edges", json!(3)),
        edges(3, 4),
    );
    cases.reject(
        "square-with-both-ends",
        &square().with("/statement/edges", json!(5)),
        edges(5, 4),
    );
    // A part that was split counts with both halves, though its pieces are straight.
    let split = embedding(
        segment_curve(),
        &["split", "monotone 3 4", "monotone 3 4", "monotone 3 4"],
        2,
        ["25/14", "5/2"],
    );
    cases.accept("segment-in-two-parts", &split);
    cases.reject(
        "segment-in-two-parts-of-one-edge",
        &split.with("/statement/edges", json!(1)),
        edges(1, 2),
    );

    cases.accept("no-radius", &moving(&channel, "0", "0"));
    cases.reject(
        "moved-farther",
        &moving(&channel, "751/1000", "53/50"),
        radius("infinity"),
    );
    cases.reject(
        "moved-farther-euclidean",
        &moving(&channel, "3/4", "107/100"),
        radius("euclidean"),
    );

    for (name, leaf) in [("far-leaf", "far 0 -1"), ("not-normal-leaf", "not_normal 1 0")] {
        let rule = leaf.split(' ').next().expect("a rule");
        let wrong = channel.clone().token(4, leaf);
        cases.reject(
            name,
            &wrong,
            expecting(
                if rule == "far" { "far" } else { "not_normal" },
                "a rule of the claim embedding",
            ),
        );
    }
    for (name, leaf) in [("cone-leaf", "cone 1 0"), ("bend-leaf", "bend 1 1")] {
        let rule = if name == "cone-leaf" { "cone" } else { "bend" };
        cases.reject(
            name,
            &channel.clone().token(1, leaf),
            expecting(rule, "a rule of the claim embedding"),
        );
    }
    let of_msd = super::channel().token(4, "separate 0 -1");
    cases.reject(
        "separate-in-the-claim-msd",
        &of_msd,
        expecting("separate", "a rule of the claim msd"),
    );
    let of_msd = super::channel().token(6, "monotone 0 1");
    cases.reject(
        "monotone-in-the-claim-msd",
        &of_msd,
        expecting("monotone", "a rule of the claim msd"),
    );

    let short = channel.clone().with("/evidence/tree", json!(CHANNEL[..8]));
    cases.reject("a-token-missing", &short, reason(Reason::TokensMissing));
    let long = channel
        .clone()
        .with("/evidence/tree", json!([&CHANNEL[..], &["monotone 1 0"]].concat()));
    cases.reject("a-token-left", &long, reason(Reason::TokensLeft));
    cases.reject(
        "no-tokens",
        &channel.clone().with("/evidence/tree", json!([])),
        reason(Reason::TokensMissing),
    );
    cases.reject(
        "grid",
        &channel.clone().with("/evidence/grid", json!(100_001)),
        reason(Reason::Grid),
    );

    malformed(&mut cases, &channel);
    cusps(&mut cases);
    cases.list()
}

fn malformed(cases: &mut Cases, certificate: &Certificate) {
    for (name, pointer, value) in [
        ("edges-as-text", "/statement/edges", json!("3")),
        ("edges-not-whole", "/statement/edges", json!(3.0)),
        ("edges-negative", "/statement/edges", json!(-3)),
        ("edges-null", "/statement/edges", Value::Null),
        (
            "radius-negative",
            "/statement/perturbation_radius/infinity",
            json!("-1/4"),
        ),
        (
            "radius-not-reduced",
            "/statement/perturbation_radius/infinity",
            json!("2/8"),
        ),
        ("radius-as-number", "/statement/perturbation_radius/euclidean", json!(1)),
        (
            "radius-infinite",
            "/statement/perturbation_radius/euclidean",
            json!("inf"),
        ),
        ("radius-alone", "/statement/perturbation_radius", json!("1/4")),
        ("tree-null", "/evidence/tree", Value::Null),
        ("tree-binary", "/evidence/tree", json!("binary")),
        ("witness-of-three-integers", "/evidence/tree/1", json!("monotone 1 0 0")),
        ("witness-of-one-integer", "/evidence/tree/4", json!("separate -1")),
    ] {
        let wrong = certificate.clone().with(pointer, value);
        if name.starts_with("witness") {
            cases.reject(name, &wrong, |rejection| matches!(rejection.reason, Reason::Token(_)));
        } else {
            cases.malformed(name, wrong.json(), |_| true);
        }
    }
    let more = certificate.clone();
    for (name, pointer, key) in [
        ("convention", "/statement", "convention"),
        ("upper", "/evidence", "upper"),
        ("third-norm", "/statement/perturbation_radius", "one"),
    ] {
        cases.malformed(
            &format!("field-{name}"),
            more.clone().with_field(pointer, key, Value::Null).json(),
            |_| true,
        );
    }
    for (name, pointer, key) in [
        ("edges", "/statement", "edges"),
        ("radius", "/statement", "perturbation_radius"),
        ("norm", "/statement/perturbation_radius", "euclidean"),
        ("grid", "/evidence", "grid"),
        ("tree", "/evidence", "tree"),
    ] {
        cases.malformed(
            &format!("without-{name}"),
            more.clone().without_field(pointer, key).json(),
            |_| true,
        );
    }
    cases.malformed(
        "statement-of-msd",
        channel().with("/statement", certificate.0["statement"].clone()).json(),
        |_| true,
    );
}

/// Control points that coincide: zero vectors are dropped from the tangents, and the margin is 0.
fn cusps(cases: &mut Cases) {
    let start = bezier(json!([[[0, 0], [0, 0], [1, 0], [2, 1]]]));
    let standing = embedding(start, &["monotone 2 1"], 1, ["0", "0"]);
    cases.accept("coincident-control-points", &standing);
    cases.reject(
        "coincident-control-points-moved",
        &moving(&standing, "1/1000000000", "0"),
        radius("infinity"),
    );
    cases.reject(
        "coincident-control-points-moved-euclidean",
        &moving(&standing, "0", "1/1000000000"),
        radius("euclidean"),
    );
    let cusp = bezier(json!([[[0, 0], [2, 2], [0, 2], [2, 0]]]));
    let turning = embedding(cusp, &["monotone 1 0"], 1, ["0", "0"]);
    cases.reject("cusp", &turning, expecting("monotone", "v·n > 0 for every tangent v"));
    let point = bezier(json!([[[0, 0], [1, 0]], [[1, 0], [1, 0]]]));
    let still = embedding(point, &["monotone 1 0"], 1, ["0", "0"]);
    cases.reject(
        "a-piece-that-is-a-point",
        &still,
        reason(Reason::PointPiece { piece: 1 }),
    );
    // Of the control points of a spline the knots decide which pieces they move.
    let spline = |points: Value| {
        let knots: Vec<String> = (0..12).map(|i| i.to_string()).collect();
        json!({ "bspline": { "degree": 2, "knots": knots, "points": exact(points) } })
    };
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
    let tree = [
        "split",
        "monotone 1 7",
        "second",
        "second",
        "first",
        "separate 2 -7",
        "monotone -3 7",
        "separate 1 0",
        "separate 1 0",
        "split",
        "monotone -3 -2",
        "first",
        "separate 0 1",
        "monotone 1 -7",
        "monotone 2 -3",
    ];
    let open = embedding(spline(points), &tree, 5, ["1/20", "13/200"]);
    cases.accept("spline", &open);
    cases.reject(
        "spline-moved-farther",
        &moving(&open, "501/10000", "13/200"),
        radius("infinity"),
    );
    cases.reject(
        "spline-moved-farther-euclidean",
        &moving(&open, "1/20", "33/500"),
        |rejection| matches!(rejection.reason, Reason::Radius { .. }),
    );
}
