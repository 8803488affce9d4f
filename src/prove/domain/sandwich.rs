//! Two polytopes, one inside K ∩ B and one around it, refined where they differ.
//!
//! The outer one is the box cut by rows h_t ≥ 0. Rays from a center in K through its vertices leave K at points that span the inner one, and the parameters
//! at which they leave it give the next rows. Everything is found in binary64 on exact combinatorics; the evidence is rounded to a grid, the inner points a little
//! towards the center and the outer ones a little away from it, and then checked exactly.

use std::collections::BTreeMap;
use std::time::Instant;

use num_traits::Signed;

use super::parts::{Hit, Parts};
use crate::check::domain::Context;
use crate::check::domain::star::measure;
use crate::check::polynomial::Bound;
use crate::claim::domain::{Evidence, Row, Star};
use crate::number::{Integer, Rational, RationalExt, RationalVector};
use crate::polytope::{Clip, HalfSpace, Polytope, hull2, hull3};

/// What is given for rounding, as a part of the tolerance.
const ROUNDING: f64 = 1.0 / 128.0;
/// Rounding is never finer than this part.
const FINEST_ROUNDING: f64 = 1e-13;
/// How often an inner point is pulled in further before the search gives up on it.
const PULLS: i32 = 9;
/// How often the grid is refined when cells collapse on it.
const GRIDS: u32 = 6;

/// One round of the refinement.
#[derive(Clone, Debug)]
pub struct Round {
    /// Rows h_t ≥ 0 of the outer polytope.
    pub inequalities: usize,
    /// Vertices of the outer polytope.
    pub vertices: usize,
    /// Facets of the outer polytope.
    pub facets: usize,
    /// Points that span the inner polytope.
    pub inner_points: usize,
    /// Estimates of the measures in binary64.
    pub estimates: [f64; 2],
    /// The measures after rounding and exact checks, if they were asked for and found.
    pub measures: Option<[Rational; 2]>,
    /// Seconds since the beginning.
    pub seconds: f64,
}

/// A checked pair of polytopes.
#[derive(Clone, Debug)]
pub struct Sandwich {
    /// The evidence, not yet seen by the checker as a whole.
    pub evidence: Evidence,
    /// Measures of the two stars.
    pub inner_measure: Rational,
    /// See `inner_measure`.
    pub outer_measure: Rational,
}

impl Sandwich {
    /// Is (outer − inner)/inner at most this?
    pub fn within(&self, tolerance: &Rational) -> bool {
        &self.outer_measure - &self.inner_measure <= &self.inner_measure * tolerance
    }
}

/// The search for a sandwich in D dimensions.
pub struct Search<'a, const D: usize> {
    context: &'a Context<'a>,
    center: [Rational; D],
    parts: Parts,
    rows: Vec<Row>,
    /// The parameters of rows of each section that are taken, as 64-bit fractions.
    taken: Vec<BTreeMap<u64, ()>>,
    polytope: Polytope<D>,
    tolerance: f64,
    measure_rounds: bool,
    started: Instant,
}

/// The outer polytope's vertices and the rays through them, and rays through its facets.
struct Rays<const D: usize> {
    /// The vertices relative to the center.
    vertices: Vec<[f64; D]>,
    hits: Vec<Hit>,
    /// Ends of all rays in cl K, relative to the center.
    inner: Vec<[f64; D]>,
}

/// Where a parameter is taken as a fraction of 2^63.
const WHOLE: u64 = 1 << 63;

impl<'a, const D: usize> Search<'a, D> {
    /// Begins with the box and rows at the ends and middles of all sections; `None` if the center is not shown in K and inside the box.
    pub fn new(context: &'a Context<'a>, center: [Rational; D], tolerance: f64, measure_rounds: bool) -> Option<Self> {
        let bounds = &context.domain.bounds;
        let corner = |corner: &[Rational]| -> Option<[Rational; D]> { corner.to_vec().try_into().ok() };
        let integers = RationalVector::from_rationals(&center);
        let rows = (0..2 * D).map(|side| Row::Side {
            axis: side / 2,
            high: side % 2 == 1,
        });
        let mut search = Search {
            context,
            parts: Parts::new(context, integers.numerators(), integers.denominator())?,
            center,
            rows: rows.collect(),
            taken: vec![BTreeMap::new(); context.sections.len()],
            polytope: Polytope::from_box(&corner(&bounds.low)?, &corner(&bounds.high)?)?,
            tolerance,
            measure_rounds,
            started: Instant::now(),
        };
        for section in 0..context.sections.len() {
            for at in [0, WHOLE, WHOLE / 2] {
                search.add_row(section, at);
            }
        }
        Some(search)
    }

