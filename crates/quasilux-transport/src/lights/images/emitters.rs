//! Mirror images of area lights (emitting facets): next-event estimation over plane mirrors.
//!
//! Seen in a chain of plane mirrors, a point of a facet stands at its image, D away with the way
//! unfolded. A vertex that chooses this chain and the point with the density p in m^-2 finds it
//! with `p D^2 / cos` in sr^-1, cos at the facet: facet and point are drawn as if the vertex stood
//! before the light itself, where its own image in the chain is. A direction from the vertex
//! that is mirrored into the same facet is weighted against that as it is where no mirror is
//! between (`emitting_facets`). What no image shows, chains past the last level and light that
//! comes over mirrors and through panes, is left to directions alone.

use super::planes::MirrorPlanes;
use super::tree::{Imaged, Images};
use super::{ImageQuery, ImageSamples};
use crate::lights::facet_group::{DrawnPlace, FacetGroup};
use crate::lights::{Asking, EmitterPlace, EmitterPoint};
use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::visibility::ShadowQueue;
use glam::DVec3;
use quasilux_sampling::Discrete;
use std::collections::BTreeMap;

/// Mirror images of all area lights.
pub(super) struct EmitterImages {
    /// The emitting facets of one material are one light.
    images: Images,
    lights: Vec<FacetGroup>,
    /// Over the images, by the flux of their light and what their mirrors reflect at most; 0 for
    /// the lights themselves. `None` where there are no images.
    by_flux: Option<Discrete>,
    light_of_material: BTreeMap<u32, u32>,
}

impl EmitterImages {
    pub(super) fn new<S: Spectrum>(
        world: &World<S>,
        mirrors: &MirrorPlanes,
        depth: Option<u32>,
    ) -> Self {
        let mut by_material: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for (number, facet) in (0..).zip(&world.facets) {
            if facet.emitted_cd_m2 * facet.area_m2() > 0.0 {
                by_material.entry(facet.material).or_default().push(number);
            }
        }
        let mut lights = Vec::new();
        let mut light_of_material = BTreeMap::new();
        for (material, facets) in by_material {
            // Places that ask are seen in mirrors, too.
            if let Some(light) = FacetGroup::new(world, facets.into_iter(), None) {
                light_of_material.insert(material, lights.len() as u32);
                lights.push(light);
            }
        }
        let balls = lights.iter().map(|light| ball(world, light));
        let images = Images::new(mirrors, balls, depth, world.hair_m());
        let weights: Vec<f64> = images
            .nodes
            .iter()
            .map(|node| match node.depth {
                0 => 0.0,
                _ => lights[node.light as usize].intensity_cd() * node.reflected,
            })
            .collect();
        Self { by_flux: Discrete::new(&weights), images, lights, light_of_material }
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.by_flux.is_none()
    }

    /// Asks for the light of one point of one image, weighted against other techniques: the weight
    /// is that of its density over this and `beside_sr` together.
    pub(super) fn sample<S: Spectrum>(
        &self,
        mirrors: &MirrorPlanes,
        query: &ImageQuery<'_, S>,
        u: [f64; 2],
        beside_sr: impl FnOnce(&EmitterPoint) -> f64,
        found: &mut ImageSamples<S>,
        shadows: &mut ShadowQueue<S>,
    ) -> Option<()> {
        let &ImageQuery { world, who, vertex, .. } = query;
        let by_flux = self.by_flux.as_ref()?;
        let choice = by_flux.sample(u[0]);
        let (image, node) = (choice.index as u32, &self.images.nodes[choice.index]);
        if node.depth > shadows.max_bounces {
            return None;
        }
        let light = &self.lights[node.light as usize];
        let place = self.images.place_before_light(mirrors, image, Asking::at(vertex));
        let ImageSamples { links, choice: work, .. } = found;
        let drawn = light.sample_point(world, place, [choice.u_remapped, u[1]], work)?;
        let DrawnPlace { drawn: EmitterPlace { facet: number, position: point }, pdf_m2 } = drawn;
        let facet = &world.facets[number as usize];
        let shown = self.images.shown_of(mirrors, image, point);
        let toward = shown.first()?.position - vertex.position();
        let distance_m = toward.length();
        let direction = toward / distance_m;
        let cos = vertex.cos(direction);
        if cos <= 0.0 {
            return None;
        }
        links.clear();
        let path = links.unfold(world, mirrors, shown.into_iter(), point, vertex.position())?;
        let cos_light = facet.front_normal.dot(path.leaves);
        if cos_light <= 0.0 {
            return None;
        }
        let pdf_sr = choice.pdf * pdf_m2 * distance_m * distance_m / cos_light;
        let lx_sr = facet.emitted_cd_m2 * cos;
        let kept = path.reflected.max_channel();
        let emitter_point = EmitterPoint { direction, lx_sr, pdf_sr, kept };
        let illuminance_lx = lx_sr / (pdf_sr + beside_sr(&emitter_point));
        let light = vertex.weight(direction) * path.reflected * illuminance_lx;
        if light.luminance() != 0.0 {
            let from = vertex.ray_origin(direction);
            shadows.push_polyline(who, light, node.depth, number, |shadow_rays| {
                links.shadow_rays(world, &path, from, point, number, shadow_rays);
            });
        }
        Some(())
    }

    /// The area light of this material, as an image over no mirror.
    pub(super) fn light(&self, material: u32) -> Option<u32> {
        self.light_of_material.get(&material).copied()
    }

    /// Image of an image in the mirrors of a plane.
    pub(super) fn child(&self, image: u32, plane: u32) -> Option<u32> {
        self.images.child(image, plane)
    }

    /// Whether there are mirrors between the light and an image.
    pub(super) fn is_mirrored(&self, image: u32) -> bool {
        self.images.nodes[image as usize].depth > 0
    }

    /// Density in m^-2 with which a place asks for a point of a facet, and this image of it.
    pub(super) fn pdf_m2<S: Spectrum>(
        &self,
        world: &World<S>,
        mirrors: &MirrorPlanes,
        image: u32,
        place: Asking,
        asked: EmitterPlace,
    ) -> f64 {
        let light = &self.lights[self.images.nodes[image as usize].light as usize];
        let pdf = self.by_flux.as_ref().map_or(0.0, |by_flux| by_flux.pdf(image as usize));
        let place = self.images.place_before_light(mirrors, image, place);
        pdf * light.pdf_m2(world, place, asked)
    }
}

/// A ball around an area light.
fn ball<S: Spectrum>(world: &World<S>, light: &FacetGroup) -> Imaged {
    let corners = || light.facets().iter().flat_map(|&it| world.facets[it as usize].corners());
    let low = corners().fold(DVec3::INFINITY, DVec3::min);
    let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
    let position = 0.5 * (low + high);
    let radius_m = corners().map(|corner| (corner - position).length()).fold(0.0, f64::max);
    Imaged { position, radius_m }
}
