//! Places of the sun that light is asked from together, for hours that are told later.

use crate::lights::outside::OutsideLight;
use crate::lights::sun_ways::{SunPlace, SunWay, SunWays};
use crate::spectrum::Spectrum;
use crate::world::vertex::Vertex;
use crate::world::visibility::LightSample;
use glam::{DVec3, Vec3};
use std::sync::Arc;

/// Number of suns asked at a vertex where nothing is known.
const ASKED: f64 = 32.0;
/// Share of the vertices at which one sun is asked on ways on which none was found to shine: the
/// ones asked may have missed it.
const RARELY: f64 = 0.125;

/// Directions in which the sun may stand.
#[derive(Clone, Debug, Default)]
pub(crate) struct Suns {
    /// Unit vectors towards them.
    directions: Vec<DVec3>,
    /// Coordinates of the same vectors, for loops over all suns.
    coordinates: [Vec<f32>; 3],
    /// How often they were found to shine; `None` while that is learnt.
    ways: Option<Arc<SunWays>>,
}

/// Numbers of suns above the horizon of a vertex; working space.
#[derive(Clone, Debug, Default)]
pub(crate) struct SunChoice {
    /// Class of each sun at the vertex: 0, [`BESIDE`] or [`THROUGH`].
    sides: Vec<u8>,
    /// Numbers of the suns of one way.
    chosen: Vec<u32>,
}

/// Suns above the horizon of a vertex, and those behind an opening; 0 for those below.
const BESIDE: u8 = 1;
const THROUGH: u8 = 3;
/// Suns so little below the horizon, by the cosine, may be above in double precision.
const ROUNDING: f32 = 1e-6;

/// The light of one of the suns, of 1 lx on a plane across its rays.
pub(crate) struct SunSample<S> {
    pub(crate) sun: u32,
    pub(crate) place: SunPlace,
    pub(crate) light_sample: LightSample<S>,
}

impl Suns {
    /// Adds one.
    pub(crate) fn push(&mut self, direction: DVec3) {
        self.directions.push(direction);
        let coordinates = direction.to_array();
        self.coordinates.iter_mut().zip(coordinates).for_each(|(all, x)| all.push(x as f32));
    }

    pub(crate) fn len(&self) -> usize {
        self.directions.len()
    }

    /// Marks the suns below a horizon.
    fn lower(&self, n: Vec3, sides: &mut [u8]) {
        let [x, y, z] = &self.coordinates;
        for (((side, x), y), z) in sides.iter_mut().zip(x).zip(y).zip(z) {
            // Without branches, many at once.
            *side *= u8::from(n.x * x + n.y * y + n.z * z > -ROUNDING);
        }
    }

    /// Asks more often from now on where they were found to shine.
    pub(crate) fn use_ways(&mut self, ways: Arc<SunWays>) {
        self.ways = Some(ways);
    }

    /// Whether it is still to be learnt where they shine.
    pub(crate) fn is_learning(&self) -> bool {
        self.ways.is_none() && !self.directions.is_empty()
    }

    /// How many of this many suns are asked at a place. Of suns that shine with a chance, the
    /// square root of that as a share makes the most of the rays.
    fn asked(&self, place: SunPlace, suns: usize) -> f64 {
        let learnt =
            |ways: &Arc<SunWays>| (suns as f64 * ways.shining_share(place).sqrt()).max(RARELY);
        self.ways.as_ref().map_or(ASKED, learnt)
    }

    /// Some of the suns above the horizon of a vertex, each with its chance.
    pub(crate) fn samples<S: Spectrum>(
        &self,
        outside: &OutsideLight<'_>,
        vertex: &Vertex<'_, S>,
        u: f64,
        choice: &mut SunChoice,
        mut take: impl FnMut(SunSample<S>),
    ) {
        choice.sort(self, outside, vertex);
        let ways: &[SunWay] = match vertex.only_side() {
            Some(_) => &[SunWay::Through, SunWay::Beside],
            None => &[SunWay::OnSheet],
        };
        for &way in ways {
            let Some(place) = SunPlace::new(way, vertex) else { continue };
            let chosen = choice.of_way(way);
            let asked = self.asked(place, chosen.len());
            // Most often none where it is dark.
            if u >= asked {
                continue;
            }
            let one_in = (chosen.len() as f64 / asked).max(1.0);
            let numbers = (0..).map(|k| ((u + f64::from(k)) * one_in) as usize);
            for &sun in numbers.map_while(|number| chosen.get(number)) {
                let direction = self.directions[sun as usize];
                let lx = one_in * vertex.cos(direction).max(0.0);
                let light = vertex.weight(direction) * lx;
                let sample = LightSample::unless_dark(direction, outside.beyond_m(), light, lx);
                if let Some(light_sample) = sample {
                    take(SunSample { sun, place, light_sample });
                }
            }
        }
    }
}

