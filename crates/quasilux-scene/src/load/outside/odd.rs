//! What cannot shine outside as the project file says: told, and taken as it is.

use crate::Warning;
use crate::environment::{SkyFacts, SkyModel};
use crate::project::{OutsideEntry, OutsideLight, Project};
use quasilux_sky::Sky;

/// The end of civil twilight, and the light of the sky there.
const NIGHT_DEG: f64 = -6.0;
const TWILIGHT_LX: f64 = 10.0;
/// CIE skies that are so thick with clouds that no sun is seen through them.
const OVERCAST: [u8; 6] = [1, 2, 3, 4, 5, 16];

pub(super) fn tell(
    project: &Project,
    entry: &OutsideEntry,
    sky: &Sky,
    facts: &SkyFacts,
    warnings: &mut Vec<Warning>,
) {
    let mut warn = |place, message: String| {
        warnings.push(Warning::new(&project.file, place, message));
    };
    let is_of_a_file = matches!(entry.light, OutsideLight::Weather(_));
    if let Some(site) = facts.site.filter(|site| !is_of_a_file && site.has_clock_of_another_place())
    {
        let (zone_h, longitude_deg) = (site.time_zone_h(), site.longitude_deg());
        warn(
            entry.places.site,
            format!(
                "time_zone_h = {zone_h} at {longitude_deg} degrees east; expected about {:.0}, hours \
                 ahead of Greenwich (the sun stands by the clock)",
                longitude_deg / 15.0
            ),
        );
    }
    let Some(sun) = facts.sun else { return };
    let below_deg = -sun.altitude_deg;
    let lx = sky.horizontal_illuminance_lx();
    if sun.altitude_deg < NIGHT_DEG && lx > TWILIGHT_LX && !is_of_a_file {
        warn(
            entry.places.sun,
            format!(
                "the sky gives {lx:.0} lx with the sun {below_deg:.0} degrees below the horizon; \
                 expected a time of the day, by the clock of the site"
            ),
        );
    }
    let Some(direct) = entry.places.direct else { return };
    if below_deg >= 0.0 {
        warn(
            Some(direct),
            format!(
                "direct = true has no effect: the sun is {below_deg:.0} degrees below the horizon; \
                 expected a time of the day, by the clock of the site"
            ),
        );
    } else if let SkyModel::Cie(cie) = &facts.model
        && OVERCAST.contains(&cie.number())
    {
        warn(
            Some(direct),
            format!(
                "direct = true with the overcast sky of CIE type {}, which no sun shines through; \
                 expected a type from 6 to 15, or no direct sun",
                cie.number()
            ),
        );
    }
}
