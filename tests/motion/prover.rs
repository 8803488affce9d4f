//! Certifying motions: everything that is written must be accepted by the checker.

use std::io::Cursor;
use std::path::Path;

use knotproof::certificate::Encoding;
use knotproof::check::{Verdict, check};
use knotproof::claim::motion::{Contact, Statement, TrackKind};
use knotproof::curve::write_curve;
use knotproof::motion::{Motion, ReadOptions, read_motion, read_motion_text};
use knotproof::number::{Integer, Rational};
use knotproof::prove::motion::{Certified, Followed, Options, certify};
use proptest::prelude::*;

fn fraction(numerator: i64, denominator: i64) -> Rational {
    Rational::new(Integer::from(numerator), Integer::from(denominator))
}

fn whole(value: u64) -> Rational {
    Rational::from_integer(value.into())
}

fn motion(text: &str) -> Motion {
    read_motion_text(text.as_bytes(), Path::new("certs/curves"), ReadOptions::default()).expect("a motion")
}

/// Certifies, lets the checker accept both forms, and returns what was found.
#[track_caller]
fn certified<'m>(motion: &'m Motion, options: &Options) -> (Certified<'m>, Statement) {
    let mut certified = certify(motion, options, &|_| ()).expect("certified");
    let mut statements = Vec::new();
    for encoding in [Encoding::Json, Encoding::Binary] {
        let mut file = Cursor::new(Vec::new());
        certified.write_checked(encoding, &mut file).expect("accepted");
        let Verdict::Accepted { document, .. } = check(file.get_ref().as_slice()) else {
            panic!("not accepted");
        };
        statements.push(document.claim.motion().expect("a motion").statement.clone());
    }
    assert_eq!(statements[0], statements[1]);
    let statement = statements.remove(0);
    (certified, statement)
}

fn of<'f>(certified: &'f Certified, kind: TrackKind) -> &'f Followed {
    certified
        .followed
        .iter()
        .find(|followed| followed.kind == kind)
        .expect("followed")
}

