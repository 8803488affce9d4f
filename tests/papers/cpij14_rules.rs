//! CPIJ14 §2 to §6: definitions, and the formulas of second differences under perturbation. All are linear, so they are compared on a basis.

use knotproof::approximation::{Polygon, nairn_peters_lutterkort};
use knotproof::number::Rational;

use crate::cpj12::bernstein_row;
use crate::exact::{Point, absolute, bezier_curve, fraction, minus, second_differences, whole, whole_points};
use crate::table::{Row, Verdict, noted, row};

/// Control point p_{j+i}, before the perturbation.
type Points<'a> = &'a dyn Fn(i64) -> Rational;
/// Where p_{j+i} is afterwards, the sums of the perturbation vectors given.
type Moved = fn(i64, Points, &[Rational]) -> Rational;

/// A printed formula for Δ₂ of p_{j+at} after a perturbation.
struct Formula {
    place: &'static str,
    text: &'static str,
    at: i64,
    moved: Moved,
    /// p_j is the midpoint of its neighbours before.
    joint: bool,
    printed: fn(Points, &[Rational]) -> Rational,
    /// The right formula, where the printed one is not.
    right: &'static str,
}

const REACH: i64 = 5;
const SUMS: usize = 4;

/// Is it true for each point and each sum that is 1, while all others are 0?
fn on_basis(test: impl Fn(Points, &[Rational]) -> bool) -> bool {
    (0..=2 * REACH as usize + SUMS).all(|i| {
        let unit = |k: usize| whole(i64::from(k == i));
        let points = |k: i64| unit((k + REACH) as usize);
        let sums: Vec<Rational> = (0..SUMS).map(|k| unit(2 * REACH as usize + 1 + k)).collect();
        test(&points, &sums)
    })
}

impl Formula {
    fn row(&self) -> Row {
        let agrees = on_basis(|p, sums| {
            let points = |k: i64| match self.joint && k == 0 {
                true => (p(-1) + p(1)) / whole(2),
                false => p(k),
            };
            let moved = |k: i64| (self.moved)(k, &points, sums);
            let exact = moved(self.at - 1) - moved(self.at) * whole(2) + moved(self.at + 1);
            exact == (self.printed)(&points, sums)
        });
        row(self.place, self.text, self.right, Verdict::equal(agrees))
    }
}

fn second(p: Points, k: i64) -> Rational {
    p(k - 1) - p(k) * whole(2) + p(k + 1)
}

fn half(n: i64) -> Rational {
    fraction(n, 2)
}

/// p_j alone (§5.1, and type 3).
fn alone(i: i64, p: Points, g: &[Rational]) -> Rational {
    if i == 0 { p(i) + &g[0] } else { p(i) }
}

fn two(i: i64, p: Points, g: &[Rational]) -> Rational {
    if (0..2).contains(&i) {
        p(i) + &g[i as usize]
    } else {
        p(i)
    }
}

fn four(i: i64, p: Points, g: &[Rational]) -> Rational {
    if (0..4).contains(&i) {
        p(i) + &g[i as usize]
    } else {
        p(i)
    }
}

/// p_j of type 1, p_{j+1} the junction.
fn type_1(i: i64, p: Points, g: &[Rational]) -> Rational {
    match i {
        0 => p(0) + &g[0],
        1 => (p(0) + &g[0] + p(2)) / whole(2),
        _ => p(i),
    }
}

fn type_2(i: i64, p: Points, g: &[Rational]) -> Rational {
    if (-1..=1).contains(&i) { p(i) + &g[0] } else { p(i) }
}

/// §6.3: both neighbours and the junction p_{j+1}.
fn three(i: i64, p: Points, g: &[Rational]) -> Rational {
    match i {
        0 => p(0) + &g[0] + &g[1],
        1 => (three(0, p, g) + three(2, p, g)) / whole(2),
        2 => p(2) + &g[1] + &g[2],
        _ => p(i),
    }
}

