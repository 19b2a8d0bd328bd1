//! What coordinates are for, as the code that draws them says it.

use quasilux_sampling::Sampler;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// A decision that coordinates feed. Surfaces count from 1 along the way of a photon or path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Purpose {
    /// Light of a photon, and its direction; its place where the light is an area.
    Emission,
    /// The rest of the emission from an area: the direction, or the place.
    EmissionOfArea,
    /// Where a path starts in its cell.
    Cell,
    /// The direction in which a path leaves its sensor.
    FirstDirection,
    /// The place on an area light that is asked for light, from a surface or the sensor (0).
    AreaLight {
        /// The surface.
        surface: u32,
    },
    /// The image of an area light that is asked, and the place on it, from a surface or the sensor
    /// (0).
    AreaLightImage {
        /// The surface.
        surface: u32,
    },
    /// The luminaire with an area that is asked, and the place on it, from a surface or the sensor
    /// (0).
    AreaLuminaire {
        /// The surface.
        surface: u32,
    },
    /// The opening that light from outside is asked through, and the place in it, from a surface or
    /// the sensor (0).
    Opening {
        /// The surface.
        surface: u32,
    },
    /// The place on the sun's disk that is asked, from a surface or the sensor (0).
    Sun {
        /// The surface.
        surface: u32,
    },
    /// The light without an area that is asked.
    PointLike {
        /// The surface.
        surface: u32,
    },
    /// The images in mirrors that are asked, from a surface or the sensor (0).
    Image {
        /// The surface.
        surface: u32,
    },
    /// Whether light goes on from a surface, how and in which direction.
    Bounce {
        /// The surface.
        surface: u32,
    },
}

/// A dimension and what it was drawn for, ordered by dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct DimensionUse {
    pub(crate) dimension: u32,
    pub(crate) purpose: Purpose,
}

/// Which dimensions were drawn for what, how often.
#[derive(Debug, Default)]
pub(crate) struct Ledger {
    open: AtomicBool,
    uses: Mutex<BTreeMap<DimensionUse, u64>>,
}

impl Ledger {
    /// Whether what follows is noted; nothing is at first.
    pub(crate) fn set_open(&self, open: bool) {
        self.open.store(open, Ordering::Relaxed);
    }

    /// Notes that dimensions from `first` on, up to where the sampler is now, were drawn. Those of
    /// a split sample's children are their own, and are left out.
    pub(crate) fn note(&self, first: u32, sampler: &Sampler<'_>, purpose: Purpose) {
        let drew = first != sampler.dimension() && !sampler.is_branch();
        if !drew || !self.open.load(Ordering::Relaxed) {
            return;
        }
        let mut uses = self.uses.lock().unwrap_or_else(PoisonError::into_inner);
        for dimension in first..sampler.dimension() {
            *uses.entry(DimensionUse { dimension, purpose }).or_default() += 1;
        }
    }

    /// All that was noted, by dimension; forgets it.
    pub(crate) fn take(&self) -> BTreeMap<DimensionUse, u64> {
        std::mem::take(&mut self.uses.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Draws coordinates, and records what for where that is to be explained.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PurposeRecorder<'a> {
    ledger: Option<&'a Ledger>,
}

impl<'a> PurposeRecorder<'a> {
    /// Records in this ledger.
    pub(crate) fn recording(ledger: &'a Ledger) -> Self {
        Self { ledger: Some(ledger) }
    }

    /// Draws coordinates for a purpose.
    #[inline]
    pub(crate) fn draw<'p, T>(
        self,
        sampler: &mut Sampler<'p>,
        purpose: Purpose,
        draw: impl FnOnce(&mut Sampler<'p>) -> T,
    ) -> T {
        let first = sampler.dimension();
        let drawn = draw(sampler);
        if let Some(ledger) = self.ledger {
            ledger.note(first, sampler, purpose);
        }
        drawn
    }
}

impl fmt::Display for Purpose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, surface) = match *self {
            Self::Emission => return f.write_str("light, and direction or place on it"),
            Self::EmissionOfArea => return f.write_str("direction from, or place on, an area"),
            Self::Cell => return f.write_str("place in the cell"),
            Self::FirstDirection => return f.write_str("direction from the sensor"),
            Self::AreaLight { surface } => ("place on an area light", surface),
            Self::AreaLightImage { surface } => ("image of an area light and place on it", surface),
            Self::AreaLuminaire { surface } => ("luminaire and place on it", surface),
            Self::Opening { surface } => ("opening and place in it", surface),
            Self::Sun { surface } => ("place on the sun", surface),
            Self::PointLike { surface } => ("choice of a light", surface),
            Self::Image { surface } => ("choice of images in mirrors", surface),
            Self::Bounce { surface } => ("survival and direction", surface),
        };
        match surface {
            0 => write!(f, "{what}, for the sensor"),
            surface => write!(f, "{what}, at surface {surface}"),
        }
    }
}
