//! Elements split where the light varies within them.
//!
//! Pilot photons, which are left out of all estimates, are counted in 16 equal parts of each element.
//! If the illuminance were what the reconstruction can follow, the sum of squared deviations from it,
//! over the mean count, would be chi-square distributed for independent photons, and less for those
//! of a quasi-random sequence. Elements where it is beyond chance are split in four, those with the
//! largest deviation in flux first if memory does not suffice for all, and the next pilot photons, twice as
//! many, look at the new ones. So elements with few photons stay as they are.

use super::blocks::Blocks;
use super::layout::{MapLayout, Place};
use super::reconstruction::Reconstruction;
use super::subdivision::split;
use super::tally::most_bounces;
use crate::photon::{Flight, PhotonCounts, PhotonReceiver};
use crate::photons::{PhotonBatch, trace_photons};
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stage::{Stage, Stream};
use crate::trial::Way;
use crate::watch::Watch;
use crate::world::Interaction;
use std::ops::Range;

/// Pilot photons of the first round; each further round has as many as all before it.
const FIRST_PHOTONS: u64 = 1 << 14;
const ROUNDS: u32 = 5;
/// Parts of an element that are counted.
const PARTS: usize = 16;
/// Fewer photons in an element say nothing about its parts.
const LEAST_PHOTONS: u64 = 4 * PARTS as u64;

/// The layout that the settings ask for, refined by pilot photons if they ask for that, and what
/// these cost.
pub(crate) fn refined<S: Spectrum>(
    stage: &Stage<'_, S>,
    settings: &Settings,
    watch: &mut Watch<'_>,
) -> (MapLayout, PhotonCounts) {
    let mut layout = MapLayout::new(&stage.world, settings);
    let mut counts = PhotonCounts::default();
    let most_bounces = most_bounces(stage);
    if !settings.map_adaptive || most_bounces == 0 {
        return (layout, counts);
    }
    let mut indices = 0..FIRST_PHOTONS;
    for _ in 0..ROUNDS {
        let affordable = settings.map_elements.saturating_sub(layout.leaves() as u64) / 3;
        if affordable == 0 {
            break;
        }
        let parts = Blocks::new(layout.len() * PARTS);
        let pilot = Pilot { layout: &layout, parts: &parts, most_bounces };
        counts += pilot.trace(stage, indices.clone(), watch);
        let chosen = chosen(&layout, &parts, affordable as usize);
        if chosen.is_empty() {
            break;
        }
        layout = layout.split(|leaf| chosen.binary_search(&leaf).is_ok());
        indices = indices.end..2 * indices.end;
    }
    (layout, counts)
}

/// Counts pilot photons in the parts of elements.
#[derive(Clone, Copy)]
struct Pilot<'a> {
    layout: &'a MapLayout,
    parts: &'a Blocks,
    most_bounces: u32,
}

impl Pilot<'_> {
    fn trace<S: Spectrum>(
        self,
        stage: &Stage<'_, S>,
        indices: Range<u64>,
        watch: &mut Watch<'_>,
    ) -> PhotonCounts {
        let way = Way::CoherentWaves;
        let batch = PhotonBatch { stream: Stream::PlanPhotons, replicates: 0..1, indices, way };
        // Before the first checkpoint the observer stops nothing, so there are always counts.
        trace_photons(stage, &batch, |_| self, watch).unwrap_or_default()
    }
}

impl<S: Spectrum> PhotonReceiver<S> for Pilot<'_> {
    fn flight(&mut self, _flight: &Flight, _weight: S, _bounces: u32) {}

    fn landing(&mut self, at: &Interaction, _weight: S, bounces: u32) {
        if (1..=self.most_bounces).contains(&bounces) {
            let place = self.layout.locate(at);
            self.parts.add(PARTS * place.element + part(&place), 1);
        }
    }
}

/// The part of its element that holds a place.
fn part(place: &Place) -> usize {
    let outer = split(place.barycentric);
    4 * outer.number + split(outer.weights).number
}

/// Barycentric weights of the centre of a part.
fn centre(part: usize) -> [f64; 3] {
    let parent = |child: usize, weights: [f64; 3]| match child {
        3 => weights.map(|weight| 0.5 - 0.5 * weight),
        corner => std::array::from_fn(|i| 0.5 * (weights[i] + f64::from(u8::from(i == corner)))),
    };
    parent(part / 4, parent(part % 4, [1.0 / 3.0; 3]))
}

/// Leaves worth splitting, in their order.
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
    /// What chi-square exceeds by chance once in a thousand elements.
    critical: f64,
    /// What it is by chance on average.
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
        if all < LEAST_PHOTONS {
            return None;
        }
        let mean = all as f64 / PARTS as f64;
        let mut rests = counts.map(|count| count as f64 - mean);
        if let Some(centres) = &self.centres {
            // The centred weights have the covariance a (delta - 1 / 3), so that their projections are
            // independent coefficients.
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
