//! The document in JSON, format "quasilux-sky/1", for programs.
//!
//! `project` is the name of the project file, `site` where it is on the earth and `sky` what
//! shines; each of them is `null` where there is none. `time` is that of the sun's place, by the
//! clock of the site: of an interval of a weather file it is the middle, and its year means
//! nothing. `sun` has `normal_illuminance_lx` and `disk_luminance_cd_m2` where its disk shines.
//! `luminances` are in directions of the compass, without the sun. `days` has the days of
//! `--positions`; `up` are times in hours from midnight between which the sun's centre is above
//! the horizon, without refraction.

use super::positions::ListedDay;
use super::subject::{ShownSky, Subject};
use super::summary::{ALTITUDES_DEG, AZIMUTHS_DEG};
use quasilux_report::json;
use quasilux_scene::SkyModel;
use quasilux_sky::{Site, SolarPosition};
use serde::Serialize;

/// Name and version of the document's format.
const FORMAT: &str = "quasilux-sky/1";

/// The document, ending in a line feed.
pub(super) fn document(subject: &Subject, days: &[ListedDay]) -> String {
    json::text(&Document {
        format: FORMAT,
        project: Some(subject.name.as_str()).filter(|name| !name.is_empty()),
        site: subject.site.map(SiteEntry::new),
        sky: subject.sky.as_ref().map(SkyEntry::new),
        days: days.iter().map(DayEntry::new).collect(),
        warnings: &subject.warnings,
    })
}

#[derive(Serialize)]
struct Document<'a> {
    format: &'static str,
    project: Option<&'a str>,
    site: Option<SiteEntry>,
    sky: Option<SkyEntry<'a>>,
    days: Vec<DayEntry<'a>>,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct SiteEntry {
    latitude_deg: f64,
    longitude_deg: f64,
    time_zone_h: f64,
}

#[derive(Serialize)]
struct SkyEntry<'a> {
    model: &'static str,
    /// Of a CIE sky.
    r#type: Option<u8>,
    /// The file that says what shines.
    file: Option<&'a str>,
    time: Option<String>,
    north_deg: f64,
    sun: Option<SunEntry>,
    horizontal_illuminance_lx: IlluminanceEntry,
    zenith_luminance_cd_m2: f64,
    ground_luminance_cd_m2: f64,
    luminances: Vec<LuminanceEntry>,
}

#[derive(Serialize)]
struct SunEntry {
    altitude_deg: f64,
    azimuth_deg: f64,
    normal_illuminance_lx: Option<f64>,
    disk_luminance_cd_m2: Option<f64>,
}

#[derive(Serialize)]
struct IlluminanceEntry {
    sky: f64,
    sun: f64,
    total: f64,
}

#[derive(Serialize)]
struct LuminanceEntry {
    altitude_deg: f64,
    azimuth_deg: f64,
    luminance_cd_m2: f64,
}

#[derive(Serialize)]
struct DayEntry<'a> {
    date: &'a str,
    up: Vec<[f64; 2]>,
    highest: PositionEntry,
    hours: Vec<PositionEntry>,
}

#[derive(Serialize)]
struct PositionEntry {
    time: String,
    altitude_deg: f64,
    azimuth_deg: f64,
}

impl SiteEntry {
    fn new(site: Site) -> Self {
        Self {
            latitude_deg: site.latitude_deg(),
            longitude_deg: site.longitude_deg(),
            time_zone_h: site.time_zone_h(),
        }
    }
}

impl<'a> SkyEntry<'a> {
    fn new(sky: &'a ShownSky) -> Self {
        let (model, r#type, file) = match &sky.facts.model {
            SkyModel::Uniform => ("uniform", None, None),
            SkyModel::Cie(cie) => ("cie", Some(cie.number()), None),
            SkyModel::Perez => ("perez", None, None),
            SkyModel::Weather { file } => ("weather", None, Some(file.as_str())),
            SkyModel::Panorama { file } => ("panorama", None, Some(file.as_str())),
        };
        let environment = &sky.environment;
        let sun = sky.facts.sun.map(|sun| SunEntry {
            altitude_deg: sun.altitude_deg,
            azimuth_deg: sun.azimuth_deg,
            normal_illuminance_lx: environment.sun.map(|sun| sun.normal_illuminance_lx),
            disk_luminance_cd_m2: sky.sun_cd_m2(),
        });
        let (of_sky, of_sun) = (sky.sky_lx(), sky.sun_lx());
        let luminance = |altitude_deg: f64, azimuth_deg: f64| LuminanceEntry {
            altitude_deg,
            azimuth_deg,
            luminance_cd_m2: sky.luminance_cd_m2(altitude_deg, azimuth_deg),
        };
        let rows = ALTITUDES_DEG.iter().flat_map(|altitude| {
            AZIMUTHS_DEG.iter().map(move |azimuth| luminance(*altitude, *azimuth))
        });
        Self {
            model,
            r#type,
            file,
            time: sky.facts.time.map(|time| time.to_string()),
            north_deg: environment.north_deg,
            sun,
            horizontal_illuminance_lx: IlluminanceEntry {
                sky: of_sky,
                sun: of_sun,
                total: of_sky + of_sun,
            },
            zenith_luminance_cd_m2: environment.sky.zenith_luminance_cd_m2(),
            ground_luminance_cd_m2: environment.ground_luminance_cd_m2(),
            luminances: rows.collect(),
        }
    }
}

impl<'a> DayEntry<'a> {
    fn new(listed: &'a ListedDay) -> Self {
        let hours = |seconds: f64| seconds / 3600.0;
        Self {
            date: &listed.date,
            up: listed.day.up_s.iter().map(|span| span.map(hours)).collect(),
            highest: PositionEntry::new(&listed.day.highest),
            hours: listed.day.hours.iter().map(PositionEntry::new).collect(),
        }
    }
}

impl PositionEntry {
    fn new(position: &SolarPosition) -> Self {
        Self {
            time: position.time.to_string(),
            altitude_deg: position.sun.altitude_deg,
            azimuth_deg: position.sun.azimuth_deg,
        }
    }
}
