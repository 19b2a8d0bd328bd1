//! What all subpaths need: the scene made ready, the shares of its lights, and the numbers of
//! samples of each technique.

use super::plan::{FoundBy, Receiver, largest_disc_m2, receivers};
use super::sources::{Photon, PhotonFluxes, Sources};
use crate::bsdf::TransportMode;
use crate::context::Context;
use crate::control::watch::Watch;
use crate::cutoff::Gain;
use crate::importance::{Copies, OpeningViews};
use crate::lights::LightKind;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::stats::tally::Quantum;
use crate::world::Interaction;
use glam::DVec3;
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
    /// Copies of light subpaths by place; one everywhere before it is planned.
    pub(super) copies: Copies,
    /// How places see outside, as far as that was surveyed.
    pub(super) openings: OpeningViews,
    /// Whether light may grow on its way: surfaces may send on more than they get.
    may_grow: bool,
}

impl<'l, 'a, S: Spectrum> Engine<'l, 'a, S> {
    /// `None` when the observer stopped it.
    pub(super) fn new(
        context: &'l Context<'a, S>,
        targets: &[Target],
        watch: &mut Watch<'_>,
    ) -> Option<Self> {
        let lights = &context.lights;
        let sources = Sources::new(lights);
        let emitters_lx = lights.emitters.as_ref().map_or(0.0, |it| it.largest_lx());
        let sky_lx = lights.outside.as_ref().map_or(0.0, |it| PI * it.brightest_cd_m2());
        let fluxes = sources.photon_fluxes();
        let area_m2 = largest_disc_m2(&context.world);
        Some(Self {
            context,
            receivers: receivers(context, targets, watch)?,
            emitters_found_by: FoundBy::new(emitters_lx, fluxes.emitters_lm / area_m2),
            sky_found_by: FoundBy::new(sky_lx, fluxes.sky_lm / area_m2),
            copies: Copies::single(0),
            openings: OpeningViews::default(),
            may_grow: context.world.may_send_on_more(),
            flux_quantum: Quantum::for_reference(fluxes.most_lm().max(f64::MIN_POSITIVE)),
            fluxes,
            sources,
        })
    }

    /// Adds a surface to the way of a subpath that came there along `-wo` after this many bounces;
    /// whether it goes on from there.
    pub(super) fn grow(
        &self,
        gain: &mut Gain,
        at: &Interaction,
        wo: DVec3,
        mode: TransportMode,
        bounces: u32,
    ) -> bool {
        if !self.may_grow {
            return true;
        }
        let albedo = self.context.world.bsdf(at).albedo(wo, at.front, mode);
        gain.grow(albedo.max_channel(), bounces)
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
