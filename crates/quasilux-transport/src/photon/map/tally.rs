//! Tally of photons by map element, and the illuminance that follows from it.

use super::blocks::Blocks;
use super::layout::{MapLayout, MapPoint};
use crate::codec::{Reader, StateError, Stored, Writer};
use crate::context::Context;
use crate::photon::receiver::{PhotonReceiver, SeenPhoton};
use crate::settings::Reconstruction;
use crate::spectrum::Spectrum;
use crate::stats::tally::checked_quanta;
use crate::world::Interaction;
use quasilux_sampling::Sampler;
use std::marker::PhantomData;
use std::ops::Range;
use std::sync::OnceLock;

/// Quanta of a photon: 2^44 photons fit a counter.
pub(crate) const QUANTA_PER_PHOTON: f64 = (1 << 20) as f64;

/// The photons counted by each element, writable by all threads, in layers by the number of their
/// bounces. Elements where nothing lands take next to no memory; others take 4 bytes for each
/// moment and channel in each layer that counts something there.
pub(crate) struct MapTally<S> {
    /// The first is for photons that bounced once, the last for all that bounced as often as there
    /// are layers or more. A layer is allocated with its first photon.
    layers: Vec<OnceLock<Blocks>>,
    /// Counters of a layer.
    counters: usize,
    reconstruction: Reconstruction,
    quanta_per_photon: f64,
    channels: PhantomData<S>,
}

/// The illuminance that a tally stands for when each photon carries a certain flux.
#[derive(Clone, Copy)]
pub(crate) struct IlluminationMap<'m, S> {
    tally: &'m MapTally<S>,
    lm_per_quantum: f64,
}

/// Illuminance by photons with one number of bounces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BounceTerm<S> {
    pub(crate) bounces: u32,
    pub(crate) illuminance_lx: S,
}

/// Counts landings of photons that the backward path does not count itself.
#[derive(Clone, Copy)]
pub(crate) struct MapReceiver<'a, S> {
    layout: &'a MapLayout,
    tally: &'a MapTally<S>,
    /// Photons with more bounces are left out: their light bounces once more before a sensor.
    max_bounces: u32,
    /// So are photons that took more coordinates.
    max_dimensions: u32,
    /// Whether that which it sees did.
    is_deep: bool,
    /// Moments that the tally refused.
    invalid: u64,
}

impl<S: Spectrum> MapTally<S> {
    /// For photons that weigh `lightest` or more, a power of two, in one or more `layers`.
    pub(crate) fn new(layout: &MapLayout, lightest: f64, layers: u32) -> Self {
        let reconstruction = layout.reconstruction();
        Self {
            layers: (0..layers).map(|_| OnceLock::new()).collect(),
            counters: layout.len() * reconstruction.moments() * S::CHANNELS,
            reconstruction,
            quanta_per_photon: QUANTA_PER_PHOTON / lightest,
            channels: PhantomData,
        }
    }

    /// Counts a photon of one bounce or more, and returns the number of its moments that were
    /// refused.
    pub(crate) fn add(&self, place: &MapPoint, weight: S, bounces: u32) -> u64 {
        let layer = &self.layers[(bounces as usize).min(self.layers.len()) - 1];
        let sums = layer.get_or_init(|| Blocks::new(self.counters));
        let first = self.first(place);
        let mut refused = 0;
        match self.reconstruction {
            Reconstruction::Constant => {
                for channel in 0..S::CHANNELS {
                    refused += self.count(sums, first + channel, weight.channel(channel));
                }
            }
            Reconstruction::Linear => {
                // By rounding, a place on an edge may lie outside by a little.
                let shares = place.barycentric.map(|share| if share < 0.0 { 0.0 } else { share });
                for channel in 0..S::CHANNELS {
                    for (corner, share) in shares.into_iter().enumerate() {
                        let moment = weight.channel(channel) * share;
                        refused += self.count(sums, first + 3 * channel + corner, moment);
                    }
                }
            }
        }
        refused
    }

