//! By which ways light comes, as Honeybee tells them apart: through the windows of each group of
//! blinds, and by all other ways.
//!
//! Light adds up, but for what the window of one group reflects into that of another: what comes
//! by a group in a state is what there is with the windows of all other groups black, less what
//! there is with those of all groups black. Groups without windows are no light paths, and stay
//! open, as dynamic shades do there.

use quasilux_scene::bsdf::Diffuse;
use quasilux_scene::{Blinds, BlindsGroup, Bsdf, Loaded, Rgb, Scene, is_file_name};
use std::collections::HashSet;

/// The light path of all that is in no group, and the name of its one state.
pub(super) const STATIC: &str = "__static_apertures__";
pub(super) const STATIC_STATE: &str = "default";

/// A group of blinds.
#[derive(Debug)]
pub(super) struct LightPath {
    pub(super) name: String,
    /// The number of the group.
    group: usize,
    /// The names of the folders of its states, open first.
    pub(super) states: Vec<String>,
}

/// Light paths of a project, and the names of the groups of blinds that are none.
#[derive(Debug, Default)]
pub(super) struct LightPaths {
    pub(super) paths: Vec<LightPath>,
    pub(super) others: Vec<String>,
}

/// Sorts the groups of blinds of a project.
///
/// # Errors
/// In words, where a light path cannot be a folder.
pub(super) fn light_paths(loaded: &Loaded) -> Result<LightPaths, String> {
    let mut found = LightPaths::default();
    let Some(blinds) = &loaded.blinds else { return Ok(found) };
    let mut taken = HashSet::from([STATIC.to_owned()]);
    for (number, group) in blinds.groups.iter().enumerate() {
        let name = &group.name;
        if windows_of(group, &loaded.scene).is_empty() {
            found.others.push(name.clone());
            continue;
        }
        if !is_file_name(name) || !taken.insert(name.to_lowercase()) {
            return Err(format!(
                "the group of blinds \"{name}\" is a folder of Honeybee's results; expected a \
                 name that can be a file name, unique whatever its case"
            ));
        }
        let state = |position: usize| format!("{position}_{name}");
        let states = (0..=group.positions.len()).map(state).collect();
        found.paths.push(LightPath { name: name.clone(), group: number, states });
    }
    Ok(found)
}

/// The open room with the windows of all groups black.
pub(super) fn without_groups(loaded: &Loaded) -> Scene {
    let mut room = loaded.scene.clone();
    for group in loaded.blinds.iter().flat_map(|blinds| &blinds.groups) {
        blacken(&mut room, group, &loaded.scene);
    }
    room
}

impl LightPath {
    /// The room with the group in a state, the others open and their windows black. `blinds` are
    /// those that the light path is of.
    pub(super) fn room(&self, open: &Scene, blinds: &Blinds, state: usize) -> Scene {
        let mut positions = vec![0; blinds.groups.len()];
        positions[self.group] = state;
        let mut room = blinds.room(open, &positions);
        for (other, group) in blinds.groups.iter().enumerate() {
            if other != self.group {
                blacken(&mut room, group, open);
            }
        }
        room
    }
}

fn blacken(room: &mut Scene, group: &BlindsGroup, open: &Scene) {
    for number in windows_of(group, open) {
        room.materials[number].bsdf = Bsdf::Diffuse(Diffuse { reflectance: Rgb::BLACK });
    }
}

/// The numbers of the materials that a group changes, or that a model has for it alone, and that
/// are windows while it is open.
fn windows_of(group: &BlindsGroup, open: &Scene) -> HashSet<usize> {
    let own = format!("group {}", group.name);
    let is_own = |name: &str| {
        let rest = name.strip_prefix(&own).map(|rest| rest.strip_prefix(' ').unwrap_or(rest));
        rest.is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit()))
    };
    let named = open.materials.iter().enumerate();
    let named = named.filter(|(_, material)| is_own(&material.name)).map(|(number, _)| number);
    let changed = group.positions.iter().flat_map(|position| {
        let pairs = open.materials.iter().zip(&position.room.materials).enumerate();
        pairs.filter(|(_, (own, other))| own != other).map(|(number, _)| number)
    });
    changed.chain(named).filter(|&number| is_window(&open.materials[number].bsdf)).collect()
}

/// Sheets that let light straight through, or as a table says; others that let it through are more
/// often leaves and shades.
fn is_window(bsdf: &Bsdf) -> bool {
    match bsdf {
        Bsdf::Pane(_) | Bsdf::Dielectric(_) => true,
        Bsdf::Measured(measured) => measured.transmits(),
        Bsdf::Diffuse(_)
        | Bsdf::Mirror(_)
        | Bsdf::Translucent(_)
        | Bsdf::Conductor(_)
        | Bsdf::Plastic(_) => false,
    }
}
