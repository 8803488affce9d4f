//! `knotproof batch`, and `certify` of many curves.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use tempfile::TempDir;

use super::run::{Run, names, program, run, text};

const SQUARE: &str = "certs/curves/square.json";
const MP06: &str = "certs/curves/mp06-figure-1.json";

/// A folder with a folder "out" to be made in it.
fn folder() -> (TempDir, PathBuf) {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().join("out");
    (folder, out)
}

/// The records of a batch.
fn results(out: &Path) -> Vec<Value> {
    let text = fs::read_to_string(out.join("results.jsonl")).expect("results");
    text.lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect()
}

/// A curve file with the polygon through these points.
fn polygon(folder: &Path, name: &str, points: &str) -> String {
    let path = folder.join(name);
    let points: Vec<&str> = points.split(' ').collect();
    let edges = points
        .windows(2)
        .map(|edge| format!("{{\"points\": [[{}], [{}]]}}", edge[0], edge[1]));
    let edges: Vec<String> = edges.collect();
    let file = format!(
        "{{\"knotproof\": \"curve/1\", \"name\": \"{name}\", \"bezier\": {{\"pieces\": [{}]}}}}",
        edges.join(", ")
    );
    fs::write(&path, file).expect("a curve file");
    text(&path).to_string()
}

#[track_caller]
fn contains(run: &Run, parts: &[&str]) {
    for part in parts {
        assert!(run.out.contains(part), "{part:?} is not in {}\n{}", run.out, run.err);
    }
}

#[test]
fn several_files_and_one_claim() {
    let (_folder, out) = folder();
    let run_ = run([
        "certify",
        "msd",
        SQUARE,
        MP06,
        "--rel-width",
        "1e-6",
        "-o",
        text(&out),
        "-j",
        "2",
    ])
    .expect(0);
    contains(&run_, &["claim", "msd --rel-width=1e-6        2          2", "results"]);
    assert_eq!(
        names(&out),
        ["mp06-figure-1.msd.cert.json", "results.jsonl", "square.msd.cert.json"]
    );
    let records = results(&out);
    // In the order of the command line, whoever was ready first.
    assert_eq!(records[0]["input"], SQUARE);
    assert_eq!(records[1]["certificate"], "mp06-figure-1.msd.cert.json");
    assert_eq!(records[1]["status"], "certified");
    assert_eq!(records[1]["exit_code"], 0);
    assert_eq!(records[1]["options"], serde_json::json!(["--rel-width=1e-6"]));
    let checked = run(["check", text(&out)]).expect(0).out;
    assert_eq!(checked.lines().count(), 3, "{checked}");
    assert!(
        checked.ends_with("2 files: 2 accepted, 0 rejected, 0 not read\n"),
        "{checked}"
    );
    // The same certificate as alone.
    let alone = out.join("alone.json");
    run(["certify", "msd", MP06, "--rel-width", "1e-6", "-o", text(&alone)]).expect(0);
    assert_eq!(
        fs::read(alone).unwrap(),
        fs::read(out.join("mp06-figure-1.msd.cert.json")).unwrap()
    );
}

#[test]
fn one_failure_does_not_end_the_rest() {
    let (folder, out) = folder();
    let broken = folder.path().join("broken.json");
    fs::write(&broken, "{\"knotproof\": \"curve/1\",").unwrap();
    let point = polygon(folder.path(), "point.json", "1,1 1,1");
    let bow = polygon(folder.path(), "bow.json", "0,0 10,10 10,0 0,10");
    let files = [SQUARE, text(&broken), "nowhere.json", &point, &bow];
    let ran = run([&["batch"], &files[..], &["--claim", "embedding", "-o", text(&out)]].concat());
    assert_eq!((ran.code, ran.err.as_str()), (2, ""), "{ran:?}");
    contains(
        &ran,
        &[
            "files not read: 2",
            "bow.json bow.json, embedding: the path passes twice through the point (5, 5)",
            "broken.json: ",
            "nowhere.json: cannot be read",
            "point.json point.json, embedding: ",
            "single point",
        ],
    );
    let records = results(&out);
    let told: Vec<(&str, i64)> = records
        .iter()
        .map(|record| {
            (
                record["status"].as_str().unwrap(),
                record["exit_code"].as_i64().unwrap(),
            )
        })
        .collect();
    let expected = [
        ("certified", 0),
        ("failed", 2),
        ("failed", 2),
        ("failed", 2),
        ("refuted", 1),
    ];
    assert_eq!(told, expected);
    assert_eq!(records[4]["statement"]["claim"], "msd");
    assert!(
        records[1]["claim"].is_null() && records[1]["reason"].as_str().unwrap().contains("EOF"),
        "{records:?}"
    );
    assert_eq!(run(["check", text(&out), "-q"]).code, 0);
    assert_eq!(names(&out).iter().filter(|name| name.starts_with('.')).count(), 0);
}