    /// The map at this moment, while no photons fly; one photon carries `flux_lm`.
    pub(crate) fn read(&self, flux_lm: f64) -> IlluminationMap<'_, S> {
        IlluminationMap { tally: self, lm_per_quantum: flux_lm / self.quanta_per_photon }
    }

    /// Adds to a counter; 1 where the moment was refused.
    #[inline]
    fn count(&self, sums: &Blocks, counter: usize, photons: f64) -> u64 {
        match checked_quanta(photons, self.quanta_per_photon) {
            Some(quanta) => {
                sums.add(counter, quanta.cast_unsigned());
                0
            }
            None => 1,
        }
    }

    /// A counter, summed over layers.
    fn quanta(&self, layers: Range<usize>, counter: usize) -> u64 {
        self.layers[layers].iter().filter_map(OnceLock::get).map(|sums| sums.get(counter)).sum()
    }

    fn first(&self, place: &MapPoint) -> usize {
        place.element * self.reconstruction.moments() * S::CHANNELS
    }
}

impl<S> Stored for MapTally<S> {
    fn put(&self, out: &mut Writer) {
        let used =
            || (0_u32..).zip(&self.layers).filter_map(|(at, layer)| Some((at, layer.get()?)));
        out.value(&used().count());
        used().for_each(|(number, sums)| {
            out.value(&number);
            sums.put(out);
        });
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        for _ in 0..from.value::<usize>()? {
            let layer = self.layers.get_mut(from.value::<u32>()? as usize);
            let layer = layer.ok_or(StateError::Unfit("an illumination map"))?;
            layer.get_or_init(|| Blocks::new(self.counters));
            layer.get_mut().map_or(Ok(()), |sums| sums.merge_from(from))?;
        }
        Ok(())
    }
}

impl<S: Spectrum> IlluminationMap<'_, S> {
    /// Illuminance in lx at a place. Linear ones may be negative in places.
    pub(crate) fn illuminance_lx(&self, place: &MapPoint) -> S {
        self.of_layers_lx(place, 0..self.tally.layers.len())
    }

    /// Its terms by the number of bounces of the photons, the last of as many as layers and more.
    /// Of photons with at most `max_bounces`.
    pub(crate) fn terms_lx(
        &self,
        place: MapPoint,
        max_bounces: u32,
    ) -> impl Iterator<Item = BounceTerm<S>> {
        let layers = self.tally.layers.len().min(max_bounces as usize);
        (0..layers).map(move |layer| BounceTerm {
            bounces: layer as u32 + 1,
            illuminance_lx: self.of_layers_lx(&place, layer..layer + 1),
        })
    }

    /// Quanta are added before all else: their sum has the bits of one layer for all.
    fn of_layers_lx(&self, place: &MapPoint, layers: Range<usize>) -> S {
        let MapTally { reconstruction, .. } = self.tally;
        let first = self.tally.first(place);
        let sum = |number: usize| self.tally.quanta(layers.clone(), first + number) as f64;
        let lx_per_quantum = self.lm_per_quantum / place.area_m2;
        S::from_channels(|channel| {
            let quanta = match reconstruction {
                Reconstruction::Constant => sum(channel),
                // The kernel summed over photons: it is linear in their weights.
                Reconstruction::Linear => (0..3)
                    .map(|corner| {
                        (12.0 * place.barycentric[corner] - 3.0) * sum(3 * channel + corner)
                    })
                    .sum(),
            };
            quanta * lx_per_quantum
        })
    }
}

impl<'a, S: Spectrum> MapReceiver<'a, S> {
    pub(crate) fn new(
        context: &Context<'_, S>,
        layout: &'a MapLayout,
        tally: &'a MapTally<S>,
    ) -> Self {
        Self::up_to(max_bounces(context), context.map_dimensions, layout, tally)
    }

    /// Leaves out photons with more bounces than these, and landings after more coordinates.
    pub(crate) fn up_to(
        max_bounces: u32,
        max_dimensions: Option<u32>,
        layout: &'a MapLayout,
        tally: &'a MapTally<S>,
    ) -> Self {
        let max_dimensions = max_dimensions.unwrap_or(u32::MAX);
        Self { layout, tally, max_bounces, max_dimensions, is_deep: false, invalid: 0 }
    }
}

