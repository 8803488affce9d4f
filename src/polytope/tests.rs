//! Against an enumeration of all vertices, and cases by hand.

use std::collections::BTreeSet;

use proptest::prelude::*;

use super::*;
use crate::number::RationalExt;

fn integer(value: i64) -> Rational {
    Rational::from_integer(Integer::from(value))
}

fn plane<const D: usize>(coefficients: &[i64]) -> HalfSpace<D> {
    HalfSpace {
        normal: std::array::from_fn(|i| Integer::from(coefficients[i])),
        constant: Integer::from(coefficients[D]),
    }
}

/// The one point common to D boundaries, by Gauss's algorithm.
fn common_point<const D: usize>(rows: [&HalfSpace<D>; D]) -> Option<[Rational; D]> {
    let mut system: Vec<Vec<Rational>> = rows
        .iter()
        .map(|row| {
            let numbers = row.normal.iter().cloned().chain([-&row.constant]);
            numbers.map(Rational::from_integer).collect()
        })
        .collect();
    for column in 0..D {
        let pivot = (column..D).find(|row| !system[*row][column].numer().is_zero())?;
        system.swap(column, pivot);
        let pivot = system[column].clone();
        for row in 0..D {
            if row != column {
                let factor = &system[row][column] / &pivot[column];
                for (entry, pivot) in system[row].iter_mut().zip(&pivot) {
                    *entry -= &factor * pivot;
                }
            }
        }
    }
    Some(std::array::from_fn(|i| &system[i][D] / &system[i][i]))
}

/// All points where D boundaries meet and that are in all half-spaces.
fn enumerate<const D: usize>(rows: &[HalfSpace<D>]) -> BTreeSet<[Rational; D]> {
    let mut found = BTreeSet::new();
    let mut choice: Vec<usize> = (0..D).collect();
    if rows.len() < D {
        return found;
    }
    loop {
        let chosen = std::array::from_fn(|i| &rows[choice[i]]);
        if let Some(point) = common_point(chosen)
            && rows.iter().all(|row| !row.value(&point).numer().is_negative())
        {
            found.insert(point);
        }
        // The next choice in lexicographic order.
        let Some(i) = (0..D).rev().find(|i| choice[*i] < rows.len() - D + i) else {
            return found;
        };
        choice[i] += 1;
        for j in i + 1..D {
            choice[j] = choice[j - 1] + 1;
        }
    }
}

/// Rank of the differences of points from the first.
fn affine_rank<const D: usize>(points: &[[Rational; D]]) -> usize {
    let mut rest: Vec<Vec<Rational>> = points
        .iter()
        .skip(1)
        .map(|point| (0..D).map(|i| &point[i] - &points[0][i]).collect())
        .collect();
    let mut rank = 0;
    for column in 0..D {
        let Some(pivot) = (rank..rest.len()).find(|row| !rest[*row][column].numer().is_zero()) else {
            continue;
        };
        rest.swap(rank, pivot);
        let pivot = rest[rank].clone();
        for row in &mut rest[rank + 1..] {
            let factor = &row[column] / &pivot[column];
            for (entry, pivot) in row.iter_mut().zip(&pivot) {
                *entry -= &factor * pivot;
            }
        }
        rank += 1;
    }
    rank
}

fn equal_rows<const D: usize>(a: &HalfSpace<D>, b: &HalfSpace<D>) -> bool {
    let coefficients = |row: &HalfSpace<D>| -> Vec<Integer> {
        let all: Vec<Integer> = row.normal.iter().chain([&row.constant]).cloned().collect();
        let divisor = all
            .iter()
            .fold(Integer::ZERO, |divisor, x| divisor.gcd(x))
            .max(Integer::ONE);
        all.iter().map(|x| x.div_exact(&divisor)).collect()
    };
    coefficients(a) == coefficients(b)
}

/// A sub-determinant of points, for the orientation.
fn orientation(a: &[Rational], b: &[Rational], c: &[Rational], d: &[Rational]) -> Rational {
    let difference = |p: &[Rational], i: usize| &p[i] - &a[i];
    let minor = |i: usize, j: usize| difference(b, i) * difference(c, j) - difference(b, j) * difference(c, i);
    difference(d, 0) * minor(1, 2) - difference(d, 1) * minor(0, 2) + difference(d, 2) * minor(0, 1)
}

