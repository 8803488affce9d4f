//! Replaying a cover tree (FORMAT §5): one pass over the tokens, holding one path of nodes. What a leaf has to satisfy is the claim's matter.

use super::boxes::Boxes;
use super::chain::{Chain, ScaleRef};
use super::element::{Element, Elements, Node};
use super::part::Geometry;
use super::rule::{Failure, Outcome, bend, cone, far, monotone, not_normal, pedal, separate, turn};
use super::word::widening;
use super::{Place, Reason, Rejection};
use crate::claim::msd::{Convention, Lower};
use crate::claim::tree::{Leaf, Token, TokenSource};

/// What the rules look at: the curve's chain, its elements, and the boxes of its runs.
pub struct Context<'c> {
    /// The chain.
    pub chain: &'c Chain,
    /// The elements under the statement's convention.
    pub elements: Elements,
    /// The boxes of all runs.
    pub boxes: Boxes,
    /// Box coordinates are over 2^grid.
    pub grid: u32,
}

impl<'c> Context<'c> {
    /// Prepares a chain for replay.
    pub fn new(chain: &'c Chain, convention: Convention, grid: u32) -> Self {
        let elements = Elements::new(chain, convention);
        let boxes = Boxes::new(chain, &elements, grid);
        Context {
            chain,
            elements,
            boxes,
            grid,
        }
    }

    /// What box coordinates are over.
    pub fn grid_scale(&self) -> ScaleRef<'static> {
        ScaleRef::power_of_two(self.grid)
    }

    /// Does a leaf's obligation in the claim `msd` hold for the pair (A, B), or (A, A) when `b` is `None`?
    pub fn obligation(&self, a: &Node<'c>, b: Option<&Node<'c>>, leaf: &Leaf, lower: &Lower) -> Outcome {
        let bits = self.bits(a, b);
        match (leaf, b) {
            (Leaf::Far(_), None) => fails("two different nodes", "one"),
            (Leaf::Far(n), Some(b)) => match lower {
                Lower::Infinite => fails("no far leaf under a statement of no double normal", "far"),
                Lower::Finite(lower) => widening!(bits, W => far::check::<W>(self, a, b, n, lower)),
            },
            (Leaf::NotNormal(_), None) => fails("two different nodes", "one"),
            (Leaf::NotNormal([alpha, beta]), Some(b))
                if !(alpha.is_zero() || beta.is_zero()) && (a.is_run() || b.is_run()) =>
            {
                fails("one factor 0 for a run", "two factors")
            }
            (Leaf::NotNormal(factors), Some(b)) => widening!(bits, W => not_normal::check::<W>(self, a, b, factors)),
            (Leaf::Cone(_) | Leaf::Bend(_), Some(b)) if !self.adjacent(a, b) => fails("adjacent nodes", "nodes apart"),
            (Leaf::Turn(_), Some(b)) if !self.adjacent(a, b) => fails("adjacent nodes", "nodes apart"),
            (Leaf::Bend(_) | Leaf::Turn(_), b) if a.is_run() || b.is_some_and(Node::is_run) => {
                fails("parts, corners or ends", "a run")
            }
            (Leaf::Cone(n), b) => widening!(bits, W => cone::check::<W>(self, a, b, n)),
            (Leaf::Bend(factors), b) => widening!(bits, W => bend::check::<W>(self, a, b, factors)),
            (Leaf::Turn(vectors), b) => {
                let [p, q] = &**vectors;
                widening!(bits, W => turn::check::<W>(self, a, b, p, q))
            }
            (Leaf::Pedal(_), None) => fails("two different nodes", "one"),
            (Leaf::Pedal(witness), Some(b)) => match lower {
                Lower::Infinite => fails("no pedal leaf under a statement of no double normal", "pedal"),
                Lower::Finite(lower) => pedal::check(self.chain, a, b, witness, lower),
            },
            (Leaf::Separate(_) | Leaf::Monotone(_), _) => fails("a rule of the claim msd", leaf.rule()),
        }
    }

    /// Does a leaf's obligation in the claim `embedding` hold for the pair (A, B), or (A, A) when `b` is `None`?
    pub fn apart(&self, a: &Node<'c>, b: Option<&Node<'c>>, leaf: &Leaf) -> Outcome {
        let bits = self.bits(a, b);
        match (leaf, b) {
            (Leaf::Separate(_), None) => fails("two different nodes", "one"),
            (Leaf::Separate(n), Some(b)) => widening!(bits, W => separate::check::<W>(self, a, b, n)),
            (Leaf::Monotone(_), Some(b)) if !self.adjacent(a, b) => fails("adjacent nodes", "nodes apart"),
            (Leaf::Monotone(n), b) => widening!(bits, W => monotone::check::<W>(self, a, b, n)),
            _ => fails("a rule of the claim embedding", leaf.rule()),
        }
    }

    /// The bits to begin with.
    fn bits(&self, a: &Node<'c>, b: Option<&Node<'c>>) -> u32 {
        let wide = [Some(a), b].into_iter().flatten().any(|node| wide(node, &self.boxes));
        if wide { 64 } else { 0 }
    }

    /// Do two different nodes, `a` before `b`, share an end parameter?
    pub fn adjacent(&self, a: &Node, b: &Node) -> bool {
        let (chain, elements) = (self.chain, &self.elements);
        let at = |parameter: super::element::Parameter, integer| parameter.depth == 0 && parameter.piece == integer;
        a.end(chain, elements) == b.start(chain, elements)
            || chain.closed && at(a.start(chain, elements), 0) && at(b.end(chain, elements), chain.count())
    }

    /// The two halves of a node.
    pub fn halves(&self, node: &Node<'c>) -> Option<(Node<'c>, Node<'c>)> {
        node.halves(self.chain, &self.elements)
    }
}

