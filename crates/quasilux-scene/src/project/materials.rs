//! `[materials.NAME]`: what the project file says about the materials of the geometry.

use super::coefficients::{eta, index, reflectance, shares};
use super::document::{Entry, Section, Value};
use super::keys::{DIRECTION, Key, SHARES, optional, required};
use super::pane;
use crate::bsdf::{Conductor, Dielectric, Diffuse, Mirror, Plastic, Translucent};
use crate::{Bsdf, LoadError, Spanned};
use glam::DVec3;

/// A kind of material, with the keys that it may hold.
pub(super) struct Kind {
    name: &'static str,
    /// The line that asks for it.
    pub(super) line: &'static str,
    pub(super) about: &'static str,
    pub(super) keys: &'static [Key],
}

const KIND: Key =
    optional("kind", "name of a kind", "`\"diffuse\"`", "How the surface scatters light");
const REFLECTANCE: Key = required("reflectance", SHARES, "The share of light that it reflects");
const ETA: Key = optional("eta", "0.2 to 5, not 1", "`1.5`", "Its refractive index");
const FROM_ALPHA: &str = "the square root of `alpha`";
const ROUGHNESS: Key = optional(
    "roughness",
    "0.02 to 1",
    FROM_ALPHA,
    "The square root of `alpha`: equal steps look alike; one of the two is given",
);
const ALPHA: Key = optional(
    "alpha",
    "0.0004 to 1",
    "`roughness` squared",
    "Width of the distribution of slopes (GGX)",
);
pub(super) const KINDS: [Kind; 8] = [
    Kind {
        name: "diffuse",
        line: "kind = \"diffuse\"",
        about: "A Lambertian surface, or a translucent sheet; both shares make 1 at most",
        keys: &[
            KIND,
            REFLECTANCE,
            optional(
                "transmittance",
                SHARES,
                "`0`",
                "The share of light that comes out of its other side",
            ),
        ],
    },
    Kind {
        name: "mirror",
        line: "kind = \"mirror\"",
        about: "A perfect mirror",
        keys: &[KIND, REFLECTANCE],
    },
    Kind {
        name: "dielectric",
        line: "kind = \"dielectric\"",
        about: "A clear closed body, its triangles facing outward: reflection and refraction",
        keys: &[KIND, ETA],
    },
    Kind {
        name: "pane",
        line: "kind = \"pane\"",
        about: "A flat pane drawn as one sheet: light goes straight through or is mirrored",
        keys: &[
            KIND,
            ETA,
            optional(
                "transmittance",
                "share, `[r, g, b]`, or table `[[0, share], ..., [90, share]]`",
                "that of a clear pane",
                "At normal incidence, or by the angle of incidence in degrees; a table goes \
                 without `eta`",
            ),
            optional(
                "reflectance",
                "table `[[0, share], ..., [90, share]]`",
                "`0` beside a table, else from `eta`",
                "By the angle of incidence, beside a table of `transmittance`",
            ),
        ],
    },
    Kind {
        name: "glazing",
        line: "kind = \"glazing\"",
        about: "The glass of a window: panes behind one another, from the front of the facets on",
        keys: &[
            KIND,
            required(
                "layers",
                "1 to 10 file names, or `{ file = \"...\", flipped = true }`",
                "Product files of the IGSDB (JSON); `flipped` turns a pane round",
            ),
        ],
    },
    Kind {
        name: "conductor",
        line: "kind = \"conductor\"",
        about: "Rough metal: GGX, whose reflectance rises to 1 at grazing incidence",
        keys: &[KIND, REFLECTANCE, ROUGHNESS, ALPHA],
    },
    Kind {
        name: "plastic",
        line: "kind = \"plastic\"",
        about: "A diffuse base under a clear rough coat",
        keys: &[
            KIND,
            required(
                "reflectance",
                SHARES,
                "The share of the light that enters the coat and comes out again",
            ),
            optional("eta", "above 1, at most 5", "`1.5`", "The refractive index of the coat"),
            ROUGHNESS,
            ALPHA,
        ],
    },
    Kind {
        name: "bsdf",
        line: "kind = \"bsdf\"",
        about: "A thin sheet whose scattering was measured",
        keys: &[
            KIND,
            required(
                "file",
                "file name",
                "WINDOW XML (Klems patches, tensor trees), MERL, ASTM E1392, DDR or DDT",
            ),
            optional(
                "up",
                DIRECTION,
                "none",
                "Where the y axis of the tables points; tables that are the same however they \
                 are turned need none",
            ),
        ],
    },
];
const PLANNED_KINDS: [&str; 2] = ["glossy", "phong"];
const PLANNED_KEYS: [&str; 2] = ["specular", "texture"];

