//! Charts: bounds as bars on one axis, and errors against levels.

use std::fmt::Write;

use super::svg::{escape, line, number, pair, text, wrapped};
use super::ticks::ticks;

/// What a number rests on, which is how it is coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Standing {
    /// A checker accepted it.
    Certified,
    /// Proved by a theorem.
    Proved,
    /// Enclosed by interval arithmetic.
    Interval,
    /// As a paper has it.
    Printed,
    /// Computed with rounding.
    Binary64,
}

impl Standing {
    fn class(self) -> &'static str {
        match self {
            Standing::Certified => "certified",
            Standing::Proved => "proved",
            Standing::Interval => "interval",
            Standing::Printed => "printed",
            Standing::Binary64 => "binary64",
        }
    }

    fn words(self) -> &'static str {
        match self {
            Standing::Certified => "certified: accepted by the checker",
            Standing::Proved => "proved or exact",
            Standing::Interval => "enclosed by another program",
            Standing::Printed => "as printed in the paper, not proved",
            Standing::Binary64 => "binary64, not proved",
        }
    }
}

/// One bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Whose, and of what.
    pub label: String,
    /// The number in words, at the right.
    pub value: String,
    /// The least it can be, and the greatest; +∞ in the second place when that is not known.
    pub range: [f64; 2],
    /// What it rests on.
    pub standing: Standing,
}

/// Bars on one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct BarPanel {
    /// What the bars are bounds of.
    pub title: String,
    /// From top to bottom.
    pub bars: Vec<Bar>,
    /// A number marked by a line from top to bottom.
    pub mark: Option<f64>,
    /// Powers of ten along the axis; only positive ends are drawn then.
    pub logarithmic: bool,
}

/// A curve of a [`LevelPanel`].
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What it is.
    pub label: String,
    /// What it rests on.
    pub standing: Standing,
    /// Level, least and greatest value; what is not positive is not drawn.
    pub points: Vec<(u32, [f64; 2])>,
}

/// Errors against levels, powers of ten upward.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelPanel {
    /// What the errors are of.
    pub title: String,
    /// The last level.
    pub last: u32,
    /// The curves.
    pub series: Vec<Series>,
    /// A horizontal line with its name.
    pub line: Option<(String, f64)>,
    /// Levels at which there is nothing, and why.
    pub none: Option<(Vec<u32>, String)>,
}

/// A picture of charts, one above the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// The heading.
    pub title: String,
    /// Lines below it.
    pub caption: Vec<String>,
    /// Bars, first.
    pub bars: Vec<BarPanel>,
    /// Errors against levels, after them.
    pub levels: Vec<LevelPanel>,
}

const WIDTH: f64 = 960.0;
const MARGIN: f64 = 24.0;
/// Where the axis begins and ends; left of it stand labels, right of it values.
const AXIS: [f64; 2] = [330.0, 700.0];
const ROW: f64 = 22.0;
const LINE: f64 = 19.0;
/// Letters of the heading and of other text in a line.
const LETTERS: [usize; 2] = [100, 150];
/// The room of errors against levels.
const LEVELS: [f64; 2] = [376.0, 250.0];
/// Bars shorter than this are drawn as dots.
const SHORT: f64 = 5.0;

