//! The scene as rays see it: facets, the bounding volume hierarchy over them, and the origins of
//! rays.

pub(crate) mod flight;
pub(crate) mod frame;
pub(crate) mod grid_plane;
pub(crate) mod panes;
pub(crate) mod subdivision;
pub(crate) mod vertex;
pub(crate) mod visibility;

use crate::bsdf::Bsdf;
use crate::prepared::PreparedScene;
use crate::spectrum::Spectrum;
use crate::world::frame::Frame;
use glam::DVec3;
use quasilux_bvh::{Hit, Ray, RayQuery, SimdLevel, TriangleBvh};
use quasilux_sampling::warp::sample_triangle;
use quasilux_scene::Light;
use std::sync::Arc;

/// Hits are drawn this share of the way to their facet's centroid, so that none lies on an edge
/// and a neighbour's plane cannot be on the wrong side of it.
const INWARD: f64 = 1.0 / (1_u64 << 34) as f64;
/// Rays start this share of the scene's size in front of their facet.
const OFFSET: f64 = 1.0 / (1_u64 << 45) as f64;
/// Sensor points stand this share of the scene's size in front of where they were put: a hair.
const HAIR: f64 = 1.0 / (1_u64 << 30) as f64;
/// Offsets are at least this share of the largest coordinate: a few units of its last place.
const MIN_OFFSET: f64 = 8.0 * f64::EPSILON;
/// Shadow rays end this share of their length before the light, which may lie on a surface.
const SHORTENING: f64 = 1e-9;

/// A triangle with all that transport needs to know of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet {
    corners: [DVec3; 3],
    /// Unit normal of the front side.
    pub(crate) front_normal: DVec3,
    /// Which of the world's [`Bsdf`]s.
    pub(crate) material: u32,
    /// Luminance of the front side in cd/m^2, 0 for most.
    pub(crate) emitted_cd_m2: f64,
}

/// A place on a facet, seen from one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interaction {
    pub(crate) facet: u32,
    pub(crate) barycentric: [f64; 3],
    pub(crate) position: DVec3,
    /// Unit geometric normal on the side that was hit.
    pub(crate) n: DVec3,
    /// Whether the front side was hit.
    pub(crate) front: bool,
    /// Distance of the ray that found it, in m.
    pub(crate) distance_m: f64,
}

/// Where rays leave from: a surface, or a free point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayOrigin {
    position: DVec3,
    /// The facet that rays from here never hit; `u32::MAX` for none.
    facet: u32,
}

/// A ray that went through a pane.
pub(crate) struct BeyondPane<S> {
    /// The share of light that the pane lets through.
    pub(crate) transmitted: S,
    pub(crate) query: RayQuery,
}

/// The scene as rays see it.
pub(crate) struct World<S> {
    pub(crate) facets: Vec<Facet>,
    bsdfs: Vec<Bsdf<S>>,
    /// Largest share of the luminous flux from all sides that each material does not absorb.
    most_kept: Vec<f64>,
    /// Largest share in any channel that each material does not absorb.
    most_survives: Vec<f64>,
    bvh: Arc<TriangleBvh>,
    /// The emitting facets again, where some lie flush in another surface: they come first there.
    flush_emitters: Option<FlushEmitters>,
    has_panes: bool,
    bounds: Option<[DVec3; 2]>,
    /// The largest extent in m.
    size_m: f64,
    offset_m: f64,
    hair_m: f64,
}

/// Emitting facets that lie in the plane of another surface, as a panel drawn onto a ceiling does.
struct FlushEmitters {
    bvh: TriangleBvh,
    /// Facet of each triangle of the hierarchy.
    facets: Vec<u32>,
}

