//! `[[luminaires]]`: measured photometry at a place.

use super::document::{Section, Value};
use super::keys::{DIRECTION, Key, POSITION, optional, required};
use crate::light::{Placement, PlacementError};
use crate::{LoadError, Spanned};
use glam::{DMat3, DVec3};
use quasilux_photometry::{GldfChoice, is_gldf, refused_format};
use quasilux_text::Position;

pub(super) const KEYS: [Key; 14] = [
    required(
        "photometry",
        "file name",
        "The luminaire's IES (`.ies`), EULUMDAT (`.ldt`), TM-33 (`.xml`) or GLDF (`.gldf`) file",
    ),
    required("position", POSITION, "Its photometric centre"),
    optional(
        "as",
        "`\"point\"` or `\"area\"`",
        "`\"point\"`",
        "Whether it shines from a point or from the luminous opening that its file describes",
    ),
    optional("aim", DIRECTION, "`[0, 0, -1]`", "Where gamma = 0 of the file points"),
    optional(
        "c0",
        DIRECTION,
        "`[1, 0, 0]`",
        "Where the half-plane C = 0 of the file points; not along `aim`",
    ),
    optional("rotation_deg", "degrees", "`0`", "Turns it about `aim`, from C0 toward C90"),
    optional(
        "dimming",
        "factor, 0 to 1e9",
        "`1`",
        "Of the light that its file gives; not beside `flux_lm`",
    ),
    optional(
        "flux_lm",
        "lm, 0 to 1e12",
        "the file's",
        "Scales the file to this flux of the luminaire, at its `length_m`",
    ),
    optional(
        "length_m",
        "m, above 0, to 1000",
        "the file's",
        "Length of a linear luminaire sold by the metre: the longer side of its luminous opening, \
         its flux and its power become so much longer, its distribution stays",
    ),
    optional(
        "variant",
        "text",
        "the only one",
        "GLDF: the variant of the product, by its `id` or name",
    ),
    optional(
        "emitter",
        "text",
        "the only one that shines",
        "GLDF: the emitter of the variant, by its `id`, its object in the 3D model or its name",
    ),
    optional(
        "light_source",
        "text",
        "the only one",
        "GLDF: one of the light sources that can be exchanged, by its `id`, that of its equipment, \
         its name, or its number from 1 on",
    ),
    optional(
        "channel",
        "text",
        "all of them",
        "GLDF: the channel of a light source that has several, by its name or its number",
    ),
    optional(
        "emergency",
        "`true` or `false`",
        "`false`",
        "GLDF: whether it shines as in an emergency",
    ),
];
/// Keys that choose from a container.
const CHOICES: [&str; 5] = ["variant", "emitter", "light_source", "channel", "emergency"];
/// Longest luminaire, in m.
const MAX_LENGTH_M: f64 = 1000.0;
/// Largest flux that a project file may give, in lm; far from overflow.
const MAX_FLUX_LM: f64 = 1e12;

/// Expected value of `photometry`, for messages.
const FILE_NAME: &str = "the name of an .ies, .ldt, .xml (TM-33) or .gldf file";

/// One luminaire.
#[derive(Clone, Debug)]
pub(crate) struct LuminaireEntry {
    pub(crate) place: Position,
    /// Name of an IES, EULUMDAT, TM-33 or GLDF file.
    pub(crate) photometry: Spanned<String>,
    pub(crate) position: DVec3,
    pub(crate) world_from_luminaire: DMat3,
    pub(crate) amount: LightOutput,
    /// Where `as = "area"` asks for the luminous shape of the file; a point else.
    pub(crate) as_area: Option<Position>,
    /// Which light of a container.
    pub(crate) choice: GldfChoice,
    /// Another length than the file's, in m.
    pub(crate) length_m: Option<Spanned<f64>>,
}

/// How much light a luminaire gives when it is new.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LightOutput {
    /// This factor of what its file says.
    Dimming(f64),
    /// This flux in lm, at the place of the project file.
    FluxLm(f64, Position),
}

pub(super) fn read(root: &Section<'_>) -> Result<Vec<LuminaireEntry>, LoadError> {
    root.tables("luminaires")?.iter().map(luminaire).collect()
}

