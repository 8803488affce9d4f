//! The checker: replays a certificate in exact integers. It never searches and never trusts a number it can compute.
//!
//! It uses the number types, the curve's data, the claim's data and the certificate reader, and nothing of the prover.

pub mod blossom;
pub mod boxes;
pub mod chain;
pub mod cover;
pub mod curvature;
pub mod deviation;
pub mod domain;
pub mod element;
pub mod embedding;
pub mod hull;
pub mod motion;
mod msd;
pub mod part;
pub mod polynomial;
pub mod rule;
pub mod section;
pub mod tangents;
mod thickness;
pub mod values;
pub mod word;

use std::fmt;
use std::io::Read;

use crate::certificate::{self, Document, FormatError};
use crate::claim::Claim;
use crate::claim::tree::TokenSource;
use domain::sign::DomainError;
pub use msd::check_msd;
pub use rule::Failure;
pub use thickness::check_thickness;

/// Where a certificate was found wanting.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The statement.
    Statement,
    /// The curve.
    Curve,
    /// The upper bound's rule.
    Upper {
        /// Its name.
        rule: &'static str,
    },
    /// A pair of nodes of the tree.
    Pair {
        /// Number of the token, from 0.
        token: u64,
        /// First node.
        a: String,
        /// Second node.
        b: String,
    },
    /// The evidence of a claim without a tree.
    Evidence,
    /// An entry of the statement.
    Entry {
        /// Its number, from 0.
        number: usize,
    },
    /// Between the tokens.
    Token {
        /// Number of the token, from 0.
        number: u64,
    },
    /// An event of a motion.
    Event {
        /// Its number, from 0.
        number: u64,
    },
    /// A pair of nodes of the tree of an event.
    EventPair {
        /// Number of the event, from 0.
        number: u64,
        /// The track.
        track: &'static str,
        /// Number of the token among those of the event, from 0.
        token: u64,
        /// First and second node.
        nodes: Box<[String; 2]>,
    },
    /// A leaf at the time that an event leads to.
    EventLeaf {
        /// Number of the event, from 0.
        number: u64,
        /// The track.
        track: &'static str,
        /// Number of the leaf.
        leaf: u64,
    },
    /// The contact of a track of a motion.
    Contact {
        /// The track.
        track: &'static str,
    },
}

/// What was wrong there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// lower_squared > upper_squared, or "inf" beside an upper bound.
    Reversed,
    /// A tree where lower_squared is 0, or none where it is not.
    TreePresence,
    /// An upper rule without an upper bound, or a bound without a rule.
    UpperPresence,
    /// The grid is above 100,000.
    Grid,
    /// A piece whose derivative vanishes identically.
    PointPiece {
        /// Its number.
        piece: usize,
    },
    /// A rule of the other convention.
    WrongConvention,
    /// A rule's obligation does not hold.
    Obligation {
        /// The rule.
        rule: &'static str,
        /// What was expected and found.
        failure: Failure,
    },
    /// `split` of two different nodes, or `first` or `second` of one node with itself.
    WrongSplit,
    /// A split of a point element, or of a part halved 120 times.
    CannotSplit,
    /// The tokens end before the tree does.
    TokensMissing,
    /// The tree ends before the tokens do.
    TokensLeft,
    /// A token that cannot be read.
    Token(String),
    /// Another number of edges than the tree's.
    Edges {
        /// As stated.
        stated: u64,
        /// Of the polygon inscribed at the end points of the leaves.
        found: u64,
    },
    /// A perturbation radius beyond the one that the tree proves.
    Radius {
        /// Which of the two.
        norm: &'static str,
    },
    /// Moving points, an interval or a box that the curve does not have.
    Domain(DomainError),
    /// A motion that the curve cannot have.
    Motion(motion::MotionError),
    /// Something else than what must be there.
    Expected {
        /// What must be there.
        expected: &'static str,
        /// What is there.
        found: String,
    },
}