    /// Rows h_t ≥ 0 so far.
    pub fn inequalities(&self) -> usize {
        self.rows.len() - 2 * D
    }

    /// Adds the row at a parameter of a section, unless it is there; the polytope stays as it is if the row does not cut it.
    fn add_row(&mut self, section: usize, at: u64) -> bool {
        if self.taken[section].insert(at, ()).is_some() {
            return false;
        }
        let sign = &self.context.sections[section];
        let v = Rational::new(Integer::from(at), Integer::from(WHOLE));
        let u = &sign.ends[0] + v * (&sign.ends[1] - &sign.ends[0]);
        let Some((affine, _)) = sign.row(&u) else { return false };
        let Ok(normal) = affine.linear.try_into() else {
            return false;
        };
        let half_space = HalfSpace {
            normal,
            constant: affine.constant,
        };
        if self.polytope.clip(&half_space, self.rows.len()) != Clip::Cut {
            return false;
        }
        self.rows.push(Row::Parameter { piece: sign.piece, u });
        true
    }

    /// Refines until the estimate of the relative error is within `target`, no row helps any more, or there are `budget` rows. `moved` lets the center move to the
    /// middle of the inner polytope first.
    pub fn refine(&mut self, target: f64, budget: usize, rounds: &mut Vec<Round>) -> bool {
        loop {
            let rays = self.rays();
            let Some(inner) = self.hull(&rays.inner) else {
                return false;
            };
            let inner_measure: f64 = inner
                .iter()
                .map(|cell| volume(cell.iter().map(|v| rays.inner[*v])))
                .sum();
            let cells = self.outer_cells();
            let outer_measure: f64 = cells
                .iter()
                .map(|(cell, _)| volume(cell.iter().map(|v| rays.vertices[*v])))
                .sum();
            rounds.push(Round {
                inequalities: self.inequalities(),
                vertices: self.polytope.vertex_count(),
                facets: self.polytope.facet_count(),
                inner_points: rays.inner.len(),
                estimates: [inner_measure, outer_measure],
                measures: match self.measure_rounds {
                    true => self
                        .evidence()
                        .ok()
                        .map(|found| [found.inner_measure, found.outer_measure]),
                    false => None,
                },
                seconds: self.started.elapsed().as_secs_f64(),
            });
            if outer_measure - inner_measure <= target * inner_measure {
                return true;
            }
            if self.inequalities() >= budget {
                return false;
            }
            if rounds.len() <= 2 {
                self.move_center(&inner, &rays.inner);
            }
            let worth = target * inner_measure / (4.0 * rays.vertices.len() as f64);
            if !self.cut(&rays, &cells, worth) {
                return false;
            }
        }
    }

    fn rays(&self) -> Rays<D> {
        let center = self.center.each_ref().map(RationalExt::to_f64);
        let vertices: Vec<[f64; D]> = (0..self.polytope.vertex_count())
            .map(|v| {
                let (point, _) = self.polytope.vertex_approximation(v);
                std::array::from_fn(|axis| point[axis] - center[axis])
            })
            .collect();
        let tolerance = (self.tolerance * ROUNDING / 8.0).max(1e-14);
        let hits: Vec<Hit> = vertices.iter().map(|arm| self.parts.hit(arm, tolerance)).collect();
        let end = |arm: &[f64; D], hit: &Hit| arm.map(|x| x / hit.ratio.max(1.0));
        let mut inner: Vec<[f64; D]> = vertices.iter().zip(&hits).map(|(arm, hit)| end(arm, hit)).collect();
        for facet in self.polytope.facets() {
            if facet.row < 2 * D || facet.vertices.iter().all(|v| hits[*v].ratio <= 1.0 + tolerance) {
                continue;
            }
            let count = facet.vertices.len() as f64;
            let middle =
                std::array::from_fn(|axis| facet.vertices.iter().map(|v| vertices[*v][axis]).sum::<f64>() / count);
            inner.push(end(&middle, &self.parts.hit(&middle, tolerance)));
        }
        Rays { vertices, hits, inner }
    }

