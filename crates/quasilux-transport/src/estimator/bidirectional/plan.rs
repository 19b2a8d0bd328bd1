//! Numbers of samples of each technique, frozen before the first one, and how each target counts
//! photons.
//!
//! For each index every target gets one eye path, and is joined to the vertices of all light
//! subpaths of that index: surely where a join gives much, else with a chance in proportion to it.
//! Subpaths that serve only some of the targets are no even part of a point set, and made the error
//! larger.

use super::asked_luminaires::nearest_luminaire_m;
use super::nearest_emitter::EmittingFacets;
use crate::bsdf::Bsdf;
use crate::context::Context;
use crate::control::watch::{POINTS_AT_ONCE, Watch};
use crate::importance::OpeningView;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::world::grid_plane::GridPlane;
use crate::world::{Interaction, RayOrigin, World};
use glam::DVec3;
use serde::Serialize;
use std::f64::consts::{PI, TAU};

/// Light subpaths of an index, a power of two. In rooms with a hundred sensor points, of 8, 32 and
/// 128 none has the least error in a given time everywhere; 32 are never far from it.
pub(super) const SUBPATHS: u64 = 32;
/// The part of the surfaces of eye paths that are connected to light vertices. All of them made the
/// error of open rooms larger, and that of rooms behind bends hardly smaller.
pub(super) const CONNECTED: f64 = 0.25;

/// Surfaces of an eye path that are left with more than what remains of its light.
pub(super) const FAVOURED: usize = 2;
/// By this factor, where that is no more than a certainty. What the first surfaces send on decides
/// the error in cubes and mirrored rooms; four times, or a third surface, is hardly better.
const FAVOUR: f64 = 2.0;
/// The radius of a disc in m, and as a share of the scene's size at most.
const RADIUS_M: f64 = 0.1;
const SHARE_OF_SIZE: f64 = 1.0 / 64.0;
/// The radius of a disc for light straight from lights with an area, as a share of the distance of
/// the nearest at most: over that distance their illuminance changes.
const SHARE_OF_DISTANCE: f64 = 0.0625;
/// Directions in which walls are looked for in the plane of a disc.
const LOOKS: u32 = 64;

/// Who finds the light of a kind of lights past narrow surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub(super) enum FoundBy {
    /// Eye paths, which run into it: no photon needs to blur it.
    EyePaths,
    Photons,
}

impl FoundBy {
    pub(super) const BOTH: [Self; 2] = [Self::EyePaths, Self::Photons];

    /// Where a path that runs into the light finds `met_lx` at most, and a photon gives this much
    /// to a disc.
    pub(super) fn new(met_lx: f64, on_a_disc_lx: f64) -> Self {
        if met_lx <= on_a_disc_lx { Self::EyePaths } else { Self::Photons }
    }
}

/// The area in m^2 of a disc in the open.
pub(super) fn largest_disc_m2<S: Spectrum>(world: &World<S>) -> f64 {
    let radius_m = largest_radius_m(world);
    PI * radius_m * radius_m
}

pub(super) fn largest_radius_m<S: Spectrum>(world: &World<S>) -> f64 {
    RADIUS_M.min(SHARE_OF_SIZE * world.size_m())
}

/// A disc that photons are counted on.
pub(super) struct PhotonDisc {
    pub(super) radius_m: f64,
    pub(super) area_m2: f64,
    /// [`Receiver::near_part`].
    pub(super) near_part: f64,
}

impl PhotonDisc {
    /// Around a place with the normal `n`, where the nearest wall in its plane is so far away.
    pub(super) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        emitting: &EmittingFacets<'_, S>,
        position: DVec3,
        n: DVec3,
        free_m: f64,
    ) -> Self {
        let world = &context.world;
        let radius_m = largest_radius_m(world).min(free_m).max(world.hair_m());
        let nearest_m = nearest_luminaire_m(&context.lights.area_luminaires, position, n);
        let nearest_m = nearest_m.min(emitting.distance_m(position, n));
        let near_m = (SHARE_OF_DISTANCE * nearest_m).max(world.hair_m());
        let share = (near_m / radius_m).min(1.0);
        Self { radius_m, area_m2: PI * radius_m * radius_m, near_part: share * share }
    }
}

/// Directions evenly around in the plane with the normal `n`; `looks` is their number.
pub(super) fn around(n: DVec3, looks: u32) -> impl Iterator<Item = DVec3> {
    let across = n.any_orthonormal_vector();
    let beside = n.cross(across);
    (0..looks).map(move |look| {
        let (sin, cos) = libm::sincos(TAU * f64::from(look) / f64::from(looks));
        across * cos + beside * sin
    })
}

