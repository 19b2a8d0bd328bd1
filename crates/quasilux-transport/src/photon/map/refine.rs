//! Adaptive refinement of an illumination map: elements are split where the light varies within
//! them.
//!
//! Pilot photons, which are left out of all estimates, are counted in 16 equal parts of each
//! element. If the illuminance were what the reconstruction can follow, the sum of squared
//! deviations from it, over the mean count, would be chi-square distributed for independent
//! photons, and less for those of a quasi-random sequence. Elements where it is beyond chance are
//! split in four, those with the largest deviation in flux first if memory does not suffice for
//! all, and the next pilot photons, twice as many, look at the new ones. So elements with few
//! photons stay as they are.

use super::blocks::Blocks;
use super::layout::{MapLayout, MapPoint};
use super::tally::max_bounces;
use crate::context::{Context, Stream};
use crate::control::watch::Watch;
use crate::photon::batch::{PhotonBatch, trace_photons};
use crate::photon::counts::PhotonCounts;
use crate::photon::order::PhotonOrder;
use crate::photon::receiver::{PhotonReceiver, SeenPhoton};
use crate::photon::trace::{PhotonSetup, Source};
use crate::settings::{Reconstruction, Settings};
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::subdivision::{SubTriangle, locate_in_quarters};
use std::ops::Range;

/// Pilot photons of the first round; each further round has as many as all before it.
const FIRST_PHOTONS: u64 = 1 << 14;
const ROUNDS: u32 = 5;
/// Parts of an element that are counted.
const PARTS: usize = 16;
/// Fewer photons in an element say nothing about its parts.
const MIN_PHOTONS: u64 = 4 * PARTS as u64;
/// Elements that splits add, three each, where every pilot photon lands eight times.
pub(crate) const MAX_NEW_ELEMENTS: u64 = 3 * 8 * (FIRST_PHOTONS << (ROUNDS - 1)) / MIN_PHOTONS;

/// The layout that the settings ask for, refined by pilot photons if they ask for that; adds these
/// to `counts`.
pub(crate) fn refined<S: Spectrum>(
    context: &Context<'_, S>,
    settings: &Settings,
    watch: &mut Watch<'_>,
    counts: &mut PhotonCounts,
) -> MapLayout {
    let max_bounces = max_bounces(context);
    if !settings.map_adaptive || max_bounces == 0 {
        return MapLayout::new(&context.world, settings);
    }
    let mut layout = MapLayout::coarse(&context.world, settings);
    let mut indices = 0..FIRST_PHOTONS;
    for _ in 0..ROUNDS {
        let affordable = settings.map_elements.saturating_sub(layout.leaves() as u64) / 3;
        if affordable == 0 {
            break;
        }
        let parts = Blocks::new(layout.len() * PARTS);
        let pilot = Pilot { layout: &layout, parts: &parts, max_bounces };
        *counts += pilot.trace(context, indices.clone(), watch);
        let chosen = chosen(&layout, &parts, affordable as usize);
        if !chosen.is_empty() {
            layout = layout.split(|leaf| chosen.binary_search(&leaf).is_ok());
        }
        indices = indices.end..2 * indices.end;
    }
    layout
}

/// Counts pilot photons in the parts of elements.
#[derive(Clone, Copy)]
struct Pilot<'a> {
    layout: &'a MapLayout,
    parts: &'a Blocks,
    max_bounces: u32,
}

impl Pilot<'_> {
    fn trace<S: Spectrum>(
        self,
        context: &Context<'_, S>,
        indices: Range<u64>,
        watch: &mut Watch<'_>,
    ) -> PhotonCounts {
        let order = PhotonOrder::CoherentWaves;
        let batch = PhotonBatch {
            stream: Stream::MapPilots,
            replicates: 0..1,
            indices,
            order,
            setup: PhotonSetup::by_chance(Source::Lights, None),
        };
        // Before the first checkpoint the observer stops nothing, so there are always counts.
        trace_photons(context, &batch, |_| self, watch).unwrap_or_default()
    }
}

impl<S: Spectrum> PhotonReceiver<S> for Pilot<'_> {
    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let &SeenPhoton { bounces, specular_class, .. } = photon;
        // As on the map.
        if specular_class.is_none() && (1..=self.max_bounces).contains(&bounces) {
            let place = self.layout.locate(at);
            self.parts.add(PARTS * place.element + part(&place), 1);
        }
    }
}

/// The part of its element that holds a place.
fn part(place: &MapPoint) -> usize {
    let outer = locate_in_quarters(place.barycentric);
    4 * outer.number + locate_in_quarters(outer.weights).number
}

/// Barycentric weights of the centre of a part.
fn centre(part: usize) -> [f64; 3] {
    SubTriangle::WHOLE.quarters()[part / 4].quarters()[part % 4].point([1.0 / 3.0; 3])
}

/// Leaves to split, in their order.
fn chosen(layout: &MapLayout, parts: &Blocks, affordable: usize) -> Vec<usize> {
    let leaves = layout.leaves();
    let misfit = Misfit::new(layout.reconstruction());
    let deviation = |element: usize| {
        let counts: [u64; PARTS] = std::array::from_fn(|i| parts.get(PARTS * element + i));
        misfit.deviation(&counts)
    };
    let mut found: Vec<(f64, usize)> = (0..leaves)
        .filter_map(|leaf| {
            // Both sides are split alike.
            let sides = [leaf, leaves + leaf].map(deviation);
            let sum: f64 = sides.into_iter().flatten().sum();
            (sum > 0.0).then_some((sum, leaf))
        })
        .collect();
    if found.len() > affordable {
        found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        found.truncate(affordable);
    }
    let mut chosen: Vec<usize> = found.into_iter().map(|(_, leaf)| leaf).collect();
    chosen.sort_unstable();
    chosen
}

