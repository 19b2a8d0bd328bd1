//! `[site]`, `[sky]`, `[sun]`, `[ground]` and `[[openings]]`: what is outside.

use super::document::{Section, Value};
use crate::LoadError;
use crate::environment::{Environment, Opening, Sun};
use quasilux_sky::{
    CieType, Distribution, Irradiance, LocalTime, Perez, Site, Sky, SkyError, SkyLevel, SkyPoint,
};

const MODELS: [&str; 3] = ["cie", "perez", "uniform"];
const PLANNED_MODELS: [&str; 2] = ["panorama", "weather"];
const SITE_KEYS: [&str; 4] = ["latitude_deg", "longitude_deg", "time_zone_h", "north_deg"];
const SUN_KEYS: [&str; 5] =
    ["altitude_deg", "azimuth_deg", "time", "direct", "normal_illuminance_lx"];
const LEVELS: [&str; 2] = ["horizontal_illuminance_lx", "zenith_luminance_cd_m2"];

/// The day of the year where no time says which: the distance of the sun is then its mean one.
const MEAN_DAY: u32 = 94;
/// Largest illuminance of the sun that a project file may give, in lx.
const MAX_SUN_LX: f64 = 1e9;
/// Most openings.
const MAX_OPENINGS: usize = 10_000;

/// `None` where there is no `[sky]`.
pub(super) fn read(root: &Section<'_>) -> Result<Option<Environment>, LoadError> {
    let Some(section) = root.table("sky")? else {
        for key in ["site", "sun", "ground", "openings"] {
            if let Some(value) = root.get(key) {
                return Err(value.error(format!("\"{key}\" goes with [sky], which is missing")));
            }
        }
        return Ok(None);
    };
    let site = root.table("site")?.map(|section| site(&section)).transpose()?;
    let north_deg = site.as_ref().map_or(0.0, |site| site.north_deg);
    let sun_section = root.table("sun")?;
    let sun = sun_section.as_ref().map(|section| sun(section, site.as_ref())).transpose()?;
    let Lit { sky, sun_lx } = sky(&section, sun.as_ref())?;
    let shining = sun_section.as_ref().zip(sun.as_ref());
    let sun = shining.map(|(section, sun)| disk(section, sun, sun_lx)).transpose()?.flatten();
    Ok(Some(Environment {
        sky,
        sun,
        ground_reflectance: ground(root)?,
        north_deg,
        openings: openings(root)?,
    }))
}

/// A sky, and what is known of its sun.
struct Lit {
    sky: Sky,
    sun_lx: Option<f64>,
}

/// A place with its compass.
struct Oriented {
    site: Option<Site>,
    north_deg: f64,
}

/// Where the sun is, and when.
struct PlacedSun {
    centre: SkyPoint,
    day_of_year: u32,
}

fn site(section: &Section<'_>) -> Result<Oriented, LoadError> {
    section.only(&SITE_KEYS, &[])?;
    let north = section.get("north_deg").map(|value| {
        value.number("degrees from +y, counter-clockwise, -360 to 360", |x| x.abs() <= 360.0)
    });
    let north_deg = north.transpose()?.unwrap_or(0.0);
    let given = SITE_KEYS[..3].iter().find(|key| section.get(key).is_some());
    if given.is_none() {
        return Ok(Oriented { site: None, north_deg });
    }
    let number = |key, expected: &str| section.require(key, expected)?.number(expected, |_| true);
    let latitude_deg = number("latitude_deg", "degrees north, -90 to 90")?;
    let longitude_deg = number("longitude_deg", "degrees east, -180 to 180")?;
    let time_zone_h = number("time_zone_h", "hours ahead of Greenwich, -15 to 15")?;
    let site = Site::new(latitude_deg, longitude_deg, time_zone_h);
    Ok(Oriented { site: Some(site.map_err(|error| refuse(section, &error))?), north_deg })
}

fn sun(section: &Section<'_>, site: Option<&Oriented>) -> Result<PlacedSun, LoadError> {
    section.only(&SUN_KEYS, &[])?;
    let Some(time) = section.get("time") else {
        let number = |key, expected: &str, most: f64| {
            section.require(key, expected)?.number(expected, |x| x.abs() <= most)
        };
        let altitude_deg = number("altitude_deg", "degrees above the horizon, or time", 90.0)?;
        let azimuth_deg = number("azimuth_deg", "degrees clockwise from north", 360.0)?;
        let centre = SkyPoint { altitude_deg, azimuth_deg };
        return Ok(PlacedSun { centre, day_of_year: MEAN_DAY });
    };
    if let Some(angle) = section.get("altitude_deg").or(section.get("azimuth_deg")) {
        return Err(angle.error(format!("\"{}\" and \"time\" exclude each other", angle.key)));
    }
    let site = site.and_then(|site| site.site).ok_or_else(|| {
        let keys = "latitude_deg, longitude_deg and time_zone_h";
        time.error(format!("\"time\" needs a site; expected [site] with {keys}"))
    })?;
    let at: LocalTime =
        time.time_text()?.parse().map_err(|error: SkyError| time.error(error.to_string()))?;
    let centre = site.sun_at(&at).map_err(|error| time.error(error.to_string()))?;
    Ok(PlacedSun { centre, day_of_year: at.day_of_year() })
}

