//! Pictures of curves and of what certificates say about them: SVG drawings and self-contained HTML reports.
//!
//! A [`Scene`] holds what is drawn, in the curve's coordinates: [`Scene::of_curve`] makes the curve with its control polygon and joints,
//! [`Scene::of_certificate`] adds what the claim is about. [`svg()`] draws a scene in the plane, in one or several views; [`html()`] makes
//! a page with a view that turns, the leaves of the cover tree, the certificate and the checker; [`index()`] lists many curves,
//! each with a [`thumbnail()`]. A [`Chart`] has numbers in place of curves: bounds as bars on one axis, and errors against
//! levels. Pictures are made in binary64 and prove nothing; they depend on their input alone, so that the same certificate
//! gives the same file.

mod chart;
mod claims;
mod html;
mod index;
mod motion;
mod scene;
mod segment;
mod svg;
mod thumbnail;
mod ticks;
mod values;
mod view;

pub use chart::{Bar, BarPanel, Chart, LevelPanel, Series, Standing};
pub use html::{Report, html};
pub use index::{Cell, GENERATOR, Index, Row, index};
pub use scene::{Item, Kind, LeafPair, Scene, Shape};
pub use segment::Segment;
pub use svg::{Picture, svg};
pub use thumbnail::thumbnail;
pub use view::{View, ViewError};

/// A point or vector; the third coordinate is 0 in the plane.
pub type Point = [f64; 3];
