//! CPJ12 §1 to §4.2: definitions, formulas, bounds, the estimate of σ.

use knotproof::approximation::{Norm, Polygon, bounds, least_power, measure, nairn_peters_lutterkort};
use knotproof::claim::msd::Convention;
use knotproof::number::Rational;

use crate::certified::{deviation, separation};
use crate::cpj12_example::{self, Example};
use crate::exact::{
    Point, bezier, bezier_curve, control_points, dot, file, fraction, infinity, minus, second_differences, shown,
    squared, times, whole, whole_points,
};
use crate::table::{Exact, Page, Row, Verdict, row};

pub fn write(page: &mut Page) {
    let example = Example::new();
    page.heading(2, "CPJ12");
    page.text(INTRODUCTION);
    page.heading(3, "§1 and §2");
    page.table(preliminaries());
    page.heading(3, "§3.1, distance of curve and polygon");
    page.table(distance(&example));
    page.heading(3, "§3.2 and §3.3, derivative and double normals");
    page.table(derivative(&example));
    page.heading(3, "§4.1 and §4.2, the estimate of σ");
    page.table(estimate(&example));
    page.text(ESTIMATE);
    cpj12_example::write(page, &example);
}

const INTRODUCTION: &str = "\
The definition of MSD has the two gaps of MP06's: parameters 0 and 1 of a closed curve, and curves without double normals. What holds in place of the bounds and of the algorithm, with proofs: [approximation.md](approximation.md).
`knotproof compare certs/curves/mp06-figure-1.json` prints most of the numbers of the example. The formulas are for one Bézier piece; for a composite curve the maximum over its pieces is meant.";

const ESTIMATE: &str = "\
The tolerance is ε/2 in §4.1, half the root of (3) in §4.2, ε_d in Figure 6. λ_c is the least distance of disjoint edges in §4.2, and the least distance of pairs that pass the double-normal test in Figure 6.
Of neither is λ_c ≤ σ + E or σ ≤ λ_c + E proved, and the example of §5 refutes both. What a polygon does prove is Theorems 3 and 4 of [approximation.md](approximation.md).";

fn preliminaries() -> Vec<Row> {
    let triangle = file("triangle-acute");
    let critical = separation(&triangle, Convention::Critical).sigma();
    let smooth = separation(&triangle, Convention::Smooth);
    let curve = file("mp06-figure-1");
    let distances = [0, 1, 2].map(|m| deviation(&curve, m));
    vec![
        row(
            "§1",
            "the \"doubly-critical self-distances\" are \"the same as MSD\"",
            &format!(
                "at corners and ends they differ: the triangle with sides 13, 14, 15 has a least doubly critical distance of {critical}, and no double normal. Here both are offered, as conventions. For smooth closed curves they agree"
            ),
            Verdict::holds(!smooth.is_infinite()),
        ),
        bernstein_row("§2.1", "c(t) = Σ C(n, i) (i − t)^{n−i} p_i"),
        row(
            "§2.1",
            "P_L ∪ P_R \"lies closer to c than the original control polygon\"",
            &format!(
                "MP06's curve, greatest distance at equal parameters after 0, 1, 2 subdivisions, certified: {}, {}, {}",
                distances[0].show(5),
                distances[1].show(5),
                distances[2].show(5)
            ),
            Verdict::holds((0..2).all(|m| distances[m + 1].ends().1 < distances[m].ends().0)),
        ),
    ]
}

/// The Bernstein polynomials, as CPJ12 and CPIJ14 print them.
pub fn bernstein_row(place: &str, printed: &str) -> Row {
    let half = fraction(1, 2);
    let weights = [1, 3, 3, 1].into_iter().enumerate().map(|(i, binomial)| {
        let base = whole(i as i64) - &half;
        (i..3).fold(whole(binomial), |power, _| power * &base)
    });
    let sum = weights.fold(whole(0), |sum, weight| sum + weight);
    row(
        place,
        printed,
        &format!("t^i (1 − t)^{{n−i}}. The printed weights do not sum to 1: for n = 3, t = 1/2 to {sum} (misprint)"),
        Verdict::equal(sum == whole(1)),
    )
}

