//! `knotproof compare`.

use serde_json::Value;

use super::run::{run, run_with_input};

const MP06: &str = "certs/curves/mp06-figure-1.json";

fn row<'v>(json: &'v Value, key: &str) -> &'v Value {
    let rows = json["rows"].as_array().expect("rows");
    let found: Vec<&Value> = rows.iter().filter(|row| row["key"] == key).collect();
    assert_eq!(found.len(), 1, "{key}");
    found[0]
}

fn number(row: &Value, field: &str) -> f64 {
    row[field].as_str().expect(field).parse().expect(field)
}

#[test]
fn the_example_of_the_paper_in_four_formats() {
    let json = run(["compare", MP06, "--json"]).expect(0).json();
    assert_eq!((&json["delta"], &json["epsilon_d"]), (&"1/4".into(), &"1/100".into()));
    for (key, exact) in [
        ("cpj12.m1", "5"),
        ("cpj12.m2", "6"),
        ("cpj12.m2_proved", "5"),
        ("cpj12.m", "6"),
        ("cpj12.edges", "960"),
    ] {
        assert_eq!(row(&json, key)["exact"], exact, "{key}");
    }
    // Between the bounds of the polygon lies what the checker accepted.
    let (sigma, proved) = (row(&json, "certified.sigma"), row(&json, "polygon.sigma"));
    assert_eq!(
        (&sigma["standing"], &proved["standing"]),
        (&"certified".into(), &"proved".into())
    );
    assert!(number(proved, "lower") <= number(sigma, "lower") && number(sigma, "upper") <= number(proved, "upper"));
    assert!(
        number(sigma, "upper") - number(sigma, "lower") < 1e-8
            && number(proved, "upper") - number(proved, "lower") < 4e-3
    );
    // What is computed in binary64 is near, and stands as such.
    for key in ["mp06.newton", "float.sigma"] {
        let found = row(&json, key);
        assert_eq!(found["standing"], "binary64");
        assert!((number(found, "lower") - 0.442_675_170_376).abs() < 1e-8, "{key}");
    }
    assert!(number(row(&json, "cpj12.lambda_disjoint"), "upper") < number(sigma, "lower"));
    assert!(number(row(&json, "certified.edges"), "lower") <= 40.0);
    assert!(number(row(&json, "certified.deviation"), "upper") <= number(row(&json, "npl99.deviation"), "upper"));
    let rows = json["rows"].as_array().expect("rows").len();
    let csv = run(["compare", MP06, "--format", "csv"]).expect(0).out;
    assert_eq!(csv.lines().count(), rows + 1);
    assert!(
        csv.starts_with("method,key,quantity,standing,lower,upper,remark\nCPJ12,cpj12.k,"),
        "{csv}"
    );
    let markdown = run(["compare", MP06, "--format", "markdown"]).expect(0).out;
    assert_eq!(markdown.lines().count(), rows + 2);
    assert!(
        markdown.lines().all(|line| line.matches('|').count() == 6),
        "{markdown}"
    );
    let text = run(["compare", MP06]).expect(0).out;
    for part in ["δ = 1/4, ε_d = 1/100", "as printed", "certified", "proved", "960"] {
        assert!(text.contains(part), "{part:?} is not in {text}");
    }
    assert_eq!(run(["compare", MP06, "--quiet"]).expect(0).out, "");
}

#[test]
fn curves_for_which_the_paper_has_no_numbers() {
    let json = run(["compare", "certs/curves/nurbs-ellipse.json", "--json"]).json();
    let refused = row(&json, "cpj12.m");
    assert!(
        refused["lower"].is_null() && refused["remark"].as_str().expect("why").contains("piece 0 is rational"),
        "{refused}"
    );
    assert!(row(&json, "certified.sigma")["lower"].is_string());
    let json = run(["compare", "certs/curves/parabola.json", "--json"]).json();
    for key in ["certified.sigma", "polygon.sigma"] {
        assert_eq!(row(&json, key)["lower"], "inf", "{key}");
    }
    // A tolerance that asks for more edges than a computer holds.
    let run = run(["compare", MP06, "--json", "--delta", "1e-30"]).expect(0);
    let json = run.json();
    assert!(row(&json, "cpj12.lambda_candidates")["lower"].is_null(), "{json}");
}

