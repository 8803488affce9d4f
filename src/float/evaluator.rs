//! Curves prepared for many evaluations.

use super::curve::Curve;
use super::error::FloatError;
use super::locate::Locator;
use super::taylor::{compensated, greatest, horner};

/// A curve prepared for many evaluations: the polynomial of every span about its middle, with bounds for the errors of its evaluation.
///
/// A point is computed by Horner's scheme in binary64 wherever that is certain to be within 16·2⁻⁵² of the point's greatest coordinate, else by a compensated
/// scheme where that is certain to be within 3·2⁻⁵², and else in double-double as [`Curve::point`] does: near the origin, where the terms cancel. Degrees above 7
/// are always computed in double-double. Preparation takes about a microsecond and a few hundred bytes a span; evaluation allocates nothing.
/// ```
/// use knotproof::float::{Curve, Evaluator};
///
/// let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 2.0];
/// let curve = Curve::new(2, 3, knots, vec![1.0, 0.0, 1.0, 2.0, 2.0, -1.0, 3.0, 3.0, 4.0, 0.0], None)?;
/// let evaluator = Evaluator::new(&curve);
/// assert_eq!(evaluator.point(0.5)?, curve.point(0.5)?);
/// # Ok::<(), knotproof::float::FloatError>(())
/// ```
pub struct Evaluator<'a> {
    curve: &'a Curve,
    form: Form,
    locator: Locator,
    /// The index of each span among the knots.
    indices: Vec<u32>,
    /// Spans one after the other: middle, threshold, coefficients with the highest power first, `lanes` numbers each. A span not prepared yet has the
    /// threshold NaN.
    high: Vec<f64>,
    /// The same of the compensated scheme: nothing, threshold, what rounding took from the coefficients.
    low: Vec<f64>,
}

/// How points are computed; the degrees whose code is inlined, and the others.
#[derive(Clone, Copy)]
enum Form {
    Plane1,
    Plane2,
    Plane3,
    Space1,
    Space2,
    Space3,
    Rational2,
    Rational3,
    Plane,
    Space,
    Rational,
    /// In double-double.
    High,
}

/// The highest degree that is prepared.
const HIGHEST: usize = 7;

/// Points that a batch computes together.
const CHUNK: usize = 16;