    /// Triangles (edges in the plane) of the hull of points given relative to the center.
    fn hull(&self, points: &[[f64; D]]) -> Option<Vec<Vec<usize>>> {
        let points: Option<Vec<[Rational; D]>> = points
            .iter()
            .map(|point| {
                let mut exact = Vec::with_capacity(D);
                for x in point {
                    exact.push(Rational::from_f64(*x)?);
                }
                exact.try_into().ok()
            })
            .collect();
        hull(
            &points?,
            &std::array::from_fn(|_| Rational::from_integer(Integer::ZERO)),
        )
    }

    /// The facets of the outer polytope cut into triangles, with their rows.
    fn outer_cells(&self) -> Vec<(Vec<usize>, usize)> {
        let mut cells = Vec::new();
        for facet in self.polytope.facets() {
            let v = &facet.vertices;
            if D == 2 {
                cells.push((v.clone(), facet.row));
                continue;
            }
            for pair in v[1..].windows(2) {
                cells.push((vec![v[0], pair[0], pair[1]], facet.row));
            }
        }
        cells
    }

    /// Moves the center to the centroid of the inner polytope, roughly, if that is shown to be in K.
    fn move_center(&mut self, cells: &[Vec<usize>], points: &[[f64; D]]) {
        let mut sum = [0.0; D];
        let mut total = 0.0;
        for cell in cells {
            let size = volume(cell.iter().map(|v| points[*v]));
            total += size;
            for axis in 0..D {
                sum[axis] += size * cell.iter().map(|v| points[*v][axis]).sum::<f64>() / (D + 1) as f64;
            }
        }
        // As coarse as the distance to the boundary allows.
        let near = cells
            .iter()
            .flatten()
            .map(|v| points[*v].iter().map(|x| x * x).sum::<f64>().sqrt());
        let grid = 2f64.powf((near.fold(f64::INFINITY, f64::min) / 64.0).log2().floor());
        let moved: Option<Vec<Rational>> = (0..D)
            .map(|axis| {
                let absolute = self.center[axis].to_f64() + sum[axis] / total;
                Rational::from_f64((absolute / grid).round() * grid)
            })
            .collect();
        let Some(moved) = moved.and_then(|moved| <[Rational; D]>::try_from(moved).ok()) else {
            return;
        };
        let integers = RationalVector::from_rationals(&moved);
        let (point, denominator) = (integers.numerators(), integers.denominator());
        let inside = strictly_in_box(self.context, &moved);
        if inside
            && self.context.show(point, denominator, Bound::Positive).is_ok()
            && let Some(parts) = Parts::new(self.context, point, denominator)
        {
            self.parts = parts;
            self.center = moved;
        }
    }

