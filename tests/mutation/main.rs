//! Mutations: every field, token and integer of small certificates changed in turn, and every byte of binary ones. What is still
//! accepted must be true, by recomputation; and the second checker must agree.
#![cfg(feature = "prove")]

mod bend;
#[path = "../common/mod.rs"]
mod common;
mod half_plane;
mod motion;
mod operations;
#[path = "../rules/subjects/mod.rs"]
mod subjects;
mod truth;
mod values;

use std::collections::BTreeSet;

use common::document::Certificate;
use common::python;
use knotproof::certificate::Document;
use knotproof::check::{Verdict, check};
use knotproof::claim::msd::{Convention, Lower, Statement};
use knotproof::curve::{Bezier, Curve, Form};
use knotproof::number::{Rational, RationalVector};
use knotproof::prove::embedding;
use knotproof::prove::msd::{Options, certify};
use truth::{Enclosure, is_true, recomputed, zero};
use values::{other_values, pointers};

/// Is what a document states true?
type Truth = Box<dyn Fn(&Document) -> bool>;

/// What became of the mutants of one certificate.
struct Tally {
    name: String,
    truth: Truth,
    accepted: Vec<Vec<u8>>,
    rejected: Vec<Vec<u8>>,
}

fn statement_of<'d>(document: &'d Document) -> &'d Statement {
    &document.claim.msd().expect("a certificate of the claim msd").statement
}

/// The truth about σ: what is known of the original's curve in both conventions, and by recomputation of any other curve.
fn truth_of_msd(original: &[u8], known: [Enclosure; 2]) -> Truth {
    let Verdict::Accepted { document: original, .. } = check(original) else {
        panic!("the original is accepted")
    };
    Box::new(move |document| {
        let Some(content) = document.claim.msd() else {
            return false;
        };
        let statement = &content.statement;
        if document.curve == original.curve {
            is_true(
                statement,
                &known[usize::from(statement.convention == Convention::Critical)],
            )
        } else {
            is_true(statement, &recomputed(&document.curve, statement.convention))
        }
    })
}

impl Tally {
    fn new(name: &str, bytes: &[u8], truth: Truth) -> Self {
        let Verdict::Accepted { document, .. } = check(bytes) else {
            panic!("{name} is accepted")
        };
        assert!(truth(&document), "{name} itself");
        Tally {
            name: name.into(),
            truth,
            accepted: Vec::new(),
            rejected: Vec::new(),
        }
    }

    fn judge(&mut self, bytes: Vec<u8>, what: &str) {
        match check(bytes.as_slice()) {
            Verdict::Accepted { document, .. } => {
                let found = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| (self.truth)(&document)));
                let true_again =
                    found.unwrap_or_else(|_| panic!("{}: {what}: {}", self.name, String::from_utf8_lossy(&bytes)));
                assert!(
                    true_again,
                    "{}: {what} is accepted and false: {:?}",
                    self.name, document.claim
                );
                self.accepted.push(bytes);
            }
            Verdict::Malformed(_) | Verdict::Rejected { .. } => self.rejected.push(bytes),
        }
    }

    /// The second checker on all accepted mutants and on one in `sample` of the rejected.
    fn agree(self, sample: usize) {
        let (accepted, rejected) = (self.accepted.len(), self.rejected.len());
        let few: Vec<&[u8]> = self.rejected.iter().step_by(sample).map(Vec::as_slice).collect();
        let all: Vec<&[u8]> = self.accepted.iter().map(Vec::as_slice).chain(few).collect();
        for (i, answer) in python::check_bytes(&all).into_iter().enumerate() {
            assert_eq!(
                answer.accepted,
                i < accepted,
                "{}: {}\n{}",
                self.name,
                answer.reason,
                String::from_utf8_lossy(all[i])
            );
        }
        assert!(
            rejected > 4 * accepted / 3,
            "{}: {accepted} of {} mutants accepted",
            self.name,
            accepted + rejected
        );
    }
}

fn mutate_json(tally: &mut Tally, certificate: &Certificate) {
    let mut places = Vec::new();
    pointers(&certificate.0, "", &mut places);
    for pointer in places {
        let value = certificate.0.pointer(&pointer).expect("there");
        for other in other_values(value) {
            let what = format!("{pointer}: {}", other.to_string().chars().take(80).collect::<String>());
            let mutant = certificate.clone().with(&pointer, other);
            if pointer.starts_with("/curve/") {
                tally.judge(mutant.clone().rehashed().json(), &what);
            }
            tally.judge(mutant.json(), &what);
        }
    }
    exchange(tally, certificate);
}

