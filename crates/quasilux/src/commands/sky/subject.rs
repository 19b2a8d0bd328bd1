//! What the command is about: the outside of a project, a CIE sky of the options, or a site alone.

use crate::arguments::SkyArguments;
use crate::commands::inputs::{Failure, bytes_of, name_of};
use crate::exit::CliError;
use crate::project::{self, Project};
use quasilux_scene::{Environment, FileKind, SkyFacts, SkyModel, Sun};
use quasilux_sky::{
    CieType, Distribution, LightAt, LocalTime, ParsedWeather, Site, Sky, SkyError, SkyLevel,
    SkyPoint, Weather, sun_luminance_cd_m2,
};
use std::path::Path;

/// The share of light that the ground of a sky of the options reflects, as in projects that say
/// nothing.
const GROUND_REFLECTANCE: f64 = 0.2;

/// What the command is about.
#[derive(Clone, Debug)]
pub(crate) struct Subject {
    /// What messages call the project file; empty without one.
    pub(super) name: String,
    /// What pictures call it.
    pub(crate) title: String,
    /// `None` where only the sun's places are asked for.
    pub(crate) sky: Option<ShownSky>,
    pub(super) site: Option<Site>,
    /// Oddities of the project that were lived with.
    pub(super) warnings: Vec<String>,
}

/// What shines.
#[derive(Clone, Debug)]
pub(crate) struct ShownSky {
    pub(super) environment: Environment,
    pub(super) facts: SkyFacts,
}

/// A CIE sky, scaled to what it gives on a horizontal plane.
#[derive(Clone, Copy, Debug)]
pub struct CieSky {
    /// The number of its type, from 1 to 16.
    pub number: u8,
    /// The sun that its luminances depend on; of most types.
    pub sun: Option<SkyPoint>,
    /// Its horizontal illuminance in lx.
    pub lx: f64,
    /// Where on the earth it is, where that is known.
    pub site: Option<Site>,
}

impl Subject {
    pub(super) fn new(arguments: &SkyArguments) -> Result<Self, CliError> {
        let needs_no_time = arguments.positions.is_some();
        if let Some(path) = &arguments.weather {
            return Self::of_weather(path, arguments.time.as_ref(), needs_no_time);
        }
        match (&arguments.project, arguments.cie) {
            (Some(path), _) => Self::of_project(&project::open(path)?, needs_no_time),
            (None, Some(number)) => {
                let sun = arguments.altitude.zip(arguments.azimuth);
                let sun =
                    sun.map(|(altitude_deg, azimuth_deg)| SkyPoint { altitude_deg, azimuth_deg });
                Self::cie(CieSky { number, sun, lx: arguments.lx, site: arguments.site })
            }
            (None, None) => {
                let (name, title) = (String::new(), String::new());
                Ok(Self { name, title, sky: None, site: arguments.site, warnings: Vec::new() })
            }
        }
    }

    /// A CIE sky by itself.
    pub(crate) fn cie(wanted: CieSky) -> Result<Self, CliError> {
        let sky = of_options(wanted).map_err(CliError::new)??;
        let (name, title) = (String::new(), String::new());
        Ok(Self { name, title, sky: Some(sky), site: wanted.site, warnings: Vec::new() })
    }

    /// The outside of a project; without a sky where it has no time and needs none.
    pub(crate) fn of_project(project: &Project, needs_no_time: bool) -> Result<Self, CliError> {
        let title = project.title().to_owned();
        let Project { name, loaded, .. } = project;
        let name = name.clone();
        let refuse = |message: &str| CliError::in_file(&name, None, message);
        let outside = loaded.scene.environment.clone().zip(loaded.sky.clone());
        let (environment, facts) =
            outside.ok_or_else(|| refuse("nothing is outside; add [sky]"))?;
        let site = facts.site;
        let warnings = loaded.warnings.iter().map(ToString::to_string).collect();
        let sky = if !facts.lacks_time() {
            Some(ShownSky { environment, facts })
        } else if needs_no_time {
            None
        } else {
            return Err(refuse(
                "no time says which interval of the weather file the sky is of; set time in \
                 [sun], such as 2026-03-20T12:30:00",
            ));
        };
        Ok(Self { name, title, sky, site, warnings })
    }

    fn of_weather(
        path: &Path,
        time: Option<&LocalTime>,
        needs_no_time: bool,
    ) -> Result<Self, CliError> {
        let file = name_of(path);
        let read = bytes_of(path, FileKind::Weather)
            .and_then(|bytes| Weather::parse(&bytes).map_err(|error| Failure::new(&file, &error)));
        let read = read.map_err(CliError::new)?;
        if time.is_none() && !needs_no_time {
            let message = "no time says which interval; give --time, like --time 2026-03-20T12:30";
            return Err(CliError::in_file(&file, None, message));
        }
        Self::of_weather_file(&file, &read, time)
    }

