//! Small cover trees by trial: at every pair the first leaf of a fixed list that the checker takes, else a split.
//!
//! The checker is asked from outside: a token it refuses is named in its rejection.

use std::cmp::Reverse;

use knotproof::check::{Reason, Verdict, check};

use super::case::at_token;
use super::document::{Certificate, curve_of};
use super::tree::{Node, elements, holds, next_pair};

/// The most tokens that are tried.
const MOST_TOKENS: usize = 400;

fn leaves(dimension: usize) -> Vec<String> {
    let mut list: Vec<String> = ["1 1", "1 0", "0 1", "1 2", "2 1"]
        .map(|factors| format!("bend {factors}"))
        .into();
    list.extend(
        ["-1 0", "1 0", "0 -1", "0 1", "-1 -1", "1 1", "-1 1", "1 -1"].map(|factors| format!("not_normal {factors}")),
    );
    let range = if dimension == 2 { -3..=3 } else { -1..=1 };
    let mut vectors: Vec<Vec<i32>> = vec![Vec::new()];
    for _ in 0..dimension {
        vectors = vectors
            .iter()
            .flat_map(|v| range.clone().map(|x| [v.as_slice(), &[x]].concat()))
            .collect();
    }
    vectors.retain(|v| v.iter().any(|x| *x != 0));
    vectors.sort_by_key(|v| v.iter().map(|x| x * x).sum::<i32>());
    for rule in ["cone", "far"] {
        list.extend(
            vectors
                .iter()
                .map(|v| v.iter().fold(rule.to_string(), |text, x| format!("{text} {x}"))),
        );
    }
    list
}

/// Runs by their elements, then parts by their size, then points, which are not split.
fn size(node: &Node) -> (usize, Reverse<u32>) {
    match node {
        Node::Run(a, b) => (b - a, Reverse(0)),
        Node::Part { depth, .. } => (1, Reverse(*depth)),
        Node::Point(_) => (0, Reverse(0)),
    }
}

/// A tree for the certificate's curve, convention and lower bound. Pairs that `divide` recognises get no leaf.
pub fn grow(certificate: &Certificate, divide: impl Fn(&[Node; 2]) -> bool) -> Certificate {
    let curve = curve_of(&certificate.0["curve"]).expect("a curve");
    let critical = certificate.0["statement"]["convention"] == "critical";
    let elements = elements(&curve, critical);
    let lower = certificate.0["statement"]["lower_squared"]
        .as_str()
        .expect("a lower bound")
        .to_string();
    let leaves = leaves(curve.dimension());
    let mut tokens: Vec<String> = Vec::new();
    while let Some(pair) = next_pair(&elements, &tokens) {
        assert!(
            tokens.len() < MOST_TOKENS,
            "no small tree for {certificate:?}: {tokens:?}"
        );
        let fits = |leaf: &&String| {
            let mut longer = tokens.clone();
            longer.push((*leaf).clone());
            match check(certificate.clone().lower(&lower, &longer).json().as_slice()) {
                Verdict::Accepted { .. } => true,
                Verdict::Rejected { rejection, .. } => match rejection.reason {
                    Reason::TokensMissing => true,
                    _ if at_token(&rejection, tokens.len()) => false,
                    _ => panic!("{rejection}"),
                },
                Verdict::Malformed(error) => panic!("{error}"),
            }
        };
        let leaf = if divide(&pair) {
            None
        } else {
            leaves.iter().find(fits).cloned()
        };
        let split = match pair {
            [a, b] if a == b => "split",
            [a, b] if size(&a) >= size(&b) => "first",
            _ => "second",
        };
        tokens.push(leaf.unwrap_or_else(|| split.to_string()));
    }
    certificate.clone().lower(&lower, &tokens)
}

/// As [`grow`], with the number of the leaf for a pair of nodes, which is not hidden in a leaf for more.
pub fn grow_with_leaf(certificate: &Certificate, wish: [Node; 2]) -> (Certificate, usize) {
    let curve = curve_of(&certificate.0["curve"]).expect("a curve");
    let elements = elements(&curve, certificate.0["statement"]["convention"] == "critical");
    let above = |pair: &[Node; 2]| {
        *pair != wish && holds(&elements, &pair[0], &wish[0]) && holds(&elements, &pair[1], &wish[1])
    };
    let grown = grow(certificate, above);
    let leaf = super::tree::leaf_for(&elements, &grown.tokens(), |pair| *pair == wish).expect("a leaf for the pair");
    (grown, leaf)
}
