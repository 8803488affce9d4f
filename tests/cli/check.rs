//! `knotproof check`.

use std::fs;
use std::path::PathBuf;

use tempfile::TempDir;

use super::run::{run, run_with_input, text};

/// The unit square: σ between √(500/501) and 1.
const SQUARE: &str = r#"{
  "knotproof": "certificate/1",
  "tool": "by hand",
  "curve": { "bspline": {
    "degree": 1,
    "knots": ["0", "0", "1", "2", "3", "4", "4"],
    "points": [["0", "0"], ["1", "0"], ["1", "1"], ["0", "1"], ["0", "0"]] } },
  "curve_sha256": "94ebb2e8ade42f942be041acd140d51466fc65e975c163a22f859e49a7befb95",
  "statement": { "claim": "msd", "convention": "smooth", "lower_squared": "500/501", "upper_squared": "1" },
  "evidence": {
    "grid": 8,
    "tree": ["split", "split", "cone 3 0", "bend 3 3", "cone 0 3", "first", "second", "far 0 -1", "bend 3 3",
      "second", "bend 3 3", "far 1 0", "split", "cone -3 0", "bend 3 3", "cone 0 -3"],
    "upper": { "rule": "root", "s": "1/2", "s_side": "after", "t": "5/2", "t_side": "after" } } }
"#;
const SQUARE_CURVE: &str = "certs/curves/square.json";

/// A directory with the square's certificate in it.
fn directory() -> (TempDir, PathBuf) {
    let directory = TempDir::new().expect("a directory");
    let path = directory.path().join("square.json");
    fs::write(&path, SQUARE).expect("a file");
    (directory, path)
}

/// The verdict on an edited certificate.
#[track_caller]
fn reject(from: &str, to: &str, parts: &[&str]) {
    assert_eq!(SQUARE.matches(from).count(), 1, "{from:?} is not there once");
    let run = run_with_input(["check", "-"], SQUARE.replace(from, to).as_bytes()).expect(1);
    assert!(run.out.starts_with("rejected: standard input: "), "{run:?}");
    for part in parts {
        assert!(run.out.contains(part), "{part:?} is not in {run:?}");
    }
}

#[test]
fn an_accepted_certificate_in_words() {
    let (_directory, path) = directory();
    let run = run(["check", text(&path)]).expect(0);
    let expected = format!(
        "accepted: {}: σ between 0.9990014 and 1 (minimum separation distance, smooth convention; curve 94ebb2e8ade4…, 10 leaves)\n",
        path.display()
    );
    assert_eq!(run.out, expected);
}

#[test]
fn an_accepted_certificate_in_json() {
    let run = run_with_input(["check", "--json", "-"], SQUARE.as_bytes()).expect(0);
    let expected = serde_json::json!({
        "file": "standard input",
        "verdict": "accepted",
        "statement": {
            "claim": "msd",
            "convention": "smooth",
            "lower_squared": "500/501",
            "upper_squared": "1",
            "lower": "0.99900149750436713",
            "upper": "1",
        },
        "leaves": 10,
        "curve_sha256": "94ebb2e8ade42f942be041acd140d51466fc65e975c163a22f859e49a7befb95",
    });
    assert_eq!(run.json(), expected);
}

#[test]
fn edited_certificates_are_rejected() {
    reject("\"500/501\"", "\"502/501\"", &["statement", "exceeds"]);
    reject(
        "\"500/501\", \"upper_squared\": \"1\"",
        "\"2\", \"upper_squared\": \"2\"",
        &["tree", "far"],
    );
    reject("\"500/501\"", "\"500/5O1\"", &["statement.lower_squared"]);
    reject("\"500/501\"", "\"inf\"", &["statement"]);
    reject(
        "upper_squared\": \"1\"",
        "upper_squared\": \"999/1000\"",
        &["upper bound", "root"],
    );
    reject("\"smooth\"", "\"critical\"", &["tree"]);
    reject("\"smooth\"", "\"rough\"", &["convention"]);
    reject("far 0 -1", "far 0 1", &["tree, token 7", "far", "expected", "found"]);
    reject("far 0 -1", "near 0 1", &["tree", "near 0 1"]);
    reject(", \"cone 0 -3\"]", "]", &["tree", "end before"]);
    reject("\"cone 0 -3\"]", "\"cone 0 -3\", \"split\"]", &["left over"]);
    reject("[\"1\", \"1\"]", "[\"1\", \"2\"]", &["curve_sha256"]);
    reject("certificate/1", "certificate/2", &["certificate/2"]);
    reject("\"tool\"", "\"fool\"", &["fool"]);
}

