//! Where the project file describes each thing of a scene, for what is said of it later.

use crate::Spanned;
use crate::geometry::Geometry;
use crate::project::{LengthUnit, LightEntry, Project, UpAxis};
use quasilux_text::Position;
use std::collections::HashMap;

/// The places of a scene's things in its project file, and what it says of the geometry files.
#[derive(Clone, Debug)]
pub struct Places {
    /// Name of the project file in messages.
    pub file: String,
    /// How long the project file is.
    pub file_bytes: u64,
    /// The section of the geometry.
    pub scene: Position,
    /// Names of the geometry files, as the project file writes them.
    pub geometry: Vec<Spanned<String>>,
    /// Whether y points up in the geometry files.
    pub y_is_up: bool,
    /// The unit of the geometry files.
    pub unit: LengthUnit,
    /// The unit of the project file's own positions.
    pub position_unit: LengthUnit,
    /// Of each light of the scene.
    pub lights: Vec<Position>,
    /// The luminaire file of each light of the scene; `None` for other lights.
    pub photometry: Vec<Option<String>>,
    /// Of each sensor.
    pub sensors: Vec<Position>,
    /// Of each camera.
    pub cameras: Vec<Position>,
    /// Of each opening to the outside.
    pub openings: Vec<Position>,
    /// Of each material; `None` where the project file does not describe it.
    pub materials: Vec<Option<Position>>,
    /// Whether any file describes a material; the default is used for the others.
    pub is_described: Vec<bool>,
}

impl Places {
    pub(super) fn new(project: &Project, geometry: &Geometry) -> Self {
        let luminaires = project.luminaires.iter().map(|entry| entry.place);
        let others = project.lights.iter().map(LightEntry::place);
        let file_of = |light: usize| {
            project.luminaires.get(light).map(|entry| entry.photometry.value.clone())
        };
        let known: HashMap<&str, Position> = project
            .materials
            .iter()
            .map(|entry| (entry.name.value.as_str(), entry.name.place))
            .collect();
        let place_of = |name: &str| known.get(name).copied();
        let materials: Vec<Option<Position>> =
            geometry.materials.iter().map(|material| place_of(&material.name)).collect();
        let described = geometry.materials.iter().zip(&materials);
        let has_default = place_of(crate::geometry::DEFAULT_MATERIAL).is_some();
        Self {
            file: project.file.clone(),
            file_bytes: project.file_bytes,
            scene: project.scene_place,
            geometry: project.geometry.clone(),
            y_is_up: project.up == Some(UpAxis::Y),
            unit: project.unit,
            position_unit: project.position_unit,
            photometry: (0..project.luminaires.len() + project.lights.len()).map(file_of).collect(),
            lights: luminaires.chain(others).collect(),
            sensors: project.sensors.iter().map(|entry| entry.place).collect(),
            cameras: project.cameras.iter().map(|entry| entry.place).collect(),
            openings: project.outside.iter().flat_map(|it| it.places.openings.clone()).collect(),
            is_described: described
                .map(|(of_file, place)| has_default || place.is_some() || of_file.is_described())
                .collect(),
            materials,
        }
    }
}
