//! The boxes of all runs and pieces of a curve, kept up to date while control points move.

/// A box: its least coordinates, then its greatest.
pub type Bounds = [i64; 6];

/// The halvings of the whole run, down to the pieces, in depth-first order: a node comes before its halves.
pub struct Runs {
    /// The right half of each node, 0 for a piece; the left half is the next node.
    right: Vec<u32>,
    parent: Vec<u32>,
    /// The pieces of each node.
    spans: Vec<(u32, u32)>,
    /// The node of each piece.
    of_piece: Vec<u32>,
    boxes: Vec<Bounds>,
}

fn around(points: &[[i64; 3]]) -> Bounds {
    let (mut least, mut greatest) = (points[0], points[0]);
    for point in &points[1..] {
        for axis in 0..3 {
            least[axis] = least[axis].min(point[axis]);
            greatest[axis] = greatest[axis].max(point[axis]);
        }
    }
    [least[0], least[1], least[2], greatest[0], greatest[1], greatest[2]]
}

fn joined(a: &Bounds, b: &Bounds) -> Bounds {
    [
        a[0].min(b[0]),
        a[1].min(b[1]),
        a[2].min(b[2]),
        a[3].max(b[3]),
        a[4].max(b[4]),
        a[5].max(b[5]),
    ]
}

impl Runs {
    /// The halvings of `count` ≥ 1 pieces.
    pub fn new(count: usize) -> Self {
        let mut runs = Runs {
            right: Vec::with_capacity(2 * count),
            parent: Vec::with_capacity(2 * count),
            spans: Vec::with_capacity(2 * count),
            of_piece: vec![0; count],
            boxes: vec![[0; 6]; 2 * count - 1],
        };
        runs.push(0, count as u32, 0);
        runs
    }

    fn push(&mut self, first: u32, last: u32, parent: u32) {
        let node = self.right.len() as u32;
        self.right.push(0);
        self.parent.push(parent);
        self.spans.push((first, last));
        if last - first == 1 {
            self.of_piece[first as usize] = node;
            return;
        }
        let middle = (first + last) / 2;
        self.push(first, middle, node);
        self.right[node as usize] = self.right.len() as u32;
        self.push(middle, last, node);
    }

    /// How many nodes there are.
    pub fn count(&self) -> usize {
        self.right.len()
    }

    /// The node of a piece.
    pub fn of_piece(&self, piece: usize) -> usize {
        self.of_piece[piece] as usize
    }

    /// The node of the pieces `first … last−1`, which are a run that halvings lead to.
    pub fn of_run(&self, first: usize, last: usize) -> usize {
        let mut node = 0;
        loop {
            let (from, to) = self.spans[node];
            if (from as usize, to as usize) == (first, last) || self.right[node] == 0 {
                return node;
            }
            let middle = (from + to) as usize / 2;
            node = if first < middle {
                node + 1
            } else {
                self.right[node] as usize
            };
        }
    }

    /// The node that a node is a half of; `None` for the whole.
    pub fn parent(&self, node: usize) -> Option<usize> {
        (node > 0).then(|| self.parent[node] as usize)
    }

    /// The pieces of a node.
    pub fn span(&self, node: usize) -> std::ops::Range<usize> {
        self.spans[node].0 as usize..self.spans[node].1 as usize
    }

    /// The box of a node.
    pub fn bounds(&self, node: usize) -> &Bounds {
        &self.boxes[node]
    }

    /// Computes all boxes; `points` gives the positions that a piece depends on.
    pub fn refresh<'p>(&mut self, points: impl Fn(usize) -> &'p [[i64; 3]]) {
        for node in (0..self.right.len()).rev() {
            self.boxes[node] = match self.right[node] {
                0 => around(points(self.spans[node].0 as usize)),
                right => joined(&self.boxes[node + 1], &self.boxes[right as usize]),
            };
        }
    }

    /// Computes the box of a piece and those of the runs above it that change by it; `changed` is told which runs do.
    pub fn update(&mut self, piece: usize, points: &[[i64; 3]], mut changed: impl FnMut(usize)) {
        let mut node = self.of_piece(piece);
        let bounds = around(points);
        if self.boxes[node] == bounds {
            return;
        }
        self.boxes[node] = bounds;
        while let Some(parent) = self.parent(node) {
            node = parent;
            let bounds = joined(&self.boxes[node + 1], &self.boxes[self.right[node] as usize]);
            if self.boxes[node] == bounds {
                return;
            }
            self.boxes[node] = bounds;
            changed(node);
        }
    }
}
