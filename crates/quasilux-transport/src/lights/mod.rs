//! Lights: emission of photons, and direct light at surfaces. Area lights are sampled in
//! `emitting_facets`: `facet_group` chooses a facet and a point on it, by `coarse_facets` and
//! `seen_triangle`; luminaires with a luminous area in `area_luminaires`, lights without extent in
//! `pointlike`, what mirrors show of both kinds in `images`; `selection` chooses one of several, by
//! what `coarse_lights` says. What comes from outside, in `outside`, has no place; its photons
//! start where they come in.

mod area_luminaires;
mod asked_tables;
mod bright_sky;
mod coarse_facets;
mod coarse_lights;
mod emitting_facets;
mod facet_group;
pub(crate) mod images;
mod outside;
mod pointlike;
mod seen_triangle;
mod selection;
mod sun_ways;
mod suns;

pub(crate) use area_luminaires::{AreaLuminaires, ChosenPlace};
pub(crate) use asked_tables::tables_bytes;
pub(crate) use coarse_lights::coarse_tables_bytes;
pub(crate) use emitting_facets::{EmitterPoint, Emitters};
pub(crate) use facet_group::EmitterPlace;
pub(crate) use outside::{DrawnDirection, Line, OnwardDirection, OutsideLight, SKY_MARGIN};
pub(crate) use pointlike::{Choice, Incidence, LightCentre, PointLikes};
pub(crate) use selection::{Asking, ChoiceWork};
pub(crate) use sun_ways::{SunPlace, SunWays};
pub(crate) use suns::{SunChoice, SunSample, Suns};

use crate::lights::images::LightPathClass;
use crate::purpose::{Purpose, PurposeRecorder};
use crate::settings::EstimatorKind;
use crate::spectrum::Spectrum;
use crate::world::frame::Frame;
use crate::world::{RayOrigin, World};
use area_luminaires::place_m;
use glam::DVec3;
use outside::{Beside, OutsidePhoton, OutsidePhotons};
use quasilux_photometry::SurfacePoint;
use quasilux_sampling::warp::{sample_cosine_hemisphere, sample_uniform_sphere};
use quasilux_sampling::{Discrete, Sampler};
use quasilux_scene::{Light, Scene};
use std::f64::consts::PI;
use std::ops::Range;

/// All lights of a scene.
pub(crate) struct Lights<'a> {
    pub(crate) pointlikes: PointLikes<'a>,
    pub(crate) area_luminaires: AreaLuminaires<'a>,
    pub(crate) emitters: Option<Emitters>,
    /// The sky and the sun.
    pub(crate) outside: Option<OutsideLight<'a>>,
    /// How photons of these start.
    outside_photons: Option<OutsidePhotons>,
    /// Over the point-like lights, the luminaires with an area, past them all emitting facets
    /// together, and past those the ways in from outside.
    by_flux: Option<Discrete>,
    fluxes_lm: Vec<f64>,
    /// Number of the first way in.
    first_way_in: usize,
    /// Flux in lm of all photons together: the sum of the fluxes of lamps and ways in.
    pub(crate) flux_lm: f64,
}

/// Kind of the light that a number of [`Lights`] stands for, with its number in that kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LightKind {
    Pointlike(usize),
    Luminaire(usize),
    /// All emitting facets.
    Emitters,
    WayIn(usize),
}

/// Light from outside, and how its photons come in.
#[derive(Clone, Copy)]
pub(crate) struct WaysIn<'l, 'a> {
    pub(crate) outside: &'l OutsideLight<'a>,
    pub(crate) photons: &'l OutsidePhotons,
}

/// A photon that has just left its light.
pub(crate) struct Emitted {
    pub(crate) emission: Emission,
    pub(crate) path_class: LightPathClass,
    /// Its flux over that of a photon of all lights: 1 but for light from outside.
    pub(crate) share: f64,
    /// Where on its shape, of a luminaire with an area.
    pub(crate) place: Option<SurfacePoint>,
}

/// A photon at the moment it leaves its light, or a surface.
#[derive(Clone, Copy)]
pub(crate) struct Emission {
    pub(crate) from: RayOrigin,
    /// Unit direction.
    pub(crate) direction: DVec3,
}

