//! `knotproof certify msd`: wrong usage and unusable files.

use std::fs;

use tempfile::TempDir;

use super::run::{run, text};

const SQUARE: &str = "certs/curves/square.json";
const MP06: &str = "certs/curves/mp06-figure-1.json";

#[track_caller]
fn refuse(arguments: &[&str], parts: &[&str]) {
    run([&["certify", "msd"], arguments].concat()).expect_error(parts);
}

#[test]
fn widths_out_of_range() {
    for width in [
        "0",
        "-1",
        "-1e-12",
        "1",
        "0.5",
        "0.1000000001",
        "1e-31",
        "0.999e-30",
        "1/9",
    ] {
        refuse(
            &[SQUARE, "--rel-width", width],
            &["--rel-width", width, "from 1e-30 to 1e-1"],
        );
    }
    for width in ["", "tenth", "1e", "nan", "1 e-3", "1/0"] {
        refuse(&[SQUARE, "--rel-width", width], &["--rel-width"]);
    }
    for width in ["0.1", "1/10", "1e-30", "0x1p-20"] {
        run(["certify", "msd", MP06, "--rel-width", width]).expect(0);
    }
}

#[test]
fn other_options_out_of_range() {
    refuse(&[SQUARE, "--budget", "0"], &["--budget"]);
    refuse(&[SQUARE, "--budget", "-1"], &["-1"]);
    refuse(&[SQUARE, "--budget", "1.5"], &["--budget"]);
    refuse(&[SQUARE, "--threads", "0"], &["--threads", "1..=1024"]);
    refuse(&[SQUARE, "--threads", "9999"], &["--threads", "1..=1024"]);
    refuse(
        &[SQUARE, "--convention", "rough"],
        &["--convention", "smooth", "critical"],
    );
    refuse(&[SQUARE, "--format", "binary"], &["--output"]);
    refuse(
        &[SQUARE, "--format", "yaml", "-o", "x"],
        &["--format", "json", "binary"],
    );
    refuse(&[], &["<CURVE>"]);
    run(["certify", "length", SQUARE]).expect_error(&["unrecognized subcommand 'length'"]);
}

#[test]
fn curve_files_that_are_none() {
    refuse(&["absent.json"], &["absent.json: cannot be read"]);
    let directory = TempDir::new().expect("a directory");
    refuse(&[text(directory.path())], &["found no file with curves"]);
    let path = directory.path().join("curve.json");
    let cases: [(&[u8], &str); 7] = [
        (b"", "JSON"),
        (b"{ \"knotproof\": \"curve/1\", ", "JSON"),
        (b"\xff", "UTF-8"),
        (br#"{ "knotproof": "curve/9" }"#, "expected \"curve/1\""),
        (
            br#"{ "knotproof": "certificate/1" }"#,
            "found version \"certificate/1\"",
        ),
        (br#"{ "knotproof": "curve/1", "colour": 3 }"#, "colour"),
        (
            br#"{ "knotproof": "curve/1", "bezier": { "pieces": [ { "points": [[0, 0], [1, "one"]] } ] } }"#,
            "bezier.pieces[0].points[1][1]: \"one\" is not a number",
        ),
    ];
    for (bytes, part) in cases {
        fs::write(&path, bytes).expect("a file");
        refuse(&[text(&path)], &[text(&path), part]);
    }
}

#[test]
fn places_that_take_no_certificate() {
    let directory = TempDir::new().expect("a directory");
    let absent = directory.path().join("absent").join("cert.json");
    refuse(
        &[SQUARE, "-o", text(&absent)],
        &[text(&absent), "there is no directory"],
    );
    refuse(&[SQUARE, "-o", "-"], &["-o", "name a file"]);
    #[cfg(unix)]
    refuse(&[SQUARE, "-o", "/dev/null"], &["/dev/null", "not a regular file"]);
    let curve = directory.path().join("curve.json");
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/certs/curves/square.json"), &curve).expect("a copy");
    let before = fs::read(&curve).expect("the curve");
    refuse(&[text(&curve), "-o", text(&curve)], &["would replace the curve file"]);
    let roundabout = directory.path().join(".").join("curve.json");
    refuse(
        &[text(&curve), "-o", text(&roundabout)],
        &["would replace the curve file"],
    );
    assert_eq!(fs::read(&curve).expect("the curve"), before);
}
