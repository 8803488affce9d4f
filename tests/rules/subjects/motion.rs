//! The claim `motion`: events, leaves that must hold while points move, contacts, criteria.

use knotproof::check::motion::MotionError;
use knotproof::check::{Place, Reason, Rejection};
use serde_json::{Value, json};

use super::channel_curve;
use super::embedding::CHANNEL;
use crate::common::case::{Case, Cases, expecting, obligation, reason};
use crate::common::document::{Certificate, bezier, polygon};

/// A motion of a curve about which nothing is said.
fn still(curve: Value, denominator: &str, events: Value) -> Certificate {
    let list = events.as_array().expect("a list of events");
    let steps = list
        .iter()
        .filter(|event| event.get("step").or(event.get("begin")).is_some())
        .count();
    Certificate::new(curve)
        .with(
            "/statement",
            json!({
                "claim": "motion", "steps": steps, "denominator": denominator, "motion_sha256": "",
                "curve": null, "polygon": null, "criteria": null
            }),
        )
        .with(
            "/evidence",
            json!({ "curve_contact": null, "polygon_contact": null, "events": events }),
        )
        .moved()
}

/// The same with a track.
fn motion(curve: Value, track: &str, through: &str, by: Value, events: Value) -> Certificate {
    still(curve, "1", events).with(
        &format!("/statement/{track}"),
        json!({ "embedded_through": through, "meets_by": by }),
    )
}

/// The tree of the channel as an event. Leaf 2 separates the two long sides.
fn tree(track: &str) -> Value {
    json!({ "tree": track, "tokens": CHANNEL })
}

/// The last point of the channel, (0,3), moves down.
fn down(by: i64) -> Value {
    json!([[3, "0", (-by).to_string()]])
}

fn step(by: i64) -> Value {
    json!({ "step": down(by) })
}

fn begin(by: i64) -> Value {
    json!({ "begin": down(by) })
}

fn go(time: &str) -> Value {
    json!({ "go": time })
}

/// The channel's end moves down by 1, twice: it stays embedded.
fn closing() -> Certificate {
    motion(
        channel_curve(),
        "curve",
        "2",
        Value::Null,
        json!([tree("curve"), step(1), step(1)]),
    )
}

/// With other events, and the number of its steps and the hash as they are then.
fn events(certificate: &Certificate, events: Value) -> Certificate {
    let list = events.as_array().expect("a list of events");
    let steps = list
        .iter()
        .filter(|event| event.get("step").or(event.get("begin")).is_some())
        .count();
    let certificate = certificate.clone().with("/evidence/events", events);
    certificate.with("/statement/steps", json!(steps)).moved()
}

/// In the third step the end goes through the other side, which it meets at time 5/2.
fn meeting(contact: Value) -> Certificate {
    let list = json!([
        tree("curve"),
        step(1),
        step(1),
        begin(2),
        go("1/4"),
        { "end": "curve" },
        go("1")
    ]);
    motion(channel_curve(), "curve", "9/4", json!("3"), list).with("/evidence/curve_contact", contact)
}

fn touch() -> Value {
    json!({ "rule": "touch", "time": "5/2", "s": "0", "t": "3" })
}

fn crossing() -> Value {
    json!({
        "rule": "crossing", "time": "3", "s": ["0", "1/2"], "t": ["5/2", "3"],
        "first": ["1", "-1"], "second": ["0", "1"]
    })
}

/// A side passes over another in space, at time 1/2.
fn passing(contact: Value) -> Certificate {
    let curve = polygon(json!([[0, 0, 0], [4, 0, 0], [4, 4, 2], [0, -4, 2]]));
    let tokens = [
        "split",
        "monotone 1 0 0",
        "second",
        "monotone 1 1 0",
        "separate 0 0 -1",
        "split",
        "monotone 0 1 0",
        "monotone -1 0 1",
        "monotone -1 0 0",
    ];
    let list = json!([
        { "tree": "curve", "tokens": tokens },
        { "begin": [[2, "0", "0", "-4"], [3, "0", "0", "-4"]] },
        go("1/4"),
        { "end": "curve" },
        go("1")
    ]);
    motion(curve, "curve", "1/4", json!("1"), list).with("/evidence/curve_contact", contact)
}

fn passage() -> Value {
    json!({
        "rule": "passage", "times": ["1/4", "1"], "s": ["1/4", "3/4"], "t": ["9/4", "11/4"],
        "first": ["2", "-1", "0"], "second": ["0", "1", "0"], "third": ["0", "0", "1"]
    })
}

