//! Which variant of a product, and which emitter of the variant.

use super::GldfError;
use super::light_emitter::{LightEmitter, is_light};
use super::product::Product;
use super::selection::GldfChoice;
use super::texts::{attribute, in_quotes, is_called, listed, text_of};
use super::told::Told;
use crate::WarningKind;
use quasilux_text::xml::Element;

/// Emitters of a variant: each is looked for among all of the product.
const MAX_EMITTERS: usize = 500;
/// Objects of a 3D model that shine with one emitter.
const MAX_OBJECTS: usize = 500;

/// An emitter as a variant uses it.
#[derive(Clone)]
pub(super) struct EmitterUse<'e> {
    pub(super) emitter: &'e Element<'e>,
    pub(super) id: &'e str,
    /// The simple geometry that it has in the variant.
    pub(super) simple: Option<&'e Element<'e>>,
    /// Name in the 3D model of the first place that it shines from.
    pub(super) objects: Vec<&'e str>,
    /// The element by which the variant refers to it.
    pub(super) reference: &'e Element<'e>,
    /// How many places of a 3D model shine with it.
    pub(super) places: usize,
}

/// The variant that was asked for, or the only one.
pub(super) fn choose_variant<'e>(
    product: Product<'e>,
    choice: &GldfChoice,
) -> Result<&'e Element<'e>, GldfError> {
    let definitions = product.root.child("ProductDefinitions");
    let variants: Vec<&Element<'_>> = definitions
        .and_then(|definitions| definitions.child("Variants"))
        .map_or_else(Vec::new, |variants| variants.all("Variant").collect());
    let choices = || {
        let name = |variant: &&Element<'_>| {
            let id = in_quotes(attribute(variant, "id").unwrap_or_default());
            match text_of(variant.child("Name")) {
                Some(name) => format!("{id} ({})", in_quotes(name)),
                None => id,
            }
        };
        listed(&variants.iter().map(name).collect::<Vec<_>>())
    };
    let Some(first) = variants.first() else {
        return Err(GldfError::at(
            definitions.unwrap_or(product.root),
            "a product without variants",
            "a Variant in ProductDefinitions",
        ));
    };
    let Some(wanted) = &choice.variant else {
        if variants.len() == 1 {
            return Ok(first);
        }
        let expected = format!("\"variant\" with one of {}", choices());
        return Err(GldfError::at(first, format!("{} variants", variants.len()), expected));
    };
    let by_id = variants.iter().find(|variant| attribute(variant, "id") == Some(wanted));
    let mut by_name = variants.iter().filter(|variant| is_called(variant.child("Name"), wanted));
    match (by_id, by_name.next(), by_name.next()) {
        (Some(variant), ..) | (None, Some(variant), None) => Ok(variant),
        _ => {
            let expected = format!("one of {}", choices());
            Err(GldfError::at(first, format!("the variant {}", in_quotes(wanted)), expected))
        }
    }
}

/// The emitters of a variant, each once, in the order of the file.
pub(super) fn emitters<'e>(
    product: Product<'e>,
    variant: &'e Element<'e>,
    told: &mut Told,
) -> Result<Vec<EmitterUse<'e>>, GldfError> {
    let mut uses: Vec<EmitterUse<'e>> = Vec::new();
    let geometry = variant.child("Geometry");
    let both = geometry.and_then(|geometry| geometry.child("GeometryReferences"));
    // Format 0.9 has references in the variant itself.
    for parent in [Some(variant), geometry, both].into_iter().flatten() {
        for reference in parent.all("EmitterReference") {
            add(product, reference, &mut uses, told)?;
        }
        for reference in parent.all("SimpleGeometryReference") {
            let at = add(product, reference, &mut uses, told)?;
            if let (Some(at), Some(id)) = (at, attribute(reference, "geometryId"))
                && uses[at].simple.is_none()
            {
                let found = product.find("Geometries", &["SimpleGeometry"], id, reference)?;
                uses[at].simple = Some(found);
            }
        }
        for model in parent.all("ModelGeometryReference") {
            // Models of several types show the one luminaire in each of them.
            let first_type = model.child("EmitterReference").and_then(model_type);
            for reference in model.all("EmitterReference") {
                let Some(at) = add(product, reference, &mut uses, told)? else { continue };
                if model_type(reference) == first_type {
                    uses[at].places += 1;
                }
                let object = reference.child("EmitterObjectExternalName").map(Element::text);
                let known = &mut uses[at].objects;
                known.extend(object.filter(|it| !it.is_empty() && !known.contains(it)));
                if known.len() > MAX_OBJECTS {
                    let expected = format!("no more than {MAX_OBJECTS} objects of an emitter");
                    return Err(GldfError::at(reference, "more", expected));
                }
            }
        }
    }
    if uses.is_empty() {
        uses = all_emitters(product, variant, told)?;
    }
    Ok(uses)
}

fn model_type<'e>(reference: &'e Element<'_>) -> Option<&'e str> {
    attribute(reference, "targetModelType")
}

/// Adds the emitter that is referred to, unless it is there: its place in the list.
fn add<'e>(
    product: Product<'e>,
    reference: &'e Element<'e>,
    uses: &mut Vec<EmitterUse<'e>>,
    told: &mut Told,
) -> Result<Option<usize>, GldfError> {
    let Some(id) = attribute(reference, "emitterId") else {
        let expected = "an emitterId (the reference is left out)";
        let found = format!("{} without an emitter", reference.name);
        told.warn(WarningKind::MissingElement, reference.at, found, expected);
        return Ok(None);
    };
    if let Some(known) = uses.iter().position(|known| known.id == id) {
        return Ok(Some(known));
    }
    if uses.len() == MAX_EMITTERS {
        let expected = format!("no more than {MAX_EMITTERS} emitters of a variant");
        return Err(GldfError::at(reference, "more", expected));
    }
    let emitter = product.find("Emitters", &["Emitter"], id, reference)?;
    uses.push(EmitterUse { emitter, id, simple: None, objects: Vec::new(), reference, places: 0 });
    Ok(Some(uses.len() - 1))
}

