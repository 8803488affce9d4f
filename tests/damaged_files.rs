//! Files that were cut, edited, or doubled in parts: every reader of our own formats answers with what it read or with an error that says what is wrong, and never panics. Readers of
//! other formats: tests/import.rs; curve files: tests/curve_reader.rs.
#![cfg(feature = "prove")]

use std::fs;
use std::path::{Path, PathBuf};

use knotproof::check::{Verdict, check};
use knotproof::engine::{read_cases, read_results, write_cases, write_results};
use knotproof::motion::{ReadOptions, read_motion_text};
use knotproof::validate::Tolerances;
use proptest::prelude::*;

/// Letters of which the formats are made.
const LETTERS: &[u8] = b"0123456789.-+eE/xpN\"[]{},: \n";

/// One thing that befalls a file: at a place, of a kind, with a value.
type Edit = (prop::sample::Index, u8, u8);

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    prop::collection::vec((any::<prop::sample::Index>(), 0..5u8, any::<u8>()), 1..5)
}

fn damage(bytes: &mut Vec<u8>, edits: &[Edit]) {
    for (at, kind, value) in edits {
        if bytes.is_empty() {
            return;
        }
        let at = at.index(bytes.len());
        match kind {
            0 => bytes[at] = *value,
            1 => bytes[at] = LETTERS[usize::from(*value) % LETTERS.len()],
            2 => drop(bytes.remove(at)),
            3 => {
                let end = (at + usize::from(*value)).min(bytes.len());
                let part = bytes[at..end].to_vec();
                bytes.splice(at..at, part);
            }
            _ => bytes.truncate(at),
        }
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Small certificates of every folder of accepted ones, in both forms.
fn certificates() -> Vec<PathBuf> {
    let folders = fs::read_dir(root().join("certs/accept")).expect("certificates");
    let mut found = Vec::new();
    for folder in folders
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_dir())
    {
        let files = fs::read_dir(folder)
            .expect("a folder")
            .map(|entry| entry.expect("an entry").path());
        let mut files: Vec<PathBuf> = files
            .filter(|path| path.metadata().is_ok_and(|data| data.len() < 4096))
            .collect();
        files.sort();
        found.extend(files.into_iter().take(3));
    }
    found.sort();
    found
}

/// The same motion as steps, as frames, and as lines of steps.
fn motions() -> [String; 3] {
    let curve = r#"{"knotproof":"curve/1","bezier":{"pieces":[{"points":[["0","0"],["1","2"],["3","1/2"]]},{"points":[["3","1/2"],["4","0"]]}]}}"#;
    let step = |x| format!(r#"{{"moves":[{{"point":1,"by":["{x}","0.25"]}}]}}"#);
    let frame = |x| format!(r#"[["0","0"],["{x}","2"],["3","1/2"],["4","0"]]"#);
    let head = format!(r#"{{"knotproof":"motion/1","name":"small","curve":{curve}"#);
    [
        format!(
            r#"{head},"display_tolerance":"10","steps":[{},{}]}}"#,
            step("0.5"),
            step("-1/3")
        ),
        format!(r#"{head},"frames":[{},{}]}}"#, frame("0.5"), frame("1e1")),
        format!("{head}}}\n{}\n{}\n", step("0.5"), step("-1/3")),
    ]
}

fn seed(name: &str) -> Vec<u8> {
    fs::read(root().join("fuzz/seeds").join(name)).expect("a small file")
}

#[test]
fn the_undamaged_files_are_read() {
    for path in certificates() {
        assert!(
            matches!(check(&fs::read(&path).unwrap()[..]), Verdict::Accepted { .. }),
            "{path:?}"
        );
    }
    for motion in motions() {
        let read = read_motion_text(motion.as_bytes(), Path::new(""), ReadOptions::default());
        let read = read.unwrap_or_else(|error| panic!("{error}: {motion}"));
        assert_eq!(read.moves().unwrap().map(Result::unwrap).count(), 2);
    }
    assert!(read_cases(seed("read_cases/small.json")).is_ok());
    assert!(read_results(seed("read_results/all.json")).is_ok());
    assert!(Tolerances::read(seed("read_tolerances/two.json")).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn certificates_are_answered(which in any::<prop::sample::Index>(), edits in edits()) {
        let all = certificates();
        let mut bytes = fs::read(&all[which.index(all.len())]).unwrap();
        damage(&mut bytes, &edits);
        match check(&bytes[..]) {
            Verdict::Accepted { document, .. } => prop_assert!(document.curve.chain().count() > 0),
            Verdict::Rejected { rejection, .. } => {
                prop_assert!(!rejection.place.to_string().is_empty() && !rejection.reason.to_string().is_empty());
            }
            Verdict::Malformed(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }

    #[test]
    fn motions_are_read_or_refused(which in 0..3usize, edits in edits()) {
        let mut bytes = motions()[which].clone().into_bytes();
        damage(&mut bytes, &edits);
        match read_motion_text(&bytes, Path::new("nowhere"), ReadOptions::default()) {
            Ok(motion) => {
                for step in motion.moves().unwrap() {
                    prop_assert!(step.is_ok());
                }
            }
            Err(error) => prop_assert!(!error.what.is_empty()),
        }
    }

    #[test]
    fn cases_results_and_tolerances_are_read_or_refused(edits in edits()) {
        let mut cases = seed("read_cases/small.json");
        damage(&mut cases, &edits);
        match read_cases(&cases) {
            Ok(file) => prop_assert_eq!(read_cases(write_cases(&file)).unwrap(), file),
            Err(error) => prop_assert!(!error.what.is_empty()),
        }
        let mut results = seed("read_results/all.json");
        damage(&mut results, &edits);
        match read_results(&results) {
            Ok(file) => {
                let text = write_results(&file);
                prop_assert_eq!(write_results(&read_results(&text).unwrap()), text);
            }
            Err(error) => prop_assert!(!error.what.is_empty()),
        }
        let mut tolerances = seed("read_tolerances/two.json");
        damage(&mut tolerances, &edits);
        match Tolerances::read(&tolerances) {
            Ok(read) => prop_assert!(read.ulps("point") >= 0.0),
            Err(error) => prop_assert!(!error.what.is_empty()),
        }
    }
}
