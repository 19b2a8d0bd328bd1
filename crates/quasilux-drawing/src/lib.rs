//! Pictures and diagrams as files: PNG, SVG and OpenEXR from plain numbers.
//!
//! Nothing here knows a scene or a simulation, reads a file or can fail. [`picture`] draws grids
//! and images in false colours and tone-mapped, [`diagram`] line plots, scatter plots and
//! photometric diagrams. Each of them is a [`Drawing`], a list of shapes that is written as SVG or
//! as PNG. [`exr`] writes floating-point layers. [`ticks`] and [`number`] choose round numbers and
//! their digits.

mod canvas;
pub mod diagram;
mod drawing;
pub mod exr;
mod font;
pub mod number;
pub mod picture;
mod raster;
mod style;
mod svg;
mod text;
pub mod ticks;

pub use drawing::{Drawing, Frame};
pub use style::{Anchor, Colour, Dash, PALETTE, Stroke, TextStyle};

#[cfg(test)]
pub(crate) mod example;

/// The example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
