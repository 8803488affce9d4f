//! A comparison as a chart.

use knotproof::compare::{Comparison, Row, Standing, Value};
use knotproof::number::{Rational, RationalExt};
use knotproof::show::{Bar, BarPanel, Chart, LevelPanel, Series, Standing as Colour};

/// The rows of σ from the paper's to the certified one.
const SIGMA: [(&str, &str); 10] = [
    ("cpj12.lambda_disjoint", "λ_c, all disjoint edges"),
    ("cpj12.lambda_candidates", "λ_c, tested pairs"),
    ("cpj12.lambda_candidates_polygon", "λ_c, polygon's chords"),
    ("cpj12.sigma", "λ_c ± E"),
    ("polygon.sigma", "λ ± 2η"),
    ("mp06.newton", "Newton's method"),
    ("float.sigma", "branch and bound"),
    ("codac.sigma", "interval Newton"),
    ("flint.sigma", "resultants, balls"),
    ("certified.sigma", "cover tree"),
];
/// How far points may move, and how thick a pipe may be.
const ROOM: [(&str, &str); 5] = [
    ("polygon.half_nu", "½ν, control polygon"),
    ("polygon.half_nu_subdivided", "½ν, subdivided"),
    ("certified.radius_infinity", "perturbation radius, ∞"),
    ("certified.radius_euclidean", "perturbation radius, Euclidean"),
    ("certified.thickness", "thickness or reach"),
];
/// Digits of numbers beside bars.
const DIGITS: usize = 7;
/// Beyond this quotient of the greatest and the least number the axis has powers of ten.
const SPREAD: f64 = 100.0;

/// The chart of all that was compared.
pub fn chart(title: String, comparison: &Comparison, tolerance: Option<&Rational>) -> Chart {
    let rows = &comparison.rows;
    let mut bars = Vec::new();
    let sigma = bars_of(rows, &SIGMA);
    let certified = rows.iter().find(|row| row.key == "certified.sigma").and_then(range);
    let certified = certified.filter(|[_, high]| high.is_finite());
    if sigma.len() > 1 {
        bars.push(BarPanel {
            title: "Minimum separation distance σ".into(),
            bars: sigma.clone(),
            mark: certified.map(|[_, high]| high),
            logarithmic: false,
        });
    }
    if let Some(certified) = certified
        && certified[0] > 0.0
        && sigma.len() > 1
    {
        let far = sigma.iter().filter(|bar| bar.range[1].is_finite());
        let far: Vec<Bar> = far.map(|bar| distance(bar, certified)).collect();
        bars.push(BarPanel {
            title: "The same: how far from the certified σ it can be, relative to σ".into(),
            bars: far,
            mark: None,
            logarithmic: true,
        });
    }
    let room = bars_of(rows, &ROOM);
    if room.len() > 1 {
        let ends = || room.iter().flat_map(|bar| bar.range).filter(|x| x.is_finite());
        let (least, greatest) = (ends().fold(f64::INFINITY, f64::min), ends().fold(0.0, f64::max));
        bars.push(BarPanel {
            title: "Room: how far control points may move, how thick a pipe may be".into(),
            bars: room,
            mark: None,
            logarithmic: least > 0.0 && greatest > SPREAD * least,
        });
    }
    Chart {
        title,
        caption: vec![
            "Thick or filled: proved, by the checker or by a theorem. Thin or hollow: a paper's number, or a rounded one. An arrow: no upper bound, or infinite.".into(),
        ],
        bars,
        levels: levels(comparison, tolerance).into_iter().collect(),
    }
}

fn bars_of(rows: &[Row], names: &[(&str, &str)]) -> Vec<Bar> {
    let found = names.iter().filter_map(|(key, name)| {
        let row = rows.iter().find(|row| row.key == *key)?;
        Some(Bar {
            label: format!("{}: {name}", row.method),
            value: words(&row.value),
            range: range(row)?,
            standing: colour(row.standing),
        })
    });
    found.collect()
}

/// A number in few digits, rounded outward.
fn words(value: &Value) -> String {
    match value.decimals_with(DIGITS) {
        (None, _) => String::new(),
        (Some(lower), _) if lower == "inf" => "infinite".into(),
        (Some(lower), Some(upper)) if lower == upper => lower,
        (Some(lower), Some(upper)) => format!("{lower} … {upper}"),
        (Some(lower), None) => format!("at least {lower}"),
    }
}

/// The ends of a row's number, the second +∞ when it is not known.
fn range(row: &Row) -> Option<[f64; 2]> {
    let end = |x: &Option<Rational>| x.as_ref().map_or(f64::INFINITY, RationalExt::to_f64);
    match &row.value {
        Value::Count(count) => Some([*count as f64; 2]),
        Value::Number(x) => Some([x.to_f64(); 2]),
        Value::Between(low, high) => Some([low.to_f64(), end(high)]),
        Value::RootBetween(low, high) => Some([low.to_f64().sqrt(), end(high).sqrt()]),
        Value::Infinite => Some([f64::INFINITY; 2]),
        Value::None => None,
    }
}

fn colour(standing: Standing) -> Colour {
    match standing {
        Standing::Certified => Colour::Certified,
        Standing::Proved | Standing::Exact => Colour::Proved,
        Standing::Interval => Colour::Interval,
        Standing::Printed => Colour::Printed,
        Standing::Binary64 | Standing::Measured | Standing::Undecided => Colour::Binary64,
    }
}

/// The greatest distance of a point of the bar from one of the certified interval, over the latter's lower end; what binary64 cannot tell from 0 is the unit of it.
fn distance(bar: &Bar, [low, high]: [f64; 2]) -> Bar {
    let far = (bar.range[1] - low).max(high - bar.range[0]) / low;
    let far = far.max(f64::EPSILON);
    let what = match bar.standing {
        Colour::Certified => "its width",
        _ => "at most",
    };
    let value = match far < 0.01 {
        true => format!("{what} {far:.1e}"),
        false => format!("{what} {far:.2}"),
    };
    Bar {
        value,
        range: [far, far],
        ..bar.clone()
    }
}

fn levels(comparison: &Comparison, tolerance: Option<&Rational>) -> Option<LevelPanel> {
    let found = comparison.domain.as_ref()?;
    let last = found.levels.last()?.level;
    let series = |label: &str, standing, of: &dyn Fn(usize) -> Option<[Rational; 2]>| Series {
        label: label.into(),
        standing,
        points: (0..found.levels.len())
            .filter_map(|i| Some((found.levels[i].level, of(i)?.map(|x| x.to_f64()))))
            .collect(),
    };
    let levels = &found.levels;
    let empty = levels
        .iter()
        .filter(|level| level.error.is_none() && level.own.is_none());
    let empty: Vec<u32> = empty.map(|level| level.level).collect();
    let measure = if found.problem.position.len() == 2 {
        "area"
    } else {
        "volume"
    };
    Some(LevelPanel {
        title: format!("Convex domain: relative error of the {measure} at the levels of GKK09"),
        last,
        series: vec![
            series("GKK09's (20): against the level before", Colour::Printed, &|i| {
                levels[i].successive.clone()
            }),
            series("the level's own bound", Colour::Proved, &|i| levels[i].own.clone()),
            series("true error, by the certified domain", Colour::Certified, &|i| {
                levels[i].error.clone()
            }),
        ],
        line: tolerance.map(|tolerance| ("tolerance".into(), tolerance.to_f64())),
        none: (!empty.is_empty()).then(|| (empty, "empty".into())),
    })
}
