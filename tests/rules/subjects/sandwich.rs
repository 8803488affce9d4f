//! Outcome `sandwich` of the claim `domain`.

use serde_json::{Value, json};

use super::domain::{block, rectangle};
use crate::common::case::{Case, Cases, expecting};
use crate::common::document::exact;

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("sandwich");
    let with = |pointer: &str, value: Value| rectangle().with(pointer, value);
    let rule = |wish| expecting("sandwich", wish);
    cases.accept("rectangle", &rectangle());
    cases.accept("block", &block());
    cases.accept(
        "weaker-measures",
        &with("/statement/outcome/inner_measure", json!("1")).with("/statement/outcome/outer_measure", json!("100")),
    );
    cases.reject(
        "inner-measure-too-large",
        &with("/statement/outcome/inner_measure", json!("4000001/1000000")),
        rule("an inner measure at most that of the inner star"),
    );
    cases.reject(
        "outer-measure-too-small",
        &with("/statement/outcome/outer_measure", json!("3999999/1000000")),
        rule("an outer measure at least that of the outer star"),
    );
    for (name, value) in [("zero", "0"), ("negative", "-4")] {
        cases.reject(
            &format!("inner-measure-{name}"),
            &with("/statement/outcome/inner_measure", json!(value)),
            rule("a positive inner measure"),
        );
        let doubled = if value == "0" { "0" } else { "-2" };
        cases.reject(
            &format!("denominator-{name}"),
            &with("/evidence/denominator", json!(doubled)),
            rule("a positive denominator"),
        );
    }
    cases.reject("other-denominator", &with("/evidence/denominator", json!("3")), |_| {
        true
    });

    // Points.
    let positive = "a sign function positive by halving";
    let non_negative = "a sign function non-negative by halving";
    cases.reject(
        "center-on-the-boundary",
        &with("/evidence/center", json!(["2", "0"])),
        rule(positive),
    );
    cases.reject(
        "center-outside",
        &with("/evidence/center", json!(["2", "-1"])),
        rule(positive),
    );
    cases.reject(
        "center-outside-the-box",
        &with("/evidence/center", json!(["2", "3"])),
        rule("the center in the box"),
    );
    cases.reject(
        "inner-point-outside",
        &with("/evidence/inner/points/0", json!(["-2", "-1"])),
        rule(non_negative),
    );
    cases.reject(
        "inner-point-outside-the-box",
        &with("/evidence/inner/points/2", json!(["7", "2"])),
        rule("inner points in the box"),
    );
    // A point that no cell names is claimed too: the hull of all inner points is in cl K.
    let mut more = rectangle();
    let points = more
        .0
        .pointer_mut("/evidence/inner/points")
        .and_then(Value::as_array_mut);
    points.expect("points").push(json!(["0", "-1"]));
    cases.reject("unused-inner-point-outside", &more, rule(non_negative));

    // Stars.
    let star = "a star around the center";
    let no_cells = json!([]);
    cases.reject(
        "no-inner-cells",
        &with("/evidence/inner/cells", no_cells.clone()),
        rule(star),
    );
    cases.reject("no-outer-cells", &with("/evidence/outer/cells", no_cells), rule(star));
    let inner = |cells: Value| with("/evidence/inner/cells", cells);
    cases.reject("inner-hole", &inner(json!([[0, 1], [1, 2], [2, 3]])), rule(star));
    cases.reject(
        "inner-cell-reversed",
        &inner(json!([[1, 0], [1, 2], [2, 3], [3, 0]])),
        rule(star),
    );
    cases.reject(
        "inner-cell-degenerate",
        &inner(json!([[0, 0], [1, 2], [2, 3], [3, 0]])),
        rule(star),
    );
    cases.reject(
        "inner-point-missing",
        &inner(json!([[0, 1], [1, 2], [2, 3], [3, 4]])),
        rule(star),
    );
    let twice = json!([[0, 1], [1, 2], [2, 3], [3, 0], [0, 1], [1, 2], [2, 3], [3, 0]]);
    cases.reject(
        "inner-twice-around",
        &inner(twice).with("/statement/outcome/inner_measure", json!("8")),
        rule(star),
    );
    // Around twice in one cycle: every point is once a start and once an end.
    let corners = |points: Value| with("/evidence/inner/points", exact(points));
    let spiral = corners(json!([
        [-2, 0],
        [6, 0],
        [6, 2],
        [-2, 2],
        [-1, 0],
        [5, 0],
        [5, 2],
        [-1, 2]
    ]));
    cases.reject(
        "inner-double-cycle",
        &spiral.with(
            "/evidence/inner/cells",
            json!([[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6], [6, 7], [7, 0]]),
        ),
        rule(star),
    );
    cases.accept(
        "inner-triangle",
        &corners(json!([[-2, 0], [6, 0], [2, 2]]))
            .with("/evidence/inner/cells", json!([[0, 1], [1, 2], [2, 0]]))
            .with("/statement/outcome/inner_measure", json!("2")),
    );
    cases.reject(
        "block-without-a-side",
        &{
            let mut certificate = block();
            let cells = certificate
                .0
                .pointer_mut("/evidence/inner/cells")
                .and_then(Value::as_array_mut);
            cells.expect("cells").truncate(10);
            certificate
        },
        rule(star),
    );
    cases.reject(
        "block-twice",
        &{
            let mut certificate = block();
            let cells = certificate
                .0
                .pointer_mut("/evidence/inner/cells")
                .and_then(Value::as_array_mut)
                .expect("cells");
            let again = cells.clone();
            cells.extend(again);
            certificate.with("/statement/outcome/inner_measure", json!("8"))
        },
        rule(star),
    );
    cases.reject(
        "block-triangle-reversed",
        &block().with("/evidence/inner/cells/0", json!([0, 3, 2])),
        rule(star),
    );

    // Rows of outer cells.
    let outer = |pointer: &str, value: Value| with(&format!("/evidence/outer/{pointer}"), value);
    cases.reject(
        "outer-point-within",
        &outer("points/0", json!(["-2", "1"])).with("/statement/outcome/outer_measure", json!("4")),
        |_| true,
    );
    cases.accept(
        "outer-point-beyond",
        &outer("points/0", json!(["-3", "-1"])).with("/statement/outcome/outer_measure", json!("6")),
    );
    cases.reject(
        "row-of-another-cell",
        &outer("cells/0", json!([0, 1, 2])),
        rule("rows at most 0 at their cells"),
    );
    cases.reject(
        "row-missing",
        &outer("cells/0", json!([0, 1, 4])),
        rule("a row for every outer cell"),
    );
    let rows = "rows of the sections and the box";
    cases.reject("row-of-no-piece", &with("/evidence/rows/0/piece", json!(1)), rule(rows));
    cases.reject(
        "row-beyond-the-piece",
        &with("/evidence/rows/0/u", json!("3/2")),
        rule(rows),
    );
    cases.reject("row-of-no-axis", &with("/evidence/rows/1/axis", json!(2)), rule(rows));
    cases.reject(
        "row-of-the-other-side",
        &with("/evidence/rows/1/side", json!("low")),
        rule("rows at most 0 at their cells"),
    );
    cases.accept("row-at-the-start", &with("/evidence/rows/0/u", json!("0")));
    cases.accept("row-at-the-end", &with("/evidence/rows/0/u", json!("1")));

    // Texts.
    for (name, pointer, value) in [
        ("cell-too-short", "/evidence/inner/cells/0", json!([0])),
        ("cell-too-long", "/evidence/inner/cells/0", json!([0, 1, 2])),
        ("outer-cell-without-row", "/evidence/outer/cells/0", json!([0, 1])),
        ("cell-of-strings", "/evidence/inner/cells/0", json!(["0", "1"])),
        ("cell-negative", "/evidence/inner/cells/0", json!([0, -1])),
        ("point-of-three", "/evidence/inner/points/0", json!(["0", "0", "0"])),
        ("point-of-fractions", "/evidence/inner/points/0", json!(["-2", "1/2"])),
        ("point-of-numbers", "/evidence/inner/points/0", json!([-2, 0])),
        ("denominator-fraction", "/evidence/denominator", json!("3/2")),
        (
            "measure-not-canonical",
            "/statement/outcome/inner_measure",
            json!("4/2"),
        ),
        (
            "row-of-both-kinds",
            "/evidence/rows/0",
            json!({ "piece": 0, "u": "1/2", "axis": 0 }),
        ),
        ("row-of-no-kind", "/evidence/rows/0", json!({})),
        ("row-side-unknown", "/evidence/rows/1/side", json!("left")),
        ("outcome-unknown", "/statement/outcome/kind", json!("sandwiches")),
        (
            "outcome-of-another-kind",
            "/statement/outcome",
            json!({ "kind": "empty" }),
        ),
        ("sign-unknown", "/statement/sign", json!("positive")),
        ("open-of-three", "/statement/open", json!([false, false, false])),
        ("box-of-one", "/statement/box", json!([["-1", "-1"]])),
        ("claim-unknown", "/statement/claim", json!("domains")),
        ("claim-of-another", "/statement/claim", json!("msd")),
        ("points-of-strings", "/statement/points", json!(["1"])),
        ("points-negative", "/statement/points", json!([-1])),
    ] {
        cases.malformed(name, with(pointer, value).json(), |_| true);
    }
    for (name, certificate) in [
        (
            "statement-with-a-field",
            rectangle().with_field("/statement", "degree", json!("true")),
        ),
        (
            "outcome-with-a-field",
            rectangle().with_field("/statement/outcome", "volume", json!("4")),
        ),
        (
            "evidence-with-a-field",
            rectangle().with_field("/evidence", "tree", Value::Null),
        ),
        (
            "star-with-a-field",
            rectangle().with_field("/evidence/inner", "rows", json!([])),
        ),
        ("without-open", rectangle().without_field("/statement", "open")),
        ("without-rows", rectangle().without_field("/evidence", "rows")),
        ("without-center", rectangle().without_field("/evidence", "center")),
    ] {
        cases.malformed(name, certificate.json(), |_| true);
    }
    cases.list()
}
