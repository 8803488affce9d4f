//! The sign function: a polynomial, affine in the position x of the moving control points, with the sign of curvature or torsion (FORMAT §9).

use std::fmt;

use crate::check::blossom::interval_values;
use crate::check::polynomial::unscaled;
use crate::claim::domain::{Domain, Sign};
use crate::curve::{BSpline, Bezier, Curve, Form};
use crate::number::{Integer, Rational};

/// A function linear·x + constant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Affine {
    /// One number for each coordinate.
    pub linear: Vec<Integer>,
    /// The constant.
    pub constant: Integer,
}

impl Affine {
    /// Is it the zero function?
    pub fn is_zero(&self) -> bool {
        self.constant.is_zero() && self.linear.iter().all(Integer::is_zero)
    }

    /// The value at point / denominator, times the denominator.
    pub fn at(&self, point: &[Integer], denominator: &Integer) -> Integer {
        let terms = self.linear.iter().zip(point).map(|(a, x)| a * x);
        terms.fold(&self.constant * denominator, |sum, term| sum + term)
    }

    fn parts(&self) -> impl Iterator<Item = &Integer> {
        self.linear.iter().chain([&self.constant])
    }

    fn map(&self, f: impl Fn(&Integer) -> Integer) -> Affine {
        Affine {
            linear: self.linear.iter().map(&f).collect(),
            constant: f(&self.constant),
        }
    }

    /// a·self + b·other.
    fn combine(&self, a: &Integer, other: &Affine, b: &Integer) -> Affine {
        let combine = |x: &Integer, y: &Integer| a * x + b * y;
        Affine {
            linear: self
                .linear
                .iter()
                .zip(&other.linear)
                .map(|(x, y)| combine(x, y))
                .collect(),
            constant: combine(&self.constant, &other.constant),
        }
    }
}

/// The control points of one piece: for each k the coordinates of C_k, then w_k and α_k, over a common denominator.
struct Triples {
    /// d + 2 numbers for each control point.
    numbers: Vec<Integer>,
    denominator: Integer,
}

/// The function of one section of the curve.
#[derive(Clone, Debug)]
pub struct Section {
    /// The piece it is on.
    pub piece: usize,
    /// Its ends in the piece's local parameter.
    pub ends: [Rational; 2],
    /// The Bernstein coefficients of g on the section, over `scale`.
    pub coefficients: Vec<Affine>,
    /// g is `coefficients` times this positive number.
    pub scale: Rational,
    /// How often the local parameter of the section, and 1 minus it, were divided out of h.
    pub removed: [usize; 2],
    /// Is the interval open at the section's start, at its end?
    pub open: [bool; 2],
}

/// What is wrong with a domain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DomainError {
    /// `points` is empty, not increasing, or has an index that the curve does not have.
    Points,
    /// Of a joint's two points one is listed and the other is not; the number of the piece before.
    Joint(usize),
    /// Not 0 ≤ a < b ≤ M.
    Interval,
    /// Not low < high on an axis.
    Box(usize),
}

impl fmt::Display for DomainError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DomainError::Points => f.write_str("expected increasing indices of control points of the curve"),
            DomainError::Joint(piece) => {
                write!(
                    f,
                    "the end of piece {piece} and the start of the next are one point and move together"
                )
            }
            DomainError::Interval => f.write_str("expected an interval 0 ≤ a < b ≤ the number of pieces"),
            DomainError::Box(axis) => write!(f, "the box is empty or flat on axis {axis}"),
        }
    }
}

/// The sections of a domain, in order.
///
/// # Errors
/// A domain that is none.
pub fn sections(curve: &Curve, domain: &Domain) -> Result<Vec<Section>, DomainError> {
    let d = curve.dimension();
    if let Some(axis) = (0..d).find(|axis| domain.bounds.low[*axis] >= domain.bounds.high[*axis]) {
        return Err(DomainError::Box(axis));
    }
    let increasing = domain.points.windows(2).all(|pair| pair[0] < pair[1]);
    let count = match curve.form() {
        Form::BSpline(spline) => spline.count(),
        Form::Bezier(pieces) => pieces.iter().map(|piece| piece.degree() + 1).sum(),
    };
    if !increasing || domain.points.last().is_none_or(|last| *last >= count) {
        return Err(DomainError::Points);
    }
    let listed = |index: usize| domain.points.binary_search(&index).is_ok();
    let pieces: Vec<Triples> = match curve.form() {
        Form::BSpline(spline) => spline_triples(spline, d, &listed),
        Form::Bezier(pieces) => bezier_triples(pieces, d, &listed)?,
    };
    let whole = |number: usize| Rational::from_integer(Integer::from(number));
    let [a, b] = &domain.interval;
    if *a < whole(0) || a >= b || *b > whole(pieces.len()) {
        return Err(DomainError::Interval);
    }
    let mut sections = Vec::new();
    for (piece, triples) in pieces.iter().enumerate() {
        let start = a.max(&whole(piece)) - whole(piece);
        let end = b.min(&whole(piece + 1)) - whole(piece);
        if start >= end {
            continue;
        }
        let open = [
            domain.open[0] && *a == &start + whole(piece),
            domain.open[1] && *b == &end + whole(piece),
        ];
        let (h, scale) = sign_function(triples, d, domain.sign);
        sections.push(section(piece, [start, end], open, h, scale));
    }
    Ok(sections)
}

