//! The binary64 engine: points one by one and in batches, knot insertion, the minimum separation; `kurbo` beside it where it offers the same.
//!
//! `cargo bench --bench float`.

#![allow(missing_docs)] // the group that criterion's macro makes

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use knotproof::curve::read_curve;
use knotproof::float::{Comparison, Curve, DoublyNormalTest, Evaluator};
use kurbo::{CubicBez, ParamCurve, Point};

/// A clamped spline with knots 0, 1, …, `spans` on a wavy line.
fn spline(dimension: usize, degree: usize, spans: usize) -> Curve {
    let mut knots = vec![0.0; degree];
    knots.extend((0..=spans).map(|k| k as f64));
    knots.extend(vec![spans as f64; degree]);
    let count = knots.len() - degree - 1;
    let points = (0..count)
        .flat_map(|i| [i as f64, (i as f64).sin(), (2 * i) as f64][..dimension].to_vec())
        .collect();
    Curve::new(dimension, degree, knots, points, None).expect("a curve")
}

fn points(criterion: &mut Criterion) {
    let count = 1000;
    let unit: Vec<f64> = (0..count).map(|i| f64::from(i) / 1000.0).collect();
    let mut group = criterion.benchmark_group("1000 points");
    group.throughput(Throughput::Elements(1000));

    let cubic = spline(2, 3, 1);
    let p: Vec<Point> = cubic.points().chunks(2).map(|p| Point::new(p[0], p[1])).collect();
    let same = CubicBez::new(p[0], p[1], p[2], p[3]);
    group.bench_function("plane cubic, kurbo", |b| {
        b.iter(|| {
            for t in &unit {
                black_box(black_box(&same).eval(*t));
            }
        });
    });
    let evaluator = Evaluator::new(&cubic);
    group.bench_function("plane cubic, prepared", |b| {
        b.iter(|| {
            for t in &unit {
                black_box(black_box(&evaluator).point(*t)).expect("inside");
            }
        });
    });
    group.bench_function("plane cubic, double-double", |b| {
        b.iter(|| {
            for t in &unit {
                black_box(black_box(&cubic).point(*t)).expect("inside");
            }
        });
    });
    let long = spline(3, 3, 100);
    let over: Vec<f64> = unit.iter().map(|t| 100.0 * t).collect();
    let mut result = vec![0.0; 3000];
    group.bench_function("space cubic of 100 spans, batch", |b| {
        b.iter(|| {
            black_box(&long)
                .points_at(&over, black_box(&mut result))
                .expect("inside")
        });
    });
    group.finish();
}

fn structure(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("structure");
    let long = spline(3, 3, 100);
    group.bench_function("insert a knot, space cubic of 100 spans", |b| {
        b.iter(|| black_box(&long).insert_knot(black_box(41.5), 1).expect("inserted"));
    });
    let short = spline(3, 3, 5);
    group.bench_function("insert a knot, space cubic of 5 spans", |b| {
        b.iter(|| black_box(&short).insert_knot(black_box(2.5), 1).expect("inserted"));
    });
    group.bench_function("elevate, space cubic of 5 spans", |b| {
        b.iter(|| black_box(&short).elevate_degree(1).expect("elevated"));
    });
    group.finish();
}

fn separation(criterion: &mut Criterion) {
    let text = std::fs::read_to_string(format!(
        "{}/certs/curves/mp06-figure-1.json",
        env!("CARGO_MANIFEST_DIR")
    ));
    let curve = read_curve(text.expect("the curve").as_bytes()).expect("a curve").curve;
    let curve = Curve::from_exact(&curve).expect("a curve");
    let mut group = criterion.benchmark_group("MP06");
    group.bench_function("minimum separation", |b| {
        b.iter(|| black_box(&curve).minimum_separation())
    });
    let test = DoublyNormalTest {
        samples: 10,
        first: 0.4,
        second: 0.4,
        comparison: Comparison::Magnitude,
    };
    group.bench_function("Newton from 9 by 9 samples, as printed", |b| {
        b.iter(|| black_box(&curve).newton_separation(&test, 1e-4));
    });
    group.finish();
}

criterion_group!(benches, points, structure, separation);
criterion_main!(benches);
