//! A scene made ready: what rays meet, and how they go on.

use crate::emission::Emission;
use crate::hint::Lookout;
use crate::metal::Metal;
use crate::optics::{Course, send_on, through_pane};
use crate::scene::Scene;
use crate::surface::Surface;
use crate::tree::Tree;
use crate::triangle::{Ray, Triangle};
use crate::vertex::{Looking, Scatter, Vertex};
use glam::DVec3;

/// Rays start and end so far from surfaces.
const GAP_M: f64 = 1e-8;
/// A chain of mirrors and glass ends here: what it still brings is far below any error.
const MAX_CHAIN: u32 = 400;

/// A scene made ready.
pub(crate) struct World<'a> {
    pub(crate) scene: &'a Scene,
    tree: Tree,
    has_panes: bool,
    metals: Vec<Metal>,
    /// Of a triangle of rough metal, which one.
    metal_of: Vec<usize>,
    /// Of the point lights.
    pub(crate) emissions: Vec<Emission>,
    pub(crate) emitters: Vec<Emitter>,
    /// The aims, for sensors that look back through them.
    pub(crate) keyholes: Vec<Lookout>,
    /// Of a triangle, the density in area that it is chosen with as a light.
    pub(crate) pdf_per_m2: Vec<f64>,
    /// Of all emitting triangles.
    pub(crate) emitted_lm: f64,
    /// A sphere around all triangles, sensors and openings.
    pub(crate) middle: DVec3,
    pub(crate) radius_m: f64,
}

/// An emitting triangle, and the share of the flux up to and with it.
pub(crate) struct Emitter {
    pub(crate) triangle: usize,
    pub(crate) flux_up_to: f64,
}

/// Where a ray came to behind mirrors and glass.
pub(crate) struct Arrival {
    /// Of its last piece.
    pub(crate) direction: DVec3,
    /// The triangle met, unless it left the scene.
    pub(crate) met: Option<Met>,
    /// What mirrors and glass kept, over the probability of the ways taken.
    pub(crate) weight: f64,
    /// Whether anything but panes passed straight was on the way.
    pub(crate) is_bent: bool,
    /// The length of all pieces in m.
    pub(crate) distance_m: f64,
}

/// A triangle that scatters or ends light.
pub(crate) struct Met {
    pub(crate) triangle: usize,
    pub(crate) position: DVec3,
    /// Unit normal of its front.
    pub(crate) front: DVec3,
}

/// A straight piece of the way of a ray.
pub(crate) struct Piece {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) length_m: f64,
    /// As of [`Arrival`], up to this piece.
    pub(crate) weight: f64,
    pub(crate) is_bent: bool,
}

impl<'a> World<'a> {
    pub(crate) fn new(scene: &'a Scene) -> Self {
        let flux = |t: &Triangle| t.luminance_cd_m2 * t.area_m2();
        let total: f64 = scene.triangles.iter().map(flux).sum();
        let mut sum = 0.0;
        let mut emitters = Vec::new();
        let (mut metals, mut metal_of) = (Vec::<Metal>::new(), Vec::new());
        for (triangle, shape) in scene.triangles.iter().enumerate() {
            if shape.luminance_cd_m2 > 0.0 {
                sum += flux(shape) / total;
                emitters.push(Emitter { triangle, flux_up_to: sum });
            }
            let mut number = 0;
            if let Surface::Metal { reflectance, alpha } = shape.surface {
                let known = metals.iter().position(|metal| metal.is(reflectance, alpha));
                number = known.unwrap_or(metals.len());
                if known.is_none() {
                    metals.push(Metal::new(reflectance, alpha));
                }
            }
            metal_of.push(number);
        }
        let pdf = |t: &Triangle| if total > 0.0 { t.luminance_cd_m2 / total } else { 0.0 };
        let is_pane = |t: &Triangle| matches!(t.surface, Surface::Pane { .. });
        let places = || {
            let corners = scene.triangles.iter().flat_map(|triangle| triangle.corners);
            let openings = scene.openings.iter().flat_map(|opening| {
                [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|uv| opening.place(uv))
            });
            let sensors = scene.sensors.iter().flat_map(|sensor| {
                let reach = DVec3::splat(sensor.area_m2().sqrt());
                [sensor.position - reach, sensor.position + reach]
            });
            corners.chain(openings).chain(sensors)
        };
        let low = places().fold(DVec3::INFINITY, DVec3::min);
        let high = places().fold(DVec3::NEG_INFINITY, DVec3::max);
        let is_empty = !(low.cmple(high).all());
        let middle = if is_empty { DVec3::ZERO } else { 0.5 * (low + high) };
        let far = places().map(|place| place.distance(middle)).fold(0.0, f64::max);
        Self {
            scene,
            tree: Tree::new(&scene.triangles),
            has_panes: scene.triangles.iter().any(is_pane),
            metals,
            metal_of,
            emissions: scene.lights.iter().map(Emission::new).collect(),
            emitters,
            keyholes: scene.aims.iter().map(|aim| aim.seen_everywhere()).collect(),
            pdf_per_m2: scene.triangles.iter().map(pdf).collect(),
            emitted_lm: std::f64::consts::PI * total,
            middle,
            radius_m: far.max(1e-3) * (1.0 + 1e-9),
        }
    }

