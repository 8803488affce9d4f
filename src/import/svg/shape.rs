//! The basic shapes: rect, circle, ellipse, line, polyline, polygon.

use super::transform::Fault;
use crate::import::Options;
use crate::import::build::{Point, RawPath, RawPiece, polygon};
use crate::import::text::{decimals, number, unit, whole};
use crate::number::{Meaning, Rational};

/// The attributes of a shape: the text of each, by its name.
pub(super) trait Attributes {
    /// The text of an attribute.
    fn text(&self, name: &str) -> Option<&str>;
}

/// A fault in an attribute.
pub(super) struct ShapeFault {
    /// The attribute, nothing for the shape as a whole.
    pub(super) attribute: &'static str,
    /// The byte in it, and what is wrong.
    pub(super) fault: Fault,
}

/// A length in user units; 0 when the attribute is not there.
fn length(attributes: &impl Attributes, name: &'static str, meaning: Meaning) -> Result<Option<Rational>, ShapeFault> {
    let Some(text) = attributes.text(name) else {
        return Ok(None);
    };
    let text = text.trim();
    if text == "auto" {
        return Ok(None);
    }
    let digits = text.strip_suffix("px").unwrap_or(text);
    number(digits, meaning).map(Some).map_err(|message| ShapeFault {
        attribute: name,
        fault: (0, format!("{message} (in user units or px)")),
    })
}

/// The path of a shape; nothing when it is not drawn.
pub(super) fn path(tag: &str, attributes: &impl Attributes, options: &Options) -> Result<Option<RawPath>, ShapeFault> {
    let meaning = options.meaning;
    let get = |name| Ok(length(attributes, name, meaning)?.unwrap_or_default());
    let size = |name: &'static str| -> Result<Option<Rational>, ShapeFault> {
        let value = length(attributes, name, meaning)?;
        match value.as_ref().is_some_and(|value| value.numer().is_negative()) {
            true => Err(ShapeFault {
                attribute: name,
                fault: (0, "found a negative size".into()),
            }),
            false => Ok(value.filter(|value| value.numer().is_positive())),
        }
    };
    let pieces = match tag {
        "line" => {
            let (a, b) = (vec![get("x1")?, get("y1")?], vec![get("x2")?, get("y2")?]);
            Some(vec![RawPiece::polynomial([a, b])])
        }
        "circle" => size("r")?
            .map(|r| Ok(ellipse(&get("cx")?, &get("cy")?, &r, &r)))
            .transpose()?,
        "ellipse" => {
            let (rx, ry) = (size("rx")?, size("ry")?);
            // One of the two alone stands for both.
            match (rx.clone().or(ry.clone()), ry.or(rx)) {
                (Some(rx), Some(ry)) => Some(ellipse(&get("cx")?, &get("cy")?, &rx, &ry)),
                _ => None,
            }
        }
        "rect" => match (size("width")?, size("height")?) {
            (Some(width), Some(height)) => {
                let (rx, ry) = (size("rx")?, size("ry")?);
                let (rx, ry) = (
                    rx.clone().or(ry.clone()).unwrap_or_default(),
                    ry.or(rx).unwrap_or_default(),
                );
                Some(rectangle(&get("x")?, &get("y")?, [&width, &height], [rx, ry]))
            }
            _ => None,
        },
        _ => return points(attributes.text("points").unwrap_or(""), tag == "polygon", meaning),
    };
    Ok(pieces.map(|pieces| RawPath {
        pieces,
        ..RawPath::default()
    }))
}

/// A quarter of an ellipse: from `from` by way of the corner `by` of its box to `to`.
fn quarter(from: Point, by: Point, to: Point) -> RawPiece {
    RawPiece {
        points: vec![from, by, to],
        weights: Some(vec![whole(1), whole(1), whole(2)]),
    }
}

fn ellipse(x: &Rational, y: &Rational, rx: &Rational, ry: &Rational) -> Vec<RawPiece> {
    let at = |i: i64, j: i64| vec![x + rx * whole(i), y + ry * whole(j)];
    [[1, 0, 0, 1], [0, 1, -1, 0], [-1, 0, 0, -1], [0, -1, 1, 0]]
        .map(|[i, j, k, l]| quarter(at(i, j), at(i + k, j + l), at(k, l)))
        .into()
}

/// As SVG prescribes: from the upper left corner along the top.
fn rectangle(x: &Rational, y: &Rational, size: [&Rational; 2], radii: [Rational; 2]) -> Vec<RawPiece> {
    let two = whole(2);
    let [rx, ry] = [0, 1].map(|axis| {
        let most = size[axis] / &two;
        let radius = radii[axis].clone();
        if radius > most { most } else { radius }
    });
    let (right, bottom) = (x + size[0], y + size[1]);
    let corners = [(x, y), (&right, y), (&right, &bottom), (x, &bottom)];
    let corner = |i: usize| vec![corners[i % 4].0.clone(), corners[i % 4].1.clone()];
    if rx.numer().is_zero() || ry.numer().is_zero() {
        return polygon(&[corner(0), corner(1), corner(2), corner(3)], true);
    }
    // Where the sides leave the corners, and where they reach the next ones.
    let (left_in, right_in) = (x + &rx, &right - &rx);
    let (top_in, bottom_in) = (y + &ry, &bottom - &ry);
    let sides = [
        [(&left_in, y), (&right_in, y)],
        [(&right, &top_in), (&right, &bottom_in)],
        [(&right_in, &bottom), (&left_in, &bottom)],
        [(x, &bottom_in), (x, &top_in)],
    ];
    let at = |(x, y): (&Rational, &Rational)| vec![x.clone(), y.clone()];
    let mut pieces = Vec::new();
    for i in 0..4 {
        let (from, to) = (at(sides[i][0]), at(sides[i][1]));
        // With the greatest radius there is no straight part.
        if from != to {
            pieces.push(RawPiece::polynomial([from, to.clone()]));
        }
        pieces.push(quarter(to, corner(i + 1), at(sides[(i + 1) % 4][0])));
    }
    pieces
}

