//! Outlines of the table `glyf`: quadratics with points between that are not written, and glyphs made of glyphs.

use read_fonts::tables::glyf::{Anchor, CompositeGlyphFlags, Glyf, Glyph, SimpleGlyph};
use read_fonts::tables::loca::{Loca, LocaGlyph};
use read_fonts::types::{F2Dot14, GlyphId};
use read_fonts::{FontRef, ReadError, TableProvider};

use super::Outlines;
use crate::import::build::{Point, RawPath, RawPiece};
use crate::import::text::{ratio, whole};
use crate::number::{Rational, exact_sqrt};

/// How deep glyphs may be made of glyphs.
const DEEPEST: usize = 8;

/// The outlines of a font.
pub(super) struct Glyphs<'a> {
    loca: Loca<'a>,
    glyf: Glyf<'a>,
    /// Whether the font may use cubics in this table, which are not read.
    cubics: bool,
}

/// A point of a contour, and whether the curve passes through it.
type Mark = (Point, bool);

impl<'a> Glyphs<'a> {
    pub(super) fn new(font: &FontRef<'a>) -> Result<Glyphs<'a>, ReadError> {
        Ok(Glyphs {
            loca: font.loca(None)?,
            glyf: font.glyf()?,
            cubics: font.head()?.glyph_data_format() != 0,
        })
    }

    /// The points of a glyph, contour by contour.
    fn marks(&self, glyph: u32, depth: usize, budget: &mut usize) -> Result<Vec<Vec<Mark>>, String> {
        let found = self.loca.get(GlyphId::new(glyph), &self.glyf);
        let found = match found.ok_or_else(|| format!("found no readable outline of glyph {glyph}"))? {
            LocaGlyph::Empty => return Ok(Vec::new()),
            LocaGlyph::Glyph(found) => found,
        };
        let composite = match found {
            Glyph::Simple(simple) => return self.simple(&simple, budget),
            Glyph::Composite(composite) => composite,
        };
        if depth == 0 {
            return Err(format!("found a glyph made of glyphs more than {DEEPEST} deep"));
        }
        let mut contours: Vec<Vec<Mark>> = Vec::new();
        for component in composite.components() {
            *budget = budget
                .checked_sub(1)
                .ok_or("found too many points in all glyphs together")?;
            let mut part = self.marks(component.glyph.to_u32(), depth - 1, budget)?;
            let fixed = |value: F2Dot14| ratio(i64::from(value.to_bits()), 1 << 14);
            let map = &component.transform;
            let [xx, yx, xy, yy] = [map.xx, map.yx, map.xy, map.yy].map(fixed);
            for (point, _) in part.iter_mut().flatten() {
                *point = vec![&xx * &point[0] + &xy * &point[1], &yx * &point[0] + &yy * &point[1]];
            }
            let offset = match component.anchor {
                Anchor::Offset { x, y } => {
                    let (x, y) = (whole(i64::from(x)), whole(i64::from(y)));
                    match component.flags.contains(CompositeGlyphFlags::SCALED_COMPONENT_OFFSET) {
                        true => [x * length(&xx, &xy)?, y * length(&yx, &yy)?],
                        false => [x, y],
                    }
                }
                Anchor::Point { base, component } => {
                    let at = |list: &[Vec<Mark>], index: u16| {
                        let found = list.iter().flatten().nth(usize::from(index));
                        found.map(|(point, _)| point.clone())
                    };
                    let (there, here) = (at(&contours, base), at(&part, component));
                    let (there, here) = there
                        .zip(here)
                        .ok_or("found a component placed by points that are not there")?;
                    [&there[0] - &here[0], &there[1] - &here[1]]
                }
            };
            for (point, _) in part.iter_mut().flatten() {
                for axis in 0..2 {
                    point[axis] += &offset[axis];
                }
            }
            contours.extend(part);
        }
        Ok(contours)
    }

    fn simple(&self, glyph: &SimpleGlyph, budget: &mut usize) -> Result<Vec<Vec<Mark>>, String> {
        let points: Vec<_> = glyph.points().collect();
        if points.len() != glyph.num_points() {
            return Err("found fewer points than the contours have".into());
        }
        *budget = budget
            .checked_sub(points.len())
            .ok_or("found too many points in all glyphs together")?;
        if self.cubics && points.iter().any(|point| point.cubic && !point.on_curve) {
            return Err("found cubics in the table glyf, expected quadratics".into());
        }
        let mut contours = Vec::new();
        let mut start = 0;
        for end in glyph.end_pts_of_contours() {
            let end = usize::from(end.get()) + 1;
            let contour = points
                .get(start..end)
                .ok_or("found contours whose ends do not increase")?;
            let mark = |x: i16, y: i16, on| (vec![whole(i64::from(x)), whole(i64::from(y))], on);
            contours.push(contour.iter().map(|p| mark(p.x, p.y, p.on_curve)).collect());
            start = end;
        }
        Ok(contours)
    }
}

/// The length of a row of a component's matrix, by which its offset is scaled.
fn length(a: &Rational, b: &Rational) -> Result<Rational, String> {
    exact_sqrt(&(a * a + b * b))
        .ok_or_else(|| "found a component's offset scaled by a number that is no fraction".into())
}

impl Outlines for Glyphs<'_> {
    fn contours(&self, glyph: u32, budget: &mut usize) -> Result<Vec<RawPath>, String> {
        let contours = self.marks(glyph, DEEPEST, budget)?;
        Ok(contours.iter().map(|marks| contour(marks)).collect())
    }
}

