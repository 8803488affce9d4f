//! The claim `embedding`: a tree of `separate` and `monotone`, the edges of its polygon, the least margin of its leaves (FORMAT §10).

mod control;
mod margin;
mod quick;
pub(super) mod rows;

use std::collections::HashSet;

use super::chain::Chain;
use super::cover::{Context, replay};
use super::element::{Node, Parameter};
use super::msd::MAX_GRID;
use super::{Place, Reason, Rejection};
use crate::claim::embedding::{Content, Radius};
use crate::claim::msd::Convention;
use crate::claim::tree::TokenSource;
use crate::curve::Curve;
use crate::number::Rational;
use control::Control;
use margin::Margins;

/// What a tree proves beside the embedding itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Measured {
    /// Leaves of the tree.
    pub leaves: u64,
    /// Edges of the polygon inscribed at the end points of the leaves.
    pub edges: u64,
    /// Edges of the control polygon of the cells between those end points, if the tree admits it as well: always for polynomial pieces.
    pub control_polygon_edges: Option<u64>,
    /// The perturbation radius in the norm of greatest coordinates.
    pub infinity: Rational,
    /// The perturbation radius in the Euclidean norm, squared.
    pub euclidean_squared: Rational,
}

/// Checks statement and evidence about a curve, and the tree's tokens; returns the number of leaves.
///
/// # Errors
/// The first place where the certificate is found wanting.
pub fn check_embedding<S: TokenSource>(curve: &Curve, content: &Content, tokens: &mut S) -> Result<u64, Rejection> {
    let fails = |reason| {
        Err(Rejection {
            place: Place::Statement,
            reason,
        })
    };
    if content.evidence.grid > MAX_GRID {
        return fails(Reason::Grid);
    }
    let chain = Chain::new(curve).map_err(|piece| Rejection {
        place: Place::Curve,
        reason: Reason::PointPiece { piece },
    })?;
    let measured = measure(curve, &chain, content.evidence.grid, tokens)?;
    let (stated, found) = (content.statement.edges, measured.edges);
    if stated != found {
        return fails(Reason::Edges { stated, found });
    }
    let Radius { infinity, euclidean } = &content.statement.perturbation_radius;
    if *infinity > measured.infinity {
        return fails(Reason::Radius { norm: "infinity" });
    }
    if euclidean * euclidean > measured.euclidean_squared {
        return fails(Reason::Radius { norm: "euclidean" });
    }
    Ok(measured.leaves)
}

/// Replays a tree, boxes of runs being on the grid 2^-`grid`, and measures it.
///
/// # Errors
/// The first leaf whose obligation does not hold, and a tree that is incomplete or too long.
pub fn measure<S: TokenSource>(curve: &Curve, chain: &Chain, grid: u32, tokens: &mut S) -> Result<Measured, Rejection> {
    let context = Context::new(chain, Convention::Smooth, grid);
    let mut margins = Margins::new(curve, chain);
    let mut control = Control::new(chain);
    let mut ends: HashSet<Parameter> = HashSet::new();
    let judge = |a: &Node, b: Option<&Node>, leaf: &_| {
        context.apart(a, b, leaf)?;
        for node in std::iter::once(a).chain(b) {
            ends.insert(node.start(chain, &context.elements));
            ends.insert(node.end(chain, &context.elements));
        }
        margins.include(&context, a, b, leaf);
        control.include(&context, a, b, leaf);
        Ok(())
    };
    let leaves = replay(&context, judge, tokens).map_err(|rejection| *rejection)?;
    // Of an open curve n points bound n−1 edges; 0 and M of a closed one are one point.
    let edges = ends.len() as u64 - 1;
    let (infinity, euclidean_squared) = margins.least();
    Ok(Measured {
        leaves,
        edges,
        control_polygon_edges: control.edges(chain, &ends),
        infinity,
        euclidean_squared,
    })
}
