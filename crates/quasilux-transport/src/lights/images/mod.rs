//! Mirror images of lights (Allen and Berkley 1979): direct light over plane mirrors, which light
//! sampling does not find, nor a BSDF where the light is a point. Area lights are in `emitters`,
//! point-like ones here.
//!
//! `planes` finds the mirrors, `tree` what they show of each light, `chain` the way from an image
//! to a place, and `light_path_class` which photons took such a path and are left out where images
//! are counted.
//!
//! An image at distance d, all bounces unfolded, gives `E = I cos / d^2` times what its mirrors
//! reflect, I in the direction in which the light really leaves.

mod chain;
mod cone;
mod emitters;
#[cfg(test)]
mod fixtures;
mod light_path_class;
mod planes;
mod tree;
mod unshown;

use crate::lights::{Asking, ChoiceWork, EmitterPlace, EmitterPoint, PointLikes};
use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::vertex::Vertex;
use crate::world::visibility::{LightRequest, ShadowQueue};
use chain::{Links, UnfoldedPath};
use emitters::EmitterImages;
use glam::DVec3;
use planes::MirrorPlanes;
use quasilux_bvh::RayQuery;
use quasilux_sampling::choose_weights;
use tree::{Imaged, Images};

pub(crate) use light_path_class::LightPathClass;
pub use unshown::UnshownWay;

/// Up to this number of images at a vertex are all tested; of more one is chosen.
const ALL_TESTED: usize = 8;
/// Numbers of images considered at each vertex: the first by depth, and at most this many of the
/// others, evenly spaced: far images are many and give little.
const SURE: usize = 64;
const THINNED: usize = 64;

/// All that mirrors show of point-like lights, and of area lights.
pub(crate) struct SpecularImages {
    mirrors: MirrorPlanes,
    images: Images,
    emitters: EmitterImages,
}

/// Light samples of images for one place, and working space.
#[derive(Default)]
pub(crate) struct ImageSamples<S> {
    links: Links,
    light_samples: Vec<ImageSample<S>>,
    choice: ChoiceWork,
}

/// A place that requests light from images, and what stands around.
pub(crate) struct ImageQuery<'q, S> {
    pub(crate) world: &'q World<S>,
    pub(crate) pointlikes: &'q PointLikes<'q>,
    /// Number of the receiver.
    pub(crate) who: u32,
    pub(crate) vertex: &'q Vertex<'q, S>,
}

/// Light from one image to a place, unless something stands in the path.
struct ImageSample<S> {
    image: u32,
    path: UnfoldedPath<S>,
    light: S,
}

/// How light of an image comes to a place.
struct ImageIncidence<S> {
    path: UnfoldedPath<S>,
    /// Unit direction to the image.
    direction: DVec3,
    /// If its mirrors reflected all of it.
    illuminance_lx: f64,
}

impl<S: Spectrum> ImageIncidence<S> {
    /// The illuminance in lx with what they reflect.
    fn reflected_lx(&self) -> f64 {
        self.path.reflected.luminance() * self.illuminance_lx
    }
}

/// Which images are considered past the first [`SURE`]: every `stride`th from `phase` on.
#[derive(Clone, Copy)]
struct Thinning {
    stride: usize,
    phase: f64,
}

impl Thinning {
    const NONE: Self = Self { stride: 1, phase: 0.0 };
}

impl SpecularImages {
    /// The images that count, through up to `depth` mirrors.
    pub(crate) fn new<S: Spectrum>(
        world: &World<S>,
        lights: &PointLikes<'_>,
        depth: Option<u32>,
    ) -> Self {
        let mirrors = MirrorPlanes::new(world);
        let points = lights.iter().map(|light| Imaged { position: light.position, radius_m: 0.0 });
        let images = Images::new(&mirrors, points, depth, world.hair_m());
        let emitters = EmitterImages::new(world, &mirrors, depth);
        Self { mirrors, images, emitters }
    }

    /// Image of an image in a mirror facet.
    fn shown_by(&self, image: u32, facet: u32) -> Option<u32> {
        self.images.child(image, self.mirrors.of_facet(facet)?)
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.images.nodes.len() == self.images.lights
    }

    /// Whether mirrors show area lights.
    pub(crate) fn show_emitters(&self) -> bool {
        !self.emitters.is_empty()
    }

