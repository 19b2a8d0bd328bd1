//! The results of a run with their intervals, as a document, tables, spreadsheets and pictures.
//!
//! A [`Report`] is built once from the scene, the settings and the estimates; all forms of output
//! only read it. Nothing here can fail, and nothing reads the clock or writes a file.
//!
//! Read on at [`report`] for the figures, [`json`] for the document that other programs rely on,
//! [`csv`] and [`table`] for spreadsheets and terminals, and [`picture`] for grids and cameras as
//! PNG and OpenEXR. [`number`] decides how many digits a figure deserves.

#[cfg(test)]
pub(crate) mod example;

pub mod annual;
pub mod camera;
mod caveat;
mod certified;
pub mod csv;
mod figure;
pub mod json;
pub mod number;
pub mod outside;
pub mod picture;
pub mod plan;
pub mod report;
pub mod table;
mod unseen;

pub use camera::{CameraFiles, CameraReport};
pub use caveat::Caveat;
pub use certified::CertifiedFigure;
pub use figure::Figure;
pub use outside::{DaylightFactor, DaylightFactorComponents, Outside};
pub use picture::{PictureOf, camera_false_colour_png, exr, false_colour_png, tone_mapped_png};
pub use plan::plan;
pub use quasilux_drawing::picture::PlanMark;
pub use report::{PointReport, Report, Run, RunFacts, SensorReport, Summary, TermReport};
pub use table::Style;
pub use unseen::{PointUnseen, SummaryUnseen};
