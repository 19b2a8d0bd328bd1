//! Places and directions in words.

use crate::number::brief;
use glam::DVec3;

/// Directions nearer than this to an axis are named after it: its cosine (half a degree).
const COS_NEAR: f64 = 0.999_96;

/// A length in m without its unit.
pub(crate) fn metres(length_m: f64) -> String {
    // Rounded to a millimetre, but not to nothing.
    let digits = if length_m.abs() < 1.0 { 3 } else { 4 + digits_before(length_m) };
    brief(length_m, digits)
}

fn digits_before(length_m: f64) -> i32 {
    crate::number::decimal_exponent(length_m).map_or(0, |e| e.clamp(0, 6))
}

/// A place by its coordinates.
pub(crate) fn place(point_m: DVec3) -> String {
    let [x, y, z] = point_m.to_array().map(metres);
    format!("({x}, {y}, {z}) m")
}

/// Where a luminaire is aimed.
pub(crate) fn aim(direction: DVec3) -> String {
    if -direction.z > COS_NEAR {
        return "straight down".to_owned();
    }
    if direction.z > COS_NEAR {
        return "straight up".to_owned();
    }
    let tilt = libm::acos((-direction.z).clamp(-1.0, 1.0)).to_degrees();
    format!("tilted {}\u{b0} toward {}", brief(tilt, 3), toward(direction))
}

/// A direction; one that is level is named by its axis or its angle from +x.
pub(crate) fn toward(direction: DVec3) -> String {
    let direction = direction.normalize_or_zero();
    if direction.z.abs() > COS_NEAR {
        return (if direction.z > 0.0 { "+z" } else { "-z" }).replace('-', "\u{2212}");
    }
    let level = direction.truncate().normalize_or_zero();
    let axes = [("+x", level.x), ("\u{2212}x", -level.x), ("+y", level.y), ("\u{2212}y", -level.y)];
    axes.iter().find(|(_, share)| *share > COS_NEAR).map_or_else(
        || {
            let angle = libm::atan2(level.y, level.x).to_degrees();
            format!("{}\u{b0} from +x", brief(angle, 3).replace('-', "\u{2212}"))
        },
        |(name, _)| (*name).to_owned(),
    )
}

/// Which way a face looks.
pub(crate) fn facing(normal: DVec3) -> String {
    match normal.normalize_or_zero().z {
        z if z > COS_NEAR => "facing up".to_owned(),
        z if z < -COS_NEAR => "facing down".to_owned(),
        z if z.abs() < 0.01 => format!("facing {}", toward(normal)),
        z => {
            let angle = libm::asin(z.clamp(-1.0, 1.0)).to_degrees();
            let way = if z > 0.0 { "up" } else { "down" };
            format!("facing {}, {}\u{b0} {way}", toward(normal), brief(angle.abs(), 2))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_named_as_people_name_them() {
        assert_eq!(aim(DVec3::NEG_Z), "straight down");
        let tilted = DVec3::new(0.5, 0.0, -libm::sqrt(0.75));
        assert_eq!(aim(tilted), "tilted 30\u{b0} toward +x");
        assert_eq!(toward(DVec3::new(1.0, 1.0, 0.0)), "45\u{b0} from +x");
        assert_eq!(toward(DVec3::NEG_Y), "\u{2212}y");
        assert_eq!(facing(DVec3::Z), "facing up");
        assert_eq!(facing(DVec3::NEG_X), "facing \u{2212}x");
        assert_eq!(facing(DVec3::new(0.0, 1.0, 1.0)), "facing +y, 45\u{b0} up");
    }

    #[test]
    fn lengths_keep_their_millimetres() {
        let texts = [0.0, 2.85, 12.3456, 2700.0, 0.0001].map(metres);
        assert_eq!(texts, ["0", "2.85", "12.346", "2700", "0.0001"]);
    }
}
