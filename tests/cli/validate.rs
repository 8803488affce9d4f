//! `knotproof cases` and `knotproof validate`.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use super::run::{run, run_with_input, text};

/// Two cases about the parabola (0,0), (1,2), (2,0).
const CASES: &str = r#"{"knotproof":"cases/1","cases":[
{"id":"middle","operation":"point","parameter":0.5,"curve":{"degree":2,"knots":[0,0,0,1,1,1],"points":[[0,0],[1,2],[2,0]]}},
{"id":"start","operation":"derivative","parameter":0,"order":1,"side":"right","curve":{"degree":2,"knots":[0,0,0,1,1,1],"points":[[0,0],[1,2],[2,0]]}}
]}"#;

fn results(middle: Value, start: Value) -> String {
    let mut entries = [middle, start];
    for (entry, id) in entries.iter_mut().zip(["middle", "start"]) {
        entry["id"] = json!(id);
    }
    json!({ "knotproof": "results/1", "engine": "mine 1.0", "results": entries }).to_string()
}

fn ok(field: &str, value: Value) -> Value {
    json!({ "status": "ok", field: value })
}

fn right() -> String {
    results(ok("point", json!([1, 1])), ok("vector", json!([2, "0x1p2"])))
}

fn wrong() -> String {
    results(ok("point", json!([1, 1.5])), ok("vector", json!([2, 4])))
}

/// A folder with the cases and a file of results.
fn folder(results: &str) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("cases.json"), CASES).expect("written");
    fs::write(folder.path().join("results.json"), results).expect("written");
    folder
}

fn arguments<'a>(folder: &'a Path, more: &[&'a str]) -> Vec<String> {
    let path = |name: &str| text(&folder.join(name)).to_string();
    let mut all = vec![
        "validate".into(),
        path("results.json"),
        "--cases".into(),
        path("cases.json"),
    ];
    all.extend(more.iter().map(|text| text.to_string()));
    all
}

