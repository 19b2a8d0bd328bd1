//! Connections of light vertices to sensors: each photon that lands is a virtual point light
//! (Keller 1997) to every sensor point, combined with paths by weights that depend on position
//! alone.
//!
//! A photon of flux P that lands at y on a diffuse surface of reflectance a gives `P a / pi * cos
//! cos' / d^2` to a sensor at distance d that sees y. So a photon tells every sensor something:
//! light that paths never find, behind corners, comes to all of them. Near corners `1 / d^2` has no
//! bound, and there paths are good. The light that comes to a sensor by a first surface at y is
//! therefore shared: the part w of it is left to the paths, and 1 - w to the photons, where w
//! depends on nothing but the densities at y, in m^-2, of the paths' first hits, `p = cos cos' /
//! (pi d^2)`, and of the photons' landings, n q (n photons for each path, q as foreseen by a
//! survey). Any such shares have the right mean.
//!
//! ```text
//! light that comes straight from lights to y:  w = p / (p + n q)         (balance heuristic)
//! all other light:                             w = max(0, 1 - k n q / p) (clamped photons)
//! ```
//!
//! The first is Veach and Guibas's balance heuristic (SIGGRAPH 1995) with marginal densities: both
//! estimates are good. For the second a path must go on, with light that it knows badly; it takes
//! the part w along, which is 0 wherever a photon's contribution is bounded well enough. This is
//! the compensation of clamped photons by T. Kollig and A. Keller, "Illumination in the presence of
//! weak singularities", Monte Carlo and Quasi-Monte Carlo Methods 2004, Springer 2006. Where
//! photons need guiding, paths hardly ever find the light, and w = 0. The densities are
//! interpolated, so that shares are continuous: each jump of the integrand costs quasi-random
//! points some of their advantage.
//!
//! Connections are expensive: a photon flies a few rays and needs a shadow ray to each sensor. Most
//! photons are therefore only counted, by the survey's cells around where they land (`coarse`), and
//! give each sensor what it is expected to see of these cells, which was found out before
//! (`transfer`) and is interpolated, so that it has no jumps. Few are connected, and tell how much
//! more or less than that they give. With A and B independent photons,
//!
//! ```text
//! light by photons = mean over many A of expected(A)
//!                  + mean over few B of (given by B - expected(B))
//! ```
//!
//! whose mean is right for any expectation: two levels of M. B. Giles, "Multilevel Monte Carlo path
//! simulation", Operations Research 56(3), 2008. Deviations from the expected that are small beside
//! what the sensor gets are left to chance, and what survives counts more, so that rays are not
//! spent on them.
//!
//! How many photons of each kind come on a path, and whether any, is found out by trials
//! ([`pilot`]).

mod cell_tally;
mod cell_transfer;
mod exitant_flux;
mod light_vertices;
mod pilot;
mod receiver;
mod receiver_element;
mod single;
mod view;

pub(crate) use light_vertices::LightVertexConnections;
pub(crate) use pilot::{ConnectionPilots, PathsAlone};
pub(super) use receiver_element::ReceiverElement;
pub(super) use view::View;

use crate::codec::Writer;
use crate::importance::WeightWindows;
use crate::path::partition::Partition;
use crate::photon::trace::{Lead, Source};
use crate::stats::tally::Quantum;
use crate::world::Interaction;
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Without weight windows, photons survive for certain down to this weight, and by Russian roulette
/// below: quasi-random points are efficient on smooth integrands.
const CERTAIN_WEIGHT: f64 = 0.1;

/// How photons are connected to sensors.
pub(crate) struct ConnectionPlan {
    /// What paths leave to them.
    pub(crate) partition: Partition,
    /// What guides them.
    windows: Option<WeightWindows>,
    /// Photons for each path, that are only counted by the cell they land in.
    cell_photons: u64,
    /// Deviations from the prediction below this part of a sensor's illuminance undergo Russian
    /// roulette.
    small: f64,
    /// Some places in each cell of the survey.
    places: Arc<[Vec<Interaction>]>,
}

impl ConnectionPlan {
    /// Puts it among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        let Self { partition, windows, cell_photons, small, places } = self;
        partition.landings.put(out);
        out.value(&windows.is_some());
        if let Some(windows) = windows {
            windows.put(out);
        }
        out.value(&partition.photons);
        out.value(cell_photons);
        out.value(small);
        let places = places.iter().flatten().flat_map(|at| at.position.to_array());
        places.for_each(|x| out.value(&x));
    }

    /// How photons begin, and what guides them.
    fn lead(&self) -> Lead<'_> {
        let windows = self.windows.as_ref();
        Lead { source: Source::Lights, windows, certain_weight: CERTAIN_WEIGHT }
    }

    /// Photons for each path of a sensor.
    pub(crate) fn photons(&self) -> u64 {
        self.partition.photons
    }

    /// Photons for each path that are only counted.
    pub(crate) fn cell_photons(&self) -> u64 {
        self.cell_photons
    }

    /// Whether they are guided.
    pub(crate) fn uses_importance(&self) -> bool {
        self.windows.is_some()
    }
}

/// Size and resolution of the sums.
#[derive(Clone)]
pub(crate) struct TallySettings {
    pub(crate) replicates: Range<u32>,
    /// Terms of the Neumann series that are told apart; 0 for none.
    pub(crate) listed_terms: u32,
    pub(crate) quantum: Quantum,
}

/// The sums behind a mutex; a panic of another thread does not make them unusable.
fn lock<T>(sums: &Mutex<Vec<T>>) -> MutexGuard<'_, Vec<T>> {
    sums.lock().unwrap_or_else(PoisonError::into_inner)
}
