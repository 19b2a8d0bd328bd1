//! The document: `properties.radiance`, what is said of light.

use super::document::{List, Point, or_default};
use super::shapes::{Face3D, Mesh3D};
use serde::de::value::MapAccessDeserializer;
use serde::de::{IgnoredAny, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;

/// Most modifiers or sets of a list: each takes some hundred bytes at least.
const MAX_MODIFIERS: usize = 100_000;

/// Of a model.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct ModelRadiance {
    #[serde(default)]
    pub(super) modifiers: List<Modifier, MAX_MODIFIERS>,
    #[serde(default)]
    pub(super) modifier_sets: List<ModifierSet, MAX_MODIFIERS>,
    pub(super) global_modifier_set: Option<Named<ModifierSet>>,
    #[serde(default)]
    pub(crate) sensor_grids: List<SensorGrid>,
    #[serde(default)]
    pub(crate) views: List<View>,
    #[serde(default)]
    pub(crate) luminaires: List<Luminaire>,
}

/// A thing, or the identifier of one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Named<T> {
    Name(String),
    Whole(Box<T>),
}

struct NamedVisitor<T>(std::marker::PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for NamedVisitor<T> {
    type Value = Named<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an identifier, or what it would name")
    }

    fn visit_str<E>(self, name: &str) -> Result<Named<T>, E> {
        Ok(Named::Name(name.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Named<T>, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(|whole| Named::Whole(Box::new(whole)))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NamedVisitor(std::marker::PhantomData))
    }
}

/// Material of Radiance, which surfaces are made of.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct Modifier {
    #[serde(rename = "type")]
    pub(super) kind: Option<String>,
    pub(super) identifier: Option<String>,
    pub(super) r_reflectance: Option<f64>,
    pub(super) g_reflectance: Option<f64>,
    pub(super) b_reflectance: Option<f64>,
    pub(super) specularity: Option<f64>,
    pub(super) roughness: Option<f64>,
    pub(super) transmitted_diff: Option<f64>,
    pub(super) transmitted_spec: Option<f64>,
    pub(super) r_transmissivity: Option<f64>,
    pub(super) g_transmissivity: Option<f64>,
    pub(super) b_transmissivity: Option<f64>,
    pub(super) refraction_index: Option<f64>,
    pub(super) r_emittance: Option<f64>,
    pub(super) g_emittance: Option<f64>,
    pub(super) b_emittance: Option<f64>,
    pub(super) max_radius: Option<f64>,
    pub(super) bsdf_data: Option<String>,
    pub(super) up_orientation: Option<Point>,
    pub(super) thickness: Option<f64>,
    pub(super) transform: Option<IgnoredAny>,
    pub(super) function_file: Option<String>,
    pub(super) front_diffuse_reflectance: List<f64>,
    pub(super) back_diffuse_reflectance: List<f64>,
    pub(super) diffuse_transmittance: List<f64>,
    pub(super) dependencies: List<IgnoredAny>,
    pub(super) modifier: Option<Named<Kind>>,
}

/// The type of a thing of which no more is asked.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(crate) struct Kind {
    #[serde(rename = "type")]
    pub(super) kind: Option<String>,
}

/// Modifiers by what they are for; what is left out comes from the model's set, or from Honeybee's.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct ModifierSet {
    pub(super) identifier: Option<String>,
    pub(super) wall_set: Option<Sides>,
    pub(super) floor_set: Option<Sides>,
    pub(super) roof_ceiling_set: Option<Sides>,
    pub(super) shade_set: Option<Sides>,
    pub(super) aperture_set: Option<ApertureSet>,
    pub(super) door_set: Option<DoorSet>,
    pub(super) air_boundary_modifier: Option<Named<Modifier>>,
    pub(super) context_modifier: Option<Named<Modifier>>,
    pub(super) modifiers: List<Modifier, MAX_MODIFIERS>,
}

