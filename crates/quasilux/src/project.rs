//! A project on disk: its files, and the settings that follow from it and the command line.

use crate::arguments::SimulationArguments;
use crate::digest::{SceneFile, SceneIdentity, sha256_hex};
use crate::exit::CliError;
use crate::names;
use quasilux_sampling::Randomization;
use quasilux_scene::{Files, Loaded, load};
use quasilux_transport::{EstimatorKind, Reconstruction, Settings, Switch, ToleranceOn};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Larger files are refused before they are read.
const MAX_BYTES: u64 = 8 << 30;

/// Files relative to the project file's folder.
struct Folder {
    path: PathBuf,
    /// Digests of what was read, by name; `None` where there was no file.
    read: RefCell<BTreeMap<String, Option<String>>>,
}

impl Files for Folder {
    fn read(&self, path: &str) -> std::io::Result<Vec<u8>> {
        let outcome = read_bounded(&self.path.join(path));
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
    let bytes = read_bounded(path).map_err(|error| CliError::new(format!("{name}: {error}")))?;
    let path_of_folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let folder = Folder { path: path_of_folder, read: RefCell::default() };
    let loaded = load(&name, &bytes, &folder)?;
    let own_name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let own = SceneFile { path: own_name, sha256: Some(sha256_hex(&bytes)) };
    let others = folder.read.into_inner().into_iter();
    let others = others.map(|(path, sha256)| SceneFile { path, sha256 }).collect();
    Ok(Project { name, loaded, identity: SceneIdentity::new(own, others) })
}

/// The bytes of a file, up to a bound.
pub(crate) fn read_bounded(path: &Path) -> std::io::Result<Vec<u8>> {
    let file = std::fs::File::open(path)?;
    if file.metadata()?.is_dir() {
        return Err(std::io::ErrorKind::IsADirectory.into());
    }
    read_all(file)
}

/// All bytes of a reader, up to the same bound.
pub(crate) fn read_all(reader: impl Read) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    reader.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(std::io::ErrorKind::FileTooLarge.into());
    }
    Ok(bytes)
}

/// What the simulation is asked to do: the command line before the project file before defaults;
/// checked against the scene.
pub(crate) fn settings(
    project: &Project,
    arguments: &SimulationArguments,
) -> Result<Settings, CliError> {
    let section = &project.loaded.simulation;
    let mut settings = Settings::default();
    if let Some(name) = &section.estimator {
        settings.estimator = names::in_project(section, "estimator", name, &EstimatorKind::NAMES)?;
    }
    if let Some(name) = &section.sequence {
        // A sequence that is overruled needs no number of points.
        let points = arguments.samples.or(arguments.sequence.as_ref().map(|_| 1));
        let known = names::sequences(points);
        settings.sequence = names::in_project(section, "sequence", name, &known)?;
    }
    if let Some(name) = &section.randomization {
        let known = &Randomization::NAMES;
        settings.randomization = names::in_project(section, "randomization", name, known)?;
    }
    if let Some(name) = &section.importance {
        settings.importance = names::in_project(section, "importance", name, &Switch::NAMES)?;
    }
    if let Some(name) = &section.connections {
        settings.connections = names::in_project(section, "connections", name, &Switch::NAMES)?;
    }
    if let Some(name) = &arguments.estimator {
        settings.estimator = names::on_command_line("--estimator", name, &EstimatorKind::NAMES)?;
    }
    if let Some(name) = &arguments.sequence {
        let known = names::sequences(arguments.samples);
        settings.sequence = names::on_command_line("--sequence", name, &known)?;
    }
    let limit = [("--time", arguments.time.is_some()), ("--rays", arguments.rays.is_some())];
    if let (Some(_), Some((limit, _))) =
        (settings.sequence.points(), limit.into_iter().find(|(_, is_given)| *is_given))
    {
        return Err(CliError::new(format!(
            "{} fills its first dimension with all of --samples: {limit} cannot end it before",
            settings.sequence.name()
        )));
    }
    let spanned = |at: &Option<quasilux_scene::Spanned<f64>>| at.as_ref().map(|at| at.value);
    let defaults = Settings::default();
    settings.rel_tol = arguments.rel_tol.or(spanned(&section.rel_tol)).unwrap_or(defaults.rel_tol);
    settings.abs_tol_lx =
        arguments.abs_tol.or(spanned(&section.abs_tol_lx)).unwrap_or(defaults.abs_tol_lx);
    if let Some(name) = &section.tolerance_on {
        let known = &ToleranceOn::NAMES;
        settings.tolerance_on = names::in_project(section, "tolerance_on", name, known)?;
    }
    if let Some(name) = &arguments.tolerance_on {
        let known = &ToleranceOn::NAMES;
        settings.tolerance_on = names::on_command_line("--tolerance-on", name, known)?;
    }
    settings.confidence =
        arguments.confidence.or(spanned(&section.confidence)).unwrap_or(defaults.confidence);
    if let Some(name) = &section.first_shot {
        let known = &Switch::NAMES;
        settings.first_shot = names::in_project(section, "first shot", name, known)?;
    }
    settings.map_element_m = spanned(&section.map_element_m);
    settings.map_elements =
        section.map_elements.as_ref().map_or(defaults.map_elements, |at| at.value);
    settings.map_adaptive =
        section.map_adaptive.as_ref().map_or(defaults.map_adaptive, |at| at.value);
    if let Some(name) = &section.map_reconstruction {
        let known = &Reconstruction::NAMES;
        settings.map_reconstruction = names::in_project(section, "reconstruction", name, known)?;
    }
    settings.map_photons = section.map_photons.as_ref().map_or(defaults.map_photons, |at| at.value);
    settings.map_dimensions = section.map_dimensions.as_ref().map(|at| at.value);
    settings.image_depth = section.image_depth.as_ref().map(|at| at.value);
    settings.replicates = section.replicates.as_ref().map_or(defaults.replicates, |at| at.value);
    settings.seed =
        arguments.seed.or(section.seed.as_ref().map(|at| at.value)).unwrap_or(defaults.seed);
    settings.max_bounces = section.max_bounces.as_ref().and_then(|at| at.value);
    settings.list_terms = section.list_terms.as_ref().map_or(0, |at| at.value);
    settings.max_samples = arguments.samples;
    settings.max_rays = arguments.rays;
    if settings.effective_replicates() < 2
        && arguments.samples.is_none()
        && arguments.time.is_none()
        && arguments.rays.is_none()
    {
        return Err(CliError::new(format!(
            "{}: one replicate gives no interval, so no tolerance can end the run: give --samples, \
             --rays or --time, or ask for more replicates and a randomization",
            project.name
        )));
    }
    let checked = quasilux_transport::check(&project.loaded.scene, &settings);
    checked.map_err(|error| CliError::new(format!("{}: {error}", project.name)))?;
    Ok(settings)
}
