//! What shines in an emitter: one of several light emitters, of which one is in use at a time.

use super::GldfError;
use super::product::{Product, Reference};
use super::selection::GldfChoice;
use super::texts::{attribute, in_quotes, listed, text_of, translations};
use quasilux_text::xml::Element;
use std::collections::{HashMap, HashSet};

/// Light emitters of an emitter: their sources are looked for among all of the product.
const MAX_LIGHTS: usize = 500;

/// References to equipment.
pub(super) const EQUIPMENT: Reference<'static> = Reference {
    child: "EquipmentReference",
    attributes: &["equipmentId"],
    list: "Equipments",
    names: &["Equipment"],
};
/// References to a light source.
pub(super) const LIGHT_SOURCE: Reference<'static> = Reference {
    child: "LightSourceReference",
    attributes: &[
        "changeableLightSourceId",
        "fixedLightSourceId",
        "multiChannelLightSourceId",
        "lightSourceId",
    ],
    list: "LightSources",
    names: &["ChangeableLightSource", "FixedLightSource", "MultiChannelLightSource", "LightSource"],
};

/// When a light emitter shines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Behaviour {
    /// In normal operation.
    Normal,
    /// In normal operation and in an emergency.
    Combined,
    /// In an emergency.
    EmergencyOnly,
}

/// A light emitter of an emitter.
#[derive(Clone, Copy)]
pub(super) struct LightEmitter<'e> {
    pub(super) element: &'e Element<'e>,
    pub(super) behaviour: Behaviour,
}

/// Whether an element of an emitter gives light: the others are sensors.
pub(super) fn is_light(element: &Element<'_>) -> bool {
    let names = [
        "ChangeableLightEmitter",
        "FixedLightEmitter",
        "MultiChannelLightEmitter",
        // Format 0.9.
        "LightEmitter",
    ];
    names.contains(&element.name)
}

impl<'e> LightEmitter<'e> {
    /// All of an emitter.
    pub(super) fn all(emitter: &'e Element<'e>) -> Vec<Self> {
        let lights = emitter.children.iter().filter(|child| is_light(child));
        let read = |element: &'e Element<'e>| {
            let behaviour = match attribute(element, "emergencyBehaviour") {
                Some("Combined") => Behaviour::Combined,
                Some("EmergencyOnly") => Behaviour::EmergencyOnly,
                _ => Behaviour::Normal,
            };
            Self { element, behaviour }
        };
        lights.map(read).collect()
    }

    /// Whether it shines in normal operation, or in an emergency.
    pub(super) fn shines(&self, emergency: bool) -> bool {
        match self.behaviour {
            Behaviour::Normal => !emergency,
            Behaviour::Combined => true,
            Behaviour::EmergencyOnly => emergency,
        }
    }

    /// The one of an emitter that was asked for, or the only one that shines in the mode of
    /// operation; one for emergencies where the emitter, asked for by name, has no other.
    pub(super) fn choose(
        product: Product<'e>,
        emitter: &'e Element<'e>,
        choice: &GldfChoice,
    ) -> Result<Self, GldfError> {
        let all = Self::all(emitter);
        if all.len() > MAX_LIGHTS {
            let expected = format!("no more than {MAX_LIGHTS} light emitters of an emitter");
            return Err(GldfError::at(emitter, all.len(), expected));
        }
        let shining = all.iter().filter(|light| light.shines(choice.emergency)).copied();
        let mut lights: Vec<Self> = shining.collect();
        if lights.is_empty() && choice.emitter.is_some() && !choice.emergency {
            lights.clone_from(&all);
        }
        if lights.is_empty() {
            let expected = "one with the emergencyBehaviour Combined or EmergencyOnly";
            return Err(GldfError::at(emitter, "an emitter without emergency light", expected));
        }
        let all = names(product, &all)?;
        let shining = |it: &Named<'e>| lights.iter().any(|light| it.is(light));
        let Some(wanted) = &choice.light_source else {
            if let [only] = lights[..] {
                return Ok(only);
            }
            let found = format!("{} light sources that can be exchanged", lights.len());
            let expected = format!("\"light_source\" with one of {}", told(&all, shining));
            return Err(GldfError::at(emitter, found, expected));
        };
        let of_mode = called(all.iter().filter(|it| shining(it)), wanted);
        match of_mode.or_else(|| called(all.iter(), wanted)) {
            Some(found) if choice.emergency && !shining(found) => {
                let found = format!("the light source {}, dark in emergencies", in_quotes(wanted));
                let expected = format!("one of {}", told(&all, shining));
                Err(GldfError::at(emitter, found, expected))
            }
            Some(found) => Ok(found.light),
            None => {
                let found = format!("the light source {}", in_quotes(wanted));
                let expected = format!("one of {}", told(&all, |_| true));
                Err(GldfError::at(emitter, found, expected))
            }
        }
    }
}

