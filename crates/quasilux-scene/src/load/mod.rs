//! From the bytes of a project to a checked [`Scene`].

mod annual;
mod blinds;
mod blurred_sun;
mod glazing;
mod lights;
mod materials;
mod measured;
mod outside;
mod photometry;
mod places;
mod schedule;

use measured::Sources;
use photometry::Told;
pub use places::Places;

use crate::annual::{Blinds, ElectricLight, YearTerms};
use crate::project::{ElectricLightEntry, Project, SimulationSection};
use crate::{Files, LoadError, Scene, SkyFacts, Warning, checks, enclosures, geometry};

/// A loaded project.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// Where the project file describes what.
    pub places: Places,
    /// Factor in (0, 1] by which the lights of the scene are dimmer than when they were new; they
    /// have it in them.
    pub maintenance_factor: f64,
    /// Facts that the sky was made from; `None` where nothing is outside.
    pub sky: Option<SkyFacts>,
    /// Terms that a year is judged by.
    pub annual: YearTerms,
    /// Blinds that move over a year; they are open in the scene.
    pub blinds: Option<Blinds>,
    /// Electric light that daylight dims over a year.
    pub electric_light: Vec<ElectricLight>,
    /// Settings that the project file asks of the engine.
    pub simulation: SimulationSection,
    /// Facts of luminaire files beside their photometry, and lengths that luminaires were given,
    /// for people: `file: fact`.
    pub luminaire_notes: Vec<String>,
    /// Oddities that were lived with.
    pub warnings: Vec<Warning>,
}

/// Loads a project: `project_name` is what messages call the project file, `files` reaches the
/// files that it names.
///
/// # Errors
/// When a file cannot be read, parsed or made sense of; see [`LoadError`].
pub fn load(
    project_name: &str,
    project_bytes: &[u8],
    files: &dyn Files,
) -> Result<Loaded, LoadError> {
    let project = Project::parse(project_name, project_bytes)?;
    let mut warnings = Vec::new();
    let mut sources = Sources::new(files);
    let Built { scene, places, facts, luminaire_notes } =
        build(&project, &mut sources, &mut warnings)?;
    let annual = annual::terms(&project, scene.weather.as_ref(), files)?;
    let intervals = scene.weather.as_ref().map_or(0, |weather| weather.hours.len());
    let blinds = blinds::hang(&project, intervals, &mut sources, &mut warnings)?;
    let electric_light = electric_light(&project)?;
    let Project { simulation, maintenance_factor, .. } = project;
    Ok(Loaded {
        scene,
        places,
        maintenance_factor,
        sky: facts,
        annual,
        blinds,
        electric_light,
        simulation,
        luminaire_notes,
        warnings,
    })
}

/// A scene, and what was said of it.
struct Built {
    scene: Scene,
    places: Places,
    facts: Option<SkyFacts>,
    luminaire_notes: Vec<String>,
}

/// The scene of a project, its blinds open.
fn build(
    project: &Project,
    sources: &mut Sources<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<Built, LoadError> {
    let files = sources.files;
    let geometry = geometry::read(project, files, warnings)?;
    let materials = materials::resolve(project, &geometry, sources, warnings)?;
    let mut told = Told::default();
    let lights = lights::place(project, &geometry, files, &mut told)?;
    warnings.append(&mut told.warnings);
    let sensors = project.sensors.iter().map(|entry| entry.sensor.clone()).collect();
    let cameras = project.cameras.iter().map(|entry| entry.camera.clone()).collect();
    let places = Places::new(project, &geometry);
    let outside::Outside { environment, weather, facts } =
        outside::resolve(project, files, warnings)?;
    let mesh = geometry.mesh;
    let scene = Scene { mesh, materials, lights, environment, weather, sensors, cameras };
    enclosures::light_must_end(&scene, project)?;
    enclosures::glass_must_be_closed(&scene, project, warnings);
    checks::places_in_walls(&scene, project, warnings)?;
    blurred_sun::tell(&scene, project, warnings);
    Ok(Built { scene, places, facts, luminaire_notes: told.notes })
}

fn electric_light(project: &Project) -> Result<Vec<ElectricLight>, LoadError> {
    let zone = |entry: &ElectricLightEntry| {
        let &ElectricLightEntry { power_w, min_power_w, target_lx, .. } = entry;
        let (name, sensor) = (entry.name.clone(), project.sensor_number(&entry.sensor)?);
        Ok(ElectricLight { name, sensor, target_lx, power_w, min_power_w })
    };
    project.electric_light.iter().map(zone).collect()
}
