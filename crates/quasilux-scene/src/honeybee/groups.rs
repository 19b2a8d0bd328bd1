//! Dynamic groups: apertures, doors and shades that change together from state to state.
//!
//! State 0 is how the scene is. What changes has a material of its own in the scene, so that each
//! state is what materials are in it, and which shades there are beside.

use super::shapes::Face3D;
use crate::Bsdf;
use crate::bsdf::Diffuse;
use crate::radiance::{Look, invisible};

/// A group, its states behind the first as changes of the scene.
#[derive(Debug)]
pub(crate) struct Group<'m> {
    pub(crate) name: String,
    members: Vec<Member>,
    shades: Vec<StateShade<'m>>,
    /// Of the member that has most.
    states: usize,
}

/// Part of a group that changes alike: a material of the scene, and its look in each state.
#[derive(Debug)]
struct Member {
    material: String,
    looks: Vec<Look>,
}

/// A shade that is there in one state behind the first.
#[derive(Clone, Debug)]
pub(crate) struct StateShade<'m> {
    pub(crate) state: usize,
    /// Whether its thing has no later state: it is there in those of the others, too.
    pub(crate) is_last: bool,
    pub(crate) name: &'m str,
    pub(crate) geometry: &'m Face3D,
    pub(crate) material: String,
    pub(crate) look: Look,
    /// The path of its key.
    pub(crate) place: String,
}

impl StateShade<'_> {
    fn is_there(&self, state: usize) -> bool {
        self.state == state || (self.is_last && self.state < state)
    }
}

/// A state behind the first.
#[derive(Debug)]
pub(crate) struct GroupState<'g, 'm> {
    pub(crate) number: usize,
    /// Looks of materials in it, by name.
    pub(crate) looks: Vec<(&'g str, &'g Look)>,
    pub(crate) shades: Vec<&'g StateShade<'m>>,
}

impl<'m> Group<'m> {
    pub(super) fn new(name: &str) -> Self {
        Self { name: name.to_owned(), members: Vec::new(), shades: Vec::new(), states: 1 }
    }

    /// Adds something that has this material in the scene. Of looks that are fewer than states the
    /// last one holds.
    pub(super) fn add(&mut self, material: String, looks: Vec<Look>) {
        self.states = self.states.max(looks.len());
        self.members.push(Member { material, looks });
    }

    pub(super) fn add_shade(&mut self, shade: StateShade<'m>) {
        self.states = self.states.max(shade.state + 1);
        self.shades.push(shade);
    }

    /// The states behind the first.
    pub(crate) fn states(&self) -> impl Iterator<Item = GroupState<'_, 'm>> {
        (1..self.states).map(|number| {
            let look = |member: &'_ Member| member.looks.len().min(number + 1) - 1;
            let looks = self.members.iter();
            let looks = looks.map(|it| (it.material.as_str(), &it.looks[look(it)])).collect();
            let shades = self.shades.iter().filter(|shade| shade.is_there(number)).collect();
            GroupState { number, looks, shades }
        })
    }
}

/// The look of something that stays where it is: what is open lets all light through, and nothing
/// shines in some states alone.
pub(super) fn in_place(look: Look) -> Look {
    match look {
        Look::Open => invisible().into(),
        Look::Light(_) => Bsdf::Diffuse(Diffuse { reflectance: crate::Rgb::BLACK }).into(),
        other => other,
    }
}