/// All that is promised of a bounded result; `vertices` are the true ones.
fn assert_polytope<const D: usize>(rows: &[HalfSpace<D>], polytope: &Polytope<D>, vertices: &BTreeSet<[Rational; D]>) {
    let points: Vec<[Rational; D]> = (0..polytope.vertex_count()).map(|i| polytope.vertex(i)).collect();
    assert_eq!(&points.iter().cloned().collect::<BTreeSet<_>>(), vertices);
    assert_eq!(points.len(), vertices.len());
    let inside = polytope.interior_point();
    assert!(
        rows.iter()
            .all(|row| { row.normal.iter().all(Integer::is_zero) || row.value(&inside).numer().is_positive() })
    );
    // The facets are those rows, the first of equal ones, on whose boundary vertices span a hyperplane.
    let on = |row: &HalfSpace<D>| -> BTreeSet<usize> {
        (0..points.len())
            .filter(|i| row.value(&points[*i]).numer().is_zero())
            .collect()
    };
    let mut expected = BTreeSet::new();
    for (i, row) in rows.iter().enumerate() {
        let on: Vec<[Rational; D]> = on(row).into_iter().map(|i| points[i].clone()).collect();
        let proper = row.normal.iter().any(|x| !x.is_zero());
        if proper && on.len() >= D && affine_rank(&on) == D - 1 && !rows[..i].iter().any(|first| equal_rows(first, row))
        {
            expected.insert(i);
        }
    }
    assert_eq!(
        polytope.facets().map(|facet| facet.row).collect::<BTreeSet<_>>(),
        expected
    );
    assert_eq!(polytope.facet_count(), expected.len());
    let mut edges = BTreeSet::new();
    for (number, facet) in polytope.facets().enumerate() {
        let set: BTreeSet<usize> = facet.vertices.iter().copied().collect();
        assert_eq!(set.len(), facet.vertices.len());
        assert_eq!(set, on(&rows[facet.row]));
        for vertex in &facet.vertices {
            assert!(polytope.vertex_facets(*vertex).any(|facet| facet == number));
            assert!(polytope.incident_rows(*vertex).contains(&facet.row));
        }
        let length = facet.vertices.len();
        if D == 3 {
            for i in 0..length {
                let [a, b, c] = [0, 1, 2].map(|j| facet.vertices[(i + j) % length]);
                assert!(edges.insert((a, b)));
                // Convex and counter-clockwise seen from outside: the inside is below.
                let [a, b, c] = [a, b, c].map(|i| points[i].as_slice());
                assert!(orientation(a, b, c, inside.as_slice()).numer().is_negative());
            }
        } else {
            assert!(edges.insert((facet.vertices[0], facet.vertices[1])));
            let [a, b] = [0, 1].map(|i| &points[facet.vertices[i]]);
            let cross = (&b[0] - &a[0]) * (&inside[1] - &a[1]) - (&b[1] - &a[1]) * (&inside[0] - &a[0]);
            assert!(cross.numer().is_positive());
        }
    }
    if D == 3 {
        assert!(edges.iter().all(|(a, b)| edges.contains(&(*b, *a))));
        assert_eq!(points.len() + polytope.facet_count(), edges.len() / 2 + 2);
    } else {
        assert_eq!(edges.len(), points.len());
    }
    for number in 0..points.len() {
        assert!(polytope.vertex_facets(number).len() >= D);
        let (approximation, bound) = polytope.vertex_approximation(number);
        let size = points[number].iter().fold(1.0, |size, x| x.to_f64().abs().max(size));
        // Nearly parallel rows meet some 1e25 away.
        assert!(bound < 1e-6 * size, "{bound} at a size of {size}");
        let bound = Rational::from_f64(bound).unwrap();
        for i in 0..D {
            let off = Rational::from_f64(approximation[i]).unwrap() - &points[number][i];
            assert!(off <= bound && -off <= bound);
        }
    }
    // The measure by another dissection: pyramids over the facets with their apex inside, by exact determinants.
    let mut total = Rational::default();
    for facet in polytope.facets() {
        if D == 3 {
            for i in 1..facet.vertices.len() - 1 {
                let [a, b, c] = [0, i, i + 1].map(|i| points[facet.vertices[i]].as_slice());
                total -= orientation(a, b, c, inside.as_slice()) / Integer::from(6);
            }
        } else {
            let [a, b] = [0, 1].map(|i| &points[facet.vertices[i]]);
            let cross = (&a[0] - &inside[0]) * (&b[1] - &inside[1]) - (&a[1] - &inside[1]) * (&b[0] - &inside[0]);
            total += cross / Integer::from(2);
        }
    }
    assert_eq!(polytope.measure(), total);
    for bits in [1, 20, 60, 150] {
        assert_enclosure(polytope, bits, &total);
    }
}

