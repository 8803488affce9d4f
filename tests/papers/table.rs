//! The page: rows of printed and exact values, with verdicts that are computed from the two.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use knotproof::number::{Integer, Meaning, Rational, decimal_down, decimal_up, parse_number, sqrt_enclosure};

/// Roots are enclosed this closely.
const ROOT_BITS: u32 = 200;
/// So many significant digits of a value are shown.
const DIGITS: usize = 10;
/// With fewer digits in common both ends of an enclosure are shown.
const LEAST_DIGITS: usize = 4;

/// A value that was computed.
#[derive(Clone, Debug)]
pub enum Exact {
    /// Exactly this.
    Fraction(Rational),
    /// Between the two.
    Between(Rational, Rational),
}

impl Exact {
    /// √square.
    pub fn root(square: &Rational) -> Exact {
        Exact::root_between(square, square)
    }

    /// Between √low and √high.
    pub fn root_between(low: &Rational, high: &Rational) -> Exact {
        let (low, high) = (sqrt_enclosure(low, ROOT_BITS).0, sqrt_enclosure(high, ROOT_BITS).1);
        [low, high].into()
    }

    /// The two ends.
    pub fn ends(&self) -> (&Rational, &Rational) {
        match self {
            Exact::Fraction(x) => (x, x),
            Exact::Between(low, high) => (low, high),
        }
    }

    /// As text with so many significant digits at most; "…" where digits follow. Short fractions are shown too.
    pub fn show(&self, digits: usize) -> String {
        match self {
            Exact::Fraction(x) if x.is_integer() => grouped(&x.to_string()),
            Exact::Fraction(x) => {
                let decimal = towards_zero(x, digits);
                let fraction = x.to_string();
                match (
                    parse_number(&decimal, Meaning::Decimal) == Ok(x.clone()),
                    fraction.len() <= 12,
                ) {
                    (true, _) => decimal,
                    (false, true) => format!("{fraction} = {decimal}…"),
                    (false, false) => format!("{decimal}…"),
                }
            }
            Exact::Between(low, high) => {
                let common = (1..=digits)
                    .rev()
                    .find(|digits| towards_zero(low, *digits) == towards_zero(high, *digits));

                match common {
                    Some(common) if common >= LEAST_DIGITS.min(digits) => format!("{}…", towards_zero(low, common)),
                    // A value that may have few digits itself has enclosures without common ones.
                    _ => format!("{} to {}", decimal_down(low, digits), decimal_up(high, digits)),
                }
            }
        }
    }
}

impl std::fmt::Display for Exact {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.show(DIGITS))
    }
}

impl From<Rational> for Exact {
    fn from(x: Rational) -> Exact {
        Exact::Fraction(x)
    }
}

impl From<[Rational; 2]> for Exact {
    fn from([low, high]: [Rational; 2]) -> Exact {
        match low == high {
            true => Exact::Fraction(low),
            false => Exact::Between(low, high),
        }
    }
}

impl From<usize> for Exact {
    fn from(n: usize) -> Exact {
        Exact::Fraction(Rational::from_integer(n.into()))
    }
}

fn towards_zero(x: &Rational, digits: usize) -> String {
    match x.numer().is_negative() {
        true => format!("-{}", decimal_down(&-x, digits)),
        false => decimal_down(x, digits),
    }
}

/// 10240 as "10,240"; four digits stay together.
fn grouped(integer: &str) -> String {
    let digits = integer.trim_start_matches('-').len();
    let mut text = String::new();
    for (i, digit) in integer.chars().rev().enumerate() {
        if digits > 4 && i % 3 == 0 && i > 0 && digit != '-' {
            text.insert(0, ',');
        }
        text.insert(0, digit);
    }
    text
}

/// What a comparison gives.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The printed number is the value.
    Equal,
    /// The value, rounded to nearest, has the printed digits.
    Rounded,
    /// The value begins with the printed digits; rounded to nearest it has others.
    CutOff,
    /// The printed number is none of these, or the formula another one.
    Different,
    /// A claim that is true.
    Holds,
    /// A claim that is false.
    Fails,
    /// A step of the proof is false.
    Unproved,
    /// Why there is nothing to compare.
    Unknown(String),
}

