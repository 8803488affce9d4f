//! CPJ12 §4.3 and §5: the comparison with the method before, and the example.

use knotproof::approximation::predecessor::{Extremes, Subdivisions, extremes};
use knotproof::approximation::{
    Chord, Norm, Parameters, PieceMeasures, Plan, Polygon, bounds, least_power, measure, nairn_peters_lutterkort, plan,
    sine,
};
use knotproof::claim::msd::Convention;
use knotproof::curve::Curve;
use knotproof::number::Rational;

use crate::certified::{Separation, separation};
use crate::exact::{Point, bezier_curve, file, fraction, minus, number, plus, squared, whole};
use crate::knot::{is_trefoil, isotopic_polygon};
use crate::table::{Exact, Page, Row, Verdict, noted, rounded_from, row, unknown, value};

/// The curve that the example of §5 is taken to be, and what is known of it.
pub struct Example {
    pub curve: Curve,
    pub pieces: Vec<PieceMeasures>,
    pub sigma: Separation,
    plans: [Plan; 2],
}

impl Example {
    pub fn new() -> Example {
        let curve = file("mp06-figure-1");
        let pieces = measure(&curve.chain()).expect("polynomial pieces");
        let sigma = separation(&curve, Convention::Smooth);
        // δ = 0.25 and ε_d = 0.01, as in §5.
        let plans = [Norm::Infinity, Norm::Euclidean].map(|norm| {
            let parameters = Parameters {
                delta: number("0.25"),
                epsilon_d: number("0.01"),
                norm,
            };
            plan(&pieces, &parameters).expect("positive tolerances")
        });
        Example {
            curve,
            pieces,
            sigma,
            plans,
        }
    }

    pub fn plan(&self, norm: Norm) -> &Plan {
        match norm {
            Norm::Infinity => &self.plans[0],
            Norm::Euclidean => &self.plans[1],
        }
    }
}

pub fn write(page: &mut Page, example: &Example) {
    page.heading(3, "§4.3, the method before and the four cases");
    page.text(CASES);
    page.text(&magnitudes(example));
    page.table(cases(example));
    page.table(
        counterexamples()
            .iter()
            .zip(1..)
            .map(|(found, number)| found.row(number))
            .collect(),
    );
    page.heading(3, "§5, the example");
    page.text(THE_CURVE);
    page.table(the_example(example));
    page.text(&lambda_text(example));
    page.table(lambda(example));
}

const CASES: &str = "\
With m₁ = ⌈x⌉ and m̃₁ = ⌈y⌉ the paper asks for x < y + 1 and concludes m₁ < m̃₁. From x < y + 1 follows m₁ ≤ m̃₁ + 1 only; x ≤ y − 1 would do. K = ‖Δ₂P‖N∞(n), X = n N∞(n−1)‖Δ₂(ΔP)‖. Numbers of the example are those of MP06's curve with ε = ε_d = 0.01 and ∞-norms.";

const THE_CURVE: &str = "\
The example is \"a composite cubic Bézier curve, consisting of five sub-curves, that forms a trefoil knot\". Its control points are in an extended version that is not at hand. The curve of MP06's Figure 1 has five cubic pieces, is a trefoil, comes from the same group, and fits the printed relative error. So the example is taken to be that curve.";

/// Why the algorithm misses σ.
fn lambda_text(example: &Example) -> String {
    let chain = example.curve.chain();
    let ends = example.sigma.ends.as_ref().expect("a box");
    let speeds = ends.each_ref().map(|[low, high]| {
        let (piece, u) = chain.locate(&((low + high) / whole(2))).expect("on the curve");
        let derivative = chain.pieces()[piece].derivatives(&u, 1).expect("inside");
        Exact::root(&squared(&derivative[1])).show(3)
    });
    format!("{LAMBDA} {} and {} the products are above ε_d.", speeds[0], speeds[1])
}

const LAMBDA: &str = "\
λ_c is not printed. The algorithm as printed, with the printed m = 6 and ε_d = 0.01 and exact arithmetic, returns for this curve a value that MP06 know to be wrong (test 4 of their Table 1), and for the same reason: a tolerance too small for the sampling. The nearest points of two edges make a chord that is
orthogonal to the edges; D_m has another direction there, and as |c'| is";

