//! Unfolding of the path from an image to a place: the points where it meets each mirror.
//!
//! Seen from the place, the last mirror shows the image of the whole chain, and the straight line
//! to it meets the mirror where the light leaves it; from there the line to the image before meets
//! the mirror before, and so on to the light. The path exists where each line meets its mirror's
//! facets, from the side that the light is on, and nothing stands between one mirror and the next.
//!
//! Where mirrors meet in an edge, several chains share an image, and a line through the edge itself
//! meets the mirrors of all of them: the points agree then ([`Links::are_same`]), and one of them
//! counts.

use super::planes::MirrorPlanes;
use super::tree::Shown;
use crate::spectrum::Spectrum;
use crate::world::{RayOrigin, World};
use glam::DVec3;
use quasilux_bvh::RayQuery;
use std::ops::Range;

/// Points in mirrors are drawn this many hairs toward the middle of their facet, so that rays do
/// not meet what adjoins the facet's edge; lines may pass a facet at one hair.
const HAIRS_INWARD: f64 = 4.0;
/// Points of two chains that are this many hairs apart are one.
const HAIRS_APART: f64 = 64.0;

/// Where light of images meets its mirrors: the links of many ways in one list, those of one path
/// the mirror nearest to the place first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Links(Vec<Link>);

/// A point in a mirror.
#[derive(Clone, Copy, Debug)]
struct Link {
    point: DVec3,
    /// The point, moved inward from the edges of its facet.
    inner: DVec3,
    facet: u32,
    /// Unit normal on the side that reflects.
    n: DVec3,
}

/// A path, but for its visibility.
#[derive(Clone, Debug)]
pub(crate) struct UnfoldedPath<S> {
    /// Its links.
    links: Range<usize>,
    /// Unit direction in which the light leaves its light.
    pub(crate) leaves: DVec3,
    /// Share of the light that all mirrors together reflect.
    pub(crate) reflected: S,
}

impl Links {
    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Follows the way from `place` to an image of `light`, by what the mirrors show, the last one
    /// first; `None` where it leads past a mirror.
    pub(crate) fn unfold<S: Spectrum>(
        &mut self,
        world: &World<S>,
        mirrors: &MirrorPlanes,
        shown: impl Iterator<Item = Shown>,
        light: DVec3,
        place: DVec3,
    ) -> Option<UnfoldedPath<S>> {
        let first = self.0.len();
        let path = self.push_links(world, mirrors, shown, light, place);
        if path.is_none() {
            self.0.truncate(first);
        }
        path
    }

    fn push_links<S: Spectrum>(
        &mut self,
        world: &World<S>,
        mirrors: &MirrorPlanes,
        shown: impl Iterator<Item = Shown>,
        light: DVec3,
        place: DVec3,
    ) -> Option<UnfoldedPath<S>> {
        let (first, slack_m) = (self.0.len(), world.hair_m());
        let mut reflected = S::white();
        let mut at = place;
        for Shown { plane, position } in shown {
            let mirror = &mirrors.planes[plane as usize];
            let behind_m = mirror.height_m(position);
            let side = -behind_m.signum();
            let height_m = mirror.height_m(at) * side;
            if height_m < -slack_m {
                return None;
            }
            let height_m = height_m.max(0.0);
            let apart_m = height_m + behind_m.abs();
            let line = position - at;
            let point = at + line * (height_m / apart_m);
            let facet = mirror.facet_at(point, slack_m)?;
            let cos = (apart_m / line.length()).min(1.0);
            let mirroring = &world.facets[facet.facet as usize];
            let front = mirroring.front_normal.dot(mirror.normal) * side > 0.0;
            reflected = reflected * world.bsdf_of(mirroring).image_reflectance(cos, front)?;
            let inward = (facet.centroid() - point).normalize_or_zero();
            let inner = point + inward * (HAIRS_INWARD * slack_m);
            self.0.push(Link { point, inner, facet: facet.facet, n: mirror.normal * side });
            at = point;
        }
        let leaves = (at - light).normalize_or_zero();
        Some(UnfoldedPath { links: first..self.0.len(), leaves, reflected })
    }

    /// The rays that see whether anything stands in a way from `from` over its mirrors to the light
    /// at `light`, which lies on `facet` or on none.
    pub(crate) fn shadow_rays<S: Spectrum>(
        &self,
        world: &World<S>,
        path: &UnfoldedPath<S>,
        from: RayOrigin,
        light: DVec3,
        facet: u32,
        shadow_rays: &mut Vec<RayQuery>,
    ) {
        let mut from = from;
        for link in &self.0[path.links.clone()] {
            shadow_rays.extend(shadow_ray(from, link.inner, link.facet));
            from = world.ray_origin_on_side(link.facet, link.inner, link.n);
        }
        shadow_rays.extend(shadow_ray(from, light, facet));
    }

    /// Whether two ways are one, point by point.
    pub(crate) fn are_same<S>(
        &self,
        a: &UnfoldedPath<S>,
        b: &UnfoldedPath<S>,
        hair_m: f64,
    ) -> bool {
        let [a, b] = [a, b].map(|path| &self.0[path.links.clone()]);
        let near = |(a, b): (&Link, &Link)| (a.point - b.point).length() <= HAIRS_APART * hair_m;
        a.len() == b.len() && a.iter().zip(b).all(near)
    }
}

/// The ray between two points; `None` where they are one.
fn shadow_ray(from: RayOrigin, to: DVec3, target: u32) -> Option<RayQuery> {
    let toward = to - from.position();
    let distance_m = toward.length();
    (distance_m > 0.0).then(|| from.shadow_ray(toward / distance_m, distance_m, target))
}