impl<'a> Evaluator<'a> {
    /// Prepares a curve.
    pub fn new(curve: &'a Curve) -> Evaluator<'a> {
        let mut evaluator = Evaluator::unprepared(curve);
        for i in 0..evaluator.locator.count() {
            evaluator.prepare(i);
        }
        evaluator
    }

    fn unprepared(curve: &'a Curve) -> Evaluator<'a> {
        let p = curve.degree;
        let form = match (curve.dimension, p, curve.weights.is_some()) {
            (_, 8.., _) => Form::High,
            (2, 1, false) => Form::Plane1,
            (2, 2, false) => Form::Plane2,
            (2, 3, false) => Form::Plane3,
            (2, _, false) => Form::Plane,
            (_, 1, false) => Form::Space1,
            (_, 2, false) => Form::Space2,
            (_, 3, false) => Form::Space3,
            (_, _, false) => Form::Space,
            (_, 2, true) => Form::Rational2,
            (_, 3, true) => Form::Rational3,
            (_, _, true) => Form::Rational,
        };
        let locator = Locator::new(curve);
        let nonempty = (p..curve.count()).filter(|k| curve.knots[*k] < curve.knots[k + 1]);
        let indices: Vec<u32> = nonempty.map(|k| k as u32).collect();
        let mut evaluator = Evaluator {
            curve,
            form,
            locator,
            high: Vec::new(),
            low: Vec::new(),
            indices,
        };
        if p <= HIGHEST {
            let size = evaluator.stride() * evaluator.indices.len();
            evaluator.high = vec![f64::NAN; size];
            evaluator.low = vec![f64::NAN; size];
        }
        evaluator
    }

    fn lanes(&self) -> usize {
        match self.form {
            Form::Plane1 | Form::Plane2 | Form::Plane3 | Form::Plane => 2,
            _ => 4,
        }
    }

    fn stride(&self) -> usize {
        2 + self.lanes() * (self.curve.degree + 1)
    }

    fn prepare(&mut self, i: usize) {
        if matches!(self.form, Form::High) {
            return;
        }
        let (lanes, stride) = (self.lanes(), self.stride());
        let taylor = self.curve.taylor(self.indices[i] as usize);
        let high = &mut self.high[i * stride..(i + 1) * stride];
        let low = &mut self.low[i * stride..(i + 1) * stride];
        (high[0], high[1]) = (taylor.middle, taylor.threshold);
        (low[0], low[1]) = (0.0, taylor.compensated_threshold);
        for (to, from) in high[2..].chunks_exact_mut(lanes).zip(&taylor.high) {
            to.copy_from_slice(&from[..lanes]);
        }
        for (to, from) in low[2..].chunks_exact_mut(lanes).zip(&taylor.low) {
            to.copy_from_slice(&from[..lanes]);
        }
    }

    /// The point c(t), t in the domain; z = 0 in the plane.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`].
    #[inline]
    pub fn point(&self, t: f64) -> Result<[f64; 3], FloatError> {
        let (start, end) = self.locator.domain();
        // NaN is outside.
        if !(start <= t && t <= end) {
            return Err(FloatError::OutsideDomain);
        }
        Ok(self.of_span(self.locator.span(t), t))
    }

    #[inline(always)]
    fn of_span(&self, i: usize, t: f64) -> [f64; 3] {
        match self.form {
            Form::Plane1 => self.plane::<2>(i, t),
            Form::Plane2 => self.plane::<3>(i, t),
            Form::Plane3 => self.plane::<4>(i, t),
            Form::Space1 => self.space::<2>(i, t),
            Form::Space2 => self.space::<3>(i, t),
            Form::Space3 => self.space::<4>(i, t),
            Form::Rational2 => self.rational::<3>(i, t),
            Form::Rational3 => self.rational::<4>(i, t),
            _ => self.of_rare_form(i, t),
        }
    }

    #[inline(never)]
    fn of_rare_form(&self, i: usize, t: f64) -> [f64; 3] {
        match (self.form, self.curve.degree) {
            (Form::Plane, 4) => self.plane::<5>(i, t),
            (Form::Plane, 5) => self.plane::<6>(i, t),
            (Form::Plane, 6) => self.plane::<7>(i, t),
            (Form::Plane, 7) => self.plane::<8>(i, t),
            (Form::Space, 4) => self.space::<5>(i, t),
            (Form::Space, 5) => self.space::<6>(i, t),
            (Form::Space, 6) => self.space::<7>(i, t),
            (Form::Space, 7) => self.space::<8>(i, t),
            (Form::Rational, 1) => self.rational::<2>(i, t),
            (Form::Rational, 4) => self.rational::<5>(i, t),
            (Form::Rational, 5) => self.rational::<6>(i, t),
            (Form::Rational, 6) => self.rational::<7>(i, t),
            (Form::Rational, 7) => self.rational::<8>(i, t),
            _ => self.curve.exact_point(self.indices[i] as usize, t),
        }
    }

    /// Middle, threshold and coefficients of a span.
    #[inline(always)]
    fn coefficients<const N: usize, const L: usize>(&self, i: usize) -> (f64, f64, &[[f64; L]; N]) {
        let stride = 2 + N * L;
        let span = &self.high[i * stride..(i + 1) * stride];
        let (rows, _) = span[2..].as_chunks::<L>();
        let rows: &[[f64; L]; N] = rows.try_into().expect("the coefficients of a span");
        (span[0], span[1], rows)
    }

    #[inline(always)]
    fn plane<const N: usize>(&self, i: usize, t: f64) -> [f64; 3] {
        let (middle, threshold, rows) = self.coefficients::<N, 2>(i);
        let [x, y] = horner(rows, t - middle);
        let point = [x, y, 0.0];
        // Not so where the threshold is NaN.
        if greatest(&point) >= threshold {
            return point;
        }
        self.carefully(i, t)
    }

    #[inline(always)]
    fn space<const N: usize>(&self, i: usize, t: f64) -> [f64; 3] {
        let (middle, threshold, rows) = self.coefficients::<N, 4>(i);
        let [x, y, z, _] = horner(rows, t - middle);
        let point = [x, y, z];
        if greatest(&point) >= threshold {
            return point;
        }
        self.carefully(i, t)
    }

    #[inline(always)]
    fn rational<const N: usize>(&self, i: usize, t: f64) -> [f64; 3] {
        let (middle, threshold, rows) = self.coefficients::<N, 4>(i);
        let [x, y, z, w] = horner(rows, t - middle);
        let point = [x / w, y / w, z / w];
        if greatest(&point) >= threshold {
            return point;
        }
        self.carefully(i, t)
    }

    /// By the compensated scheme, or else in double-double.
    #[cold]
    #[inline(never)]
    fn carefully(&self, i: usize, t: f64) -> [f64; 3] {
        let stride = self.stride();
        let (high, low) = (&self.high[i * stride..][..stride], &self.low[i * stride..][..stride]);
        let (middle, threshold) = (high[0], low[1]);
        let point = if self.lanes() == 2 {
            let (high, low) = (high[2..].as_chunks().0, low[2..].as_chunks().0);
            let [x, y] = compensated::<2>(high, low, middle, t);
            [x, y, 0.0]
        } else {
            let (high, low) = (high[2..].as_chunks().0, low[2..].as_chunks().0);
            let [x, y, z, w] = compensated::<4>(high, low, middle, t);
            if self.curve.weights.is_some() {
                [x / w, y / w, z / w]
            } else {
                [x, y, z]
            }
        };
        if greatest(&point) >= threshold {
            return point;
        }
        self.curve.exact_point(self.indices[i] as usize, t)
    }

    /// The points at many parameters, flat, `dimension` numbers each, into `points`; fastest when neighbours share a span.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`] for the first parameter outside, and [`FloatError::Argument`] when `points` has another length; `points` is then
    /// unspecified.
    pub fn points_at(&self, parameters: &[f64], points: &mut [f64]) -> Result<(), FloatError> {
        let d = self.curve.dimension;
        check_room(parameters, points, d)?;
        match self.form {
            Form::Plane1 => return self.batch::<2, 2, 2>(parameters, points),
            Form::Plane2 => return self.batch::<3, 2, 2>(parameters, points),
            Form::Plane3 => return self.batch::<4, 2, 2>(parameters, points),
            Form::Space1 => return self.batch::<2, 4, 3>(parameters, points),
            Form::Space2 => return self.batch::<3, 4, 3>(parameters, points),
            Form::Space3 => return self.batch::<4, 4, 3>(parameters, points),
            _ => {}
        }
        for (t, point) in parameters.iter().zip(points.chunks_exact_mut(d)) {
            point.copy_from_slice(&self.point(*t)?[..d]);
        }
        Ok(())
    }

    /// Points of a polynomial curve of D coordinates, some at a time where they share a span.
    fn batch<const N: usize, const L: usize, const D: usize>(
        &self,
        parameters: &[f64],
        points: &mut [f64],
    ) -> Result<(), FloatError> {
        let (chunks, rest) = parameters.as_chunks::<CHUNK>();
        let (rows, _) = points.as_chunks_mut::<D>();
        let (row_chunks, row_rest) = rows.as_chunks_mut::<CHUNK>();
        let (start, end) = self.locator.domain();
        let mut span = 0;
        for (chunk, row_chunk) in chunks.iter().zip(row_chunks) {
            let one = chunk[0];
            let (from, to) = self.locator.ends(span);
            if !(from <= one && one < to) && start <= one && one <= end {
                span = self.locator.span(one);
            }
            if !self.together::<N, L, D>(span, chunk, row_chunk) {
                for (t, row) in chunk.iter().zip(row_chunk) {
                    *row = first(&self.point(*t)?);
                }
            }
        }
        for (t, row) in rest.iter().zip(row_rest) {
            *row = first(&self.point(*t)?);
        }
        Ok(())
    }

    /// Points of one span by Horner's scheme; false where they are not all on it, or not all certain to be accurate.
    #[inline(always)]
    fn together<const N: usize, const L: usize, const D: usize>(
        &self,
        span: usize,
        parameters: &[f64; CHUNK],
        points: &mut [[f64; D]; CHUNK],
    ) -> bool {
        let (start, end) = self.locator.ends(span);
        let (middle, threshold, rows) = self.coefficients::<N, L>(span);
        let mut doubtful = 0;
        for (t, point) in parameters.iter().zip(points) {
            let sum = horner(rows, t - middle);
            *point = std::array::from_fn(|axis| sum[axis]);
            let mut most = sum[0].abs();
            for x in &sum[1..D] {
                most = if x.abs() > most { x.abs() } else { most };
            }
            // NaN is in no order.
            let (inside, accurate) = ((start <= *t) & (*t < end), most >= threshold);
            doubtful |= u32::from(!inside) | u32::from(!accurate);
        }
        doubtful == 0
    }
}

fn first<const D: usize>(point: &[f64; 3]) -> [f64; D] {
    std::array::from_fn(|axis| point[axis])
}

fn check_room(parameters: &[f64], points: &[f64], dimension: usize) -> Result<(), FloatError> {
    if parameters.len() * dimension == points.len() {
        return Ok(());
    }
    Err(FloatError::Argument {
        expected: "room for as many points as there are parameters",
    })
}

impl Curve {
    /// The points at many parameters, as [`Evaluator::points_at`]; only spans that the parameters meet are prepared.
    ///
    /// # Errors
    /// As for [`Evaluator::points_at`].
    pub fn points_at(&self, parameters: &[f64], points: &mut [f64]) -> Result<(), FloatError> {
        let d = self.dimension;
        check_room(parameters, points, d)?;
        let mut evaluator = Evaluator::unprepared(self);
        let (start, end) = evaluator.locator.domain();
        let mut prepared = vec![false; evaluator.locator.count()];
        for t in parameters {
            if !(start <= *t && *t <= end) {
                return Err(FloatError::OutsideDomain);
            }
            let i = evaluator.locator.span(*t);
            if !prepared[i] {
                prepared[i] = true;
                evaluator.prepare(i);
            }
        }
        evaluator.points_at(parameters, points)
    }
}