/// A light that was chosen, and the two coordinates of its first distribution.
#[derive(Clone, Copy)]
pub(crate) struct Chosen {
    pub(crate) number: usize,
    pub(crate) u: [f64; 2],
}

impl<'a> Lights<'a> {
    /// All lights, for an estimator of this kind.
    pub(crate) fn new<S: Spectrum>(
        scene: &'a Scene,
        world: &World<S>,
        estimator: EstimatorKind,
    ) -> Self {
        let pointlikes = PointLikes::new(scene, world.bounds());
        let area_luminaires = AreaLuminaires::new(scene, world.bounds());
        let emitters = Emitters::new(scene, world);
        let outside = OutsideLight::new(scene, world);
        let emitters_lm = emitters.as_ref().map_or(0.0, Emitters::flux_lm);
        let centred = pointlikes.iter().chain(area_luminaires.iter());
        let mut fluxes_lm: Vec<f64> =
            centred.map(|light| light.flux_lm).chain([emitters_lm]).collect();
        let lamps_lm = fluxes_lm.iter().sum();
        let outside_photons = outside.as_ref().and_then(|outside| {
            // Elsewhere paths find what comes straight to sensors.
            let counts_at_sensors = estimator.is_bounded() || estimator == EstimatorKind::Photon;
            OutsidePhotons::new(outside, scene, world, Beside { counts_at_sensors, lamps_lm })
        });
        let first_way_in = fluxes_lm.len();
        fluxes_lm.extend(outside_photons.iter().flat_map(OutsidePhotons::fluxes_lm));
        let (by_flux, flux_lm) = (Discrete::new(&fluxes_lm), fluxes_lm.iter().sum());
        Self {
            pointlikes,
            area_luminaires,
            emitters,
            outside,
            outside_photons,
            by_flux,
            fluxes_lm,
            first_way_in,
            flux_lm,
        }
    }

    /// An illuminance in lx that is large for this scene: what each light gives, on average over
    /// directions, at a hundredth of the scene's size from it, or where the scene comes nearest.
    pub(crate) fn reference_lx<S: Spectrum>(&self, world: &World<S>) -> f64 {
        let near_m = 0.01 * world.size_m();
        let centred = self.pointlikes.iter().chain(self.area_luminaires.iter());
        let centred = centred.map(|LightCentre { position, flux_lm }| {
            let to_box_m = world
                .bounds()
                .map_or(0.0, |[low, high]| (position - position.clamp(low, high)).length());
            let distance_m = to_box_m.max(near_m);
            flux_lm / (4.0 * PI * distance_m * distance_m)
        });
        let of_emitters = self.emitters.as_ref().map_or(0.0, Emitters::largest_lx);
        let of_outside = self.outside.as_ref().map_or(0.0, OutsideLight::reference_lx);
        centred.sum::<f64>() + of_emitters + of_outside
    }

    /// Whether paths can run into light: facets that emit, or what is outside.
    pub(crate) fn can_be_met(&self) -> bool {
        self.emitters.is_some() || self.outside.is_some()
    }

    /// Number of lights, all emitting facets counted as one, and each way in from outside.
    pub(crate) fn len(&self) -> usize {
        self.fluxes_lm.len()
    }

    /// The flux of one of them in lm.
    pub(crate) fn flux_of_lm(&self, number: usize) -> f64 {
        self.fluxes_lm[number]
    }

    /// Which kind of light a number stands for.
    pub(crate) fn kind(&self, number: usize) -> LightKind {
        let pointlikes = self.pointlikes.len();
        match number.checked_sub(self.first_way_in) {
            Some(way) => LightKind::WayIn(way),
            None if number < pointlikes => LightKind::Pointlike(number),
            None if number + 1 < self.first_way_in => LightKind::Luminaire(number - pointlikes),
            None => LightKind::Emitters,
        }
    }

    /// The numbers of the ways in, which follow that of the emitting facets.
    pub(crate) fn ways_numbers(&self) -> Range<usize> {
        self.first_way_in..self.len()
    }

