//! What exists: triangles, materials, placed luminaires, sensors; their loaders and checks.
//!
//! A [`Scene`] is built once, checked once and never changed. Everything that can go wrong with a
//! user's files goes wrong here, with the place in the file; light transport cannot fail.
//!
//! Read on at [`scene`] for the model, at [`project`] for the project file, and at [`mod@load`] for
//! the way from bytes to a [`Scene`].

pub mod annual;
pub mod bsdf;
pub mod camera;
mod checks;
mod enclosures;
pub mod environment;
pub mod error;
mod export;
mod files;
mod geometry;
mod honeybee;
mod import;
pub mod light;
pub mod load;
pub mod mesh;
mod nearest;
pub mod project;
mod radiance;
pub mod rgb;
pub mod scene;
pub mod sensor;
pub mod solids;

pub use annual::{
    Blinds, BlindsControl, BlindsGroup, BlindsPosition, ElectricLight, Occupancy, OccupiedDays,
    Thresholds, YearTerms,
};
pub use bsdf::Bsdf;
pub use camera::{Camera, View};
pub use environment::{Environment, Opening, SkyFacts, SkyModel, Sun};
pub use error::{LoadError, Spanned, Warning};
pub use export::{Exported, ExportedFile, export_radiance};
pub use files::{FileKind, Files, TriangleArrays, too_large};
pub use geometry::ifc_advice;
pub use glam::DVec3;
pub use import::{
    ImportTerms, Imported, ImportedFile, RadianceTerms, import_honeybee, import_radiance,
};
pub use light::Light;
pub use load::{Loaded, Places, load};
pub use mesh::Mesh;
pub use nearest::nearest;
pub use project::{LengthUnit, SimulationSection, is_file_name};
pub use quasilux_text::Position;
pub use rgb::Rgb;
pub use scene::{Material, Scene};
pub use sensor::{Grid, Quantity, Sensor, SensorPoint, SensorShape};

/// Tests the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