/// Half a join for each light subpath where its vertices lie evenly, until pilots know more
/// (`join_rate`); in m^2, see [`Receiver::per_sure_m2`].
pub(super) fn per_sure_before_pilots_m2<S: Spectrum>(world: &World<S>) -> f64 {
    let area_m2: f64 = world.facets.iter().map(|facet| facet.area_m2()).sum();
    0.5 * area_m2.max(f64::MIN_POSITIVE) / TAU
}

/// Between a target and a surface.
pub(super) struct JoinEdge {
    /// At the target.
    pub(super) cos: f64,
    /// At the surface.
    pub(super) cos_there: f64,
    /// Of its length.
    pub(super) square_m2: f64,
    pub(super) is_narrow: bool,
}

/// How photons are counted at a target, and joined to it.
#[derive(Clone, Debug)]
pub(super) struct Receiver {
    pub(super) target: Target,
    pub(super) position: DVec3,
    /// Unit normal of the side that counts.
    pub(super) n: DVec3,
    /// Of the disc or the cell that photons are counted on.
    pub(super) area_m2: f64,
    /// Of a disc.
    pub(super) radius_m: Option<f64>,
    /// The part of the disc, around the same centre, on which photons count that come straight from
    /// lights with an area; 1 for cells.
    pub(super) near_part: f64,
    /// How many times brighter radiance is than in air, at most: in glass by the square of its
    /// index.
    pub(super) radiance_scale: f64,
    /// Light subpaths of an index.
    pub(super) subpaths: u64,
    /// Photons of an index that count where they come from narrow surfaces with light that eye
    /// paths hardly find.
    pub(super) photons: u64,
    /// In m^2: a join is made for certain where cosines over squared distance are one over it.
    pub(super) per_sure_m2: f64,
    /// How it sees outside.
    pub(super) view: OpeningView,
    /// The most in lx that a sample adds to one index (`caps`), for assertions.
    pub(super) most_lx: f64,
}

/// Receivers of all targets; `None` when the observer stopped it.
pub(super) fn receivers<S: Spectrum>(
    context: &Context<'_, S>,
    targets: &[Target],
    watch: &mut Watch<'_>,
) -> Option<Vec<Receiver>> {
    let world = &context.world;
    let per_sure_m2 = per_sure_before_pilots_m2(world);
    let emitting = EmittingFacets::new(world);
    let most_scale = world.bsdfs().iter().map(Bsdf::scale_inside).fold(1.0, f64::max);
    let receiver = |it: &Target| Receiver::new(context, it, per_sure_m2, most_scale, &emitting);
    watch.map_in_parts(targets, POINTS_AT_ONCE, receiver)
}

/// The chance to go on from a surface with this number in an eye path over what remains of its
/// light, where that is no more than a certainty; the target is 0.
pub(super) fn favour(number: usize) -> f64 {
    if number <= FAVOURED { FAVOUR } else { 1.0 }
}

/// The light subpath that the eye path of a target with this index is connected to.
///
/// The first digits of coordinates follow the number of a subpath, and those of an eye path the
/// lowest digits of its index. From as many indices as there are subpaths to the next the pairs are
/// shifted by one: so each first part of the eye paths meets all subpaths alike, in as many steps.
pub(super) fn connected(target: usize, index: u64, subpaths: u64) -> u64 {
    (target as u64).wrapping_add(index).wrapping_add(index / subpaths) % subpaths
}

/// Surroundings of a point with the normal `n`, as rays meet them.
struct Around {
    /// How far it is to the nearest wall in its plane.
    free_m: f64,
    /// How many times brighter radiance is there than in air, as surfaces tell that are met from
    /// inside.
    radiance_scale: f64,
}

impl Around {
    fn new<S: Spectrum>(world: &World<S>, from: RayOrigin, n: DVec3) -> Self {
        let met = around(n, LOOKS).filter_map(|it| world.trace(from, it));
        let met: Vec<Interaction> = met.collect();
        let free_m = met.iter().map(|at| at.distance_m).fold(f64::INFINITY, f64::min);
        let before = world.trace(from, n);
        let from_inside = met.iter().chain(&before).filter(|at| !at.front);
        let scales = from_inside.map(|at| world.bsdf(at).scale_inside());
        Self { free_m, radiance_scale: scales.fold(1.0, f64::max) }
    }
}

