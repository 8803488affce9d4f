//! Writers of cases and results.

use serde::{Serialize, Serializer};

use super::{
    Answer, CASES_VERSION, Case, CaseSide, CasesFile, FloatCurve, Operation, RESULTS_VERSION, ResultEntry, ResultsFile,
    Returned,
};

/// A finite binary64 as the shortest decimal that reads back as it; others by their names.
#[derive(Clone, Copy)]
struct Number(f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            // Whole numbers without a fraction: shorter, and what people write.
            x if x.fract() == 0.0 && x.abs() < 1e15 && !(x == 0.0 && x.is_sign_negative()) => {
                serializer.serialize_i64(x as i64)
            }
            x if x.is_finite() => serializer.serialize_f64(x),
            x if x.is_nan() => serializer.serialize_str("NaN"),
            x if x > 0.0 => serializer.serialize_str("Infinity"),
            _ => serializer.serialize_str("-Infinity"),
        }
    }
}

fn numbers(values: &[f64]) -> Vec<Number> {
    values.iter().map(|value| Number(*value)).collect()
}

#[derive(Serialize)]
struct CurveOut {
    degree: usize,
    knots: Vec<Number>,
    points: Vec<Vec<Number>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    weights: Option<Vec<Number>>,
}

impl From<&FloatCurve> for CurveOut {
    fn from(curve: &FloatCurve) -> CurveOut {
        CurveOut {
            degree: curve.degree,
            knots: numbers(&curve.knots),
            points: curve.points.iter().map(|point| numbers(point)).collect(),
            weights: curve.weights.as_deref().map(numbers),
        }
    }
}

#[derive(Serialize, Default)]
struct CaseOut<'a> {
    id: &'a str,
    operation: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    parameter: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    order: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<CaseSide>,
    #[serde(skip_serializing_if = "Option::is_none")]
    times: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<Vec<Number>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    point: Option<usize>,
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    half_width: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    level: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sign: Option<&'static str>,
    curve: Option<CurveOut>,
    #[serde(skip_serializing_if = "Option::is_none")]
    other: Option<CurveOut>,
}

fn case(case: &Case) -> CaseOut<'_> {
    let mut out = CaseOut {
        id: &case.id,
        operation: case.operation.name(),
        parameter: case.operation.parameter().map(Number),
        curve: Some((&case.curve).into()),
        ..CaseOut::default()
    };
    match &case.operation {
        Operation::Derivative { order, side, .. } => {
            out.order = Some(*order);
            out.side = Some(*side);
        }
        Operation::Curvature { side, .. } | Operation::Torsion { side, .. } => out.side = Some(*side),
        Operation::InsertKnot { times, .. }
        | Operation::RemoveKnot { times, .. }
        | Operation::ElevateDegree { times } => out.times = Some(*times),
        Operation::NearestPoint { target } => out.target = Some(numbers(target)),
        Operation::CurveDistance { other } => out.other = Some(other.as_ref().into()),
        Operation::ConvexDomain {
            point,
            half_width,
            level,
            positive,
        } => {
            out.point = Some(*point);
            out.half_width = Some(Number(*half_width));
            out.level = Some(*level);
            out.sign = Some(if *positive { "+" } else { "-" });
        }
        Operation::Point { .. } | Operation::Split { .. } | Operation::Decompose | Operation::Msd => {}
    }
    out
}

#[derive(Serialize, Default)]
struct ResultOut<'a> {
    id: &'a str,
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    message: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    point: Option<Vec<Number>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    vector: Option<Vec<Number>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    curve: Option<CurveOut>,
    #[serde(skip_serializing_if = "Option::is_none")]
    curves: Option<Vec<CurveOut>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    distance: Option<Option<Number>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    parameters: Vec<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    vertices: Option<Vec<Vec<Number>>>,
}

fn result(entry: &ResultEntry) -> ResultOut<'_> {
    let mut out = ResultOut {
        id: &entry.id,
        status: "ok",
        ..ResultOut::default()
    };
    match &entry.answer {
        Answer::Refused(message) => {
            out.status = "refused";
            out.message = Some(message);
        }
        Answer::NotOffered => out.status = "not_offered",
        Answer::Ok(returned) => match returned {
            Returned::Point(point) => out.point = Some(numbers(point)),
            Returned::Vector(vector) => out.vector = Some(numbers(vector)),
            Returned::Value(value) => out.value = Some(Number(*value)),
            Returned::Curve(curve) => out.curve = Some(curve.into()),
            Returned::Curves(curves) => out.curves = Some(curves.iter().map(CurveOut::from).collect()),
            Returned::Distance { distance, parameters } => {
                out.distance = Some(distance.map(Number));
                out.parameters = numbers(parameters);
            }
            Returned::Vertices(vertices) => {
                out.vertices = Some(vertices.iter().map(|vertex| numbers(vertex)).collect());
            }
        },
    }
    out
}

/// The text of a file of cases: one case a line, numbers as the shortest decimals that read back as they are.
pub fn write_cases(file: &CasesFile) -> String {
    let seed = file.seed.map_or(String::new(), |seed| format!("\"seed\":{seed},"));
    let head = format!("{{\"knotproof\":\"{CASES_VERSION}\",{seed}\"cases\":[");
    lines(head, file.cases.iter().map(|c| text(&case(c))))
}

/// The text of a file of results, one a line, in the same manner.
pub fn write_results(file: &ResultsFile) -> String {
    let engine = text(&file.engine);
    let head = format!("{{\"knotproof\":\"{RESULTS_VERSION}\",\"engine\":{engine},\"results\":[");
    lines(head, file.results.iter().map(|r| text(&result(r))))
}

fn text(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("strings, numbers and lists can be written")
}

fn lines(head: String, entries: impl Iterator<Item = String>) -> String {
    let mut out = head;
    for (i, entry) in entries.enumerate() {
        out.push_str(if i == 0 { "\n" } else { ",\n" });
        out.push_str(&entry);
    }
    out.push_str("\n]}\n");
    out
}