#[rustfmt::skip]
const FORMULAS: [Formula; 30] = [
    Formula { place: "§5.1", text: "Δ₂(δ₁p_{j−1}) = p_{j−2} − p_{j−1} + p_j + γ", at: -1, moved: alone, joint: false, right: "p_{j−2} − 2p_{j−1} + p_j + γ (misprint)",
        printed: |p, g| p(-2) - p(-1) + p(0) + &g[0] },
    Formula { place: "", text: "… = Δ₂(p_{j−1}) + γ", at: -1, moved: alone, joint: false, right: "the same", printed: |p, g| second(p, -1) + &g[0] },
    Formula { place: "", text: "Δ₂(δ₁p_j) = Δ₂(p_j) − 2γ", at: 0, moved: alone, joint: false, right: "the same", printed: |p, g| second(p, 0) - &g[0] * whole(2) },
    Formula { place: "", text: "Δ₂(δ₁p_{j+1}) = Δ₂(p_{j+1}) + γ", at: 1, moved: alone, joint: false, right: "the same", printed: |p, g| second(p, 1) + &g[0] },
    Formula { place: "§5.2, u = 2", text: "Δ₂(δ_n p_{k−1}) = Δ₂(p_{k−1}) + Σγ_k", at: -1, moved: two, joint: false, right: "the same", printed: |p, g| second(p, -1) + &g[0] },
    Formula { place: "", text: "Δ₂(δ_n p_k) = Δ₂(p_k) + Σ(γ_{k+1} − 2γ_k)", at: 0, moved: two, joint: false, right: "the same", printed: |p, g| second(p, 0) + &g[1] - &g[0] * whole(2) },
    Formula { place: "", text: "Δ₂(δ_n p_{k+1}) = Δ₂(p_{k+1}) + Σ(γ_k − 2γ_{k+1})", at: 1, moved: two, joint: false, right: "the same", printed: |p, g| second(p, 1) + &g[0] - &g[1] * whole(2) },
    Formula { place: "", text: "Δ₂(δ_n p_{k+2}) = Δ₂(p_{k+2}) + Σγ_{k+1}", at: 2, moved: two, joint: false, right: "the same", printed: |p, g| second(p, 2) + &g[1] },
    Formula { place: "§5.2, u ≥ 3 (here 4)", text: "Δ₂(δ_n p_{k−1}) = Δ₂(p_{k−1}) + Σγ_k", at: -1, moved: four, joint: false, right: "the same", printed: |p, g| second(p, -1) + &g[0] },
    Formula { place: "", text: "Δ₂(δ_n p_k) = Δ₂(p_k) + Σ(γ_{k+1} − 2γ_k)", at: 0, moved: four, joint: false, right: "the same", printed: |p, g| second(p, 0) + &g[1] - &g[0] * whole(2) },
    Formula { place: "", text: "Δ₂(δ_n p_s) = Δ₂(p_s) + Σ(γ_{s−1} − 2γ_s + γ_{s+1})", at: 2, moved: four, joint: false, right: "the same", printed: |p, g| second(p, 2) + &g[1] - &g[2] * whole(2) + &g[3] },
    Formula { place: "", text: "Δ₂(δ_n p_{k+v}) = Δ₂(p_{k+v}) + Σ(γ_{k+v−1} − 2γ_{k+v})", at: 3, moved: four, joint: false, right: "the same", printed: |p, g| second(p, 3) + &g[2] - &g[3] * whole(2) },
    Formula { place: "", text: "Δ₂(δ_n p_{k+v+1}) = Δ₂(p_{k+v+1}) + Σγ_{k+v}", at: 4, moved: four, joint: false, right: "the same", printed: |p, g| second(p, 4) + &g[3] },
    Formula { place: "§6.2, type 1", text: "Δ₂(δ_n p_{j−1}) = Δ₂p_{j−1} + Σγ", at: -1, moved: type_1, joint: false, right: "the same", printed: |p, g| second(p, -1) + &g[0] },
    Formula { place: "", text: "Δ₂(δ_n p_j) = (p_{j−1} − 3/2 p_j + 1/2 p_{j+2}) − 3/2 Σγ", at: 0, moved: type_1, joint: false, right: "the same", printed: |p, g| p(-1) - p(0) * half(3) + p(2) * half(1) - &g[0] * half(3) },
    Formula { place: "", text: "Δ₂(δ_n p_{j+1}) = 0", at: 1, moved: type_1, joint: false, right: "the same", printed: |_, _| whole(0) },
    Formula { place: "", text: "Δ₂(δ_n p_{j+2}) = (1/2 p_j − 3/2 p_{j+2} + p_{j+3}) + 1/2 Σγ", at: 2, moved: type_1, joint: false, right: "the same", printed: |p, g| p(0) * half(1) - p(2) * half(3) + p(3) + &g[0] * half(1) },
    Formula { place: "§6.2, type 2", text: "Δ₂(δ_n p_{j−2}) = Δ₂(p_{j−2}) + Σγ", at: -2, moved: type_2, joint: true, right: "the same", printed: |p, g| second(p, -2) + &g[0] },
    Formula { place: "", text: "Δ₂(δ_n p_{j−1}) = Δ₂(p_{j−1}) − Σγ", at: -1, moved: type_2, joint: true, right: "the same", printed: |p, g| second(p, -1) - &g[0] },
    Formula { place: "", text: "Δ₂(δ_n p_j) = 0", at: 0, moved: type_2, joint: true, right: "the same, as p_j is the midpoint before", printed: |_, _| whole(0) },
    Formula { place: "", text: "Δ₂(δ_n p_{j+1}) = Δ₂(p_{j−1}) − Σγ", at: 1, moved: type_2, joint: true, right: "Δ₂(p_{j+1}) − Σγ (misprint)", printed: |p, g| second(p, -1) - &g[0] },
    Formula { place: "", text: "Δ₂(δ_n p_{j+2}) = Δ₂(p_{j+2}) + Σγ", at: 2, moved: type_2, joint: true, right: "the same", printed: |p, g| second(p, 2) + &g[0] },
    Formula { place: "§6.2, type 3", text: "Δ₂(δ_n p_{j−1}) = Δ₂(p_{j−1}) + Σγ", at: -1, moved: alone, joint: false, right: "the same", printed: |p, g| second(p, -1) + &g[0] },
    Formula { place: "", text: "Δ₂(δ_n p_j) = Δ₂(p_j) − 2Σγ", at: 0, moved: alone, joint: false, right: "the same", printed: |p, g| second(p, 0) - &g[0] * whole(2) },
    Formula { place: "", text: "Δ₂(δ_n p_{j+1}) = Δ₂(p_{j+1}) + Σγ", at: 1, moved: alone, joint: false, right: "the same", printed: |p, g| second(p, 1) + &g[0] },
    Formula { place: "§6.3", text: "Δ₂(δ_n p_{j−1}) = Δ₂p_{j−1} + Σ(γ_j + γ_{j+1})", at: -1, moved: three, joint: false, right: "the same", printed: |p, g| second(p, -1) + &g[0] + &g[1] },
    Formula { place: "", text: "Δ₂(δ_n p_j) = p_{j−1} − 3/2 p_j + 1/2 p_{j+2} + Σ(−3/2 γ_j − γ_{j+1} + 1/2 γ_{j+2})", at: 0, moved: three, joint: false,
        right: "the same, with the sum from k = 1 (printed 0; there is no γ_{j,0})", printed: |p, g| p(-1) - p(0) * half(3) + p(2) * half(1) - &g[0] * half(3) - &g[1] + &g[2] * half(1) },
    Formula { place: "", text: "Δ₂(δ_n p_{j+1}) = 0", at: 1, moved: three, joint: false, right: "the same", printed: |_, _| whole(0) },
    Formula { place: "", text: "Δ₂(δ_n p_{j+2}) = 1/2 p_j − 3/2 p_{j+2} + p_{j+3} + Σ(1/2 γ_j − γ_{j+1} − 3/2 γ_{j+2})", at: 2, moved: three, joint: false, right: "the same",
        printed: |p, g| p(0) * half(1) - p(2) * half(3) + p(3) + &g[0] * half(1) - &g[1] - &g[2] * half(3) },
    Formula { place: "", text: "Δ₂(δ_n p_{j+3}) = Δ₂p_{j+3} + Σ(γ_{j+1} + γ_{j+2})", at: 3, moved: three, joint: false, right: "the same", printed: |p, g| second(p, 3) + &g[1] + &g[2] },
];