#[test]
fn truncated_certificates_are_rejected() {
    for length in (0..SQUARE.trim_end().len()).step_by(7) {
        let run = run_with_input(["check", "-"], &SQUARE.as_bytes()[..length]).expect(1);
        assert!(
            run.out.starts_with("rejected: standard input: "),
            "{length} bytes: {run:?}"
        );
    }
}

#[test]
fn other_bytes_are_rejected() {
    for bytes in [
        &b"[]"[..],
        b"null",
        b"\xff\xfe",
        b"KNOTCRT1",
        b"KNOTCRT1\xff\xff\xff\xff",
        b"{}",
    ] {
        run_with_input(["check", "-"], bytes).expect(1);
    }
    let run = run(["check", SQUARE_CURVE]).expect(1);
    assert!(
        run.out.contains("found a curve file, expected a certificate"),
        "{run:?}"
    );
}

#[test]
fn a_rejection_in_json() {
    let edited = SQUARE.replace("far 0 -1", "far 0 1");
    let json = run_with_input(["check", "--json", "-"], edited.as_bytes())
        .expect(1)
        .json();
    assert_eq!(json["file"], "standard input");
    assert_eq!(json["verdict"], "rejected");
    assert!(
        json["place"]
            .as_str()
            .is_some_and(|place| place.starts_with("tree, token 7")),
        "{json}"
    );
    assert!(
        json["reason"].as_str().is_some_and(|reason| reason.contains("far")),
        "{json}"
    );
    assert!(
        json.get("statement").is_none() && json.get("leaves").is_none(),
        "{json}"
    );
    let json = run_with_input(["check", "--json", "-"], &SQUARE.as_bytes()[..100])
        .expect(1)
        .json();
    assert_eq!(
        (&json["verdict"], &json["place"]),
        (&"rejected".into(), &serde_json::Value::Null)
    );
}

#[test]
fn the_worst_of_several_files_decides() {
    let (directory, good) = directory();
    let bad = directory.path().join("bad.json");
    fs::write(&bad, SQUARE.replace("500/501", "502/501")).expect("a file");
    let absent = directory.path().join("absent.json");
    let (good, bad, absent) = (text(&good), text(&bad), text(&absent));
    let twice = run(["check", good, good]).expect(0).out;
    assert!(
        twice.ends_with("2 files: 2 accepted, 0 rejected, 0 not read\n"),
        "{twice}"
    );
    assert_eq!(twice.lines().count(), 3);
    let mixed = run(["check", bad, good]).expect(1);
    assert!(
        mixed.out.starts_with("rejected: ") && mixed.out.contains("\naccepted: "),
        "{mixed:?}"
    );
    for files in [[absent, bad], [bad, absent], [good, absent]] {
        let run = run([&["check"], &files[..]].concat());
        assert_eq!((run.code, run.out.lines().count()), (2, 2), "{run:?}");
        assert!(
            run.err.starts_with("error: ") && run.err.contains("absent.json: cannot be read"),
            "{run:?}"
        );
    }
    let run = run(["check", "--json", good, absent, bad]);
    let lines: Vec<serde_json::Value> = run
        .out
        .lines()
        .map(|line| serde_json::from_str(line).expect("JSON in each line"))
        .collect();
    assert_eq!(run.code, 2);
    assert_eq!(lines[0]["verdict"], "accepted");
    assert!(lines[1].get("verdict").is_none(), "{run:?}");
    assert!(
        lines[1]["error"]
            .as_str()
            .is_some_and(|error| error.contains("cannot be read")),
        "{run:?}"
    );
    assert_eq!(lines[2]["verdict"], "rejected");
}

