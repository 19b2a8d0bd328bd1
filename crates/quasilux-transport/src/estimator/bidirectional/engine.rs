//! What all subpaths need: the scene made ready, the shares of its lights, and the numbers of
//! samples of each technique.

use super::plan::{FoundBy, Receiver, largest_disc_m2, receivers};
use super::sources::{Photon, PhotonFluxes, Sources};
use crate::context::Context;
use crate::lights::LightKind;
use crate::spectrum::Spectrum;
use crate::stats::tally::Quantum;
use crate::stats::targets::Target;
use std::f64::consts::PI;

/// The scene, its lights, and how targets are served.
pub(super) struct Engine<'l, 'a, S> {
    pub(super) context: &'l Context<'a, S>,
    pub(super) sources: Sources<'l, 'a>,
    pub(super) fluxes: PhotonFluxes,
    /// Of all targets.
    pub(super) receivers: Vec<Receiver>,
    /// Who finds emitting facets past narrow surfaces, and the sky.
    pub(super) emitters_found_by: FoundBy,
    pub(super) sky_found_by: FoundBy,
    /// Of the fluxes of photons.
    pub(super) flux_quantum: Quantum,
}

impl<'l, 'a, S: Spectrum> Engine<'l, 'a, S> {
    pub(super) fn new(context: &'l Context<'a, S>, targets: &[Target]) -> Self {
        let lights = &context.lights;
        let sources = Sources::new(lights);
        let emitters_lx = lights.emitters.as_ref().map_or(0.0, |it| it.largest_lx());
        let sky_lx = lights.outside.as_ref().map_or(0.0, |it| PI * it.brightest_cd_m2());
        let fluxes = sources.photon_fluxes();
        let area_m2 = largest_disc_m2(&context.world);
        Self {
            context,
            receivers: receivers(context, targets),
            emitters_found_by: FoundBy::new(emitters_lx, fluxes.emitters_lm / area_m2),
            sky_found_by: FoundBy::new(sky_lx, fluxes.sky_lm / area_m2),
            flux_quantum: Quantum::for_reference(fluxes.most_lm().max(f64::MIN_POSITIVE)),
            fluxes,
            sources,
        }
    }

    /// Who finds the light of a photon past narrow surfaces.
    pub(super) fn found_by(&self, photon: &Photon) -> FoundBy {
        match photon.kind {
            LightKind::Emitters => self.emitters_found_by,
            LightKind::WayIn(_) if !self.is_of_sun(photon) => self.sky_found_by,
            LightKind::Pointlike(_) | LightKind::Luminaire(_) | LightKind::WayIn(_) => {
                FoundBy::Photons
            }
        }
    }
}

impl<S> Engine<'_, '_, S> {
    /// Whether a photon from outside comes from the sun.
    pub(super) fn is_of_sun(&self, photon: &Photon) -> bool {
        let ways = self.context.lights.ways_in();
        let LightKind::WayIn(way) = photon.kind else { return false };
        ways.is_some_and(|ways| ways.photons.is_sun(way))
    }
}