impl SunChoice {
    /// Tells the suns behind an opening from the others above the horizon of a vertex.
    fn sort<S: Spectrum>(&mut self, suns: &Suns, outside: &OutsideLight<'_>, v: &Vertex<'_, S>) {
        let Self { sides, .. } = self;
        sides.clear();
        sides.resize(suns.len(), if outside.has_portals() { BESIDE } else { THROUGH });
        for corners in outside.portal_corners() {
            let cone = Cone::new(corners.map(|corner| corner - v.position()));
            cone.into_iter().for_each(|cone| cone.find(suns, sides));
        }
        if let Some(n) = v.only_side() {
            suns.lower(n.as_vec3(), sides);
        }
    }

    /// The suns that may shine on a way.
    fn of_way(&mut self, way: SunWay) -> &[u32] {
        let [low, high] = match way {
            SunWay::Beside => [BESIDE, BESIDE],
            SunWay::Through => [THROUGH, THROUGH],
            SunWay::OnSheet => [BESIDE, THROUGH],
        };
        let Self { sides, chosen } = self;
        chosen.resize(sides.len(), 0);
        let mut count = 0;
        for (sun, side) in (0..).zip(&*sides) {
            // Without branches: what is not wanted is written over.
            chosen[count] = sun;
            count += usize::from(low <= *side && *side <= high);
        }
        &chosen[..count]
    }
}

/// The directions of a triangle, seen from the origin. Single precision will do: who counts as
/// behind the triangle only has other chances to be asked.
struct Cone {
    /// Inward normals of the planes through its edges.
    normals: [Vec3; 3],
}

impl Cone {
    /// `None` edge-on.
    fn new([a, b, c]: [DVec3; 3]) -> Option<Self> {
        let normals = [a.cross(b), b.cross(c), c.cross(a)];
        let volume = normals[0].dot(c);
        let inward = |n: DVec3| (n * volume.signum()).normalize_or_zero().as_vec3();
        (volume != 0.0).then(|| Self { normals: normals.map(inward) })
    }

    /// Marks the suns in it.
    fn find(&self, suns: &Suns, sides: &mut [u8]) {
        let [l, m, n] = self.normals;
        let [x, y, z] = &suns.coordinates;
        for (((side, x), y), z) in sides.iter_mut().zip(x).zip(y).zip(z) {
            let along = |n: Vec3| n.x * x + n.y * y + n.z * z;
            let is_in = (along(l) >= 0.0) & (along(m) >= 0.0) & (along(n) >= 0.0);
            *side |= THROUGH * u8::from(is_in);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cones_hold_what_goes_through_their_triangle() {
        let corners =
            [DVec3::new(-1.0, 2.0, 0.0), DVec3::new(2.0, 2.0, 0.0), DVec3::new(0.0, 3.0, 2.0)];
        let [a, b, c] = corners;
        for corners in [[a, b, c], [b, a, c]] {
            let cone = Cone::new(corners).unwrap();
            let holds = |direction: DVec3| {
                let mut suns = Suns::default();
                suns.push(direction.normalize());
                let mut sides = [0];
                cone.find(&suns, &mut sides);
                sides[0] == THROUGH
            };
            assert!(holds(a + b + c) && !holds(-(a + b + c)));
            for [away, p, q] in [[a, b, c], [b, c, a], [c, a, b]] {
                assert!(holds(p + q + 0.01 * away) && !holds(p + q - 0.01 * away));
            }
        }
        assert!(Cone::new([a, b, a + b]).is_none());
    }
}