/// §5 and §6, formula by formula.
pub fn formulas() -> Vec<Row> {
    FORMULAS.iter().map(Formula::row).collect()
}

/// §2 and §4.
pub fn definitions() -> Vec<Row> {
    let piece = bezier_curve(&whole_points(&[[0, 0], [1, 2], [3, 2], [4, 0]]));
    let halved = Polygon::new(&piece.chain(), 2).expect("a polygon");
    let points = halved.edges() + 1;
    let printed_w = 4 * 3 + 1;
    vec![
        bernstein_row("Definition 1", "c(t) = Σ C(d, i) (i − t)^{d−i} q_i"),
        row(
            "§4: δ_j p_i",
            "p_i + Σ_{k=1}^{J} γ_{i,k}",
            "the sum up to j (misprint)",
            Verdict::misprint(),
        ),
        row(
            "Example 1",
            "X₁ = {p₀, p₁ + γ_{1,1}, p₂, p₃ + γ_{3,1}}, X₂ = {p₀, p₁ + γ_{1,1} + γ_{1,2}, p₂, p₃ + γ_{3,1} + γ_{3,2}}",
            "the same, by the definition of δ_j p_i",
            Verdict::equal(on_basis(|p, g| {
                p(1) + &g[0] + &g[1] == alone(0, &|k| p(k + 1), &[&g[0] + &g[1]])
            })),
        ),
        row(
            "after α subdivisions",
            "(1/2)^{2a} ‖Δ₂X‖_∞ N∞(d)",
            "(1/2)^{2α} (misprint)",
            Verdict::misprint(),
        ),
        row(
            "N∞(d)",
            "⌈d/2⌉⌊d/2⌋/(2d)",
            &format!("the same; N∞(3) = {}", nairn_peters_lutterkort(3)),
            Verdict::equal(nairn_peters_lutterkort(3) == fraction(2, 6)),
        ),
        noted(
            "§4: \"there are generated w control points where w = 2^α d + 1\"; α = 2, d = 3",
            "w = ",
            &printed_w.to_string(),
            points,
            "control points",
        ),
        noted(
            "X₀ = {p₀, …, p_w}; α = 2, d = 3",
            "w + 1 = ",
            &(printed_w + 1).to_string(),
            points,
            "points: the last index is 2^α d, and Γ has 2^α d + 1 rows",
        ),
    ]
}

