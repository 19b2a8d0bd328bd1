//! The project file: TOML bytes to typed sections, everything checked that needs no other file.
//!
//! One file a section; [`SimulationSection`] is the one the command line reads further. Unknown
//! keys, wrong types and values out of range are refused with their place and the nearest valid
//! key.

mod annual;
mod blinds;
mod cameras;
mod coefficients;
mod document;
mod electric_light;
mod grid;
mod keys;
mod lights;
mod luminaires;
mod materials;
mod names;
mod outside;
mod pane;
mod reference;
mod renamed;
mod sensors;
mod simulation;
mod units;

pub use keys::{Key, KeyTable};
pub use names::is_file_name;
pub use reference::reference;
pub use renamed::{REFUSED_KEYS, RefusedKey};
pub use simulation::{SimulationSection, doubt_of_tolerance};
pub use units::LengthUnit;

pub(crate) use annual::{AnnualEntry, OccupancyEntry};
pub(crate) use blinds::{BlindsEntry, BlindsRule, PositionEntry};
pub(crate) use cameras::CameraEntry;
pub(crate) use electric_light::ElectricLightEntry;
pub(crate) use lights::{Emission, LightEntry};
pub(crate) use luminaires::{LightOutput, LuminaireEntry};
pub(crate) use materials::{LayerEntry, MaterialEntry, Scattering};
pub(crate) use outside::{OutsideEntry, OutsideLight, OutsidePlaces, PanoramaEntry, WeatherEntry};
pub(crate) use sensors::SensorEntry;

use crate::{LoadError, Spanned};
use document::{Section, Source, Value};
use keys::{optional, required};
use names::Names;
use quasilux_text::Position;
use toml::de::DeTable;

/// The axis that points up in the geometry files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum UpAxis {
    Y,
    Z,
}

/// A project file, read and checked on its own.
#[derive(Clone, Debug)]
pub(crate) struct Project {
    pub(crate) file: String,
    /// How long the project file is.
    pub(crate) file_bytes: u64,
    /// Names of the geometry files, at least one.
    pub(crate) geometry: Vec<Spanned<String>>,
    /// Where the section of the geometry is.
    pub(crate) scene_place: Position,
    /// `None` where the file does not say: z.
    pub(crate) up: Option<UpAxis>,
    /// Of the geometry files.
    pub(crate) unit: LengthUnit,
    /// Of positions and lengths of the project file.
    pub(crate) position_unit: LengthUnit,
    /// Light that the lights give in use over what they give when new, in (0, 1].
    pub(crate) maintenance_factor: f64,
    pub(crate) materials: Vec<MaterialEntry>,
    pub(crate) luminaires: Vec<LuminaireEntry>,
    pub(crate) lights: Vec<LightEntry>,
    /// Light from outside.
    pub(crate) outside: Option<OutsideEntry>,
    pub(crate) annual: AnnualEntry,
    pub(crate) blinds: Vec<BlindsEntry>,
    pub(crate) electric_light: Vec<ElectricLightEntry>,
    pub(crate) sensors: Vec<SensorEntry>,
    /// At least one where there is no sensor.
    pub(crate) cameras: Vec<CameraEntry>,
    pub(crate) simulation: SimulationSection,
}

/// Most keys, lists and elements of lists together, as their marks are counted: each takes up to
/// 0.1 kB once it is read, whatever it takes in the file.
const MAX_PARTS: usize = 1 << 23;

const EXPECTED_SENSORS: &str = "at least one [[sensors]] or [[cameras]]";

const SECTIONS: [&str; 16] = [
    "scene",
    "materials",
    "luminaires",
    "lights",
    "site",
    "weather",
    "sky",
    "sun",
    "ground",
    "openings",
    "annual",
    "blinds",
    "electric_light",
    "sensors",
    "cameras",
    "simulation",
];

const UNITS: &str = "`\"m\"`, `\"cm\"`, `\"mm\"`, `\"in\"` or `\"ft\"`";
const SCENE_KEYS: [Key; 5] = [
    required(
        "geometry",
        "list of file names",
        "OBJ, glTF or GLB files, Honeybee models (`.hbjson`) or Radiance scenes (`.rad`, `.mat`, \
         which are one scene), at least one, each once",
    ),
    optional(
        "up",
        "`\"y\"` or `\"z\"`",
        "`\"z\"`",
        "The axis that points up in the geometry files; with `\"y\"` their (x, y, z) becomes (x, \
         -z, y)",
    ),
    optional("units", UNITS, "`\"m\"`", "Of the geometry files; Honeybee models say theirs"),
    optional("position_units", UNITS, "`\"m\"`", "Of positions and lengths in the project file"),
    optional(
        "maintenance_factor",
        "factor, above 0, at most 1",
        "`1`",
        "What all lights give in use over what they give when new",
    ),
];

/// Refuses a file that would take too much memory once it is read.
fn expect_few_parts(source: &Source<'_>, text: &str) -> Result<(), LoadError> {
    let is_part = |byte: &u8| matches!(byte, b',' | b'=' | b'[' | b'{');
    let parts = text.as_bytes().iter().filter(|byte| is_part(byte)).count();
    if parts <= MAX_PARTS {
        return Ok(());
    }
    Err(source.error(0, format!("the file has {parts} parts; expected at most {MAX_PARTS}")))
}

