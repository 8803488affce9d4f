//! docs/PAPERS.md is written by this test: what four papers print, beside values that are computed here.
//!
//! `cargo test --test papers` compares the page with the file in the repository; `cargo test --test papers write -- --ignored` writes it.
#![cfg(feature = "prove")]

#[path = "../common/mod.rs"]
mod common;

mod certified;
mod cpij14;
mod cpij14_rules;
mod cpj12;
mod cpj12_example;
mod double_normals;
mod exact;
mod gkk09;
mod gkk09_tables;
mod knot;
mod mp06;
mod mp06_search;
mod sampling;
mod table;

use std::fmt::Write as _;

use table::Page;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/PAPERS.md");

const HEAD: &str = "\
# What the papers print

Four papers are implemented here. This page lists what they print about a curve or a formula and what can be computed again from their text: numbers, counts, formulas, inequalities and claims, each beside the value
and with a verdict. The file is written by `tests/papers`: values are computed with exact fractions or enclosed by them (what is decided in binary64 says so), σ, deviations and motions are accepted by the checker first, and every verdict on a number follows
from a comparison. `cargo test --test papers` fails when the page is not what the generator writes.

- **MP06**: E. L. F. Moore, T. J. Peters, *Floating Point Geometric Algorithms for Topologically Correct Scientific Visualization* (2006).
- **CPJ12**: H. P. Cassidy, T. J. Peters, K. E. Jordan, *Dynamic Computational Topology for Piecewise Linear Curves* (CCCG 2012).
- **CPIJ14**: H. P. Cassidy, T. J. Peters, H. Ilies, K. E. Jordan, *Topological Integrity for Dynamic Spline Models During Visualization of Big Data* (2014).
- **GKK09**: A. I. Ginnis, E. I. Karousos, P. D. Kaklis, *A discrete methodology for controlling the sign of curvature and torsion for NURBS*, Computing 86 (2009).

The texts were read by machine from printed pages. A damaged formula may be the reader's; such rows say *misprint*, whosever it is.

| verdict | meaning |
| --- | --- |
| equal | the printed number is the value; the formula or list is the right one |
| rounded | the value, rounded to nearest, has the printed digits |
| cut off | the value begins with the printed digits, and rounds to others |
| different | neither |
| holds | the claim is true: by computation where it is about numbers, else by the proof named |
| does not hold | the claim is false, by the counterexample beside it |
| proof does not hold | a step of the argument is false, by the counterexample beside it |
| cannot be recomputed | the text does not determine it; the reason is given |

Decimals that end in … are cut off; \"a to b\" is an enclosure. A fraction stands for itself, and so does a decimal without …. σ is the length of the shortest double normal in the convention `smooth` of [msd.md](msd.md).
";

fn page() -> String {
    type Writer = fn(&mut Page);
    let papers: [(&str, Writer); 4] = [
        ("MP06", mp06::write),
        ("CPJ12", cpj12::write),
        ("CPIJ14", cpij14::write),
        ("GKK09", gkk09::write),
    ];
    let names = table::verdict_names();
    let mut body = String::new();
    let mut counts = String::from("\n| |");
    for name in &names {
        let _ = write!(counts, " {name} |");
    }
    let _ = write!(counts, "\n|{}\n", " --- |".repeat(names.len() + 1));
    let written = std::thread::scope(|scope| {
        let threads = papers.map(|(paper, write)| {
            let thread = scope.spawn(move || {
                let mut page = Page::default();
                write(&mut page);
                page.finish()
            });
            (paper, thread)
        });
        threads.map(|(paper, thread)| (paper, thread.join().expect("a paper")))
    });
    for (paper, (text, found)) in written {
        body.push_str(&text);
        let _ = write!(counts, "| {paper} |");
        for name in &names {
            let count = found
                .iter()
                .find(|(verdict, _)| verdict == name)
                .map_or(0, |(_, count)| *count);
            let _ = write!(counts, " {count} |");
        }
        counts.push('\n');
    }
    format!("{HEAD}{counts}{body}")
}

#[test]
fn the_page_is_what_is_computed() {
    let (kept, computed) = (std::fs::read_to_string(FILE).expect(FILE), page());
    let difference = kept
        .lines()
        .zip(computed.lines())
        .find(|(kept, computed)| kept != computed);
    assert_eq!(difference, None, "(kept, computed)");
    assert_eq!(kept.len(), computed.len(), "one is longer");
}

#[test]
#[ignore = "writes docs/PAPERS.md"]
fn write() {
    std::fs::write(FILE, page()).expect(FILE);
}