/// Roughness below which a surface is as good as smooth; its square is the least alpha.
const MIN_ROUGHNESS: f64 = 0.02;
const MIN_ALPHA: f64 = 0.0004;

/// More panes than any glazing has.
const MAX_LAYERS: usize = 10;

/// Expected value of `file`, for messages.
const FILE_NAME: &str = "the name of a file with a measured BSDF";
const LAYERS: &str = "files of the IGSDB from the front on, [\"outer.json\", { file = \
                      \"inner.json\", flipped = true }], at most 10";
const UP: &str = "a direction [x, y, z] with a length";

/// One material.
#[derive(Clone, Debug)]
pub(crate) struct MaterialEntry {
    pub(crate) name: Spanned<String>,
    pub(crate) scattering: Scattering,
}

/// How a material scatters light.
#[derive(Clone, Debug)]
pub(crate) enum Scattering {
    /// By the project file alone.
    Described(Bsdf),
    /// By the tables of a file.
    Measured {
        file: Spanned<String>,
        /// Where the `y` axis of the tables points.
        up: Option<Spanned<DVec3>>,
    },
    /// By panes of glass, the one at the front first.
    Glazing(Vec<LayerEntry>),
}

/// One pane of a glazing.
#[derive(Clone, Debug)]
pub(crate) struct LayerEntry {
    pub(crate) file: Spanned<String>,
    /// Whether its back is turned to the front of the glazing.
    pub(crate) is_flipped: bool,
}

pub(super) fn read(root: &Section<'_>) -> Result<Vec<MaterialEntry>, LoadError> {
    let Some(materials) = root.table("materials")? else {
        return Ok(Vec::new());
    };
    entries(&materials)
}

/// The materials of a table, by name.
pub(super) fn entries(materials: &Section<'_>) -> Result<Vec<MaterialEntry>, LoadError> {
    let entries = materials.entries().into_iter();
    entries
        .map(|Entry { key: name, value }| {
            let section = value.section(format!("[materials.{}]", name.value))?;
            let name = Spanned { value: name.value.to_owned(), place: name.place };
            Ok(MaterialEntry { name, scattering: scattering(&section)? })
        })
        .collect()
}

fn scattering(section: &Section<'_>) -> Result<Scattering, LoadError> {
    let names = KINDS.map(|kind| kind.name);
    let kind = section.get("kind").map(|kind| kind.name(&names, &PLANNED_KINDS));
    let kind = kind.transpose()?.unwrap_or("diffuse");
    refuse_keys_of_other_kinds(section, kind)?;
    match kind {
        "bsdf" => measured(section),
        "glazing" => glazing(section),
        _ => Ok(Scattering::Described(bsdf(section, kind)?)),
    }
}

fn bsdf(section: &Section<'_>, kind: &str) -> Result<Bsdf, LoadError> {
    Ok(match kind {
        "mirror" => Bsdf::Mirror(Mirror { reflectance: reflectance(section)? }),
        "dielectric" => Bsdf::Dielectric(Dielectric { eta: eta(section)? }),
        "pane" => Bsdf::Pane(pane::read(section)?),
        "conductor" => Bsdf::Conductor(Conductor {
            reflectance: reflectance(section)?,
            alpha: alpha(section, "; kind = \"mirror\" is smooth")?,
        }),
        "plastic" => Bsdf::Plastic(Plastic {
            reflectance: reflectance(section)?,
            eta: index(section, "a refractive index above 1, at most 5", |x| x > 1.0 && x <= 5.0)?,
            alpha: alpha(section, "")?,
        }),
        _ => diffuse(section)?,
    })
}

