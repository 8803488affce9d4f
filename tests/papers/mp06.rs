//! MP06: definitions, the curve of Figure 1, its Bézier segments, Newton's method.

use knotproof::claim::msd::Convention;
use knotproof::curve::{BSpline, Curve, Form, Joint, Side};
use knotproof::number::Rational;

use crate::certified::separation;
use crate::exact::{
    bezier, control_points, cross, dot, file, fraction, minus, number, numbers, points, shown, squared, times, whole,
};
use crate::mp06_search;
use crate::table::{Exact, Page, Row, Verdict, noted, row};

const CONTROL_POINTS: &str = "(0.0 0.0 0.0) (-1.0 1.0 0.0) (4.5 5.5 2.0) (5.0 -1.0 8.5) (-1.5 2.5 -4.5) (4.5 6.0 8.5) (3.5 -3.5 0.0) (0.0 0.0 0.0)";
const KNOTS: &str = "0 0 0 0 0.2 0.4 0.6 0.8 1 1 1 1";
const INSERTED: &str = "0 0 0 0 .2 .2 .2 .4 .4 .4 .6 .6 .6 .8 .8 .8 1 1 1 1";
const SEGMENTS: [(&str, &str); 5] = [
    ("yellow", "(0 0 0) (-1 1 0) (1.75 3.25 1) (3.2083 3.2917 2.5833)"),
    (
        "cyan",
        "(3.2083 3.2917 2.5833) (4.6667 3.3333 4.1667) (4.8333 1.1667 6.3333) (3.8333 0.6667 5.25)",
    ),
    (
        "magenta",
        "(3.8333 0.6667 5.25) (2.8333 0.1667 4.1667) (0.6667 1.3333 -0.1667) (0.5833 2.5 -0.1667)",
    ),
    (
        "red",
        "(0.5833 2.5 -0.1667) (0.5 3.6667 -0.1667) (2.5 4.8333 4.1667) (3.25 3.0417 4.2083)",
    ),
    ("blue", "(3.25 3.0417 4.2083) (4 1.25 4.25) (3.5 -3.5 0) (0 0 0)"),
];

fn spline(curve: &Curve) -> &BSpline {
    match curve.form() {
        Form::BSpline(spline) => spline,
        Form::Bezier(_) => panic!("a B-spline"),
    }
}

pub fn write(page: &mut Page) {
    let curve = file("mp06-figure-1");
    page.heading(2, "MP06");
    page.text(
        "The paper calls σ the *global separation*. It counts segments from 1, certificates count pieces from 0.",
    );
    page.heading(3, "§1, definitions");
    page.table(definitions(&curve));
    page.text(DEFINITIONS);
    page.heading(3, "§1, the curve of Figure 1 and its Bézier segments");
    page.table(the_curve(&curve));
    page.table(segments(&curve));
    page.heading(3, "§1, equations (1) to (9)");
    page.table(newton_equations(&curve));
    mp06_search::write(page, &curve);
}

const DEFINITIONS: &str = "\
\"Normal to c\" needs a tangent; Definition 1.1 asks for a parametric curve without self-intersections and names no smoothness. Here tangents are one-sided directions, a joint is smooth when the two agree, and 0 and the end of
a closed curve are one parameter. Where there are doubly normal segments, positivity is an outcome, proved for each curve by its tree, and not a premise ([msd.md](msd.md)).";

fn definitions(curve: &Curve) -> Vec<Row> {
    let spline = spline(curve);
    let [start, end] = [whole(0), whole(1)].map(|t| spline.derivatives(&t, Side::After, 1).expect("in the domain"));
    let chord = minus(&start[0], &end[0]);
    let zero = |x: &Rational| *x == whole(0);
    let (f, g) = (dot(&chord, &start[1]), dot(&chord, &end[1]));
    let literal = zero(&f) && zero(&g) && zero(&squared(&chord));
    let segment = file("segment");
    let straight = segment.chain().pieces()[0].clone();
    let none = ["segment", "parabola"].map(|name| separation(&file(name), Convention::Smooth));
    vec![
        row(
            "Definition 1.1",
            "distinct s, t ∈ [0, 1] with (1) and (2) are the ends of a doubly normal segment",
            &format!(
                "closed curves: s = 0 and t = 1 are distinct, c(0) − c(1) = {}, and (1) = {f}, (2) = {g}. Read literally, σ of the curve of Figure 1 is {}",
                shown(&chord),
                Exact::root(&squared(&chord)),
            ),
            Verdict::holds(!literal),
        ),
        row(
            "Definition 1.2",
            "\"For compact curves, this minimum has been shown to be positive\"",
            &format!(
                "the straight segment {} to {} and the parabola y = x², −1 ≤ x ≤ 1, have no doubly normal segment, certified. The minimum is over the empty set",
                shown(&straight.point(0)),
                shown(&straight.point(1)),
            ),
            Verdict::holds(!none.iter().all(|found| found.is_infinite())),
        ),
    ]
}

