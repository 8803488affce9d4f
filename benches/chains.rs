//! Benchmark chains: deterministic random chains of cubic Bézier pieces, built in memory.
//!
//! Library-like on purpose: benches and integration tests include this file with
//! `#[path = "…/benches/chains.rs"] mod chains;` and need no JSON. The same kind, number of pieces and seed give the same
//! chain on every platform: only integers, additions, multiplications, divisions and square roots are used.

// Each including target uses its own part of this file.
#![allow(dead_code)]

/// The four control points of a cubic piece, three coordinates each.
pub type Piece = [[f64; 3]; 4];

/// What to build. In every kind consecutive pieces share their joint exactly, and the two control points beside a
/// joint are exactly symmetric about it (an exactly C¹ joint); for the decimal kinds this holds of the decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Closed random polygon (a random walk conditioned to return), rounded off by Catmull–Rom tangents. Decimals with
    /// three places; an `f64` here is the one nearest to the decimal, and prints as that decimal.
    ClosedPolygon,
    /// Open chain like the Cα trace of a protein: steps of 3.8, other vertices at least 4 apart, compact, Catmull–Rom
    /// tangents. Decimals with three places, as above.
    CAlpha,
    /// The chain of [`Kind::CAlpha`] with every coordinate at full binary64 precision.
    FullPrecision,
    /// The chain of [`Kind::CAlpha`] with every coordinate a multiple of 2⁻²⁰.
    BinaryGrid,
}

impl Kind {
    /// Every kind with its name on the command line.
    pub const NAMES: [(&'static str, Kind); 4] = [
        ("closed-polygon", Kind::ClosedPolygon),
        ("calpha", Kind::CAlpha),
        ("w", Kind::FullPrecision),
        ("wr", Kind::BinaryGrid),
    ];

    /// The kind of a command-line name.
    pub fn from_name(name: &str) -> Option<Kind> {
        Self::NAMES
            .iter()
            .find(|(known, _)| *known == name)
            .map(|&(_, kind)| kind)
    }

    /// Whether the chain closes (the last control point is the first).
    pub fn closed(self) -> bool {
        self == Kind::ClosedPolygon
    }

    /// Whether the coordinates stand for decimals with three places (otherwise for themselves, binary64).
    pub fn decimal(self) -> bool {
        matches!(self, Kind::ClosedPolygon | Kind::CAlpha)
    }

    /// The least number of pieces: a closed chain of two pieces would run back on itself.
    pub fn least_pieces(self) -> usize {
        if self.closed() { 3 } else { 1 }
    }

    /// The most pieces; beyond, vertex numbers of the neighbour grid would no longer fit 32 bits comfortably.
    pub const MOST_PIECES: usize = 10_000_000;
}

/// SplitMix64 (Steele, Lea, Flood 2014): small, seeded, the same everywhere.
pub struct SplitMix64(u64);

impl SplitMix64 {
    /// A generator started from `seed`.
    pub fn new(seed: u64) -> Self {
        SplitMix64(seed)
    }

    /// The next 64 random bits.
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in (−1, 1), a multiple of 2⁻⁵².
    pub fn symmetric(&mut self) -> f64 {
        ((self.next_u64() >> 11) as f64) / (1u64 << 52) as f64 - 1.0
    }

    /// Uniform on the unit sphere, by rejection from the cube.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = [self.symmetric(), self.symmetric(), self.symmetric()];
            let square = dot(v, v);
            if (1e-4..=1.0).contains(&square) {
                let length = square.sqrt();
                return v.map(|x| x / length);
            }
        }
    }
}