fn measured(section: &Section<'_>) -> Result<Scattering, LoadError> {
    let file = section.require("file", FILE_NAME)?;
    let file = file.spanned(file.string(FILE_NAME)?.to_owned());
    let up = section.get("up").map(|value| match value.vector(UP)? {
        DVec3::ZERO => Err(value.unexpected(UP)),
        up => Ok(value.spanned(up)),
    });
    Ok(Scattering::Measured { file, up: up.transpose()? })
}

fn glazing(section: &Section<'_>) -> Result<Scattering, LoadError> {
    let value = section.require("layers", LAYERS)?;
    let layers = value.array(LAYERS)?;
    if layers.is_empty() || layers.len() > MAX_LAYERS {
        return Err(value.unexpected(LAYERS));
    }
    Ok(Scattering::Glazing(layers.iter().map(layer).collect::<Result<_, _>>()?))
}

fn layer(value: &Value<'_>) -> Result<LayerEntry, LoadError> {
    if value.is_string() {
        let file = value.spanned(value.string(LAYERS)?.to_owned());
        return Ok(LayerEntry { file, is_flipped: false });
    }
    let section = value.section("of a layer".to_owned()).map_err(|_| value.unexpected(LAYERS))?;
    section.only_names(&["file", "flipped"], &[])?;
    let file = section.require("file", LAYERS)?;
    let file = file.spanned(file.string(LAYERS)?.to_owned());
    let is_flipped = section.get("flipped").map_or(Ok(false), |flipped| flipped.boolean())?;
    Ok(LayerEntry { file, is_flipped })
}

fn refuse_keys_of_other_kinds(section: &Section<'_>, kind: &str) -> Result<(), LoadError> {
    let keys_of = |name: &str| KINDS.iter().find(|known| known.name == name).map(|it| it.keys);
    let known = keys_of(kind).unwrap_or(&[]);
    for Entry { key, value } in section.entries() {
        let has_key = |keys: &[Key]| keys.iter().any(|it| it.name == key.value);
        if !has_key(known) && KINDS.iter().any(|kind| has_key(kind.keys)) {
            let kinds = KINDS.iter().filter(|kind| has_key(kind.keys));
            let kinds: Vec<String> = kinds.map(|kind| format!("\"{}\"", kind.name)).collect();
            let names: Vec<&str> = known.iter().map(|key| key.name).collect();
            return Err(value.error(format!(
                "\"{}\" goes with kind = {}, not with \"{kind}\"; expected {}",
                key.value,
                kinds.join(" or "),
                names.join(", ")
            )));
        }
    }
    section.only(known, &PLANNED_KEYS)
}

fn diffuse(section: &Section<'_>) -> Result<Bsdf, LoadError> {
    let reflectance = reflectance(section)?;
    let Some(value) = section.get("transmittance") else {
        return Ok(Bsdf::Diffuse(Diffuse { reflectance }));
    };
    let transmittance = shares(value)?;
    let sum = (reflectance + transmittance).max_channel();
    // A hair above one is the rounding of shares that add up to one.
    if sum > 1.0 + 1e-12 {
        let message = format!(
            "reflectance and transmittance add up to {sum}; expected at most 1 in each channel"
        );
        return Err(value.error(message));
    }
    Ok(Bsdf::Translucent(Translucent { reflectance, transmittance }))
}

/// Given as such, or as a roughness, whose square it is: equal steps of roughness look alike.
fn alpha(section: &Section<'_>, smooth: &str) -> Result<f64, LoadError> {
    let value = section.exactly_one(&["roughness", "alpha"])?;
    if value.key == "alpha" {
        let expected = format!("a number within {MIN_ALPHA} to 1{smooth}");
        return value.number(&expected, |x| (MIN_ALPHA..=1.0).contains(&x));
    }
    let expected = format!("a number within {MIN_ROUGHNESS} to 1{smooth}");
    let roughness = value.number(&expected, |x| (MIN_ROUGHNESS..=1.0).contains(&x))?;
    Ok(roughness * roughness)
}
