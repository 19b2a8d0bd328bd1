//! A loaded project, and the settings that follow from it and the command line.

use crate::arguments::{SimulationArguments, YearArguments};
use crate::digest::SceneIdentity;
use crate::exit::CliError;
use crate::forecast;
use crate::heartbeat::Heartbeat;
use crate::names::{self, take_from_project as take};
use crate::source::{Identified, Source};
use quasilux_sampling::{Randomization, Sequence};
use quasilux_scene::{Environment, LoadError, Loaded, SimulationSection, SkyFacts, Spanned};
use quasilux_transport::{
    EstimatorKind, IntervalKind, Reconstruction, Settings, Switch, ToleranceOn, UnseenTolerance,
};
use std::path::Path;

/// A loaded project, and what messages call its file.
pub struct Project {
    pub(crate) name: String,
    pub(crate) loaded: Loaded,
    /// Which scene it is.
    pub(crate) identity: SceneIdentity,
    /// What it is made of.
    pub(crate) source: Source,
}

/// Loads a project, with signs of life; messages name its files as the user does.
pub(crate) fn open(path: &Path) -> Result<Project, CliError> {
    let _signs_of_life = Heartbeat::new(&format!("reading {}", path.display()));
    Project::open(path)
}

impl Project {
    /// Loads a project file, or a bundle; messages name its files as the user does.
    ///
    /// # Errors
    /// When a file cannot be read, parsed or made sense of.
    pub fn open(path: &Path) -> Result<Self, CliError> {
        Self::load(Source::at(path)?)
    }

    /// Loads a project of files and arrays in memory.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn load(source: Source) -> Result<Self, CliError> {
        let Identified { loaded, identity } = source.load()?;
        Ok(Self { name: source.name.clone(), loaded, identity, source })
    }

    /// What messages call the project file.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// SHA-256 that identifies the scene, of the bytes of all that it was read from.
    #[must_use]
    pub fn sha256(&self) -> &str {
        &self.identity.sha256
    }

    /// The scene, and what was said of it.
    #[must_use]
    pub fn loaded(&self) -> &Loaded {
        &self.loaded
    }

    /// What the scene was made of.
    #[must_use]
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Everything that the scene is made of, for another machine: [`Source::from_bundle`] reads it.
    ///
    /// # Errors
    /// When a file has changed since the scene was loaded.
    pub fn to_bundle(&self) -> Result<Vec<u8>, CliError> {
        self.source.to_bundle(&self.identity)
    }

    /// What the project is called in pictures: its file without folder and ending.
    pub(crate) fn title(&self) -> &str {
        let stem = Path::new(&self.name).file_stem().and_then(|stem| stem.to_str());
        stem.unwrap_or_default()
    }
}

/// The settings of a run: the command line before the project file before defaults; checked against
/// the scene.
///
/// # Errors
/// When a name is unknown, the settings make no sense together or for the scene, or nothing shines
/// in it.
pub(crate) fn settings(
    project: &Project,
    arguments: &SimulationArguments,
) -> Result<Settings, CliError> {
    expect_light(project)?;
    let section = &project.loaded.simulation;
    let mut settings = Settings::default();
    names_in_section(&mut settings, section, arguments)?;
    values_in_section(&mut settings, section);
    take_arguments(&mut settings, arguments)?;
    expect_an_end(project, &settings, arguments)?;
    let checked = quasilux_transport::check(&project.loaded.scene, &settings);
    checked.map_err(|error| CliError::in_file(&project.name, None, error))?;
    forecast::expect_memory(&project.loaded, &settings)?;
    Ok(settings)
}