impl Project {
    pub(crate) fn parse(file: &str, bytes: &[u8]) -> Result<Self, LoadError> {
        let text = text_of(file, bytes)?;
        let source = Source::new(file, text);
        expect_few_parts(&source, text)?;
        let table = table_of(&source, text)?;
        let root = source.root(table.get_ref());
        root.only_names(&SECTIONS, &[])?;
        let SceneSection {
            geometry,
            place: scene_place,
            up,
            unit,
            position_unit,
            maintenance_factor,
        } = scene_section(&root)?;
        let source = source.with_position_unit(position_unit.metres());
        let root = source.root(table.get_ref());
        let luminaires = luminaires::read(&root)?;
        let lights = lights::read(&root)?;
        let outside = outside::read(&root)?;
        let annual = annual::read(&root, outside.as_ref())?;
        let blinds = blinds::read(&root, outside.as_ref(), &geometry)?;
        if luminaires.is_empty() && lights.is_empty() && outside.is_none() {
            let message = "no lights; expected at least one [[luminaires]] or [[lights]], or [sky]";
            return Err(root.error(message));
        }
        let materials = materials::read(&root)?;
        let mut names = Names::default();
        let sensors = sensors::read(&root, &mut names)?;
        let cameras = cameras::read(&root, &mut names)?;
        if sensors.is_empty() && cameras.is_empty() {
            let message = format!("no sensors and no cameras; expected {EXPECTED_SENSORS}");
            return Err(root.error(message));
        }
        Ok(Self {
            file: file.to_owned(),
            file_bytes: bytes.len() as u64,
            geometry,
            scene_place,
            up,
            unit,
            position_unit,
            maintenance_factor,
            materials,
            luminaires,
            lights,
            outside,
            annual,
            blinds,
            electric_light: electric_light::read(&root)?,
            sensors,
            cameras,
            simulation: simulation::read(file, &root)?,
        })
    }
}

impl Project {
    pub(crate) fn error(&self, place: Position, message: impl Into<String>) -> LoadError {
        LoadError::new(&self.file, Some(place), message)
    }

    /// The number of the sensor of this name.
    pub(crate) fn sensor_number(&self, name: &Spanned<String>) -> Result<usize, LoadError> {
        let names = || self.sensors.iter().map(|entry| entry.sensor.name.as_str());
        names().position(|own| own == name.value).ok_or_else(|| {
            let message =
                format!("no sensor is called \"{}\"; expected the name of one", name.value);
            self.error(name.place, message).offer(&name.value, names())
        })
    }
}

fn table_of<'t>(
    source: &Source<'_>,
    text: &'t str,
) -> Result<toml::Spanned<DeTable<'t>>, LoadError> {
    DeTable::parse(text).map_err(|error| {
        let message = error.message().replace('\n', "; ");
        let offset = error.span().map_or(0, |span| span.start);
        source.error(offset, format!("not valid TOML: {message}"))
    })
}

/// The text without a byte order mark; what is not UTF-8 is refused at its place.
fn text_of<'a>(file: &str, bytes: &'a [u8]) -> Result<&'a str, LoadError> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    std::str::from_utf8(bytes).map_err(|error| {
        let valid = std::str::from_utf8(&bytes[..error.valid_up_to()]).unwrap_or_default();
        Source::new(file, valid).error(valid.len(), "not UTF-8 text; expected a TOML project file")
    })
}

/// `[scene]`: names of geometry files, the axis that points up in them, units, and what holds for
/// all lights.
struct SceneSection {
    geometry: Vec<Spanned<String>>,
    place: Position,
    up: Option<UpAxis>,
    unit: LengthUnit,
    position_unit: LengthUnit,
    maintenance_factor: f64,
}

fn scene_section(root: &Section<'_>) -> Result<SceneSection, LoadError> {
    let expected = "[\"room.obj\"]: OBJ, glTF, GLB, HBJSON or RAD files, relative to the project \
                    file";
    let section = root.table("scene")?.ok_or_else(|| {
        root.error(format!("no [scene] section; expected [scene] with geometry = {expected}"))
    })?;
    section.only(&SCENE_KEYS, &[])?;
    let list = section.require("geometry", expected)?;
    let geometry = geometry_files(&list, expected)?;
    let up = match section.get("up").map(|up| up.name(&["y", "z"], &[])).transpose()? {
        None => None,
        Some("y") => Some(UpAxis::Y),
        Some(_) => Some(UpAxis::Z),
    };
    let maintenance_factor = section.get("maintenance_factor").map(|factor| {
        let expected = "a factor above 0, at most 1, such as 0.8";
        factor.number(expected, |x| x > 0.0 && x <= 1.0)
    });
    let maintenance_factor = maintenance_factor.transpose()?.unwrap_or(1.0);
    Ok(SceneSection {
        geometry,
        place: section.place(),
        up,
        unit: units::read(&section, "units")?,
        position_unit: units::read(&section, "position_units")?,
        maintenance_factor,
    })
}

/// A list of geometry files, each once.
fn geometry_files(list: &Value<'_>, expected: &str) -> Result<Vec<Spanned<String>>, LoadError> {
    let files = list.array(expected)?;
    if files.is_empty() {
        return Err(list.unexpected(expected));
    }
    let mut geometry: Vec<Spanned<String>> = Vec::new();
    for file in files {
        let name = file.string("the name of an OBJ, glTF, GLB, HBJSON or RAD file")?;
        if geometry.iter().any(|earlier| earlier.value == name) {
            return Err(file.error(format!("\"{name}\" is listed twice; list each file once")));
        }
        geometry.push(file.spanned(name.to_owned()));
    }
    Ok(geometry)
}
