//! Partition of the light at the first surface of a path between paths and connected photons.
//!
//! Where photons are connected to sensors, light that comes to a sensor by a first surface at y is
//! found by both. The part that is left to the path depends on nothing but the densities at y, in
//! m^-2, of the paths' first hits, `p`, and of the photons' landings, `n q`:
//!
//! ```text
//! light that comes straight from lights to y:  w = p / (p + n q)         (balance heuristic)
//! all other light:                             w = max(0, 1 - k n q / p) (clamped photons)
//! ```
//!
//! The first is the balance heuristic of E. Veach and L. Guibas, SIGGRAPH 1995, with marginal
//! densities; the second the compensation of clamped virtual point lights by T. Kollig and A.
//! Keller, Monte Carlo and Quasi-Monte Carlo Methods 2004, Springer 2006. `estimator/connection/`
//! has the photons' side of it.

use crate::importance::{Density, Landings};
use glam::DVec3;

/// k: paths take over where a photon would count this many times its average contribution.
const CLAMP: f64 = 3.0;

/// What of the light at first surfaces paths leave to connected photons.
pub(crate) struct Partition {
    /// Densities of landings to expect.
    pub(crate) landings: Landings,
    /// Photons for each path of a sensor.
    pub(crate) photons: u64,
    /// Whether weight windows guide the photons: then paths hardly ever find the light.
    pub(crate) is_guided: bool,
}

/// Weights in [0, 1] of what paths find of the light that comes to a sensor by one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PartitionWeights {
    /// Of what comes there straight from the lights.
    pub(crate) first: f64,
    /// Of all other light.
    pub(crate) rest: f64,
}

impl PartitionWeights {
    /// Paths find everything.
    pub(crate) const ALL: Self = Self { first: 1.0, rest: 1.0 };
}

impl Partition {
    /// The expected density of landings on the side `n` of a surface.
    pub(crate) fn density(&self, position: DVec3, n: DVec3) -> Density {
        self.landings.density(&self.landings.around(position, n))
    }

    /// The weights of paths whose first hits have the density `pdf_m2`, in m^-2, where landings
    /// have this one.
    pub(crate) fn path_weights(&self, pdf_m2: f64, density: Density) -> PartitionWeights {
        let [first, rest] =
            [density.first, density.rest].map(|per_m2| per_m2 * self.photons as f64);
        let left = if self.is_guided { 0.0 } else { (1.0 - CLAMP * rest / pdf_m2).max(0.0) };
        PartitionWeights { first: pdf_m2 / (pdf_m2 + first), rest: left }
    }
}
