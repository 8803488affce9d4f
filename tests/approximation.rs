//! CPJ12's example, recomputed exactly on MP06's curve, and the intervals that polygons prove, compared with certified ones.
#![cfg(feature = "prove")]

use knotproof::approximation::predecessor::{Subdivisions, extremes};
use knotproof::approximation::{Chord, Norm, Parameters, Plan, Polygon, bounds, measure, plan};
use knotproof::claim::msd::Lower;
use knotproof::curve::{Curve, read_curve};
use knotproof::number::{Rational, decimal_down, decimal_up, sqrt_decimal_down};
use knotproof::prove::msd::{Options, certify};

fn fraction(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn curve(name: &str) -> Curve {
    let path = format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    read_curve(std::fs::read(&path).expect(&path)).expect(name).curve
}

/// δ = 0.25 and ε_d = 0.01, as in CPJ12 §5.
fn example(norm: Norm) -> Plan {
    let curve = curve("mp06-figure-1");
    let pieces = measure(&curve.chain()).expect("polynomial pieces");
    let parameters = Parameters {
        delta: fraction(1, 4),
        epsilon_d: fraction(1, 100),
        norm,
    };
    plan(&pieces, &parameters).expect("positive tolerances")
}

#[test]
fn the_example_of_cpj12_as_printed() {
    let plan = example(Norm::Infinity);
    // K = 8.25/3, ℓ₀² = 40.875, X = 3·33.625/4.
    assert_eq!(plan.bounds.distance_squared, fraction(11, 4) * fraction(11, 4));
    assert_eq!(plan.bounds.longest_edge_squared, fraction(327, 8));
    assert_eq!(
        plan.bounds.derivative_printed_squared,
        fraction(807, 32) * fraction(807, 32)
    );
    assert_eq!(decimal_down(&plan.epsilon[0], 8), "0.0084085967");
    assert_eq!(decimal_up(&plan.epsilon[1], 8), "0.0084085968");
    // m = 6 and 960 segments as printed, because of the factor 3/2 in the bound of the derivative.
    assert_eq!((plan.m1, plan.m2, plan.subdivisions), (Some(5), Some(6), 6));
    assert_eq!(plan.edges, Some(960));
    assert_eq!((plan.m1_whole_root, plan.m2_proved), (Some(5), Some(5)));
    // E is not the 0.0034415 of the paper.
    assert_eq!(decimal_down(&plan.error[0], 6), "0.0199938");
    assert_eq!(decimal_up(&plan.error[1], 6), "0.0199939");
    // ε = 0.01 is the root with K in the Euclidean norm, not halved.
    let plan = example(Norm::Euclidean);
    assert_eq!(plan.bounds.distance_squared, fraction(761, 72));
    assert_eq!(decimal_down(&plan.epsilon[0], 8), "0.0099401399");
    assert_eq!((plan.m1, plan.m2, plan.edges), (Some(5), Some(6), Some(960)));
    assert_eq!(decimal_down(&plan.error[0], 6), "0.0200078");
}

#[test]
fn the_method_before() {
    let curve = curve("mp06-figure-1");
    let found = extremes(&curve.chain()).expect("polynomial pieces");
    assert_eq!(found.speed, [fraction(21, 2), fraction(21, 2)]);
    assert_eq!(found.acceleration, [fraction(99, 2), fraction(99, 2)]);
    assert_eq!(decimal_down(&found.least_speed[0], 6), "2.33801");
    assert_eq!(decimal_up(&found.least_speed[1], 6), "2.33802");
    // 10,240 = 5·2^11 segments: m̃₁ alone, with the ε = 0.01 of the paper.
    let printed = [fraction(1, 100), fraction(1, 100)];
    assert_eq!(found.m1(&printed), Subdivisions::Exactly(11));
    assert_eq!(found.m2(&printed), Subdivisions::Exactly(13));
    assert_eq!(found.subdivisions(&printed), Subdivisions::Exactly(13));
    assert_eq!(curve.chain().count() << 11, 10_240);
    // A sine of an angle above 1 is not taken.
    assert_eq!(found.m2(&[fraction(3, 1), fraction(3, 1)]), Subdivisions::Undecided);
    assert_eq!(
        found.m1(&[Rational::default(), Rational::default()]),
        Subdivisions::Undecided
    );
}

#[test]
fn the_estimate_of_the_example_misses_sigma_and_the_polygon_proves_it() {
    let curve = curve("mp06-figure-1");
    let polygon = Polygon::new(&curve.chain(), 6).expect("a polygon");
    assert_eq!(polygon.edges(), 960);
    assert_eq!(sqrt_decimal_down(&polygon.longest_edge_squared(), 6), "0.0773398");
    let disjoint = polygon.nearest_disjoint_edges().expect("disjoint edges");
    assert_eq!(sqrt_decimal_down(&disjoint.squared, 6), "0.0176725");
    // The value of test 4 of MP06's table, which the authors call wrong.
    for chord in [Chord::Curve, Chord::Polygon] {
        let found = polygon.nearest_candidates(&fraction(1, 100), chord).expect("a pair");
        assert_eq!(sqrt_decimal_down(&found.squared, 5), "0.91921");
    }
    // One subdivision more, and the pair of the least double normal passes.
    let finer = Polygon::new(&curve.chain(), 7).expect("a polygon");
    let found = finer
        .nearest_candidates(&fraction(1, 100), Chord::Curve)
        .expect("a pair");
    assert_eq!(sqrt_decimal_down(&found.squared, 5), "0.44268");
    let proved = polygon.separation();
    assert_eq!(decimal_down(&proved.lower.expect("finite"), 5), "0.44114");
    assert_eq!(decimal_up(&proved.upper.expect("a double normal"), 5), "0.44433");
    assert_eq!(polygon.vertex_clearance_squared(), Some(disjoint.squared));
}

#[test]
fn proved_intervals_contain_the_certified_ones() {
    for (name, shortest_exists) in [
        ("mp06-figure-1", true),
        ("cpij14-experiment-1", true),
        ("trefoil-24", true),
        ("closed-degree-5", false),
        ("unclamped-periodic", false),
        ("parabola", false),
        ("segment", false),
        ("square", false),
        ("cusp", false),
        ("figure-eight", true),
    ] {
        let curve = curve(name);
        let mut certified = certify(&curve, &Options::default(), &|_| ()).expect(name);
        let statement = certified.document.claim.statement.clone();
        certified
            .write_checked(
                knotproof::certificate::Encoding::Binary,
                &mut std::io::Cursor::new(Vec::new()),
            )
            .expect(name);
        for m in [2, 4] {
            let proved = Polygon::new(&curve.chain(), m).expect(name).separation();
            // Bounds of σ from both sides never contradict each other.
            if let (Some(lower), Some(upper)) = (&proved.lower, &statement.upper_squared) {
                assert!(lower * lower <= *upper, "{name}, {m}");
            }
            assert!(
                proved.lower.is_some() || statement.upper_squared.is_none(),
                "{name}, {m}"
            );
            if let (Some(upper), Lower::Finite(lower)) = (&proved.upper, &statement.lower_squared) {
                assert!(upper * upper >= *lower, "{name}, {m}");
            }
            assert!(
                proved.upper.is_none() || statement.lower_squared != Lower::Infinite,
                "{name}, {m}"
            );
            if m == 4 {
                assert_eq!(proved.upper.is_some(), shortest_exists, "{name}");
            }
        }
    }
}

#[test]
fn the_longest_edge_shrinks_by_half_at_least() {
    // CPJ12's Lemma 1.
    let curve = curve("mp06-figure-1");
    let chain = curve.chain();
    let longest = bounds(&measure(&chain).expect("polynomial pieces"), Norm::Euclidean).longest_edge_squared;
    for m in 0..7 {
        let polygon = Polygon::new(&chain, m).expect("a polygon");
        assert!(polygon.longest_edge_squared() * fraction(1 << (2 * m), 1) <= longest);
    }
}
