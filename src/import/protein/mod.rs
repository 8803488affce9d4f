//! Protein structures: the backbone of each chain of each model as C¹ cubics through its Cα atoms.
//!
//! The pieces follow the rule of Catmull and Rom (1974) with the file's coordinates, exactly. Of atoms in alternate locations the first is taken.
//! Neighbours whose residue numbers leave a gap are joined all the same, and the gaps counted in a note.

mod mmcif;
mod pdb;

pub(super) use mmcif::read as read_mmcif;
pub(super) use pdb::read as read_pdb;

use super::build::{Point, RawPath, catmull_rom, finish, without_repetitions};
use super::error::{ImportError, curve_fault};
use super::{Format, Imported, ImportedCurve, Note, Options};

/// The Cα atoms of one chain in one model.
struct Chain {
    model: String,
    name: String,
    points: Vec<Point>,
    /// The residue of the last atom.
    residue: Residue,
    gaps: usize,
}

/// Number and insertion code of a residue.
#[derive(Clone, PartialEq, Eq)]
struct Residue {
    number: Option<i64>,
    insertion: String,
}

/// Chains as they are read, atom by atom.
#[derive(Default)]
struct Chains(Vec<Chain>);

impl Chains {
    /// Adds a Cα atom; an alternate location of the residue before is passed over.
    fn add(&mut self, model: &str, name: &str, residue: Residue, point: Point) {
        // Atoms of a chain stand together, but for those of other chains between; nearly always it is the last one.
        let found = self
            .0
            .iter_mut()
            .rev()
            .find(|chain| chain.model == model && chain.name == name);
        match found {
            Some(chain) if chain.residue == residue => {}
            Some(chain) => {
                let follows = match (chain.residue.number, residue.number) {
                    (Some(before), Some(after)) => {
                        after.checked_sub(before).is_some_and(|step| (0..=1).contains(&step))
                    }
                    _ => true,
                };
                chain.gaps += usize::from(!follows);
                chain.residue = residue;
                chain.points.push(point);
            }
            None => self.0.push(Chain {
                model: model.to_string(),
                name: name.to_string(),
                points: vec![point],
                residue,
                gaps: 0,
            }),
        }
    }

    /// The curves; a file with one model does not name it.
    fn finish(self, format: Format, options: &Options) -> Result<Imported, ImportError> {
        let several = self.0.iter().any(|chain| chain.model != self.0[0].model);
        let mut curves = Vec::new();
        let mut short = 0;
        for chain in self.0 {
            let (points, dropped) = without_repetitions(chain.points, false);
            let path = RawPath {
                pieces: catmull_rom(&points, false),
                ..RawPath::default()
            };
            let finished = finish(path, options);
            let name = match several {
                true => format!("{}/{}", chain.model, chain.name),
                false => chain.name.clone(),
            };
            let finished =
                finished.map_err(|error| ImportError::whole(format!("chain {name}: {}", curve_fault(&error))))?;
            let Some((curve, mut notes)) = finished else {
                short += 1;
                continue;
            };
            if dropped > 0 {
                notes.push(Note::Dropped { pieces: dropped });
            }
            if chain.gaps > 0 {
                notes.push(Note::Bridged { gaps: chain.gaps });
            }
            notes.push(Note::Smoothed);
            curves.push(ImportedCurve {
                aliases: if several {
                    vec![chain.model, chain.name]
                } else {
                    Vec::new()
                },
                name,
                curve,
                notes,
            });
        }
        let notes = (short > 0).then(|| format!("chains of a single residue left out: {short}"));
        Ok(Imported {
            format,
            curves,
            notes: notes.into_iter().collect(),
        })
    }
}
