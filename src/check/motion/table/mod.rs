//! The leaves of a track, and whether they hold while control points move.
//!
//! Nothing but the leaves that a move touches is looked at again: a control point belongs to a few pieces, a piece to itself, its parts and
//! the runs around it, and these to the leaves that name them. When most points move, all leaves are gone through in a row.

mod holds;

use super::obligation;
use super::parts::Parts;
use super::positions::Positions;
use super::runs::Runs;
use super::shape::{Node, Shape};
use crate::check::Reason;
use crate::check::rule::Outcome;
use crate::claim::motion::Move;
use crate::claim::tree::{Leaf, Token, TokenSource};
use crate::number::Integer;

/// A node as the table finds it: below the number of runs a run or a piece, from there on a part.
type Number = u32;

/// A vector, in 64 bits where it fits.
struct Direction {
    n: [i64; 3],
    /// The bit length of the sum of its magnitudes; 255 where `wide` holds the vector.
    bits: u8,
    wide: Option<Box<[Integer; 3]>>,
}

impl Direction {
    fn new(n: &[Integer; 3]) -> Self {
        if let [Some(x), Some(y), Some(z)] = [n[0].to_i64(), n[1].to_i64(), n[2].to_i64()] {
            let sum = [x, y, z].iter().map(|x| u128::from(x.unsigned_abs())).sum::<u128>();
            return Direction {
                n: [x, y, z],
                bits: (u128::BITS - sum.leading_zeros()) as u8,
                wide: None,
            };
        }
        Direction {
            n: [0; 3],
            bits: u8::MAX,
            wide: Some(Box::new(n.clone())),
        }
    }

    fn exact(&self) -> [Integer; 3] {
        match &self.wide {
            Some(n) => (**n).clone(),
            None => self.n.map(Integer::from),
        }
    }
}

struct Separate {
    direction: Direction,
    /// For each axis, which coordinate of the box of A, and of that of B, gives the least gap.
    corners: ([u8; 3], [u8; 3]),
    a: Number,
    b: Number,
    number: u64,
    seen: u32,
}

struct Monotone {
    direction: Direction,
    /// Where all pieces of both nodes are polynomial Bézier pieces: their control points, in one or two rows.
    rows: [(u32, u32); 2],
    number: u64,
    seen: u32,
    a: Node,
    b: Option<Node>,
    /// The numbers of the nodes among the parts, where they are parts whose hull points are not control points as they are.
    parts: [Option<u32>; 2],
}

/// Where a leaf is.
#[derive(Clone, Copy)]
enum Place {
    Gone,
    Separate(usize),
    Monotone(usize),
}

/// Which points moved since the last look.
#[derive(Clone, Copy)]
pub enum Moved<'m> {
    /// All, or others than one knows.
    All,
    /// Those of a move.
    By(&'m Move),
}

/// A tree that is not one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeError {
    /// Number of the token, from 0.
    pub token: u64,
    /// First node of the pair.
    pub a: Node,
    /// Second node of the pair; the first one again if it is a pair of one node.
    pub b: Node,
    /// What is wrong.
    pub reason: Box<Reason>,
}

/// The leaves of a track.
pub struct Table<'c> {
    shape: Shape<'c>,
    runs: Runs,
    parts: Parts,
    separate: Vec<Separate>,
    monotone: Vec<Monotone>,
    places: Vec<Place>,
    /// The leaves that name a run or piece, by number, and some that are gone.
    separate_at: Vec<Vec<u64>>,
    monotone_at: Vec<Vec<u64>>,
    /// Which look this is.
    look: u32,
    /// Do boxes and parts belong to the positions last looked at?
    fresh: bool,
}

/// The row of positions in the order of which n·P must increase, if there is nothing else to the pieces.
const NO_ROW: (u32, u32) = (1, 0);

