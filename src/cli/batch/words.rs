//! What came of a curve, for people who draw curves: what and where, in the file's own coordinates.

use knotproof::certificate::Document;
use knotproof::claim::Claim;
use knotproof::claim::msd::{Content, Interval, Lower, Upper};
use knotproof::claim::thickness::Evidence;
use knotproof::curve::{Chain, Curve, Joint};
use knotproof::number::{Integer, Meaning, Rational, RationalExt, parse_number};

/// Digits of coordinates.
const DIGITS: usize = 7;
/// From here on a corner is told as a turn back, in degrees.
const TURN_BACK: f64 = 179.999;
/// So many corners are told with their places.
const CORNERS_TOLD: usize = 3;

/// Sentences about what a certificate proves that its statement does not say in plain words.
pub fn of_proof(curve: &Curve, document: &Document) -> Vec<String> {
    let chain = curve.chain();
    match &document.claim {
        Claim::Msd(content) => of_distance(&chain, content),
        Claim::Thickness(content) => match &content.evidence {
            Evidence::Corner { joint } => vec![format!(
                "the path has a corner, {}; no pipe of positive radius fits around a corner",
                corner_at(&chain, *joint)
            )],
            Evidence::Bounds { .. } => Vec::new(),
        },
        Claim::Curvature(_) => {
            let corners = corners(&chain);
            match corners.is_empty() {
                true => Vec::new(),
                false => vec![format!("{}; corners do not count", told(&chain, &corners))],
            }
        }
        Claim::Embedding(_) => vec!["the path neither touches nor crosses itself".into()],
        _ => Vec::new(),
    }
}

fn of_distance(chain: &Chain, content: &Content) -> Vec<String> {
    let meets = match &content.evidence.upper {
        Some(Upper::Touch { s, t: _ }) => {
            let at = place(chain, s);
            format!("the path passes twice through the point {at}: it touches or crosses itself there")
        }
        Some(Upper::Crossing { s, .. }) => {
            let at = place(chain, &middle(s));
            format!("the path crosses itself at {at}")
        }
        _ => {
            let infinite = matches!(content.statement.lower_squared, Lower::Infinite);
            let corners = corners(chain);
            return match infinite && !corners.is_empty() {
                true => vec![format!(
                    "no straight line meets the path at right angles at both of its ends; {}, which count with --convention critical only",
                    told(chain, &corners)
                )],
                false => Vec::new(),
            };
        }
    };
    vec![meets]
}

/// A reason of `certify` in plain words; nothing where it is plain already.
pub fn of_reason(curve: &Curve, reason: &str) -> Option<String> {
    let chain = curve.chain();
    let parameters = parameters(&chain, reason);
    let places: Vec<String> = parameters
        .iter()
        .map(|at| format!("about {}", place(&chain, at)))
        .collect();
    let at = || places.join(" and ");
    let has = |part: &str| reason.contains(part);
    if has("turns back") && !places.is_empty() {
        return Some(turn(&chain, &parameters[0], &at()));
    }
    if has("could not be told from") && places.len() == 2 {
        let apart = reason.split_once("), ").and_then(|(_, rest)| rest.split_once(" apart"));
        let apart = apart
            .and_then(|(apart, _)| apart.trim().parse().ok())
            .map(|apart| short(apart, 4));
        let apart = apart.unwrap_or_else(|| "an unknown distance".into());
        return Some(match has("double normal") {
            true => format!(
                "two parts of the path face each other, about {apart} apart, at {}: whether they come no nearer could be neither proved nor excluded",
                at()
            ),
            false => format!(
                "two parts of the path are about {apart} apart, or touch, at {}: that could not be decided",
                at()
            ),
        });
    }
    if has("no double normal could be proved") || has("could not be isolated") {
        return Some(
            "a distance is proved below which no two strands come, but not that any come as near as that: the shortest connection is one of a \
             family of equal ones, or begins or ends at a joint"
                .into(),
        );
    }
    if has("budget of") {
        // A search does not come to an end beside a point around which nothing can be proved.
        if let Some(joint) = corners(&chain).into_iter().find(|joint| turns_back(&chain, *joint)) {
            let parameter = Rational::from_integer(Integer::from(joint));
            return Some(turn(&chain, &parameter, &place(&chain, &parameter)));
        }
        return Some(
            "the proof became too long: parts of the path run beside each other at the same distance (as in circles and parallel lines) or nearly \
             touch; --budget allows a longer proof, --rel-width asks for less"
                .into(),
        );
    }
    if (has("not regular") || has("curvature is unbounded")) && !places.is_empty() {
        return Some(format!(
            "at {} the path slows down to a standstill, as in a cusp or where control points coincide, and its curvature is not bounded",
            at()
        ));
    }
    if has("single point") {
        return Some("a piece of the path has no length; leave it out".into());
    }
    match places.is_empty() {
        true => None,
        false => Some(format!("the place is {}", at())),
    }
}

