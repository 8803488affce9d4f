//! The engine of the claim `motion`: what a table of leaves says of moving points, by steps and as a whole, against every obligation computed anew; the measures of the criteria
//! against their definitions.

use knotproof::check::motion::{
    Criteria, Greatests, Moved, Node, Positions, Shape, Table, bound_factor, nu_squared, polygon,
};
use knotproof::claim::motion::Move;
use knotproof::claim::tree::{Leaf, Token, TokenError, TokenSource};
use knotproof::curve::{BSpline, Bezier, Curve, Form};
use knotproof::number::{Integer, Rational, RationalVector};
use proptest::prelude::*;

/// Tokens in memory.
struct List(std::vec::IntoIter<Token>);

impl TokenSource for List {
    fn next_token(&mut self) -> Result<Option<Token>, TokenError> {
        Ok(self.0.next())
    }
}

fn list(tokens: Vec<Token>) -> List {
    List(tokens.into_iter())
}

fn vector(coordinates: Vec<Integer>) -> RationalVector {
    RationalVector::from_parts(coordinates, Integer::ONE).expect("denominator 1")
}

/// Which kind of curve.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Polynomial,
    Rational,
    Spline,
    ClosedSpline,
}

/// Points around a circle of radius 1000 (in space a little up and down), each moved a little.
fn round(count: usize, dimension: usize, noise: &[i64]) -> Vec<Vec<i64>> {
    let point = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / count as f64;
        let place = [angle.cos() * 1000.0, angle.sin() * 1000.0, (2.0 * angle).sin() * 200.0];
        let axis = |i: usize| place[i].round() as i64 + noise[(k * 3 + i) % noise.len()];
        (0..dimension).map(axis).collect()
    };
    (0..count).map(point).collect()
}

/// A curve of cubic pieces around the origin, with all coordinates times `scale`.
fn curve(kind: Kind, dimension: usize, noise: &[i64], scale: &Integer) -> Curve {
    let pieces = 4;
    let flat =
        |points: &[Vec<i64>]| -> Vec<Integer> { points.iter().flatten().map(|x| Integer::from(*x) * scale).collect() };
    let form = match kind {
        Kind::Polynomial | Kind::Rational => {
            let points = round(3 * pieces, dimension, noise);
            let piece = |i: usize| {
                let of_piece: Vec<Vec<i64>> = (0..4).map(|k| points[(3 * i + k) % points.len()].clone()).collect();
                let weights = matches!(kind, Kind::Rational).then(|| vector([3, 2, 4, 5].map(Integer::from).to_vec()));
                Bezier::new(dimension, vector(flat(&of_piece)), weights).expect("a piece")
            };
            Form::Bezier((0..pieces).map(piece).collect())
        }
        Kind::Spline => {
            // Three quarters of the round, knots clamped at one end only.
            let points = round(12, dimension, noise)[..9].to_vec();
            let knots = [0, 0, 0, 0, 1, 2, 4, 5, 6, 8, 9, 10, 11].map(Integer::from);
            let spline = BSpline::new(dimension, 3, vector(knots.to_vec()), vector(flat(&points)), None);
            Form::BSpline(spline.expect("a spline"))
        }
        Kind::ClosedSpline => {
            let mut points = round(8, dimension, noise);
            points.extend_from_within(..3);
            let knots = (0..15).map(Integer::from).collect();
            let spline = BSpline::new(dimension, 3, vector(knots), vector(flat(&points)), None);
            Form::BSpline(spline.expect("a spline"))
        }
    };
    Curve::new(dimension, form).expect("a curve")
}

/// Vectors to try.
fn directions(dimension: usize) -> Vec<[Integer; 3]> {
    let range = || -2i64..=2;
    let all = range().flat_map(|x| range().flat_map(move |y| range().map(move |z| [x, y, z])));
    let fits = |v: &[i64; 3]| *v != [0; 3] && (dimension == 3 || v[2] == 0);
    all.filter(fits).map(|v| v.map(Integer::from)).collect()
}

