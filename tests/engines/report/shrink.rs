//! Greedy shrinking: of all smaller variants of a case, the smallest that is still wrong in the same way, until there is none.

use std::collections::{BTreeMap, HashSet};

use knotproof::engine::{Answer, Case, CasesFile, FloatCurve, Operation, write_cases};
use knotproof::validate::{Tolerances, Verdict, judge};
use rayon::prelude::*;

use crate::run::Adapter;
use crate::{Fault, Group, group, truth};

/// The most variants of a case that are tried in a round.
const MOST_VARIANTS: usize = 100;
/// The same where the exact result takes a search.
const MOST_SEARCHED: usize = 40;

/// The size of a case: the length of its text.
pub fn size(case: &Case) -> usize {
    let case = Case {
        id: String::new(),
        ..case.clone()
    };
    write_cases(&CasesFile {
        seed: None,
        cases: vec![case],
    })
    .len()
}

/// Makes the cases of all faults as small as it can.
pub fn shrink(
    engine: &Adapter,
    faults: &mut BTreeMap<Group, Fault>,
    tolerances: &Tolerances,
    rounds: usize,
) -> Result<(), String> {
    let mut open: HashSet<Group> = faults.keys().copied().collect();
    for _ in 0..rounds {
        let mut cases: Vec<Case> = Vec::new();
        let mut of: Vec<Group> = Vec::new();
        for (group, fault) in faults.iter().filter(|(group, _)| open.contains(*group)) {
            for variant in smaller(&fault.case) {
                let id = cases.len().to_string();
                cases.push(Case { id, ..variant });
                of.push(*group);
            }
        }
        if cases.is_empty() {
            break;
        }
        let results = engine.answers(&cases)?;
        let answers: BTreeMap<&str, &Answer> = results.results.iter().map(|r| (r.id.as_str(), &r.answer)).collect();
        let verdicts: Vec<Option<Verdict>> = cases
            .par_iter()
            .map(|case| match answers.get(case.id.as_str()) {
                Some(answer @ Answer::Ok(_)) => Some(judge(&case.operation, &truth(case), answer, tolerances)),
                _ => None,
            })
            .collect();
        open.clear();
        for ((case, was), verdict) in cases.into_iter().zip(of).zip(verdicts) {
            let Some(Verdict::Wrong(wrong)) = verdict else { continue };
            // A smaller case that is wrong in another way is another fault.
            if group(&case, &wrong) != was {
                continue;
            }
            if let Some(fault) = faults.get_mut(&was)
                && size(&case) < size(&fault.case)
            {
                fault.case = case;
                fault.wrong = wrong;
                open.insert(was);
            }
        }
    }
    Ok(())
}

/// Valid variants of a case that are smaller, smallest first.
fn smaller(case: &Case) -> Vec<Case> {
    let own = size(case);
    let mut variants: Vec<(usize, Case)> = variants(case)
        .into_iter()
        .filter(|variant| is_valid(variant))
        .map(|variant| (size(&variant), variant))
        .filter(|(size, _)| *size < own)
        .collect();
    variants.sort_by_key(|(size, _)| *size);
    variants.dedup_by(|a, b| a.1 == b.1);
    let most = match case.operation {
        Operation::CurveDistance { .. } | Operation::Msd => MOST_SEARCHED,
        _ => MOST_VARIANTS,
    };
    // Some of every size: the smallest are the boldest, and mostly not wrong any more.
    let step = variants.len().div_ceil(most).max(1);
    variants.into_iter().step_by(step).map(|(_, variant)| variant).collect()
}

fn is_valid(case: &Case) -> bool {
    let Ok(spline) = case.curve.exact() else { return false };
    let knots = &case.curve.knots[case.curve.degree..case.curve.knots.len() - case.curve.degree];
    let (start, end) = (knots[0], knots[knots.len() - 1]);
    let dimension = spline.dimension();
    let inside = |t: f64| start < t && t < end;
    match &case.operation {
        Operation::Point { parameter }
        | Operation::Derivative { parameter, .. }
        | Operation::Curvature { parameter, .. } => start <= *parameter && *parameter <= end,
        Operation::Torsion { parameter, .. } => dimension == 3 && start <= *parameter && *parameter <= end,
        Operation::InsertKnot { parameter, times } | Operation::RemoveKnot { parameter, times } => {
            let present = case.curve.knots.iter().filter(|t| *t == parameter).count();
            let fits = match case.operation {
                Operation::InsertKnot { .. } => present + times <= case.curve.degree,
                _ => present >= *times,
            };
            inside(*parameter) && *times > 0 && fits
        }
        Operation::Split { parameter } => inside(*parameter),
        Operation::NearestPoint { target } => target.len() == dimension,
        Operation::CurveDistance { other } => other.exact().is_ok_and(|other| other.dimension() == dimension),
        _ => true,
    }
}

