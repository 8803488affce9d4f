//! `knotproof certify embedding`: results, certificates, exit codes.

use serde_json::Value;

use super::run::{names, run, text};

const MP06: &str = "certs/curves/mp06-figure-1.json";
const EIGHT: &str = "certs/curves/figure-eight.json";

#[test]
fn an_embedded_curve() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path().join("embedding.json");
    let json = run(["certify", "embedding", MP06, "--json", "-o", text(&path)])
        .expect(0)
        .json();
    assert_eq!(
        (&json["status"], &json["claim"]),
        (&"certified".into(), &"embedding".into())
    );
    assert!(
        json["edges"].as_u64().is_some_and(|edges| (6..=40).contains(&edges)),
        "{json}"
    );
    // Cubic pieces, cells within them.
    assert_eq!(
        json["control_polygon_edges"].as_u64(),
        json["edges"].as_u64().map(|edges| 3 * edges)
    );
    for field in ["perturbation_radius", "perturbation_radius_euclidean"] {
        let radius: f64 = json[field]
            .as_str()
            .and_then(|text| text.parse().ok())
            .expect("a decimal");
        // σ of this curve is 0.4426…; to move by more than half of it should not be safe.
        assert!(radius > 0.0 && radius < 0.222, "{json}");
    }
    let checked = run(["check", "--json", "--curve", MP06, text(&path)]).expect(0).json();
    assert_eq!(checked["verdict"], "accepted");
    for field in ["edges", "perturbation_radius", "perturbation_radius_euclidean"] {
        assert_eq!(checked["statement"][field], json[field]);
    }
    assert_eq!(checked["leaves"], json["leaves"]);
    let words = run(["check", text(&path)]).expect(0).out;
    assert!(words.contains("the curve is embedded"), "{words}");
}

#[test]
fn both_forms_and_any_number_of_threads() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = |name: &str| directory.path().join(name);
    for threads in ["1", "2"] {
        let file = path(&format!("{threads}.bin"));
        run([
            "certify",
            "embedding",
            MP06,
            "-q",
            "--threads",
            threads,
            "-o",
            text(&file),
        ])
        .expect(0);
    }
    let read = |name: &str| std::fs::read(path(name)).expect("written");
    assert_eq!(read("1.bin"), read("2.bin"));
    assert!(read("1.bin").starts_with(b"KNOTCRT1"));
}

#[test]
fn a_curve_that_meets_itself_is_refuted_with_a_certificate() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path().join("eight.json");
    let json = run(["certify", "embedding", EIGHT, "--json", "-o", text(&path)])
        .expect(1)
        .json();
    assert_eq!(json["status"], "refuted");
    assert_eq!((&json["at"][0], &json["at"][1]), (&"1/2".into(), &"5/2".into()));
    assert_eq!(json["rule"], "touch");
    let checked = run(["check", "--json", text(&path)]).expect(0).json();
    assert_eq!(checked["statement"]["claim"], "msd");
    assert_eq!(checked["statement"]["upper_squared"], "0");
    let words = run(["certify", "embedding", EIGHT]).expect(1).out;
    assert!(words.starts_with("refuted: the curve is not embedded"), "{words}");
}

#[test]
fn undecided_writes_nothing() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path().join("none.json");
    let json = run([
        "certify",
        "embedding",
        MP06,
        "--json",
        "--budget",
        "3",
        "-o",
        text(&path),
    ])
    .expect(3)
    .json();
    assert_eq!(
        (&json["status"], &json["certificate"]),
        (&"undecided".into(), &Value::Null)
    );
    assert!(
        json["reason"]
            .as_str()
            .is_some_and(|why| why.contains("budget of 3 leaves")),
        "{json}"
    );
    assert_eq!(names(directory.path()), Vec::<String>::new());
    let words = run(["certify", "embedding", "certs/curves/cusp.json"]).expect(3).out;
    assert!(words.contains("parameter 0.5"), "{words}");
}

#[test]
fn help_tells_the_options() {
    let help = run(["certify", "embedding", "--help"]).expect(0).out;
    for option in [
        "--budget",
        "--threads",
        "--output",
        "--format",
        "--snap-joints",
        "--json",
        "exit code is 1",
    ] {
        assert!(help.contains(option), "{option:?} is not in {help}");
    }
}