/// The points of a polyline or polygon.
fn points(text: &str, closed: bool, meaning: Meaning) -> Result<Option<RawPath>, ShapeFault> {
    let fault = |at, message| ShapeFault {
        attribute: "points",
        fault: (at, message),
    };
    let mut numbers = Vec::new();
    let mut most = 0;
    for word in text.split([' ', '\t', '\r', '\n', ',']).filter(|word| !word.is_empty()) {
        // Both are parts of one text.
        let at = word.as_ptr() as usize - text.as_ptr() as usize;
        numbers.push(number(word, meaning).map_err(|message| fault(at, message))?);
        most = most.max(decimals(word));
    }
    if numbers.len() % 2 == 1 {
        return Err(fault(
            text.len(),
            format!("found {} numbers, expected pairs", numbers.len()),
        ));
    }
    let points: Vec<Point> = numbers.chunks(2).map(<[Rational]>::to_vec).collect();
    let mut pieces = polygon(&points, closed);
    let closing_line = closed && points.len() > 2 && points.first() != points.last();
    if closed && points.len() > 2 && !closing_line {
        pieces.pop();
    }
    Ok((!pieces.is_empty()).then(|| RawPath {
        pieces,
        closing_line,
        unit: Some(unit(most)),
        ..RawPath::default()
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Joint;
    use crate::import::build::finish;

    struct List<'a>(&'a [(&'a str, &'a str)]);

    impl Attributes for List<'_> {
        fn text(&self, name: &str) -> Option<&str> {
            self.0.iter().find(|(key, _)| *key == name).map(|(_, value)| *value)
        }
    }

    fn read(tag: &str, attributes: &[(&str, &str)]) -> Result<Option<RawPath>, String> {
        path(tag, &List(attributes), &Options::default())
            .map_err(|fault| format!("{}: {}", fault.attribute, fault.fault.1))
    }

    #[test]
    fn circles_are_exact() {
        let path = read("circle", &[("cx", "12"), ("cy", "-1"), ("r", "2.5px")])
            .unwrap()
            .unwrap();
        let curve = finish(path, &Options::default()).unwrap().unwrap().0;
        assert!(curve.is_closed());
        let chain = curve.chain();
        for k in 0..16 {
            let t = crate::import::text::ratio(k, 4);
            let p = chain.evaluate(&t).unwrap();
            let (x, y) = (&p[0] - whole(12), &p[1] + whole(1));
            assert_eq!(&x * &x + &y * &y, crate::import::text::ratio(25, 4));
        }
        for i in 0..4 {
            assert_eq!(chain.joint(i), Some(Joint::Smooth));
        }
    }

    #[test]
    fn other_shapes() {
        let rect = |more: &[(&'static str, &'static str)]| {
            let mut all = vec![("width", "10"), ("height", "4")];
            all.extend(more);
            read("rect", &all).unwrap().unwrap().pieces.len()
        };
        assert_eq!(rect(&[]), 4);
        assert_eq!(rect(&[("rx", "1")]), 8);
        // More than half the height: no straight part at the sides.
        assert_eq!(rect(&[("rx", "1"), ("ry", "9")]), 6);
        assert_eq!(rect(&[("rx", "auto"), ("ry", "3")]), 6);
        assert_eq!(
            read("polygon", &[("points", "0,0 1,0 1,1")])
                .unwrap()
                .unwrap()
                .pieces
                .len(),
            3
        );
        assert_eq!(
            read("polygon", &[("points", "0,0 1,0 1,1 0 0")])
                .unwrap()
                .unwrap()
                .pieces
                .len(),
            3
        );
        assert_eq!(
            read("polyline", &[("points", "0,0 1,0 1,1")])
                .unwrap()
                .unwrap()
                .pieces
                .len(),
            2
        );
        assert_eq!(read("line", &[("x2", "5")]).unwrap().unwrap().pieces.len(), 1);
        assert_eq!(read("ellipse", &[("rx", "5")]).unwrap().unwrap().pieces.len(), 4);
        for tag in ["circle", "ellipse", "rect", "polyline"] {
            assert!(read(tag, &[]).unwrap().is_none(), "{tag}");
        }
        for (tag, name, value) in [
            ("circle", "r", "-1"),
            ("circle", "r", "50%"),
            ("rect", "width", "2em"),
            ("polygon", "points", "1 2 3"),
            ("polygon", "points", "1 x"),
        ] {
            assert!(read(tag, &[(name, value)]).unwrap_err().starts_with(name), "{value}");
        }
    }
}