/// Fields of two places exchanged.
fn exchange(tally: &mut Tally, certificate: &Certificate) {
    let upper = &certificate.0["evidence"]["upper"];
    for (a, b) in [("s", "t"), ("first", "second"), ("s_side", "t_side")] {
        if upper.get(a).is_some() && upper.get(b).is_some() {
            let exchanged = certificate.clone();
            let mutant = exchanged
                .with(&format!("/evidence/upper/{a}"), upper[b].clone())
                .with(&format!("/evidence/upper/{b}"), upper[a].clone());
            if mutant != *certificate {
                tally.judge(mutant.json(), &format!("{a} and {b} exchanged"));
            }
        }
    }
}

fn mutate_bytes(tally: &mut Tally, bytes: &[u8]) {
    mutated_bytes(bytes, &mut |mutant, what| tally.judge(mutant, what));
}

/// Every byte changed, dropped, doubled, exchanged with the next, and the file cut there.
fn mutated_bytes(bytes: &[u8], judge: &mut dyn FnMut(Vec<u8>, &str)) {
    for (i, byte) in bytes.iter().enumerate() {
        let others: BTreeSet<u8> = [
            byte ^ 1,
            byte ^ 2,
            byte ^ 0x10,
            byte ^ 0x80,
            byte.wrapping_add(1),
            byte.wrapping_sub(1),
            0,
            0xff,
            0x20,
        ]
        .into();
        for other in others.into_iter().filter(|other| other != byte) {
            let mut mutant = bytes.to_vec();
            mutant[i] = other;
            judge(mutant, &format!("byte {i} as {other:#x}"));
        }
        let mut dropped = bytes.to_vec();
        dropped.remove(i);
        judge(dropped, &format!("byte {i} dropped"));
        let mut doubled = bytes.to_vec();
        doubled.insert(i, *byte);
        judge(doubled, &format!("byte {i} doubled"));
        judge(bytes[..i].to_vec(), &format!("cut at byte {i}"));
        if i > 0 && bytes[i - 1] != *byte {
            let mut exchanged = bytes.to_vec();
            exchanged.swap(i - 1, i);
            judge(exchanged, &format!("bytes {} and {i} exchanged", i - 1));
        }
    }
}

/// σ² of the certificate's curve in both conventions, recomputed.
fn both(bytes: &[u8]) -> [Enclosure; 2] {
    let Verdict::Accepted { document, .. } = check(bytes) else {
        panic!("accepted")
    };
    [Convention::Smooth, Convention::Critical].map(|convention| recomputed(&document.curve, convention))
}

fn exactly(squared: i64) -> [Enclosure; 2] {
    let squared = Some(Rational::from_integer(squared.into()));
    [0, 1].map(|_| Enclosure {
        lower: squared.clone(),
        upper: squared.clone(),
    })
}

fn run(name: &str, certificate: &Certificate, known: Option<[Enclosure; 2]>, sample: usize) {
    let bytes = certificate.json();
    let known = known.unwrap_or_else(|| both(&bytes));
    let mut tally = Tally::new(name, &bytes, truth_of_msd(&bytes, known));
    mutate_json(&mut tally, certificate);
    tally.agree(sample);
}

fn run_binary(name: &str, certificate: &Certificate, sample: usize) {
    let bytes = certificate.binary();
    let mut tally = Tally::new(name, &bytes, truth_of_msd(&bytes, both(&bytes)));
    mutate_bytes(&mut tally, &bytes);
    tally.agree(sample);
}

/// The accepted hand-made case of a subject.
fn hand_made(subject: &str, name: &str) -> Certificate {
    let (_, cases) = subjects::all()
        .into_iter()
        .find(|(listed, _)| *listed == subject)
        .expect(subject);
    let case = cases()
        .into_iter()
        .find(|case| case.accepted() && case.name == name)
        .expect(name);
    Certificate::of_bytes(&case.bytes)
}

/// What the prover writes about an example curve.
fn proved(curve: &str, convention: Convention, digits: u32) -> Certificate {
    let path = common::case::certs().join("curves").join(curve);
    let curve = knotproof::curve::read_curve(std::fs::read(path).expect(curve))
        .expect(curve)
        .curve;
    let relative_width = Rational::new(1.into(), knotproof::number::Integer::from(10).pow(digits));
    let options = Options {
        convention,
        relative_width,
        budget: Some(3000),
        ..Options::default()
    };
    let mut found = certify(&curve, &options, &|_| ()).expect("certifies");
    let mut bytes = Vec::new();
    found
        .write(knotproof::certificate::Encoding::Json, &mut bytes)
        .expect("writes to memory");
    Certificate::of_bytes(&bytes)
}