/// A square of side 2, closed, as Bézier pieces.
fn square() -> Value {
    polygon(json!([[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]))
}

/// The same as a B-spline, with the first point once more at the end.
fn square_spline() -> Value {
    json!({ "bspline": {
        "degree": 1, "knots": ["0", "0", "1", "2", "3", "4", "4"],
        "points": [["0", "0"], ["2", "0"], ["2", "2"], ["0", "2"], ["0", "0"]]
    } })
}

const SQUARE: [&str; 16] = [
    "split",
    "split",
    "monotone 1 0",
    "monotone 1 1",
    "monotone 0 1",
    "first",
    "second",
    "separate 0 -1",
    "monotone 1 -1",
    "second",
    "monotone -1 1",
    "separate 1 0",
    "split",
    "monotone -1 0",
    "monotone -1 -1",
    "monotone 0 -1",
];

/// A parabola whose middle point moves by (3,−4)/5 in every step.
fn parabola() -> Certificate {
    let curve = bezier(json!([[[-1, 1], [0, -1], [1, 1]]]));
    let by = json!([[1, "3", "-4"]]);
    let list = json!([{ "step": by }, { "step": by }, { "step": by }]);
    still(curve, "5", list).with(
        "/statement/criteria",
        json!({
            "display_tolerance": "12/5",
            "second_differences": { "infinity": 2, "euclidean": 1 },
            "half_nu": { "nu_squared": "16/5", "infinity": 2, "euclidean": 1 }
        }),
    )
}

/// Something else than this was found there.
fn wanting(wish: &'static str) -> impl Fn(&Rejection) -> bool {
    move |rejection| matches!(&rejection.reason, Reason::Expected { expected, .. } if *expected == wish)
}

/// A leaf does not hold at the time that an event leads to.
fn fails_at(event: u64, number: u64) -> impl Fn(&Rejection) -> bool {
    move |rejection| {
        rejection.place
            == Place::EventLeaf {
                number: event,
                track: "curve",
                leaf: number,
            }
    }
}

pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("motion");
    tracks(&mut cases);
    trees(&mut cases);
    times(&mut cases);
    moves(&mut cases);
    contacts(&mut cases);
    passages(&mut cases);
    closed(&mut cases);
    criteria(&mut cases);
    malformed(&mut cases);
    cases.list()
}

fn tracks(cases: &mut Cases) {
    let closing = closing();
    cases.accept("closing", &closing);
    cases.accept_bytes("closing-binary", closing.binary());
    let nothing = closing
        .clone()
        .with("/statement/curve", Value::Null)
        .with("/evidence/events", json!([step(1), step(1)]));
    cases.accept("nothing-is-said", &nothing);
    cases.reject(
        "steps-after-the-last",
        &nothing.clone().with("/statement/steps", json!(1)),
        wanting("no more moves than steps of the statement"),
    );
    cases.reject(
        "steps-missing",
        &nothing.clone().with("/statement/steps", json!(3)),
        wanting("events until the last frame"),
    );
    cases.reject(
        "too-many-steps",
        &nothing.clone().with("/statement/steps", json!(100_000_001u64)),
        wanting("at most 100,000,000 steps"),
    );
    cases.reject(
        "no-tree",
        &closing.clone().with("/evidence/events", json!([step(1), step(1)])),
        wanting("a tree for every track of the statement"),
    );
    cases.reject(
        "a-track-that-is-null",
        &nothing
            .clone()
            .with("/evidence/events", json!([tree("curve"), step(1), step(1)])),
        wanting("an event about a track of the statement"),
    );
    cases.reject(
        "the-other-track",
        &closing
            .clone()
            .with("/evidence/events", json!([tree("polygon"), step(1), step(1)])),
        wanting("an event about a track of the statement"),
    );
    let at = |through: &str| {
        closing
            .clone()
            .with("/statement/curve/embedded_through", json!(through))
    };
    cases.reject(
        "embedded-through-less",
        &at("1"),
        wanting("a track that ends at embedded_through"),
    );
    cases.reject(
        "embedded-through-more",
        &at("5/2"),
        wanting("embedded_through: a time from 0 to the number of steps"),
    );
    cases.reject(
        "embedded-through-negative",
        &at("-1"),
        wanting("embedded_through: a time from 0 to the number of steps"),
    );
    cases.reject(
        "hash-of-another",
        &closing.clone().with("/statement/motion_sha256", json!("0".repeat(64))),
        wanting("motion_sha256: the hash of the motion"),
    );
    cases.reject(
        "hash-in-capitals",
        &closing.clone().with(
            "/statement/motion_sha256",
            json!(
                closing.0["statement"]["motion_sha256"]
                    .as_str()
                    .expect("a text")
                    .to_uppercase()
            ),
        ),
        wanting("motion_sha256: the hash of the motion"),
    );
    let no_steps = motion(channel_curve(), "curve", "0", Value::Null, json!([tree("curve")]));
    cases.accept("no-steps", &no_steps);
    cases.reject(
        "no-steps-no-tree",
        &no_steps.with("/evidence/events", json!([])),
        wanting("a tree for every track of the statement"),
    );
    let both = closing
        .clone()
        .with(
            "/statement/polygon",
            json!({ "embedded_through": "2", "meets_by": null }),
        )
        .with(
            "/evidence/events",
            json!([tree("curve"), tree("polygon"), step(1), step(1)]),
        );
    cases.accept("both-tracks", &both);
    cases.accept_bytes("both-tracks-binary", both.binary());
}

