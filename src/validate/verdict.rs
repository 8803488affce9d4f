//! What a judge says of an answer.

use std::fmt;

/// The judgement of one answer.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// Within the tolerance.
    Right {
        /// How far off, in units in the last place.
        ulps: f64,
    },
    /// Outside it.
    Wrong(Wrong),
    /// The engine raised an error, of this text.
    Refused(String),
    /// The engine has no such operation.
    NotOffered,
    /// There is no answer to this case in the results.
    Missing,
    /// There is no exact result to hold it against, for this reason.
    Unjudged(String),
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Right { ulps } => write!(f, "right, {} off", super::words::ulps(*ulps)),
            Verdict::Wrong(wrong) => write!(f, "wrong: {wrong}"),
            Verdict::Refused(message) => write!(f, "refused: {message}"),
            Verdict::NotOffered => f.write_str("not offered"),
            Verdict::Missing => f.write_str("no answer in the results"),
            Verdict::Unjudged(why) => write!(f, "not judged: {why}"),
        }
    }
}

/// In what way an answer is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A number is infinite or NaN.
    NotFinite,
    /// What should be a curve is none: knots decrease, weights are not positive, numbers are too few.
    NotACurve,
    /// Not what the operation makes: another degree, a knot not inserted, another number of pieces or coordinates.
    OtherForm,
    /// Of the right form, and another number, point or curve.
    OtherValue,
}

impl Kind {
    /// A short name, as `other value`.
    pub fn name(self) -> &'static str {
        match self {
            Kind::NotFinite => "not finite",
            Kind::NotACurve => "not a curve",
            Kind::OtherForm => "other form",
            Kind::OtherValue => "other value",
        }
    }
}

/// A wrong answer with its witness.
#[derive(Debug, Clone, PartialEq)]
pub struct Wrong {
    /// In what way.
    pub kind: Kind,
    /// Where, as `at parameter 1/4`; empty when that goes without saying.
    pub place: String,
    /// What the engine returned there.
    pub found: String,
    /// The exact value there.
    pub expected: String,
    /// How far off, in units in the last place; infinite when no number tells.
    pub ulps: f64,
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.place.is_empty() {
            write!(f, "{}: ", self.place)?;
        }
        write!(f, "found {}, expected {}", self.found, self.expected)?;
        if self.ulps.is_finite() {
            write!(f, " ({} off)", super::words::ulps(self.ulps))?;
        }
        Ok(())
    }
}

impl Wrong {
    pub(super) fn form(found: impl Into<String>, expected: impl Into<String>) -> Wrong {
        Wrong {
            kind: Kind::OtherForm,
            place: String::new(),
            found: found.into(),
            expected: expected.into(),
            ulps: f64::INFINITY,
        }
    }
}
