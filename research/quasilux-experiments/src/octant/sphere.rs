//! The scene: one eighth of a diffuse sphere between three mirrors, and what its light gives
//! directly.
//!
//! The sphere is a mesh of `n * n` facets an eighth, all corners on one sphere. Where the foot of
//! the centre's perpendicular on a facet lies, the facet touches a sphere around the centre: there
//! the normal is the sphere's. The mesh is as large as makes its middle facet touch the unit
//! sphere, at the place that the paper names, so that the direct light has no error there, and the
//! indirect light has one of the order of `n^-2`.

use crate::building::{add_material, add_quad, grey, lamp, points};
use glam::DVec3;
use quasilux_scene::bsdf::Mirror;
use quasilux_scene::{Bsdf, Mesh, Rgb, Scene};
use std::f64::consts::{FRAC_PI_2, PI};

/// The source as reconstructed; the paper does not give it. On the diagonal, so far along each
/// axis.
pub(super) const LIGHT_M: f64 = 0.210_792_8;
/// Its intensity.
pub(super) const INTENSITY_CD: f64 = 83.331_125;
/// Of the sphere, as reconstructed.
pub(super) const REFLECTANCE: f64 = 0.5;
/// Facets along an edge of the coarsest mesh. It is cut by four from mesh to mesh, as each facet
/// then has one of the same shape in its middle.
const COARSEST: u32 = 4;

/// The octant on a mesh.
pub(super) struct Octant {
    /// Facets along each edge.
    pub(super) n: u32,
    /// Its sensor has one point in each facet of the coarsest mesh, but for those that symmetry
    /// makes equal.
    pub(super) scene: Scene,
    /// These points; all normals look at the centre.
    pub(super) places: Vec<DVec3>,
    /// The one in the middle.
    pub(super) middle: usize,
}

/// A facet of the mesh.
pub(super) struct Facet {
    corners: [DVec3; 3],
    /// Its centre.
    pub(super) place: DVec3,
    pub(super) normal: DVec3,
    pub(super) area_m2: f64,
}

impl Facet {
    /// Mean of what the light and its images give: by the middles of the edges, exact to third
    /// order.
    fn direct_lx(&self) -> f64 {
        let [a, b, c] = self.corners;
        let middles = [(a, b), (b, c), (c, a)].map(|(a, b)| 0.5 * (a + b));
        middles.iter().map(|&place| direct_to_lx(place, self.normal)).sum::<f64>() / 3.0
    }
}

/// Corners of a facet, in steps of the mesh: numbers that sum to `n`.
type Steps = [[u32; 3]; 3];

impl Octant {
    /// The mesh number `level`, from 0 on.
    pub(super) fn new(level: u32) -> Self {
        let n = COARSEST << (2 * level);
        let seen = distinct_facets().map(|facet| in_the_middle(facet, level));
        let feet: Vec<DVec3> = seen.map(|facet| foot(facet, n)).collect();
        let lean = |foot: &DVec3| foot.normalize().dot(diagonal());
        let middle = (0..feet.len()).max_by(|a, b| lean(&feet[*a]).total_cmp(&lean(&feet[*b])));
        let middle = middle.expect("the mesh has facets");
        let radius_m = 1.0 / feet[middle].length();
        let places: Vec<DVec3> = feet.into_iter().map(|foot| radius_m * foot).collect();
        let mut scene = Scene::default();
        let sphere = add_material(&mut scene, grey(REFLECTANCE));
        for facet in facets(n) {
            let corners = facet.map(|steps| radius_m * corner(steps, n));
            add_facet(&mut scene.mesh, corners, sphere);
        }
        add_mirrors(&mut scene);
        lamp(&mut scene, DVec3::splat(LIGHT_M), INTENSITY_CD);
        let looking: Vec<_> = places.iter().map(|&place| (place, -place.normalize())).collect();
        scene.sensors.push(points(&looking));
        Self { n, scene, places, middle }
    }

    /// The same with a black sphere: all light that arrives is direct.
    pub(super) fn black(&self) -> Scene {
        let mut scene = self.scene.clone();
        scene.materials[0].bsdf = grey(0.0);
        scene
    }