/// Bounces of the photons whose light may come to a sensor after one more.
pub(super) fn max_bounces<S>(context: &Context<'_, S>) -> u32 {
    context.max_bounces.map_or(u32::MAX, |most| most.saturating_sub(1))
}

impl<S: Spectrum> PhotonReceiver<S> for MapReceiver<'_, S> {
    fn follow(&mut self, sampler: &Sampler<'_>) {
        self.is_deep = sampler.dimension() > self.max_dimensions;
    }

    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, bounces, specular_class } = photon;
        // Light straight from the lights is never read from the map; paths count light that images
        // show, and caustics are added beside the map.
        let is_counted = !self.is_deep && specular_class.is_none();
        if is_counted && (1..=self.max_bounces).contains(&bounces) {
            self.invalid += self.tally.add(&self.layout.locate(at), weight, bounces);
        }
    }

    fn finish(self) -> u64 {
        self.invalid
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photon::map::fixture::{Numbers, at, square};
    use crate::settings::Settings;
    use quasilux_scene::Rgb;

    /// Photons at the three places of a rule that is exact for quadratic functions, as many as a
    /// linear function says: its projection is that function, or its mean.
    #[test]
    fn linear_illumination_is_projected_exactly() {
        let (world, numbers) = (square(), &mut Numbers(3));
        let function = |[a, b, c]: [f64; 3]| 5.0 * a + 0.25 * b + 2.0 * c;
        for map_reconstruction in [Reconstruction::Constant, Reconstruction::Linear] {
            let settings = Settings { map_reconstruction, ..Settings::default() };
            let layout = MapLayout::new(&world, &settings);
            for _ in 0..100 {
                let tally = MapTally::<f64>::new(&layout, 1.0, 3);
                let place = layout.locate(&at(&world, numbers));
                let gauss = |corner| {
                    std::array::from_fn(|i| [1.0 / 6.0, 2.0 / 3.0][usize::from(i == corner)])
                };
                for (barycentric, bounces) in [0, 1, 2].map(gauss).into_iter().zip([1, 3, 7]) {
                    tally.add(&MapPoint { barycentric, ..place }, function(barycentric), bounces);
                }
                let map = tally.read(place.area_m2 / 3.0);
                let found = map.illuminance_lx(&place);
                let wanted = match map_reconstruction {
                    Reconstruction::Constant => function([1.0 / 3.0; 3]),
                    Reconstruction::Linear => function(place.barycentric),
                };
                assert!((found - wanted).abs() < 2e-5, "{found}, wanted {wanted}");
                let terms: Vec<_> = map.terms_lx(place, u32::MAX).collect();
                assert!(terms.iter().map(|term| term.bounces).eq(1..=3));
                let [a, b, c] = [0, 1, 2].map(|layer: usize| terms[layer].illuminance_lx);
                assert!(b == 0.0 && (a + c - found).abs() < 1e-12);
                assert_eq!(map.terms_lx(place, 1).count(), 1);
            }
        }
    }

    /// Invalid photons: each moment is refused by itself, and nothing is added for it. A place that
    /// lies outside its element by rounding is counted.
    #[test]
    fn invalid_photons_are_refused_and_counted() {
        let (world, numbers) = (square(), &mut Numbers(11));
        for (map_reconstruction, moments) in
            [(Reconstruction::Constant, 1), (Reconstruction::Linear, 3)]
        {
            let settings = Settings { map_reconstruction, ..Settings::default() };
            let layout = MapLayout::new(&world, &settings);
            let tally = MapTally::<f64>::new(&layout, 1.0, 1);
            let place = layout.locate(&at(&world, numbers));
            for weight in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 1e300] {
                assert_eq!(tally.add(&place, weight, 1), moments, "{weight}");
            }
            let found = tally.read(1.0).illuminance_lx(&place);
            assert_eq!(found, 0.0, "{map_reconstruction:?}");
            let outside = MapPoint { barycentric: [-1e-5, 0.5, 0.5 + 1e-5], ..place };
            assert_eq!(tally.add(&outside, 1.0, 1), 0);
            let coloured = MapTally::<Rgb>::new(&layout, 1.0, 1);
            assert_eq!(coloured.add(&place, Rgb([1.0, -0.5, f64::NAN]), 1), 2 * moments);
        }
    }
}
