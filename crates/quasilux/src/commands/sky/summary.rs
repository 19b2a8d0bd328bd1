//! What is outside, for people.

use super::subject::{ShownSky, Subject};
use quasilux_report::number::brief;
use quasilux_sky::Site;
use quasilux_text::printable;
use std::fmt::Write;

/// Digits of figures.
const DIGITS: i32 = 5;
/// Altitudes and azimuths of the table of luminances, but for the zenith.
pub(super) const ALTITUDES_DEG: [f64; 6] = [75.0, 60.0, 45.0, 30.0, 15.0, 0.0];
pub(super) const AZIMUTHS_DEG: [f64; 8] = [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0];
const NAMES: [&str; 8] = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];

/// Figures, and a table of luminances.
pub(super) fn summary(subject: &Subject) -> String {
    let mut text = String::new();
    if !subject.name.is_empty() {
        writeln!(text, "{}", printable(&subject.name)).expect("strings grow");
    }
    let mut line = |name: &str, value: &str| {
        writeln!(text, "  {name:<11} {}", printable(value)).expect("strings grow");
    };
    if let Some(sky) = &subject.sky {
        line("model", &sky.model_text());
        if let Some(time) = sky.time_text() {
            line("time", &time);
        }
    }
    if let Some(site) = subject.site {
        line("site", &place(site));
    }
    let Some(sky) = &subject.sky else { return text };
    line("sun", &sun_text(sky));
    let [of_sky, of_sun] = [sky.sky_lx(), sky.sun_lx()].map(|lx| brief(lx, DIGITS));
    let all = brief(sky.sky_lx() + sky.sun_lx(), DIGITS);
    line("horizontal", &format!("{of_sky} lx of the sky, {of_sun} lx of the sun, {all} lx in all"));
    let zenith = brief(sky.environment.sky.zenith_luminance_cd_m2(), DIGITS);
    line("zenith", &format!("{zenith} cd/m²"));
    let ground = brief(sky.environment.ground_luminance_cd_m2(), DIGITS);
    let reflectance = brief(sky.environment.ground_reflectance, DIGITS);
    line("ground", &format!("{ground} cd/m², reflectance {reflectance}"));
    if sky.environment.north_deg != 0.0 {
        let degrees = brief(sky.environment.north_deg, DIGITS);
        line("north", &format!("{degrees}° from +y, counter-clockwise seen from above"));
    }
    text + &luminances(sky)
}

/// Altitude and azimuth of the sun, and what its disk gives.
pub(super) fn sun_text(sky: &ShownSky) -> String {
    let place = match sky.facts.sun {
        Some(sun) if sun.altitude_deg >= 0.0 => {
            format!("{:.2}° high, {:.2}° from north", sun.altitude_deg, sun.azimuth_deg)
        }
        Some(sun) => format!(
            "{:.2}° below the horizon, {:.2}° from north",
            -sun.altitude_deg, sun.azimuth_deg
        ),
        None => return "none".to_owned(),
    };
    match (&sky.environment.sun, sky.sun_cd_m2()) {
        (Some(disk), Some(cd_m2)) => format!(
            "{place}; {} lx across its rays, a disk of {} cd/m²",
            brief(disk.normal_illuminance_lx, DIGITS),
            brief(cd_m2, 4)
        ),
        _ => format!("{place}; its disk does not shine"),
    }
}

/// Where a site is.
fn place(site: Site) -> String {
    let side = |degrees: f64, names: [&str; 2]| {
        let name = if degrees < 0.0 { names[1] } else { names[0] };
        format!("{}° {name}", brief(degrees.abs(), 7))
    };
    let latitude = side(site.latitude_deg(), ["north", "south"]);
    let longitude = side(site.longitude_deg(), ["east", "west"]);
    format!("{latitude}, {longitude}, the clock {} h ahead of Greenwich", site.time_zone_h())
}

/// A row an altitude, a column an azimuth.
fn luminances(sky: &ShownSky) -> String {
    let mut text = "\n  luminance of the sky in cd/m², by altitude and azimuth\n     ".to_owned();
    for (name, azimuth_deg) in NAMES.iter().zip(AZIMUTHS_DEG) {
        write!(text, " {:>8}", format!("{name} {azimuth_deg}°")).expect("strings grow");
    }
    text.push('\n');
    for altitude_deg in ALTITUDES_DEG {
        write!(text, "{:>5}", format!("{altitude_deg}°")).expect("strings grow");
        for azimuth_deg in AZIMUTHS_DEG {
            let cd_m2 = brief(sky.luminance_cd_m2(altitude_deg, azimuth_deg), 4);
            write!(text, " {cd_m2:>8}").expect("strings grow");
        }
        text.push('\n');
    }
    text
}