fn exactly(m: Subdivisions) -> i64 {
    match m {
        Subdivisions::Exactly(m) => m,
        found => panic!("{found:?}"),
    }
}

/// A curve for which the condition of a case holds and its conclusion does not.
struct Counterexample {
    case: &'static str,
    condition: &'static str,
    words: &'static str,
    curve: Curve,
    epsilon: Rational,
    /// With a constant that makes the conclusion true.
    right: &'static str,
}

fn counterexamples() -> [Counterexample; 4] {
    let line = |text: &[[(i64, i64); 2]]| {
        let points: Vec<Point> = text
            .iter()
            .map(|p| p.iter().map(|(n, d)| fraction(*n, *d)).collect())
            .collect();
        bezier_curve(&points)
    };
    // Chebyshev's polynomial of degree 4 has steep differences and stays between −1 and 1.
    let mut steep = vec![vec![whole(0), whole(0)]];
    for x in [whole(1), whole(-7), fraction(35, 3), whole(-7), whole(1)] {
        let last: &Point = &steep[steep.len() - 1];
        steep.push(plus(last, &[x / whole(5), fraction(1, 20)]));
    }
    [
        Counterexample {
            case: "case 1: m₁ < m̃₁",
            condition: "3K₀²/(Kε) > 1/4",
            words: "the curve of degree 5 with c' = (T₄(2t − 1), 1/4), T₄ Chebyshev's polynomial",
            curve: bezier_curve(&steep),
            epsilon: fraction(28, 25),
            right: "> 4",
        },
        Counterexample {
            case: "case 2: m₂ < m̃₂",
            condition: "sin(ε/4)·μ₀√X/(√ε·K₁) < √8",
            words: "the cubic (0, 0), (10, 0), (20, 0), (30, 8/9)",
            curve: line(&[
                [(0, 1), (0, 1)],
                [(10, 1), (0, 1)],
                [(20, 1), (0, 1)],
                [(30, 1), (8, 9)],
            ]),
            epsilon: fraction(1, 4),
            right: "≤ 1/√2, with the sine of ε/2",
        },
        Counterexample {
            case: "case 3: m₁ < m̃₂",
            condition: "sin(ε/2)·μ₀√K/(K₁√ε) < 2",
            words: "the quadratic (0, 0), (20, 0), (40, 4)",
            curve: line(&[[(0, 1), (0, 1)], [(20, 1), (0, 1)], [(40, 1), (4, 1)]]),
            epsilon: fraction(1, 4),
            right: "≤ 1/2",
        },
        Counterexample {
            case: "case 4: m₂ < m̃₁",
            condition: "Xε/K₀² < 8/3",
            words: "the cubic (0, 0), (23/60, 1/12), (1/10, 1/6), (29/60, 1/4)",
            curve: line(&[
                [(0, 1), (0, 1)],
                [(23, 60), (1, 12)],
                [(1, 10), (1, 6)],
                [(29, 60), (1, 4)],
            ]),
            epsilon: whole(1),
            right: "≤ 3/2",
        },
    ]
}

