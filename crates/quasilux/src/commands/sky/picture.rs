//! The sky in false colours.

use super::subject::{ShownSky, Subject};
use super::summary::sun_text;
use quasilux_drawing::Drawing;
use quasilux_drawing::picture::{self, Caption, SkyPicture};
use quasilux_report::number::brief;

/// How the picture is to be read.
const METHOD: &str = "As on a map, east on the right; the distance from the middle is the angle \
                      from the zenith. Without the sun's disk.";

/// The luminances of the hemisphere above.
pub(super) fn drawing(subject: &Subject, sky: &ShownSky, cells: usize) -> Drawing {
    let title = sky.model_text();
    let mut facts: Vec<String> = sky.time_text().into_iter().collect();
    if sky.facts.sun.is_some() {
        facts.push(format!("sun {}", sun_text(sky)));
    }
    let [of_sky, zenith] =
        [sky.sky_lx(), sky.environment.sky.zenith_luminance_cd_m2()].map(|x| brief(x, 4));
    facts.push(format!("sky {of_sky} lx on a horizontal plane"));
    if sky.sun_lx() > 0.0 {
        facts.push(format!("sun {} lx", brief(sky.sun_lx(), 4)));
    }
    facts.push(format!("zenith {zenith} cd/m²"));
    let caption = Caption {
        title: &title,
        project: &subject.title,
        facts: &facts,
        method: METHOD,
        caution: "",
    };
    picture::sky(&SkyPicture {
        caption,
        luminance_cd_m2: &|[altitude_deg, azimuth_deg]| {
            sky.luminance_cd_m2(altitude_deg, azimuth_deg)
        },
        sun_deg: sky.facts.sun.map(|sun| [sun.altitude_deg, sun.azimuth_deg]),
        cells,
    })
}
