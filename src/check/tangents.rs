//! The tangents T of a node in one width (FORMAT §5).

use super::chain::{ScaleRef, convert};
use super::cover::Context;
use super::element::{Element, Node, corner_pieces};
use super::part::{Block, Geometry, Part};
use super::word::{Word, vector};

/// The tangents of a node: integer vectors in groups, each group over one scale.
pub struct Tangents<'s, W> {
    vectors: Vec<[W; 3]>,
    groups: Vec<Group<'s>>,
}

struct Group<'s> {
    end: usize,
    scale: ScaleRef<'s>,
    /// Belongs to a piece, not to a point element.
    of_piece: bool,
}

impl<'s, W: Word> Tangents<'s, W> {
    /// T of a node; `None` if it does not fit this width.
    pub fn new(context: &'s Context, node: &Node) -> Option<Self> {
        let mut tangents = Tangents {
            vectors: Vec::new(),
            groups: Vec::new(),
        };
        match node {
            Node::Run { first, last, .. } => {
                for element in *first..*last {
                    match context.elements.get(element) {
                        Element::Piece(piece) => tangents.push_part(context, &Part::whole(context.chain, piece))?,
                        point => tangents.push_point(context, point)?,
                    }
                }
            }
            Node::Point(element) => tangents.push_point(context, *element)?,
            Node::Part(part) => tangents.push_part(context, part)?,
        }
        Some(tangents)
    }

    fn push_part(&mut self, context: &'s Context, part: &Part) -> Option<()> {
        match &part.geometry {
            Geometry::Narrow(block) => self.push_nonzero(block),
            Geometry::Wide(block) => self.push_nonzero(block),
            Geometry::Large(block) => self.push_nonzero(block),
        }?;
        self.groups.push(Group {
            end: self.vectors.len(),
            scale: part.tangent_scale(context.chain),
            of_piece: true,
        });
        Some(())
    }

    fn push_nonzero<S: Word>(&mut self, block: &Block<'_, S>) -> Option<()> {
        for tangent in block.tangents.iter() {
            if tangent.iter().any(|x| !x.vanishes()) {
                self.vectors.push(convert(tangent)?);
            }
        }
        Some(())
    }

    fn push_point(&mut self, context: &'s Context, element: Element) -> Option<()> {
        let chain = context.chain;
        let directions = match element {
            Element::Piece(_) => unreachable!("a piece is not a point element"),
            Element::Start => vec![(0, false)],
            Element::End => vec![(chain.count() - 1, true)],
            Element::Corner(joint) => {
                let (before, after) = corner_pieces(chain, joint);
                vec![(before, true), (after, false)]
            }
        };
        for (piece, end) in directions {
            self.vectors.push(vector(&chain.end_direction(piece, end))?);
            let scale = chain.pieces[piece].tangent_scale.doubled(0);
            self.groups.push(Group {
                end: self.vectors.len(),
                scale,
                of_piece: false,
            });
        }
        Some(())
    }

    /// All vectors, whatever their scale.
    pub fn all(&self) -> &[[W; 3]] {
        &self.vectors
    }

    /// The groups with their scales.
    pub fn groups(&self) -> impl Iterator<Item = (&[[W; 3]], ScaleRef<'s>)> {
        let mut start = 0;
        self.groups.iter().map(move |group| {
            let vectors = &self.vectors[start..group.end];
            start = group.end;
            (vectors, group.scale)
        })
    }

    /// X: the vectors that belong to pieces.
    pub fn of_pieces(&self) -> impl Iterator<Item = &[W; 3]> {
        let mut start = 0;
        self.groups.iter().flat_map(move |group| {
            let range = start..group.end;
            start = group.end;
            if group.of_piece { &self.vectors[range] } else { &[] }
        })
    }
}

/// Calls `test` with a positive multiple of αv+βw for all v∈T(A), w∈T(B), with their exact scales; stops at the first `false`.
/// Where α or β is 0, one vector of the other side stands for all of its side.
pub fn all_combinations<W: Word>(
    a: &Tangents<W>,
    b: &Tangents<W>,
    alpha: &W,
    beta: &W,
    mut test: impl FnMut(&[W; 3]) -> Option<bool>,
) -> Option<bool> {
    let multiple = |vectors: &[[W; 3]], factor: &W, test: &mut dyn FnMut(&[W; 3]) -> Option<bool>| {
        // Only the factor's sign matters.
        let sign = W::from_i128(factor.sign() as i128)?;
        for v in vectors {
            if !test(&[v[0].times(&sign)?, v[1].times(&sign)?, v[2].times(&sign)?])? {
                return Some(false);
            }
        }
        Some(true)
    };
    if beta.vanishes() {
        return multiple(a.all(), alpha, &mut test);
    }
    if alpha.vanishes() {
        return multiple(b.all(), beta, &mut test);
    }
    for (vectors_a, scale_a) in a.groups() {
        for (vectors_b, scale_b) in b.groups() {
            // v/(c·s) and w/(c·t): αv·t + βw·s is a positive multiple of the combination.
            let (s, t, _) = super::hull::bring_together::<W>(scale_a, scale_b)?;
            let (alpha, beta) = (alpha.times(&t)?, beta.times(&s)?);
            for v in vectors_a {
                for w in vectors_b {
                    if !test(&super::word::combine(&alpha, v, &beta, w)?)? {
                        return Some(false);
                    }
                }
            }
        }
    }
    Some(true)
}
