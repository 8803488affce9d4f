//! Frames a second of a moving curve, proved embedded at and between all of them: `cargo bench --bench motion` prints a table in Markdown. One thread.
//!
//! A closed C¹ chain of 2,000 random cubic pieces moves for 1,000 frames, each joint with its two neighbours, so that it stays C¹; the tree of the first frame holds
//! throughout. `in memory`: positions and leaves alone. `certificate`: the whole file in the binary form is checked, with reading, hashing and the criteria.

mod curves;

use std::io::Cursor;
use std::time::Instant;

use curves::chains::{Kind, SplitMix64};
use curves::generated;
use knotproof::certificate::{Document, Encoding, MotionHash, read, write};
use knotproof::check::motion::{Moved, Positions, Shape, Table};
use knotproof::check::{Verdict, check};
use knotproof::claim::motion::{Content, Event, Evidence, Move, Statement, Track, TrackKind, write_event};
use knotproof::claim::tree::{TokenSource, write_token};
use knotproof::curve::Curve;
use knotproof::number::{Integer, Rational};
use knotproof::prove::embedding;

const PIECES: usize = 2_000;
const FRAMES: usize = 1_000;
/// Displacements are in millionths.
const DENOMINATOR: i64 = 1_000_000;

/// The tokens of a tree for the first frame.
fn tree(curve: &Curve) -> Vec<u8> {
    let options = embedding::Options::default();
    let Ok(embedding::Outcome::Embedded(mut found)) = embedding::certify(curve, &options, &|_| ()) else {
        panic!("the chain is embedded")
    };
    let mut file = Vec::new();
    found
        .write(Encoding::Binary, &mut file)
        .expect("memory takes all bytes");
    let (_, mut tokens) = read(Cursor::new(file)).expect("a certificate");
    let mut tree = Vec::new();
    while let Some(token) = tokens.next_token().expect("a token") {
        write_token(&token, 3, &mut tree);
    }
    tree
}

/// A move of the joints numbered `joints`, each with the points beside it, by their vectors times `sign`.
fn displacements(joints: impl Iterator<Item = usize>, vectors: &[[i64; 3]], sign: i64) -> Move {
    let count = 3 * PIECES;
    let mut points: Vec<(usize, [i64; 3])> = joints
        .flat_map(|joint| [count - 1, 0, 1].map(|by| ((3 * joint + by) % count, vectors[joint])))
        .filter(|(_, vector)| *vector != [0; 3])
        .collect();
    points.sort_unstable();
    let mut made = Move::new();
    for (point, vector) in points {
        let vector = vector.map(|x| Integer::from(sign * x));
        made.push(point as u64, vector).expect("in order and not zero");
    }
    made
}

/// There and back twice.
fn sign(frame: usize) -> i64 {
    if (frame / (FRAMES / 4)).is_multiple_of(2) {
        1
    } else {
        -1
    }
}

fn in_memory(curve: &Curve, tree: &[u8], moves: &[Move]) -> f64 {
    let mut positions = Positions::new(curve, &DENOMINATOR.into()).expect("thousandths");
    let mut table = Table::new(Shape::new(curve));
    let mut tokens = knotproof::claim::tree::BinaryTokens::new(tree, 3);
    table.plant(&positions, &mut tokens).expect("a tree of the first frame");
    let start = Instant::now();
    for (frame, displacements) in moves.iter().enumerate() {
        positions.apply(displacements).expect("points of the curve");
        assert_eq!(
            table.check(&positions, Moved::By(displacements)),
            None,
            "frame {}",
            frame + 1
        );
    }
    start.elapsed().as_secs_f64()
}

fn certificate(curve: &Curve, tree: &[u8], moves: &[Move]) -> Vec<u8> {
    let denominator = Integer::from(DENOMINATOR);
    let mut hash = MotionHash::new(curve, &denominator);
    let mut events = Vec::new();
    write_event(&Event::Tree(TrackKind::Curve), 3, &mut events);
    events.extend_from_slice(tree);
    for displacements in moves {
        hash.include(displacements);
        write_event(&Event::Step(displacements.clone()), 3, &mut events);
    }
    let statement = Statement {
        steps: moves.len() as u64,
        denominator,
        motion_sha256: hash.finish(),
        curve: Some(Track {
            embedded_through: Rational::from_integer(moves.len().into()),
            meets_by: None,
        }),
        polygon: None,
        criteria: None,
    };
    let document = Document {
        tool: "bench".into(),
        name: None,
        snapped_joints: None,
        curve: std::borrow::Cow::Borrowed(curve),
        claim: Content {
            statement,
            evidence: Evidence::default(),
        },
    };
    let mut file = Vec::new();
    write(&document, events.as_slice(), Encoding::Binary, &mut file).expect("memory takes all bytes");
    file
}

fn main() {
    let curve = generated(Kind::ClosedPolygon, PIECES);
    let tree = tree(&curve);
    let mut random = SplitMix64::new(7);
    let vectors: Vec<[i64; 3]> = (0..PIECES)
        .map(|_| [0; 3].map(|_| (random.next_u64() % 7) as i64 - 3))
        .collect();
    let all: Vec<Move> = (0..FRAMES)
        .map(|frame| displacements(0..PIECES, &vectors, sign(frame)))
        .collect();
    // Another three joints in every frame of the way there, and the same on the way back.
    let few: Vec<Move> = (0..FRAMES)
        .map(|frame| {
            let quarter = FRAMES / 4;
            let step = if sign(frame) > 0 {
                frame % quarter
            } else {
                quarter - 1 - frame % quarter
            };
            displacements(
                [0, 1, 2].map(|i| (step * 7 + i * 600) % PIECES).into_iter(),
                &vectors,
                sign(frame),
            )
        })
        .collect();
    println!("| motion | frames | in memory, s | frames a second | certificate, s | frames a second | bytes |");
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for (name, moves) in [("all points move", &all), ("9 points move", &few)] {
        let memory = in_memory(&curve, &tree, moves);
        let file = certificate(&curve, &tree, moves);
        let start = Instant::now();
        let verdict = check(file.as_slice());
        let checked = start.elapsed().as_secs_f64();
        assert!(matches!(verdict, Verdict::Accepted { .. }), "{name}: {verdict:?}");
        let frames = moves.len() as f64;
        println!(
            "| {name} | {} | {memory:.4} | {:.0} | {checked:.4} | {:.0} | {} |",
            moves.len(),
            frames / memory,
            frames / checked,
            file.len()
        );
    }
}
