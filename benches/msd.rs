//! Search, exact self-check and writing of a certificate, and checking alone; one thread.
//!
//! `cargo bench --bench msd`. The curves are A, B, C, D, F, W, Wr of docs/BENCHMARKS.md.

#![allow(missing_docs)] // the group that criterion's macro makes

mod curves;

use std::hint::black_box;
use std::io::Cursor;
use std::path::Path;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use curves::chains::Kind;
use curves::{file, generated};
use knotproof::certificate::Encoding;
use knotproof::check::{Verdict, check};
use knotproof::curve::Curve;
use knotproof::prove::msd::{Options, Status, certify};

/// Search, writing, and the exact replay of what was written, in memory.
fn certify_and_replay(curve: &Curve) {
    let mut certified = certify(curve, &Options::default(), &|_| ()).expect("written");
    assert_eq!(certified.status, Status::Certified);
    let mut file = Cursor::new(Vec::new());
    certified.write_checked(Encoding::Binary, &mut file).expect("accepted");
    black_box(file);
}

/// The same by way of a temporary file that is renamed in the end, as `certify msd -o` does it, but for waiting until the file is on the disk.
fn certify_to_file(curve: &Curve, target: &Path) {
    let mut certified = certify(curve, &Options::default(), &|_| ()).expect("written");
    assert_eq!(certified.status, Status::Certified);
    let directory = target.parent().expect("a directory");
    let mut file = tempfile::NamedTempFile::new_in(directory).expect("a temporary file");
    certified
        .write_checked(Encoding::Binary, file.as_file_mut())
        .expect("accepted");
    file.persist(target).expect("renamed");
}

fn accepted(certificate: &[u8]) {
    let verdict = check(Cursor::new(certificate));
    assert!(matches!(black_box(verdict), Verdict::Accepted { .. }));
}

fn benches(criterion: &mut Criterion) {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()
        .expect("the first pool");
    let directory = tempfile::tempdir().expect("a directory");
    let curves = [
        ("A mp06", file("mp06-figure-1")),
        ("B trefoil", file("trefoil-24")),
        ("D degree 8", file("degree-8")),
        ("C closed polygon 200", generated(Kind::ClosedPolygon, 200)),
        ("F C-alpha chain 2000", generated(Kind::CAlpha, 2000)),
        ("W 53 bits 20000", generated(Kind::FullPrecision, 20_000)),
        ("Wr 2^-20 grid 20000", generated(Kind::BinaryGrid, 20_000)),
    ];
    for (name, curve) in &curves {
        let mut group = criterion.benchmark_group(*name);
        group.sample_size(10);
        group.bench_function("certify, write, self-check", |bencher| {
            bencher.iter(|| certify_and_replay(curve))
        });
        let target = directory.path().join("bench.cert");
        group.bench_function("certify to a new file", |bencher| {
            bencher.iter_batched(
                || {
                    // There may be none.
                    let _ = std::fs::remove_file(&target);
                },
                |()| certify_to_file(curve, &target),
                BatchSize::PerIteration,
            )
        });
        // Some file systems take much longer to put a file in the place of another.
        group.bench_function("certify in place of a file", |bencher| {
            bencher.iter(|| certify_to_file(curve, &target))
        });
        let mut certificate = Vec::new();
        certify(curve, &Options::default(), &|_| ())
            .expect("certified")
            .write(Encoding::Binary, &mut certificate)
            .expect("written");
        group.bench_function("check", |bencher| bencher.iter(|| accepted(&certificate)));
        group.finish();
    }
}

criterion_group!(msd, benches);
criterion_main!(msd);
