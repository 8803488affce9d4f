//! Rust engines side by side: points, knot insertion, the shortest double normal.
//!
//! Groups are named as the columns of `run.py`. Every engine gets the same curves and parameters, in the form that is its fastest.

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use knotproof::float::{BezierEvaluator, Evaluator};
use knotproof_engine_benches::{Input, inputs};
use kurbo::ParamCurve;
use truck_geometry::prelude::{ParametricCurve, Point3};

/// Parameters of a group of single points.
const SINGLE: usize = 1_000;
/// Parameters of a batch.
const BATCH: usize = 100_000;

fn each<R>(group: &mut BenchmarkGroup<'_, WallTime>, engine: &str, parameters: &[f64], mut point: impl FnMut(f64) -> R) {
    group.bench_function(engine, |b| {
        b.iter(|| {
            for t in parameters {
                black_box(point(black_box(*t)));
            }
        });
    });
}

fn ours(group: &mut BenchmarkGroup<'_, WallTime>, input: &Input, parameters: &[f64]) {
    let curve = input.knotproof();
    let evaluator = Evaluator::new(&curve);
    each(group, "knotproof, prepared", parameters, |t| evaluator.point(t).expect("inside"));
    each(group, "knotproof, correctly rounded", parameters, |t| curve.point(t).expect("inside"));
}

fn points(criterion: &mut Criterion) {
    let inputs = inputs();
    for (name, input) in &inputs {
        let parameters = input.parameters(SINGLE);
        let mut group = criterion.benchmark_group(format!("point {name}"));
        group.throughput(Throughput::Elements(SINGLE as u64));
        ours(&mut group, input, &parameters);
        if input.degree == 3 && input.points.len() == 4 {
            let curve = input.kurbo();
            each(&mut group, "kurbo", &parameters, |t| black_box(&curve).eval(t));
            let cubic = BezierEvaluator::<4, 2>::new(&input.knotproof()).expect("a plane cubic");
            each(&mut group, "knotproof, cubic", &parameters, |t| black_box(&cubic).point(t).expect("inside"));
        }
        if input.is_planar() {
            let curve = input.curvo_2();
            let mut evaluator = curve.evaluator();
            each(&mut group, "curvo", &parameters, |t| evaluator.point_at(t));
        } else {
            let curve = input.curvo_3();
            let mut evaluator = curve.evaluator();
            each(&mut group, "curvo", &parameters, |t| evaluator.point_at(t));
        }
        match (input.is_planar(), &input.weights) {
            (true, None) => {
                let curve = input.truck_2();
                each(&mut group, "truck", &parameters, |t| curve.subs(t));
            }
            (true, Some(_)) => {
                let curve = input.truck_nurbs();
                each(&mut group, "truck", &parameters, |t| curve.subs(t));
            }
            _ => {
                let curve = input.truck_3();
                each(&mut group, "truck", &parameters, |t| curve.subs(t));
            }
        }
        group.finish();
    }
}

fn batches(criterion: &mut Criterion) {
    let inputs = inputs();
    for name in ["cubic", "mp06"] {
        let input = &inputs[name];
        let mut parameters = input.parameters(BATCH);
        parameters.sort_by(f64::total_cmp);
        let mut group = criterion.benchmark_group(format!("batch {name}"));
        group.throughput(Throughput::Elements(BATCH as u64)).sample_size(20);
        let curve = input.knotproof();
        let mut flat = vec![0.0; BATCH * curve.dimension()];
        group.bench_function("knotproof, prepared", |b| {
            b.iter(|| Evaluator::new(black_box(&curve)).points_at(&parameters, black_box(&mut flat)).expect("inside"));
        });
        if input.is_planar() {
            let cubic = BezierEvaluator::<4, 2>::new(&curve).expect("a plane cubic");
            let mut found = vec![[0.0; 2]; BATCH];
            group.bench_function("knotproof, cubic", |b| {
                b.iter(|| black_box(&cubic).points_at(&parameters, black_box(&mut found)).expect("inside"));
            });
            let curve = input.kurbo();
            let mut found = vec![kurbo::Point::ZERO; BATCH];
            group.bench_function("kurbo", |b| {
                b.iter(|| {
                    let curve = black_box(&curve);
                    for (point, t) in black_box(&mut found).iter_mut().zip(&parameters) {
                        *point = curve.eval(*t);
                    }
                });
            });
        } else {
            let curve = input.curvo_3();
            let mut found = vec![nalgebra::Point3::origin(); BATCH];
            group.bench_function("curvo", |b| {
                b.iter(|| {
                    let mut evaluator = black_box(&curve).evaluator();
                    for (point, t) in black_box(&mut found).iter_mut().zip(&parameters) {
                        *point = evaluator.point_at(*t);
                    }
                });
            });
            let curve = input.truck_3();
            let mut found = vec![Point3::new(0.0, 0.0, 0.0); BATCH];
            group.bench_function("truck", |b| {
                b.iter(|| {
                    let curve = black_box(&curve);
                    for (point, t) in black_box(&mut found).iter_mut().zip(&parameters) {
                        *point = curve.subs(*t);
                    }
                });
            });
        }
        group.finish();
    }
}

/// A new curve with one knot more: engines that change a curve in place get a copy of it.
fn insertion(criterion: &mut Criterion) {
    let inputs = inputs();
    for (name, t) in [("mp06", 0.5), ("long", 41.5)] {
        let input = &inputs[name];
        let mut group = criterion.benchmark_group(format!("insertion {name}"));
        let curve = input.knotproof();
        group.bench_function("knotproof", |b| {
            b.iter(|| black_box(&curve).insert_knot(black_box(t), 1).expect("inserted"));
        });
        let curve = input.curvo_3();
        group.bench_function("curvo", |b| {
            b.iter(|| {
                let mut copy = black_box(&curve).clone();
                copy.try_add_knot(black_box(t)).expect("inserted");
                copy
            });
        });
        let curve = input.truck_3();
        group.bench_function("truck", |b| {
            b.iter(|| {
                let mut copy = black_box(&curve).clone();
                copy.add_knot(black_box(t));
                copy
            });
        });
        group.finish();
    }
}

fn separation(criterion: &mut Criterion) {
    let curve = inputs()["mp06"].knotproof();
    let mut group = criterion.benchmark_group("msd mp06");
    group.bench_function("knotproof", |b| {
        b.iter(|| black_box(&curve).minimum_separation().expect("found"))
    });
    group.finish();
}

criterion_group!(benches, points, batches, insertion, separation);
criterion_main!(benches);
