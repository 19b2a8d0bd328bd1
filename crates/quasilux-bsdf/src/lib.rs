//! Measured surfaces: files of scattering distributions, read into tables that are sampled exactly.
//!
//! A file is read ([`read_bsdf`]) into a [`MeasuredBsdf`]: for each side of a thin sheet, what is reflected
//! and what passes, as a [`Distribution`]. Each kind of table keeps the cells that it was stored with; none is
//! turned into another.
//!
//! ```
//! use glam::DVec3;
//! use quasilux_bsdf::{Side, Way, read_bsdf};
//! let file = b"VARS theta_i,phi_i,theta_s,phi_s,BRDF\n0,0,0,0,0.2\n";
//! let read = read_bsdf(file)?;
//! let reflection = read.bsdf.scattering(Side::Front, Way::Reflection).unwrap();
//! assert!((reflection.albedo(DVec3::Z)[0] - 0.2 * std::f64::consts::PI).abs() < 1e-3);
//! let sample = reflection.sample(DVec3::Z, [0.3, 0.7]).unwrap();
//! let weight = reflection.evaluate(DVec3::Z, sample.wo)[0] * sample.wo.z / sample.pdf_sr;
//! assert!((weight - reflection.albedo(DVec3::Z)[0]).abs() < 1e-12);
//! # Ok::<(), quasilux_bsdf::ParseError>(())
//! ```
//!
//! # Frame
//! One frame for the whole sheet. `x` and `y` lie in it, the same two for both sides: seen from the back, with `y` up,
//! `x` points to the right. A direction has unit length and points away from the sheet, and its `z` is the cosine of the
//! angle to the normal *of the side that it is on*: positive for the incident and the scattered direction
//! alike, in reflection and in transmission. Light that goes straight through the sheet has
//! `wo = (-wi.x, -wi.y, wi.z)`, and so has light that a mirror reflects.
//!
//! The front is the side that a file calls so. In WINDOW files it faces outdoors and Radiance takes the back for the
//! side that the normal points to (`doc/notes/BSDFdirections.txt`). Files of one measured side, all other formats, have it in front
//! and count azimuths counterclockwise as seen from there, from `-x` of this frame on: from the right, with `y` up.

mod analysis;
mod astm;
mod ddr;
mod defects;
mod distribution;
pub mod formats;
mod from_function;
mod gaps;
mod gridded;
mod klems;
mod memory;
mod merl;
mod pieces;
mod read;
mod reversed;
mod tree;
mod warning;
mod window_xml;

pub use analysis::{BsdfAnalysis, EnergyBalance, Reciprocity};
pub use astm::read_astm;
pub use ddr::read_ddr;
pub use distribution::{Distribution, ScatterSample, luminance};
pub use gridded::GriddedTable;
pub use klems::{AngleBasis, KlemsTable, ThetaBand};
pub use memory::max_bsdf_memory_bytes;
pub use merl::read_merl;
pub use quasilux_text::{ParseError, Position};
pub use read::{BsdfFormat, Parsed, read_bsdf, read_bsdf_named};
pub use tree::{ExchangedTree, TensorTree};
pub use warning::{Warning, WarningKind};
pub use window_xml::read_bsdf_xml;

use std::sync::OnceLock;

/// One measured surface: how both sides of a thin sheet scatter light.
#[derive(Clone, Debug)]
pub struct MeasuredBsdf {
    facts: BsdfFacts,
    /// By [`Side`] that light arrives on, then by [`Way`].
    scattering: [[Option<Distribution>; 2]; 2],
    kept: Box<Kept>,
}

/// What is made of tables once somebody asks.
#[derive(Clone, Debug, Default)]
struct Kept {
    /// Their directions exchanged, by the side and the way of the original.
    exchanged: [[OnceLock<Option<Distribution>>; 2]; 2],
    analysis: OnceLock<BsdfAnalysis>,
}

