//! Measured photometry: luminaire files, spherical tables, exact sampling.
//!
//! A file is read ([`read_ies`], [`read_ldt`], [`read_tm33`]) into a [`Photometry`]: intensities
//! over directions, with the facts of the header. Behind it stands a [`SphericalTable`], bilinear
//! on a grid of spherical angles, with its integral in closed form and an inverse transform that
//! turns two uniform coordinates into a direction, continuously and without rejection.
//!
//! What of a luminaire shines is a [`LuminousShape`], by the signs of the file's dimensions.
//!
//! The luminaire frame has gamma = 0 (nadir) along -z, C0 along +x and C90 along +y; [`Web`] says
//! where the angles of each photometric type lie in it.
//!
//! ```
//! use quasilux_photometry::DVec3;
//! let file = b"IESNA:LM-63-2002\n[TEST] example\nTILT=NONE\n\
//!     1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 180\n0\n100 100\n";
//! let read = quasilux_photometry::read_ies(file)?;
//! let flux_lm = read.photometry.flux_lm();
//! assert!((flux_lm - 400.0 * std::f64::consts::PI).abs() < 1e-9);
//! assert_eq!(read.photometry.intensity_cd(DVec3::NEG_Z), 100.0);
//! # Ok::<(), quasilux_photometry::ParseError>(())
//! ```
//!
//! What a reader tolerates beyond the standard is listed in [`WarningKind`]; each case is reported
//! as a [`Warning`]. Any bytes may be given: readers do not panic, and take no more memory than
//! [`max_read_memory_bytes`]. [`write_ies`] and [`write_ldt`] write files that read back to the
//! same table. The formats stand line by line in [`formats`].

pub mod analysis;
mod angles;
pub mod candela;
mod count;
mod facts;
mod file_format;
pub mod formats;
mod gldf;
mod ies;
mod ldt;
mod memory;
mod parsed;
mod photometry;
mod scaling;
mod shape;
mod standard;
mod sum;
mod table;
mod tilt;
mod tm33;
mod turning;
mod warning;
mod web;
mod write;

pub use analysis::Analysis;
pub use facts::{EulumdatFacts, Keyword, LuminaireFacts, LuminousOpening, PhotometricType, Tilt};
pub use file_format::Format;
pub use glam::{DMat3, DVec3};
pub use gldf::{
    ContainerFact, ContainerWarning, GldfChoice, GldfError, GldfLuminaire, is_gldf, read_gldf,
    refused_format,
};
pub use ies::{ReadTilt, read_ies, read_tilt, write_ies};
pub use ldt::{read_ldt, write_ldt};
pub use memory::max_read_memory_bytes;
pub use parsed::Parsed;
pub use photometry::Photometry;
pub use quasilux_sampling::ParseNameError;
pub use quasilux_text::{ParseError, Position};
pub use scaling::{LengthError, OfLength};
pub use shape::{Axis, LuminousShape, Solid, SurfacePoint};
pub use standard::{IesStandard, Standard, Tm33Edition};
pub use table::{Angles, DirectionSample, Grid, Maximum, SphericalTable, Symmetry, TableError};
pub use tilt::{TiltFactor, TiltSupport};
pub use tm33::read_tm33;
pub use warning::{Warning, WarningKind};
pub use web::{Web, WebAngles};
pub use write::{Encoded, EncodingNote};

/// Tests the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
