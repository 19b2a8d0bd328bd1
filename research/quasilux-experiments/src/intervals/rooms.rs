//! Rooms whose light jumps from one path to the next, or comes by few paths.

use crate::building::{add_block, add_material, add_quad, grey, lamp, points, room};
use glam::DVec3;
use quasilux_scene::bsdf::Mirror;
use quasilux_scene::{Bsdf, Rgb, Scene};

/// Edges of all rooms in m, but of that with a door.
const SIZE_M: DVec3 = DVec3::new(4.0, 3.0, 2.5);
/// Between two storeys, in m.
const SLAB_M: [f64; 2] = [1.25, 1.3];

/// A scene with one sensor point.
pub(super) struct Room {
    pub(super) name: &'static str,
    pub(super) what: &'static str,
    pub(super) scene: Scene,
}

/// Those with jumps first.
pub(super) fn all() -> Vec<Room> {
    vec![
        Room { name: "shadow", what: "a point in the hard shadow of a table", scene: shadow() },
        Room { name: "door", what: "a room lit through a door that is 10 cm ajar", scene: door() },
        Room { name: "beam", what: "a lamp behind a hole makes a dot on the floor", scene: beam() },
        Room {
            name: "glint",
            what: "a chip of mirror throws light at the ceiling",
            scene: glint(),
        },
        Room { name: "wall", what: "a point 2 cm before a wall with a lamp", scene: wall() },
        Room { name: "hole", what: "a white room lit through a hole of 4 cm", scene: hole() },
    ]
}

fn with_point(mut scene: Scene, position: DVec3, n: DVec3) -> Scene {
    scene.sensors.push(points(&[(position, n)]));
    scene
}

fn shadow() -> Scene {
    let mut scene = room(SIZE_M, grey(0.5));
    let top = add_material(&mut scene, grey(0.4));
    add_block(&mut scene, DVec3::new(1.5, 1.0, 0.9), DVec3::new(1.0, 1.0, 0.1), top);
    lamp(&mut scene, DVec3::new(2.0, 1.5, 2.3), 300.0);
    with_point(scene, DVec3::new(2.0, 1.5, 0.5), DVec3::Z)
}

fn door() -> Scene {
    let mut scene = room(DVec3::new(6.0, 3.0, 2.5), grey(0.5));
    let between = add_material(&mut scene, grey(0.5));
    add_block(&mut scene, DVec3::new(3.0, 0.1, -0.1), DVec3::new(0.05, 3.0, 2.7), between);
    lamp(&mut scene, DVec3::new(1.5, 1.5, 2.3), 300.0);
    with_point(scene, DVec3::new(4.5, 2.0, 0.8), DVec3::Z)
}

/// A room of two storeys with a square hole between them.
fn storeys(reflectance: f64, hole_m: f64) -> Scene {
    let mut scene = room(SIZE_M, grey(reflectance));
    let slab = add_material(&mut scene, grey(reflectance));
    let [low, high] = SLAB_M;
    let (x, y) = (2.0, 1.5);
    let half_m = 0.5 * hole_m;
    // All reach out of the room, so that no two surfaces lie in one plane.
    for [from_x, to_x, from_y, to_y] in [
        [-0.1, x - half_m, -0.1, 3.1],
        [x + half_m, 4.1, -0.1, 3.1],
        [x - half_m, x + half_m, -0.1, y - half_m],
        [x - half_m, x + half_m, y + half_m, 3.1],
    ] {
        let size_m = DVec3::new(to_x - from_x, to_y - from_y, high - low);
        add_block(&mut scene, DVec3::new(from_x, from_y, low), size_m, slab);
    }
    scene
}

fn beam() -> Scene {
    let mut scene = storeys(0.5, 0.05);
    lamp(&mut scene, DVec3::new(2.0, 1.5, 1.6), 300.0);
    with_point(scene, DVec3::new(3.0, 0.8, 0.5), DVec3::Z)
}

fn hole() -> Scene {
    let mut scene = storeys(0.8, 0.04);
    lamp(&mut scene, DVec3::new(1.0, 1.0, 2.2), 300.0);
    with_point(scene, DVec3::new(2.5, 1.2, 0.5), DVec3::Z)
}

fn glint() -> Scene {
    let mut scene = room(SIZE_M, grey(0.5));
    let bsdf = Bsdf::Mirror(Mirror { reflectance: Rgb::grey(0.9) });
    let chip = add_material(&mut scene, bsdf);
    let corner = |x: f64, y: f64| DVec3::new(1.0 + x, 1.0 + y, 0.01);
    let corners = [corner(0.0, 0.0), corner(0.05, 0.0), corner(0.05, 0.05), corner(0.0, 0.05)];
    add_quad(&mut scene, corners, chip);
    lamp(&mut scene, DVec3::new(1.5, 1.5, 2.3), 300.0);
    with_point(scene, DVec3::new(2.5, 2.0, 0.8), DVec3::Z)
}

fn wall() -> Scene {
    let mut scene = room(SIZE_M, grey(0.7));
    lamp(&mut scene, DVec3::new(0.15, 1.5, 1.8), 300.0);
    with_point(scene, DVec3::new(0.02, 1.5, 1.0), DVec3::Z)
}
