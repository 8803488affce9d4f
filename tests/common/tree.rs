//! A walk over a cover tree, written from FORMAT §5 apart from the checker's: which pair of nodes each token is for.

use knotproof::curve::{Curve, Joint};
use knotproof::number::{Integer, Rational};

/// An element of the curve.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Element {
    /// A piece.
    Piece(usize),
    /// A corner, at a joint.
    Corner(usize),
    /// The end at 0.
    Start,
    /// The end at M.
    End,
}

/// A node.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Node {
    /// Elements number a … b−1, two or more.
    Run(usize, usize),
    /// A point element.
    Point(Element),
    /// A part of a piece: its index among the 2^depth parts.
    Part { piece: usize, index: u128, depth: u32 },
}

/// The elements of a curve.
pub fn elements(curve: &Curve, critical: bool) -> Vec<Element> {
    let chain = curve.chain();
    let corner = |i| chain.joint(i) == Some(Joint::Corner);
    let mut list = Vec::new();
    if critical && !chain.closed() {
        list.push(Element::Start);
    } else if critical && corner(0) {
        list.push(Element::Corner(0));
    }
    for i in 0..chain.count() {
        list.push(Element::Piece(i));
        if critical && i + 1 < chain.count() && corner(i + 1) {
            list.push(Element::Corner(i + 1));
        }
    }
    if critical && !chain.closed() {
        list.push(Element::End);
    }
    list
}

fn of_elements(elements: &[Element], a: usize, b: usize) -> Node {
    match elements[a] {
        _ if b - a > 1 => Node::Run(a, b),
        Element::Piece(piece) => Node::Part {
            piece,
            index: 0,
            depth: 0,
        },
        point => Node::Point(point),
    }
}

fn halves(elements: &[Element], node: Node) -> [Node; 2] {
    match node {
        Node::Run(a, b) => {
            let m = (a + b) / 2;
            [of_elements(elements, a, m), of_elements(elements, m, b)]
        }
        Node::Point(_) => panic!("a point element is not split"),
        Node::Part { piece, index, depth } => [2 * index, 2 * index + 1].map(|index| Node::Part {
            piece,
            index,
            depth: depth + 1,
        }),
    }
}

/// Pairs of nodes still without a token.
struct Stack<'e> {
    elements: &'e [Element],
    pairs: Vec<[Node; 2]>,
}

impl<'e> Stack<'e> {
    fn new(elements: &'e [Element]) -> Self {
        let whole = of_elements(elements, 0, elements.len());
        Stack {
            elements,
            pairs: vec![[whole, whole]],
        }
    }

    /// The next pair that wants a token.
    fn next(&mut self) -> Option<[Node; 2]> {
        let is_skipped = |pair: &[Node; 2]| matches!(pair, [Node::Point(p), Node::Point(q)] if p == q);
        while self.pairs.last().is_some_and(is_skipped) {
            self.pairs.pop();
        }
        self.pairs.pop()
    }

    fn apply(&mut self, [a, b]: [Node; 2], token: &str) {
        match token {
            "split" => {
                let [left, right] = halves(self.elements, a);
                self.pairs.extend([[right, right], [left, right], [left, left]]);
            }
            "first" => self
                .pairs
                .extend(halves(self.elements, a).map(|a| [a, b]).into_iter().rev()),
            "second" => self
                .pairs
                .extend(halves(self.elements, b).map(|b| [a, b]).into_iter().rev()),
            _ => {}
        }
    }
}

/// The pair each token of a complete tree is for.
pub fn pairs<S: AsRef<str>>(elements: &[Element], tokens: &[S]) -> Vec<[Node; 2]> {
    let mut stack = Stack::new(elements);
    let mut pairs = Vec::new();
    for token in tokens {
        let pair = stack.next().expect("a token for every pair");
        pairs.push(pair);
        stack.apply(pair, token.as_ref());
    }
    pairs
}

/// The pair that wants a token after the given ones.
pub fn next_pair<S: AsRef<str>>(elements: &[Element], tokens: &[S]) -> Option<[Node; 2]> {
    let mut stack = Stack::new(elements);
    for token in tokens {
        let pair = stack.next().expect("a token for every pair");
        stack.apply(pair, token.as_ref());
    }
    stack.next()
}

/// Is a node within another?
pub fn holds(elements: &[Element], node: &Node, inner: &Node) -> bool {
    let of_run = |a: usize, b: usize| {
        elements[a..b].iter().any(|element| match (element, inner) {
            (Element::Piece(i), Node::Part { piece, .. }) => i == piece,
            (element, Node::Point(point)) => element == point,
            _ => false,
        })
    };
    match (node, inner) {
        (Node::Run(a, b), Node::Run(c, d)) => a <= c && d <= b,
        (Node::Run(a, b), _) => of_run(*a, *b),
        (
            Node::Part { piece, index, depth },
            Node::Part {
                piece: p,
                index: i,
                depth: d,
            },
        ) => piece == p && d >= depth && i >> (d - depth) == *index,
        _ => node == inner,
    }
}

/// The number of the leaf token for a pair of nodes that the function recognises, the last one if there are several.
pub fn leaf_for<S: AsRef<str>>(elements: &[Element], tokens: &[S], wish: impl Fn(&[Node; 2]) -> bool) -> Option<usize> {
    let leaf = |i: &usize| !matches!(tokens[*i].as_ref(), "split" | "first" | "second");
    let pairs = pairs(elements, tokens);
    (0..tokens.len()).rev().filter(leaf).find(|i| wish(&pairs[*i]))
}

/// The ends of the leaves' nodes of a tree of the convention `smooth`, in their order.
pub fn leaf_ends(curve: &Curve, tokens: &[String]) -> Vec<Rational> {
    let whole = |i: usize| Rational::from_integer(i.into());
    let mut ends = Vec::new();
    for (token, pair) in tokens.iter().zip(pairs(&elements(curve, false), tokens)) {
        if !matches!(token.as_str(), "split" | "first" | "second") {
            for node in pair {
                match node {
                    Node::Run(a, b) => ends.extend([whole(a), whole(b)]),
                    Node::Part { piece, index, depth } => {
                        let unit = Rational::new(1.into(), Integer::ONE << depth);
                        let start = whole(piece) + Rational::from_integer((index as i64).into()) * &unit;
                        ends.extend([start.clone(), start + unit]);
                    }
                    Node::Point(_) => unreachable!("no points in this convention"),
                }
            }
        }
    }
    ends.sort();
    ends.dedup();
    ends
}
