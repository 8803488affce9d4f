//! The page.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use knotproof::engine::{Case, CasesFile, OPERATIONS, write_cases};
use knotproof::validate::Tolerances;

use crate::{Found, Group};

/// Writes docs/ENGINES.md.
pub fn page(found: &[Found], cases: &[Case], seed: u64) -> String {
    let mut page = String::from(HEAD);
    let _ = writeln!(
        page,
        "This run: {} cases, seed {seed}. Tolerances are the defaults of `knotproof validate` ([validate](validate.md)):\n\
         {} units in the last place for results that are formulas of the input, {} for distances.\n",
        cases.len(),
        Tolerances::default().ulps("point"),
        Tolerances::default().ulps("msd"),
    );
    page.push_str("| engine | right | wrong | refused | not offered | not judged | wrong in |\n| --- | ---: | ---: | ---: | ---: | ---: | --- |\n");
    for engine in found {
        let total = engine.report.total();
        let mut wrong: BTreeMap<&str, usize> = BTreeMap::new();
        for ((operation, ..), fault) in &engine.faults {
            *wrong.entry(operation).or_default() += fault.count;
        }
        let wrong: Vec<String> = wrong.iter().map(|(name, count)| format!("{name} {count}")).collect();
        let _ = writeln!(
            page,
            "| [{}](#{}) | {} | {} | {} | {} | {} | {} |",
            engine.report.engine,
            anchor(&engine.report.engine),
            total.right,
            total.wrong,
            total.refused,
            total.not_offered,
            total.unjudged,
            if wrong.is_empty() {
                "–".into()
            } else {
                wrong.join(", ")
            },
        );
    }
    page.push_str(&known(found));
    for engine in found {
        section(&mut page, engine);
    }
    page
}

/// Defects found by hand before there was a generator: the engine, its function, what it does wrong, and where a case of it is counted.
const KNOWN: [(&str, &str, &str, &str, &str); 4] = [
    (
        "geomdl",
        "`degree_operations`",
        "leaves the multiplicity of interior knots as it was, so that another curve results",
        "elevate_degree",
        "polynomial: other value",
    ),
    (
        "curvo",
        "`try_add_knot`",
        "changes a curve with weights, such as an exact quarter circle",
        "insert_knot",
        "rational: other value",
    ),
    (
        "kurbo",
        "`PathSeg::min_dist`",
        "reports more than the distance of two curves, such as cubics",
        "curve_distance",
        "other value",
    ),
    (
        "OCCT",
        "`GeomAPI_ExtremaCurveCurve`",
        "finds one extremum of a pair of curves, and none of a piece with itself, so that the shortest double normal is missed",
        "msd",
        "polynomial: other value",
    ),
];

/// A table of them, with what this run found.
fn known(found: &[Found]) -> String {
    let mut text = String::from(
        "\nFour defects were known before there was a generator. These lines show them:\n\n\
         | engine | function | defect | shown under | cases |\n| --- | --- | --- | --- | ---: |\n",
    );
    for (name, function, defect, operation, group) in KNOWN {
        let engines = found.iter().filter(|engine| engine.report.engine.starts_with(name));
        let faults = engines.flat_map(|engine| &engine.faults);
        let count: usize = faults
            .filter(|(of, _)| of.0 == operation && title(of).ends_with(group))
            .map(|(_, fault)| fault.count)
            .sum();
        let _ = writeln!(
            text,
            "| {name} | {function} | {defect} | {operation}, {group} | {count} |"
        );
    }
    text
}

/// What a group is called after its operation.
fn title((_, kind, rational, unclamped, cubics): &Group) -> String {
    let form = match (rational, cubics) {
        (_, true) => "two cubics",
        (true, _) => "rational",
        _ => "polynomial",
    };
    let knots = if *unclamped { ", unclamped knots" } else { "" };
    format!("{form}{knots}: {}", kind.name())
}

const HEAD: &str = "\
# What engines get wrong

Written by `tests/engines/run.sh` from real runs; not edited by hand. The cases are generated from a seed and, in a smaller part, about the curves of
`certs/curves`; no case was picked. Every answer is held against the exact result. *Wrong* is outside the tolerance, *refused* an exception, a crash
or no answer within the time allowed, *not offered* an operation that the engine does not have for such curves. Which side of a knot a derivative takes, and
whether a part is put on [0, 1], are conventions and never wrong. Units in the last place are those of [validate](validate.md). For each way of being
wrong the smallest case that a greedy shrinker found is shown, with what the engine returned and the exact value. A reproduction is a
complete case: put into a file `{\"knotproof\":\"cases/1\",\"cases\":[…]}`, the adapter under `tests/engines/` answers it.
Iterative functions get the precision that the adapters ask for; kurbo's `min_dist`, slow for less, gets an accuracy of 1e-7. The double normals of
OCCT are the least of those that `GeomAPI_ExtremaCurveCurve` finds for the pairs of Bézier pieces. The engine of this library, knotproof-f64 ([float](float.md)), answers the same cases.

";

fn anchor(title: &str) -> String {
    let keep = |c: char| match c {
        ' ' => Some('-'),
        c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c.to_ascii_lowercase()),
        _ => None,
    };
    title.chars().filter_map(keep).collect()
}

fn section(page: &mut String, engine: &Found) {
    let _ = writeln!(page, "\n## {}\n", engine.report.engine);
    page.push_str(
        "| operation | cases | right | wrong | refused | not offered | not judged | worst units of a right answer |\n",
    );
    page.push_str("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (operation, c) in engine.report.by_operation() {
        let worst = match c.right {
            0 => "–".to_string(),
            _ if c.worst_ulps < 1000.0 => format!("{:.1}", c.worst_ulps),
            _ => format!("{:.1e}", c.worst_ulps),
        };
        let _ = writeln!(
            page,
            "| {operation} | {} | {} | {} | {} | {} | {} | {worst} |",
            c.cases, c.right, c.wrong, c.refused, c.not_offered, c.unjudged
        );
    }
    let mut faults: Vec<_> = engine.faults.iter().collect();
    faults.sort_by_key(|((operation, kind, rational, unclamped, cubics), _)| {
        (
            OPERATIONS.iter().position(|name| name == operation),
            *kind,
            *rational,
            *unclamped,
            *cubics,
        )
    });
    for (group, fault) in faults {
        let plural = if fault.count == 1 { "case" } else { "cases" };
        let _ = writeln!(
            page,
            "\n**{}, {}** ({} {plural}). Smallest found:\n",
            group.0,
            title(group),
            fault.count
        );
        let text = write_cases(&CasesFile {
            seed: None,
            cases: vec![Case {
                id: "a".into(),
                ..fault.case.clone()
            }],
        });
        let case = text.lines().nth(1).unwrap_or_default();
        let place = if fault.wrong.place.is_empty() {
            String::new()
        } else {
            format!("{}, ", fault.wrong.place)
        };
        let _ = writeln!(page, "```json\n{case}\n```\n");
        let off = match fault.wrong.ulps {
            x if x.is_finite() => format!(" ({x:.1e} units off)"),
            _ => String::new(),
        };
        let _ = writeln!(
            page,
            "{place}found {}, expected {}{off}.",
            fault.wrong.found, fault.wrong.expected
        );
    }
}