/// The polygon of a chain of straight pieces, moved in whole frames.
fn polyline(frames: &[&[&[i64]]]) -> Motion {
    let point = |p: &&[i64]| format!("[{}]", p.iter().map(|x| x.to_string()).collect::<Vec<_>>().join(","));
    let pieces = frames[0]
        .windows(2)
        .map(|pair| format!(r#"{{"points":[{},{}]}}"#, point(&pair[0]), point(&pair[1])));
    let pieces = pieces.collect::<Vec<_>>().join(",");
    // The last point of a closed chain is its first.
    let closed = frames[0].first() == frames[0].last();
    let own = frames[0].len() - usize::from(closed);
    let frame = |frame: &&[&[i64]]| format!("[{}]", frame[..own].iter().map(point).collect::<Vec<_>>().join(","));
    let later = frames[1..].iter().map(frame).collect::<Vec<_>>().join(",");
    motion(&format!(
        r#"{{"knotproof":"motion/1","curve":{{"knotproof":"curve/1","bezier":{{"pieces":[{pieces}]}}}},"frames":[{later}]}}"#
    ))
}

#[test]
fn experiment_1_of_cpij14() {
    let path = Path::new("certs/motions/cpij14-experiment-1.json");
    let motion = read_motion(path, ReadOptions::default()).expect("a motion");
    let (certified, statement) = certified(&motion, &Options::default());
    // The curve stays embedded; the polygon touches itself exactly at step 10, at p_u = p_v.
    let curve = statement.curve.expect("a curve");
    assert_eq!((curve.embedded_through, curve.meets_by), (whole(10), None));
    let polygon = statement.polygon.expect("a polygon");
    assert!(polygon.embedded_through > fraction(999, 100) && polygon.embedded_through < whole(10));
    assert_eq!(polygon.meets_by, Some(whole(10)));
    let contact = of(&certified, TrackKind::Polygon).contact.clone();
    let expected = Contact::Touch {
        time: whole(10),
        s: whole(2),
        t: whole(40),
    };
    assert_eq!(contact, Some(expected));
    let criteria = statement.criteria.expect("criteria");
    let failures = [
        criteria.second_differences.infinity,
        criteria.second_differences.euclidean,
    ];
    assert_eq!(failures, [Some(10), Some(10)]);
    let half_nu = criteria.half_nu.expect("half of ν");
    assert_eq!(half_nu.nu_squared, fraction(1, 1));
    assert_eq!(
        [half_nu.failures.infinity, half_nu.failures.euclidean],
        [Some(3), Some(3)]
    );
    assert_eq!(certified.as_printed.first, Some(2));
    let nine = &certified.measures[9];
    assert_eq!(nine.second, [fraction(15, 8), fraction(225, 64)]);
    assert_eq!(nine.greatest.second, [fraction(5, 8), fraction(25, 64)]);
    assert_eq!(nine.greatest.moved, [fraction(5, 4), fraction(25, 16)]);
    assert_eq!(nine.as_printed, Some(fraction(25, 8)));
}

#[test]
fn no_motion_at_all() {
    for (steps, count) in [("", 0), (r#"{"moves":[]},{"moves":[{"point":3,"by":[0,0,0]}]}"#, 2)] {
        let text = format!(r#"{{"knotproof":"motion/1","curve":"trefoil-24.json","steps":[{steps}]}}"#);
        let motion = motion(&text);
        let (certified, statement) = certified(&motion, &Options::default());
        assert_eq!(statement.steps, count);
        for track in [statement.curve, statement.polygon] {
            assert_eq!(track.expect("a track").embedded_through, whole(count));
        }
        assert!(certified.followed.iter().all(|followed| followed.edits == 0));
    }
}

#[test]
fn a_trefoil_moves_and_stays_a_trefoil() {
    // Every point goes its own way, there and back again.
    let text = r#"{"knotproof":"motion/1","curve":"trefoil-24.json","steps":[]}"#;
    let count = motion(text).points().count() as i64;
    let step = |sign: i64, k: i64| {
        let moves = (0..count).map(|j| {
            let by = [0, 1, 2].map(|axis| sign * ((7 * j + 5 * axis + 3 * k) % 11 - 5));
            format!(r#"{{"point":{j},"by":["{}/60","{}/60","{}/60"]}}"#, by[0], by[1], by[2])
        });
        format!(r#"{{"moves":[{}]}}"#, moves.collect::<Vec<_>>().join(","))
    };
    let there: Vec<String> = (0..6).map(|k| step(1, k)).collect();
    let back: Vec<String> = (0..6).rev().map(|k| step(-1, k)).collect();
    let steps = [there, back].concat().join(",");
    let motion = motion(&text.replace("[]", &format!("[{steps}]")));
    let (_, statement) = certified(
        &motion,
        &Options {
            polygon: false,
            ..Options::default()
        },
    );
    assert_eq!(statement.polygon, None);
    let track = statement.curve.expect("a curve");
    assert_eq!((track.embedded_through, track.meets_by), (whole(12), None));
}

#[test]
fn an_end_goes_through_an_edge_in_the_plane() {
    let before: &[&[i64]] = &[&[0, 0], &[40, 0], &[40, 20], &[17, 20]];
    let same = before;
    let after: &[&[i64]] = &[&[0, 0], &[40, 0], &[40, 20], &[17, -10]];
    let motion = polyline(&[before, same, after, after]);
    let (certified, statement) = certified(&motion, &Options::default());
    for kind in TrackKind::BOTH {
        let track = statement.track(kind).expect("a track");
        // It reaches the edge at 2/3 of the second step.
        assert!(
            track.embedded_through > fraction(166, 100) && track.embedded_through < fraction(5, 3),
            "{track:?}"
        );
        let meets_by = track.meets_by.clone().expect("a meeting");
        assert!(meets_by >= fraction(5, 3) && meets_by <= whole(2));
        assert!(of(&certified, kind).contact.is_some());
    }
}

#[test]
fn an_end_only_touches_in_the_plane() {
    let before: &[&[i64]] = &[&[0, 0], &[40, 0], &[40, 20], &[17, 20]];
    let after: &[&[i64]] = &[&[0, 0], &[40, 0], &[40, 20], &[17, 0]];
    let motion = polyline(&[before, after, before]);
    let (_, statement) = certified(&motion, &Options::default());
    let track = statement.curve.expect("a curve");
    assert_eq!(track.meets_by, Some(whole(1)));
}

#[test]
fn one_edge_passes_through_another_in_space() {
    for (x, aside) in [(1, 0), (0, 0), (7, 5)] {
        // The last edge comes down through the first one, at a simple fraction of the way, or, if it moves aside too, at an irrational one.
        let before: &[&[i64]] = &[
            &[-20, 0, 0],
            &[20, 0, 0],
            &[30, 30, 10],
            &[x, 20, 10],
            &[1 + 2 * x, -23, 10],
        ];
        let after: &[&[i64]] = &[
            &[-20, 0, 0],
            &[20, 0, 0],
            &[30, 30, 10],
            &[x - aside, 20 - aside, -20],
            &[1 + 2 * x + aside, -23, -22 - aside],
        ];
        let motion = polyline(&[before, after]);
        let (certified, statement) = certified(&motion, &Options::default());
        for kind in TrackKind::BOTH {
            let followed = of(&certified, kind);
            assert!(followed.contact.is_some(), "{x} {followed:?}");
            let track = statement.track(kind).expect("a track");
            assert!(track.embedded_through > fraction(1, 10), "{track:?}");
            assert!(track.meets_by.clone().expect("a meeting") < whole(1));
        }
        let rules: Vec<&str> = certified
            .followed
            .iter()
            .filter_map(|f| f.contact.as_ref())
            .map(Contact::rule)
            .collect();
        assert_eq!(rules, [if aside == 0 { "touch" } else { "passage" }; 2]);
    }
}

/// A closed C¹ chain of parabolas near the torus knot T(2, q), all numbers rational: the middle points of its pieces are on the torus, from rational
/// points (cos θ, sin θ) of the circle by the formulas for cos 2θ and so on.
fn torus_knot(q: u32, count: i64) -> String {
    let times = |(a, b): &(Rational, Rational), (c, d): &(Rational, Rational)| (a * c - b * d, a * d + b * c);
    let vertices: Vec<[Rational; 3]> = (0..count)
        .map(|i| {
            let angle = std::f64::consts::PI * ((2 * i + 1) as f64 / count as f64 - 1.0);
            let m = fraction(((angle / 2.0).tan() * 16.0).round() as i64, 16);
            let (one, square) = (fraction(1, 1), &m * &m);
            let unit = ((&one - &square) / (&one + &square), (&m + &m) / (&one + &square));
            let twice = times(&unit, &unit);
            let turned = (1..q).fold(unit.clone(), |power, _| times(&power, &unit));
            let radius = fraction(2, 1) + &turned.0;
            [&radius * &twice.0, &radius * &twice.1, turned.1]
        })
        .collect();
    let text = |p: &[Rational; 3]| format!("[\"{}\",\"{}\",\"{}\"]", p[0], p[1], p[2]);
    let joint = |i: usize| -> [Rational; 3] {
        let next = &vertices[(i + 1) % vertices.len()];
        std::array::from_fn(|axis| (&vertices[i][axis] + &next[axis]) * fraction(1, 2))
    };
    let pieces = (0..vertices.len()).map(|i| {
        let before = joint((i + vertices.len() - 1) % vertices.len());
        format!(
            r#"{{"points":[{},{},{}]}}"#,
            text(&before),
            text(&vertices[i]),
            text(&joint(i))
        )
    });
    let pieces = pieces.collect::<Vec<_>>().join(",");
    format!(r#"{{"knotproof":"curve/1","bezier":{{"pieces":[{pieces}]}}}}"#)
}

#[test]
fn torus_knots_stay_knotted_while_they_move() {
    for (q, count) in [(3, 16), (5, 28)] {
        let curve = torus_knot(q, count);
        // Points in the middles of pieces are types 1; joints follow.
        let step = |sign: i64| {
            let moves = (0..count).map(|i| {
                let by = [0, 1, 2].map(|axis| sign * ((5 * i + 3 * axis) % 7 - 3));
                let point = 2 * i + 1;
                format!(
                    r#"{{"point":{point},"by":["{}/50","{}/50","{}/50"],"type":1}}"#,
                    by[0], by[1], by[2]
                )
            });
            format!(r#"{{"moves":[{}]}}"#, moves.collect::<Vec<_>>().join(","))
        };
        let steps = [1, 1, -1, -1].map(step).join(",");
        let motion = motion(&format!(
            r#"{{"knotproof":"motion/1","curve":{curve},"strategy":"c1","steps":[{steps}]}}"#
        ));
        let (certified, statement) = certified(&motion, &Options::default());
        for kind in TrackKind::BOTH {
            let track = statement
                .track(kind)
                .unwrap_or_else(|| panic!("{q}: {:?}", certified.followed));
            assert_eq!(track.embedded_through, whole(4), "{q}: {:?}", certified.followed);
        }
    }
}

#[test]
fn arms_that_nearly_touch() {
    // Two arms of a hairpin come together from 2,000,000 to 2, and go apart again.
    let arms = |gap: i64| -> Vec<Vec<i64>> {
        vec![
            vec![-10_000_000, -gap],
            vec![10_000_000, -gap],
            vec![12_000_000, 0],
            vec![10_000_000, gap],
            vec![-10_000_000, gap],
        ]
    };
    let frames: Vec<Vec<Vec<i64>>> = [1_000_000, 1, 1, 500_000].map(arms).to_vec();
    let borrowed: Vec<Vec<&[i64]>> = frames
        .iter()
        .map(|frame| frame.iter().map(Vec::as_slice).collect())
        .collect();
    let slices: Vec<&[&[i64]]> = borrowed.iter().map(Vec::as_slice).collect();
    let motion = polyline(&slices);
    let (_, statement) = certified(&motion, &Options::default());
    for kind in TrackKind::BOTH {
        assert_eq!(statement.track(kind).expect("a track").embedded_through, whole(3));
    }
}

#[test]
fn big_steps_are_cut() {
    // A spiral arm is turned around its end by more than a right angle in one step; no leaf holds at both ends.
    let before: &[&[i64]] = &[&[0, 0], &[40, 0], &[40, 40], &[0, 40], &[0, 20], &[20, 20]];
    let after: &[&[i64]] = &[&[0, 0], &[0, 40], &[-40, 40], &[-40, 0], &[-20, 0], &[-20, 20]];
    let motion = polyline(&[before, after, before]);
    let (certified, statement) = certified(&motion, &Options::default());
    let followed = of(&certified, TrackKind::Curve);
    assert_eq!(statement.curve.expect("a curve").embedded_through, whole(2));
    assert!(followed.edits > 0);
}

#[test]
fn a_curve_passes_through_itself_in_space() {
    // Two cubics of a chain in space, one of them goes down through the other.
    let curve = r#"{"knotproof":"curve/1","bezier":{"pieces":[
        {"points":[[-3,0,0],[-1,1,0],[1,1,0],[3,0,0]]},
        {"points":[[3,0,0],[6,-1,2],[6,5,4],[1,4,3]]},
        {"points":[[1,4,3],[0,2,2],[0,-1,3],[1,-3,3]]}]}}"#;
    let moves = (6..10).map(|j| format!(r#"{{"point":{j},"by":[0,"1/7",-5]}}"#));
    let moves = moves.collect::<Vec<_>>().join(",");
    let motion = motion(&format!(
        r#"{{"knotproof":"motion/1","curve":{curve},"steps":[{{"moves":[]}},{{"moves":[{moves}]}}]}}"#
    ));
    let (certified, statement) = certified(&motion, &Options::default());
    let track = statement.curve.expect("a curve");
    assert_eq!(
        of(&certified, TrackKind::Curve).contact.as_ref().map(Contact::rule),
        Some("passage")
    );
    let meets_by = track.meets_by.expect("a meeting");
    assert!(track.embedded_through > whole(1) && meets_by < whole(2));
    assert!(meets_by - track.embedded_through < fraction(1, 1000));
}

#[test]
fn the_ends_of_an_open_curve_meet() {
    let before: &[&[i64]] = &[&[0, 0], &[40, 0], &[40, 40], &[8, 40]];
    let after: &[&[i64]] = &[&[0, 0], &[40, 0], &[40, 40], &[0, 0]];
    let motion = polyline(&[before, after]);
    let (certified, statement) = certified(&motion, &Options::default());
    assert_eq!(statement.curve.expect("a curve").meets_by, Some(whole(1)));
    let contact = of(&certified, TrackKind::Curve).contact.clone();
    let expected = Contact::Touch {
        time: whole(1),
        s: whole(0),
        t: whole(3),
    };
    assert_eq!(contact, Some(expected));
}

#[test]
fn rational_curves_and_splines_move() {
    for name in [
        "nurbs-circle.json",
        "nurbs-space.json",
        "mp06-figure-1.json",
        "unclamped-periodic.json",
    ] {
        let text = format!(r#"{{"knotproof":"motion/1","curve":"{name}","display_tolerance":"1","steps":[]}}"#);
        let still = motion(&text);
        let (dimension, count) = (still.points().dimension(), still.points().count());
        // All points go the same way, so that closed splines stay closed, and a middle one a little farther.
        let by = |more: bool| {
            let numbers = (0..dimension).map(|axis| if more && axis == 0 { "1/20" } else { "1/30" });
            numbers.map(|x| format!("\"{x}\"")).collect::<Vec<_>>().join(",")
        };
        let moves = (0..count).map(|j| format!(r#"{{"point":{j},"by":[{}]}}"#, by(j == count / 2)));
        let step = format!(r#"{{"moves":[{}]}}"#, moves.collect::<Vec<_>>().join(","));
        let motion = motion(&text.replace("[]", &format!("[{step},{step}]")));
        let (certified, statement) = certified(&motion, &Options::default());
        let track = statement
            .curve
            .unwrap_or_else(|| panic!("{name}: {:?}", certified.followed));
        assert_eq!(track.embedded_through, whole(2), "{name}: {:?}", certified.followed);
        // The criteria are for polynomial pieces.
        assert_eq!(statement.criteria.is_some(), !name.contains("nurbs"), "{name}");
    }
}

#[test]
fn a_closed_spline_may_not_be_opened() {
    let text = r#"{"knotproof":"motion/1","curve":"mp06-figure-1.json","steps":[{"moves":[]},{"moves":[{"point":0,"by":[1,0,0]}]}]}"#;
    let motion = motion(text);
    let error = certify(&motion, &Options::default(), &|_| ())
        .err()
        .expect("refused")
        .to_string();
    assert!(error.contains("step 2") && error.contains("closed"), "{error}");
}

#[test]
fn a_first_frame_that_meets_itself_is_not_followed() {
    let motion = motion(r#"{"knotproof":"motion/1","curve":"figure-eight.json","steps":[{"moves":[]}]}"#);
    let certified = certify(
        &motion,
        &Options {
            polygon: false,
            ..Options::default()
        },
        &|_| (),
    )
    .expect("certified");
    assert!(certified.document.is_none());
    let followed = of(&certified, TrackKind::Curve);
    assert!(followed.track.is_none() && followed.undecided.as_ref().is_some_and(|why| why.contains("at time 0")));
}

fn points(count: usize) -> impl Strategy<Value = Vec<Vec<i64>>> {
    proptest::collection::vec(proptest::collection::vec(-12i64..=12, 2), count)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// What is certified of polygons in the plane agrees with a search of each frame by itself.
    #[test]
    fn frames_agree_with_searches_of_each(start in points(5), ways in proptest::collection::vec(points(5), 3)) {
        use knotproof::prove::embedding::{self, Outcome};
        let mut frames = vec![start];
        for way in ways {
            let last = frames.last().expect("a frame");
            frames.push(last.iter().zip(&way).map(|(p, v)| vec![p[0] + v[0] / 4, p[1] + v[1] / 4]).collect());
        }
        prop_assume!(frames[0].first() != frames[0].last());
        let borrowed: Vec<Vec<&[i64]>> = frames.iter().map(|frame| frame.iter().map(Vec::as_slice).collect()).collect();
        let slices: Vec<&[&[i64]]> = borrowed.iter().map(Vec::as_slice).collect();
        prop_assume!(frames[0].windows(2).all(|pair| pair[0] != pair[1]));
        let motion = polyline(&slices);
        let mut certified = certify(&motion, &Options::default(), &|_| ()).expect("certified");
        let track = of(&certified, TrackKind::Curve).track.clone();
        prop_assert_eq!(&track, &of(&certified, TrackKind::Polygon).track);
        if certified.document.is_some() {
            let accepted = certified.write_checked(Encoding::Binary, &mut Cursor::new(Vec::new()));
            prop_assert!(accepted.is_ok(), "{:?}", accepted.err());
        }
        let through = track.as_ref().map(|track| track.embedded_through.clone());
        for (i, frame) in slices.iter().enumerate() {
            if frame.windows(2).any(|pair| pair[0] == pair[1]) || frame.first() == frame.last() {
                continue;
            }
            let alone = polyline(&[frame]);
            let outcome = embedding::certify(&alone.curve, &embedding::Options::default(), &|_| ());
            let embedded = through.as_ref().is_some_and(|through| whole(i as u64) <= *through);
            match outcome.expect("a curve") {
                Outcome::Embedded(_) => prop_assert!(i > 0 || embedded),
                _ => prop_assert!(!embedded, "frame {} of {}", i, write_curve(&motion.curve, None)),
            }
        }
    }
}
