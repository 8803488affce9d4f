//! The distance of two segments, exactly.

use crate::number::{Integer, Rational};

/// A point or vector with integer coordinates; the third is 0 in the plane.
pub(super) type Point = [Integer; 3];

pub(super) fn subtract(p: &Point, q: &Point) -> Point {
    [&p[0] - &q[0], &p[1] - &q[1], &p[2] - &q[2]]
}

pub(super) fn dot(v: &Point, w: &Point) -> Integer {
    &v[0] * &w[0] + &v[1] * &w[1] + &v[2] * &w[2]
}

fn scaled(v: &Point, factor: &Integer) -> Point {
    [&v[0] * factor, &v[1] * factor, &v[2] * factor]
}

/// Two nearest points of two segments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Closest {
    /// The square of their distance.
    pub squared: Rational,
    /// Where on the first segment, 0 at its start, 1 at its end.
    pub s: Rational,
    /// Where on the second.
    pub t: Rational,
}

/// The nearest points of the segments from `p[0]` to `p[1]` and from `q[0]` to `q[1]`, which may be points. Where there are several nearest pairs
/// (parallel segments), one with an end point.
///
/// |p(s) − q(t)|² is convex on the square of the parameters: when its critical point is not inside, the least value is attained on the border,
/// where one of the points is an end of its segment.
pub(super) fn closest(p: [&Point; 2], q: [&Point; 2]) -> Closest {
    let (v, w) = (subtract(p[1], p[0]), subtract(q[1], q[0]));
    let r = subtract(p[0], q[0]);
    let (a, b, e) = (dot(&v, &v), dot(&v, &w), dot(&w, &w));
    let determinant = &a * &e - &b * &b;
    if determinant.is_positive() {
        let (c, f) = (dot(&v, &r), dot(&w, &r));
        let (s, t) = (&b * &f - &c * &e, &a * &f - &b * &c);
        let inside = |x: &Integer| x.is_positive() && *x < determinant;
        if inside(&s) && inside(&t) {
            let (r, v, w) = (scaled(&r, &determinant), scaled(&v, &s), scaled(&w, &t));
            let chord: Point = std::array::from_fn(|i| &r[i] + &v[i] - &w[i]);
            return Closest {
                squared: Rational::new(dot(&chord, &chord), &determinant * &determinant),
                s: Rational::new(s, determinant.clone()),
                t: Rational::new(t, determinant),
            };
        }
    }
    let at = |end: usize| Rational::from_integer(Integer::from(end));
    let mut best: Option<Closest> = None;
    for end in [0, 1] {
        let (squared, t) = from_point(p[end], q[0], &w);
        let first = Closest { squared, s: at(end), t };
        let (squared, s) = from_point(q[end], p[0], &v);
        let second = Closest { squared, s, t: at(end) };
        for found in [first, second] {
            if best.as_ref().is_none_or(|best| found.squared < best.squared) {
                best = Some(found);
            }
        }
    }
    best.expect("four candidates")
}

/// The squared distance of a point from the segment from `start` in the direction `w`, and where it is attained.
pub(super) fn from_point(x: &Point, start: &Point, w: &Point) -> (Rational, Rational) {
    let r = subtract(x, start);
    let (along, length) = (dot(&r, w), dot(w, w));
    if !along.is_positive() {
        return (Rational::from_integer(dot(&r, &r)), Rational::default());
    }
    if along >= length {
        let r = subtract(&r, w);
        return (
            Rational::from_integer(dot(&r, &r)),
            Rational::from_integer(Integer::ONE),
        );
    }
    // |r − w(r·w)/(w·w)|² = ((r·r)(w·w) − (r·w)²)/(w·w)
    let squared = Rational::new(dot(&r, &r) * &length - &along * &along, length.clone());
    (squared, Rational::new(along, length))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn point(x: i64, y: i64, z: i64) -> Point {
        [x.into(), y.into(), z.into()]
    }

    fn squared(p: [[i64; 3]; 2], q: [[i64; 3]; 2]) -> Rational {
        let [a, b] = p.map(|[x, y, z]| point(x, y, z));
        let [c, d] = q.map(|[x, y, z]| point(x, y, z));
        closest([&a, &b], [&c, &d]).squared
    }

    #[test]
    fn all_cases() {
        let fraction = |p: i64, q: i64| Rational::new(p.into(), q.into());
        // Skew, both nearest points inside.
        assert_eq!(
            squared([[-1, 0, 0], [1, 0, 0]], [[0, -1, 3], [0, 1, 3]]),
            fraction(9, 1)
        );
        // They cross.
        assert_eq!(squared([[0, 0, 0], [2, 2, 0]], [[0, 2, 0], [2, 0, 0]]), fraction(0, 1));
        // End against the inside, not axis parallel.
        assert_eq!(squared([[0, 0, 0], [1, 2, 0]], [[1, 0, 0], [5, 0, 0]]), fraction(4, 5));
        // Parallel and side by side; on one line, overlapping and apart.
        assert_eq!(squared([[0, 0, 0], [4, 0, 0]], [[3, 1, 0], [9, 1, 0]]), fraction(1, 1));
        assert_eq!(squared([[0, 0, 0], [4, 0, 0]], [[3, 0, 0], [9, 0, 0]]), fraction(0, 1));
        assert_eq!(squared([[0, 0, 0], [1, 1, 0]], [[3, 3, 0], [9, 9, 0]]), fraction(8, 1));
        // Points.
        assert_eq!(squared([[0, 0, 0], [0, 0, 0]], [[1, 0, 0], [0, 1, 0]]), fraction(1, 2));
        assert_eq!(squared([[0, 0, 0], [0, 0, 0]], [[1, 2, 2], [1, 2, 2]]), fraction(9, 1));
    }

    fn points() -> impl Strategy<Value = Point> {
        [-6_i64..7, -6_i64..7, -2_i64..3].prop_map(|[x, y, z]| point(x, y, z))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(150))]

        #[test]
        fn no_points_are_nearer(p in [points(), points()], q in [points(), points()]) {
            let found = closest([&p[0], &p[1]], [&q[0], &q[1]]);
            let on = |ends: &[Point; 2], u: &Rational| -> Vec<Rational> {
                (0..3).map(|i| {
                    let x = |end: usize| Rational::from_integer(ends[end][i].clone());
                    x(0) + u * (x(1) - x(0))
                }).collect()
            };
            let squared = |s: &Rational, t: &Rational| {
                on(&p, s).iter().zip(on(&q, t)).fold(Rational::default(), |sum, (x, y)| {
                    let d = x - y;
                    sum + &d * &d
                })
            };
            prop_assert_eq!(squared(&found.s, &found.t), found.squared.clone());
            let unit = |k: i64| Rational::new(k.into(), Integer::from(8));
            for i in 0..=8 {
                for j in 0..=8 {
                    prop_assert!(squared(&unit(i), &unit(j)) >= found.squared);
                }
            }
            for u in [&found.s, &found.t] {
                prop_assert!(*u >= unit(0) && *u <= unit(8));
            }
        }
    }
}
