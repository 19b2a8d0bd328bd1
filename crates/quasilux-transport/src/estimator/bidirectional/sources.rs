//! Which light a photon leaves: half of the choices go by flux, half evenly, so that a faint lamp
//! is never left out beside bright ones.

use crate::importance::PilotPhoton;
use crate::lights::{Emission, Emitted, LightKind, Lights, Line, SKY_MARGIN};
use crate::spectrum::Spectrum;
use crate::world::World;
use glam::DVec3;
use quasilux_photometry::SurfacePoint;
use quasilux_sampling::{Discrete, Sampler};

/// The share of the photons that lights get evenly.
const EVENLY: f64 = 0.5;

/// All lights, as photons leave them.
pub(super) struct Sources<'l, 'a> {
    lights: &'l Lights<'a>,
    choice: Option<Discrete>,
}

/// The most that a photon of each kind of lights stands for, were it the only one, in lm.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PhotonFluxes {
    pub(super) pointlikes_lm: f64,
    pub(super) luminaires_lm: f64,
    pub(super) emitters_lm: f64,
    pub(super) sky_lm: f64,
    pub(super) sun_lm: f64,
}

impl PhotonFluxes {
    pub(super) fn most_lm(&self) -> f64 {
        let Self { pointlikes_lm, luminaires_lm, emitters_lm, sky_lm, sun_lm } = *self;
        [pointlikes_lm, luminaires_lm, emitters_lm, sky_lm, sun_lm].into_iter().fold(0.0, f64::max)
    }
}

/// A photon that has just left its light.
#[derive(Clone)]
pub(super) struct Photon {
    pub(super) kind: LightKind,
    pub(super) number: usize,
    pub(super) emission: Emission,
    /// Where on its shape, of a luminaire with an area.
    pub(super) place: Option<SurfacePoint>,
    /// The flux that it stands for, were it the only one, in lm.
    pub(super) flux_lm: f64,
}

impl<'l, 'a> Sources<'l, 'a> {
    pub(super) fn new(lights: &'l Lights<'a>) -> Self {
        let fluxes_lm: Vec<f64> = (0..lights.len()).map(|it| lights.flux_of_lm(it)).collect();
        let all_lm: f64 = fluxes_lm.iter().sum();
        let shining = fluxes_lm.iter().filter(|flux_lm| **flux_lm > 0.0).count() as f64;
        let share = |flux_lm: &f64| match *flux_lm > 0.0 {
            true => (1.0 - EVENLY) * flux_lm / all_lm + EVENLY / shining,
            false => 0.0,
        };
        Self { lights, choice: Discrete::new(&fluxes_lm.iter().map(share).collect::<Vec<f64>>()) }
    }

    /// The share of the photons of one light.
    pub(super) fn share(&self, number: usize) -> f64 {
        self.choice.as_ref().map_or(0.0, |choice| choice.pdf(number))
    }

    /// Largest flux in lm that a photon of each kind of lights stands for, were it the only one.
    pub(super) fn photon_fluxes(&self) -> PhotonFluxes {
        let mut most = PhotonFluxes::default();
        for number in 0..self.lights.len() {
            let lamp_lm = self.lights.flux_of_lm(number);
            let (of_kind, flux_lm) = match (self.lights.kind(number), self.lights.ways_in()) {
                (LightKind::Pointlike(_), _) => (&mut most.pointlikes_lm, lamp_lm),
                (LightKind::Luminaire(_), _) => (&mut most.luminaires_lm, lamp_lm),
                (LightKind::Emitters, _) => (&mut most.emitters_lm, lamp_lm),
                (LightKind::WayIn(way), Some(ways)) => {
                    let flux_lm = ways.photons.most_lm(ways.outside, way);
                    match ways.photons.is_sun(way) {
                        true => (&mut most.sun_lm, flux_lm),
                        false => (&mut most.sky_lm, SKY_MARGIN * flux_lm),
                    }
                }
                (LightKind::WayIn(_), None) => continue,
            };
            if flux_lm > 0.0 {
                *of_kind = of_kind.max(flux_lm / self.share(number));
            }
        }
        most
    }

    /// Photons for each lumen of a lamp: its share over its flux.
    pub(super) fn per_lm(&self, number: usize) -> f64 {
        self.share(number) / self.lights.flux_of_lm(number)
    }

    /// Photons for each lumen of a luminaire with an area.
    pub(super) fn of_luminaire_per_lm(&self, number: usize) -> f64 {
        self.per_lm(self.lights.pointlikes.len() + number)
    }

    /// Photons for each lumen of the emitting facets.
    pub(super) fn of_emitters_per_lm(&self) -> f64 {
        self.per_lm(self.lights.ways_numbers().start - 1)
    }

    /// Density in m^-2 sr^-1, across the line and over directions, of photons from outside along a
    /// line, of the sun or of all else.
    pub(super) fn pdf_line(&self, point: DVec3, direction: DVec3, of_sun: bool) -> f64 {
        let Some(ways) = self.lights.ways_in() else { return 0.0 };
        let line = Line { point, direction, of_sun };
        let numbers = self.lights.ways_numbers().enumerate();
        numbers
            .map(|(way, number)| {
                self.share(number) * ways.photons.pdf_line(ways.outside, way, &line)
            })
            .sum()
    }

    /// A photon for a survey.
    pub(super) fn pilot<S: Spectrum>(
        &self,
        world: &World<S>,
        sampler: &mut Sampler<'_>,
    ) -> Option<PilotPhoton> {
        let Photon { emission, flux_lm, .. } = self.emit(world, sampler)?;
        Some(PilotPhoton { emission, share: flux_lm / self.lights.flux_lm })
    }

    /// A photon, by two coordinates and more for lights with an area.
    pub(super) fn emit<S: Spectrum>(
        &self,
        world: &World<S>,
        sampler: &mut Sampler<'_>,
    ) -> Option<Photon> {
        let choice = sampler.choose_leading(self.choice.as_ref()?);
        let u = [sampler.remapped_1d(), sampler.next_1d()];
        let number = choice.index;
        let chosen = crate::lights::Chosen { number, u };
        let Emitted { emission, share, place, .. } =
            self.lights.emit_from(chosen, world, Default::default(), sampler)?;
        let flux_lm = share * self.lights.flux_of_lm(number) / choice.pdf;
        Some(Photon { kind: self.lights.kind(number), number, emission, place, flux_lm })
    }
}
