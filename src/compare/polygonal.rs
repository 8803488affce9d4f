//! The rows of CPJ12, of the method before it, and of what the polygon proves.

use super::certified::Certified;
use super::{CompareError, Options, Row, Standing, Value};
use crate::approximation::predecessor::{Subdivisions, extremes};
use crate::approximation::{
    ApproximationError, Chord, Norm, Pair, Parameters, PieceMeasures, Plan, Polygon, measure, plan,
};
use crate::claim::msd::Lower;
use crate::curve::Chain;
use crate::number::{Integer, Rational, sqrt_enclosure};

const CPJ12: &str = "CPJ12";
const CPIJ14: &str = "CPIJ14";
const BEFORE: &str = "before CPJ12";
/// Why there is no number of subdivisions.
const NOTHING: &str = "the polygon is the curve: the formula takes log 0";
/// Why there is none of the method before.
const NONE: &str = "c' vanishes or K₁ is 0, or ε is 0 or above 2, or the enclosures do not tell";
const POLYGON: &str = "polygon";
/// √ is enclosed this closely.
const ROOT_BITS: u32 = 96;

/// Rows, and the number of subdivisions they are about.
pub(super) struct Polygonal {
    pub rows: Vec<Row>,
    pub subdivisions: u32,
}

/// All rows; for a curve with a rational piece one that says so.
pub(super) fn rows(chain: &Chain, options: &Options, certified: &Certified) -> Result<Polygonal, CompareError> {
    let parameters = |norm| Parameters {
        delta: options.delta.clone(),
        epsilon_d: options.epsilon_d.clone(),
        norm,
    };
    // Tolerances are refused for every curve alike.
    plan(&[], &parameters(Norm::Infinity)).map_err(CompareError::Tolerance)?;
    let pieces = match measure(chain) {
        Ok(pieces) => pieces,
        Err(error) => {
            let refused = Row::new(CPJ12, "cpj12.m", "subdivisions m", Value::None, Standing::Exact);
            return Ok(Polygonal {
                rows: vec![refused.remark(error.to_string())],
                subdivisions: 0,
            });
        }
    };
    let printed = plan(&pieces, &parameters(Norm::Infinity)).map_err(CompareError::Tolerance)?;
    let euclidean = plan(&pieces, &parameters(Norm::Euclidean)).map_err(CompareError::Tolerance)?;
    let mut rows = plan_rows(&pieces, &printed, &euclidean);
    let mut subdivisions = 0;
    if printed.is_feasible() {
        subdivisions = printed.subdivisions;
        estimate_rows(chain, options, &printed, certified, &mut rows).map_err(CompareError::Tolerance)?;
    } else {
        let none = Row::new(
            CPJ12,
            "cpj12.lambda_candidates",
            "λ_c, tested pairs",
            Value::None,
            Standing::Printed,
        );
        rows.push(none.remark("the polygon has too many edges"));
    }
    predecessor_rows(chain, &printed, &mut rows).map_err(CompareError::Tolerance)?;
    for (key, norm, plan) in [
        ("cpij14.tolerance", "∞-norm", &printed),
        ("cpij14.tolerance_euclidean", "Euclidean", &euclidean),
    ] {
        let quantity = format!("display tolerance before any move, {norm}");
        let value = Value::root(plan.bounds.distance_squared.clone());
        let row = Row::new(CPIJ14, key, quantity, value, Standing::Proved);
        rows.push(row.remark("points may move by ε_d less this while second differences do not grow"));
    }
    Ok(Polygonal { rows, subdivisions })
}

fn count(value: Option<i64>) -> Value {
    value.map_or(Value::None, Value::Count)
}