/// What a file says about its surface.
#[derive(Clone, Debug, PartialEq)]
pub struct BsdfFacts {
    /// The format that the file has.
    pub format: BsdfFormat,
    /// Empty where the file gives none.
    pub name: String,
    /// Empty where the file gives none.
    pub manufacturer: String,
    /// Thickness of the sheet; light is scattered as if it had none.
    pub thickness_m: Option<f64>,
}

/// A side of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The side that a file calls the front; the measured side of a reflection without sides.
    Front,
    /// The other side.
    Back,
}

/// Where scattered light goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Way {
    /// Back to the side that it came from.
    Reflection,
    /// To the other side.
    Transmission,
}

impl Side {
    /// Both sides.
    pub const ALL: [Self; 2] = [Self::Front, Self::Back];

    /// The other side.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Front => Self::Back,
            Self::Back => Self::Front,
        }
    }

    /// `front` or `back`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
        }
    }
}

impl Way {
    /// Both ways.
    pub const ALL: [Self; 2] = [Self::Reflection, Self::Transmission];

    /// `reflection` or `transmission`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reflection => "reflection",
            Self::Transmission => "transmission",
        }
    }
}

impl MeasuredBsdf {
    /// A surface of tables that a program made; the last one counts where several are for the same side and way.
    pub fn from_tables(
        facts: BsdfFacts,
        tables: impl IntoIterator<Item = (Side, Way, Distribution)>,
    ) -> Self {
        let mut surface = Self::new(facts);
        tables.into_iter().for_each(|(side, way, table)| surface.set(side, way, table));
        surface
    }

    /// A surface that scatters nothing yet.
    #[must_use]
    pub fn new(facts: BsdfFacts) -> Self {
        Self { facts, scattering: [[None, None], [None, None]], kept: Box::default() }
    }

    /// Takes over how light that arrives on `side` is scattered that way.
    pub fn set(&mut self, side: Side, way: Way, distribution: Distribution) {
        self.scattering[side as usize][way as usize] = Some(distribution);
        self.kept.exchanged[side as usize][way as usize] = OnceLock::new();
        self.kept.analysis = OnceLock::new();
    }

    /// How light that arrives on `side` is scattered that way; `None` where nothing is.
    #[must_use]
    pub fn scattering(&self, side: Side, way: Way) -> Option<&Distribution> {
        self.scattering[side as usize][way as usize].as_ref()
    }

    /// The same for light that goes the other way round: arriving where that leaves, and leaving where it arrives. Made when it is first
    /// asked for; `None` where there is none, see [`Distribution::reversed`].
    #[must_use]
    pub fn exchanged(&self, side: Side, way: Way) -> Option<&Distribution> {
        let made = &self.kept.exchanged[side as usize][way as usize];
        made.get_or_init(|| self.scattering(side, way)?.reversed()).as_ref()
    }

    /// Figures of energy and reciprocity, made when they are first asked for.
    #[must_use]
    pub fn analysis(&self) -> &BsdfAnalysis {
        self.kept.analysis.get_or_init(|| BsdfAnalysis::of(self))
    }

    /// What the file says besides.
    #[must_use]
    pub fn facts(&self) -> &BsdfFacts {
        &self.facts
    }

    /// All distributions, each with the side that light arrives on and the way it goes.
    pub fn distributions(&self) -> impl Iterator<Item = (Side, Way, &Distribution)> {
        let pairs = Side::ALL.into_iter().flat_map(|side| Way::ALL.map(|way| (side, way)));
        pairs.filter_map(|(side, way)| Some((side, way, self.scattering(side, way)?)))
    }

    /// Whether each distribution stays the same when incident and scattered direction turn together
    /// about the normal.
    #[must_use]
    pub fn is_isotropic(&self) -> bool {
        self.distributions().all(|(_, _, distribution)| distribution.is_isotropic())
    }

    /// Whether a distribution has colour channels that differ.
    #[must_use]
    pub fn is_coloured(&self) -> bool {
        self.distributions().any(|(_, _, distribution)| distribution.is_coloured())
    }
}
