//! Small vectors of binary64. Four components, so that a vector fills a register; the fourth is a weight or 0.

/// (x, y, z, w).
pub type Vector = [f64; 4];

/// a + b.
#[inline]
pub fn add(a: &Vector, b: &Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}

/// a − b.
#[inline]
pub fn sub(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]]
}

/// k·a.
#[inline]
pub fn scale(a: &Vector, k: f64) -> Vector {
    [a[0] * k, a[1] * k, a[2] * k, a[3] * k]
}

/// (a + b)/2.
#[inline]
pub fn middle(a: &Vector, b: &Vector) -> Vector {
    scale(&add(a, b), 0.5)
}

/// The dot product of the first three components.
#[inline]
pub fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The lesser of two numbers; `b` if either is not a number. One instruction, where `f64::min` takes several.
#[inline]
pub fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers; `b` if either is not a number. One instruction, where `f64::max` takes several.
#[inline]
pub fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The lesser components of two vectors, as [`lesser`].
#[inline]
pub fn lesser_of_each(a: &Vector, b: &Vector) -> Vector {
    [
        lesser(a[0], b[0]),
        lesser(a[1], b[1]),
        lesser(a[2], b[2]),
        lesser(a[3], b[3]),
    ]
}

/// The greater components of two vectors, as [`greater`].
#[inline]
pub fn greater_of_each(a: &Vector, b: &Vector) -> Vector {
    [
        greater(a[0], b[0]),
        greater(a[1], b[1]),
        greater(a[2], b[2]),
        greater(a[3], b[3]),
    ]
}

/// |x| + |y| + |z|.
#[inline]
pub fn norm1(a: &Vector) -> f64 {
    a[0].abs() + a[1].abs() + a[2].abs()
}

/// The greatest of |x|, |y|, |z|. Where one of them is not a number the answer need not be the greatest of the others.
#[inline]
pub fn greatest(a: &Vector) -> f64 {
    greater(a[0].abs(), greater(a[1].abs(), a[2].abs()))
}

/// a/|a|, or `None` for the zero vector.
#[inline]
pub fn unit(a: &Vector) -> Option<Vector> {
    let square = dot(a, a);
    (square > 0.0 && square.is_finite()).then(|| scale(a, 1.0 / square.sqrt()))
}

/// A direction in which the least product with the vectors is as great as Gilbert's steps make it: nearly the one of the shortest vector
/// of their convex hull. Zero vectors are left out.
pub fn inner_direction(vectors: &[Vector]) -> Vector {
    let given: Vec<&Vector> = vectors.iter().filter(|v| dot(v, v) > 0.0).collect();
    let mut x = given.iter().fold([0.0; 4], |sum, v| add(&sum, v));
    x = scale(&x, 1.0 / given.len().max(1) as f64);
    let mut best = (f64::NEG_INFINITY, x);
    for _ in 0..30 {
        let least = given.iter().min_by(|v, w| dot(v, &x).total_cmp(&dot(w, &x)));
        let Some(support) = least else { break };
        let length = dot(&x, &x).sqrt();
        let reached = dot(support, &x) / length;
        if reached > best.0 {
            best = (reached, x);
        }
        // The point of the segment from x to the support point that is nearest to the origin.
        let step = sub(&x, support);
        let square = dot(&step, &step);
        let fraction = if square > 0.0 {
            (dot(&x, &step) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        if fraction <= 0.0 || reached.is_nan() || reached > 0.999 * length {
            break;
        }
        x = sub(&x, &scale(&step, fraction));
    }
    best.1
}

/// An integer nearest to x, as far as it matters for a choice: near the middle between two integers it may be the wrong one of them.
#[inline]
pub fn nearest_integer(x: f64) -> i64 {
    // Faster than `round`, which is a function call on processors of old.
    (x + 0.5f64.copysign(x)) as i64
}

/// The integer vector nearest to a multiple of `a` whose greatest component is 2^bits − 1.
pub fn quantised(a: &Vector, bits: u32) -> [i64; 3] {
    let greatest = greatest(a);
    if greatest.is_nan() || greatest <= 0.0 || greatest.is_infinite() {
        return [0; 3];
    }
    // Divided first, so that neither tiny nor huge vectors leave the range.
    let factor = ((1i64 << bits) - 1) as f64;
    [0, 1, 2].map(|i| nearest_integer(a[i] / greatest * factor))
}

/// An integer vector as floats; exact below 2^53.
#[inline]
pub fn from_integers(n: &[i64; 3]) -> Vector {
    [n[0] as f64, n[1] as f64, n[2] as f64, 0.0]
}
