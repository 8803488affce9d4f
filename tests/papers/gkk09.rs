//! GKK09 §2 to §4: sign functions, propositions, Theorem 1, knot insertion, the algorithm.

use knotproof::check::domain::Context;
use knotproof::claim::domain::{Outcome, Sign};
use knotproof::curve::{BSpline, Curve};
use knotproof::number::{Rational, RationalVector, decimal_down};
use knotproof::prove::domain::levels::{Degree, Level, Levels};
use knotproof::prove::domain::{Bounds, Options, Problem, Question, certify};
use knotproof::prove::linear_program::GoodLp;

use crate::exact::{
    Point, absolute, bezier, bezier_curve, control_points, cross, dot, file, fraction, squared, whole, whole_points,
};
use crate::gkk09_tables;
use crate::table::{Exact, Page, Row, Verdict, row};

pub fn write(page: &mut Page) {
    page.heading(2, "GKK09");
    page.text(INTRODUCTION);
    page.heading(3, "§2, sign functions and propositions");
    page.table(propositions());
    page.heading(3, "§3, inequalities and knot insertion");
    page.table(insertion());
    page.text(INSERTION);
    page.heading(3, "§4, the algorithm");
    page.table(algorithm());
    page.text(&rule_of_thumb());
    gkk09_tables::write(page);
}

const INTRODUCTION: &str = "\
Definitions and proofs as used here: [domain.md](domain.md). The control points of Figures 1, 3 and 5 are not printed, so the areas, volumes, vertices and faces of Tables 1 to 3 cannot be recomputed; what the tables say of each other can.";

const INSERTION: &str = "\
The tables subdivide every interval like a Bézier curve (the midpoint inserted to full multiplicity), and count the coefficient at a shared end twice. It is the midpoint of its neighbours and always redundant. At equal level the elevated form gives a slightly larger polygon; per inequality the true degree wins.";

/// What (20) is worth where levels are late enough.
fn rule_of_thumb() -> String {
    let cubic = levels::<2>(&file("domain-cubic"), &question(1, None, 20), 9);
    let difference = Exact::from(cubic[5].relative_error.clone().expect("an error"));
    let left = (&cubic[9].measure[0] - &cubic[5].measure[1]) / &cubic[5].measure[1];
    format!(
        "As coefficients converge quadratically, the true error falls by four from level to level, and the last difference is about three times the error that is left, for levels late enough: for `domain-cubic.json` with a box of edge 20 it is {} at level 5, where by level 9 the true error is at least {}. That is a rule of thumb. The sandwich of [domain.md](domain.md) bounds the error, and emptiness is proved there by at most d + 1 parameters or sides of the box.",
        difference.show(4),
        decimal_down(&left, 3)
    )
}

/// Coefficients of polynomials in Bernstein form.
type Coefficients = Vec<Rational>;

fn binomial(n: usize, k: usize) -> Rational {
    Rational::from_integer(knotproof::number::Integer::binomial(n as u32, k as u32))
}

fn product(a: &[Rational], b: &[Rational]) -> Coefficients {
    let (n, m) = (a.len() - 1, b.len() - 1);
    let mut found = vec![whole(0); n + m + 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            found[i + j] += x * y * binomial(n, i) * binomial(m, j) / binomial(n + m, i + j);
        }
    }
    found
}

fn derivative(a: &[Rational]) -> Coefficients {
    let n = whole(a.len() as i64 - 1);
    a.windows(2).map(|pair| (&pair[1] - &pair[0]) * &n).collect()
}

fn halves(a: &[Rational]) -> [Coefficients; 2] {
    let mut row = a.to_vec();
    let last = row.len() - 1;
    let (mut left, mut right) = (vec![row[0].clone()], vec![row[last].clone()]);
    for round in (0..last).rev() {
        for k in 0..=round {
            row[k] = (&row[k] + &row[k + 1]) / whole(2);
        }
        left.push(row[0].clone());
        right.push(row[round].clone());
    }
    right.reverse();
    [left, right]
}