    /// Goes on over mirrors and through glass to what is none, and tells each piece of the way.
    pub(crate) fn follow(
        &self,
        origin: DVec3,
        direction: DVec3,
        mut way: Course,
        mut tell: impl FnMut(&Piece),
    ) -> Option<Arrival> {
        let (mut weight, mut is_bent, mut distance_m) = (1.0, false, 0.0);
        let mut ray = Ray { origin, direction, nearest_m: GAP_M, farthest_m: f64::INFINITY };
        for _ in 0..MAX_CHAIN {
            let hit = self.tree.nearest(&self.scene.triangles, ray);
            let length_m = hit.map_or(f64::INFINITY, |hit| hit.distance_m);
            let (origin, direction) = (ray.origin, ray.direction);
            tell(&Piece { origin, direction, length_m, weight, is_bent });
            let Some(hit) = hit else {
                let met = None;
                return Some(Arrival { direction, met, weight, is_bent, distance_m });
            };
            distance_m += hit.distance_m;
            let triangle = &self.scene.triangles[hit.triangle];
            let front = triangle.double_area().normalize();
            let position = origin + direction * hit.distance_m;
            let onward = send_on(triangle.surface, direction, front, &mut way);
            let Some(onward) = onward else {
                let met = Some(Met { triangle: hit.triangle, position, front });
                return Some(Arrival { direction, met, weight, is_bent, distance_m });
            };
            weight *= onward.weight;
            is_bent |= !onward.is_straight;
            if weight == 0.0 {
                return None;
            }
            ray.origin = position;
            ray.direction = onward.direction;
        }
        None
    }

    /// What passes from a place so far in a unit direction, straight through panes.
    pub(crate) fn passed(&self, origin: DVec3, direction: DVec3, distance_m: f64) -> f64 {
        let farthest_m = distance_m - GAP_M;
        let mut ray = Ray { origin, direction, nearest_m: GAP_M, farthest_m };
        if !self.has_panes {
            return if self.tree.blocks(&self.scene.triangles, ray) { 0.0 } else { 1.0 };
        }
        let mut passed = 1.0;
        while let Some(hit) = self.tree.nearest(&self.scene.triangles, ray) {
            let triangle = &self.scene.triangles[hit.triangle];
            let Surface::Pane { eta, tint } = triangle.surface else {
                return 0.0;
            };
            let cos = direction.dot(triangle.double_area().normalize());
            passed *= through_pane(cos, eta, tint);
            ray.origin += direction * hit.distance_m;
            ray.farthest_m -= hit.distance_m;
        }
        passed
    }

    /// The vertex where something arrived, unless light ends there.
    pub(crate) fn vertex_at(&self, arrival: &Arrival, looking: Looking<'a>) -> Option<Vertex<'_>> {
        let met = arrival.met.as_ref()?;
        let is_front = met.front.dot(arrival.direction) < 0.0;
        let normal = if is_front { met.front } else { -met.front };
        let scatter = match self.scene.triangles[met.triangle].surface {
            Surface::Grey { reflectance, two_sided } if is_front || two_sided => {
                Scatter::Matt { reflectance }
            }
            Surface::Sheet { reflectance, transmittance } => {
                Scatter::Sheet { reflectance, transmittance }
            }
            Surface::Metal { .. } => Scatter::Metal {
                metal: &self.metals[self.metal_of[met.triangle]],
                wo: -arrival.direction,
            },
            _ => return None,
        };
        let is_black = matches!(scatter, Scatter::Matt { .. } | Scatter::Sheet { .. })
            && scatter.kept() == 0.0;
        (!is_black).then(|| Vertex::new(met.position, normal, scatter, looking))
    }
}