#[test]
fn levels_of_gkk09_beside_the_certified_domain() {
    let cubic = [
        "compare",
        "certs/curves/domain-cubic.json",
        "--point",
        "1",
        "--box",
        "20",
    ];
    let json = run([&cubic[..], &["--json"]].concat()).expect(0).json();
    assert_eq!(
        (&json["domain"]["degree"], &json["domain"]["sign"]),
        (&"paper".into(), &"+".into())
    );
    assert_eq!(json["domain"]["box"][1], serde_json::json!(["10", "10"]));
    let bounds = |key: &str| {
        let row = row(&json, key);
        [number(row, "lower"), number(row, "upper")]
    };
    let certified = bounds("certified.domain.measure");
    assert!(certified[0] < certified[1] && certified[1] < certified[0] * 1.000_01);
    assert_eq!(row(&json, "certified.domain.measure")["standing"], "certified");
    for level in 0..=5 {
        let at = |key: &str| bounds(&format!("gkk09.{level}.{key}"));
        // A cubic has (2n − 2)·2^ℓ coefficients.
        assert_eq!(at("inequalities")[0], f64::from(4 << level));
        let (measure, own, error) = (at("measure"), at("own"), at("error"));
        assert!(measure[1] < certified[0]);
        // The true error lies below what the level knows of it, and is the gap to the certified area.
        assert!(error[0] > 0.0 && error[1] < own[1], "{error:?} {own:?}");
        assert!((error[0] * measure[0] - (certified[0] - measure[0])).abs() < 1e-6);
    }
    assert!(row(&json, "gkk09.0.successive")["lower"].is_null());
    // The paper's last difference is about three times the error that is left.
    assert!((bounds("gkk09.5.successive")[1] - 1.339e-4).abs() < 1e-7);
    assert!((bounds("gkk09.5.error")[1] - 4.1e-5).abs() < 1e-6);
    let rows = json["rows"].as_array().expect("rows").len();
    for (format, more) in [("csv", 1), ("markdown", 2)] {
        let text = run([&cubic[..], &["--format", format]].concat()).expect(0).out;
        assert_eq!(text.lines().count(), rows + more, "{format}");
    }
    let text = run([&cubic[..], &["--tol", "1e-3"]].concat()).expect(0).out;
    for part in [
        "convex domain of the control point (0, 0), curvature +, box (-10, -10) to (10, 10)",
        "level 4, true error",
        "level at which (20) ≤ 1/1000 stops",
        "the true error is at most the tolerance",
    ] {
        assert!(text.contains(part), "{part:?} is not in {text}");
    }
    assert!(!text.contains("level 5"), "{text}");
}

#[test]
fn levels_in_space_and_of_empty_domains() {
    let curve = |name: &str| format!("certs/curves/{name}.json");
    let spatial = curve("domain-quintic-spatial");
    let json = run(["compare", &spatial, "--point", "2", "--levels", "1", "--json"])
        .expect(0)
        .json();
    assert_eq!(row(&json, "gkk09.1.inequalities")["exact"], "20");
    assert!(number(row(&json, "gkk09.1.measure"), "upper") < number(row(&json, "certified.domain.measure"), "lower"));
    // Levels 0 and 1 are empty, the domain is not.
    let late = curve("domain-quintic-late");
    let asked = ["--point", "2", "--box", "40", "--sign", "+", "--levels", "3", "--json"];
    let json = run([&["compare", late.as_str()][..], &asked].concat()).json();
    assert!(number(row(&json, "certified.domain.measure"), "lower") > 0.0);
    for (level, why) in [(0, "there is no level before"), (1, "the level before is empty")] {
        let measure = row(&json, &format!("gkk09.{level}.measure"));
        assert_eq!((&measure["lower"], &measure["upper"]), (&"0".into(), &"0".into()));
        assert_eq!(row(&json, &format!("gkk09.{level}.successive"))["remark"], why);
        for key in ["own", "error"] {
            let error = row(&json, &format!("gkk09.{level}.{key}"));
            assert!(
                error["lower"].is_null() && error["remark"] == "the level is empty",
                "{error}"
            );
        }
    }
    assert_eq!(row(&json, "gkk09.2.successive")["remark"], "the level before is empty");
    for level in [2, 3] {
        let at = |key: &str| row(&json, &format!("gkk09.{level}.{key}"));
        assert!(number(at("measure"), "lower") > 0.0);
        assert!(number(at("error"), "upper") < number(at("own"), "upper"));
    }
    // Of a rational curve the degree is the true one.
    let arc = run([
        "compare",
        &curve("domain-nurbs-arc"),
        "--point",
        "1",
        "--levels",
        "0",
        "--json",
    ])
    .json();
    assert_eq!(arc["domain"]["degree"], "true");
    let none = curve("domain-quintic-empty");
    let json = run([&["compare", none.as_str()][..], &asked].concat()).json();
    assert_eq!(row(&json, "certified.domain.measure")["remark"], "the domain is empty");
    assert_eq!(row(&json, "gkk09.3.own")["remark"], "the domain is empty");
}

