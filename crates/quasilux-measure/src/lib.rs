//! What is reported: figures with intervals, as a table, a document, a spreadsheet and a picture.
//!
//! A [`Report`] is built once from the scene, the settings and the estimates; the four forms only
//! read it. Nothing here can fail, and nothing reads the clock or writes a file.
//!
//! Read on at [`report`] for the figures, [`json`] for the document that other programs rely on,
//! [`csv`] and [`table`] for people with spreadsheets and terminals, and [`picture`] for the
//! false-colour picture of a grid, [`camera`] and [`open_exr`] for what a camera gives. [`number`] decides how many digits a figure deserves. Plots of
//! experiments are drawn by [`svg`].

#[cfg(test)]
pub(crate) mod example;

pub mod camera;
pub mod csv;
pub mod json;
pub mod number;
pub mod open_exr;
pub mod picture;
pub mod report;
pub mod svg;
pub mod table;
pub mod ticks;

pub use camera::{CameraFiles, CameraReport};
pub use open_exr::exr;
pub use picture::{camera_false_colour_png, false_colour_png, tone_mapped_png};
pub use report::{Figure, PointReport, Report, Run, RunFacts, SensorReport, Summary, TermReport};
pub use table::Style;