fn middle(a: &Point, b: &Point) -> Point {
    a.iter().zip(b).map(|(a, b)| (a + b) * ratio(1, 2)).collect()
}

/// Lines between points on the curve, quadratics around those off it; between two of these the curve passes through the middle.
fn contour(marks: &[Mark]) -> RawPath {
    let mut path = RawPath::default();
    let Some((first, first_on)) = marks.first() else {
        return path;
    };
    let n = marks.len();
    // The start: a point on the curve, or the middle of the last and the first.
    let on = marks.iter().position(|(_, on)| *on);
    let start = match on {
        Some(at) => marks[at].0.clone(),
        None => middle(&marks[n - 1].0, first),
    };
    debug_assert!(on.is_some() || !first_on);
    let begin = on.map_or(0, |at| at + 1);
    let mut at = start.clone();
    let mut control: Option<Point> = None;
    let last = (start, true);
    // Once around, the start again at the end.
    let rest = (0..n - usize::from(on.is_some())).map(|k| &marks[(begin + k) % n]);
    for (point, on) in rest.chain([&last]) {
        let (from, by) = match (control.take(), *on) {
            (None, false) => {
                control = Some(point.clone());
                continue;
            }
            (None, true) => (std::mem::replace(&mut at, point.clone()), None),
            (Some(by), true) => (std::mem::replace(&mut at, point.clone()), Some(by)),
            (Some(by), false) => {
                let to = middle(&by, point);
                control = Some(point.clone());
                (std::mem::replace(&mut at, to), Some(by))
            }
        };
        let to = at.clone();
        path.pieces.push(match by {
            None => RawPiece::polynomial([from, to]),
            Some(by) => RawPiece::polynomial([from, by, to]),
        });
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(marks: &[(i64, i64, bool)]) -> String {
        let marks: Vec<Mark> = marks
            .iter()
            .map(|(x, y, on)| (vec![whole(*x), whole(*y)], *on))
            .collect();
        let path = contour(&marks);
        let pieces = path.pieces.iter().map(|piece| {
            let points = piece.points.iter().map(|p| format!("{},{}", p[0], p[1]));
            points.collect::<Vec<_>>().join(" ")
        });
        pieces.collect::<Vec<_>>().join("; ")
    }

    #[test]
    fn contours_with_points_that_are_not_written() {
        for (marks, expected) in [
            (
                &[(0, 0, true), (2, 0, true), (2, 2, true)][..],
                "0,0 2,0; 2,0 2,2; 2,2 0,0",
            ),
            (&[(0, 0, true), (2, 0, false), (2, 2, true)], "0,0 2,0 2,2; 2,2 0,0"),
            (
                &[(0, 0, true), (2, 0, false), (2, 2, false)],
                "0,0 2,0 2,1; 2,1 2,2 0,0",
            ),
            (&[(2, 0, false), (2, 2, true), (0, 0, true)], "2,2 0,0; 0,0 2,0 2,2"),
            (
                &[(1, 0, false), (0, 1, false), (-1, 0, false), (0, -1, false)],
                "1/2,-1/2 1,0 1/2,1/2; 1/2,1/2 0,1 -1/2,1/2; -1/2,1/2 -1,0 -1/2,-1/2; -1/2,-1/2 0,-1 1/2,-1/2",
            ),
            (&[(1, 1, true)], "1,1 1,1"),
            (&[(1, 1, false)], "1,1 1,1 1,1"),
            (&[], ""),
        ] {
            assert_eq!(read(marks), expected);
        }
    }
}