fn sky(section: &Section<'_>, sun: Option<&PlacedSun>) -> Result<Lit, LoadError> {
    let expected = "\"cie\", \"perez\" or \"uniform\"";
    let model = section.require("model", expected)?;
    let name = model.name(&MODELS, &PLANNED_MODELS)?;
    let [lx, cd_m2] = LEVELS;
    match name {
        "cie" => section.only(&["model", "type", lx, cd_m2], &[])?,
        "uniform" => section.only(&["model", lx, cd_m2], &[])?,
        _ => {
            let keys = ["direct_normal_w_m2", "diffuse_horizontal_w_m2", "dew_point_c"];
            section.only(&["model", keys[0], keys[1], keys[2]], &[])?;
            return measured(section, &model, sun);
        }
    }
    let distribution = if name == "uniform" {
        Distribution::uniform()
    } else {
        let number = section.require("type", "1 to 16")?;
        let cie = CieType::new(number.integer("1 to 16", 1..=16)? as i64);
        let cie = cie.map_err(|error| number.error(error.to_string()))?;
        if cie.needs_sun() && sun.is_none() {
            let message = format!(
                "the luminances of a CIE sky of type {} depend on the sun; expected [sun] with \
                 altitude_deg and azimuth_deg, or time",
                cie.number()
            );
            return Err(number.error(message));
        }
        let zenith = SkyPoint { altitude_deg: 90.0, azimuth_deg: 0.0 };
        Distribution::cie(cie, sun.map_or(zenith, |sun| sun.centre))
    };
    let amount = section.exactly_one(&LEVELS)?;
    let level = amount.number("a number, 0 to 1e9", |x| (0.0..=1e9).contains(&x))?;
    let level = if amount.key == lx {
        SkyLevel::HorizontalIlluminance { lx: level }
    } else {
        SkyLevel::ZenithLuminance { cd_m2: level }
    };
    let sky = Sky::new(distribution, level).map_err(|error| amount.error(error.to_string()))?;
    Ok(Lit { sky, sun_lx: None })
}

/// The sky of a measured hour.
fn measured(
    section: &Section<'_>,
    model: &Value<'_>,
    sun: Option<&PlacedSun>,
) -> Result<Lit, LoadError> {
    let Some(sun) = sun else {
        return Err(model.error("the model \"perez\" needs the sun; expected [sun]"));
    };
    let expected = "an irradiance in W/m2, 0 to 2000";
    let number = |key| section.require(key, expected)?.number(expected, |_| true);
    let irradiance = Irradiance {
        direct_normal_w_m2: number("direct_normal_w_m2")?,
        diffuse_horizontal_w_m2: number("diffuse_horizontal_w_m2")?,
    };
    let dew_point = section.get("dew_point_c");
    let dew_point = dew_point.map(|value| value.number("degrees Celsius", |_| true)).transpose()?;
    let dew_point_c = dew_point.unwrap_or(Perez::DEW_POINT_C);
    let perez = Perez::new(irradiance, sun.centre, sun.day_of_year, dew_point_c)
        .map_err(|error| refuse(section, &error))?;
    let level = SkyLevel::HorizontalIlluminance { lx: perez.diffuse_illuminance_lx() };
    let sky = Sky::new(Distribution::perez(&perez), level);
    let sky = sky.map_err(|error| refuse(section, &error))?;
    Ok(Lit { sky, sun_lx: Some(perez.normal_illuminance_lx()) })
}

/// The disk of the sun; `None` where it does not shine.
fn disk(
    section: &Section<'_>,
    PlacedSun { centre, .. }: &PlacedSun,
    sun_lx: Option<f64>,
) -> Result<Option<Sun>, LoadError> {
    let is_direct = section.get("direct").map(|value| value.boolean()).transpose()?;
    let given = section.get("normal_illuminance_lx");
    if let (Some(given), Some(_)) = (given, sun_lx) {
        let message = "\"normal_illuminance_lx\" and the irradiances of [sky] exclude each other";
        return Err(given.error(message));
    }
    if is_direct != Some(true) {
        return Ok(None);
    }
    let normal_illuminance_lx = match sun_lx {
        Some(lx) => lx,
        None => {
            let expected = "the illuminance in lx that the sun gives on a plane across its rays";
            let value = section.require("normal_illuminance_lx", expected)?;
            value.number(expected, |x| (0.0..=MAX_SUN_LX).contains(&x))?
        }
    };
    // Below the horizon there is no sun.
    let is_up = centre.altitude_deg > 0.0 && normal_illuminance_lx > 0.0;
    Ok(is_up.then_some(Sun { centre: *centre, normal_illuminance_lx }))
}

fn ground(root: &Section<'_>) -> Result<f64, LoadError> {
    let Some(section) = root.table("ground")? else { return Ok(0.2) };
    section.only(&["reflectance"], &[])?;
    let expected = "a share of light, 0 to 1";
    section.require("reflectance", expected)?.number(expected, |x| (0.0..=1.0).contains(&x))
}

fn openings(root: &Section<'_>) -> Result<Vec<Opening>, LoadError> {
    let sections = root.tables("openings")?;
    if sections.len() > MAX_OPENINGS {
        return Err(sections[MAX_OPENINGS].error(format!("more than {MAX_OPENINGS} openings")));
    }
    let opening = |section: &Section<'_>| {
        section.only(&["origin", "u", "v"], &[])?;
        let vector = |key, expected: &str| section.require(key, expected)?.position_m(expected);
        let origin = vector("origin", "a position [x, y, z] in m")?;
        let u = vector("u", "an edge [x, y, z] in m")?;
        let v = vector("v", "an edge [x, y, z] in m")?;
        if u.cross(v).length() <= 1e-9 * u.length() * v.length() {
            return Err(
                section.error("the opening has no area; expected edges u and v that span it")
            );
        }
        Ok(Opening { origin, u, v })
    };
    sections.iter().map(opening).collect()
}

/// Says what is wrong with values of a section.
fn refuse(section: &Section<'_>, error: &SkyError) -> LoadError {
    let value = section.get(error.name);
    value.map_or_else(|| section.error(error.to_string()), |value| value.error(error.to_string()))
}