/// All emitters of the product, for a variant that names none.
fn all_emitters<'e>(
    product: Product<'e>,
    variant: &'e Element<'e>,
    told: &mut Told,
) -> Result<Vec<EmitterUse<'e>>, GldfError> {
    let definitions = product.root.child("GeneralDefinitions");
    let list = definitions.and_then(|definitions| definitions.child("Emitters"));
    let emitters = list.iter().flat_map(|list| list.all("Emitter"));
    let of_variant = |emitter: &'e Element<'e>| {
        let id = attribute(emitter, "id").unwrap_or_default();
        EmitterUse { emitter, id, simple: None, objects: Vec::new(), reference: variant, places: 0 }
    };
    let uses: Vec<EmitterUse<'e>> = emitters.map(of_variant).take(MAX_EMITTERS + 1).collect();
    if uses.len() > MAX_EMITTERS {
        let expected = format!("no more than {MAX_EMITTERS} emitters of a product");
        return Err(GldfError::at(variant, "more", expected));
    }
    let found = "a variant without emitters";
    if uses.is_empty() {
        let expected = "an EmitterReference in its Geometry: nothing of it shines (ask the maker \
                        for a container with photometry)";
        return Err(GldfError::at(variant, found, expected));
    }
    let expected = "an EmitterReference in its Geometry (an emitter of the product is taken)";
    told.warn(WarningKind::VariantWithoutEmitter, variant.at, found, expected);
    Ok(uses)
}

/// The emitter that was asked for, or the only one that shines in the mode of operation.
pub(super) fn choose_emitter<'e>(
    uses: &[EmitterUse<'e>],
    choice: &GldfChoice,
) -> Result<EmitterUse<'e>, GldfError> {
    let at = uses[0].reference;
    if let Some(wanted) = &choice.emitter {
        let it = called(uses, wanted);
        if let Some(found) = it.filter(|it| it.emitter.children.iter().any(is_light)) {
            return Ok(found.clone());
        }
        let what = if it.is_some() { ", a sensor" } else { "" };
        let found = format!("the emitter {}{what}", in_quotes(wanted));
        return Err(GldfError::at(at, found, format!("one of {}", names(uses, |_| true))));
    }
    let shines = |it: &EmitterUse<'_>| {
        LightEmitter::all(it.emitter).iter().any(|light| light.shines(choice.emergency))
    };
    let mut shining = uses.iter().filter(|it| shines(it));
    match (shining.next(), shining.next()) {
        (Some(only), None) => Ok(only.clone()),
        (Some(_), Some(_)) => {
            let found =
                format!("{} emitters that shine", uses.iter().filter(|it| shines(it)).count());
            let expected = format!(
                "\"emitter\" with one of {} (each is a luminaire of its own)",
                names(uses, shines)
            );
            Err(GldfError::at(at, found, expected))
        }
        (None, _) if choice.emergency => {
            let expected = "an emitter with the emergencyBehaviour Combined or EmergencyOnly";
            Err(GldfError::at(at, "no emitter with light in an emergency", expected))
        }
        (None, _) if uses.iter().any(|it| it.emitter.children.iter().any(is_light)) => {
            let expected = "\"emergency = true\" for its light in an emergency";
            Err(GldfError::at(at, "a variant that shines in an emergency only", expected))
        }
        (None, _) => {
            let expected = "an emitter with light (it has sensors alone, or nothing)";
            Err(GldfError::at(at, "a variant without light", expected))
        }
    }
}

/// The emitter of that identifier, else the only one at that object, else the only one of that
/// name.
fn called<'n, 'e>(uses: &'n [EmitterUse<'e>], wanted: &str) -> Option<&'n EmitterUse<'e>> {
    let is_at = |it: &&EmitterUse<'e>| it.objects.contains(&wanted);
    let is_named = |it: &&EmitterUse<'e>| {
        it.emitter.children.iter().any(|child| is_called(child.child("Name"), wanted))
    };
    let (mut at, mut named) = (uses.iter().filter(is_at), uses.iter().filter(is_named));
    uses.iter().find(|it| it.id == wanted).or_else(|| match (at.next(), at.next()) {
        (Some(only), None) => Some(only),
        (Some(_), Some(_)) => None,
        (None, _) => named.next().filter(|_| named.next().is_none()),
    })
}

/// The emitters with light that a test lets through, for a message.
fn names<'e>(uses: &[EmitterUse<'e>], fits: impl Fn(&EmitterUse<'e>) -> bool) -> String {
    let with_light = uses.iter().filter(|it| it.emitter.children.iter().any(is_light) && fits(it));
    let name = |it: &EmitterUse<'_>| {
        let only = LightEmitter::all(it.emitter).iter().all(|light| !light.shines(false));
        let mode = if only { "in an emergency only" } else { "" };
        let objects: Vec<String> = it.objects.iter().map(|object| in_quotes(object)).collect();
        let object =
            (!objects.is_empty()).then(|| format!("at {} of the 3D model", listed(&objects)));
        let more: Vec<String> =
            object.into_iter().chain((!mode.is_empty()).then(|| mode.to_owned())).collect();
        let id = in_quotes(it.id);
        if more.is_empty() { id } else { format!("{id} ({})", more.join(", ")) }
    };
    listed(&with_light.map(name).collect::<Vec<_>>())
}
