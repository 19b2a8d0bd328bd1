//! Honeybee models (HBJSON): rooms and shades with their modifiers, sensor grids, views,
//! luminaires and dynamic groups.
//!
//! [`Model`] is the file as the honeybee-schema of Ladybug Tools has it (2026), with the keys that
//! say something of light; [`Model::parse`] refuses what has the wrong type. [`surfaces()`] says
//! which polygons there are and what they are made of: a face with its apertures and doors cut out,
//! the two faces between rooms once. What becomes of all that is up to `geometry` and `import`.

mod defaults;
mod document;
mod groups;
mod look;
mod model;
mod modifiers;
mod names;
mod radiance;
mod shapes;
mod slots;
mod surfaces;
mod views;

pub(crate) use document::Point;
pub(crate) use groups::{Group, GroupState, StateShade};
pub(crate) use model::Model;
pub(crate) use radiance::{Luminaire, LuminaireInstance, SensorGrid, View};
pub(crate) use shapes::{Face3D, Mesh3D};
pub(crate) use surfaces::{Shape, Surface, Surfaces, surfaces};
