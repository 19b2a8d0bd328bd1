//! On which ways suns shine on the surfaces of a scene, learnt from paths that do not count.

use crate::spectrum::Spectrum;
use crate::world::vertex::Vertex;
use std::collections::HashMap;

/// Weight of the counts of the whole scene against those of a side of a facet, in suns asked there.
const PRIOR: f64 = 32.0;

/// How a sun may shine on a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SunWay {
    /// On one side, past all openings: these need not be complete.
    Beside,
    /// On one side, through an opening.
    Through,
    /// On a sheet that lets light through to its other side.
    OnSheet,
}

/// Where a sun is asked for, and how it might shine there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SunPlace {
    pub(crate) way: SunWay,
    /// Which side of which facet.
    side: u32,
}

/// How often suns were found to shine, by way.
#[derive(Clone, Debug, Default)]
pub(crate) struct SunWays {
    of_side: HashMap<u32, [SunCounts; 3]>,
    of_all: [SunCounts; 3],
}

#[derive(Clone, Copy, Debug, Default)]
struct SunCounts {
    asked: u32,
    shining: u32,
}

impl SunPlace {
    /// `None` where no surface is.
    pub(crate) fn new<S: Spectrum>(way: SunWay, vertex: &Vertex<'_, S>) -> Option<Self> {
        vertex.facet_side().map(|side| Self { way, side })
    }
}

impl SunWays {
    /// Takes note of a sun that was asked for.
    pub(crate) fn note(&mut self, place: SunPlace, is_shining: bool) {
        let own = self.of_side.entry(place.side).or_default();
        for found in [own, &mut self.of_all].map(|ways| &mut ways[place.way as usize]) {
            found.add(SunCounts { asked: 1, shining: u32::from(is_shining) });
        }
    }

    /// Adds what others found.
    pub(crate) fn merge(mut self, other: Self) -> Self {
        let add = |own: &mut [SunCounts; 3], more: [SunCounts; 3]| {
            own.iter_mut().zip(more).for_each(|(own, more)| own.add(more));
        };
        for (side, more) in other.of_side {
            add(self.of_side.entry(side).or_default(), more);
        }
        add(&mut self.of_all, other.of_all);
        self
    }

    /// The share of the suns that are asked for there that shine.
    pub(crate) fn shining_share(&self, SunPlace { way, side }: SunPlace) -> f64 {
        let [asked, shining] = self.of_all[way as usize].counts();
        let prior = PRIOR * shining / asked.max(1.0);
        let own = self.of_side.get(&side).copied().unwrap_or_default();
        let [asked, shining] = own[way as usize].counts();
        (shining + prior) / (asked + PRIOR)
    }
}

impl SunCounts {
    fn add(&mut self, more: Self) {
        self.asked += more.asked;
        self.shining += more.shining;
    }

    fn counts(self) -> [f64; 2] {
        [self.asked, self.shining].map(f64::from)
    }
}
