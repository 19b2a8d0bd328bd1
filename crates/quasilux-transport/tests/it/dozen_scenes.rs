//! Small scenes, each for one thing that light does on its way. Their sensors are two cells that
//! cross the whole room; the one that looks down sees few of the lights.

use crate::images::add_panel;
use crate::materials::{add_ball, add_box, conductor, plastic, translucent};
use crate::mirrored_light::make_wall;
use crate::scenes::{diffuse, mirror, point_light, room};
use glam::{DMat3, DVec3};
use quasilux_photometry::{LuminousShape, Solid, read_ies};
use quasilux_scene::bsdf::{Dielectric, Diffuse, Mirror, Pane};
use quasilux_scene::light::{AreaLight, Luminaire};
use quasilux_scene::{Bsdf, Grid, Light, Quantity, Rgb, Scene, Sensor, SensorShape};
use std::sync::Arc;

fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A room of 4 m by 3 m by 2.5 m with two cells that look up and down from 0.8 m, each over all of
/// the room.
fn plain(reflectance: f64) -> Scene {
    let mut scene = room(at(4.0, 3.0, 2.5), diffuse(reflectance));
    for (name, normal) in [("up", DVec3::Z), ("down", DVec3::NEG_Z)] {
        let grid = Grid {
            origin: at(0.0, 0.0, 0.8),
            u: DVec3::X * 4.0,
            v: DVec3::Y * 3.0,
            counts: [1, 1],
            normal,
            quantity: Quantity::Mean,
            target_lx: None,
        };
        scene.sensors.push(Sensor { name: name.to_owned(), shape: SensorShape::Grid(grid) });
    }
    scene
}

/// Makes all triangles from `first` on shine from their front sides, and reflect little.
fn shine(scene: &mut Scene, first: usize, luminance_cd_m2: f64) {
    let triangles: Vec<u32> = (first as u32..scene.mesh.triangles.len() as u32).collect();
    let area_m2 = triangles.iter().map(|&triangle| scene.mesh.area_m2(triangle)).sum();
    let material = scene.mesh.material_of[first];
    scene.lights.push(Light::Area(AreaLight { material, triangles, area_m2, luminance_cd_m2 }));
}

/// A panel that shines along `u` cross `v`.
fn add_shining_panel(scene: &mut Scene, corner: DVec3, u: DVec3, v: DVec3, luminance_cd_m2: f64) {
    let first = scene.mesh.triangles.len();
    add_panel(scene, corner, u, v, diffuse(0.2));
    shine(scene, first, luminance_cd_m2);
}

/// A ceiling that shines, a hair below the other.
fn add_shining_ceiling(scene: &mut Scene) {
    add_shining_panel(scene, at(0.0, 0.0, 2.49), DVec3::Y * 3.0, DVec3::X * 4.0, 100.0);
}

/// Nothing but walls and a lamp.
pub(crate) fn closed(reflectance: f64) -> Scene {
    let mut scene = plain(reflectance);
    scene.lights.push(point_light(at(1.3, 1.1, 1.9), 300.0));
    scene
}

/// Without one wall, and with a lamp inside and one outside.
pub(crate) fn open() -> Scene {
    let mut scene = plain(0.6);
    scene.mesh.triangles.drain(6..8);
    scene.mesh.material_of.drain(6..8);
    scene.mesh.object_of.drain(6..8);
    scene.lights.push(point_light(at(1.3, 1.1, 1.9), 300.0));
    scene.lights.push(point_light(at(5.0, 1.0, 2.0), 150.0));
    scene
}

/// A mirror wall, with a lamp on either side of the middle.
pub(crate) fn mirror_wall() -> Scene {
    let mut scene = plain(0.5);
    make_wall(&mut scene, 6, mirror(0.9));
    scene.lights.push(point_light(at(0.9, 1.0, 1.9), 300.0));
    scene.lights.push(point_light(at(2.9, 2.2, 1.4), 100.0));
    scene
}

/// Coloured, with a third beside them, and a ceiling that shines.
pub(crate) fn facing_mirrors() -> Scene {
    let mut scene = plain(0.4);
    let coloured = Bsdf::Mirror(Mirror { reflectance: Rgb([0.7, 0.5, 0.3]) });
    for first in [4, 6, 8] {
        make_wall(&mut scene, first, coloured.clone());
    }
    add_shining_ceiling(&mut scene);
    scene
}

/// Clear, across the room, with a lamp on one side.
pub(crate) fn pane() -> Scene {
    let mut scene = plain(0.5);
    let clear = Bsdf::Pane(Pane::Clear { eta: 1.5 });
    add_panel(&mut scene, at(1.8, 0.0, 0.0), DVec3::Y * 3.0, DVec3::Z * 2.5, clear);
    scene.lights.push(point_light(at(1.0, 1.2, 1.6), 300.0));
    scene
}

/// Clear, half-way below a ceiling that shines.
pub(crate) fn pane_below_ceiling() -> Scene {
    let mut scene = plain(0.5);
    let clear = Bsdf::Pane(Pane::Clear { eta: 1.5 });
    add_panel(&mut scene, at(0.0, 0.0, 1.9), DVec3::X * 2.2, DVec3::Y * 3.0, clear);
    add_shining_ceiling(&mut scene);
    scene
}

