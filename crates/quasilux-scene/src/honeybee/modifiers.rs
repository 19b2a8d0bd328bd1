//! Which modifier a thing has: its own, or that of its room's set, of the model's set, or of
//! Honeybee's own.

use super::defaults;
use super::model::Model;
use super::radiance::{ModelRadiance, Modifier, ModifierSet, Named, Sides};
use super::slots::Slot;
use crate::LoadError;
use std::collections::HashMap;

/// All modifiers and sets of a model.
pub(super) struct Modifiers<'m> {
    file: &'m str,
    by_name: HashMap<&'m str, &'m Modifier>,
    sets: HashMap<&'m str, &'m ModifierSet>,
    global: Option<&'m ModifierSet>,
}

impl<'m> Modifiers<'m> {
    /// Collects those of a model, and Honeybee's own.
    pub(super) fn new(file: &'m str, model: &'m Model) -> Self {
        let mut all = Self { file, by_name: HashMap::new(), sets: HashMap::new(), global: None };
        all.add(defaults::modifiers());
        let Some(ModelRadiance { modifiers, modifier_sets, global_modifier_set, .. }) =
            model.radiance()
        else {
            return all;
        };
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
            // Honeybee's own set has none in the file.
            all.global = all.sets.get(name.as_str()).copied();
        }
        all
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
                    let message = format!(
                        "{place}.properties.radiance.modifier_set: no set is called {name:?}; \
                         expected one of the model's properties.radiance.modifier_sets"
                    );
                    let names = self.sets.keys().copied();
                    Err(LoadError::new(self.file, None, message).offer(name, names))
                }
            },
        }
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
