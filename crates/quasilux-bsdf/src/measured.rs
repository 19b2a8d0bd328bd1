//! One measured surface: the scattering distributions of a thin sheet, with the facts of its file.

use crate::analysis::BsdfAnalysis;
use crate::distribution::Distribution;
use crate::facts::BsdfFacts;
use crate::side::ScatteringMode;
use crate::side::Side;
use crate::tables::ScatteringTables;
use std::sync::OnceLock;

/// One measured surface: how both sides of a thin sheet scatter light.
#[derive(Clone, Debug)]
pub struct MeasuredBsdf {
    facts: BsdfFacts,
    scattering: ScatteringTables,
    cache: Box<Cache>,
}

/// A distribution with the light that it is for.
#[derive(Clone, Copy, Debug)]
pub struct SheetDistribution<D = Distribution> {
    /// The side that light arrives on.
    pub side: Side,
    /// Whether the light is reflected or transmitted.
    pub mode: ScatteringMode,
    /// f in sr^-1.
    pub distribution: D,
}

/// Results that are computed from the tables when they are first asked for.
#[derive(Clone, Debug, Default)]
struct Cache {
    /// The adjoint distributions, by the side and the mode of the original.
    adjoint: [[OnceLock<Option<Distribution>>; 2]; 2],
    analysis: OnceLock<BsdfAnalysis>,
}

impl MeasuredBsdf {
    /// A surface of tables that a program made; the last one counts where several are for the same
    /// side and mode.
    pub fn from_tables(
        facts: BsdfFacts,
        tables: impl IntoIterator<Item = SheetDistribution>,
    ) -> Self {
        let mut surface = Self::new(facts);
        for SheetDistribution { side, mode, distribution } in tables {
            surface.set(side, mode, distribution);
        }
        surface
    }

    /// A surface that scatters nothing yet.
    #[must_use]
    pub fn new(facts: BsdfFacts) -> Self {
        Self { facts, scattering: ScatteringTables::default(), cache: Box::default() }
    }

    /// Sets how light that arrives on `side` is reflected or transmitted.
    pub fn set(&mut self, side: Side, mode: ScatteringMode, distribution: Distribution) {
        self.scattering.set(side, mode, distribution);
        self.cache.adjoint[side as usize][mode as usize] = OnceLock::new();
        self.cache.analysis = OnceLock::new();
    }

    /// How light that arrives on `side` is reflected or transmitted; `None` where none is.
    #[must_use]
    pub fn scattering(&self, side: Side, mode: ScatteringMode) -> Option<&Distribution> {
        self.scattering.get(side, mode)
    }

    /// The adjoint of [`Self::scattering`], for light that travels in reverse: it arrives where
    /// that leaves, and leaves where that arrives. Computed when it is first asked for; `None`
    /// where there is none, see [`Distribution::adjoint`].
    #[must_use]
    pub fn adjoint(&self, side: Side, mode: ScatteringMode) -> Option<&Distribution> {
        let made = &self.cache.adjoint[side as usize][mode as usize];
        made.get_or_init(|| self.scattering(side, mode)?.adjoint()).as_ref()
    }

    /// Figures of energy and reciprocity, made when they are first asked for.
    #[must_use]
    pub fn analysis(&self) -> &BsdfAnalysis {
        self.cache.analysis.get_or_init(|| BsdfAnalysis::new(&self.scattering))
    }

    /// What the file says besides.
    #[must_use]
    pub fn facts(&self) -> &BsdfFacts {
        &self.facts
    }

    /// All distributions, first those of light on the front.
    pub fn distributions(&self) -> impl Iterator<Item = SheetDistribution<&Distribution>> {
        Side::ALL.into_iter().flat_map(move |side| {
            ScatteringMode::ALL.into_iter().filter_map(move |mode| {
                let distribution = self.scattering(side, mode)?;
                Some(SheetDistribution { side, mode, distribution })
            })
        })
    }

    /// Whether each distribution stays the same when incident and scattered direction turn together
    /// about the normal.
    #[must_use]
    pub fn is_isotropic(&self) -> bool {
        self.distributions().all(|entry| entry.distribution.is_isotropic())
    }

    /// Whether a distribution has colour channels that differ.
    #[must_use]
    pub fn is_coloured(&self) -> bool {
        self.distributions().any(|entry| entry.distribution.is_coloured())
    }
}
