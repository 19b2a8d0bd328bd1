//! The simple scenes that experiments are made of: rooms and quadrilaterals, lamps and sensor
//! points.

use glam::DVec3;
use quasilux_scene::bsdf::Diffuse;
use quasilux_scene::light::{AreaLight, PointLight};
use quasilux_scene::{Bsdf, Light, Material, Mesh, Rgb, Scene, Sensor, SensorPoint, SensorShape};

/// Corners of a box's sides, low and high along z, x and y, as seen from within. A corner's bits
/// say where along x, y and z it is.
const BOX: [[u32; 4]; 6] =
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6]];

/// A closed box from the origin to `size_m`, all of one material, its normals inward: floor,
/// ceiling, then the walls at low and high x, at low and high y, two triangles each.
pub(super) fn room(size_m: DVec3, bsdf: Bsdf) -> Scene {
    let mut scene = Scene::default();
    let material = add_material(&mut scene, bsdf);
    for quad in BOX {
        add_quad(&mut scene, quad.map(|corner| corner_of_box(corner) * size_m), material);
    }
    scene
}

fn corner_of_box(number: u32) -> DVec3 {
    let axis = |bit: u32| f64::from(number >> bit & 1);
    DVec3::new(axis(0), axis(1), axis(2))
}

/// A surface that reflects the same share of all light, diffusely.
pub(super) fn grey(reflectance: f64) -> Bsdf {
    Bsdf::Diffuse(Diffuse { reflectance: Rgb::grey(reflectance) })
}

/// A surface that reflects a share of each channel, diffusely.
pub(super) fn coloured(reflectance: [f64; 3]) -> Bsdf {
    Bsdf::Diffuse(Diffuse { reflectance: Rgb(reflectance) })
}

/// Adds a material, and returns its number.
pub(super) fn add_material(scene: &mut Scene, bsdf: Bsdf) -> u32 {
    let number = scene.materials.len() as u32;
    scene.materials.push(Material { name: format!("material {number}"), bsdf });
    number
}

/// Adds a quadrilateral as two triangles; its corners run counter-clockwise as its front sees them.
pub(super) fn add_quad(scene: &mut Scene, corners: [DVec3; 4], material: u32) {
    let mesh: &mut Mesh = &mut scene.mesh;
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners);
    for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
        mesh.triangles.push([first + a, first + b, first + c]);
        mesh.material_of.push(material);
        mesh.object_of.push(0);
    }
    if mesh.objects.is_empty() {
        mesh.objects.push("scene".into());
    }
}

/// Adds a block with its edges along the axes, its normals outward.
pub(super) fn add_block(scene: &mut Scene, low: DVec3, size_m: DVec3, material: u32) {
    for quad in BOX {
        let mut corners = quad.map(|corner| low + corner_of_box(corner) * size_m);
        corners.reverse();
        add_quad(scene, corners, material);
    }
}

/// Makes all triangles from `first` on, which are of `material`, shine with one luminance.
pub(super) fn shine(scene: &mut Scene, material: u32, first: u32, luminance_cd_m2: f64) {
    let triangles: Vec<u32> = (first..scene.mesh.triangles.len() as u32).collect();
    let area_m2 = triangles.iter().map(|&triangle| scene.mesh.area_m2(triangle)).sum();
    scene.lights.push(Light::Area(AreaLight { material, triangles, area_m2, luminance_cd_m2 }));
}

/// An isotropic point light.
pub(super) fn lamp(scene: &mut Scene, position: DVec3, intensity_cd: f64) {
    scene.lights.push(Light::Point(PointLight { position, intensity_cd }));
}

/// Sensor points at places with normals.
pub(super) fn points(places: &[(DVec3, DVec3)]) -> Sensor {
    let points = places.iter().map(|&(position, normal)| SensorPoint { position, normal });
    Sensor { name: "places".to_owned(), shape: SensorShape::Points(points.collect()) }
}
