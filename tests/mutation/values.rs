//! Other values for each value of a document.

use std::collections::BTreeSet;

use knotproof::number::{Integer, Rational, RationalExt};
use serde_json::{Value, json};

/// Other spellings and values of a string.
pub fn other_strings(text: &str) -> BTreeSet<String> {
    let mut others: BTreeSet<String> = ["", "0", "1", "-1", "inf", "null"].map(String::from).into();
    others.extend([
        format!("{text} "),
        format!("+{text}"),
        format!("0{text}"),
        format!("-{text}"),
        text.to_uppercase(),
    ]);
    others.extend(text.strip_prefix('-').map(String::from));
    if let Ok(number) = Rational::parse_canonical(text) {
        let one = Rational::from_integer(1.into());
        let tiny = Rational::new(1.into(), Integer::from(10).pow(40));
        for other in [
            &number + &one,
            &number - &one,
            -&number,
            &number * (&one + &tiny),
            &number * (&one - &tiny),
            &number / (&one + &one),
            &number + &number,
        ] {
            others.insert(other.format());
        }
        others.insert(format!(
            "{}/{}",
            number.numer() + number.numer(),
            number.denom() + number.denom()
        ));
        others.insert(Rational::new_raw(number.denom().clone(), number.numer().clone()).to_string());
    } else {
        others.extend(
            [
                "split", "first", "second", "smooth", "critical", "before", "after", "root", "touch", "miranda",
            ]
            .map(String::from),
        );
    }
    let words: Vec<&str> = text.split(' ').collect();
    for i in 1..words.len() {
        let mut replace = |word: Option<String>| {
            let mut words: Vec<String> = words.iter().map(|word| word.to_string()).collect();
            match word {
                Some(word) => words[i] = word,
                None => drop(words.remove(i)),
            }
            others.insert(words.join(" "));
        };
        replace(None);
        replace(Some("0".into()));
        if let Ok(n) = words[i].parse::<i64>() {
            for n in [n + 1, n - 1, -n, 2 * n] {
                replace(Some(n.to_string()));
            }
        }
    }
    if words.len() > 2 {
        let mut exchanged = words.clone();
        exchanged.swap(1, 2);
        others.insert(exchanged.join(" "));
        let all_zero = words
            .iter()
            .enumerate()
            .map(|(i, word)| if i == 0 { word } else { "0" });
        others.insert(all_zero.collect::<Vec<_>>().join(" "));
        for rule in ["far", "cone", "not_normal", "bend"] {
            others.insert(
                std::iter::once(rule)
                    .chain(words[1..].iter().copied())
                    .collect::<Vec<_>>()
                    .join(" "),
            );
        }
    }
    others.remove(text);
    others
}

/// All values that stand for one value of the document, in turn.
pub fn other_values(value: &Value) -> Vec<Value> {
    let mut others = vec![Value::Null, json!([]), json!({}), json!(true), json!(0), json!("0")];
    match value {
        Value::String(text) => others.extend(other_strings(text).into_iter().map(Value::String)),
        Value::Number(number) => {
            let n = number.as_i64().expect("small integers");
            others.extend([n + 1, n - 1, -n - 1, 2 * n, 1 << 40].map(|n| json!(n)));
            others.extend([json!(n as f64), json!(n.to_string())]);
        }
        Value::Array(items) => {
            for i in 0..items.len() {
                let mut dropped = items.clone();
                let item = dropped.remove(i);
                others.push(dropped.into());
                let mut doubled = items.clone();
                doubled.insert(i, item);
                others.push(doubled.into());
                if i > 0 {
                    let mut exchanged = items.clone();
                    exchanged.swap(i - 1, i);
                    others.push(exchanged.into());
                }
            }
            others.push(items.iter().rev().cloned().collect());
        }
        Value::Object(fields) => {
            for key in fields.keys() {
                let mut dropped = fields.clone();
                let field = dropped.remove(key).expect("there");
                others.push(dropped.clone().into());
                dropped.insert(format!("{key}_"), field);
                others.push(dropped.into());
                let mut added = fields.clone();
                added.insert(format!("{key}_"), json!("0"));
                others.push(added.into());
            }
        }
        Value::Bool(_) | Value::Null => {}
    }
    others.retain(|other| other != value);
    others
}

/// JSON pointers to all values of a document, itself included.
pub fn pointers(value: &Value, at: &str, list: &mut Vec<String>) {
    list.push(at.to_string());
    match value {
        Value::Array(items) => items
            .iter()
            .enumerate()
            .for_each(|(i, item)| pointers(item, &format!("{at}/{i}"), list)),
        Value::Object(fields) => fields
            .iter()
            .for_each(|(key, field)| pointers(field, &format!("{at}/{key}"), list)),
        _ => {}
    }
}
