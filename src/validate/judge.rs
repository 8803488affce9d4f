//! An answer held against the exact result.

use super::structure::Deviation;
use super::truth::{Enclosed, ExactVector, Truth};
use super::verdict::{Kind, Verdict, Wrong};
use super::{Tolerances, words};
use crate::engine::{Answer, FloatCurve, Operation, Returned};
use crate::number::{Rational, RationalExt};

/// Judges an answer to an operation whose exact result is `truth`.
pub fn judge(operation: &Operation, truth: &Truth, answer: &Answer, tolerances: &Tolerances) -> Verdict {
    let returned = match answer {
        Answer::Refused(message) => return Verdict::Refused(message.clone()),
        Answer::NotOffered => return Verdict::NotOffered,
        Answer::Ok(returned) => returned,
    };
    let most = tolerances.ulps(operation.name());
    let judged = match (truth, returned) {
        (Truth::Unknown(why), _) => return Verdict::Unjudged(why.clone()),
        (Truth::Vectors(choices), Returned::Point(found)) if matches!(operation, Operation::Point { .. }) => {
            vector(choices, found, most)
        }
        (Truth::Vectors(choices), Returned::Vector(found)) if matches!(operation, Operation::Derivative { .. }) => {
            vector(choices, found, most)
        }
        (Truth::Values { choices, unsigned }, Returned::Value(found)) => value(choices, *unsigned, *found, most),
        (Truth::Curves(expected), Returned::Curve(found)) if !has_parts(operation) => {
            expected.compare(&[found]).and_then(|off| curve(off, most))
        }
        (Truth::Curves(expected), Returned::Curves(found)) if has_parts(operation) => {
            let found: Vec<&FloatCurve> = found.iter().collect();
            expected.compare(&found).and_then(|off| curve(off, most))
        }
        (Truth::Distance { bounds, attained }, Returned::Distance { distance, .. }) => {
            match distance_of(bounds, attained, *distance, most) {
                Some(judged) => judged,
                None => return Verdict::Unjudged("the exact distance is not enclosed narrowly enough".into()),
            }
        }
        (Truth::Domain(domain), Returned::Vertices(found)) => return domain.judge(found, most),
        (Truth::NoDistance, Returned::Distance { distance: None, .. }) => Ok(0.0),
        (
            Truth::NoDistance,
            Returned::Distance {
                distance: Some(found), ..
            },
        ) => Err(Wrong {
            kind: Kind::OtherValue,
            place: String::new(),
            found: found.to_string(),
            expected: "none: there is no double normal".into(),
            ulps: f64::INFINITY,
        }),
        (_, other) => Err(Wrong::form(
            format!("a {}", other.field()),
            format!("the result of {}", operation.name()),
        )),
    };
    match judged {
        Ok(ulps) => Verdict::Right { ulps },
        Err(wrong) => Verdict::Wrong(wrong),
    }
}

fn has_parts(operation: &Operation) -> bool {
    matches!(operation, Operation::Split { .. } | Operation::Decompose)
}

/// The number of units, or what is wrong about so many.
type Judged = Result<f64, Wrong>;

fn not_finite(found: String, expected: String) -> Judged {
    Err(Wrong {
        kind: Kind::NotFinite,
        place: String::new(),
        found,
        expected,
        ulps: f64::INFINITY,
    })
}

/// |found − exact| in units. The difference is exact, the quotient rounded.
fn units(found: f64, exact: &Rational, unit: f64) -> f64 {
    let Some(found) = Rational::from_f64(found) else {
        return f64::INFINITY;
    };
    let off = (found - exact).to_f64().abs();
    if off == 0.0 { 0.0 } else { off / unit }
}

fn vector(choices: &[ExactVector], found: &[f64], most: f64) -> Judged {
    let Some(first) = choices.first() else {
        return Err(Wrong::form(words::floats(found), "nothing"));
    };
    if found.len() != first.vector.len() {
        return Err(Wrong::form(
            format!("{} coordinates", found.len()),
            format!("{} coordinates", first.vector.len()),
        ));
    }
    if found.iter().any(|x| !x.is_finite()) {
        return not_finite(words::floats(found), words::point(&first.vector));
    }
    let off = |choice: &ExactVector| {
        let each = choice.vector.iter().zip(found).map(|(x, y)| units(*y, x, choice.unit));
        each.fold(0.0, f64::max)
    };
    let nearest = choices.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(first);
    let ulps = off(nearest);
    if ulps <= most {
        return Ok(ulps);
    }
    let expected: Vec<String> = choices.iter().map(|choice| words::point(&choice.vector)).collect();
    Err(Wrong {
        kind: Kind::OtherValue,
        place: String::new(),
        found: words::floats(found),
        expected: one_of(expected),
        ulps,
    })
}

fn one_of(mut expected: Vec<String>) -> String {
    expected.dedup();
    expected.join(" or ")
}

fn value(choices: &[Enclosed], unsigned: bool, found: f64, most: f64) -> Judged {
    let expected = || one_of(choices.iter().map(|choice| words::number(&choice.upper)).collect());
    if !found.is_finite() {
        return not_finite(found.to_string(), expected());
    }
    let compared = if unsigned { found.abs() } else { found };
    let ulps = choices
        .iter()
        .map(|choice| outside(choice, compared))
        .fold(f64::INFINITY, f64::min);
    if ulps <= most {
        return Ok(ulps);
    }
    Err(Wrong {
        kind: Kind::OtherValue,
        place: String::new(),
        found: found.to_string(),
        expected: expected(),
        ulps,
    })
}

/// How many units a number is outside its bounds.
fn outside(bounds: &Enclosed, found: f64) -> f64 {
    match Rational::from_f64(found) {
        Some(x) if x < bounds.lower => units(found, &bounds.lower, bounds.unit),
        Some(x) if x > bounds.upper => units(found, &bounds.upper, bounds.unit),
        Some(_) => 0.0,
        None => f64::INFINITY,
    }
}

fn curve(off: Deviation, most: f64) -> Judged {
    if off.ulps <= most {
        return Ok(off.ulps);
    }
    Err(Wrong {
        kind: Kind::OtherValue,
        place: off.place,
        found: words::floats(&off.found.iter().map(RationalExt::to_f64).collect::<Vec<_>>()),
        expected: words::point(&off.expected),
        ulps: off.ulps,
    })
}

/// Nothing when the bounds are too far apart to tell.
fn distance_of(bounds: &Enclosed, attained: &str, found: Option<f64>, most: f64) -> Option<Judged> {
    let Some(found) = found else {
        return Some(Err(Wrong::form("no distance", attained)));
    };
    if !found.is_finite() {
        return Some(not_finite(found.to_string(), attained.to_string()));
    }
    let ulps = outside(bounds, found);
    if ulps > most {
        let above = Rational::from_f64(found).is_some_and(|x| x > bounds.upper);
        let expected = if above {
            format!("at most {}: {attained}", words::number(&bounds.upper))
        } else {
            format!("at least {}", words::number(&bounds.lower))
        };
        return Some(Err(Wrong {
            kind: Kind::OtherValue,
            place: String::new(),
            found: found.to_string(),
            expected,
            ulps,
        }));
    }
    let width = (&bounds.upper - &bounds.lower).to_f64() / bounds.unit;
    (width <= most.max(1.0e5)).then_some(Ok(ulps))
}

#[cfg(test)]
mod tests;