impl Counterexample {
    fn row(&self, number: usize) -> Row {
        let epsilon = &self.epsilon;
        let pieces = measure(&self.curve.chain()).expect("polynomial pieces");
        let bounds = bounds(&pieces, Norm::Infinity);
        let found = extremes(&self.curve.chain()).expect("polynomial pieces");
        let both = [epsilon.clone(), epsilon.clone()];
        let square = epsilon * epsilon;
        let (k_squared, x_squared) = (&bounds.distance_squared, &bounds.derivative_printed_squared);
        let m1 = least_power(&(k_squared / &square), 4);
        let m2 = least_power(&(x_squared / (&square * whole(4))), 4);
        let (k, x) = (
            Exact::root(k_squared).ends().0.clone(),
            Exact::root(x_squared).ends().0.clone(),
        );
        // The left side, squared where a root stands in it.
        let slow = |part: i64, factor: &Rational| -> Rational {
            let sine = sine(&(epsilon / whole(part)), 200).expect("a small angle").1;
            let product = sine * &found.least_speed[1] / &found.acceleration[0];
            &product * &product * factor / epsilon
        };
        let (left, holds) = match number {
            1 => {
                let left = whole(3) * &found.speed[0] * &found.speed[0] / (&k * epsilon);
                (Exact::from(left.clone()), left > fraction(1, 4))
            }
            2 => (Exact::root(&slow(4, &x)), slow(4, &x) < whole(8)),
            3 => (Exact::root(&slow(2, &k)), slow(2, &k) < whole(4)),
            _ => {
                let left = &x * epsilon / (&found.speed[0] * &found.speed[0]);
                (Exact::from(left.clone()), left < fraction(8, 3))
            }
        };
        let (name, new) = if number == 1 || number == 3 {
            ("m₁", m1)
        } else {
            ("m₂", m2)
        };
        let (old_name, old) = match number {
            1 | 4 => ("m̃₁", exactly(found.m1(&both))),
            _ => ("m̃₂", exactly(found.m2(&both))),
        };
        let new = new.expect("a number");
        assert!(holds && new >= 0);
        row(
            self.case,
            &format!("if {}", self.condition),
            &format!(
                "{}, ε = {epsilon}: the left side is {}, and {name} = {new}, {old_name} = {old}. (True with {}.)",
                self.words,
                left.show(4),
                self.right
            ),
            Verdict::holds(new < old),
        )
    }
}

/// The quantities that the formulas take from the example's curve.
fn magnitudes(example: &Example) -> String {
    let found = extremes(&example.curve.chain()).expect("polynomial pieces");
    let [infinite, euclidean] = [Norm::Infinity, Norm::Euclidean].map(|norm| &example.plan(norm).bounds);
    format!(
        "Of MP06's curve, per piece: K₀ = max ‖c'‖_∞ = {}, K₁ = max ‖c''‖_∞ = {}, μ₀ = min ‖c'‖_∞ = {}; K = {} (∞-norm), {} (Euclidean); ℓ₀ = {}.",
        Exact::from(found.speed),
        Exact::from(found.acceleration),
        Exact::from(found.least_speed).show(6),
        Exact::root(&infinite.distance_squared),
        Exact::root(&euclidean.distance_squared).show(6),
        Exact::root(&infinite.longest_edge_squared).show(6),
    )
}

