//! A room as a scene of the brute-force program, and which part of its light is found how.

use crate::room::{Face, FoundBy, Lamp, Lookout, Parallelogram, Room, SensorPlace, Shine};
use crate::room::{SkyKind, SunPlace, Surface};
use glam::DVec3;
use quasilux_brute::{self as brute, Mode, Part, Source};

/// The same room, with the places to look at.
#[must_use]
pub fn brute_scene(room: &Room) -> brute::Scene {
    let [hint_share, late_hint_share] = room.hint_shares;
    let sun = room.outside.and_then(|outside| outside.sun).map(sun);
    let sky = room.outside.map(|outside| {
        let model = match outside.sky {
            SkyKind::Uniform => brute::SkyModel::Uniform,
            SkyKind::Overcast => brute::SkyModel::StandardOvercast,
        };
        let zenith_luminance_cd_m2 = outside.zenith_cd_m2;
        let sky = brute::Sky { model, zenith_luminance_cd_m2, ground_luminance_cd_m2: 0.0 };
        sky.over_ground(outside.ground_reflectance, sun.as_ref())
    });
    let opening = |it: &Parallelogram| brute::Lookout::new(it.corner, it.u, it.v);
    brute::Scene {
        triangles: room.faces.iter().flat_map(triangles).collect(),
        lights: room.lamps.iter().map(light).collect(),
        sky,
        sun,
        sensors: room.places.iter().map(sensor).collect(),
        hints: room.hints.iter().map(lookout).collect(),
        hint_share,
        late_hint_share,
        aims: room.aims.iter().map(lookout).collect(),
        aim_share: room.aim_share,
        openings: room.ways_in.iter().map(opening).collect(),
        ..brute::Scene::default()
    }
}

/// What shines in the scene, each with the way in which it is found.
#[must_use]
pub fn brute_parts(room: &Room, scene: &brute::Scene) -> Vec<Part> {
    let found = |source: &Source| match source {
        Source::Light(number) => room.lamps[*number].found,
        Source::Emitters => room.emitters_found,
        Source::Sky => room.sky_found,
        Source::Sun => room.sun_found,
    };
    let mode = |found: FoundBy| match found {
        FoundBy::Paths => Mode::Paths,
        FoundBy::Joins => Mode::Joins,
        FoundBy::BeamsAndJoins => Mode::BeamsAndJoins,
        FoundBy::KeyholesAndJoins => Mode::KeyholesAndJoins,
        FoundBy::Photons => Mode::Photons,
    };
    let sources = scene.sources();
    let of = |way: FoundBy| {
        let own: Vec<Source> = sources.iter().copied().filter(|it| found(it) == way).collect();
        (!own.is_empty()).then(|| Part { sources: own, mode: mode(way) })
    };
    FoundBy::ALL.into_iter().filter_map(of).collect()
}

fn lookout(it: &Lookout) -> brute::Lookout {
    let Parallelogram { corner, u, v } = it.shape;
    brute::Lookout::new(corner, u, v).from_within(it.low, it.high)
}

fn sensor(place: &SensorPlace) -> brute::Sensor {
    let &SensorPlace { position, normal, cell, disc_radius_m } = place;
    match cell {
        Some([u, v]) => brute::Sensor::cell(position, u, v, normal),
        None => brute::Sensor::point_with_disc(position, normal, disc_radius_m),
    }
}

fn sun(place: SunPlace) -> brute::Sun {
    brute::Sun { direction: place.direction(), normal_illuminance_lx: place.normal_illuminance_lx }
}

fn triangles(face: &Face) -> Vec<brute::Triangle> {
    let surface = match face.surface {
        Surface::Grey(reflectance) => brute::Surface::grey(reflectance),
        Surface::Mirror(reflectance) => brute::Surface::Mirror { reflectance },
        Surface::Glass(eta) => brute::Surface::Glass { eta },
        Surface::Pane(eta) => brute::Surface::clear_pane(eta),
        Surface::Translucent { reflectance, transmittance } => {
            brute::Surface::Sheet { reflectance, transmittance }
        }
        Surface::Metal { reflectance, roughness } => brute::Surface::metal(reflectance, roughness),
    };
    let luminance_cd_m2 = face.luminance_cd_m2;
    let triangle = |corners| brute::Triangle { corners, surface, luminance_cd_m2 };
    face.triangles().map(triangle).collect()
}

fn light(Lamp { position, shine, .. }: &Lamp) -> brute::PointLight {
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