    /// Adds rows where the polytopes differ by more than `worth`; false if none cuts.
    fn cut(&mut self, rays: &Rays<D>, cells: &[(Vec<usize>, usize)], worth: f64) -> bool {
        let mut share = vec![0.0; rays.vertices.len()];
        for (cell, _) in cells {
            let size = volume(cell.iter().map(|v| rays.vertices[*v]));
            for v in cell {
                share[*v] += size / D as f64;
            }
        }
        let gap = |v: usize| share[v] * (1.0 - rays.hits[v].ratio.max(1.0).powi(-(D as i32)));
        let mut candidates: Vec<(f64, usize)> = (0..share.len()).map(|v| (gap(v), v)).collect();
        candidates.retain(|(gap, v)| rays.hits[*v].ratio > 1.0 && *gap > worth);
        candidates.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let before = self.taken.clone();
        let mut any = false;
        for (_, v) in candidates {
            let hit = rays.hits[v];
            let at = (hit.at * WHOLE as f64) as u64;
            let near = |taken: &BTreeMap<u64, ()>| {
                let below = taken.range(..=at).next_back().map_or(0, |(x, ())| *x);
                let above = taken.range(at..).next().map_or(WHOLE, |(x, ())| *x);
                (below, above)
            };
            let (below, above) = near(&before[hit.section]);
            let spacing = above - below;
            let (newer_below, newer_above) = near(&self.taken[hit.section]);
            let crowded = |x: u64, old: u64| x != old && at.abs_diff(x) < spacing / 8;
            if crowded(newer_below, below) || crowded(newer_above, above) {
                continue;
            }
            // As short as the spacing allows; the row moves by the square of the rounding.
            let step = (spacing / 64).max(1 << 14).next_power_of_two();
            let rounded = ((at + step / 2) / step * step).min(WHOLE);
            any |= self.add_row(hit.section, rounded) || self.add_row(hit.section, at);
        }
        any
    }

    /// Rounds the polytopes to a grid, checks the inner points exactly, and measures both.
    ///
    /// # Errors
    /// What could not be shown.
    pub fn evidence(&self) -> Result<Sandwich, String> {
        let rays = self.rays();
        let rounding = (self.tolerance * ROUNDING / D as f64).max(FINEST_ROUNDING);
        let nearest = self.inradius(&rays);
        if nearest.is_nan() || nearest <= 0.0 {
            return Err("the center is on the boundary".into());
        }
        let mut bits = -(rounding * nearest / 4.0).log2().floor() as i64;
        let mut failure = String::new();
        for _ in 0..GRIDS {
            match self.on_grid(&rays, rounding, bits.max(1) as u32) {
                Ok(sandwich) => return Ok(sandwich),
                Err(why) => failure = why,
            }
            bits += 20;
        }
        Err(failure)
    }

    /// A lower estimate of the distance from the center to the boundary of the outer polytope.
    fn inradius(&self, rays: &Rays<D>) -> f64 {
        let inner = rays
            .inner
            .iter()
            .map(|arm| arm.iter().map(|x| x * x).sum::<f64>().sqrt());
        inner.fold(f64::INFINITY, f64::min) / 16.0
    }

    fn on_grid(&self, rays: &Rays<D>, rounding: f64, bits: u32) -> Result<Sandwich, String> {
        // The center's own denominator may not be a power of two.
        let center_over = RationalVector::from_rationals(&self.center).denominator().clone();
        let denominator = center_over << bits;
        let grid = Rational::from_integer(denominator.clone());
        let center: Vec<Integer> = self.center.iter().map(|x| (x * &grid).to_integer()).collect();
        let mut inner = Vec::with_capacity(rays.inner.len());
        for arm in &rays.inner {
            let pulled = (0..PULLS).find_map(|pull| {
                let factor = 1.0 - rounding * 8f64.powi(pull);
                let point = self.on(&center, arm, factor, &grid)?;
                let shown = factor > 0.0
                    && self.context.in_box(&point, &denominator)
                    && self.context.show(&point, &denominator, Bound::NonNegative).is_ok();
                shown.then_some(point)
            });
            // A point that cannot be shown is left out; the hull says whether the others suffice.
            inner.extend(pulled);
        }
        let points: Vec<[Rational; D]> = inner
            .iter()
            .map(|point| std::array::from_fn(|axis| Rational::from_integer(&point[axis] - &center[axis])))
            .collect();
        let origin = std::array::from_fn(|_| Rational::from_integer(Integer::ZERO));
        let cells = hull(&points, &origin).ok_or("the inner points do not surround the center")?;
        let inner = compact(inner, cells);
        let inner_measure = measure(&inner, &center, &denominator).map_err(|error| format!("inner: {error:?}"))?;

        let push = Rational::from_f64(1.0 + rounding).ok_or("no rounding")?;
        let outer_points: Vec<Vec<Integer>> = (0..self.polytope.vertex_count())
            .map(|v| {
                let vertex = self.polytope.vertex(v);
                (0..D)
                    .map(|axis| {
                        let pushed = &self.center[axis] + (&vertex[axis] - &self.center[axis]) * &push;
                        (pushed * &grid).round().to_integer()
                    })
                    .collect()
            })
            .collect();
        let cells = self.outer_cells();
        let used: BTreeMap<usize, usize> = {
            let mut rows: Vec<usize> = cells.iter().map(|(_, row)| *row).collect();
            rows.sort_unstable();
            rows.dedup();
            rows.into_iter().enumerate().map(|(new, old)| (old, new)).collect()
        };
        let rows: Vec<Row> = used.keys().map(|row| self.rows[*row].clone()).collect();
        let (cells, cell_rows): (Vec<Vec<usize>>, Vec<usize>) =
            cells.into_iter().map(|(cell, row)| (cell, used[&row])).unzip();
        for (cell, row) in cells.iter().zip(&cell_rows) {
            let exact = self.context.row(&rows[*row]).ok_or("a row that is none")?;
            if cell
                .iter()
                .any(|v| exact.affine.at(&outer_points[*v], &denominator).is_positive())
            {
                return Err("an outer point within its row".into());
            }
        }
        let outer = Star {
            points: outer_points,
            cells,
        };
        let outer_measure = measure(&outer, &center, &denominator).map_err(|error| format!("outer: {error:?}"))?;
        Ok(Sandwich {
            evidence: Evidence::Sandwich {
                denominator,
                center,
                inner,
                outer,
                rows,
                cell_rows,
            },
            inner_measure,
            outer_measure,
        })
    }

