//! Cases by subject: one file for each rule, and for the parts of a certificate that belong to no rule.

pub mod ball;
pub mod bend;
pub mod binary;
pub mod change;
pub mod cone;
pub mod critical_interval;
pub mod critical_root;
pub mod crossing;
pub mod curvature;
pub mod curve;
pub mod deviation;
pub mod domain;
pub mod embedding;
pub mod empty;
pub mod far;
pub mod miranda;
pub mod monotone;
pub mod motion;
pub mod nearest;
pub mod not_normal;
pub mod numbers;
pub mod pedal;
pub mod root;
pub mod sandwich;
pub mod separate;
pub mod statement;
pub mod text;
pub mod thickness;
pub mod touch;
pub mod tree;
pub mod turn;
pub mod values;

use serde_json::{Value, json};

use crate::common::case::Case;
use crate::common::document::{Certificate, polygon};

/// All subjects with their cases.
#[allow(clippy::type_complexity, reason = "a plain list")]
pub fn all() -> Vec<(&'static str, fn() -> Vec<Case>)> {
    vec![
        ("far", far::cases),
        ("not_normal", not_normal::cases),
        ("cone", cone::cases),
        ("bend", bend::cases),
        ("turn", turn::cases),
        ("pedal", pedal::cases),
        ("miranda", miranda::cases),
        ("root", root::cases),
        ("touch", touch::cases),
        ("crossing", crossing::cases),
        ("critical_root", critical_root::cases),
        ("critical_interval", critical_interval::cases),
        ("tree", tree::cases),
        ("statement", statement::cases),
        ("curve", curve::cases),
        ("text", text::cases),
        ("binary", binary::cases),
        ("numbers", numbers::cases),
        ("domain", domain::cases),
        ("sandwich", sandwich::cases),
        ("empty", empty::cases),
        ("nearest", nearest::cases),
        ("change", change::cases),
        ("ball", ball::cases),
        ("separate", separate::cases),
        ("monotone", monotone::cases),
        ("embedding", embedding::cases),
        ("curvature", curvature::cases),
        ("deviation", deviation::cases),
        ("thickness", thickness::cases),
        ("motion", motion::cases),
        ("values", values::cases),
    ]
}

/// Three sides of a rectangle, open: (0,0), (4,0), (4,3), (0,3). σ = 3.
pub fn channel_curve() -> Value {
    polygon(json!([[0, 0], [4, 0], [4, 3], [0, 3]]))
}

/// A tree for [`channel_curve`]. Token 4 is for the two long sides, token 3 and 7 for its corners, the others for one side each.
pub const CHANNEL: [&str; 9] = [
    "split",
    "cone 1 0",
    "second",
    "bend 1 1",
    "far 0 -1",
    "split",
    "cone 0 1",
    "bend 1 1",
    "cone -1 0",
];

/// The channel with the greatest lower bound.
pub fn channel() -> Certificate {
    Certificate::new(channel_curve()).lower("9", &CHANNEL)
}

/// A double normal of the channel.
pub fn channel_root() -> Value {
    json!({ "rule": "root", "s": "1/2", "s_side": "after", "t": "5/2", "t_side": "after" })
}

/// An open polygon that climbs a step: no double normal.
pub fn step_curve() -> Value {
    polygon(json!([[0, 0], [2, 0], [3, 1], [5, 1]]))
}

/// A tree for [`step_curve`]. Token 4 is for its two level sides.
pub const STEP: [&str; 9] = [
    "split",
    "cone 1 0",
    "second",
    "cone 2 1",
    "not_normal -1 0",
    "split",
    "cone 1 1",
    "cone 2 1",
    "cone 1 0",
];

/// The step with the statement that it has no double normal.
pub fn step() -> Certificate {
    Certificate::new(step_curve()).lower("inf", &STEP)
}

/// The segment from (0,0) to (3,4), of one piece.
pub fn segment_curve() -> Value {
    polygon(json!([[0, 0], [3, 4]]))
}

/// A tree for [`segment_curve`] in the convention `critical`; token 2 is for the start and the piece, 3 for both ends, 6 for the piece and its end.
pub const SEGMENT: [&str; 7] = [
    "split",
    "second",
    "bend 1 0",
    "not_normal -1 0",
    "split",
    "cone 3 4",
    "bend 0 1",
];