fn trees(cases: &mut Cases) {
    let closing = closing();
    let with = |list: Value| events(&closing, list);
    let edit = |leaf: u64, tokens: Value| json!({ "edit": "curve", "leaf": leaf, "tokens": tokens });
    let same = json!(["separate 0 -1"]);
    let halves = json!(["first", "separate 0 -1", "separate 0 -1"]);
    let edited = with(json!([tree("curve"), step(1), edit(2, halves.clone()), step(1)]));
    cases.accept("edited", &edited);
    cases.accept_bytes("edited-binary", edited.binary());
    cases.accept(
        "edited-twice",
        &with(json!([
            tree("curve"),
            edit(2, halves.clone()),
            step(1),
            edit(7, same.clone()),
            edit(8, same.clone()),
            step(1)
        ])),
    );
    let gone = wanting("a leaf of the table");
    cases.reject(
        "edit-of-a-leaf-that-is-gone",
        &with(json!([
            tree("curve"),
            edit(2, halves.clone()),
            step(1),
            edit(2, same.clone()),
            step(1)
        ])),
        gone,
    );
    cases.reject(
        "edit-of-a-leaf-that-never-was",
        &with(json!([tree("curve"), step(1), edit(6, same.clone()), step(1)])),
        wanting("a leaf of the table"),
    );
    cases.reject(
        "edit-without-tree",
        &with(json!([edit(0, same.clone()), tree("curve"), step(1), step(1)])),
        wanting("an edit of a track with a tree"),
    );
    cases.reject(
        "edit-of-no-tokens",
        &with(json!([tree("curve"), edit(2, json!([])), step(1), step(1)])),
        reason(Reason::TokensMissing),
    );
    cases.reject(
        "edit-incomplete",
        &with(json!([
            tree("curve"),
            edit(2, json!(["first", "separate 0 -1"])),
            step(1),
            step(1)
        ])),
        reason(Reason::TokensMissing),
    );
    cases.reject(
        "edit-with-tokens-left",
        &with(json!([
            tree("curve"),
            edit(2, json!(["separate 0 -1", "separate 0 -1"])),
            step(1),
            step(1)
        ])),
        reason(Reason::TokensLeft),
    );
    cases.reject(
        "edit-does-not-hold",
        &with(json!([
            tree("curve"),
            edit(2, json!(["separate 0 1"])),
            step(1),
            step(1)
        ])),
        obligation("separate"),
    );
    cases.reject(
        "edit-splits-a-pair-as-one-node",
        &with(json!([tree("curve"), edit(2, json!(["split"])), step(1), step(1)])),
        reason(Reason::WrongSplit),
    );
    // An edited leaf must hold at later frames as all others.
    cases.reject(
        "edit-does-not-hold-later",
        &with(json!([tree("curve"), edit(5, json!(["monotone -1 2"])), step(1), { "step": [[3, "1", "-1"]] }])),
        fails_at(3, 6),
    );
    cases.accept(
        "edit-holds-later",
        &with(json!([tree("curve"), edit(5, json!(["monotone -1 2"])), step(1), { "step": [[3, "1", "0"]] }])),
    );
    let planted = |tokens: Value| with(json!([{ "tree": "curve", "tokens": tokens }, step(1), step(1)]));
    cases.reject("tree-of-no-tokens", &planted(json!([])), reason(Reason::TokensMissing));
    cases.reject(
        "tree-incomplete",
        &planted(json!(CHANNEL[..8])),
        reason(Reason::TokensMissing),
    );
    let mut more = CHANNEL.to_vec();
    more.push("monotone 1 0");
    cases.reject(
        "tree-with-tokens-left",
        &planted(json!(more)),
        reason(Reason::TokensLeft),
    );
    let token = |i: usize, token: &str| {
        let mut tokens = CHANNEL.map(String::from);
        tokens[i] = token.into();
        planted(json!(tokens))
    };
    cases.reject("separate-turned", &token(4, "separate 0 1"), obligation("separate"));
    cases.reject("separate-by-nothing", &token(4, "separate 0 0"), obligation("separate"));
    cases.reject("monotone-by-nothing", &token(1, "monotone 0 0"), obligation("monotone"));
    cases.reject(
        "monotone-apart",
        &token(4, "monotone 1 1"),
        expecting("monotone", "adjacent nodes"),
    );
    cases.reject(
        "separate-of-one-node",
        &token(1, "separate 1 0"),
        expecting("separate", "two different nodes"),
    );
    cases.reject(
        "a-rule-of-another-claim",
        &token(4, "far 0 -1"),
        expecting("far", "a rule of the claim motion"),
    );
    // Nothing but a leaf that holds at every frame will do: here only its own tree's holds at frame 1.
    let turned = json!({ "step": [[3, "4", "0"]] });
    cases.reject(
        "a-leaf-fails",
        &with(json!([tree("curve"), step(1), turned])),
        |rejection| {
            matches!(
                rejection.place,
                Place::EventLeaf {
                    number: 2,
                    track: "curve",
                    ..
                }
            )
        },
    );
    // Another tree may take over at any time.
    let again = [
        "split",
        "monotone 1 0",
        "second",
        "monotone 1 1",
        "separate -1 -8",
        "split",
        "monotone 0 1",
        "monotone -1 1",
        "monotone -1 0",
    ];
    let second = json!({ "tree": "curve", "tokens": again });
    cases.accept("another-tree", &with(json!([tree("curve"), step(1), second, step(1)])));
    cases.reject(
        "another-tree-of-no-tokens",
        &with(json!([tree("curve"), step(1), { "tree": "curve", "tokens": [] }, step(1)])),
        reason(Reason::TokensMissing),
    );
    cases.reject(
        "numbers-begin-anew",
        &with(json!([
            tree("curve"),
            edit(2, halves),
            second,
            edit(7, same),
            step(1),
            step(1)
        ])),
        wanting("a leaf of the table"),
    );
}

