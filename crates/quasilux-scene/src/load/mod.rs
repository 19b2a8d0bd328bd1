//! From the bytes of a project to a checked [`Scene`].

mod glazing;
mod lights;
mod materials;
mod measured;
mod outside;
mod photometry;
mod places;

pub use places::Places;

use crate::project::{Project, SimulationSection};
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
    /// What the sky was made of; `None` where nothing is outside.
    pub sky: Option<SkyFacts>,
    /// What the project file asks of the engine.
    pub simulation: SimulationSection,
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
    let geometry = geometry::read(&project, files, &mut warnings)?;
    let materials = materials::resolve(&project, &geometry, files, &mut warnings)?;
    let lights = lights::place(&project, &geometry, files, &mut warnings)?;
    let sensors = project.sensors.iter().map(|entry| entry.sensor.clone()).collect();
    let cameras = project.cameras.iter().map(|entry| entry.camera.clone()).collect();
    let places = Places::new(&project, &geometry);
    let outside::Outside { environment, weather, facts } =
        outside::resolve(&project, files, &mut warnings)?;
    let mesh = geometry.mesh;
    let scene = Scene { mesh, materials, lights, environment, weather, sensors, cameras };
    enclosures::light_must_end(&scene, &project)?;
    enclosures::glass_must_be_closed(&scene, &project, &mut warnings);
    checks::places_in_walls(&scene, &project, &mut warnings)?;
    let Project { simulation, maintenance_factor, .. } = project;
    Ok(Loaded { scene, places, maintenance_factor, sky: facts, simulation, warnings })
}