/// The truth about the embedding, by searching anew: the curve is embedded, and so it is after moves of all coordinates by nearly the radius, up
/// or down by chance.
fn is_embedded(document: &Document) -> bool {
    let Some(content) = document.claim.embedding() else {
        return false;
    };
    let radius = &content.statement.perturbation_radius;
    let Form::Bezier(pieces) = document.curve.form() else {
        panic!("these certificates are about Bézier pieces")
    };
    let proved = |curve: &Curve| {
        let found = embedding::certify(curve, &embedding::Options::default(), &|_| ());
        matches!(found, Ok(embedding::Outcome::Embedded(_)))
    };
    let dimension = document.curve.dimension();
    let moves = |seed: u64| {
        let mut state = seed;
        let mut vertex = || -> Vec<Rational> {
            let mut coordinate = || {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                let sign = if state >> 63 == 0 { 1 } else { -1 };
                Rational::new((999 * sign).into(), 1000.into())
            };
            let step = (0..dimension).map(|_| coordinate());
            step.collect()
        };
        let first = vertex();
        let mut last = first.clone();
        let count = pieces.len();
        let moved = pieces.iter().enumerate().map(|(i, piece)| {
            let mut steps = vec![last.clone()];
            steps.extend((0..piece.degree()).map(|_| vertex()));
            if i + 1 == count && document.curve.is_closed() {
                *steps.last_mut().expect("a point") = first.clone();
            }
            last = steps.last().expect("a point").clone();
            let coordinates = piece.points().iter().zip(steps.iter().flatten());
            let coordinates: Vec<Rational> = coordinates.map(|(x, step)| x + step * &radius.infinity).collect();
            Bezier::new(
                dimension,
                RationalVector::from_rationals(&coordinates),
                piece.weights().cloned(),
            )
        });
        let moved: Vec<Bezier> = moved.collect::<Result<_, _>>().expect("pieces");
        Curve::new(dimension, Form::Bezier(moved)).expect("a curve")
    };
    let nothing = Rational::from_integer(0.into());
    proved(&document.curve) && (radius.infinity == nothing || (1..=4).all(|seed| proved(&moves(seed))))
}

#[test]
fn embeddings() {
    for (subject, name) in [
        ("embedding", "channel"),
        ("embedding", "square"),
        ("monotone", "rational"),
        ("monotone", "sharp-corner"),
        ("separate", "arch"),
        ("separate", "runs-by-their-control-points"),
    ] {
        let certificate = hand_made(subject, name);
        let mut tally = Tally::new(name, &certificate.json(), Box::new(is_embedded));
        mutate_json(&mut tally, &certificate);
        tally.agree(10);
    }
    let channel = hand_made("embedding", "channel").binary();
    let mut tally = Tally::new("bytes of the channel", &channel, Box::new(is_embedded));
    mutate_bytes(&mut tally, &channel);
    tally.agree(10);
}

#[test]
fn polygons() {
    let channel = subjects::channel().upper("9", subjects::channel_root());
    run("channel", &channel, None, 10);
    run("step", &subjects::step(), None, 10);
    run(
        "bend at an end",
        &hand_made("bend", "end-against-its-piece-both"),
        None,
        10,
    );
    run("ends", &hand_made("not_normal", "ends-leaning-out"), None, 20);
    run("touch", &hand_made("touch", "two-joints"), None, 10);
    run("crossing", &hand_made("crossing", "two-diagonals"), None, 10);
    run(
        "critical root",
        &hand_made("critical_root", "ends-behind-each-other"),
        None,
        10,
    );
    run(
        "critical interval",
        &hand_made("critical_interval", "altitude"),
        None,
        10,
    );
}

#[test]
fn curved() {
    run("lens", &hand_made("miranda", "mixed-factors"), None, 10);
    run("circle", &hand_made("root", "rational-inside"), Some(exactly(4)), 10);
    run("parabola", &proved("parabola.json", Convention::Critical, 3), None, 10);
    run(
        "concentric arcs",
        &hand_made("pedal", "concentric-arcs"),
        Some(exactly(4)),
        10,
    );
    run(
        "opposite arcs",
        &hand_made("pedal", "opposite-arcs"),
        Some(exactly(4)),
        10,
    );
    run("needle", &hand_made("turn", "needle"), None, 10);
    run(
        "corner inside",
        &hand_made("miranda", "corner-inside-critical"),
        None,
        10,
    );
}

