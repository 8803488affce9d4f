//! MP06: the doubly normal test, the numbers of Table 1, Newton's method from its starts.

use knotproof::curve::{Chain, Curve};
use knotproof::float;
use knotproof::number::{Rational, RationalExt};

use crate::double_normals::{All, DoubleNormal, double_normals};
use crate::exact::{dot, fraction, minus, number, squared, whole};
use crate::mp06::{printed_segments, sigma};
use crate::sampling::{
    Found, NewtonRuns, Piece, Sample, Test, inner_parameters, newton, samples, short_chords, shortest,
};
use crate::table::{Exact, Page, Row, Verdict, named, noted, rounded_from, row, unknown, value};

pub fn write(page: &mut Page, curve: &Curve) {
    page.heading(3, "§1, the value, and Newton's method");
    page.table(sigma(curve));
    page.table(method(curve));
    page.heading(3, "§1, Table 1");
    let all = double_normals(curve);
    page.table(table_1(curve));
    page.table(other_double_normals(&all));
    page.text(TABLE_1);
    page.text(PLACEMENTS);
    page.plain_table(
        &[
            "samples of each segment, n = 1000, ε₁ = 0.001, ε₂ = 0.01",
            "shortest chord that passes",
            "one way",
            "rounded",
            "rounded, one way",
        ],
        &placements(curve),
    );
    page.heading(3, "§1, the doubly normal test (10), (11)");
    page.table(culling(curve));
    page.text(CULLING);
    page.heading(3, "§1, the rest");
    page.table(the_rest(curve, &all));
}

const TABLE_1: &str = "\
The tests are repeated with the samples k/n, 0 < k < n, of each segment and with magnitudes in (10) and (11). Whether a chord passes is decided in binary64; the length of the chord found is exact. The wrong values of tests 3 and 4 are near the lengths of the next double normals.";

const PLACEMENTS: &str = "\
Test 4 depends on where the samples lie. *One way*: chords between two segments are tested from the segment with the lower number only, as the paper's number of tests has it. *Rounded*: with the control points of the segments as printed.";

const CULLING: &str = "\
The two tests compare a dot product without an absolute value; a strongly negative product passes. As printed, the inequalities find a chord beside the shortest double normal in tests 3 and 4 too: the program must have compared magnitudes.

What tests 3 and 4 show is the point of a certificate: from within, a wrong value looks like a right one. Sampling and Newton's method give upper bounds (up to rounding). That no shorter double normal exists is a statement of another kind.";

/// The exact length of a chord between two samples.
fn length(chain: &Chain, samples: &[Sample], found: &Found) -> Exact {
    let [p, q] = found.ends.map(|end| {
        let sample = &samples[end];
        chain.pieces()[sample.piece]
            .evaluate(&sample.parameter)
            .expect("inside")
    });
    Exact::root(&squared(&minus(&p, &q)))
}

fn ends(samples: &[Sample], found: &Found) -> String {
    let mut ends = found.ends;
    ends.sort_unstable();
    let text = ends.map(|end| format!("{} on segment {}", samples[end].parameter, samples[end].piece + 1));
    text.join(", ")
}

/// Newton's method with n = 10, ε₁ = ε₂ = 0.4 and ε = 0.0001, in binary64; the length of the shortest chord that it ends with is exact.
fn newton_from_ten(curve: &Curve) -> (NewtonRuns, Exact) {
    let chain = curve.chain();
    let pieces = Piece::all(&chain);
    let runs = newton(&pieces, &samples(&pieces, &inner_parameters(10)), 0.4, 1e-4);
    let (_, at) = runs.shortest.expect("a double normal");
    let [p, q] = at.map(|(piece, u)| {
        let u = Rational::from_f64(u).expect("finite");
        chain.pieces()[piece].evaluate(&u).expect("inside")
    });
    let length = Exact::root(&squared(&minus(&p, &q)));
    (runs, length)
}

