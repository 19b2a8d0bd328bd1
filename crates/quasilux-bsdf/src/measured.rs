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
    kept: Box<Kept>,
}

/// What is made of tables once somebody asks.
#[derive(Clone, Debug, Default)]
struct Kept {
    /// Their directions exchanged, by the side and the way of the original.
    exchanged: [[OnceLock<Option<Distribution>>; 2]; 2],
    analysis: OnceLock<BsdfAnalysis>,
}

impl MeasuredBsdf {
    /// A surface of tables that a program made; the last one counts where several are for the same
    /// side and way.
    pub fn from_tables(
        facts: BsdfFacts,
        tables: impl IntoIterator<Item = (Side, ScatteringMode, Distribution)>,
    ) -> Self {
        let mut surface = Self::new(facts);
        tables.into_iter().for_each(|(side, way, table)| surface.set(side, way, table));
        surface
    }

    /// A surface that scatters nothing yet.
    #[must_use]
    pub fn new(facts: BsdfFacts) -> Self {
        Self { facts, scattering: ScatteringTables::default(), kept: Box::default() }
    }

    /// Takes over how light that arrives on `side` is scattered that way.
    pub fn set(&mut self, side: Side, way: ScatteringMode, distribution: Distribution) {
        self.scattering.set(side, way, distribution);
        self.kept.exchanged[side as usize][way as usize] = OnceLock::new();
        self.kept.analysis = OnceLock::new();
    }

    /// How light that arrives on `side` is scattered that way; `None` where nothing is.
    #[must_use]
    pub fn scattering(&self, side: Side, way: ScatteringMode) -> Option<&Distribution> {
        self.scattering.get(side, way)
    }

    /// The same for light that goes the other way round: arriving where that leaves, and leaving
    /// where it arrives. Made when it is first asked for; `None` where there is none, see
    /// [`Distribution::reversed`].
    #[must_use]
    pub fn exchanged(&self, side: Side, way: ScatteringMode) -> Option<&Distribution> {
        let made = &self.kept.exchanged[side as usize][way as usize];
        made.get_or_init(|| self.scattering(side, way)?.reversed()).as_ref()
    }

    /// Figures of energy and reciprocity, made when they are first asked for.
    #[must_use]
    pub fn analysis(&self) -> &BsdfAnalysis {
        self.kept.analysis.get_or_init(|| BsdfAnalysis::new(&self.scattering))
    }

    /// What the file says besides.
    #[must_use]
    pub fn facts(&self) -> &BsdfFacts {
        &self.facts
    }

    /// All distributions, each with the side that light arrives on and the way it goes.
    pub fn distributions(&self) -> impl Iterator<Item = (Side, ScatteringMode, &Distribution)> {
        let pairs =
            Side::ALL.into_iter().flat_map(|side| ScatteringMode::ALL.map(|way| (side, way)));
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