fn times(cases: &mut Cases) {
    let closing = closing();
    let with = |list: Value| events(&closing, list);
    let end = json!({ "end": "curve" });
    let halfway = with(json!([tree("curve"), begin(1), go("1/2"), go("3/4"), go("1"), step(1)]));
    cases.accept("halfway", &halfway);
    cases.accept_bytes("halfway-binary", halfway.binary());
    cases.accept(
        "begun-and-done",
        &with(json!([tree("curve"), begin(1), go("1"), begin(1), go("1")])),
    );
    cases.accept("edited-halfway", &with(json!([tree("curve"), begin(1), go("1/2"), { "edit": "curve", "leaf": 2, "tokens": ["separate 0 -1"] }, go("1"), step(1)])));
    cases.accept(
        "another-tree-halfway",
        &with(json!([
            tree("curve"),
            begin(1),
            go("1/2"),
            tree("curve"),
            go("1"),
            step(1)
        ])),
    );
    let later = wanting("a time after the one before");
    cases.reject(
        "back",
        &with(json!([tree("curve"), begin(1), go("1/2"), go("1/4"), go("1"), step(1)])),
        later,
    );
    cases.reject(
        "nowhere",
        &with(json!([tree("curve"), begin(1), go("1/2"), go("1/2"), go("1"), step(1)])),
        wanting("a time after the one before"),
    );
    let dyadic = "a reduced dyadic fraction above 0 and at most 1";
    cases.reject(
        "beyond",
        &with(json!([tree("curve"), begin(1), go("3/2"), step(1)])),
        wanting(dyadic),
    );
    cases.reject(
        "to-zero",
        &with(json!([tree("curve"), begin(1), go("0"), go("1"), step(1)])),
        wanting(dyadic),
    );
    cases.reject(
        "not-begun",
        &with(json!([tree("curve"), go("1"), step(1), step(1)])),
        wanting("a move that has begun"),
    );
    cases.reject(
        "gone-twice",
        &with(json!([tree("curve"), begin(1), go("1"), go("1"), step(1)])),
        wanting("a move that has begun"),
    );
    let rest = "the rest of the move that has begun";
    cases.reject(
        "step-in-a-move",
        &with(json!([tree("curve"), begin(1), step(1)])),
        wanting(rest),
    );
    cases.reject(
        "begin-in-a-move",
        &with(json!([tree("curve"), begin(1), go("1/2"), begin(1), go("1")])),
        wanting(rest),
    );
    cases.reject(
        "not-finished",
        &with(json!([tree("curve"), step(1), begin(1)])),
        wanting("events until the last frame"),
    );
    cases.reject(
        "not-finished-halfway",
        &with(json!([tree("curve"), step(1), begin(1), go("1/2")])),
        wanting("events until the last frame"),
    );
    // As many moves as steps, and the last one only begun.
    let begun = with(json!([tree("curve"), step(1), step(1), begin(1)]))
        .with("/statement/steps", json!(2))
        .moved();
    cases.reject(
        "begun-after-the-last",
        &begun,
        wanting("no more moves than steps of the statement"),
    );
    let first = "the first tree of a track at time 0";
    cases.reject(
        "tree-later",
        &with(json!([step(1), tree("curve"), step(1)])),
        wanting(first),
    );
    cases.reject(
        "tree-halfway",
        &with(json!([begin(1), go("1/2"), tree("curve"), go("1"), step(1)])),
        wanting(first),
    );
    cases.accept(
        "tree-when-begun",
        &with(json!([begin(1), tree("curve"), go("1"), step(1)])),
    );
    let ended =
        with(json!([tree("curve"), step(1), end, step(1)])).with("/statement/curve/embedded_through", json!("1"));
    cases.accept("ended", &ended);
    cases.reject(
        "ended-elsewhere",
        &ended.clone().with("/statement/curve/embedded_through", json!("1/2")),
        wanting("the end of a track at embedded_through"),
    );
    cases.reject(
        "ended-and-claimed-to-the-end",
        &ended.clone().with("/statement/curve/embedded_through", json!("2")),
        wanting("the end of a track at embedded_through"),
    );
    cases.reject(
        "ended-twice",
        &ended
            .clone()
            .with("/evidence/events", json!([tree("curve"), step(1), end, end, step(1)])),
        wanting("an end of a track with a tree"),
    );
    cases.reject(
        "ended-before-its-tree",
        &with(json!([end, step(1), step(1)])).with("/statement/curve/embedded_through", json!("0")),
        wanting("an end of a track with a tree"),
    );
    cases.reject(
        "edited-after-the-end",
        &ended.clone().with(
            "/evidence/events",
            json!([tree("curve"), step(1), end, { "edit": "curve", "leaf": 2, "tokens": ["separate 0 -1"] }, step(1)]),
        ),
        wanting("an edit of a track with a tree"),
    );
    cases.reject(
        "tree-after-the-end",
        &ended.with(
            "/evidence/events",
            json!([tree("curve"), step(1), end, tree("curve"), step(1)]),
        ),
        wanting("no tree of a track that has ended"),
    );
    let at_start =
        with(json!([tree("curve"), end, step(1), step(1)])).with("/statement/curve/embedded_through", json!("0"));
    cases.accept("ended-at-the-start", &at_start);
    cases.reject(
        "tree-after-the-end-at-the-start",
        &at_start.with(
            "/evidence/events",
            json!([tree("curve"), end, tree("curve"), step(1), step(1)]),
        ),
        wanting("no tree of a track that has ended"),
    );
    // The sides are 1/2 apart at time 5/2, and meet at 3.
    let near = json!([tree("curve"), step(1), step(1), begin(1), go("1/2"), end, go("1")]);
    cases.accept(
        "ended-halfway",
        &with(near).with("/statement/curve/embedded_through", json!("5/2")),
    );
    cases.reject(
        "until-it-meets",
        &with(json!([tree("curve"), step(1), step(1), step(1)])).with("/statement/curve/embedded_through", json!("3")),
        fails_at(3, 2),
    );
    cases.reject(
        "until-it-meets-halfway",
        &with(json!([
            tree("curve"),
            step(1),
            step(1),
            begin(2),
            go("1/4"),
            go("1/2"),
            end,
            go("1")
        ]))
        .with("/statement/curve/embedded_through", json!("5/2")),
        fails_at(5, 2),
    );
}