fn variants(case: &Case) -> Vec<Case> {
    let mut all = Vec::new();
    let with = |curve: FloatCurve| Case { curve, ..case.clone() };
    let doing = |operation: Operation| Case {
        operation,
        ..case.clone()
    };
    // One coordinate less, everywhere at once.
    if case.curve.dimension() == 3 {
        for axis in 0..3 {
            let mut variant = case.clone();
            drop_axis(&mut variant.curve, axis);
            match &mut variant.operation {
                Operation::NearestPoint { target } => drop(target.remove(axis)),
                Operation::CurveDistance { other } => drop_axis(other, axis),
                _ => {}
            }
            all.push(variant);
        }
    }
    for curve in curves(&case.curve) {
        let mut variant = with(curve);
        all.push(variant.clone());
        // A parameter that the change has put outside, or that is no knot any more.
        if let Some(t) = case.operation.parameter() {
            let knots = &variant.curve.knots;
            let (first, last) = (case.curve.knots[0], case.curve.knots[case.curve.knots.len() - 1]);
            let share = (t - first) / (last - first);
            let (new_first, new_last) = (knots[0], knots[knots.len() - 1]);
            let index = case.curve.knots.iter().position(|knot| *knot == t);
            let moved = [
                Some(new_first + share * (new_last - new_first)),
                index.and_then(|i| knots.get(i).copied()),
            ];
            for t in moved.into_iter().flatten() {
                set_parameter(&mut variant.operation, t);
                all.push(variant.clone());
            }
        }
    }
    match &case.operation {
        Operation::NearestPoint { target } => {
            all.extend(
                lists(target)
                    .into_iter()
                    .map(|target| doing(Operation::NearestPoint { target })),
            );
        }
        Operation::CurveDistance { other } => {
            let others = curves(other).into_iter();
            all.extend(others.map(|other| doing(Operation::CurveDistance { other: Box::new(other) })));
        }
        Operation::Derivative { parameter, side, order } if *order > 1 => all.push(doing(Operation::Derivative {
            parameter: *parameter,
            side: *side,
            order: order - 1,
        })),
        Operation::InsertKnot { parameter, times } if *times > 1 => all.push(doing(Operation::InsertKnot {
            parameter: *parameter,
            times: times - 1,
        })),
        Operation::ElevateDegree { times } if *times > 1 => {
            all.push(doing(Operation::ElevateDegree { times: times - 1 }));
        }
        _ => {}
    }
    if let Some(t) = case.operation.parameter() {
        let knots = &case.curve.knots;
        let mut values = simpler(t);
        values.extend(knots.windows(2).map(|pair| pair[0] + (pair[1] - pair[0]) / 2.0));
        values.extend(knots);
        for t in values {
            let mut operation = case.operation.clone();
            set_parameter(&mut operation, t);
            all.push(doing(operation));
        }
    }
    all
}

fn set_parameter(operation: &mut Operation, t: f64) {
    match operation {
        Operation::Point { parameter }
        | Operation::Derivative { parameter, .. }
        | Operation::Curvature { parameter, .. }
        | Operation::Torsion { parameter, .. }
        | Operation::InsertKnot { parameter, .. }
        | Operation::RemoveKnot { parameter, .. }
        | Operation::Split { parameter } => *parameter = t,
        _ => {}
    }
}

fn drop_axis(curve: &mut FloatCurve, axis: usize) {
    for point in &mut curve.points {
        if axis < point.len() {
            point.remove(axis);
        }
    }
}