    /// center + factor·arm, rounded to the grid.
    fn on(&self, center: &[Integer], arm: &[f64; D], factor: f64, grid: &Rational) -> Option<Vec<Integer>> {
        center
            .iter()
            .zip(arm)
            .map(|(c, x)| Some(c + (Rational::from_f64(x * factor)? * grid).round().to_integer()))
            .collect()
    }
}

/// Without the points that no cell names.
fn compact(points: Vec<Vec<Integer>>, mut cells: Vec<Vec<usize>>) -> Star {
    let mut number = vec![usize::MAX; points.len()];
    let mut kept = Vec::new();
    for v in cells.iter_mut().flatten() {
        if number[*v] == usize::MAX {
            number[*v] = kept.len();
            kept.push(points[*v].clone());
        }
        *v = number[*v];
    }
    Star { points: kept, cells }
}

/// The boundary of the hull as cells; `None` if `interior` is not inside it.
fn hull<const D: usize>(points: &[[Rational; D]], interior: &[Rational; D]) -> Option<Vec<Vec<usize>>> {
    if D == 2 {
        let flat = |p: &[Rational; D]| [p[0].clone(), p[1].clone()];
        let points: Vec<[Rational; 2]> = points.iter().map(flat).collect();
        let cycle = hull2(&points, &flat(interior)).ok()?;
        let next = cycle.iter().cycle().skip(1);
        return Some(cycle.iter().zip(next).map(|(a, b)| vec![*a, *b]).collect());
    }
    let spatial = |p: &[Rational; D]| [p[0].clone(), p[1].clone(), p[2].clone()];
    let points: Vec<[Rational; 3]> = points.iter().map(spatial).collect();
    let triangles = hull3(&points, &spatial(interior)).ok()?;
    Some(triangles.into_iter().map(|triangle| triangle.to_vec()).collect())
}

/// The measure of the simplex of the origin and D points.
fn volume<const D: usize>(points: impl Iterator<Item = [f64; D]>) -> f64 {
    let p: Vec<[f64; D]> = points.collect();
    if D == 2 {
        return (p[0][0] * p[1][1] - p[0][1] * p[1][0]) / 2.0;
    }
    let [a, b, c] = [p[0], p[1], p[2]];
    (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6.0
}

/// Is a point inside the box and on none of its sides?
pub fn strictly_in_box(context: &Context, point: &[Rational]) -> bool {
    let bounds = &context.domain.bounds;
    let positive = |x: Rational| x.is_positive();
    (0..point.len())
        .all(|axis| positive(&point[axis] - &bounds.low[axis]) && positive(&bounds.high[axis] - &point[axis]))
}