fn distance(example: &Example) -> Vec<Row> {
    let cubic = whole_points(&[[0, 0], [1, 1], [2, 4], [3, 9]]);
    let second = second_differences(&cubic)
        .iter()
        .map(|v| infinity(v))
        .max()
        .expect("differences");
    let n = 3;
    let floors = fraction((n / 2) * (n / 2), 2 * n);
    let attained = deviation(&bezier_curve(&cubic), 0);
    let proved = nairn_peters_lutterkort(3);
    let spike = whole_points(&[[0, 0, 0], [1, 1, 1], [0, 0, 0]]);
    let bound = nairn_peters_lutterkort(2)
        * second_differences(&spike)
            .iter()
            .map(|v| infinity(v))
            .max()
            .expect("one");
    let top = bezier(&spike).evaluate(&fraction(1, 2)).expect("inside");
    let far = squared(&minus(&spike[1], &top));
    let euclidean = bounds(&example.pieces, Norm::Euclidean).distance_squared;
    let largest = deviation(&example.curve, 0);
    let parabola = deviation(&file("parabola"), 0);
    let k = Exact::root(&example.plan(Norm::Infinity).bounds.distance_squared)
        .ends()
        .0
        .clone();
    let m1 = least_power(&(&k / fraction(1, 100)), 2).expect("positive");
    let reaches = |m: i64| fraction(1, 100) * whole(4_i64.pow(m as u32)) >= k;
    vec![
        row(
            "N∞(n)",
            "⌊n/2⌋⌊n/2⌋/(2n)",
            &format!(
                "⌊n/2⌋⌈n/2⌉/(2n) (CPIJ14 print it so). For p_k = (k, k²), n = 3: distance of curve and polygon {}, certified; bound with N∞(3) = {proved}: {}, as printed with {floors}: {}",
                attained.show(6),
                &second * &proved,
                &second * &floors,
            ),
            Verdict::equal(&second * &floors >= *attained.ends().0),
        ),
        row(
            "\"the maximal Hausdorff distance … is given by\" (1/2)^{2m} ‖Δ₂P‖_∞ N∞(n)",
            "with the ∞-norm",
            &format!(
                "in the ∞-norm a bound. In Euclidean distance the norm of Δ₂ has to be Euclidean: the quadratic {} reaches up to {}, so its polygon is √({far}) from it, and the bound is {bound}",
                spike.iter().map(|p| shown(p)).collect::<Vec<_>>().join(", "),
                shown(&top),
            ),
            Verdict::holds(far <= &bound * &bound),
        ),
        row(
            "\"this distance is actually attained\"",
            "always",
            &format!(
                "MP06's curve: bound {} (Euclidean), distance at equal parameters {}, certified. It is attained for n = 2 (the parabola: {}), and where the second differences of a piece are all equal",
                Exact::root(&euclidean).show(7),
                largest.show(6),
                parabola.show(6),
            ),
            Verdict::holds(largest.ends().1 * largest.ends().1 >= euclidean),
        ),
        row(
            "(1)",
            "m₁ = ⌈−½ log₂(ε/(‖Δ₂P‖ N∞(n)))⌉ subdivisions suffice for ε",
            &format!("the least m with ‖Δ₂P‖N∞/4^m ≤ ε; MP06's curve, ε = 0.01: K = {k}, m₁ = {m1}"),
            Verdict::holds(reaches(m1) && !reaches(m1 - 1)),
        ),
    ]
}

