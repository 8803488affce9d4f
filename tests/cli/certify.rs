//! `knotproof certify msd`: results and certificates.

use std::fs;
use std::path::Path;

use knotproof::number::{Integer, Meaning, Rational, RationalExt, parse_number};
use serde_json::Value;
use tempfile::TempDir;

use super::run::{Run, run, run_with_input, text};

const MP06: &str = "certs/curves/mp06-figure-1.json";
/// σ of that curve, to 42 decimals.
const MP06_SIGMA: &str = "0.442675170376606599444313276103389848818804";

fn number(text: &str) -> Rational {
    parse_number(text, Meaning::Decimal).expect("a number")
}

fn number_at(json: &Value, field: &str) -> Rational {
    number(
        json[field]
            .as_str()
            .unwrap_or_else(|| panic!("no text in {field} of {json}")),
    )
}

fn msd(curve: &str, options: &[&str]) -> Run {
    run([&["certify", "msd", curve], options].concat())
}

fn msd_json(curve: &str, options: &[&str]) -> Value {
    msd(curve, &[options, &["--json"]].concat()).expect(0).json()
}

/// The interval is in order, its decimals are outside of it, and it is as narrow as `width`.
#[track_caller]
fn assert_interval(json: &Value, width: &str) {
    let [lower_squared, upper_squared] = ["lower_squared", "upper_squared"].map(|field| number_at(json, field));
    let [lower, upper] = ["lower", "upper"].map(|field| number_at(json, field));
    assert!(
        &lower * &lower <= lower_squared && lower_squared <= upper_squared,
        "{json}"
    );
    assert!(upper_squared <= &upper * &upper, "{json}");
    let one = Rational::from_integer(Integer::ONE);
    let least = &one - number(width);
    assert!(&upper_squared * &least * &least <= lower_squared, "{json}");
    let told = number_at(json, "relative_width");
    assert!(
        told <= number(width) && (&one - &told) * &upper <= number_at(json, "lower") * number("1.0001"),
        "{json}"
    );
}

#[test]
fn the_interval_of_the_published_curve_at_every_width() {
    let unit = Rational::new(Integer::ONE, Integer::from(10).pow(42));
    let (below, above) = (number(MP06_SIGMA) - &unit, number(MP06_SIGMA) + &unit);
    for width in ["1e-1", "1/1000", "1e-12", "1e-16", "1e-30"] {
        let json = msd_json(MP06, &["--rel-width", width]);
        assert_interval(&json, width);
        assert!(number_at(&json, "lower_squared") <= &above * &above, "{width}: {json}");
        assert!(number_at(&json, "upper_squared") >= &below * &below, "{width}: {json}");
        assert!(
            number_at(&json, "lower") <= above && number_at(&json, "upper") >= below,
            "{width}: {json}"
        );
        assert_eq!(json["relative_width_asked"], width);
    }
}

#[test]
fn the_object_of_json() {
    let directory = TempDir::new().expect("a directory");
    let path = directory.path().join("msd.cert.json");
    let json = msd_json(MP06, &["-o", text(&path)]);
    let fields = [
        "status",
        "claim",
        "convention",
        "lower_squared",
        "upper_squared",
        "lower",
        "upper",
        "relative_width",
        "relative_width_asked",
        "at",
        "at_pieces",
        "upper_rule",
        "leaves",
        "seconds",
        "certificate",
        "snapped_joints",
    ];
    let object = json.as_object().expect("an object");
    for field in fields {
        assert!(object.contains_key(field), "no {field} in {json}");
    }
    assert_eq!(object.len(), fields.len(), "{json}");
    assert_eq!((&json["status"], &json["claim"]), (&"certified".into(), &"msd".into()));
    assert_eq!(
        (&json["convention"], &json["relative_width_asked"]),
        (&"smooth".into(), &"1e-12".into())
    );
    assert_eq!(
        (&json["upper_rule"], &json["snapped_joints"]),
        (&"miranda".into(), &0.into())
    );
    assert!(json["leaves"].as_u64().is_some_and(|leaves| leaves > 10), "{json}");
    assert!(json["seconds"].as_f64().is_some_and(|seconds| seconds > 0.0), "{json}");
    assert_eq!(json["certificate"], text(&path));
    assert_eq!(msd_json(MP06, &[])["certificate"], Value::Null);
    // The five pieces lie on the knots 0, 1/5, … 1.
    let at = json["at"].as_array().expect("two parameters");
    let pieces = json["at_pieces"].as_array().expect("two places");
    assert_eq!((at.len(), pieces.len()), (2, 2));
    for (knot, place) in at.iter().zip(pieces) {
        let piece = Rational::from_integer(place["piece"].as_u64().expect("a piece").into());
        let local = number_at(place, "local");
        assert_eq!(number(knot.as_str().expect("a text")), (piece + local) / number("5"));
    }
    let near = |knot: &Value, value: f64| (number(knot.as_str().expect("a text")).to_f64() - value).abs() < 1e-6;
    assert!(near(&at[0], 0.0954737) && near(&at[1], 0.5569022), "{json}");
}

