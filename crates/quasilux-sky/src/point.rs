//! A place in the sky.

use libm::{asin, atan2, cos, sin};

/// A direction by its angles above the horizon and around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyPoint {
    /// Above the horizon, -90 to 90.
    pub altitude_deg: f64,
    /// Clockwise from north, seen from above.
    pub azimuth_deg: f64,
}

impl SkyPoint {
    /// The altitude of the sun at the end of civil twilight: by then the sky has less than a
    /// ten-thousandth of a day's light.
    pub const NIGHT_DEG: f64 = -6.0;

    /// The unit vector towards it: x east, y north, z up.
    #[must_use]
    pub fn to_direction(self) -> [f64; 3] {
        let (altitude, azimuth) = (self.altitude_deg.to_radians(), self.azimuth_deg.to_radians());
        let horizontal = cos(altitude);
        [horizontal * sin(azimuth), horizontal * cos(azimuth), sin(altitude)]
    }

    /// Where a unit vector points; the azimuth is in [0, 360).
    #[must_use]
    pub fn from_direction([x, y, z]: [f64; 3]) -> Self {
        let azimuth_deg = atan2(x, y).to_degrees();
        Self {
            altitude_deg: asin(z.clamp(-1.0, 1.0)).to_degrees(),
            azimuth_deg: if azimuth_deg < 0.0 { azimuth_deg + 360.0 } else { azimuth_deg },
        }
    }
}

/// The cosine of the angle between two unit vectors.
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_a_compass() {
        let direction =
            |altitude_deg, azimuth_deg| SkyPoint { altitude_deg, azimuth_deg }.to_direction();
        let near =
            |a: [f64; 3], b| a.iter().zip(b).all(|(a, b): (&f64, f64)| (a - b).abs() < 1e-15);
        assert!(near(direction(0.0, 90.0), [1.0, 0.0, 0.0]), "east");
        assert!(near(direction(0.0, 0.0), [0.0, 1.0, 0.0]), "north");
        assert!(near(direction(90.0, 77.0), [0.0, 0.0, 1.0]), "zenith");
        for (altitude_deg, azimuth_deg) in [(12.0, 0.0), (-33.0, 200.0), (89.0, 359.5)] {
            let point = SkyPoint { altitude_deg, azimuth_deg };
            let again = SkyPoint::from_direction(point.to_direction());
            assert!((again.altitude_deg - altitude_deg).abs() < 1e-10);
            assert!((again.azimuth_deg - azimuth_deg).abs() < 1e-10);
        }
    }
}