/// A tree for a pair, or nothing if pieces would have to be halved too often.
fn grow(table: &mut Table, positions: &Positions, a: Node, b: Option<Node>, tokens: &mut Vec<Token>) -> bool {
    let dimension = if positions.get(0)[2].is_zero() && positions.get(1)[2].is_zero() {
        2
    } else {
        3
    };
    let adjacent = b.as_ref().is_none_or(|b| table.shape().adjacent(&a, b));
    for n in directions(dimension) {
        let leaf = if adjacent { Leaf::Monotone(n) } else { Leaf::Separate(n) };
        if table.obligation(positions, &a, b.as_ref(), &leaf).is_ok() {
            tokens.push(Token::Leaf(leaf));
            return true;
        }
    }
    let deep = |node: &Node| matches!(node, Node::Part { depth: 5.., .. });
    if deep(&a) || b.as_ref().is_some_and(deep) {
        return false;
    }
    let size = |node: &Node| match *node {
        Node::Run { first, last } => (last - first) as f64,
        Node::Part { depth, .. } => 0.5f64.powi(depth as i32),
    };
    match b {
        None => {
            let (left, right) = a.halves().expect("not deep");
            tokens.push(Token::Split);
            grow(table, positions, left, None, tokens)
                && grow(table, positions, left, Some(right), tokens)
                && grow(table, positions, right, None, tokens)
        }
        Some(b) if size(&a) >= size(&b) => {
            let (left, right) = a.halves().expect("not deep");
            tokens.push(Token::First);
            grow(table, positions, left, Some(b), tokens) && grow(table, positions, right, Some(b), tokens)
        }
        Some(b) => {
            let (left, right) = b.halves().expect("not deep");
            tokens.push(Token::Second);
            grow(table, positions, a, Some(left), tokens) && grow(table, positions, a, Some(right), tokens)
        }
    }
}

/// All leaves that do not hold, each computed anew.
fn failing_anew(table: &mut Table, positions: &Positions) -> Vec<u64> {
    let numbers: Vec<u64> = (0..table.next_number()).collect();
    let mut found = Vec::new();
    for number in numbers {
        if let Some((a, b, leaf)) = table.leaf(number)
            && table.obligation(positions, &a, b.as_ref(), &leaf).is_err()
        {
            found.push(number);
        }
    }
    found
}

/// A move of some points, in the plane if `dimension` is 2.
fn displacements(of: &[(usize, [i64; 3])], count: usize, dimension: usize, scale: &Integer) -> (Move, Move) {
    let mut by = std::collections::BTreeMap::new();
    for (point, vector) in of {
        by.insert(point % count, *vector);
    }
    let (mut there, mut back) = (Move::new(), Move::new());
    for (point, vector) in by {
        let vector = [0, 1, 2].map(|i| {
            if i < dimension {
                Integer::from(vector[i]) * scale
            } else {
                Integer::ZERO
            }
        });
        if vector.iter().any(|x| !x.is_zero()) {
            there.push(point as u64, vector.clone()).expect("in order");
            back.push(point as u64, vector.map(|x| -x)).expect("in order");
        }
    }
    (there, back)
}

/// One step of a motion: which points, by what; and which leaf is edited before.
type Step = (Vec<(usize, [i64; 3])>, Option<prop::sample::Index>);

fn steps() -> impl Strategy<Value = Vec<Step>> {
    let small = prop::array::uniform3(-40i64..40);
    let large = prop::array::uniform3(-700i64..700);
    let vector = prop_oneof![4 => small, 1 => large];
    let few = prop::collection::vec((0usize..20, vector), 0..4);
    let drift = prop::array::uniform3(-5i64..5);
    let all = drift.prop_map(|by| (0..20).map(|k| (k, by.map(|x| x * (k as i64 % 3)))).collect::<Vec<_>>());
    prop::collection::vec(
        (
            prop_oneof![3 => few, 1 => all],
            prop::option::of(any::<prop::sample::Index>()),
        ),
        1..10,
    )
}