fn fails(expected: &'static str, found: &str) -> Outcome {
    Err(Failure {
        expected,
        found: found.into(),
    })
}

/// Does a node certainly need more than 64 bits?
fn wide(node: &Node, boxes: &Boxes) -> bool {
    match node {
        Node::Run { .. } => matches!(boxes, Boxes::Large(_)),
        Node::Point(Element::Piece(_)) => false,
        Node::Point(_) => false,
        Node::Part(part) => !matches!(part.geometry, Geometry::Narrow(_)),
    }
}

/// Replays the tokens of `source` against the pair (whole, whole), with `judge` for its leaves; returns their number.
pub fn replay<'c, S, J>(context: &Context<'c>, judge: J, source: &mut S) -> Result<u64, Box<Rejection>>
where
    S: TokenSource,
    J: FnMut(&Node<'c>, Option<&Node<'c>>, &Leaf) -> Outcome,
{
    let mut replay = Replay {
        context,
        judge,
        source,
        token: 0,
        tokens: 0,
        leaves: 0,
    };
    let whole = Node::whole(context.chain, &context.elements);
    replay.pair(&whole, None)?;
    match replay.source.next_token() {
        Ok(None) => Ok(replay.leaves),
        Ok(Some(_)) => Err(Box::new(Rejection {
            place: Place::Token { number: replay.tokens },
            reason: Reason::TokensLeft,
        })),
        Err(error) => {
            let place = Place::Token { number: replay.tokens };
            Err(Box::new(Rejection {
                place,
                reason: Reason::Token(error.to_string()),
            }))
        }
    }
}

struct Replay<'r, 'c, S, J> {
    context: &'r Context<'c>,
    judge: J,
    source: &'r mut S,
    /// Number of the token that is being worked on.
    token: u64,
    /// Tokens read.
    tokens: u64,
    leaves: u64,
}

impl<'c, S, J> Replay<'_, 'c, S, J>
where
    S: TokenSource,
    J: FnMut(&Node<'c>, Option<&Node<'c>>, &Leaf) -> Outcome,
{
    /// Replays the pair (A, B), or (A, A) when `b` is `None`. The recursion is at most as deep as two paths of halvings.
    fn pair(&mut self, a: &Node<'c>, b: Option<&Node<'c>>) -> Result<(), Box<Rejection>> {
        if b.is_none() && a.is_point() {
            return Ok(());
        }
        self.token = self.tokens;
        let token = match self.source.next_token() {
            Ok(Some(token)) => token,
            Ok(None) => return Err(self.rejection(a, b, Reason::TokensMissing)),
            Err(error) => return Err(self.rejection(a, b, Reason::Token(error.to_string()))),
        };
        self.tokens += 1;
        match (&token, b) {
            (Token::Leaf(leaf), _) => {
                self.leaves += 1;
                (self.judge)(a, b, leaf).map_err(|failure| {
                    self.rejection(
                        a,
                        b,
                        Reason::Obligation {
                            rule: leaf.rule(),
                            failure,
                        },
                    )
                })
            }
            (Token::Split, None) => {
                let (left, right) = self.halves(a, a, None)?;
                self.pair(&left, None)?;
                self.pair(&left, Some(&right))?;
                self.pair(&right, None)
            }
            (Token::First, Some(b)) => {
                let (left, right) = self.halves(a, a, Some(b))?;
                self.pair(&left, Some(b))?;
                self.pair(&right, Some(b))
            }
            (Token::Second, Some(b)) => {
                let (left, right) = self.halves(b, a, Some(b))?;
                self.pair(a, Some(&left))?;
                self.pair(a, Some(&right))
            }
            _ => Err(self.rejection(a, b, Reason::WrongSplit)),
        }
    }

    fn halves(&self, node: &Node<'c>, a: &Node, b: Option<&Node>) -> Result<(Node<'c>, Node<'c>), Box<Rejection>> {
        self.context
            .halves(node)
            .ok_or_else(|| self.rejection(a, b, Reason::CannotSplit))
    }

    fn rejection(&self, a: &Node, b: Option<&Node>, reason: Reason) -> Box<Rejection> {
        let address = |node: &Node| node.address(self.context.chain, &self.context.elements);
        let place = Place::Pair {
            token: self.token,
            a: address(a),
            b: address(b.unwrap_or(a)),
        };
        Box::new(Rejection { place, reason })
    }
}
