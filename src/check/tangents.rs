//! The tangents T of a node in one width (FORMAT §5).

use std::borrow::Cow;
use std::cmp::Ordering;

use super::chain::{ScaleRef, Width, convert};
use super::cover::Context;
use super::element::{Element, Node, corner_pieces};
use super::part::Geometry;
use super::word::{Word, vector};

/// The tangents of a node: integer vectors in groups, each group over one scale.
pub struct Tangents<'s, W: Clone> {
    vectors: Cow<'s, [[W; 3]]>,
    groups: Groups<'s>,
}

#[derive(Clone, Copy)]
struct Group<'s> {
    end: usize,
    scale: ScaleRef<'s>,
    /// Belongs to a piece, not to a point element.
    of_piece: bool,
}

/// Mostly there is one group, which takes no memory of its own.
enum Groups<'s> {
    One(Group<'s>),
    Many(Vec<Group<'s>>),
}

impl<'s> Groups<'s> {
    fn as_slice(&self) -> &[Group<'s>] {
        match self {
            Groups::One(group) => std::slice::from_ref(group),
            Groups::Many(groups) => groups,
        }
    }
}

impl<'s, W: Word> Tangents<'s, W> {
    /// T of a node; `None` if it does not fit this width.
    pub fn new(context: &'s Context, node: &'s Node) -> Option<Self> {
        let mut all = Collected {
            vectors: Vec::new(),
            groups: Vec::new(),
        };
        match node {
            Node::Part(part) => {
                let vectors = match &part.geometry {
                    Geometry::Narrow(block) => nonzero(block.tangents(), W::of_narrow),
                    Geometry::Wide(block) => nonzero(block.tangents(), W::of_wide),
                    Geometry::Large(block) => nonzero(block.tangents(), W::of_large),
                }?;
                let group = Group {
                    end: vectors.len(),
                    scale: part.tangent_scale(context.chain),
                    of_piece: true,
                };
                return Some(Tangents {
                    vectors,
                    groups: Groups::One(group),
                });
            }
            Node::Run { first, last, .. } => {
                for element in *first..*last {
                    match context.elements.get(element) {
                        Element::Piece(piece) => all.push_piece(context, piece)?,
                        point => all.push_point(context, point)?,
                    }
                }
            }
            Node::Point(element) => all.push_point(context, *element)?,
        }
        Some(Tangents {
            vectors: Cow::Owned(all.vectors),
            groups: Groups::Many(all.groups),
        })
    }

    /// All vectors, whatever their scale.
    pub fn all(&self) -> &[[W; 3]] {
        &self.vectors
    }

    /// The groups with their scales.
    pub fn groups(&self) -> impl Iterator<Item = (&[[W; 3]], ScaleRef<'s>)> {
        let mut start = 0;
        self.groups.as_slice().iter().map(move |group| {
            let vectors = &self.vectors[start..group.end];
            start = group.end;
            (vectors, group.scale)
        })
    }

    /// X: the vectors that belong to pieces, group by group.
    pub fn of_pieces(&self) -> impl Iterator<Item = &[[W; 3]]> {
        let mut start = 0;
        self.groups.as_slice().iter().filter_map(move |group| {
            let range = start..group.end;
            start = group.end;
            group.of_piece.then(|| &self.vectors[range])
        })
    }
}

/// The vectors that are not zero, converted; as they are where none is.
fn nonzero<'n, S: Word, W: Word>(
    vectors: &'n [[S; 3]],
    convert_all: impl Fn(&'n [[S; 3]]) -> Option<Cow<'n, [[W; 3]]>>,
) -> Option<Cow<'n, [[W; 3]]>> {
    let zero = |v: &[S; 3]| v.iter().all(S::vanishes);
    if !vectors.iter().any(zero) {
        return convert_all(vectors);
    }
    let rest = vectors.iter().filter(|v| !zero(v));
    rest.map(convert).collect::<Option<_>>().map(Cow::Owned)
}

/// The tangents of several elements.
struct Collected<'s, W> {
    vectors: Vec<[W; 3]>,
    groups: Vec<Group<'s>>,
}

impl<'s, W: Word> Collected<'s, W> {
    fn push_piece(&mut self, context: &'s Context, piece: usize) -> Option<()> {
        let chain = context.chain;
        match chain.pieces[piece].width {
            Width::Narrow => self.push_nonzero(chain.narrow_numbers(piece).tangents),
            Width::Wide => self.push_nonzero(chain.wide_numbers(piece).tangents),
            Width::Large => self.push_nonzero(chain.large_numbers(piece).tangents),
        }?;
        self.groups.push(Group {
            end: self.vectors.len(),
            scale: chain.pieces[piece].tangent_scale.doubled(0),
            of_piece: true,
        });
        Some(())
    }

    fn push_nonzero<S: Word>(&mut self, tangents: &[[S; 3]]) -> Option<()> {
        for tangent in tangents {
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
}

/// Calls `test` with a positive multiple of αv for all v∈T; stops at the first `false`.
pub fn all_multiples<W: Word>(
    tangents: &Tangents<W>,
    alpha: &W,
    mut test: impl FnMut(&[W; 3]) -> Option<bool>,
) -> Option<bool> {
    // Only the factor's sign matters.
    let (zero, sign) = (W::zero(), alpha.sign());
    for v in tangents.all() {
        let holds = match sign {
            Ordering::Greater => test(v)?,
            Ordering::Less => test(&[zero.minus(&v[0])?, zero.minus(&v[1])?, zero.minus(&v[2])?])?,
            Ordering::Equal => test(&[zero.clone(), zero.clone(), zero.clone()])?,
        };
        if !holds {
            return Some(false);
        }
    }
    Some(true)
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
    if beta.vanishes() {
        return all_multiples(a, alpha, test);
    }
    if alpha.vanishes() {
        return all_multiples(b, beta, test);
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