impl<S: Spectrum> World<S> {
    pub(crate) fn new<'a>(scene: impl Into<PreparedScene<'a>>, simd: SimdLevel) -> Self {
        let prepared = scene.into();
        let scene = prepared.scene();
        let mesh = &scene.mesh;
        let mut facets: Vec<Facet> = (0..mesh.triangles.len() as u32)
            .map(|triangle| Facet {
                corners: mesh.corners(triangle),
                front_normal: mesh.front_normal(triangle),
                material: mesh.material_of[triangle as usize],
                emitted_cd_m2: 0.0,
            })
            .collect();
        for light in &scene.lights {
            if let Light::Area(area) = light {
                for &triangle in &area.triangles {
                    facets[triangle as usize].emitted_cd_m2 += area.luminance_cd_m2;
                }
            }
        }
        let bounds = mesh.bounds();
        let [low, high] = bounds.unwrap_or([DVec3::ZERO, DVec3::ONE]);
        let size_m = (high - low).length();
        let min_m = MIN_OFFSET * low.abs().max(high.abs()).max_element();
        let mut world = Self {
            facets,
            bsdfs: scene.materials.iter().map(|material| Bsdf::new(&material.bsdf)).collect(),
            most_kept: scene.materials.iter().map(|of| of.bsdf.most_kept().luminance()).collect(),
            most_survives: scene
                .materials
                .iter()
                .map(|of| of.bsdf.most_kept().max_channel())
                .collect(),
            bvh: prepared.hierarchy_for(simd),
            flush_emitters: None,
            has_panes: false,
            bounds,
            size_m,
            offset_m: (OFFSET * size_m).max(min_m),
            hair_m: (HAIR * size_m).max(4.0 * min_m),
        };
        world.flush_emitters = FlushEmitters::new(&world, simd);
        let is_pane = |facet: &Facet| world.bsdf_of(facet).straight_transmittance(1.0).is_some();
        world.has_panes = world.facets.iter().any(is_pane);
        world
    }

    /// The box around all facets; `None` where there are none.
    pub(crate) fn bounds(&self) -> Option<[DVec3; 2]> {
        self.bounds
    }

    /// A length that is nothing beside the scene, in m.
    pub(crate) fn hair_m(&self) -> f64 {
        self.hair_m
    }

    /// The largest extent, in m.
    pub(crate) fn size_m(&self) -> f64 {
        self.size_m
    }

    pub(crate) fn facet(&self, at: &Interaction) -> &Facet {
        &self.facets[at.facet as usize]
    }

    /// How the surface scatters there.
    #[inline]
    pub(crate) fn bsdf(&self, at: &Interaction) -> &Bsdf<S> {
        self.bsdf_of(self.facet(at))
    }

    /// The local frame of that on the side that was hit.
    #[inline]
    pub(crate) fn frame(&self, at: &Interaction) -> Frame {
        self.bsdf(at).up().map_or_else(|| Frame::around(at.n), |up| Frame::upright(at.n, up))
    }

    /// How all materials scatter, in the order of their numbers.
    pub(crate) fn bsdfs(&self) -> &[Bsdf<S>] {
        &self.bsdfs
    }

    /// How a facet scatters.
    #[inline]
    pub(crate) fn bsdf_of(&self, facet: &Facet) -> &Bsdf<S> {
        &self.bsdfs[facet.material as usize]
    }

    /// Whether light is reflected or refracted to single directions anywhere.
    pub(crate) fn has_specular_facets(&self) -> bool {
        self.facets.iter().any(|facet| self.bsdf_of(facet).is_specular())
    }

    /// Luminous flux that a facet does not absorb, at most, over what meets it:
    /// [`quasilux_scene::Bsdf::most_kept`].
    pub(crate) fn most_kept_by(&self, facet: &Facet) -> f64 {
        self.most_kept[facet.material as usize]
    }

    /// Largest share in any channel that a facet does not absorb: the survival probability there.
    pub(crate) fn most_survives_at(&self, facet: &Facet) -> f64 {
        self.most_survives[facet.material as usize]
    }

    /// Whether any material sends on more light than it gets.
    pub(crate) fn may_send_on_more(&self) -> bool {
        self.most_survives.iter().any(|share| *share > 1.0)
    }

    /// Whether any material does not absorb all of it.
    pub(crate) fn keeps_light(&self) -> bool {
        self.most_kept.iter().any(|share| *share > 0.0)
    }

    /// Luminance in cd/m^2 that the place emits toward the side it was hit from.
    pub(crate) fn emitted_cd_m2(&self, at: &Interaction) -> f64 {
        if at.front { self.facet(at).emitted_cd_m2 } else { 0.0 }
    }

    /// The first facet that a ray from `from` along the unit vector `direction` meets.
    pub(crate) fn trace(&self, from: RayOrigin, direction: DVec3) -> Option<Interaction> {
        let RayQuery { ray, excluded } = from.query(direction);
        let hit = self.bvh.closest_hit(&ray, &excluded)?;
        let hit = self.unless_flush(hit, &ray, from.facet);
        Some(self.interaction(&hit, direction))
    }

    /// Whether nothing stands between `from` and the point at `distance_m` along `direction`.
    /// `target` is the facet the point lies on, `u32::MAX` for none.
    pub(crate) fn is_visible(
        &self,
        from: RayOrigin,
        direction: DVec3,
        distance_m: f64,
        target: u32,
    ) -> bool {
        let RayQuery { ray, excluded } = from.shadow_ray(direction, distance_m, target);
        !self.bvh.is_occluded(&ray, &excluded)
    }

    /// [`Self::trace`] of many rays made by [`RayOrigin::query`], in their order.
    pub(crate) fn trace_all(
        &self,
        queries: &[RayQuery],
        hits: &mut Vec<Option<Hit>>,
        found: &mut Vec<Option<Interaction>>,
    ) {
        self.closest_hit_batch(queries, hits);
        found.clear();
        found.extend(queries.iter().zip(hits).map(|(query, hit)| {
            let hit = self.unless_flush((*hit)?, &query.ray, query.excluded[0]);
            Some(self.interaction(&hit, query.ray.direction))
        }));
    }

    /// [`Self::is_visible`] of many rays made by [`RayOrigin::shadow_ray`], in their order.
    pub(crate) fn are_visible(&self, shadow_rays: &[RayQuery], visible: &mut Vec<bool>) {
        visible.clear();
        visible.resize(shadow_rays.len(), false);
        self.bvh.occluded_batch(shadow_rays, visible);
        visible.iter_mut().for_each(|visible| *visible = !*visible);
    }

    /// The first facets that many rays meet, in their order.
    pub(crate) fn closest_hit_batch(&self, queries: &[RayQuery], hits: &mut Vec<Option<Hit>>) {
        hits.clear();
        hits.resize(queries.len(), None);
        self.bvh.closest_hit_batch(queries, hits);
    }

    /// Where a ray goes on behind the pane that it meets; `None` where it meets something else.
    pub(crate) fn beyond_pane(&self, query: &RayQuery, hit: &Hit) -> Option<BeyondPane<S>> {
        let RayQuery { ray, excluded } = query;
        let facet = &self.facets[hit.triangle as usize];
        let cos = facet.front_normal.dot(ray.direction);
        let transmitted = self.bsdf_of(facet).straight_transmittance(cos.abs())?;
        let origin = ray.at(hit.distance) + facet.front_normal * (self.offset_m * cos.signum());
        let ray = Ray::new(origin, ray.direction).up_to(ray.t_max - hit.distance);
        Some(BeyondPane {
            transmitted,
            query: RayQuery { ray, excluded: [hit.triangle, excluded[1]] },
        })
    }

    /// Whether there are panes.
    pub(crate) fn has_panes(&self) -> bool {
        self.has_panes
    }

    /// The hit, or the flush emitter that comes first there.
    fn unless_flush(&self, hit: Hit, ray: &Ray, from: u32) -> Hit {
        let flush = self.flush_emitters.as_ref();
        flush.and_then(|flush| flush.before(&hit, ray, from)).unwrap_or(hit)
    }

    #[inline]
    fn interaction(&self, hit: &Hit, direction: DVec3) -> Interaction {
        let front = self.facets[hit.triangle as usize].front_normal.dot(direction) < 0.0;
        let at = self.interaction_on(hit.triangle, front, hit.barycentric);
        Interaction { distance_m: hit.distance, ..at }
    }

    /// The place with these weights on one side of a facet, as if a ray of no length had met it.
    #[inline]
    pub(crate) fn interaction_on(
        &self,
        number: u32,
        front: bool,
        weights: [f64; 3],
    ) -> Interaction {
        let facet = &self.facets[number as usize];
        let barycentric = weights.map(|b| b + (1.0 / 3.0 - b) * INWARD);
        Interaction {
            facet: number,
            barycentric,
            position: facet.point(barycentric),
            n: if front { facet.front_normal } else { -facet.front_normal },
            front,
            distance_m: 0.0,
        }
    }

    /// Where rays leave from that go on from a hit on the side it was hit from.
    pub(crate) fn ray_origin(&self, at: &Interaction) -> RayOrigin {
        RayOrigin { position: at.position + at.n * self.offset_m, facet: at.facet }
    }

    /// Where rays leave from that go on from a hit on the other side.
    pub(crate) fn ray_origin_behind(&self, at: &Interaction) -> RayOrigin {
        RayOrigin { position: at.position - at.n * self.offset_m, facet: at.facet }
    }

    /// Where rays leave from a facet's front side.
    pub(crate) fn ray_origin_on_front(&self, facet: u32, position: DVec3) -> RayOrigin {
        let n = self.facets[facet as usize].front_normal;
        RayOrigin { position: position + n * self.offset_m, facet }
    }

    /// Where rays leave from a point of a facet, on the side `n`.
    pub(crate) fn ray_origin_on_side(&self, facet: u32, position: DVec3, n: DVec3) -> RayOrigin {
        RayOrigin { position: position + n * self.offset_m, facet }
    }

    /// Where rays leave from a sensor point: a hair in front of it.
    pub(crate) fn ray_origin_of_sensor(&self, position: DVec3, normal: DVec3) -> RayOrigin {
        RayOrigin { position: position + normal * self.hair_m, facet: u32::MAX }
    }

    /// Where rays leave from a point-like light along `direction`: it may lie on a surface.
    pub(crate) fn ray_origin_of_light(&self, position: DVec3, direction: DVec3) -> RayOrigin {
        RayOrigin { position: position + direction * self.hair_m, facet: u32::MAX }
    }

    /// The facet nearest to a point that a sensor with this normal can lie on, within a hair;
    /// among several the one that faces the normal most.
    pub(crate) fn facet_under(&self, position: DVec3, normal: DVec3) -> Option<Interaction> {
        let reach = 4.0 * self.hair_m;
        let from = RayOrigin { position: position + normal * reach, facet: u32::MAX };
        let ray = Ray::new(from.position, -normal).up_to(2.0 * reach);
        let hit = self.bvh.closest_hit(&ray, &[])?;
        Some(self.interaction(&hit, -normal))
    }
}

