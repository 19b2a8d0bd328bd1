//! What is outside, where a file says what shines.

mod odd;

use super::photometry::{load_error, passed_on};
use crate::environment::{Environment, SkyFacts, SkyModel, Sun};
use crate::geometry::read_file;
use crate::project::{OutsideEntry, OutsideLight, PanoramaEntry, Project, WeatherEntry};
use crate::{FileKind, Files, LoadError, Spanned, Warning};
use quasilux_sky::{
    Distribution, LightAt, LightAtError, LocalTime, Panorama, Site, Sky, SkyLevel, Weather,
};

/// Most degrees that the site of a project and that of its weather file may be apart in latitude
/// and in longitude: no more than they are rounded.
const MAX_APART_DEG: f64 = 0.05;

/// Sky, sun and weather outside of a project.
#[derive(Default)]
pub(super) struct Outside {
    pub(super) environment: Option<Environment>,
    pub(super) weather: Option<Weather>,
    pub(super) facts: Option<SkyFacts>,
}

/// Sky and sun, with the file that says them.
struct Light {
    sky: Sky,
    sun: Option<Sun>,
    facts: SkyFacts,
    weather: Option<Weather>,
}

pub(super) fn resolve(
    project: &Project,
    files: &dyn Files,
    warnings: &mut Vec<Warning>,
) -> Result<Outside, LoadError> {
    let Some(entry) = &project.outside else { return Ok(Outside::default()) };
    let Light { sky, sun, facts, weather } = match &entry.light {
        OutsideLight::Known { sky, sun, facts } => {
            Light { sky: sky.clone(), sun: *sun, facts: facts.clone(), weather: None }
        }
        OutsideLight::Panorama { picture, sun, facts } => {
            let sky = of_picture(project, picture, files, warnings)?;
            Light { sky, sun: *sun, facts: facts.clone(), weather: None }
        }
        OutsideLight::Weather(entry) => of_weather(project, entry, files, warnings)?,
    };
    if sky.is_held() {
        let message = "the sky is approximate: the model of Perez covers no sky this bright with \
                       the sun this low (b > 0). It takes the nearest brightness that the model \
                       covers, and keeps its illuminance";
        warnings.push(Warning::new(&project.file, None, message.to_owned()));
    }
    odd::tell(project, entry, &sky, &facts, warnings);
    let OutsideEntry { ground_reflectance, north_deg, openings, .. } = entry;
    let (ground_reflectance, north_deg) = (*ground_reflectance, *north_deg);
    let openings = openings.clone();
    let environment = Environment { sky, sun, ground_reflectance, north_deg, openings };
    Ok(Outside { environment: Some(environment), weather, facts: Some(facts) })
}

/// The sky of a picture.
fn of_picture(
    project: &Project,
    entry: &PanoramaEntry,
    files: &dyn Files,
    warnings: &mut Vec<Warning>,
) -> Result<Sky, LoadError> {
    let file = entry.file.value.as_str();
    let bytes = read_file(project, &entry.file, files, FileKind::Panorama)?;
    let read = Panorama::parse(&bytes).map_err(|error| load_error(file, &error))?;
    warnings.extend(read.warnings.iter().map(|warning| passed_on(file, warning)));
    let panorama = read.panorama.with_middle_at(entry.middle_azimuth_deg);
    if panorama.horizontal_illuminance_lx() <= 0.0 {
        let message =
            format!("the upper half of \"{file}\" is dark; expected the luminances of a sky");
        return Err(project.error(entry.file.place, message));
    }
    let level = entry.level.as_ref();
    let place = level.map_or(entry.file.place, |level| level.place);
    let level = level.map_or(SkyLevel::Absolute, |level| level.value);
    Sky::new(Distribution::panorama(panorama), level)
        .map_err(|error| project.error(place, error.to_string()))
}

/// The light of an interval of a weather file; without a time a sky of 0 lx.
fn of_weather(
    project: &Project,
    entry: &WeatherEntry,
    files: &dyn Files,
    warnings: &mut Vec<Warning>,
) -> Result<Light, LoadError> {
    let file = entry.file.value.as_str();
    let bytes = read_file(project, &entry.file, files, FileKind::Weather)?;
    let read = Weather::parse(&bytes).map_err(|error| load_error(file, &error))?;
    warnings.extend(read.warnings.iter().map(|warning| passed_on(file, warning)));
    let weather = read.weather;
    if let Some(site) = &entry.site {
        expect_same_site(project, site, &weather, file)?;
    }
    let model = SkyModel::Weather { file: file.to_owned() };
    let mut facts = SkyFacts { model, site: Some(weather.site), time: None, sun: None };
    let mut shining = None;
    if let Some(time) = &entry.time {
        let at = light_at(project, &weather, file, time)?;
        facts.time = Some(at.middle);
        let sun = weather.site.sun_at(&at.middle);
        facts.sun = Some(sun.map_err(|error| LoadError::new(file, None, error.to_string()))?);
        if at.light.is_none() {
            let message = format!("nothing shines at this time in \"{file}\"; the sky is dark");
            warnings.push(Warning::new(&project.file, Some(time.place), message));
        }
        shining = at.light;
    }
    let sun = shining.as_ref().filter(|light| light.sun_normal_illuminance_lx > 0.0);
    let sun = sun.filter(|_| entry.is_direct).map(|light| Sun {
        centre: light.sun,
        normal_illuminance_lx: light.sun_normal_illuminance_lx,
    });
    let sky = match shining {
        Some(light) => light.sky,
        None => dark().map_err(|error| LoadError::new(file, None, error.to_string()))?,
    };
    Ok(Light { sky, sun, facts, weather: Some(weather) })
}

/// Sky and sun of a time by the file.
fn light_at(
    project: &Project,
    weather: &Weather,
    file: &str,
    time: &Spanned<LocalTime>,
) -> Result<LightAt, LoadError> {
    weather.light_at(&time.value).map_err(|error| match error {
        LightAtError::Sky(error) => LoadError::new(file, None, error.to_string()),
        lack => project.error(time.place, format!("\"{file}\" has {lack}")),
    })
}

/// Refuses a site that is not the one of the weather file.
fn expect_same_site(
    project: &Project,
    given: &Spanned<Site>,
    weather: &Weather,
    file: &str,
) -> Result<(), LoadError> {
    let (own, other) = (given.value, weather.site);
    let turn = (own.longitude_deg() - other.longitude_deg()).rem_euclid(360.0);
    let is_same = (own.latitude_deg() - other.latitude_deg()).abs() <= MAX_APART_DEG
        && turn.min(360.0 - turn) <= MAX_APART_DEG
        && own.time_zone_h() == other.time_zone_h();
    if is_same {
        return Ok(());
    }
    let of = |site: Site| {
        let (latitude, longitude) = (site.latitude_deg(), site.longitude_deg());
        format!("({latitude}, {longitude}, {} h)", site.time_zone_h())
    };
    let message = format!(
        "[site] is at {} by latitude_deg, longitude_deg and time_zone_h, and \"{file}\" is of {}; \
         give the same place, or [site] with north_deg alone: the weather file says where it is",
        of(own),
        of(other)
    );
    Err(project.error(given.place, message))
}

/// A sky of 0 lx.
fn dark() -> Result<Sky, quasilux_sky::SkyError> {
    Sky::new(Distribution::uniform(), SkyLevel::HorizontalIlluminance { lx: 0.0 })
}
