//! The illumination map: elements on the diffuse facets that count photons.
//!
//! Each triangle is cut into n^2 equal triangles, n from its longest edge, so no parametrisation is
//! needed and no element crosses an edge; the two sides of a facet are kept apart. An element's
//! illuminance is `E = m flux / area`, m photons of equal flux (Voloboy, Dmitriev and Kopylov 2003).

use crate::photon::{Flight, PhotonReceiver};
use crate::spectrum::Spectrum;
use crate::stage::Stage;
use crate::world::{Facet, Interaction, World};
use std::marker::PhantomData;
use std::sync::atomic::{AtomicI64, Ordering};

/// Elements a metre of scene size get where nothing is asked for.
const ELEMENTS_ACROSS: f64 = 64.0;
/// More elements than this make the elements larger, both sides counted once.
const MOST_ELEMENTS: u64 = 1 << 22;
/// Photons are counted in so many quanta each: 2^39 photons fit a counter.
pub(crate) const QUANTA_PER_PHOTON: f64 = (1 << 24) as f64;

/// Which element a place belongs to.
pub(crate) struct MapLayout {
    facets: Vec<Subdivision>,
    elements: usize,
}

#[derive(Clone, Copy)]
struct Subdivision {
    /// Number of the facet's first element.
    first: u32,
    /// Parts along each edge; 0 where nothing is counted.
    parts: u32,
    element_area_m2: f64,
}

/// The photons counted by each element, readable and writable by all threads.
pub(crate) struct MapTally<S> {
    counts: Vec<AtomicI64>,
    channels: PhantomData<S>,
}

/// Illuminance by element, in lx.
pub(crate) struct IlluminationMap<S> {
    illuminance_lx: Vec<S>,
}

/// Counts landings of photons that the backward path does not count itself.
#[derive(Clone, Copy)]
pub(crate) struct MapReceiver<'a, S> {
    layout: &'a MapLayout,
    tally: &'a MapTally<S>,
    /// Photons with more bounces are left out: their light bounces once more before a sensor.
    most_bounces: u32,
}

impl<'a, S: Spectrum> MapReceiver<'a, S> {
    pub(crate) fn new(stage: &Stage<'_, S>, layout: &'a MapLayout, tally: &'a MapTally<S>) -> Self {
        let most_bounces = stage.max_bounces.map_or(u32::MAX, |most| most.saturating_sub(1));
        Self { layout, tally, most_bounces }
    }
}

impl MapLayout {
    /// Elements no longer than `element_m` (by default a share of the scene's size) as far as
    /// memory allows.
    pub(crate) fn new<S: Spectrum>(world: &World<S>, element_m: Option<f64>) -> Self {
        let mut element_m = element_m.unwrap_or(world.size_m() / ELEMENTS_ACROSS);
        let parts = |facet: &Facet, element_m: f64| {
            let counts = world.bsdf_of(facet).keeps_illuminance();
            let parts = (facet.longest_edge_m() / element_m).ceil().clamp(1.0, 65535.0);
            if counts { parts } else { 0.0 }
        };
        let total = |element_m: f64| -> f64 {
            world.facets.iter().map(|facet| parts(facet, element_m)).map(|n| n * n).sum()
        };
        let most = (MOST_ELEMENTS.max(world.facets.len() as u64)) as f64;
        while total(element_m) > most {
            element_m *= 1.25;
        }
        let mut elements = 0;
        let facets = world
            .facets
            .iter()
            .map(|facet| {
                let n = parts(facet, element_m);
                let first = elements as u32;
                elements += (n * n) as usize;
                Subdivision { first, parts: n as u32, element_area_m2: facet.area_m2() / (n * n) }
            })
            .collect();
        Self { facets, elements }
    }

    /// Number of elements, each side of a facet counted.
    pub(crate) fn len(&self) -> usize {
        2 * self.elements
    }

    /// The element under a place, on the side that was hit.
    pub(crate) fn element(&self, at: &Interaction) -> usize {
        let facet = self.facets[at.facet as usize];
        2 * (facet.first as usize + facet.element(at.barycentric)) + usize::from(at.front)
    }