fn assert_enclosure<const D: usize>(polytope: &Polytope<D>, bits: u32, measure: &Rational) {
    let [low, high] = polytope.measure_enclosure(bits);
    assert!(low.numer().is_positive() && low <= *measure && *measure <= high);
    assert!((&high - &low) * (Integer::ONE << bits) <= low);
    for end in [&low, &high] {
        let digits = end.numer().bits() - end.numer().trailing_zeros().unwrap_or(0);
        assert!(end.denom().is_power_of_two() && digits <= u64::from(bits) + 8);
    }
}

/// The rows with the sides of a box so large that it cuts off nothing but directions of infinity.
fn with_box<const D: usize>(rows: &[HalfSpace<D>], size: &Integer) -> Vec<HalfSpace<D>> {
    let mut all = rows.to_vec();
    for axis in 0..D {
        for sign in [1, -1] {
            let mut normal = std::array::from_fn(|_| Integer::ZERO);
            normal[axis] = Integer::from(sign);
            all.push(HalfSpace {
                normal,
                constant: size.clone(),
            });
        }
    }
    all
}

/// [`intersect`] against [`enumerate`], whatever comes out.
fn assert_intersection<const D: usize>(rows: &[HalfSpace<D>]) {
    let empty = |row: &HalfSpace<D>| row.normal.iter().all(Integer::is_zero) && row.constant.is_negative();
    if rows.iter().any(empty) {
        assert!(matches!(intersect(rows), Intersection::Empty));
        return;
    }
    let bits = rows
        .iter()
        .flat_map(|row| row.normal.iter().chain([&row.constant]))
        .map(Integer::bits);
    let size = Integer::ONE << (4 * bits.max().unwrap_or(0) + 8) as u32;
    let vertices = enumerate(&with_box(rows, &size));
    let at_box = vertices.iter().any(|point| {
        point
            .iter()
            .any(|x| *x == Rational::from_integer(size.clone()) || *x == Rational::from_integer(-&size))
    });
    let points: Vec<[Rational; D]> = vertices.iter().cloned().collect();
    let rank = affine_rank(&points);
    match intersect(rows) {
        Intersection::Empty => assert!(vertices.is_empty()),
        Intersection::Flat(flat) => {
            assert!(!vertices.is_empty() && flat.dimension < D);
            assert_eq!(flat.dimension, rank);
            assert_eq!(flat.bounded, !at_box);
            assert!(rows.iter().all(|row| !row.value(&flat.point).numer().is_negative()));
        }
        Intersection::Unbounded => assert!(at_box && rank == D),
        Intersection::Bounded(polytope) => {
            assert!(!at_box && rank == D);
            assert_polytope(rows, &polytope, &vertices);
        }
    }
}

#[test]
fn zero_normals_decide_alone() {
    let square: Vec<HalfSpace<2>> = [[1, 0, 1], [-1, 0, 1], [0, 1, 1], [0, -1, 1]]
        .map(|row| plane(&row))
        .to_vec();
    for (constant, empty) in [(1, false), (0, false), (-1, true)] {
        for at in [0, 2, 4] {
            let mut rows = square.clone();
            rows.insert(at, plane(&[0, 0, constant]));
            assert_eq!(matches!(intersect(&rows), Intersection::Empty), empty);
            assert_intersection(&rows);
        }
        assert_eq!(
            matches!(intersect(&[plane::<3>(&[0, 0, 0, constant])]), Intersection::Empty),
            empty
        );
    }
    assert!(matches!(intersect::<2>(&[]), Intersection::Unbounded));
    assert!(matches!(intersect::<3>(&[]), Intersection::Unbounded));
}

