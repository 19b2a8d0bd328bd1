//! Luminaires, as ies2rad makes them: a shape that shines by a table of intensities over the area
//! that it shows in each direction.

use super::shapes::Shape;
use super::webs::intensities;
use super::words::{Primitive, Words, number};
use super::{Exported, LM_PER_W};
use crate::light::Luminaire;
use glam::DMat3;
use quasilux_photometry::Photometry;
use std::sync::Arc;

/// Functions of the tables, in the frame of the luminaire: nadir along -z, C0 along +x. A ray looks
/// at the shape along D, so that light leaves along -D.
pub(super) const FUNCTIONS: &str = "\
{ Functions of light sources and skies that quasilux exports. }
q_deg : 180/PI;
q_turn(a) : if(a, a, a + 360);
{ Angles of a luminaire: gamma from nadir, C from +x towards +y, in degrees. }
q_gamma = q_deg * Acos(Dz);
q_c = q_turn(q_deg * atan2(-Dy, -Dx));
{ Intensities to radiances: over the area that is seen, of a sphere, a sheet, a box, tubes. }
q_point(v) = v / A1;
q_flat(v) = v / (A1 * abs(Dz));
q_box(v) = v / (A1 * abs(Dx) + A2 * abs(Dy) + A3 * abs(Dz));
q_tube(v) = v / (A1 * sqrt(max(0, 1 - Dz*Dz)) + A2 * abs(Dz));
{ Angles of a sky: altitude, and from +x towards +y, in degrees. }
q_altitude = q_deg * Asin(Dz);
q_around = q_turn(q_deg * atan2(Dy, Dx));
q_sky(v) = v;
";

/// Tables that are there, by the photometry that they are of.
pub(super) type Tables = Vec<(Arc<Photometry>, String)>;

/// Writes a luminaire and, where it is the first of its photometry, the table.
pub(super) fn write(
    light: &Luminaire,
    number: usize,
    tables: &mut Tables,
    words: &mut Words,
    exported: &mut Exported,
) {
    let name = format!("luminaire{number}");
    let table = table_of(&light.photometry, tables, exported);
    let shape = Shape::new(light, &name, exported);
    let pattern = format!("{name}.d");
    let texts = [shape.function, &table, "quasilux.cal", "q_gamma", "q_c"];
    let mut texts: Vec<String> = texts.map(str::to_owned).to_vec();
    texts.push(turned(light.world_from_luminaire));
    let (kind, numbers) = ("brightdata", shape.areas_m2.as_slice());
    words.add(Primitive { modifier: "void", kind, name: &pattern, texts: &texts, numbers });
    words.of_numbers(&pattern, "light", &name, &[light.dimming / LM_PER_W; 3]);
    for (part, surface) in shape.surfaces.iter().enumerate() {
        surface.write(light, &name, &format!("{name}.{part}"), words);
    }
}

/// The name of the table of a photometry.
fn table_of(photometry: &Arc<Photometry>, tables: &mut Tables, exported: &mut Exported) -> String {
    let known = tables.iter().find(|(known, _)| Arc::ptr_eq(known, photometry));
    if let Some((_, name)) = known {
        return name.clone();
    }
    let name = format!("web{}.dat", tables.len());
    exported.add(&name, intensities(photometry));
    tables.push((Arc::clone(photometry), name.clone()));
    name
}

/// Options of `xform` that turn the frame of the luminaire into the world's: about z, y and z.
fn turned(world_from_luminaire: DMat3) -> String {
    let axis = world_from_luminaire.z_axis;
    let tilt = libm::atan2(libm::hypot(axis.x, axis.y), axis.z);
    let (first, last) = if libm::sin(tilt).abs() < 1e-12 {
        // Up or down: one angle says all.
        let x = world_from_luminaire.x_axis * libm::cos(tilt).signum();
        (0.0, libm::atan2(x.y, x.x))
    } else {
        let (x, y) = (world_from_luminaire.x_axis.z, world_from_luminaire.y_axis.z);
        (libm::atan2(y, -x), libm::atan2(axis.y, axis.x))
    };
    let [first, tilt, last] = [first, tilt, last].map(f64::to_degrees);
    format!("-rz {} -ry {} -rz {}", number(first), number(tilt), number(last))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::Placement;
    use glam::DVec3;

    /// `xform` turns about the fixed axes, one option after the other.
    fn by_options(options: &str) -> DMat3 {
        let words: Vec<&str> = options.split_whitespace().collect();
        words.chunks(2).fold(DMat3::IDENTITY, |before, pair| {
            let angle = pair[1].parse::<f64>().expect("an angle").to_radians();
            let turn = match pair[0] {
                "-ry" => DMat3::from_rotation_y(angle),
                "-rz" => DMat3::from_rotation_z(angle),
                other => panic!("{other}"),
            };
            turn * before
        })
    }

    #[test]
    fn options_turn_as_the_luminaire_is_turned() {
        let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z, DVec3::Z];
        let mut aims = axes.to_vec();
        aims.extend([DVec3::new(0.3, -0.5, -0.7), DVec3::new(1e-7, 0.0, -1.0)]);
        for aim in aims {
            for c0 in [DVec3::new(0.2, 0.9, 0.1), DVec3::new(-0.8, 0.1, 0.5)] {
                for rotation_rad in [0.0, 1.0, -2.5] {
                    let placement = Placement { aim, c0, rotation_rad };
                    let wanted = placement.world_from_luminaire().expect("no parallel axes");
                    let found = by_options(&turned(wanted));
                    let error = (found - wanted).to_cols_array();
                    assert!(error.iter().all(|it| it.abs() < 1e-6), "{aim} {c0}: {found}");
                }
            }
        }
    }
}