/// a₁, a₂, b of (3) in Bernstein form of degree 2n − 3, for a planar Bézier curve with the free control point k.
fn sign_function(points: &[Point], k: usize) -> [Coefficients; 3] {
    let n = points.len() - 1;
    let own: Coefficients = (0..=n).map(|i| whole(i64::from(i == k))).collect();
    let rest = |axis: usize| -> Coefficients {
        let fixed = points.iter().enumerate();
        fixed
            .map(|(i, p)| if i == k { whole(0) } else { p[axis].clone() })
            .collect()
    };
    let first = [own, rest(0), rest(1)].map(|a| derivative(&a));
    let second = first.each_ref().map(|a| derivative(a));
    let determinant = |i: usize, j: usize| -> Coefficients {
        let (left, right) = (product(&first[i], &second[j]), product(&second[i], &first[j]));
        left.iter().zip(&right).map(|(x, y)| x - y).collect()
    };
    [determinant(0, 2), determinant(1, 0), determinant(1, 2)]
}

/// h at a point, in Bernstein form.
fn at(function: &[Coefficients; 3], d: &Point) -> Coefficients {
    let [a, b, c] = function;
    (0..a.len()).map(|j| &a[j] * &d[0] + &b[j] * &d[1] + &c[j]).collect()
}

fn determinant(a: &[Rational], b: &[Rational], c: &[Rational]) -> Rational {
    dot(a, &cross(b, c))
}

/// Levels of the paper's algorithm, in the paper's degree, with exact measures.
pub fn levels<const D: usize>(curve: &Curve, question: &Question, last: u32) -> Vec<Level> {
    let problem = Problem::new(curve, question).expect("a question");
    let context = Context::new(curve, &problem.domain).expect("a domain");
    let mut levels = Levels::<D>::new(&context, Degree::Paper, |_| true).expect("polynomial");
    (0..=last).map(|_| levels.step(false).0).collect()
}

pub fn question(point: usize, sign: Option<Sign>, edge: i64) -> Question {
    Question {
        point,
        sign,
        interval: None,
        bounds: Bounds::Edge(whole(edge)),
    }
}

