//! `knotproof certify deviation`.

use tempfile::TempDir;

use super::run::{run, text};

#[test]
fn the_distance_and_the_bound_are_told_and_the_certificate_is_accepted() {
    let folder = TempDir::new().expect("a folder");
    let certificate = folder.path().join("deviation.json");
    let mp06 = "certs/curves/mp06-figure-1.json";
    let told = run([
        "certify",
        "deviation",
        mp06,
        "--subdivisions",
        "6",
        "-o",
        text(&certificate),
    ])
    .expect(0)
    .out;
    for part in [
        "certified: deviation",
        "is between",
        "960 edges",
        "Nairn, Peters, Lutterkort",
        "accepted by the checker",
    ] {
        assert!(told.contains(part), "{part:?} is not in {told}");
    }
    assert!(
        run(["check", text(&certificate), "--curve", mp06])
            .expect(0)
            .out
            .contains("control polygon after 6 subdivisions")
    );
    let json = run(["certify", "deviation", "certs/curves/parabola.json", "--json"])
        .expect(0)
        .json();
    assert_eq!(json["status"], "certified");
    assert_eq!(json["lower_squared"], "1");
    assert_eq!(json["upper_squared"], "1");
    assert_eq!(json["bound_squared"], "1");
    assert_eq!(json["edges"], 2);
    let rational = run(["certify", "deviation", "certs/curves/nurbs-circle.json", "--json"])
        .expect(0)
        .json();
    assert!(
        rational["bound"].is_null() && rational["upper"].is_string(),
        "{rational}"
    );
}

#[test]
fn wrong_usage() {
    for wrong in [
        &["--subdivisions", "17"][..],
        &["--subdivisions", "-1"],
        &["--rel-width", "2"],
    ] {
        let run = run([&["certify", "deviation", "certs/curves/parabola.json"], wrong].concat());
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{run:?}");
    }
}
