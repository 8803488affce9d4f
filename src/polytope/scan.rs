//! The first of three layers: all vertices against one row in binary64, coordinate by coordinate so that the compiler can use vectors.

/// Homogeneous coordinates of the vertices in binary64, the greatest magnitude of each vertex at most 1.
#[derive(Clone, Debug)]
pub(super) struct Scan {
    /// x, y, z and the weight; z is empty in the plane.
    columns: [Vec<f64>; 4],
    dimension: usize,
}

/// Vertices looked at together.
const BLOCK: usize = 16;

impl Scan {
    /// Bound on the error of a computed value, 2⁻⁴⁹. Coefficients are at most 1 and off by at most 2⁻⁵⁴, coordinates at most 1 and off by at most 2⁻⁵³, so
    /// the sum of products is off by at most 4 · (3 · 2⁻⁵⁴ + 2⁻¹⁰⁷). Each of four products, at most 1, rounds by at most 2⁻⁵⁴, each of three sums, at most 4
    /// in any order, by at most 2⁻⁵². Together that is 7 · 2⁻⁵² and a trifle.
    pub(super) const ERROR: f64 = 8.0 * f64::EPSILON;

    pub(super) fn new(dimension: usize) -> Self {
        Scan {
            columns: Default::default(),
            dimension,
        }
    }

    fn used(&self) -> &'static [usize] {
        if self.dimension == 2 { &[0, 1, 3] } else { &[0, 1, 2, 3] }
    }

    pub(super) fn push(&mut self, point: [f64; 4]) {
        for &i in self.used() {
            self.columns[i].push(point[i]);
        }
    }

    pub(super) fn swap_remove(&mut self, vertex: usize) {
        for &i in self.used() {
            self.columns[i].swap_remove(vertex);
        }
    }

    /// Appends the vertices not certainly inside, with the value computed: outside for certain below −[`ERROR`](Scan::ERROR).
    pub(super) fn not_inside(&self, row: [f64; 4], found: &mut Vec<(u32, f64)>) {
        let [x, y, z, w] = &self.columns;
        let blocks = w.len() / BLOCK * BLOCK;
        let mut values = [0.0; BLOCK];
        for start in (0..blocks).step_by(BLOCK) {
            let block = start..start + BLOCK;
            let (x, y, w) = (&x[block.clone()], &y[block.clone()], &w[block.clone()]);
            if self.dimension == 2 {
                for i in 0..BLOCK {
                    values[i] = (row[0] * x[i] + row[1] * y[i]) + row[3] * w[i];
                }
            } else {
                let z = &z[block];
                for i in 0..BLOCK {
                    values[i] = (row[0] * x[i] + row[1] * y[i]) + (row[2] * z[i] + row[3] * w[i]);
                }
            }
            let inside = values
                .iter()
                .fold(true, |inside, value| inside & (*value > Self::ERROR));
            if !inside {
                collect(start, &values, found);
            }
        }
        for i in blocks..w.len() {
            let third = if self.dimension == 2 { 0.0 } else { row[2] * z[i] };
            let value = (row[0] * x[i] + row[1] * y[i]) + (third + row[3] * w[i]);
            collect(i, &[value], found);
        }
    }
}

/// Appends those of the values, of vertices from `start` on, that do not exceed the error bound.
fn collect(start: usize, values: &[f64], found: &mut Vec<(u32, f64)>) {
    for (vertex, &value) in (start as u32..).zip(values) {
        if value <= Scan::ERROR {
            found.push((vertex, value));
        }
    }
}
