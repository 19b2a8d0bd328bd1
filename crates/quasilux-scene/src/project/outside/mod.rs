//! `[site]`, `[weather]`, `[sky]`, `[sun]`, `[ground]` and `[[openings]]`: what is outside.

mod site;
mod sky;
mod sun;

use super::document::{Section, Value};
use super::keys::{Key, POSITION, required};
use crate::environment::{Opening, SkyFacts, SkyModel, Sun};
use crate::{LoadError, Spanned};
use quasilux_sky::{LocalTime, Site, Sky, SkyError, SkyLevel};
use quasilux_text::Position;
pub(super) use site::KEYS as SITE_KEYS;
use site::Oriented;
use sky::Lit;
pub(super) use sky::{CIE_KEYS, PANORAMA_KEYS, PEREZ_KEYS, UNIFORM_KEYS};
pub(super) use sun::{KEYS as SUN_KEYS, WEATHER_KEYS as WEATHER_SUN_KEYS};

const MODELS: [&str; 5] = ["cie", "perez", "uniform", "weather", "panorama"];
pub(super) const WEATHER_SKY_KEYS: [Key; 1] = [sky::MODEL];
pub(super) const WEATHER_KEYS: [Key; 1] =
    [required("file", "file name", "A weather file: EPW or WEA")];
pub(super) const GROUND_KEYS: [Key; 1] = [required(
    "reflectance",
    "share, 0 to 1",
    "Of the ground around; without `[ground]` it is 0.2",
)];
pub(super) const OPENING_KEYS: [Key; 3] = [
    required("origin", POSITION, "A corner of the opening"),
    required("u", POSITION, "The edge from `origin` to the next corner"),
    required("v", POSITION, "The other edge from `origin`"),
];
const EXPECTED_MODEL: &str = "\"cie\", \"perez\", \"uniform\", \"weather\" or \"panorama\"";
/// Most openings.
const MAX_OPENINGS: usize = 10_000;

/// Light from outside, as far as the project file describes it.
#[derive(Clone, Debug)]
pub(crate) struct OutsideEntry {
    pub(crate) light: OutsideLight,
    pub(crate) ground_reflectance: f64,
    pub(crate) north_deg: f64,
    pub(crate) openings: Vec<Opening>,
    pub(crate) places: OutsidePlaces,
}

/// Where the project file says it.
#[derive(Clone, Debug)]
pub(crate) struct OutsidePlaces {
    pub(crate) site: Option<Position>,
    pub(crate) sun: Option<Position>,
    /// Where it asks for the disk of the sun.
    pub(crate) direct: Option<Position>,
    /// Of each opening.
    pub(crate) openings: Vec<Position>,
}

/// Sky and sun outside.
#[derive(Clone, Debug)]
pub(crate) enum OutsideLight {
    /// All of it is known.
    Known {
        /// The sky without the sun.
        sky: Sky,
        /// The sun, where its disk shines.
        sun: Option<Sun>,
        /// Facts that they were made from.
        facts: SkyFacts,
    },
    /// A weather file says it.
    Weather(WeatherEntry),
    /// A picture has the luminances of the sky.
    Panorama {
        /// The picture.
        picture: PanoramaEntry,
        /// The sun, where its disk shines.
        sun: Option<Sun>,
        /// Facts that are known beside the picture.
        facts: SkyFacts,
    },
}

/// `[weather]` with what the other sections ask of it.
#[derive(Clone, Debug)]
pub(crate) struct WeatherEntry {
    /// The weather file.
    pub(crate) file: Spanned<String>,
    /// Which interval of the file; `None` where the project names none.
    pub(crate) time: Option<Spanned<LocalTime>>,
    /// Whether the disk of the sun shines.
    pub(crate) is_direct: bool,
    /// Site as `[site]` gives it.
    pub(crate) site: Option<Spanned<Site>>,
}

/// The picture of a sky.
#[derive(Clone, Debug)]
pub(crate) struct PanoramaEntry {
    /// Its file.
    pub(crate) file: Spanned<String>,
    /// The azimuth of its middle, clockwise from north.
    pub(crate) middle_azimuth_deg: f64,
    /// Level that it is scaled to; `None` where its values are radiances.
    pub(crate) level: Option<Spanned<SkyLevel>>,
}

