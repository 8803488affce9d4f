//! The attribute `transform`.

use super::angle::rotation;
use crate::import::build::{Point, RawPath};
use crate::import::text::{abs, number, small, whole};
use crate::number::{Meaning, Rational, sqrt_enclosure};

/// Bits to which bounds are computed.
const BOUND_BITS: u32 = 30;

/// An affine map (x, y) ↦ (ax + cy + e, bx + dy + f), as SVG writes it, with bounds of how far each number is from the one meant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Affine {
    /// a, b, c, d, e, f.
    numbers: [Rational; 6],
    /// Bounds of their errors, 0 unless a rotation had to be approximated.
    errors: [Rational; 6],
}

impl Affine {
    /// The identity.
    pub(super) fn identity() -> Affine {
        Affine::exact([1, 0, 0, 1, 0, 0].map(whole))
    }

    fn exact(numbers: [Rational; 6]) -> Affine {
        Affine {
            numbers,
            errors: std::array::from_fn(|_| whole(0)),
        }
    }

    /// Whether it is the map meant.
    pub(super) fn is_exact(&self) -> bool {
        self.errors.iter().all(|error| error.numer().is_zero())
    }

    /// This map after `first`.
    pub(super) fn after(&self, first: &Affine) -> Result<Affine, String> {
        let product = |p: &[Rational; 6], q: &[Rational; 6], shift: bool| {
            let cell = |i: usize, j: usize| {
                let linear = &p[i] * &q[j] + &p[2 + i] * &q[j + 1];
                if j == 4 && shift { linear + &p[4 + i] } else { linear }
            };
            [cell(0, 0), cell(1, 0), cell(0, 2), cell(1, 2), cell(0, 4), cell(1, 4)]
        };
        let numbers = product(&self.numbers, &first.numbers, true);
        let mut errors: [Rational; 6] = std::array::from_fn(|_| whole(0));
        if !self.is_exact() || !first.is_exact() {
            // |PQ − P'Q'| ≤ |P'| F + E (|Q'| + F), number by number; the last column of Q' has a 1 below it.
            let (p, q) = (self.numbers.each_ref().map(abs), first.numbers.each_ref().map(abs));
            let beyond: [Rational; 6] = std::array::from_fn(|i| &q[i] + &first.errors[i]);
            let one = product(&p, &first.errors, false);
            let other = product(&self.errors, &beyond, true);
            errors = std::array::from_fn(|i| &one[i] + &other[i]);
        }
        match numbers.iter().chain(&errors).all(small) {
            true => Ok(Affine { numbers, errors }),
            false => Err("found a transform of too long numbers".into()),
        }
    }

    /// The image of a point.
    fn apply(&self, point: &Point) -> Point {
        let n = &self.numbers;
        (0..2)
            .map(|i| &n[i] * &point[0] + &n[2 + i] * &point[1] + &n[4 + i])
            .collect()
    }

    /// Maps a path, and adds what is uncertain to its bound.
    pub(super) fn apply_to(&self, path: &mut RawPath) {
        let mut bound = whole(0);
        if let Some(before) = &path.bound {
            let norm = self.numbers[..4]
                .iter()
                .zip(&self.errors)
                .fold(whole(0), |sum, (n, e)| {
                    let most = abs(n) + e;
                    sum + &most * &most
                });
            bound += before * sqrt_enclosure(&norm, BOUND_BITS).1;
        }
        if !self.is_exact() {
            let mut most = [whole(0), whole(0)];
            for point in path.pieces.iter().flat_map(|piece| &piece.points) {
                for axis in 0..2 {
                    let size = abs(&point[axis]);
                    if size > most[axis] {
                        most[axis] = size;
                    }
                }
            }
            // The curve lies in the hull of its control points, on which the error is greatest at a corner of the box.
            let e = &self.errors;
            let square = (0..2).fold(whole(0), |sum, i| {
                let error = &e[i] * &most[0] + &e[2 + i] * &most[1] + &e[4 + i];
                sum + &error * &error
            });
            bound += sqrt_enclosure(&square, BOUND_BITS).1;
        }
        if path.bound.is_some() || !self.is_exact() {
            path.bound = Some(bound);
        }
        for point in path.pieces.iter_mut().flat_map(|piece| &mut piece.points) {
            *point = self.apply(point);
        }
    }
}

/// A fault in the text of the attribute: the byte and what is wrong.
pub(super) type Fault = (usize, String);

/// Reads a list of transforms.
pub(super) fn parse(text: &str, meaning: Meaning) -> Result<Affine, Fault> {
    let mut map = Affine::identity();
    let mut rest = text;
    loop {
        rest = rest.trim_start_matches([' ', '\t', '\r', '\n', ',']);
        if rest.is_empty() {
            return Ok(map);
        }
        let at = text.len() - rest.len();
        let (name, inside) = rest
            .split_once('(')
            .ok_or((at, format!("found {rest:?}, expected a transform such as \"scale(2)\"")))?;
        let (arguments, after) = inside.split_once(')').ok_or((at, "found no \")\"".to_string()))?;
        let numbers: Result<Vec<Rational>, String> = arguments
            .split([' ', '\t', '\r', '\n', ','])
            .filter(|word| !word.is_empty())
            .map(|word| number(word, meaning))
            .collect();
        let numbers = numbers.map_err(|message| (at, message))?;
        let one = transform(name.trim(), &numbers).map_err(|message| (at, message))?;
        map = map.after(&one).map_err(|message| (at, message))?;
        rest = after;
    }
}