fn cases(example: &Example) -> Vec<Row> {
    let epsilon = number("0.01");
    let both = [epsilon.clone(), epsilon.clone()];
    let found = extremes(&example.curve.chain()).expect("polynomial pieces");
    let b = bounds(&example.pieces, Norm::Infinity);
    let (k_squared, x_squared) = (&b.distance_squared, &b.derivative_printed_squared);
    let m1 = least_power(&(k_squared / (&epsilon * &epsilon)), 4).expect("positive");
    let m2 = least_power(&(x_squared / (&epsilon * &epsilon * whole(4))), 4).expect("positive");
    let (old1, old2) = (exactly(found.m1(&both)), exactly(found.m2(&both)));
    let Extremes {
        speed,
        acceleration,
        least_speed,
    } = &found;
    let k = Exact::root(k_squared).ends().0.clone();
    let x = Exact::root(x_squared).ends().0.clone();
    let second = example
        .pieces
        .iter()
        .map(|piece| piece.second.infinity.clone())
        .max()
        .expect("pieces");
    // sin(ε/2)·μ₀/(K₁√ε), squared, and times K and X.
    let angle = |part: i64| sine(&(&epsilon / whole(part)), 200).expect("a small angle");
    let form = |factor: &Rational, part: i64| -> Exact {
        let (low, high) = angle(part);
        let low = low * &least_speed[0] / &acceleration[1];
        let high = high * &least_speed[1] / &acceleration[0];
        Exact::root_between(&(&low * &low * factor / &epsilon), &(&high * &high * factor / &epsilon))
    };
    // μ₀/K₁ at which case 2 turns, for ‖Δ₂(ΔP)‖ = 1.
    let limit = |part: i64| -> Exact {
        let (low, high) = angle(part);
        let factor = whole(3) * nairn_peters_lutterkort(2);
        let square = |sine: &Rational| whole(8) * &epsilon / (sine * sine * &factor);
        Exact::root_between(&square(&high), &square(&low))
    };
    let third = nairn_peters_lutterkort(3);
    let constant = whole(3) / (&third * &epsilon);
    let case_4 = &x * &epsilon / (&speed[0] * &speed[0]);
    vec![
        row(
            "case 1, (4)",
            "3K₀²/(Kε) > 1/4",
            &format!(
                "the right form of x < y + 1. The example: {}",
                Exact::from(whole(3) * &speed[0] * &speed[0] / (&k * &epsilon)).show(6)
            ),
            Verdict::equal(
                (whole(3) * &speed[0] * &speed[0] / (&k * &epsilon) > fraction(1, 4))
                    == (&k / &epsilon < whole(12) * &speed[0] * &speed[0] / (&epsilon * &epsilon)),
            ),
        ),
        noted(
            "cubic, ε = 0.01",
            "(M₀²/‖Δ₂P‖) times ",
            "300",
            constant.clone(),
            "times K₀²/‖Δ₂P‖: N∞(3) = 1/3 is left out; M₀ is K₀",
        ),
        noted(
            "the ratio at which (4) turns",
            "",
            "1/1200",
            fraction(1, 4) / constant,
            "",
        ),
        row(
            "case 2",
            "sin(ε/4)·μ₀√X/(√ε·K₁) < √8",
            &format!("sin(ε/2), as in m̃₂. The example: {}", form(&x, 2).show(5)),
            Verdict::equal(angle(4) == angle(2)),
        ),
        noted(
            "cubic, ε = 0.01: false only for μ₀/K₁ >",
            "",
            "130.6",
            limit(4),
            &format!(
                "/√‖Δ₂(ΔP)‖: the value for ‖Δ₂(ΔP)‖ = 1 and the sine of ε/4; with that of ε/2 it is {}",
                limit(2).show(6)
            ),
        ),
        row(
            "case 3",
            "sin(ε/2)·μ₀√K/(K₁√ε) < 2",
            &format!("the right form of x < y + 1. The example: {}", form(&k, 2).show(5)),
            // x < y + 1 is K/ε < (2K₁/(sin(ε/2)μ₀))².
            Verdict::equal(
                (*form(&k, 2).ends().1 < whole(2)) == {
                    let right = whole(2) * &acceleration[0] / (&angle(2).1 * &least_speed[1]);
                    &k / &epsilon < &right * &right
                },
            ),
        ),
        row(
            "\"‖Δ₂P‖_∞ is an approximation of K₁\"",
            "‖Δ₂P‖_∞ ≈ K₁",
            &format!(
                "c'' has the control points n(n−1)Δ₂p_i: for a cubic K₁ ≤ 6‖Δ₂P‖. The example: K₁ = {}, ‖Δ₂P‖_∞ = {second}, quotient {}",
                acceleration[0],
                &acceleration[0] / &second
            ),
            Verdict::holds(acceleration[0] <= &second * whole(2)),
        ),
        noted(
            "case 4: Xε/K₀² <",
            "",
            "8/3",
            whole(24),
            &format!(
                "is x < y + 1; 8/3 has the 3 on the wrong side, and is stricter. (x ≤ y − 1 is ≤ 3/2.) The example: {}",
                Exact::from(case_4).show(5)
            ),
        ),
        row(
            "\"m < m̃\"",
            "for the example",
            &format!("m₁ = {m1}, m₂ = {m2}; m̃₁ = {old1}, m̃₂ = {old2}"),
            Verdict::holds(m1.max(m2) < old1.max(old2)),
        ),
    ]
}

