//! `knotproof certify domain`: results, certificates, wrong usage.

use knotproof::number::{Meaning, Rational, parse_number};
use serde_json::Value;
use tempfile::TempDir;

use super::run::{Run, run, text};

const CUBIC: &str = "certs/curves/domain-cubic.json";
const QUINTIC: &str = "certs/curves/domain-quintic-many-vertices.json";
const SPATIAL: &str = "certs/curves/domain-quintic-spatial.json";
const EMPTY: &str = "certs/curves/domain-quintic-empty.json";

fn domain(curve: &str, options: &[&str]) -> Run {
    run([&["certify", "domain", curve], options].concat())
}

fn number(value: &Value) -> Rational {
    parse_number(value.as_str().expect("a text"), Meaning::Decimal).expect("a number")
}

fn fraction(text: &str) -> Rational {
    parse_number(text, Meaning::Decimal).expect("a number")
}

#[test]
fn the_sandwich_is_written_and_accepted_by_check() {
    let folder = TempDir::new().expect("a folder");
    for (curve, point, name) in [(CUBIC, "1", "area"), (SPATIAL, "2", "volume")] {
        for file in ["d.json", "d.bin"] {
            let certificate = folder.path().join(file);
            let options = [
                "--point",
                point,
                "--box",
                "20",
                "--tol",
                "1e-3",
                "-o",
                text(&certificate),
            ];
            let told = domain(curve, &options).expect(0).out;
            for part in [
                "certified: convex domain",
                name,
                "inner polytope",
                "outer polytope",
                "accepted by the checker",
            ] {
                assert!(told.contains(part), "{part:?} is not in {told}");
            }
            let checked = run(["check", text(&certificate), "--curve", curve]).expect(0).out;
            assert!(checked.starts_with("accepted: ") && checked.contains(name), "{checked}");
            let json = run(["check", "--json", text(&certificate)]).expect(0).json();
            assert_eq!(json["statement"]["claim"], "domain");
            assert_eq!(json["statement"]["outcome"], "sandwich");
        }
        let json = domain(curve, &["--point", point, "--box", "20", "--tol", "1e-3", "--json"])
            .expect(0)
            .json();
        assert_eq!(json["status"], "certified");
        let (inner, outer) = (number(&json["inner_measure"]), number(&json["outer_measure"]));
        assert!((&outer - &inner) / &inner <= number(&json["relative_error"]), "{json}");
        assert!(number(&json["relative_error"]) <= fraction("1e-3"), "{json}");
        assert!(
            number(&json[name][0]) <= inner && outer <= number(&json[name][1]),
            "{json}"
        );
        let levels = json["levels"].as_array().expect("a list");
        for level in levels {
            let [low, high] = [0, 1].map(|end| number(&level[name][end]));
            assert!(
                low <= high && number(&level["relative_error"]) >= fraction("0"),
                "{json}"
            );
        }
        assert!(
            number(&levels[levels.len() - 1]["relative_error"]) <= fraction("1e-3"),
            "{json}"
        );
        for field in ["level", "inequalities", "vertices", "facets"] {
            assert!(levels.iter().all(|level| level[field].is_u64()), "{json}");
        }
    }
}

