//! Outcome `change` of the claim `domain`.

use serde_json::{Value, json};

use super::domain::{about, parabola};
use crate::common::case::{Case, Cases, expecting};
use crate::common::document::Certificate;

/// From (1,1/2) the half-plane is left at (1,0).
pub fn half() -> Certificate {
    about(
        parabola(),
        json!({ "kind": "change", "from": ["1", "1/2"], "lower_squared": "1/4", "upper_squared": "1/4" }),
        json!({ "row": { "piece": 0, "u": "0" } }),
    )
}

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("change");
    let with = |pointer: &str, value: Value| half().with(pointer, value);
    let rule = |wish| expecting("change", wish);
    cases.accept("half", &half());
    cases.accept(
        "from-outside-the-box",
        &with("/statement/outcome/from", json!(["9", "1/2"])),
    );
    cases.accept("lower-zero", &with("/statement/outcome/lower_squared", json!("0")));
    cases.reject(
        "lower-too-large",
        &with("/statement/outcome/lower_squared", json!("250001/1000000")),
        rule("a ball within the domain"),
    );
    cases.reject(
        "lower-negative",
        &with("/statement/outcome/lower_squared", json!("-1/4")),
        rule("lower_squared ≥ 0"),
    );
    let upper = "a row that vanishes within upper_squared";
    cases.reject(
        "upper-too-small",
        &with("/statement/outcome/upper_squared", json!("249999/1000000")),
        rule(upper),
    );
    cases.reject(
        "from-the-boundary",
        &with("/statement/outcome/from", json!(["1", "0"])),
        rule("a sign function positive by halving"),
    );
    cases.reject(
        "from-outside",
        &with("/statement/outcome/from", json!(["1", "-1/2"])),
        rule("a sign function positive by halving"),
    );
    cases.reject(
        "row-of-the-box",
        &with("/evidence/row", json!({ "axis": 1, "side": "high" })),
        rule("a row of a piece"),
    );
    cases.reject(
        "row-of-no-piece",
        &with("/evidence/row/piece", json!(1)),
        rule("a row of a section"),
    );
    cases.malformed("without-row", half().without_field("/evidence", "row").json(), |_| true);
    cases.list()
}
