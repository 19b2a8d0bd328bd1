//! Pictures and diagrams as files: PNG, SVG and OpenEXR from plain numbers.
//!
//! Nothing here knows a scene or a simulation, reads a file or can fail. [`picture`] draws grids
//! and images in false colours and tone-mapped, [`svg`] line plots, scatter plots and photometric
//! diagrams, [`exr`] writes floating-point layers. [`ticks`] and [`number`] choose round numbers
//! and their digits.

pub mod exr;
mod font;
pub mod number;
pub mod picture;
pub mod svg;
pub mod ticks;

#[cfg(test)]
pub(crate) mod example;

/// The example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
