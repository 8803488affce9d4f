//! Vertex sets against lrs (lrslib) and scdd_gmp (cddlib), where these are installed; a test says so when it is skipped.
#![cfg(feature = "prove")]

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use knotproof::number::{Integer, Rational, RationalExt};
use knotproof::polytope::{HalfSpace, Intersection, intersect};

/// Steele, Lea, Flood 2014: SplitMix64.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed ^ (mixed >> 31)) % bound
    }

    fn between(&mut self, low: i64, high: i64) -> i64 {
        low + self.below((high - low + 1) as u64) as i64
    }

    /// Rows around the origin, of small coefficients that coincide often or of large ones, some of them twice and some through a point of others.
    fn system<const D: usize>(&mut self, rows: usize) -> Vec<HalfSpace<D>> {
        let size = [2, 5, 1 << 20, 1 << 60][self.below(4) as usize];
        let mut system: Vec<HalfSpace<D>> = (0..rows)
            .map(|_| HalfSpace {
                normal: std::array::from_fn(|_| Integer::from(self.between(-size, size))),
                constant: Integer::from(self.between(size / 2, size * 2)),
            })
            .collect();
        for i in 0..rows / 4 {
            let mut row = system[i].clone();
            if self.below(2) == 0 {
                row.constant += &system[i + 1].constant;
                for (sum, other) in row.normal.iter_mut().zip(&system[i + 1].normal) {
                    *sum += other;
                }
            } else {
                let factor = Integer::from(self.between(1, 9));
                row.constant *= &factor;
                row.normal.iter_mut().for_each(|x| *x *= &factor);
            }
            system.push(row);
        }
        for axis in 0..D {
            for sign in [1, -1] {
                let normal = std::array::from_fn(|i| Integer::from(if i == axis { sign } else { 0 }));
                let constant = Integer::from(self.between(1, 4));
                system.push(HalfSpace { normal, constant });
            }
        }
        // Beyond 128 bits, for the sake of lrs: version 7.1 with 128-bit integers drops zeros in the middle of a number it prints, and this makes it
        // use GMP from the start.
        let mut long = system[0].clone();
        long.constant <<= 200;
        long.normal.iter_mut().for_each(|x| *x <<= 200);
        system.push(long);
        system
    }
}

/// The system as both programs read it: c before n in each row.
fn write<const D: usize>(path: &Path, rows: &[HalfSpace<D>]) {
    let mut text = format!("H-representation\nbegin\n{} {} integer\n", rows.len(), D + 1);
    for row in rows {
        write!(text, "{}", row.constant).unwrap();
        for number in &row.normal {
            write!(text, " {number}").unwrap();
        }
        text.push('\n');
    }
    text.push_str("end\n");
    std::fs::write(path, text).unwrap();
}

/// The vertices in the last V-representation: rows 1 x₁ … x_D between "begin" and "end". lrs puts remarks that start with '*' anywhere, and begins
/// anew when it changes to longer integers.
fn vertices<const D: usize>(text: &str) -> BTreeSet<[Rational; D]> {
    let last = text.rsplit("V-representation").next().expect("a V-representation");
    let lines = last.lines().map(str::trim).take_while(|line| *line != "end");
    let rows = lines.filter(|line| !line.is_empty() && !line.starts_with('*') && *line != "begin");
    // The size line of cddlib: rows, columns and the kind of number.
    let rows = rows.filter(|line| !line.ends_with("rational") && !line.ends_with("integer"));
    rows.map(|line| {
        let mut numbers = line.split_whitespace();
        assert_eq!(numbers.next(), Some("1"), "a vertex: {line}");
        std::array::from_fn(|_| Rational::parse_canonical(numbers.next().expect("a coordinate")).expect("a fraction"))
    })
    .collect()
}

fn compare<const D: usize>(program: &str, answer: impl Fn(&Path) -> String, systems: u64) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("system.ine");
    let mut most = 0;
    for seed in 0..systems {
        let mut random = Random(seed);
        let count = 1 + random.below(60) as usize;
        let rows = random.system::<D>(count);
        write(&path, &rows);
        let expected = vertices(&answer(&path));
        let Intersection::Bounded(polytope) = intersect(&rows) else {
            panic!("{program}, system {seed}: the origin is inside and a box around it");
        };
        let found: BTreeSet<[Rational; D]> = (0..polytope.vertex_count()).map(|i| polytope.vertex(i)).collect();
        assert_eq!(found.len(), polytope.vertex_count());
        assert_eq!(found, expected, "{program}, system {seed}");
        most = most.max(found.len());
    }
    assert!(most > 4 * D, "all systems were small");
}

fn installed(program: &str) -> bool {
    let found = std::env::var_os("PATH")
        .is_some_and(|path| std::env::split_paths(&path).any(|folder| folder.join(program).is_file()));
    if !found {
        eprintln!("skipped: {program} is not installed");
    }
    found
}

#[test]
fn vertices_as_lrs_finds_them() {
    if !installed("lrs") {
        return;
    }
    let answer = |path: &Path| {
        let output = Command::new("lrs").arg(path).output().expect("lrs runs");
        String::from_utf8(output.stdout).expect("text")
    };
    compare::<2>("lrs", answer, 60);
    compare::<3>("lrs", answer, 60);
}

#[test]
fn vertices_as_cddlib_finds_them() {
    if !installed("scdd_gmp") {
        return;
    }
    let answer = |path: &Path| {
        let output = Command::new("scdd_gmp").arg(path).output().expect("scdd_gmp runs");
        assert!(output.status.success());
        // Versions differ in whether they replace the extension.
        let name = [path.with_extension("ext"), path.with_extension("ine.ext")]
            .into_iter()
            .find(|name| name.is_file());
        std::fs::read_to_string(name.expect("a file of vertices")).expect("text")
    };
    compare::<2>("scdd_gmp", answer, 30);
    compare::<3>("scdd_gmp", answer, 30);
}