    /// The facets in the middle that together are an element of an illumination map, on a mesh fine
    /// enough: those of a triangle that would be one facet of eight along an edge.
    pub(super) fn element(&self) -> Vec<Facet> {
        let mesh = &self.scene.mesh;
        let inner = |(_, facet): &(u32, Steps)| {
            facet.as_flattened().iter().all(|step| 8 * step <= 3 * self.n)
        };
        let described = |(triangle, _): (u32, Steps)| Facet {
            corners: mesh.corners(triangle),
            place: mesh.corners(triangle).iter().sum::<DVec3>() / 3.0,
            normal: mesh.front_normal(triangle),
            area_m2: mesh.area_m2(triangle),
        };
        // The mesh has them in this order, before all else.
        (0..).zip(facets(self.n)).filter(inner).map(described).collect()
    }

    /// Mean of what the light and its images give to the element.
    pub(super) fn direct_on_the_element_lx(&self) -> f64 {
        let element = self.element();
        let area_m2: f64 = element.iter().map(|facet| facet.area_m2).sum();
        element.iter().map(|facet| facet.area_m2 * facet.direct_lx()).sum::<f64>() / area_m2
    }
}

/// Illuminance that the light and its seven images give to a place that looks at the centre.
pub(super) fn direct_lx(place: DVec3) -> f64 {
    direct_to_lx(place, -place.normalize())
}

fn direct_to_lx(place: DVec3, normal: DVec3) -> f64 {
    let side = |image: u32, bit: u32| if image >> bit & 1 == 0 { LIGHT_M } else { -LIGHT_M };
    let images = (0..8).map(|i| DVec3::new(side(i, 0), side(i, 1), side(i, 2)));
    let lx = |image: DVec3| {
        let toward = image - place;
        let cos = toward.normalize().dot(normal);
        INTENSITY_CD * cos / toward.length_squared()
    };
    images.map(lx).sum()
}

/// The same at the place in the middle of a unit sphere: `I` times the sum of
/// `(1 - s c) / (1 + s^2 - 2 s c)^1.5`, s the distance of the light from the centre, c the cosine
/// of the angle between an image and the place.
pub(super) fn direct_in_the_middle_lx() -> f64 {
    let s = 3.0_f64.sqrt() * LIGHT_M;
    let term = |c: f64| (1.0 - s * c) / libm::pow(1.0 + s * s - 2.0 * s * c, 1.5);
    INTENSITY_CD * (term(1.0) + 3.0 * term(1.0 / 3.0) + 3.0 * term(-1.0 / 3.0) + term(-1.0))
}

/// A sphere's points all see each other alike, `cos cos / (pi r^2) = 1 / (4 pi R^2)`: the flux of
/// the eight images is spread evenly at the first reflection and stays so at the others, `E = 8 I
/// rho / (1 - rho) / R^2`.
pub(super) fn indirect_lx() -> f64 {
    let flux_lm = 8.0 * 4.0 * PI * INTENSITY_CD;
    flux_lm / (4.0 * PI) * REFLECTANCE / (1.0 - REFLECTANCE)
}

/// Where the paper looks.
pub(super) fn diagonal() -> DVec3 {
    DVec3::ONE.normalize()
}

/// All facets, with the centre on their front side.
fn facets(n: u32) -> Vec<Steps> {
    let mut facets = Vec::new();
    for i in 0..n {
        for j in 0..n - i {
            let k = n - 1 - i - j;
            facets.push([[i + 1, j, k], [i, j, k + 1], [i, j + 1, k]]);
            if k > 0 {
                facets.push([[i, j + 1, k], [i + 1, j + 1, k - 1], [i + 1, j, k]]);
            }
        }
    }
    facets
}

/// Of the coarsest mesh, those which are not an earlier one with the axes exchanged.
fn distinct_facets() -> impl Iterator<Item = Steps> {
    let middle = |facet: &Steps| [0, 1, 2].map(|axis| facet.iter().map(|c| c[axis]).sum::<u32>());
    facets(COARSEST).into_iter().filter(move |facet| middle(facet).is_sorted())
}