#[test]
fn all_outcomes_in_the_plane() {
    let cases: [&[[i64; 3]]; 14] = [
        &[[1, 0, 0]],
        &[[1, 1, 0], [-1, -1, 0]],
        &[[1, 1, 0], [-1, -1, -1]],
        &[[1, 1, 0], [-1, -1, 1]],
        &[[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]],
        &[[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 2]],
        &[[1, 0, 0], [-1, 0, -1]],
        &[[1, 2, 0], [-2, 1, 0], [1, -3, 0]],
        &[[1, 2, -1], [-2, 1, -1], [1, -3, -1]],
        &[[1, 2, 1], [-2, 1, 1], [1, -3, 1]],
        &[[1, 2, 1], [2, 4, 2], [-2, 1, 1], [1, -3, 1], [3, 6, 3], [1, -3, 2]],
        &[
            [2, 0, 2],
            [1, 0, 1],
            [-3, 0, 3],
            [0, 1, 1],
            [0, -1, 1],
            [1, 1, 2],
            [1, 1, 3],
            [-1, 0, 1],
        ],
        &[[1, 1, 0], [-1, -1, 0], [1, -1, 0], [-1, 1, -1]],
        &[[1, 1, 0], [-1, -1, 0], [1, -1, 0], [-1, 1, 0]],
    ];
    let mut seen = [0; 4];
    for rows in cases {
        let rows: Vec<HalfSpace<2>> = rows.iter().map(|row| plane(row)).collect();
        assert_intersection(&rows);
        seen[match intersect(&rows) {
            Intersection::Empty => 0,
            Intersection::Flat(_) => 1,
            Intersection::Unbounded => 2,
            Intersection::Bounded(_) => 3,
        }] += 1;
    }
    assert_eq!(seen, [4, 5, 2, 3]);
}

#[test]
fn all_outcomes_in_space() {
    let cube = [
        [1, 0, 0, 1],
        [-1, 0, 0, 1],
        [0, 1, 0, 1],
        [0, -1, 0, 1],
        [0, 0, 1, 1],
        [0, 0, -1, 1],
    ];
    let cases: [(&[[i64; 4]], &str); 12] = [
        (&[], "bounded"),
        (&[[1, 1, 1, 0]], "bounded"),
        // Through three vertices, then touching one, an edge and a facet.
        (&[[-1, -1, -1, 1]], "bounded"),
        (&[[1, 1, 1, 3]], "bounded"),
        (&[[1, 1, 0, 2]], "bounded"),
        (&[[5, 0, 0, 5]], "bounded"),
        (&[[1, 1, 1, -3]], "flat 0"),
        (&[[1, 1, 0, -2]], "flat 1"),
        (&[[1, 0, 0, -1]], "flat 2"),
        (&[[1, 1, 1, 0], [-1, -1, -1, 0]], "flat 2"),
        (
            &[
                [1, 1, 1, 0],
                [-1, -1, -1, 0],
                [1, -1, 0, 0],
                [-1, 1, 0, 0],
                [3, 0, 1, 0],
                [0, 0, 0, 0],
            ],
            "flat 1",
        ),
        (&[[1, 1, 1, -4]], "empty"),
    ];
    for (more, expected) in cases {
        let rows: Vec<HalfSpace<3>> = cube.iter().chain(more).map(|row| plane(row)).collect();
        assert_intersection(&rows);
        let found = match intersect(&rows) {
            Intersection::Empty => "empty".to_string(),
            Intersection::Flat(flat) => format!("flat {}", flat.dimension),
            Intersection::Unbounded => "unbounded".to_string(),
            Intersection::Bounded(_) => "bounded".to_string(),
        };
        assert_eq!(found, expected, "{more:?}");
        // Without one side.
        assert_intersection(&rows[1..]);
        assert_intersection(&rows[3..]);
    }
    let line = [[1, 1, 0, 0], [-1, -1, 0, 0], [0, 1, 1, 0], [0, -1, -1, 0]].map(|row| plane::<3>(&row));
    let Intersection::Flat(flat) = intersect(&line) else {
        panic!("a line was expected")
    };
    assert_eq!((flat.dimension, flat.bounded), (1, false));
}

