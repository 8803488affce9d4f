//! `miranda`.

use knotproof::number::Integer;
use serde_json::{Value, json};

use crate::common::case::{Case, Cases, expecting};
use crate::common::document::{Certificate, bezier, exact, polygon};

/// An interval, as a certificate has it.
type Pair = [&'static str; 2];

fn rule(s: Pair, t: Pair, factors: [[i64; 2]; 2], regular: Value, subdivisions: u32) -> Value {
    let [first, second] = factors.map(|pair| exact(json!(pair)));
    json!({ "rule": "miranda", "s": s, "t": t, "first": first, "second": second, "regular": exact2(regular), "subdivisions": subdivisions })
}

fn exact2(vectors: Value) -> Value {
    vectors
        .as_array()
        .expect("two vectors")
        .iter()
        .cloned()
        .map(exact)
        .collect()
}

const I: Pair = ["1/4", "3/4"];
const J: Pair = ["9/4", "11/4"];
/// F₁ grows with s, F₂ with t.
const GROWING: [[i64; 2]; 2] = [[-1, 0], [0, 1]];

/// The parabolas y = x² and y = 4 − x² for |x| ≤ 1, joined on the right. A double normal of length 4 is at 1/2, 5/2.
fn lens() -> Value {
    bezier(json!([
        [[-1, 1], [0, -1], [1, 1]],
        [[1, 1], [1, 3]],
        [[1, 3], [0, 5], [-1, 3]]
    ]))
}

fn across() -> Value {
    json!([[1, 0], [-1, 0]])
}

/// A chain whose first pieces are `below`, and a level side above them from (1, 4) to (−1, 4).
fn under_a_roof(below: Value) -> Value {
    let mut pieces = below.as_array().expect("pieces").clone();
    pieces.push(json!([[1, 1], [1, 4]]));
    pieces.push(json!([[1, 4], [-1, 4]]));
    bezier(Value::Array(pieces))
}

/// Cases of the rule.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("miranda");
    let lens_with = |rule: Value| Certificate::new(lens()).upper("81/4", rule);
    let plain = |factors, regular| rule(I, J, factors, regular, 1);
    let good = plain(GROWING, across());
    cases.accept("two-parabolas", &lens_with(good.clone()));
    cases.accept(
        "two-parabolas-in-the-convention-critical",
        &lens_with(good.clone()).critical(),
    );
    cases.accept("mixed-factors", &lens_with(plain([[-7, -1], [1, 7]], across())));
    cases.accept("sub-sections", &lens_with(rule(I, J, GROWING, across(), 5)));
    cases.accept("most-sub-sections", &lens_with(rule(I, J, GROWING, across(), 1024)));
    let huge = format!("-1{}", "0".repeat(300));
    cases.accept(
        "huge-factor",
        &lens_with(good.clone()).with("/evidence/upper/first/0", json!(huge)),
    );
    let bits = |bits: u32| {
        let factor = Integer::from(1) - Integer::from(2).pow(bits);
        let certificate = lens_with(good.clone());
        certificate.with("/evidence/upper/first/0", json!(factor.to_string()))
    };
    cases.accept("factor-of-65536-bits", &bits(65_536));
    cases.malformed("factor-of-65537-bits", bits(65_537).json(), |_| true);
    let bound = expecting("miranda", "upper_squared ≥ |p−q|² for all hull points");
    cases.reject(
        "bound-below",
        &lens_with(good.clone()).with("/statement/upper_squared", json!("81000000/4000001")),
        bound,
    );
    let count = expecting("miranda", "1 to 1,024 subdivisions");
    cases.reject(
        "no-sub-sections",
        &lens_with(rule(I, J, GROWING, across(), 0)),
        count.clone(),
    );
    cases.reject(
        "too-many-sub-sections",
        &lens_with(rule(I, J, GROWING, across(), 1025)),
        count,
    );

    let independent = expecting("miranda", "α₁β₂ ≠ α₂β₁");
    for (name, factors) in [
        ("zero-factors", [[0, 0], [0, 0]]),
        ("zero-first-factors", [[0, 0], [0, 1]]),
        ("dependent-factors", [[-1, 1], [2, -2]]),
    ] {
        cases.reject(name, &lens_with(plain(factors, across())), independent.clone());
    }
    let face = expecting("miranda", "one strict sign on each face");
    for (name, factors) in [
        ("first-reversed", [[1, 0], [0, 1]]),
        ("second-reversed", [[-1, 0], [0, -1]]),
        ("exchanged", [[0, 1], [-1, 0]]),
    ] {
        cases.reject(name, &lens_with(plain(factors, across())), face.clone());
    }
    cases.reject(
        "no-double-normal-inside",
        &lens_with(rule(["5/8", "7/8"], J, GROWING, across(), 8)),
        face.clone(),
    );
    // The double normal is on the edge of the box: a product is zero there.
    cases.reject(
        "double-normal-on-a-face",
        &lens_with(rule(["1/2", "3/4"], ["5/2", "11/4"], GROWING, across(), 64)),
        face.clone(),
    );
    let regular = expecting("miranda", "m·v > 0 for all tangents of an interval");
    for (name, vectors) in [
        ("zero-witness", json!([[0, 0], [-1, 0]])),
        ("second-zero-witness", json!([[1, 0], [0, 0]])),
        ("witness-reversed", json!([[-1, 0], [-1, 0]])),
        ("witness-orthogonal-to-a-tangent", json!([[1, 1], [-1, 0]])),
    ] {
        cases.reject(name, &lens_with(plain(GROWING, vectors)), regular.clone());
    }
    intervals(&mut cases);

    // A cusp: D = (3a², 2a) vanishes at a = 0 and all faces have their signs, yet the one-sided tangents are vertical there.
    let cusp = under_a_roof(json!([[[-1, 1], [1, "-1/3"], [-1, "-1/3"], [1, 1]]]));
    let roof =
        |curve, regular| Certificate::new(curve).upper("30", rule(I, ["17/8", "23/8"], [[-1, 0], [0, -1]], regular, 1));
    for (name, vector) in [("cusp", [1, 0]), ("cusp-tangent", [0, 1]), ("cusp-slanted", [1, 1])] {
        cases.reject(name, &roof(cusp.clone(), json!([vector, [-1, 0]])), regular.clone());
    }
    // The same box over the parabola in its place holds a double normal.
    let parabola = under_a_roof(json!([[[-1, 1], ["-1/3", "-1/3"], ["1/3", "-1/3"], [1, 1]]]));
    cases.accept("parabola-in-place-of-the-cusp", &roof(parabola, across()));

    // A corner that points away: the faces have their signs, but no chord from the corner is orthogonal to either of its sides.
    let wedge = polygon(json!([[-1, 1], [0, 0], [1, 1], [1, 4], [-1, 4]]));
    let wide = |curve| {
        Certificate::new(curve).upper(
            "18",
            rule(["1/2", "3/2"], ["25/8", "31/8"], [[-1, 0], [0, -1]], across(), 1),
        )
    };
    cases.reject(
        "corner-inside",
        &wide(wedge.clone()),
        expecting("miranda", "no corner inside"),
    );
    // In the other convention the chord from the corner to the roof counts: it is orthogonal to the sum of the corner's directions.
    cases.accept("corner-inside-critical", &wide(wedge).critical());
    // Where the curve goes down before and behind the corner, no chord to the roof is critical there.
    let falling = polygon(json!([[-1, 4], [0, 0], [1, "-1/2"], [1, 9], [-1, 9]]));
    let over = rule(["1/2", "3/2"], ["25/8", "31/8"], [[-1, 0], [0, -1]], across(), 1);
    cases.reject(
        "corner-inside-not-critical",
        &Certificate::new(falling).critical().upper("200", over),
        face.clone(),
    );
    // A smooth joint inside, where D jumps by a factor: the parabola in two pieces of different speed.
    let pieces = under_a_roof(json!([
        [[-1, 1], ["-3/4", "1/2"], ["-1/2", "1/4"]],
        [["-1/2", "1/4"], ["1/4", "-1/2"], [1, 1]]
    ]));
    let jump =
        |s| Certificate::new(pieces.clone()).upper("30", rule(s, ["25/8", "31/8"], [[-1, 0], [0, -1]], across(), 4));
    cases.accept("smooth-joint-inside", &jump(["3/4", "7/4"]));
    cases.reject(
        "smooth-joint-inside-but-no-double-normal",
        &jump(["1/2", "5/4"]),
        face.clone(),
    );

    straight(&mut cases, &face);
    space(&mut cases, &face);
    cases.list()
}

