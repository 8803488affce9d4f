//! A whole cover tree: the upper part in order, subtrees in parallel, the tokens in order again.
//!
//! Where the tree is cut into subtrees depends on the curve alone, and so do the subtrees; so the tokens are the same for any number of threads.

use std::io::{self, Write};

use rayon::prelude::*;

use super::cone::Cone;
use super::cover::{Contact, Event, Goal, Search, splits_first};
use super::float_chain::FloatChain;
use super::node::Nodes;
use crate::check::cover::Context;
use crate::claim::tree::{Token, write_token};

/// What a search needs of the curve.
pub struct Curve<'s> {
    /// The exact curve.
    pub context: &'s Context<'s>,
    /// The curve in floats.
    pub floats: &'s FloatChain,
    /// Cones of runs.
    pub run_cones: &'s [Cone],
}

impl<'s> Curve<'s> {
    /// Nodes of the curve.
    pub fn nodes(&self) -> Nodes<'s> {
        Nodes::new(self.context, self.floats, self.run_cones)
    }
}

/// Elements `first … last−1`, run `number` if there are at least two.
#[derive(Clone, Copy, Debug)]
struct Elements {
    number: usize,
    first: usize,
    last: usize,
}

enum Item {
    Tokens(Vec<u8>),
    Subtree {
        a: Elements,
        b: Option<Elements>,
        contact: Contact,
    },
}

/// Subtrees that are worked on between two writes.
const BATCH: usize = 128;

/// Why no tree was written.
#[derive(Debug)]
pub enum Failure {
    /// The search came upon something.
    Event(Event),
    /// The tokens could not be written.
    Io(io::Error),
}

/// Searches the whole tree and writes its tokens; returns the number of leaves.
pub fn search(curve: &Curve, goal: &Goal, out: &mut dyn Write, progress: &dyn Fn(f64)) -> Result<u64, Failure> {
    let count = curve.context.elements.count();
    let mut plan = Plan {
        curve,
        goal,
        items: Vec::new(),
        tokens: Vec::new(),
        leaves: 0,
        small: (count / 256).max(64),
    };
    plan.pair(
        Elements {
            number: 0,
            first: 0,
            last: count,
        },
        None,
        Contact::default(),
    )
    .map_err(Failure::Event)?;
    plan.flush();
    let Plan { items, mut leaves, .. } = plan;
    let total = items.len();
    for (done, batch) in items.chunks(BATCH).enumerate() {
        progress((done * BATCH) as f64 / total as f64);
        // Small curves are not worth waking other threads, and one other thread does nothing sooner.
        let alone = total < 4 || rayon::current_num_threads() == 1;
        let results: Vec<Result<(Vec<u8>, u64), Event>> = if alone {
            batch.iter().map(|item| subtree(curve, goal, item)).collect()
        } else {
            batch.par_iter().map(|item| subtree(curve, goal, item)).collect()
        };
        for result in results {
            let (tokens, more) = result.map_err(Failure::Event)?;
            leaves += more;
            if leaves > goal.budget {
                return Err(Failure::Event(Event::Budget));
            }
            out.write_all(&tokens).map_err(Failure::Io)?;
        }
    }
    progress(1.0);
    Ok(leaves)
}

fn subtree(curve: &Curve, goal: &Goal, item: &Item) -> Result<(Vec<u8>, u64), Event> {
    match item {
        Item::Tokens(tokens) => Ok((tokens.clone(), 0)),
        Item::Subtree { a, b, contact } => {
            let mut nodes = curve.nodes();
            let a = nodes.of_elements(a.number, a.first, a.last);
            let b = b.map(|b| nodes.of_elements(b.number, b.first, b.last));
            let mut search = Search::new(&mut nodes, goal);
            search.tokens.reserve(512);
            search.pair(&a, b.as_ref(), *contact)?;
            Ok((search.tokens, search.leaves))
        }
    }
}

struct Plan<'p, 's> {
    curve: &'p Curve<'s>,
    goal: &'p Goal,
    items: Vec<Item>,
    tokens: Vec<u8>,
    leaves: u64,
    small: usize,
}

impl Plan<'_, '_> {
    fn flush(&mut self) {
        if !self.tokens.is_empty() {
            self.items.push(Item::Tokens(std::mem::take(&mut self.tokens)));
        }
    }

    fn emit(&mut self, token: &Token) {
        write_token(token, self.curve.context.chain.dimension, &mut self.tokens);
    }

    fn pair(&mut self, a: Elements, b: Option<Elements>, contact: Contact) -> Result<(), Event> {
        let size = |elements: Elements| elements.last - elements.first;
        if size(a).max(b.map_or(0, size)) <= self.small {
            self.flush();
            self.items.push(Item::Subtree { a, b, contact });
            return Ok(());
        }
        let mut nodes = self.curve.nodes();
        let node_a = nodes.of_elements(a.number, a.first, a.last);
        let node_b = b.map(|b| nodes.of_elements(b.number, b.first, b.last));
        let leaf = Search::new(&mut nodes, self.goal).quick_leaf(&node_a, node_b.as_ref(), contact);
        if let Some(leaf) = leaf {
            self.leaves += 1;
            self.emit(&Token::Leaf(leaf));
            return Ok(());
        }
        let Some(b) = b else {
            let (left, right) = self.halves(a);
            self.emit(&Token::Split);
            let backward = size(a) == self.curve.context.elements.count() && self.curve.floats.closed;
            self.pair(left, None, Contact::default())?;
            self.pair(
                left,
                Some(right),
                Contact {
                    forward: true,
                    backward,
                },
            )?;
            return self.pair(right, None, Contact::default());
        };
        let first = splits_first(&node_a, node_b.as_ref().expect("two nodes")) && size(a) >= 2 || size(b) < 2;
        let (left, right) = self.halves(if first { a } else { b });
        let (node_left, node_right) = (
            nodes.of_elements(left.number, left.first, left.last),
            nodes.of_elements(right.number, right.first, right.last),
        );
        if first {
            self.emit(&Token::First);
            let (of_left, of_right) = contact.of_first_halves(&node_left, &node_right);
            self.pair(left, Some(b), of_left)?;
            self.pair(right, Some(b), of_right)
        } else {
            self.emit(&Token::Second);
            let (of_left, of_right) = contact.of_second_halves(&node_left, &node_right);
            self.pair(a, Some(left), of_left)?;
            self.pair(a, Some(right), of_right)
        }
    }

    fn halves(&self, elements: Elements) -> (Elements, Elements) {
        use crate::check::boxes::Boxes;
        let Elements { number, first, last } = elements;
        let middle = (first + last) / 2;
        let left = Elements {
            number: Boxes::left(number),
            first,
            last: middle,
        };
        (
            left,
            Elements {
                number: Boxes::right(number, middle - first),
                first: middle,
                last,
            },
        )
    }
}