#[test]
fn many_facets_meet_in_one_vertex() {
    // A pyramid over a polygon with 12 sides, and two of them base to base, cut off at the tips' height.
    let directions: Vec<[i64; 2]> = [[0, 5], [3, 4], [4, 3]]
        .into_iter()
        .flat_map(|[x, y]| [[x, y], [y, -x], [-x, -y], [-y, x]])
        .collect();
    let mut rows: Vec<HalfSpace<3>> = directions.iter().map(|[x, y]| plane(&[*x, *y, -5, 5])).collect();
    rows.push(plane(&[0, 0, 1, 2]));
    assert_intersection(&rows);
    rows.extend(directions.iter().map(|[x, y]| plane(&[*x, *y, 5, 5])));
    rows.extend([plane(&[0, 0, 1, 1]), plane(&[0, 0, -1, 1])]);
    let double = bounded(&rows);
    assert_eq!((double.vertex_count(), double.facet_count()), (14, 24));
    assert!((0..14).any(|vertex| double.vertex_facets(vertex).len() == 12));
    assert_intersection(&rows[12..]);
}

#[test]
fn rows_that_differ_in_late_bits() {
    for shift in [60, 130, 3000] {
        let unit = Integer::ONE << shift;
        let row = |x: i64, y: i64, less: i64| HalfSpace {
            normal: [Integer::from(x) * &unit, Integer::from(y) * &unit - Integer::from(less)],
            constant: unit.clone(),
        };
        // Five nearly equal upper sides through (0, 1), and the same again, one bit tighter.
        let mut rows: Vec<HalfSpace<2>> = (0..5).map(|i| row(0, -1, 0).tilted(i - 2)).collect();
        let tighter = rows.clone().into_iter().map(|row| HalfSpace {
            constant: &unit - Integer::ONE,
            ..row
        });
        rows.extend(tighter);
        rows.extend([row(1, 0, 0), row(-1, 0, 0), row(0, 1, 0), row(0, 1, 0), row(0, 1, -1)]);
        assert_intersection(&rows);
        let Intersection::Bounded(polygon) = intersect(&rows) else {
            panic!("a polygon was expected")
        };
        let facets: BTreeSet<usize> = polygon.facets().map(|facet| facet.row).collect();
        assert_eq!(facets, BTreeSet::from([5, 9, 10, 11, 14]));
    }
}

impl HalfSpace<2> {
    fn tilted(mut self, by: i64) -> Self {
        self.normal[0] += Integer::from(by);
        self
    }
}

#[test]
fn huge_and_tiny_extents() {
    for exponent in [0, 500, 2000, 5000] {
        let far = Integer::ONE << exponent;
        // 0 ≤ x, y, z with x + y + z ≤ 2^exponent, and with 2^exponent (x + y + z) ≤ 1.
        let mut rows = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [-1, -1, -1, 1]].map(|row| plane::<3>(&row));
        rows[3].constant = far.clone();
        assert_eq!(bounded(&rows).measure(), Rational::new(far.pow(3), Integer::from(6)));
        assert_enclosure(&bounded(&rows), 50, &bounded(&rows).measure());
        rows[3] = HalfSpace {
            normal: [-&far, -&far, -&far],
            constant: Integer::ONE,
        };
        assert_eq!(
            bounded(&rows).measure(),
            Rational::new(Integer::ONE, far.pow(3) * Integer::from(6))
        );
        assert_enclosure(&bounded(&rows), 50, &bounded(&rows).measure());
        // Thin and far away: 2^exponent ≤ x ≤ 2^exponent + 2^-exponent, and a slanted side.
        let mut rows =
            [[1, 0, 0, 0], [-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [-1, -1, -1, 7]].map(|row| plane::<3>(&row));
        rows[0].constant = -&far;
        rows[1].normal[0] = -&far;
        rows[1].constant = &far * &far + Integer::ONE;
        rows[4].constant += &far;
        let thin = bounded(&rows);
        assert_eq!((thin.vertex_count(), thin.facet_count()), (6, 5));
        assert_enclosure(&thin, 50, &thin.measure());
    }
}

fn bounded<const D: usize>(rows: &[HalfSpace<D>]) -> Polytope<D> {
    match intersect(rows) {
        Intersection::Bounded(polytope) => polytope,
        other => panic!("a polytope was expected, not {other:?}"),
    }
}