#[test]
fn the_result_in_words() {
    let directory = TempDir::new().expect("a directory");
    let path = directory.path().join("msd.cert.json");
    let run = msd(MP06, &["-o", text(&path)]).expect(0);
    let bytes = fs::metadata(&path).expect("a certificate").len();
    let lines: Vec<&str> = run.out.lines().collect();
    assert!(
        lines[0].starts_with("certified: minimum separation distance σ of \"MP06 Figure 1"),
        "{run:?}"
    );
    assert!(lines[0].ends_with("(smooth convention)"), "{run:?}");
    assert!(lines[1].starts_with("  σ between 0.442675170376"), "{run:?}");
    for part in [
        "where: knot values 0.09547",
        "piece 0 at 0.47736",
        "piece 2 at 0.7845",
        "(rule miranda)",
        "a cover tree with",
        &format!(
            "certificate: {}, {bytes} bytes, accepted by the checker",
            path.display()
        ),
    ] {
        assert!(run.out.contains(part), "{part:?} is not in {run:?}");
    }
    assert!(msd(MP06, &[]).expect(0).out.contains("not kept; -o CERT writes it"));
    assert_eq!(msd(MP06, &["--quiet"]).expect(0).out, "");
    assert_eq!(
        msd(MP06, &["--quiet", "--json"]).expect(0).json()["status"],
        "certified"
    );
}

#[test]
fn curves_without_double_normals() {
    for curve in ["certs/curves/segment.json", "certs/curves/parabola.json"] {
        let json = msd_json(curve, &[]);
        assert_eq!((&json["lower_squared"], &json["lower"]), (&"inf".into(), &"inf".into()));
        for field in [
            "upper_squared",
            "upper",
            "at",
            "at_pieces",
            "upper_rule",
            "relative_width",
        ] {
            assert_eq!(json[field], Value::Null, "{field}");
        }
        assert!(msd(curve, &[]).expect(0).out.contains("there is no double normal"));
    }
}

#[test]
fn a_curve_that_crosses_itself() {
    let json = msd_json("certs/curves/figure-eight.json", &[]);
    let bounds = ["lower_squared", "upper_squared", "lower", "upper"].map(|field| json[field].as_str());
    assert_eq!(bounds, [Some("0"); 4]);
    assert_eq!(json["at"], serde_json::json!(["1/2", "5/2"]));
    let run = msd("certs/curves/figure-eight.json", &[]).expect(0);
    assert!(
        run.out.contains("σ is 0, the curve passes twice through a point"),
        "{run:?}"
    );
    assert!(run.out.contains("where: parameters 0.5 and 2.5"), "{run:?}");
}

#[test]
fn both_conventions() {
    let square = "certs/curves/square.json";
    let smooth = msd_json(square, &["--convention", "smooth"]);
    let critical = msd_json(square, &["--convention", "critical"]);
    assert_eq!((&smooth["upper_rule"], &smooth["upper"]), (&"root".into(), &"1".into()));
    assert_eq!(
        (&critical["upper_rule"], &critical["convention"]),
        (&"critical_root".into(), &"critical".into())
    );
    let triangle = msd_json("certs/curves/triangle.json", &["--convention", "critical"]);
    assert_interval(&triangle, "1e-12");
    assert_eq!(triangle["upper"], "2.4");
    assert_eq!(msd_json("certs/curves/triangle.json", &[])["lower"], "inf");
}

#[test]
fn a_budget_that_runs_out() {
    let directory = TempDir::new().expect("a directory");
    let path = directory.path().join("msd.cert.json");
    let run_json = msd(MP06, &["--budget", "5", "--json", "-o", text(&path)]).expect(3);
    let json = run_json.json();
    assert_eq!(json["status"], "undecided");
    assert!(
        json["reason"]
            .as_str()
            .is_some_and(|reason| reason.contains("budget of 5 leaves")),
        "{json}"
    );
    assert!(number_at(&json, "lower") <= number(MP06_SIGMA), "{json}");
    assert!(number_at(&json, "upper") >= number(MP06_SIGMA), "{json}");
    let words = msd(MP06, &["--budget", "5"]).expect(3).out;
    for part in [
        "undecided: ",
        "because the budget of 5 leaves ran out",
        "proved so far: σ ",
    ] {
        assert!(words.contains(part), "{part:?} is not in {words}");
    }
    // What was proved so far is a certificate like any other.
    let checked = run(["check", "--json", text(&path)]).expect(0).json();
    assert_eq!(checked["statement"]["lower_squared"], json["lower_squared"]);
    assert_eq!(checked["statement"]["upper_squared"], json["upper_squared"]);
}