fn spline_triples(spline: &BSpline, d: usize, listed: &dyn Fn(usize) -> bool) -> Vec<Triples> {
    let points = spline.points().numerators();
    let (over, weights) = (spline.points().denominator(), spline.weights());
    let numbers: Vec<Integer> = (0..spline.count())
        .flat_map(|k| {
            let weight = weights.map_or(Integer::ONE, |weights| weights.numerators()[k].clone());
            triple(&points[k * d..(k + 1) * d], over, &weight, listed(k))
        })
        .collect();
    let over = over * weights.map_or(&Integer::ONE, |weights| weights.denominator());
    interval_values(spline, &numbers, d + 2)
        .map(|(numbers, multiple)| Triples {
            numbers,
            denominator: &over * multiple,
        })
        .collect()
}

fn bezier_triples(pieces: &[Bezier], d: usize, listed: &dyn Fn(usize) -> bool) -> Result<Vec<Triples>, DomainError> {
    let mut first = 0;
    let mut triples = Vec::with_capacity(pieces.len());
    for (i, piece) in pieces.iter().enumerate() {
        let points = piece.points().numerators();
        let (over, weights) = (piece.points().denominator(), piece.weights());
        let next = first + piece.degree() + 1;
        if i + 1 < pieces.len() && listed(next - 1) != listed(next) {
            return Err(DomainError::Joint(i));
        }
        let numbers = (0..=piece.degree()).flat_map(|k| {
            let weight = weights.map_or(Integer::ONE, |weights| weights.numerators()[k].clone());
            triple(&points[k * d..(k + 1) * d], over, &weight, listed(first + k))
        });
        triples.push(Triples {
            numbers: numbers.collect(),
            denominator: over * weights.map_or(&Integer::ONE, |weights| weights.denominator()),
        });
        first = next;
    }
    Ok(triples)
}

/// (C, w, α) of a control point with the coordinates `point` / `over` and the weight `weight`, times `over`.
fn triple(point: &[Integer], over: &Integer, weight: &Integer, listed: bool) -> Vec<Integer> {
    let w = weight * over;
    let c = point.iter().map(|x| if listed { Integer::ZERO } else { x * weight });
    let alpha = if listed { w.clone() } else { Integer::ZERO };
    c.chain([w, alpha]).collect()
}

/// A vector of polynomials by their Bernstein coefficients times binomials; `columns[c][i]`.
type Columns = Vec<Vec<Integer>>;

