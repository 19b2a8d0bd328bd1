//! GLDF containers: a product with its variants, emitters and photometric files in a zip archive.
//!
//! The chain that is followed is variant, emitter, light emitter, photometry, file; see
//! [`formats::gldf`](crate::formats::gldf) for the elements, and [`GldfChoice`] for what can be
//! asked for. `archive` keeps the archive harmless, `light` makes the light as bright as its lamps,
//! `rotation` turns it, `description` finds contradictions.

mod archive;
mod channels;
mod description;
mod error;
mod facts;
mod figures;
mod file;
mod flux;
mod light;
mod light_emitter;
mod names;
mod opening;
mod product;
mod rotation;
mod selection;
mod texts;
mod told;
mod variant;

use crate::warning::Warnings;
use crate::{Keyword, LuminaireFacts, Photometry, WarningKind};
use archive::Archive;
use error::PRODUCT;
pub use error::{ContainerWarning, GldfError};
use glam::DMat3;
use light::{Light, Power};
use light_emitter::{Behaviour, LightEmitter};
use product::Product;
use quasilux_text::decode;
use quasilux_text::xml::{self, Element};
use rotation::Turn;
pub use selection::GldfChoice;
use std::borrow::Cow;
use texts::{attribute, in_quotes, listed, text_of};
pub use told::ContainerFact;
use told::Told;
use variant::EmitterUse;

/// Bytes that `product.xml` may have: the tree of its elements takes a multiple of it.
const MAX_PRODUCT_BYTES: usize = 2 << 20;
/// Bytes in which a declaration names its encoding.
const DECLARATION_BYTES: usize = 200;

/// The light of a container that was chosen.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct GldfLuminaire {
    /// The luminaire, as bright as its light sources make it, in the frame of its photometric file.
    pub photometry: Photometry,
    /// The turn from that frame to the frame of the luminaire.
    pub luminaire_from_photometry: DMat3,
    /// The name of the photometric file in the container; the first one of several channels.
    pub part: String,
    /// Facts that photometric files do not have.
    pub facts: Vec<ContainerFact>,
    /// Deviations and contradictions that were lived with.
    pub warnings: Vec<ContainerWarning>,
}

/// Whether a file is a container: a zip archive, or one by its name.
#[must_use]
pub fn is_gldf(name: &str, bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06") || has_ending(name, "gldf")
}

/// The reason why a file of this name is not read: formats of single programs.
#[must_use]
pub fn refused_format(name: &str) -> Option<&'static str> {
    if has_ending(name, "uld") {
        Some(
            "a ULD file, DIALux's own format, which is not published; expected an EULUMDAT (.ldt), \
             IES or GLDF file (ask the maker, or save one from DIALux)",
        )
    } else if has_ending(name, "rolf") || has_ending(name, "rolfz") {
        Some(
            "a ROLF file, Relux's own format, which is not published; expected an EULUMDAT \
             (.ldt), IES or GLDF file (ask the maker, or save one from Relux)",
        )
    } else {
        None
    }
}

fn has_ending(name: &str, ending: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, end)| end.eq_ignore_ascii_case(ending))
}

/// Reads the light of a container. Total: any bytes give a luminaire or an error, and no archive
/// makes it unpack more than 16 MiB.
///
/// # Errors
/// [`GldfError`] where the archive or a file in it is damaged or refused, where there are several
/// choices and none was asked for, and where one that was asked for does not exist.
pub fn read_gldf(bytes: &[u8], choice: &GldfChoice) -> Result<GldfLuminaire, GldfError> {
    let mut archive = Archive::open(bytes)?;
    let Some(name) = archive.find(PRODUCT)?.map(str::to_owned) else {
        let expected = "one in a GLDF container (for a zip of photometric files, unpack it and \
                        name one)";
        return Err(GldfError::of_container("no product.xml", expected));
    };
    let xml = archive.unpack(&name, MAX_PRODUCT_BYTES)?;
    let mut told = Told::default();
    let text = text_of_product(&xml, &mut told);
    let root = xml::parse(&text).map_err(|error| GldfError::in_part(PRODUCT, &error))?;
    if root.name != "Root" {
        let found = format!("the root element {}", in_quotes(root.name));
        return Err(GldfError::at(&root, found, "Root, that of a GLDF product"));
    }
    read_product(Product { root: &root }, choice, &mut archive, told)
}