impl Verdict {
    /// What a printed number is beside the value. A printed decimal stands for its digits, an integer or a fraction for itself.
    ///
    /// # Panics
    /// When the enclosure is too wide to tell.
    pub fn of(printed: &str, exact: &Exact) -> Verdict {
        let (number, unit) = read(printed);
        let (low, high) = exact.ends();
        if low == high && *low == number {
            return Verdict::Equal;
        }
        let half = &unit / whole(2);
        if *low >= &number - &half && *high <= &number + &half {
            return Verdict::Rounded;
        }
        let (first, last) = match number.numer().is_negative() {
            true => (&number - &unit, number.clone()),
            false => (number.clone(), &number + &unit),
        };
        if *low >= first && *high < last {
            return Verdict::CutOff;
        }
        let apart = |from: &Rational, to: &Rational| high < from || low > to;
        let apart = apart(&(&number - &half), &(&number + &half)) && apart(&first, &last);
        assert!(apart || low == high, "{printed}: too wide an enclosure");
        Verdict::Different
    }

    /// `Equal` or `Different`.
    pub fn equal(is: bool) -> Verdict {
        if is { Verdict::Equal } else { Verdict::Different }
    }

    /// `Holds` or `Fails`.
    pub fn holds(does: bool) -> Verdict {
        if does { Verdict::Holds } else { Verdict::Fails }
    }

    /// `Different`, by a word or symbol that is not a number.
    pub fn misprint() -> Verdict {
        Verdict::Different
    }

    /// `Holds`, by a proof that the row names.
    pub fn proved() -> Verdict {
        Verdict::Holds
    }

    /// `Unproved`, because of a false step.
    ///
    /// # Panics
    /// When the step is not false.
    pub fn unproved(step_is_false: bool) -> Verdict {
        assert!(step_is_false);
        Verdict::Unproved
    }

    fn name(&self) -> &'static str {
        match self {
            Verdict::Equal => "equal",
            Verdict::Rounded => "rounded",
            Verdict::CutOff => "cut off",
            Verdict::Different => "different",
            Verdict::Holds => "holds",
            Verdict::Fails => "does not hold",
            Verdict::Unproved => "proof does not hold",
            Verdict::Unknown(_) => "cannot be recomputed",
        }
    }
}

/// A printed number and the unit of its last place: 0 for integers and fractions.
fn read(printed: &str) -> (Rational, Rational) {
    let text = printed.replace(',', "");
    let number = parse_number(&text, Meaning::Decimal).unwrap_or_else(|error| panic!("{printed}: {error}"));
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let Some((_, decimals)) = mantissa.split_once('.') else {
        return (number, Rational::default());
    };
    let place = exponent.parse::<i32>().expect("an exponent") - decimals.len() as i32;
    let power = Rational::from_integer(Integer::from(10).pow(place.unsigned_abs()));
    let unit = if place < 0 { whole(1) / power } else { power };
    (number, unit)
}

/// All numbers that round to the printed one.
pub fn rounded_from(printed: &str) -> [Rational; 2] {
    let (number, unit) = read(printed);
    let half = unit / whole(2);
    [&number - &half, number + half]
}

fn whole(n: i64) -> Rational {
    Rational::from_integer(n.into())
}

/// A line of a table.
pub struct Row {
    place: String,
    printed: String,
    exact: String,
    verdict: Verdict,
}

/// A printed number beside its value.
pub fn value(place: &str, printed: &str, exact: impl Into<Exact>) -> Row {
    named(place, "", printed, exact)
}

/// A printed number beside its value, with a name before it ("m = ").
pub fn named(place: &str, name: &str, printed: &str, exact: impl Into<Exact>) -> Row {
    noted(place, name, printed, exact, "")
}

/// The same with a note behind the value.
pub fn noted(place: &str, name: &str, printed: &str, exact: impl Into<Exact>, note: &str) -> Row {
    let exact = exact.into();
    let verdict = Verdict::of(printed, &exact);
    let space = if note.is_empty() || note.starts_with([',', ':', ';']) {
        ""
    } else {
        " "
    };
    row(
        place,
        &format!("{name}{printed}"),
        &format!("{exact}{space}{note}"),
        verdict,
    )
}

/// Anything else.
pub fn row(place: &str, printed: &str, exact: &str, verdict: Verdict) -> Row {
    Row {
        place: place.into(),
        printed: printed.into(),
        exact: exact.into(),
        verdict,
    }
}

/// Something printed that the text does not determine.
pub fn unknown(place: &str, printed: &str, why: &str) -> Row {
    row(place, printed, "–", Verdict::Unknown(why.into()))
}

/// A text in Markdown that counts its verdicts.
#[derive(Default)]
pub struct Page {
    text: String,
    counts: BTreeMap<Verdict, usize>,
}

impl Page {
    /// A heading.
    pub fn heading(&mut self, level: usize, text: &str) {
        let _ = write!(self.text, "\n{} {text}\n", "#".repeat(level));
    }

