//! What was understood, for people.

use super::panes::panes;
use crate::project::Project;
use glam::DVec3;
use quasilux_inspection::Finding;
use quasilux_report::number::{brief, plural};
use quasilux_scene::bsdf::Pane;
use quasilux_scene::{Bsdf, Environment, Light, Scene, SensorShape, SkyFacts};
use quasilux_text::printable;
use std::fmt::Write;

/// Lights, sensors, materials that are listed.
const MAX_LISTED: usize = 40;
/// Digits of lengths in m.
const DIGITS: i32 = 4;

/// A paragraph for the geometry, and one line for each material, light, sensor and camera.
pub(super) fn summary(project: &Project) -> String {
    let scene = &project.loaded.scene;
    let mut text = format!("{}\n", printable(&project.name));
    let mut section = |name: &str, lines: Vec<String>| {
        let more = lines.len().saturating_sub(MAX_LISTED);
        for (i, line) in lines.iter().take(MAX_LISTED).enumerate() {
            let name = if i == 0 { name } else { "" };
            writeln!(text, "  {name:<11} {}", printable(line)).expect("strings grow");
        }
        if more > 0 {
            writeln!(text, "  {:<11} and {more} more", "").expect("strings grow");
        }
    };
    section("geometry", geometry(project));
    section("materials", materials(scene));
    section("lights", (0..scene.lights.len()).map(|i| light(project, i)).collect());
    section("from files", project.loaded.luminaire_notes.clone());
    let flux_lm = brief(scene.flux_lm(), 5);
    section(
        "flux",
        vec![format!("{flux_lm} lm of {}", plural(scene.lights.len() as u64, "light"))],
    );
    let is_of_a_year = project.loaded.sky.as_ref().is_some_and(SkyFacts::lacks_time);
    section("outside", scene.environment.iter().map(|it| outside(it, is_of_a_year)).collect());
    section("sensors", scene.sensors.iter().map(sensor).collect());
    section("cameras", scene.cameras.iter().map(camera).collect());
    text
}

fn outside(environment: &Environment, is_of_a_year: bool) -> String {
    let openings = plural(environment.openings.len() as u64, "named opening");
    if is_of_a_year {
        return format!("a weather file in all of its hours (`quasilux annual`), {openings}");
    }
    let lx = brief(environment.horizontal_illuminance_lx(), 5);
    let sun = match environment.sun {
        Some(sun) => {
            let (altitude, azimuth) = (sun.centre.altitude_deg, sun.centre.azimuth_deg);
            format!("the sun at {altitude:.1} degrees, {azimuth:.1} degrees from north")
        }
        None => "no sun".to_owned(),
    };
    format!("{lx} lx on a horizontal plane, {sun}, {openings}")
}

/// Findings and warnings, or that there are none.
pub(super) fn oddities(project: &Project, findings: &[Finding]) -> String {
    let mut text = String::new();
    for warning in &project.loaded.warnings {
        writeln!(text, "warning: {}", printable(&warning.to_string())).expect("strings grow");
    }
    for (number, finding) in findings.iter().enumerate() {
        let finding = printable(&finding.to_string());
        writeln!(text, "warning {}: {finding}", number + 1).expect("strings grow");
    }
    if findings.is_empty() {
        text += "nothing odd was found in the scene\n";
    }
    text
}

fn geometry(project: &Project) -> Vec<String> {
    let (scene, places) = (&project.loaded.scene, &project.loaded.places);
    let files: Vec<&str> = places.geometry.iter().map(|file| file.value.as_str()).collect();
    let (up, unit) = (if places.y_is_up { "y" } else { "z" }, places.unit.name());
    let triangles = plural(scene.mesh.triangles.len() as u64, "triangle");
    let objects = plural(scene.mesh.objects.len() as u64, "object");
    let mut lines = vec![format!(
        "{}: {triangles} in {objects}; read with {up} up, in {unit}",
        files.join(", ")
    )];
    if let Some([low, high]) = scene.mesh.bounds() {
        let [x, y, z] = (high - low).to_array().map(|edge| brief(edge, DIGITS));
        lines.push(format!("{x} x {y} m, {z} m high, from {} to {}", place(low), place(high)));
    }
    lines
}

fn materials(scene: &Scene) -> Vec<String> {
    let mut areas_m2 = vec![0.0; scene.materials.len()];
    for triangle in 0..scene.mesh.triangles.len() as u32 {
        areas_m2[scene.mesh.material_of[triangle as usize] as usize] +=
            scene.mesh.area_m2(triangle);
    }
    let width = scene.materials.iter().map(|m| m.name.chars().count()).max().unwrap_or(0).min(24);
    let numbered = (0..).zip(&scene.materials).zip(areas_m2);
    let used = numbered.filter(|(_, area_m2)| *area_m2 > 0.0);
    let line = |((number, material), area_m2): ((u32, &quasilux_scene::Material), f64)| {
        let reflectance = match material.bsdf.reflectance() {
            Some(reflectance) if reflectance.is_grey() => {
                format!(", reflectance {}", brief(reflectance.luminance(), 3))
            }
            Some(reflectance) => {
                let [r, g, b] = reflectance.0.map(|channel| brief(channel, 3));
                format!(", reflectance [{r}, {g}, {b}]")
            }
            None => pane(&material.bsdf),
        };
        let count = match material.bsdf {
            Bsdf::Pane(_) => format!(" in {}", plural(panes(&scene.mesh, number) as u64, "pane")),
            _ => String::new(),
        };
        let (kind, area_m2) = (material.bsdf.kind(), brief(area_m2, DIGITS));
        format!("{:<width$} {kind}{reflectance}, {area_m2} m²{count}", material.name)
    };
    used.map(line).collect()
}