/// The settings of a year: the command line before the project file before defaults. A tolerance
/// of the project file is one of points, not of hours.
///
/// # Errors
/// When a name is unknown, or the settings make no sense together.
pub(crate) fn annual_settings(
    project: &Project,
    arguments: &YearArguments,
) -> Result<Settings, CliError> {
    let section = &project.loaded.simulation;
    let mut settings = Settings::default();
    names_in_section(&mut settings, section, &SimulationArguments::default())?;
    values_in_section(&mut settings, section);
    settings.estimator = EstimatorKind::Path;
    settings.rel_tol = arguments.rel_tol;
    settings.abs_tol_lx = arguments.abs_tol;
    settings.confidence = arguments.confidence.unwrap_or(settings.confidence);
    settings.seed = arguments.seed.unwrap_or(settings.seed);
    settings.max_samples = arguments.samples;
    let checked = quasilux_transport::check(&project.loaded.scene, &settings);
    checked.map_err(|error| CliError::in_file(&project.name, None, error))?;
    Ok(settings)
}

/// Refuses projects of a whole year.
pub(crate) fn expect_a_time(project: &Project) -> Result<(), CliError> {
    if project.loaded.sky.as_ref().is_some_and(SkyFacts::lacks_time) {
        let message = "no time says which interval of the weather file the sky is of; set time in \
                       [sun], such as 2026-03-20T12:30:00 (`quasilux annual` computes the year)";
        return Err(CliError::in_file(&project.name, None, message));
    }
    Ok(())
}

/// Refuses projects of a whole year, and those in which nothing shines.
fn expect_light(project: &Project) -> Result<(), CliError> {
    expect_a_time(project)?;
    let scene = &project.loaded.scene;
    let refuse = |message: &str| Err(CliError::in_file(&project.name, None, message));
    let is_dark_outside = scene.environment.as_ref().is_some_and(Environment::is_dark);
    if is_dark_outside && scene.flux_lm() <= 0.0 {
        return refuse("nothing shines: the sky is dark, and no lamp gives any flux");
    }
    Ok(())
}

/// Takes over what the project file gives by name.
fn names_in_section(
    settings: &mut Settings,
    section: &SimulationSection,
    arguments: &SimulationArguments,
) -> Result<(), LoadError> {
    // A sequence that is overruled needs no number of points.
    let points = arguments.samples.or(arguments.sequence.as_ref().map(|_| 1));
    let sequences = names::sequences(points);
    let to = settings;
    let from = section;
    let all = &EstimatorKind::ALL;
    take(&mut to.estimator, from, &from.estimator, "estimator", all, EstimatorKind::name)?;
    take(&mut to.sequence, from, &from.sequence, "sequence", &sequences, Sequence::name)?;
    let (name, all) = (&from.randomization, &Randomization::ALL);
    take(&mut to.randomization, from, name, "randomization", all, Randomization::name)?;
    let (name, all) = (&from.tolerance_on, &ToleranceOn::ALL);
    take(&mut to.tolerance_on, from, name, "tolerance_on", all, ToleranceOn::name)?;
    let (name, all) = (&from.interval, &IntervalKind::ALL);
    take(&mut to.interval, from, name, "interval", all, IntervalKind::name)?;
    let (name, all) = (&from.map_reconstruction, &Reconstruction::ALL);
    take(&mut to.map_reconstruction, from, name, "reconstruction", all, Reconstruction::name)?;
    let take_switch =
        |to: &mut Switch, name, what| take(to, from, name, what, &Switch::ALL, Switch::name);
    take_switch(&mut to.importance, &from.importance, "importance")?;
    take_switch(&mut to.first_shot, &from.first_shot, "first shot")
}

