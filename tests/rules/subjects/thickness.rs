//! The claim `thickness`.

use knotproof::check::Reason;
use serde_json::{Value, json};

use super::{SEGMENT, channel_curve, curvature, root, segment_curve};
use crate::common::case::{Case, Cases, expecting, obligation, reason};
use crate::common::document::{Certificate, polygon};

/// A certificate with this evidence.
fn about(curve: Value, convention: &str, bounds: [Value; 2], evidence: Value) -> Certificate {
    let [lower, upper] = bounds;
    let mut certificate = Certificate::new(curve);
    certificate.0["statement"] =
        json!({ "claim": "thickness", "convention": convention, "lower_squared": lower, "upper_squared": upper });
    certificate.0["evidence"] = evidence;
    certificate
}

fn part(certificate: &Certificate) -> Value {
    json!({ "statement": certificate.0["statement"], "evidence": certificate.0["evidence"] })
}

/// An open segment: its reach is infinite.
pub fn segment() -> Certificate {
    let msd = Certificate::new(segment_curve()).critical().lower("inf", &SEGMENT);
    let curvature = curvature::about(segment_curve(), ["0", "0"], 0, "0");
    let evidence = json!({ "msd": part(&msd), "curvature": part(&curvature) });
    about(segment_curve(), "critical", [json!("inf"), Value::Null], evidence)
}

/// The unit circle, without a lower bound: τ ≤ 1.
pub fn circle() -> Certificate {
    let case = root::cases()
        .into_iter()
        .find(|case| case.name == "rational-inside")
        .expect("a case");
    let msd = Certificate::of_bytes(&case.bytes);
    let curve = msd.0["curve"].clone();
    let curvature = curvature::about(curve.clone(), ["1", "1"], 0, "1/3");
    let evidence = json!({ "msd": part(&msd), "curvature": part(&curvature) });
    about(curve, "smooth", [json!("0"), json!("1")], evidence)
}

/// A polygon with a corner.
pub fn corner() -> Certificate {
    let evidence = json!({ "corner": 1 });
    about(channel_curve(), "critical", [json!("0"), json!("0")], evidence)
}

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("thickness");
    let [lower, upper] = ["/statement/lower_squared", "/statement/upper_squared"];
    let below = || {
        let wish = "a lower_squared at most 1/κ² and σ²/4 by the bounds in the evidence";
        expecting("thickness", wish)
    };
    let above = || {
        let wish = "an upper_squared at least 1/κ² or σ²/4 by the bounds in the evidence";
        expecting("thickness", wish)
    };
    cases.accept("segment", &segment());
    cases.accept_bytes("segment-binary", segment().binary());
    cases.accept("segment-finite", &segment().with(lower, json!("25")));
    cases.reject(
        "segment-bounded",
        &segment().with(upper, json!("25")).with(lower, json!("0")),
        above(),
    );
    cases.reject(
        "inf-below-a-bound",
        &segment().with(upper, json!("25")),
        reason(Reason::Reversed),
    );
    let open = "the convention \"critical\" for an open curve";
    cases.reject(
        "open-and-smooth",
        &segment().with("/statement/convention", json!("smooth")),
        expecting("thickness", open),
    );
    cases.reject(
        "chords-of-the-other-convention",
        &segment().with("/evidence/msd/statement/convention", json!("smooth")),
        expecting("thickness", "bounds of σ in the convention of the statement"),
    );
    let finite = segment().with("/evidence/msd/statement/lower_squared", json!("25"));
    cases.reject("inf-from-finite-chords", &finite, below());
    cases.accept("a-quarter-of-the-chords", &finite.clone().with(lower, json!("25/4")));
    cases.reject(
        "more-than-a-quarter-of-the-chords",
        &finite.with(lower, json!("313/50")),
        below(),
    );
    let bent = segment().with("/evidence/curvature/statement/upper_squared", json!("1/4"));
    cases.reject("inf-from-a-curvature", &bent, below());
    cases.accept("the-radius-of-curvature", &bent.clone().with(lower, json!("4")));
    cases.reject("more-than-the-radius", &bent.with(lower, json!("401/100")), below());
    cases.reject(
        "curvature-not-attained",
        &segment()
            .with("/evidence/curvature/statement/lower_squared", json!("1/4"))
            .with("/evidence/curvature/statement/upper_squared", json!("1/4"))
            .with(lower, json!("0")),
        obligation("curvature"),
    );
    cases.reject(
        "a-leaf-that-does-not-hold",
        &segment().with("/evidence/msd/evidence/tree/3", json!("not_normal 1 0")),
        obligation("not_normal"),
    );
    cases.malformed(
        "without-curvature",
        segment().without_field("/evidence", "curvature").json(),
        |_| true,
    );
    cases.malformed(
        "another-claim-inside",
        segment()
            .with("/evidence/curvature/statement/claim", json!("msd"))
            .json(),
        |_| true,
    );
    cases.malformed(
        "corner-and-bounds",
        segment().with_field("/evidence", "corner", json!(0)).json(),
        |_| true,
    );

    cases.accept("circle", &circle());
    cases.accept("circle-not-bounded", &circle().with(upper, Value::Null));
    cases.reject("circle-smaller", &circle().with(upper, json!("99/100")), above());
    cases.reject("circle-without-a-tree", &circle().with(lower, json!("1/2")), below());
    cases.accept(
        "circle-by-its-chords",
        &circle().with("/evidence/curvature/statement/lower_squared", json!("0")),
    );
    cases.reject("reversed", &circle().with(lower, json!("2")), reason(Reason::Reversed));

    cases.accept("corner", &corner());
    cases.accept_bytes("corner-binary", corner().binary());
    cases.accept("corner-not-bounded", &corner().with(upper, Value::Null));
    let joint = || expecting("thickness", "a joint that is a corner");
    for (name, number) in [("end-0", 0), ("end-3", 3), ("no-joint", 9)] {
        let other = corner().with("/evidence/corner", json!(number));
        cases.reject(&format!("corner-{name}"), &other, joint());
    }
    cases.reject(
        "corner-lower",
        &corner().with(lower, json!("1/9")).with(upper, json!("1")),
        expecting("thickness", "lower_squared 0 of a curve with a corner"),
    );
    cases.reject(
        "corner-open-and-smooth",
        &corner().with("/statement/convention", json!("smooth")),
        expecting("thickness", open),
    );
    let closed = polygon(json!([[0, 0], [4, 0], [4, 3], [0, 0]]));
    let corner_at = |joint: u32| {
        let evidence = json!({ "corner": joint });
        about(closed.clone(), "smooth", [json!("0"), json!("0")], evidence)
    };
    cases.accept("corner-at-the-closing-point", &corner_at(0));
    cases.reject("corner-behind-the-closing-point", &corner_at(3), joint());
    let straight_on = polygon(json!([[0, 0], [1, 0], [3, 0], [3, 1]]));
    let smooth_joint = corner().curve(straight_on);
    cases.reject("smooth-joint", &smooth_joint, joint());
    cases.accept(
        "corner-after-it",
        &smooth_joint.clone().with("/evidence/corner", json!(2)),
    );
    // Bounds where there is a corner.
    let mut bounds = corner();
    let msd = Certificate::new(channel_curve()).critical();
    let curvature = curvature::about(channel_curve(), ["0", "0"], 0, "0");
    bounds.0["evidence"] = json!({ "msd": part(&msd), "curvature": part(&curvature) });
    bounds.0["statement"]["upper_squared"] = Value::Null;
    cases.reject("bounds-beside-a-corner", &bounds, expecting("thickness", "no corner"));
    cases.list()
}