fn moves(cases: &mut Cases) {
    let closing = closing();
    let with = |displacements: Value| events(&closing, json!([tree("curve"), { "step": displacements }, step(1)]));
    cases.accept("no-point-moves", &with(json!([])));
    cases.accept(
        "all-points-move",
        &with(json!([[0, "5", "7"], [1, "5", "7"], [2, "5", "7"], [3, "5", "7"]])),
    );
    let far = "1".to_string() + &"0".repeat(40);
    cases.accept(
        "all-points-move-far",
        &with(json!([[0, far, far], [1, far, far], [2, far, far], [3, far, far]])),
    );
    let none = reason(Reason::Motion(MotionError::Point { point: 4, count: 4 }));
    cases.reject("no-such-point", &with(json!([[4, "1", "0"]])), none);
    let last = u64::MAX;
    cases.reject(
        "no-such-point-by-far",
        &with(json!([[last, "1", "0"]])),
        reason(Reason::Motion(MotionError::Point { point: last, count: 4 })),
    );
    let shifted = polygon(json!([[0, 0], [4, 0], [4, 3], [0, "5/2"]]));
    let fraction = closing.clone().curve(shifted);
    cases.reject(
        "not-over-the-denominator",
        &fraction.clone().moved(),
        reason(Reason::Motion(MotionError::Denominator { point: 3 })),
    );
    cases.accept(
        "over-the-denominator",
        &fraction.with("/statement/denominator", json!("2")).moved(),
    );
    cases.reject(
        "denominator-zero",
        &closing.clone().with("/statement/denominator", json!("0")),
        wanting("a denominator of at least 1"),
    );
    cases.reject(
        "denominator-negative",
        &closing.with("/statement/denominator", json!("-1")),
        wanting("a denominator of at least 1"),
    );
    let point = json!({ "bezier": { "pieces": [{ "points": [["0", "0"], ["0", "0"]] }, { "points": [["0", "0"], ["1", "0"]] }] } });
    let still = still(point, "1", json!([]));
    cases.reject(
        "a-piece-that-is-a-point",
        &still,
        reason(Reason::PointPiece { piece: 0 }),
    );
}

fn contacts(cases: &mut Cases) {
    cases.accept("touch", &meeting(touch()));
    cases.accept_bytes("touch-binary", meeting(touch()).binary());
    cases.accept("crossing", &meeting(crossing()));
    cases.accept_bytes("crossing-binary", meeting(crossing()).binary());
    let present = "a contact when and only when there is a meets_by";
    cases.reject("contact-missing", &meeting(Value::Null), wanting(present));
    cases.reject(
        "contact-not-stated",
        &meeting(touch()).with("/statement/curve/meets_by", Value::Null),
        wanting(present),
    );
    cases.reject(
        "contact-of-no-track",
        &meeting(touch()).with("/evidence/polygon_contact", touch()),
        wanting("a contact only of a track of the statement"),
    );
    let by = |time: &str| meeting(touch()).with("/statement/curve/meets_by", json!(time));
    cases.accept("meets-by-sharp", &by("5/2"));
    let after = "meets_by: a time after embedded_through, not after the frame that follows it";
    cases.reject("meets-at-once", &by("9/4"), wanting(after));
    cases.reject(
        "meets-after-the-next-frame",
        &events(
            &meeting(touch()),
            json!([tree("curve"), step(1), step(1), begin(2), go("1/4"), { "end": "curve" }, go("1"), step(1)]),
        )
        .with("/statement/curve/meets_by", json!("4")),
        wanting(after),
    );
    let when = "a time after embedded_through and not after meets_by";
    cases.reject("meets-before-the-contact", &by("19/8"), expecting("touch", when));
    let at = |contact: Value, field: &str, value: Value| {
        let mut contact = contact;
        contact[field] = value;
        meeting(contact)
    };
    cases.reject(
        "touch-too-early",
        &at(touch(), "time", json!("9/4")),
        expecting("touch", when),
    );
    cases.reject(
        "touch-long-before",
        &at(touch(), "time", json!("-1")),
        expecting("touch", when),
    );
    cases.reject(
        "touch-too-late",
        &at(touch(), "time", json!("7/2")),
        expecting("touch", when),
    );
    cases.reject(
        "touch-at-another-time",
        &at(touch(), "time", json!("21/8")),
        expecting("touch", "c(s) = c(t)"),
    );
    cases.reject(
        "touch-elsewhere",
        &at(touch(), "s", json!("1/2")),
        expecting("touch", "c(s) = c(t)"),
    );
    cases.reject(
        "touch-of-one-parameter",
        &at(touch(), "s", json!("3")),
        expecting("touch", "s < t"),
    );
    cases.reject(
        "touch-beyond-the-end",
        &at(touch(), "t", json!("4")),
        expecting("touch", "two parameters of the curve"),
    );
    cases.reject(
        "crossing-at-another-time",
        &at(crossing(), "time", json!("19/8")),
        obligation("crossing"),
    );
    cases.reject(
        "crossing-elsewhere",
        &at(crossing(), "s", json!(["0", "1/8"])),
        expecting("crossing", "one strict sign on each face"),
    );
    cases.reject(
        "crossing-turned",
        &at(crossing(), "first", json!(["-1", "1"])),
        expecting("crossing", "one strict sign on each face"),
    );
    cases.reject(
        "crossing-dependent",
        &at(crossing(), "second", json!(["-1", "1"])),
        expecting("crossing", "independent n₁, n₂"),
    );
    cases.reject(
        "passage-in-the-plane",
        &meeting(json!({
            "rule": "passage", "times": ["9/4", "3"], "s": ["0", "1/2"], "t": ["5/2", "3"],
            "first": ["1", "-1"], "second": ["0", "1"], "third": ["1", "0"]
        })),
        expecting("passage", "a spatial curve"),
    );
}

