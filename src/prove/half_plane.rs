//! Choosing α, β for the rules `not_normal` and `bend`.
//!
//! Both rules ask for αa + βb > 0 at all points (a, b) of a set of rectangles. The directions of these points must leave out a half-plane; then the
//! bisector of the cone they span is the safest (α, β), and a rounded one with few bits mostly does.

use super::vector::{greater, lesser, nearest_integer};

/// a between `a[0]` and `a[1]`, b between `b[0]` and `b[1]`.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    /// Least and greatest a.
    pub a: [f64; 2],
    /// Least and greatest b.
    pub b: [f64; 2],
}

/// Limits on the signs of α and β at ends of the curve: the sign that is allowed besides 0, or 0 for both.
pub type Signs = [i8; 2];

/// Does αa + βb exceed |α|·errors[0] + |β|·errors[1] on all rectangles, with signs that are allowed?
#[inline]
fn works(rectangles: &[Rectangle], errors: [f64; 2], signs: Signs, factors: [i64; 2]) -> bool {
    let [alpha, beta] = factors.map(|factor| factor as f64);
    let margin = (alpha.abs() * errors[0] + beta.abs() * errors[1]) * 1.000_001;
    let (of_a, of_b) = (usize::from(alpha < 0.0), usize::from(beta < 0.0));
    let allowed = (0..2).all(|i| signs[i] == 0 || factors[i] * i64::from(signs[i]) >= 0);
    let exceeds = |r: &Rectangle| {
        let (x, y) = (alpha * r.a[of_a], beta * r.b[of_b]);
        x + y > margin + 4.0 * f64::EPSILON * (x.abs() + y.abs())
    };
    allowed && factors != [0, 0] && rectangles.iter().all(exceeds)
}

/// Integers α, β with αa + βb > |α|·errors[0] + |β|·errors[1] on all rectangles.
pub fn choose(rectangles: &[Rectangle], errors: [f64; 2], signs: Signs) -> Option<[i64; 2]> {
    // Where no half-plane is left, nothing can serve.
    let mut span = Span::default();
    if !rectangles.iter().all(|rectangle| span.include(rectangle)) {
        return None;
    }
    let units = [[1, 0], [-1, 0], [0, 1], [0, -1]].into_iter();
    let mut units = units.filter(|factors| works(rectangles, errors, signs, *factors));
    units
        .next()
        .or_else(|| round_bisector(rectangles, span.bisector()?, errors, signs))
}

/// Rounds a bisector, from few bits to many, until it serves.
pub fn round_bisector(
    rectangles: &[Rectangle],
    [alpha, beta]: [f64; 2],
    errors: [f64; 2],
    signs: Signs,
) -> Option<[i64; 2]> {
    let greatest = alpha.abs().max(beta.abs());
    [2u32, 4, 7, 12, 20, 30].into_iter().find_map(|bits| {
        let factor = ((1i64 << bits) - 1) as f64 / greatest;
        let factors = [nearest_integer(alpha * factor), nearest_integer(beta * factor)];
        if !works(rectangles, errors, signs, factors) {
            return None;
        }
        let common = num_integer::gcd(factors[0], factors[1]).max(1);
        Some(factors.map(|factor| factor / common))
    })
}

/// The cone that some points (a, b) span, as long as it is less than a half-plane.
#[derive(Clone, Copy, Debug, Default)]
pub struct Span {
    /// Its two ends, counter-clockwise.
    ends: Option<([f64; 2], [f64; 2])>,
}

fn cross(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[1] - p[1] * q[0]
}

impl Span {
    /// Widens the cone by the corners of a rectangle; `false` when no half-plane is left.
    #[inline]
    pub fn include(&mut self, r: &Rectangle) -> bool {
        if let Some((right, left)) = self.ends {
            // The least of each product over the four corners.
            let of_right = least_product(right[0], &r.b) - greatest_product(right[1], &r.a);
            let to_left = least_product(left[1], &r.a) - greatest_product(left[0], &r.b);
            if of_right > 0.0 && to_left > 0.0 {
                return true;
            }
        }
        let corners = [[r.a[0], r.b[0]], [r.a[0], r.b[1]], [r.a[1], r.b[0]], [r.a[1], r.b[1]]];
        corners.into_iter().all(|corner| self.include_point(corner))
    }