impl FlushEmitters {
    /// Looks a hair in front of and behind each emitting facet, at 16 places spread over it.
    fn new<S: Spectrum>(world: &World<S>, simd: SimdLevel) -> Option<Self> {
        let emits = |&facet: &u32| world.facets[facet as usize].emitted_cd_m2 > 0.0;
        let facets: Vec<u32> = (0..world.facets.len() as u32).filter(emits).collect();
        let corners = facets.iter().map(|&facet| world.facets[facet as usize].corners).collect();
        let is_flush = |&facet: &u32| {
            let own = &world.facets[facet as usize];
            (0..16).any(|place| {
                let u = [f64::from(place / 4), f64::from(place % 4)].map(|i| (i + 0.5) / 4.0);
                let start = own.point(sample_triangle(u)) + own.front_normal * world.hair_m;
                let probe = Ray::new(start, -own.front_normal).up_to(2.0 * world.hair_m);
                world.bvh.is_occluded(&probe, &[facet])
            })
        };
        let found = facets.iter().any(is_flush);
        found.then(|| Self { bvh: TriangleBvh::build_for(corners, simd), facets })
    }

    /// The emitting facet that a ray meets together with `hit`, or just behind it.
    fn before(&self, hit: &Hit, ray: &Ray, from: u32) -> Option<Hit> {
        let reach = ray.up_to(hit.distance * (1.0 + SHORTENING));
        let found = self.bvh.closest_hit(&reach, &[])?;
        let triangle = self.facets[found.triangle as usize];
        (triangle != from).then_some(Hit { triangle, ..found })
    }
}

