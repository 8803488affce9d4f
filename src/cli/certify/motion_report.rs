//! What `certify motion` prints.

use std::fmt::Write;

use knotproof::claim::motion::{Contact, FirstFailures, TrackKind};
use knotproof::motion::Motion;
use knotproof::number::{Rational, RationalExt, decimal_down, decimal_up, sqrt_enclosure};
use knotproof::prove::motion::{Certified, Followed, Measures};
use serde::Serialize;

use super::report::{Written, last_lines};
use crate::cli::Exit;
use crate::cli::bounds::leaves_in_words;
use crate::cli::input::Input;

/// For so many frames, that of time 0 among them, `--json` tells the criteria's values; of a longer motion for none.
pub const FRAMES_TOLD: u64 = 10_001;

/// Significant digits of decimals.
const DIGITS: usize = 12;

/// All there is to tell of a run.
pub struct Report<'r> {
    /// Where the motion was read from.
    pub input: &'r Input,
    /// The motion.
    pub motion: &'r Motion,
    /// What was proved.
    pub certified: &'r Certified<'r>,
    /// How long search, check and writing took.
    pub seconds: f64,
    /// The certificate's file.
    pub written: Option<Written>,
}

/// The object of `--json`.
#[derive(Serialize)]
pub struct ForPrograms {
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    claim: &'static str,
    steps: u64,
    curve: Option<TrackLine>,
    polygon: Option<TrackLine>,
    criteria: Option<CriteriaLine>,
    per_step: Option<Vec<StepLine>>,
    seconds: f64,
    certificate: Option<String>,
    snapped_joints: usize,
}

#[derive(Serialize)]
struct TrackLine {
    /// An exact time; null if not even the first frame was shown to be embedded.
    embedded_through: Option<String>,
    /// The step in which it meets itself: the number of the frame that ends it.
    first_failing_step: Option<u64>,
    meets_by: Option<String>,
    rule: Option<&'static str>,
    leaves: u64,
    edits: u64,
}

/// First frames at which criteria fail.
#[derive(Serialize)]
struct CriteriaLine {
    display_tolerance: String,
    cpij14: CpijLine,
    half_nu: Option<HalfNuLine>,
}

#[derive(Serialize)]
struct CpijLine {
    infinity: Option<u64>,
    euclidean: Option<u64>,
    /// Without N∞, and with the displacement of the point of the greatest second difference alone; null also where it is not evaluated.
    as_printed: Option<u64>,
}

#[derive(Serialize)]
struct HalfNuLine {
    nu_squared: String,
    infinity: Option<u64>,
    euclidean: Option<u64>,
}

/// The values at a frame, exact but for the enclosure of a sum of two roots.
#[derive(Serialize)]
struct StepLine {
    step: u64,
    second_difference_infinity: String,
    second_difference_euclidean_squared: String,
    displacement_infinity: String,
    displacement_euclidean_squared: String,
    cpij14_infinity: String,
    cpij14_euclidean: [String; 2],
    as_printed: Option<String>,
}

impl StepLine {
    fn new(measures: &Measures) -> StepLine {
        let greatest = &measures.greatest;
        let (a, b) = (
            sqrt_enclosure(&greatest.second[1], 64),
            sqrt_enclosure(&greatest.moved[1], 64),
        );
        StepLine {
            step: measures.frame,
            second_difference_infinity: measures.second[0].format(),
            second_difference_euclidean_squared: measures.second[1].format(),
            displacement_infinity: greatest.moved[0].format(),
            displacement_euclidean_squared: greatest.moved[1].format(),
            cpij14_infinity: (&greatest.second[0] + &greatest.moved[0]).format(),
            cpij14_euclidean: [decimal_down(&(a.0 + b.0), DIGITS), decimal_up(&(a.1 + b.1), DIGITS)],
            as_printed: measures.as_printed.as_ref().map(RationalExt::format),
        }
    }
}