/// The one in the middle of a facet after each edge was cut in four, this many times.
fn in_the_middle(facet: Steps, times: u32) -> Steps {
    let sum = |a: [u32; 3], b: [u32; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    // Cut in two, the middle one joins the middles of the edges.
    (0..2 * times).fold(facet, |[a, b, c], _| [sum(b, c), sum(c, a), sum(a, b)])
}

/// On the unit sphere. Equal steps along the octant's edges are equal angles there.
fn corner(steps: [u32; 3], n: u32) -> DVec3 {
    let along = |step: u32| libm::sin(FRAC_PI_2 * f64::from(step) / f64::from(n));
    let [x, y, z] = steps.map(along);
    DVec3::new(x, y, z).normalize()
}

/// The point of a facet's plane that is nearest to the centre.
fn foot(facet: Steps, n: u32) -> DVec3 {
    let [a, b, c] = facet.map(|steps| corner(steps, n));
    let normal = (b - a).cross(c - a).normalize();
    normal * normal.dot(a)
}

fn add_facet(mesh: &mut Mesh, corners: [DVec3; 3], material: u32) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners);
    mesh.triangles.push([first, first + 1, first + 2]);
    mesh.material_of.push(material);
    mesh.object_of.push(0);
}

/// On the three coordinate planes, a little larger than the sphere.
fn add_mirrors(scene: &mut Scene) {
    let material = add_material(scene, Bsdf::Mirror(Mirror { reflectance: Rgb::grey(1.0) }));
    for (u, v) in [(DVec3::X, DVec3::Y), (DVec3::Y, DVec3::Z), (DVec3::Z, DVec3::X)] {
        let (u, v) = (1.2 * u, 1.2 * v);
        add_quad(scene, [DVec3::ZERO, u, u + v, v], material);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_close_the_octant_and_look_at_its_centre() {
        for level in 0..2 {
            let Octant { n, scene, places, middle } = Octant::new(level);
            let (mesh, all) = (&scene.mesh, n * n);
            assert_eq!(mesh.triangles.len() as u32, all + 6);
            let mut area_vector = DVec3::ZERO;
            for triangle in 0..all {
                let twice = mesh.double_area_vector(triangle);
                assert!(twice.dot(mesh.corners(triangle)[0]) < 0.0, "{triangle} looks away");
                area_vector += 0.5 * twice;
            }
            // Closed with the three planes' parts, which are polygons in a quarter of a circle.
            let radius_m = mesh.positions[0].length();
            let step = FRAC_PI_2 / f64::from(n);
            let quarter_m2 = 0.5 * radius_m * radius_m * f64::from(n) * libm::sin(step);
            assert!((area_vector + quarter_m2 * DVec3::ONE).length() < 1e-12, "{area_vector}");
            assert!((places[middle] - diagonal()).length() < 1e-12);
            assert_eq!(places.len(), 5);
        }
    }

    /// Seen from each place, its corners follow each other in one sense of turning.
    #[test]
    fn places_are_on_their_facets() {
        for level in 0..3 {
            let n = COARSEST << (2 * level);
            for facet in facets(COARSEST) {
                let facet = in_the_middle(facet, level);
                let place = foot(facet, n);
                let to = facet.map(|steps| corner(steps, n) - place);
                let sides = [0, 1, 2].map(|i| to[i].cross(to[(i + 1) % 3]).dot(place));
                assert!(sides.iter().all(|side| *side < 0.0), "{level}: {facet:?}");
            }
        }
    }

    #[test]
    fn the_reconstruction_gives_the_papers_figures() {
        assert!((direct_in_the_middle_lx() - (1353.247 - 666.649)).abs() < 1e-3);
        assert!((direct_in_the_middle_lx() - direct_lx(diagonal())).abs() < 1e-9);
        assert!((indirect_lx() - 666.649).abs() < 1e-9);
    }

    /// A facet of eight along an edge is cut in 64, and is a little larger than the average.
    #[test]
    fn the_element_is_a_triangle_in_the_middle() {
        let element = Octant::new(2).element();
        assert_eq!(element.len(), 64);
        let area_m2: f64 = element.iter().map(|facet| facet.area_m2).sum();
        let mean_m2 = FRAC_PI_2 / 64.0;
        assert!(area_m2 > mean_m2 && area_m2 < 1.6 * mean_m2, "{area_m2}");
        let middle = element.iter().map(|facet| facet.area_m2 * facet.place).sum::<DVec3>();
        assert!((middle / area_m2 - diagonal()).length() < 0.01, "{middle}");
    }
}
