//! `knotproof certify motion`.

use serde_json::Value;
use tempfile::TempDir;

use super::run::{run, run_with_input, text};

const EXPERIMENT: &str = "certs/motions/cpij14-experiment-1.json";

#[test]
fn experiment_1_is_followed_to_its_meeting() {
    let folder = TempDir::new().expect("a folder");
    let certificate = folder.path().join("motion.json");
    let told = run(["certify", "motion", EXPERIMENT, "-o", text(&certificate)])
        .expect(1)
        .out;
    for part in [
        "refuted: motion of \"CPIJ14 Experiment 1",
        "curve: embedded, and the same up to isotopy, throughout",
        "polygon: meets itself in step 10",
        "fails at step 10 in both norms (as CPIJ14 print it, without N∞: fails at step 2)",
        "displacement against ½ν, ν² = 1: fails at step 3 in both norms",
        "accepted by the checker",
    ] {
        assert!(told.contains(part), "{part:?} is not in {told}");
    }
    let curve = "certs/curves/cpij14-experiment-1.json";
    let checked = run(["check", text(&certificate), "--curve", curve]).expect(0).out;
    assert!(checked.contains("motion of 10 steps"), "{checked}");
}

#[test]
fn numbers_for_programs() {
    let json = run(["certify", "motion", EXPERIMENT, "--json"]).expect(1).json();
    assert_eq!((&json["status"], &json["claim"]), (&"refuted".into(), &"motion".into()));
    assert_eq!(
        (&json["steps"], &json["curve"]["embedded_through"]),
        (&10.into(), &"10".into())
    );
    assert_eq!(json["curve"]["first_failing_step"], Value::Null);
    let polygon = &json["polygon"];
    assert_eq!(
        (&polygon["first_failing_step"], &polygon["meets_by"]),
        (&10.into(), &"10".into())
    );
    assert_eq!(polygon["rule"], "touch");
    let cpij14 = &json["criteria"]["cpij14"];
    assert_eq!(
        [&cpij14["infinity"], &cpij14["euclidean"], &cpij14["as_printed"]],
        [&10, &10, &2]
    );
    let half_nu = &json["criteria"]["half_nu"];
    assert_eq!((&half_nu["nu_squared"], &half_nu["infinity"]), (&"1".into(), &3.into()));
    let steps = json["per_step"].as_array().expect("a list");
    assert_eq!(steps.len(), 11);
    let nine = &steps[9];
    for (field, value) in [
        ("second_difference_infinity", "15/8"),
        ("second_difference_euclidean_squared", "225/64"),
        ("displacement_infinity", "5/4"),
        ("displacement_euclidean_squared", "25/16"),
        ("cpij14_infinity", "15/8"),
        ("as_printed", "25/8"),
    ] {
        assert_eq!(nine[field], value, "{field}");
    }
    assert_eq!(steps[10]["cpij14_euclidean"][0], "2.16666666666");
    // Another tolerance, and one track alone.
    let json = run([
        "certify",
        "motion",
        EXPERIMENT,
        "--json",
        "--track",
        "curve",
        "--display-tolerance",
        "3/2",
    ]);
    let json = json.expect(0).json();
    assert_eq!((&json["status"], &json["polygon"]), (&"certified".into(), &Value::Null));
    assert_eq!(json["criteria"]["cpij14"]["infinity"], 5);
}

#[test]
fn half_nu_says_nothing_in_space() {
    let json = run(["certify", "motion", "certs/motions/half-nu-in-space.json", "--json"])
        .expect(1)
        .json();
    assert_eq!(json["criteria"]["half_nu"]["euclidean"], Value::Null);
    assert_eq!(json["polygon"]["first_failing_step"], 1);
}

#[test]
fn a_first_frame_that_meets_itself_is_undecided() {
    let motion = r#"{"knotproof":"motion/1","curve":"certs/curves/figure-eight.json","steps":[]}"#;
    let told = run_with_input(["certify", "motion", "-", "--track", "curve"], motion.as_bytes())
        .expect(3)
        .out;
    assert!(
        told.contains("undecided: motion") && told.contains("at time 0"),
        "{told}"
    );
    let json = run_with_input(
        ["certify", "motion", "-", "--track", "curve", "--json"],
        motion.as_bytes(),
    );
    let json = json.expect(3).json();
    assert_eq!(
        (&json["status"], &json["curve"]["embedded_through"]),
        (&"undecided".into(), &Value::Null)
    );
}

#[test]
fn wrong_usage() {
    run(["certify", "motion", "certs/motions/none.json"]).expect_error(&["certs/motions/none.json", "cannot be read"]);
    run(["certify", "motion", "certs/curves/parabola.json"]).expect_error(&["found version \"curve/1\""]);
    for wrong in [
        &["--display-tolerance", "0"][..],
        &["--display-tolerance", "-1"],
        &["--track", "both sides"],
        &["--budget", "0"],
    ] {
        run(["certify", "motion", EXPERIMENT].iter().chain(wrong)).expect_error(&[wrong[0]]);
    }
    run(["certify", "motion", EXPERIMENT, "-o", EXPERIMENT]).expect_error(&["would replace"]);
    let opens = r#"{"knotproof":"motion/1","curve":"certs/curves/mp06-figure-1.json","steps":[{"moves":[{"point":0,"by":[1,0,0]}]}]}"#;
    run_with_input(["certify", "motion", "-"], opens.as_bytes()).expect_error(&["standard input: step 1", "closed"]);
}
