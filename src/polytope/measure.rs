//! Exact area and volume.

use super::body::Body;
use crate::number::{Integer, Rational};

/// A sum of fractions whose common denominator is the product of the weights of some vertices.
struct Term {
    numerator: Integer,
    /// Ascending.
    vertices: Vec<u32>,
}

/// The simplices that a vertex of the body spans with its boundary, given by the numbers of their other vertices: edges in the plane, in
/// space triangles of all facets, positively oriented seen from outside.
pub(super) fn boundary(body: &Body) -> impl Iterator<Item = [u32; 3]> + '_ {
    body.facets.iter().flat_map(move |facet| {
        let vertices = &facet.vertices;
        let simplices = if body.dimension == 2 { 1 } else { vertices.len() - 2 };
        (0..simplices).map(move |i| {
            let third = if body.dimension == 2 { i + 1 } else { i + 2 };
            [vertices[0], vertices[i + 1], vertices[third]]
        })
    })
}

/// Area or volume: by Gauss, ½ Σ det(a, b) over the edges or ⅙ Σ det(a, b, c) over triangles of the boundary.
pub(super) fn measure(body: &Body) -> Rational {
    // Reduced: common factors of a vertex's coordinates would come back in every product.
    let points: Vec<[Integer; 4]> = body
        .vertices
        .iter()
        .map(|vertex| {
            let point = vertex.homogeneous(&body.rows, body.dimension);
            let divisor = point.iter().fold(Integer::ZERO, |divisor, x| divisor.gcd(x));
            if divisor.is_one() {
                point
            } else {
                point.map(|x| x.div_exact(&divisor))
            }
        })
        .collect();
    let weights: Vec<&Integer> = points.iter().map(|point| &point[3]).collect();
    let terms: Vec<Term> = boundary(body)
        .map(|[i, j, k]| {
            let [a, b, c] = [i, j, k].map(|vertex| &points[vertex as usize]);
            let mut vertices = vec![i, j, k];
            let minor = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
            let numerator = if body.dimension == 2 {
                vertices.pop();
                minor(0, 1)
            } else {
                &c[2] * minor(0, 1) - &c[1] * minor(0, 2) + &c[0] * minor(1, 2)
            };
            vertices.sort_unstable();
            Term { numerator, vertices }
        })
        .collect();
    let total = sum(terms, &weights);
    let factor = Integer::from(if body.dimension == 2 { 2 } else { 6 });
    let denominator = product(&total.vertices, &weights) * factor;
    Rational::new(total.numerator, denominator)
}

/// Adds by halves, so that the operands of long multiplications are of similar length.
fn sum(mut terms: Vec<Term>, weights: &[&Integer]) -> Term {
    while terms.len() > 1 {
        let mut halved = Vec::with_capacity(terms.len().div_ceil(2));
        let mut rest = terms.into_iter();
        while let Some(a) = rest.next() {
            halved.push(match rest.next() {
                Some(b) => add(a, b, weights),
                None => a,
            });
        }
        terms = halved;
    }
    terms.pop().unwrap_or(Term {
        numerator: Integer::ZERO,
        vertices: Vec::new(),
    })
}

fn add(a: Term, b: Term, weights: &[&Integer]) -> Term {
    let missing = |from: &[u32], to: &[u32]| -> Vec<u32> {
        let lacks = |vertex: &&u32| to.binary_search(vertex).is_err();
        from.iter().filter(lacks).copied().collect()
    };
    let (only_a, only_b) = (missing(&a.vertices, &b.vertices), missing(&b.vertices, &a.vertices));
    let numerator = a.numerator * product(&only_b, weights) + b.numerator * product(&only_a, weights);
    let mut vertices = a.vertices;
    vertices.extend(only_b);
    vertices.sort_unstable();
    Term { numerator, vertices }
}

fn product(vertices: &[u32], weights: &[&Integer]) -> Integer {
    match vertices {
        [] => Integer::ONE,
        [vertex] => weights[*vertex as usize].clone(),
        _ => {
            let (a, b) = vertices.split_at(vertices.len() / 2);
            product(a, weights) * product(b, weights)
        }
    }
}