#[test]
fn interval_methods_where_they_are_installed() {
    // A row whatever is installed; a number only with an enclosure of the certified one.
    let json = run(["compare", MP06, "--json", "--peers", "--peer-limit", "120"])
        .expect(0)
        .json();
    let sigma = row(&json, "certified.sigma");
    for key in ["codac.sigma", "flint.sigma"] {
        let found = row(&json, key);
        assert_eq!(found["standing"], "interval");
        if found["lower"].is_string() {
            assert!(
                number(found, "lower") <= number(sigma, "upper") && number(sigma, "lower") <= number(found, "upper")
            );
            assert!(number(row(&json, &key.replace("sigma", "seconds")), "lower") >= 0.0);
        } else {
            assert!(!found["remark"].as_str().expect("why").is_empty());
        }
    }
    let json = run(["compare", MP06, "--json", "--peers", "--python", "no-such-python"])
        .expect(0)
        .json();
    let remark = row(&json, "codac.sigma")["remark"].as_str().expect("why").to_string();
    assert!(remark.contains("no-such-python cannot be started"), "{remark}");
}

#[test]
fn a_picture_of_the_bounds() {
    let folder = tempfile::tempdir().expect("a folder");
    let draw = |name: &str, arguments: &[&str]| {
        let path = folder.path().join(name);
        let picture = path.to_str().expect("a path");
        run([&["compare"][..], arguments, &["--quiet", "--picture", picture]].concat()).expect(0);
        std::fs::read_to_string(&path).expect("a picture")
    };
    let (first, second) = (draw("a.svg", &[MP06]), draw("b.svg", &[MP06]));
    assert_eq!(first, second, "the same curve gives the same picture");
    for part in [
        "Minimum separation distance σ",
        "CPJ12: λ_c ± E",
        "certified: cover tree",
        "its width",
        "perturbation radius, Euclidean",
    ] {
        assert!(first.contains(part), "{part:?}");
    }
    assert!(!first.contains("Convex domain"));
    let domain = [
        "certs/curves/domain-cubic.json",
        "--point",
        "1",
        "--levels",
        "3",
        "--tol",
        "1e-9",
    ];
    let levels = draw("c.svg", &domain);
    assert!(levels.contains("Convex domain: relative error of the area") && levels.contains(">tolerance<"));
    // Four levels of two errors and three of a difference, and three dots in the key.
    assert_eq!(
        levels
            .split("Convex domain: relative")
            .nth(1)
            .map(|part| part.matches("<circle").count()),
        Some(14)
    );
    // What is drawn is not replaced, nor written where there is no place.
    run(["compare", MP06, "--picture", MP06]).expect_error(&["would replace the curve"]);
    let nowhere = folder.path().join("no/a.svg");
    run(["compare", MP06, "--picture", nowhere.to_str().expect("a path")]).expect_error(&["no directory"]);
}

#[test]
fn wrong_usage() {
    for wrong in [
        ["--delta", "0"],
        ["--epsilon-d", "-1"],
        ["--delta", "x"],
        ["--format", "xml"],
    ] {
        let run = run([&["compare", MP06][..], &wrong].concat());
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{run:?}");
    }
    for (wrong, why) in [
        (&["--box", "2"][..], "--point"),
        (&["--levels", "3"], "--point"),
        (&["--point", "1", "--levels", "17"], "17"),
        (&["--python", "python3"], "--peers"),
        (&["--peers", "--peer-limit", "0"], "above 0"),
        (&["--point", "99"], "there is no control point 99"),
        (&["--point", "1", "--box", "0"], "box"),
        (&["--point", "1", "--box-from", "0,0,0"], "--box-to"),
    ] {
        run([&["compare", MP06][..], wrong].concat()).expect_error(&[why]);
    }
    let point = br#"{"knotproof":"curve/1","bezier":{"pieces":[{"points":[[1,1],[1,1]]}]}}"#;
    run_with_input(["compare", "-"], point).expect_error(&["standard input", "piece 0 is a single point"]);
}
