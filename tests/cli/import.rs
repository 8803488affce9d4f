//! `knotproof import`, and other formats given to other commands.

use std::fs;

use super::run::{run, run_with_input};

const DRAWING: &str = "tests/import/drawing.svg";

#[test]
fn lists_the_curves_of_a_file() {
    let listed = run(["import", DRAWING]).expect(0).out;
    for line in [
        "tests/import/drawing.svg: SVG",
        "0: wave: open, 2 pieces, degree 3, 2 coordinates",
        "3: ring: closed, 4 pieces, degree 2, rational, 2 coordinates",
        "5: slanted: open, 1 piece, degree 2, rational, 2 coordinates; 1 arc approximated, distance at most",
        "subpaths without length left out: 1",
    ] {
        assert!(listed.contains(line), "{line:?} is not in {listed}");
    }
    let json = run(["import", DRAWING, "--json", "--select", "two", "--select", "0"])
        .expect(0)
        .json();
    assert_eq!(json["format"], "svg");
    let names: Vec<&str> = json["curves"]
        .as_array()
        .unwrap()
        .iter()
        .map(|c| c["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["two/0", "two/1", "wave"]);
    assert_eq!(run(["import", DRAWING, "--quiet"]).expect(0).out, "");
}

#[test]
fn writes_curve_files() {
    let folder = tempfile::tempdir().unwrap();
    let one = folder.path().join("ring.json");
    run(["import", DRAWING, "--select", "ring", "-o", one.to_str().unwrap()]).expect(0);
    let written = fs::read_to_string(&one).unwrap();
    assert!(written.contains("\"name\":\"ring\""), "{written}");
    // The curve file goes where other curve files go.
    run(["certify", "embedding", one.to_str().unwrap()]).expect(0);
    let piped = run(["import", DRAWING, "--select", "ring", "-o", "-"]).expect(0).out;
    assert_eq!(piped, written);
    run_with_input(["certify", "embedding", "-"], piped.as_bytes()).expect(0);
    let many = folder.path().join("all");
    fs::create_dir(&many).unwrap();
    let all = run(["import", DRAWING, "--json", "-o", many.to_str().unwrap()])
        .expect(0)
        .json();
    let files = all["curves"].as_array().unwrap();
    assert_eq!(files.len(), fs::read_dir(&many).unwrap().count());
    assert!(files[1]["file"].as_str().unwrap().ends_with("0001-two-0.json"));
    run(["import", DRAWING, "-o", one.to_str().unwrap()]).expect_error(&["found 7 curves", "directory", "--select"]);
    run(["import", DRAWING, "-o", "-"]).expect_error(&["found 7 curves", "--select"]);
}

#[test]
fn certifies_other_formats_directly() {
    let folder = tempfile::tempdir().unwrap();
    let certificate = folder.path().join("ring.cert.json");
    let certificate = certificate.to_str().unwrap();
    run(["certify", "embedding", DRAWING, "--select", "ring", "-o", certificate]).expect(0);
    run(["check", certificate, "--curve", DRAWING, "--select", "ring"]).expect(0);
    let other = run(["check", certificate, "--curve", DRAWING, "--select", "wave"]);
    assert_eq!(other.code, 1, "{other:?}");
    for (file, select) in [
        ("tests/import/curve.geomdl.json", None),
        ("tests/import/square.vect", Some("0")),
        ("tests/import/curves.step", Some("seam")),
        ("tests/import/curves.igs", Some("#3")),
        ("tests/import/letters.ttf", Some("D")),
        ("tests/import/letters.otf", Some("D")),
    ] {
        let mut arguments = vec!["certify", "embedding", file];
        arguments.extend(select.iter().flat_map(|select| ["--select", *select]));
        run(arguments).expect(0);
    }
    run(["certify", "msd", DRAWING]).expect_error(&["drawing.svg: found 7 curves (wave, two/0,", "--select"]);
    run(["certify", "msd", DRAWING, "--select", "nothing"])
        .expect_error(&["found no curve \"nothing\" among 7 curves"]);
    run(["certify", "msd", DRAWING, "--select", "slanted", "--exact"]).expect_error(&["line 11", "rotation"]);
}

#[test]
fn what_reading_changed_is_told_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let certificate = folder.path().join("slanted.cert.json");
    let path = certificate.to_str().unwrap();
    let told = run(["certify", "embedding", DRAWING, "--select", "slanted", "-o", path]);
    assert_eq!(told.code, 0, "{told:?}");
    let note = "note: tests/import/drawing.svg: 1 arc approximated, distance at most ";
    assert!(told.err.starts_with(note), "{told:?}");
    let kept = fs::read_to_string(&certificate).unwrap();
    assert!(
        kept.contains("slanted [1 arc approximated, distance at most "),
        "{kept}"
    );
    let quiet = run(["certify", "embedding", DRAWING, "--select", "slanted", "--quiet"]);
    assert_eq!((quiet.code, quiet.err.as_str()), (0, ""));
    // A miss is told, but nothing was changed.
    let missed = run(["certify", "embedding", DRAWING, "--select", "almost", "-o", path]);
    let note = "the end misses the start by 0.1, as rounding may; --weld moves it there";
    assert!(missed.err.contains(note), "{missed:?}");
    assert!(!fs::read_to_string(&certificate).unwrap().contains("misses"));
    let welded = run(["certify", "embedding", DRAWING, "--select", "almost", "--weld"]);
    assert!(!welded.err.contains("misses"), "{welded:?}");
    assert!(
        welded.err.contains("end welded to the start, moved by 0.1"),
        "{welded:?}"
    );
}

#[test]
fn unusable_files() {
    run(["import", "tests/import/nothing.svg"]).expect_error(&["nothing.svg"]);
    run_with_input(["import", "-"], b"hello").expect_error(&["standard input", "expected one of"]);
    run_with_input(["import", "-"], b"<svg/>").expect_error(&["found no curve in the SVG file"]);
    run_with_input(["import", "-", "--format", "step"], b"<svg/>").expect_error(&["line 1 column 1", "ISO-10303-21"]);
    let same = run(["import", DRAWING, "--select", "ring", "-o", DRAWING]);
    same.expect_error(&["would replace the file"]);
}