fn passages(cases: &mut Cases) {
    cases.accept("passage", &passing(passage()));
    cases.accept_bytes("passage-binary", passing(passage()).binary());
    let at = |field: &str, value: Value| {
        let mut contact = passage();
        contact[field] = value;
        passing(contact)
    };
    let when = "two times in order from embedded_through to meets_by";
    cases.reject(
        "passage-too-early",
        &at("times", json!(["0", "1"])),
        expecting("passage", when),
    );
    cases.reject(
        "passage-too-late",
        &at("times", json!(["1/4", "5/4"])),
        expecting("passage", when),
    );
    cases.reject(
        "passage-back",
        &at("times", json!(["1", "1/4"])),
        expecting("passage", when),
    );
    cases.reject(
        "passage-at-one-time",
        &at("times", json!(["1/2", "1/2"])),
        expecting("passage", when),
    );
    let third = "n₃·(p − q) negative at the first time and positive at the second";
    cases.reject(
        "passage-before-it",
        &at("times", json!(["1/4", "3/8"])),
        expecting("passage", third),
    );
    cases.reject(
        "passage-after-it",
        &at("times", json!(["5/8", "1"])),
        expecting("passage", third),
    );
    cases.reject(
        "passage-upwards",
        &at("third", json!(["0", "0", "-1"])),
        expecting("passage", third),
    );
    let face = "one strict sign on each face at both times";
    cases.reject(
        "passage-elsewhere",
        &at("s", json!(["1/8", "1/4"])),
        expecting("passage", face),
    );
    cases.reject(
        "passage-turned",
        &at("first", json!(["-2", "1", "0"])),
        expecting("passage", face),
    );
    cases.reject(
        "passage-second-turned",
        &at("second", json!(["0", "-1", "0"])),
        expecting("passage", face),
    );
    cases.reject(
        "passage-dependent",
        &at("third", json!(["2", "0", "0"])),
        expecting("passage", "independent n₁, n₂, n₃"),
    );
    cases.reject(
        "passage-of-one-interval",
        &at("t", json!(["1/4", "3/4"])),
        expecting("passage", "disjoint intervals in order"),
    );
    cases.reject(
        "passage-outside",
        &at("t", json!(["11/4", "13/4"])),
        expecting("passage", "two intervals of the curve"),
    );
    cases.reject(
        "crossing-in-space",
        &passing(json!({
            "rule": "crossing", "time": "1/2", "s": ["1/4", "3/4"], "t": ["9/4", "11/4"],
            "first": ["2", "-1", "0"], "second": ["0", "1", "0"]
        })),
        expecting("crossing", "a planar curve"),
    );
    // Also an exact touch is there.
    cases.accept(
        "touch-in-space",
        &passing(json!({ "rule": "touch", "time": "1/2", "s": "1/2", "t": "5/2" })),
    );
}

