//! Operations whose result is a curve: the knots are those that the operation makes, and the curve is the same.

use super::super::deviation::Part;
use super::super::polynomial::{convolution, scaled};
use super::super::rule::Failure;
use super::pieces::Pieces;
use crate::curve::{Curve, Form};
use crate::number::{Integer, Rational, RationalExt};

/// Degree and knots of a curve as a B-spline: as it is given, or of a single Bézier piece, with the knots 0 and 1.
pub struct Spline {
    /// The degree p.
    pub degree: usize,
    /// All knots, p + 1 more than control points.
    pub knots: Vec<Rational>,
}

impl Spline {
    /// Nothing for several Bézier pieces.
    pub fn of(curve: &Curve) -> Option<Spline> {
        match curve.form() {
            Form::BSpline(spline) => Some(Spline {
                degree: spline.degree(),
                knots: spline.knots().iter().collect(),
            }),
            Form::Bezier(pieces) => match pieces.as_slice() {
                [piece] => {
                    let ends = [Integer::ZERO, Integer::ONE].map(Rational::from_integer);
                    let knots = ends.into_iter().flat_map(|end| vec![end; piece.degree() + 1]);
                    Some(Spline {
                        degree: piece.degree(),
                        knots: knots.collect(),
                    })
                }
                _ => None,
            },
        }
    }

    /// The two ends of the domain.
    pub fn domain(&self) -> [&Rational; 2] {
        [
            &self.knots[self.degree],
            &self.knots[self.knots.len() - 1 - self.degree],
        ]
    }

    fn is_inside(&self, t: &Rational) -> bool {
        let [start, end] = self.domain();
        start < t && t < end
    }

    /// With a knot of the domain, its ends included, `times` more; nothing outside.
    pub fn inserted(&self, t: &Rational, times: usize) -> Option<Spline> {
        let [start, end] = self.domain();
        if t < start || t > end {
            return None;
        }
        let mut knots = self.knots.clone();
        let at = knots.partition_point(|knot| knot <= t);
        knots.splice(at..at, vec![t.clone(); times]);
        Some(Spline {
            degree: self.degree,
            knots,
        })
    }

    /// With a knot inside the domain `times` less; nothing where it does not occur so often.
    pub fn removed(&self, t: &Rational, times: usize) -> Option<Spline> {
        let from = self.knots.partition_point(|knot| knot < t);
        let to = self.knots.partition_point(|knot| knot <= t);
        if !self.is_inside(t) || to - from < times {
            return None;
        }
        let mut knots = self.knots.clone();
        knots.drain(from..from + times);
        Some(Spline {
            degree: self.degree,
            knots,
        })
    }

    /// Of a degree that is higher by `times`: every knot `times` more, without those that come to stand outside p + `times` before the domain or behind it.
    pub fn elevated(&self, times: usize) -> Spline {
        let (p, n) = (self.degree, self.knots.len() - 1 - self.degree);
        let distinct = |knots: &[Rational]| knots.chunk_by(|a, b| a == b).count();
        let before = (distinct(&self.knots[..=p]) - 1) * times;
        let behind = (distinct(&self.knots[n..]) - 1) * times;
        let mut knots: Vec<Rational> = self
            .knots
            .chunk_by(|a, b| a == b)
            .flat_map(|run| vec![run[0].clone(); run.len() + times])
            .collect();
        knots.truncate(knots.len() - behind);
        Spline {
            degree: p + times,
            knots: knots.split_off(before),
        }
    }

    /// The parts before and behind a parameter inside the domain, which becomes a knot p + 1 times of both.
    pub fn split(&self, t: &Rational) -> Option<[Spline; 2]> {
        if !self.is_inside(t) {
            return None;
        }
        let ends = vec![t.clone(); self.degree + 1];
        let before = self.knots.iter().filter(|knot| *knot < t).cloned();
        let behind = self.knots.iter().filter(|knot| *knot > t).cloned();
        Some([
            Spline {
                degree: self.degree,
                knots: before.chain(ends.clone()).collect(),
            },
            Spline {
                degree: self.degree,
                knots: ends.into_iter().chain(behind).collect(),
            },
        ])
    }

    /// Is `curve` a B-spline with this degree and these knots?
    ///
    /// # Errors
    /// It is not.
    pub fn require(&self, curve: &Curve) -> Result<(), Failure> {
        let Form::BSpline(spline) = curve.form() else {
            return Err(Failure {
                expected: "a B-spline",
                found: "Bézier pieces".into(),
            });
        };
        if spline.degree() != self.degree {
            return Err(Failure {
                expected: "the degree that the operation makes",
                found: format!("degree {}", spline.degree()),
            });
        }
        if !spline.knots().iter().eq(self.knots.iter().cloned()) {
            return Err(Failure {
                expected: "the knots that the operation makes",
                found: "others".into(),
            });
        }
        Ok(())
    }
}