    /// What a weather file says of a time, with the disk of the sun; without one only of its site.
    pub(crate) fn of_weather_file(
        file: &str,
        read: &ParsedWeather,
        time: Option<&LocalTime>,
    ) -> Result<Self, CliError> {
        let refuse = |message: String| CliError::in_file(file, None, message);
        let site = Some(read.weather.site);
        let sky = |time: &LocalTime| {
            let at = read.weather.light_at(time).map_err(|lack| refuse(lack.to_string()))?;
            of_light(file, at, site)
        };
        let sky = time.map(sky).transpose()?;
        let warnings = read.warnings.iter().map(|warning| format!("{file}:{warning}")).collect();
        Ok(Self { name: String::new(), title: file.to_owned(), sky, site, warnings })
    }

    /// Where on the earth the sun is to be listed.
    pub(super) fn site_for_positions(&self) -> Result<Site, CliError> {
        self.site.ok_or_else(|| {
            if self.name.is_empty() {
                return CliError::new("--positions needs a site; give --site");
            }
            let keys = "latitude_deg, longitude_deg and time_zone_h";
            let message = format!("--positions needs a site; add [site] with {keys}");
            CliError::in_file(&self.name, None, message)
        })
    }
}

/// What shines in an interval of a weather file.
fn of_light(file: &str, at: LightAt, site: Option<Site>) -> Result<ShownSky, CliError> {
    let Some(light) = at.light else {
        let middle = at.middle.to_string().replacen('T', " ", 1);
        let message = format!("nothing shines at {}; give a time of the day", &middle[5..]);
        return Err(CliError::in_file(file, None, message));
    };
    let model = SkyModel::Weather { file: file.to_owned() };
    let facts = SkyFacts { model, site, time: Some(at.middle), sun: Some(light.sun) };
    let normal_illuminance_lx = light.sun_normal_illuminance_lx;
    let sun = Sun { centre: light.sun, normal_illuminance_lx };
    Ok(ShownSky {
        environment: Environment {
            sky: light.sky,
            sun: Some(sun).filter(|_| normal_illuminance_lx > 0.0),
            ground_reflectance: GROUND_REFLECTANCE,
            north_deg: 0.0,
            openings: Vec::new(),
        },
        facts,
    })
}

/// A CIE sky; the inner error says that a sun is missing.
fn of_options(wanted: CieSky) -> Result<Result<ShownSky, CliError>, SkyError> {
    let CieSky { number, sun, lx, site } = wanted;
    let cie = CieType::new(i64::from(number))?;
    if cie.needs_sun() && sun.is_none() {
        return Ok(Err(CliError::new(format!(
            "the luminances of a CIE sky of type {number} depend on the sun; give --altitude and \
             --azimuth"
        ))));
    }
    let zenith = SkyPoint { altitude_deg: 90.0, azimuth_deg: 0.0 };
    let level = SkyLevel::HorizontalIlluminance { lx };
    let sky = Sky::new(Distribution::cie(cie, sun.unwrap_or(zenith)), level)?;
    let facts = SkyFacts { model: SkyModel::Cie(cie), site, time: None, sun };
    let environment = Environment {
        sky,
        sun: None,
        ground_reflectance: GROUND_REFLECTANCE,
        north_deg: 0.0,
        openings: Vec::new(),
    };
    Ok(Ok(ShownSky { environment, facts }))
}

impl ShownSky {
    /// The illuminance of the sky alone on a horizontal plane, in lx.
    pub(super) fn sky_lx(&self) -> f64 {
        self.environment.sky.horizontal_illuminance_lx()
    }

    /// The illuminance of the sun alone on a horizontal plane, in lx.
    pub(super) fn sun_lx(&self) -> f64 {
        self.environment.horizontal_illuminance_lx() - self.sky_lx()
    }

    /// The luminance of the sun's disk in cd/m2, where it shines.
    pub(super) fn sun_cd_m2(&self) -> Option<f64> {
        self.environment.sun.map(|sun| sun_luminance_cd_m2(sun.normal_illuminance_lx))
    }

    /// The luminance of the sky in a direction of the compass.
    pub(crate) fn luminance_cd_m2(&self, altitude_deg: f64, azimuth_deg: f64) -> f64 {
        let point = SkyPoint { altitude_deg, azimuth_deg };
        // The horizon itself is sky.
        let [x, y, z] = point.to_direction();
        self.environment.sky.luminance_cd_m2([x, y, z.max(0.0)])
    }

    /// The model, for people.
    pub(super) fn model_text(&self) -> String {
        match &self.facts.model {
            SkyModel::Uniform => "uniform sky".to_owned(),
            SkyModel::Cie(cie) if cie.number() == 16 => "traditional overcast sky".to_owned(),
            SkyModel::Cie(cie) => {
                format!("CIE standard general sky {}: {}", cie.number(), cie.description())
            }
            SkyModel::Perez => "all-weather sky of Perez".to_owned(),
            SkyModel::Weather { file } => format!("all-weather sky of Perez, by {file}"),
            SkyModel::Panorama { file } => format!("panorama {file}"),
        }
    }

    /// The time, for people; the interval of a weather file is of no year.
    pub(super) fn time_text(&self) -> Option<String> {
        let text = self.facts.time?.to_string().replacen('T', " ", 1);
        Some(match &self.facts.model {
            SkyModel::Weather { .. } => {
                let (_, of_year) = text.split_once('-')?;
                format!("{of_year}, the middle of its interval")
            }
            _ => text,
        })
    }
}
