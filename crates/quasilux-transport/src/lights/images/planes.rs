//! Mirror planes: the specular facets of a scene, grouped by the plane that they lie in.
//!
//! Every facet is flat, so even a curved mirror is made of planes, of very many. Up to
//! [`FEW_PLANES`] are taken all; where there are more, only those that hold at least [`MIN_SHARE`]
//! of the area of all mirrors are, and the others count as curved: their light is not followed from
//! image to image.

use crate::bsdf::Bsdf;
use crate::spectrum::Spectrum;
use crate::world::World;
use glam::DVec3;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Up to this number of planes are taken whatever their areas.
const FEW_PLANES: usize = 64;
/// Share of the mirrors' area that a plane among many has at least.
const MIN_SHARE: f64 = 0.01;
/// Normals that agree to this, and heights over a common point that agree to this share of the
/// scene's size, are one plane's.
const SAME_PLANE: f64 = 1e-6;
/// Steps of the cosine of incidence in which it is known how much is reflected; and looks in each.
const COSINES: usize = 32;
const LOOKS: usize = 4;
/// Marks facets that lie in no mirror plane.
const NO_PLANE: u32 = u32::MAX;

/// The mirrors of a scene.
pub(crate) struct MirrorPlanes {
    pub(crate) planes: Vec<MirrorPlane>,
    /// Of each facet; empty where nothing reflects.
    plane_of_facet: Vec<u32>,
    /// Facets that reflect and belong to none of the planes.
    pub(crate) curved_facets: usize,
}

/// A plane with the reflecting facets on it; both sides reflect.
pub(crate) struct MirrorPlane {
    /// Unit normal.
    pub(crate) normal: DVec3,
    /// The plane is where `normal . x` has this value, in m.
    offset_m: f64,
    pub(crate) facets: Vec<MirrorFacet>,
    area_m2: f64,
    reflectance: MaxReflectance,
}

/// The most that is reflected in any channel, at cosines of incidence from k / [`COSINES`] to 1.
/// Shared by all planes of one material.
#[derive(Clone)]
struct MaxReflectance(Arc<[f64; COSINES + 1]>);

/// A reflecting triangle.
pub(crate) struct MirrorFacet {
    pub(crate) facet: u32,
    pub(crate) corners: [DVec3; 3],
    /// In the plane, unit, inward: and its product with the points of the edge.
    edges: [(DVec3, f64); 3],
}

impl MirrorPlanes {
    pub(crate) fn new<S: Spectrum>(world: &World<S>) -> Self {
        let mut by_key: BTreeMap<[i64; 4], MirrorPlane> = BTreeMap::new();
        let centre = world.bounds().map_or(DVec3::ZERO, |[low, high]| 0.5 * (low + high));
        let mut facets = 0;
        let mut of_materials = BTreeMap::new();
        for (facet, own) in (0..).zip(&world.facets) {
            let reflectance = of_materials
                .entry(own.material)
                .or_insert_with(|| MaxReflectance::by(world.bsdf_of(own)));
            let area_m2 = own.area_m2();
            let Some(reflectance) = reflectance.as_ref().filter(|_| area_m2 > 0.0) else {
                continue;
            };
            facets += 1;
            let normal = own.front_normal * facing(own.front_normal);
            let height = normal.dot(own.corners()[0] - centre) / world.size_m();
            let key = [normal.x, normal.y, normal.z, height];
            let key = key.map(|x| (x / SAME_PLANE).round_ties_even() as i64);
            let plane = by_key.entry(key).or_insert_with(|| MirrorPlane {
                normal,
                offset_m: normal.dot(own.point([1.0 / 3.0; 3])),
                facets: Vec::new(),
                area_m2: 0.0,
                reflectance: reflectance.clone(),
            });
            plane.area_m2 += area_m2;
            plane.reflectance.join(reflectance);
            plane.facets.push(MirrorFacet::new(facet, own.corners(), own.front_normal));
        }
        Self::choose(by_key.into_values().collect(), facets, world.facets.len())
    }

    /// Leaves out the planes of curved mirrors.
    fn choose(mut planes: Vec<MirrorPlane>, reflecting: usize, facets: usize) -> Self {
        planes.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
        if planes.len() > FEW_PLANES {
            let min_m2 = MIN_SHARE * planes.iter().map(|plane| plane.area_m2).sum::<f64>();
            planes.retain(|plane| plane.area_m2 >= min_m2);
        }
        let mut plane_of_facet = Vec::new();
        if !planes.is_empty() {
            plane_of_facet.resize(facets, NO_PLANE);
        }
        let mut flat = 0;
        for (number, plane) in (0..).zip(&planes) {
            flat += plane.facets.len();
            for mirror in &plane.facets {
                plane_of_facet[mirror.facet as usize] = number;
            }
        }
        Self { planes, plane_of_facet, curved_facets: reflecting - flat }
    }

    /// The plane that a facet lies in, if it is one of these mirrors.
    pub(crate) fn of_facet(&self, facet: u32) -> Option<u32> {
        let plane = self.plane_of_facet.get(facet as usize).copied()?;
        (plane != NO_PLANE).then_some(plane)
    }
}