/// The coefficients of h on a whole piece, and the positive number they are to be multiplied by.
fn sign_function(piece: &Triples, d: usize, sign: Sign) -> (Vec<Affine>, Rational) {
    let stride = d + 2;
    let rows: Vec<&[Integer]> = piece.numbers.chunks(stride).collect();
    let n = rows.len() - 1;
    if n < d {
        let zero = Affine {
            linear: vec![Integer::ZERO; d],
            constant: Integer::ZERO,
        };
        return (vec![zero], Rational::from_integer(Integer::ONE));
    }
    let polynomial = rows.iter().all(|row| row[d] == rows[0][d]);
    // The columns of q_k: those that stay, then α.
    let q: Vec<Vec<Integer>> = if polynomial {
        rows.windows(2)
            .map(|pair| {
                let difference = |i: usize| &pair[1][i] - &pair[0][i];
                (0..d).map(difference).chain([difference(d + 1)]).collect()
            })
            .collect()
    } else {
        rows.iter()
            .map(|row| {
                let weight_first = [&row[d]].into_iter().chain(&row[..d]).chain([&row[d + 1]]);
                weight_first.cloned().collect()
            })
            .collect()
    };
    let m = q[0].len() - 1;
    let e = n - d;
    // b_j: the polynomial of degree e on q_j … q_{j+e}.
    let vectors: Vec<Columns> = (0..m)
        .map(|j| {
            let column = |c: usize| {
                let coefficient = |i: usize| Integer::binomial(e as u32, i as u32) * &q[j + i][c];
                (0..=e).map(coefficient).collect()
            };
            (0..=m).map(column).collect()
        })
        .collect();
    let stays: Vec<usize> = (0..m).collect();
    let negative = sign == Sign::Negative;
    let signed = |scaled: Vec<Integer>| -> (Vec<Integer>, Integer) {
        let (coefficients, multiple) = unscaled(scaled);
        match negative {
            true => (coefficients.iter().map(|x| -x).collect(), multiple),
            false => (coefficients, multiple),
        }
    };
    let (constants, multiple) = signed(determinant(&vectors, &stays));
    let linear: Vec<Vec<Integer>> = (0..d)
        .map(|axis| {
            let mut columns = stays.clone();
            columns[m - d + axis] = m;
            signed(determinant(&vectors, &columns)).0
        })
        .collect();
    let coefficients = constants
        .into_iter()
        .enumerate()
        .map(|(k, constant)| Affine {
            linear: linear.iter().map(|column| column[k].clone()).collect(),
            constant,
        })
        .collect();
    let over = piece.denominator.pow(m as u32) * multiple;
    (coefficients, Rational::new(Integer::ONE, over))
}

/// The determinant of the chosen columns of polynomial vectors, by expansion along the first; coefficients times binomials.
fn determinant(vectors: &[Columns], columns: &[usize]) -> Vec<Integer> {
    if let [column] = columns {
        return vectors[0][*column].clone();
    }
    let mut sum: Vec<Integer> = Vec::new();
    for (i, column) in columns.iter().enumerate() {
        let rest: Vec<usize> = columns.iter().copied().filter(|other| other != column).collect();
        let minor = determinant(&vectors[1..], &rest);
        let factor = &vectors[0][*column];
        sum.resize(minor.len() + factor.len() - 1, Integer::ZERO);
        for (j, x) in factor.iter().enumerate() {
            for (k, y) in minor.iter().enumerate() {
                if i % 2 == 0 {
                    sum[j + k] += x * y;
                } else {
                    sum[j + k] -= x * y;
                }
            }
        }
    }
    sum
}

/// Restricts h to a section and takes out the factors of open ends.
fn section(piece: usize, ends: [Rational; 2], open: [bool; 2], h: Vec<Affine>, scale: Rational) -> Section {
    let mut section = Section {
        piece,
        ends,
        coefficients: h,
        scale,
        removed: [0, 0],
        open,
    };
    section.restrict();
    for end in [0, 1] {
        if open[end] {
            section.remove_factor(end);
        }
    }
    section.reduce();
    section
}

impl Section {
    /// From the whole piece to the section.
    fn restrict(&mut self) {
        let one = Rational::from_integer(Integer::ONE);
        let start = self.ends[0].clone();
        if !start.numer().is_zero() {
            self.cut_start(&start);
        }
        // The end, seen from behind in what is left.
        let rest = (&one - &self.ends[1]) / (&one - &start);
        if !rest.numer().is_zero() {
            self.coefficients.reverse();
            self.cut_start(&rest);
            self.coefficients.reverse();
        }
    }

    /// From [0, 1] to [u, 1], by de Casteljau.
    fn cut_start(&mut self, u: &Rational) {
        let (p, q) = (u.numer(), u.denom());
        let rest = q - p;
        let degree = self.coefficients.len() - 1;
        // After a round the coefficients still combined have one more factor q; the others get it too.
        for round in 0..degree {
            for k in 0..degree - round {
                self.coefficients[k] = self.coefficients[k].combine(&rest, &self.coefficients[k + 1], p);
            }
            for k in degree - round..=degree {
                self.coefficients[k] = self.coefficients[k].map(|x| x * q);
            }
        }
        self.scale = &self.scale / Rational::from_integer(q.pow(degree as u32));
    }