fn method(curve: &Curve) -> Vec<Row> {
    let (runs, found) = newton_from_ten(curve);
    let chain = curve.chain();
    let count = |counts: &[usize]| runs.iterations.iter().filter(|n| counts.contains(n)).count();
    let typical = count(&[3, 4]);
    let pairs = (0..chain.count()).map(|i| i + 1).sum::<usize>();
    let total = runs.iterations.len();
    vec![
        row(
            "Newton's method with n = 10, ε₁ = ε₂ = 0.4, ε = 0.0001",
            "0.44268",
            &format!(
                "{found}, from {} starts in binary64, the last chord exactly",
                runs.starts
            ),
            Verdict::of("0.44268", &found),
        ),
        row(
            "\"Typically, convergence … occurred after 3 or 4 iterations\"",
            "3 or 4",
            &format!(
                "of {total} runs that converge, {} take 1 or 2 iterations, {typical} take 3 or 4, {} take more",
                count(&[1, 2]),
                total - typical - count(&[1, 2]),
            ),
            Verdict::holds(2 * typical > total),
        ),
        named(
            "\"a value of n = 10 for the number of parametric values\": 0.1, 0.2, …, 0.9",
            "",
            "10",
            inner_parameters(10).len(),
        ),
        row(
            "pairs of segments",
            "\"c_i and c_j, i = j = 1, …, 5\"",
            &format!(
                "i, j = 1, …, 5 with i ≤ j: {pairs} pairs; i = j would be {} (misprint)",
                chain.count()
            ),
            Verdict::equal(pairs == chain.count()),
        ),
    ]
}

fn table_1(curve: &Curve) -> Vec<Row> {
    let chain = curve.chain();
    let pieces = Piece::all(&chain);
    let mut rows = Vec::new();
    for (test, n, epsilon, printed, reach) in [
        ("1", 10_000, [0.001, 0.01], "0.44268", 0.4428),
        ("2", 2000, [0.001, 0.01], "0.44268", 1.0),
        ("3", 2000, [0.001, 0.001], "0.81230", 1.0),
        ("4", 1000, [0.001, 0.01], "0.91921", 1.0),
    ] {
        let all = samples(&pieces, &inner_parameters(n));
        let found = shortest(&all, epsilon, Test::BothWays, reach).expect("a chord passes");
        let place = format!(
            "test {test}: IEA, n = {}, ε₁ = {}, ε₂ = {}",
            Exact::from(n as usize),
            epsilon[0],
            epsilon[1]
        );
        rows.push(noted(
            &place,
            "",
            printed,
            length(&chain, &all, &found),
            &format!("({})", ends(&all, &found)),
        ));
    }
    rows.push(value(
        "test 5: Newton, n = 10, ε₁ = ε₂ = 0.4",
        "0.44268",
        newton_from_ten(curve).1,
    ));
    rows.push(noted(
        "the same with the control points of the segments as printed",
        "",
        "0.44268",
        newton_from_ten(&printed_segments()).1,
        "so the paper's values are those of unrounded segments",
    ));
    let all = samples(&pieces, &inner_parameters(2000));
    let second = length(
        &chain,
        &all,
        &shortest(&all, [0.001, 0.01], Test::BothWays, 0.45).expect("a chord passes"),
    );
    rows.push(row(
        "\"n = 2000 is sufficient to compute the global separation of 0.4427\"",
        "0.4427",
        "with samples k/n",
        Verdict::holds(Verdict::of("0.4427", &second) == Verdict::Rounded),
    ));
    let middles: Vec<Rational> = (1..=1000).map(|k| fraction(2 * k - 1, 2000)).collect();
    let all = samples(&pieces, &middles);
    let fourth = length(
        &chain,
        &all,
        &shortest(&all, [0.001, 0.01], Test::BothWays, 1.0).expect("a chord passes"),
    );
    rows.push(row(
        "\"n = 1000 is not sufficient\"",
        "not 0.4427",
        &format!(
            "it depends on where the samples lie: with (k−½)/n test 4 gives {}",
            fourth.show(8)
        ),
        Verdict::holds(Verdict::of("0.4427", &fourth) != Verdict::Rounded),
    ));
    rows.push(unknown(
        "times",
        "85 s, 6 s, 6 s, 2 s, negligible",
        "times of a machine of 2006",
    ));
    rows
}