fn closed(cases: &mut Cases) {
    let planted = |track: &str| json!({ "tree": track, "tokens": SQUARE });
    let corner = json!({ "step": [[0, "-1", "-1"]] });
    let square_motion = |curve: Value, track: &str, moves: Value| {
        motion(curve, track, "1", Value::Null, json!([planted(track), moves]))
    };
    cases.accept("square", &square_motion(square(), "curve", corner.clone()));
    cases.accept("square-polygon", &square_motion(square(), "polygon", corner.clone()));
    cases.accept_bytes(
        "square-polygon-binary",
        square_motion(square(), "polygon", corner.clone()).binary(),
    );
    cases.reject(
        "square-has-four-points",
        &square_motion(square(), "curve", json!({ "step": [[0, "-1", "-1"], [4, "-1", "-1"]] })),
        reason(Reason::Motion(MotionError::Point { point: 4, count: 4 })),
    );
    // The first corner comes to the opposite one: the sides at the closing point do not keep their direction.
    let folded = json!({ "step": [[0, "2", "2"]] });
    cases.reject(
        "square-folded",
        &square_motion(square(), "curve", folded),
        |rejection| matches!(rejection.place, Place::EventLeaf { number: 1, .. }),
    );
    // A B-spline has its end twice, and must move both.
    let both = json!({ "step": [[0, "-1", "-1"], [4, "-1", "-1"]] });
    cases.accept("square-spline", &square_motion(square_spline(), "curve", both.clone()));
    cases.accept(
        "square-spline-polygon",
        &square_motion(square_spline(), "polygon", both.clone()),
    );
    let opens = || reason(Reason::Motion(MotionError::Opens));
    cases.reject(
        "square-spline-opens",
        &square_motion(square_spline(), "curve", corner.clone()),
        opens(),
    );
    cases.reject(
        "square-spline-polygon-opens",
        &square_motion(square_spline(), "polygon", corner.clone()),
        opens(),
    );
    cases.reject(
        "square-spline-opens-and-nothing-is-said",
        &still(square_spline(), "1", json!([corner])),
        opens(),
    );
    // An open curve whose ends meet is not a closed one.
    let ends = json!({ "step": [[3, "0", "-3"]] });
    let meets = json!([tree("curve"), { "end": "curve" }, ends]);
    let meets = motion(channel_curve(), "curve", "0", json!("1"), meets);
    cases.accept(
        "ends-meet",
        &meets.with(
            "/evidence/curve_contact",
            json!({ "rule": "touch", "time": "1", "s": "0", "t": "3" }),
        ),
    );
    let square_meets = motion(
        square(),
        "curve",
        "0",
        json!("1"),
        json!([planted("curve"), { "end": "curve" }, corner]),
    );
    cases.reject(
        "closing-point-meets-itself",
        &square_meets.with(
            "/evidence/curve_contact",
            json!({ "rule": "touch", "time": "1", "s": "0", "t": "4" }),
        ),
        expecting("touch", "two parameters of the curve"),
    );
    // The polygon of a curve that is not one: the chord of the parabola's hump, moved onto the curve's own polygon, meets nothing.
    let hump = bezier(json!([[[0, 0], [2, 4], [4, 0]], [[4, 0], [6, -4], [8, 0]]]));
    let forward = json!(["monotone 1 0"]);
    let flat = json!([{ "tree": "curve", "tokens": forward }, { "tree": "polygon", "tokens": forward }, { "step": [[1, "0", "-3"], [2, "1", "0"]] }]);
    let flat = motion(hump, "curve", "1", Value::Null, flat).with(
        "/statement/polygon",
        json!({ "embedded_through": "1", "meets_by": null }),
    );
    cases.accept("curve-and-polygon", &flat);
    // An edge of length zero is a meeting; no tree holds there.
    let folded = json!([{ "tree": "curve", "tokens": ["monotone 1 0"] }, { "tree": "polygon", "tokens": ["monotone 1 0"] }, { "step": [[1, "2", "-4"]] }]);
    cases.reject("an-edge-of-length-zero", &events(&flat, folded.clone()), |rejection| {
        matches!(
            rejection.place,
            Place::EventLeaf {
                number: 2,
                track: "polygon",
                ..
            }
        )
    });
    let only_curve = json!([{ "tree": "curve", "tokens": ["monotone 1 0"] }, { "step": [[1, "2", "-4"]] }]);
    cases.accept(
        "a-zero-vector-in-the-curve",
        &events(&flat.clone().with("/statement/polygon", Value::Null), only_curve),
    );
    let touching = json!([{ "tree": "curve", "tokens": ["monotone 1 0"] }, { "tree": "polygon", "tokens": ["monotone 1 0"] }, { "end": "polygon" }, { "step": [[1, "2", "-4"]] }]);
    let touching = events(&flat, touching).with(
        "/statement/polygon",
        json!({ "embedded_through": "0", "meets_by": "1" }),
    );
    cases.accept(
        "an-edge-of-length-zero-meets",
        &touching.with(
            "/evidence/polygon_contact",
            json!({ "rule": "touch", "time": "1", "s": "5/4", "t": "7/4" }),
        ),
    );
}

fn criteria(cases: &mut Cases) {
    cases.accept("criteria", &parabola());
    cases.accept_bytes("criteria-binary", parabola().binary());
    let with = |pointer: &str, value: Value| parabola().with(&format!("/statement/criteria{pointer}"), value);
    let second = "criteria.second_differences: the first failures";
    for (name, norm, value) in [
        ("second-infinity-early", "infinity", json!(1)),
        ("second-infinity-late", "infinity", json!(3)),
        ("second-infinity-never", "infinity", Value::Null),
        ("second-euclidean-early", "euclidean", json!(0)),
        ("second-euclidean-late", "euclidean", json!(2)),
    ] {
        cases.reject(
            name,
            &with(&format!("/second_differences/{norm}"), value),
            wanting(second),
        );
    }
    let half = "criteria.half_nu: the first failures";
    for (name, norm, value) in [
        ("half-nu-infinity-early", "infinity", json!(1)),
        ("half-nu-euclidean-late", "euclidean", json!(2)),
        ("half-nu-euclidean-never", "euclidean", Value::Null),
    ] {
        cases.reject(name, &with(&format!("/half_nu/{norm}"), value), wanting(half));
    }
    // At frame 1 the value in the norm of greatest coordinates is 11/5, at frame 0 it is 1 in both.
    let never = json!({ "infinity": null, "euclidean": null });
    let early = json!({ "infinity": 0, "euclidean": 0 });
    let tolerance = |tolerance: &str, failures: Value| {
        with("/display_tolerance", json!(tolerance)).with("/statement/criteria/second_differences", failures)
    };
    cases.accept(
        "tolerance-attained",
        &tolerance("11/5", json!({ "infinity": 1, "euclidean": 1 })),
    );
    cases.accept("tolerance-attained-at-once", &tolerance("1", early));
    cases.accept("tolerance-never-reached", &tolerance("100", never.clone()));
    cases.reject("tolerance-reached", &tolerance("11/5", never), wanting(second));
    cases.reject(
        "tolerance-zero",
        &with("/display_tolerance", json!("0")),
        wanting("criteria.display_tolerance: a fraction above 0"),
    );
    cases.accept("without-half-nu", &with("/half_nu", Value::Null));
    cases.reject(
        "nu-greater",
        &with("/half_nu/nu_squared", json!("17/5")),
        wanting("criteria.half_nu.nu_squared: the square of ν"),
    );
    cases.reject(
        "nu-less",
        &with("/half_nu/nu_squared", json!("3")),
        wanting("criteria.half_nu.nu_squared: the square of ν"),
    );
    let rational = json!({ "bezier": { "pieces": [{ "points": [["-1", "1"], ["0", "-1"], ["1", "1"]], "weights": ["1", "2", "1"] }] } });
    cases.reject(
        "criteria-of-a-rational-piece",
        &parabola().curve(rational.clone()).moved(),
        wanting("criteria only of polynomial pieces"),
    );
    cases.accept(
        "no-criteria-of-a-rational-piece",
        &parabola()
            .with("/statement/criteria", Value::Null)
            .curve(rational)
            .moved(),
    );
    let equal = json!({ "bezier": { "pieces": [{ "points": [["-1", "1"], ["0", "-1"], ["1", "1"]], "weights": ["2", "2", "2"] }] } });
    cases.accept("criteria-of-equal-weights", &parabola().curve(equal).moved());
    let spline = json!({ "bspline": { "degree": 2, "knots": ["0", "0", "0", "1", "1", "1"], "points": [["-1", "1"], ["0", "-1"], ["1", "1"]] } });
    cases.accept("criteria-of-a-spline", &parabola().curve(spline).moved());
    let segment = polygon(json!([[0, 0], [3, 4]]));
    let alone = still(segment, "5", json!([{ "step": [[1, "3", "-4"]] }]))
        .with("/statement/criteria", parabola().0["statement"]["criteria"].clone());
    cases.reject(
        "no-vertex-apart",
        &alone,
        wanting("ν of a polygon of at most 4,096 edges, some vertex apart from some edge"),
    );
}

