//! CPJ12's example, recomputed exactly on MP06's curve, and the intervals that polygons prove, compared with certified ones.
#![cfg(feature = "prove")]

use knotproof::approximation::predecessor::{Subdivisions, extremes};
use knotproof::approximation::{Chord, Norm, Parameters, Plan, Polygon, measure, plan};
use knotproof::curve::{Curve, read_curve};
use knotproof::number::{Rational, RationalExt, decimal_down, sqrt_decimal_down};

fn fraction(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn curve(name: &str) -> Curve {
    let path = format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    read_curve(std::fs::read(&path).expect(&path)).expect(name).curve
}

#[test]
fn probe() {
    for name in [
        "mp06-figure-1",
        "cpij14-experiment-1",
        "closed-degree-5",
        "trefoil-24",
        "unclamped-periodic",
        "parabola",
        "helix-degree-9",
        "calpha-2000",
        "figure-eight",
        "cusp",
        "square",
        "stadium",
    ] {
        let c = curve(name);
        let chain = c.chain();
        let Ok(pieces) = measure(&chain) else {
            println!("{name} rational");
            continue;
        };
        println!("{name}: {} pieces", chain.count());
        for norm in [Norm::Infinity, Norm::Euclidean] {
            let p = plan(
                &pieces,
                &Parameters {
                    delta: fraction(1, 4),
                    epsilon_d: fraction(1, 100),
                    norm,
                },
            )
            .unwrap();
            println!(
                "  {norm:?} K {} Q {} X {} l0 {} eps {} m1 {:?} {:?} m2 {:?} {:?} m {} edges {:?} E {}",
                sqrt_decimal_down(&p.bounds.distance_squared, 8),
                sqrt_decimal_down(&p.bounds.derivative_squared, 8),
                sqrt_decimal_down(&p.bounds.derivative_printed_squared, 8),
                sqrt_decimal_down(&p.bounds.longest_edge_squared, 8),
                decimal_down(&p.epsilon[0], 10),
                p.m1,
                p.m1_whole_root,
                p.m2,
                p.m2_proved,
                p.subdivisions,
                p.edges,
                decimal_down(&p.error[0], 10)
            );
        }
        let e = extremes(&chain).unwrap();
        println!(
            "  K0 {} K1 {} mu0 {}",
            decimal_down(&e.speed[0], 8),
            decimal_down(&e.acceleration[0], 8),
            decimal_down(&e.least_speed[0], 8)
        );
        for eps in [fraction(1, 100), fraction(1, 200), fraction(1, 4)] {
            let i = [eps.clone(), eps];
            println!("   m~ {:?} {:?}", e.m1(&i), e.m2(&i));
        }
        for m in [0, 2, 4, 5, 6, 7] {
            if (chain.count() << m) > 4000 {
                continue;
            }
            let start = std::time::Instant::now();
            let polygon = Polygon::new(&chain, m).unwrap();
            let built = start.elapsed();
            let a = polygon.nearest_disjoint_edges();
            let ta = start.elapsed();
            let b = polygon.nearest_candidates(&fraction(1, 100), Chord::Curve);
            let tb = start.elapsed();
            let b2 = polygon.nearest_candidates(&fraction(1, 100), Chord::Polygon);
            let tb2 = start.elapsed();
            let v = polygon.vertex_clearance_squared();
            let tv = start.elapsed();
            let s = polygon.separation();
            let ts = start.elapsed();
            let d = |p: &Option<knotproof::approximation::Pair>| {
                p.as_ref()
                    .map(|p| (sqrt_decimal_down(&p.squared, 8), p.at[0].to_f64(), p.at[1].to_f64()))
            };
            println!(
                "  m {m} edges {} built {built:?}\n   disjoint {:?} {ta:?}\n  cand {:?} {tb:?}\n   candpoly {:?} {tb2:?}\n   nu {:?} {tv:?}\n  sep {:?} eta {} lower {:?} upper {:?} {ts:?}",
                polygon.edges(),
                d(&a),
                d(&b),
                d(&b2),
                v.map(|v| sqrt_decimal_down(&v, 8)),
                s.distance_squared.map(|x| sqrt_decimal_down(&x, 10)),
                decimal_down(&s.eta, 6),
                s.lower.map(|x| decimal_down(&x, 8)),
                s.upper.map(|x| decimal_down(&x, 8))
            );
        }
    }
}
