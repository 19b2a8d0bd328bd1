//! A project on disk: its files, and the settings that follow from it and the command line.

use crate::arguments::SimulationArguments;
use crate::digest::{SceneFile, SceneIdentity, sha256_hex};
use crate::exit::CliError;
use crate::forecast;
use crate::heartbeat::Heartbeat;
use crate::input;
use crate::names::{self, take_from_project as take};
use quasilux_sampling::{Randomization, Sequence};
use quasilux_scene::{FileKind, Files, LoadError, Loaded, SimulationSection, Spanned, load};
use quasilux_transport::{EstimatorKind, Reconstruction, Settings, Switch, ToleranceOn};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Files relative to the project file's folder.
struct Folder {
    path: PathBuf,
    /// Digests of what was read, by name; `None` where there was no file.
    read: RefCell<BTreeMap<String, Option<String>>>,
}

impl Files for Folder {
    fn read(&self, path: &str, kind: FileKind) -> std::io::Result<Vec<u8>> {
        let outcome = input::read_kind(&self.path.join(path), kind);
        let digest = outcome.as_ref().ok().map(|bytes| sha256_hex(bytes));
        self.read.borrow_mut().insert(path.to_owned(), digest);
        outcome
    }
}

/// A loaded project, and what messages call its file.
pub(crate) struct Project {
    pub(crate) name: String,
    pub(crate) loaded: Loaded,
    /// Which scene it is.
    pub(crate) identity: SceneIdentity,
}

/// Loads a project; messages name its files as the user does.
pub(crate) fn open(path: &Path) -> Result<Project, CliError> {
    let name = path.display().to_string();
    let bytes = input::read(path, input::MAX_PROJECT_BYTES)
        .map_err(|error| CliError::new(format!("{name}: {error}")))?;
    let path_of_folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let folder = Folder { path: path_of_folder, read: RefCell::default() };
    let signs_of_life = Heartbeat::new(&format!("reading {name}"));
    let loaded = load(&name, &bytes, &folder)?;
    drop(signs_of_life);
    let own_name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let own = SceneFile { path: own_name, sha256: Some(sha256_hex(&bytes)) };
    let others = folder.read.into_inner().into_iter();
    let others = others.map(|(path, sha256)| SceneFile { path, sha256 }).collect();
    Ok(Project { name, loaded, identity: SceneIdentity::new(own, others) })
}

/// The settings of a run: the command line before the project file before defaults; checked against
/// the scene.
///
/// # Errors
/// When a name is unknown, or the settings make no sense together or for the scene.
pub(crate) fn settings(
    project: &Project,
    arguments: &SimulationArguments,
) -> Result<Settings, CliError> {
    let section = &project.loaded.simulation;
    let mut settings = Settings::default();
    names_in_section(&mut settings, section, arguments)?;
    values_in_section(&mut settings, section);
    take_arguments(&mut settings, arguments)?;
    expect_an_end(project, &settings, arguments)?;
    let checked = quasilux_transport::check(&project.loaded.scene, &settings);
    checked.map_err(|error| CliError::new(format!("{}: {error}", project.name)))?;
    forecast::expect_memory(&project.loaded, &settings)?;
    Ok(settings)
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
    let (name, all) = (&from.map_reconstruction, &Reconstruction::ALL);
    take(&mut to.map_reconstruction, from, name, "reconstruction", all, Reconstruction::name)?;
    let take_switch =
        |to: &mut Switch, name, what| take(to, from, name, what, &Switch::ALL, Switch::name);
    take_switch(&mut to.importance, &from.importance, "importance")?;
    take_switch(&mut to.connections, &from.connections, "connections")?;
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
    settings.rel_tol = arguments.rel_tol.unwrap_or(settings.rel_tol);
    settings.abs_tol_lx = arguments.abs_tol.unwrap_or(settings.abs_tol_lx);
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
    checked.map_err(|error| CliError::new(format!("{file}: {error}")))?;
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
        return Err(CliError::new(format!(
            "{}: one replicate gives no interval, so no tolerance can end the run: give --samples, \
             --rays or --time, or ask for more replicates and a randomization",
            project.name
        )));
    }
    Ok(())
}