/// The wrong values of Table 1 belong to other double normals.
fn other_double_normals(all: &All) -> Vec<Row> {
    let place = |found: &DoubleNormal| {
        let ends = found.ends.each_ref().map(|end| Exact::from(end.clone()).show(6));
        format!("at {} and {}, pieces counted from 0", ends[0], ends[1])
    };
    let [_, second, third, ..] = all.found.as_slice() else {
        panic!("three double normals");
    };
    vec![
        noted(
            "test 3 and the second shortest double normal",
            "",
            "0.81230",
            second.length.clone(),
            &place(second),
        ),
        noted(
            "test 4 and the third",
            "",
            "0.91921",
            third.length.clone(),
            &place(third),
        ),
    ]
}

/// Where the samples of test 4 may lie.
fn placements(curve: &Curve) -> Vec<Vec<String>> {
    // The control points of the segments as printed, rounded to four decimals.
    let rounded = printed_segments();
    let n = 1000;
    let parameters: [(&str, Vec<Rational>); 5] = [
        ("k/n, 0 < k < n", inner_parameters(n)),
        ("k/n, 0 ≤ k ≤ n", (0..=n).map(|k| fraction(k, n)).collect()),
        ("k/(n+1), 1 ≤ k ≤ n", inner_parameters(n + 1)),
        ("(k−1)/(n−1), 1 ≤ k ≤ n", (0..n).map(|k| fraction(k, n - 1)).collect()),
        (
            "(k−½)/n, 1 ≤ k ≤ n",
            (1..=n).map(|k| fraction(2 * k - 1, 2 * n)).collect(),
        ),
    ];
    let found = |curve: &Curve, parameters: &[Rational], test: Test| {
        let chain = curve.chain();
        let all = samples(&Piece::all(&chain), parameters);
        let found = shortest(&all, [0.001, 0.01], test, 1.5).expect("a chord passes");
        length(&chain, &all, &found).show(8)
    };
    let line = |(name, parameters): (&str, Vec<Rational>)| {
        vec![
            name.into(),
            found(curve, &parameters, Test::BothWays),
            found(curve, &parameters, Test::OneWay),
            found(&rounded, &parameters, Test::BothWays),
            found(&rounded, &parameters, Test::OneWay),
        ]
    };
    parameters.into_iter().map(line).collect()
}

fn culling(curve: &Curve) -> Vec<Row> {
    let chain = curve.chain();
    let pieces = Piece::all(&chain);
    let [_, below] = rounded_from("0.44268");
    let all = samples(&pieces, &inner_parameters(2000));
    let mut least: Option<Found> = None;
    short_chords(&all, below.to_f64(), |found| {
        let size = |i: usize| found.products[i].abs();
        if size(1) < 0.01 && least.is_none_or(|least| size(0) < least.products[0].abs()) {
            least = Some(found);
        }
    });
    let least = least.expect("a chord");
    let [first, second] = exact_products(&chain, &all, &least);
    let printed = |n: i64, epsilon: [f64; 2]| {
        let all = samples(&pieces, &inner_parameters(n));
        let found = shortest(&all, epsilon, Test::Printed, 1.0).expect("a chord passes");
        length(&chain, &all, &found)
    };
    let third = printed(2000, [0.001, 0.001]);
    let fourth = printed(1000, [0.001, 0.01]);
    let engine = float::Curve::from_exact(curve).expect("binary64");
    let passing = |comparison| {
        let test = float::DoublyNormalTest {
            samples: 1000,
            first: 0.001,
            second: 0.01,
            comparison,
        };
        engine.sampled_separation(&test).expect("samples").starts
    };
    let (many, few) = (
        passing(float::Comparison::Printed),
        passing(float::Comparison::Magnitude),
    );
    vec![
        row(
            "(10), (11)",
            "⟨p₁, p₂⟩·c'(s₁) < ε₁, ⟨p₂, p₁⟩·c'(s₂) < ε₂",
            &format!(
                "|⟨p₁, p₂⟩·c'(s₁)| < ε₁ and likewise: with n = 1000, ε₁ = 0.001, ε₂ = 0.01, {} chords pass as printed, {} with magnitudes",
                Exact::from(many),
                Exact::from(few),
            ),
            Verdict::equal(many == few),
        ),
        row(
            "test 3 with (10), (11) as printed",
            "0.81230",
            &third.to_string(),
            Verdict::of("0.81230", &third),
        ),
        row(
            "test 4 with (10), (11) as printed",
            "0.91921",
            &fourth.to_string(),
            Verdict::of("0.91921", &fourth),
        ),
        row(
            "ε₁ = 0.001, ε₂ = 0.01, n = 2000: \"Values smaller than these would result in critical doubly normal segments not being found\"",
            "no smaller ε₁",
            &format!(
                "with samples k/n, ε₂ = 0.01 and any ε₁ above {} a chord of length {} passes; its second product is {}",
                first.show(4),
                length(&chain, &all, &least),
                second.show(4),
            ),
            Verdict::holds(*first.ends().0 >= number("0.001")),
        ),
        unknown(
            "\"Values greater than these would result in too many double normal segments being found\"",
            "too many",
            "no number is printed",
        ),
        row(
            "\"Comparing test number 3 to test 2 shows the importance of carefully choosing … ε₁ and ε₂\"",
            "test 3 is wrong",
            "0.81230 ≠ σ; with samples k/n and ε₁ = ε₂ = 0.001 nothing shorter passes",
            Verdict::holds(shortest(&all, [0.001, 0.001], Test::BothWays, 0.8).is_none()),
        ),
    ]
}

