//! The corpus: both checkers accept every file of certs/accept and reject every file of certs/reject.
//!
//! `cargo test --test corpus regenerate -- --ignored` writes it anew, the hand-made files from the cases of tests/rules and the others with
//! the prover; `SUBJECT=… cargo test --test corpus renew_subject -- --ignored` the hand-made files of one subject.

#[cfg(feature = "prove")]
#[path = "../benches/chains.rs"]
mod chains;
mod common;
#[path = "rules/subjects/mod.rs"]
mod subjects;

use std::path::{Path, PathBuf};

use common::case::{Case, certs, describe};
use common::python;
use knotproof::check::{Verdict, check};

/// Hand-made files above this size are tested but not kept.
const MOST_BYTES: usize = 16_384;

/// The hand-made cases that are kept.
fn recipes() -> Vec<Case> {
    let all = subjects::all().into_iter().flat_map(|(_, cases)| cases());
    all.filter(|case| case.bytes.len() <= MOST_BYTES).collect()
}

/// All files below a folder, in order.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    for entry in entries {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push(path);
        }
    }
    found.sort();
    found
}

#[test]
fn both_checkers_agree_on_every_file() {
    let accept = files(&certs().join("accept"));
    let reject = files(&certs().join("reject"));
    assert!(
        accept.len() >= 100 && reject.len() >= 300,
        "{} and {} files",
        accept.len(),
        reject.len()
    );
    let all: Vec<(PathBuf, bool)> = accept
        .into_iter()
        .map(|path| (path, true))
        .chain(reject.into_iter().map(|path| (path, false)))
        .collect();
    let paths: Vec<PathBuf> = all.iter().map(|(path, _)| path.clone()).collect();
    let second = std::thread::spawn(move || python::check_files(&paths));
    let mut wrong = Vec::new();
    for (path, accepted) in &all {
        let verdict = check(std::fs::File::open(path).expect("a file"));
        if matches!(verdict, Verdict::Accepted { .. }) != *accepted {
            wrong.push(format!("{}: {}", path.display(), describe(&verdict)));
        }
    }
    for ((path, accepted), answer) in all.iter().zip(second.join().expect("the second checker answers")) {
        if answer.accepted != *accepted {
            wrong.push(format!("{}: check.py: {}", path.display(), answer.reason));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn hand_made_files_are_those_of_the_rules_tests() {
    let recipes = recipes();
    for case in &recipes {
        let path = certs().join(case.path());
        let kept = std::fs::read(&path).unwrap_or_default();
        assert!(
            kept == case.bytes,
            "{} is not as tests/rules makes it; regenerate the corpus",
            path.display()
        );
    }
    let known: Vec<PathBuf> = recipes.iter().map(|case| certs().join(case.path())).collect();
    for folder in ["accept", "reject"] {
        for path in files(&certs().join(folder)) {
            let proved = path.parent().is_some_and(|parent| parent.ends_with("proved"));
            assert!(proved || known.contains(&path), "{} has no recipe", path.display());
        }
    }
}

#[test]
fn every_rule_is_on_both_sides() {
    for rule in [
        "far",
        "not_normal",
        "cone",
        "bend",
        "turn",
        "pedal",
        "miranda",
        "root",
        "touch",
        "crossing",
        "critical_root",
        "critical_interval",
        "sandwich",
        "empty",
        "nearest",
        "change",
        "ball",
        "curvature",
        "thickness",
        "separate",
        "monotone",
        "embedding",
        "values",
        "motion",
    ] {
        for verdict in ["accept", "reject"] {
            assert!(!files(&certs().join(verdict).join(rule)).is_empty(), "{verdict}/{rule}");
        }
    }
}

#[cfg(feature = "prove")]
mod proved {
    use std::io::Cursor;
    use std::path::Path;

    use knotproof::certificate::{Document, Encoding};
    use knotproof::claim::domain::{Content, Sign};
    use knotproof::claim::msd::{Convention, Lower};
    use knotproof::curve::{Bezier, Curve, Form, read_curve};
    use knotproof::number::{Integer, Rational, RationalVector};
    use knotproof::prove::domain;
    use knotproof::prove::domain::questions::{About, answer};
    use knotproof::prove::embedding;
    use knotproof::prove::linear_program::GoodLp;
    use knotproof::prove::msd::{Certified, Options, certify};
    use knotproof::prove::values;

    use super::chains;
    use super::common::case::certs;

    fn tenth_to_the(exponent: u32) -> Rational {
        Rational::new(1.into(), Integer::from(10).pow(exponent))
    }

    fn certified<'c>(curve: &'c Curve, name: &str, convention: Convention, digits: u32, budget: u64) -> Certified<'c> {
        let options = Options {
            convention,
            relative_width: tenth_to_the(digits),
            budget: Some(budget),
            name: Some(name.into()),
            snapped_joints: None,
        };
        certify(curve, &options, &|_| ()).expect("certifies")
    }

    fn write(certified: &mut Certified, encoding: Encoding, name: &str) {
        let mut file = Cursor::new(Vec::new());
        certified.write_checked(encoding, &mut file).expect(name);
        let extension = if encoding == Encoding::Json { "json" } else { "cert" };
        let folder = certs().join("accept/proved");
        std::fs::create_dir_all(&folder).expect("a folder");
        std::fs::write(folder.join(format!("{name}.{extension}")), file.into_inner()).expect("writes");
    }

    fn says_something(certified: &Certified) -> bool {
        let statement = &certified.document.claim.statement;
        let zero = matches!(&statement.lower_squared, Lower::Finite(lower) if lower.numer().is_zero());
        !zero || statement.upper_squared.is_some()
    }

    /// A certificate of 200 pieces like the trace of a protein.
    fn trace() -> Curve {
        let pieces = chains::chain(chains::Kind::CAlpha, 200, 1).expect("a size that is accepted");
        let thousandths = |x: &f64| Rational::new(Integer::from((x * 1000.0).round() as i64), Integer::from(1000));
        let pieces = pieces.iter().map(|points| {
            let coordinates: Vec<Rational> = points.iter().flatten().map(thousandths).collect();
            Bezier::new(3, RationalVector::from_rationals(&coordinates), None).expect("a piece")
        });
        Curve::new(3, Form::Bezier(pieces.collect())).expect("a curve")
    }

    /// The example curves that are embedded.
    fn write_embeddings() {
        for path in super::files(&certs().join("curves")) {
            let name = path.file_stem().and_then(|stem| stem.to_str()).expect("a name");
            let file = read_curve(std::fs::read(&path).expect("a file")).expect("a curve");
            let options = embedding::Options {
                budget: Some(1500),
                name: file.name.clone(),
                snapped_joints: None,
            };
            let found = embedding::certify(&file.curve, &options, &|_| ()).expect("certifies");
            if let embedding::Outcome::Embedded(mut certified) = found {
                let mut file = Cursor::new(Vec::new());
                certified.write_checked(Encoding::Json, &mut file).expect(name);
                let path = certs().join(format!("accept/proved/{name}-embedding.json"));
                std::fs::write(path, file.into_inner()).expect("writes");
            }
        }
    }

    /// Results of operations on some of the example curves, with the distance of a point.
    fn write_values() {
        for name in [
            "parabola",
            "nurbs-circle",
            "mp06-figure-1",
            "unclamped-periodic",
            "planar-degree-4",
            "nurbs-space",
        ] {
            let path = certs().join("curves").join(format!("{name}.json"));
            let file = read_curve(std::fs::read(path).expect(name)).expect(name);
            let curve = file.curve;
            let options = values::Options {
                operations: None,
                samples: 1,
                targets: vec![vec![Rational::from_integer(2.into()); curve.dimension()]],
                others: Vec::new(),
                relative_width: tenth_to_the(9),
                name: file.name,
                snapped_joints: None,
            };
            let found = values::certify(&curve, &options).expect(name);
            let mut file = Cursor::new(Vec::new());
            domain::write_checked(&found.document, Encoding::Json, &mut file).expect(name);
            let path = certs().join(format!("accept/proved/{name}-values.json"));
            std::fs::write(path, file.into_inner()).expect("writes");
        }
    }

    /// Domains of control points, and answers to questions about them.
    fn write_domains() {
        for (name, point, sign) in [
            ("domain-cubic", 1, None),
            ("domain-quintic-bounded", 2, Some(Sign::Positive)),
            ("domain-quintic-many-vertices", 2, Some(Sign::Positive)),
            ("domain-quintic-late", 2, Some(Sign::Positive)),
            ("domain-quintic-empty", 2, Some(Sign::Positive)),
            ("domain-quintic-spatial", 2, None),
            ("domain-nurbs-arc", 2, None),
            ("domain-spiral-12", 6, None),
            ("domain-helix-nurbs", 4, None),
        ] {
            let path = certs().join("curves").join(format!("{name}.json"));
            let curve = read_curve(std::fs::read(path).expect(name)).expect(name).curve;
            let question = domain::Question {
                point,
                sign,
                interval: None,
                bounds: domain::Bounds::Edge(Rational::from_integer(20.into())),
            };
            let problem = domain::Problem::new(&curve, &question).expect(name);
            let options = |digits| domain::Options {
                tolerance: tenth_to_the(digits),
                budget: 2000,
                name: Some(name.into()),
                snapped_joints: None,
                measure_rounds: false,
                solver: &GoodLp,
            };
            let found = domain::certify(&curve, &problem, &options(3)).document.expect(name);
            write_domain(&found, Encoding::Json, name);
            write_domain(&found, Encoding::Binary, name);
            let target = problem
                .position
                .iter()
                .map(|x| x + Rational::from_integer(7.into()))
                .collect();
            for (kind, about) in [
                ("nearest", About::Nearest(target)),
                ("fair", About::Fair),
                ("change", About::Change),
                ("ball", About::Ball),
            ] {
                if let Ok(found) = answer(&curve, &problem, &about, &options(9)) {
                    write_domain(&found.document, Encoding::Json, &format!("{name}-{kind}"));
                }
            }
        }
    }

    fn write_domain(document: &Document<Content>, encoding: Encoding, name: &str) {
        let mut file = Cursor::new(Vec::new());
        domain::write_checked(document, encoding, &mut file).expect(name);
        let extension = if encoding == Encoding::Json { "json" } else { "cert" };
        let folder = certs().join("accept/proved");
        std::fs::write(folder.join(format!("{name}.{extension}")), file.into_inner()).expect("writes");
    }

    /// The certificates of the example curves.
    pub fn write_all() {
        for path in super::files(&certs().join("curves")) {
            let name = path
                .file_stem()
                .and_then(|stem| stem.to_str())
                .expect("a name")
                .to_string();
            let file = read_curve(std::fs::read(&path).expect("a file")).expect("a curve");
            let title = file.name.unwrap_or_else(|| name.clone());
            for convention in [Convention::Smooth, Convention::Critical] {
                // As narrow as a small tree allows.
                let widths = [12, 6, 3, 2, 1];
                let found = widths
                    .into_iter()
                    .map(|digits| certified(&file.curve, &title, convention, digits, 1500))
                    .find(|found| found.status == knotproof::prove::msd::Status::Certified);
                let mut found = found.unwrap_or_else(|| certified(&file.curve, &title, convention, 1, 1500));
                if says_something(&found) {
                    write(&mut found, Encoding::Json, &format!("{name}-{}", convention.name()));
                }
            }
        }
        let curve = |name: &str| {
            let path: &Path = &certs().join("curves").join(name);
            read_curve(std::fs::read(path).expect(name)).expect(name).curve
        };
        for name in ["mp06-figure-1", "trefoil-24", "nurbs-ellipse", "square"] {
            let curve = curve(&format!("{name}.json"));
            let mut found = certified(&curve, name, Convention::Smooth, 12, 20_000);
            write(&mut found, Encoding::Binary, name);
        }
        write_embeddings();
        let mp06 = curve("mp06-figure-1.json");
        let mut narrow = certified(&mp06, "mp06-figure-1, 30 digits", Convention::Smooth, 30, 20_000);
        write(&mut narrow, Encoding::Json, "mp06-figure-1-30-digits");
        let spatial = trace();
        let mut trace = certified(
            &spatial,
            "200 pieces like the trace of a protein",
            Convention::Smooth,
            12,
            200_000,
        );
        write(&mut trace, Encoding::Binary, "trace-200");
        write_domains();
        write_values();
    }
}

#[cfg(feature = "prove")]
#[test]
#[ignore = "writes certs/accept and certs/reject"]
fn regenerate() {
    for folder in ["accept", "reject"] {
        let folder = certs().join(folder);
        if folder.exists() {
            std::fs::remove_dir_all(&folder).expect("removes the old corpus");
        }
    }
    for case in recipes() {
        let path = certs().join(case.path());
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, &case.bytes).expect("writes");
    }
    proved::write_all();
}

/// The hand-made files of one subject anew, the others left as they are.
#[test]
#[ignore = "writes the files of the subject that the environment variable SUBJECT names"]
fn renew_subject() {
    let subject = std::env::var("SUBJECT").expect("SUBJECT names a subject of tests/rules");
    for verdict in ["accept", "reject"] {
        let folder = certs().join(verdict).join(&subject);
        if folder.exists() {
            std::fs::remove_dir_all(&folder).expect("removes the old files");
        }
    }
    for case in recipes().iter().filter(|case| case.subject == subject) {
        let path = certs().join(case.path());
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, &case.bytes).expect("writes");
    }
}
