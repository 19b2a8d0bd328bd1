//! Things of a scene, and places in it, as messages name them.

use glam::DVec3;
use quasilux_scene::{Light, Mesh, Places};

/// A position in m, to the millimetre.
pub(crate) fn position(at: DVec3) -> String {
    let [x, y, z] = at.to_array().map(number);
    format!("[{x}, {y}, {z}]")
}

/// A length in m, to the millimetre or to three digits.
pub(crate) fn length(length_m: f64) -> String {
    format!("{} m", number(length_m))
}

fn number(value: f64) -> String {
    if value.abs() >= 1e6 {
        return format!("{value:.3e}");
    }
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// What a light is, with its number among lights of its kind.
pub(crate) fn light(places: &Places, lights: &[Light], index: usize) -> String {
    match (&lights[index], &places.photometry[index]) {
        (Light::Luminaire(_), Some(file)) => format!("luminaire {} (\"{file}\")", index + 1),
        (Light::Luminaire(_), None) => format!("luminaire {}", index + 1),
        (Light::Point(_) | Light::Area(_), _) => {
            let luminaires = lights[..index].iter();
            let luminaires = luminaires.filter(|light| matches!(light, Light::Luminaire(_)));
            format!("light {}", index + 1 - luminaires.count())
        }
    }
}

/// The object that a triangle belongs to.
pub(crate) fn object(mesh: &Mesh, triangle: u32) -> &str {
    &mesh.objects[mesh.object_of[triangle as usize] as usize]
}

/// A number of things, in the right number.
pub(crate) fn count(count: usize, one: &str, many: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {many}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(position(DVec3::new(1.5, -1e-9, 2700.0)), "[1.5, 0, 2700]");
        assert_eq!(length(0.05), "0.05 m");
        assert_eq!(length(2.5e7), "2.500e7 m");
    }
}
