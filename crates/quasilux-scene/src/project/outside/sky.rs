//! `[sky]` of a model that needs no other file.

use super::sun::PlacedSun;
use super::{PanoramaEntry, refuse};
use crate::LoadError;
use crate::environment::SkyModel;
use crate::project::document::{Section, Value};
use crate::project::keys::{Key, optional, required};
use quasilux_sky::{CieType, Distribution, Irradiance, Perez, Sky, SkyLevel, SkyPoint};

const LEVELS: [&str; 2] = ["horizontal_illuminance_lx", "zenith_luminance_cd_m2"];

pub(in crate::project) const MODEL: Key = required(
    "model",
    "`\"cie\"`, `\"perez\"`, `\"uniform\"`, `\"weather\"` or `\"panorama\"`",
    "Which of the models it is",
);
const HORIZONTAL: Key = optional(
    LEVELS[0],
    "lx, 0 to 1e9",
    "from the other",
    "What the sky without the sun gives on a free horizontal plane; this or \
     `zenith_luminance_cd_m2`",
);
const ZENITH: Key =
    optional(LEVELS[1], "cd/m2, 0 to 1e9", "from the other", "The luminance of the zenith");
pub(in crate::project) const UNIFORM_KEYS: [Key; 3] = [MODEL, HORIZONTAL, ZENITH];
pub(in crate::project) const CIE_KEYS: [Key; 4] = [
    MODEL,
    required(
        "type",
        "1 to 16",
        "The number of the CIE standard general sky (CIE S 011); 1 is overcast, 16 the \
         traditional overcast sky",
    ),
    HORIZONTAL,
    ZENITH,
];
pub(in crate::project) const PEREZ_KEYS: [Key; 4] = [
    MODEL,
    required(
        "direct_normal_w_m2",
        "W/m2, 0 to 2000",
        "Irradiance of the sun on a plane across its rays",
    ),
    required(
        "diffuse_horizontal_w_m2",
        "W/m2, 0 to 2000",
        "Irradiance of the sky on a horizontal plane",
    ),
    optional("dew_point_c", "degrees Celsius, -90 to 60", "`11`", "Dew point of the air"),
];
pub(in crate::project) const PANORAMA_KEYS: [Key; 5] = [
    MODEL,
    required("file", "file name", "A panorama in Radiance's RGBE or XYZE format"),
    optional(
        "middle_azimuth_deg",
        "degrees, -360 to 360",
        "`0`",
        "What the middle of the picture shows, clockwise from north",
    ),
    optional(
        LEVELS[0],
        "lx, 0 to 1e9",
        "the picture's",
        "Scales it to this illuminance of a free horizontal plane",
    ),
    optional(
        LEVELS[1],
        "cd/m2, 0 to 1e9",
        "the picture's",
        "Scales it to this luminance of the zenith; not beside the other",
    ),
];

/// A sky, and what is known of its sun.
pub(super) struct Lit {
    pub(super) sky: Sky,
    pub(super) model: SkyModel,
    /// The illuminance of the sun on a plane across its rays, where the model gives it.
    pub(super) sun_lx: Option<f64>,
}

pub(super) fn uniform(section: &Section<'_>) -> Result<Lit, LoadError> {
    section.only(&UNIFORM_KEYS, &[])?;
    Ok(Lit {
        sky: scaled(section, Distribution::uniform())?,
        model: SkyModel::Uniform,
        sun_lx: None,
    })
}

pub(super) fn cie(section: &Section<'_>, sun: Option<&PlacedSun>) -> Result<Lit, LoadError> {
    section.only(&CIE_KEYS, &[])?;
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
    let distribution = Distribution::cie(cie, sun.map_or(zenith, |sun| sun.centre));
    Ok(Lit { sky: scaled(section, distribution)?, model: SkyModel::Cie(cie), sun_lx: None })
}

/// The sky of a measured hour.
pub(super) fn perez(
    section: &Section<'_>,
    model: &Value<'_>,
    sun: Option<&PlacedSun>,
) -> Result<Lit, LoadError> {
    section.only(&PEREZ_KEYS, &[])?;
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
    let perez = Perez::new(irradiance, sun.centre, sun.day_of_year(), dew_point_c)
        .map_err(|error| refuse(section, &error))?;
    let level = SkyLevel::HorizontalIlluminance { lx: perez.diffuse_illuminance_lx() };
    let sky = Sky::new(Distribution::perez(&perez), level);
    let sky = sky.map_err(|error| refuse(section, &error))?;
    Ok(Lit { sky, model: SkyModel::Perez, sun_lx: Some(perez.normal_illuminance_lx()) })
}

/// A sky of the level that the section gives.
fn scaled(section: &Section<'_>, distribution: Distribution) -> Result<Sky, LoadError> {
    let amount = section.exactly_one(&LEVELS)?;
    Sky::new(distribution, level(&amount)?).map_err(|error| amount.error(error.to_string()))
}

/// The level that a value gives.
fn level(amount: &Value<'_>) -> Result<SkyLevel, LoadError> {
    let level = amount.number("a number, 0 to 1e9", |x| (0.0..=1e9).contains(&x))?;
    Ok(if amount.key == LEVELS[0] {
        SkyLevel::HorizontalIlluminance { lx: level }
    } else {
        SkyLevel::ZenithLuminance { cd_m2: level }
    })
}

/// The picture of a sky, and how it is scaled and turned.
pub(super) fn panorama(section: &Section<'_>) -> Result<PanoramaEntry, LoadError> {
    section.only(&PANORAMA_KEYS, &[])?;
    let expected = "the name of a panorama in Radiance's format, such as \"sky.hdr\"";
    let file = section.require("file", expected)?;
    let file = file.spanned(file.string(expected)?.to_owned());
    let middle = section.get("middle_azimuth_deg").map(|value| {
        let expected = "degrees from north, clockwise, -360 to 360";
        value.number(expected, |x| x.abs() <= 360.0)
    });
    let middle_azimuth_deg = middle.transpose()?.unwrap_or(0.0);
    let is_scaled = LEVELS.iter().any(|key| section.get(key).is_some());
    let level = is_scaled.then(|| {
        let amount = section.exactly_one(&LEVELS)?;
        Ok(amount.spanned(level(&amount)?))
    });
    Ok(PanoramaEntry { file, middle_azimuth_deg, level: level.transpose()? })
}
