//! A convex polyhedron in binary64, cut by half-spaces one after the other.

use std::collections::BTreeMap;

use super::convex_domain::{Row, between, error, value};

/// A convex polyhedron; without vertices it is empty.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ConvexSolid {
    /// The vertices. Some may agree but for rounding.
    pub vertices: Vec<[f64; 3]>,
    /// For each face the numbers of its vertices, counter-clockwise seen from outside.
    pub faces: Vec<Vec<usize>>,
}

/// What became of a cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cut {
    /// The half-space contains what is left.
    Done,
    /// Nothing is left.
    Empty,
    /// A face is cut more than once: rounding bent it.
    Doubtful,
}

impl ConvexSolid {
    /// A cube around the origin.
    pub(super) fn cube(half_width: f64) -> ConvexSolid {
        let w = half_width;
        let end = |bit: usize| if bit == 0 { -w } else { w };
        ConvexSolid {
            vertices: (0..8).map(|i| [end(i & 1), end(i & 2), end(i & 4)]).collect(),
            faces: vec![
                vec![0, 4, 6, 2],
                vec![1, 3, 7, 5],
                vec![0, 1, 5, 4],
                vec![2, 6, 7, 3],
                vec![0, 2, 3, 1],
                vec![4, 5, 7, 6],
            ],
        }
    }

    /// The volume.
    pub fn volume(&self) -> f64 {
        let Some(apex) = self.vertices.first() else {
            return 0.0;
        };
        let arm = |v: usize| -> [f64; 3] { std::array::from_fn(|axis| self.vertices[v][axis] - apex[axis]) };
        let mut sum = 0.0;
        for face in &self.faces {
            for pair in face[1..].windows(2) {
                let [a, b, c] = [arm(face[0]), arm(pair[0]), arm(pair[1])];
                sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                    + a[2] * (b[0] * c[1] - b[1] * c[0]);
            }
        }
        sum / 6.0
    }

    /// Cuts with a half-space, moved outward by its rounding error; vertices outside by twice that are cut off. A vertex is in or out for all its faces alike, so
    /// that they always fit together.
    pub(super) fn cut(&mut self, row: &Row) -> Cut {
        let slack = error(row);
        let values: Vec<f64> = self.vertices.iter().map(|q| value(row, q) + slack).collect();
        let out: Vec<bool> = values.iter().map(|v| *v < -slack).collect();
        if !out.contains(&true) {
            return Cut::Done;
        }
        if !out.contains(&false) {
            return Cut::Empty;
        }
        let mut vertices = std::mem::take(&mut self.vertices);
        let mut cuts: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        // In the new face the vertex after each.
        let mut next: BTreeMap<usize, usize> = BTreeMap::new();
        let mut faces = Vec::with_capacity(self.faces.len() + 1);
        for face in &self.faces {
            let mut cycle = Vec::with_capacity(face.len() + 1);
            let (mut leaves, mut enters) = (Vec::new(), Vec::new());
            for (k, &i) in face.iter().enumerate() {
                let j = face[(k + 1) % face.len()];
                if !out[i] {
                    cycle.push(i);
                }
                if out[i] == out[j] {
                    continue;
                }
                let (a, b) = (i.min(j), i.max(j));
                let at = *cuts.entry((a, b)).or_insert_with(|| {
                    let point = between(&vertices[a], &vertices[b], values[a], values[b]);
                    vertices.push(point);
                    vertices.len() - 1
                });
                cycle.push(at);
                if out[i] { enters.push(at) } else { leaves.push(at) }
            }
            match (&leaves[..], &enters[..]) {
                ([], []) => {}
                ([leave], [enter]) => {
                    next.insert(*enter, *leave);
                }
                _ => return Cut::Doubtful,
            }
            if !cycle.is_empty() {
                faces.push(cycle);
            }
        }
        // The new face closes, once around.
        let mut cap = Vec::with_capacity(next.len());
        let mut at = next.keys().next().copied();
        while let Some(vertex) = at {
            cap.push(vertex);
            at = next.remove(&vertex);
        }
        if !next.is_empty() || cap.len() < 4 || cap.first() != cap.last() {
            return Cut::Doubtful;
        }
        cap.pop();
        faces.push(cap);
        self.faces = faces;
        self.vertices = vertices;
        self.compact();
        Cut::Done
    }

    /// Without the vertices that no face has.
    fn compact(&mut self) {
        let mut number = vec![usize::MAX; self.vertices.len()];
        let mut kept = Vec::new();
        for v in self.faces.iter_mut().flatten() {
            if number[*v] == usize::MAX {
                number[*v] = kept.len();
                kept.push(self.vertices[*v]);
            }
            *v = number[*v];
        }
        self.vertices = kept;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every edge belongs to two faces, once in each direction.
    fn is_closed(solid: &ConvexSolid) -> bool {
        let mut edges = std::collections::BTreeSet::new();
        for face in &solid.faces {
            for (k, v) in face.iter().enumerate() {
                if !edges.insert((*v, face[(k + 1) % face.len()])) {
                    return false;
                }
            }
        }
        edges.iter().all(|(a, b)| edges.contains(&(*b, *a)))
    }

    #[test]
    fn a_cube_is_cut() {
        let mut solid = ConvexSolid::cube(1.0);
        assert!(is_closed(&solid));
        assert_eq!(solid.volume(), 8.0);
        // A corner of edge 1, then half of what is left of x, then the same again, which cuts nothing.
        assert_eq!(solid.cut(&[-1.0, -1.0, -1.0, 2.0, 1.0]), Cut::Done);
        assert!(is_closed(&solid) && solid.faces.len() == 7 && solid.vertices.len() == 10);
        assert!((solid.volume() - (8.0 - 1.0 / 6.0)).abs() < 1e-13);
        for _ in 0..2 {
            assert_eq!(solid.cut(&[-1.0, 0.0, 0.0, 0.0, 1.0]), Cut::Done);
            assert!(is_closed(&solid));
            assert!((solid.volume() - 4.0).abs() < 1e-12, "{}", solid.volume());
        }
        assert_eq!(solid.clone().cut(&[1.0, 0.0, 0.0, -1.0, 1.0]), Cut::Empty);
        assert_eq!(ConvexSolid::default().volume(), 0.0);
    }

    #[test]
    fn a_ball_of_many_planes() {
        let mut solid = ConvexSolid::cube(2.0);
        let mut state = 1_u64;
        let mut unit = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        for _ in 0..500 {
            let n = [unit(), unit(), unit()];
            let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert_eq!(solid.cut(&[n[0], n[1], n[2], length, 4.0 * length]), Cut::Done);
        }
        assert!(is_closed(&solid));
        // Euler's formula.
        let edges = solid.faces.iter().map(Vec::len).sum::<usize>() / 2;
        assert_eq!(solid.vertices.len() + solid.faces.len(), edges + 2);
        let ball = 4.0 / 3.0 * std::f64::consts::PI;
        assert!(
            solid.volume() > ball && solid.volume() < 1.1 * ball,
            "{}",
            solid.volume()
        );
    }
}