    /// A paragraph or a list.
    pub fn text(&mut self, text: &str) {
        let _ = write!(self.text, "\n{}\n", text.trim());
    }

    /// A table.
    pub fn table(&mut self, rows: Vec<Row>) {
        self.text
            .push_str("\n| where | printed | exact | verdict |\n| --- | --- | --- | --- |\n");
        for row in rows {
            let verdict = match &row.verdict {
                Verdict::Unknown(why) => format!("{}: {why}", row.verdict.name()),
                verdict => verdict.name().to_string(),
            };
            self.cells(&[&row.place, &row.printed, &row.exact, &verdict]);
            let kind = match row.verdict {
                Verdict::Unknown(_) => Verdict::Unknown(String::new()),
                verdict => verdict,
            };
            *self.counts.entry(kind).or_default() += 1;
        }
    }

    /// A table without verdicts.
    pub fn plain_table(&mut self, head: &[&str], rows: &[Vec<String>]) {
        self.text.push('\n');
        self.cells(head);
        self.cells(&vec!["---"; head.len()]);
        for row in rows {
            self.cells(&row.iter().map(String::as_str).collect::<Vec<_>>());
        }
    }

    fn cells(&mut self, cells: &[&str]) {
        for cell in cells {
            let _ = write!(self.text, "| {} ", cell.replace('|', "\\|"));
        }
        self.text.push_str("|\n");
    }

    /// The text, and how often each verdict occurs in it.
    pub fn finish(self) -> (String, Vec<(&'static str, usize)>) {
        let counts = self.counts.iter().map(|(verdict, count)| (verdict.name(), *count));
        (self.text, counts.collect())
    }
}

/// The names of all verdicts, in their order.
pub fn verdict_names() -> Vec<&'static str> {
    let all = [
        Verdict::Equal,
        Verdict::Rounded,
        Verdict::CutOff,
        Verdict::Different,
        Verdict::Holds,
        Verdict::Fails,
        Verdict::Unproved,
        Verdict::Unknown(String::new()),
    ];
    all.iter().map(Verdict::name).collect()
}

#[test]
fn verdicts() {
    let third = Exact::from(Rational::new(1.into(), 3.into()));
    let near = |text: &str| Exact::from(parse_number(text, Meaning::Decimal).unwrap());
    for (printed, exact, verdict) in [
        ("1/3", &third, Verdict::Equal),
        ("0.333", &third, Verdict::Rounded),
        ("0.334", &third, Verdict::Different),
        ("0.3e0", &third, Verdict::Rounded),
        ("3.3e-1", &third, Verdict::Rounded),
        ("1/4", &third, Verdict::Different),
        ("0.66", &near("2/3"), Verdict::CutOff),
        ("0.67", &near("2/3"), Verdict::Rounded),
        ("-0.66", &near("-2/3"), Verdict::CutOff),
        ("-0.65", &near("-2/3"), Verdict::Different),
        ("10,240", &near("10240"), Verdict::Equal),
        ("10,240", &near("10241"), Verdict::Different),
        ("1.9", &near("1.875"), Verdict::Rounded),
        ("0.65", &near("0.625"), Verdict::Different),
        ("1.41", &Exact::root(&whole(2)), Verdict::Rounded),
        ("2.0", &Exact::root(&whole(4)), Verdict::Equal),
    ] {
        assert_eq!(Verdict::of(printed, exact), verdict, "{printed} {exact}");
    }
}

#[test]
fn values_as_text() {
    let text = |n: i64, d: i64| Exact::from(Rational::new(n.into(), d.into())).to_string();
    assert_eq!(text(77, 24), "77/24 = 3.208333333…");
    assert_eq!(text(-1, 6), "-1/6 = -0.1666666666…");
    assert_eq!(text(3, 4), "0.75");
    assert_eq!(text(10_240, 1), "10,240");
    assert_eq!(text(-1024, 1), "-1024");
    assert_eq!(text(-123_456, 1), "-123,456");
    assert_eq!(Exact::root(&whole(2)).show(5), "1.4142…");
    let [low, high] = ["1.19999999", "1.2"].map(|x| parse_number(x, Meaning::Decimal).unwrap());
    assert_eq!(Exact::Between(low, high).to_string(), "1.19999999 to 1.2");
}

#[test]
#[should_panic(expected = "too wide")]
fn a_verdict_needs_a_narrow_enclosure() {
    Verdict::of("1.5", &Exact::Between(whole(1), whole(2)));
}