    /// How photons from outside come in.
    pub(crate) fn ways_in(&self) -> Option<WaysIn<'_, 'a>> {
        let (outside, photons) = self.outside.as_ref().zip(self.outside_photons.as_ref())?;
        Some(WaysIn { outside, photons })
    }

    /// How many coordinates lead a photon out: its light and direction, and its place where facets
    /// emit, or where it comes in. The place on a luminaire with an area comes after its direction
    /// and matters less.
    pub(crate) fn leading_dimensions(&self) -> u32 {
        if self.emitters.is_some() || self.outside_photons.is_some() { 4 } else { 2 }
    }

    /// One photon of about equal flux: the light in proportion to its flux, place and direction
    /// from the light's own distribution. `None` where nothing emits, and where what was drawn
    /// carries nothing.
    ///
    /// The first two coordinates choose the light and its direction by superposition, however many
    /// lights there are; a photon of an area light or luminaire takes two more.
    pub(crate) fn emit<S: Spectrum>(
        &self,
        world: &World<S>,
        purposes: PurposeRecorder<'_>,
        sampler: &mut Sampler<'_>,
    ) -> Option<Emitted> {
        let by_flux = self.by_flux.as_ref()?;
        let (choice, u) = purposes.draw(sampler, Purpose::Emission, |sampler| {
            (sampler.choose_leading(by_flux), [sampler.remapped_1d(), sampler.next_1d()])
        });
        self.emit_from(Chosen { number: choice.index, u }, world, purposes, sampler)
    }

    /// One photon of a certain light: place and direction from its own distribution. The two
    /// coordinates come before those of the sampler.
    pub(crate) fn emit_from<S: Spectrum>(
        &self,
        Chosen { number, u }: Chosen,
        world: &World<S>,
        purposes: PurposeRecorder<'_>,
        sampler: &mut Sampler<'_>,
    ) -> Option<Emitted> {
        let mut more = || purposes.draw(sampler, Purpose::EmissionOfArea, Sampler::next_2d);
        if let Some(light) = self.pointlikes.get(number) {
            let (position, direction) = match light {
                Light::Point(light) => {
                    (light.position, DVec3::from_array(sample_uniform_sphere(u)))
                }
                Light::Luminaire(light) => {
                    let direction = light.photometry.sample_direction(u)?;
                    (light.position, light.world_from_luminaire * direction)
                }
                Light::Area(_) => return None,
            };
            let from = world.ray_origin_of_light(position, direction);
            let path_class = LightPathClass::Shown(number as u32);
            let emission = Emission { from, direction };
            return Some(Emitted { emission, path_class, share: 1.0, place: None });
        }
        if let Some(luminaire) = self.area_luminaires.get(number - self.pointlikes.len()) {
            let towards = luminaire.photometry.sample_direction(u)?;
            let place = luminaire.shape.sample_silhouette(towards, more());
            let direction = luminaire.world_from_luminaire * towards;
            let from = world.ray_origin_of_light(place_m(luminaire, &place), direction);
            return Some(Emitted {
                emission: Emission { from, direction },
                path_class: LightPathClass::Straight,
                share: 1.0,
                place: Some(place),
            });
        }
        if let Some(way_in) = number.checked_sub(self.first_way_in) {
            let (outside, photons) = self.outside.as_ref().zip(self.outside_photons.as_ref())?;
            let OutsidePhoton { position, direction, share } =
                photons.emit(outside, way_in, u, more())?;
            let from = world.ray_origin_of_light(position, direction);
            let emission = Emission { from, direction };
            let path_class = LightPathClass::Outside;
            return Some(Emitted { emission, path_class, share, place: None });
        }
        let place = self.emitters.as_ref()?.sample_point(world, u);
        let n = world.facets[place.facet as usize].front_normal;
        let local = DVec3::from_array(sample_cosine_hemisphere(more()));
        let direction = Frame::around(n).to_world(local);
        let from = world.ray_origin_on_front(place.facet, place.position);
        let emission = Emission { from, direction };
        let path_class = LightPathClass::Found;
        Some(Emitted { emission, path_class, share: 1.0, place: None })
    }
}
