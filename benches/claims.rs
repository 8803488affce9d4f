//! One run each of the claims embedding, curvature, thickness and deviation on named curves and a long chain: `cargo bench --bench claims` prints a table in
//! Markdown, times in ms, one thread.

mod curves;

use std::io::Cursor;
use std::time::Instant;

use curves::chains::Kind;
use curves::generated;
use knotproof::certificate::Encoding;
use knotproof::check::{Verdict, check};
use knotproof::claim::msd::Convention;
use knotproof::curve::{Curve, read_curve};
use knotproof::number::Rational;
use knotproof::prove::domain::write_checked;
use knotproof::prove::{curvature, deviation, embedding, thickness};

fn named(name: &str) -> Curve {
    let path = format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    read_curve(&text)
        .unwrap_or_else(|error| panic!("{path}: {error}"))
        .curve
}

fn width(exponent: i64) -> Rational {
    Rational::new(1.into(), 10i64.pow(exponent as u32).into())
}

/// The certificate in the binary form and what is to be told of it, or nothing if it was not found.
type Made = Option<(Vec<u8>, String)>;

/// Makes the certificate of a claim.
type Certify = fn(&Curve) -> Made;

fn embedded(curve: &Curve) -> Made {
    let options = embedding::Options {
        budget: None,
        name: None,
        snapped_joints: None,
    };
    let Ok(embedding::Outcome::Embedded(mut found)) = embedding::certify(curve, &options, &|_| ()) else {
        return None;
    };
    let mut file = Cursor::new(Vec::new());
    found.write_checked(Encoding::Binary, &mut file).ok()?;
    let edges = found.document.claim.statement.edges;
    Some((file.into_inner(), format!("{} leaves, {edges} edges", found.leaves)))
}

fn curved(curve: &Curve) -> Made {
    let options = curvature::Options {
        relative_width: width(9),
        name: None,
        snapped_joints: None,
    };
    let found = curvature::certify(curve, &options).ok()?.document?;
    let mut file = Cursor::new(Vec::new());
    write_checked(&found, Encoding::Binary, &mut file).ok()?;
    Some((file.into_inner(), String::new()))
}

fn thick(curve: &Curve) -> Made {
    let options = thickness::Options {
        convention: if curve.is_closed() {
            Convention::Smooth
        } else {
            Convention::Critical
        },
        relative_width: width(9),
        budget: None,
        name: None,
        snapped_joints: None,
    };
    let mut found = thickness::certify(curve, &options, &|_| ()).ok()?;
    found.document.as_ref()?;
    let mut file = Cursor::new(Vec::new());
    found.write_checked(Encoding::Binary, &mut file).ok()?;
    Some((file.into_inner(), format!("{} leaves", found.leaves)))
}

fn deviating(curve: &Curve) -> Made {
    let options = deviation::Options {
        subdivisions: 3,
        relative_width: width(6),
        name: None,
        snapped_joints: None,
    };
    let found = deviation::certify(curve, &options).ok()?;
    let mut file = Cursor::new(Vec::new());
    write_checked(&found.document?, Encoding::Binary, &mut file).ok()?;
    Some((file.into_inner(), format!("{} edges", found.edges)))
}

fn main() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build_global();
    pool.expect("the first pool");
    println!("| curve | claim | certified | checked | bytes | |");
    println!("| --- | --- | --- | --- | --- | --- |");
    let curves = [
        "mp06-figure-1",
        "trefoil-24",
        "degree-8",
        "nurbs-ellipse",
        "calpha-2000",
    ];
    let curves = curves.into_iter().map(|name| (name, named(name)));
    for (name, curve) in curves.chain([("generated, 20,000 pieces", generated(Kind::CAlpha, 20_000))]) {
        let claims: [(&str, Certify); 4] = [
            ("embedding", embedded),
            ("curvature", curved),
            ("thickness", thick),
            ("deviation, 3 subdivisions", deviating),
        ];
        for (claim, certify) in claims {
            let start = Instant::now();
            let Some((bytes, told)) = certify(&curve) else {
                println!("| {name} | {claim} | undecided or refused | | | |");
                continue;
            };
            let certified = start.elapsed().as_secs_f64();
            let start = Instant::now();
            assert!(
                matches!(check(bytes.as_slice()), Verdict::Accepted { .. }),
                "{name}, {claim}"
            );
            let checked = start.elapsed().as_secs_f64();
            println!(
                "| {name} | {claim} | {:.2} | {:.2} | {} | {told} |",
                1e3 * certified,
                1e3 * checked,
                bytes.len()
            );
        }
    }
}