/// The text of `product.xml`: UTF-8 or UTF-16 by its byte order mark, else code page 850 where its
/// declaration says so, else UTF-8, or Latin-1, which is told.
fn text_of_product<'b>(bytes: &'b [u8], told: &mut Told) -> Cow<'b, str> {
    let start = bytes[..bytes.len().min(DECLARATION_BYTES)].to_ascii_lowercase();
    let start = String::from_utf8_lossy(&start);
    let declaration = start.starts_with("<?xml").then(|| start.split_once("?>")).flatten();
    let is_850 = |declaration: &str| {
        ["ibm850", "cp850", "ibm-850"].iter().any(|name| declaration.contains(name))
    };
    if declaration.is_some_and(|(declaration, _)| is_850(declaration)) {
        return Cow::Owned(names::from_code_page_850(bytes));
    }
    let mut warnings = Warnings::default();
    let text = decode(bytes, &mut warnings);
    let has_mark = [&[0xEF, 0xBB, 0xBF][..], &[0xFF, 0xFE], &[0xFE, 0xFF]];
    if !has_mark.iter().any(|mark| bytes.starts_with(mark)) {
        told.pass_on(PRODUCT, warnings.into_vec());
    }
    text
}

fn read_product(
    product: Product<'_>,
    choice: &GldfChoice,
    archive: &mut Archive<'_>,
    mut told: Told,
) -> Result<GldfLuminaire, GldfError> {
    let variant = variant::choose_variant(product, choice)?;
    let uses = variant::emitters(product, variant, &mut told)?;
    let chosen = variant::choose_emitter(&uses, choice)?;
    let emitter = LightEmitter::choose(product, chosen.emitter, choice)?;
    tell_choice(variant, &chosen, &emitter, &mut told);
    if emitter.behaviour == Behaviour::EmergencyOnly && !choice.emergency {
        let found = "a light emitter for emergencies only";
        let expected = "one for normal operation (it shines, as it was asked for)";
        told.warn(WarningKind::EmergencyEmitter, emitter.element.at, found, expected);
    }
    tell_others(&uses, &chosen, choice, &mut told);
    let light = light::read(product, &emitter, choice, archive, &mut told)?;
    facts::of_light(&light, &mut told)?;
    let turn = Turn::read(emitter.element)?;
    tell_turn(&turn, &emitter, &chosen, &mut told);
    facts::of_mounting(variant, &mut told);
    let mut photometry = named(product, variant, &light);
    if let Some(simple) = chosen.simple {
        photometry = opening::with_opening(photometry, simple, &turn, &mut told)?;
    }
    let is_emergency = choice.emergency || emitter.behaviour == Behaviour::EmergencyOnly;
    if let ([only], false) = (&light.parts[..], is_emergency) {
        description::compare(only.declared, &photometry, &mut told)?;
    }
    Ok(GldfLuminaire {
        photometry,
        luminaire_from_photometry: turn.luminaire_from_photometry,
        part: light.parts.first().map(|part| part.part.clone()).unwrap_or_default(),
        facts: told.facts,
        warnings: told.warnings,
    })
}

/// The luminaire under the names that the container gives it, which count before those of the
/// photometric file, and with its power.
fn named(product: Product<'_>, variant: &Element<'_>, light: &Light<'_>) -> Photometry {
    let photometry = &light.photometry;
    let definitions = product.root.child("ProductDefinitions");
    let meta = definitions.and_then(|definitions| definitions.child("ProductMetaData"));
    let of_product = |name| meta.and_then(|meta| meta.child(name));
    let header = product.root.child("Header");
    let mut facts = photometry.facts().clone();
    for (keyword, elements) in [
        ("MANUFAC", [header.and_then(|header| header.child("Manufacturer")), None]),
        ("LUMINAIRE", [variant.child("Name"), of_product("Name")]),
        ("LUMCAT", [variant.child("ProductNumber"), of_product("ProductNumber")]),
    ] {
        let found = elements.into_iter().flatten().find_map(|it| Some((it, text_of(Some(it))?)));
        if let Some((element, text)) = found {
            set_keyword(&mut facts, keyword, text, element.at.line);
        }
    }
    match light.power {
        Power::Unknown => facts.input_watts = 0.0,
        Power::Stated(power_w) if power_w > 0.0 => facts.input_watts = power_w,
        _ => {}
    }
    Photometry::new(photometry.table().clone(), facts)
}

