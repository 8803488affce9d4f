//! A full-dimensional polytope as vertices and facets, and its intersection with one more half-space.
//!
//! All that is decided here follows from exact signs (which side of a hyperplane a vertex is on), so the combinatorial structure is exact, for
//! vertices in any number of facets too.

use smallvec::SmallVec;

use super::Clip;
use super::fixed::{scale, to_binary64};
use super::scan::Scan;
use super::vertex::{Row, Vertex};
use crate::number::{Integer, Rational};

/// A facet: its row and its vertices, counter-clockwise seen from outside; in the plane the two ends, with the polygon on the left of the
/// way from the first to the second.
#[derive(Clone, Debug)]
pub(super) struct Face {
    pub(super) row: u32,
    pub(super) vertices: SmallVec<[u32; 6]>,
}

/// See the module. Vertices and facets are numbered without gaps; an intersection may renumber them.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub(super) dimension: usize,
    /// Every row that ever cut: vertices may lie on rows that are no facets any more.
    pub(super) rows: Vec<Row>,
    pub(super) vertices: Vec<Vertex>,
    pub(super) facets: Vec<Face>,
    scan: Scan,
    work: Work,
}

/// Storage of [`Body::clip`], kept from one call to the next. Between calls `side` is 1, `touched` false and `pending` empty throughout.
#[derive(Clone, Debug, Default)]
struct Work {
    /// By vertex: 1, 0 or −1 as it is inside, on or outside the new row.
    side: Vec<i8>,
    /// By facet: whether it contains a vertex that is not inside.
    touched: Vec<bool>,
    /// By facet: new vertices that another facet has made on an edge with it, each after that other facet.
    pending: Vec<SmallVec<[(u32, u32); 2]>>,
    /// By vertex: its successor around the new facet.
    next: Vec<u32>,
    /// Vertices the filter did not find inside, and among them those outside and those on the new row.
    doubtful: Vec<(u32, f64)>,
    outside: Vec<u32>,
    on: Vec<u32>,
    affected: Vec<u32>,
    dead: Vec<u32>,
}

impl Body {
    /// The box with the given sides: coordinate i is bounded from below by `sides[2i]`, from above by `sides[2i + 1]`, and the bounds differ.
    pub(super) fn from_sides(sides: &[([Integer; 4], Option<usize>)], dimension: usize) -> Self {
        let rows: Vec<Row> = sides
            .iter()
            .map(|(row, label)| Row::new([&row[0], &row[1], &row[2], &row[3]], *label))
            .collect();
        let mut body = Body {
            dimension,
            rows,
            vertices: Vec::new(),
            facets: Vec::new(),
            scan: Scan::new(dimension),
            work: Work::default(),
        };
        // Bit i of a corner's number tells whether it is on the upper side of coordinate i.
        for corner in 0..1_u32 << dimension {
            let mut of = [0; 3];
            for (i, row) in of.iter_mut().enumerate() {
                let i = i.min(dimension - 1) as u32;
                *row = 2 * i + (corner >> i & 1);
            }
            let facets = of[..dimension].into();
            let vertex = Vertex::new(&body.rows, of, facets, dimension);
            body.push_vertex(vertex);
        }
        let cycles: &[&[u32]] = match dimension {
            2 => &[&[2, 0], &[1, 3], &[0, 1], &[3, 2]],
            _ => &[
                &[0, 4, 6, 2],
                &[1, 3, 7, 5],
                &[0, 1, 5, 4],
                &[2, 6, 7, 3],
                &[0, 2, 3, 1],
                &[4, 5, 7, 6],
            ],
        };
        for (row, cycle) in (0..).zip(cycles) {
            body.push_facet(Face {
                row,
                vertices: SmallVec::from_slice(cycle),
            });
        }
        body
    }

    fn push_vertex(&mut self, vertex: Vertex) -> u32 {
        let number = self.vertices.len() as u32;
        self.scan.push(vertex.point.to_binary64());
        self.vertices.push(vertex);
        self.work.side.push(1);
        self.work.next.push(0);
        number
    }

    fn push_facet(&mut self, face: Face) {
        self.facets.push(face);
        self.work.touched.push(false);
        self.work.pending.push(SmallVec::new());
    }