/// `None` where there is no `[sky]`.
pub(super) fn read(root: &Section<'_>) -> Result<Option<OutsideEntry>, LoadError> {
    let Some(section) = root.table("sky")? else {
        for key in ["site", "weather", "sun", "ground", "openings"] {
            if let Some(value) = root.get(key) {
                return Err(value.error(format!("\"{key}\" goes with [sky], which is missing")));
            }
        }
        return Ok(None);
    };
    let model = section.require("model", EXPECTED_MODEL)?;
    let name = model.name(&MODELS, &[])?;
    let site_section = root.table("site")?;
    let site = site_section.as_ref().map(site::read).transpose()?.unwrap_or_default();
    let light = match (name, root.get("weather")) {
        ("weather", _) => {
            section.only(&WEATHER_SKY_KEYS, &[])?;
            let place = site_section.as_ref().map(Section::place);
            let site = site.site.zip(place).map(|(value, place)| Spanned { value, place });
            OutsideLight::Weather(weather(root, &model, site)?)
        }
        (_, Some(unused)) => {
            let message = format!(
                "\"weather\" goes with [sky] model = \"weather\", and the model is \"{name}\""
            );
            return Err(unused.error(message));
        }
        _ => known(root, &section, &model, &site)?,
    };
    let sun = root.table("sun")?;
    let places = OutsidePlaces {
        site: site_section.as_ref().map(Section::place),
        sun: sun.as_ref().map(Section::place),
        direct: sun.as_ref().map(sun::place_of_direct).transpose()?.flatten(),
        openings: root.tables("openings")?.iter().map(Section::place).collect(),
    };
    Ok(Some(OutsideEntry {
        light,
        ground_reflectance: ground(root)?,
        north_deg: site.north_deg,
        openings: openings(root)?,
        places,
    }))
}

/// Sky and sun by a model that needs no weather file.
fn known(
    root: &Section<'_>,
    section: &Section<'_>,
    model: &Value<'_>,
    site: &Oriented,
) -> Result<OutsideLight, LoadError> {
    let sun_section = root.table("sun")?;
    let sun = sun_section.as_ref().map(|section| sun::place(section, site)).transpose()?;
    let facts = |model| SkyFacts {
        model,
        site: site.site,
        time: sun.and_then(|sun| sun.time),
        sun: sun.map(|sun| sun.centre),
    };
    let disk = |sun_lx| {
        let shining = sun_section.as_ref().zip(sun.as_ref());
        let disk = shining.map(|(section, sun)| sun::disk(section, sun, sun_lx));
        disk.transpose().map(Option::flatten)
    };
    let Lit { sky, model, sun_lx } = match model.name(&MODELS, &[])? {
        "cie" => sky::cie(section, sun.as_ref())?,
        "perez" => sky::perez(section, model, sun.as_ref())?,
        "panorama" => {
            let picture = sky::panorama(section)?;
            let facts = facts(SkyModel::Panorama { file: picture.file.value.clone() });
            return Ok(OutsideLight::Panorama { picture, sun: disk(None)?, facts });
        }
        _ => sky::uniform(section)?,
    };
    Ok(OutsideLight::Known { sky, sun: disk(sun_lx)?, facts: facts(model) })
}

/// `[weather]`, which the sky's `model` asks for.
fn weather(
    root: &Section<'_>,
    model: &Value<'_>,
    site: Option<Spanned<Site>>,
) -> Result<WeatherEntry, LoadError> {
    let Some(section) = root.table("weather")? else {
        let message = "the model \"weather\" needs a weather file; expected [weather] with file";
        return Err(model.error(message));
    };
    section.only(&WEATHER_KEYS, &[])?;
    let expected = "the name of a weather file: EPW or WEA, relative to the project file";
    let file = section.require("file", expected)?;
    let file = file.spanned(file.string(expected)?.to_owned());
    let sun = root.table("sun")?.as_ref().map(sun::of_weather).transpose()?.unwrap_or_default();
    Ok(WeatherEntry { file, time: sun.time, is_direct: sun.is_direct, site })
}

fn ground(root: &Section<'_>) -> Result<f64, LoadError> {
    let Some(section) = root.table("ground")? else { return Ok(0.2) };
    section.only(&GROUND_KEYS, &[])?;
    let expected = "a share of light, 0 to 1";
    section.require("reflectance", expected)?.number(expected, |x| (0.0..=1.0).contains(&x))
}

fn openings(root: &Section<'_>) -> Result<Vec<Opening>, LoadError> {
    let sections = root.tables("openings")?;
    if sections.len() > MAX_OPENINGS {
        return Err(sections[MAX_OPENINGS].error(format!("more than {MAX_OPENINGS} openings")));
    }
    let opening = |section: &Section<'_>| {
        section.only(&OPENING_KEYS, &[])?;
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
