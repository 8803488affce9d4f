//! Reading motion files.

use std::path::Path;

use knotproof::motion::{Motion, MotionError, ReadOptions, Step, read_motion, read_motion_text};
use knotproof::number::Integer;
use tempfile::TempDir;

const SEGMENTS: &str = r#"{"knotproof":"curve/1","bezier":{"pieces":[{"points":[["0","0"],["1","0"]]},{"points":[["1","0"],["1","1/3"]]}]}}"#;
/// Two parabolas that are C¹ at their joint.
const PARABOLAS: &str =
    r#"{"knotproof":"curve/1","bezier":{"pieces":[{"points":[[0,0],[1,1],[2,1]]},{"points":[[2,1],[3,1],[4,0]]}]}}"#;

fn read(text: &str) -> Result<Motion, MotionError> {
    read_motion_text(text.as_bytes(), Path::new(""), ReadOptions::default())
}

fn steps(motion: &Motion) -> Vec<Step> {
    motion
        .moves()
        .expect("steps")
        .map(|step| step.expect("a step"))
        .collect()
}

fn by(x: i64, y: i64) -> [Integer; 3] {
    [x, y, 0].map(Integer::from)
}

fn document(curve: &str, rest: &str) -> String {
    format!(r#"{{"knotproof":"motion/1","curve":{curve},{rest}}}"#)
}

#[test]
fn steps_frames_and_lines_say_the_same() {
    let one = r#"{"moves":[{"point":2,"by":["0","1/2"]},{"point":0,"by":[-1,0]}]}"#;
    let two = r#"{"moves":[{"point":1,"by":[0,0]}]}"#;
    let of_steps = read(&document(SEGMENTS, &format!(r#""steps":[{one},{two}]"#))).expect("a motion");
    assert_eq!(of_steps.denominator, Integer::from(6));
    let expected: Vec<Step> = vec![vec![(0, by(-6, 0)), (2, by(0, 3))], vec![]];
    assert_eq!(steps(&of_steps), expected);
    let frame = r#"[[-1,0],[1,0],[1,"5/6"]]"#;
    let of_frames = read(&document(SEGMENTS, &format!(r#""frames":[{frame},{frame}]"#))).expect("a motion");
    assert_eq!(steps(&of_frames), expected);
    let header = document(SEGMENTS, r#""strategy":"free""#);
    let lines = format!("{header}\n{one}\n{two}\n");
    let line_frames = format!("{header}\n{{\"points\":{frame}}}\n{{\"points\":{frame}}}");
    let folder = TempDir::new().expect("a folder");
    for (i, text) in [lines, line_frames].iter().enumerate() {
        let motion = read(text).expect("a motion");
        assert_eq!((motion.steps, steps(&motion)), (2, expected.clone()));
        let path = folder.path().join(format!("{i}.jsonl"));
        std::fs::write(&path, text).expect("written");
        let motion = read_motion(&path, ReadOptions::default()).expect("a motion");
        assert_eq!((motion.steps, steps(&motion)), (2, expected.clone()));
        // A file that has another length on the second reading is noticed.
        std::fs::write(&path, header.clone() + "\n" + one + "\n" + two + "\n" + one).expect("written");
        assert!(motion.moves().expect("steps").any(|step| step.is_err()));
    }
}

#[test]
fn the_strategy_c1_moves_joints_and_their_neighbours() {
    let motion = |moves: &str| {
        read(&document(
            PARABOLAS,
            &format!(r#""strategy":"c1","steps":[{{"moves":[{moves}]}}]"#),
        ))
        .expect("a motion")
    };
    // Type 1: the joint goes to the midpoint.
    let motion_1 = motion(r#"{"point":1,"by":[0,1],"type":1}"#);
    assert_eq!(motion_1.denominator, Integer::from(2));
    assert_eq!(steps(&motion_1), [vec![(1, by(0, 2)), (2, by(0, 1))]]);
    // Type 2: its neighbours go with it.
    let moved = [(1, by(2, 2)), (2, by(2, 2)), (3, by(2, 2))];
    assert_eq!(steps(&motion(r#"{"point":2,"by":[1,1],"type":2}"#)), [moved.to_vec()]);
    // Type 3: alone.
    assert_eq!(
        steps(&motion(r#"{"point":4,"by":[1,1],"type":3}"#)),
        [vec![(4, by(2, 2))]]
    );
    // Three at a time (§6.3): p_j + γ_j + γ_{j+1}, and the midpoint of the new neighbours between them.
    let three = r#"{"point":1,"by":[0,1]},{"point":2,"by":[1,0]},{"point":3,"by":[0,3]}"#;
    let moved = [(1, by(2, 2)), (2, by(2, 4)), (3, by(2, 6))];
    assert_eq!(steps(&motion(three)), [moved.to_vec()]);
}

#[test]
fn every_frame_of_a_c1_motion_is_c1() {
    // A closed chain of four parabolas: the corners and edge midpoints of a square. Every corner is beside two joints.
    let square = r#"{"knotproof":"curve/1","bezier":{"pieces":[
        {"points":[[1,0],[1,1],[0,1]]},{"points":[[0,1],[-1,1],[-1,0]]},
        {"points":[[-1,0],[-1,-1],[0,-1]]},{"points":[[0,-1],[1,-1],[1,0]]}]}}"#;
    let moves = r#"{"point":0,"by":[3,1],"type":2},{"point":1,"by":[0,2],"type":1},{"point":6,"by":[1,1]}"#;
    let text = document(square, &format!(r#""strategy":"c1","steps":[{{"moves":[{moves}]}}]"#));
    let motion = read(&text).expect("a motion");
    let mut points = motion.points().over(&motion.denominator);
    for (point, by) in &steps(&motion)[0] {
        for axis in 0..2 {
            let place = 2 * *point as usize + axis;
            points[place] = &points[place] + &by[axis];
        }
    }
    for joint in [0, 2, 4, 6] {
        for axis in 0..2 {
            let at = |j: usize| &points[2 * (j % 8) + axis];
            assert_eq!(at(joint + 7) + at(joint + 1), at(joint) + at(joint), "joint {joint}");
        }
    }
    assert_eq!(motion.points().kind(1), 1);
}

#[test]
fn subdivision_comes_before_numbering() {
    let text = document(
        PARABOLAS,
        r#""strategy":"c1","subdivisions":2,"steps":[{"moves":[{"point":16,"by":[1,0]}]}]"#,
    );
    let motion = read(&text).expect("a motion");
    assert_eq!(motion.points().count(), 17);
    assert_eq!(motion.curve.chain().count(), 8);
    // Coordinates are over 8, and joints go to midpoints.
    assert_eq!(motion.denominator, Integer::from(32));
    assert_eq!(steps(&motion), [vec![(16, by(32, 0))]]);
}

#[test]
fn curves_are_found_beside_the_motion() {
    let folder = TempDir::new().expect("a folder");
    std::fs::create_dir(folder.path().join("curves")).expect("a folder");
    std::fs::write(folder.path().join("curves/a.json"), SEGMENTS).expect("written");
    let path = folder.path().join("motion.json");
    std::fs::write(&path, document("\"curves/a.json\"", r#""steps":[]"#)).expect("written");
    assert_eq!(
        read_motion(&path, ReadOptions::default())
            .expect("a motion")
            .points()
            .count(),
        3
    );
    std::fs::write(&path, document("\"curves/b.json\"", r#""steps":[]"#)).expect("written");
    let error = read_motion(&path, ReadOptions::default())
        .expect_err("no such curve")
        .to_string();
    assert!(
        error.contains("curve: ") && error.contains("b.json: cannot be read"),
        "{error}"
    );
}

#[test]
fn what_is_wrong_is_named() {
    let step = |step: &str| document(SEGMENTS, &format!(r#""steps":[{{"moves":[]}},{step}]"#));
    let c1 = |curve: &str, rest: &str| document(curve, &format!(r#""strategy":"c1",{rest}"#));
    let cases = [
        (
            document(SEGMENTS, r#""steps":[],"frames":[]"#),
            "found both steps and frames",
        ),
        (document(SEGMENTS, r#""steps":[],"extra":1"#), "unknown field `extra`"),
        (document(SEGMENTS, r#""steps":null"#), "steps: "),
        (
            document(SEGMENTS, r#""steps":[]"#).replace("motion/1", "motion/2"),
            "expected \"motion/1\"",
        ),
        (
            document(SEGMENTS, r#""steps":[],"numbers":"float""#),
            "numbers: found \"float\"",
        ),
        (
            document(SEGMENTS, r#""steps":[],"strategy":"c2""#),
            "strategy: found \"c2\"",
        ),
        (
            document(SEGMENTS, r#""steps":[],"subdivisions":17"#),
            "subdivisions: found 17",
        ),
        (
            document(SEGMENTS, r#""steps":[],"display_tolerance":"0""#),
            "display_tolerance: found 0",
        ),
        (
            document(SEGMENTS, r#""steps":[],"display_tolerance":[]"#),
            "display_tolerance: found a list",
        ),
        (document("{}", r#""steps":[]"#), "curve: "),
        (
            document(&SEGMENTS.replace("1/3", "1/0"), r#""steps":[]"#),
            "curve.bezier.pieces[1].points[1][1]",
        ),
        (
            step(r#"{"moves":[{"point":3,"by":[1,1]}]}"#),
            "steps[1].moves[0].point: found point 3, expected one from 0 to 2",
        ),
        (
            step(r#"{"moves":[{"point":-1,"by":[1,1]}]}"#),
            "steps[1].moves[0].point",
        ),
        (
            step(r#"{"moves":[{"point":1,"by":[1,1]},{"point":1,"by":[1,1]}]}"#),
            "steps[1].moves[1].point: found point 1 twice",
        ),
        (
            step(r#"{"moves":[{"point":1,"by":[1,1,1]}]}"#),
            "steps[1].moves[0].by: found 3 coordinates, expected 2",
        ),
        (
            step(r#"{"moves":[{"point":1,"by":[1,"x"]}]}"#),
            "steps[1].moves[0].by[1]",
        ),
        (
            step(r#"{"moves":[{"point":1,"by":[1,1],"type":2}]}"#),
            "steps[1].moves[0].type: found a type",
        ),
        (step(r#"{"move":[]}"#), "steps[1]"),
        (
            document(SEGMENTS, r#""frames":[[[0,0],[1,1]]]"#),
            "frames[0]: found 2 points, expected 3",
        ),
        (
            document(SEGMENTS, r#""frames":[[[0,0],[1,1],[1]]]"#),
            "frames[0][2]: found 1 coordinates",
        ),
        (
            document(SEGMENTS, r#""display_tolerance":1"#) + "\n{}",
            "line 2: found neither moves nor points",
        ),
        (
            document(SEGMENTS, r#""display_tolerance":1"#) + "\n{\"moves\":[]}\n{\"points\":[[0,0],[1,0],[1,1]]}",
            "line 3: found moves beside frames",
        ),
        (
            document(SEGMENTS, r#""display_tolerance":1"#) + "\n{\"moves\":[]}\n\n",
            "line 3",
        ),
        (c1(SEGMENTS, r#""steps":[]"#), "degrees 1 and 1 at joint 1"),
        (
            c1(&PARABOLAS.replace("[3,1]", "[4,1]"), r#""steps":[]"#),
            "different end edges at joint 1",
        ),
        (c1(PARABOLAS, r#""frames":[]"#), "found frames, expected steps"),
        (
            c1(PARABOLAS, r#""steps":[{"moves":[{"point":2,"by":[0,0],"type":1}]}]"#),
            "steps[0].moves[0].type: found type 1, expected 2 for point 2",
        ),
        ("{".into(), "EOF"),
        ("".into(), "EOF"),
    ];
    for (text, expected) in cases {
        let error = read(&text).expect_err(expected).to_string();
        assert!(error.contains(expected), "{expected:?} is not in {error:?}");
    }
}

#[test]
fn strategy_c1_needs_polynomial_pieces() {
    let weights = PARABOLAS.replace("[2,1]]},", "[2,1]],\"weights\":[1,2,1]},");
    let text = document(&weights, r#""strategy":"c1","steps":[]"#);
    assert!(
        read(&text)
            .expect_err("weights")
            .to_string()
            .contains("found weights in piece 0")
    );
    let spline =
        r#"{"knotproof":"curve/1","bspline":{"degree":2,"knots":[0,0,0,1,2,2,2],"points":[[0,0],[1,1],[3,1],[4,0]]}}"#;
    let text = document(spline, r#""strategy":"c1","steps":[]"#);
    assert!(
        read(&text)
            .expect_err("a spline")
            .to_string()
            .contains("found a B-spline")
    );
    // Halved, it is a C¹ chain of Bézier pieces.
    let text = document(spline, r#""strategy":"c1","subdivisions":1,"steps":[]"#);
    assert_eq!(read(&text).expect("a motion").points().count(), 9);
}
