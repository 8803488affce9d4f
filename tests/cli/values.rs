//! `knotproof certify values`.

use tempfile::TempDir;

use super::run::{run, text};

const CIRCLE: &str = "certs/curves/nurbs-circle.json";

#[test]
fn results_are_told_and_the_certificate_is_accepted() {
    let folder = TempDir::new().expect("a folder");
    for name in ["values.json", "values.bin"] {
        let certificate = folder.path().join(name);
        let told = run([
            "certify",
            "values",
            CIRCLE,
            "--samples",
            "1",
            "--target",
            "-3,0",
            "-o",
            text(&certificate),
        ])
        .expect(0)
        .out;
        for part in [
            "certified: results of operations on",
            " point, ",
            "1 decompose",
            "the distance to (-3, 0) is exactly 2",
            "accepted by the checker",
        ] {
            assert!(told.contains(part), "{part:?} is not in {told}");
        }
        let checked = run(["check", text(&certificate), "--curve", CIRCLE]).expect(0).out;
        assert!(checked.contains("exact results of operations: "), "{checked}");
        let json = run(["check", "--json", text(&certificate)]).expect(0).json();
        assert_eq!(json["statement"]["claim"], "values");
        assert_eq!(json["statement"]["operations"][0]["operation"], "point");
        assert_eq!(json["statement"]["distances"][0]["upper"], "2");
    }
}

#[test]
fn operations_that_were_asked_for() {
    let json = run([
        "certify",
        "values",
        CIRCLE,
        "--ops",
        "curvature,point",
        "--samples",
        "0",
        "--json",
    ])
    .expect(0)
    .json();
    let names: Vec<&str> = json["operations"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|line| line["operation"].as_str())
        .collect();
    assert_eq!(names, ["point", "curvature"]);
    assert_eq!(json["status"], "certified");
    let parabola = run([
        "certify",
        "values",
        "certs/curves/parabola.json",
        "--ops",
        "remove_knot",
    ])
    .expect(0)
    .out;
    assert!(
        parabola.contains("no remove_knot: no knot can be removed"),
        "{parabola}"
    );
}

#[test]
fn distances_of_curves() {
    let json = run([
        "certify",
        "values",
        "certs/curves/parabola.json",
        "--ops",
        "curve_distance",
        "--other",
        "certs/curves/segment.json",
        "--json",
    ])
    .expect(0)
    .json();
    assert_eq!(json["distances"][0]["upper_squared"], "0");
    // Every point is nearest: the tree grows too large for the width asked for.
    let circles = run([
        "certify",
        "values",
        CIRCLE,
        "--ops",
        "curve_distance",
        "--other",
        "certs/curves/nurbs-circle-radius-3-2.json",
        "--quiet",
    ]);
    assert_eq!((circles.code, circles.out.as_str()), (3, ""), "{circles:?}");
}

#[test]
fn wrong_usage() {
    for wrong in [
        &["--ops", "points"][..],
        &["--ops", "torsion"],
        &["--ops", "nearest_point"],
        &["--ops", "curve_distance"],
        &["--target", "1"],
        &["--target", "1,2,3"],
        &["--target", "1,x"],
        &["--samples", "-1"],
        &["--samples", "1024", "--other", "no-such-file.json"],
        &["--other", "certs/curves/trefoil-24.json"],
        &["--rel-width", "0"],
    ] {
        let run = run([&["certify", "values", CIRCLE], wrong].concat());
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{run:?}");
    }
    run(["certify", "values", "certs/curves/figure-eight.json", "--ops", "split"]).expect_error(&[
        "figure-eight.json",
        "operation split",
        "several Bézier pieces",
    ]);
}