fn greatest(points: &[Point]) -> Rational {
    second_differences(points)
        .iter()
        .map(|v| absolute(&v[0]))
        .max()
        .expect("points")
}

fn line(values: &[i64]) -> Vec<Point> {
    values.iter().map(|x| vec![half(*x)]).collect()
}

/// §5 and §6, what is said of the formulas.
pub fn claims() -> Vec<Row> {
    // A spike is flattened.
    let (before, after) = (line(&[0, 2, 0]), line(&[0, 0, 0]));
    let by_formula = greatest(&before).max(greatest(&after));
    // p₁ and p₃ move by 1 each, p₂ between them rests.
    let (rest, moved) = (line(&[0, 0, -1, 0, 0]), line(&[0, 2, -1, 2, 0]));
    let old = second_differences(&rest);
    let gamma = whole(1);
    let chains = [
        absolute(&(&old[0][0] - &gamma * whole(2))),
        absolute(&(&old[1][0] + &gamma)),
        absolute(&(&old[2][0] - &gamma * whole(2))),
        greatest(&rest),
    ];
    let printed = chains.iter().max().expect("values").clone();
    let actual = greatest(&moved);
    // Quadratics: p₂ and p₄ are junctions, and moving p₂ takes p₁ and p₃ along, which are beside p₀ and p₄ too.
    let quadratics = line(&[0, 2, 4, 6, 8, 10, 12]);
    let mut taken = quadratics.clone();
    for k in 1..=3 {
        taken[k][0] += whole(1);
    }
    let bent = &second_differences(&taken)[3][0];
    // Cubics, type 1 and type 2: the junction stays the midpoint.
    let smooth = |points: &[Point], joint: usize| {
        minus(&points[joint], &points[joint - 1]) == minus(&points[joint + 1], &points[joint])
    };
    let mut cubic = line(&[0, 2, 6, 8, 10, 0, 4]);
    let start = smooth(&cubic, 3);
    cubic[2][0] += whole(5);
    cubic[3][0] = (&cubic[2][0] + &cubic[4][0]) / whole(2);
    let type_1 = smooth(&cubic, 3);
    for k in 2..=4 {
        cubic[k][0] += whole(7);
    }
    let type_2 = smooth(&cubic, 3);
    vec![
        row(
            "§5.1, §6.2",
            "‖Δ₂X₁‖ = max{‖Δ₂X₀‖, ‖Δ₂(δ₁p_{j−1})‖, ‖Δ₂(δ₁p_j)‖, ‖Δ₂(δ₁p_{j+1})‖}",
            &format!(
                "≤: ‖Δ₂X₀‖ counts old values of points that moved. For 0, 1, 0 and γ = −1 the right side is {by_formula}, ‖Δ₂X₁‖ = {}",
                greatest(&after)
            ),
            Verdict::holds(by_formula == greatest(&after)),
        ),
        row(
            "§5.2",
            "chains of adjacent moved points can be treated one by one",
            &format!(
                "not where one resting point lies between two chains: its second difference changes by both. For 0, 0, −1/2, 0, 0, degree 4, and γ₁ = γ₃ = 1 the formulas give at most {printed}, and ‖Δ₂X₁‖ = {actual}: the bound of the distance is too small"
            ),
            Verdict::holds(actual <= printed),
        ),
        row("Example 2", "p₂ → p₂ + γ₂", "p₂ + γ (misprint)", Verdict::misprint()),
        row(
            "§6.3",
            "\"Let p_j and p_{j+2} be type 1 …, so p_j is a type 2\"",
            "p_{j+1} is of type 2 (misprint)",
            Verdict::misprint(),
        ),
        row(
            "§6.3",
            "p_{j+1} → 1/2 (p_j + p_{j+2} + Σ(γ_j + 2γ_{j+1} + γ_{j+2}))",
            "the midpoint of its neighbours",
            Verdict::equal(on_basis(|p, g| {
                let printed = (p(0) + p(2) + &g[0] + &g[1] * whole(2) + &g[2]) / whole(2);
                printed == three(1, p, g)
            })),
        ),
        row(
            "§6.1, types 1 and 2",
            "\"a perturbation strategy that guarantees C¹ continuity\"",
            "cubic pieces with equal spans: the junction is the midpoint of its neighbours after a move of either type, and so for every degree of 3 and more",
            Verdict::holds(start && type_1 && type_2),
        ),
        row(
            "",
            "for Bézier curves of any degree",
            &format!(
                "not for degree 2, where a point is beside two junctions: for 0, 1, …, 6 and γ = 1 at the junction p₂, type 2 takes p₁ and p₃ along, and at the junction p₄ the second difference becomes {bent}"
            ),
            Verdict::holds(*bent == whole(0)),
        ),
    ]
}
