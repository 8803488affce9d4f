//! The lines between the modules, read from the sources: who may use whom, and how long a file may be.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Modules under `src` with those each may use. What is not listed may use nothing that is.
const MAY_USE: &[(&str, &[&str])] = &[
    ("number", &[]),
    ("polytope", &["number"]),
    ("curve", &["number"]),
    ("import", &["number", "curve"]),
    ("approximation", &["number", "curve"]),
    ("motion", &["number", "curve"]),
    ("claim", &["number", "curve"]),
    ("certificate", &["number", "curve", "claim"]),
    ("check", &["number", "curve", "claim", "certificate"]),
    ("engine", &["number", "curve"]),
    ("float", &["number", "curve"]),
    (
        "prove",
        &[
            "number",
            "polytope",
            "curve",
            "approximation",
            "motion",
            "claim",
            "certificate",
            "check",
            "float",
        ],
    ),
    (
        "compare",
        &[
            "number",
            "curve",
            "approximation",
            "claim",
            "certificate",
            "check",
            "float",
            "prove",
        ],
    ),
    (
        "validate",
        &[
            "number",
            "polytope",
            "curve",
            "claim",
            "certificate",
            "check",
            "engine",
            "float",
        ],
    ),
    ("show", &["number", "curve", "claim", "certificate", "check", "float"]),
    (
        "cli",
        &[
            "number",
            "curve",
            "import",
            "approximation",
            "motion",
            "claim",
            "certificate",
            "check",
            "engine",
            "float",
            "prove",
            "compare",
            "validate",
            "show",
        ],
    ),
    ("main", &["cli"]),
];

/// Lines of a source file, its unit tests at the end not counted.
const MOST_LINES: usize = 650;

fn src() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

/// A file's text without comments and string literals.
fn code(path: &Path) -> String {
    let text = std::fs::read_to_string(path).expect("a source file");
    let mut code = String::new();
    let mut rest = text.as_str();
    while let Some(at) = rest.find(['/', '"', '\'']) {
        code.push_str(&rest[..at]);
        rest = &rest[at..];
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if let Some(inside) = rest.strip_prefix('"') {
            let mut escaped = false;
            let end = inside.find(|c| {
                let ends = c == '"' && !escaped;
                escaped = c == '\\' && !escaped;
                ends
            });
            end.map_or(rest.len(), |end| end + 2)
        } else if rest.starts_with("'\"'") {
            3
        } else if rest.starts_with("'\\") {
            4
        } else {
            code.push_str(&rest[..1]);
            1
        };
        rest = &rest[length..];
    }
    code + rest
}

/// The top-level module of a source file.
fn module(path: &Path) -> String {
    let relative = path.strip_prefix(src()).expect("a source file");
    let first = relative.iter().next().expect("a name").to_string_lossy();
    first.trim_end_matches(".rs").to_string()
}

fn identifier(text: &str) -> &str {
    let end = text
        .find(|c: char| !c.is_alphanumeric() && c != '_')
        .unwrap_or(text.len());
    &text[..end]
}

/// The top-level modules a file names, by `crate::` or, in the binary, by the library's name.
fn uses(path: &Path) -> BTreeSet<String> {
    let code = code(path);
    let mut found = BTreeSet::new();
    let depth = path.strip_prefix(src()).expect("a source file").components().count();
    // `super` so often that it leads out of the module.
    let up = "super::".repeat(if path.ends_with("mod.rs") { depth - 1 } else { depth });
    for prefix in ["crate::", "knotproof::", &up] {
        if prefix.is_empty() {
            continue;
        }
        for (at, _) in code.match_indices(prefix) {
            let before = code[..at].chars().next_back();
            if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':') {
                continue;
            }
            let rest = code[at + prefix.len()..].trim_start();
            if let Some(group) = rest.strip_prefix('{') {
                // A group of paths: every name that follows `{` or `,` at its own level.
                let (mut level, mut start) = (0, true);
                for (i, c) in group.char_indices() {
                    match c {
                        '{' => level += 1,
                        '}' if level == 0 => break,
                        '}' => level -= 1,
                        ',' if level == 0 => start = true,
                        c if start && (c.is_alphabetic() || c == '_') => {
                            found.insert(identifier(&group[i..]).to_string());
                            start = false;
                        }
                        _ => {}
                    }
                }
            } else {
                found.insert(identifier(rest).to_string());
            }
        }
    }
    found
}

/// What each module uses, as far as it is one of those listed.
fn graph() -> BTreeMap<String, BTreeSet<String>> {
    let listed: Vec<&str> = MAY_USE.iter().map(|(name, _)| *name).collect();
    let mut graph: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for path in sources(&src()) {
        let own = module(&path);
        let used = uses(&path)
            .into_iter()
            .filter(|name| *name != own && listed.contains(&name.as_str()));
        graph.entry(own.clone()).or_default().extend(used);
    }
    graph
}

#[test]
fn modules_use_only_what_they_may() {
    let graph = graph();
    for (name, used) in &graph {
        if name == "lib" {
            continue;
        }
        let allowed = MAY_USE
            .iter()
            .find(|(listed, _)| listed == name)
            .unwrap_or_else(|| panic!("src/{name} is not in the list of modules"));
        for other in used {
            assert!(allowed.1.contains(&other.as_str()), "src/{name} uses {other}");
        }
    }
    // The scan sees what is certainly there.
    for (name, other) in [
        ("check", "certificate"),
        ("certificate", "claim"),
        ("claim", "number"),
        ("prove", "check"),
        ("curve", "number"),
        ("polytope", "number"),
    ] {
        assert!(
            graph[name].contains(other),
            "src/{name} no longer uses {other}, or the scan is blind"
        );
    }
}

#[test]
fn the_permitted_uses_have_no_cycle() {
    // Each module may use only modules listed before it.
    for (i, (name, used)) in MAY_USE.iter().enumerate() {
        for other in *used {
            assert!(
                MAY_USE[..i].iter().any(|(earlier, _)| earlier == other),
                "{name} and {other}"
            );
        }
    }
}

#[test]
fn the_checker_uses_neither_threads_nor_floating_point_nor_search() {
    for path in sources(&src().join("check")) {
        let code = code(&path);
        for word in ["f64", "f32", "rayon", "indicatif", "cfg(feature"] {
            let own = code.match_indices(word).any(|(at, _)| {
                let (before, after) = (code[..at].chars().next_back(), code[at + word.len()..].chars().next());
                let joins = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
                !joins(before) && !joins(after)
            });
            assert!(!own, "{} uses {word}", path.display());
        }
    }
}

#[test]
fn nothing_is_unsafe() {
    let manifest = std::fs::read_to_string(src().with_file_name("Cargo.toml")).expect("Cargo.toml");
    assert!(manifest.contains("unsafe_code = \"forbid\""));
    for path in sources(&src()) {
        let code = code(&path);
        let unsafe_word = code
            .split(|c: char| !c.is_alphanumeric() && c != '_')
            .any(|word| word == "unsafe");
        assert!(!unsafe_word, "{}", path.display());
    }
}

#[test]
fn files_are_short() {
    for path in sources(&src()) {
        let text = std::fs::read_to_string(&path).expect("a source file");
        let lines: Vec<&str> = text.lines().collect();
        let tests = lines
            .windows(2)
            .position(|pair| pair[0] == "#[cfg(test)]" && pair[1].ends_with('{'));
        let lines = tests.unwrap_or(lines.len());
        assert!(
            lines <= MOST_LINES,
            "{}: {lines} lines, at most {MOST_LINES} expected",
            path.display()
        );
    }
}