/// Follows a motion with a table and compares every answer; returns how many leaves there were and how often some failed.
fn follow(
    kind: Kind,
    dimension: usize,
    of_polygon: bool,
    noise: &[i64],
    scale: &Integer,
    steps: &[Step],
) -> (usize, Vec<Vec<u64>>) {
    let curve = curve(kind, dimension, noise, scale);
    let edges = polygon(&curve).expect("few edges");
    let mut positions = Positions::new(&curve, &Integer::ONE).expect("integers");
    let mut table = Table::new(Shape::new(if of_polygon { &edges } else { &curve }));
    let whole = table.shape().whole();
    let mut tokens = Vec::new();
    if !grow(&mut table, &positions, whole, None, &mut tokens) {
        return (0, Vec::new());
    }
    let count = tokens.len() as u64;
    assert_eq!(table.plant(&positions, &mut list(tokens)), Ok(count));
    let leaves = table.count();
    let mut answers = Vec::new();
    for (moved, edited) in steps {
        if let Some(edited) = edited {
            let number = edited.index(table.next_number() as usize) as u64;
            if let Some((a, b, leaf)) = table.leaf(number) {
                // Both halves of a pair of two nodes hold where the pair does.
                let half = Token::Leaf(leaf.clone());
                let tokens = match b {
                    Some(_) if matches!(leaf, Leaf::Separate(_)) && a.halves().is_some() => {
                        vec![Token::First, half.clone(), half]
                    }
                    _ => vec![half],
                };
                let count = tokens.len() as u64;
                assert_eq!(table.replace(&positions, number, &mut list(tokens)), Some(Ok(count)));
                assert_eq!(table.leaf(number), None);
                assert_eq!(table.replace(&positions, number, &mut list(Vec::new())), None);
            }
        }
        let (there, back) = displacements(moved, positions.count(), dimension, scale);
        let halfway = positions.between(&there, 3, 2).expect("points of the curve");
        positions.apply(&there).expect("points of the curve");
        let found = table.failing(&positions, Moved::By(&there));
        assert_eq!(found, failing_anew(&mut table, &positions));
        assert_eq!(table.failing(&positions, Moved::All), found);
        if found.is_empty() {
            // What holds at both ends of a move holds on the way.
            assert_eq!(table.failing(&halfway, Moved::All), Vec::<u64>::new());
            assert_eq!(table.failing(&positions, Moved::All), Vec::<u64>::new());
        } else {
            positions.apply(&back).expect("points of the curve");
            assert_eq!(table.check(&positions, Moved::All), None);
        }
        answers.push(found);
    }
    (leaves, answers)
}

fn kinds() -> impl Strategy<Value = (Kind, usize, bool)> {
    let kind = prop_oneof![
        Just((Kind::Polynomial, false)),
        Just((Kind::Polynomial, true)),
        Just((Kind::Rational, false)),
        Just((Kind::Rational, true)),
        Just((Kind::Spline, false)),
        Just((Kind::Spline, true)),
        Just((Kind::ClosedSpline, false)),
    ];
    (kind, 2usize..=3).prop_map(|((kind, of_polygon), dimension)| (kind, dimension, of_polygon))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Looking at what a move touches finds the same as looking at everything, in every width of numbers.
    #[test]
    fn a_table_finds_what_fails((kind, dimension, of_polygon) in kinds(), noise in prop::collection::vec(-30i64..30, 13), steps in steps()) {
        let (leaves, answers) = follow(kind, dimension, of_polygon, &noise, &Integer::ONE, &steps);
        prop_assert!(leaves > 0 || dimension == 3, "no tree was found");
        // 10^11: 64 bits hold positions, but no products; 10^30: they hold neither.
        for exponent in [11, 30] {
            let scale = Integer::from(10).pow(exponent);
            let scaled = follow(kind, dimension, of_polygon, &noise, &scale, &steps);
            prop_assert_eq!(&scaled.1, &answers);
        }
    }

    /// Measures kept up to date are those of the definition.
    #[test]
    fn criteria_follow_their_definition(
        (kind, dimension) in (prop_oneof![Just(Kind::Polynomial), Just(Kind::Spline), Just(Kind::ClosedSpline)], 2usize..=3),
        noise in prop::collection::vec(-30i64..30, 13),
        steps in steps(),
        exponent in prop_oneof![Just(0u32), Just(25)],
    ) {
        let scale = Integer::from(10).pow(exponent);
        let curve = curve(kind, dimension, &noise, &scale);
        let denominator = Integer::from(6);
        let start = Positions::new(&curve, &denominator).expect("integers");
        let mut shape = Shape::new(&curve);
        let mut positions = start.clone();
        let mut criteria = Criteria::new(&mut shape, &start, &denominator).expect("polynomial pieces");
        for (moved, _) in &steps {
            let (there, _) = displacements(moved, positions.count(), dimension, &scale);
            positions.apply(&there).expect("points of the curve");
            criteria.update(&shape, &positions, &there);
            prop_assert_eq!(criteria.greatest(), by_definition(&criteria, &shape, &start, &positions, &denominator));
        }
    }
}