    /// Asks for the light of one point on one image of an area light, see
    /// [`EmitterImages::sample`].
    pub(crate) fn sample_emitters<S: Spectrum>(
        &self,
        query: &ImageQuery<'_, S>,
        u: [f64; 2],
        beside_sr: impl FnOnce(&EmitterPoint) -> f64,
        found: &mut ImageSamples<S>,
        shadows: &mut ShadowQueue<S>,
    ) {
        let _ = self.emitters.sample(&self.mirrors, query, u, beside_sr, found, shadows);
    }

    /// The plane that a facet mirrors in, if it is one of the mirrors.
    pub(crate) fn plane_of(&self, facet: u32) -> Option<u32> {
        self.mirrors.of_facet(facet)
    }

    /// Density in m^-2 with which a place asks for a point of a facet over mirrors in these planes,
    /// the one next to the facet first; `None` where no image shows it, or nothing mirrors.
    pub(crate) fn asked_over_m2<S: Spectrum>(
        &self,
        world: &World<S>,
        mut planes: impl Iterator<Item = u32>,
        place: Asking,
        asked: EmitterPlace,
    ) -> Option<f64> {
        let light = self.emitter(world.facets[asked.facet as usize].material)?;
        let image = planes.try_fold(light, |image, plane| self.emitter_in(image, plane))?;
        self.is_mirrored_emitter(image).then(|| self.asked_m2(world, image, place, asked))
    }

    /// The area light of this material, as an image over no mirror.
    pub(crate) fn emitter(&self, material: u32) -> Option<u32> {
        self.emitters.light(material)
    }

    /// Image of an image of an area light in the mirrors of a plane.
    pub(crate) fn emitter_in(&self, image: u32, plane: u32) -> Option<u32> {
        self.emitters.child(image, plane)
    }

    /// Whether there are mirrors between an area light and this image of it.
    pub(crate) fn is_mirrored_emitter(&self, image: u32) -> bool {
        self.emitters.is_mirrored(image)
    }

    /// Density in m^-2 with which a place asks for a point of a facet, and this image of it.
    pub(crate) fn asked_m2<S: Spectrum>(
        &self,
        world: &World<S>,
        image: u32,
        place: Asking,
        asked: EmitterPlace,
    ) -> f64 {
        self.emitters.pdf_m2(world, &self.mirrors, image, place, asked)
    }

