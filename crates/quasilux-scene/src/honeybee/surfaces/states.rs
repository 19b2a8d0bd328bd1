//! States of things: what of a group changes alike, and the shades of each state.

use super::super::groups::{StateShade, in_place};
use super::super::names::plain;
use super::super::radiance::{Modifier, State, SubFaceRadiance};
use super::super::slots::Slot;
use super::{Collector, Group, Shape, Thing};
use crate::LoadError;
use crate::radiance::Look;

/// Most states of a thing: those that a group of blinds has, and the first one.
const MAX_STATES: usize = 17;
/// Most shades of states: each comes once for each state that it is in.
const MAX_STATE_SHADES: usize = 100_000;
/// Most characters of a group's name in those of its materials.
const MAX_NAME: usize = 100;

impl<'m> Collector<'_, 'm> {
    /// Adds the states of a thing to its group; the material of the thing, which is that of the
    /// group.
    pub(super) fn states(
        &mut self,
        thing: Thing<'m>,
        radiance: &'m SubFaceRadiance,
        base: &'m Modifier,
        place: &str,
    ) -> Result<usize, LoadError> {
        let states: &'m [State] = &radiance.states;
        let mut modifiers: Vec<&'m Modifier> = Vec::new();
        if states.len() > MAX_STATES {
            self.findings.note(place, format!("states beyond {MAX_STATES} are left out"));
        }
        let states = &states[..states.len().min(MAX_STATES)];
        for (number, state) in states.iter().enumerate() {
            let place = format!("{place}.properties.radiance.states[{number}]");
            let own = state.modifier.as_ref();
            modifiers.push(own.map_or(Ok(base), |own| self.modifiers.named(own, &place))?);
        }
        let group = match &radiance.dynamic_group_identifier {
            Some(group) if states.len() > 1 => self.group(group),
            other => {
                if other.is_none() {
                    let note = "states without dynamic_group_identifier: the first one counts";
                    self.findings.note(place, note);
                }
                self.shades_of_state(None, &states[0], place)?;
                return self.material(modifiers[0]);
            }
        };
        for (number, state) in states.iter().enumerate() {
            let is_last = number + 1 == states.len();
            let which = WhichState { group, number, is_last };
            self.shades_of_state(Some(which), state, place)?;
        }
        self.member(group, &modifiers, thing.name)
    }

    /// The material of what changes alike, in a group.
    fn member(
        &mut self,
        group: usize,
        modifiers: &[&'m Modifier],
        name: &str,
    ) -> Result<usize, LoadError> {
        let modifiers: Vec<&Modifier> = modifiers.iter().map(|it| self.first_like(it)).collect();
        let key = (group, modifiers.iter().map(|&it| std::ptr::from_ref(it)).collect());
        if let Some(&known) = self.member_of.get(&key) {
            return Ok(known);
        }
        let mut looks = Vec::new();
        for modifier in modifiers {
            looks.push(self.look_in_place(modifier, name)?);
        }
        let name = format!("group {}", self.short_name(group));
        let number = self.new_material(&name, looks[0].clone())?;
        self.found.groups[group].add(self.found.materials[number].0.clone(), looks);
        self.member_of.insert(key, number);
        Ok(number)
    }

    /// Adds the shades of one state: those of the first one are there until another comes.
    fn shades_of_state(
        &mut self,
        which: Option<WhichState>,
        state: &'m State,
        place: &str,
    ) -> Result<(), LoadError> {
        let number = which.map_or(0, |which| which.number);
        for (index, shade) in state.shades.iter().enumerate() {
            let place = format!("{place}.properties.radiance.states[{number}].shades[{index}]");
            let slot = Slot::Shade { is_inside: false };
            let modifier = self.modifiers.choose(shade.modifier.as_ref(), None, slot, &place)?;
            let shape = Shape::Polygon { outline: &shade.geometry, cut_out: Vec::new() };
            let Some(WhichState { group, number, is_last }) = which else {
                let material = self.material(modifier)?;
                self.push(&shade.identifier, material, shape, &place, false);
                continue;
            };
            self.count_state_shade(&place)?;
            let name = shade.identifier.as_str();
            let modifier = self.first_like(modifier);
            let look = self.look_in_place(modifier, name)?;
            let material = self.state_material(group, number, modifier, &look)?;
            match material {
                StateMaterial::InScene(material) => {
                    self.push(name, material, shape, &place, false);
                }
                StateMaterial::Added(material) => {
                    let (state, geometry) = (number, &shade.geometry);
                    let shade =
                        StateShade { state, is_last, name, geometry, material, look, place };
                    self.found.groups[group].add_shade(shade);
                }
            }
        }
        Ok(())
    }

    fn count_state_shade(&mut self, place: &str) -> Result<(), LoadError> {
        self.state_shades += 1;
        if self.state_shades <= MAX_STATE_SHADES {
            return Ok(());
        }
        let message = format!(
            "{place}: more than {MAX_STATE_SHADES} shades of states in the \
                               model; expected fewer"
        );
        Err(LoadError::new(self.file, None, message))
    }

    /// The material of the shades that a state of a group has of one modifier.
    fn state_material(
        &mut self,
        group: usize,
        number: usize,
        modifier: &'m Modifier,
        look: &Look,
    ) -> Result<StateMaterial, LoadError> {
        let key = (group, number, std::ptr::from_ref(modifier));
        if let Some(known) = self.state_materials.get(&key) {
            return Ok(known.clone());
        }
        let material_name = format!("group {} state {number}", self.short_name(group));
        let material = if number == 0 {
            let material = self.new_material(&material_name, look.clone())?;
            let looks = vec![look.clone(), in_place(Look::Open)];
            self.found.groups[group].add(self.found.materials[material].0.clone(), looks);
            StateMaterial::InScene(material)
        } else {
            StateMaterial::Added(self.names.new_name(&plain(&material_name)))
        };
        self.state_materials.insert(key, material.clone());
        Ok(material)
    }

    /// The beginning of a group's name.
    fn short_name(&self, group: usize) -> String {
        self.found.groups[group].name.chars().take(MAX_NAME).collect()
    }

    /// The look of a modifier for something that stays in place.
    fn look_in_place(&mut self, modifier: &'m Modifier, name: &str) -> Result<Look, LoadError> {
        let look = self.look(modifier)?;
        match look {
            Look::Unknown(refusal) => Err(LoadError::new(self.file, None, refusal.message)),
            Look::Light(_) => {
                self.findings.note(name, "light of a state of a group is left out");
                Ok(in_place(look))
            }
            other => Ok(in_place(other)),
        }
    }

    /// The number of the group of this name.
    fn group(&mut self, name: &'m str) -> usize {
        let groups = &mut self.found.groups;
        *self.groups.entry(name).or_insert_with(|| {
            groups.push(Group::new(name));
            groups.len() - 1
        })
    }
}

/// A material of shades of a state.
#[derive(Clone, Debug)]
pub(super) enum StateMaterial {
    /// By its number among those of the scene.
    InScene(usize),
    /// By the name that it has in the geometry of the state.
    Added(String),
}

/// A state of a thing in a group.
#[derive(Clone, Copy)]
struct WhichState {
    group: usize,
    number: usize,
    /// Whether the thing stays in it while others of the group go on.
    is_last: bool,
}
