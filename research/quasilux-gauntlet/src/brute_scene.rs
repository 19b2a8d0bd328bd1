//! A room as a scene of the brute-force program.

use crate::room::{Face, Lamp, Lookout, Parallelogram, Room, SensorPlace, Shine, Surface};
use glam::DVec3;
use quasilux_brute as brute;

/// The same room, with the places to look at; `None` where that program does not know what is in
/// the room.
#[must_use]
pub fn brute_scene(room: &Room) -> Option<brute::Scene> {
    let is_known =
        |face: &Face| matches!(face.surface, Surface::Grey(_) | Surface::Mirror(_));
    let has_cells = room.places.iter().any(|place| place.cell.is_some());
    if room.outside.is_some() || has_cells || !room.faces.iter().all(is_known) {
        return None;
    }
    let [hint_share, late_hint_share] = room.hint_shares;
    let hint = |it: &Lookout| {
        let Parallelogram { corner, u, v } = it.shape;
        brute::Lookout::new(corner, u, v).from_within(it.low, it.high)
    };
    let sensor = |it: &SensorPlace| brute::Sensor { position: it.position, normal: it.normal };
    Some(brute::Scene {
        triangles: room.faces.iter().flat_map(triangles).collect(),
        lights: room.lamps.iter().map(light).collect(),
        sensors: room.places.iter().map(sensor).collect(),
        hints: room.hints.iter().map(hint).collect(),
        hint_share,
        late_hint_share,
    })
}

fn triangles(face: &Face) -> Vec<brute::Triangle> {
    let surface = match face.surface {
        Surface::Mirror(reflectance) => brute::Surface::Mirror { reflectance },
        Surface::Grey(reflectance) => brute::Surface::Grey { reflectance, two_sided: true },
        _ => brute::Surface::Grey { reflectance: 0.0, two_sided: true },
    };
    let luminance_cd_m2 = face.luminance_cd_m2;
    let triangle = |corners| brute::Triangle { corners, surface, luminance_cd_m2 };
    face.triangles().map(triangle).collect()
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
