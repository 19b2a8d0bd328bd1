//! Which modifier a thing has: its own, or that of its room's set, of the model's set, or of
//! Honeybee's own.

use super::defaults;
use super::model::Model;
use super::radiance::{ModelRadiance, Modifier, ModifierSet, Named, Sides};
use super::slots::Slot;
use crate::LoadError;
use crate::radiance::Findings;
use std::collections::HashMap;

/// Name by which models call Honeybee's own set, which is in no file.
const HONEYBEES_OWN_SET: &str = "Generic_Interior_Visible_Modifier_Set";

/// All modifiers and sets of a model.
pub(super) struct Modifiers<'m> {
    file: &'m str,
    by_name: HashMap<&'m str, &'m Modifier>,
    sets: HashMap<&'m str, &'m ModifierSet>,
    global: Option<&'m ModifierSet>,
}

impl<'m> Modifiers<'m> {
    /// Collects those of a model, and Honeybee's own.
    pub(super) fn new(
        file: &'m str,
        model: &'m Model,
        findings: &mut Findings,
    ) -> Result<Self, LoadError> {
        let mut all = Self { file, by_name: HashMap::new(), sets: HashMap::new(), global: None };
        all.add(defaults::modifiers());
        let Some(ModelRadiance { modifiers, modifier_sets, global_modifier_set, .. }) =
            model.radiance()
        else {
            return Ok(all);
        };
        tell_twins(modifiers, findings);
        if let Some(Named::Whole(set)) = global_modifier_set {
            all.add(&set.modifiers);
            all.global = Some(set);
        }
        all.add(modifiers);
        for set in modifier_sets.iter() {
            all.add(&set.modifiers);
            all.sets.extend(set.identifier.as_deref().map(|name| (name, set)));
        }
        if let Some(Named::Name(name)) = global_modifier_set {
            let known = all.sets.get(name.as_str()).copied();
            if known.is_none() && name != HONEYBEES_OWN_SET {
                return Err(all.no_set("properties.radiance.global_modifier_set", name));
            }
            all.global = known;
        }
        Ok(all)
    }

    fn add(&mut self, modifiers: &'m [Modifier]) {
        let named = |it: &'m Modifier| it.identifier.as_deref().map(|name| (name, it));
        self.by_name.extend(modifiers.iter().filter_map(named));
    }

    /// The set of a room; `place` is the path of the room.
    pub(super) fn set(
        &self,
        set: Option<&'m Named<ModifierSet>>,
        place: &str,
    ) -> Result<Option<&'m ModifierSet>, LoadError> {
        match set {
            None => Ok(None),
            Some(Named::Whole(set)) => Ok(Some(set)),
            Some(Named::Name(name)) => match self.sets.get(name.as_str()) {
                Some(set) => Ok(Some(set)),
                None => {
                    let key = format!("{place}.properties.radiance.modifier_set");
                    Err(self.no_set(&key, name))
                }
            },
        }
    }

    fn no_set(&self, key: &str, name: &str) -> LoadError {
        let message = format!(
            "{key}: no set is called {name:?}; expected one of the model's \
             properties.radiance.modifier_sets"
        );
        LoadError::new(self.file, None, message).offer(name, self.sets.keys().copied())
    }

    /// The modifier that is named or given; `place` is the path of the thing that has it.
    pub(super) fn named(
        &self,
        modifier: &'m Named<Modifier>,
        place: &str,
    ) -> Result<&'m Modifier, LoadError> {
        let name = match modifier {
            Named::Whole(modifier) => return Ok(modifier),
            Named::Name(name) => name,
        };
        self.by_name.get(name.as_str()).copied().ok_or_else(|| {
            let message = format!(
                "{place}: no modifier is called {name:?}; expected one of the model's \
                 properties.radiance.modifiers"
            );
            LoadError::new(self.file, None, message).offer(name, self.by_name.keys().copied())
        })
    }

    /// The modifier of a thing: its own, or the one for its use in the set of its room, or else in
    /// other sets.
    pub(super) fn choose(
        &self,
        own: Option<&'m Named<Modifier>>,
        set: Option<&'m ModifierSet>,
        slot: Slot,
        place: &str,
    ) -> Result<&'m Modifier, LoadError> {
        let sets = [set, self.global];
        let from_sets = || sets.into_iter().flatten().find_map(|set| in_set(set, slot));
        if let Some(modifier) = own.or_else(from_sets) {
            return self.named(modifier, place);
        }
        let name = defaults::of_slot(slot);
        Ok(self.by_name.get(name).copied().expect("Honeybee's own modifiers are there"))
    }
}

/// Tells of modifiers of one name that say different things.
fn tell_twins(modifiers: &[Modifier], findings: &mut Findings) {
    let mut seen: HashMap<&str, &Modifier> = HashMap::new();
    for modifier in modifiers {
        let Some(name) = modifier.identifier.as_deref() else { continue };
        if seen.insert(name, modifier).is_some_and(|before| before != modifier) {
            let note = "the model has different modifiers of this name: the last one counts";
            findings.note(&format!("modifier \"{name}\""), note);
        }
    }
}

fn in_set(set: &ModifierSet, slot: Slot) -> Option<&Named<Modifier>> {
    let apertures = set.aperture_set.as_ref();
    let doors = set.door_set.as_ref();
    match slot {
        Slot::Wall { is_inside } => side(set.wall_set.as_ref(), is_inside),
        Slot::Floor { is_inside } => side(set.floor_set.as_ref(), is_inside),
        Slot::RoofCeiling { is_inside } => side(set.roof_ceiling_set.as_ref(), is_inside),
        Slot::Shade { is_inside } => side(set.shade_set.as_ref(), is_inside),
        Slot::AirBoundary => set.air_boundary_modifier.as_ref(),
        Slot::Context => set.context_modifier.as_ref(),
        Slot::Window => apertures?.window_modifier.as_ref(),
        Slot::Skylight => apertures?.skylight_modifier.as_ref(),
        Slot::Operable => apertures?.operable_modifier.as_ref(),
        Slot::InteriorWindow => apertures?.interior_modifier.as_ref(),
        Slot::OverheadDoor => doors?.overhead_modifier.as_ref(),
        Slot::Door { is_inside: false, is_glass: false } => doors?.exterior_modifier.as_ref(),
        Slot::Door { is_inside: true, is_glass: false } => doors?.interior_modifier.as_ref(),
        Slot::Door { is_inside: false, is_glass: true } => doors?.exterior_glass_modifier.as_ref(),
        Slot::Door { is_inside: true, is_glass: true } => doors?.interior_glass_modifier.as_ref(),
    }
}

fn side(sides: Option<&Sides>, is_inside: bool) -> Option<&Named<Modifier>> {
    let Sides { interior_modifier, exterior_modifier } = sides?;
    if is_inside { interior_modifier.as_ref() } else { exterior_modifier.as_ref() }
}
