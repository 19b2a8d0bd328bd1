//! Rooms, references and a short run.

use super::brute::brute_scene;
use super::*;
use quasilux_brute::{Limits, solve_until};
use quasilux_bvh::TriangleBvh;
use quasilux_inspection::{Check, inspect};
use quasilux_scene::{LengthUnit, Places, Position, Scene};
use quasilux_transport::{Settings, check, simulate};

/// The same room without any reflection but that of mirrors.
fn black(number: u64) -> Room {
    let mut room = room(number);
    for face in &mut room.faces {
        if let Surface::Grey(reflectance) = &mut face.surface {
            *reflectance = 0.0;
        }
    }
    room
}

#[test]
fn rooms_follow_from_their_numbers() {
    for number in 0..4 * families() {
        let made = room(number);
        assert_eq!(made, room(number));
        assert!((6..=10).contains(&made.places.len()), "{}: {}", made.family, made.places.len());
        assert!(!made.parameters.is_empty());
        assert_ne!(made.digest(), room(number + families()).digest());
        let scene = made.scene();
        assert!(check(&scene, &Settings::default()).is_ok(), "{}", made.family);
    }
}

/// Where things of a scene would be described, were they read from a file.
fn places(scene: &Scene) -> Places {
    let place = Position { line: 1, column: 1 };
    let (lights, materials) = (scene.lights.len(), scene.materials.len());
    Places {
        file: "room".to_owned(),
        scene: place,
        geometry: Vec::new(),
        y_is_up: false,
        unit: LengthUnit::Metre,
        lights: vec![place; lights],
        photometry: vec![None; lights],
        sensors: vec![place; scene.sensors.len()],
        cameras: vec![place; scene.cameras.len()],
        materials: vec![None; materials],
        is_described: vec![true; materials],
    }
}

/// Light that is hard to find is no fault of a scene.
#[test]
fn hard_rooms_are_right() {
    let mut told = Vec::new();
    for number in 0..6 * families() {
        let made = room(number);
        let scene = made.scene();
        let triangles = 0..scene.mesh.triangles.len() as u32;
        let hierarchy = TriangleBvh::build(triangles.map(|t| scene.mesh.corners(t)).collect());
        let findings = inspect(&scene, &places(&scene), &hierarchy);
        // Rooms are whiter than paint, and have holes, on purpose.
        let meant = [Check::HighReflectance, Check::Hole];
        let odd = findings.iter().filter(|finding| !meant.contains(&finding.check));
        told.extend(odd.map(|finding| format!("room {number}, {}: {finding}", made.family)));
    }
    assert!(told.is_empty(), "{}", told.join("\n"));
}

/// One room of each family without interreflection: what comes straight from lights, or over
/// mirrors, by both programs. 5 standard errors of both; seeds 1. An error of 5 % at a well-lit
/// point would be noticed. All of the brute program's paths are traced: a few that agree may all
/// have missed a lamp in a mirror.
#[test]
fn both_programs_agree_on_direct_light_in_each_family() {
    for number in 0..families() {
        let room = black(number);
        let limits = Limits { relative_error: 0.0, paths: 1 << 16 };
        let known = solve_until(&brute_scene(&room), limits, 1, || true);
        let settings =
            Settings { rel_tol: 0.01, max_samples: Some(1 << 10), ..Settings::default() };
        let estimates = simulate(&room.scene(), &settings, &mut ());
        for (point, known) in estimates.point_intervals(0).iter().zip(known) {
            let error = 0.5 * point.half_width.unwrap_or(f64::INFINITY) + known.standard_error_lx;
            let distance = (point.value - known.lx).abs();
            let family = room.family;
            assert!(distance <= 5.0 * error + 1e-6 * known.lx, "{family}: {point:?}, {known:?}");
        }
    }
}

/// Two easy rooms, by so many samples as a busy machine and an idle one both take.
#[test]
fn easy_rooms_are_passed() {
    let limit = Duration::MAX;
    let mut effort = Effort { rooms: 2, seeds: 1, seed: 1, limit, max_samples: Some(1 << 8) };
    let known = |number| {
        let room = room(number);
        let limits = Limits { relative_error: 0.02, paths: 1 << 13 };
        let points = solve_until(&brute_scene(&room), limits, 1, || true)
            .into_iter()
            .map(|it| Reference { lx: it.lx, standard_error_lx: it.standard_error_lx })
            .collect();
        RoomReferences { number, digest: room.digest(), points }
    };
    let outcome = outcome(&effort, vec![known(0), known(1)]);
    assert!(outcome.passed, "{}", outcome.markdown);
    effort.rooms = 1;
    let stale = RoomReferences { digest: "0".to_owned(), ..known(0) };
    let refused = super::outcome(&effort, vec![stale]);
    assert!(!refused.passed && refused.markdown.contains("another generator"));
}