#[test]
fn thousands_of_rows() {
    // Tangents of the parabola y = x² meet halfway between where they touch.
    let mut rows: Vec<HalfSpace<2>> = (-1500..=1500).map(|k| plane(&[-2 * k, 1, k * k])).collect();
    rows.push(plane(&[0, -1, 1_000_000_000]));
    let polygon = bounded(&rows);
    assert_eq!((polygon.vertex_count(), polygon.facet_count()), (3002, 3002));
    let vertices: BTreeSet<[Rational; 2]> = (0..3002).map(|i| polygon.vertex(i)).collect();
    assert!((-1500..1500).all(|k| {
        let half = Rational::new(Integer::from(2 * k + 1), Integer::from(2));
        vertices.contains(&[half, integer(k * (k + 1))])
    }));
    // Planes that touch z = x² + y² above the points of a grid: four meet above the middle of each square, and above each side of the grid's
    // boundary there are an edge and a corner of the top.
    let m = 15;
    let grid = (-m..=m).flat_map(|a| (-m..=m).map(move |b| [a, b]));
    let mut rows: Vec<HalfSpace<3>> = grid.map(|[a, b]| plane(&[-2 * a, -2 * b, 1, a * a + b * b])).collect();
    rows.push(plane(&[0, 0, -1, 1_000_000]));
    let bowl = bounded(&rows);
    let (squares, sides) = (4 * m * m, 8 * m);
    assert_eq!(bowl.vertex_count() as i64, squares + sides);
    assert_eq!(bowl.facet_count() as i64, (2 * m + 1) * (2 * m + 1) + 1);
    let fourfold = (0..bowl.vertex_count()).filter(|vertex| bowl.vertex_facets(*vertex).len() == 4);
    assert_eq!(fourfold.count() as i64, squares);
    assert_enclosure(&bowl, 40, &bowl.measure());
}

#[test]
fn clipping_leaves_what_it_does_not_cut() {
    let mut square = Polytope::from_box(&[integer(-1), integer(-1)], &[integer(1), integer(1)]).unwrap();
    assert!(Polytope::from_box(&[integer(1), integer(-1)], &[integer(1), integer(1)]).is_none());
    for (row, expected) in [
        ([1, 1, 2], Clip::Redundant),
        ([1, 1, -2], Clip::Flat),
        ([1, 1, -3], Clip::Empty),
        ([1, 0, -1], Clip::Flat),
        ([0, 0, -1], Clip::Empty),
        ([0, 0, 0], Clip::Redundant),
    ] {
        assert_eq!(square.clip(&plane(&row), 9), expected);
        assert_eq!(square.measure(), integer(4));
        assert_eq!(square.facets().map(|facet| facet.row).collect::<Vec<_>>(), [0, 1, 2, 3]);
    }
    assert_eq!(square.clip(&plane(&[1, 1, 0]), 9), Clip::Cut);
    assert_eq!(square.clip(&plane(&[2, 2, 0]), 10), Clip::Redundant);
    assert_eq!(square.measure(), integer(2));
    let rows: Vec<usize> = square.cycle().into_iter().map(|(_, row)| row).collect();
    let start = rows.iter().position(|row| *row == 9).unwrap();
    assert_eq!([0, 1, 2].map(|i| rows[(start + i) % 3]), [9, 1, 3]);
}

#[test]
fn hulls() {
    let point = |[x, y]: [i64; 2]| [integer(x), integer(y)];
    let points = [[0, 0], [4, 0], [2, 0], [4, 4], [0, 4], [2, 2], [4, 0], [1, 3]].map(point);
    let hull = hull2(&points, &point([1, 2])).unwrap();
    let start = hull.iter().position(|i| *i == 0).unwrap();
    assert_eq!([0, 1, 2, 3].map(|i| hull[(start + i) % 4]), [0, 1, 3, 4]);
    for outside in [[0, 0], [2, 0], [5, 2]] {
        assert_eq!(hull2(&points, &point(outside)), Err(HullError::NotInterior));
    }
    assert_eq!(hull2(&points[..3], &point([1, 0])), Err(HullError::NotInterior));
    assert_eq!(hull2(&[], &point([1, 0])), Err(HullError::NotInterior));
    let corners: Vec<[Rational; 3]> = (0..27).map(|i| [i % 3, i / 3 % 3, i / 9].map(integer)).collect();
    let triangles = hull3(&corners, &[integer(1), integer(1), integer(1)]).unwrap();
    assert_eq!(triangles.len(), 12);
    let volume: Rational = triangles
        .iter()
        .map(|[a, b, c]| -orientation(&corners[*a], &corners[*b], &corners[*c], &corners[13]))
        .sum();
    assert_eq!(volume, integer(48));
}

/// Coefficients of which many are small, so that rows meet in many ways.
fn coefficient() -> impl Strategy<Value = i64> {
    prop_oneof![8 => -3_i64..=3, 1 => -100_i64..=100]
}