/// The chain of `pieces` cubic pieces of this kind and seed.
///
/// # Errors
/// A sentence when `pieces` is below [`Kind::least_pieces`] or above [`Kind::MOST_PIECES`].
pub fn chain(kind: Kind, pieces: usize, seed: u64) -> Result<Vec<Piece>, String> {
    if pieces < kind.least_pieces() || pieces > Kind::MOST_PIECES {
        return Err(format!(
            "{pieces} pieces: expected {} to {}",
            kind.least_pieces(),
            Kind::MOST_PIECES
        ));
    }
    let mut random = SplitMix64::new(seed);
    Ok(match kind {
        Kind::ClosedPolygon => {
            let polygon = random_closed_polygon(pieces, &mut random);
            join(pieces, |i| {
                decimal_joint(polygon[i % pieces], catmull_rom_arm(&polygon, i % pieces))
            })
        }
        Kind::CAlpha => {
            let thousandths: Vec<[i64; 3]> = c_alpha_trace(pieces + 1, &mut random)
                .into_iter()
                .map(|vertex| vertex.map(|x| (x * 1000.0).round() as i64))
                .collect();
            join(pieces, |i| {
                let (previous, next, parts) = neighbours(i, pieces);
                let (previous, next) = (thousandths[previous], thousandths[next]);
                decimal_joint(
                    thousandths[i],
                    [0, 1, 2].map(|k| rounded_quotient(next[k] - previous[k], parts)),
                )
            })
        }
        Kind::FullPrecision | Kind::BinaryGrid => {
            let vertices = c_alpha_trace(pieces + 1, &mut random);
            join(pieces, |i| {
                let (previous, next, parts) = neighbours(i, pieces);
                let mut joint = [[0.0; 3]; 3];
                for k in 0..3 {
                    let arm = (vertices[next][k] - vertices[previous][k]) / parts as f64;
                    let vertex = vertices[i][k];
                    // On one grid the three values below are exact and the joint is exactly C¹.
                    let grid = match kind {
                        Kind::BinaryGrid => 1.0 / f64::from(1 << 20),
                        _ => unit_in_last_place(vertex.abs() + arm.abs()),
                    };
                    let vertex = (vertex / grid).round() * grid;
                    let arm = (arm / grid).round() * grid;
                    // Adding +0 turns −0 into 0.
                    joint[0][k] = vertex - arm + 0.0;
                    joint[1][k] = vertex + 0.0;
                    joint[2][k] = vertex + arm + 0.0;
                }
                joint
            })
        }
    })
}

/// Strings joints (control point before, joint, control point after) together into pieces.
fn join(pieces: usize, joint: impl Fn(usize) -> [[f64; 3]; 3]) -> Vec<Piece> {
    let mut start = joint(0);
    (1..=pieces)
        .map(|i| {
            let end = joint(i);
            let piece = [start[1], start[2], end[0], end[1]];
            start = end;
            piece
        })
        .collect()
}

/// Vertices whose difference gives the tangent at vertex `i` of an open chain, and the divisor that makes it an arm of
/// the control polygon: a sixth of the Catmull–Rom chord inside, a third of the only edge at an end.
fn neighbours(i: usize, pieces: usize) -> (usize, usize, i64) {
    if i == 0 {
        (0, 1, 3)
    } else if i == pieces {
        (i - 1, i, 3)
    } else {
        (i - 1, i + 1, 6)
    }
}

/// The joint of a decimal chain, from integers in thousandths.
fn decimal_joint(vertex: [i64; 3], arm: [i64; 3]) -> [[f64; 3]; 3] {
    let decimal = |f: &dyn Fn(usize) -> i64| [0, 1, 2].map(|k| f(k) as f64 / 1000.0);
    [
        decimal(&|k| vertex[k] - arm[k]),
        decimal(&|k| vertex[k]),
        decimal(&|k| vertex[k] + arm[k]),
    ]
}

/// The integer nearest to `numerator / denominator`, halves upward; `denominator` positive.
fn rounded_quotient(numerator: i64, denominator: i64) -> i64 {
    (2 * numerator + denominator).div_euclid(2 * denominator)
}

