//! The statement of the claim `motion` for programs, and in words.

use knotproof::claim::motion::{Criteria, FirstFailures, HalfNu, Statement, Track};
use knotproof::number::RationalExt;
use serde::Serialize;

/// What `--json` prints of a statement. All fractions are exact.
#[derive(Serialize)]
pub struct MotionLine {
    steps: u64,
    denominator: String,
    motion_sha256: String,
    curve: Option<TrackLine>,
    polygon: Option<TrackLine>,
    criteria: Option<CriteriaLine>,
}

#[derive(Serialize)]
struct TrackLine {
    embedded_through: String,
    meets_by: Option<String>,
}

/// First frames at which a criterion fails.
#[derive(Serialize)]
struct FailuresLine {
    infinity: Option<u64>,
    euclidean: Option<u64>,
}

#[derive(Serialize)]
struct CriteriaLine {
    display_tolerance: String,
    second_differences: FailuresLine,
    half_nu: Option<HalfNuLine>,
}

#[derive(Serialize)]
struct HalfNuLine {
    nu_squared: String,
    #[serde(flatten)]
    failures: FailuresLine,
}

impl TrackLine {
    fn new(track: &Track) -> Self {
        TrackLine {
            embedded_through: track.embedded_through.format(),
            meets_by: track.meets_by.as_ref().map(RationalExt::format),
        }
    }
}

impl FailuresLine {
    fn new(failures: &FirstFailures) -> Self {
        FailuresLine {
            infinity: failures.infinity,
            euclidean: failures.euclidean,
        }
    }
}

impl CriteriaLine {
    fn new(criteria: &Criteria) -> Self {
        let half_nu = |half_nu: &HalfNu| HalfNuLine {
            nu_squared: half_nu.nu_squared.format(),
            failures: FailuresLine::new(&half_nu.failures),
        };
        CriteriaLine {
            display_tolerance: criteria.display_tolerance.format(),
            second_differences: FailuresLine::new(&criteria.second_differences),
            half_nu: criteria.half_nu.as_ref().map(half_nu),
        }
    }
}

impl MotionLine {
    /// The statement's own fields.
    pub fn new(statement: &Statement) -> Self {
        MotionLine {
            steps: statement.steps,
            denominator: statement.denominator.to_string(),
            motion_sha256: statement.motion_sha256.clone(),
            curve: statement.curve.as_ref().map(TrackLine::new),
            polygon: statement.polygon.as_ref().map(TrackLine::new),
            criteria: statement.criteria.as_ref().map(CriteriaLine::new),
        }
    }
}

fn track_in_words(name: &str, track: &Track, steps: u64) -> String {
    let through = &track.embedded_through;
    let embedded = if *through == knotproof::number::Rational::from_integer(steps.into()) {
        format!("the {name} stays embedded and isotopic to itself throughout")
    } else {
        format!(
            "the {name} stays embedded and isotopic to itself until time {}",
            through.format()
        )
    };
    match &track.meets_by {
        None => embedded,
        Some(by) => format!("{embedded}, and meets itself by time {}", by.format()),
    }
}

fn criterion_in_words(name: &str, failures: &FirstFailures) -> String {
    let word = |first: Option<u64>| first.map_or("never".to_string(), |frame| format!("at frame {frame}"));
    match (failures.infinity, failures.euclidean) {
        (None, None) => format!("the criterion of {name} never fails"),
        (infinity, euclidean) if infinity == euclidean => {
            format!("the criterion of {name} first fails {}", word(infinity))
        }
        (infinity, euclidean) => format!(
            "the criterion of {name} first fails {} (greatest coordinate), {} (Euclidean)",
            word(infinity),
            word(euclidean)
        ),
    }
}

/// What a statement says, for people.
pub fn in_words(statement: &Statement) -> String {
    let steps = statement.steps;
    let mut parts = vec![match steps {
        1 => "a motion of 1 step".to_string(),
        steps => format!("a motion of {steps} steps"),
    }];
    for (name, track) in [("curve", &statement.curve), ("polygon", &statement.polygon)] {
        parts.extend(track.as_ref().map(|track| track_in_words(name, track, steps)));
    }
    if let Some(criteria) = &statement.criteria {
        parts.push(criterion_in_words("second differences", &criteria.second_differences));
        let half_nu = criteria.half_nu.as_ref();
        parts.extend(half_nu.map(|half_nu| criterion_in_words("half ν", &half_nu.failures)));
    }
    if parts.len() == 1 {
        parts.push("nothing is said of it".into());
    }
    parts.join("; ")
}
