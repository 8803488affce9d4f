//! `knotproof certify curvature` and `knotproof certify thickness`.

use serde_json::{Value, json};
use tempfile::TempDir;

use super::run::{run, text};

const CIRCLE: &str = "certs/curves/nurbs-circle-radius-3-2.json";
const ELLIPSE: &str = "certs/curves/nurbs-ellipse.json";
const PARABOLA: &str = "certs/curves/parabola.json";

fn fields(json: &Value) -> Vec<&str> {
    json.as_object()
        .expect("an object")
        .keys()
        .map(String::as_str)
        .collect()
}

#[test]
fn the_object_of_curvature() {
    let directory = TempDir::new().expect("a directory");
    let path = directory.path().join("curvature.json");
    let json = run(["certify", "curvature", CIRCLE, "--json", "-o", text(&path)])
        .expect(0)
        .json();
    let mut expected = vec![
        "status",
        "claim",
        "lower_squared",
        "upper_squared",
        "lower",
        "upper",
        "relative_width",
        "relative_width_asked",
        "at",
        "piece",
        "local",
        "corners",
        "seconds",
        "certificate",
        "snapped_joints",
    ];
    expected.sort_unstable();
    let mut found = fields(&json);
    found.sort_unstable();
    assert_eq!(found, expected);
    assert_eq!([&json["status"], &json["claim"]], ["certified", "curvature"]);
    assert_eq!([&json["lower_squared"], &json["upper_squared"]], ["4/9", "4/9"]);
    assert_eq!(
        [&json["lower"], &json["upper"]],
        ["0.66666666666666666", "0.66666666666666667"]
    );
    let checked = run(["check", text(&path), "--curve", CIRCLE]).expect(0).out;
    assert!(
        checked.contains("the greatest curvature is between 0.666666 and 0.666667"),
        "{checked}"
    );
    let checked = run(["check", text(&path), "--json"]).expect(0).json();
    assert_eq!(checked["statement"]["claim"], "curvature");
    assert_eq!(checked["statement"]["upper_squared"], "4/9");
}

#[test]
fn parameters_are_those_of_the_curve() {
    let json = run(["certify", "curvature", "certs/curves/mp06-figure-1.json", "--json"])
        .expect(0)
        .json();
    assert_eq!(json["at"], "3/5");
    let out = run(["certify", "curvature", "certs/curves/square.json"]).expect(0).out;
    assert!(
        out.contains("exactly 0") && out.contains("corners, which do not count: 4"),
        "{out}"
    );
}

#[test]
fn a_cusp_is_undecided_and_named() {
    let out = run(["certify", "curvature", "certs/curves/cusp.json"]).expect(3).out;
    assert!(
        out.contains("undecided") && out.contains("at the parameter 1/2"),
        "{out}"
    );
    let json = run(["certify", "thickness", "certs/curves/coincident-ends.json", "--json"])
        .expect(3)
        .json();
    let reason = json["reason"].as_str().expect("a reason");
    assert!(
        reason.contains("unbounded") && reason.contains("the parameter 0"),
        "{json}"
    );
}

#[test]
fn thickness_in_both_forms() {
    let directory = TempDir::new().expect("a directory");
    for name in ["t.json", "t.bin"] {
        let path = directory.path().join(name);
        let json = run(["certify", "thickness", ELLIPSE, "--json", "-o", text(&path)])
            .expect(0)
            .json();
        assert_eq!([&json["lower_squared"], &json["upper_squared"]], ["1/9", "1/9"]);
        assert_eq!(json["convention"], "smooth");
        assert!(json["leaves"].as_u64().is_some_and(|leaves| leaves > 0), "{json}");
        let checked = run(["check", text(&path), "--curve", ELLIPSE]).expect(0).out;
        assert!(
            checked.contains("the thickness is between 0.333333 and 0.333334 (smooth"),
            "{checked}"
        );
        run(["check", text(&path), "--curve", PARABOLA]).expect(1);
    }
}

#[test]
fn the_reach_of_open_curves() {
    run(["certify", "thickness", PARABOLA]).expect_error(&["parabola.json", "open", "\"critical\""]);
    let out = run(["certify", "thickness", PARABOLA, "--convention", "critical"])
        .expect(0)
        .out;
    assert!(out.contains("the reach is exactly 0.5"), "{out}");
    let segment = "certs/curves/segment.json";
    let json = run(["certify", "thickness", segment, "--convention", "critical", "--json"])
        .expect(0)
        .json();
    assert_eq!([&json["lower"], &json["upper"]], [&json!("inf"), &Value::Null]);
}

#[test]
fn corners_make_the_thickness_0() {
    let json = run(["certify", "thickness", "certs/curves/square.json", "--json"])
        .expect(0)
        .json();
    assert_eq!([&json["upper"], &json["corner"]], ["0", "0"]);
}

#[test]
fn wrong_widths_are_refused() {
    for claim in ["curvature", "thickness"] {
        for width in ["0", "-1", "1/2", "x"] {
            let refused = run(["certify", claim, CIRCLE, "--rel-width", width]);
            assert_eq!((refused.code, refused.out.as_str()), (2, ""), "{refused:?}");
        }
    }
}
