//! What the adapters share: reads cases.json, lets an engine answer them in a thread, writes results.json.
//!
//! A panic or an endless loop of the engine costs one case: it counts as refused.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

const SECONDS: u64 = 5;

#[derive(Clone, Deserialize, Serialize)]
pub struct Curve {
    pub degree: usize,
    pub knots: Vec<Value>,
    pub points: Vec<Vec<Value>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weights: Option<Vec<Value>>,
}

#[derive(Clone, Deserialize)]
pub struct Case {
    pub id: String,
    pub operation: String,
    pub curve: Curve,
    #[serde(default)]
    pub parameter: f64,
    #[serde(default)]
    pub order: usize,
    #[serde(default)]
    pub times: usize,
    #[serde(default)]
    pub target: Vec<f64>,
    pub other: Option<Curve>,
}

pub enum Trouble {
    NotOffered,
    Refused(String),
}

pub type Answer = Result<Value, Trouble>;

pub fn refused(why: impl std::fmt::Display) -> Trouble {
    Trouble::Refused(why.to_string())
}

/// Numbers as JSON has them; others by their names.
pub fn number(x: f64) -> Value {
    match x {
        x if x.is_finite() => json!(x),
        x if x.is_nan() => json!("NaN"),
        x if x > 0.0 => json!("Infinity"),
        _ => json!("-Infinity"),
    }
}

pub fn numbers(list: impl IntoIterator<Item = f64>) -> Vec<Value> {
    list.into_iter().map(number).collect()
}

fn floats(list: &[Value]) -> Vec<f64> {
    list.iter().filter_map(Value::as_f64).collect()
}

impl Curve {
    pub fn knots(&self) -> Vec<f64> {
        floats(&self.knots)
    }

    pub fn points(&self) -> Vec<Vec<f64>> {
        self.points.iter().map(|point| floats(point)).collect()
    }

    /// Homogeneous control points: coordinates times weight, weight.
    pub fn homogeneous(&self) -> Vec<Vec<f64>> {
        let weights = self
            .weights
            .as_ref()
            .map_or_else(|| vec![1.0; self.points.len()], |w| floats(w));
        let lift = |(point, w): (Vec<f64>, f64)| point.into_iter().map(|x| x * w).chain([w]).collect();
        self.points().into_iter().zip(weights).map(lift).collect()
    }

    pub fn from_homogeneous(degree: usize, knots: Vec<f64>, control: Vec<Vec<f64>>) -> Curve {
        let dimension = control[0].len() - 1;
        let weights: Vec<f64> = control.iter().map(|p| p[dimension]).collect();
        Curve {
            degree,
            knots: numbers(knots),
            points: control
                .iter()
                .map(|p| numbers(p[..dimension].iter().map(|x| x / p[dimension])))
                .collect(),
            weights: weights.iter().any(|w| *w != 1.0).then(|| numbers(weights)),
        }
    }

    pub fn is_bezier(&self) -> bool {
        let order = self.degree + 1;
        let expected = |i: usize| if i < order { 0.0 } else { 1.0 };
        self.points.len() == order && self.knots().iter().enumerate().all(|(i, t)| *t == expected(i))
    }

    pub fn dimension(&self) -> usize {
        self.points[0].len()
    }
}

pub fn run(name: &str, engine: fn(&Case) -> Answer) {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, from, to] = arguments.as_slice() else {
        panic!("two arguments: CASES RESULTS");
    };
    let text = std::fs::read_to_string(from).expect("a file of cases");
    let mut file: Value = serde_json::from_str(&text).expect("cases in JSON");
    let cases: Vec<Case> = serde_json::from_value(file["cases"].take()).expect("cases");
    let cases = Arc::new(cases);
    std::panic::set_hook(Box::new(|_| ()));
    let mut results: Vec<Value> = Vec::new();
    while results.len() < cases.len() {
        let (sender, receiver) = channel();
        let (work, start) = (cases.clone(), results.len());
        std::thread::spawn(move || {
            for case in &work[start..] {
                if sender.send(answer(case, engine)).is_err() {
                    return;
                }
            }
        });
        loop {
            match receiver.recv_timeout(Duration::from_secs(SECONDS)) {
                Ok(result) => results.push(result),
                Err(RecvTimeoutError::Disconnected) => break,
                Err(RecvTimeoutError::Timeout) => {
                    let why = format!("no answer within {SECONDS} s");
                    results.push(json!({ "id": cases[results.len()].id, "status": "refused", "message": why }));
                    break;
                }
            }
        }
    }
    let file = json!({ "knotproof": "results/1", "engine": name, "results": results });
    std::fs::write(to, file.to_string()).expect("a file to write");
    // Threads that do not come back end here.
    std::process::exit(0);
}

fn answer(case: &Case, engine: fn(&Case) -> Answer) -> Value {
    let found = catch_unwind(AssertUnwindSafe(|| engine(case))).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| text.to_string()));
        Err(Trouble::Refused(format!("panic: {}", text.unwrap_or_default())))
    });
    let id = &case.id;
    match found {
        Ok(mut result) => {
            result["id"] = json!(id);
            result["status"] = json!("ok");
            result
        }
        Err(Trouble::NotOffered) => json!({ "id": id, "status": "not_offered" }),
        Err(Trouble::Refused(why)) => {
            let why: String = why.chars().take(200).collect();
            json!({ "id": id, "status": "refused", "message": why })
        }
    }
}
