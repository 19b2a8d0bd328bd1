//! A room as a scene of the brute-force program.

use super::{Face, Lamp, Room, Shine, Surface};
use glam::DVec3;
use quasilux_brute as brute;

/// The same room, with the places to look at.
pub(super) fn brute_scene(room: &Room) -> brute::Scene {
    let [hint_share, late_hint_share] = room.hint_shares;
    let hint = |it: &super::Lookout| {
        let super::Parallelogram { corner, u, v } = it.shape;
        brute::Lookout::new(corner, u, v).from_within(it.low, it.high)
    };
    let sensor = |it: &super::SensorPlace| brute::Sensor::point(it.position, it.normal);
    brute::Scene {
        triangles: room.faces.iter().flat_map(triangles).collect(),
        lights: room.lamps.iter().map(light).collect(),
        sensors: room.places.iter().map(sensor).collect(),
        hints: room.hints.iter().map(hint).collect(),
        hint_share,
        late_hint_share,
        ..brute::Scene::default()
    }
}

fn triangles(face: &Face) -> [brute::Triangle; 2] {
    let [a, b, c, d] = face.corners;
    let surface = match face.surface {
        Surface::Grey(reflectance) => brute::Surface::grey(reflectance),
        Surface::Mirror(reflectance) => brute::Surface::Mirror { reflectance },
    };
    let luminance_cd_m2 = face.luminance_cd_m2;
    [[a, b, c], [a, c, d]].map(|corners| brute::Triangle { corners, surface, luminance_cd_m2 })
}

fn light(Lamp { position, shine }: &Lamp) -> brute::PointLight {
    let row = |&[gamma_deg, intensity_cd]: &[f64; 2]| brute::CandelaRow {
        gamma_rad: gamma_deg.to_radians(),
        intensity_cd,
    };
    let (aim, candela) = match shine {
        Shine::Everywhere(intensity_cd) => (DVec3::Z, brute::Candela::Constant(*intensity_cd)),
        Shine::Table { aim, rows } => (*aim, brute::Candela::Table(rows.iter().map(row).collect())),
    };
    brute::PointLight { position: *position, aim, candela }
}
