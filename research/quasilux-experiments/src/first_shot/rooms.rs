//! The two rooms: one where a narrow beam lights a small part of the floor, and one where most
//! light of a bare lamp lands on a small part of the wall beside it.

use crate::building::{grey, lamp, points, room};
use glam::{DMat3, DVec3};
use quasilux_photometry::{LuminousShape, read_ies};
use quasilux_scene::light::Luminaire;
use quasilux_scene::{Light, Scene};
use std::sync::Arc;

/// Width, depth and height.
const SIZE_M: DVec3 = DVec3::new(4.0, 3.0, 2.5);
/// Of all surfaces.
const REFLECTANCE: f64 = 0.5;
/// A beam of 10 degrees straight down, and a faint glow from there to the horizon, in candela.
const SPOTLIGHT: &str = "IESNA:LM-63-2002\n[TEST] Spotlight of quasilux experiment \
    first-shot\nTILT=NONE\n\
    1 -1 1 6 1 1 2 0 0 0\n1 1 1\n0 4 6 30 90 180\n0\n9000 8000 300 40 0 0\n";

/// A room, and what makes it hard.
pub(super) struct Room {
    pub(super) name: &'static str,
    pub(super) why: &'static str,
    pub(super) scene: Scene,
}

/// Both rooms.
pub(super) fn all() -> [Room; 2] {
    [spotlight(), near_wall()]
}

fn spotlight() -> Room {
    let mut scene = empty();
    let photometry = read_ies(SPOTLIGHT.as_bytes()).expect("the file is written by the rules");
    scene.lights.push(Light::Luminaire(Luminaire {
        photometry: Arc::new(photometry.photometry),
        position: DVec3::new(1.4, 1.4, 2.4),
        world_from_luminaire: DMat3::IDENTITY,
        dimming: 1.0,
        shape: LuminousShape::POINT,
    }));
    Room { name: "spotlight", why: "a beam of 10 degrees from the ceiling", scene }
}

fn near_wall() -> Room {
    let mut scene = empty();
    lamp(&mut scene, DVec3::new(0.1, 1.1, 1.3), 100.0);
    Room { name: "near a wall", why: "a bare lamp of 100 cd, 10 cm from a wall", scene }
}

/// The room without its light, and nine points at table height.
fn empty() -> Scene {
    let mut scene = room(SIZE_M, grey(REFLECTANCE));
    let places = [0.6, 2.0, 3.3].map(|x| [0.5, 1.5, 2.4].map(|y| DVec3::new(x, y, 0.75)));
    let places: Vec<_> = places.as_flattened().iter().map(|&place| (place, DVec3::Z)).collect();
    scene.sensors.push(points(&places));
    scene
}
