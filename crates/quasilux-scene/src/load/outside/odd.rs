//! What cannot shine outside as the project file says: told, and taken as it is.

use crate::Warning;
use crate::environment::{SkyFacts, SkyModel};
use crate::project::{OutsideEntry, OutsideLight, OutsidePlaces, Project};
use quasilux_sky::{Site, Sky, SkyPoint};

/// More than the sky gives at the end of civil twilight.
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
    let OutsidePlaces { site, sun, direct, .. } = entry.places;
    // Their readers tell what is odd about weather files.
    let is_of_a_file = matches!(entry.light, OutsideLight::Weather(_));
    let of_site = facts.site.filter(|_| !is_of_a_file).and_then(|it| odd_clock(&it));
    let of_sky = facts.sun.filter(|_| !is_of_a_file).and_then(|it| odd_sky(sky, it));
    let of_direct = facts.sun.filter(|_| direct.is_some()).and_then(|it| odd_disk(facts, it));
    for (place, message) in [(site, of_site), (sun, of_sky), (direct, of_direct)] {
        warnings.extend(message.map(|message| Warning::new(&project.file, place, message)));
    }
}

fn odd_clock(site: &Site) -> Option<String> {
    let (zone_h, longitude_deg) = (site.time_zone_h(), site.longitude_deg());
    site.has_clock_of_another_place().then(|| {
        format!(
            "time_zone_h = {zone_h} at {longitude_deg} degrees east; set it to about {:.0}, in \
             hours ahead of Greenwich (the sun stands by the clock)",
            longitude_deg / 15.0
        )
    })
}

fn odd_sky(sky: &Sky, sun: SkyPoint) -> Option<String> {
    let lx = sky.horizontal_illuminance_lx();
    (sun.altitude_deg < SkyPoint::NIGHT_DEG && lx > TWILIGHT_LX).then(|| {
        format!(
            "the sky gives {lx:.0} lx with the sun {:.0} degrees below the horizon; set a time of \
             the day, by the clock of the site",
            -sun.altitude_deg
        )
    })
}

fn odd_disk(facts: &SkyFacts, sun: SkyPoint) -> Option<String> {
    if sun.altitude_deg <= 0.0 {
        return Some(format!(
            "direct = true has no effect: the sun is {:.0} degrees below the horizon; set a time \
             of the day, by the clock of the site",
            -sun.altitude_deg
        ));
    }
    let SkyModel::Cie(cie) = &facts.model else { return None };
    OVERCAST.contains(&cie.number()).then(|| {
        format!(
            "direct = true with the overcast sky of CIE type {}, which no sun shines through; set \
             a type from 6 to 15, or direct = false",
            cie.number()
        )
    })
}
