//! What the command is about: the outside of a project, a CIE sky of the options, or a site alone.

use crate::arguments::SkyArguments;
use crate::commands::inputs::{Failure, bytes_of, name_of};
use crate::exit::CliError;
use crate::project;
use quasilux_scene::{Environment, FileKind, SkyFacts, SkyModel, Sun};
use quasilux_sky::{
    CieType, Distribution, LightAt, Site, Sky, SkyError, SkyLevel, SkyPoint, Weather,
    sun_luminance_cd_m2,
};
use std::path::Path;

/// The share of light that the ground of a sky of the options reflects, as in projects that say
/// nothing.
const GROUND_REFLECTANCE: f64 = 0.2;

/// What the command is about.
pub(super) struct Subject {
    /// What messages call the project file; empty without one.
    pub(super) name: String,
    /// What pictures call it.
    pub(super) title: String,
    /// `None` where only the sun's places are asked for.
    pub(super) sky: Option<ShownSky>,
    pub(super) site: Option<Site>,
    /// Oddities of the project that were lived with.
    pub(super) warnings: Vec<String>,
}

/// What shines.
pub(super) struct ShownSky {
    pub(super) environment: Environment,
    pub(super) facts: SkyFacts,
}

impl Subject {
    pub(super) fn new(arguments: &SkyArguments) -> Result<Self, CliError> {
        if let Some(path) = &arguments.weather {
            return Self::of_weather(path, arguments);
        }
        match (&arguments.project, arguments.cie) {
            (Some(path), _) => Self::of_project(path, arguments.positions.is_some()),
            (None, Some(number)) => {
                let sky = of_options(number, arguments).map_err(CliError::new)??;
                let site = arguments.site;
                let (name, title) = (String::new(), String::new());
                Ok(Self { name, title, sky: Some(sky), site, warnings: Vec::new() })
            }
            (None, None) => {
                let (name, title) = (String::new(), String::new());
                Ok(Self { name, title, sky: None, site: arguments.site, warnings: Vec::new() })
            }
        }
    }

    fn of_project(path: &Path, needs_no_time: bool) -> Result<Self, CliError> {
        let project = project::open(path)?;
        let title = project.title().to_owned();
        let project::Project { name, loaded, .. } = project;
        let refuse = |message: &str| CliError::in_file(&name, None, message);
        let (environment, facts) = loaded
            .scene
            .environment
            .zip(loaded.sky)
            .ok_or_else(|| refuse("nothing is outside; add [sky]"))?;
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

    /// What a weather file says of a time, with the disk of the sun.
    fn of_weather(path: &Path, arguments: &SkyArguments) -> Result<Self, CliError> {
        let file = name_of(path);
        let refuse = |message: String| CliError::in_file(&file, None, message);
        let read = bytes_of(path, FileKind::Weather)
            .and_then(|bytes| Weather::parse(&bytes).map_err(|error| Failure::new(&file, &error)));
        let read = read.map_err(CliError::new)?;
        let site = Some(read.weather.site);
        let warnings = read.warnings.iter().map(|warning| format!("{file}:{warning}")).collect();
        let sky = match &arguments.time {
            Some(time) => {
                let at = read.weather.light_at(time);
                Some(of_light(&file, at.map_err(|lack| refuse(lack.to_string()))?, site)?)
            }
            None if arguments.positions.is_some() => None,
            None => {
                let expected = "give --time, like --time 2026-03-20T12:30";
                return Err(refuse(format!("no time says which interval; {expected}")));
            }
        };
        Ok(Self { name: String::new(), title: file, sky, site, warnings })
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
fn of_options(
    number: u8,
    arguments: &SkyArguments,
) -> Result<Result<ShownSky, CliError>, SkyError> {
    let cie = CieType::new(i64::from(number))?;
    let sun = arguments.altitude.zip(arguments.azimuth);
    let sun = sun.map(|(altitude_deg, azimuth_deg)| SkyPoint { altitude_deg, azimuth_deg });
    if cie.needs_sun() && sun.is_none() {
        return Ok(Err(CliError::new(format!(
            "the luminances of a CIE sky of type {number} depend on the sun; give --altitude and \
             --azimuth"
        ))));
    }
    let zenith = SkyPoint { altitude_deg: 90.0, azimuth_deg: 0.0 };
    let level = SkyLevel::HorizontalIlluminance { lx: arguments.lx };
    let sky = Sky::new(Distribution::cie(cie, sun.unwrap_or(zenith)), level)?;
    let facts = SkyFacts { model: SkyModel::Cie(cie), site: arguments.site, time: None, sun };
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
    pub(super) fn luminance_cd_m2(&self, altitude_deg: f64, azimuth_deg: f64) -> f64 {
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
