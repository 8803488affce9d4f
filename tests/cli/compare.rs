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
    let point = br#"{"knotproof":"curve/1","bezier":{"pieces":[{"points":[[1,1],[1,1]]}]}}"#;
    run_with_input(["compare", "-"], point).expect_error(&["standard input", "piece 0 is a single point"]);
}
