//! Dynamic groups as groups of blinds: state 0 is open, the others are their states.

use super::Writer;
use super::text::quoted;
use crate::honeybee::{Face3D, Group, GroupState, StateShade, Surfaces};
use std::collections::HashSet;
use std::fmt::Write;

/// Most groups and states that a project has.
const MAX_GROUPS: usize = 64;
const MAX_STATES: usize = 16;

impl Writer<'_> {
    /// Writes the groups, if there is a year for them to move in.
    pub(super) fn states(&mut self, surfaces: &Surfaces<'_>) {
        if self.terms.weather.is_none() {
            // Told when the project is loaded.
            return;
        }
        for (number, group) in surfaces.groups.iter().enumerate() {
            if number < MAX_GROUPS {
                self.group(group, &name_of(group, &surfaces.groups));
            } else {
                let note = format!("groups beyond the first {MAX_GROUPS} stay in state 0");
                self.findings.note(&format!("group \"{}\"", group.name), note);
            }
        }
        if !surfaces.groups.is_empty() {
            let note = "states follow one another as the sun shines on the sensors; `control` and \
                        `schedule` of [[blinds]] say otherwise";
            self.findings.note("dynamic groups", note);
        }
    }

    fn group(&mut self, group: &Group<'_>, name: &str) {
        self.text.section("[[blinds]]");
        self.text.key("name", &quoted(name));
        for state in group.states() {
            if state.number > MAX_STATES {
                let note = format!("states beyond the first {MAX_STATES} are left out");
                self.findings.note(&format!("group \"{}\"", group.name), note);
                break;
            }
            self.state(group, &state);
        }
    }

    fn state(&mut self, group: &Group<'_>, state: &GroupState<'_, '_>) {
        let number = state.number;
        self.text.section("[[blinds.states]]");
        self.text.key("name", &quoted(&format!("state {number}")));
        let mut there = state.shades.clone();
        there.retain(|shade| self.has_area(shade));
        if !there.is_empty() {
            let obj = self.obj(&there);
            let name = format!("{}-{number}", group.name);
            let file = self.file(&name, ".obj", obj.into_bytes());
            self.text.key("geometry", &format!("[{}]", quoted(&file)));
        }
        let shades = there.iter().map(|shade| (shade.material.as_str(), &shade.look));
        let mut written = HashSet::new();
        let all = state.looks.iter().copied().chain(shades);
        for (name, look) in all.filter(|(name, _)| written.insert(*name)) {
            self.text.section(&format!("[blinds.states.materials.{}]", quoted(name)));
            self.material(look);
        }
    }

    /// Whether a shade is something that geometry has.
    fn has_area(&mut self, shade: &StateShade<'_>) -> bool {
        let has_area = shade.geometry.area() > 0.0;
        if !has_area {
            self.findings.note(&shade.place, "a polygon without area is left out");
        }
        has_area
    }

    /// Shades as an OBJ file, in the unit of the model.
    fn obj(&mut self, shades: &[&StateShade<'_>]) -> String {
        let mut obj = String::new();
        let mut vertices = 0;
        for shade in shades {
            let StateShade { name, geometry: Face3D { boundary, holes }, material, .. } = shade;
            if !holes.is_empty() {
                self.findings.note(&shade.place, "holes in the shade of a state are left out");
            }
            let name = name.replace(char::is_control, " ");
            let material = material.replace(char::is_control, " ");
            writeln!(obj, "o {name}\nusemtl {material}").expect("strings grow");
            for point in boundary {
                let [x, y, z] = point.0.to_array();
                writeln!(obj, "v {x:?} {y:?} {z:?}").expect("strings grow");
            }
            let corners: Vec<String> =
                (1..=boundary.len()).map(|corner| (vertices + corner).to_string()).collect();
            writeln!(obj, "f {}", corners.join(" ")).expect("strings grow");
            vertices += boundary.len();
        }
        obj
    }
}

/// The name of a group, and one that no other has for a group of an empty name.
fn name_of(group: &Group<'_>, all: &[Group<'_>]) -> String {
    if !group.name.is_empty() {
        return group.name.clone();
    }
    let is_free = |name: &String| all.iter().all(|other| other.name != *name);
    let numbered = (2..).map(|number| format!("group {number}"));
    let mut names = std::iter::once("group".to_owned()).chain(numbered);
    names.find(is_free).expect("numbers do not end")
}