/// Of things that are inside or outside.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Sides {
    pub(super) interior_modifier: Option<Named<Modifier>>,
    pub(super) exterior_modifier: Option<Named<Modifier>>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct ApertureSet {
    pub(super) window_modifier: Option<Named<Modifier>>,
    pub(super) interior_modifier: Option<Named<Modifier>>,
    pub(super) skylight_modifier: Option<Named<Modifier>>,
    pub(super) operable_modifier: Option<Named<Modifier>>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct DoorSet {
    pub(super) exterior_modifier: Option<Named<Modifier>>,
    pub(super) interior_modifier: Option<Named<Modifier>>,
    pub(super) exterior_glass_modifier: Option<Named<Modifier>>,
    pub(super) interior_glass_modifier: Option<Named<Modifier>>,
    pub(super) overhead_modifier: Option<Named<Modifier>>,
}

/// Of a room.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct RoomRadiance {
    pub(super) modifier_set: Option<Named<ModifierSet>>,
}

/// Of a face.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct FaceRadiance {
    pub(super) modifier: Option<Named<Modifier>>,
}

/// Of an aperture or a door.
#[derive(Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct SubFaceRadiance {
    pub(super) modifier: Option<Named<Modifier>>,
    pub(super) dynamic_group_identifier: Option<String>,
    pub(super) states: List<State>,
}

/// Of a shade or a mesh of shades.
pub(crate) type ShadeRadiance = SubFaceRadiance;

/// How a thing is in a state of its group.
#[derive(Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct State {
    pub(super) modifier: Option<Named<Modifier>>,
    pub(super) shades: List<StateGeometry>,
}

/// A shade that is there in one state.
#[derive(Debug, PartialEq, Deserialize)]
pub(crate) struct StateGeometry {
    pub(super) identifier: String,
    pub(super) geometry: Face3D,
    pub(super) modifier: Option<Named<Modifier>>,
}

/// Points of measurement.
#[derive(Debug, Deserialize)]
pub(crate) struct SensorGrid {
    pub(crate) identifier: String,
    pub(crate) sensors: Vec<SensorPlace>,
    /// With a face or a vertex for each point.
    pub(crate) mesh: Option<Mesh3D>,
    #[serde(default)]
    pub(crate) light_path: List<IgnoredAny>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
pub(crate) struct SensorPlace {
    pub(crate) pos: Point,
    pub(crate) dir: Point,
}

/// Where a picture is taken from.
#[derive(Debug, Deserialize)]
pub(crate) struct View {
    pub(crate) identifier: String,
    pub(crate) position: Point,
    pub(crate) direction: Point,
    pub(crate) up_vector: Option<Point>,
    pub(crate) view_type: Option<String>,
    /// Angles in degrees, of a perspective view.
    pub(crate) h_size: Option<f64>,
    pub(crate) v_size: Option<f64>,
    pub(crate) shift: Option<f64>,
    pub(crate) lift: Option<f64>,
    pub(crate) fore_clip: Option<f64>,
    pub(crate) aft_clip: Option<f64>,
}

/// A photometric file and where luminaires of it hang.
#[derive(Debug, Deserialize)]
pub(crate) struct Luminaire {
    pub(crate) identifier: Option<String>,
    pub(crate) ies_path: Option<String>,
    pub(crate) ies_content: Option<String>,
    pub(crate) light_loss_factor: Option<f64>,
    pub(crate) candela_multiplier: Option<f64>,
    pub(crate) luminaire_zone: Option<LuminaireZone>,
    pub(crate) custom_lamp: Option<CustomLamp>,
}

impl Luminaire {
    /// Where those of it hang.
    pub(crate) fn instances(&self) -> &[LuminaireInstance] {
        self.luminaire_zone.as_ref().map_or(&[][..], |zone| &zone.instances)
    }
}

#[derive(Debug, Deserialize)]
pub(crate) struct LuminaireZone {
    #[serde(default)]
    pub(crate) instances: List<LuminaireInstance>,
}

/// A place; angles in degrees.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(crate) struct LuminaireInstance {
    pub(crate) point: NamedPoint,
    #[serde(default, deserialize_with = "or_default")]
    pub(crate) spin: f64,
    #[serde(default, deserialize_with = "or_default")]
    pub(crate) tilt: f64,
    #[serde(default, deserialize_with = "or_default")]
    pub(crate) rotation: f64,
}

/// A lamp in place of that of the file: its colour is left out.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(crate) struct CustomLamp {
    pub(crate) depreciation_factor: Option<f64>,
}

/// A point with names for its coordinates.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(crate) struct NamedPoint {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) z: f64,
}
