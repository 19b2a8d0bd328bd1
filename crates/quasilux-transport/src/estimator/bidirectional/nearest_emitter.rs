//! How near the emitting facets are that a target may see.

use super::boxes::BoxTree;
use super::supremum::{Bounded, SeenPart, supremum};
use crate::spectrum::Spectrum;
use crate::world::World;
use glam::DVec3;

/// All facets that emit.
pub(super) struct EmittingFacets<'w, S> {
    world: &'w World<S>,
    tree: BoxTree,
    facets: Vec<usize>,
}

impl<'w, S: Spectrum> EmittingFacets<'w, S> {
    pub(super) fn new(world: &'w World<S>) -> Self {
        let emits = |number: &usize| world.facets[*number].emitted_cd_m2 > 0.0;
        let facets: Vec<usize> = (0..world.facets.len()).filter(emits).collect();
        Self { world, tree: BoxTree::of_facets(world, &facets), facets }
    }

    /// The least distance in m of one whose front may be seen from a place to the side `n`, or a
    /// little less; infinite where there is none.
    pub(super) fn distance_m(&self, position: DVec3, n: DVec3) -> f64 {
        let nearness = Nearness { emitting: self, position, n };
        supremum(self.world, &self.tree, &self.facets, &nearness).recip()
    }
}

/// One over the distance, in m^-1.
struct Nearness<'e, 'w, S> {
    emitting: &'e EmittingFacets<'w, S>,
    position: DVec3,
    n: DVec3,
}

impl<S: Spectrum> Nearness<'_, '_, S> {
    fn is_before(&self, place: DVec3) -> bool {
        self.n.dot(place - self.position) > 0.0
    }

    /// Whether the front of a part looks here.
    fn is_shown(&self, part: &SeenPart) -> bool {
        let EmittingFacets { world, facets, .. } = self.emitting;
        let facet = &world.facets[facets[part.facet as usize]];
        facet.front_normal.dot(self.position - part.corners[0]) > 0.0
    }
}

impl<S: Spectrum> Bounded for Nearness<'_, '_, S> {
    fn over_box(&self, _number: u32, low: DVec3, high: DVec3) -> f64 {
        let foremost = DVec3::select(self.n.cmpgt(DVec3::ZERO), high, low);
        let distance_m = (self.position - self.position.clamp(low, high)).length();
        if self.is_before(foremost) { distance_m.recip() } else { 0.0 }
    }

    fn over_part(&self, part: &SeenPart) -> f64 {
        let is_seen = part.corners.iter().any(|corner| self.is_before(*corner));
        let is_seen = is_seen && self.is_shown(part);
        if is_seen { part.distance_m(self.position).recip() } else { 0.0 }
    }

    fn at_centre(&self, part: &SeenPart) -> f64 {
        let centre = part.centre();
        let is_seen = self.is_before(centre) && self.is_shown(part);
        if is_seen { centre.distance(self.position).recip() } else { 0.0 }
    }
}