    /// Intersects with the half-space of the given coefficients, of which one besides the last is not zero. Leaves the polytope as it is
    /// unless the result is [`Clip::Cut`].
    pub(super) fn clip(&mut self, coefficients: [&Integer; 4], label: Option<usize>) -> Clip {
        self.classify(coefficients);
        let (outside, on) = (self.work.outside.len(), self.work.on.len());
        let clip = if outside == 0 {
            Clip::Redundant
        } else if outside + on < self.vertices.len() {
            Clip::Cut
        } else if on == 0 {
            Clip::Empty
        } else {
            Clip::Flat
        };
        if clip == Clip::Cut {
            self.cut(Row::new(coefficients, label));
        } else {
            for vertex in self.work.outside.iter().chain(&self.work.on) {
                self.work.side[*vertex as usize] = 1;
            }
        }
        clip
    }

    /// Fills `side`, `outside` and `on`, both in ascending order.
    fn classify(&mut self, coefficients: [&Integer; 4]) {
        let work = &mut self.work;
        work.doubtful.clear();
        work.outside.clear();
        work.on.clear();
        self.scan.not_inside(to_binary64(coefficients), &mut work.doubtful);
        let mut fixed = None;
        for &(vertex, value) in &work.doubtful {
            let side = if value < -Scan::ERROR {
                -1
            } else {
                let fixed = fixed.get_or_insert_with(|| scale(coefficients));
                self.vertices[vertex as usize].side(coefficients, fixed, &self.rows, self.dimension)
            };
            work.side[vertex as usize] = side;
            match side {
                0 => work.on.push(vertex),
                -1 => work.outside.push(vertex),
                _ => {}
            }
        }
    }

    /// Cuts off what is outside, after [`classify`](Body::classify) found vertices outside and inside.
    fn cut(&mut self, row: Row) {
        let new_row = self.rows.len() as u32;
        self.rows.push(row);
        let new_facet = self.facets.len() as u32;
        let first_new = self.vertices.len() as u32;
        self.touch();
        let affected = std::mem::take(&mut self.work.affected);
        let cycle = if self.dimension == 2 {
            self.cut_edges(&affected, new_row, new_facet)
        } else {
            self.cut_faces(&affected, new_row, new_facet)
        };
        for facet in &affected {
            self.work.touched[*facet as usize] = false;
            self.work.pending[*facet as usize].clear();
        }
        self.work.affected = affected;
        // Vertices on the row lose the facets that vanish and gain the new one; new vertices have theirs.
        for &vertex in &self.work.on {
            self.work.side[vertex as usize] = 1;
            let dead = &self.work.dead;
            let facets = &mut self.vertices[vertex as usize].facets;
            facets.retain(|facet| !dead.contains(facet));
            facets.push(new_facet);
        }
        for vertex in first_new as usize..self.vertices.len() {
            self.work.side[vertex] = 1;
        }
        self.push_facet(Face {
            row: new_row,
            vertices: cycle,
        });
        self.remove();
    }

    /// Collects the facets with a vertex that is not inside.
    fn touch(&mut self) {
        let work = &mut self.work;
        work.affected.clear();
        work.dead.clear();
        for vertex in work.outside.iter().chain(&work.on) {
            for &facet in &self.vertices[*vertex as usize].facets {
                if !work.touched[facet as usize] {
                    work.touched[facet as usize] = true;
                    work.affected.push(facet);
                }
            }
        }
    }

    /// In the plane: shortens the edges that cross the new row; the new edge's ends.
    fn cut_edges(&mut self, affected: &[u32], new_row: u32, new_facet: u32) -> SmallVec<[u32; 6]> {
        let mut ends = [0; 2];
        for &facet in affected {
            let [from, to] = [0, 1].map(|end| self.facets[facet as usize].vertices[end]);
            let sides = [from, to].map(|vertex| self.work.side[vertex as usize]);
            if sides[0].max(sides[1]) <= 0 {
                self.work.dead.push(facet);
                continue;
            }
            // The new edge goes from where the old ones end to where they start again.
            let end = usize::from(sides[0] > 0);
            let vertex = if sides[0].min(sides[1]) < 0 {
                let row = self.facets[facet as usize].row;
                let facets = [facet, new_facet].as_slice().into();
                let vertex = Vertex::new(&self.rows, [row, new_row, new_row], facets, 2);
                let vertex = self.push_vertex(vertex);
                self.facets[facet as usize].vertices[end] = vertex;
                vertex
            } else {
                [from, to][end]
            };
            ends[1 - end] = vertex;
        }
        ends.as_slice().into()
    }