fn malformed(cases: &mut Cases) {
    let closing = closing();
    let mut refuse = |name: &str, certificate: Certificate| cases.malformed(name, certificate.json(), |_| true);
    let with = |list: Value| closing.clone().with("/evidence/events", list);
    for (name, event) in [
        ("an-event-of-nothing", json!({})),
        ("two-events-in-one", json!({ "step": down(1), "begin": down(1) })),
        ("a-step-with-tokens", json!({ "step": down(1), "tokens": [] })),
        ("a-tree-without-tokens", json!({ "tree": "curve" })),
        (
            "a-tree-of-a-leaf",
            json!({ "tree": "curve", "leaf": 0, "tokens": CHANNEL }),
        ),
        (
            "an-edit-without-leaf",
            json!({ "edit": "curve", "tokens": ["separate 0 -1"] }),
        ),
        ("an-unknown-track", json!({ "end": "polyline" })),
        ("an-unknown-event", json!({ "stop": "curve" })),
        ("a-null-in-an-event", json!({ "step": down(1), "end": null })),
        ("a-displacement-of-zero", json!({ "step": [[3, "0", "0"]] })),
        ("a-point-twice", json!({ "step": [[3, "0", "1"], [3, "0", "1"]] })),
        ("points-out-of-order", json!({ "step": [[3, "0", "1"], [2, "0", "1"]] })),
        ("a-displacement-too-short", json!({ "step": [[3, "1"]] })),
        ("a-displacement-too-long", json!({ "step": [[3, "1", "0", "0"]] })),
        ("a-displacement-as-numbers", json!({ "step": [[3, 1, 0]] })),
        ("a-displacement-of-a-fraction", json!({ "step": [[3, "1/2", "0"]] })),
        ("a-point-as-a-text", json!({ "step": [["3", "1", "0"]] })),
        ("a-negative-point", json!({ "step": [[-1, "1", "0"]] })),
        ("a-time-not-reduced", json!({ "go": "2/4" })),
        ("a-time-not-dyadic", json!({ "go": "1/3" })),
        ("a-time-too-fine", json!({ "go": format!("1/{}", 1u64 << 61) })),
        ("a-time-as-a-number", json!({ "go": 1 })),
    ] {
        refuse(name, with(json!([tree("curve"), step(1), event, step(1)])));
    }
    refuse("events-missing", closing.clone().without_field("/evidence", "events"));
    refuse(
        "events-in-a-block",
        closing.clone().with("/evidence/events", json!("binary")),
    );
    refuse(
        "contact-field-missing",
        closing.clone().without_field("/evidence", "polygon_contact"),
    );
    refuse(
        "track-field-missing",
        closing.clone().without_field("/statement", "polygon"),
    );
    refuse(
        "meets-by-missing",
        closing.clone().without_field("/statement/curve", "meets_by"),
    );
    refuse(
        "grid-left-in",
        closing.clone().with_field("/evidence", "grid", json!(0)),
    );
    refuse("steps-as-a-text", closing.clone().with("/statement/steps", json!("2")));
    refuse("steps-negative", closing.clone().with("/statement/steps", json!(-2)));
    refuse(
        "denominator-a-fraction",
        closing.clone().with("/statement/denominator", json!("1/2")),
    );
    refuse(
        "half-nu-missing",
        parabola().without_field("/statement/criteria", "half_nu"),
    );
    refuse(
        "nu-negative",
        parabola().with("/statement/criteria/half_nu/nu_squared", json!("-1")),
    );
    refuse(
        "contact-of-another-rule",
        meeting(json!({ "rule": "root", "s": "0", "s_side": "after", "t": "1", "t_side": "after" })),
    );
    refuse(
        "contact-of-two-vectors",
        passing(passage()).without_field("/evidence/curve_contact", "third"),
    );
    let mut bytes = closing.binary();
    bytes.push(0x49);
    cases.reject_bytes("binary-unknown-event", bytes.clone(), |rejection| {
        matches!(&rejection.reason, Reason::Token(_))
    });
    bytes.pop();
    bytes.pop();
    cases.reject_bytes("binary-cut", bytes, |rejection| {
        matches!(&rejection.reason, Reason::Token(_))
    });
}