const STYLE: &str = "
text { font: 13px sans-serif; fill: #1a1c1e }
.title { font-size: 16px; font-weight: 600 }
.panel { font-weight: 600 }
.tick, .small { font-size: 11px; fill: #55595e }
.paper { fill: #ffffff }
.axis { stroke: #8d9298; stroke-width: 1 }
.grid { stroke: #dfe2e5; stroke-width: 1 }
.mark { stroke: #2a7f4f; stroke-width: 1; stroke-dasharray: 2 3 }
.limit { stroke: #55595e; stroke-width: 1; stroke-dasharray: 6 4 }
path { fill: none; stroke-width: 2; stroke-linecap: round; stroke-linejoin: round }
path.certified { stroke: #2a7f4f } circle.certified { fill: #2a7f4f; stroke: #2a7f4f }
path.proved { stroke: #1f5fa8 } circle.proved { fill: #1f5fa8; stroke: #1f5fa8 }
path.interval { stroke: #0f8a94 } circle.interval { fill: #0f8a94; stroke: #0f8a94 }
path.printed { stroke: #b5620a; stroke-dasharray: 5 3 } circle.printed { fill: #ffffff; stroke: #b5620a }
path.binary64 { stroke: #7d4fa3; stroke-dasharray: 2 2 } circle.binary64 { fill: #ffffff; stroke: #7d4fa3 }
circle { stroke-width: 1.6 }
.bar { stroke-width: 5; stroke-linecap: butt }
.bar.printed, .bar.binary64 { stroke-width: 2; stroke-dasharray: none }
@media (prefers-color-scheme: dark) {
text { fill: #e6e8ea } .tick, .small { fill: #a6abb1 } .paper { fill: #15181b } .axis { stroke: #7d838a } .grid { stroke: #2c3136 }
.mark { stroke: #5fca8e } .limit { stroke: #a6abb1 }
path.certified { stroke: #5fca8e } circle.certified { fill: #5fca8e; stroke: #5fca8e }
path.proved { stroke: #7db5f2 } circle.proved { fill: #7db5f2; stroke: #7db5f2 }
path.interval { stroke: #55c7d0 } circle.interval { fill: #55c7d0; stroke: #55c7d0 }
path.printed { stroke: #f0a94e } circle.printed { fill: #15181b; stroke: #f0a94e }
path.binary64 { stroke: #c79bea } circle.binary64 { fill: #15181b; stroke: #c79bea } }
@media print { .paper { fill: none } }
";

/// Numbers along a line of pixels.
struct Axis {
    low: f64,
    high: f64,
    logarithmic: bool,
    from: f64,
    to: f64,
}

impl Axis {
    fn new(numbers: &[f64], logarithmic: bool, [from, to]: [f64; 2]) -> Axis {
        let usable = |x: &&f64| x.is_finite() && (!logarithmic || **x > 0.0);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for x in numbers.iter().filter(usable) {
            let x = if logarithmic { x.log10() } else { *x };
            (low, high) = (low.min(x), high.max(x));
        }
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        if logarithmic {
            (low, high) = ((low - 0.05).floor(), (high + 0.05).ceil());
        } else {
            if low >= 0.0 && (low < 0.6 * high || low == high) {
                low = 0.0;
            }
            let room = if high > low {
                0.05 * (high - low)
            } else {
                high.abs().max(1.0)
            };
            (low, high) = (if low == 0.0 { 0.0 } else { low - room }, high + room);
        }
        if high <= low {
            high = low + 1.0;
        }
        Axis {
            low,
            high,
            logarithmic,
            from,
            to,
        }
    }

    /// Pixels, at an end for what lies beyond.
    fn place(&self, x: f64) -> f64 {
        let x = match self.logarithmic {
            true if x > 0.0 => x.log10(),
            true => f64::NEG_INFINITY,
            false => x,
        };
        let part = ((x - self.low) / (self.high - self.low)).clamp(0.0, 1.0);
        self.from + part * (self.to - self.from)
    }

    /// Numbers to write beside the axis: their places and texts.
    fn ticks(&self, count: usize) -> Vec<(f64, String)> {
        if !self.logarithmic {
            let (values, decimals) = ticks(self.low, self.high, count);
            let text = |x: f64| format!("{x:.decimals$}");
            return values.into_iter().map(|x| (self.place(x), text(x))).collect();
        }
        let decades = (self.high - self.low).round().max(1.0) as usize;
        let step = decades.div_ceil(count.max(1)).max(1);
        let numbers = (0..=decades).step_by(step);
        numbers
            .map(|i| {
                let part = i as f64 / decades as f64;
                (
                    self.from + part * (self.to - self.from),
                    power(self.low as i32 + i as i32),
                )
            })
            .collect()
    }
}

/// A power of ten in letters.
fn power(exponent: i32) -> String {
    match exponent {
        0 => "1".into(),
        1 => "10".into(),
        _ => {
            let digits = exponent.to_string();
            let raised = digits.chars().map(|c| match c {
                '-' => '⁻',
                '1' => '¹',
                '2' => '²',
                '3' => '³',
                c => char::from_u32('⁰' as u32 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
            });
            format!("10{}", raised.collect::<String>())
        }
    }
}

impl Chart {
    /// The drawing, readable on white, on a dark page and in print.
    pub fn svg(&self) -> String {
        let mut body = String::new();
        let mut y = MARGIN + 12.0;
        for words in wrapped(&self.title, LETTERS[0]) {
            text(&mut body, "title", [MARGIN, y], "start", &words);
            y += LINE;
        }
        for words in self.caption.iter().flat_map(|words| wrapped(words, LETTERS[1])) {
            text(&mut body, "small", [MARGIN, y], "start", &words);
            y += LINE - 3.0;
        }
        y += 10.0;
        for panel in &self.bars {
            y = panel.draw(&mut body, y);
        }
        for panel in &self.levels {
            y = panel.draw(&mut body, y);
        }
        y = self.legend(&mut body, y);
        let (width, height) = (number(WIDTH), number(y + MARGIN / 2.0));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n\
             <title>{}</title>\n<style>{STYLE}</style>\n<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n{body}</svg>\n",
            escape(&self.title)
        )
    }

    /// What the colours of the bars say.
    fn legend(&self, out: &mut String, mut y: f64) -> f64 {
        let mut standings: Vec<Standing> = self
            .bars
            .iter()
            .flat_map(|panel| &panel.bars)
            .map(|bar| bar.standing)
            .collect();
        standings.sort_unstable();
        standings.dedup();
        let mut x = MARGIN;
        for standing in standings {
            // Two to a line.
            if x > WIDTH - 300.0 {
                (x, y) = (MARGIN, y + LINE);
            }
            bar(out, standing, [x, x + 26.0], y - 4.0);
            text(out, "small", [x + 34.0, y], "start", standing.words());
            x += 290.0;
        }
        y + LINE
    }
}

/// A bar with both ends known.
fn bar(out: &mut String, standing: Standing, [from, to]: [f64; 2], y: f64) {
    let class = standing.class();
    if to - from < SHORT {
        let (x, y) = (number((from + to) / 2.0), number(y));
        let _ = writeln!(out, "<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"3.6\"/>");
        return;
    }
    let _ = writeln!(
        out,
        "<path class=\"bar {class}\" d=\"M{} L{}\"/>",
        pair([from, y]),
        pair([to, y])
    );
    let ends = [from, to].map(|x| format!("M{} L{}", pair([x, y - 6.0]), pair([x, y + 6.0])));
    let _ = writeln!(
        out,
        "<path class=\"{class}\" style=\"stroke-dasharray:none\" d=\"{} {}\"/>",
        ends[0], ends[1]
    );
}

impl BarPanel {
    /// Draws it below `y` and returns where it ends.
    fn draw(&self, out: &mut String, y: f64) -> f64 {
        let ends = self.bars.iter().flat_map(|bar| bar.range).chain(self.mark);
        let axis = Axis::new(&ends.collect::<Vec<f64>>(), self.logarithmic, AXIS);
        text(out, "panel", [MARGIN, y + 12.0], "start", &self.title);
        let top = y + 24.0;
        let bottom = top + ROW * self.bars.len() as f64 + 4.0;
        for (x, words) in axis.ticks(6) {
            line(out, "grid", [x, top], [x, bottom]);
            text(out, "tick", [x, bottom + 15.0], "middle", &words);
        }
        line(out, "axis", [AXIS[0], bottom], [AXIS[1], bottom]);
        if let Some(mark) = self.mark {
            let x = axis.place(mark);
            line(out, "mark", [x, top], [x, bottom]);
        }
        for (i, item) in self.bars.iter().enumerate() {
            let middle = top + ROW * (i as f64 + 0.5);
            text(out, "label", [AXIS[0] - 12.0, middle + 4.0], "end", &item.label);
            text(out, "small", [AXIS[1] + 14.0, middle + 4.0], "start", &item.value);
            let [low, high] = item.range;
            if !low.is_finite() {
                arrow(out, item.standing, AXIS[1] - 24.0, middle);
            } else if high.is_finite() {
                bar(out, item.standing, [axis.place(low), axis.place(high)], middle);
            } else {
                arrow(out, item.standing, axis.place(low), middle);
            }
        }
        bottom + 44.0
    }
}

/// From `x` to beyond the axis.
fn arrow(out: &mut String, standing: Standing, x: f64, y: f64) {
    let class = standing.class();
    let end = AXIS[1] + 8.0;
    let _ = writeln!(
        out,
        "<path class=\"{class}\" d=\"M{} L{}\"/>\n<path class=\"{class}\" style=\"stroke-dasharray:none\" d=\"M{} L{} M{} L{} L{}\"/>",
        pair([x, y]),
        pair([end, y]),
        pair([x, y - 6.0]),
        pair([x, y + 6.0]),
        pair([end - 6.0, y - 4.0]),
        pair([end, y]),
        pair([end - 6.0, y + 4.0])
    );
}

impl LevelPanel {
    /// Draws it below `y` and returns where it ends.
    fn draw(&self, out: &mut String, y: f64) -> f64 {
        let [wide, tall] = LEVELS;
        let (left, top) = (MARGIN + 60.0, y + 26.0);
        let bottom = top + tall;
        text(out, "panel", [MARGIN, y + 12.0], "start", &self.title);
        let ends = self
            .series
            .iter()
            .flat_map(|series| series.points.iter().flat_map(|(_, range)| *range));
        let ends: Vec<f64> = ends.chain(self.line.as_ref().map(|(_, x)| *x)).collect();
        let axis = Axis::new(&ends, true, [bottom, top]);
        for (place, words) in axis.ticks(8) {
            line(out, "grid", [left, place], [left + wide, place]);
            text(out, "tick", [left - 8.0, place + 4.0], "end", &words);
        }
        let column = |level: u32| left + wide * (f64::from(level) + 0.5) / f64::from(self.last + 1);
        let none = self.none.as_ref();
        for level in 0..=self.last {
            let x = column(level);
            line(out, "axis", [x, bottom], [x, bottom + 4.0]);
            text(out, "tick", [x, bottom + 16.0], "middle", &level.to_string());
            if let Some((_, why)) = none.filter(|(levels, _)| levels.contains(&level)) {
                text(out, "small", [x, bottom - 8.0], "middle", why);
            }
        }
        line(out, "axis", [left, bottom], [left + wide, bottom]);
        line(out, "axis", [left, top], [left, bottom]);
        text(out, "tick", [left + wide / 2.0, bottom + 32.0], "middle", "level");
        if let Some((words, at)) = &self.line {
            let place = axis.place(*at);
            line(out, "limit", [left, place], [left + wide, place]);
            text(out, "small", [left + wide + 14.0, place + 4.0], "start", words);
        }
        for series in &self.series {
            series.draw(out, &axis, &column);
        }
        // The key stands where there is room whatever the lines do: at the right, above the tolerance's name.
        for (i, series) in self.series.iter().enumerate() {
            let (x, y) = (left + wide + 28.0, top + 14.0 + LINE * 1.2 * i as f64);
            let class = series.standing.class();
            let _ = writeln!(
                out,
                "<path class=\"{class}\" d=\"M{} L{}\"/>",
                pair([x, y - 4.0]),
                pair([x + 30.0, y - 4.0])
            );
            dot(out, series.standing, [x + 15.0, y - 4.0]);
            text(out, "label", [x + 40.0, y], "start", &series.label);
        }
        bottom + 58.0
    }
}

impl Series {
    fn draw(&self, out: &mut String, axis: &Axis, column: &impl Fn(u32) -> f64) {
        let class = self.standing.class();
        let drawn: Vec<(f64, [f64; 2])> = self
            .points
            .iter()
            .filter(|(_, [_, high])| *high > 0.0 && high.is_finite())
            .map(|(level, range)| (column(*level), range.map(|x| axis.place(x))))
            .collect();
        let path: Vec<String> = drawn.iter().map(|(x, [_, high])| pair([*x, *high])).collect();
        if path.len() > 1 {
            let _ = writeln!(out, "<path class=\"{class}\" d=\"M{}\"/>", path.join(" L"));
        }
        for (x, [low, high]) in drawn {
            if low - high >= SHORT {
                let _ = writeln!(
                    out,
                    "<path class=\"{class}\" style=\"stroke-dasharray:none\" d=\"M{} L{}\"/>",
                    pair([x, low]),
                    pair([x, high])
                );
            }
            dot(out, self.standing, [x, high]);
        }
    }
}

fn dot(out: &mut String, standing: Standing, [x, y]: [f64; 2]) {
    let class = standing.class();
    let (x, y) = (number(x), number(y));
    let _ = writeln!(out, "<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"3.6\"/>");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> Chart {
        let bar = |label: &str, range, standing| Bar {
            label: label.into(),
            value: "1 < 2".into(),
            range,
            standing,
        };
        let series = Series {
            label: "true error".into(),
            standing: Standing::Proved,
            points: vec![(0, [0.5, 0.5]), (1, [0.001, 0.125]), (2, [0.0, 0.0])],
        };
        Chart {
            title: "A & B".into(),
            caption: vec!["beside".into()],
            bars: vec![BarPanel {
                title: "σ".into(),
                bars: vec![
                    bar("short", [0.5, 0.5], Standing::Certified),
                    bar("long", [0.25, 0.75], Standing::Printed),
                    bar("at least", [0.25, f64::INFINITY], Standing::Proved),
                    bar("infinite", [f64::INFINITY; 2], Standing::Binary64),
                ],
                mark: Some(0.5),
                logarithmic: false,
            }],
            levels: vec![LevelPanel {
                title: "errors".into(),
                last: 2,
                series: vec![series],
                line: Some(("tolerance".into(), 0.01)),
                none: Some((vec![2], "empty".into())),
            }],
        }
    }

    #[test]
    fn the_same_chart_gives_the_same_text() {
        let text = chart().svg();
        assert_eq!(text, chart().svg());
        assert!(text.contains("A &amp; B") && text.contains("1 &lt; 2"));
        assert!(!text.contains("NaN") && !text.contains("inf,") && !text.contains("\"inf"));
        // A dot for the short bar; two levels, the third has nothing to draw; one in the key, one in the legend of none.
        assert_eq!(text.matches("<circle").count(), 4);
        assert_eq!(text.matches(">empty<").count(), 1);
        for words in [
            "certified: accepted by the checker",
            "binary64, not proved",
            "tolerance",
        ] {
            assert_eq!(text.matches(words).count(), 1, "{words}");
        }
    }

    #[test]
    fn bars_begin_and_end_where_their_numbers_are() {
        let axis = Axis::new(&[0.25, 0.75], false, [100.0, 200.0]);
        assert_eq!(axis.low, 0.0);
        assert!((axis.place(0.75) - axis.place(0.25) - 50.0 / axis.high).abs() < 1e-9);
        assert_eq!(axis.place(1e9), 200.0);
        let axis = Axis::new(&[1e-3, 1.0, 0.0, f64::INFINITY], true, [0.0, 40.0]);
        assert_eq!((axis.low, axis.high), (-4.0, 1.0));
        assert_eq!(axis.place(1e-4), 0.0);
        assert_eq!(axis.place(0.0), 0.0);
        assert_eq!(axis.ticks(2).len(), 2);
        // Numbers that are all the same, and none at all.
        for numbers in [&[7.0, 7.0][..], &[]] {
            let axis = Axis::new(numbers, false, [0.0, 10.0]);
            assert!(axis.low < axis.high && axis.place(7.0).is_finite());
        }
    }

    #[test]
    fn powers_of_ten_are_raised() {
        assert_eq!([power(-12), power(0), power(1), power(4)], ["10⁻¹²", "1", "10", "10⁴"]);
    }
}
