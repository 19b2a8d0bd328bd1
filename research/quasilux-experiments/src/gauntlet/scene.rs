//! A room as a scene of quasilux.

use super::room::{Face, Lamp, Room, Shine, Surface};
use crate::building::{add_material, add_quad, grey, lamp, points, shine};
use glam::DVec3;
use quasilux_photometry::{LuminousShape, read_ies};
use quasilux_scene::bsdf::Mirror;
use quasilux_scene::light::{Luminaire, Placement};
use quasilux_scene::{Bsdf, Light, Rgb, Scene};
use std::sync::Arc;

impl Room {
    /// The same room for quasilux, with one sensor.
    #[must_use]
    pub fn scene(&self) -> Scene {
        let mut scene = Scene::default();
        let mut known: Vec<Surface> = Vec::new();
        for face in &self.faces {
            add_face(&mut scene, face, &mut known);
        }
        self.lamps.iter().for_each(|lamp| add_lamp(&mut scene, lamp));
        let places: Vec<_> =
            self.places.iter().map(|place| (place.position, place.normal)).collect();
        scene.sensors.push(points(&places));
        scene
    }
}

/// What shines is a material of its own; of others there is one for each surface that is `known`.
fn add_face(scene: &mut Scene, face: &Face, known: &mut Vec<Surface>) {
    if face.luminance_cd_m2 > 0.0 {
        let material = add_material(scene, bsdf(face.surface));
        // Numbers of materials and of what is known go together.
        known.push(Surface::Grey(f64::NAN));
        let first = scene.mesh.triangles.len() as u32;
        add_quad(scene, face.corners, material);
        shine(scene, material, first, face.luminance_cd_m2);
        return;
    }
    let number = known.iter().position(|surface| *surface == face.surface);
    let material = number.map_or_else(
        || {
            known.push(face.surface);
            add_material(scene, bsdf(face.surface))
        },
        |number| number as u32,
    );
    add_quad(scene, face.corners, material);
}

fn bsdf(surface: Surface) -> Bsdf {
    match surface {
        Surface::Grey(reflectance) => grey(reflectance),
        Surface::Mirror(reflectance) => {
            Bsdf::Mirror(Mirror { reflectance: Rgb::grey(reflectance) })
        }
    }
}

fn add_lamp(scene: &mut Scene, Lamp { position, shine }: &Lamp) {
    match shine {
        Shine::Everywhere(intensity_cd) => lamp(scene, *position, *intensity_cd),
        Shine::Table { aim, rows } => {
            let file = file(rows);
            let photometry =
                read_ies(file.as_bytes()).expect("the file is written by the rules").photometry;
            let c0 = if aim.x.abs() < 0.8 { DVec3::X } else { DVec3::Y };
            let placement = Placement { aim: *aim, c0, rotation_rad: 0.0 };
            let world_from_luminaire =
                placement.world_from_luminaire().expect("c0 is not along aim");
            scene.lights.push(Light::Luminaire(Luminaire {
                photometry: Arc::new(photometry),
                position: *position,
                world_from_luminaire,
                dimming: 1.0,
                shape: LuminousShape::POINT,
            }));
        }
    }
}

/// One half-plane, which stands for all.
fn file(rows: &[[f64; 2]]) -> String {
    let joined = |k: usize| {
        let column: Vec<String> = rows.iter().map(|row| row[k].to_string()).collect();
        column.join("\n")
    };
    format!(
        "IESNA:LM-63-2002\n[TEST] Lamp of quasilux experiment gauntlet\nTILT=NONE\n\
         1 -1 1 {} 1 1 2 0 0 0\n1 1 0\n{}\n0\n{}\n",
        rows.len(),
        joined(0),
        joined(1),
    )
}
