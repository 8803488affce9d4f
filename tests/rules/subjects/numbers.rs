//! Numbers beyond every width of machine integer: a wrapped product would turn a verdict round.

use knotproof::number::Integer;
use serde_json::{Value, json};

use super::{CHANNEL, STEP, channel, channel_root};
use crate::common::case::{Case, Cases, obligation};
use crate::common::document::{Certificate, polygon};

fn power(bits: u32) -> Integer {
    Integer::from(2).pow(bits)
}

/// The channel, 2^bits times as large, moved by a vector.
fn scaled(bits: u32, shift: &Integer) -> Value {
    let vertices = [[0, 0], [4, 0], [4, 3], [0, 3]]
        .map(|vertex| vertex.map(|x| (Integer::from(x) * power(bits) + shift).to_string()));
    polygon(json!(vertices))
}

/// Cases of large numbers.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("numbers");
    let one = Integer::from(1);
    for bits in [
        14, 15, 29, 30, 31, 60, 61, 62, 63, 64, 124, 125, 126, 127, 128, 251, 253, 254, 255, 256, 1000,
    ] {
        let shift = power(bits + 2) * Integer::from(-1);
        let squared = Integer::from(9) * power(2 * bits);
        for (name, shift) in [("", Integer::from(0)), ("-moved", shift)] {
            let curve = scaled(bits, &shift);
            let exact = Certificate::new(curve)
                .lower(&squared.to_string(), &CHANNEL)
                .upper(&squared.to_string(), channel_root());
            cases.accept(&format!("times-2-to-the-{bits}{name}"), &exact);
            let above = (&squared + &one).to_string();
            let claim = exact
                .clone()
                .with("/statement/lower_squared", json!(above))
                .with("/statement/upper_squared", json!(above));
            cases.reject(
                &format!("times-2-to-the-{bits}{name}-lower-above"),
                &claim,
                obligation("far"),
            );
            let below = (&squared - &one).to_string();
            let claim = exact
                .with("/statement/lower_squared", json!(below))
                .with("/statement/upper_squared", json!(below));
            cases.reject(
                &format!("times-2-to-the-{bits}{name}-upper-below"),
                &claim,
                obligation("root"),
            );
        }
    }
    // Small numbers, and bounds of many digits.
    for bits in [62, 126, 254, 500] {
        let small = |x: i64| format!("{x}/{}", power(bits));
        let vertices = json!([["0", "0"], [small(5), "0"], [small(5), small(3)], ["0", small(3)]]);
        let squared = format!("9/{}", power(2 * bits));
        let exact = Certificate::new(polygon(vertices))
            .lower(&squared, &CHANNEL)
            .upper(&squared, channel_root());
        cases.accept(&format!("over-2-to-the-{bits}"), &exact);
        let above = format!("{}/{}", Integer::from(9) * power(600) + &one, power(2 * bits + 600));
        cases.reject(
            &format!("over-2-to-the-{bits}-lower-above"),
            &exact
                .with("/statement/lower_squared", json!(above))
                .with("/statement/upper_squared", json!("1")),
            obligation("far"),
        );
    }
    let bound = |sign: i64| {
        format!(
            "{}/{}",
            Integer::from(9) * power(20_000) + Integer::from(sign),
            power(20_000)
        )
    };
    cases.accept(
        "lower-bound-of-20000-bits-below",
        &channel().with("/statement/lower_squared", json!(bound(-1))),
    );
    cases.reject(
        "lower-bound-of-20000-bits-above",
        &channel().with("/statement/lower_squared", json!(bound(1))),
        obligation("far"),
    );
    // A tangent of 64 bits beside one of a few: products of αv + βw.
    for bits in [30, 31, 32, 61, 62, 63, 64, 127, 128, 255, 256] {
        let far_right = power(bits).to_string();
        let climb = polygon(json!([[0, 0], [2, 0], [3, 1], [far_right, "1"]]));
        let step = Certificate::new(climb).lower("inf", &STEP);
        cases.accept(&format!("long-step-{bits}"), &step);
        cases.reject(
            &format!("long-step-{bits}-opposed"),
            &step.clone().token(4, "not_normal -1 1"),
            obligation("not_normal"),
        );
        cases.accept(
            &format!("long-step-{bits}-outweighed"),
            &step.token(4, &format!("not_normal -{far_right} 1")),
        );
    }
    cases.list()
}