/// Why a well-formed certificate is not accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejection {
    /// Where.
    pub place: Place,
    /// Why.
    pub reason: Reason,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Statement => f.write_str("statement"),
            Place::Curve => f.write_str("curve"),
            Place::Upper { rule } => write!(f, "upper bound, rule {rule}"),
            Place::Pair { token, a, b } => write!(f, "tree, token {token}, pair ({a}; {b})"),
            Place::Evidence => f.write_str("evidence"),
            Place::Entry { number } => write!(f, "statement.entries[{number}]"),
            Place::Token { number } => write!(f, "tree, token {number}"),
            Place::Event { number } => write!(f, "event {number}"),
            Place::EventPair {
                number,
                track,
                token,
                nodes,
            } => write!(
                f,
                "event {number}, {track}, token {token}, pair ({}; {})",
                nodes[0], nodes[1]
            ),
            Place::EventLeaf { number, track, leaf } => write!(f, "event {number}, {track}, leaf {leaf}"),
            Place::Contact { track } => write!(f, "contact of the {track}"),
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::Reversed => f.write_str("lower_squared exceeds upper_squared"),
            Reason::TreePresence => f.write_str("expected a tree when and only when lower_squared is not 0"),
            Reason::UpperPresence => f.write_str("expected an upper rule when and only when there is an upper bound"),
            Reason::Grid => f.write_str("the grid exceeds 100,000"),
            Reason::PointPiece { piece } => write!(f, "the derivative of piece {piece} vanishes identically"),
            Reason::WrongConvention => f.write_str("a rule of the convention \"critical\" under another one"),
            Reason::Obligation { rule, failure } => {
                write!(f, "rule {rule}: expected {}, found {}", failure.expected, failure.found)
            }
            Reason::WrongSplit => f.write_str("a split that is not for this pair"),
            Reason::CannotSplit => f.write_str("a split of a corner or end, or of a part halved 120 times"),
            Reason::TokensMissing => f.write_str("the tokens end before the tree does"),
            Reason::TokensLeft => f.write_str("tokens left over when the tree is complete"),
            Reason::Token(what) => f.write_str(what),
            Reason::Edges { stated, found } => write!(f, "expected {found} edges, found {stated}"),
            Reason::Radius { norm } => {
                write!(
                    f,
                    "perturbation_radius.{norm}: expected at most the least margin of the leaves, found more"
                )
            }
            Reason::Domain(error) => error.fmt(f),
            Reason::Motion(error) => error.fmt(f),
            Reason::Expected { expected, found } => write!(f, "expected {expected}, found {found}"),
        }
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.reason)
    }
}

impl std::error::Error for Rejection {}

/// What the checker says of a file.
#[derive(Debug)]
pub enum Verdict {
    /// Every obligation holds: the statement is true of the curve.
    Accepted {
        /// The document, with curve and statement.
        document: Box<Document<'static>>,
        /// Leaves of the tree, if the claim has one, else 0.
        leaves: u64,
    },
    /// The file is not a certificate.
    Malformed(FormatError),
    /// The file is a certificate, but does not prove its statement.
    Rejected {
        /// The document.
        document: Box<Document<'static>>,
        /// Why not.
        rejection: Rejection,
    },
}

/// Checks a certificate in either form.
pub fn check<R: Read>(source: R) -> Verdict {
    let (document, mut tokens) = match certificate::read(source) {
        Ok(read) => read,
        Err(error) => return Verdict::Malformed(error),
    };
    let document = Box::new(document);
    let outcome = match &document.claim {
        Claim::Msd(content) => check_msd(&document.curve, content, &mut tokens),
        Claim::Embedding(content) => embedding::check_embedding(&document.curve, content, &mut tokens),
        Claim::Domain(content) => no_tokens(&mut tokens)
            .and_then(|()| domain::check_domain(&document.curve, content))
            .map(|()| 0),
        Claim::Deviation(content) => no_tokens(&mut tokens)
            .and_then(|()| deviation::check_deviation(&document.curve, content))
            .map(|()| 0),
        Claim::Motion(content) => motion::check_motion(&document.curve, content, &mut tokens),
        Claim::Thickness(content) => check_thickness(&document.curve, content, &mut tokens),
        Claim::Curvature(content) => no_tokens(&mut tokens)
            .and_then(|()| curvature::check_curvature(&document.curve, content))
            .map(|()| 0),
        Claim::Values(content) => no_tokens(&mut tokens)
            .and_then(|()| values::check_values(&document.curve, content))
            .map(|()| 0),
    };
    match outcome {
        Ok(leaves) => Verdict::Accepted { document, leaves },
        Err(rejection) => Verdict::Rejected { document, rejection },
    }
}

/// Nothing follows where there is no tree.
fn no_tokens<S: TokenSource>(tokens: &mut S) -> Result<(), Rejection> {
    match tokens.next_token() {
        Ok(None) => Ok(()),
        _ => Err(Rejection {
            place: Place::Token { number: 0 },
            reason: Reason::TokensLeft,
        }),
    }
}
