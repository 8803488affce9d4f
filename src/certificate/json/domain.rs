//! Statement and evidence of the claim `domain` as texts (FORMAT §9).

use serde::Deserialize;

use super::super::FormatError;
use super::numbers::{Parsed, integer, parameter, rational, shortened};
use super::raw::{Object, Text};
use super::read::parse_within;
use super::write::string;
use crate::claim::domain::{Box, Content, Domain, Evidence, Outcome, Row, Sign, Star, Statement, Target};
use crate::number::{Integer, Rational, RationalExt};

/// The most points, cells and rows of a certificate together.
const MOST_PARTS: usize = 1 << 22;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStatement<'a> {
    #[serde(borrow, rename = "claim")]
    _claim: Text<'a>,
    points: Vec<u32>,
    #[serde(borrow)]
    sign: Text<'a>,
    #[serde(borrow)]
    interval: [Text<'a>; 2],
    open: [bool; 2],
    #[serde(borrow, rename = "box")]
    bounds: [Vec<Text<'a>>; 2],
    #[serde(borrow)]
    outcome: Object<RawOutcome<'a>>,
}

#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
enum RawOutcome<'a> {
    Sandwich {
        #[serde(borrow)]
        inner_measure: Text<'a>,
        #[serde(borrow)]
        outer_measure: Text<'a>,
    },
    Empty {},
    Nearest {
        #[serde(borrow)]
        to: RawTarget<'a>,
        #[serde(borrow)]
        lower_squared: Text<'a>,
        #[serde(borrow)]
        upper_squared: Text<'a>,
    },
    Change {
        #[serde(borrow)]
        from: Vec<Text<'a>>,
        #[serde(borrow)]
        lower_squared: Text<'a>,
        #[serde(borrow)]
        upper_squared: Text<'a>,
    },
    Ball {
        #[serde(borrow)]
        lower: Text<'a>,
        #[serde(borrow)]
        upper: Text<'a>,
    },
}