#[test]
fn the_papers_levels_have_its_counts_and_columns() {
    let table = domain(
        CUBIC,
        &["--point", "1", "--box", "20", "--degree", "paper", "--level", "5"],
    )
    .expect(0)
    .out;
    for column in [
        "level",
        "inequalities",
        "vertices",
        "abs.error",
        "rel.error",
        "seconds",
        "first level",
    ] {
        assert!(table.contains(column), "{column:?} is not in {table}");
    }
    let json = domain(
        CUBIC,
        &[
            "--point",
            "1",
            "--box",
            "20",
            "--degree",
            "paper",
            "--level",
            "5",
            "--exact-measure",
            "--json",
        ],
    )
    .expect(0)
    .json();
    let levels = json["levels"].as_array().expect("a list");
    let counts: Vec<u64> = levels
        .iter()
        .filter_map(|level| level["inequalities"].as_u64())
        .collect();
    assert_eq!(counts, [4, 8, 16, 32, 64, 128]);
    assert!(levels[0]["relative_error"].is_null());
    for pair in levels.windows(2) {
        let [before, after] = [0, 1].map(|i| number(&pair[i]["exact_measure"]));
        assert!(
            number(&pair[1]["area"][0]) <= after && after <= number(&pair[1]["area"][1]),
            "{json}"
        );
        let error = (&after - &before) / before;
        let told = &pair[1]["relative_error"];
        assert!(number(&told[0]) <= error && error <= number(&told[1]), "{json}");
    }
    // Without --level the tolerance ends it.
    let json = domain(
        CUBIC,
        &[
            "--point", "1", "--box", "20", "--degree", "true", "--tol", "1e-2", "--json",
        ],
    )
    .expect(0)
    .json();
    let levels = json["levels"].as_array().expect("a list");
    let errors: Vec<bool> = levels
        .iter()
        .map(|level| level["relative_error"][1].is_string() && number(&level["relative_error"][1]) <= fraction("1e-2"))
        .collect();
    assert_eq!(
        errors.iter().position(|within| *within),
        Some(errors.len() - 1),
        "{json}"
    );
    // All levels empty, which proves nothing.
    let empty = domain(EMPTY, &["--point", "2", "--box", "40", "--sign", "+", "--level", "3"])
        .expect(3)
        .out;
    assert!(empty.contains("says nothing"), "{empty}");
}

#[test]
fn an_empty_domain_is_proved() {
    let folder = TempDir::new().expect("a folder");
    let certificate = folder.path().join("empty.json");
    let options = ["--point", "2", "--box", "40", "--sign", "+", "-o", text(&certificate)];
    let told = domain(EMPTY, &options).expect(0).out;
    assert!(
        told.contains("has no point in the box") && told.contains("3 inequalities that contradict each other"),
        "{told}"
    );
    assert!(
        run(["check", text(&certificate)])
            .expect(0)
            .out
            .contains("has no point in the box")
    );
    // Asked for its nearest point, it is empty all the same.
    let json = domain(
        EMPTY,
        &[
            "--point",
            "2",
            "--box",
            "40",
            "--sign",
            "+",
            "--nearest",
            "0,0",
            "--json",
        ],
    )
    .expect(0)
    .json();
    assert_eq!(json["outcome"], "empty");
}

#[test]
fn questions_are_answered_with_certificates() {
    let folder = TempDir::new().expect("a folder");
    for (question, value, outcome, words) in [
        ("--nearest", Some("9,-9"), "nearest", "at a distance between"),
        ("--fair", None, "nearest", "least ∫|c''|²"),
        ("--change", None, "change", "the shortest move"),
        ("--ball", None, "ball", "a radius between"),
    ] {
        let certificate = folder.path().join(format!("{outcome}.json"));
        let base = ["--point", "1", "--box", "20", question];
        let options: Vec<&str> = base.into_iter().chain(value).collect();
        let written = domain(CUBIC, &[&options[..], &["-o", text(&certificate)]].concat())
            .expect(0)
            .out;
        assert!(written.contains(words), "{written}");
        assert!(run(["check", text(&certificate)]).expect(0).out.contains(words));
        let json = domain(CUBIC, &[&options[..], &["--json"]].concat()).expect(0).json();
        assert_eq!(json["outcome"], outcome);
        assert!(number(&json["lower"]) <= number(&json["upper"]), "{json}");
        assert!(
            json["point"].is_array() || json["move"]["direction"].is_array(),
            "{json}"
        );
    }
}

#[test]
fn what_is_not_reached_is_undecided_and_says_what_is_known() {
    let few = [
        "--point", "2", "--box", "40", "--sign", "+", "--tol", "1e-9", "--budget", "10",
    ];
    let told = domain(QUINTIC, &few).expect(3).out;
    assert!(told.contains("undecided") && told.contains("proved so far"), "{told}");
    let json = domain(QUINTIC, &[&few[..], &["--json"]].concat()).expect(3).json();
    assert_eq!(json["status"], "undecided");
    assert!(number(&json["inner_measure"]) > fraction("0"), "{json}");
}