fn plan_rows(pieces: &[PieceMeasures], printed: &Plan, euclidean: &Plan) -> Vec<Row> {
    let row = |key, quantity: &str, value, standing| Row::new(CPJ12, key, quantity, value, standing);
    let between = |[lower, upper]: &[Rational; 2]| Value::Between(lower.clone(), Some(upper.clone()));
    let longest = pieces.iter().map(|piece| piece.longest_edge_squared.clone()).max();
    vec![
        row(
            "cpj12.k",
            "K = N∞·‖Δ₂P‖, ∞-norm",
            Value::root(printed.bounds.distance_squared.clone()),
            Standing::Exact,
        ),
        row(
            "cpj12.k_euclidean",
            "K, Euclidean norm",
            Value::root(euclidean.bounds.distance_squared.clone()),
            Standing::Exact,
        ),
        row(
            "cpj12.l0",
            "ℓ₀, longest edge",
            Value::root(longest.unwrap_or_default()),
            Standing::Exact,
        ),
        row("cpj12.epsilon", "ε, root of (3)", between(&printed.epsilon), Standing::Exact),
        row(
            "cpj12.epsilon_euclidean",
            "ε with K in the Euclidean norm",
            between(&euclidean.epsilon),
            Standing::Exact,
        ),
        row("cpj12.m1", "m₁, equation (1)", count(printed.m1), Standing::Exact).if_none(NOTHING),
        row("cpj12.m2", "m₂, equation (2)", count(printed.m2), Standing::Exact).if_none(NOTHING),
        row(
            "cpj12.m2_proved",
            "m₂ by the bound N∞(n−1)·‖Δ₂(ΔP)‖/4^m",
            count(printed.m2_proved),
            Standing::Exact,
        )
        .if_none(NOTHING),
        row(
            "cpj12.m",
            "subdivisions m",
            Value::Count(i64::from(printed.subdivisions)),
            Standing::Exact,
        ),
        row(
            "cpj12.edges",
            "edges of the polygon",
            count(printed.edges.and_then(|edges| i64::try_from(edges).ok())),
            Standing::Exact,
        ),
        row("cpj12.error", "E", between(&printed.error), Standing::Printed)
            .remark("the derivation needs edges of length 1 or more, and a proof that the nearest pair is near the double normal"),
    ]
}

/// λ_c in its readings, the printed interval, and what the polygon proves.
fn estimate_rows(
    chain: &Chain,
    options: &Options,
    plan: &Plan,
    certified: &Certified,
    rows: &mut Vec<Row>,
) -> Result<(), ApproximationError> {
    let polygon = Polygon::new(chain, plan.subdivisions)?;
    let control = Polygon::new(chain, 0)?;
    let root = |pair: &Option<Pair>| {
        pair.as_ref()
            .map_or(Value::None, |pair| Value::root(pair.squared.clone()))
    };
    let row = |key, quantity: &str, value| Row::new(CPJ12, key, quantity, value, Standing::Printed);
    let disjoint = polygon.nearest_disjoint_edges();
    rows.push(
        row(
            "cpj12.lambda_disjoint",
            "λ_c, all disjoint edges (§4.2)",
            root(&disjoint),
        )
        .remark("at most the shortest edge, whatever σ is"),
    );
    let candidates = polygon.nearest_candidates(&options.epsilon_d, Chord::Curve);
    let none = "no pair passes the test";
    let tested = row(
        "cpj12.lambda_candidates",
        "λ_c, tested pairs (Figure 6)",
        root(&candidates),
    );
    rows.push(match &candidates {
        Some(_) => tested,
        None => tested.remark(none),
    });
    let chords = polygon.nearest_candidates(&options.epsilon_d, Chord::Polygon);
    let tested = row(
        "cpj12.lambda_candidates_polygon",
        "λ_c, test on the polygon's chord",
        root(&chords),
    );
    rows.push(match &chords {
        Some(_) => tested,
        None => tested.remark(none),
    });
    if let Some(pair) = &candidates {
        let (below, above) = sqrt_enclosure(&pair.squared, ROOT_BITS);
        let lower = (below - &plan.error[1]).max(Rational::default());
        let upper = above + &plan.error[1];
        let verdict = verdict(certified, &lower, &upper);
        let interval = row("cpj12.sigma", "σ in λ_c ± E", Value::Between(lower, Some(upper)));
        rows.push(interval.remark(verdict));
    }
    let proved = |key, quantity: &str, value| Row::new(POLYGON, key, quantity, value, Standing::Proved);
    let separation = polygon.separation();
    let two = Rational::from_integer(Integer::from(2));
    rows.push(proved(
        "polygon.error",
        "2η with η ≥ |c − L|: the valid E",
        Value::Number(two * &separation.eta),
    ));
    rows.push(match &separation.distance_squared {
        Some(squared) => proved(
            "polygon.lambda",
            "λ, parts not shown to be without a double normal",
            Value::root(squared.clone()),
        ),
        None => proved("polygon.lambda", "λ", Value::Infinite),
    });
    rows.push(match (separation.lower, separation.upper) {
        (None, _) => proved("polygon.sigma", "σ", Value::Infinite),
        (Some(lower), Some(upper)) => proved("polygon.sigma", "σ", Value::Between(lower, Some(upper))),
        (Some(lower), None) => proved("polygon.sigma", "σ", Value::Between(lower, None))
            .remark("no double normal was shown to be as short as λ"),
    });
    let quarter = Rational::new(Integer::ONE, Integer::from(4));
    for (polygon, key, quantity) in [
        (&control, "polygon.half_nu", "½ν of the control polygon"),
        (&polygon, "polygon.half_nu_subdivided", "½ν after m subdivisions"),
    ] {
        let value = polygon
            .vertex_clearance_squared()
            .map_or(Value::None, |squared| Value::root(squared * &quarter));
        rows.push(Row::new(POLYGON, key, quantity, value, Standing::Exact));
    }
    Ok(())
}

