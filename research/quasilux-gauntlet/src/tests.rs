//! Rooms, and both programs in them.

use crate::families::ALL;
use crate::*;
use quasilux_brute::{Limits, solve_parts};
use quasilux_bvh::TriangleBvh;
use quasilux_inspection::{Check, inspect};
use quasilux_scene::Loaded;
use quasilux_transport::{EstimatorKind, Settings, check, simulate};

fn rooms(numbers: u64) -> impl Iterator<Item = Room> {
    (0..numbers)
        .flat_map(|number| ALL.iter().map(move |family| room_of(family.name, number).unwrap()))
}

fn loaded(room: &Room) -> Loaded {
    room.load().unwrap_or_else(|error| panic!("{} {}: {error}", room.family, room.number))
}

#[test]
fn rooms_follow_from_family_and_number() {
    assert!(ALL.len() >= 40);
    for room in rooms(3) {
        assert_eq!(room, room_of(room.family, room.number).unwrap());
        assert!((6..=11).contains(&room.places.len()), "{}: {}", room.family, room.places.len());
        assert!(!room.parameters.is_empty());
        let other = room_of(room.family, room.number + 1).unwrap();
        assert_ne!(room.digest(), other.digest(), "{}", room.family);
        assert!(ALL.iter().filter(|family| family.name == room.family).count() == 1);
    }
}

/// Every place has a slot of its own, and the scene has as many values.
#[test]
fn projects_are_loaded_and_places_are_found() {
    for room in rooms(3) {
        let scene = loaded(&room).scene;
        assert!(check(&scene, &Settings::default()).is_ok(), "{}", room.family);
        for (place, slot) in room.places.iter().zip(room.slots()) {
            let point = scene.sensors[slot.sensor].point(slot.point);
            let half = place.cell.map_or(glam::DVec3::ZERO, |[u, v]| 0.5 * (u + v));
            assert!(point.position.distance(place.position + half) < 1e-12, "{}", room.family);
            assert!(point.normal.dot(place.normal) > 1.0 - 1e-12, "{}", room.family);
        }
        let values: usize = scene.sensors.iter().map(quasilux_scene::Sensor::len).sum();
        assert_eq!(values, room.places.len());
    }
}

/// Light that is hard to find is no fault of a scene.
#[test]
fn hard_rooms_are_right() {
    let mut told = Vec::new();
    for room in rooms(6) {
        let loaded = loaded(&room);
        let Loaded { scene, places, .. } = &loaded;
        let warned = loaded.warnings.iter().map(ToString::to_string);
        told.extend(warned.map(|it| format!("{} {}: {it}", room.family, room.number)));
        let triangles = 0..scene.mesh.triangles.len() as u32;
        let hierarchy = TriangleBvh::build(triangles.map(|t| scene.mesh.corners(t)).collect());
        let findings = inspect(scene, places, &hierarchy);
        // Rooms are whiter than paint, have holes, are tiny and have single cells, on purpose.
        let meant = [Check::HighReflectance, Check::Hole, Check::Units, Check::GridSize];
        let odd = findings.iter().filter(|finding| !meant.contains(&finding.check));
        told.extend(odd.map(|it| format!("{} {}: {it}", room.family, room.number)));
    }
    assert!(told.is_empty(), "{}", told.join("\n"));
}