fn derivative(example: &Example) -> Vec<Row> {
    let chain = example.curve.chain();
    let piece = &chain.pieces()[0];
    let points = control_points(piece);
    let polygon = Polygon::new(&chain, 6).expect("a polygon");
    let part: Vec<Point> = (0..=3).map(|k| polygon.point(0, k)).collect();
    let printed = times(&minus(&part[1], &part[0]), &whole(9));
    let derivative = piece.derivatives(&whole(0), 1).expect("the start")[1].clone();
    let ratio = &printed[0] / &derivative[0];
    assert_eq!(printed, times(&derivative, &ratio));
    // ΔP at 0 and at 1/3 against c'.
    let hodograph: Vec<Point> = points
        .windows(2)
        .map(|p| times(&minus(&p[1], &p[0]), &whole(3)))
        .collect();
    let third = fraction(1, 3);
    let same = bezier(&hodograph).evaluate(&third).expect("inside") == piece.derivatives(&third, 1).expect("inside")[1];
    // c' = 2t, halved once.
    let line = bezier_curve(&whole_points(&[[0, 0], [0, 0], [1, 0]]));
    let halved = Polygon::new(&line.chain(), 1).expect("a polygon");
    let listed: Vec<Point> = (0..2)
        .flat_map(|i| [whole(0), whole(1)].map(|u| halved.discrete_derivative(i, &u).expect("inside")))
        .collect();
    let at_third = line.chain().pieces()[0].derivatives(&third, 1).expect("inside")[1][0].clone();
    let wrong = &listed[1][0] - at_third;
    // The cubic 0, 0, 1, 1 at the middle.
    let step = whole_points(&[[0, 0], [0, 0], [1, 0], [1, 0]]);
    let curve = bezier_curve(&step);
    let measures = measure(&curve.chain()).expect("polynomial");
    let found = bounds(&measures, Norm::Infinity);
    let at = Polygon::new(&curve.chain(), 0).expect("a polygon");
    let half = fraction(1, 2);
    let gap = infinity(&minus(
        &at.discrete_derivative(0, &half).expect("inside"),
        &at.derivative_at(0, &half).expect("inside"),
    ));
    let sharp = Exact::root(&found.derivative_squared);
    let as_printed = Exact::root(&(&found.derivative_printed_squared / whole(4)));
    let plain = Exact::root(&(&found.derivative_printed_squared / whole(36)));
    let plan = example.plan(Norm::Infinity);
    let ends = [0, 1].map(|u| curve.chain().pieces()[0].derivatives(&whole(u), 1).expect("an end"));
    let chord = minus(&ends[0][0], &ends[1][0]);
    let forms = [dot(&chord, &ends[0][1]), dot(&chord, &ends[1][1])];
    vec![
        row(
            "§3.2",
            "ΔP = n{p₁ − p₀, …} generates c'",
            &format!(
                "MP06's first segment at t = 1/3: {}",
                shown(&piece.derivatives(&third, 1).expect("inside")[1])
            ),
            Verdict::equal(same),
        ),
        row(
            "P' after m subdivisions",
            "n{Δp₀, …}, with Δ as defined",
            &format!(
                "2^m{{Δp₀, …}}: Δ contains the n already, and a part runs 2^m times as fast. MP06's curve, m = 6: printed {}, c'(0) = {} on segment 1, {ratio} of it",
                shown(&printed),
                shown(&derivative),
            ),
            Verdict::equal(ratio == whole(1)),
        ),
        row(
            "",
            "P' = {p'₀, …, p'_{n−1}}; superscripts k, 1",
            &format!(
                "2^m·n points, {} for one cubic and m = 6; superscripts m, 1 (misprint)",
                3 << 6
            ),
            Verdict::equal(3 << 6 == 3),
        ),
        row(
            "D_m = 𝓛(P', [0, 1])",
            "uniform over all points of P'",
            &format!(
                "each part has its own [k/2^m, (k+1)/2^m]. Ends of parts are listed twice, so uniformly over [0, 1] the listed points are at wrong parameters: for c' = 2t and m = 1 they are {}, and at 1/3 the error is {wrong}, the bound 0",
                listed.iter().map(|p| p[0].to_string()).collect::<Vec<_>>().join(", "),
            ),
            Verdict::holds(wrong == whole(0)),
        ),
        row(
            "‖D_m − c'‖ ≤ (1/2)^{2m+1} N∞(n−1) n ‖Δ₂(ΔP)‖",
            "a bound",
            &format!(
                "n/2 times the sharp bound. The cubic 0, 0, 1, 1, m = 0: distance {gap} at t = 1/2, sharp bound {sharp}, printed {as_printed}. (Were ΔP plain differences, it would be {plain}, and false)"
            ),
            Verdict::holds(&gap <= as_printed.ends().0 && gap == *sharp.ends().0 && &gap > plain.ends().1),
        ),
        row(
            "(2)",
            "m₂ = ⌈−½(1 + log₂(ε_d/(N∞(n−1) n ‖Δ₂(ΔP)‖)))⌉",
            &format!(
                "the least m for the printed bound; MP06's curve, ε_d = 0.01: m₂ = {}, by the sharp bound {}",
                plan.m2.expect("a number"),
                plan.m2_proved.expect("a number")
            ),
            Verdict::equal({
                let x = Exact::root(&plan.bounds.derivative_printed_squared).ends().0.clone();
                least_power(&(x / fraction(2, 100)), 2) == plan.m2
            }),
        ),
        row(
            "§3.3",
            "c(s), c(t) establish a double normal if and only if ⟨c(s), c(t)⟩ = ⟨c(t), c(s)⟩ = 0",
            &format!(
                "where c' ≠ 0. The cubic 0, 0, 1, 1 is a straight segment; at s = 0, t = 1 both products are {} and {}, because c' = 0 there",
                forms[0], forms[1]
            ),
            Verdict::holds(forms.iter().any(|form| *form != whole(0))),
        ),
    ]
}