    /// Divides out the factor of an end whose coefficients vanish identically.
    fn remove_factor(&mut self, end: usize) {
        if end == 1 {
            self.coefficients.reverse();
        }
        let zeros = self.coefficients.iter().take_while(|c| c.is_zero()).count();
        if zeros > 0 && zeros < self.coefficients.len() {
            let degree = (self.coefficients.len() - 1) as u32;
            let scaled: Vec<Affine> = self
                .coefficients
                .iter()
                .enumerate()
                .skip(zeros)
                .map(|(k, c)| c.map(|x| x * Integer::binomial(degree, k as u32)))
                .collect();
            let mut columns: Vec<(Vec<Integer>, Integer)> = (0..=scaled[0].linear.len())
                .map(|i| {
                    unscaled(
                        scaled
                            .iter()
                            .map(|c| c.parts().nth(i).cloned().unwrap_or_default())
                            .collect(),
                    )
                })
                .collect();
            let (constants, multiple) = columns.pop().unwrap_or_default();
            self.coefficients = constants
                .into_iter()
                .enumerate()
                .map(|(k, constant)| Affine {
                    linear: columns.iter().map(|(column, _)| column[k].clone()).collect(),
                    constant,
                })
                .collect();
            self.scale = &self.scale / Rational::from_integer(multiple);
            self.removed[end] = zeros;
        }
        if end == 1 {
            self.coefficients.reverse();
        }
    }

    /// Divides all coefficients by what they have in common.
    fn reduce(&mut self) {
        let mut common = Integer::ZERO;
        for part in self.coefficients.iter().flat_map(Affine::parts) {
            common = common.gcd(part);
            if common.is_one() {
                return;
            }
        }
        if common.is_zero() {
            return;
        }
        for coefficient in &mut self.coefficients {
            *coefficient = coefficient.map(|x| x.div_exact(&common));
        }
        self.scale = &self.scale * Rational::from_integer(common);
    }

    /// The coefficients at a point, up to a positive factor.
    pub fn at(&self, point: &[Integer], denominator: &Integer) -> Vec<Integer> {
        self.coefficients
            .iter()
            .map(|coefficient| coefficient.at(point, denominator))
            .collect()
    }

    /// The row at a local parameter of the piece, exactly `affine` times the positive number; `None` outside the section.
    pub fn row(&self, u: &Rational) -> Option<(Affine, Rational)> {
        if *u < self.ends[0] || *u > self.ends[1] {
            return None;
        }
        let v = (u - &self.ends[0]) / (&self.ends[1] - &self.ends[0]);
        let rest = Rational::from_integer(Integer::ONE) - &v;
        let (p, r, q) = (v.numer(), v.denom() - v.numer(), v.denom());
        let degree = self.coefficients.len() - 1;
        let mut row = self.coefficients.clone();
        for round in 0..degree {
            for k in 0..degree - round {
                row[k] = row[k].combine(&r, &row[k + 1], p);
            }
        }
        let mut scale = &self.scale / Rational::from_integer(q.pow(degree as u32));
        for (end, factor) in [(0, &v), (1, &rest)] {
            // At the open end itself the row is the value of g.
            if !factor.numer().is_zero() {
                for _ in 0..self.removed[end] {
                    scale *= factor;
                }
            }
        }
        Some((row.swap_remove(0), scale))
    }

    /// Is a local parameter of the piece an end of the interval that is open there?
    pub fn excludes(&self, u: &Rational) -> bool {
        (self.open[0] && *u == self.ends[0]) || (self.open[1] && *u == self.ends[1])
    }
}

/// For each piece the second differences of the affine control points, Δ²(C/w) and Δ²(α/w), d + 1 numbers each; `None` if a piece is rational.
pub fn second_differences(curve: &Curve, points: &[usize]) -> Option<Vec<Vec<Vec<Rational>>>> {
    let d = curve.dimension();
    let listed = |index: usize| points.binary_search(&index).is_ok();
    let pieces = match curve.form() {
        Form::BSpline(spline) => spline_triples(spline, d, &listed),
        Form::Bezier(pieces) => bezier_triples(pieces, d, &listed).ok()?,
    };
    let differences = |piece: &Triples| {
        let rows: Vec<&[Integer]> = piece.numbers.chunks(d + 2).collect();
        let weight = &rows[0][d];
        if rows.iter().any(|row| row[d] != *weight) {
            return None;
        }
        let second = |k: usize, i: usize| &rows[k + 2][i] - &rows[k + 1][i] - &rows[k + 1][i] + &rows[k][i];
        let over = |x: Integer| Rational::new(x, weight.clone());
        let columns = || (0..d).chain([d + 1]);
        let count = rows.len().saturating_sub(2);
        Some(
            (0..count)
                .map(|k| columns().map(|i| over(second(k, i))).collect())
                .collect(),
        )
    };
    pieces.iter().map(differences).collect()
}