/// One transform.
fn transform(name: &str, numbers: &[Rational]) -> Result<Affine, String> {
    let zero = || whole(0);
    let one = || whole(1);
    Ok(match (name, numbers) {
        ("matrix", [a, b, c, d, e, f]) => Affine::exact([a, b, c, d, e, f].map(Clone::clone)),
        ("translate", [x]) => Affine::exact([one(), zero(), zero(), one(), x.clone(), zero()]),
        ("translate", [x, y]) => Affine::exact([one(), zero(), zero(), one(), x.clone(), y.clone()]),
        ("scale", [s]) => Affine::exact([s.clone(), zero(), zero(), s.clone(), zero(), zero()]),
        ("scale", [x, y]) => Affine::exact([x.clone(), zero(), zero(), y.clone(), zero(), zero()]),
        ("rotate", [angle]) => {
            let turn = rotation(angle);
            let mut map = Affine::exact([
                turn.cosine.clone(),
                turn.sine.clone(),
                -&turn.sine,
                turn.cosine,
                zero(),
                zero(),
            ]);
            for error in &mut map.errors[..4] {
                *error = turn.error.clone();
            }
            map
        }
        ("rotate", [_, x, y]) => {
            let there = transform("translate", &[x.clone(), y.clone()])?;
            let back = transform("translate", &[-x, -y])?;
            there.after(&transform("rotate", &numbers[..1])?)?.after(&back)?
        }
        ("skewX" | "skewY", [angle]) => {
            let tangent = [(0, 0), (45, 1), (-45, -1)]
                .into_iter()
                .find(|(degrees, _)| *angle == whole(*degrees))
                .ok_or_else(|| {
                    format!("found {name} by {angle} degrees, expected 0, 45 or -45: others are not exact")
                })?;
            let tangent = whole(tangent.1);
            match name {
                "skewX" => Affine::exact([one(), zero(), tangent, one(), zero(), zero()]),
                _ => Affine::exact([one(), tangent, zero(), one(), zero(), zero()]),
            }
        }
        ("matrix" | "translate" | "scale" | "rotate" | "skewX" | "skewY", _) => {
            return Err(format!("found {} numbers in {name}", numbers.len()));
        }
        _ => {
            return Err(format!(
                "found the transform {name:?}, expected matrix, translate, scale, rotate, skewX or skewY"
            ));
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::build::polygon;
    use crate::import::text::ratio;

    fn image(text: &str, x: i64, y: i64) -> Point {
        parse(text, Meaning::Decimal).unwrap().apply(&vec![whole(x), whole(y)])
    }

    #[test]
    fn transforms_as_svg_defines_them() {
        for (text, expected) in [
            ("", [3, 5]),
            ("matrix(1 2 3 4 5 6)", [23, 32]),
            ("translate(10)", [13, 5]),
            ("translate(10,-1)", [13, 4]),
            ("scale(2)", [6, 10]),
            ("scale(2 -1)", [6, -5]),
            ("rotate(90)", [-5, 3]),
            ("rotate(-90 1 1)", [5, -1]),
            ("skewX(45)", [8, 5]),
            ("skewY(-45)", [3, 2]),
            // The last one acts first.
            ("translate(10) scale(2)", [16, 10]),
            ("scale(2), translate(10)", [26, 10]),
        ] {
            assert_eq!(image(text, 3, 5), expected.map(whole), "{text}");
            assert!(parse(text, Meaning::Decimal).unwrap().is_exact());
        }
        for text in [
            "rotate",
            "rotate(1 2)",
            "skewX(10)",
            "spin(3)",
            "scale(x)",
            "scale(1",
            "matrix(1)",
        ] {
            assert!(parse(text, Meaning::Decimal).is_err(), "{text}");
        }
    }

    #[test]
    fn approximated_rotations_carry_a_bound() {
        let map = parse(
            "translate(5 7) rotate(45) scale(1000) translate(-5 -7)",
            Meaning::Decimal,
        )
        .unwrap();
        assert!(!map.is_exact());
        let mut path = RawPath {
            pieces: polygon(&[vec![whole(5), whole(7)], vec![whole(6), whole(7)]], false),
            ..RawPath::default()
        };
        map.apply_to(&mut path);
        let bound = path.bound.expect("a bound");
        let end = &path.pieces[0].points[1];
        let half = (end[0].clone() - whole(5)) / whole(1000);
        // cos 45°: the square is 1/2 up to twice the error.
        let miss = abs(&(&half * &half - ratio(1, 2)));
        assert!(miss <= whole(2) * &bound / whole(1000), "{miss}");
        assert!(bound < ratio(1, 1_000_000));
    }
}