/// Intervals that are none.
fn intervals(cases: &mut Cases) {
    let on = |curve: Value, s, t| Certificate::new(curve).upper("81/4", rule(s, t, GROWING, across(), 1));
    let none = expecting("miranda", "two intervals of the curve");
    for (name, s, t) in [
        ("reversed-interval", ["3/4", "1/4"], J),
        ("second-interval-reversed", I, ["11/4", "9/4"]),
        ("empty-interval", ["1/2", "1/2"], J),
        ("negative-start", ["-1/4", "1/2"], J),
        ("too-long", ["1/4", "21/16"], J),
        ("beyond-the-end", I, ["9/4", "25/8"]),
    ] {
        cases.reject(name, &on(lens(), s, t), none.clone());
    }
    let apart = expecting("miranda", "disjoint intervals in order");
    for (name, s, t) in [
        ("exchanged-intervals", J, I),
        ("one-interval-twice", I, I),
        ("intervals-that-touch", ["1/4", "3/4"], ["3/4", "1"]),
    ] {
        cases.reject(name, &on(lens(), s, t), apart.clone());
    }
    // Closed: J may go past M, but not as far as I again.
    let closed = bezier(json!([
        [[-1, 1], [0, -1], [1, 1]],
        [[1, 1], [1, 3]],
        [[1, 3], [0, 5], [-1, 3]],
        [[-1, 3], [-1, 1]]
    ]));
    cases.accept("closed", &on(closed.clone(), I, J));
    cases.reject(
        "round-to-the-other-interval",
        &on(closed.clone(), I, ["15/4", "17/4"]),
        apart.clone(),
    );
    cases.reject("round-past-the-other-interval", &on(closed, I, ["15/4", "19/4"]), apart);
}

