//! The statement's own consistency, and edited statements.

use knotproof::check::Reason;
use serde_json::{Value, json};

use super::{channel, channel_curve, channel_root, step};
use crate::common::case::{Case, Cases, obligation, reason};
use crate::common::document::{Certificate, bezier};

/// Cases of the statement.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("statement");
    let both = || channel().upper("9", channel_root());
    cases.accept("exact", &both());
    cases.accept("nothing-said", &Certificate::new(channel_curve()));
    cases.accept(
        "upper-bound-alone",
        &Certificate::new(channel_curve()).upper("9", channel_root()),
    );
    cases.accept("no-double-normal", &step());
    let lower = |value: &str| both().with("/statement/lower_squared", json!(value));
    let upper = |value: &str| both().with("/statement/upper_squared", json!(value));
    cases.accept("lower-edited-down", &lower("89/10"));
    cases.accept("upper-edited-up", &upper("91/10"));
    cases.reject(
        "lower-edited-up",
        &lower("90001/10000").with("/statement/upper_squared", json!("10")),
        obligation("far"),
    );
    cases.reject(
        "upper-edited-down",
        &upper("89999/10000").with("/statement/lower_squared", json!("8")),
        obligation("root"),
    );
    cases.reject("reversed", &lower("10"), reason(Reason::Reversed));
    cases.reject("inf-beside-an-upper-bound", &lower("inf"), reason(Reason::Reversed));
    cases.reject("zero-with-a-tree", &lower("0"), reason(Reason::TreePresence));
    cases.reject(
        "bound-without-a-tree",
        &both().with("/evidence/tree", Value::Null),
        reason(Reason::TreePresence),
    );
    cases.reject(
        "inf-without-a-tree",
        &step().with("/evidence/tree", Value::Null),
        reason(Reason::TreePresence),
    );
    cases.reject(
        "upper-bound-without-a-rule",
        &both().with("/evidence/upper", Value::Null),
        reason(Reason::UpperPresence),
    );
    cases.reject(
        "rule-without-an-upper-bound",
        &both().with("/statement/upper_squared", Value::Null),
        reason(Reason::UpperPresence),
    );
    cases.accept("greatest-grid", &both().with("/evidence/grid", json!(100_000)));
    cases.reject(
        "grid-above",
        &both().with("/evidence/grid", json!(100_001)),
        reason(Reason::Grid),
    );
    cases.reject(
        "inf-where-there-is-a-double-normal",
        &channel().with("/statement/lower_squared", json!("inf")),
        obligation("far"),
    );
    cases.reject("the-other-convention", &both().critical(), |_| true);

    // A piece that is a point has no tangent.
    let point = bezier(json!([[[0, 0], [4, 0]], [[4, 0], [4, 0]], [[4, 0], [4, 3]]]));
    cases.reject(
        "a-piece-that-is-a-point",
        &Certificate::new(point.clone()),
        reason(Reason::PointPiece { piece: 1 }),
    );
    let tree = [
        "split", "cone 1 0", "second", "bend 1 1", "bend 1 1", "split", "cone 0 1", "bend 1 1", "cone 0 1",
    ];
    cases.reject(
        "a-piece-that-is-a-point-with-a-tree",
        &Certificate::new(point).lower("1", &tree),
        reason(Reason::PointPiece { piece: 1 }),
    );

    // Another curve under the same evidence.
    let lower_roof = crate::common::document::polygon(json!([[0, 0], [4, 0], [4, 2], [0, 2]]));
    cases.reject(
        "about-a-lower-curve",
        &both().curve(lower_roof.clone()),
        obligation("far"),
    );
    let higher_roof = crate::common::document::polygon(json!([[0, 0], [4, 0], [4, 4], [0, 4]]));
    cases.reject("about-a-higher-curve", &both().curve(higher_roof), obligation("root"));
    let unhashed = both().with("/curve", lower_roof);
    cases.malformed("hash-of-another-curve", unhashed.json(), |error| {
        matches!(error, knotproof::certificate::FormatError::Hash { .. })
    });
    cases.list()
}