fn half_space<const D: usize>() -> impl Strategy<Value = HalfSpace<D>> {
    // Mostly around the origin, so that many results are bounded with interior.
    let constant = prop_oneof![10 => 1_i64..=8, 2 => Just(0), 1 => -3_i64..0];
    let factor = prop_oneof![6 => Just(Integer::ONE), 1 => (1_i64..4).prop_map(Integer::from), 1 => (0_u32..300).prop_map(|bits| (Integer::ONE << bits) + Integer::ONE)];
    (prop::collection::vec(coefficient(), D), constant, factor).prop_map(|(normal, constant, factor)| HalfSpace {
        normal: std::array::from_fn(|i| Integer::from(normal[i]) * &factor),
        constant: Integer::from(constant) * &factor,
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn plane_by_enumeration(rows in prop::collection::vec(half_space::<2>(), 0..14)) {
        assert_intersection(&rows);
    }

    #[test]
    fn space_by_enumeration(rows in prop::collection::vec(half_space::<3>(), 0..11)) {
        assert_intersection(&rows);
    }

    #[test]
    fn row_by_row(rows in prop::collection::vec(half_space::<3>(), 1..9)) {
        let sides = [[1, 0, 0, 3], [-1, 0, 0, 3], [0, 1, 0, 3], [0, -1, 0, 3], [0, 0, 1, 3], [0, 0, -1, 3]];
        let mut all: Vec<HalfSpace<3>> = sides.iter().map(|side| plane(side)).collect();
        let mut polytope = Polytope::from_box(&[-3, -3, -3].map(integer), &[3, 3, 3].map(integer)).unwrap();
        for row in rows {
            let before = polytope.measure();
            let clip = polytope.clip(&row, all.len());
            all.push(row);
            let after = intersect(&all);
            prop_assert_eq!(polytope.measure() == before, clip != Clip::Cut);
            prop_assert!(polytope.measure() <= before);
            match clip {
                Clip::Empty => prop_assert!(matches!(after, Intersection::Empty)),
                Clip::Flat => prop_assert!(matches!(after, Intersection::Flat(_))),
                Clip::Redundant | Clip::Cut => assert_polytope(&all, &polytope, &enumerate(&all)),
            }
            if matches!(clip, Clip::Empty | Clip::Flat) {
                all.pop();
            }
        }
    }

    #[test]
    fn perturbed_rows(
        rows in prop::collection::vec((half_space::<3>(), prop::array::uniform4(-1_i64..=1)), 3..7),
        bits in 40_u32..90,
    ) {
        // Coincidences broken in a late bit.
        let rows: Vec<HalfSpace<3>> = rows.into_iter().map(|(row, by)| HalfSpace {
            normal: std::array::from_fn(|i| (&row.normal[i] << bits) + Integer::from(by[i])),
            constant: (&row.constant << bits) + Integer::from(by[3]),
        }).collect();
        assert_intersection(&rows);
    }

    #[test]
    fn hull_of_points(points in prop::collection::vec(prop::array::uniform3(-4_i64..=4), 0..30)) {
        let points: Vec<[Rational; 3]> = points.into_iter().map(|point| point.map(integer)).collect();
        let origin = [0, 0, 0].map(integer);
        // Volume of the hull as of its double polar, with the rows through three points each.
        if let Ok(triangles) = hull3(&points, &origin) {
            for [a, b, c] in &triangles {
                let [a, b, c] = [a, b, c].map(|i| points[*i].as_slice());
                prop_assert!(orientation(a, b, c, &origin).numer().is_negative());
                for point in &points {
                    prop_assert!(!orientation(a, b, c, point).numer().is_positive());
                }
            }
            let edges: BTreeSet<(usize, usize)> = triangles.iter().flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)]).collect();
            prop_assert_eq!(edges.len(), 3 * triangles.len());
            prop_assert!(edges.iter().all(|(a, b)| edges.contains(&(*b, *a))));
        } else {
            // Then some closed half-space through the origin contains all points: one spanned by two of them, if they span space at all.
            let separated = points.iter().any(|a| points.iter().any(|b| {
                [1, -1].iter().any(|sign| points.iter().all(|c| {
                    let value = orientation(&origin, a, b, c) * Integer::from(*sign);
                    !value.numer().is_negative()
                }))
            }));
            prop_assert!(separated || points.is_empty());
        }
    }
}