/// Does a printed interval contain σ?
fn verdict(certified: &Certified, lower: &Rational, upper: &Rational) -> &'static str {
    let statement = &certified.separation;
    let Lower::Finite(sigma_lower) = &statement.lower_squared else {
        return "σ is infinite";
    };
    let (lower, upper) = (lower * lower, upper * upper);
    match &statement.upper_squared {
        _ if *sigma_lower > upper => "does not contain the certified σ",
        Some(sigma_upper) if *sigma_upper < lower => "does not contain the certified σ",
        Some(sigma_upper) if *sigma_lower >= lower && *sigma_upper <= upper => "contains the certified σ",
        _ => "not told whether it contains σ",
    }
}

fn predecessor_rows(chain: &Chain, plan: &Plan, rows: &mut Vec<Row>) -> Result<(), ApproximationError> {
    let found = extremes(chain)?;
    let mut row =
        |key, quantity: &str, value| rows.push(Row::new(BEFORE, key, quantity, value, Standing::Exact).if_none(NONE));
    let between = |[lower, upper]: &[Rational; 2]| Value::Between(lower.clone(), Some(upper.clone()));
    let subdivisions = |m| match m {
        Subdivisions::Exactly(m) => Value::Count(m),
        Subdivisions::Any => Value::Count(0),
        Subdivisions::Undecided => Value::None,
    };
    row("before.k0", "K₀ = max ‖c'‖_∞", between(&found.speed));
    row("before.k1", "K₁ = max ‖c''‖_∞", between(&found.acceleration));
    row("before.mu0", "μ₀ = min ‖c'‖_∞", between(&found.least_speed));
    row("before.m1", "m̃₁", subdivisions(found.m1(&plan.epsilon)));
    row("before.m2", "m̃₂", subdivisions(found.m2(&plan.epsilon)));
    let most = found.subdivisions(&plan.epsilon);
    row("before.m", "subdivisions m̃", subdivisions(most));
    let segments = match most {
        Subdivisions::Exactly(m) => u32::try_from(m.max(0))
            .ok()
            .and_then(|m| i64::try_from(chain.count()).ok()?.checked_mul(1_i64.checked_shl(m)?)),
        _ => None,
    };
    row(
        "before.segments",
        "segments, one for each part",
        segments.map_or(Value::None, Value::Count),
    );
    Ok(())
}
