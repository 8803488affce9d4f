//! Reports: one HTML file with a view that turns, the leaves of the cover tree, the certificate, and the checker that checks it again.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

use super::svg::escape;
use super::{Item, Point, Scene, Segment, Shape};

const PAGE: &str = include_str!("html/page.html");
const STYLE: &str = include_str!("html/style.css");
const VIEWER: &str = include_str!("html/viewer.js");
/// The checker, compiled to WebAssembly from `certs/checkers/wasm` by its `build.sh`, and compressed.
const CHECKER: &[u8] = include_bytes!("html/checker.wasm.gz");

/// Points of a piece that is drawn as a polygon.
const SAMPLES: usize = 25;

/// What a report shows beside its scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report<'a> {
    /// The heading.
    pub title: &'a str,
    /// What is stated, in words and exact numbers.
    pub statement: &'a [String],
    /// The certificate's bytes, or none for a curve alone.
    pub certificate: Option<&'a [u8]>,
    /// The name under which the certificate is saved.
    pub file_name: &'a str,
}

#[derive(Serialize)]
struct Payload<'a> {
    dimension: usize,
    items: Vec<ItemLine<'a>>,
    segments: Vec<SegmentLine<'a>>,
    /// a, b, rule number.
    leaves: Vec<([f64; 2], [f64; 2], usize)>,
    rules: Vec<&'static str>,
    frames: Vec<FrameLine>,
    certificate: Option<String>,
    file_name: &'a str,
    checker: Option<String>,
}

#[derive(Serialize)]
struct ItemLine<'a> {
    kind: &'static str,
    label: &'a str,
    lines: Vec<Vec<Point>>,
    dots: &'a [Point],
    closed: bool,
    filled: bool,
    radius: f64,
}

#[derive(Serialize)]
struct SegmentLine<'a> {
    points: &'a [Point],
    weights: &'a [f64],
}

#[derive(Serialize)]
struct FrameLine {
    time: f64,
    line: Vec<Point>,
}

impl<'a> ItemLine<'a> {
    fn new(item: &'a Item) -> ItemLine<'a> {
        let mut line = ItemLine {
            kind: item.kind.name(),
            label: &item.label,
            lines: Vec::new(),
            dots: &[],
            closed: false,
            filled: false,
            radius: 0.0,
        };
        match &item.shape {
            Shape::Path(segments) => line.lines = vec![sampled(segments)],
            Shape::Tube(segments, radius) => (line.lines, line.radius) = (vec![sampled(segments)], *radius),
            Shape::Lines(lines) => line.lines = lines.iter().map(|ends| ends.to_vec()).collect(),
            Shape::Polyline(points, closed) => (line.lines, line.closed) = (vec![points.clone()], *closed),
            Shape::Area(points) => (line.lines, line.closed, line.filled) = (vec![points.clone()], true, true),
            Shape::Dots(points) => line.dots = points,
        }
        line
    }
}

/// Points along a curve; a straight piece has its ends alone.
fn sampled(segments: &[Segment]) -> Vec<Point> {
    let mut points = Vec::new();
    for segment in segments {
        let count = if segment.points.len() == 2 { 2 } else { SAMPLES };
        points.extend(segment.samples(count).into_iter().skip(usize::from(!points.is_empty())));
    }
    points
}

/// The page. It refers to nothing outside itself.
pub fn html(scene: &Scene, report: &Report) -> String {
    let mut rules: Vec<&'static str> = scene.leaves.iter().map(|leaf| leaf.rule).collect();
    rules.sort_unstable();
    rules.dedup();
    let number = |rule: &str| rules.iter().position(|known| *known == rule).unwrap_or_default();
    let payload = Payload {
        dimension: scene.dimension,
        items: scene.drawn().into_iter().map(ItemLine::new).collect(),
        segments: scene
            .segments
            .iter()
            .map(|Segment { points, weights }| SegmentLine { points, weights })
            .collect(),
        leaves: scene
            .leaves
            .iter()
            .map(|leaf| (leaf.a, leaf.b, number(leaf.rule)))
            .collect(),
        rules: rules.clone(),
        frames: scene
            .frames
            .iter()
            .map(|(time, segments)| FrameLine {
                time: *time,
                line: sampled(segments),
            })
            .collect(),
        certificate: report.certificate.map(|bytes| STANDARD.encode(bytes)),
        file_name: report.file_name,
        checker: report.certificate.map(|_| STANDARD.encode(CHECKER)),
    };
    // "</script>" must not occur inside a script element; JSON may write "<" as an escape.
    let data = serde_json::to_string(&payload)
        .expect("numbers and texts can be written")
        .replace('<', "\\u003c");
    let statement: String = report
        .statement
        .iter()
        .map(|line| format!("<p>{}</p>\n", escape(line)))
        .collect();
    // One pass, so that nothing inside a text is taken for a place to fill in.
    let mut page = String::new();
    let mut rest = PAGE;
    while let Some((before, after)) = rest.split_once("{{") {
        page.push_str(before);
        let Some((name, after)) = after.split_once("}}") else {
            break;
        };
        match name {
            "title" => page.push_str(&escape(report.title)),
            "style" => page.push_str(STYLE),
            "statement" => page.push_str(&statement),
            "data" => page.push_str(&data),
            "viewer" => page.push_str(VIEWER),
            _ => unreachable!("the page names no other place"),
        }
        rest = after;
    }
    page.push_str(rest);
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_holds_everything_and_nothing_breaks_out_of_the_script() {
        let curve = crate::curve::read_curve(
            r#"{ "knotproof": "curve/1", "bezier": { "pieces": [ { "points": [[0,0],[1,2],[3,1]] } ] } }"#,
        )
        .unwrap()
        .curve;
        let statement = ["σ² = 1/3 & more {{data}}".to_string()];
        let report = Report {
            title: "</title><script>",
            statement: &statement,
            certificate: Some(b"KNOTCRT1 not really"),
            file_name: "</script>.cert",
        };
        let page = html(&Scene::of_curve(&curve), &report);
        assert_eq!(page, html(&Scene::of_curve(&curve), &report));
        assert_eq!(page.matches("</script>").count(), page.matches("<script").count());
        assert!(page.contains("σ² = 1/3 &amp; more {{data}}"));
        assert!(page.contains(&STANDARD.encode(b"KNOTCRT1 not really")));
        assert!(
            !page.contains("http://") && !page.contains("https://"),
            "no address outside"
        );
        assert!(page.len() < 1_500_000, "{}", page.len());
    }
}