/// Takes over the numbers and truth values of the project file.
fn values_in_section(settings: &mut Settings, section: &SimulationSection) {
    fn take<T: Clone>(setting: &mut T, given: &Option<Spanned<T>>) {
        if let Some(given) = given {
            *setting = given.value.clone();
        }
    }
    take(&mut settings.rel_tol, &section.rel_tol);
    take(&mut settings.abs_tol_lx, &section.abs_tol_lx);
    if let Some(given) = &section.unseen_tol {
        settings.unseen_tol = given.value.map_or(UnseenTolerance::Off, UnseenTolerance::Share);
    }
    take(&mut settings.confidence, &section.confidence);
    take(&mut settings.map_elements, &section.map_elements);
    take(&mut settings.map_adaptive, &section.map_adaptive);
    take(&mut settings.map_photons, &section.map_photons);
    take(&mut settings.replicates, &section.replicates);
    take(&mut settings.seed, &section.seed);
    take(&mut settings.list_terms, &section.list_terms);
    take(&mut settings.max_bounces, &section.max_bounces);
    settings.map_element_m = section.map_element_m.as_ref().map(|given| given.value);
    settings.map_dimensions = section.map_dimensions.as_ref().map(|given| given.value);
    settings.image_depth = section.image_depth.as_ref().map(|given| given.value);
}

/// Takes over what the command line gives.
fn take_arguments(
    settings: &mut Settings,
    arguments: &SimulationArguments,
) -> Result<(), CliError> {
    if let Some(name) = &arguments.estimator {
        let all = &EstimatorKind::ALL;
        settings.estimator = names::on_command_line("--estimator", name, all, EstimatorKind::name)?;
    }
    if let Some(name) = &arguments.sequence {
        let known = names::sequences(arguments.samples);
        settings.sequence = names::on_command_line("--sequence", name, &known, Sequence::name)?;
    }
    if let Some(name) = &arguments.tolerance_on {
        let all = &ToleranceOn::ALL;
        settings.tolerance_on =
            names::on_command_line("--tolerance-on", name, all, ToleranceOn::name)?;
    }
    if let Some(name) = &arguments.interval {
        let all = &IntervalKind::ALL;
        settings.interval = names::on_command_line("--interval", name, all, IntervalKind::name)?;
    }
    settings.rel_tol = arguments.rel_tol.unwrap_or(settings.rel_tol);
    settings.abs_tol_lx = arguments.abs_tol.unwrap_or(settings.abs_tol_lx);
    settings.unseen_tol = arguments.unseen_tol.unwrap_or(settings.unseen_tol);
    settings.confidence = arguments.confidence.unwrap_or(settings.confidence);
    settings.seed = arguments.seed.unwrap_or(settings.seed);
    settings.max_samples = arguments.samples;
    settings.max_rays = arguments.rays;
    Ok(())
}

/// The settings in a plan or checkpoint, checked against the scene; `file` is what messages call
/// it.
///
/// # Errors
/// When the settings make no sense together or for the scene.
pub(crate) fn kept_settings(
    settings: &Settings,
    file: &str,
    project: &Project,
) -> Result<Settings, CliError> {
    let sequence = settings.sequence.with_points(settings.max_samples.unwrap_or(0));
    let settings = Settings { sequence, ..settings.clone() };
    let checked = quasilux_transport::check(&project.loaded.scene, &settings);
    checked.map_err(|error| CliError::in_file(file, None, error))?;
    forecast::expect_memory(&project.loaded, &settings)?;
    Ok(settings)
}

/// Refuses limits that cannot end the run, and runs that nothing can end.
fn expect_an_end(
    project: &Project,
    settings: &Settings,
    arguments: &SimulationArguments,
) -> Result<(), CliError> {
    let limit = [("--time", arguments.time.is_some()), ("--rays", arguments.rays.is_some())];
    if let (Some(_), Some((limit, _))) =
        (settings.sequence.points(), limit.into_iter().find(|(_, is_given)| *is_given))
    {
        return Err(CliError::new(format!(
            "{} fills its first dimension with all of --samples: {limit} cannot end it before",
            settings.sequence.name()
        )));
    }
    let has_limit =
        arguments.samples.is_some() || arguments.time.is_some() || arguments.rays.is_some();
    if settings.effective_replicates() < 2 && !has_limit {
        let message = "no tolerance can end the run, since one replicate gives no interval: give \
                       --samples, --rays or --time, or set more replicates and a randomization";
        return Err(CliError::in_file(&project.name, None, message));
    }
    Ok(())
}