#[test]
fn folders_and_many_files() {
    let (directory, good) = directory();
    let folder = directory.path().join("folder");
    fs::create_dir(&folder).expect("a folder");
    for name in ["b.cert.json", "a.cert.json", "curve.json", ".c.cert.json"] {
        fs::copy(&good, folder.join(name)).expect("a copy");
    }
    fs::write(folder.join("c.cert.bin"), "KNOTCRT1").expect("a file");
    let lines = directory.path().join("lines.jsonl");
    let arguments = ["check", text(&folder), text(&good), "-j", "3", "--jsonl", text(&lines)];
    let told = run(arguments).expect(1).out;
    let starts: Vec<&str> = told
        .lines()
        .map(|line| line.split(": ").next().unwrap_or_default())
        .collect();
    assert_eq!(
        starts,
        ["accepted", "accepted", "rejected", "accepted", "4 files"],
        "{told}"
    );
    assert!(told.contains("3 accepted, 1 rejected, 0 not read"), "{told}");
    let lines = fs::read_to_string(lines).expect("lines");
    let verdicts: Vec<serde_json::Value> = lines
        .lines()
        .map(|line| serde_json::from_str::<serde_json::Value>(line).expect("JSON")["verdict"].clone())
        .collect();
    assert_eq!(verdicts, ["accepted", "accepted", "rejected", "accepted"]);
    run(["check", text(&good), "--jsonl", "/nowhere/at/all"]).expect_error(&["cannot be written"]);
}

#[test]
fn unreadable_files_are_no_verdict() {
    let directory = TempDir::new().expect("a directory");
    run(["check", text(directory.path())]).expect_error(&["no file in the folder that ends in .cert.json"]);
    run(["check", "absent.json"]).expect_error(&["absent.json: cannot be read"]);
    run(["check", "-", "-"]).expect_error(&["standard input", "once"]);
    run(["check", "-", "--curve", "-"]).expect_error(&["standard input", "once"]);
}

#[test]
fn quiet_leaves_the_exit_code() {
    let (_directory, path) = directory();
    assert_eq!(run(["check", "--quiet", text(&path)]).expect(0).out, "");
    assert_eq!(run(["check", "-q", SQUARE_CURVE]).expect(1).out, "");
    assert_eq!(
        run(["check", "--quiet", "--json", text(&path)]).expect(0).json()["verdict"],
        "accepted"
    );
}

#[test]
fn the_curve_asked_for_and_no_other() {
    let (directory, path) = directory();
    let path = text(&path);
    run(["check", path, "--curve", SQUARE_CURVE]).expect(0);
    let other = run(["check", path, "--curve", "certs/curves/triangle.json"]).expect(1);
    for part in [
        "another curve",
        "certs/curves/triangle.json",
        "94ebb2e8ade42f942be041acd140d51466fc65e975c163a22f859e49a7befb95",
    ] {
        assert!(other.out.contains(part), "{part:?} is not in {other:?}");
    }
    let json = run(["check", path, "--json", "--curve", "certs/curves/triangle.json"])
        .expect(1)
        .json();
    assert_eq!(
        (&json["verdict"], &json["place"]),
        (&"rejected".into(), &"curve".into())
    );
    // The same points, closed by another knot vector, are another curve.
    let stretched = directory.path().join("stretched.json");
    let curve = fs::read_to_string(SQUARE_CURVE).expect("the square");
    fs::write(&stretched, curve.replace("\"4\"", "\"5\"").replace("4, 4", "5, 5")).expect("a file");
    assert_ne!(fs::read_to_string(&stretched).expect("a file"), curve);
    run(["check", path, "--curve", text(&stretched)]).expect(1);
    run(["check", path, "--curve", "absent.json"]).expect_error(&["absent.json: cannot be read"]);
    run(["check", path, "--curve", path]).expect_error(&["certificate/1", "curve/1"]);
    run(["check", path, "--snap-joints"]).expect_error(&["--curve"]);
}

#[cfg(unix)]
#[test]
fn a_reader_who_has_gone_is_no_failure() {
    let (_directory, path) = directory();
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let output = super::run::program()
        .args(["check", text(&path), text(&path)])
        .stdout(writer)
        .output();
    let output = output.expect("the program runs");
    assert_eq!((output.status.code(), output.stderr), (Some(0), Vec::new()));
}