/// What a pane does at normal incidence, and what a measured one lets through at 60 degrees.
fn pane(bsdf: &Bsdf) -> String {
    let Bsdf::Pane(pane) = bsdf else {
        return String::new();
    };
    let (transmittance, front_reflectance, back_reflectance) = match pane {
        Pane::Clear { eta } => return at_normal(Pane::clear_transmittance(*eta)),
        Pane::Tinted { transmittance, .. } => return at_normal(transmittance.luminance()),
        Pane::Measured { transmittance, front_reflectance, back_reflectance } => {
            (transmittance, front_reflectance, back_reflectance)
        }
    };
    let [t, front, back] = [transmittance, front_reflectance, back_reflectance]
        .map(|table| brief(table.at_angle(0.0), 3));
    let aslant = brief(transmittance.at_angle(60_f64.to_radians()), 3);
    let reflected = if front == back { front } else { format!("{front} (front), {back} (back)") };
    format!(", transmittance {t} ({aslant} at 60 degrees), reflectance {reflected}")
}

fn at_normal(transmittance: f64) -> String {
    format!(", transmittance {}", brief(transmittance, 3))
}

fn light(project: &Project, index: usize) -> String {
    let scene = &project.loaded.scene;
    let light = &scene.lights[index];
    let flux_lm = brief(light.flux_lm(), 5);
    let number = index + 1;
    match light {
        Light::Luminaire(luminaire) => {
            let file = luminaire.photometry.name();
            let turn = luminaire.world_from_luminaire;
            let (aim, c0) = (direction(-turn.z_axis), direction(turn.x_axis));
            let form = if luminaire.is_area() { luminaire.shape.name() } else { "point" };
            let maintenance = project.loaded.maintenance_factor;
            let new = match maintenance {
                1.0 => String::new(),
                factor => format!(" of {} when new", brief(light.flux_lm() / factor, 5)),
            };
            format!(
                "{number} {file}, {flux_lm} lm{new}, {form} at {}, aim {aim}, C0 {c0}, dimming {}",
                place(luminaire.position),
                brief(luminaire.dimming / maintenance, 3)
            )
        }
        Light::Point(point) => {
            format!("{number} point, {flux_lm} lm at {}", place(point.position))
        }
        Light::Area(area) => format!(
            "{number} area \"{}\", {flux_lm} lm, {} cd/m² on {} m² of {} triangles",
            scene.materials[area.material as usize].name,
            brief(area.luminance_cd_m2, 4),
            brief(area.area_m2, DIGITS),
            area.triangles.len()
        ),
    }
}

fn sensor(sensor: &quasilux_scene::Sensor) -> String {
    let name = &sensor.name;
    match &sensor.shape {
        SensorShape::Grid(grid) => {
            let [columns, rows] = grid.counts;
            let [u, v] = [grid.u, grid.v].map(|edge| brief(edge.length(), DIGITS));
            let (from, normal) = (place(grid.origin), direction(grid.normal));
            let target = grid.target_lx.map(|lx| format!(", target {} lx", brief(lx, DIGITS)));
            let target = target.unwrap_or_default();
            format!("{name}: grid of {columns} x {rows} points on {u} x {v} m from {from}, normal ")
                + &normal
                + &target
        }
        SensorShape::Points(points) => {
            let first = points.first().map_or_else(String::new, |p| place(p.position));
            format!("{name}: {} points, the first at {first}", points.len())
        }
    }
}

fn camera(camera: &quasilux_scene::Camera) -> String {
    let [width, height] = camera.resolution;
    format!(
        "{}: {width} x {height} pixels from {} toward {}",
        camera.name,
        place(camera.position),
        place(camera.target)
    )
}

fn place(at: DVec3) -> String {
    let [x, y, z] = at.to_array().map(|c| brief(c, 5));
    format!("[{x}, {y}, {z}]")
}

/// A direction, in a word where it runs along an axis.
fn direction(to: DVec3) -> String {
    let axes = [
        (DVec3::NEG_Z, "down"),
        (DVec3::Z, "up"),
        (DVec3::X, "+x"),
        (DVec3::NEG_X, "-x"),
        (DVec3::Y, "+y"),
        (DVec3::NEG_Y, "-y"),
    ];
    let axis = axes.iter().find(|(axis, _)| axis.dot(to) > 1.0 - 1e-9);
    axis.map_or_else(|| place((to * 1e4).round() / 1e4), |(_, name)| (*name).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_scene::Rgb;

    /// A clear pane of glass lets through 92 %: 2 eta / (eta^2 + 1).
    #[test]
    fn panes_tell_what_they_let_through() {
        let clear = Bsdf::Pane(Pane::Clear { eta: 1.5 });
        assert_eq!(pane(&clear), ", transmittance 0.923");
        let transmittance = Rgb::grey(0.6);
        assert_eq!(
            pane(&Bsdf::Pane(Pane::Tinted { eta: 1.5, transmittance })),
            ", transmittance 0.6"
        );
    }
}