fn the_curve(curve: &Curve) -> Vec<Row> {
    let spline = spline(curve);
    let printed: Vec<Rational> = points(CONTROL_POINTS).iter().flatten().map(|x| number(x)).collect();
    let own: Vec<Rational> = spline.points().iter().collect();
    let knots: Vec<Rational> = spline.knots().iter().collect();
    let inside = ["0.2", "0.4", "0.6", "0.8"].map(number);
    let twice: Vec<Rational> = inside.iter().flat_map(|t| [t.clone(), t.clone()]).collect();
    let refined = spline.refine(&twice).expect("refined");
    let chain = curve.chain();
    let smooth = inside.iter().all(|t| {
        let [before, after] = [Side::Before, Side::After].map(|side| spline.derivatives(t, side, 2).expect("inside"));
        before == after
    });
    let start = &spline.derivatives(&whole(0), Side::After, 1).expect("the start")[1];
    let end = &spline.derivatives(&whole(1), Side::Before, 1).expect("the end")[1];
    let parallel = cross(start, end).iter().all(|x| *x == whole(0)) && dot(start, end) > whole(0);
    assert!(parallel && chain.joint(0) == Some(Joint::Smooth));
    vec![
        row(
            "control points",
            CONTROL_POINTS,
            "those of `certs/curves/mp06-figure-1.json`, with which all below is computed",
            Verdict::equal(printed == own),
        ),
        row(
            "knot vector",
            KNOTS,
            "the same",
            Verdict::equal(numbers(KNOTS) == knots),
        ),
        noted(
            "\"five Bézier segments\"",
            "",
            "5",
            chain.count(),
            &format!("({} control points of degree {})", spline.count(), spline.degree()),
        ),
        row(
            "U after inserting interior knots",
            INSERTED,
            &format!("{} knots, {} control points", refined.knots().len(), refined.count()),
            Verdict::equal(numbers(&INSERTED.replace(" .", " 0.")) == refined.knots().iter().collect::<Vec<_>>()),
        ),
        row(
            "\"a composite C² Bézier curve\"",
            "at the four inner joints",
            "c, c', c'' agree from both sides at 0.2, 0.4, 0.6, 0.8",
            Verdict::holds(smooth),
        ),
        row(
            "",
            "at the closing point",
            &format!(
                "c'(0) = {}, c'(1) = {}: parallel, of different lengths; not C¹ as a closed curve, but with a tangent (G¹)",
                shown(start),
                shown(end)
            ),
            Verdict::holds(start == end),
        ),
    ]
}

fn segments(curve: &Curve) -> Vec<Row> {
    let chain = curve.chain();
    let mut rows = Vec::new();
    for (i, (colour, printed)) in SEGMENTS.iter().enumerate() {
        for (k, (point, exact)) in points(printed)
            .iter()
            .zip(control_points(&chain.pieces()[i]))
            .enumerate()
        {
            let verdicts = point.iter().zip(&exact).map(|(x, y)| Verdict::of(x, &y.clone().into()));
            rows.push(row(
                &if k == 0 {
                    format!("curve {} ({colour})", i + 1)
                } else {
                    String::new()
                },
                &format!("({})", point.join(" ")),
                &shown(&exact),
                verdicts.max().expect("coordinates"),
            ));
        }
    }
    rows
}

/// The derivative at 0 of a polynomial of degree at most 6 in x, exactly, from its values at −3, …, 3.
fn derivative_at_zero(value: impl Fn(&Rational) -> Rational) -> Rational {
    let at = |k: i64| value(&fraction(k, 100)) - value(&fraction(-k, 100));
    (at(1) * fraction(3, 4) - at(2) * fraction(3, 20) + at(3) * fraction(1, 60)) * whole(100)
}