    /// In space: cuts the facets that cross the new row; the new facet's vertices.
    fn cut_faces(&mut self, affected: &[u32], new_row: u32, new_facet: u32) -> SmallVec<[u32; 6]> {
        let mut start = 0;
        let mut count = 0;
        for &facet in affected {
            let old = std::mem::take(&mut self.facets[facet as usize].vertices);
            let side = |vertex: u32| self.work.side[vertex as usize];
            if old.iter().all(|vertex| side(*vertex) <= 0) {
                self.work.dead.push(facet);
                self.facets[facet as usize].vertices = old;
                continue;
            }
            let mut kept = SmallVec::new();
            for (i, &from) in old.iter().enumerate() {
                let to = old[if i + 1 == old.len() { 0 } else { i + 1 }];
                let [a, b] = [from, to].map(|vertex| self.work.side[vertex as usize]);
                if a >= 0 {
                    kept.push(from);
                }
                if a * b < 0 {
                    kept.push(self.crossing(facet, from, to, new_row, new_facet));
                }
            }
            // A facet that ends in the new row has an edge there, which the new facet runs along the other way.
            let on = |vertex: u32| self.work.side[vertex as usize] == 0;
            let mut edge = None;
            for (i, &from) in kept.iter().enumerate() {
                let to = kept[if i + 1 == kept.len() { 0 } else { i + 1 }];
                if on(from) && on(to) {
                    edge = Some((from, to));
                }
            }
            if let Some((from, to)) = edge {
                self.work.next[to as usize] = from;
                start = to;
                count += 1;
            }
            self.facets[facet as usize].vertices = kept;
        }
        let mut cycle = SmallVec::with_capacity(count);
        for _ in 0..count {
            cycle.push(start);
            start = self.work.next[start as usize];
        }
        cycle
    }

    /// The new vertex on the edge between two vertices of a facet on different sides; the first of the edge's two facets to come makes it.
    fn crossing(&mut self, facet: u32, from: u32, to: u32, new_row: u32, new_facet: u32) -> u32 {
        let ends = [from, to].map(|vertex| &self.vertices[vertex as usize].facets);
        // Two facets share an edge, and no third contains it.
        let other = ends[0].iter().find(|other| **other != facet && ends[1].contains(other));
        let other = *other.expect("every edge of a polytope lies in two facets");
        let made = self.work.pending[facet as usize].iter().find(|made| made.0 == other);
        if let Some(&(_, vertex)) = made {
            return vertex;
        }
        let rows = [facet, other].map(|facet| self.facets[facet as usize].row);
        let facets = [facet, other, new_facet].as_slice().into();
        let vertex = Vertex::new(&self.rows, [rows[0], rows[1], new_row], facets, 3);
        let vertex = self.push_vertex(vertex);
        self.work.side[vertex as usize] = 0;
        self.work.pending[other as usize].push((facet, vertex));
        vertex
    }

    /// Removes the vertices outside and the facets that vanished; the last ones take their numbers.
    fn remove(&mut self) {
        for &vertex in self.work.outside.iter().rev() {
            // All above are gone or inside, so what comes from the end stays.
            self.vertices.swap_remove(vertex as usize);
            self.scan.swap_remove(vertex as usize);
            let last = self.vertices.len() as u32;
            self.work.side.pop();
            self.work.next.pop();
            if vertex < last {
                self.work.side[vertex as usize] = 1;
                for facet in &self.vertices[vertex as usize].facets {
                    let vertices = &mut self.facets[*facet as usize].vertices;
                    vertices.iter_mut().filter(|v| **v == last).for_each(|v| *v = vertex);
                }
            }
        }
        self.work.dead.sort_unstable();
        for &facet in self.work.dead.iter().rev() {
            self.facets.swap_remove(facet as usize);
            self.work.touched.pop();
            self.work.pending.pop();
            let last = self.facets.len() as u32;
            if facet < last {
                for vertex in &self.facets[facet as usize].vertices {
                    let facets = &mut self.vertices[*vertex as usize].facets;
                    facets.iter_mut().filter(|f| **f == last).for_each(|f| *f = facet);
                }
            }
        }
    }

    /// The centroid of vertices that span a simplex; coordinates beyond the dimension are 0.
    pub(super) fn interior_point(&self) -> [Rational; 3] {
        // The first vertices of a facet span its hyperplane: no three vertices of a polytope are collinear.
        let facet = &self.facets[0];
        let mut corners: SmallVec<[u32; 4]> = SmallVec::from_slice(&facet.vertices[..self.dimension]);
        corners.extend((0..self.vertices.len() as u32).find(|vertex| !facet.vertices.contains(vertex)));
        let mut sum: [Rational; 3] = Default::default();
        for &corner in &corners {
            let [point @ .., weight] = self.vertices[corner as usize].homogeneous(&self.rows, self.dimension);
            for (sum, coordinate) in sum.iter_mut().zip(point) {
                *sum += Rational::new(coordinate, weight.clone());
            }
        }
        sum.map(|coordinate| coordinate / Integer::from(corners.len()))
    }
}
