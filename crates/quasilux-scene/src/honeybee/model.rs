//! The document: what of a model has to do with light.

use super::document::{self, List};
use super::radiance::{FaceRadiance, ModelRadiance, RoomRadiance, ShadeRadiance, SubFaceRadiance};
use super::shapes::{Face3D, Mesh3D};
use crate::{LengthUnit, LoadError};
use serde::Deserialize;

/// A whole model.
#[derive(Debug, Deserialize)]
pub(crate) struct Model {
    #[serde(rename = "type")]
    kind: Option<String>,
    units: Option<Units>,
    #[serde(default)]
    pub(crate) rooms: List<Room>,
    #[serde(default)]
    pub(crate) orphaned_faces: List<Face>,
    #[serde(default)]
    pub(crate) orphaned_shades: List<Shade>,
    #[serde(default)]
    pub(crate) orphaned_apertures: List<Aperture>,
    #[serde(default)]
    pub(crate) orphaned_doors: List<Door>,
    #[serde(default)]
    pub(crate) shade_meshes: List<ShadeMesh>,
    #[serde(default, deserialize_with = "document::or_default")]
    properties: Properties<ModelRadiance>,
}

/// Properties of a thing, of which those of light count.
#[derive(Debug, Deserialize)]
pub(crate) struct Properties<T> {
    radiance: Option<T>,
}

impl<T> Default for Properties<T> {
    fn default() -> Self {
        Self { radiance: None }
    }
}

impl<T> Properties<T> {
    pub(super) fn get(&self) -> Option<&T> {
        self.radiance.as_ref()
    }
}

#[derive(Clone, Copy, Debug, Deserialize)]
enum Units {
    Meters,
    Millimeters,
    Feet,
    Inches,
    Centimeters,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Room {
    pub(crate) faces: Vec<Face>,
    #[serde(default)]
    pub(crate) indoor_shades: List<Shade>,
    #[serde(default)]
    pub(crate) outdoor_shades: List<Shade>,
    #[serde(default, deserialize_with = "document::or_default")]
    pub(crate) properties: Properties<RoomRadiance>,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Face {
    pub(crate) identifier: String,
    pub(crate) geometry: Face3D,
    pub(crate) face_type: FaceType,
    #[serde(default, deserialize_with = "document::or_default")]
    pub(crate) boundary_condition: Boundary,
    #[serde(default)]
    pub(crate) apertures: List<Aperture>,
    #[serde(default)]
    pub(crate) doors: List<Door>,
    #[serde(default)]
    pub(crate) indoor_shades: List<Shade>,
    #[serde(default)]
    pub(crate) outdoor_shades: List<Shade>,
    #[serde(default, deserialize_with = "document::or_default")]
    pub(crate) properties: Properties<FaceRadiance>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub(crate) enum FaceType {
    Wall,
    Floor,
    RoofCeiling,
    AirBoundary,
}

/// Condition behind a face.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct Boundary {
    #[serde(rename = "type")]
    kind: Option<String>,
    #[serde(default)]
    boundary_condition_objects: List<String>,
}

impl Boundary {
    /// Whether another room or nothing that has a sky is behind.
    pub(super) fn is_inside(&self) -> bool {
        !matches!(self.kind.as_deref(), None | Some("Outdoors" | "Ground"))
    }

    /// The identifier of the thing on the other side, where it is that of a neighbour.
    pub(super) fn neighbour(&self) -> Option<&str> {
        let is_between_rooms = self.kind.as_deref() == Some("Surface");
        let first = self.boundary_condition_objects.first();
        first.filter(|_| is_between_rooms).map(String::as_str)
    }
}

#[derive(Debug, Deserialize)]
pub(crate) struct Aperture {
    pub(crate) identifier: String,
    pub(crate) geometry: Face3D,
    pub(crate) is_operable: Option<bool>,
    #[serde(default, deserialize_with = "document::or_default")]
    pub(crate) boundary_condition: Boundary,
    #[serde(default)]
    pub(crate) indoor_shades: List<Shade>,
    #[serde(default)]
    pub(crate) outdoor_shades: List<Shade>,
    #[serde(default, deserialize_with = "document::or_default")]
    pub(crate) properties: Properties<SubFaceRadiance>,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Door {
    pub(crate) identifier: String,
    pub(crate) geometry: Face3D,
    pub(crate) is_glass: Option<bool>,
    #[serde(default, deserialize_with = "document::or_default")]
    pub(crate) boundary_condition: Boundary,
    #[serde(default)]
    pub(crate) indoor_shades: List<Shade>,
    #[serde(default)]
    pub(crate) outdoor_shades: List<Shade>,
    #[serde(default, deserialize_with = "document::or_default")]
    pub(crate) properties: Properties<SubFaceRadiance>,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Shade {
    pub(crate) identifier: String,
    pub(crate) geometry: Face3D,
    #[serde(default, deserialize_with = "document::or_default")]
    pub(crate) properties: Properties<ShadeRadiance>,
}

#[derive(Debug, Deserialize)]
pub(crate) struct ShadeMesh {
    pub(crate) identifier: String,
    pub(crate) geometry: Mesh3D,
    /// Whether it belongs to no building, as it does where nothing is said.
    pub(crate) is_detached: Option<bool>,
    #[serde(default, deserialize_with = "document::or_default")]
    pub(crate) properties: Properties<ShadeRadiance>,
}

impl Model {
    /// Reads a file; `file` is what messages call it.
    pub(crate) fn parse(file: &str, bytes: &[u8]) -> Result<Self, LoadError> {
        let model: Self = document::parse(file, bytes)?;
        match model.kind.as_deref() {
            Some("Model") => Ok(model),
            other => {
                let found = other.map_or("none".to_owned(), |kind| format!("{kind:?}"));
                let message = format!("type: found {found}; expected \"Model\", a whole model");
                Err(LoadError::new(file, None, message))
            }
        }
    }

    /// The unit of its lengths.
    pub(crate) fn unit(&self) -> LengthUnit {
        match self.units {
            None | Some(Units::Meters) => LengthUnit::Metre,
            Some(Units::Millimeters) => LengthUnit::Millimetre,
            Some(Units::Feet) => LengthUnit::Foot,
            Some(Units::Inches) => LengthUnit::Inch,
            Some(Units::Centimeters) => LengthUnit::Centimetre,
        }
    }

    /// Properties of light.
    pub(crate) fn radiance(&self) -> Option<&ModelRadiance> {
        self.properties.get()
    }
}
