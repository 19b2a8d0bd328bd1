//! The simple scenes that experiments are made of: rooms and quadrilaterals, lamps and sensor points.

use glam::DVec3;
use quasilux_scene::bsdf::Diffuse;
use quasilux_scene::light::{AreaLight, PointLight};
use quasilux_scene::{Bsdf, Light, Material, Mesh, Rgb, Scene, Sensor, SensorPoint, SensorShape};

/// A closed box from the origin to `size_m`, all of one material, its normals inward.
pub(super) fn room(size_m: DVec3, bsdf: Bsdf) -> Scene {
    let mut scene = Scene::default();
    let material = add_material(&mut scene, bsdf);
    let quads =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6]];
    for quad in quads {
        let corner = |i: i32| {
            let axis = |bit: i32| f64::from(i >> bit & 1);
            DVec3::new(axis(0), axis(1), axis(2)) * size_m
        };
        add_quad(&mut scene, quad.map(corner), material);
    }
    scene
}

/// A surface that reflects the same share of all light, diffusely.
pub(super) fn grey(reflectance: f64) -> Bsdf {
    Bsdf::Diffuse(Diffuse { reflectance: Rgb::grey(reflectance) })
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
        mesh.objects.push("scene".to_owned());
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