#[derive(Deserialize)]
#[serde(untagged)]
enum RawTarget<'a> {
    Name(#[serde(borrow)] Text<'a>),
    Point(#[serde(borrow)] Vec<Text<'a>>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStar<'a> {
    #[serde(borrow)]
    points: Vec<Vec<Text<'a>>>,
    cells: Vec<Vec<u32>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawParameter<'a> {
    piece: u32,
    #[serde(borrow)]
    u: Text<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSide<'a> {
    axis: u32,
    #[serde(borrow)]
    side: Text<'a>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum RawRow<'a> {
    Parameter(#[serde(borrow)] Object<RawParameter<'a>>),
    Side(#[serde(borrow)] Object<RawSide<'a>>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSandwich<'a> {
    #[serde(borrow)]
    denominator: Text<'a>,
    #[serde(borrow)]
    center: Vec<Text<'a>>,
    #[serde(borrow)]
    inner: Object<RawStar<'a>>,
    #[serde(borrow)]
    outer: Object<RawStar<'a>>,
    #[serde(borrow)]
    rows: Vec<RawRow<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawEmpty<'a> {
    #[serde(borrow)]
    rows: Vec<RawRow<'a>>,
    #[serde(borrow)]
    multipliers: Vec<Text<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawNearest<'a> {
    #[serde(borrow)]
    center: Vec<Text<'a>>,
    #[serde(borrow)]
    point: Vec<Text<'a>>,
    #[serde(borrow)]
    base: Vec<Text<'a>>,
    #[serde(borrow)]
    rows: Vec<RawRow<'a>>,
    #[serde(borrow)]
    multipliers: Vec<Text<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawChange<'a> {
    #[serde(borrow)]
    row: RawRow<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawBall<'a> {
    #[serde(borrow)]
    center: Vec<Text<'a>>,
    #[serde(borrow)]
    rows: Vec<RawRow<'a>>,
    #[serde(borrow)]
    multipliers: Vec<Text<'a>>,
    #[serde(borrow)]
    lengths: Vec<Text<'a>>,
}

/// Reads both.
pub fn read(statement_text: &str, evidence_text: &str, dimension: usize) -> Parsed<Content> {
    let Object(raw): Object<RawStatement> = parse_within(statement_text, "statement")?;
    let Object(raw_outcome) = &raw.outcome;
    let domain = Domain {
        points: raw.points.iter().map(|index| *index as usize).collect(),
        sign: Sign::from_name(&raw.sign.0).ok_or_else(|| unexpected("statement.sign", &raw.sign, "\"+\" or \"-\""))?,
        interval: [
            parameter(&raw.interval[0], "statement.interval[0]")?,
            parameter(&raw.interval[1], "statement.interval[1]")?,
        ],
        open: raw.open,
        bounds: Box {
            low: position(&raw.bounds[0], dimension, "statement.box[0]")?,
            high: position(&raw.bounds[1], dimension, "statement.box[1]")?,
        },
    };
    let outcome = outcome(raw_outcome, dimension)?;
    let evidence = evidence(evidence_text, raw_outcome, dimension)?;
    Ok(Content {
        statement: Statement { domain, outcome },
        evidence,
    })
}

fn unexpected(place: &str, found: &Text, expected: &str) -> FormatError {
    FormatError::malformed(place, format!("found {:?}, expected {expected}", shortened(&found.0)))
}

fn outcome(raw: &RawOutcome, dimension: usize) -> Parsed<Outcome> {
    let number = |text: &Text, name: &str| rational(text, &format!("statement.outcome.{name}"));
    Ok(match raw {
        RawOutcome::Sandwich {
            inner_measure,
            outer_measure,
        } => Outcome::Sandwich {
            inner_measure: number(inner_measure, "inner_measure")?,
            outer_measure: number(outer_measure, "outer_measure")?,
        },
        RawOutcome::Empty {} => Outcome::Empty,
        RawOutcome::Nearest {
            to,
            lower_squared,
            upper_squared,
        } => Outcome::Nearest {
            to: match to {
                RawTarget::Name(name) if name.0 == "fair" => Target::Fair,
                RawTarget::Name(name) => {
                    return Err(unexpected("statement.outcome.to", name, "coordinates or \"fair\""));
                }
                RawTarget::Point(point) => Target::Point(position(point, dimension, "statement.outcome.to")?),
            },
            lower_squared: number(lower_squared, "lower_squared")?,
            upper_squared: number(upper_squared, "upper_squared")?,
        },
        RawOutcome::Change {
            from,
            lower_squared,
            upper_squared,
        } => Outcome::Change {
            from: position(from, dimension, "statement.outcome.from")?,
            lower_squared: number(lower_squared, "lower_squared")?,
            upper_squared: number(upper_squared, "upper_squared")?,
        },
        RawOutcome::Ball { lower, upper } => Outcome::Ball {
            lower: number(lower, "lower")?,
            upper: number(upper, "upper")?,
        },
    })
}

fn evidence(text: &str, outcome: &RawOutcome, dimension: usize) -> Parsed<Evidence> {
    let list = |texts: &[Text], name: &str| -> Parsed<Vec<Rational>> {
        few(texts.len())?;
        texts.iter().map(|text| rational(text, name)).collect()
    };
    let place = |texts: &[Text], name: &str| position(texts, dimension, &format!("evidence.{name}"));
    Ok(match outcome {
        RawOutcome::Sandwich { .. } => {
            let Object(raw): Object<RawSandwich> = parse_within(text, "evidence")?;
            let (Object(inner), Object(outer)) = (&raw.inner, &raw.outer);
            few(inner.points.len() + inner.cells.len() + outer.points.len() + outer.cells.len() + raw.rows.len())?;
            let (inner, _) = star(inner, dimension, 0, "evidence.inner")?;
            let (outer, cell_rows) = star(outer, dimension, 1, "evidence.outer")?;
            Evidence::Sandwich {
                denominator: integer(&raw.denominator, "evidence.denominator")?,
                center: integers(&raw.center, dimension, "evidence.center")?,
                inner,
                outer,
                rows: rows(&raw.rows)?,
                cell_rows,
            }
        }
        RawOutcome::Empty {} => {
            let Object(raw): Object<RawEmpty> = parse_within(text, "evidence")?;
            few(raw.rows.len() + raw.multipliers.len())?;
            let multiplier = |text| integer(text, "evidence.multipliers");
            Evidence::Empty {
                rows: rows(&raw.rows)?,
                multipliers: raw.multipliers.iter().map(multiplier).collect::<Parsed<_>>()?,
            }
        }
        RawOutcome::Nearest { .. } => {
            let Object(raw): Object<RawNearest> = parse_within(text, "evidence")?;
            Evidence::Nearest {
                center: place(&raw.center, "center")?,
                point: place(&raw.point, "point")?,
                base: place(&raw.base, "base")?,
                rows: rows(&raw.rows)?,
                multipliers: list(&raw.multipliers, "evidence.multipliers")?,
            }
        }
        RawOutcome::Change { .. } => {
            let Object(raw): Object<RawChange> = parse_within(text, "evidence")?;
            Evidence::Change {
                row: row(&raw.row, "evidence.row")?,
            }
        }
        RawOutcome::Ball { .. } => {
            let Object(raw): Object<RawBall> = parse_within(text, "evidence")?;
            Evidence::Ball {
                center: place(&raw.center, "center")?,
                rows: rows(&raw.rows)?,
                multipliers: list(&raw.multipliers, "evidence.multipliers")?,
                lengths: list(&raw.lengths, "evidence.lengths")?,
            }
        }
    })
}

fn few(parts: usize) -> Parsed<()> {
    if parts > MOST_PARTS {
        let what = format!("{parts} points, cells and rows, at most {MOST_PARTS} expected");
        return Err(FormatError::malformed("evidence", what));
    }
    Ok(())
}

fn as_many(found: usize, expected: usize, place: &str) -> Parsed<()> {
    if found == expected {
        return Ok(());
    }
    let what = format!("found {found} entries, expected {expected}");
    Err(FormatError::malformed(place, what))
}

fn position(texts: &[Text], dimension: usize, place: &str) -> Parsed<Vec<Rational>> {
    as_many(texts.len(), dimension, place)?;
    texts.iter().map(|text| rational(text, place)).collect()
}

fn integers(texts: &[Text], dimension: usize, place: &str) -> Parsed<Vec<Integer>> {
    as_many(texts.len(), dimension, place)?;
    texts.iter().map(|text| integer(text, place)).collect()
}

/// A star, and of each cell the entry behind its points, if there is to be one.
fn star(raw: &RawStar, dimension: usize, more: usize, place: &str) -> Parsed<(Star, Vec<usize>)> {
    let at = |name: &str, i: usize| format!("{place}.{name}[{i}]");
    let points = raw.points.iter().enumerate();
    let points = points.map(|(i, point)| integers(point, dimension, &at("points", i)));
    let points: Vec<_> = points.collect::<Parsed<_>>()?;
    let mut cells = Vec::with_capacity(raw.cells.len());
    let mut last = Vec::new();
    for (i, cell) in raw.cells.iter().enumerate() {
        as_many(cell.len(), dimension + more, &at("cells", i))?;
        let numbers: Vec<usize> = cell.iter().map(|number| *number as usize).collect();
        cells.push(numbers[..dimension].to_vec());
        last.extend_from_slice(&numbers[dimension..]);
    }
    Ok((Star { points, cells }, last))
}

fn rows(raw: &[RawRow]) -> Parsed<Vec<Row>> {
    few(raw.len())?;
    let rows = raw.iter().enumerate();
    rows.map(|(i, raw)| row(raw, &format!("evidence.rows[{i}]"))).collect()
}

fn row(raw: &RawRow, place: &str) -> Parsed<Row> {
    Ok(match raw {
        RawRow::Parameter(Object(raw)) => Row::Parameter {
            piece: raw.piece as usize,
            u: parameter(&raw.u, &format!("{place}.u"))?,
        },
        RawRow::Side(Object(raw)) => Row::Side {
            axis: raw.axis as usize,
            high: match raw.side.0.as_ref() {
                "low" => false,
                "high" => true,
                _ => {
                    return Err(unexpected(&format!("{place}.side"), &raw.side, "\"low\" or \"high\""));
                }
            },
        },
    })
}

/// `[…]` of what `item` makes of each.
fn array<T>(items: &[T], separator: &str, item: impl Fn(&T) -> String) -> String {
    let texts: Vec<String> = items.iter().map(item).collect();
    format!("[{}]", texts.join(separator))
}

fn fractions(numbers: &[Rational]) -> String {
    array(numbers, ", ", |number| string(&number.format()))
}

fn whole(numbers: &[Integer]) -> String {
    array(numbers, ", ", |number| format!("\"{number}\""))
}

/// Writes the statement.
pub fn write_statement(statement: &Statement, out: &mut String) {
    let Domain {
        points,
        sign,
        interval,
        open,
        bounds,
    } = &statement.domain;
    out.push_str(&format!(
        "{{ \"claim\": \"domain\", \"points\": {}, \"sign\": \"{}\", \"interval\": {}, \"open\": {},\n    \"box\": [{}, {}],\n    \"outcome\": {{ ",
        array(points, ", ", usize::to_string),
        sign.name(),
        fractions(interval),
        array(open, ", ", bool::to_string),
        fractions(&bounds.low),
        fractions(&bounds.high),
    ));
    let field = |name: &str, value: &Rational| format!(", \"{name}\": \"{}\"", value.format());
    out.push_str(&match &statement.outcome {
        Outcome::Sandwich {
            inner_measure,
            outer_measure,
        } => {
            "\"kind\": \"sandwich\"".to_string()
                + &field("inner_measure", inner_measure)
                + &field("outer_measure", outer_measure)
        }
        Outcome::Empty => "\"kind\": \"empty\"".into(),
        Outcome::Nearest {
            to,
            lower_squared,
            upper_squared,
        } => {
            let to = match to {
                Target::Point(point) => fractions(point),
                Target::Fair => "\"fair\"".into(),
            };
            format!("\"kind\": \"nearest\", \"to\": {to}")
                + &field("lower_squared", lower_squared)
                + &field("upper_squared", upper_squared)
        }
        Outcome::Change {
            from,
            lower_squared,
            upper_squared,
        } => {
            format!("\"kind\": \"change\", \"from\": {}", fractions(from))
                + &field("lower_squared", lower_squared)
                + &field("upper_squared", upper_squared)
        }
        Outcome::Ball { lower, upper } => {
            "\"kind\": \"ball\"".to_string() + &field("lower", lower) + &field("upper", upper)
        }
    });
    out.push_str(" } }");
}

fn row_text(row: &Row) -> String {
    match row {
        Row::Parameter { piece, u } => format!("{{ \"piece\": {piece}, \"u\": \"{}\" }}", u.format()),
        Row::Side { axis, high } => {
            let side = if *high { "high" } else { "low" };
            format!("{{ \"axis\": {axis}, \"side\": \"{side}\" }}")
        }
    }
}

/// A list with one item a line.
fn lines<T>(items: &[T], item: impl Fn(&T) -> String) -> String {
    if items.is_empty() {
        return "[]".into();
    }
    let texts: Vec<String> = items.iter().map(|x| format!("\n      {}", item(x))).collect();
    format!("[{}]", texts.join(","))
}

fn star_text(star: &Star, more: &[usize]) -> String {
    let cells: Vec<String> = star
        .cells
        .iter()
        .enumerate()
        .map(|(i, cell)| {
            let numbers: Vec<usize> = cell.iter().chain(more.get(i)).copied().collect();
            array(&numbers, ",", usize::to_string)
        })
        .collect();
    format!(
        "{{\n      \"points\": {},\n      \"cells\": [{}] }}",
        lines(&star.points, |point| whole(point)),
        cells.join(", ")
    )
}

/// Writes the evidence.
pub fn write_evidence(evidence: &Evidence, out: &mut String) {
    out.push_str("{\n    ");
    out.push_str(&match evidence {
        Evidence::Sandwich {
            denominator,
            center,
            inner,
            outer,
            rows,
            cell_rows,
        } => format!(
            "\"denominator\": \"{denominator}\", \"center\": {},\n    \"inner\": {},\n    \"outer\": {},\n    \"rows\": {}",
            whole(center),
            star_text(inner, &[]),
            star_text(outer, cell_rows),
            lines(rows, row_text)
        ),
        Evidence::Empty { rows, multipliers } => format!(
            "\"rows\": {},\n    \"multipliers\": {}",
            lines(rows, row_text),
            whole(multipliers)
        ),
        Evidence::Nearest {
            center,
            point,
            base,
            rows,
            multipliers,
        } => format!(
            "\"center\": {},\n    \"point\": {},\n    \"base\": {},\n    \"rows\": {},\n    \"multipliers\": {}",
            fractions(center),
            fractions(point),
            fractions(base),
            lines(rows, row_text),
            fractions(multipliers)
        ),
        Evidence::Change { row } => format!("\"row\": {}", row_text(row)),
        Evidence::Ball {
            center,
            rows,
            multipliers,
            lengths,
        } => format!(
            "\"center\": {},\n    \"rows\": {},\n    \"multipliers\": {},\n    \"lengths\": {}",
            fractions(center),
            lines(rows, row_text),
            fractions(multipliers),
            fractions(lengths)
        ),
    });
    out.push_str(" }");
}
