//! Measured surfaces: files of scattering distributions, read into tables that are sampled exactly.
//!
//! A file is read ([`read_bsdf`]) into a [`MeasuredBsdf`]: for each side of a thin sheet, what is
//! reflected and what passes, as a [`Distribution`]. Each kind of table keeps the cells that it was
//! stored with; none is turned into another. Clear glass is [`read_glazing`]'s, and has no lobes.
//!
//! ```
//! use quasilux_bsdf::{DVec3, Side, ScatteringMode, read_bsdf};
//! let file = b"VARS theta_i,phi_i,theta_s,phi_s,BRDF\n0,0,0,0,0.2\n";
//! let read = read_bsdf(file)?;
//! let reflection = read.bsdf.scattering(Side::Front, ScatteringMode::Reflection).unwrap();
//! assert!((reflection.albedo(DVec3::Z)[0] - 0.2 * std::f64::consts::PI).abs() < 1e-3);
//! let sample = reflection.sample(DVec3::Z, [0.3, 0.7]).unwrap();
//! let weight = reflection.evaluate(DVec3::Z, sample.wo)[0] * sample.wo.z / sample.pdf_sr;
//! assert!((weight - reflection.albedo(DVec3::Z)[0]).abs() < 1e-12);
//! # Ok::<(), quasilux_bsdf::ParseError>(())
//! ```
//!
//! # Frame
//! One frame for the whole sheet. `x` and `y` lie in it, the same two for both sides: seen from the
//! back, with `y` up, `x` points to the right. A direction has unit length and points away from the
//! sheet, and its `z` is the cosine of the angle to the normal *of the side that it is on*:
//! positive for the incident and the scattered direction alike, in reflection and in transmission.
//! Light that goes straight through the sheet has `wo = (-wi.x, -wi.y, wi.z)`, and so has light
//! that a mirror reflects.
//!
//! The front is the side that a file calls so. In WINDOW files it faces outdoors and Radiance takes
//! the back for the side that the normal points to (`doc/notes/BSDFdirections.txt`). Files of one
//! measured side, all other formats, have it in front and count azimuths counterclockwise as seen
//! from there, from `-x` of this frame on: from the right, with `y` up.

mod adjoint;
mod analysis;
mod astm;
mod color;
mod ddr;
mod defects;
mod distribution;
mod facts;
pub mod formats;
mod from_function;
mod gaps;
mod glazing;
mod gridded;
mod hemisphere;
mod klems;
mod measured;
mod memory;
mod merl;
mod parsed;
mod read;
mod side;
mod straight_peak;
mod tables;
mod tokens;
mod tree;
mod warning;
mod window_xml;

pub use analysis::{BsdfAnalysis, EnergyBalance, Reciprocity};
pub use astm::read_astm;
pub use color::luminance;
pub use ddr::read_ddr;
pub use distribution::Distribution;
pub use facts::{BsdfFacts, BsdfFormat};
pub use glam::DVec3;
pub use glazing::{
    Glazing, GlazingLayer, GlazingProduct, ParsedGlazing, SheetShares, read_glazing,
};
pub use gridded::GriddedTable;
pub use hemisphere::ScatterSample;
pub use klems::{AngleBasis, BandDefinition, KlemsTable, ThetaBand};
pub use measured::{MeasuredBsdf, SheetDistribution};
pub use memory::max_bsdf_memory_bytes;
pub use merl::read_merl;
pub use parsed::Parsed;
pub use quasilux_sampling::ParseNameError;
pub use quasilux_text::{ParseError, Position};
pub use read::{read_bsdf, read_bsdf_named};
pub use side::{ScatteringMode, Side};
pub use straight_peak::StraightPeak;
pub use tree::{AdjointTree, TensorTree};
pub use warning::{Warning, WarningKind};
pub use window_xml::read_bsdf_xml;

/// Tests the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