    /// Tests all images for all sensor points, and tells `receive` who gets how much light.
    pub(crate) fn all<S: Spectrum>(
        &self,
        world: &World<S>,
        pointlikes: &PointLikes<'_>,
        receivers: &[LightRequest<'_, S>],
        shadows: &mut ShadowQueue<S>,
        receive: impl FnMut(u32, S, u32),
    ) {
        if self.is_empty() {
            return;
        }
        let mut found = ImageSamples::default();
        for LightRequest { who, vertex } in receivers {
            let query = ImageQuery { world, pointlikes, who: *who, vertex };
            self.find(&query, shadows.max_bounces, Thinning::NONE, |_, _, _| 1.0, &mut found);
            for light_sample in &found.light_samples {
                self.ask(&query, light_sample, &found.links, shadows);
            }
        }
        shadows.answer(world, receive);
    }

    /// Asks for the light that a path gets from images at a vertex, with the coordinate `u`: of all
    /// where they are few. Of very many, far ones are thinned out; of those that give anything
    /// unshadowed, one is chosen in proportion to what it gives where they are more than
    /// [`ALL_TESTED`].
    ///
    /// `share` is the part of an image's light that counts, by the number of its light, the
    /// direction to it and the illuminance in lx that it gives.
    pub(crate) fn sample_direct<S: Spectrum>(
        &self,
        query: &ImageQuery<'_, S>,
        u: f64,
        share: impl Fn(u32, DVec3, f64) -> f64,
        found: &mut ImageSamples<S>,
        shadows: &mut ShadowQueue<S>,
    ) {
        let others = self.images.nodes.len().saturating_sub(self.images.lights + SURE);
        let stride = others.div_ceil(THINNED).max(1);
        self.find(query, shadows.max_bounces, Thinning { stride, phase: u }, share, found);
        let u = (u * stride as f64).fract();
        let ImageSamples { links, light_samples, .. } = found;
        if light_samples.len() > ALL_TESTED {
            let weights = light_samples.iter().map(|light_sample| light_sample.light.luminance());
            // Without a choice a figure is not finite: then the tally must see it.
            if let Some(choice) = choose_weights(u, weights) {
                light_samples.swap(0, choice.index);
                light_samples.truncate(1);
                light_samples[0].light = light_samples[0].light * (1.0 / choice.pdf);
            }
        }
        for light_sample in light_samples.iter() {
            self.ask(query, light_sample, links, shadows);
        }
    }

    /// The illuminance in lx that an image, or a light itself, gives to a surface as if nothing
    /// stood in the path; `None` where no vertex there asks it.
    pub(crate) fn illuminance_lx<S: Spectrum>(
        &self,
        query: &ImageQuery<'_, S>,
        image: u32,
    ) -> Option<f64> {
        let incidence = self.incidence(query, image, &mut Links::default())?;
        Some(incidence.reflected_lx())
    }

    /// How light of an image comes to a vertex; `None` where it does not.
    fn incidence<S: Spectrum>(
        &self,
        query: &ImageQuery<'_, S>,
        image: u32,
        links: &mut Links,
    ) -> Option<ImageIncidence<S>> {
        let &ImageQuery { world, pointlikes, vertex, .. } = query;
        let (place, node) = (vertex.position(), &self.images.nodes[image as usize]);
        let toward_m = node.position - place;
        if vertex.cos(toward_m) <= 0.0 || !node.beam.holds(-toward_m) {
            return None;
        }
        let (shown, light) =
            (self.images.shown(image), self.images.nodes[node.light as usize].position);
        let path = links.unfold(world, &self.mirrors, shown, light, place)?;
        let distance_m = toward_m.length();
        let direction = toward_m / distance_m;
        let intensity_cd = pointlikes.intensity_cd(node.light, path.leaves);
        let illuminance_lx = intensity_cd * vertex.cos(direction) / (distance_m * distance_m);
        Some(ImageIncidence { path, direction, illuminance_lx })
    }

    /// Finds what all images over at most `max_bounces` mirrors may give to a vertex, `share` of it
    /// each.
    fn find<S: Spectrum>(
        &self,
        query: &ImageQuery<'_, S>,
        max_bounces: u32,
        Thinning { stride, phase }: Thinning,
        share: impl Fn(u32, DVec3, f64) -> f64,
        found: &mut ImageSamples<S>,
    ) {
        let ImageSamples { links, light_samples, .. } = found;
        links.clear();
        light_samples.clear();
        for (count, number) in self.images.mirrored(SURE, stride, phase).enumerate() {
            let (image, node) = (number as u32, &self.images.nodes[number]);
            if node.depth > max_bounces {
                break;
            }
            let Some(incidence) = self.incidence(query, image, links) else { continue };
            let share = share(node.light, incidence.direction, incidence.reflected_lx());
            let ImageIncidence { path, direction, illuminance_lx } = incidence;
            let stands_for = if count < SURE { share } else { share * stride as f64 };
            let weight = query.vertex.weight(direction);
            let light = weight * path.reflected * (illuminance_lx * stands_for);
            let is_known = |other: &ImageSample<S>| {
                self.images.nodes[other.image as usize].light == node.light
                    && links.are_same(&other.path, &path, query.world.hair_m())
            };
            if light.luminance() != 0.0 && !light_samples.iter().any(is_known) {
                light_samples.push(ImageSample { image, path, light });
            }
        }
    }

    fn ask<S: Spectrum>(
        &self,
        query: &ImageQuery<'_, S>,
        light_sample: &ImageSample<S>,
        links: &Links,
        shadows: &mut ShadowQueue<S>,
    ) {
        let &ImageQuery { world, who, vertex, .. } = query;
        let image = &self.images.nodes[light_sample.image as usize];
        let from = vertex.ray_origin(image.position - vertex.position());
        let light_m = self.images.nodes[image.light as usize].position;
        let nothing = RayQuery::NONE;
        shadows.push_polyline(who, light_sample.light, image.depth, nothing, |shadow_rays| {
            let path = &light_sample.path;
            links.shadow_rays(world, path, from, light_m, RayQuery::NONE, shadow_rays);
        });
    }
}
