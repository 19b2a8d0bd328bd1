//! The furnished room: a lamp over a table, and what else stands in a living room, all of blocks.
//!
//! Blocks stay 1 mm apart and off the walls, so that no two faces coincide. The lamp shines down
//! alone: the ceiling is dark before the second bounce.

use crate::building::{add_block, add_material, add_quad, coloured, grey, room, shine};
use glam::DVec3;
use quasilux_scene::{Bsdf, Camera, Grid, Quantity, Scene, Sensor, SensorShape};

/// Width, depth and height.
const SIZE_M: DVec3 = DVec3::new(4.2, 3.4, 2.6);
/// Luminance of the lamp.
const LUMINANCE_CD_M2: f64 = 6000.0;
/// Of the plane that is measured, which goes from wall to wall.
const PLANE_M: f64 = 0.8;
/// Its cells.
const CELLS: [u32; 2] = [4, 3];
/// What the camera sees, in pixels.
const RESOLUTION: [u32; 2] = [320, 240];

/// Materials: in linear red, green and blue.
const CEILING: [f64; 3] = [0.8, 0.8, 0.78];
const WALL: [f64; 3] = [0.68, 0.65, 0.58];
const RED_WALL: [f64; 3] = [0.55, 0.16, 0.1];
const FLOOR: [f64; 3] = [0.34, 0.22, 0.13];
const WOOD: [f64; 3] = [0.5, 0.33, 0.18];
const SOFA: [f64; 3] = [0.12, 0.24, 0.38];
const RUG: [f64; 3] = [0.5, 0.45, 0.36];
const BOOKS: [[f64; 3]; 4] =
    [[0.45, 0.1, 0.08], [0.1, 0.3, 0.15], [0.6, 0.5, 0.2], [0.15, 0.2, 0.4]];

/// The room with the plane as its sensor.
pub(super) fn measured() -> Scene {
    let mut scene = furnished();
    let (u, v) = (DVec3::X * SIZE_M.x, DVec3::Y * SIZE_M.y);
    let origin = DVec3::Z * PLANE_M;
    let (counts, normal, quantity) = (CELLS, DVec3::Z, Quantity::Mean);
    let grid = Grid { origin, u, v, counts, normal, quantity, target_lx: None };
    scene.sensors.push(Sensor { name: "plane".to_owned(), shape: SensorShape::Grid(grid) });
    scene
}

/// The room as a camera sees it from a corner; every pixel is cut into this many.
pub(super) fn seen(resolution: [u32; 2]) -> Scene {
    let mut scene = furnished();
    scene.cameras.push(Camera {
        name: "corner".to_owned(),
        position: DVec3::new(0.25, 0.2, 1.65),
        target: DVec3::new(2.5, 2.2, 0.95),
        up: DVec3::Z,
        vertical_fov_rad: 62.0_f64.to_radians(),
        resolution,
        samples: None,
        rel_tol: None,
    });
    scene
}

/// The resolution of a full run.
pub(super) const fn resolution() -> [u32; 2] {
    RESOLUTION
}

/// The room in words.
pub(super) fn description() -> String {
    format!(
        "a furnished room of {} m x {} m x {} m, lit by one lamp that shines down on the table, \
         with a red wall",
        SIZE_M.x, SIZE_M.y, SIZE_M.z
    )
}

/// What is measured in words.
pub(super) fn plane() -> String {
    format!("the level plane {PLANE_M} m above the floor, from wall to wall")
}

/// Area of the plane in m^2.
pub(super) fn plane_m2() -> f64 {
    SIZE_M.x * SIZE_M.y
}

fn furnished() -> Scene {
    let mut scene = room(SIZE_M, coloured(WALL));
    // Floor, ceiling, low x, high x, low y, high y: two triangles each.
    for (side, colour) in [(0, FLOOR), (1, CEILING), (3, RED_WALL)] {
        let material = add_material(&mut scene, coloured(colour));
        scene.mesh.material_of[2 * side..2 * side + 2].fill(material);
    }
    add_lamp(&mut scene);
    add_blocks(&mut scene, coloured(WOOD), &table());
    add_blocks(&mut scene, coloured(WOOD), &chair(DVec3::new(1.35, 1.25, 0.0), 0.0));
    add_blocks(&mut scene, coloured(WOOD), &chair(DVec3::new(2.95, 1.35, 0.0), 0.38));
    add_blocks(&mut scene, coloured(WOOD), &shelf());
    add_blocks(&mut scene, coloured(SOFA), &sofa());
    add_blocks(&mut scene, coloured(RUG), &[block([0.9, 0.7, 0.001], [2.7, 1.8, 0.012])]);
    for (number, colour) in BOOKS.into_iter().enumerate() {
        add_blocks(&mut scene, coloured(colour), &books(number));
    }
    add_blocks(&mut scene, grey(0.7), &[block([1.9, 1.4, 0.742], [0.22, 0.3, 0.004])]);
    scene
}

