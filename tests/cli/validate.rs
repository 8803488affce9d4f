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

/// Makes a certificate and the cases of it.
fn certificate_and_cases(folder: &Path, certify: &[&str]) -> (String, Vec<Value>) {
    let certificate = text(&folder.join("made.cert.json")).to_string();
    run([&["certify"], certify, &["-o", &certificate]].concat()).expect(0);
    let cases = run(["cases", "--certificates", &certificate]).expect(0).out;
    let mut document: Value = serde_json::from_str(&cases).expect("JSON");
    let Value::Array(cases) = document["cases"].take() else {
        panic!("{document}");
    };
    (certificate, cases)
}

fn write_results(folder: &Path, results: Vec<Value>) -> String {
    let document = json!({ "knotproof": "results/1", "engine": "mine 1.0", "results": results });
    let path = folder.join("answers.json");
    fs::write(&path, document.to_string()).expect("written");
    text(&path).to_string()
}

#[test]
fn results_against_a_certificate_of_values() {
    let folder = TempDir::new().expect("a folder");
    let command = ["values", "certs/curves/parabola.json", "--ops", "point,derivative"];
    let (certificate, cases) = certificate_and_cases(folder.path(), &command);
    // y = x² with x = 2t − 1.
    let answers = |error: f64| -> Vec<Value> {
        let answer = |case: &Value| {
            let x = 2.0 * case["parameter"].as_f64().expect("a number") - 1.0;
            let (field, value) = match (case["operation"].as_str(), case["order"].as_u64()) {
                (Some("point"), _) => ("point", [x, x * x + error]),
                (_, Some(1)) => ("vector", [2.0, 4.0 * x]),
                (_, Some(2)) => ("vector", [0.0, 8.0]),
                _ => ("vector", [0.0, 0.0]),
            };
            json!({ "id": case["id"], "status": "ok", field: value })
        };
        cases.iter().map(answer).collect()
    };
    let right = write_results(folder.path(), answers(0.0));
    let told = run(["validate", &right, &certificate]).expect(0).out;
    assert!(told.contains("point") && told.contains("derivative"), "{told}");
    let wrong = write_results(folder.path(), answers(0.01));
    run(["validate", &wrong, &certificate]).expect(1);
    // Not every entry answered; and an id that no entry has.
    let some = write_results(folder.path(), answers(0.0)[1..].to_vec());
    let told = run(["validate", &some, &certificate]).expect(1).out;
    assert!(told.contains("no answer"), "{told}");
    let mut strange = answers(0.0);
    strange[0]["id"] = json!("000000000000/0");
    let strange = write_results(folder.path(), strange);
    run(["validate", &strange, &certificate]).expect_error(&["results[0].id", "000000000000/0"]);
}

#[test]
fn results_against_a_certificate_of_msd() {
    let folder = TempDir::new().expect("a folder");
    let command = ["msd", "certs/curves/mp06-figure-1.json"];
    let (certificate, cases) = certificate_and_cases(folder.path(), &command);
    assert_eq!(cases.len(), 1);
    let answer = |distance: Value| {
        let result = json!({ "id": cases[0]["id"], "status": "ok", "distance": distance });
        write_results(folder.path(), vec![result])
    };
    let digits = json!(0.442_675_170_376_6);
    run(["validate", &answer(digits.clone()), &certificate]).expect(0);
    run(["validate", &answer(json!(0.45)), &certificate]).expect(1);
    run(["validate", &answer(Value::Null), &certificate]).expect(1);
    // A certificate that proves nothing is no measure.
    let mut document: Value = serde_json::from_str(&fs::read_to_string(&certificate).expect("a file")).expect("JSON");
    document["statement"]["lower_squared"] = json!("1/5");
    let forged = folder.path().join("forged.cert.json");
    fs::write(&forged, document.to_string()).expect("written");
    let told = run(["validate", &answer(digits), text(&forged)]).expect(1).out;
    assert!(told.starts_with("rejected: "), "{told}");
    let told = run(["cases", "--certificates", text(&forged)]);
    assert_eq!((told.code, told.out.as_str()), (1, ""), "{told:?}");
}

#[test]
fn the_engine_of_this_program() {
    let folder = folder(&right());
    let cases = text(&folder.path().join("cases.json")).to_string();
    let told = run(["validate", "--engine", "knotproof-f64", "--cases", &cases])
        .expect(0)
        .out;
    assert!(told.starts_with("passed: knotproof-f64 "), "{told}");
    let command = ["values", "certs/curves/nurbs-circle.json", "--target", "2,0"];
    let (certificate, asked) = certificate_and_cases(folder.path(), &command);
    let json = run(["validate", "--engine", "knotproof-f64", &certificate, "--json"])
        .expect(0)
        .json();
    let cases: u64 = json["operations"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|o| o["cases"].as_u64().expect("a number"))
        .sum();
    assert_eq!(cases, asked.len() as u64);
    run(["validate", "--engine", "knotproof-f65", &certificate]).expect_error(&["knotproof-f65"]);
    run(["validate", "--engine", "knotproof-f64"]).expect_error(&["--cases"]);
}