fn newton_equations(curve: &Curve) -> Vec<Row> {
    let chain = curve.chain();
    // On the first and third piece, where the shortest double normal is.
    let (s, t) = (fraction(1, 3), fraction(5, 7));
    let at = |piece: usize, u: &Rational| chain.pieces()[piece].derivatives(u, 2).expect("inside");
    let f = |s: &Rational, t: &Rational| {
        let (p, q) = (at(0, s), at(2, t));
        dot(&minus(&p[0], &q[0]), &p[1])
    };
    let g = |s: &Rational, t: &Rational| {
        let (p, q) = (at(0, s), at(2, t));
        dot(&minus(&p[0], &q[0]), &q[1])
    };
    let (p, q) = (at(0, &s), at(2, &t));
    let chord = minus(&p[0], &q[0]);
    let true_values = [
        derivative_at_zero(|x| f(&(&s + x), &t)),
        derivative_at_zero(|x| f(&s, &(&t + x))),
        derivative_at_zero(|x| g(&(&s + x), &t)),
        derivative_at_zero(|x| g(&s, &(&t + x))),
    ];
    let printed_values = [
        dot(&chord, &p[2]) + dot(&p[1], &p[1]),
        -dot(&q[1], &p[1]),
        dot(&p[1], &q[1]),
        dot(&chord, &q[2]) + dot(&q[1], &times(&q[1], &whole(-1))),
    ];
    let formulas = [
        ("(6)", "∂f/∂s = [c(s) − c(t)]·c''(s) + c'(s)·c'(s)"),
        ("(7)", "∂f/∂t = −c'(t)·c'(s)"),
        ("(8)", "∂g/∂s = c'(s)·c'(t)"),
        ("(9)", "∂g/∂t = [c(s) − c(t)]·c''(t) + c'(t)·−c'(t)"),
    ];
    let mut rows = vec![];
    let [fs, ft, gs, gt] = &true_values;
    let determinant = fs * gt - ft * gs;
    let inverse = [gt, &-ft, &-gs, fs].map(|x| x / &determinant);
    let identity = [
        &inverse[0] * fs + &inverse[1] * gs,
        &inverse[0] * ft + &inverse[1] * gt,
        &inverse[2] * fs + &inverse[3] * gs,
        &inverse[2] * ft + &inverse[3] * gt,
    ];
    rows.push(row(
        "(5)",
        "J⁻¹ = 1/(f_s g_t − f_t g_s) · [[g_t, −f_t], [−g_s, f_s]]",
        "J⁻¹J = 1, by fractions at s = 1/3 on segment 1, t = 5/7 on segment 3",
        Verdict::equal(identity == [whole(1), whole(0), whole(0), whole(1)]),
    ));
    for ((place, formula), (printed, exact)) in formulas.iter().zip(printed_values.iter().zip(&true_values)) {
        rows.push(row(
            place,
            formula,
            &format!("there: {}, as the derivative itself", Exact::from(exact.clone())),
            Verdict::equal(printed == exact),
        ));
    }
    rows
}

/// The rows about the certified value.
pub fn sigma(curve: &Curve) -> Vec<Row> {
    let chain = curve.chain();
    let found = separation(curve, Convention::Smooth);
    let sigma = found.sigma();
    let [s, t] = found.ends.as_ref().expect("a box of parameters");
    let local = |[low, high]: &[Rational; 2], piece: i64| -> Exact { [low - whole(piece), high - whole(piece)].into() };
    let note = |end: &[Rational; 2], piece: usize| {
        let knot: Exact = [0, 1].map(|i| chain.knot_at(&end[i]).expect("on the curve")).into();
        format!("on piece {piece}, at {knot} in the knots of the B-spline")
    };
    let exact = format!("{}, certified", sigma.show(28));
    vec![
        row(
            "\"the distance … is 0.4427, which is the global separation\"",
            "0.4427",
            &exact,
            Verdict::of("0.4427", &sigma),
        ),
        noted("its ends", "s = ", "0.4774", local(s, 0), &note(s, 0)),
        noted("", "t = ", "0.7845", local(t, 2), &note(t, 2)),
    ]
}

/// The curve of the printed Bézier segments.
pub fn printed_segments() -> Curve {
    let piece = |(_, text): &(&str, &str)| {
        let numbers = |p: &Vec<&str>| p.iter().map(|x| number(x)).collect();
        bezier(&points(text).iter().map(numbers).collect::<Vec<_>>())
    };
    Curve::new(3, Form::Bezier(SEGMENTS.iter().map(piece).collect())).expect("pieces that join")
}