impl Facet {
    pub(crate) fn corners(&self) -> [DVec3; 3] {
        self.corners
    }

    /// The point with these barycentric weights.
    pub(crate) fn point(&self, [a, b, c]: [f64; 3]) -> DVec3 {
        self.corners[0] * a + self.corners[1] * b + self.corners[2] * c
    }

    /// The area in m^2.
    pub(crate) fn area_m2(&self) -> f64 {
        let [a, b, c] = self.corners;
        0.5 * (b - a).cross(c - a).length()
    }

    /// The longest edge in m.
    pub(crate) fn longest_edge_m(&self) -> f64 {
        let [a, b, c] = self.corners;
        (b - a).length().max((c - b).length()).max((a - c).length())
    }
}

impl RayOrigin {
    /// The starting point in m.
    pub(crate) fn position(&self) -> DVec3 {
        self.position
    }

    /// The facet that rays from here never hit, if any.
    pub(crate) fn facet(&self) -> Option<u32> {
        (self.facet != u32::MAX).then_some(self.facet)
    }

    /// The ray from here along a unit vector.
    pub(crate) fn query(&self, direction: DVec3) -> RayQuery {
        RayQuery { ray: Ray::new(self.position, direction), excluded: [self.facet, RayQuery::NONE] }
    }

    /// The ray from here to the point at `distance_m` along `direction`, which lies on the facet
    /// `target`, `u32::MAX` for none.
    pub(crate) fn shadow_ray(&self, direction: DVec3, distance_m: f64, target: u32) -> RayQuery {
        let ray = Ray::new(self.position, direction).up_to(distance_m * (1.0 - SHORTENING));
        RayQuery { ray, excluded: [self.facet, target] }
    }
}