#[test]
fn polytopes_of_convex_domains() {
    let folder = TempDir::new().expect("a folder");
    let path = |name: &str| text(&folder.path().join(name)).to_string();
    let cases = path("cases.json");
    run(["cases", "--ops", "convex_domain", "--count", "12", "-o", &cases]).expect(0);
    let made: Value = serde_json::from_str(&fs::read_to_string(&cases).expect("cases")).expect("JSON");
    for case in made["cases"].as_array().expect("cases") {
        assert_eq!(case["operation"], "convex_domain");
        assert!(
            case["level"].is_u64() && (case["sign"] == "+" || case["sign"] == "-"),
            "{case}"
        );
    }
    let judged = run(["validate", "--engine", "knotproof-f64", "--cases", &cases, "--json"])
        .expect(0)
        .json();
    assert_eq!(judged["operations"][0]["right"], 12, "{judged}");
    // Not made unless it is named.
    let usual = run(["cases", "--count", "26"]).expect(0).out;
    assert!(!usual.contains("convex_domain"), "{usual}");
    // The half-plane of level 0, y ≤ x, touches the square in a corner.
    let cases = r#"{"knotproof":"cases/1","cases":[{"id":"a","operation":"convex_domain","point":1,"box":1,"level":0,"sign":"+",
"curve":{"degree":2,"knots":[0,0,0,1,1,1],"points":[[0,0],[2,0],[2,2]]}}]}"#;
    fs::write(path("square.json"), cases).expect("written");
    for (vertices, code, part) in [
        (json!([[1, -1], [3, -1], [3, 1], [1, 1]]), 0, "right"),
        (json!([[1, -1], [3, -1], [3, 1], [1, 1.125]]), 1, "vertex 3"),
        (json!([[1, -1], [3, -1], [3, 1]]), 1, "the vertex (1, 1)"),
        (json!([]), 1, "no vertices"),
    ] {
        let results = json!({ "knotproof": "results/1", "engine": "mine 1.0",
            "results": [{ "id": "a", "status": "ok", "vertices": vertices }] });
        fs::write(path("results.json"), results.to_string()).expect("written");
        let told = run(["validate", &path("results.json"), "--cases", &path("square.json")])
            .expect(code)
            .out;
        assert!(told.contains(part), "{vertices}: {told}");
    }
}

#[test]
fn a_chain_makes_cases_as_one_spline() {
    let folder = TempDir::new().expect("a folder");
    let chain = folder.path().join("chain.json");
    // Pieces of degrees 1, 2 and 3, one of them rational with other weights at its joints than its neighbours.
    let pieces = r#"{ "knotproof": "curve/1", "bezier": { "pieces": [
        { "points": [[0, 0], [3, 0]] },
        { "points": [[3, 0], [5, 1], [3, 2]], "weights": [2, 1, 4] },
        { "points": [[3, 2], [2, 3], [1, 1], [0, 2]] } ] } }"#;
    fs::write(&chain, pieces).expect("written");
    for command in [
        &[
            "values",
            text(&chain),
            "--ops",
            "point,derivative,curvature,nearest_point",
            "--target",
            "1,5",
        ][..],
        &["msd", text(&chain)],
    ] {
        let (certificate, asked) = certificate_and_cases(folder.path(), command);
        assert!(!asked.is_empty(), "{command:?}");
        for case in &asked {
            assert_eq!(
                case["curve"]["knots"],
                json!([0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 3])
            );
        }
        run(["validate", "--engine", "knotproof-f64", &certificate]).expect(0);
    }
}

#[test]
fn several_certificates_about_one_curve() {
    let folder = TempDir::new().expect("a folder");
    let certificate = |name: &str, operations: &str| {
        let path = folder.path().join(name);
        run([
            "certify",
            "values",
            "certs/curves/mp06-figure-1.json",
            "--ops",
            operations,
            "-o",
            text(&path),
            "-q",
        ])
        .expect(0);
        text(&path).to_string()
    };
    let (points, curvatures) = (
        certificate("points.json", "point"),
        certificate("curvatures.json", "curvature"),
    );
    let judged = run(["validate", "--engine", "knotproof-f64", &points, &curvatures, "--json"])
        .expect(0)
        .json();
    let operations = judged["operations"].as_array().expect("operations");
    assert_eq!(operations.len(), 2, "{judged}");
    assert!(
        operations.iter().all(|operation| operation["cases"].as_u64() > Some(1)),
        "{judged}"
    );
}
