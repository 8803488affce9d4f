//! Outcome `ball` of the claim `domain`.

use serde_json::{Value, json};

use super::domain::{about, parabola};
use crate::common::case::{Case, Cases, expecting};
use crate::common::document::Certificate;

/// In the strip [−1,3] × (0,1] the largest ball has the radius 1/2.
pub fn strip() -> Certificate {
    about(
        parabola(),
        json!({ "kind": "ball", "lower": "1/2", "upper": "1/2" }),
        json!({
            "center": ["1", "1/2"], "rows": [{ "piece": 0, "u": "1" }, { "axis": 1, "side": "high" }],
            "multipliers": ["1", "2"], "lengths": ["2", "1"]
        }),
    )
}

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("ball");
    let with = |pointer: &str, value: Value| strip().with(pointer, value);
    let rule = |wish| expecting("ball", wish);
    cases.accept("strip", &strip());
    cases.accept("elsewhere", &with("/evidence/center", json!(["2", "1/2"])));
    cases.accept(
        "weaker",
        &with("/statement/outcome/lower", json!("1/3")).with("/statement/outcome/upper", json!("2/3")),
    );
    cases.reject(
        "lower-zero",
        &with("/statement/outcome/lower", json!("0")),
        rule("a positive radius"),
    );
    cases.reject(
        "lower-negative",
        &with("/statement/outcome/lower", json!("-1/2")),
        rule("a positive radius"),
    );
    cases.reject(
        "lower-too-large",
        &with("/statement/outcome/lower", json!("501/1000")),
        rule("a ball within the box"),
    );
    cases.reject(
        "too-near-to-a-side",
        &with("/evidence/center", json!(["-3/4", "1/2"])),
        rule("a ball within the box"),
    );
    cases.reject(
        "too-low",
        &with("/evidence/center", json!(["1", "49/100"])),
        rule("a ball within the domain"),
    );
    let upper = "an upper bound at least that of the multipliers";
    cases.reject(
        "upper-too-small",
        &with("/statement/outcome/upper", json!("499/1000")),
        rule(upper),
    );
    let longer = "lengths at most those of the normals";
    cases.reject(
        "length-too-large",
        &with("/evidence/lengths", json!(["2000001/1000000", "1"])),
        rule(longer),
    );
    cases.reject(
        "length-negative",
        &with("/evidence/lengths", json!(["2", "-1"])),
        rule(longer),
    );
    cases.reject(
        "lengths-zero",
        &with("/evidence/lengths", json!(["0", "0"])),
        rule("a positive sum of multipliers times lengths"),
    );
    cases.reject(
        "length-missing",
        &with("/evidence/lengths", json!(["2"])),
        rule("as many lengths as rows"),
    );
    cases.accept(
        "shorter-lengths",
        &with("/evidence/lengths", json!(["1", "1"])).with("/statement/outcome/upper", json!("2/3")),
    );
    cases.reject(
        "shorter-lengths-claim-less",
        &with("/evidence/lengths", json!(["1", "1"])),
        rule(upper),
    );
    cases.reject(
        "multipliers-unequal",
        &with("/evidence/multipliers", json!(["1", "1"])),
        rule("a combination of normals that vanishes"),
    );
    cases.reject(
        "multipliers-zero",
        &with("/evidence/multipliers", json!(["0", "0"])),
        rule("a positive sum of multipliers times lengths"),
    );
    cases.reject(
        "multiplier-negative",
        &with("/evidence/multipliers", json!(["-1", "-2"])),
        rule("multipliers ≥ 0"),
    );
    cases.reject(
        "multiplier-missing",
        &with("/evidence/multipliers", json!(["1"])),
        rule("as many multipliers as rows"),
    );
    cases.malformed(
        "without-lengths",
        strip().without_field("/evidence", "lengths").json(),
        |_| true,
    );
    cases.list()
}