fn estimate(example: &Example) -> Vec<Row> {
    let chain = example.curve.chain();
    let pieces = &example.pieces;
    let [infinite, euclidean] = [Norm::Infinity, Norm::Euclidean].map(|norm| bounds(pieces, norm));
    let longest = infinite.longest_edge_squared.clone();
    let polygons: Vec<Polygon> = (0..=6).map(|m| Polygon::new(&chain, m).expect("a polygon")).collect();
    let lemma = polygons
        .iter()
        .enumerate()
        .all(|(m, polygon)| polygon.longest_edge_squared() * whole(1 << (2 * m)) <= longest);
    let fine = &polygons[6];
    let edges: Vec<Rational> = (0..fine.parts())
        .flat_map(|part| (0..3).map(move |k| (part, k)))
        .map(|(part, k)| squared(&minus(&fine.point(part, k + 1), &fine.point(part, k))))
        .collect();
    let shortest = Exact::root(edges.iter().min().expect("edges"));
    let longest_fine = fine.longest_edge_squared();
    let length = Exact::root(&longest_fine);
    let disjoint = [0, 3, 6].map(|m| Exact::root(&polygons[m].nearest_disjoint_edges().expect("edges").squared));
    let error = &example.plan(Norm::Infinity).error;
    let normalised: Exact = [&error[0] / length.ends().1, &error[1] / length.ends().0].into();
    let delta = fraction(1, 4);
    // p nearest to its partner q, and the end of the shortest double normal.
    let pair = fine.nearest_disjoint_edges().expect("edges");
    let on_polygon = |at: &Rational| {
        let scaled = at * whole(64);
        let part = scaled.floor();
        fine.at(part.to_integer().to_u64().expect("a part") as usize, &(scaled - part))
            .expect("a point")
    };
    let ends = example.sigma.ends.as_ref().expect("a box");
    let on_curve = ends
        .clone()
        .map(|[low, high]| chain.evaluate(&((low + high) / whole(2))).expect("a point"));
    let apart = pair
        .at
        .iter()
        .flat_map(|at| on_curve.iter().map(move |c| squared(&minus(&on_polygon(at), c))));
    let nearest = apart.min().expect("points");
    let half_error = &error[1] / whole(2);
    let sigma = example.sigma.sigma();
    vec![
        row(
            "§4.1",
            "‖γ̃‖ ≤ ε/2 after subdivision, so |⟨c(s), c(t)⟩_d| ≤ ε/2 (Cauchy–Schwarz)",
            &format!(
                "needs the Euclidean norm; (2) has the ∞-norm, up to √3 times smaller. MP06's curve: ‖Δ₂(ΔP)‖ = {} and {}",
                Exact::root(&(&infinite.derivative_squared * whole(16))).show(7),
                Exact::root(&(&euclidean.derivative_squared * whole(16))).show(7),
            ),
            Verdict::unproved(euclidean.derivative_squared > infinite.derivative_squared),
        ),
        row(
            "§4.2, Lemma 1",
            "ℓ_m ≤ ℓ₀/2^m",
            &format!(
                "an edge after one halving is half a mean of edges. MP06's curve: ℓ₀ = {}, ℓ₆ = {}",
                Exact::root(&longest).show(7),
                length.show(7)
            ),
            Verdict::holds(lemma),
        ),
        row(
            "\"λ_c, our estimate for σ\", the least distance of disjoint edges",
            "an estimate",
            &format!(
                "edges with one edge between them are disjoint, so λ_c → 0 for every curve. MP06's, m = 0, 3, 6: {}, {}, {}; σ = {}",
                disjoint[0].show(5),
                disjoint[1].show(5),
                disjoint[2].show(5),
                sigma.show(5)
            ),
            Verdict::holds(disjoint[2].ends().1 + &error[1] >= *sigma.ends().0),
        ),
        row(
            "\"d₁ < d₁², unless d₁ < 1\"",
            "<",
            "≤: for d₁ = 1 neither is true",
            Verdict::holds(whole(1) < &whole(1) * &whole(1)),
        ),
        row(
            "\"simplifying assumption that ℓ_m ≥ 1\"",
            "no restriction, by \"normalizing the measuring scale\"",
            &format!(
                "E is a square of lengths that is compared with a length, and changes with the scale. Scaled to ℓ₆ = 1, E of the example is {} in the units of the curve, above δ = {delta}",
                normalised.show(6)
            ),
            Verdict::holds(*normalised.ends().0 <= delta),
        ),
        row(
            "d₁ ≤ d₁²",
            "from ℓ_m ≥ 1",
            &format!(
                "d₁ is at least as long as *its own* edge L₁; ℓ_m is the longest edge. MP06's curve, m = 6: longest {}, shortest {}",
                length.show(5),
                shortest.show(5)
            ),
            Verdict::unproved(shortest.ends().1 < length.ends().0),
        ),
        row(
            "d(c(s), p) ≤ d₁",
            "≤ ε²/4 + ℓ₀²/2^{2m}",
            &format!(
                "p, q are where λ_c is attained; that they are beside c(s), c(t) is what was to be shown. The example: the distance of the nearest of them to an end of the shortest double normal is {}, the bound {}",
                Exact::root(&nearest).show(5),
                Exact::from([&error[0] / whole(2), half_error.clone()]).show(5)
            ),
            Verdict::unproved(nearest > (&half_error + fraction(1, 1000)) * (&half_error + fraction(1, 1000))),
        ),
        row(
            "(3)",
            "\"the smallest positive root\" of ½ε² + 2ℓ₀²ε/K − δ",
            "there is one positive root: the product of the two is −2δ",
            Verdict::holds(-whole(2) * &delta < whole(0)),
        ),
        row(
            "E ≤ δ",
            "for the ε of (3)",
            &format!(
                "holds for the formula E: {} (∞-norm), {} (Euclidean norm) ≤ {delta} in the example",
                Exact::from(error.clone()).show(6),
                Exact::from(example.plan(Norm::Euclidean).error.clone()).show(6)
            ),
            Verdict::holds(error[1] <= delta),
        ),
    ]
}