fn norms(v: &[Rational; 3]) -> [Rational; 2] {
    let abs = |x: &Rational| if x.numer().is_negative() { -x } else { x.clone() };
    let most = v.iter().map(abs).max().expect("three");
    let square = v.iter().fold(Rational::default(), |sum, x| sum + x * x);
    [most, square]
}

fn by_definition(
    criteria: &Criteria,
    shape: &Shape,
    start: &Positions,
    positions: &Positions,
    denominator: &Integer,
) -> Greatests {
    let mut greatest = Greatests {
        second: Default::default(),
        moved: Default::default(),
    };
    for (piece, at) in shape.pieces.iter().enumerate() {
        let factor = bound_factor(at.last - at.first);
        for v in criteria.second_differences(shape, positions, piece) {
            let [most, square] = norms(&v);
            for (greatest, found) in greatest
                .second
                .iter_mut()
                .zip([&factor * most, &factor * &factor * square])
            {
                *greatest = greatest.clone().max(found);
            }
        }
    }
    for place in 0..positions.count() {
        let (p, q) = (positions.get(place), start.get(place));
        let v = [0, 1, 2].map(|i| Rational::new(&p[i] - &q[i], denominator.clone()));
        for (greatest, found) in greatest.moved.iter_mut().zip(norms(&v)) {
            *greatest = greatest.clone().max(found);
        }
    }
    greatest
}