/// A low corner and a size.
type Block = [DVec3; 2];

fn block(low_m: [f64; 3], size_m: [f64; 3]) -> Block {
    [DVec3::from(low_m), DVec3::from(size_m)]
}

fn add_blocks(scene: &mut Scene, bsdf: Bsdf, blocks: &[Block]) {
    let material = add_material(scene, bsdf);
    for [low, size_m] in blocks {
        add_block(scene, *low, *size_m, material);
    }
}

/// A flat housing, open below: its light is 1 mm under it.
fn add_lamp(scene: &mut Scene) {
    let (low, size_m) = (DVec3::new(1.7, 1.45, 1.85), DVec3::new(0.9, 0.3, 0.04));
    add_blocks(scene, grey(0.5), &[[low, size_m]]);
    let material = add_material(scene, grey(0.0));
    let first = scene.mesh.triangles.len() as u32;
    let corners = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];
    let corner = |[x, y]: [f64; 2]| low + DVec3::new(x * size_m.x, y * size_m.y, -0.001);
    add_quad(scene, corners.map(corner), material);
    shine(scene, material, first, LUMINANCE_CD_M2);
}

fn table() -> Vec<Block> {
    let mut blocks = vec![block([1.4, 1.2, 0.7], [1.5, 0.8, 0.04])];
    for x in [1.45, 2.8] {
        for y in [1.25, 1.9] {
            blocks.push(block([x, y, 0.014], [0.05, 0.05, 0.685]));
        }
    }
    blocks
}

/// On four legs, its back at so much of x.
fn chair(corner: DVec3, back_x: f64) -> Vec<Block> {
    let shift = DVec3::new(if back_x == 0.0 { -0.42 } else { 0.03 }, 0.1, 0.014);
    let mut blocks = vec![
        block([0.0, 0.0, 0.42], [0.42, 0.42, 0.04]),
        block([back_x, 0.0, 0.461], [0.04, 0.42, 0.45]),
    ];
    for x in [0.01, 0.37] {
        for y in [0.01, 0.37] {
            blocks.push(block([x, y, 0.0], [0.04, 0.04, 0.419]));
        }
    }
    blocks.into_iter().map(|[low, size_m]| [low + corner + shift, size_m]).collect()
}

/// Along the wall at high x.
fn shelf() -> Vec<Block> {
    let mut blocks = vec![
        block([3.85, 0.5, 0.001], [0.34, 0.03, 1.8]),
        block([3.85, 2.1, 0.001], [0.34, 0.03, 1.8]),
    ];
    let boards =
        (0..5).map(|k| block([3.85, 0.531, 0.05 + 0.4 * f64::from(k)], [0.34, 1.568, 0.025]));
    blocks.extend(boards);
    blocks
}

/// Those of one colour: every fourth of a row on each board.
fn books(number: usize) -> Vec<Block> {
    let mut blocks = Vec::new();
    for board in 0..4_usize {
        for place in (number..22).step_by(4).filter(|place| (place + board) % 7 != 3) {
            let height_m = 0.2 + 0.02 * ((place * 5 + board * 3) % 6) as f64;
            let y = 0.56 + 0.068 * place as f64;
            let z = 0.076 + 0.4 * board as f64;
            blocks.push(block([3.9, y, z], [0.2, 0.06, height_m]));
        }
    }
    blocks
}

/// Along the wall at high y.
fn sofa() -> Vec<Block> {
    vec![
        block([1.0, 2.55, 0.08], [1.9, 0.8, 0.34]),
        block([1.0, 3.16, 0.421], [1.9, 0.2, 0.4]),
        block([0.8, 2.55, 0.08], [0.199, 0.8, 0.52]),
        block([2.901, 2.55, 0.08], [0.199, 0.8, 0.52]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All blocks are in the room, and every surface reflects less than it gets.
    #[test]
    fn all_is_inside() {
        let scene = measured();
        let [low, high] = scene.mesh.bounds().expect("there are walls");
        assert_eq!([low, high], [DVec3::ZERO, SIZE_M]);
        assert!(scene.mesh.triangles.len() > 1000);
        for material in &scene.materials {
            assert!(
                material.bsdf.reflectance().is_some_and(|share| share.0.iter().all(|x| *x < 0.9))
            );
        }
    }
}