#[test]
fn the_checker_accepts_what_was_written_in_both_forms() {
    let directory = TempDir::new().expect("a directory");
    let path = |name: &str| directory.path().join(name);
    let write = |name: &str, options: &[&str]| {
        msd(MP06, &[&["-o", text(&path(name))], options].concat()).expect(0);
        fs::read(path(name)).expect("a certificate")
    };
    let binary = |bytes: &[u8]| bytes.starts_with(b"KNOTCRT1");
    assert!(!binary(&write("a.json", &[])));
    assert!(!binary(&write("a.cert", &[])));
    assert!(binary(&write("a.bin", &[])));
    assert!(binary(&write("b.json", &["--format", "binary"])));
    assert!(!binary(&write("b.bin", &["--format", "json"])));
    let statements = ["a.json", "a.cert", "a.bin", "b.json", "b.bin"].map(|name| {
        let checked = run(["check", "--json", text(&path(name)), "--curve", MP06])
            .expect(0)
            .json();
        (
            checked["statement"].clone(),
            checked["leaves"].clone(),
            checked["curve_sha256"].clone(),
        )
    });
    assert!(
        statements.iter().all(|statement| *statement == statements[0]),
        "{statements:?}"
    );
    assert_eq!(msd_json(MP06, &[])["lower_squared"], statements[0].0["lower_squared"]);
    // A binary certificate that lacks its last byte, or has one more.
    let whole = fs::read(path("a.bin")).expect("a certificate");
    run_with_input(["check", "-"], &whole[..whole.len() - 1]).expect(1);
    run_with_input(["check", "-"], &[&whole[..], &[0]].concat()).expect(1);
}

#[test]
fn the_certificate_does_not_depend_on_threads() {
    let directory = TempDir::new().expect("a directory");
    let curve = "certs/curves/trefoil-24.json";
    let written = ["1", "2", "7"].map(|threads| {
        let path = directory.path().join(threads);
        msd(curve, &["--threads", threads, "-o", text(&path)]).expect(0);
        fs::read(path).expect("a certificate")
    });
    assert!(written.iter().all(|bytes| *bytes == written[0]));
}

#[test]
fn a_curve_on_standard_input() {
    let curve = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(MP06)).expect("the curve");
    let json = run_with_input(["certify", "msd", "-", "--json"], &curve)
        .expect(0)
        .json();
    assert_eq!(json["lower_squared"], msd_json(MP06, &[])["lower_squared"]);
    // A curve without a name is called by its file.
    let nameless = r#"{ "knotproof": "curve/1", "bezier": { "pieces": [ { "points": [[0, 0], [1, 0]] } ] } }"#;
    let run = run_with_input(["certify", "msd", "-"], nameless.as_bytes()).expect(0);
    assert!(run.out.contains("σ of standard input (smooth convention)"), "{run:?}");
}

#[test]
fn joints_that_do_not_meet() {
    let directory = TempDir::new().expect("a directory");
    let (curve, certificate) = (directory.path().join("curve.json"), directory.path().join("cert.json"));
    let gap = r#"{ "knotproof": "curve/1", "bezier": { "pieces": [
        { "points": [["0", "0"], ["1", "0"]] }, { "points": [["1", "1e-9"], ["2", "1"]] } ] } }"#;
    fs::write(&curve, gap).expect("a file");
    let (curve, certificate) = (text(&curve), text(&certificate));
    msd(curve, &[]).expect_error(&[curve, "bezier.pieces[1].points[0]", "--snap-joints"]);
    let run_words = msd(curve, &["--snap-joints"]).expect(0);
    assert!(
        run_words.out.contains("joints moved by --snap-joints: 1"),
        "{run_words:?}"
    );
    assert_eq!(
        msd_json(curve, &["--snap-joints", "-o", certificate])["snapped_joints"],
        1
    );
    let written: Value = serde_json::from_slice(&fs::read(certificate).expect("a certificate")).expect("JSON");
    assert_eq!(written["snapped_joints"], 1);
    run(["check", certificate, "--curve", curve]).expect_error(&["bezier.pieces[1].points[0]"]);
    run(["check", certificate, "--curve", curve, "--snap-joints"]).expect(0);
    // Every claim says so.
    let bent = r#"{ "knotproof": "curve/1", "bezier": { "pieces": [
        { "points": [["0", "0"], ["1", "2"], ["2", "0"]] }, { "points": [["2.001", "0"], ["3", "2"], ["4", "0"]] } ] } }"#;
    fs::write(curve, bent).expect("a file");
    for claim in [
        "msd",
        "embedding",
        "curvature",
        "deviation",
        "values",
        "thickness --convention critical",
        "domain --point 1 --box 4",
    ] {
        let order: Vec<&str> = claim.split(' ').chain([curve, "--snap-joints"]).collect();
        let words = run([&["certify"], &order[..]].concat());
        assert!(
            words.out.contains("joints moved by --snap-joints: 1;"),
            "{claim}: {words:?}"
        );
        let json = run([&["certify"], &order[..], &["--json"]].concat()).json();
        assert_eq!(json["snapped_joints"], 1, "{claim}: {json}");
    }
}
