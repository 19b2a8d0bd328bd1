//! In which hours blinds are closed.

use super::calendar::Calendar;
use quasilux_scene::{Blinds, BlindsControl, Scene, Sensor};
use quasilux_transport::{Settings, sunlit_points};

/// Sunlight that has blinds closed: on more than this share of the points more than so many lx
/// (IES LM-83).
const SUNLIT_SHARE: f64 = 0.02;
const SUNLIT_LX: f64 = 1000.0;

/// Whether the blinds of a scene, which it has open, are closed: by hour of those with light.
///
/// Runs in the rayon pool that the call is made in.
#[must_use]
pub fn closed_hours(
    blinds: &Blinds,
    scene: &Scene,
    calendar: &Calendar,
    settings: &Settings,
) -> Vec<bool> {
    match &blinds.control {
        BlindsControl::Schedule { is_closed } => {
            let intervals = calendar.intervals.iter().zip(is_closed);
            intervals.filter(|(it, _)| it.sky.is_some()).map(|(_, closed)| *closed).collect()
        }
        BlindsControl::Sunlight { sensor } => {
            let lengths = || scene.sensors.iter().map(Sensor::len);
            let points = match *sensor {
                Some(number) => {
                    let first = lengths().take(number).sum();
                    first..first + lengths().nth(number).unwrap_or(0)
                }
                None => 0..lengths().sum(),
            };
            let limit = SUNLIT_SHARE * points.len() as f64;
            let counts = sunlit_points(scene, &calendar.skies, settings, points, SUNLIT_LX);
            counts.into_iter().map(|count| count as f64 > limit).collect()
        }
    }
}