fn set_keyword(facts: &mut LuminaireFacts, name: &str, text: &str, line: usize) {
    facts.keywords.retain(|keyword| keyword.name != name);
    let value = text.split_whitespace().collect::<Vec<_>>().join(" ");
    facts.keywords.push(Keyword { name: name.to_owned(), value, line });
}

fn tell_choice(
    variant: &Element<'_>,
    chosen: &EmitterUse<'_>,
    emitter: &LightEmitter<'_>,
    told: &mut Told,
) {
    let id = attribute(variant, "id").unwrap_or_default();
    let name = text_of(variant.child("Name"));
    told.fact("variant", name.map_or_else(|| id.to_owned(), |name| format!("{id}, {name}")));
    let name = text_of(emitter.element.child("Name"));
    let id = chosen.id;
    told.fact("emitter", name.map_or_else(|| id.to_owned(), |name| format!("{id}, {name}")));
}

/// Tells of the emitters of the variant that were not chosen, and of places in a 3D model.
fn tell_others(
    uses: &[EmitterUse<'_>],
    chosen: &EmitterUse<'_>,
    choice: &GldfChoice,
    told: &mut Told,
) {
    let (mut others, mut sensors, mut exits) = (Vec::new(), Vec::new(), Vec::new());
    for other in uses.iter().filter(|it| it.id != chosen.id) {
        let lights = LightEmitter::all(other.emitter);
        let is_emergency = !lights.is_empty() && lights.iter().all(|light| !light.shines(false));
        if lights.is_empty() {
            sensors.push(in_quotes(other.id));
        } else if is_emergency && !choice.emergency {
            exits.push(other);
        } else if !is_emergency {
            others.push(in_quotes(other.id));
        }
    }
    if let Some(first) = exits.first() {
        let ids: Vec<String> = exits.iter().map(|exit| in_quotes(exit.id)).collect();
        let found = format!("emitters for emergencies only: {}", listed(&ids));
        let expected = "emitters for normal operation (these are not in this light; \"emitter\" \
                        chooses one)";
        told.warn(WarningKind::EmergencyEmitter, first.reference.at, found, expected);
    }
    for (name, list) in [("other lights", others), ("sensors", sensors)] {
        if !list.is_empty() {
            told.fact(name, listed(&list));
        }
    }
    if chosen.places > 1 {
        let found = format!("{} places of the 3D model that shine", chosen.places);
        let expected = "a [[luminaires]] of its own for each (this is the light of one)";
        told.warn(WarningKind::ModelPlaces, chosen.reference.at, found, expected);
    }
}

fn tell_turn(turn: &Turn, emitter: &LightEmitter<'_>, chosen: &EmitterUse<'_>, told: &mut Told) {
    if !turn.is_none() {
        let [x, y, z, g0] = turn.angles_deg;
        told.fact("rotation", format!("X {x}, Y {y}, Z {z}, G0 {g0} degrees"));
        let at = emitter.element.child("Rotation").map_or(emitter.element.at, |it| it.at);
        let found = format!("a rotation of X {x}, Y {y}, Z {z}, G0 {g0} degrees");
        let expected = "a photometry in its position of use (GLDF does not define the angles: \
                        look at a picture)";
        told.warn(WarningKind::EmitterTurned, at, found, expected);
    }
    if !chosen.objects.is_empty() {
        let objects: Vec<String> = chosen.objects.iter().map(|it| in_quotes(it)).collect();
        let text = format!("{} (places and turns in the model are not read)", listed(&objects));
        told.fact("3D model", text);
    }
}
