//! The knot type of a curve, from a polygon that is ambient isotopic to it and a projection with three crossings.

use std::io::Cursor;

use knotproof::certificate::Encoding;
use knotproof::curve::Curve;
use knotproof::number::Rational;
use knotproof::prove::embedding::{Options, Outcome, certify};

use crate::common::document::Certificate;
use crate::common::tree::leaf_ends;
use crate::exact::{Point, absolute, minus, whole};

/// The vertices of a closed polygon that is certified to be ambient isotopic to a closed curve, the first not repeated.
pub fn isotopic_polygon(curve: &Curve) -> Vec<Point> {
    let Ok(Outcome::Embedded(mut certified)) = certify(curve, &Options::default(), &|_| ()) else {
        panic!("an embedded curve");
    };
    let mut file = Cursor::new(Vec::new());
    certified
        .write_checked(Encoding::Json, &mut file)
        .expect("accepted by the checker");
    let tokens = Certificate::of_bytes(file.get_ref()).tokens();
    let chain = curve.chain();
    let mut ends = leaf_ends(curve, &tokens);
    assert_eq!(ends.pop(), Some(whole(chain.count() as i64)));
    assert_eq!(ends.len() as u64, certified.document.claim.statement.edges);
    ends.iter()
        .map(|end| chain.evaluate(end).expect("on the curve"))
        .collect()
}

/// A passage through a crossing: where along the polygon, which crossing, over or under.
struct Passage {
    at: Rational,
    crossing: usize,
    over: bool,
}

/// Is a closed polygon a trefoil? `None` when no projection that is tried has three crossings.
///
/// A diagram with three crossings in which the passages are 1, 2, 3, 1, 2, 3 and alternate between over and under is that of a trefoil.
pub fn is_trefoil(polygon: &[Point]) -> Option<bool> {
    let directions = (-6..=6).flat_map(|a| (-6..=6).map(move |b| [whole(a) / whole(5), whole(b) / whole(5)]));
    let found = directions.filter_map(|direction| passages(polygon, &direction));
    let passages = found.into_iter().find(|passages| passages.len() == 6)?;
    let order: Vec<usize> = passages.iter().map(|passage| passage.crossing).collect();
    let alternates = passages
        .iter()
        .zip(passages.iter().cycle().skip(1))
        .all(|(p, q)| p.over != q.over);
    Some(order[..3] == order[3..] && alternates)
}

/// The passages through crossings in their order, for the projection along (a, b, 1); `None` where that is not generic.
fn passages(polygon: &[Point], direction: &[Rational; 2]) -> Option<Vec<Passage>> {
    let flat: Vec<[Rational; 2]> = polygon
        .iter()
        .map(|p| [&p[0] - &direction[0] * &p[2], &p[1] - &direction[1] * &p[2]])
        .collect();
    let n = polygon.len();
    let cross = |p: &[Rational], q: &[Rational]| &p[0] * &q[1] - &p[1] * &q[0];
    let mut found = Vec::new();
    let mut crossings = 0;
    for i in 0..n {
        for j in i + 1..n {
            let neighbours = j == i + 1 || (i == 0 && j == n - 1);
            let along = minus(&flat[(i + 1) % n], &flat[i]);
            let other = minus(&flat[(j + 1) % n], &flat[j]);
            let between = minus(&flat[j], &flat[i]);
            let determinant = cross(&along, &other);
            if determinant == whole(0) {
                return None;
            }
            if neighbours {
                continue;
            }
            let s = cross(&between, &other) / &determinant;
            let t = cross(&between, &along) / &determinant;
            if [&s, &t].iter().any(|x| **x == whole(0) || **x == whole(1)) {
                return None;
            }
            let inside = |x: &Rational| *x == absolute(x) && *x < whole(1);
            if !(inside(&s) && inside(&t)) {
                continue;
            }
            let height = |k: usize, u: &Rational| {
                let (from, to) = (&polygon[k][2], &polygon[(k + 1) % n][2]);
                from + (to - from) * u
            };
            let (first, second) = (height(i, &s), height(j, &t));
            if first == second {
                return None;
            }
            let over = first > second;
            found.push(Passage {
                at: whole(i as i64) + s,
                crossing: crossings,
                over,
            });
            found.push(Passage {
                at: whole(j as i64) + t,
                crossing: crossings,
                over: !over,
            });
            crossings += 1;
        }
    }
    found.sort_by(|p, q| p.at.cmp(&q.at));
    Some(found)
}

#[test]
fn a_trefoil_and_an_unknot_with_the_same_shadow() {
    let shadow = [
        [15, -18, -9],
        [52, 7, -18],
        [45, 37, 9],
        [7, 35, 18],
        [-24, -4, -9],
        [-20, -48, -18],
        [9, -58, 9],
        [27, -24, 18],
        [8, 23, -9],
        [-32, 41, -18],
        [-55, 21, 9],
        [-34, -11, 18],
    ];
    let polygon = |height: &dyn Fn(usize) -> i64| -> Vec<Point> {
        let points = shadow.iter().enumerate();
        points
            .map(|(i, [x, y, _])| vec![whole(*x), whole(*y), whole(height(i))])
            .collect()
    };
    assert_eq!(is_trefoil(&polygon(&|i| shadow[i][2])), Some(true));
    // It goes up all the time, but for its last edge.
    assert_ne!(is_trefoil(&polygon(&|i| i as i64)), Some(true));
}