    /// The area of the element under a place, in m^2.
    pub(crate) fn element_area_m2(&self, at: &Interaction) -> f64 {
        self.facets[at.facet as usize].element_area_m2
    }

    /// Areas of all elements in their order.
    fn areas_m2(&self) -> impl Iterator<Item = f64> {
        self.facets.iter().flat_map(|facet| {
            let sides = 2 * facet.parts as usize * facet.parts as usize;
            std::iter::repeat_n(facet.element_area_m2, sides)
        })
    }
}

impl Subdivision {
    /// The small triangle at these weights. Rows run along the first corner's weight; in a row,
    /// triangles that stand and triangles that hang take turns.
    fn element(self, [_, b, c]: [f64; 3]) -> usize {
        let n = self.parts;
        let scale = f64::from(n);
        let row = ((b * scale) as u32).min(n - 1);
        let column = ((c * scale) as u32).min(n - 1 - row);
        let rests = (b * scale - f64::from(row)) + (c * scale - f64::from(column));
        let hangs = u32::from(rests > 1.0 && row + column + 1 < n);
        (row * (2 * n - row) + 2 * column + hangs) as usize
    }
}

impl<S: Spectrum> MapTally<S> {
    pub(crate) fn new(layout: &MapLayout) -> Self {
        let counts = (0..layout.len() * S::CHANNELS).map(|_| AtomicI64::new(0)).collect();
        Self { counts, channels: PhantomData }
    }

    fn add(&self, element: usize, weight: S) {
        for channel in 0..S::CHANNELS {
            let quanta = (weight.channel(channel) * QUANTA_PER_PHOTON).round_ties_even() as i64;
            self.counts[element * S::CHANNELS + channel].fetch_add(quanta, Ordering::Relaxed);
        }
    }

    /// The map at this moment; one photon carries `flux_lm`.
    pub(crate) fn read(&self, layout: &MapLayout, flux_lm: f64) -> IlluminationMap<S> {
        let per_quantum = flux_lm / QUANTA_PER_PHOTON;
        let illuminance_lx = self
            .counts
            .chunks_exact(S::CHANNELS)
            .zip(layout.areas_m2())
            .map(|(counts, area_m2)| {
                S::from_channels(|c| {
                    counts[c].load(Ordering::Relaxed) as f64 * (per_quantum / area_m2)
                })
            })
            .collect();
        IlluminationMap { illuminance_lx }
    }
}

impl<S: Spectrum> IlluminationMap<S> {
    /// Illuminance in lx at an element.
    pub(crate) fn illuminance_lx(&self, element: usize) -> S {
        self.illuminance_lx[element]
    }
}

impl<S: Spectrum> PhotonReceiver<S> for MapReceiver<'_, S> {
    fn flight(&mut self, _flight: &Flight, _weight: S, _bounces: u32) {}

    fn landing(&mut self, at: &Interaction, weight: S, bounces: u32) {
        // Light straight from the lights is never read from the map.
        if (1..=self.most_bounces).contains(&bounces) {
            self.tally.add(self.layout.element(at), weight);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every small triangle's centre belongs to it alone: numbers come once each, in order.
    #[test]
    fn elements_are_numbered_once_each() {
        for parts in [1, 2, 3, 7, 64] {
            let facet = Subdivision { first: 0, parts, element_area_m2: 1.0 };
            let n = f64::from(parts);
            let mut numbers = Vec::new();
            for row in 0..parts {
                for column in 0..parts - row {
                    let corner = |d: f64| {
                        let (b, c) = ((f64::from(row) + d) / n, (f64::from(column) + d) / n);
                        facet.element([1.0 - b - c, b, c])
                    };
                    numbers.push(corner(1.0 / 3.0));
                    if row + column + 1 < parts {
                        numbers.push(corner(2.0 / 3.0));
                    }
                }
            }
            assert!(
                numbers.iter().copied().eq(0..(parts * parts) as usize),
                "{parts}: {numbers:?}"
            );
        }
    }

    #[test]
    fn borders_stay_inside() {
        let facet = Subdivision { first: 0, parts: 5, element_area_m2: 1.0 };
        for weights in [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [0., 0.5, 0.5], [0., 0.4, 0.6]] {
            assert!(facet.element(weights) < 25);
        }
    }
}
