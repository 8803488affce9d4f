//! Elements of a curve and the nodes made of them (FORMAT §5).

use std::fmt;

use super::boxes::Boxes;
use super::chain::Chain;
use super::part::Part;
use crate::claim::msd::Convention;
use crate::number::Integer;

/// One element of the curve.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Element {
    /// Piece i.
    Piece(usize),
    /// The corner at joint i (0 is the closing point).
    Corner(usize),
    /// The end of an open curve at parameter 0.
    Start,
    /// The end of an open curve at parameter M.
    End,
}

/// The elements of a curve, in order of their parameters.
pub struct Elements {
    pieces: usize,
    /// Empty in the smooth convention, where element i is piece i.
    listed: Vec<Element>,
}

impl Elements {
    /// The elements under a convention.
    pub fn new(chain: &Chain, convention: Convention) -> Self {
        let pieces = chain.count();
        let mut listed = Vec::new();
        if convention == Convention::Critical {
            if !chain.closed {
                listed.push(Element::Start);
            } else if !chain.smooth_joint(pieces - 1, 0) {
                listed.push(Element::Corner(0));
            }
            for piece in 0..pieces {
                listed.push(Element::Piece(piece));
                if piece + 1 < pieces && !chain.smooth_joint(piece, piece + 1) {
                    listed.push(Element::Corner(piece + 1));
                }
            }
            if !chain.closed {
                listed.push(Element::End);
            }
        }
        Elements { pieces, listed }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        if self.listed.is_empty() {
            self.pieces
        } else {
            self.listed.len()
        }
    }

    /// Element number i.
    #[inline]
    pub fn get(&self, i: usize) -> Element {
        if self.listed.is_empty() {
            Element::Piece(i)
        } else {
            self.listed[i]
        }
    }
}

/// The piece on whose end (`true`) or start (`false`) a point element lies; the point is the same on both sides of a corner.
pub fn point_location(chain: &Chain, element: Element) -> (usize, bool) {
    match element {
        Element::Piece(_) => unreachable!("a piece is not a point element"),
        Element::Corner(joint) => (joint, false),
        Element::Start => (0, false),
        Element::End => (chain.count() - 1, true),
    }
}

/// The piece before and the piece after a corner.
pub fn corner_pieces(chain: &Chain, joint: usize) -> (usize, usize) {
    (if joint == 0 { chain.count() - 1 } else { joint - 1 }, joint)
}

/// A parameter of the chain: `piece + numerator/2^depth`, with an odd numerator or numerator 0 and depth 0.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Parameter {
    /// Integer part.
    pub piece: usize,
    /// Numerator of the dyadic fraction.
    pub numerator: u128,
    /// Exponent of its denominator.
    pub depth: u32,
}

impl Parameter {
    fn new(piece: usize, index: u128, depth: u32) -> Self {
        if index == 0 {
            return Parameter {
                piece,
                numerator: 0,
                depth: 0,
            };
        }
        let zeros = index.trailing_zeros().min(depth);
        let (numerator, depth) = (index >> zeros, depth - zeros);
        if depth == 0 {
            return Parameter {
                piece: piece + 1,
                numerator: 0,
                depth: 0,
            };
        }
        Parameter {
            piece,
            numerator,
            depth,
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.depth == 0 {
            write!(f, "{}", self.piece)
        } else {
            write!(
                f,
                "{}+{}/{}",
                self.piece,
                self.numerator,
                Integer::from(1) << self.depth
            )
        }
    }
}

/// A node: a run of at least two elements, a point element, or a part of a piece.
pub enum Node<'c> {
    /// The elements `first … last−1`, at least two; `number` is its place among the boxes.
    Run {
        /// Number of the run in depth-first order.
        number: usize,
        /// First element.
        first: usize,
        /// One past the last element.
        last: usize,
    },
    /// A corner or an end.
    Point(Element),
    /// A part of a piece.
    Part(Part<'c>),
}

impl<'c> Node<'c> {
    /// The node of all elements.
    pub fn whole(chain: &'c Chain, elements: &Elements) -> Self {
        Node::of_elements(chain, elements, 0, 0, elements.count())
    }

    fn of_elements(chain: &'c Chain, elements: &Elements, number: usize, first: usize, last: usize) -> Self {
        if last - first >= 2 {
            return Node::Run { number, first, last };
        }
        match elements.get(first) {
            Element::Piece(piece) => Node::Part(Part::whole(chain, piece)),
            point => Node::Point(point),
        }
    }

    /// Its two halves; `None` for a point element and for a part that was halved too often.
    pub fn halves(&self, chain: &'c Chain, elements: &Elements) -> Option<(Node<'c>, Node<'c>)> {
        match self {
            Node::Run { number, first, last } => {
                let middle = (first + last) / 2;
                Some((
                    Node::of_elements(chain, elements, Boxes::left(*number), *first, middle),
                    Node::of_elements(chain, elements, Boxes::right(*number, middle - first), middle, *last),
                ))
            }
            Node::Point(_) => None,
            Node::Part(part) => part.halves().map(|(left, right)| (Node::Part(left), Node::Part(right))),
        }
    }

    /// Is it a run?
    pub fn is_run(&self) -> bool {
        matches!(self, Node::Run { .. })
    }

    /// Is it a point element?
    pub fn is_point(&self) -> bool {
        matches!(self, Node::Point(_))
    }

    /// The parameter where it starts.
    pub fn start(&self, chain: &Chain, elements: &Elements) -> Parameter {
        match self {
            Node::Run { first, .. } => element_range(chain, elements.get(*first)).0,
            Node::Point(element) => element_range(chain, *element).0,
            Node::Part(part) => Parameter::new(part.piece, part.index, part.depth),
        }
    }

    /// The parameter where it ends.
    pub fn end(&self, chain: &Chain, elements: &Elements) -> Parameter {
        match self {
            Node::Run { last, .. } => element_range(chain, elements.get(*last - 1)).1,
            Node::Point(element) => element_range(chain, *element).1,
            Node::Part(part) => Parameter::new(part.piece, part.index + 1, part.depth),
        }
    }

    /// Does it contain the end of an open curve at parameter 0, or at M?
    pub fn contains_end(&self, elements: &Elements, end: Element) -> bool {
        match self {
            Node::Run { first, last, .. } => elements.get(*first) == end || elements.get(*last - 1) == end,
            Node::Point(element) => *element == end,
            Node::Part(_) => false,
        }
    }

    /// What it is and where, in words.
    pub fn address(&self, chain: &Chain, elements: &Elements) -> String {
        let range = || format!("[{}, {}]", self.start(chain, elements), self.end(chain, elements));
        match self {
            Node::Run { first, last, .. } => format!("{} elements {}", last - first, range()),
            Node::Point(Element::Corner(joint)) => format!("corner at {joint}"),
            Node::Point(_) => format!("end at {}", self.start(chain, elements)),
            Node::Part(part) if part.depth == 0 => format!("piece {}", part.piece),
            Node::Part(part) => format!("piece {} part {}", part.piece, range()),
        }
    }
}

fn element_range(chain: &Chain, element: Element) -> (Parameter, Parameter) {
    let (start, end) = match element {
        Element::Piece(piece) => (piece, piece + 1),
        Element::Corner(joint) => (joint, joint),
        Element::Start => (0, 0),
        Element::End => (chain.count(), chain.count()),
    };
    (Parameter::new(start, 0, 0), Parameter::new(end, 0, 0))
}