/// What is wrong at a point around which nothing can be proved.
fn turn(chain: &Chain, parameter: &Rational, at: &str) -> String {
    let nearest = Rational::from_f64(parameter.to_f64().round());
    let joint = nearest.filter(|joint| (parameter - joint).to_f64().abs() < 1e-6);
    let joint = joint
        .and_then(|joint| joint.numer().to_i64())
        .map(|joint| joint.unsigned_abs() as usize);
    let joint = joint.map(|joint| {
        if chain.closed() {
            joint % chain.count().max(1)
        } else {
            joint
        }
    });
    let advice = "nothing can be proved around such a point; reshape the path there";
    match joint.and_then(|joint| turning(chain, joint)) {
        Some(degrees) if degrees > TURN_BACK => format!("the path turns back on itself at {at}; {advice}"),
        Some(degrees) if degrees > 0.001 => format!(
            "at {at} the path turns by {}°, and parts of it leave that point side by side; {advice}",
            short(degrees, 4)
        ),
        _ => format!("at {at} the path slows down to a standstill or turns back on itself (a cusp); {advice}"),
    }
}

/// How many corners there are, and where the first are.
fn told(chain: &Chain, corners: &[usize]) -> String {
    let first: Vec<String> = corners
        .iter()
        .take(CORNERS_TOLD)
        .map(|i| corner_at(chain, *i))
        .collect();
    let more = if corners.len() > first.len() { ", …" } else { "" };
    match corners.len() {
        1 => format!("the path has a corner, {}", first[0]),
        count => format!("the path has {count} corners ({}{more})", first.join(", ")),
    }
}

/// "90° at (1, 2)".
fn corner_at(chain: &Chain, joint: usize) -> String {
    let at = place(chain, &Rational::from_integer(Integer::from(joint)));
    match turning(chain, joint) {
        Some(degrees) => format!("a turn by {}° at {at}", short(degrees, 4)),
        None => format!("at {at}"),
    }
}

/// The joints that are corners.
fn corners(chain: &Chain) -> Vec<usize> {
    (0..chain.count())
        .filter(|i| chain.joint(*i) == Some(Joint::Corner))
        .collect()
}

/// Is a joint a turn by 180°?
fn turns_back(chain: &Chain, joint: usize) -> bool {
    turning(chain, joint).is_some_and(|degrees| degrees > TURN_BACK)
}

/// By how many degrees the direction changes at a joint.
fn turning(chain: &Chain, joint: usize) -> Option<f64> {
    let pieces = chain.pieces();
    let before = match joint {
        0 if chain.closed() => pieces.last()?,
        0 => return None,
        _ => pieces.get(joint - 1)?,
    };
    let floats = |direction: Vec<Rational>| -> Vec<f64> { direction.iter().map(Rational::to_f64).collect() };
    let (v, w) = (
        floats(before.end_direction()?),
        floats(pieces.get(joint)?.start_direction()?),
    );
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let lengths = (dot(&v, &v) * dot(&w, &w)).sqrt();
    let cosine = dot(&v, &w) / lengths;
    // Near 0° and 180° the sine is what tells the angle.
    let square: f64 = (0..v.len())
        .flat_map(|i| (0..i).map(move |j| (i, j)))
        .map(|(i, j)| (v[i] * w[j] - v[j] * w[i]) / lengths)
        .map(|sine| sine * sine)
        .fold(0.0, |sum, square| sum + square);
    let angle = square.sqrt().atan2(cosine).to_degrees();
    angle.is_finite().then_some(angle)
}

/// The global parameters that a text names: each "parameter" with a number after it, a value of the curve's own knots.
fn parameters(chain: &Chain, text: &str) -> Vec<Rational> {
    let mut found = Vec::new();
    for after in text.split("parameter ").skip(1) {
        let number: String = after
            .chars()
            .take_while(|c| c.is_ascii_digit() || "+-./eE".contains(*c))
            .collect();
        let number = number.trim_end_matches(['.', 'e', 'E', '+', '-', '/']);
        let Ok(knot) = parse_number(number, Meaning::Decimal) else {
            continue;
        };
        found.extend(chain.parameter_at(&knot));
    }
    found
}