/// Distance from |x| to the next binary64 above it; x must be finite and normal (or 0, taken as 1).
fn unit_in_last_place(x: f64) -> f64 {
    let exponent = x.to_bits() & 0x7ff0_0000_0000_0000;
    if exponent == 0 {
        f64::EPSILON
    } else {
        f64::from_bits(exponent) * f64::EPSILON
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Vertices, in thousandths, of a closed random walk with steps uniform in the cube [−10, 10]³ less their mean: its
/// extent grows with the square root of its length, so long ones do not become crowded. A walk on which a tangent would
/// vanish is drawn again.
fn random_closed_polygon(vertices: usize, random: &mut SplitMix64) -> Vec<[i64; 3]> {
    loop {
        let mut position = [0i64; 3];
        let mut walk: Vec<[i64; 3]> = (0..vertices)
            .map(|_| {
                position = position.map(|x| x + (random.symmetric() * 10_000.0).round() as i64);
                position
            })
            .collect();
        for (i, vertex) in walk.iter_mut().enumerate() {
            for k in 0..3 {
                vertex[k] -= rounded_quotient(position[k] * (i as i64 + 1), vertices as i64);
            }
        }
        if (0..vertices).all(|i| catmull_rom_arm(&walk, i) != [0; 3]) {
            return walk;
        }
    }
}

/// The arm of the control polygon at vertex `i` of a closed polygon, a sixth of the chord past that vertex, in
/// thousandths.
fn catmull_rom_arm(polygon: &[[i64; 3]], i: usize) -> [i64; 3] {
    let n = polygon.len();
    let (previous, next) = (polygon[(i + n - 1) % n], polygon[(i + 1) % n]);
    [0, 1, 2].map(|k| rounded_quotient(next[k] - previous[k], 6))
}

/// Length of a step between consecutive Cα atoms, in ångströms.
const STEP: f64 = 3.8;
/// Least distance of vertices that are not neighbours.
const CLEARANCE: f64 = 4.0;
/// Cosines of the least and greatest angle between consecutive steps (Cα virtual bond angles of about 85° to 145°).
const TURN: std::ops::RangeInclusive<f64> = -0.09..=0.82;

/// Vertices of a self-avoiding walk with persistent direction inside a ball of about 400 cubic ångströms a vertex.
/// A walk that runs into a dead end goes back r steps or more with probability 1/r: pockets of every depth are left in
/// the end, at little cost to the usual shallow ones.
fn c_alpha_trace(vertices: usize, random: &mut SplitMix64) -> Vec<[f64; 3]> {
    let radius = cube_root(400.0 * vertices as f64 * 3.0 / 12.566).max(2.0 * STEP);
    let mut grid = Grid::new(radius + 2.0 * STEP, vertices);
    let mut walk: Vec<[f64; 3]> = Vec::with_capacity(vertices);
    walk.push([0.0; 3]);
    grid.insert(&walk);
    while walk.len() < vertices {
        let here = walk[walk.len() - 1];
        let forward = match walk.len() {
            1 => None,
            n => Some(difference(here, walk[n - 2])),
        };
        let found = (0..60).find_map(|_| {
            let u = random.direction();
            if forward.is_some_and(|v| !TURN.contains(&(dot(u, v) / STEP))) {
                return None;
            }
            let next = [0, 1, 2].map(|k| here[k] + STEP * u[k]);
            let distance = dot(next, next);
            if distance > radius * radius && distance > dot(here, here) {
                return None;
            }
            grid.free(&walk, next).then_some(next)
        });
        match found {
            Some(next) => {
                walk.push(next);
                grid.insert(&walk);
            }
            None => {
                let retreat = (1.0 / random.symmetric().abs().max(1e-9)) as usize;
                for _ in 0..retreat.min(walk.len() - 1) {
                    grid.remove_last(&walk);
                    walk.pop();
                }
            }
        }
    }
    walk
}

/// Cube root of a number above 1, by Newton's method from above: the library function may differ between platforms in
/// the last place.
fn cube_root(x: f64) -> f64 {
    (0..100).fold(x, |root, _| (2.0 * root + x / (root * root)) / 3.0)
}

/// Vertices by cells of side [`CLEARANCE`], each cell a list that starts with its newest vertex.
struct Grid {
    half: f64,
    side: usize,
    head: Vec<u32>,
    next: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Grid {
    fn new(half: f64, vertices: usize) -> Self {
        let side = (2.0 * half / CLEARANCE) as usize + 1;
        Grid {
            half,
            side,
            head: vec![NONE; side * side * side],
            next: Vec::with_capacity(vertices),
        }
    }

    fn cell(&self, point: [f64; 3]) -> [usize; 3] {
        point.map(|x| (((x + self.half) / CLEARANCE) as usize).min(self.side - 1))
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (x * self.side + y) * self.side + z
    }

    /// Adds the last vertex of the walk.
    fn insert(&mut self, walk: &[[f64; 3]]) {
        let cell = self.index(self.cell(walk[walk.len() - 1]));
        self.next.push(self.head[cell]);
        self.head[cell] = (walk.len() - 1) as u32;
    }

    /// Removes the last vertex of the walk, the newest of its cell.
    fn remove_last(&mut self, walk: &[[f64; 3]]) {
        let cell = self.index(self.cell(walk[walk.len() - 1]));
        self.head[cell] = self.next.pop().unwrap_or(NONE);
    }

    /// Whether `point` keeps its distance from all vertices but the last of the walk.
    fn free(&self, walk: &[[f64; 3]], point: [f64; 3]) -> bool {
        let around = self
            .cell(point)
            .map(|c| c.saturating_sub(1)..=(c + 1).min(self.side - 1));
        for x in around[0].clone() {
            for y in around[1].clone() {
                for z in around[2].clone() {
                    let mut vertex = self.head[self.index([x, y, z])];
                    while vertex != NONE {
                        let i = vertex as usize;
                        let chord = difference(walk[i], point);
                        if i + 1 != walk.len() && dot(chord, chord) < CLEARANCE * CLEARANCE {
                            return false;
                        }
                        vertex = self.next[i];
                    }
                }
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A coordinate as an exact integer: in thousandths, or in units of 2⁻¹⁰⁰ (of which every binary64 of a joint is a
    /// multiple unless it lies within 2⁻⁴⁷ of 0).
    fn exact(kind: Kind, x: f64) -> i128 {
        if kind.decimal() {
            let thousandths = (x * 1000.0).round();
            assert_eq!(thousandths / 1000.0, x);
            return thousandths as i128;
        }
        let scaled = x * 2f64.powi(100);
        assert!(scaled.abs() < 2f64.powi(120));
        scaled as i128
    }

    fn kinds() -> impl Iterator<Item = Kind> {
        Kind::NAMES.into_iter().map(|(_, kind)| kind)
    }

    #[test]
    fn splitmix64_reference_values() {
        // From the reference implementation, seed 1234567.
        let mut random = SplitMix64::new(1_234_567);
        let values = [0; 3].map(|_| random.next_u64());
        assert_eq!(values, [6457827717110365317, 3203168211198807973, 9817491932198370423]);
    }

    #[test]
    fn joints_are_shared_and_exactly_c1() {
        for kind in kinds() {
            for (pieces, seed) in [(3, 1), (4, 2), (50, 3), (400, 4)] {
                let chain = chain(kind, pieces, seed).expect("accepted size");
                assert_eq!(chain.len(), pieces);
                let closing = kind.closed().then(|| (chain[pieces - 1], chain[0]));
                let inner = chain.windows(2).map(|pair| (pair[0], pair[1]));
                for (a, b) in inner.chain(closing) {
                    assert_eq!(a[3], b[0]);
                    let mut tangent = [0; 3];
                    for k in 0..3 {
                        let [before, joint, after] = [a[2][k], a[3][k], b[1][k]].map(|x| exact(kind, x));
                        assert_eq!(before + after, 2 * joint, "{kind:?}");
                        tangent[k] = after - joint;
                    }
                    assert_ne!(tangent, [0; 3]);
                }
            }
        }
    }

    #[test]
    fn c_alpha_trace_keeps_its_distances() {
        let walk = c_alpha_trace(1500, &mut SplitMix64::new(7));
        for (i, &p) in walk.iter().enumerate() {
            for (j, &q) in walk.iter().enumerate().skip(i + 1) {
                let chord = difference(p, q);
                let distance = dot(chord, chord).sqrt();
                if j == i + 1 {
                    assert!((distance - STEP).abs() < 1e-9);
                } else {
                    assert!(distance >= CLEARANCE - 1e-9, "{i} {j} {distance}");
                }
            }
        }
        // Compact: about 400 cubic ångströms a vertex.
        assert!(walk.iter().all(|&p| dot(p, p).sqrt() < 60.0));
    }

    #[test]
    fn full_precision_uses_the_last_bits() {
        let chain = chain(Kind::FullPrecision, 200, 5).expect("accepted size");
        let odd = chain
            .iter()
            .flatten()
            .flatten()
            .filter(|x| x.to_bits() & 1 == 1)
            .count();
        assert!((400..2000).contains(&odd), "{odd} of 2400 coordinates end in a 1");
    }

    #[test]
    fn the_same_seed_gives_the_same_chain_and_another_seed_another() {
        for kind in kinds() {
            let first = chain(kind, 30, 11).expect("accepted size");
            assert_eq!(first, chain(kind, 30, 11).expect("accepted size"));
            assert_ne!(first, chain(kind, 30, 12).expect("accepted size"));
        }
    }

    #[test]
    fn sizes_outside_the_range_are_errors() {
        assert!(chain(Kind::ClosedPolygon, 2, 0).is_err());
        assert!(chain(Kind::CAlpha, 0, 0).is_err());
        assert!(chain(Kind::CAlpha, 1, 0).is_ok());
        assert!(chain(Kind::BinaryGrid, Kind::MOST_PIECES + 1, 0).is_err());
    }
}