fn propositions() -> Vec<Row> {
    // Numbers in place of the derivatives at a parameter: (N, s₁, s₂, s₃), orders 1 to 3, and a position.
    let jets = whole_points(&[[2, 3, 5], [7, 11, 13], [17, 19, 23], [29, 31, 41]]);
    let d = [whole(43), whole(47), whole(53)];
    let f: Vec<Point> = (1..4)
        .map(|i| jets[i].iter().zip(&jets[0]).map(|(s, n)| s + n * &d[i - 1]).collect())
        .collect();
    let two = |p: &Point, q: &Point| &p[0] * &q[1] - &p[1] * &q[0];
    let planar = two(&f[0], &f[1]);
    let planar_printed = two(&jets[0], &jets[2]) * &d[0] + two(&jets[1], &jets[0]) * &d[1] + two(&jets[1], &jets[2]);
    let spatial = determinant(&f[0], &f[1], &f[2]);
    let spatial_printed = determinant(&jets[0], &jets[2], &jets[3]) * &d[0]
        + determinant(&jets[1], &jets[0], &jets[3]) * &d[1]
        + determinant(&jets[1], &jets[2], &jets[0]) * &d[2]
        + determinant(&jets[1], &jets[2], &jets[3]);
    // c = 0 and N' ≠ 0 in the plane.
    let (n1, n2) = (whole(2), whole(3));
    let (s1, s2) = ([whole(7), whole(17)], [whole(7) * &n2 / &n1, whole(17) * &n2 / &n1]);
    let dependent = &n1 * &s2[0] == &n2 * &s1[0] && &n1 * &s2[1] == &n2 * &s1[1] && &s1[0] * &s2[1] == &s2[0] * &s1[1];
    let star = s1.clone().map(|s| -s / &n1);
    let only = (0..2).all(|axis| &star[axis] * &n1 + &s1[axis] == whole(0));
    // N = t, s = (t³, t⁴): F(d; t) at t = 0.
    let flat = bezier(&[
        vec![whole(0), whole(0)],
        vec![whole(0), whole(0)],
        vec![whole(0), whole(0)],
        vec![fraction(1, 4), whole(0)],
        vec![whole(1), whole(1)],
    ]);
    let start = flat.derivatives(&whole(0), 1).expect("the start");
    let near = flat.derivatives(&fraction(1, 1000), 2).expect("inside");
    let curvature = two(&near[1], &near[2]);
    // A quartic in space: 0, d, 0, (0, 1/4, 0), (0, 1, 1).
    let quartic = |d: [i64; 3]| {
        bezier(&[
            vec![whole(0), whole(0), whole(0)],
            d.iter().map(|x| whole(*x)).collect(),
            vec![whole(0), whole(0), whole(0)],
            vec![whole(0), fraction(1, 4), whole(0)],
            vec![whole(0), whole(1), whole(1)],
        ])
    };
    let flat_at_start = |d: [i64; 3]| {
        let jet = quartic(d).derivatives(&whole(0), 3).expect("the start");
        squared(&cross(&jet[1], &jet[2])) == whole(0) && determinant(&jet[1], &jet[2], &jet[3]) == whole(0)
    };
    let torsion = |d: [i64; 3]| -> Rational {
        let jet = quartic(d).derivatives(&fraction(1, 1_000_000), 3).expect("inside");
        determinant(&jet[1], &jet[2], &jet[3]) / squared(&cross(&jet[1], &jet[2]))
    };
    let limits = [[1, 0, 0], [2, 1, 0], [-1, 0, 0]].map(torsion);
    // h and F' × F'' vanish at t = 0 for four positions that span space, and so for all: h is affine, and F', F'' are multiples of d there.
    let everywhere = [[1, 1, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        .map(flat_at_start)
        .iter()
        .all(|flat| *flat);
    let positive = limits.iter().filter(|torsion| torsion.numer().is_positive()).count();
    // Cubics in space: h has degree 3n − 9 = 0, so one parameter tells.
    let collinear = |d: [i64; 3]| {
        let cubic = bezier(&whole_points(&[[0, 0, 0], [1, 0, 0], d, [3, 0, 0]]));
        let jet = cubic.derivatives(&fraction(1, 2), 3).expect("inside");
        determinant(&jet[1], &jet[2], &jet[3])
    };
    // 𝓗 is affine in the position: four that span space tell.
    let never = [[5, 0, 0], [5, 1, 0], [5, 0, 1], [-3, 7, 2]]
        .map(collinear)
        .iter()
        .all(|h| *h == whole(0));
    // Theorem 1: P₀, P₁, P₂ on a line, P₃ free.
    let cubic = whole_points(&[[0, 0], [1, 0], [2, 0], [3, 1]]);
    let function = sign_function(&cubic, 3);
    let inside = at(&function, &cubic[3]);
    let mut part = function.clone();
    let mut always = 0;
    for _ in 0..8 {
        if part.iter().all(|a| a[0] == whole(0)) {
            always += 1;
        }
        part = part.map(|a| halves(&a)[0].clone());
    }
    let in_k = inside[0] == whole(0) && inside[1..].iter().all(|c| c.numer().is_positive());
    vec![
        row(
            "(3), (4)",
            "h = a₁x + a₂y + b with the determinants of (3)",
            "the same, by numbers in place of the derivatives",
            Verdict::equal(planar == planar_printed),
        ),
        row(
            "(5)",
            "[Ḟ, F̈, F̈]",
            "[Ḟ, F̈, F⃛]: as printed it is 0 (misprint)",
            Verdict::equal(determinant(&f[0], &f[1], &f[1]) == spatial),
        ),
        row(
            "(6), (7)",
            "𝓗 = a₁x + a₂y + a₃z + b with the determinants of (6)",
            "the same, by numbers in place of the derivatives",
            Verdict::equal(spatial == spatial_printed),
        ),
        row(
            "Proposition 1.2",
            "half-spaces \"bounded by the half-plane 𝓗 = 0\"",
            "by the plane 𝓗 = 0 (misprint)",
            Verdict::misprint(),
        ),
        row(
            "Proposition 1",
            "c ≠ 0: D is an open half-plane or half-space",
            "Lemmas 1 and 3 of [domain.md](domain.md): where h ≠ 0 the point is ordinary, and h is affine",
            Verdict::proved(),
        ),
        row(
            "Proposition 2, (8) and b(t₀) = 0",
            "c = 0, Ṅ ≠ 0: s̈ = ṡ·N̈/Ṅ, so h ≡ 0",
            "the same, by numbers in place of the derivatives; in space N', s₁', s₂', s₃' and their derivatives have rank 2 at most, so 𝓗 ≡ 0 too",
            Verdict::equal(dependent),
        ),
        row(
            "(9)",
            "F is not regular for d* = −ṡ/Ṅ alone",
            "Ḟ = d Ṅ + ṡ: the same",
            Verdict::equal(only),
        ),
        row(
            "Proposition 2(ii)",
            "c = 0, Ṅ = 0, ṡ ≠ 0: D is empty or everything",
            "h = b for every d; where 𝓗 ≠ 0 curvature is not 0 either",
            Verdict::proved(),
        ),
        row(
            "Proposition 2(iii)",
            "Ṅ = 0, ṡ = 0: h vanishes for every d",
            "every determinant of (3) and (6) has a zero column",
            Verdict::proved(),
        ),
        row(
            "Proposition 2(i), plane",
            "D(t₀) is empty or one point d*",
            &format!(
                "the proof counts d* in, but Definition 1 asks for an ordinary point, and F'(d*; t₀) = 0: D is always empty. N = t, s = (t³, t⁴), t₀ = 0, d* = 0: F' = ({}, {}), while the sign of curvature tends to {}",
                start[1][0],
                start[1][1],
                if curvature.numer().is_positive() { "+" } else { "−" }
            ),
            Verdict::unproved(start[1].iter().all(|x| *x == whole(0))),
        ),
        row(
            "Proposition 2(i), space (\"without loss of generality … the planar case\")",
            "D(t₀) is empty or one point",
            &format!(
                "the exception is not a point in space. The quartic 0, d, 0, (0, 1/4, 0), (0, 1, 1) at t₀ = 0: c_τ = 0, Ṅ ≠ 0, and F' × F'' = 0 for every d. By Definition 1 D is empty. By limits, as in the proof, torsion is det(d, e₂, e₃)/(2|d × e₂|²), positive on a half-space: for d = (1, 0, 0), (2, 1, 0), (−1, 0, 0) it is {}, {}, {} at t = 10⁻⁶",
                Exact::from(limits[0].clone()).show(4),
                Exact::from(limits[1].clone()).show(4),
                Exact::from(limits[2].clone()).show(4)
            ),
            Verdict::unproved(everywhere && positive == 2),
        ),
        row(
            "after (12)",
            "L is an \"intersection of finite, possibly degenerate\" sets",
            "each is empty or everything, and so is L. They need not belong to finitely many parameters: a cubic in space with P₀, P₁, P₃ on a line and P₂ free is planar for every position, 𝓗 ≡ 0 for all t, and L is empty",
            Verdict::holds(never),
        ),
        row(
            "(13), Theorem 1",
            "every point of K_κ is in K^(ℓ) for all large ℓ",
            &format!(
                "K_κ leaves out the parameters with c_κ = 0, (13) and (16) do not. For (0, 0), (1, 0), (2, 0) and P₃ free h vanishes at t = 0 for every position: the inequality j = 0 is 0 > 0 at every level ({always} were looked at), all K^(ℓ) are empty, and (3, 1) is in K_κ: the coefficients there are {}. True where c_κ ≠ 0 throughout I",
                inside.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
            ),
            Verdict::holds(!(in_k && always == 8)),
        ),
    ]
}

fn insertion() -> Vec<Row> {
    let cubic = file("domain-cubic");
    let points = control_points(&cubic.chain().pieces()[0]);
    let function = sign_function(&points, 1);
    let own = levels::<2>(&cubic, &question(1, None, 20), 3);
    let problem = Problem::new(&cubic, &question(1, None, 20)).expect("a question");
    let context = Context::new(&cubic, &problem.domain).expect("a domain");
    let paper = Levels::<2>::new(&context, Degree::Paper, |_| true).expect("polynomial");
    let true_count = Levels::<2>::new(&context, Degree::True, |_| true)
        .expect("polynomial")
        .rows()
        .len();
    let rows = paper.rows();
    // Proportional with one positive factor.
    let factor = &function[0][1] / Rational::from_integer(rows[1].normal[0].clone());
    let same = factor.numer().is_positive()
        && rows.iter().enumerate().all(|(j, row)| {
            let scaled = |x: &knotproof::number::Integer| Rational::from_integer(x.clone()) * &factor;
            scaled(&row.normal[0]) == function[0][j]
                && scaled(&row.normal[1]) == function[1][j]
                && scaled(&row.constant) == function[2][j]
        });
    // One knot at the midpoint of every interval, for a function of degree 3 on one interval.
    let zeros = RationalVector::from_rationals(&vec![whole(0); 8]);
    let knots: Vec<Rational> = [0, 0, 0, 0, 1, 1, 1, 1].map(whole).to_vec();
    let mut spline = BSpline::new(2, 3, RationalVector::from_rationals(&knots), zeros, None).expect("a spline");
    let mut inserted = vec![spline.count()];
    for _ in 0..3 {
        let mut distinct: Vec<Rational> = spline.knots().iter().collect();
        distinct.dedup();
        let middles: Vec<Rational> = distinct
            .windows(2)
            .map(|pair| (&pair[0] + &pair[1]) / whole(2))
            .collect();
        spline = spline.refine(&middles).expect("refined");
        inserted.push(spline.count());
    }
    let formula: Vec<usize> = (1..4).map(|level| 3 + (1 << (level - 1)) + 1).collect();
    // Coefficients against values at the Greville abscissae, at the control point's own position.
    let quintic = control_points(&file("domain-quintic-bounded").chain().pieces()[0]);
    let mut parts = vec![at(&sign_function(&quintic, 2), &quintic[2])];
    let mut gaps = Vec::new();
    for _ in 0..7 {
        let gap = parts.iter().map(|part| {
            let n = part.len() - 1;
            let value = |k: usize| {
                let basis = knotproof::curve::bernstein(n, &fraction(k as i64, n as i64));
                dot(&basis, part)
            };
            (0..=n)
                .map(|k| absolute(&(&part[k] - value(k))))
                .max()
                .expect("coefficients")
        });
        gaps.push(gap.max().expect("parts"));
        parts = parts.iter().flat_map(|part| halves(part)).collect();
    }
    let quotients: Vec<Rational> = gaps.windows(2).map(|pair| &pair[0] / &pair[1]).collect();
    let grows = own.windows(2).all(|pair| pair[0].measure[1] <= pair[1].measure[1]);
    vec![
        row(
            "(3) multiplied out, # inequalities at ℓ = 0",
            "a cubic: 4 (degree 2n − 3)",
            &format!(
                "the degree of h is 2n − 4 (3n − 9 in space, where (6) gives 3n − 6): `certs/curves/domain-cubic.json` has {true_count} coefficients of its own, {} in the paper's form; both are one function",
                rows.len()
            ),
            Verdict::equal(same && rows.len() == true_count),
        ),
        row(
            "(14)",
            "sufficient for (13)",
            "basis functions are not negative and sum to 1",
            Verdict::proved(),
        ),
        row(
            "(13)",
            "p + 1 functions of order q need the knots t₀, …, t_{p+q}",
            &format!("p = {}, q = 4: {} knots", inserted[0] - 1, knots.len()),
            Verdict::equal(knots.len() == inserted[0] + 4),
        ),
        row(
            "(15), for p + 1 = 4, λ = 1, ℓ = 1, 2, 3",
            &format!("p_ℓ + 1 = p + λ·2^{{ℓ−1}} + 1 = {}", list(&formula)),
            &format!(
                "one knot in each of λ·2^{{ℓ−1}} intervals at every level: p_ℓ = p + λ(2^ℓ − 1), that is {}. (p_ℓ = p_{{ℓ−1}} + λ·2^{{ℓ−1}} would say so.)",
                list(&inserted[1..])
            ),
            Verdict::equal(formula == inserted[1..]),
        ),
        row(
            "(15) and Table 1, ℓ = 1, 2, 3",
            &format!("{} and 8, 16, 32", list(&formula)),
            "neither (15) nor the insertion of single knots is what the tables do",
            Verdict::equal(formula == [8, 16, 32] || inserted[1..] == [8, 16, 32]),
        ),
        row(
            "(18)",
            "coefficients converge quadratically to the values at the Greville abscissae",
            &format!(
                "`domain-quintic-bounded.json`: from level to level the greatest difference falls by {}: to 4",
                quotients
                    .iter()
                    .map(|x| Exact::from(x.clone()).show(4))
                    .collect::<Vec<_>>()
                    .join(", ")
            ),
            Verdict::holds(
                quotients
                    .last()
                    .is_some_and(|x| absolute(&(x - whole(4))) < fraction(1, 5)),
            ),
        ),
        row(
            "Remark 1, §4",
            "K^(ℓ) \"converges uniformly to the restriction of K_κ to any bounding box\", by Remark 1",
            "Remark 1 is about compact subsets of K_κ, and K_κ ∩ 𝓑 is open at the boundary of K_κ: near it no level is enough. With Theorem 1 the areas converge all the same, as the K^(ℓ) are nested and their union is K_κ ∩ 𝓑",
            Verdict::unproved(own.windows(2).all(|pair| pair[0].measure[1] < pair[1].measure[0])),
        ),
        row(
            "Remark 2",
            "K^(ℓ) ⊆ K^(ℓ+1)",
            &format!(
                "coefficients of a half are means of coefficients. `domain-cubic.json`: areas {}",
                own.iter()
                    .map(|level| Exact::from(level.measure.clone()).show(6))
                    .collect::<Vec<_>>()
                    .join(", ")
            ),
            Verdict::holds(grows),
        ),
    ]
}

fn list(counts: &[usize]) -> String {
    counts.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

fn algorithm() -> Vec<Row> {
    // A quartic whose polytopes grow late.
    let late = bezier_curve(&whole_points(&[[4, 9], [-4, -2], [-7, 6], [-8, 0], [-8, -1]]));
    let found = levels::<2>(&late, &question(1, Some(Sign::Positive), 20), 8);
    let tolerance = fraction(1, 8);
    let stop = found
        .iter()
        .position(|level| level.relative_error.as_ref().is_some_and(|error| error[1] <= tolerance))
        .expect("a level");
    let last_difference = Exact::from(found[stop].relative_error.clone().expect("an error"));
    let left = (&found[8].measure[0] - &found[stop].measure[1]) / &found[stop].measure[1];
    let cubic = levels::<2>(&file("domain-cubic"), &question(1, None, 20), 5);
    let empty = file("domain-quintic-empty");
    let ask = question(2, Some(Sign::Positive), 40);
    let none = levels::<2>(&empty, &ask, 6).iter().all(|level| level.vertices == 0);
    let problem = Problem::new(&empty, &ask).expect("a question");
    let options = Options {
        tolerance: fraction(1, 1000),
        budget: 20_000,
        name: None,
        snapped_joints: None,
        measure_rounds: false,
        solver: &GoodLp,
    };
    let document = certify(&empty, &problem, &options).document.expect("a document");
    let proved_empty = document.claim.statement.outcome == Outcome::Empty;
    let small = file("domain-quintic-late");
    let counts: Vec<usize> = levels::<2>(&small, &ask, 3)
        .iter()
        .map(|level| level.vertices)
        .collect();
    let first = counts.iter().position(|count| *count > 0).expect("a level");
    vec![
        row(
            "(19)",
            "δ(K^(ℓ+1), K^(ℓ)) = area(K^(ℓ+1) \\ K^(ℓ))",
            "by Remark 2",
            Verdict::holds(cubic.windows(2).all(|pair| pair[0].measure[0] <= pair[1].measure[1])),
        ),
        row(
            "(20), Output",
            "\"an approximant of K_κ ∩ 𝓑\" with rel.error ≤ tol, read as its error",
            &format!(
                "rel.error compares two iterates and does not bound the error: the quartic (4, 9), (−4, −2), (−7, 6), (−8, 0), (−8, −1) with P₁ free, box of edge 20 and tol = {tolerance} stops at level {stop} with {}; level 8 shows that the true relative error is at least {}",
                last_difference.show(4),
                decimal_down(&left, 4)
            ),
            Verdict::holds(left <= tolerance),
        ),
        row(
            "steps 1, 2",
            "ℓ ← ℓ + 1",
            "ℓ ← 0 is missing (misprint)",
            Verdict::misprint(),
        ),
        row(
            "\"terminates, after a finite number of steps\"",
            "when K_κ is not empty",
            &format!(
                "by Theorem 1, where that holds. Whether K_κ is empty the levels do not tell: of `domain-quintic-empty.json` (certified: {}) the levels 0 to 6 are empty, of `domain-quintic-late.json` the first {first} are, and its domain is not",
                if proved_empty { "empty" } else { "not empty" }
            ),
            Verdict::holds(none && proved_empty && first > 0),
        ),
        row(
            "Input",
            "a bounding box 𝓑 \"centered at the initial position of d\"",
            "Table 2 has a box that \"contains the entire K_κ\", which is not known before",
            Verdict::misprint(),
        ),
    ]
}