/// The box touches the closure of K along an edge, where the sign function vanishes only at the open start: nothing rational tells.
#[test]
fn a_domain_without_interior_in_the_box_is_undecided() {
    let folder = TempDir::new().expect("a folder");
    let curve = folder.path().join("flat.json");
    let text_of_curve = r#"{ "knotproof": "curve/1", "bezier": { "pieces": [
        { "points": [[0, 0], [1, 0], [2, 0], [3, 0], [4, 5]] } ] } }"#;
    std::fs::write(&curve, text_of_curve).expect("writes");
    let options = ["--point", "3", "--sign=+", "--box-from", "2,-2", "--box-to"];
    let told = domain(text(&curve), &[&options[..], &["4,0"]].concat()).expect(3).out;
    assert!(
        told.contains("undecided") && told.contains("nothing is proved"),
        "{told}"
    );
    // A little higher there is one; a box below is refused, because the control point is not in it.
    assert!(
        domain(text(&curve), &[&options[..], &["4,1/1000"]].concat())
            .expect(0)
            .out
            .contains("area")
    );
    let lower = [
        "--point",
        "3",
        "--sign=+",
        "--box-from",
        "2,-2",
        "--box-to",
        "4,-1/1000",
    ];
    domain(text(&curve), &lower).expect_error(&["does not contain the control point"]);
}

#[test]
fn wrong_questions_are_refused() {
    let refuse = |options: &[&str], parts: &[&str]| domain(CUBIC, options).expect_error(parts);
    refuse(
        &["--point", "4", "--box", "20"],
        &[CUBIC, "no control point 4", "0 to 3"],
    );
    refuse(&["--point", "1", "--box", "0"], &["the box is empty"]);
    refuse(&["--point", "1", "--box", "-2"], &["the box is empty"]);
    refuse(
        &["--point", "1", "--box-from", "1,1", "--box-to", "2,2"],
        &["does not contain the control point"],
    );
    refuse(
        &["--point", "1", "--box-from", "1", "--box-to", "2"],
        &["1 coordinates", "has 2"],
    );
    refuse(
        &["--point", "1", "--box", "20", "--interval", "1/2", "1/2"],
        &["interval", "0 to 1"],
    );
    refuse(
        &["--point", "1", "--box", "20", "--interval", "0", "3/2"],
        &["interval", "0 to 1"],
    );
    refuse(
        &["--point", "1", "--box", "20", "--nearest", "1,2,3"],
        &["3 coordinates", "has 2"],
    );
    for tolerance in ["0", "-1", "x"] {
        let run = domain(CUBIC, &["--point", "1", "--box", "20", "--tol", tolerance]);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{run:?}");
        assert!(run.err.contains("--tol"), "{run:?}");
    }
    for wrong in [
        &["--box", "20"][..],
        &["--point", "1"],
        &["--point", "-1", "--box", "20"],
        &["--point", "1", "--box", "20", "--sign", "0"],
        &["--point", "1", "--box", "20", "--fair", "--ball"],
        &["--point", "1", "--box", "20", "--level", "99"],
        &["--point", "1", "--box", "20", "--level", "2", "-o", "x.json"],
        &["--point", "1", "--box", "20", "--box-from", "1,1", "--box-to", "2,2"],
    ] {
        let run = domain(CUBIC, wrong);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{run:?}");
    }
    domain(QUINTIC, &["--point", "2", "--box", "20"]).expect_error(&["both signs"]);
    domain("certs/curves/square.json", &["--point", "1", "--box", "20"]).expect_error(&["degree 1", "curvature"]);
    domain(
        "certs/curves/domain-nurbs-arc.json",
        &["--point", "2", "--box", "20", "--degree", "paper"],
    )
    .expect_error(&["--degree paper", "rational"]);
    domain(
        "certs/curves/domain-nurbs-arc.json",
        &["--point", "2", "--box", "20", "--fair"],
    )
    .expect_error(&["polynomial pieces"]);
}