/// A straight line has no double normal, however it is parametrised; with vectors scaled one by one all faces would have their signs.
fn straight(cases: &mut Cases, face: &(impl Fn(&knotproof::check::Rejection) -> bool + Clone + 'static)) {
    let line = bezier(json!([[[0, 0], [1, 0], [2, 0]], [[2, 0], [3, 0], [4, 0]]]));
    let on = |curve: &Value, s, t, factors| {
        Certificate::new(curve.clone()).upper("100", rule(s, t, factors, json!([[1, 0], [1, 0]]), 1))
    };
    // D is (1, 0) everywhere. Numerators over the parameters' denominators: 2 at 1/2, 3 at 2/3, 4 at 5/4, 5 at 7/5; 6 and 20 on the
    // intervals. With these in place of D, the faces pass.
    cases.reject(
        "straight-line-numerators-for-vectors",
        &on(&line, ["1/2", "2/3"], ["5/4", "7/5"], [[-8, 1], [3, -4]]),
        face.clone(),
    );
    // Faster and faster: D from (1, 0) to (5, 0), on both pieces.
    let faster = bezier(json!([[[0, 0], [1, 0], [6, 0]], [[6, 0], [11, 0], [26, 0]]]));
    for (i, factors) in [
        [[1, -1], [1, 1]],
        [[-1, 0], [0, 1]],
        [[-3, 1], [1, -3]],
        [[5, -1], [-1, 5]],
        [[-1, 1], [-1, -1]],
        [[-2, 1], [2, 1]],
    ]
    .into_iter()
    .enumerate()
    {
        cases.reject(
            &format!("straight-line-{i}"),
            &on(&faster, ["1/8", "7/8"], ["9/8", "15/8"], factors),
            face.clone(),
        );
    }
}

/// Two skew arcs in space, and two that no double normal joins.
fn space(cases: &mut Cases, face: &(impl Fn(&knotproof::check::Rejection) -> bool + Clone + 'static)) {
    let arcs = bezier(json!([
        [[-1, 0, 1], [0, 0, -1], [1, 0, 1]],
        [[1, 0, 1], [0, -1, 3]],
        [[0, -1, 3], [0, 0, 5], [0, 1, 3]]
    ]));
    let rule = |factors| rule(I, J, factors, json!([[1, 0, 0], [0, 1, 0]]), 2);
    cases.accept(
        "skew-arcs",
        &Certificate::new(arcs.clone()).upper("21", rule([[-1, 0], [0, 1]])),
    );
    cases.reject(
        "skew-arcs-reversed",
        &Certificate::new(arcs).upper("21", rule([[1, 0], [0, 1]])),
        face.clone(),
    );
}