fn the_example(example: &Example) -> Vec<Row> {
    let [infinite, euclidean] = [Norm::Infinity, Norm::Euclidean].map(|norm| example.plan(norm));
    let chain = example.curve.chain();
    let sigma = example.sigma.sigma();
    let half = |plan: &Plan| -> Exact { plan.epsilon.clone().map(|epsilon| epsilon / whole(2)).into() };
    let printed = number("0.01");
    let found = extremes(&chain).expect("polynomial pieces");
    let both = [printed.clone(), printed];
    let (old1, old2) = (exactly(found.m1(&both)), exactly(found.m2(&both)));
    let parts = chain.count();
    let ratio = |error: &[Rational; 2]| -> Exact { [&error[0] / sigma.ends().1, &error[1] / sigma.ends().0].into() };
    let from_printed = ratio(&rounded_from("0.0034415"));
    // ℓ₀ that the printed E needs, with ε = 0.01 and m = 6.
    let needed = (number("0.0034415") - number("0.00005")) * whole(1 << 11);
    let polygon = Polygon::new(&chain, 6).expect("a polygon");
    let no_edge = no_edge_gives_the_printed_error(&example.curve);
    let true_edge = polygon.longest_edge_squared();
    let with_true_edge = number("0.00005") + whole(2) * true_edge;
    let isotopic = isotopic_polygon(&example.curve);
    vec![
        row(
            "\"consisting of five sub-curves, that forms a trefoil knot\"",
            "a trefoil",
            &format!(
                "MP06's curve has {parts} pieces. The polygon of {} points on it that `certify embedding` proves to be isotopic has a projection with 3 crossings, passed in the order 1, 2, 3, 1, 2, 3, over and under in turn: a trefoil",
                isotopic.len()
            ),
            Verdict::holds(is_trefoil(&isotopic) == Some(true)),
        ),
        noted(
            "δ = 0.25 \"gives\"",
            "ε = ",
            "0.01",
            infinite.epsilon.clone(),
            "the root of (3), ∞-norm as printed",
        ),
        noted(
            "",
            "ε = ",
            "0.01",
            euclidean.epsilon.clone(),
            "the root, Euclidean norm",
        ),
        noted(
            "\"half the smallest positive root\"",
            "ε = ",
            "0.01",
            half(infinite),
            "∞-norm",
        ),
        noted("", "ε = ", "0.01", half(euclidean), "Euclidean norm"),
        noted(
            "\"so m = 6\"",
            "m = ",
            "6",
            infinite.subdivisions as usize,
            &format!(
                "= max(m₁, m₂) = max({}, {}), in both norms, with the root and with its half; by the bound of the derivative without the superfluous 3/2 m₂ = {} (∞-norm), {} (Euclidean)",
                infinite.m1.expect("a number"),
                infinite.m2.expect("a number"),
                infinite.m2_proved.expect("a number"),
                euclidean.m2_proved.expect("a number")
            ),
        ),
        noted("\"6 subdivisions yields\"", "", "960", polygon.edges(), "segments"),
        noted(
            "\"the previous approach involved\"",
            "",
            "10,240",
            parts << old1,
            &format!("= 5·2^{old1}, by m̃₁ alone"),
        ),
        noted(
            "",
            "",
            "10,240",
            parts << old1.max(old2),
            &format!("by m̃ = max(m̃₁, m̃₂) = max({old1}, {old2}), as §4.3 says"),
        ),
        noted(
            "\"The maximum error\"",
            "E = ",
            "0.0034415",
            infinite.error.clone(),
            "∞-norm, ε from (3)",
        ),
        noted("", "E = ", "0.0034415", euclidean.error.clone(), "Euclidean norm"),
        noted(
            "",
            "E = ",
            "0.0034415",
            with_true_edge,
            "with ε = 0.01 and the true ℓ₆ in place of ℓ₀/2⁶",
        ),
        row(
            "",
            "E = 0.0034415",
            &format!(
                "with ε = 0.01 and m = 6 it needs ℓ₀ = {}. With every edge of the control polygons in place of ℓ₀, every m from 0 to 12 and every ε from 0 to 0.01 the formula does not give the digits printed",
                Exact::root(&needed).show(5)
            ),
            Verdict::equal(!no_edge),
        ),
        noted(
            "\"maximum relative error of approximately\"",
            "",
            "0.0078",
            from_printed,
            "= 0.0034415/σ",
        ),
        noted("", "", "0.0078", ratio(&infinite.error), "with the E of the formula"),
        unknown(
            "control points, Figure 7",
            "in [9]",
            "the extended version is not at hand",
        ),
    ]
}

