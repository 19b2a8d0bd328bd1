//! Radiance: scenes (`.rad`), and what its materials are here.
//!
//! [`Scene::read`] goes through the files of a scene as `oconv` does, one after the other:
//! modifiers by the last definition before they are used, aliases, and commands, of which `xform`
//! and a few generators are evaluated and all others refused ([`mod@command`]). [`Looks`] is the
//! one mapping of materials for all readers. What becomes of surfaces, luminaires and the sky is
//! up to `geometry` and `import`.

mod collector;
mod command;
mod data;
mod definitions;
mod document;
mod findings;
mod frame;
mod generators;
pub(crate) mod glass;
mod includes;
mod lamps;
mod look;
mod materials;
mod outside;
mod pattern;
mod points;
mod refusal;
mod scene;
mod shapes;
mod tessellation;
mod views;
mod web;
mod words;
mod xform;

pub(crate) use findings::Findings;
pub(crate) use frame::sincos;
pub(crate) use lamps::Lamp;
pub(crate) use look::{Coated, Look, Looks, Unusable, invisible};
pub(crate) use outside::{Ground, Outside, SkyKind};
pub(crate) use points::points;
pub(crate) use scene::{Scene, Surface};
pub(crate) use shapes::Shape;
pub(crate) use tessellation::tessellate;
pub(crate) use views::{View, views};
