//! One run each of growing chains, with the greatest memory so far: `cargo bench --bench scale -- [pieces…]` (default 2,000, 20,000,
//! 200,000 and 1,000,000), one thread.

mod curves;

use std::time::Instant;

use curves::chains::Kind;
use curves::generated;
use knotproof::certificate::Encoding;
use knotproof::check::{Verdict, check};
use knotproof::prove::msd::{Options, certify};

/// The greatest resident memory so far in MiB, where the system tells.
fn memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    line.split_whitespace()
        .nth(1)?
        .parse::<u64>()
        .ok()
        .map(|kibibytes| kibibytes / 1024)
}

fn main() {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()
        .expect("the first pool");
    let asked: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let sizes = if asked.is_empty() {
        vec![2_000, 20_000, 200_000, 1_000_000]
    } else {
        asked
    };
    println!("| pieces | leaves | certify s | write and self-check s | check s | bytes | memory MiB |");
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for pieces in sizes {
        let curve = generated(Kind::CAlpha, pieces);
        let mut file = tempfile::tempfile().expect("a temporary file");
        let start = Instant::now();
        let mut certified = certify(&curve, &Options::default(), &|_| ()).expect("certified");
        let searched = start.elapsed().as_secs_f64();
        certified.write_checked(Encoding::Binary, &mut file).expect("accepted");
        let written = start.elapsed().as_secs_f64() - searched;
        let bytes = file.metadata().expect("a file").len();
        std::io::Seek::rewind(&mut file).expect("a file");
        let start = Instant::now();
        assert!(matches!(check(&mut file), Verdict::Accepted { .. }));
        let checked = start.elapsed().as_secs_f64();
        let memory = memory().map_or("—".into(), |mebibytes| mebibytes.to_string());
        println!(
            "| {pieces} | {} | {searched:.4} | {written:.4} | {checked:.4} | {bytes} | {memory} |",
            certified.leaves
        );
    }
}