    fn include_point(&mut self, point: [f64; 2]) -> bool {
        if point == [0.0, 0.0] {
            return false;
        }
        let Some((right, left)) = &mut self.ends else {
            self.ends = Some((point, point));
            return true;
        };
        let (from_right, to_left) = (cross(*right, point), cross(point, *left));
        // The two ends of a cone of no width: opposite points leave no half-plane.
        if from_right == 0.0 && to_left == 0.0 && right[0] * point[0] + right[1] * point[1] < 0.0 {
            return false;
        }
        match (from_right >= 0.0, to_left >= 0.0) {
            (true, true) => {}
            (false, true) => *right = point,
            (true, false) => *left = point,
            (false, false) => return false,
        }
        true
    }

    /// The bisector of the cone.
    pub fn bisector(&self) -> Option<[f64; 2]> {
        let (right, left) = self.ends?;
        let norm = |p: [f64; 2]| {
            let length = (p[0] * p[0] + p[1] * p[1]).sqrt();
            [p[0] / length, p[1] / length]
        };
        let (right, left) = (norm(right), norm(left));
        let sum = [right[0] + left[0], right[1] + left[1]];
        (sum != [0.0, 0.0] && sum.iter().all(|x| x.is_finite())).then_some(sum)
    }
}

/// The least of `factor`·x over an interval.
#[inline]
fn least_product(factor: f64, range: &[f64; 2]) -> f64 {
    lesser(factor * range[0], factor * range[1])
}

/// The greatest of `factor`·x over an interval.
#[inline]
fn greatest_product(factor: f64, range: &[f64; 2]) -> f64 {
    greater(factor * range[0], factor * range[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_chosen_works(
            points in proptest::collection::vec((-1.0..1.0f64, -1.0..1.0f64), 1..6),
            turn in 0.0..std::f64::consts::TAU,
        ) {
            // Points in the half-plane a > 0.05, turned about the origin: a choice must exist, and it must work.
            let (sin, cos) = turn.sin_cos();
            let rectangles: Vec<Rectangle> = points
                .iter()
                .map(|(x, y)| {
                    let x = x.abs() + 0.05;
                    let (a, b) = (x * cos - y * sin, x * sin + y * cos);
                    Rectangle { a: [a, a], b: [b, b] }
                })
                .collect();
            let [alpha, beta] = choose(&rectangles, [0.0, 0.0], [0, 0]).expect("a half-plane is free");
            for r in &rectangles {
                prop_assert!(alpha as f64 * r.a[0] + beta as f64 * r.b[0] > 0.0);
            }
        }
    }

    #[test]
    fn no_choice_around_the_origin() {
        let points = [[1.0, 0.0], [-1.0, 0.1], [0.0, -1.0]].map(|[a, b]| Rectangle { a: [a, a], b: [b, b] });
        assert_eq!(choose(&points, [0.0; 2], [0, 0]), None);
        assert_eq!(
            choose(
                &[Rectangle {
                    a: [-1.0, 1.0],
                    b: [-1.0, 1.0]
                }],
                [0.0; 2],
                [0, 0]
            ),
            None
        );
        assert_eq!(
            choose(
                &[Rectangle {
                    a: [0.0; 2],
                    b: [0.0; 2]
                }],
                [0.0; 2],
                [0, 0]
            ),
            None
        );
    }

    #[test]
    fn signs_are_kept() {
        let points = [Rectangle {
            a: [1.0, 2.0],
            b: [-1.0, -0.5],
        }];
        assert_eq!(choose(&points, [0.0; 2], [-1, 0]), Some([0, -1]));
        assert_eq!(choose(&points, [0.0; 2], [-1, 1]), None);
    }
}
