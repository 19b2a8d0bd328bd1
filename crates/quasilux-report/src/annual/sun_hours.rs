//! How long the sun shines on points: over a year of weather, were all of it clear, and on a day of
//! the equinox.

use super::calendar::Calendar;
use quasilux_scene::Scene;
use quasilux_sky::{LocalTime, Site, SkyError, SkyPoint};
use quasilux_transport::{Settings, seen_suns};

/// The sun shines where it gives more across its rays, in lx: the 120 W/m2 of the World
/// Meteorological Organization, at 100 lm/W, as a low sun has.
const SUNSHINE_LX: f64 = 12_000.0;
/// A day of the equinox. Which year differs by less than a minute of sunlight.
const EQUINOX: [u32; 2] = [3, 20];
const YEAR: i32 = 2026;
/// Between two looks at the sun of that day, in s.
const STEP_S: u32 = 120;

/// How long a point is in the sun, in h: as long as its ray to the sun's centre is free but for
/// clear panes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunHours {
    /// In the intervals of the weather file in which the sun shines.
    pub sunlit_h: f64,
    /// In all of them in which the sun is above the horizon.
    pub clear_sky_sunlit_h: f64,
    /// On a clear day of the equinox, 20 March.
    pub equinox_sunlit_h: f64,
}

/// Of all points of all sensors. Runs in the rayon pool that the call is made in.
///
/// # Errors
/// For times beyond the range of the solar position.
pub fn sun_hours(
    scene: &Scene,
    calendar: &Calendar,
    site: &Site,
    settings: &Settings,
) -> Result<Vec<SunHours>, SkyError> {
    let up = calendar.skies.iter().filter(|sky| sky.sun.altitude_deg > 0.0);
    let mut suns: Vec<SkyPoint> = up.clone().map(|sky| sky.sun).collect();
    let shines: Vec<bool> = up.map(|sky| sky.sun_normal_illuminance_lx > SUNSHINE_LX).collect();
    let of_year = suns.len();
    for step in 0..86_400 / STEP_S {
        let [month, day] = EQUINOX;
        let seconds = f64::from(STEP_S) * (f64::from(step) + 0.5);
        let sun = site.sun_at(&LocalTime::new(YEAR, month, day, seconds)?)?;
        suns.extend(Some(sun).filter(|sun| sun.altitude_deg > 0.0));
    }
    let hours = |is_seen: &[bool]| {
        let (year, equinox) = is_seen.split_at(of_year);
        let seen = |it: &[bool]| it.iter().filter(|is_seen| **is_seen).count() as f64;
        let in_sunshine =
            year.iter().zip(&shines).filter(|(is_seen, shines)| **is_seen && **shines);
        SunHours {
            sunlit_h: calendar.interval_h * in_sunshine.count() as f64,
            clear_sky_sunlit_h: calendar.interval_h * seen(year),
            equinox_sunlit_h: seen(equinox) * f64::from(STEP_S) / 3600.0,
        }
    };
    Ok(seen_suns(scene, &suns, settings, hours))
}

impl SunHours {
    /// What results call them.
    pub(super) const NAMES: [&'static str; 3] =
        ["sunlit_h", "clear_sky_sunlit_h", "equinox_sunlit_h"];

    /// In the order of the names.
    pub(super) fn values(&self) -> [f64; 3] {
        [self.sunlit_h, self.clear_sky_sunlit_h, self.equinox_sunlit_h]
    }
}
