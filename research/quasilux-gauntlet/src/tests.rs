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
        // Rooms are whiter than paint, have holes, are tiny, and have single cells and points that
        // look at a near wall, on purpose.
        let meant = [
            Check::HighReflectance,
            Check::Hole,
            Check::Units,
            Check::GridSize,
            Check::SensorCovered,
        ];
        let odd = findings.iter().filter(|finding| !meant.contains(&finding.check));
        told.extend(odd.map(|it| format!("{} {}: {it}", room.family, room.number)));
    }
    assert!(told.is_empty(), "{}", told.join("\n"));
}

/// Families whose light both programs find at once, among them every surface, lamp and sky.
const EASY: [&str; 9] = [
    "plain box",
    "small panel",
    "luminous ceiling",
    "glossy floor",
    "glass slabs in series",
    "partitions in series",
    "kaleidoscope",
    "skylights",
    "blind in the sun",
];

/// 5 standard errors of both; seeds 1. Each program is better than 3 % at most points, so that an
/// error of 15 % would be noticed, and one of 5 % at the better half of them.
#[test]
fn both_programs_agree_in_easy_families() {
    for family in EASY {
        let room = room_of(family, 0).unwrap();
        let scene = brute_scene(&room);
        let limits = Limits { relative_error: 0.01, paths: 1 << 15 };
        let known = solve_parts(&scene, &brute_parts(&room, &scene), limits, 1, || true);
        let settings = Settings {
            estimator: EstimatorKind::Path,
            rel_tol: 0.01,
            max_samples: Some(1 << 10),
            ..Settings::default()
        };
        let estimates = simulate(&loaded(&room).scene, &settings, &mut ());
        for (slot, known) in room.slots().iter().zip(known) {
            let point = estimates.point_intervals(slot.sensor)[slot.point];
            let own = 0.5 * point.half_width.unwrap_or(f64::INFINITY);
            let error = own + known.standard_error_lx + 1e-6 * known.lx;
            let distance = (point.value - known.lx).abs();
            assert!(distance <= 5.0 * error, "{family} {slot:?}: {point:?}, {known:?}");
        }
    }
}