impl Receiver {
    fn new<S: Spectrum>(
        context: &Context<'_, S>,
        target: &Target,
        per_sure_m2: f64,
        most_scale: f64,
        emitting: &EmittingFacets<'_, S>,
    ) -> Self {
        let world = &context.world;
        match *target {
            Target::Point { position, normal: n } => {
                let from = world.ray_origin_of_sensor(position, n);
                let Around { free_m, radiance_scale } = Around::new(world, from, n);
                let disc = PhotonDisc::new(context, emitting, from.position(), n, free_m);
                Self {
                    target: *target,
                    position: from.position(),
                    n,
                    area_m2: disc.area_m2,
                    radius_m: Some(disc.radius_m),
                    near_part: disc.near_part,
                    radiance_scale,
                    subpaths: SUBPATHS,
                    photons: SUBPATHS,
                    per_sure_m2,
                    view: OpeningView::UNKNOWN,
                    most_lx: f64::INFINITY,
                }
            }
            Target::Cell { grid, cell } => {
                let area_m2 = GridPlane::new(world, &grid).cell_area_m2();
                let position = grid.point_in_cell(cell, [0.5; 2]);
                Self {
                    target: *target,
                    position,
                    n: grid.normal,
                    area_m2,
                    radius_m: None,
                    near_part: 1.0,
                    // A part of it may hang in glass.
                    radiance_scale: most_scale,
                    subpaths: SUBPATHS,
                    photons: SUBPATHS,
                    per_sure_m2,
                    view: OpeningView::UNKNOWN,
                    most_lx: f64::INFINITY,
                }
            }
        }
    }

    /// Where a ray leaves from that starts at it: in a cell at a place by two coordinates.
    pub(super) fn origin<S: Spectrum>(
        &self,
        world: &World<S>,
        u: impl FnOnce() -> [f64; 2],
    ) -> RayOrigin {
        let place = match self.target {
            Target::Point { position, .. } => position,
            Target::Cell { grid, cell } => grid.point_in_cell(cell, u()),
        };
        world.ray_origin_of_sensor(place, self.n)
    }

    /// Asserts that a sample adds no more to an index than its caps say.
    pub(super) fn assert_capped<S: Spectrum>(&self, technique: &str, light: S) {
        let lx = light.luminance();
        // What is not a number is counted elsewhere.
        debug_assert!(
            lx.is_nan() || lx <= self.most_lx * (1.0 + 1e-9),
            "{technique} adds {lx} lx at {:?}, at most {} lx were expected",
            self.position,
            self.most_lx
        );
    }

    /// Photons that count in weights, for each eye path, over those that land on a square metre:
    /// all of them where the last surface is narrow and eye paths hardly find the light past it.
    pub(super) fn photons(&self, is_narrow: bool, found: FoundBy) -> f64 {
        let all = is_narrow && found == FoundBy::Photons;
        self.area_m2 * if all { self.photons as f64 } else { 1.0 }
    }

    /// Photons that are traced for each eye path.
    pub(super) fn traced(&self, is_narrow: bool, found: FoundBy) -> f64 {
        let all = is_narrow && found == FoundBy::Photons;
        (if all { self.photons } else { self.subpaths }) as f64
    }

    /// Joins that are made of a light vertex, on average, for each eye path.
    pub(super) fn joins(&self, edge: &JoinEdge) -> f64 {
        self.subpaths as f64 * self.join_probability(edge)
    }

    /// Probability of a join: by its cosines over squared distance. Narrow surfaces may send more
    /// the lower, so of them the cosine is left out.
    pub(super) fn join_probability(&self, edge: &JoinEdge) -> f64 {
        let cos_there = if edge.is_narrow { 1.0 } else { edge.cos_there };
        self.join_probability_of(edge.cos * cos_there / edge.square_m2)
    }

    /// Probability of a join by its cosines over squared distance, in m^-2.
    pub(super) fn join_probability_of(&self, per_m2: f64) -> f64 {
        (per_m2 * self.per_sure_m2).min(1.0)
    }

    /// The part of its area on which photons count.
    pub(super) fn straight_part(&self, is_straight_from_area: bool) -> f64 {
        if is_straight_from_area { self.near_part } else { 1.0 }
    }

    /// The area in m^2 on which photons count that come straight from a light.
    pub(super) fn straight_m2(&self, is_of_area: bool) -> f64 {
        self.area_m2 * self.straight_part(is_of_area)
    }

    /// The radius in m of the part of a disc on which photons count that come straight from lights
    /// with an area; 0 of a cell.
    pub(super) fn straight_radius_m(&self) -> f64 {
        self.radius_m.map_or(0.0, |radius_m| radius_m * self.near_part.sqrt())
    }

    pub(super) fn is_cell(&self) -> bool {
        self.radius_m.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eye paths whose coordinates begin alike, those of every 32nd index, meet all subpaths
    /// equally often: each once in 1024 indices, and none twice before. With one subpath for all of
    /// them the error of rooms with two lamps stopped to shrink at 0.1 %.
    #[test]
    fn eye_paths_that_begin_alike_meet_all_subpaths() {
        for (target, first) in [(0, 0), (5, 1), (1000, 31)] {
            let alike = (0..SUBPATHS).map(|step| first + step * SUBPATHS);
            let mut met: Vec<u64> = alike.map(|index| connected(target, index, SUBPATHS)).collect();
            met.sort_unstable();
            assert!(met.into_iter().eq(0..SUBPATHS), "{target}, {first}");
        }
    }
}
