//! Small scenes made in code.

use glam::DVec3;
use quasilux_scene::bsdf::{Diffuse, Mirror};
use quasilux_scene::light::{AreaLight, PointLight};
use quasilux_scene::{
    Bsdf, Grid, Light, Material, Mesh, Quantity, Rgb, Scene, Sensor, SensorPoint, SensorShape,
};

/// A closed box from the origin to `size`, its normals inward, of one material.
pub(crate) fn room(size: DVec3, bsdf: Bsdf) -> Scene {
    let positions = (0..8)
        .map(|i| size * DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1)))
        .collect();
    let quads =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6]];
    let triangles: Vec<[u32; 3]> =
        quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let count = triangles.len();
    Scene {
        mesh: Mesh {
            positions,
            triangles,
            material_of: vec![0; count],
            object_of: vec![0; count],
            objects: vec!["room".into()],
        },
        materials: vec![Material { name: "walls".to_owned(), bsdf }],
        lights: Vec::new(),
        sensors: Vec::new(),
        environment: None,
        weather: None,
        cameras: Vec::new(),
    }
}

pub(crate) fn diffuse(reflectance: f64) -> Bsdf {
    Bsdf::Diffuse(Diffuse { reflectance: Rgb::grey(reflectance) })
}

pub(crate) fn mirror(reflectance: f64) -> Bsdf {
    Bsdf::Mirror(Mirror { reflectance: Rgb::grey(reflectance) })
}

pub(crate) fn point_light(position: DVec3, intensity_cd: f64) -> Light {
    Light::Point(PointLight { position, intensity_cd })
}

/// Makes every triangle of material 0 emit.
pub(crate) fn all_walls_emit(scene: &mut Scene, luminance_cd_m2: f64) {
    let triangles: Vec<u32> = (0..scene.mesh.triangles.len() as u32).collect();
    let area_m2 = triangles.iter().map(|&t| scene.mesh.area_m2(t)).sum();
    scene.lights.push(Light::Area(AreaLight { material: 0, triangles, area_m2, luminance_cd_m2 }));
}

pub(crate) fn points(name: &str, points: &[(DVec3, DVec3)]) -> Sensor {
    let points = points.iter().map(|&(position, normal)| SensorPoint { position, normal });
    Sensor { name: name.to_owned(), shape: SensorShape::Points(points.collect()) }
}

/// The diffuse cube of Voloboy, Dmitriev and Kopylov (2003): 10 m, reflectance 2/3, 50 000 cd at
/// the centre; points on the wall x = 0 at coordinates in units of the half side.
pub(crate) fn diffuse_cube(places: &[(f64, f64)]) -> Scene {
    let mut scene = room(DVec3::splat(10.0), diffuse(2.0 / 3.0));
    scene.lights.push(point_light(DVec3::splat(5.0), 50_000.0));
    let on_wall = |&(y, z): &(f64, f64)| (DVec3::new(0.0, 5.0 + 5.0 * y, 5.0 + 5.0 * z), DVec3::X);
    let places: Vec<(DVec3, DVec3)> = places.iter().map(on_wall).collect();
    scene.sensors.push(points("wall", &places));
    scene
}

/// Means over the cells of a grid that covers the wall x = 0 of the diffuse cube.
pub(crate) fn wall_grid(counts: [u32; 2]) -> Sensor {
    let grid = Grid {
        origin: DVec3::ZERO,
        u: DVec3::Y * 10.0,
        v: DVec3::Z * 10.0,
        counts,
        normal: DVec3::X,
        quantity: Quantity::Mean,
        target_lx: None,
    };
    Sensor { name: "grid".to_owned(), shape: SensorShape::Grid(grid) }
}

/// Means over the cells of a level grid that looks up.
pub(crate) fn level_grid(origin: DVec3, size_m: [f64; 2], counts: [u32; 2]) -> Sensor {
    let (u, v) = (DVec3::X * size_m[0], DVec3::Y * size_m[1]);
    let (normal, quantity) = (DVec3::Z, Quantity::Mean);
    let grid = Grid { origin, u, v, counts, normal, quantity, target_lx: None };
    Sensor { name: "plane".to_owned(), shape: SensorShape::Grid(grid) }
}