/// |x·T|/(|x||T|) at both ends of a chord.
fn exact_products(chain: &Chain, samples: &[Sample], found: &Found) -> [Exact; 2] {
    let [p, q] = found.ends.map(|end| {
        let sample = &samples[end];
        chain.pieces()[sample.piece]
            .derivatives(&sample.parameter, 1)
            .expect("inside")
    });
    let x = minus(&q[0], &p[0]);
    [&p[1], &q[1]].map(|tangent| {
        let product = dot(&x, tangent);
        Exact::root(&(&product * &product / (squared(&x) * squared(tangent))))
    })
}

fn the_rest(curve: &Curve, all: &All) -> Vec<Row> {
    let n = whole(2000);
    let same = &n * (&n - whole(1)) * whole(5);
    let other = &n * &n * whole(4 + 3 + 2 + 1);
    let sum = &same + &other;
    let once = &same / whole(2) + &other;
    vec![
        named("tests for n = 2000", "(2000)(1999)(5) = ", "19,990,000", same.clone()),
        named("", "as ", "1.999e7", same.clone()),
        named("", "(2000)(2000)(4+3+2+1) = ", "40,000,000", other.clone()),
        row(
            "",
            "≈ 60 million",
            &Exact::from(sum.clone()).to_string(),
            Verdict::of("60.0e6", &sum.clone().into()),
        ),
        row(
            "the number of tests",
            "≈ 60 million",
            &format!(
                "pairs on one segment are counted twice, pairs on two segments once. Every pair once: {}; in both orders, as (10) and (11) need: {}",
                Exact::from(once.clone()),
                Exact::from(&once * whole(2)),
            ),
            Verdict::equal(sum == once || sum == once * whole(2)),
        ),
        value(
            "independent implementation [2]: \"verified to be 0.44268\"",
            "0.44268",
            crate::certified::separation(curve, knotproof::claim::msd::Convention::Smooth).sigma(),
        ),
        unknown("the same with ε₁ = ε₂ = 0.1", "starts, iterations", "n is not printed"),
        row(
            "\"this minimum [occurs] for two different pairs of points in close proximity\"",
            "two pairs",
            &format!(
                "one pair: the next double normal has the length {}",
                all.found[1].length
            ),
            Verdict::holds(
                all.found
                    .iter()
                    .filter(|found| *found.length.ends().0 < number("0.4427"))
                    .count()
                    > 1,
            ),
        ),
        row(
            "Figure 1: \"many doubly normal segments exist on this curve\"",
            "many",
            &format!(
                "exactly {}, of the lengths {}. Proof: pairs of parts are excluded by their tangents, and in each box that is left the map (f, g) has one zero (operator of Krawczyk, in exact fractions)",
                all.found.len(),
                all.found
                    .iter()
                    .map(|found| found.length.show(5))
                    .collect::<Vec<_>>()
                    .join(", "),
            ),
            Verdict::holds(all.found.len() > 2),
        ),
    ]
}