impl Report<'_> {
    /// Proved to the end, refuted by a meeting, or undecided.
    pub fn exit(&self) -> Exit {
        let followed = &self.certified.followed;
        if followed.iter().any(|followed| followed.contact.is_some()) {
            Exit::Refuted
        } else if followed.iter().any(|followed| followed.undecided.is_some()) {
            Exit::Undecided
        } else {
            Exit::Success
        }
    }

    fn status(&self) -> &'static str {
        match self.exit() {
            Exit::Success => "certified",
            Exit::Refuted => "refuted",
            _ => "undecided",
        }
    }

    /// One object for programs.
    pub fn for_programs(&self) -> ForPrograms {
        let followed = &self.certified.followed;
        let reasons: Vec<String> = followed
            .iter()
            .filter_map(|followed| followed.undecided.clone())
            .collect();
        let line = |kind: TrackKind| followed.iter().find(|followed| followed.kind == kind).map(track_line);
        ForPrograms {
            status: self.status(),
            reason: (!reasons.is_empty()).then(|| reasons.join("; ")),
            claim: "motion",
            steps: self.motion.steps,
            curve: line(TrackKind::Curve),
            polygon: line(TrackKind::Polygon),
            criteria: self.criteria(),
            per_step: self.per_step(),
            seconds: self.seconds,
            certificate: self.written.as_ref().map(|written| written.path.display().to_string()),
            snapped_joints: self.motion.snapped,
        }
    }

    fn criteria(&self) -> Option<CriteriaLine> {
        let document = self.certified.document.as_ref()?;
        let criteria = document.claim.statement.criteria.as_ref()?;
        let FirstFailures { infinity, euclidean } = criteria.second_differences;
        Some(CriteriaLine {
            display_tolerance: criteria.display_tolerance.format(),
            cpij14: CpijLine {
                infinity,
                euclidean,
                as_printed: self.certified.as_printed.first,
            },
            half_nu: criteria.half_nu.as_ref().map(|half_nu| HalfNuLine {
                nu_squared: half_nu.nu_squared.format(),
                infinity: half_nu.failures.infinity,
                euclidean: half_nu.failures.euclidean,
            }),
        })
    }

    fn per_step(&self) -> Option<Vec<StepLine>> {
        let measures = &self.certified.measures;
        let told = !measures.is_empty() && self.motion.steps < FRAMES_TOLD;
        told.then(|| measures.iter().map(StepLine::new).collect())
    }

    /// Some lines for people.
    pub fn for_people(&self) -> String {
        let name = match &self.motion.name {
            Some(name) => format!("{name:?}"),
            None => self.input.to_string(),
        };
        let steps = match self.motion.steps {
            1 => "1 step".to_string(),
            steps => format!("{steps} steps"),
        };
        let mut text = format!("{}: motion of {name}, {steps}\n", self.status());
        for followed in &self.certified.followed {
            let _ = writeln!(text, "  {}", self.track_in_words(followed));
        }
        if let Some(criteria) = self.criteria() {
            let word =
                |first: Option<u64>| first.map_or("never fails".to_string(), |step| format!("fails at step {step}"));
            let both = |infinity: Option<u64>, euclidean: Option<u64>| match (infinity, euclidean) {
                (None, None) => "never fails in either norm".to_string(),
                (infinity, euclidean) if infinity == euclidean => format!("{} in both norms", word(infinity)),
                (infinity, euclidean) => format!(
                    "{} in the ∞-norm, {} in the Euclidean norm",
                    word(infinity),
                    word(euclidean)
                ),
            };
            let cpij14 = &criteria.cpij14;
            let _ = write!(
                text,
                "  second differences and displacement against the display tolerance {}: {}",
                criteria.display_tolerance,
                both(cpij14.infinity, cpij14.euclidean)
            );
            let _ = match self.certified.as_printed.evaluated {
                true => writeln!(text, " (as CPIJ14 print it, without N∞: {})", word(cpij14.as_printed)),
                false => writeln!(text),
            };
            if let Some(half_nu) = &criteria.half_nu {
                let _ = writeln!(
                    text,
                    "  displacement against ½ν, ν² = {}: {}",
                    half_nu.nu_squared,
                    both(half_nu.infinity, half_nu.euclidean)
                );
            }
        } else if self.motion.display_tolerance.is_some() {
            let _ = writeln!(text, "  the criteria are for polynomial pieces, and were not evaluated");
        }
        let has_evidence = self.certified.document.is_some();
        if !has_evidence {
            let _ = writeln!(text, "  there is nothing to certify");
        }
        text + &last_lines(self.motion.snapped, has_evidence, self.written.as_ref(), self.seconds)
    }

    fn track_in_words(&self, followed: &Followed) -> String {
        let name = followed.kind.name();
        let Some(track) = &followed.track else {
            let why = followed.undecided.as_deref().unwrap_or("nothing was proved");
            return format!("{name}: nothing proved, {why}");
        };
        let by = format!(
            "by {} at the end, {} replaced",
            leaves_in_words(followed.leaves),
            followed.edits
        );
        let until = in_decimal(&track.embedded_through);
        match (&track.meets_by, &followed.undecided) {
            (Some(meets_by), _) => format!(
                "{name}: meets itself in step {}, between the times {until} and {}; embedded, and the same up to isotopy, until {until}, {by}",
                step_after(&track.embedded_through),
                in_decimal(meets_by)
            ),
            (None, Some(why)) => {
                format!("{name}: embedded, and the same up to isotopy, until time {until}, {by}; undecided {why}")
            }
            (None, None) => format!("{name}: embedded, and the same up to isotopy, throughout, {by}"),
        }
    }
}

/// A time, exact where that is short.
fn in_decimal(time: &Rational) -> String {
    let exact = time.format();
    if exact.len() <= 8 {
        exact
    } else {
        format!("{:.10}", time.to_f64())
    }
}

/// The number of the frame after a time.
fn step_after(time: &Rational) -> u64 {
    time.numer().div_floor(time.denom()).to_u64().unwrap_or(0) + 1
}

fn track_line(followed: &Followed) -> TrackLine {
    let track = followed.track.as_ref();
    let meets_by = track.and_then(|track| track.meets_by.as_ref());
    TrackLine {
        embedded_through: track.map(|track| track.embedded_through.format()),
        first_failing_step: track
            .filter(|_| meets_by.is_some())
            .map(|track| step_after(&track.embedded_through)),
        meets_by: meets_by.map(RationalExt::format),
        rule: followed.contact.as_ref().map(Contact::rule),
        leaves: followed.leaves,
        edits: followed.edits,
    }
}