/// Is `result` the same curve as `curve` at all parameters of its own domain, which must be part of that of `curve`?
///
/// # Errors
/// It is not, and where.
pub fn require_same(curve: &Pieces, result: &Pieces) -> Result<(), Failure> {
    let ([start, end], [first, last]) = (curve.domain(), result.domain());
    if result.dimension != curve.dimension || first < start || last > end {
        return Err(Failure {
            expected: "a result of the curve's dimension inside its domain",
            found: format!(
                "dimension {}, {} to {}",
                result.dimension,
                first.format(),
                last.format()
            ),
        });
    }
    let mut i = curve.ends.partition_point(|end| end <= first) - 1;
    let mut j = 0;
    let mut low = first.clone();
    while j < result.pieces.len() {
        let (here, there) = (&curve.ends[i + 1], &result.ends[j + 1]);
        let high = here.min(there).clone();
        if !same(
            &section(&curve.pieces[i], &curve.ends[i..=i + 1], &low, &high),
            &section(&result.pieces[j], &result.ends[j..=j + 1], &low, &high),
        ) {
            return Err(Failure {
                expected: "the same curve",
                found: format!("another one between {} and {}", low.format(), high.format()),
            });
        }
        let (next_here, next_there) = (*here == high, *there == high);
        i += usize::from(next_here);
        j += usize::from(next_there);
        low = high;
    }
    Ok(())
}

/// X·v = Y·w for (X, w) and (Y, v): the same points at all parameters.
fn same(a: &[Vec<Integer>], b: &[Vec<Integer>]) -> bool {
    let scaled_columns = |columns: &[Vec<Integer>]| columns.iter().map(|column| scaled(column)).collect::<Vec<_>>();
    let (a, b) = (scaled_columns(a), scaled_columns(b));
    let d = a.len() - 1;
    (0..d).all(|axis| convolution(&a[axis], &b[d]) == convolution(&b[axis], &a[d]))
}

/// The columns of a piece on the interval `ends` of knots, restricted to low … high within it, up to a positive factor.
fn section(piece: &Part, ends: &[Rational], low: &Rational, high: &Rational) -> Vec<Vec<Integer>> {
    let local = |t: &Rational| (t - &ends[0]) / (&ends[1] - &ends[0]);
    let (from, to) = (local(low), local(high));
    piece
        .columns
        .iter()
        .map(|column| {
            let left = left_part(column, &to);
            // What is left runs from 0 to `to`; seen from its end the section is the first (to − from)/to of it.
            let mut reversed: Vec<Integer> = left.into_iter().rev().collect();
            reversed = left_part(&reversed, &((&to - &from) / &to));
            reversed.reverse();
            reversed
        })
        .collect()
}

/// The coefficients on [0, u], times the degree-th power of u's denominator (de Casteljau).
fn left_part(column: &[Integer], u: &Rational) -> Vec<Integer> {
    if u.is_integer() {
        return column.to_vec();
    }
    let (a, q) = (u.numer(), u.denom());
    let rest = q - a;
    let degree = column.len() - 1;
    let mut row = column.to_vec();
    for round in 1..=degree {
        // Entries below `round` are done and only rise to the common factor.
        for k in (round..=degree).rev() {
            row[k] = &row[k - 1] * &rest + &row[k] * a;
        }
        for x in &mut row[..round] {
            *x = &*x * q;
        }
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{BSpline, Curve};
    use crate::number::RationalVector;

    fn vector(numbers: &[i64]) -> RationalVector {
        let numbers: Vec<Rational> = numbers
            .iter()
            .map(|x| Rational::from_integer(Integer::from(*x)))
            .collect();
        RationalVector::from_rationals(&numbers)
    }

    fn half() -> Rational {
        Rational::new(Integer::ONE, Integer::from(2))
    }

    /// Rational, of degree 2, with a double knot, not clamped.
    fn spline() -> BSpline {
        BSpline::new(
            2,
            2,
            vector(&[0, 1, 2, 3, 3, 5, 6, 8]),
            vector(&[0, 0, 2, 1, 3, 5, 4, 4, 9, 1]),
            Some(vector(&[1, 2, 1, 3, 1])),
        )
        .expect("a spline")
    }

    #[test]
    fn knots_are_those_of_the_operations() {
        let spline = spline();
        let curve = Curve::from(spline.clone());
        let known = Spline::of(&curve).expect("a spline");
        let t = half() + Rational::from_integer(Integer::from(3));
        let requires = |wanted: Option<Spline>, made: BSpline| {
            let made = Curve::from(made);
            assert_eq!(wanted.expect("possible").require(&made), Ok(()));
            let pieces = Pieces::new(&curve).expect("no points");
            assert_eq!(require_same(&pieces, &Pieces::new(&made).expect("no points")), Ok(()));
        };
        requires(known.inserted(&t, 2), spline.insert_knot(&t, 2).expect("inserts"));
        for by in [1, 3] {
            requires(Some(known.elevated(by)), spline.elevate(by).expect("elevates"));
        }
        let [first, second] = known.split(&t).expect("inside");
        let (before, behind) = spline.split(&t).expect("inside");
        requires(Some(first), before);
        requires(Some(second), behind);
        let inserted = spline.insert_knot(&t, 2).expect("inserts");
        let more = Spline::of(&Curve::from(inserted)).expect("a spline");
        assert_eq!(more.removed(&t, 2).expect("there").knots, known.knots);
        assert!(more.removed(&t, 3).is_none());
        assert!(known.removed(&Rational::from_integer(Integer::from(2)), 1).is_none());
        assert!(known.split(&Rational::from_integer(Integer::from(6))).is_none());
        assert!(known.inserted(&Rational::from_integer(Integer::from(7)), 1).is_none());
    }

    #[test]
    fn left_parts_are_sections() {
        let column = [3, -1, 4, 1].map(Integer::from);
        // By halving the coefficients are sums over 8.
        assert_eq!(left_part(&column, &half()), [24, 8, 10, 13].map(Integer::from));
        let one = Rational::from_integer(Integer::ONE);
        assert_eq!(left_part(&column, &one), column);
    }
}