impl<'c> Table<'c> {
    /// A table without leaves.
    pub fn new(shape: Shape<'c>) -> Self {
        let runs = Runs::new(shape.pieces.len());
        let count = runs.count();
        Table {
            shape,
            runs,
            parts: Parts::default(),
            separate: Vec::new(),
            monotone: Vec::new(),
            places: Vec::new(),
            separate_at: vec![Vec::new(); count],
            monotone_at: vec![Vec::new(); count],
            look: 0,
            fresh: false,
        }
    }

    /// What stays the same.
    pub fn shape(&mut self) -> &mut Shape<'c> {
        &mut self.shape
    }

    /// How many leaves there are.
    pub fn count(&self) -> usize {
        self.separate.len() + self.monotone.len()
    }

    /// The number that the next leaf will get.
    pub fn next_number(&self) -> u64 {
        self.places.len() as u64
    }

    /// The pair and the rule of a leaf, unless it is gone or never was.
    pub fn leaf(&self, number: u64) -> Option<(Node, Option<Node>, Leaf)> {
        match self.place(number) {
            Place::Gone => None,
            Place::Separate(at) => {
                let leaf = &self.separate[at];
                let [a, b] = [leaf.a, leaf.b].map(|node| self.node(node));
                Some((a, Some(b), Leaf::Separate(leaf.direction.exact())))
            }
            Place::Monotone(at) => {
                let leaf = &self.monotone[at];
                Some((leaf.a, leaf.b, Leaf::Monotone(leaf.direction.exact())))
            }
        }
    }

    /// Does an obligation hold at these positions? Nothing that the table knows is used.
    pub fn obligation(&mut self, positions: &Positions, a: &Node, b: Option<&Node>, leaf: &Leaf) -> Outcome {
        obligation::obligation(&mut self.shape, positions, a, b, leaf)
    }

    /// Replaces all leaves by those of a complete tree, numbered from 0, which must hold at these positions; returns how many tokens it has.
    ///
    /// # Errors
    /// The first token at which the tree is not one.
    pub fn plant<S: TokenSource>(&mut self, positions: &Positions, tokens: &mut S) -> Result<u64, TreeError> {
        self.places.clear();
        self.separate.clear();
        self.monotone.clear();
        self.parts = Parts::default();
        self.separate_at.iter_mut().for_each(Vec::clear);
        self.monotone_at.iter_mut().for_each(Vec::clear);
        self.refresh(positions);
        self.grow(positions, self.shape.whole(), None, tokens)
    }

    /// Replaces a leaf by the leaves of a complete tree for its pair, which get the next numbers and must hold at these positions, the ones last
    /// looked at; returns how many tokens it has, or `None` if there is no such leaf.
    ///
    /// # Errors
    /// The first token at which the tree is not one.
    pub fn replace<S: TokenSource>(
        &mut self,
        positions: &Positions,
        number: u64,
        tokens: &mut S,
    ) -> Option<Result<u64, TreeError>> {
        let (a, b, _) = self.leaf(number)?;
        self.remove(number);
        if !self.fresh {
            self.refresh(positions);
        }
        Some(self.grow(positions, a, b, tokens))
    }

    /// The first leaf found that does not hold at these positions.
    ///
    /// [`Moved::By`] is for positions that a move made of the ones last looked at, when all leaves held there.
    pub fn check(&mut self, positions: &Positions, moved: Moved) -> Option<u64> {
        self.look(positions, moved, true).first().copied()
    }

    /// All leaves that do not hold at these positions, in the order of their numbers, under the same condition.
    pub fn failing(&mut self, positions: &Positions, moved: Moved) -> Vec<u64> {
        let mut found = self.look(positions, moved, false);
        found.sort_unstable();
        found
    }

    fn place(&self, number: u64) -> Place {
        let at = usize::try_from(number).ok();
        at.and_then(|at| self.places.get(at)).copied().unwrap_or(Place::Gone)
    }

    fn grow<S: TokenSource>(
        &mut self,
        positions: &Positions,
        a: Node,
        b: Option<Node>,
        tokens: &mut S,
    ) -> Result<u64, TreeError> {
        let mut stack = vec![(a, b)];
        let mut token = 0;
        while let Some((a, b)) = stack.pop() {
            let fails = |reason| TreeError {
                token,
                a,
                b: b.unwrap_or(a),
                reason: Box::new(reason),
            };
            let next = match tokens.next_token() {
                Ok(Some(next)) => next,
                Ok(None) => return Err(fails(Reason::TokensMissing)),
                Err(error) => return Err(fails(Reason::Token(error.to_string()))),
            };
            match (&next, b) {
                (Token::Leaf(leaf), b) => {
                    let inserted = self.insert(positions, a, b, leaf);
                    inserted.map_err(|failure| {
                        let rule = leaf.rule();
                        fails(Reason::Obligation { rule, failure })
                    })?;
                }
                (Token::Split, None) => {
                    let (left, right) = a.halves().ok_or_else(|| fails(Reason::CannotSplit))?;
                    stack.extend([(right, None), (left, Some(right)), (left, None)]);
                }
                (Token::First, Some(b)) => {
                    let (left, right) = a.halves().ok_or_else(|| fails(Reason::CannotSplit))?;
                    stack.extend([(right, Some(b)), (left, Some(b))]);
                }
                (Token::Second, Some(b)) => {
                    let (left, right) = b.halves().ok_or_else(|| fails(Reason::CannotSplit))?;
                    stack.extend([(a, Some(right)), (a, Some(left))]);
                }
                _ => return Err(fails(Reason::WrongSplit)),
            }
            token += 1;
        }
        Ok(token)
    }

    fn insert(&mut self, positions: &Positions, a: Node, b: Option<Node>, leaf: &Leaf) -> Outcome {
        obligation::fits(&self.shape, &a, b.as_ref(), leaf)?;
        let number = self.next_number();
        match (leaf, b) {
            (Leaf::Separate(n), Some(b)) => {
                let (a, b) = (self.number(positions, &a), self.number(positions, &b));
                let negative = |axis: usize| u8::from(n[axis].is_negative());
                let record = Separate {
                    direction: Direction::new(n),
                    corners: (
                        [0, 1, 2].map(|axis| axis as u8 + 3 * negative(axis)),
                        [0, 1, 2].map(|axis| axis as u8 + 3 * (1 - negative(axis))),
                    ),
                    a,
                    b,
                    number,
                    seen: 0,
                };
                if !self.holds_apart(&record, positions) {
                    return obligation::not_apart();
                }
                for node in [a, b] {
                    self.leaves_at(node, true).push(number);
                }
                self.places.push(Place::Separate(self.separate.len()));
                self.separate.push(record);
            }
            (Leaf::Monotone(n), b) => {
                let mut parts = [None; 2];
                for (node, part) in std::iter::once(a).chain(b).zip(&mut parts) {
                    self.prepare(positions, &node);
                    if let Node::Part { piece, depth, index } = node {
                        *part = self.parts.find((piece, depth, index)).map(|part| part as u32);
                    }
                }
                let record = Monotone {
                    parts,
                    direction: Direction::new(n),
                    rows: self.rows(&a, b.as_ref()),
                    number,
                    seen: 0,
                    a,
                    b,
                };
                if !self.holds_forward(&record, positions) {
                    return obligation::not_forward();
                }
                for node in std::iter::once(a).chain(b) {
                    let node = self.number(positions, &node);
                    self.leaves_at(node, false).push(number);
                }
                self.places.push(Place::Monotone(self.monotone.len()));
                self.monotone.push(record);
            }
            // Other leaves do not fit.
            _ => {}
        }
        Ok(())
    }

    fn remove(&mut self, number: u64) {
        match self.place(number) {
            Place::Gone => return,
            Place::Separate(at) => {
                self.separate.swap_remove(at);
                if let Some(moved) = self.separate.get(at) {
                    self.places[moved.number as usize] = Place::Separate(at);
                }
            }
            Place::Monotone(at) => {
                self.monotone.swap_remove(at);
                if let Some(moved) = self.monotone.get(at) {
                    self.places[moved.number as usize] = Place::Monotone(at);
                }
            }
        }
        self.places[number as usize] = Place::Gone;
    }

    fn leaves_at(&mut self, node: Number, separate: bool) -> &mut Vec<u64> {
        let (node, runs) = (node as usize, self.runs.count());
        match (node.checked_sub(runs), separate) {
            (None, true) => &mut self.separate_at[node],
            (None, false) => &mut self.monotone_at[node],
            (Some(part), true) => &mut self.parts.get_mut(part).separate,
            (Some(part), false) => &mut self.parts.get_mut(part).monotone,
        }
    }

    /// The control points of nodes in rows, if they are polynomial Bézier pieces.
    fn rows(&self, a: &Node, b: Option<&Node>) -> [(u32, u32); 2] {
        let row = |node: &Node| {
            let whole = !matches!(node, Node::Part { depth: 1.., .. });
            let direct = whole && (self.shape.direct || node.pieces().all(|piece| self.shape.pieces[piece].direct));
            let places = self.shape.places(node);
            direct.then(|| (*places.start() as u32, *places.end() as u32))
        };
        match (row(a), b.map(row)) {
            (Some(a), None) => [a, NO_ROW],
            (Some(a), Some(Some(b))) if a.1 == b.0 => [(a.0, b.1), NO_ROW],
            (Some(a), Some(Some(b))) => [a, b],
            _ => [NO_ROW, NO_ROW],
        }
    }

    /// The parts that the pieces of a node need, if they need any.
    fn prepare(&mut self, positions: &Positions, node: &Node) {
        for piece in node.pieces() {
            match *node {
                Node::Part {
                    depth: depth @ 1..,
                    index,
                    ..
                } => {
                    self.parts.number(&mut self.shape, positions, (piece, depth, index));
                }
                _ if !self.shape.pieces[piece].direct => {
                    self.parts.number(&mut self.shape, positions, (piece, 0, 0));
                }
                _ => {}
            }
        }
    }

    fn number(&mut self, positions: &Positions, node: &Node) -> Number {
        let number = match *node {
            Node::Run { first, last } => self.runs.of_run(first, last),
            Node::Part { piece, depth: 0, .. } if self.shape.pieces[piece].direct => self.runs.of_piece(piece),
            Node::Part { piece, depth, index } => {
                let key = (piece, depth, index);
                self.runs.count() + self.parts.number(&mut self.shape, positions, key)
            }
        };
        number as Number
    }

    fn node(&self, number: Number) -> Node {
        let number = number as usize;
        match number.checked_sub(self.runs.count()) {
            None => {
                let span = self.runs.span(number);
                Node::of_pieces(span.start, span.end)
            }
            Some(part) => {
                let (piece, depth, index) = self.parts.key(part);
                Node::Part { piece, depth, index }
            }
        }
    }

    fn refresh(&mut self, positions: &Positions) {
        if let Some(points) = positions.narrow() {
            let pieces = &self.shape.pieces;
            self.runs
                .refresh(|piece| &points[pieces[piece].first..=pieces[piece].last]);
        }
        self.parts.refresh(positions);
        self.fresh = positions.narrow().is_some();
    }

    fn look(&mut self, positions: &Positions, moved: Moved, first_only: bool) -> Vec<u64> {
        self.look = self.look.wrapping_add(1);
        match moved {
            Moved::By(moved) if self.fresh && positions.narrow().is_some() && 4 * moved.len() < positions.count() => {
                self.look_around(positions, moved, first_only)
            }
            _ => {
                self.refresh(positions);
                self.look_at_all(positions, first_only)
            }
        }
    }

    fn look_at_all(&self, positions: &Positions, first_only: bool) -> Vec<u64> {
        let most = if first_only { 1 } else { usize::MAX };
        let failing = self.separate.iter().filter(|leaf| !self.holds_apart(leaf, positions));
        let mut found: Vec<u64> = failing.map(|leaf| leaf.number).take(most).collect();
        let failing = self.monotone.iter().filter(|leaf| !self.holds_forward(leaf, positions));
        found.extend(failing.map(|leaf| leaf.number).take(most - found.len().min(most)));
        found
    }

    /// Looks at the leaves that a move touches.
    fn look_around(&mut self, positions: &Positions, moved: &Move, first_only: bool) -> Vec<u64> {
        let points = positions.narrow().unwrap_or_default();
        let places = moved.points().flat_map(|point| positions.places(point as usize));
        let mut pieces: Vec<usize> = places.flat_map(|place| self.shape.pieces_at(place)).collect();
        pieces.sort_unstable();
        pieces.dedup();
        let mut changed = Vec::new();
        for piece in &pieces {
            let span = &self.shape.pieces[*piece];
            let span = &points[span.first..=span.last];
            self.runs.update(*piece, span, |run| changed.push(run));
            self.parts.update(*piece, positions);
            // The piece may have changed within its box.
            changed.push(self.runs.of_piece(*piece));
        }
        changed.sort_unstable();
        changed.dedup();
        let mut failing = Vec::new();
        for node in changed {
            let mut leaves = std::mem::take(&mut self.separate_at[node]);
            self.look_at_separate(&mut leaves, positions, &mut failing);
            self.separate_at[node] = leaves;
        }
        for piece in pieces {
            for part in self.parts.of_piece(piece).to_vec() {
                let mut leaves = std::mem::take(&mut self.parts.get_mut(part).separate);
                self.look_at_separate(&mut leaves, positions, &mut failing);
                self.parts.get_mut(part).separate = leaves;
                let mut leaves = std::mem::take(&mut self.parts.get_mut(part).monotone);
                self.look_at_monotone(&mut leaves, None, positions, &mut failing);
                self.parts.get_mut(part).monotone = leaves;
            }
            let mut node = Some(self.runs.of_piece(piece));
            while let Some(run) = node {
                let mut leaves = std::mem::take(&mut self.monotone_at[run]);
                self.look_at_monotone(&mut leaves, Some(piece), positions, &mut failing);
                self.monotone_at[run] = leaves;
                node = self.runs.parent(run);
            }
            if first_only && !failing.is_empty() {
                break;
            }
        }
        failing.sort_unstable();
        failing.dedup();
        failing
    }

    /// Looks at leaves, and forgets those that are gone.
    fn look_at_separate(&mut self, leaves: &mut Vec<u64>, positions: &Positions, failing: &mut Vec<u64>) {
        leaves.retain(|number| {
            let Place::Separate(at) = self.place(*number) else {
                return false;
            };
            if self.separate[at].seen != self.look {
                self.separate[at].seen = self.look;
                if !self.holds_apart(&self.separate[at], positions) {
                    failing.push(*number);
                }
            }
            true
        });
    }

    /// The same of leaves `monotone`, of which only one piece changed, or all that they are about.
    fn look_at_monotone(
        &mut self,
        leaves: &mut Vec<u64>,
        piece: Option<usize>,
        positions: &Positions,
        failing: &mut Vec<u64>,
    ) {
        leaves.retain(|number| {
            let Place::Monotone(at) = self.place(*number) else {
                return false;
            };
            let leaf = &self.monotone[at];
            let holds = match piece {
                Some(piece) => self.piece_goes(&leaf.direction, piece, positions),
                None if leaf.seen == self.look => true,
                None => self.holds_forward(leaf, positions),
            };
            if piece.is_none() {
                self.monotone[at].seen = self.look;
            }
            if !holds {
                failing.push(*number);
            }
            true
        });
    }
}