/// The only one of that name, else the one of that number.
fn called<'n, 'e>(
    lights: impl Iterator<Item = &'n Named<'e>> + Clone,
    wanted: &str,
) -> Option<&'n Named<'e>> {
    let mut named = lights.clone().filter(|it| it.names.contains(&wanted));
    let only = named.next().filter(|_| named.next().is_none());
    let numbered = || lights.clone().find(|it| it.number.to_string() == wanted);
    only.or_else(numbered)
}

/// A light emitter, and all that it can be called.
struct Named<'e> {
    light: LightEmitter<'e>,
    number: usize,
    /// Identifiers first.
    names: Vec<&'e str>,
}

impl<'e> Named<'e> {
    fn is(&self, light: &LightEmitter<'_>) -> bool {
        self.light.element.at == light.element.at
    }

    /// A name that no other one has, or the number; with its name for people.
    fn told(&self, uses: &HashMap<&str, usize>) -> String {
        let own = self.names.iter().find(|name| uses.get(*name) == Some(&1));
        let key = own.map_or_else(|| self.number.to_string(), |name| (*name).to_owned());
        let name = text_of(self.light.element.child("Name")).filter(|name| *name != key);
        let mode = match self.light.behaviour {
            Behaviour::EmergencyOnly => Some("in an emergency only".to_owned()),
            _ => None,
        };
        let more: Vec<String> = name.map(in_quotes).into_iter().chain(mode).collect();
        let key = in_quotes(&key);
        if more.is_empty() { key } else { format!("{key} ({})", more.join(", ")) }
    }
}

/// Names and numbers of the lights that a test lets through, for a message.
fn told<'e>(all: &[Named<'e>], fits: impl Fn(&Named<'e>) -> bool) -> String {
    let mut uses = HashMap::new();
    let fitting: Vec<&Named<'e>> = all.iter().filter(|it| fits(it)).collect();
    for it in &fitting {
        for name in it.names.iter().copied().collect::<HashSet<&str>>() {
            *uses.entry(name).or_insert(0) += 1;
        }
    }
    listed(&fitting.iter().map(|it| it.told(&uses)).collect::<Vec<_>>())
}

fn names<'e>(
    product: Product<'e>,
    lights: &[LightEmitter<'e>],
) -> Result<Vec<Named<'e>>, GldfError> {
    let mut all = Vec::new();
    for (i, light) in lights.iter().enumerate() {
        let equipment = product.refer(light.element, &EQUIPMENT)?;
        let source = product.refer(equipment.unwrap_or(light.element), &LIGHT_SOURCE)?;
        let ids = [equipment, source].into_iter().flatten().filter_map(|it| attribute(it, "id"));
        let names = [source, Some(light.element)].into_iter().flatten();
        let names = names.filter_map(|it| it.child("Name")).flat_map(translations);
        all.push(Named { light: *light, number: i + 1, names: ids.chain(names).collect() });
    }
    Ok(all)
}