/// A slab of glass above the cells, under a ceiling that shines.
pub(crate) fn glass_slab() -> Scene {
    let mut scene = plain(0.4);
    let glass = Bsdf::Dielectric(Dielectric { eta: 1.5 });
    add_box(&mut scene, at(0.5, 0.5, 1.2), at(3.5, 2.5, 1.4), glass);
    add_shining_ceiling(&mut scene);
    scene
}

/// A ball of glass under a ceiling that shines.
pub(crate) fn glass_ball() -> Scene {
    let mut scene = plain(0.5);
    add_ball(&mut scene, at(2.0, 1.5, 0.6), 0.35, Bsdf::Dielectric(Dielectric { eta: 1.5 }));
    add_shining_ceiling(&mut scene);
    scene
}

/// Twenty-four, of strengths from 1 to 24.
pub(crate) fn many_lights() -> Scene {
    let mut scene = plain(0.5);
    for i in 0..24 {
        let (x, y) = (0.4 + 0.6 * f64::from(i % 6), 0.4 + 0.7 * f64::from(i / 6));
        let z = 1.4 + 0.04 * f64::from(i * 7 % 24);
        scene.lights.push(point_light(at(x, y, z), 5.0 * f64::from(1 + i * 5 % 24)));
    }
    scene
}

/// A luminaire with no symmetry in a niche of 0.6 m by 1.2 m.
pub(crate) fn niche() -> Scene {
    in_niche(LuminousShape::POINT)
}

/// The same from a face of 0.1 m by 0.1 m.
pub(crate) fn wide_niche() -> Scene {
    in_niche(LuminousShape::new(Solid::Cuboid, at(0.1, 0.1, 0.0)))
}

fn in_niche(shape: LuminousShape) -> Scene {
    let mut scene = plain(0.5);
    for y in [1.0, 2.2] {
        add_panel(&mut scene, at(3.4, y, 0.0), DVec3::X * 0.6, DVec3::Z * 2.5, diffuse(0.5));
    }
    // Candela at C0, C90, C180, C270 and nadir angles 0, 90, 180 degrees, linear between.
    let text = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 5 1 2 0 0 0\n1 1 100\n0 90 180\n\
                0 90 180 270 360\n50 100 20\n50 300 20\n50 700 20\n50 40 20\n50 100 20\n";
    let photometry = read_ies(text.as_bytes()).expect("a file").photometry;
    scene.lights.push(Light::Luminaire(Luminaire {
        photometry: Arc::new(photometry),
        position: at(3.5, 1.7, 1.9),
        world_from_luminaire: DMat3::IDENTITY,
        dimming: 1.0,
        shape,
    }));
    scene
}

pub(crate) fn colours() -> Scene {
    let mut scene = plain(0.5);
    let colours = [[0.9, 0.1, 0.1], [0.2, 0.8, 0.2], [0.1, 0.2, 0.9]];
    for (first, colour) in [0, 2, 6].into_iter().zip(colours) {
        make_wall(&mut scene, first, Bsdf::Diffuse(Diffuse { reflectance: Rgb(colour) }));
    }
    scene.lights.push(point_light(at(1.3, 1.1, 1.9), 300.0));
    scene
}

/// A translucent wall between the lamp and the cell.
pub(crate) fn screen() -> Scene {
    let mut scene = plain(0.4);
    let corner = at(0.9, 0.0, 0.0);
    add_panel(&mut scene, corner, DVec3::Y * 3.0, DVec3::Z * 2.5, translucent(0.3, 0.5));
    scene.lights.push(point_light(at(0.4, 1.1, 1.0), 300.0));
    scene
}

/// A wall of rough metal.
pub(crate) fn metal() -> Scene {
    let mut scene = plain(0.5);
    make_wall(&mut scene, 8, conductor(0.8, 0.3));
    scene.lights.push(point_light(at(1.3, 1.1, 1.9), 300.0));
    scene
}

/// A floor of plastic, and a table of it.
pub(crate) fn glossy_floor() -> Scene {
    let mut scene = plain(0.5);
    make_wall(&mut scene, 0, plastic(0.5, 0.2));
    add_box(&mut scene, at(1.5, 1.0, 0.5), at(2.5, 1.6, 0.6), plastic(0.4, 0.3));
    scene.lights.push(point_light(at(1.3, 1.1, 1.9), 300.0));
    scene
}

/// A panel that shines down on a table.
pub(crate) fn table() -> Scene {
    let mut scene = plain(0.5);
    add_box(&mut scene, at(1.2, 1.0, 0.9), at(2.7, 1.8, 0.95), diffuse(0.3));
    add_shining_panel(&mut scene, at(0.5, 0.5, 2.3), DVec3::Y * 2.0, DVec3::X * 3.0, 300.0);
    scene
}

/// Plates at odd angles, lit on both sides.
pub(crate) fn plates() -> Scene {
    let mut scene = plain(0.6);
    for i in 0..6 {
        let angle = f64::from(i);
        let (sin, cos) = libm::sincos(angle);
        let u = at(cos, sin, 0.4).normalize() * 0.8;
        let v = at(-0.3 * sin, 0.5 * cos, 0.7).normalize() * 0.6;
        let corner = at(0.6 + 0.5 * angle, 1.4 + 0.5 * sin, 0.4);
        add_panel(&mut scene, corner, u, v, diffuse(0.3 + 0.1 * angle));
    }
    scene.lights.push(point_light(at(1.3, 1.1, 1.9), 300.0));
    scene.lights.push(point_light(at(2.9, 2.2, 0.3), 100.0));
    scene
}
