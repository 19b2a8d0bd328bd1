//! Photons joined to sensors, beside paths: each finds what the other seldom does.
//!
//! A photon of flux P that lands at y on a diffuse surface of reflectance a gives
//! `P a / pi * cos cos' / d^2` to a sensor at distance d that sees y. So a photon tells every sensor
//! something: light that paths never find, behind corners, comes to all of them. Near corners `1 / d^2`
//! has no bound, and there paths are good. The light that comes to a sensor by a first surface at y is
//! therefore shared: the part w of it is left to the paths, and 1 - w to the photons, where w depends on
//! nothing but the densities at y, in m^-2, of the paths' first hits, `p = cos cos' / (pi d^2)`, and of
//! the photons' landings, n q (n photons for each path, q as foreseen by a survey). Any such shares have
//! the right mean.
//!
//! ```text
//! light that comes straight from lights to y:  w = p / (p + n q)         (balance heuristic)
//! all other light:                             w = max(0, 1 - k n q / p) (clamped photons)
//! ```
//!
//! The first is Veach and Guibas's balance heuristic (SIGGRAPH 1995) with marginal densities: both
//! estimates are good. For the second a path must go on, with light that it knows badly; it takes the part w along,
//! which is 0 wherever a photon's contribution is bounded well enough. This is the compensation of clamped photons by
//! T. Kollig and A. Keller, "Illumination in the presence of weak singularities", Monte Carlo and
//! Quasi-Monte Carlo Methods 2004, Springer 2006. Where photons need steering, paths hardly ever find the light,
//! and w = 0. The densities are interpolated, so that shares are continuous: each jump in what is summed
//! costs quasi-random points some of their advantage.
//!
//! Joining is dear: a photon flies a few rays and asks for one to each sensor. Most photons are therefore only
//! counted, by the survey's cells around where they land (`coarse`), and give each sensor what it is expected to see
//! of these cells, which was found out before (`outlook`) and is interpolated, so that it has no jumps. Few are
//! joined, and tell how much more or less than that they give. With A and B independent photons,
//!
//! ```text
//! light by photons = mean over many A of expected(A) + mean over few B of (given by B - expected(B))
//! ```
//!
//! whose mean is right for any expectation: two levels of M. B. Giles, "Multilevel Monte Carlo path simulation",
//! Operations Research 56(3), 2008. Deviations from the expected that are small beside what the sensor gets are left
//! to chance, and what survives counts more, so that rays are not spent on them.
//!
//! How many photons of each kind come on a path, and whether any, is found out by trials ([`ways`]).

mod coarse;
mod joined;
mod leaving;
mod outlook;
mod receiver;
mod single;
mod spot;
mod view;
mod ways;

pub(crate) use joined::Joined;
pub(crate) use ways::{Alone, Ways};

use crate::codec::Writer;
use crate::importance::{Density, Landings, Windows};
use crate::photon::trace::{Lead, Source};
use crate::world::Interaction;
use glam::DVec3;
use std::sync::Arc;

/// k: paths take over where a photon would count this many times what it does on average.
const CLAMP: f64 = 3.0;
/// Photons that are steered by nothing go on for certain as long as absorption leaves so much of them, and
/// by chance later: smooth sums are what quasi-random points are good at.
const CERTAIN_WEIGHT: f64 = 0.1;

/// How photons are joined to sensors.
pub(crate) struct Joining {
    /// Where to expect them.
    landings: Landings,
    /// What steers them.
    windows: Option<Windows>,
    /// For each path of a sensor.
    photons: u64,
    /// More for each path, that are only counted by the cell they land in.
    coarse_photons: u64,
    /// What deviates from the foreseen by less than this part of what a sensor gets in all is left to chance.
    small: f64,
    /// Some places in each cell of the survey.
    places: Arc<[Vec<Interaction>]>,
}

/// Parts of the light that comes to a sensor by one place which paths find.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shares {
    /// Of what comes there straight from the lights.
    pub(crate) first: f64,
    /// Of all other light.
    pub(crate) rest: f64,
}

impl Shares {
    /// Paths find everything.
    pub(crate) const ALL: Self = Self { first: 1.0, rest: 1.0 };
}

impl Joining {
    /// Puts it among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        let Self { landings, windows, photons, coarse_photons, small, places } = self;
        landings.put(out);
        out.bool(windows.is_some());
        if let Some(windows) = windows {
            windows.put(out);
        }
        out.u64(*photons);
        out.u64(*coarse_photons);
        out.f64(*small);
        let places = places.iter().flatten().flat_map(|at| at.position.to_array());
        places.for_each(|x| out.f64(x));
    }

    /// How photons begin, and what steers them.
    fn lead(&self) -> Lead<'_> {
        let windows = self.windows.as_ref();
        Lead { source: Source::Lights, windows, certain_weight: CERTAIN_WEIGHT }
    }

    /// Photons for each path of a sensor.
    pub(crate) fn photons(&self) -> u64 {
        self.photons
    }

    /// Photons for each path that are only counted.
    pub(crate) fn coarse_photons(&self) -> u64 {
        self.coarse_photons
    }

    /// Whether they are steered.
    pub(crate) fn uses_importance(&self) -> bool {
        self.windows.is_some()
    }

    /// What to expect of a photon on the side `n` of a surface.
    pub(crate) fn landings(&self, position: DVec3, n: DVec3) -> Density {
        self.landings.density(&self.landings.around(position, n))
    }

    /// The parts that paths find by a place where their first hits have the density `pdf_m2`, in m^-2,
    /// and landings this one.
    pub(crate) fn path_shares(&self, pdf_m2: f64, density: Density) -> Shares {
        let [first, rest] =
            [density.first, density.rest].map(|per_m2| per_m2 * self.photons as f64);
        let left = match &self.windows {
            None => (1.0 - CLAMP * rest / pdf_m2).max(0.0),
            // Where photons need steering, paths hardly ever find the light.
            Some(_) => 0.0,
        };
        Shares { first: pdf_m2 / (pdf_m2 + first), rest: left }
    }
}
