//! Statements about convex domains, for programs and for people.

use knotproof::claim::domain::{Domain, Outcome, Sign, Statement, Target};
use knotproof::number::{
    Rational, RationalExt, decimal_down, decimal_up, interval_digits, sqrt_decimal_down, sqrt_decimal_up,
    sqrt_enclosure,
};
use serde::Serialize;

/// At least so many digits of an interval are printed.
const DIGITS_AT_LEAST: usize = 6;
/// Roots are enclosed this closely before digits are counted.
const ROOT_BITS: u32 = 256;

/// A convex domain as JSON.
#[derive(Serialize)]
pub struct DomainLine {
    points: Vec<usize>,
    sign: &'static str,
    interval: Vec<String>,
    open: [bool; 2],
    #[serde(rename = "box")]
    bounds: [Vec<String>; 2],
}

/// A statement about it as JSON.
#[derive(Serialize)]
pub struct DomainStatementLine {
    #[serde(flatten)]
    domain: DomainLine,
    #[serde(flatten)]
    outcome: OutcomeLine,
}

#[derive(Serialize)]
#[serde(tag = "outcome", rename_all = "snake_case")]
enum OutcomeLine {
    Sandwich {
        /// Exact fractions.
        inner_measure: String,
        outer_measure: String,
        /// A decimal at least (outer − inner)/inner.
        relative_error: String,
    },
    Empty,
    Nearest {
        to: Option<Vec<String>>,
        lower_squared: String,
        upper_squared: String,
        lower: String,
        upper: String,
    },
    Change {
        from: Vec<String>,
        lower_squared: String,
        upper_squared: String,
        lower: String,
        upper: String,
    },
    Ball {
        lower_exact: String,
        upper_exact: String,
        lower: String,
        upper: String,
    },
}

/// Exact fractions.
pub fn texts(numbers: &[Rational]) -> Vec<String> {
    numbers.iter().map(Rational::format).collect()
}

impl DomainLine {
    /// Its own fields.
    pub fn new(domain: &Domain) -> DomainLine {
        DomainLine {
            points: domain.points.clone(),
            sign: domain.sign.name(),
            interval: texts(&domain.interval),
            open: domain.open,
            bounds: [texts(&domain.bounds.low), texts(&domain.bounds.high)],
        }
    }
}

impl DomainStatementLine {
    /// The statement's own fields, with outward decimals beside its fractions.
    pub fn new(statement: &Statement) -> DomainStatementLine {
        let outcome = match &statement.outcome {
            Outcome::Sandwich {
                inner_measure,
                outer_measure,
            } => OutcomeLine::Sandwich {
                inner_measure: inner_measure.format(),
                outer_measure: outer_measure.format(),
                relative_error: relative_error(inner_measure, outer_measure),
            },
            Outcome::Empty => OutcomeLine::Empty,
            Outcome::Nearest {
                to,
                lower_squared,
                upper_squared,
            } => {
                let [lower, upper] = roots(lower_squared, upper_squared);
                OutcomeLine::Nearest {
                    to: match to {
                        Target::Point(point) => Some(texts(point)),
                        Target::Fair => None,
                    },
                    lower_squared: lower_squared.format(),
                    upper_squared: upper_squared.format(),
                    lower,
                    upper,
                }
            }
            Outcome::Change {
                from,
                lower_squared,
                upper_squared,
            } => {
                let [lower, upper] = roots(lower_squared, upper_squared);
                OutcomeLine::Change {
                    from: texts(from),
                    lower_squared: lower_squared.format(),
                    upper_squared: upper_squared.format(),
                    lower,
                    upper,
                }
            }
            Outcome::Ball { lower, upper } => {
                let [low, high] = decimals(lower, upper);
                OutcomeLine::Ball {
                    lower_exact: lower.format(),
                    upper_exact: upper.format(),
                    lower: low,
                    upper: high,
                }
            }
        };
        DomainStatementLine {
            domain: DomainLine::new(&statement.domain),
            outcome,
        }
    }
}

/// An interval as outward decimals with enough digits to tell the ends apart.
pub fn decimals(lower: &Rational, upper: &Rational) -> [String; 2] {
    let digits = interval_digits(lower, upper).max(DIGITS_AT_LEAST);
    [decimal_down(lower, digits), decimal_up(upper, digits)]
}

/// Outward decimals of the roots of an interval.
pub fn roots(lower_squared: &Rational, upper_squared: &Rational) -> [String; 2] {
    let (lower, upper) = (
        sqrt_enclosure(lower_squared, ROOT_BITS).0,
        sqrt_enclosure(upper_squared, ROOT_BITS).1,
    );
    let digits = interval_digits(&lower, &upper).max(DIGITS_AT_LEAST);
    [
        sqrt_decimal_down(lower_squared, digits),
        sqrt_decimal_up(upper_squared, digits),
    ]
}

/// A decimal at least (outer − inner)/inner.
pub fn relative_error(inner: &Rational, outer: &Rational) -> String {
    decimal_up(&((outer - inner) / inner), 3)
}

/// "curvature" or "torsion".
pub fn quantity(domain: &Domain) -> &'static str {
    match domain.bounds.low.len() {
        2 => "curvature",
        _ => "torsion",
    }
}

fn subject(domain: &Domain) -> String {
    let points: Vec<String> = domain.points.iter().map(usize::to_string).collect();
    let sign = match domain.sign {
        Sign::Positive => "positive",
        Sign::Negative => "negative",
    };
    let plural = if points.len() == 1 { "" } else { "s" };
    format!(
        "the domain of control point{plural} {} for {sign} {}",
        points.join(", "),
        quantity(domain)
    )
}

/// What a statement says, for people.
pub fn in_words(statement: &Statement) -> String {
    let domain = &statement.domain;
    let subject = subject(domain);
    match &statement.outcome {
        Outcome::Sandwich {
            inner_measure,
            outer_measure,
        } => {
            let [low, high] = decimals(inner_measure, outer_measure);
            let measure = if domain.bounds.low.len() == 2 { "area" } else { "volume" };
            format!(
                "{subject}, within the box, has an {measure} between {low} and {high} (relative error at most {})",
                relative_error(inner_measure, outer_measure)
            )
            .replace("an volume", "a volume")
        }
        Outcome::Empty => format!("{subject} has no point in the box"),
        Outcome::Nearest {
            to,
            lower_squared,
            upper_squared,
        } => {
            let [low, high] = roots(lower_squared, upper_squared);
            let to = match to {
                Target::Point(point) => format!("({})", texts(point).join(", ")),
                Target::Fair => "the position of least ∫|c''|²".into(),
            };
            format!("{subject}, within the box, is at a distance between {low} and {high} from {to}")
        }
        Outcome::Change {
            from,
            lower_squared,
            upper_squared,
        } => {
            let [low, high] = roots(lower_squared, upper_squared);
            format!(
                "from ({}), the shortest move out of {subject} has a length between {low} and {high}",
                texts(from).join(", ")
            )
        }
        Outcome::Ball { lower, upper } => {
            let [low, high] = decimals(lower, upper);
            format!("the largest ball in {subject}, within the box, has a radius between {low} and {high}")
        }
    }
}
