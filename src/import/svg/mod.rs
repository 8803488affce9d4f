//! Scalable Vector Graphics: the paths and basic shapes of a drawing, each subpath a curve.
//!
//! The XML is read by `roxmltree`, path data and numbers by this module, so that no number passes through binary64. Lines,
//! quadratics and cubics are exact; arcs and rotations where [`Note`](super::Note) does not say otherwise.

mod angle;
mod arc;
mod path;
mod shape;
mod transform;

use std::collections::HashMap;

use roxmltree::{Attribute, Document, Node, NodeId, ParsingOptions};

use self::shape::{Attributes, ShapeFault};
use self::transform::{Affine, Fault};
use super::build::{RawPath, finish};
use super::error::{ImportError, Place, curve_fault, position};
use super::{Format, Imported, ImportedCurve, Options};
use crate::curve::Position;

/// The most XML nodes read.
const MOST_NODES: u32 = 4_000_000;

/// What elements inside of these say is not drawn in place.
const NOT_DRAWN: [&str; 6] = ["defs", "clipPath", "mask", "symbol", "pattern", "marker"];
/// Drawn, but not as curves that are read here.
const NOT_READ: [&str; 4] = ["use", "text", "image", "foreignObject"];

impl Attributes for Node<'_, '_> {
    fn text(&self, name: &str) -> Option<&str> {
        self.attribute(name)
    }
}

/// Reads a drawing.
pub(super) fn read(text: &str, options: &Options) -> Result<Imported, ImportError> {
    let parsing = ParsingOptions {
        allow_dtd: true,
        nodes_limit: MOST_NODES,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, parsing).map_err(|error| {
        let at = error.pos();
        ImportError {
            place: Some(Place::Position(Position {
                line: at.row as usize,
                column: at.col as usize,
            })),
            message: format!("{error}, expected XML"),
        }
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(ImportError::at(
            text,
            root.range().start,
            format!("found the element {:?}, expected \"svg\"", root.tag_name().name()),
        ));
    }
    let mut reader = Reader {
        text,
        options,
        maps: HashMap::new(),
        counts: HashMap::new(),
        curves: Vec::new(),
        empty: 0,
        undrawn: 0,
        unread: 0,
    };
    for node in root.descendants().filter(Node::is_element) {
        reader.element(node)?;
    }
    let notes = [
        (reader.empty, "subpaths without length left out"),
        (reader.undrawn, "shapes inside of defs and the like left out"),
        (reader.unread, "elements use, text, image and foreignObject not read"),
    ];
    Ok(Imported {
        format: Format::Svg,
        curves: reader.curves,
        notes: notes
            .into_iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{what}: {count}"))
            .collect(),
    })
}

struct Reader<'t> {
    text: &'t str,
    options: &'t Options,
    /// The maps of the elements that have children, to the root's coordinates; nothing where nothing is drawn.
    maps: HashMap<NodeId, Option<Affine>>,
    /// How many elements of a kind there were, for their names.
    counts: HashMap<String, usize>,
    curves: Vec<ImportedCurve>,
    empty: usize,
    undrawn: usize,
    unread: usize,
}

impl Reader<'_> {
    fn element(&mut self, node: Node) -> Result<(), ImportError> {
        let parent = node.parent_element().and_then(|parent| self.maps.get(&parent.id()));
        let outer = parent.cloned().unwrap_or_else(|| Some(Affine::identity()));
        let tag = node.tag_name().name();
        let drawn = outer.filter(|_| !NOT_DRAWN.contains(&tag));
        if NOT_READ.contains(&tag) {
            self.unread += usize::from(drawn.is_some());
        }
        let map = match (drawn, node.attribute("transform")) {
            (Some(outer), Some(value)) => {
                let own = transform::parse(value, self.options.meaning);
                let own = own.map_err(|fault| self.fault(node, "transform", &fault))?;
                if self.options.exact && !own.is_exact() {
                    let what = "found a rotation that is not exact, expected multiples of 90 degrees (--exact)";
                    return Err(self.fault(node, "transform", &(0, what.into())));
                }
                let all = outer.after(&own);
                Some(all.map_err(|message| self.fault(node, "transform", &(0, message)))?)
            }
            (outer, _) => outer,
        };
        if node.has_children() {
            self.maps.insert(node.id(), map.clone());
        }
        let paths = match tag {
            "path" | "rect" | "circle" | "ellipse" | "line" | "polyline" | "polygon" if map.is_none() => {
                self.undrawn += 1;
                return Ok(());
            }
            "path" => {
                let data = node.attribute("d").unwrap_or("");
                let (paths, empty) = path::parse(data, self.options.meaning, self.options.exact)
                    .map_err(|fault| self.fault(node, "d", &fault))?;
                self.empty += empty;
                paths
            }
            "rect" | "circle" | "ellipse" | "line" | "polyline" | "polygon" => {
                let path = shape::path(tag, &node, self.options);
                let path = path.map_err(|ShapeFault { attribute, fault }| self.fault(node, attribute, &fault))?;
                path.into_iter().collect()
            }
            _ => return Ok(()),
        };
        self.add(node, tag, paths, map.as_ref())
    }

    /// Adds the curves of an element.
    fn add(&mut self, node: Node, tag: &str, paths: Vec<RawPath>, map: Option<&Affine>) -> Result<(), ImportError> {
        let count = self.counts.entry(tag.to_string()).or_default();
        let name = match node.attribute("id") {
            Some(id) if !id.is_empty() => id.to_string(),
            _ => format!("{tag}{count}"),
        };
        *count += 1;
        let several = paths.len() > 1;
        for (k, mut path) in paths.into_iter().enumerate() {
            if let Some(map) = map {
                map.apply_to(&mut path);
            }
            let finished = finish(path, self.options);
            let finished =
                finished.map_err(|error| ImportError::at(self.text, node.range().start, curve_fault(&error)))?;
            match finished {
                None => self.empty += 1,
                Some((curve, notes)) => self.curves.push(ImportedCurve {
                    name: if several { format!("{name}/{k}") } else { name.clone() },
                    aliases: if several { vec![name.clone()] } else { Vec::new() },
                    curve,
                    notes,
                }),
            }
        }
        Ok(())
    }

    /// Whether an attribute's value has the bytes of the file, one by one.
    fn is_literal(&self, attribute: &Attribute) -> bool {
        let source = self.text.get(attribute.range_value()).unwrap_or("");
        source.len() == attribute.value().len() && !source.contains('&')
    }

    /// A fault in an attribute, told by the line and column in the file.
    fn fault(&self, node: Node, attribute: &str, (offset, message): &Fault) -> ImportError {
        let found = node.attribute_node(attribute);
        let at = match &found {
            // Line ends become spaces, one for one; with entities the bytes of the value are not those of the file.
            Some(found) if self.is_literal(found) => found.range_value().start + offset,
            Some(found) => found.range_value().start,
            None => node.range().start,
        };
        ImportError {
            place: Some(Place::Position(position(self.text, at))),
            message: format!("{} {attribute}: {message}", node.tag_name().name()),
        }
    }
}
