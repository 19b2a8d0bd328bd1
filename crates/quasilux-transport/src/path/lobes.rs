//! Test for missed lobes: whether enough paths met the bright part of narrow lobes under point-like
//! lights.
//!
//! A path that meets a glossy surface asks there for the light of a point-like light, and finds
//! nearly always that the lobe points elsewhere. The few that meet the place from where it points
//! to the light bring nearly all that there is: before they do, values are too low, and their
//! spread says nothing of it.
//!
//! How many have met it is foreseen from all paths that come to such surfaces. A direction that a
//! surface draws with the density p stands for a solid angle of about `1 / p`, the part `1 / k` of
//! a hemisphere, with `k = 2 pi p`: about 1 on Lambertian surfaces. Where directions are not drawn
//! as the surface scatters, k is what it gives to the mirror direction or straight on, over what a
//! Lambertian surface would. Toward a light at a distance b the lobe's bright place is smaller, as
//! seen from a distance a, than toward one far away, by `(b / (a + b))^2`. So of n paths about `n /
//! mean(k (a + b)^2 / b^2)` met it.

use crate::bsdf::{Bsdf, TransportMode};
use crate::codec::{Sums, add_count};
use crate::lights::{Incidence, PointLikes};
use crate::spectrum::Spectrum;
use crate::stats::tally::{Quantum, Sum};
use crate::world::Interaction;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_1_PI, PI, TAU};
use std::ops::AddAssign;

/// So many paths, of all replicates, must have been where a lobe is bright.
const MIN_MET: f64 = 32.0;
/// Lobes whose light, were it spread evenly, is less than this part of all do not matter.
const MATTERS: f64 = 1e-3;
/// No place counts as sharper than this, so that sums of many have room.
const SHARPEST: f64 = 1e9;

/// What one path met of lobes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Lobes {
    surfaces: u64,
    /// Of all of them, `k (a + b)^2 / b^2` rounded up.
    sharpness: u64,
    /// What they would give, in lx, were they Lambertian and nothing in the way.
    even_lx: f64,
}

/// A surface that a path met.
pub(crate) struct Met<'a> {
    pub(crate) at: &'a Interaction,
    /// Whether light from behind counts.
    pub(crate) transmits: bool,
    /// What a lux there counts where the path starts, were the surface Lambertian, times pi.
    pub(crate) goes_on: f64,
    /// See [`sharpness`].
    pub(crate) sharpness: f64,
}

/// The same of many paths.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct LobeSums {
    surfaces: u64,
    sharpness: u64,
    even: Sum,
}

impl Lobes {
    /// Surfaces so far that scatter into lobes.
    pub(crate) fn surfaces(&self) -> u64 {
        self.surfaces
    }

    /// Adds a surface that scatters into lobes.
    pub(crate) fn meet(&mut self, lights: &PointLikes<'_>, met: &Met<'_>) {
        let Met { at, transmits, goes_on, sharpness } = *met;
        let (mut all_lx, mut weighed) = (0.0, 0.0);
        for incidence in lights.unshadowed(at.position, at.n, transmits) {
            let Incidence { illuminance_lx: lx, distance_m, .. } = incidence;
            let turn = (at.distance_m + distance_m) / distance_m;
            all_lx += lx;
            weighed += lx * turn * turn;
        }
        if all_lx > 0.0 {
            let sharpness = 1.0 + (sharpness - 1.0).max(0.0) * weighed / all_lx;
            self.surfaces += 1;
            self.sharpness += sharpness.ceil().clamp(1.0, SHARPEST) as u64;
            self.even_lx += goes_on * FRAC_1_PI * all_lx;
        }
    }
}

/// k of the module, for a path that arrived along `-wo` and drew a direction with this density.
pub(crate) fn sharpness<S: Spectrum>(bsdf: &Bsdf<S>, wo: DVec3, front: bool, pdf_sr: f64) -> f64 {
    let albedo = bsdf.albedo(wo, front, TransportMode::Radiance).luminance();
    let over_lambert = |wi: DVec3| {
        let f_sr = bsdf.evaluate(wo, wi, front, TransportMode::Radiance).luminance();
        if f_sr > 0.0 { PI * f_sr / albedo } else { 0.0 }
    };
    let mirrored = DVec3::new(-wo.x, -wo.y, wo.z);
    over_lambert(mirrored).max(over_lambert(-wo)).max(TAU * pdf_sr)
}

impl LobeSums {
    /// Adds those of a path.
    pub(crate) fn add(&mut self, Lobes { surfaces, sharpness, even_lx }: Lobes, quantum: Quantum) {
        if surfaces > 0 {
            self.surfaces += surfaces;
            self.sharpness = self.sharpness.saturating_add(sharpness);
            self.even.add(even_lx, quantum);
        }
    }

    /// Whether the spread of a target that has this illuminance after so many paths says nothing of
    /// its error, for too few of them were where lobes are bright.
    pub(crate) fn are_missed(&self, quantum: Quantum, paths: u64, value_lx: f64) -> bool {
        let even_lx = quantum.value(self.even) / paths.max(1) as f64;
        let surfaces = self.surfaces as f64;
        let met = surfaces * surfaces / self.sharpness.max(1) as f64;
        self.surfaces > 0 && even_lx > MATTERS * value_lx && met < MIN_MET
    }
}

/// Warning about this number of sensor points.
pub(crate) fn warning(points: usize) -> Option<String> {
    (points > 0).then(|| {
        format!(
            "{points} sensor points get light of point-like lights over surfaces with lobes so \
             narrow that fewer than {MIN_MET} paths can have met where they are bright: much may \
             be missing, and values have no interval there"
        )
    })
}

impl AddAssign<&Self> for LobeSums {
    fn add_assign(&mut self, other: &Self) {
        self.surfaces += other.surfaces;
        self.sharpness = self.sharpness.saturating_add(other.sharpness);
        self.even += other.even;
    }
}

impl Sums for LobeSums {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        add_count(&mut self.surfaces, other.surfaces)?;
        add_count(&mut self.sharpness, other.sharpness)?;
        self.even.checked_add(&other.even)
    }
}
