//! Intersections of half-spaces as convex domains give them, with the measure enclosed to 40 bits; one thread.
//!
//! `cargo bench --bench polytope`. With `-- --write FOLDER` it writes the systems instead, one file each for other programs: a line with the
//! dimension and the number of rows, a line with a point of the interior, then the rows n₁ … n_D c of n·x + c ≥ 0; and prints name, rows, vertices, facets and seconds, the least of some runs, as a table.

#![allow(missing_docs)] // the group that criterion's macro makes

#[path = "polytope/systems.rs"]
mod systems;

use std::fmt::Write as _;
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group};
use knotproof::number::{Rational, RationalExt};
use knotproof::polytope::{HalfSpace, Intersection, Polytope, intersect};
use systems::Case;

const PLANAR: [Case<2>; 1] = [Case {
    name: "2h, level 7",
    points: [[1, -2], [3, 5], [-15, -16], [13, 10], [-15, -9], [9, -5]],
    free: 2,
    level: 7,
}];

const SPATIAL: [[i64; 3]; 6] = [
    [18, -1, -15],
    [-16, -13, -2],
    [3, -17, 4],
    [13, 17, -16],
    [-20, 11, -20],
    [10, 3, 7],
];

const SPATIAL_MANY: [[i64; 3]; 6] = [
    [-3, -3, -11],
    [4, -8, -15],
    [5, -4, -17],
    [0, -6, -8],
    [-4, -7, -16],
    [18, -2, -4],
];

const SPACE: [Case<3>; 3] = [
    Case {
        name: "3, level 5",
        points: SPATIAL,
        free: 2,
        level: 5,
    },
    Case {
        name: "3, level 7",
        points: SPATIAL,
        free: 2,
        level: 7,
    },
    Case {
        name: "3h, level 7",
        points: SPATIAL_MANY,
        free: 2,
        level: 7,
    },
];

fn whole<const D: usize>(rows: &[HalfSpace<D>]) -> Polytope<D> {
    let Intersection::Bounded(polytope) = intersect(rows) else {
        panic!("a bounded polytope was expected");
    };
    black_box(polytope.measure_enclosure(40));
    polytope
}

fn bench<const D: usize>(criterion: &mut Criterion, cases: &[Case<D>]) {
    for case in cases {
        let rows = case.rows();
        criterion.bench_function(case.name, |bencher| bencher.iter(|| whole(black_box(&rows))));
    }
}

fn benches(criterion: &mut Criterion) {
    bench(criterion, &PLANAR);
    bench(criterion, &SPACE);
}

criterion_group! {
    name = group;
    config = Criterion::default().sample_size(20).measurement_time(Duration::from_secs(3));
    targets = benches
}

/// A point of the interior with short coordinates: the mean of the vertices in binary64.
fn inside<const D: usize>(polytope: &Polytope<D>) -> String {
    let count = polytope.vertex_count();
    let mean = |i: usize| {
        (0..count)
            .map(|vertex| polytope.vertex_approximation(vertex).0[i])
            .sum::<f64>()
            / count as f64
    };
    let exact = (0..D).map(|i| Rational::from_f64(mean(i)).expect("finite").to_string());
    exact.collect::<Vec<_>>().join(" ")
}

fn write<const D: usize>(folder: &Path, cases: &[Case<D>]) {
    for case in cases {
        let rows = case.rows();
        let mut text = format!("{D} {}\n{}\n", rows.len(), inside(&whole(&rows)));
        for row in &rows {
            for number in &row.normal {
                write!(text, "{number} ").expect("a string takes all");
            }
            writeln!(text, "{}", row.constant).expect("a string takes all");
        }
        let file = case.name.replace(", level ", "-");
        std::fs::write(folder.join(format!("{file}.rows")), text).expect("written");
        let mut least = f64::INFINITY;
        let mut counts = (0, 0);
        for _ in 0..20 {
            let start = Instant::now();
            let polytope = whole(&rows);
            least = least.min(start.elapsed().as_secs_f64());
            counts = (polytope.vertex_count(), polytope.facet_count());
        }
        println!("{file}\t{}\t{}\t{}\t{least:.6}", rows.len(), counts.0, counts.1);
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(at) = arguments.iter().position(|argument| argument == "--write") {
        let folder = arguments.get(at + 1).expect("--write FOLDER");
        write(Path::new(folder), &PLANAR);
        write(Path::new(folder), &SPACE);
        return;
    }
    group();
    Criterion::default().configure_from_args().final_summary();
}