#[test]
fn the_worst_outcome_is_the_exit_code() {
    let (folder, out) = folder();
    let bow = polygon(folder.path(), "bow.json", "0,0 10,10 10,0 0,10");
    let undecided = ["--claim", "msd --budget 1"];
    for (files, claim, code) in [
        (&[SQUARE, MP06][..], "embedding", 0),
        (&[SQUARE, &bow], "embedding", 1),
        (&[SQUARE, MP06], undecided[1], 3),
        (&[MP06, &bow], "embedding --budget 1,embedding", 1),
        (&[SQUARE, "nowhere.json", &bow], "embedding", 2),
    ] {
        let ran = run([&["batch"], files, &["--claim", claim, "--quiet"]].concat());
        assert_eq!((ran.code, ran.out.as_str()), (code, ""), "{files:?} {claim}: {ran:?}");
    }
    assert!(!out.exists());
    let ran = run(["batch", MP06, "--claim", undecided[1]]);
    contains(&ran, &["undecided:", "the proof became too long", "proved: "]);
}

#[test]
fn words_say_what_and_where() {
    let (folder, _) = folder();
    let corners = polygon(folder.path(), "corners.json", "0,0 7.5,0 7.5,2 0,2 0,0");
    let ran = run(["batch", &corners, "--claim", "thickness"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let json = run(["batch", &corners, "--claim", "thickness", "--json"])
        .expect(0)
        .json();
    let remark = json["remarks"][0].as_str().unwrap();
    assert!(
        remark.starts_with("the path has a corner, a turn by 90° at (0, 0); no pipe"),
        "{remark}"
    );
    // Back over itself.
    let back = polygon(folder.path(), "back.json", "0,0 3,1.5 1,0.5");
    let ran = run(["batch", &back, "--claim", "embedding"]);
    assert_eq!(ran.code, 1, "{ran:?}");
    contains(&ran, &["the path passes twice through the point (1.5, 0.75)"]);
    // A crossing at a point that is no fraction of the file's.
    let cubic = folder.path().join("loop.json");
    let points = "[[0,0],[3,2],[-2,2],[1,0.25]]";
    let file = format!("{{\"knotproof\": \"curve/1\", \"bezier\": {{\"pieces\": [{{\"points\": {points}}}]}}}}");
    fs::write(&cubic, file).unwrap();
    let ran = run(["batch", text(&cubic), "--claim", "embedding"]);
    assert_eq!(ran.code, 1, "{ran:?}");
    contains(&ran, &["embedding: the path crosses itself at (0."]);
    // No double normal in a triangle.
    let triangle = polygon(folder.path(), "triangle.json", "0,0 4,0 0,3 0,0");
    let json = run(["batch", &triangle, "--claim", "msd", "--json"]).expect(0).json();
    let remark = json["remarks"][0].as_str().unwrap();
    for part in [
        "3 corners",
        "a turn by 90° at (0, 0)",
        "a turn by 143.1° at (4, 0)",
        "--convention critical",
    ] {
        assert!(remark.contains(part), "{part} is not in {remark}");
    }
}

// An end that overshoots the start by one unit of the last decimal, so that the line of Z crosses the beginning: what rounded relative coordinates leave in real drawings.
#[cfg(feature = "import")]
#[test]
fn an_end_that_misses_the_start_is_suspected() {
    let (folder, out) = folder();
    let file = folder.path().join("overshoot.svg");
    let path = "M0 0C4 0 4 4 4 6L-4 6C-4 4-4 0 .01 0Z";
    fs::write(&file, format!("<svg><path d=\"{path}\"/></svg>")).unwrap();
    let order = ["batch", text(&file), "--claim", "embedding", "-o", text(&out)];
    for resumed in [false, true] {
        let ran = run([&order[..], &["--resume"][..usize::from(resumed)]].concat());
        assert_eq!(ran.code, 1, "{ran:?}");
        let suspicion = "the end misses the start by 0.01, as rounding may; --weld moves it there";
        contains(&ran, &["the path crosses itself at (0.004", suspicion]);
        assert_eq!(results(&out)[0]["resumed"], resumed);
    }
    let welded = run([&order[..], &["--weld"]].concat()).expect(0);
    assert!(!welded.out.contains("misses"), "{welded:?}");
    // Nothing to suspect.
    fs::write(&file, "<svg><path d=\"M0 0L4 0L0 4L4 4Z\"/></svg>").unwrap();
    let crossed = run(["batch", text(&file), "--claim", "embedding"]);
    assert_eq!(crossed.code, 1, "{crossed:?}");
    assert!(!crossed.out.contains("misses"), "{crossed:?}");
}

#[test]
fn an_earlier_run_is_resumed() {
    let (folder, out) = folder();
    let line = polygon(folder.path(), "line.json", "0,0 1,0 1,1");
    let certify = |extra: &[&str]| -> Vec<bool> {
        let fixed = [
            "batch",
            SQUARE,
            MP06,
            &line,
            "--claim",
            "embedding",
            "-o",
            text(&out),
            "-q",
        ];
        run([&fixed, extra].concat()).expect(0);
        let records = results(&out);
        assert_eq!(records.len(), 3);
        records.iter().map(|record| record["resumed"] == true).collect()
    };
    assert_eq!(certify(&["--resume"]), [false; 3]);
    assert_eq!(certify(&["--resume"]), [true; 3]);
    assert_eq!(certify(&[]), [false; 3]);
    // A certificate that is gone, and one that was changed, are made anew.
    fs::remove_file(out.join("square.embedding.cert.json")).unwrap();
    let second = out.join("mp06-figure-1.embedding.cert.json");
    let changed = fs::read_to_string(&second)
        .unwrap()
        .replace("\"edges\":", "\"edges\":1");
    fs::write(&second, changed).unwrap();
    assert_eq!(certify(&["--resume"]), [false, false, true]);
    assert_eq!(run(["check", text(&out), "-q"]).code, 0);
    // So is that of a curve that was changed.
    polygon(folder.path(), "line.json", "0,0 1,0 1,2");
    assert_eq!(certify(&["--resume"]), [true, true, false]);
    // Other options are another question.
    let square = |claim| run(["batch", SQUARE, "--claim", claim, "-o", text(&out), "-q", "--resume"]).expect(0);
    square("msd");
    square("msd --convention critical");
    assert_eq!(results(&out)[0]["resumed"], false);
    assert_eq!(results(&out)[0]["statement"]["convention"], "critical");
    // Half a line, as a run that was killed may leave it.
    let whole = fs::read_to_string(out.join("results.jsonl")).unwrap();
    fs::write(out.join("results.jsonl"), &(whole.clone() + &whole)[..whole.len() + 40]).unwrap();
    square("msd --convention critical");
    assert_eq!(results(&out)[0]["resumed"], true);
}

#[test]
fn a_long_search_is_given_up() {
    let (folder, out) = folder();
    let points: Vec<String> = (0..3000).map(|i| format!("{i},{},{}", i * i % 7, i * 5 % 11)).collect();
    let long = polygon(folder.path(), "long.json", &points.join(" "));
    let limit = "the time limit of 0.001 s was reached";
    let alone = run(["certify", "msd", &long, "--time-limit", "0.001"]);
    assert_eq!((alone.code, alone.err.as_str()), (3, ""), "{alone:?}");
    contains(&alone, &["undecided: msd\n", limit]);
    let json = run(["certify", "msd", &long, "--time-limit", "0.001", "--json"])
        .expect(3)
        .json();
    assert_eq!(
        (json["status"].as_str(), json["reason"].as_str()),
        (Some("undecided"), Some(limit))
    );
    let batch = run([
        "batch",
        &long,
        "--claim",
        "msd,embedding",
        "--time-limit",
        "0.001",
        "-o",
        text(&out),
    ]);
    assert_eq!(batch.code, 3, "{batch:?}");
    contains(&batch, &[limit]);
    assert_eq!(names(&out), ["results.jsonl"]);
    run(["certify", "msd", SQUARE, "--time-limit", "60"]).expect(0);
    for wrong in ["0", "-1", "soon"] {
        run(["certify", "msd", SQUARE, &format!("--time-limit={wrong}")]).expect_error(&["--time-limit"]);
    }
}

#[cfg(unix)]
#[test]
fn an_end_from_the_keyboard_leaves_whole_files() {
    use std::process::{Command, Stdio};
    let (folder, out) = folder();
    let curves = folder.path().join("curves");
    fs::create_dir(&curves).unwrap();
    for i in 0..400 {
        polygon(
            &curves,
            &format!("{i:03}.json"),
            &format!("0,0 {},0 4,3 0,{}", i + 1, i + 9),
        );
    }
    let mut child = program()
        .args([
            "batch",
            text(&curves),
            "--claim",
            "embedding",
            "-j",
            "1",
            "-o",
            text(&out),
        ])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = || fs::read_to_string(out.join("results.jsonl")).map_or(0, |text| text.lines().count());
    while lines() < 3 && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    let killed = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(killed.success());
    let ran = Run::from(child.wait_with_output().unwrap());
    assert_eq!((ran.code, ran.err.as_str()), (3, ""), "{ran:?}");
    contains(&ran, &["interrupted, not finished: ", "--resume goes on"]);
    let done = results(&out).len();
    assert!((3..400).contains(&done), "{done}");
    let left = names(&out);
    assert_eq!(left.len(), done + 1, "{left:?}");
    assert_eq!(run(["check", text(&out), "-q"]).code, 0);
    let again = run([
        "batch",
        text(&curves),
        "--claim",
        "embedding",
        "-o",
        text(&out),
        "--resume",
    ])
    .expect(0);
    contains(
        &again,
        &[&format!("taken over from an earlier run, checked again: {done}\n")],
    );
    assert_eq!(results(&out).len(), 400);
}

#[test]
fn results_for_programs() {
    let (folder, _) = folder();
    let lines = folder.path().join("lines.jsonl");
    let ran = run([
        "batch",
        SQUARE,
        MP06,
        "--claim",
        "embedding,curvature",
        "--jsonl",
        text(&lines),
    ])
    .expect(0);
    contains(&ran, &["embedding        2          2"]);
    let written = fs::read_to_string(&lines).unwrap();
    for arguments in [["--jsonl", "-"], ["--json", "-q"]] {
        let ran = run([
            &["batch", SQUARE, MP06, "--claim", "embedding,curvature"][..],
            &arguments,
        ]
        .concat())
        .expect(0);
        let keys = |text: &str| -> BTreeSet<(String, String)> {
            let line = |line: &str| -> (String, String) {
                let value: Value = serde_json::from_str(line).unwrap();
                assert!(value["seconds"].as_f64().unwrap() > 0.0 && value["certificate"].is_null());
                (value["curve"].to_string(), value["words"].to_string())
            };
            text.lines().map(line).collect()
        };
        assert_eq!(ran.out.lines().count(), 4, "{ran:?}");
        assert_eq!(keys(&ran.out), keys(&written));
    }
}

#[test]
fn claims_with_options_and_of_motions() {
    let (folder, out) = folder();
    let cubic = "certs/curves/domain-cubic.json";
    let domain = "domain --point 1 --box 20 --tol 1e-3";
    let question = format!("{domain} --nearest 10,-10");
    run([
        "batch",
        cubic,
        "--claim",
        domain,
        "--claim",
        &question,
        "-o",
        text(&out),
        "-q",
    ])
    .expect(0);
    assert_eq!(
        names(&out),
        [
            "domain-cubic.domain-2.cert.json",
            "domain-cubic.domain.cert.json",
            "results.jsonl"
        ]
    );
    let certify = [
        "certify",
        "domain",
        cubic,
        "--point",
        "1",
        "--box",
        "20",
        "--nearest",
        "-1,2",
        "--all",
        "-q",
    ];
    run(certify).expect(0);
    run(["batch", SQUARE, "--claim", "motion"]).expect_error(&["certify motion"]);
    run(["batch", SQUARE, "--claim", "distance"]).expect_error(&["--claim", "distance"]);
    run(["batch", SQUARE, "--claim", "msd --rel-width 7"]).expect_error(&["1e-30 to 1e-1"]);
    let motion = "certs/motions/cpij14-experiment-1.json";
    let copy = folder.path().join("copy.json");
    let moved = fs::read_to_string(motion).unwrap();
    fs::write(&copy, moved).unwrap();
    let motions = folder.path().join("motions");
    let ran = run([
        "certify",
        "motion",
        motion,
        motion,
        "-o",
        text(&motions),
        "--budget",
        "100000",
    ]);
    let records = results(&motions);
    assert_eq!(records.len(), 2, "{ran:?}");
    assert_eq!(records[0]["claim"], "motion");
    assert_eq!(records[0]["status"], records[1]["status"]);
    assert_ne!(records[0]["status"], "failed", "{ran:?}");
}

#[test]
fn wrong_usage_of_batches() {
    let (folder, out) = folder();
    run(["batch"]).expect_error(&["<FILE>"]);
    run(["batch", SQUARE, "--resume"]).expect_error(&["--output"]);
    run(["batch", SQUARE, "--show"]).expect_error(&["--output"]);
    run(["batch", "-", "-"]).expect_error(&["standard input", "only once"]);
    let file = folder.path().join("file");
    fs::write(&file, "mine").unwrap();
    run(["batch", SQUARE, "-o", text(&file)]).expect_error(&["cannot be made the folder of a batch"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    // Files that no batch has written are left alone.
    for (name, arguments) in [("results.jsonl", &[][..]), ("index.html", &["--show"])] {
        let mine = folder.path().join(format!("mine-{name}"));
        fs::create_dir(&mine).unwrap();
        fs::write(mine.join(name), "<p>my page</p>").unwrap();
        let batch = ["batch", SQUARE, "-o", text(&mine)];
        run([&batch, arguments].concat()).expect_error(&[name, "no file of a batch"]);
        assert_eq!(fs::read_to_string(mine.join(name)).unwrap(), "<p>my page</p>");
    }
    let ran = run([
        "certify",
        "domain",
        "certs/curves/domain-cubic.json",
        "--point",
        "1",
        "--box",
        "20",
        "--level",
        "2",
        "--all",
    ]);
    assert_eq!(ran.code, 2, "{ran:?}");
    contains(&ran, &["'--level <LEVEL>' cannot be used with '--output <CERT>'"]);
    run(["batch", SQUARE, "--jsonl", "/nowhere/at/all"]).expect_error(&["/nowhere/at/all", "cannot be written"]);
    let ran = run(["batch", text(&out)]);
    assert_eq!(ran.code, 2, "{ran:?}");
    contains(&ran, &["files not read: 1", "out: cannot be read"]);
    fs::create_dir(&out).unwrap();
    run(["batch", text(&out)]).expect_error(&["out: found no file with curves"]);
}

#[cfg(feature = "import")]
#[test]
fn every_curve_of_a_drawing_with_pictures() {
    let (folder, out) = folder();
    let drawing = "tests/import/drawing.svg";
    let ran = run([
        "batch",
        drawing,
        "--claims",
        "embedding",
        "--show=reports",
        "-o",
        text(&out),
    ]);
    assert_eq!(ran.code, 1, "{ran:?}");
    contains(
        &ran,
        &["drawing.svg almost, embedding: the path passes twice through the point (0.1, 0)"],
    );
    let records = results(&out);
    assert_eq!(records.len(), 7);
    let page = fs::read_to_string(out.join("index.html")).unwrap();
    assert_eq!(page.matches("class=\"thumbnail\"").count(), 7);
    assert!(!page.contains("http"), "no address outside");
    for record in &records {
        for field in ["certificate", "picture", "report"] {
            let name = record[field].as_str().unwrap_or_else(|| panic!("{field} of {record}"));
            assert!(page.contains(&format!("href=\"{name}\"")), "{name}");
            assert!(fs::metadata(out.join(name)).unwrap().len() > 500, "{name}");
        }
    }
    let slanted = records.iter().find(|record| record["curve"] == "slanted").unwrap();
    assert!(slanted["notes"][0].as_str().unwrap().contains("arc approximated"));
    // One of them, or all of them, by the command of one claim.
    let one = folder.path().join("one");
    let ring = [
        "certify",
        "msd",
        drawing,
        "--select",
        "ring",
        "--rel-width",
        "1e-3",
        "-o",
    ];
    run([&ring[..], &[&format!("{}/", text(&one)), "-q"]].concat()).expect(0);
    assert_eq!(names(&one), ["drawing.msd.cert.json", "results.jsonl"]);
    run(["certify", "embedding", drawing, "--all", "-q"]).expect(1);
    // A folder: what is no curve is left out, what should be one and is not is told.
    let many = folder.path().join("many");
    fs::create_dir(&many).unwrap();
    fs::copy(drawing, many.join("a.svg")).unwrap();
    fs::write(many.join("b.svg"), "<svg>").unwrap();
    fs::write(many.join("LICENSE"), "do what you like").unwrap();
    fs::write(many.join(".hidden.svg"), "<svg>").unwrap();
    let ran = run(["certify", "embedding", text(&many)]);
    assert_eq!(ran.code, 2, "{ran:?}");
    contains(
        &ran,
        &[
            "embedding        7          6          1",
            "b.svg: ",
            "left out, files of folders in no known format: 1",
        ],
    );
}
