//! CPIJ14 §3 and §7: Experiment 1 and Example 4, on the motion that the file describes.

use std::io::Cursor;
use std::path::Path;

use knotproof::approximation::{least_power, nairn_peters_lutterkort};
use knotproof::certificate::Encoding;
use knotproof::claim::motion::Statement;
use knotproof::motion::{Motion, ReadOptions, read_motion};
use knotproof::number::{Rational, exact_sqrt};
use knotproof::prove::motion::{Options, certify};

use crate::certified::deviation;
use crate::cpij14_rules;
use crate::exact::{
    Point, dot, fraction, infinity, minus, number, plus, points, second_difference, second_differences, shown, squared,
    times, whole,
};
use crate::table::{Exact, Page, Row, Verdict, noted, row, unknown, value};

const CONTROL_POINTS: &str = "(0,6) (1,5) (2,4.5) (3,5.25) (4,6) (5,7) (6,8) (7,9) (9,10) (11,11) (13,12) (15,13) (17,13.35) (19,13.7) (21,13) (22,12) (23,11) (24,10) (24.5,8) (25,6) (25,4) (25,3)";
const GAMMA_U: &str = "(0,5/20) (0,4/20) (0,4/20) (0,4/20) (0,3/20) (0,2/20) (0,1/20) (0,1/20) (0,1/20) (0,5/20)";
const GAMMA_V: &str =
    "(0,-5/20) (0,-4/20) (0,-4/20) (0,-4/20) (0,-3/20) (0,-2/20) (0,-1/20) (0,-1/20) (0,-1/20) (0,-5/20)";
/// p_u, p_v and the junction p_j.
const U: usize = 2;
const V: usize = 40;
const J: usize = 39;

/// A motion with all its frames, and what is certified of it.
struct Moving {
    motion: Motion,
    frames: Vec<Vec<Point>>,
    statement: Statement,
}

fn moving(name: &str) -> Moving {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("certs/motions").join(name);
    let motion = read_motion(&path, ReadOptions::default()).expect("a motion");
    let dimension = motion.points().dimension();
    let mut frame: Vec<Point> = motion
        .points()
        .coordinates()
        .chunks(dimension)
        .map(<[_]>::to_vec)
        .collect();
    let mut frames = vec![frame.clone()];
    for step in motion.moves().expect("steps") {
        for (point, by) in step.expect("a step") {
            for axis in 0..dimension {
                frame[point as usize][axis] += Rational::new(by[axis].clone(), motion.denominator.clone());
            }
        }
        frames.push(frame.clone());
    }
    let mut certified = certify(&motion, &Options::default(), &|_| ()).expect("certified");
    certified
        .write_checked(Encoding::Binary, &mut Cursor::new(Vec::new()))
        .expect("accepted by the checker");
    let statement = certified.document.as_ref().expect("a document").claim.statement.clone();
    drop(certified);
    Moving {
        motion,
        frames,
        statement,
    }
}

impl Moving {
    /// The greatest second difference inside a cubic piece in frame i, and the points that attain it.
    fn second(&self, i: usize) -> (Rational, Vec<usize>) {
        let frame = &self.frames[i];
        let inner = (1..frame.len() - 1).filter(|j| j % 3 != 0);
        let all: Vec<(usize, Point)> = inner
            .map(|j| (j, second_difference(&frame[j - 1], &frame[j], &frame[j + 1])))
            .collect();
        let greatest = all.iter().map(|(_, v)| infinity(v)).max().expect("points");
        // Here both norms agree: all that counts is vertical.
        let longest = all.iter().map(|(_, v)| squared(v)).max().expect("points");
        assert_eq!(exact_sqrt(&longest), Some(greatest.clone()));
        let attained = all.iter().filter(|(_, v)| infinity(v) == greatest).map(|(j, _)| *j);
        let attained = attained.collect();
        (greatest, attained)
    }

    /// The greatest displacement since time 0.
    fn displacement(&self, i: usize) -> Rational {
        let all = || self.frames[i].iter().zip(&self.frames[0]).map(|(p, q)| minus(p, q));
        let greatest = all().map(|v| infinity(&v)).max().expect("points");
        let longest = all().map(|v| squared(&v)).max().expect("points");
        assert_eq!(exact_sqrt(&longest), Some(greatest.clone()));
        greatest
    }

    /// N∞(3)·‖Δ₂X_i‖.
    fn distance(&self, i: usize) -> Rational {
        self.second(i).0 * nairn_peters_lutterkort(3)
    }