impl MaxReflectance {
    /// By a surface; `None` where it shows no images.
    fn by<S: Spectrum>(bsdf: &Bsdf<S>) -> Option<Self> {
        let mut most = [0.0_f64; COSINES + 1];
        let mut so_far = 0.0_f64;
        for look in (0..=COSINES * LOOKS).rev() {
            let cos = look as f64 / (COSINES * LOOKS) as f64;
            for front in [true, false] {
                so_far = so_far.max(bsdf.image_reflectance(cos, front)?.max_channel());
            }
            most[look / LOOKS] = so_far;
        }
        (so_far > 0.0).then(|| Self(Arc::new(most)))
    }

    /// By one or the other.
    fn join(&mut self, other: &Self) {
        if !Arc::ptr_eq(&self.0, &other.0) {
            self.0 = Arc::new(std::array::from_fn(|step| self.0[step].max(other.0[step])));
        }
    }
}

impl MirrorPlane {
    /// The most that is reflected in any channel of light whose cosine of incidence is this or
    /// larger.
    pub(crate) fn max_reflected(&self, min_cos: f64) -> f64 {
        self.reflectance.0[(min_cos.clamp(0.0, 1.0) * COSINES as f64) as usize]
    }

    /// Signed height of a point over the plane, in m.
    pub(crate) fn height_m(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset_m
    }

    /// Where a point is seen in the mirror.
    pub(crate) fn mirrored(&self, point: DVec3) -> DVec3 {
        point - self.normal * (2.0 * self.height_m(point))
    }

    /// The facet that holds a point of the plane, or comes within `slack_m` of it.
    pub(crate) fn facet_at(&self, point: DVec3, slack_m: f64) -> Option<&MirrorFacet> {
        self.facets.iter().find(|facet| facet.holds(point, slack_m))
    }
}

impl MirrorFacet {
    fn new(facet: u32, corners: [DVec3; 3], normal: DVec3) -> Self {
        let edge = |i: usize| {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            let inward = normal.cross(to - from).normalize_or_zero();
            (inward, inward.dot(from))
        };
        Self { facet, corners, edges: [edge(0), edge(1), edge(2)] }
    }

    fn holds(&self, point: DVec3, slack_m: f64) -> bool {
        self.edges.iter().all(|(inward, offset)| inward.dot(point) - offset >= -slack_m)
    }

    pub(crate) fn centroid(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (a + b + c) * (1.0 / 3.0)
    }
}

/// The sign that gives opposite normals one direction: their largest component positive.
fn facing(normal: DVec3) -> f64 {
    let size = normal.abs();
    let largest = if size.x > size.y.max(size.z) - SAME_PLANE {
        normal.x
    } else if size.y > size.z - SAME_PLANE {
        normal.y
    } else {
        normal.z
    };
    1.0_f64.copysign(largest)
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::Mirrors;
    use super::*;

    /// Two sides of a plate are one plane, whichever way its triangles are turned; a tilted one is
    /// another, and what is diffuse is none.
    #[test]
    fn facets_in_one_plane_are_one_mirror() {
        let mut mirrors = Mirrors::new(0.9);
        let [o, x, y, z] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        mirrors.add([o, x, x + y, y]);
        mirrors.add([x * 3.0, y + x * 3.0, x * 4.0 + y, x * 4.0]);
        mirrors.add([z, z + x, x + y + z * 1.1, y + z * 1.1]);
        mirrors.add_diffuse([z * 2.0, x + z * 2.0, x + y + z * 2.0, y + z * 2.0]);
        let planes = MirrorPlanes::new(&mirrors.world());
        let facets: Vec<usize> = planes.planes.iter().map(|plane| plane.facets.len()).collect();
        assert_eq!((facets, planes.curved_facets), (vec![4, 2], 0));
        assert_eq!(
            (planes.of_facet(3), planes.of_facet(5), planes.of_facet(6)),
            (Some(0), Some(1), None)
        );
        let plane = &planes.planes[0];
        assert_eq!(plane.mirrored(DVec3::new(0.3, 0.2, 0.7)), DVec3::new(0.3, 0.2, -0.7));
        let facet = |x, y, slack_m| {
            plane.facet_at(DVec3::new(x, y, 0.0), slack_m).map(|mirror| mirror.facet)
        };
        assert_eq!(
            [facet(0.7, 0.2, 0.0), facet(0.2, 0.7, 0.0), facet(1.1, 0.5, 0.0)],
            [Some(0), Some(1), None]
        );
        assert_eq!(facet(1.0 + 1e-9, 0.5, 1e-8), Some(0));
    }

    /// A finely curved mirror is no set of planes, but a flat one beside it still is one.
    #[test]
    fn many_small_planes_are_a_curved_mirror() {
        let mut mirrors = Mirrors::new(0.9);
        let at = |i: u32, y: f64| {
            let (sin, cos) = libm::sincos(f64::from(i) * 0.01);
            DVec3::new(cos, y, sin)
        };
        for i in 0..300 {
            mirrors.add([at(i, 0.0), at(i + 1, 0.0), at(i + 1, 1.0), at(i, 1.0)]);
        }
        mirrors.add(
            [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y].map(|p| p - DVec3::Z * 0.3),
        );
        let planes = MirrorPlanes::new(&mirrors.world());
        assert_eq!((planes.planes.len(), planes.curved_facets), (1, 600));
    }
}
