//! Drawings in SVG 1.1 with style sheets, readable on white, on a dark page and in print.

use std::fmt::Write;

use super::ticks::ticks;
use super::{Item, Kind, Point, Scene, Segment, Shape, View};

/// What a drawing shows beside its scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The heading.
    pub title: String,
    /// Lines below the drawing: what is stated, exactly.
    pub caption: Vec<String>,
    /// From where; one panel each, all to one scale.
    pub views: Vec<View>,
}

/// The room that all panels share.
const ROOM: [f64; 2] = [900.0, 460.0];
const MARGIN: f64 = 24.0;
/// Between panels, and left of each for the numbers of its axis.
const GAP: f64 = 64.0;
const LINE: f64 = 19.0;
/// Letters in a line of the caption, by the width of the drawing.
const LETTER: f64 = 7.5;
/// Points of a piece that SVG has no curve for.
const SAMPLES: usize = 49;

const STYLE: &str = "
text { font: 13px sans-serif; fill: #1a1c1e }
.title { font-size: 16px; font-weight: 600 }
.tick { font-size: 11px; fill: #55595e }
.paper { fill: #ffffff }
.frame-of-panel { fill: none; stroke: #b9bdc2; stroke-width: 1 }
.axis { stroke: #b9bdc2; stroke-width: 1 }
path, polyline, polygon, line { fill: none; stroke-linejoin: round; stroke-linecap: round }
.curve { stroke: #12355b; stroke-width: 2 }
.control { stroke: #9a9ea3; stroke-width: 1; stroke-dasharray: 4 3 }
.polygon { stroke: #b5620a; stroke-width: 1.5 }
.chord { stroke: #c1121f; stroke-width: 2 }
.comb { stroke: #7a9cc6; stroke-width: 0.7 }
.frame { stroke: #12355b; stroke-width: 1; stroke-opacity: 0.35 }
.pipe { stroke: #7fb7be; stroke-opacity: 0.35 }
.outer { stroke: #b5620a; stroke-width: 1.2; fill: #b5620a; fill-opacity: 0.12 }
.inner { stroke: #2a7f4f; stroke-width: 1.2; fill: #2a7f4f; fill-opacity: 0.25 }
.joint { fill: #12355b }
.mark { fill: #c1121f }
@media (prefers-color-scheme: dark) {
text { fill: #e6e8ea } .tick { fill: #a6abb1 } .paper { fill: #15181b }
.frame-of-panel, .axis { stroke: #484d53 } .curve { stroke: #8ec5ff } .control { stroke: #7d838a }
.polygon { stroke: #f0a94e } .chord { stroke: #ff6b6b } .comb { stroke: #4d6f99 } .frame { stroke: #8ec5ff }
.pipe { stroke: #2f6f78 } .outer { stroke: #f0a94e; fill: #f0a94e } .inner { stroke: #5fca8e; fill: #5fca8e }
.joint { fill: #8ec5ff } .mark { fill: #ff6b6b } }
@media print { .paper { fill: none } }
";

/// A panel: a view with the box of what it shows, and where it stands.
struct Panel<'v> {
    view: &'v View,
    low: [f64; 2],
    high: [f64; 2],
    /// Upper left corner in the drawing.
    corner: [f64; 2],
    scale: f64,
}

impl Panel<'_> {
    fn place(&self, point: &Point) -> [f64; 2] {
        let [x, y] = self.view.project(point);
        [
            self.corner[0] + (x - self.low[0]) * self.scale,
            self.corner[1] + (self.high[1] - y) * self.scale,
        ]
    }

    fn width(&self) -> f64 {
        (self.high[0] - self.low[0]) * self.scale
    }

    fn height(&self) -> f64 {
        (self.high[1] - self.low[1]) * self.scale
    }
}

/// The drawing of a scene.
pub fn svg(scene: &Scene, picture: &Picture) -> String {
    let mut panels = panels(scene, &picture.views);
    let width = panels
        .last()
        .map_or(ROOM[0], |last| last.corner[0] + last.width() + MARGIN)
        .max(620.0);
    let letters = ((width - 2.0 * MARGIN) / LETTER) as usize;
    let title = wrapped(&picture.title, letters * 13 / 16);
    let top = MARGIN + LINE * title.len() as f64 + 14.0;
    for panel in &mut panels {
        panel.corner[1] += top;
    }
    let tallest = panels.iter().map(Panel::height).fold(0.0, f64::max);
    let mut below = top + tallest + 44.0;
    let mut body = String::new();
    for (i, line) in title.iter().enumerate() {
        text(
            &mut body,
            "title",
            [MARGIN, MARGIN + 12.0 + LINE * i as f64],
            "start",
            line,
        );
    }
    for panel in &panels {
        draw_panel(&mut body, scene, panel);
    }
    for item in scene.drawn() {
        swatch(&mut body, item.kind, below);
        for line in wrapped(&item.label, letters - 8) {
            text(&mut body, "label", [MARGIN + 44.0, below], "start", &line);
            below += LINE;
        }
    }
    below += 8.0;
    for line in picture.caption.iter().flat_map(|line| wrapped(line, letters)) {
        text(&mut body, "caption", [MARGIN, below], "start", &line);
        below += LINE;
    }
    let height = below + MARGIN - LINE / 2.0;
    let (width, height) = (number(width), number(height));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n\
         <title>{}</title>\n<style>{STYLE}</style>\n<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n{body}</svg>\n",
        escape(&picture.title)
    )
}

fn panels<'v>(scene: &Scene, views: &'v [View]) -> Vec<Panel<'v>> {
    let points = scene.extent();
    let radius = scene.tube_radius();
    let mut panels: Vec<Panel> = views
        .iter()
        .map(|view| {
            let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
            for point in &points {
                let place = view.project(point);
                for axis in 0..2 {
                    low[axis] = low[axis].min(place[axis]);
                    high[axis] = high[axis].max(place[axis]);
                }
            }
            let side = (high[0] - low[0]).max(high[1] - low[1]);
            let room = radius + if side > 0.0 { 0.04 * side } else { 1.0 };
            Panel {
                view,
                low: low.map(|x| x - room),
                high: high.map(|x| x + room),
                corner: [0.0, 0.0],
                scale: 1.0,
            }
        })
        .collect();
    let wide: f64 = panels.iter().map(Panel::width).sum();
    let tall = panels.iter().map(Panel::height).fold(0.0, f64::max);
    let gaps = GAP * panels.len().saturating_sub(1) as f64;
    let scale = ((ROOM[0] - gaps) / wide).min(ROOM[1] / tall);
    let mut left = MARGIN + GAP;
    for panel in &mut panels {
        panel.scale = scale;
        panel.corner[0] = left;
        left += panel.width() + GAP;
    }
    panels
}

fn draw_panel(out: &mut String, scene: &Scene, panel: &Panel) {
    let ([left, top], wide, tall) = (panel.corner, panel.width(), panel.height());
    let _ = writeln!(
        out,
        "<g><rect class=\"frame-of-panel\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
        number(left),
        number(top),
        number(wide),
        number(tall)
    );
    axes(out, panel);
    for item in scene.drawn() {
        draw(out, item, panel);
    }
    out.push_str("</g>\n");
}

fn axes(out: &mut String, panel: &Panel) {
    let ([left, top], tall) = (panel.corner, panel.height());
    let bottom = top + tall;
    if panel.view.axes.is_some() {
        let fit = |pixels: f64, each: f64| ((pixels / each) as usize).clamp(1, 8);
        let (values, decimals) = ticks(panel.low[0], panel.high[0], fit(panel.width(), 60.0));
        for value in values {
            let x = left + (value - panel.low[0]) * panel.scale;
            line(out, "axis", [x, bottom], [x, bottom + 4.0]);
            text(
                out,
                "tick",
                [x, bottom + 16.0],
                "middle",
                &format!("{value:.decimals$}"),
            );
        }
        let (values, decimals) = ticks(panel.low[1], panel.high[1], fit(tall, 40.0));
        for value in values {
            let y = top + (panel.high[1] - value) * panel.scale;
            let value = if panel.view.is_downward() { 0.0 - value } else { value };
            line(out, "axis", [left - 4.0, y], [left, y]);
            text(
                out,
                "tick",
                [left - 7.0, y + 4.0],
                "end",
                &format!("{value:.decimals$}"),
            );
        }
    }
    let name = match panel.view.axes {
        Some([right, up]) if panel.view.is_downward() => format!("{right} to the right, {up} down"),
        Some([right, up]) => format!("{right} to the right, {up} up"),
        None => format!("seen {}", panel.view.name),
    };
    text(out, "tick", [left, top - 5.0], "start", &name);
}

fn draw(out: &mut String, item: &Item, panel: &Panel) {
    let class = item.kind.name();
    match &item.shape {
        Shape::Path(segments) => {
            let _ = writeln!(out, "<path class=\"{class}\" d=\"{}\"/>", path(segments, panel));
        }
        Shape::Tube(segments, radius) => {
            // All discs of the radius around the curve's points: what a pipe looks like from any side.
            let wide = number((2.0 * radius * panel.scale).max(0.5));
            let d = path(segments, panel);
            let _ = writeln!(out, "<path class=\"{class}\" stroke-width=\"{wide}\" d=\"{d}\"/>");
        }
        Shape::Lines(lines) => {
            let mut d = String::new();
            for [from, to] in lines {
                let (from, to) = (panel.place(from), panel.place(to));
                let _ = write!(d, "M{} L{} ", pair(from), pair(to));
            }
            let _ = writeln!(out, "<path class=\"{class}\" d=\"{}\"/>", d.trim_end());
        }
        Shape::Polyline(points, closed) => {
            let element = if *closed { "polygon" } else { "polyline" };
            let places = places(points, panel);
            let _ = writeln!(
                out,
                "<{element} class=\"{class}\" style=\"fill:none\" points=\"{places}\"/>"
            );
        }
        Shape::Area(points) => {
            let _ = writeln!(out, "<polygon class=\"{class}\" points=\"{}\"/>", places(points, panel));
        }
        Shape::Dots(points) => {
            let radius = if item.kind == Kind::Mark { 4.0 } else { 2.4 };
            for point in points {
                let [x, y] = panel.place(point);
                let _ = writeln!(
                    out,
                    "<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\"{radius}\"/>",
                    number(x),
                    number(y)
                );
            }
        }
    }
}

/// Path commands: polynomial pieces up to degree 3 are what SVG draws, others are sampled.
fn path(segments: &[Segment], panel: &Panel) -> String {
    let mut d = String::new();
    for (i, segment) in segments.iter().enumerate() {
        if i == 0 {
            let _ = write!(d, "M{}", pair(panel.place(&segment.points[0])));
        }
        let points = &segment.points;
        match (points.len(), segment.weights.is_empty()) {
            (2, true) => command(&mut d, 'L', &points[1..], panel),
            (3, true) => command(&mut d, 'Q', &points[1..], panel),
            (4, true) => command(&mut d, 'C', &points[1..], panel),
            _ => command(&mut d, 'L', &segment.samples(SAMPLES)[1..], panel),
        }
    }
    d
}

fn command(d: &mut String, letter: char, points: &[Point], panel: &Panel) {
    let _ = write!(d, " {letter}{}", places(points, panel));
}

fn places(points: &[Point], panel: &Panel) -> String {
    let places: Vec<String> = points.iter().map(|point| pair(panel.place(point))).collect();
    places.join(" ")
}

fn swatch(out: &mut String, kind: Kind, y: f64) {
    let class = kind.name();
    let (left, middle) = (MARGIN, y - 4.0);
    let _ = match kind {
        Kind::Joint | Kind::Mark => writeln!(
            out,
            "<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\"3\"/>",
            number(left + 16.0),
            number(middle)
        ),
        Kind::Inner | Kind::Outer => writeln!(
            out,
            "<polygon class=\"{class}\" points=\"{}\"/>",
            [[0.0, -5.0], [32.0, -5.0], [32.0, 5.0], [0.0, 5.0]]
                .map(|[x, y]| pair([left + x, middle + y]))
                .join(" ")
        ),
        _ => {
            let wide = if kind == Kind::Pipe { " stroke-width=\"10\"" } else { "" };
            let (from, to) = (pair([left, middle]), pair([left + 32.0, middle]));
            writeln!(out, "<path class=\"{class}\"{wide} d=\"M{from} L{to}\"/>")
        }
    };
}

pub(super) fn line(out: &mut String, class: &str, from: [f64; 2], to: [f64; 2]) {
    let _ = writeln!(
        out,
        "<line class=\"{class}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>",
        number(from[0]),
        number(from[1]),
        number(to[0]),
        number(to[1])
    );
}

pub(super) fn text(out: &mut String, class: &str, [x, y]: [f64; 2], anchor: &str, words: &str) {
    let _ = writeln!(
        out,
        "<text class=\"{class}\" x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\">{}</text>",
        number(x),
        number(y),
        escape(words)
    );
}

pub(super) fn pair([x, y]: [f64; 2]) -> String {
    format!("{},{}", number(x), number(y))
}

/// At most two decimals, no trailing zeros, no negative zero.
pub(super) fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// Text for XML; characters that XML 1.0 cannot hold become spaces.
pub(super) fn escape(words: &str) -> String {
    let mut out = String::with_capacity(words.len());
    for c in words.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => out.push(' '),
            c if c < ' ' && !matches!(c, '\t' | '\n' | '\r') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Lines of at most `letters` letters, broken at spaces, and inside a word only where it is longer than a line.
pub(super) fn wrapped(words: &str, letters: usize) -> Vec<String> {
    let letters = letters.max(8);
    let mut lines = Vec::new();
    let mut line = String::new();
    let mut used = 0;
    for word in words.split(' ') {
        let mut rest: Vec<char> = word.chars().collect();
        if used > 0 && used + 1 + rest.len() > letters {
            lines.push(std::mem::take(&mut line));
            used = 0;
        }
        while rest.len() > letters {
            lines.push(rest.drain(..letters).collect());
        }
        if used > 0 {
            line.push(' ');
            used += 1;
        }
        used += rest.len();
        line.extend(rest);
    }
    lines.push(line);
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawing(views: Vec<View>) -> String {
        let curve = crate::curve::read_curve(
            r#"{ "knotproof": "curve/1", "bezier": { "pieces": [ { "points": [[0,0,0],[1,2,0],[3,1,1]] },
                { "points": [[3,1,1],[4,0,1],[4,0,2],[5,0,0],[6,1,0]] } ] } }"#,
        )
        .unwrap()
        .curve;
        let picture = Picture {
            title: "A <curve> & \"more\"".into(),
            caption: vec!["σ² = 1/3".into()],
            views,
        };
        svg(&Scene::of_curve(&curve), &picture)
    }

    #[test]
    fn the_same_scene_gives_the_same_text_and_names_are_escaped() {
        let text = drawing(View::usual(3));
        assert_eq!(text, drawing(View::usual(3)));
        assert!(text.contains("A &lt;curve&gt; &amp; &quot;more&quot;"));
        assert!(text.contains("σ² = 1/3"));
        assert_eq!(
            text.matches("<path class=\"curve\"").count(),
            4,
            "three panels and the legend"
        );
        assert!(!text.contains("NaN") && !text.contains("inf"));
    }

    #[test]
    fn quadratic_pieces_are_drawn_as_such() {
        let text = drawing(vec![View::of_axes(0, 1)]);
        let path = text.lines().find(|line| line.contains("class=\"curve\"")).unwrap();
        assert_eq!(path.matches(" Q").count(), 1);
        assert_eq!(path.matches(" L").count(), 1, "degree 4 is sampled");
    }

    #[test]
    fn long_words_are_broken() {
        assert_eq!(
            wrapped("ab cdefghijklmnopqrs t", 8),
            ["ab", "cdefghij", "klmnopqr", "s t"]
        );
        assert_eq!(wrapped("", 8), [""]);
    }
}
