//! Double normals from Delaunay starts against an exhaustive search.

use super::double_normal::{Candidate, find};
use super::generate::Random;
use super::piece::{Pieces, dot, middle, sub};
use super::search_tests::{file, root};
use super::tree::Tree;
use super::*;

/// A random closed C¹ planar cubic around a circle: many strands face each other.
fn wavy(random: &mut Random) -> Curve {
    let count = 5 + random.below(8);
    let knots = (0..count + 7).map(|k| k as f64).collect();
    let mut points: Vec<f64> = (0..count)
        .flat_map(|i| {
            let (sin, cos) = (i as f64 * std::f64::consts::TAU / count as f64).sin_cos();
            let radius = 1.0 + 0.9 * random.signed();
            [radius * cos, radius * sin]
        })
        .collect();
    points.extend_from_within(..6);
    Curve::new(2, 3, knots, points, None).unwrap()
}

/// The curves of `certs/curves` in the plane.
fn planar_corpus() -> Vec<(String, Curve)> {
    let folder = std::fs::read_dir(format!("{}/certs/curves", root())).unwrap();
    let mut names: Vec<String> = folder
        .map(|entry| {
            entry
                .unwrap()
                .path()
                .file_stem()
                .unwrap()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    let curves = names.into_iter().map(|name| (name.clone(), file(&name)));
    curves.filter(|(_, curve)| curve.dimension() == 2).collect()
}

/// All double normals: pairs of parts are halved until both are `halvings` times halved pieces, and dropped only where the hulls of their points and tangents
/// show that there is none, as `minimum_separation` does but at any length; Newton's method from the middle of each pair that is left.
fn exhaustive(curve: &Curve, halvings: u32) -> Vec<Candidate> {
    let pieces = Pieces::new(curve, &middle(curve));
    let mut tree = Tree::new(&pieces);
    let mut open = vec![(tree.root(), tree.root())];
    let mut found = Vec::new();
    while let Some((a, b)) = open.pop() {
        let dropped = if a == b {
            tree.is_acute(a, a)
        } else if tree.adjacent(a, b) {
            tree.is_acute(a, b) || tree.is_bend(a, b)
        } else {
            tree.not_normal(a, b)
        };
        if dropped {
            continue;
        }
        let whole = |tree: &Tree, a: u32| tree.middle(a).is_none() || tree.depth(a) < halvings;
        let (split_a, split_b) = (whole(&tree, a), whole(&tree, b));
        if a == b && split_a {
            let (left, right) = tree.children(a);
            open.extend([(left, left), (left, right), (right, right)]);
        } else if split_a && (!split_b || tree.size(a) >= tree.size(b)) {
            let (left, right) = tree.children(a);
            open.extend([(left, b), (right, b)]);
        } else if split_b {
            let (left, right) = tree.children(b);
            open.extend([(a, left), (a, right)]);
        } else if let (Some(s), Some(t)) = (tree.middle(a), tree.middle(b)) {
            found.extend(find(&pieces, s, t));
        }
    }
    found
}

/// Which of the double normals `all` are not among `found`. One of a continuum (the diameters of a circle) is there when another one of its length is.
fn missed(curve: &Curve, all: &[Candidate], found: &[Separation]) -> Vec<(f64, f64, f64)> {
    let pieces = Pieces::new(curve, &middle(curve));
    let (start, end) = curve.domain();
    let near = |s: f64, t: f64| {
        let apart = (s - t).abs();
        apart < 1e-6 * (end - start) || pieces.closed && end - start - apart < 1e-6 * (end - start)
    };
    let mut missed = Vec::new();
    for normal in all {
        let [s, t] = [normal.s, normal.t].map(|(piece, u)| pieces.all[piece].parameter(u));
        let ([p, p1, p2], [q, q1, q2]) = (
            pieces.all[normal.s.0].evaluate(normal.s.1),
            pieces.all[normal.t.0].evaluate(normal.t.1),
        );
        let x = sub(&p, &q);
        let (a, d) = (dot(&p1, &p1) + dot(&x, &p2), dot(&x, &q2) - dot(&q1, &q1));
        let cross = dot(&p1, &q1);
        let continuum = (a * d + cross * cross).abs() < 1e-6 * (dot(&p1, &p1) * dot(&q1, &q1));
        let there = |other: &Separation| {
            let (a, b) = other.parameters;
            let same = (other.distance - normal.length).abs() <= 1e-9 * pieces.scale;
            same && (continuum || near(a, s) && near(b, t) || near(a, t) && near(b, s))
        };
        if !found.iter().any(there) {
            missed.push((s, t, normal.length));
        }
    }
    missed
}

#[test]
fn normals_through_a_triangulation_miss_no_double_normal() {
    let show = std::env::var("KNOTPROOF_SHOW_ERRORS").is_ok();
    let mut random = Random(11);
    let made = (0..40).map(|i| (format!("made {i}"), wavy(&mut random)));
    let (mut few, mut many, mut count, mut missing) = (0, 0, 0, 0);
    for (name, curve) in planar_corpus().into_iter().chain(made) {
        let halvings = if name.starts_with("made") { 6 } else { 7 };
        let all = exhaustive(&curve, halvings);
        let walked = curve.double_normals(Starts::Delaunay { samples: 4 }).unwrap();
        let grid = curve.double_normals(Starts::Grid { samples: 10 }).unwrap();
        let missed_by_walk = missed(&curve, &all, &walked.found);
        if show {
            println!(
                "{name}: {} of all; walk {} starts, {} found, {} missed; grid {} starts, {} found, {} missed {:?}",
                all.len(),
                walked.starts,
                walked.found.len(),
                missed_by_walk.len(),
                grid.starts,
                grid.found.len(),
                missed(&curve, &all, &grid.found).len(),
                missed_by_walk.first()
            );
        }
        few += walked.starts;
        many += grid.starts;
        count += walked.found.len();
        missing += missed_by_walk.len();
    }
    if show {
        println!("{few} and {many} starts, {count} found, {missing} missed");
    }
    assert_eq!(missing, 0, "missed");
    assert!(10 * few < many, "{few} and {many} starts");
}

#[test]
fn delaunay_starts_are_for_the_plane() {
    let space = file("trefoil-24").double_normals(Starts::Delaunay { samples: 8 });
    assert_eq!(space, Err(FloatError::Dimension));
    let plane = file("square");
    assert!(plane.double_normals(Starts::Delaunay { samples: 0 }).is_err());
    assert!(plane.double_normals(Starts::Grid { samples: 1 }).is_err());
}