#[test]
fn known_to_forty_digits() {
    // σ of the closed cubic spline, and one unit of its fortieth digit.
    let digits = "442675170376606599444313276103389848818804";
    let sigma = |last: i64| {
        let numerator: knotproof::number::Integer = digits.parse().expect("digits");
        let sigma = Rational::new(
            numerator + knotproof::number::Integer::from(last),
            knotproof::number::Integer::from(10).pow(42),
        );
        Some(&sigma * &sigma)
    };
    let known = [0, 1].map(|_| Enclosure {
        lower: sigma(-1),
        upper: sigma(1),
    });
    run(
        "mp06",
        &proved("mp06-figure-1.json", Convention::Smooth, 12),
        Some(known),
        40,
    );
}

#[test]
fn bytes() {
    run_binary("channel", &subjects::channel().upper("9", subjects::channel_root()), 10);
    run_binary("parabola", &proved("parabola.json", Convention::Smooth, 3), 10);
    run_binary("concentric arcs", &hand_made("pedal", "concentric-arcs"), 10);
    run_binary("needle", &hand_made("turn", "needle"), 10);
    run_binary("square", &proved("square.json", Convention::Critical, 3), 10);
}

#[test]
fn the_recomputation_refutes_what_is_false() {
    let certificate = subjects::channel();
    let Verdict::Accepted { document, .. } = check(certificate.json().as_slice()) else {
        panic!("accepted")
    };
    let known = recomputed(&document.curve, Convention::Smooth);
    let mut statement = statement_of(&document).clone();
    assert!(is_true(&statement, &known));
    statement.lower_squared = Lower::Finite(Rational::from_integer(10.into()));
    assert!(!is_true(&statement, &known));
    statement.lower_squared = Lower::Infinite;
    assert!(!is_true(&statement, &known));
    statement.lower_squared = Lower::Finite(zero());
    statement.upper_squared = Some(Rational::from_integer(8.into()));
    assert!(!is_true(&statement, &known));
}

/// A certificate about the domain of a parabola's points, which is a half-plane.
fn run_domain(name: &str, certificate: &Certificate) {
    let bytes = certificate.json();
    let mut tally = Tally::new(name, &bytes, Box::new(half_plane::is_true));
    mutate_json(&mut tally, certificate);
    tally.agree(5);
}

#[test]
fn half_planes() {
    run_domain("rectangle", &subjects::domain::rectangle());
    run_domain("below", &subjects::empty::below());
    run_domain("from below", &subjects::nearest::from_below());
    run_domain("fair", &subjects::nearest::fair());
    run_domain("half", &subjects::change::half());
    run_domain("strip", &subjects::ball::strip());
}

/// A sandwich that the prover found, of a domain with a curved boundary, and one in space.
#[test]
fn sandwiches() {
    run_domain("block", &subjects::domain::block());
    let path = common::case::certs().join("accept/proved/domain-cubic.json");
    run_domain(
        "cubic",
        &Certificate::of_bytes(&std::fs::read(path).expect("in the corpus")),
    );
}

#[test]
fn bytes_of_half_planes() {
    for certificate in [subjects::domain::rectangle(), subjects::empty::below()] {
        let bytes = certificate.binary();
        let mut tally = Tally::new("half-plane", &bytes, Box::new(half_plane::is_true));
        mutate_bytes(&mut tally, &bytes);
        tally.agree(20);
    }
}

/// A certificate whose truth is recomputed by `truth`.
fn run_with(name: &str, certificate: &Certificate, truth: fn(&Document) -> bool) {
    let bytes = certificate.json();
    let mut tally = Tally::new(name, &bytes, Box::new(truth));
    mutate_json(&mut tally, certificate);
    tally.agree(5);
}

#[test]
fn curvature() {
    run_with("vertex", &subjects::curvature::vertex(), bend::curvature_is_true);
    run_with("circle", &hand_made("curvature", "circle"), bend::curvature_is_true);
    run_with(
        "coincident points",
        &hand_made("curvature", "coincident-points"),
        bend::curvature_is_true,
    );
    run_with("in space", &hand_made("curvature", "in-space"), bend::curvature_is_true);
    let bytes = subjects::curvature::vertex().binary();
    let mut tally = Tally::new("vertex", &bytes, Box::new(bend::curvature_is_true));
    mutate_bytes(&mut tally, &bytes);
    tally.agree(20);
}

#[test]
fn thickness() {
    run_with("segment", &subjects::thickness::segment(), bend::thickness_is_true);
    run_with("circle", &subjects::thickness::circle(), bend::thickness_is_true);
    run_with("corner", &subjects::thickness::corner(), bend::thickness_is_true);
}

#[test]
fn results_of_operations() {
    let everything = subjects::values::everything();
    run_with("everything", &everything, operations::values_are_true);
}
