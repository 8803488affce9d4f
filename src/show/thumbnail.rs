//! Small pictures of curves.

use std::fmt::Write;

use super::scene::Scene;
use super::segment::Segment;
use super::view::View;
use crate::curve::Curve;

/// The edge of the picture.
const SIZE: f64 = 64.0;
/// Room around the curve.
const MARGIN: f64 = 3.0;
/// So many points of a curve are drawn at most, as far as it has no more pieces.
const POINTS: usize = 192;

/// A curve in a square, as an element of an HTML page; in space, as seen from the direction (1, −2, 1). The line has the class `thumbnail`. `upside_down` is for
/// curves of files in which y grows downwards.
pub fn thumbnail(curve: &Curve, upside_down: bool) -> String {
    let segments = Scene::of_curve(curve).segments;
    let view = match curve.dimension() {
        2 => View::of_axes(0, 1),
        _ => View::from_direction([1.0, -2.0, 1.0]).unwrap_or_else(|| View::of_axes(0, 1)),
    };
    let each = (POINTS / segments.len().max(1)).clamp(2, 24);
    let points = segments.iter().enumerate().flat_map(|(i, segment)| {
        let samples = segment.samples(if is_edge(segment) { 2 } else { each });
        samples.into_iter().skip(usize::from(i > 0))
    });
    let flip = if upside_down { 1.0 } else { -1.0 };
    let places: Vec<[f64; 2]> = points
        .map(|point| view.project(&point))
        .map(|[x, y]| [x, flip * y])
        .collect();
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for place in &places {
        for axis in 0..2 {
            low[axis] = low[axis].min(place[axis]);
            high[axis] = high[axis].max(place[axis]);
        }
    }
    let side = (high[0] - low[0]).max(high[1] - low[1]);
    let scale = if side > 0.0 { (SIZE - 2.0 * MARGIN) / side } else { 1.0 };
    let mut path = String::new();
    for (i, place) in places.iter().enumerate() {
        let [x, y]: [f64; 2] =
            std::array::from_fn(|axis| SIZE / 2.0 + (place[axis] - (low[axis] + high[axis]) / 2.0) * scale);
        let letter = if i == 0 { "M" } else { "L" };
        // Writing to a string does not fail.
        let _ = write!(path, "{letter}{} {}", tenth(x), tenth(y));
    }
    format!("<svg class=\"thumbnail\" viewBox=\"0 0 {SIZE} {SIZE}\" aria-hidden=\"true\"><path d=\"{path}\"/></svg>")
}

fn is_edge(segment: &Segment) -> bool {
    segment.points.len() == 2
}

/// One decimal, none where it is 0.
fn tenth(x: f64) -> String {
    let text = format!("{x:.1}");
    text.strip_suffix(".0").map_or(text.clone(), String::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(text: &str, upside_down: bool) -> String {
        let file =
            format!("{{ \"knotproof\": \"curve/1\", \"bezier\": {{ \"pieces\": [ {{ \"points\": {text} }} ] }} }}");
        thumbnail(&crate::curve::read_curve(file).unwrap().curve, upside_down)
    }

    #[test]
    fn curves_fill_the_square() {
        assert!(
            path("[[0,0],[10,5]]", false).contains("d=\"M3 46.5L61 17.5\""),
            "{}",
            path("[[0,0],[10,5]]", false)
        );
        assert!(path("[[0,0],[10,5]]", true).contains("d=\"M3 17.5L61 46.5\""));
        let space = path("[[0,0,0],[1,0,0],[0,1,1],[3,1,2]]", false);
        assert_eq!(space.matches('L').count(), 23, "{space}");
        assert!(!space.contains("NaN"));
    }
}