fn middle(interval: &Interval) -> Rational {
    (&interval.start + &interval.end) / Rational::from_integer(Integer::from(2))
}

/// The point at a global parameter; of a closed chain those beyond the last are in the next round.
pub fn place(chain: &Chain, parameter: &Rational) -> String {
    let count = Rational::from_integer(Integer::from(chain.count()));
    let parameter = match *parameter > count {
        true => parameter - count,
        false => parameter.clone(),
    };
    let Ok(point) = chain.evaluate(&parameter) else {
        return "an unknown place".into();
    };
    let coordinates: Vec<String> = point.iter().map(|x| short(x.to_f64(), DIGITS)).collect();
    format!("({})", coordinates.join(", "))
}

/// A number to so many digits, without zeros at its end.
fn short(x: f64, digits: usize) -> String {
    let rounded: f64 = format!("{x:.*e}", digits - 1).parse().unwrap_or(x);
    // What rounding left of 0 is 0 to people.
    match rounded == 0.0 {
        true => "0".into(),
        false if (1e-6..1e15).contains(&rounded.abs()) => rounded.to_string(),
        false => format!("{rounded:e}"),
    }
}

#[cfg(test)]
mod tests {
    use knotproof::curve::read_curve;

    use super::*;

    fn curve(text: &str) -> Curve {
        read_curve(format!("{{ \"knotproof\": \"curve/1\", {text} }}"))
            .unwrap()
            .curve
    }

    /// Three edges of a square, with knots that are no piece numbers.
    fn bracket() -> Curve {
        curve(
            r#""bspline": { "degree": 1, "knots": ["0","0","10","20","30","30"], "points": [[0,0],["12.5",0],["12.5",8],[0,8]] }"#,
        )
    }

    #[test]
    fn numbers_are_short() {
        for (x, expected) in [
            (12.5, "12.5"),
            (1.0 / 3.0, "0.3333333"),
            (-2e-9, "-2e-9"),
            (0.0, "0"),
            (-0.0, "0"),
            (1234567.89, "1234568"),
            (1e20, "1e20"),
        ] {
            assert_eq!(short(x, DIGITS), expected);
        }
    }

    #[test]
    fn corners_are_told_with_angle_and_place() {
        let curve = bracket();
        let chain = curve.chain();
        assert_eq!(corners(&chain), [1, 2]);
        assert_eq!(corner_at(&chain, 1), "a turn by 90° at (12.5, 0)");
        assert_eq!(
            told(&chain, &corners(&chain)),
            "the path has 2 corners (a turn by 90° at (12.5, 0), a turn by 90° at (12.5, 8))"
        );
    }

    #[test]
    fn reasons_name_places_in_the_files_coordinates() {
        let curve = bracket();
        let told = |reason| of_reason(&curve, reason);
        let touching = "the points at about parameter 2.000000000000 (piece 0 at 0.2) and parameter 28.000000000000 (piece 2 at 0.8), 8.000e0 apart, \
            could not be told from a double point";
        assert_eq!(
            told(touching).unwrap(),
            "two parts of the path are about 8 apart, or touch, at about (2.5, 0) and about (2.5, 8): that could not be decided"
        );
        let back = "the derivative vanishes or the curve turns back at about parameter 10.000000000000 (piece 1 at 0.000000000000)";
        assert!(
            told(back)
                .unwrap()
                .starts_with("at about (12.5, 0) the path turns by 90°")
        );
        assert!(
            told("the curve is not regular: its derivative vanishes at the parameter 20")
                .unwrap()
                .contains("(12.5, 8)")
        );
        assert!(told("the budget of 50 leaves ran out").unwrap().contains("--budget"));
        assert_eq!(told("the time limit of 3 s was reached"), None);
    }

    #[test]
    fn a_turn_back_is_told_as_such() {
        let curve =
            curve(r#""bezier": { "pieces": [ { "points": [[0,0],[3,1]] }, { "points": [[3,1],["1.5","0.5"]] } ] }"#);
        let reason =
            "the derivative vanishes or the curve turns back at about parameter 1.000000000000 (piece 1 at 0.0)";
        let told = of_reason(&curve, reason).unwrap();
        assert!(
            told.starts_with("the path turns back on itself at about (3, 1)"),
            "{told}"
        );
    }
}