/// E = ε²/2 + ℓ₀²/2^(2m−1), for every edge, every m from 0 to 12 and ε from 0 to 0.01.
fn no_edge_gives_the_printed_error(curve: &Curve) -> bool {
    let [low, high] = rounded_from("0.0034415");
    let control = Polygon::new(&curve.chain(), 0).expect("a polygon");
    let edges = (0..control.parts()).flat_map(|part| (0..control.degree(part)).map(move |k| (part, k)));
    let squares: Vec<Rational> = edges
        .map(|(part, k)| squared(&minus(&control.point(part, k), &control.point(part, k + 1))))
        .collect();
    (0..=12).all(|m| {
        squares.iter().all(|square| {
            let rest = square * fraction(2, 1 << (2 * m));
            rest > high || rest + number("0.00005") < low
        })
    })
}

fn lambda(example: &Example) -> Vec<Row> {
    let chain = example.curve.chain();
    let epsilon = number("0.01");
    let polygon = Polygon::new(&chain, 6).expect("a polygon");
    let finer = Polygon::new(&chain, 7).expect("a polygon");
    let disjoint = Exact::root(&polygon.nearest_disjoint_edges().expect("edges").squared);
    let tested = [Chord::Curve, Chord::Polygon]
        .map(|chord| Exact::root(&polygon.nearest_candidates(&epsilon, chord).expect("a pair").squared));
    assert_eq!(tested[0].ends(), tested[1].ends());
    let fine = Exact::root(
        &finer
            .nearest_candidates(&epsilon, Chord::Curve)
            .expect("a pair")
            .squared,
    );
    let sigma = example.sigma.sigma();
    let error = &example.plan(Norm::Infinity).error[1];
    let contains = |lambda: &Exact, error: &Rational| {
        let (low, high) = (lambda.ends().0 - error, lambda.ends().1 + error);
        low <= *sigma.ends().1 && *sigma.ends().0 <= high
    };
    let printed = number("0.0034415");
    let proved = polygon.separation();
    let (lower, upper) = (proved.lower.expect("finite"), proved.upper.expect("a double normal"));
    let width = Exact::from(whole(2) * &proved.eta);
    vec![
        row(
            "λ_c over all disjoint edges (§4.2)",
            "σ ∈ [λ_c − E, λ_c + E]",
            &format!(
                "λ_c = {}, E = {}, σ = {}",
                disjoint.show(6),
                Exact::from(error.clone()).show(4),
                sigma.show(6)
            ),
            Verdict::holds(contains(&disjoint, error) || contains(&disjoint, &printed)),
        ),
        row(
            "λ_c of pairs that pass (Figure 6)",
            "σ ∈ [λ_c − E, λ_c + E]",
            &format!(
                "λ_c = {}, with the points of the curve and with those of the polygon",
                tested[0].show(8)
            ),
            Verdict::holds(contains(&tested[0], error) || contains(&tested[0], &printed)),
        ),
        row(
            "the same, m = 7",
            "σ ∈ [λ_c − E, λ_c + E]",
            &format!(
                "λ_c = {}: there the pair beside the shortest double normal passes",
                fine.show(8)
            ),
            Verdict::holds(contains(&fine, error)),
        ),
        row(
            "E, of what the 960 edges do prove",
            "0.0034415",
            &format!(
                "{} < σ < {}, by Theorems 3 and 4 of [approximation.md](approximation.md): a valid E is {}",
                Exact::from(lower).show(5),
                Exact::from(upper).show(5),
                width.show(5)
            ),
            Verdict::of("0.0034415", &width),
        ),
        value("λ_c as MP06's test 4", "0.91921", tested[0].clone()),
    ]
}