fn luminaire(section: &Section<'_>) -> Result<LuminaireEntry, LoadError> {
    section.only(&KEYS, &[])?;
    let photometry = photometry(section.require("photometry", FILE_NAME)?)?;
    let position = "a position [x, y, z] in m";
    let position = section.require("position", position)?.position_m(position)?;
    let form =
        section.get("as").map(|form| Ok((form.name(&["point", "area"], &[])?, form.place())));
    let as_area = match form.transpose()? {
        Some(("area", place)) => Some(place),
        _ => None,
    };
    let choice = choice(section, &photometry.value)?;
    let length_m = section.get("length_m").map(|value| {
        let expected = "a length in m, above 0 and no more than 1000";
        let length_m = value.length_m(expected)?;
        if length_m > MAX_LENGTH_M {
            return Err(value.unexpected(expected));
        }
        Ok(value.spanned(length_m))
    });
    Ok(LuminaireEntry {
        place: section.place(),
        choice,
        length_m: length_m.transpose()?,
        photometry,
        position,
        world_from_luminaire: rotation(section)?,
        amount: amount(section)?,
        as_area,
    })
}

/// Which light of a container is asked for; other files have but one.
fn choice(section: &Section<'_>, photometry: &str) -> Result<GldfChoice, LoadError> {
    let emergency = section.get("emergency").map(|value| value.boolean()).transpose()?;
    let emergency = emergency.unwrap_or(false);
    if !is_gldf(photometry, &[]) {
        let asks = |key: &&&str| **key != "emergency" || emergency;
        let given = CHOICES.iter().filter(asks).find_map(|key| section.get(key));
        return match given {
            Some(value) => {
                let message = format!(
                    "\"{}\" chooses from a GLDF container, and \"photometry\" is none; expected \
                     the name of a .gldf file there",
                    value.key
                );
                Err(value.error(message))
            }
            None => Ok(GldfChoice::default()),
        };
    }
    let text = |key: &str| {
        let expected = "a name in the container";
        let value = section.get(key).map(|value| value.string(expected).map(str::to_owned));
        value.transpose()
    };
    Ok(GldfChoice {
        variant: text("variant")?,
        emitter: text("emitter")?,
        light_source: text("light_source")?,
        channel: text("channel")?,
        emergency,
    })
}

fn amount(section: &Section<'_>) -> Result<LightOutput, LoadError> {
    match (section.get("dimming"), section.get("flux_lm")) {
        (Some(_), Some(flux)) => {
            Err(flux.error("\"dimming\" and \"flux_lm\" exclude each other; give one of them"))
        }
        (None, Some(flux)) => {
            let expected = "the flux of the luminaire in lm, at least 0";
            let lm = flux.number(expected, |x| (0.0..=MAX_FLUX_LM).contains(&x))?;
            Ok(LightOutput::FluxLm(lm, flux.place()))
        }
        (None, None) => Ok(LightOutput::Dimming(1.0)),
        (Some(dimming), None) => {
            let expected = "a factor of at least 0, where 1 is full light";
            let factor = dimming.number(expected, |x| (0.0..=1e9).contains(&x))?;
            Ok(LightOutput::Dimming(factor))
        }
    }
}

fn photometry(value: Value<'_>) -> Result<Spanned<String>, LoadError> {
    let name = value.string(FILE_NAME)?;
    if let Some(refused) = refused_format(name) {
        return Err(value.error(format!("found {refused}")));
    }
    let extension = name.rsplit_once('.').map(|(_, end)| end.to_ascii_lowercase());
    match extension.as_deref() {
        Some("ies" | "ldt" | "xml" | "gldf") => Ok(value.spanned(name.to_owned())),
        _ => Err(value.unexpected(FILE_NAME)),
    }
}

fn rotation(section: &Section<'_>) -> Result<DMat3, LoadError> {
    let (aim, c0) = (section.get("aim"), section.get("c0"));
    let direction = |value: Option<Value<'_>>, default: DVec3| {
        value.map_or(Ok(default), |value| value.vector("a direction [x, y, z] with a length"))
    };
    let degrees =
        section.get("rotation_deg").map(|turn| turn.number("an angle in degrees", |_| true));
    let placement = Placement {
        aim: direction(aim, DVec3::NEG_Z)?,
        c0: direction(c0, DVec3::X)?,
        rotation_rad: degrees.transpose()?.unwrap_or(0.0).to_radians(),
    };
    placement.world_from_luminaire().map_err(|error| {
        let (culprit, message) = match error {
            PlacementError::ZeroAim => (aim, "\"aim\" has no length; expected a direction"),
            PlacementError::ParallelC0 if c0.is_none() => {
                (aim, "\"aim\" is along x, as is the default \"c0\"; expected a \"c0\" across it")
            }
            PlacementError::ParallelC0 => {
                (c0, "\"c0\" is parallel to \"aim\"; expected a direction across it")
            }
        };
        culprit.map_or_else(|| section.error(message), |value| value.error(message))
    })
}