#[test]
fn right_answers_pass_and_wrong_ones_fail() {
    let good = folder(&right());
    let told = run(arguments(good.path(), &[])).expect(0).out;
    assert!(told.starts_with("passed: mine 1.0\n"), "{told}");
    let bad = folder(&wrong());
    let told = run(arguments(bad.path(), &[])).expect(1).out;
    assert!(told.starts_with("failed: mine 1.0\n"), "{told}");
    assert!(
        told.contains("middle: wrong: found (1, 1.5), expected (1, 1)"),
        "{told}"
    );
    assert_eq!(run(arguments(bad.path(), &["--quiet"])).expect(1).out, "");
    let json = run(arguments(bad.path(), &["--json"])).expect(1).json();
    assert_eq!(json["outcome"], "failed");
    assert_eq!(json["findings"][0]["id"], "middle");
    assert_eq!(json["operations"][1]["right"], 1);
    // A tolerance that a team has checked in.
    let tolerances = bad.path().join("tolerances.json");
    fs::write(&tolerances, r#"{"knotproof":"tolerances/1","ulps":{"point":1e16}}"#).expect("written");
    run(arguments(bad.path(), &["--tolerances", text(&tolerances)])).expect(0);
}

#[test]
fn reports_for_machines() {
    let bad = folder(&wrong());
    let (junit, sarif) = (bad.path().join("report.xml"), bad.path().join("report.sarif"));
    let more = ["--junit", text(&junit), "--sarif", text(&sarif), "--format", "github"];
    let told = run(arguments(bad.path(), &more)).expect(1).out;
    assert!(told.starts_with("::error file="), "{told}");
    assert!(
        told.contains("title=mine 1.0%3A point middle::found (1, 1.5)"),
        "{told}"
    );
    assert_eq!(told.lines().count(), 1);
    let junit = fs::read_to_string(junit).expect("a report");
    for part in [
        "<testsuites",
        "tests=\"2\"",
        "failures=\"1\"",
        "<failure",
        "type=\"other value\"",
        "expected (1, 1)",
    ] {
        assert!(junit.contains(part), "{part:?} is not in {junit}");
    }
    let sarif: Value = serde_json::from_str(&fs::read_to_string(sarif).expect("a report")).expect("JSON");
    assert_eq!(sarif["version"], "2.1.0");
    let found = sarif["runs"][0]["results"].as_array().expect("a list");
    assert_eq!(found.len(), 1);
    assert_eq!(found[0]["ruleId"], "other-value");
    let rules = sarif["runs"][0]["tool"]["driver"]["rules"].as_array().expect("a list");
    assert!(rules.iter().any(|rule| rule["id"] == "other-value"));
    assert!(found[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].is_string());
}

#[test]
fn what_is_not_an_answer_never_passes() {
    // A number that is not finite is wrong, not malformed.
    let nan = folder(&results(ok("point", json!([1, "NaN"])), ok("vector", json!([2, 4]))));
    assert!(run(arguments(nan.path(), &[])).expect(1).out.contains("NaN"));
    // Refusals alone are no pass.
    let refused = folder(&results(
        json!({"status": "refused", "message": "no"}),
        json!({"status": "not_offered"}),
    ));
    let told = run(arguments(refused.path(), &[])).expect(3).out;
    assert!(told.starts_with("nothing judged"), "{told}");
    // A case without an answer is a finding.
    let mut missing: Value = serde_json::from_str(&right()).expect("JSON");
    missing["results"].as_array_mut().expect("a list").pop();
    let told = run(arguments(folder(&missing.to_string()).path(), &[])).expect(1).out;
    assert!(told.contains("start: no answer in the results"), "{told}");
}

#[test]
fn unusable_results_are_errors() {
    for (results, parts) in [
        (
            r#"{"knotproof":"results/1","engine":"mine","results":[]}"#.to_string(),
            ["results.json: results", "empty list"],
        ),
        (String::new(), ["results.json", "EOF"]),
        (
            right().replace("\"start\"", "\"middle\""),
            ["results[1].id", "each id once"],
        ),
        (
            right().replace("\"start\"", "\"other\""),
            ["results[1].id", "\"other\""],
        ),
        (right().replace("0x1p2", "four"), ["results[1].vector[1]", "four"]),
        (right().replace("results/1", "results/9"), ["knotproof", "results/9"]),
        (right().replace("[1,1]", "NaN"), ["results[0].point", "results.json"]),
    ] {
        run(arguments(folder(&results).path(), &[])).expect_error(&parts);
    }
    let good = folder(&right());
    run(["validate", text(&good.path().join("results.json"))]).expect_error(&["--cases"]);
    run(["validate", "-", "--cases", "-"]).expect_error(&["only once"]);
    run([
        "validate",
        "nowhere.json",
        "--cases",
        text(&good.path().join("cases.json")),
    ])
    .expect_error(&["nowhere.json"]);
    let cases = text(&good.path().join("cases.json")).to_string();
    run_with_input(["validate", "-", "--cases", cases.as_str()], right().as_bytes()).expect(0);
}

#[test]
fn cases_are_made_from_a_seed() {
    let one = run(["cases", "--count", "30", "--seed", "7"]).expect(0).out;
    assert_eq!(run(["cases", "--count", "30", "--seed", "7"]).expect(0).out, one);
    assert_ne!(run(["cases", "--count", "30", "--seed", "8"]).expect(0).out, one);
    let document: Value = serde_json::from_str(&one).expect("JSON");
    assert_eq!(document["cases"].as_array().expect("a list").len(), 30);
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("cases.json");
    let mp06 = "certs/curves/mp06-figure-1.json";
    let options = [
        "cases",
        "--count",
        "4",
        "--ops",
        "point,split",
        "--curves",
        mp06,
        "-o",
        text(&file),
    ];
    assert_eq!(run(options).expect(0).out, "");
    let document: Value = serde_json::from_str(&fs::read_to_string(file).expect("a file")).expect("JSON");
    let operations: Vec<&str> = document["cases"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|case| case["operation"].as_str().expect("a name"))
        .collect();
    assert_eq!(operations, ["point", "split", "point", "split"]);
    assert_eq!(document["cases"][0]["curve"]["points"][2], json!([4.5, 5.5, 2]));
    run(["cases", "--count", "0"]).expect_error(&["--count"]);
    run(["cases", "--ops", "dance"]).expect_error(&["dance"]);
    run(["cases", "--curves", "nowhere.json"]).expect_error(&["nowhere.json"]);
}