/// Chains of one, two and three neighbours that move, as Cassidy, Peters, Ilies and Jordan (2014) print their second differences: §5.1, §5.2, §6.2.
///
/// Misprints there: §5.1 writes p_{j−2} − p_{j−1} + p_j for Δ₂p_{j−1} (the middle term is doubled); §6.2, type 2, writes Δ₂(p_{j−1}) − γ for the change at p_{j+1} (it is Δ₂(p_{j+1}) − γ);
/// and ‖Δ₂X₁‖ as the greatest of ‖Δ₂X₀‖ and the changed ones, which is an upper bound only: the greatest of X₀ may be among those that changed.
#[test]
fn chains_of_neighbours_as_printed() {
    let before: Vec<[i64; 2]> = vec![[0, 0], [3, 1], [5, 5], [9, 4], [12, 7], [13, 11], [20, 12], [22, 20]];
    let gamma = [[2, -1], [5, 3], [-4, 7]];
    let at = |points: &[[i64; 2]]| {
        let flat = points.iter().flatten().map(|x| Integer::from(*x)).collect();
        let piece = Bezier::new(2, vector(flat), None).expect("a piece");
        Curve::new(2, Form::Bezier(vec![piece])).expect("a curve")
    };
    let curve = at(&before);
    let mut shape = Shape::new(&curve);
    let start = Positions::new(&curve, &Integer::ONE).expect("integers");
    let first = Criteria::new(&mut shape, &start, &Integer::ONE).expect("polynomial");
    let second = |criteria: &Criteria, positions: &Positions, shape: &Shape| -> Vec<[i64; 2]> {
        let integer = |x: &Rational| x.numer().to_i64().expect("small");
        let all = criteria.second_differences(shape, positions, 0);
        all.iter().map(|v| [integer(&v[0]), integer(&v[1])]).collect()
    };
    let unmoved = second(&first, &start, &shape);
    // The changes at p_{k−1}, p_k, …; entry i of the list is Δ₂p_{i+1}.
    let k = 3;
    let changes: [&[[i64; 2]]; 3] = [
        // γ_k, −2γ_k, γ_k
        &[[2, -1], [-4, 2], [2, -1]],
        // γ_k, γ_{k+1} − 2γ_k, γ_k − 2γ_{k+1}, γ_{k+1}
        &[[2, -1], [1, 5], [-8, -7], [5, 3]],
        // γ_k, γ_{k+1} − 2γ_k, γ_k − 2γ_{k+1} + γ_{k+2}, γ_{k+1} − 2γ_{k+2}, γ_{k+2}
        &[[2, -1], [1, 5], [-12, 0], [13, -11], [-4, 7]],
    ];
    for (length, changes) in (1..).zip(changes) {
        let mut by = Move::new();
        for (i, v) in gamma[..length].iter().enumerate() {
            by.push((k + i) as u64, [v[0].into(), v[1].into(), Integer::ZERO])
                .expect("in order");
        }
        let mut positions = start.clone();
        positions.apply(&by).expect("points of the curve");
        let moved = second(&first, &positions, &shape);
        for (i, (old, new)) in unmoved.iter().zip(&moved).enumerate() {
            let change = (i + 2)
                .checked_sub(k)
                .and_then(|i| changes.get(i))
                .copied()
                .unwrap_or([0, 0]);
            assert_eq!(
                [old[0] + change[0], old[1] + change[1]],
                *new,
                "a chain of {length}, Δ₂ of point {}",
                i + 1
            );
        }
    }
    // Type 2: a joint and its neighbours by one vector, which leaves its own second difference as it is: γ, −γ, 0, −γ, γ around it.
    let mut by = Move::new();
    for point in 3..=5 {
        by.push(point, [2.into(), (-1).into(), Integer::ZERO])
            .expect("in order");
    }
    let mut positions = start.clone();
    positions.apply(&by).expect("points of the curve");
    let moved = second(&first, &positions, &shape);
    let change = |i: usize| [moved[i][0] - unmoved[i][0], moved[i][1] - unmoved[i][1]];
    let changes: Vec<[i64; 2]> = (0..6).map(change).collect();
    assert_eq!(changes, [[0, 0], [2, -1], [-2, 1], [0, 0], [-2, 1], [2, -1]]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// ν² is the least of all squared distances of vertices from edges that do not end in them.
    #[test]
    fn nu_is_the_least_distance(points in prop::collection::vec(prop::array::uniform2(-9i64..9), 3..9), closed: bool, exponent in prop_oneof![Just(0u32), Just(40)]) {
        let scale = Integer::from(10).pow(exponent);
        let mut around = points.clone();
        if closed {
            around.push(points[0]);
        }
        let edges = around.windows(2).map(|pair| {
            let flat = pair.iter().flatten().map(|x| Integer::from(*x) * &scale).collect();
            Bezier::new(2, vector(flat), None).expect("an edge")
        });
        let polygon = Curve::new(2, Form::Bezier(edges.collect())).expect("a polygon");
        let positions = Positions::new(&polygon, &Integer::from(2)).expect("integers");
        let found = nu_squared(&Shape::new(&polygon), &positions, &Integer::from(2));
        let count = around.len() - 1;
        let closed = around[0] == around[count];
        let vertices = if closed { count } else { count + 1 };
        let mut least: Option<Rational> = None;
        for (i, p) in around[..vertices].iter().enumerate() {
            for j in (0..count).filter(|j| i != *j && i != (j + 1) % vertices) {
                let (a, b) = (around[j], around[j + 1]);
                let dot = |v: [i64; 2], w: [i64; 2]| v[0] * w[0] + v[1] * w[1];
                let (along, from) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
                let square = dot(along, along);
                // The parameter of the nearest point, in [0, 1].
                let t = if square == 0 { Rational::default() } else { Rational::new(dot(along, from).into(), square.into()) };
                let t = t.clamp(Rational::default(), Rational::from_integer(1.into()));
                let axis = |i: usize| Rational::from_integer(from[i].into()) - &t * Rational::from_integer(along[i].into());
                let distance = axis(0) * axis(0) + axis(1) * axis(1);
                least = Some(least.map_or(distance.clone(), |least| least.min(distance)));
            }
        }
        let scaled = least.map(|least| least * Rational::from_integer(&scale * &scale));
        prop_assert_eq!(found, scaled);
    }
}