/// How badly a reconstruction follows the counts of the parts.
struct Misfit {
    /// For linear functions: centres of the parts, from the centre of all.
    centres: Option<[[f64; 3]; PARTS]>,
    /// Chi-square that is exceeded by chance once in a thousand elements.
    critical: f64,
    /// Mean of chi-square by chance: its degrees of freedom.
    freedom: f64,
}

impl Misfit {
    fn new(reconstruction: Reconstruction) -> Self {
        match reconstruction {
            Reconstruction::Constant => Self { centres: None, critical: 37.70, freedom: 15.0 },
            Reconstruction::Linear => {
                let centres = std::array::from_fn(|part| centre(part).map(|w| w - 1.0 / 3.0));
                Self { centres: Some(centres), critical: 34.53, freedom: 13.0 }
            }
        }
    }

    /// The sum of squared deviations in photons^2 beyond what chance makes of it, where that is
    /// significant.
    fn deviation(&self, counts: &[u64; PARTS]) -> Option<f64> {
        let all: u64 = counts.iter().sum();
        if all < MIN_PHOTONS {
            return None;
        }
        let mean = all as f64 / PARTS as f64;
        let mut rests = counts.map(|count| count as f64 - mean);
        if let Some(centres) = &self.centres {
            // The centred weights have the covariance a (delta - 1 / 3), so that their projections
            // are independent coefficients.
            let a: f64 = centres.iter().flatten().map(|x| x * x).sum::<f64>() / 2.0;
            let slopes: [f64; 3] = std::array::from_fn(|i| {
                rests.iter().zip(centres).map(|(rest, centre)| rest * centre[i]).sum::<f64>() / a
            });
            for (rest, centre) in rests.iter_mut().zip(centres) {
                *rest -= (0..3).map(|i| slopes[i] * centre[i]).sum::<f64>();
            }
        }
        let squares: f64 = rests.iter().map(|rest| rest * rest).sum();
        (squares > self.critical * mean).then_some(squares - self.freedom * mean)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photon::map::fixture::{Numbers, at, square};
    use crate::world::World;

    #[test]
    fn centres_lie_in_their_parts() {
        let (world, settings) = (square(), Settings::default());
        let layout = MapLayout::new(&world, &settings);
        let any = layout.locate(&at(&world, &mut Numbers(1)));
        for number in 0..PARTS {
            assert_eq!(part(&MapPoint { barycentric: centre(number), ..any }), number);
        }
    }

    /// Leaves of [`square`] chosen after independent photons on its front, accepted by a density
    /// along x that is at most 1.
    fn chosen_under(
        layout: &MapLayout,
        world: &World<f64>,
        density: impl Fn(f64) -> f64,
        affordable: usize,
    ) -> Vec<usize> {
        let (parts, numbers) = (Blocks::new(PARTS * layout.len()), &mut Numbers(7));
        for _ in 0..400_000 {
            let at = Interaction { front: true, ..at(world, numbers) };
            if numbers.next() < density(at.position.x) {
                let place = layout.locate(&at);
                parts.add(PARTS * place.element + part(&place), 1);
            }
        }
        chosen(layout, &parts, affordable)
    }

    /// Seed 7; each element is chosen by chance with a probability of 1e-3, so among 256 elements
    /// more than 4 are with one of 1e-5. A step to four times the light is found in most elements
    /// that it cuts.
    #[test]
    fn elements_are_split_at_an_edge_and_not_where_light_is_even() {
        let world = square();
        for map_reconstruction in [Reconstruction::Constant, Reconstruction::Linear] {
            let settings =
                Settings { map_reconstruction, map_element_m: Some(0.2), ..Settings::default() };
            let layout = MapLayout::new(&world, &settings);
            let even = chosen_under(&layout, &world, |_| 0.8, 1000);
            assert!(even.len() <= 4, "{even:?}");
            let large =
                MapLayout::new(&world, &Settings { map_element_m: Some(0.8), ..settings.clone() });
            let slope = chosen_under(&large, &world, |x| 0.1 + 0.45 * x, 1000);
            match map_reconstruction {
                Reconstruction::Constant => assert_eq!(slope.len(), large.leaves()),
                Reconstruction::Linear => assert!(slope.len() <= 2, "{slope:?}"),
            }
            let step = |x: f64| if x < 0.77 { 0.2 } else { 0.8 };
            let edge = chosen_under(&layout, &world, step, 1000);
            let numbers = &mut Numbers(9);
            let mut lies_near = vec![false; layout.leaves()];
            for _ in 0..100_000 {
                let at = Interaction { front: true, ..at(&world, numbers) };
                lies_near[layout.locate(&at).element] |= (at.position.x - 0.77).abs() < 0.01;
            }
            let found = edge.iter().filter(|&&leaf| lies_near[leaf]).count();
            let near = lies_near.iter().filter(|near| **near).count();
            assert!(edge.len() - found <= 4 && 2 * found > near, "{found} of {near}");
            assert_eq!(chosen_under(&layout, &world, step, 3).len(), 3);
        }
    }
}
