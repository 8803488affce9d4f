//! What a displacement in a motion file means.

use super::MotionError;

/// What moves when a point is displaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strategy {
    /// The points that are named, and no others (CPIJ14 §5).
    Free,
    /// A C¹ chain of Bézier pieces of equal spans stays C¹ (CPIJ14 §6): a point next to a joint (type 1) takes the joint to the midpoint of its two
    /// neighbours, a joint (type 2) takes its neighbours along, any other point (type 3) moves alone.
    C1,
}

impl Strategy {
    /// The strategy of a name; `None` stands for `free`.
    pub(super) fn of(name: Option<&str>) -> Result<Strategy, MotionError> {
        match name {
            None | Some("free") => Ok(Strategy::Free),
            Some("c1") => Ok(Strategy::C1),
            Some(other) => {
                let what = format!("found {other:?}, expected \"free\" or \"c1\"");
                Err(MotionError::new("strategy", what))
            }
        }
    }
}