    /// The criterion with N∞.
    fn criterion(&self, i: usize) -> Rational {
        self.distance(i) + self.displacement(i)
    }

    /// As printed, without N∞.
    fn as_printed(&self, i: usize) -> Rational {
        self.second(i).0 + self.displacement(i)
    }
}

/// What the text of the page says of all frames.
fn of_all_frames(moving: &Moving) {
    assert_eq!((moving.motion.points().count(), moving.motion.steps), (43, 10));
    let kinds = [0, 1, U, 3, 4, J, V, 41, 42].map(|j| moving.motion.points().kind(j));
    assert_eq!(kinds, [3, 3, 1, 2, 1, 2, 1, 3, 3]);
    for (i, frame) in moving.frames.iter().enumerate() {
        assert_eq!(moving.second(i).1, [U, V]);
        let farthest = infinity(&minus(&frame[V], &moving.frames[0][V]));
        assert_eq!(farthest, moving.displacement(i));
        // p_u and p_v at step 10 are the only two vertices that meet.
        let pairs = (0..frame.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        let meeting: Vec<(usize, usize)> = pairs.filter(|(a, b)| frame[*a] == frame[*b]).collect();
        assert_eq!(meeting, if i == 10 { vec![(V, U)] } else { vec![] });
    }
}

pub fn write(page: &mut Page) {
    let moving = moving("cpij14-experiment-1.json");
    of_all_frames(&moving);
    page.heading(2, "CPIJ14");
    page.text(INTRODUCTION);
    page.heading(3, "§2 and §4, definitions");
    page.table(cpij14_rules::definitions());
    page.heading(3, "§3, Experiment 1");
    page.table(experiment(&moving));
    page.heading(3, "§5 and §6, formulas");
    page.text("The formulas are linear in control points and perturbation vectors, so each is compared on a basis; a sum over time steps is one vector.");
    page.table(cpij14_rules::formulas());
    page.table(cpij14_rules::claims());
    page.heading(3, "§7, Example 4");
    page.table(example(&moving));
    page.text(STEPS);
    page.plain_table(
        &["step", "‖Δ₂X‖", "N∞‖Δ₂X‖", "displacement", "sum", "sum without N∞"],
        &steps(&moving),
    );
    page.table(criterion(&moving));
    page.text(CRITERION);
}

const INTRODUCTION: &str = "\
What the criteria prove, and do not, with proofs: [motion.md](motion.md) §4, §5. The curve of Experiment 1 is `certs/curves/cpij14-experiment-1.json`, its motion `certs/motions/cpij14-experiment-1.json`, with the signs of Γ turned as the text describes the motion.";

const STEPS: &str = "All displacements and the greatest second differences are vertical, so that the ∞-norm and the Euclidean norm give the same numbers.";

const CRITERION: &str = "\
p_u and p_v attain ‖Δ₂‖ in every frame, and no point is displaced farther than they are. So here the displacement of the attaining point, which the paper takes, is the greatest one, which the proof needs.";

fn steps(moving: &Moving) -> Vec<Vec<String>> {
    let line = |i: usize| {
        let values = [
            moving.second(i).0,
            moving.distance(i),
            moving.displacement(i),
            moving.criterion(i),
            moving.as_printed(i),
        ];
        std::iter::once(i.to_string())
            .chain(values.map(|x| x.to_string()))
            .collect()
    };
    (0..moving.frames.len()).map(line).collect()
}

/// ν², the least squared distance of a vertex and an edge that does not end in it.
fn nu_squared(polygon: &[Point]) -> Rational {
    let mut least: Option<Rational> = None;
    for (k, vertex) in polygon.iter().enumerate() {
        for (e, edge) in polygon.windows(2).enumerate().filter(|(e, _)| k != *e && k != e + 1) {
            let along = minus(&edge[1], &edge[0]);
            let from = minus(vertex, &edge[0]);
            let share = (dot(&along, &from) / squared(&along)).clamp(whole(0), whole(1));
            let distance = squared(&minus(&from, &times(&along, &share)));
            assert!(e < polygon.len());
            least = Some(least.map_or(distance.clone(), |least| least.min(distance)));
        }
    }
    least.expect("edges")
}

fn experiment(moving: &Moving) -> Vec<Row> {
    let first = &moving.frames[0];
    let half: Vec<Point> = points(CONTROL_POINTS)
        .iter()
        .map(|p| p.iter().map(|x| number(x)).collect())
        .collect();
    let reflected = half
        .iter()
        .rev()
        .skip(1)
        .map(|p: &Point| vec![p[0].clone(), whole(6) - &p[1]]);
    let printed: Vec<Point> = half.iter().cloned().chain(reflected).collect();
    let joints: Vec<usize> = (3..first.len() - 1).step_by(3).collect();
    let smooth = joints.iter().all(|j| {
        second_difference(&first[j - 1], &first[*j], &first[j + 1])
            .iter()
            .all(|x| *x == whole(0))
    });
    let nu = nu_squared(first);
    let criteria = moving.statement.criteria.as_ref().expect("criteria");
    assert_eq!(criteria.half_nu.as_ref().expect("a polygon").nu_squared, nu);
    let half_nu = exact_sqrt(&nu).expect("a fraction") / whole(2);
    let permitted = (0..moving.frames.len())
        .take_while(|i| moving.displacement(*i) < half_nu)
        .count()
        - 1;
    let polygon = moving.statement.polygon.as_ref().expect("followed");
    let curve = moving.statement.curve.as_ref().expect("followed");
    let meets: Vec<usize> = (0..moving.frames.len())
        .filter(|i| moving.frames[*i][U] == moving.frames[*i][V])
        .collect();
    let space = self::moving("half-nu-in-space.json");
    let space_criteria = space.statement.criteria.as_ref().expect("criteria");
    let space_nu = space_criteria.half_nu.as_ref().expect("a polygon");
    let space_polygon = space.statement.polygon.as_ref().expect("followed");
    vec![
        row(
            "control points, \"together with their reflection through the line y = 3\"",
            CONTROL_POINTS,
            &format!("{} points, those of the file", first.len()),
            Verdict::equal(printed == *first),
        ),
        row(
            "\"C¹ composite cubic Bézier curve\"",
            "C¹",
            &format!(
                "{} cubics with equal spans; all {} junctions are midpoints of their neighbours",
                joints.len() + 1,
                joints.len()
            ),
            Verdict::holds(smooth),
        ),
        row(
            "\"non-self intersecting\"",
            "embedded",
            &format!("certified for all times from 0 to {}", curve.embedded_through),
            Verdict::holds(curve.embedded_through == whole(10) && curve.meets_by.is_none()),
        ),
        row(
            "ν, \"the minimal distance between points and edges of a PL curve\"",
            "all edges",
            "the edges that do not end in the point; the distance to those that do is 0",
            Verdict::equal(nu == whole(0)),
        ),
        noted(
            "",
            "½ν = ",
            "1/2",
            half_nu.clone(),
            &format!("(ν² = {nu}, at the vertices (25, 4), (25, 3), (25, 2))"),
        ),
        noted(
            "\"would have guaranteed that the first 5 time steps were permissible\"",
            "",
            "5",
            permitted,
            &format!(
                "steps: the displacement is {} at step 2, {} at step 3; ν itself is reached at step 5",
                moving.displacement(2),
                moving.displacement(3)
            ),
        ),
        row(
            "\"Perturbing p_u and p_v over ten time steps introduces a self intersection to the PL structure\"",
            "at step 10",
            &format!(
                "exactly at time 10, p_u = p_v = {}; the polygon is certified to be embedded beyond time {}, and to meet itself by {}",
                shown(&moving.frames[10][U]),
                polygon.embedded_through.floor(),
                polygon.meets_by.as_ref().map_or("–".into(), ToString::to_string),
            ),
            Verdict::holds(meets == [10] && polygon.meets_by == Some(whole(10)) && polygon.embedded_through > whole(9)),
        ),
        row(
            "\"that is not present in the underlying spline curve\"",
            "embedded at step 10",
            &format!("certified through {}", curve.embedded_through),
            Verdict::holds(curve.embedded_through == whole(10)),
        ),
        row(
            "½ν is \"sufficient … to preserve ambient isotopy\"",
            "in ℝ²",
            "Theorem 4 of [motion.md](motion.md)",
            Verdict::proved(),
        ),
        row(
            "",
            "in ℝ³",
            &format!(
                "`certs/motions/half-nu-in-space.json`: ν² = {}, the displacement {} is below ½ν in every frame, and the polygon is certified to meet itself by time {}",
                space_nu.nu_squared,
                Exact::root(
                    &space.frames[1]
                        .iter()
                        .zip(&space.frames[0])
                        .map(|(p, q)| squared(&minus(p, q)))
                        .max()
                        .expect("points")
                ),
                space_polygon.meets_by.as_ref().expect("it meets itself")
            ),
            Verdict::holds(space_nu.failures.euclidean.is_some() || space_polygon.meets_by.is_none()),
        ),
        unknown(
            "[8, Proposition 5.2]",
            "\"an obvious typographical error\"",
            "the proposition is not printed",
        ),
    ]
}

fn example(moving: &Moving) -> Vec<Row> {
    let list = |text: &str| -> Vec<Point> {
        let parse = |p: &Vec<&str>| p.iter().map(|x| number(x)).collect();
        points(text).iter().map(parse).collect()
    };
    let (gamma_u, gamma_v) = (list(GAMMA_U), list(GAMMA_V));
    let total = |list: &[Point]| list.iter().fold(vec![whole(0), whole(0)], |sum, x| plus(&sum, x));
    let turned = |list: &[Point], j: usize| {
        (1..=10).all(|i| minus(&moving.frames[i][j], &moving.frames[i - 1][j]) == times(&list[i - 1], &whole(-1)))
    };
    assert!(turned(&gamma_u, U) && turned(&gamma_v, V));
    let frames = &moving.frames;
    let true_sum = minus(&frames[10][V], &frames[0][V]);
    let printed_end = plus(&frames[0][V], &total(&gamma_v));
    let (second, attained) = moving.second(0);
    assert_eq!(attained, [U, V]);
    let distance = moving.distance(0);
    let true_distance = deviation(&moving.motion.curve, 0);
    let tolerance = number("1.9167");
    let all = &distance + moving.displacement(10);
    let kinds = [V, J].map(|j| moving.motion.points().kind(j));
    let point = |text: &str| -> Point { list(text).remove(0) };
    let alpha = least_power(&(&distance / &tolerance), 2).expect("positive");
    vec![
        row(
            "X₀",
            "{(0,6), (1,5), (2,4.5), …, (2,1.5), (1,1), (0,0)}",
            "the points 0, 1, 2, 40, 41, 42 of the file",
            Verdict::equal(
                list("(0,6) (1,5) (2,4.5)") == frames[0][..3] && list("(2,1.5) (1,1) (0,0)") == frames[0][V..],
            ),
        ),
        row(
            "N∞(3)·‖Δ₂X₀‖",
            "5/12",
            &format!("1/3·{second} = {distance}, at p_u and p_v"),
            Verdict::of("5/12", &distance.clone().into()),
        ),
        row(
            "\"The maximal distance between the curve and the control polygon is 5/12\"; \"this distance is actually attained\" (§2.1)",
            "5/12",
            &format!(
                "{} at equal parameters, certified; 5/12 is a bound",
                true_distance.show(6)
            ),
            Verdict::of("5/12", &true_distance),
        ),
        noted("", "ε_d = ", "1.9167", all.clone(), "= 5/12 + 3/2"),
        row(
            "5/12 \"is less than the given ε_d\"",
            "5/12 < 1.9167",
            &format!("⌈−½ log₂(ε_d/(5/12))⌉ = {alpha}: no subdivision"),
            Verdict::holds(distance < tolerance),
        ),
        row(
            "γ_u",
            GAMMA_U,
            "opposite to the motion described (p_u moves down)",
            Verdict::equal(gamma_u[0] == minus(&frames[1][U], &frames[0][U])),
        ),
        row(
            "γ_v",
            GAMMA_V,
            &format!(
                "opposite to the motion described: with them p_v ends at {}",
                shown(&printed_end)
            ),
            Verdict::equal(gamma_v[0] == minus(&frames[1][V], &frames[0][V])),
        ),
        row(
            "Σγ_v",
            "(0, 3/2)",
            &format!(
                "{} with the signs turned, {} as printed",
                shown(&true_sum),
                shown(&total(&gamma_v))
            ),
            Verdict::equal(point("(0,3/2)") == total(&gamma_v)),
        ),
        row(
            "p_v → δ₁₀p_v",
            "(2, 3/2) → (2, 3)",
            &format!("{} → {}", shown(&frames[0][V]), shown(&frames[10][V])),
            Verdict::equal(point("(2,3/2)") == frames[0][V] && point("(2,3)") == frames[10][V]),
        ),
        row(
            "p_j → δ₁₀p_j",
            "(3, 3/4) → (3, 3/2)",
            &format!("{} → {}", shown(&frames[0][J]), shown(&frames[10][J])),
            Verdict::equal(point("(3,3/4)") == frames[0][J] && point("(3,3/2)") == frames[10][J]),
        ),
        noted(
            "\"p_v is a type 2 point\"",
            "type ",
            "2",
            kinds[0] as usize,
            &format!(", next to the junction p_j, which is of type {}", kinds[1]),
        ),
        row(
            "½ν = 1/2, \"clearly exceeded after 5 steps\"",
            "after 5 steps",
            &format!(
                "the displacement is {} after 5 steps; it is above 1/2 after {}",
                moving.displacement(5),
                (0..=10)
                    .find(|i| moving.displacement(*i) > fraction(1, 2))
                    .expect("a step")
            ),
            Verdict::holds(moving.displacement(5) > fraction(1, 2)),
        ),
    ]
}

fn criterion(moving: &Moving) -> Vec<Row> {
    let tolerance = number("1.9167");
    let holds = |i: usize| moving.criterion(i) < tolerance;
    let printed_holds = |i: usize| moving.as_printed(i) < tolerance;
    let first = |test: &dyn Fn(usize) -> bool| (0..=10).position(|i| !test(i)).expect("a step that fails");
    let criteria = moving.statement.criteria.as_ref().expect("criteria");
    assert_eq!(criteria.second_differences.infinity, Some(first(&holds) as u64));
    // A straight polygon that is sheared: no second differences, and p₀, which attains the maximum 0, rests.
    let straight = |slope: i64| -> Vec<Point> { (0..4).map(|k| vec![whole(k), whole(slope * k)]).collect() };
    let bent = second_differences(&straight(10))
        .iter()
        .map(|v| infinity(v))
        .max()
        .expect("points");
    let rests = infinity(&minus(&straight(10)[0], &straight(0)[0]));
    let farthest = infinity(&minus(&straight(10)[3], &straight(0)[3]));
    let three = whole(3);
    let contact = moving.frames[10][U] == moving.frames[10][V];
    vec![
        noted("step 9: N∞‖Δ₂X₉‖", "", "0.65", moving.distance(9), ""),
        value("step 9: displacement", "1.25", moving.displacement(9)),
        value("step 9: sum", "1.9", moving.criterion(9)),
        value("step 10: N∞‖Δ₂X₁₀‖", "0.667", moving.distance(10)),
        value("step 10: displacement", "1.5", moving.displacement(10)),
        value("step 10: sum", "2.167", moving.criterion(10)),
        row(
            "the inequality at step 10",
            "2.167 > ε_d",
            &format!("{} > 1.9167", moving.criterion(10)),
            Verdict::holds(moving.criterion(10) > tolerance),
        ),
        row(
            "\"It is easy to see that ‖Δ₂X_i‖ + ‖Σγ‖ < ε_d for i = 1, …, 9\"",
            "without N∞, as printed",
            &format!(
                "fails from step {}: {}; at step 9 it is {}. The factor N∞ is missing in print: the numbers contain it",
                first(&printed_holds),
                moving.as_printed(first(&printed_holds)),
                moving.as_printed(9)
            ),
            Verdict::holds((1..=9).all(printed_holds)),
        ),
        row(
            "",
            "with N∞",
            &format!(
                "the first step that fails is {}, with 1.9167 and with 23/12",
                first(&holds)
            ),
            Verdict::holds((1..=9).all(holds) && first(&|i| moving.criterion(i) < fraction(23, 12)) == 10),
        ),
        row(
            "Σγ_X is \"applied to the control point that yields ‖Δ₂X_i‖\"",
            "the criterion bounds the distance",
            &format!(
                "the maximum over *all* points is needed. The straight cubic (k, 0) → (k, 10k) keeps ‖Δ₂‖ = {bent}, attained by p₀ among others, which moves by {rests}; the sum is 0 and p₃ has moved by {farthest}"
            ),
            Verdict::holds(&bent + &rests >= farthest),
        ),
        row(
            "§3: to \"show *exactly* how many subsequent frames can\" reuse the polygon",
            "the criterion decides topology",
            &format!(
                "it bounds a distance: with ε_d = {three} it holds at step 10 ({} < {three}), where the polygon meets itself. That both fail at step 10 in the example is by the choice of ε_d",
                moving.criterion(10)
            ),
            Verdict::holds(!(moving.criterion(10) < three && contact)),
        ),
    ]
}
