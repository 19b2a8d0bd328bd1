//! What shines from outside.

use crate::commands::{CieSky, ShownSky, Subject, sky_document, sky_drawing, sky_text};
use crate::exit::CliError;
use crate::project::Project;
use quasilux_drawing::Drawing;
use quasilux_sky::{LocalTime, SkyPoint, Weather};

/// One sky, as `quasilux sky` describes it.
#[derive(Clone, Debug)]
pub struct OutsideSky {
    subject: Subject,
    sky: ShownSky,
}

impl OutsideSky {
    /// That of a project.
    ///
    /// # Errors
    /// When nothing is outside, or no time says of which interval of a weather file.
    pub fn of_project(project: &Project) -> Result<Self, CliError> {
        Self::new(Subject::of_project(project, false)?)
    }

    /// Sky of a weather file, which messages call `file`, at a time by the clock of its site.
    ///
    /// # Errors
    /// When it is no weather file, or nothing shines then.
    pub fn of_weather(file: &str, bytes: &[u8], time: &LocalTime) -> Result<Self, CliError> {
        let read = Weather::parse(bytes)
            .map_err(|error| CliError::in_file(file, Some(error.position()), error.message()))?;
        Self::new(Subject::of_weather_file(file, &read, Some(time))?)
    }

    /// A CIE sky.
    ///
    /// # Errors
    /// When there is no such sky, or it depends on a sun that is not given.
    pub fn cie(wanted: CieSky) -> Result<Self, CliError> {
        Self::new(Subject::cie(wanted)?)
    }

    fn new(subject: Subject) -> Result<Self, CliError> {
        let sky = subject.sky.clone().ok_or_else(|| CliError::new("there is no sky"))?;
        Ok(Self { subject, sky })
    }

    /// The luminance in a direction of the compass in cd/m2, without the sun; 0 below the horizon.
    #[must_use]
    pub fn luminance_cd_m2(&self, direction: SkyPoint) -> f64 {
        let SkyPoint { altitude_deg, azimuth_deg } = direction;
        if altitude_deg < 0.0 { 0.0 } else { self.sky.luminance_cd_m2(altitude_deg, azimuth_deg) }
    }

    /// The document, format "quasilux-sky/1".
    #[must_use]
    pub fn document(&self) -> String {
        sky_document(&self.subject)
    }

    /// Description for people.
    #[must_use]
    pub fn text(&self) -> String {
        sky_text(&self.subject)
    }

    /// Its luminances in false colours.
    #[must_use]
    pub fn drawing(&self) -> Drawing {
        sky_drawing(&self.subject, &self.sky)
    }
}