/// Fewer points, lower degrees, simpler knots, weights and coordinates; rational curves stay rational.
fn curves(curve: &FloatCurve) -> Vec<FloatCurve> {
    let mut all = Vec::new();
    let (p, count) = (curve.degree, curve.points.len());
    let without = |i: usize| {
        let mut less = curve.clone();
        less.points.remove(i);
        if let Some(weights) = &mut less.weights {
            weights.remove(i);
        }
        less
    };
    for i in 0..count {
        // A degree less: a knot less at both ends.
        if p > 1 {
            let mut less = without(i);
            less.degree -= 1;
            less.knots = curve.knots[1..curve.knots.len() - 1].to_vec();
            all.push(less);
        }
    }
    if count > p + 1 {
        let mut distinct: Vec<usize> = (1..curve.knots.len() - 1).collect();
        distinct.dedup_by_key(|k| curve.knots[*k].to_bits());
        for k in distinct {
            for i in [k.saturating_sub(p).min(count - 1), k.min(count - 1), count - 1, 0] {
                let mut less = without(i);
                less.knots.remove(k);
                all.push(less);
            }
        }
    }
    for knots in knots(curve) {
        all.push(FloatCurve { knots, ..curve.clone() });
    }
    if let Some(weights) = &curve.weights {
        let with = |weights: Vec<f64>| FloatCurve {
            weights: Some(weights),
            ..curve.clone()
        };
        for (i, w) in weights.iter().enumerate() {
            for simple in [1.0, 2.0, w.round().max(1.0)] {
                let mut changed = weights.clone();
                changed[i] = simple;
                all.push(with(changed));
            }
        }
        all.push(with(weights.iter().map(|w| w.round().max(1.0)).collect()));
    }
    let flat = curve.points.concat();
    let dimension = curve.dimension().max(1);
    for list in lists(&flat) {
        all.push(FloatCurve {
            points: list.chunks(dimension).map(<[f64]>::to_vec).collect(),
            ..curve.clone()
        });
    }
    all
}

/// Clamped knots, breakpoints 0, 1, 2, …, shares of 1.
fn knots(curve: &FloatCurve) -> Vec<Vec<f64>> {
    let p = curve.degree;
    let mut all = Vec::new();
    let mut clamped = curve.knots.clone();
    let count = curve.points.len();
    let (start, end) = (clamped[p], clamped[count]);
    clamped[..p].fill(start);
    clamped[count + 1..].fill(end);
    for knots in [curve.knots.clone(), clamped] {
        let mut distinct = knots.clone();
        distinct.dedup();
        let rank = |t: &f64| distinct.iter().position(|d| d == t).unwrap_or(0) as f64;
        let last = (distinct.len() - 1) as f64;
        all.push(knots.iter().map(rank).collect());
        all.push(knots.iter().map(|t| rank(t) / last).collect());
        all.push(knots.iter().map(|t| t.round()).collect());
        all.push(knots);
    }
    for k in 0..curve.knots.len() {
        for t in simpler(curve.knots[k]) {
            let mut knots = curve.knots.clone();
            knots[k] = t;
            all.push(knots);
        }
    }
    all
}

/// All numbers rounded, and each made simpler alone.
fn lists(numbers: &[f64]) -> Vec<Vec<f64>> {
    let mut all: Vec<Vec<f64>> = vec![
        numbers.iter().map(|x| x.round()).collect(),
        numbers.iter().map(|x| (x / 2.0).trunc()).collect(),
        numbers.iter().map(|x| x.signum() * x.abs().sqrt().round()).collect(),
        numbers.iter().map(|x| x - numbers[0].trunc()).collect(),
        numbers.iter().map(|x| x - numbers[numbers.len() - 1].trunc()).collect(),
        numbers.iter().map(|x| x.clamp(-1.0, 1.0)).collect(),
        numbers.iter().map(|x| x.clamp(-3.0, 3.0)).collect(),
        numbers.iter().map(|x| (x * 16.0).round() / 16.0).collect(),
    ];
    for (i, x) in numbers.iter().enumerate() {
        for simple in simpler(*x) {
            let mut changed = numbers.to_vec();
            changed[i] = simple;
            all.push(changed);
        }
    }
    all
}

fn simpler(x: f64) -> Vec<f64> {
    vec![
        0.0,
        1.0,
        0.5,
        x.round(),
        x.trunc(),
        (x / 2.0).trunc(),
        (x * 4.0).round() / 4.0,
        x.abs(),
        x - x.signum(),
    ]
}
