//! Where a photon arrives, and how densely light that comes as it did is asked for there.

use super::engine::Engine;
use super::leading::WayOut;
use super::mirrored_way::MirroredWay;
use super::sources::Photon;
use super::subpath_weights::{SubpathWeights, product};
use crate::context::Context;
use crate::lights::{EmitterPlace, LightKind, OutsideLight};
use crate::spectrum::Spectrum;
use glam::DVec3;

/// Where a subpath arrives.
pub(super) struct Arrival {
    pub(super) way_out: WayOut,
    pub(super) n: DVec3,
    /// Of the flight, from the last vertex or pane.
    pub(super) along_m: f64,
    pub(super) direction: DVec3,
    pub(super) cos: f64,
    pub(super) asks: Asks,
}

/// Which lights a place asks for light.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Asks {
    /// A specular surface.
    Nothing,
    /// One of each kind.
    One,
    /// A cell: every light without extent.
    AllPointlikes,
}

impl Arrival {
    /// From an emitting facet over mirrors: how densely its image is asked for here, over the
    /// density of the photon.
    pub(super) fn of_image<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        photon: &Photon,
        way: &MirroredWay<S>,
    ) -> Option<f64> {
        let emission = Emission::new(engine, photon);
        let left_from = EmitterPlace { facet: emission.facet, position: emission.position };
        let Context { world, images, .. } = engine.context;
        let planes = way.planes.iter().copied();
        let pdf_m2 = images.asked_over_m2(world, planes, self.way_out.place, left_from)?;
        let distance_m = way.distance_m(self.along_m);
        let per_m2 = emission.per_m2_sr * self.cos * way.kept();
        Some(product(pdf_m2, distance_m * distance_m / per_m2))
    }

    /// Straight from the light of a photon, panes between or not: the densities of asking for its
    /// light here, and of running into it, over that of the photon.
    pub(super) fn of_photon<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        photon: &Photon,
        distance_m: f64,
    ) -> SubpathWeights {
        let Self { way_out, n, direction, cos, asks, .. } = *self;
        let place = way_out.place;
        let Engine { context, sources, .. } = engine;
        let (lights, position) = (&context.lights, place.position);
        let asks_for = asks != Asks::Nothing;
        match photon.kind {
            LightKind::Pointlike(_) | LightKind::Luminaire(_) if !asks_for => {
                SubpathWeights::default()
            }
            LightKind::Pointlike(light) => {
                let both = place.side.is_none();
                let lx = lights.pointlikes.illuminance_lx(light, position, n, both);
                let choice = match asks {
                    Asks::AllPointlikes => 1.0,
                    Asks::Nothing | Asks::One => lights.pointlikes.probability(light, place),
                };
                SubpathWeights::new(choice / (sources.per_lm(photon.number) * lx), 0.0)
            }
            LightKind::Luminaire(light) => {
                let own = photon.place.as_ref().and_then(|on_shape| {
                    lights.area_luminaires.incidence(light, on_shape, position, |_| cos)
                });
                let Some(incidence) = own else { return SubpathWeights::default() };
                let choice = lights.area_luminaires.probability(light, place);
                let photons_m2 = sources.per_lm(photon.number) * incidence.illuminance_lx;
                SubpathWeights::new(choice / photons_m2, 0.0)
            }
            LightKind::Emitters => {
                let emission = Emission::new(engine, photon);
                let asked = EmitterPlace { facet: emission.facet, position: emission.position };
                let emitters = lights.emitters.as_ref().filter(|_| asks_for);
                let pdf_m2 = emitters.map_or(0.0, |it| it.pdf_m2(&context.world, place, asked));
                let square_m2 = distance_m * distance_m;
                let vcm = product(pdf_m2, square_m2 / (emission.per_m2_sr * cos));
                SubpathWeights::new(vcm, emission.cos / emission.per_m2_sr / cos)
            }
            LightKind::WayIn(_) => {
                let of_sun = engine.is_of_sun(photon);
                let per_m2 = sources.pdf_line(position, direction, of_sun) * cos;
                let outside = lights.outside.as_ref().filter(|_| asks_for);
                let asked_sr = outside.map_or(0.0, |outside: &OutsideLight<'_>| match of_sun {
                    true => outside.sun_pdf_sr(-direction),
                    false => way_out.asked_sr(outside, -direction),
                });
                SubpathWeights::new(product(asked_sr, per_m2.recip()), per_m2.recip())
            }
        }
    }
}

/// How a photon left an emitting facet.
struct Emission {
    facet: u32,
    position: DVec3,
    cos: f64,
    per_m2_sr: f64,
}

impl Emission {
    fn new<S: Spectrum>(engine: &Engine<'_, '_, S>, photon: &Photon) -> Self {
        let (from, direction) = (photon.emission.from, photon.emission.direction);
        let facet = from.facet().expect("it left a facet");
        let on = &engine.context.world.facets[facet as usize];
        let cos = on.front_normal.dot(direction);
        let per_m2_sr = engine.sources.of_emitters_per_lm() * on.emitted_cd_m2 * cos;
        Self { facet, position: from.position(), cos, per_m2_sr }
    }
}
