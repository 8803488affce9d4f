//! `knotproof show`.

use std::fs;

use tempfile::TempDir;

use super::run::{run, text};

const MP06: &str = "certs/accept/proved/mp06-figure-1-smooth.json";

#[test]
fn drawings_and_reports_are_whole_and_the_same_each_time() {
    let folder = TempDir::new().expect("a folder");
    let (svg, html) = (folder.path().join("a.svg"), folder.path().join("a.html"));
    let told = run(["show", MP06, "-o", text(&svg)]).expect(0).out;
    assert!(told.contains("a.svg: "), "{told}");
    let drawing = fs::read_to_string(&svg).unwrap();
    assert_eq!(
        drawing,
        run(["show", MP06]).expect(0).out,
        "standard output has the same drawing"
    );
    for part in [
        "<svg ",
        "x to the right, y up",
        "y to the right, z up",
        "shortest double normal",
        "lower_squared = ",
        "0.44267517037",
        "prefers-color-scheme: dark",
    ] {
        assert!(drawing.contains(part), "{part:?} is not in the drawing");
    }
    let one = run(["show", MP06, "--view", "1,-2,1", "--title", "A & B"])
        .expect(0)
        .out;
    assert!(
        one.contains("A &amp; B") && one.contains("seen from (0.41, -0.82, 0.41)"),
        "{one}"
    );

    let line = run(["show", MP06, "-o", text(&html), "--json"]).expect(0).json();
    let report = fs::read_to_string(&html).unwrap();
    assert_eq!(line["bytes"], report.len());
    assert!(report.len() < 1_500_000, "{}", report.len());
    for part in ["<canvas", "Proved: ", "id=\"data\"", "WebAssembly.instantiate"] {
        assert!(report.contains(part), "{part:?} is not in the report");
    }
}

#[test]
fn every_claim_and_bare_curves_are_drawn() {
    for (file, part) in [
        ("certs/curves/nurbs-circle.json", "curve, 4 pieces"),
        (
            "certs/accept/proved/mp06-figure-1-embedding.json",
            "isotopic polygon, 10 edges",
        ),
        (
            "certs/accept/proved/domain-cubic.json",
            "every position inside keeps the sign",
        ),
        (
            "certs/accept/proved/domain-quintic-spatial.cert",
            "no position outside keeps the sign",
        ),
        ("certs/accept/proved/domain-cubic-ball.json", "ball of radius"),
        ("certs/accept/curvature/circle.json", "greatest curvature known"),
        ("certs/accept/thickness/circle.json", "pipe of radius"),
        ("certs/accept/thickness/corner.json", "corner at joint"),
        ("certs/accept/deviation/rational.json", "control polygon after"),
        ("certs/accept/proved/figure-eight-smooth.json", "the curve meets itself"),
    ] {
        let drawing = run(["show", file]).expect(0).out;
        assert!(drawing.contains(part), "{part:?} is not in the drawing of {file}");
        assert!(!drawing.contains("NaN") && !drawing.contains("inf\""), "{file}");
    }
}

#[test]
fn what_is_rejected_is_not_drawn() {
    let folder = TempDir::new().expect("a folder");
    let (bad, picture) = (folder.path().join("bad.json"), folder.path().join("bad.svg"));
    let certificate = fs::read_to_string(MP06).unwrap();
    fs::write(&bad, certificate.replacen("\"cone ", "\"cone 7", 1)).unwrap();
    let told = run(["show", text(&bad), "-o", text(&picture)]).expect(1).out;
    assert!(
        told.contains("rejected: ") && told.contains("nothing is drawn"),
        "{told}"
    );
    assert!(!picture.exists());
}

#[test]
fn wrong_usage() {
    run(["show", MP06, "-o", "picture.png"]).expect_error(&["picture.png", ".svg or .html"]);
    run(["show", MP06, "--json"]).expect_error(&["-o"]);
    run(["show", "nowhere.json"]).expect_error(&["nowhere.json"]);
    let wrong = run(["show", MP06, "--view", "up"]);
    assert!(
        wrong.code == 2 && wrong.err.contains("direction towards the eye"),
        "{wrong:?}"
    );
    let folder = TempDir::new().expect("a folder");
    let own = folder.path().join("own.svg");
    fs::copy(MP06, &own).unwrap();
    run(["show", text(&own), "-o", text(&own)]).expect_error(&["would replace"]);
    let curve = folder.path().join("curve.json");
    fs::write(&curve, "{ \"knotproof\": \"curve/1\", \"bezier\": { \"pieces\": [] } }").unwrap();
    run(["show", text(&curve)]).expect_error(&["curve.json", "pieces"]);
}

#[test]
#[cfg(feature = "import")]
fn a_drawing_stands_as_in_its_file() {
    run(["show", "tests/import/drawing.svg"]).expect_error(&["drawing.svg", "--select"]);
    let picture = run(["show", "tests/import/drawing.svg", "--select", "0"]).expect(0).out;
    assert!(picture.contains("x to the right, y down"), "{picture}");
    let upward = run(["show", "tests/import/drawing.svg", "--select", "0", "--view", "xy"])
        .expect(0)
        .out;
    assert!(upward.contains("x to the right, y up"), "{upward}");
    let turned = run(["show", "certs/curves/square.json", "--view", "x-y"]).expect(0).out;
    assert!(turned.contains("x to the right, y down"), "{turned}");
}
