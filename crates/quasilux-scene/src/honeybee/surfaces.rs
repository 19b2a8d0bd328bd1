//! Which surfaces a model has, and what they are made of.

mod states;

use super::groups::Group;
use super::look::look;
use super::model::{Aperture, Boundary, Door, Face, FaceType, Model, Room, Shade};
use super::modifiers::Modifiers;
use super::names::Names;
use super::radiance::{Modifier, ModifierSet, SubFaceRadiance};
use super::shapes::{Face3D, Mesh3D};
use super::slots::Slot;
use crate::LoadError;
use crate::radiance::{Findings, Look};
use states::StateMaterial;
use std::collections::HashMap;

/// All surfaces, with materials and groups.
#[derive(Debug)]
pub(crate) struct Surfaces<'m> {
    pub(crate) surfaces: Vec<Surface<'m>>,
    /// The materials by name.
    pub(crate) materials: Vec<(String, Look)>,
    pub(crate) groups: Vec<Group<'m>>,
}

/// Something that light meets.
#[derive(Debug)]
pub(crate) struct Surface<'m> {
    pub(crate) name: &'m str,
    /// The path of its key.
    pub(crate) place: String,
    /// The number of its material.
    pub(crate) material: usize,
    pub(crate) shape: Shape<'m>,
}

#[derive(Debug)]
pub(crate) enum Shape<'m> {
    /// A polygon without others that lie in its plane.
    Polygon {
        outline: &'m Face3D,
        cut_out: Vec<&'m Face3D>,
    },
    Mesh(&'m Mesh3D),
}

/// Collects the surfaces of a model; `file` is what messages call it.
pub(crate) fn surfaces<'m>(
    file: &'m str,
    model: &'m Model,
    findings: &mut Findings,
) -> Result<Surfaces<'m>, LoadError> {
    let mut collector = Collector {
        file,
        modifiers: Modifiers::new(file, model, findings)?,
        findings,
        number_of: HashMap::new(),
        member_of: HashMap::new(),
        groups: HashMap::new(),
        looks: HashMap::new(),
        firsts: HashMap::new(),
        state_materials: HashMap::new(),
        state_shades: 0,
        names: Names::default(),
        sheet_names: Names::default(),
        written: HashMap::new(),
        found: Surfaces { surfaces: Vec::new(), materials: Vec::new(), groups: Vec::new() },
    };
    collector.model(model)?;
    Ok(collector.found)
}

/// Most modifiers: each takes up to some kB.
const MAX_MATERIALS: usize = 100_000;
/// Name of a modifier without identifier.
const UNNAMED: &str = "unnamed modifier";

/// The side of a pair that was met first.
struct FirstSide<'m> {
    identifier: &'m str,
    modifier: &'m Modifier,
    radiance: Option<&'m SubFaceRadiance>,
}

struct Collector<'a, 'm> {
    file: &'m str,
    modifiers: Modifiers<'m>,
    findings: &'a mut Findings,
    /// Materials by their modifier.
    number_of: HashMap<*const Modifier, usize>,
    /// Materials by what changes alike: the group, and the modifiers of all states.
    member_of: HashMap<(usize, Vec<*const Modifier>), usize>,
    /// By group, state and modifier.
    state_materials: HashMap<(usize, usize, *const Modifier), StateMaterial>,
    state_shades: usize,
    /// Groups by name.
    groups: HashMap<&'m str, usize>,
    looks: HashMap<*const Modifier, Look>,
    /// The first modifier in use of each name.
    firsts: HashMap<&'m str, &'m Modifier>,
    /// Of all materials.
    names: Names,
    sheet_names: Names,
    /// By the identifier of the other side.
    written: HashMap<&'m str, FirstSide<'m>>,
    found: Surfaces<'m>,
}

/// A thing that has states.
#[derive(Clone, Copy)]
struct Thing<'m> {
    name: &'m str,
    radiance: Option<&'m SubFaceRadiance>,
    set: Option<&'m ModifierSet>,
    slot: Slot,
}

/// An aperture or a door.
struct SubFace<'m> {
    thing: Thing<'m>,
    geometry: &'m Face3D,
    boundary: &'m Boundary,
    indoor_shades: &'m [Shade],
    outdoor_shades: &'m [Shade],
}

impl<'m> SubFace<'m> {
    fn of_aperture(it: &'m Aperture, set: Option<&'m ModifierSet>, face_type: FaceType) -> Self {
        let slot = match (it.boundary_condition.is_inside(), it.is_operable, face_type) {
            (true, ..) => Slot::InteriorWindow,
            (false, Some(true), _) => Slot::Operable,
            (false, _, FaceType::Wall) => Slot::Window,
            _ => Slot::Skylight,
        };
        let Aperture { geometry, indoor_shades, outdoor_shades, properties, .. } = it;
        let thing = Thing { name: &it.identifier, radiance: properties.get(), set, slot };
        let boundary = &it.boundary_condition;
        Self { thing, geometry, boundary, indoor_shades, outdoor_shades }
    }

    fn of_door(it: &'m Door, set: Option<&'m ModifierSet>, face_type: FaceType) -> Self {
        let (is_inside, is_glass) =
            (it.boundary_condition.is_inside(), it.is_glass.unwrap_or(false));
        let is_overhead = !is_inside && !is_glass && face_type != FaceType::Wall;
        let slot =
            if is_overhead { Slot::OverheadDoor } else { Slot::Door { is_inside, is_glass } };
        let Door { geometry, indoor_shades, outdoor_shades, properties, .. } = it;
        let thing = Thing { name: &it.identifier, radiance: properties.get(), set, slot };
        let boundary = &it.boundary_condition;
        Self { thing, geometry, boundary, indoor_shades, outdoor_shades }
    }
}

impl<'m> Collector<'_, 'm> {
    fn model(&mut self, model: &'m Model) -> Result<(), LoadError> {
        for (number, room) in model.rooms.iter().enumerate() {
            self.room(room, &format!("rooms[{number}]"))?;
        }
        for (number, face) in model.orphaned_faces.iter().enumerate() {
            self.face(face, None, &format!("orphaned_faces[{number}]"))?;
        }
        for (number, it) in model.orphaned_apertures.iter().enumerate() {
            let sub_face = SubFace::of_aperture(it, None, FaceType::Wall);
            self.sub_face(&sub_face, &format!("orphaned_apertures[{number}]"))?;
        }
        for (number, it) in model.orphaned_doors.iter().enumerate() {
            let sub_face = SubFace::of_door(it, None, FaceType::Wall);
            self.sub_face(&sub_face, &format!("orphaned_doors[{number}]"))?;
        }
        self.shades(&model.orphaned_shades, None, Slot::Context, "orphaned_shades")?;
        for (number, mesh) in model.shade_meshes.iter().enumerate() {
            let place = format!("shade_meshes[{number}]");
            let is_attached = mesh.is_detached == Some(false);
            let slot = if is_attached { Slot::Shade { is_inside: false } } else { Slot::Context };
            let radiance = mesh.properties.get();
            let thing = Thing { name: &mesh.identifier, radiance, set: None, slot };
            self.add(thing, Shape::Mesh(&mesh.geometry), &place)?;
        }
        Ok(())
    }

    fn room(&mut self, room: &'m Room, place: &str) -> Result<(), LoadError> {
        let set = room.properties.get().and_then(|radiance| radiance.modifier_set.as_ref());
        let set = self.modifiers.set(set, place)?;
        for (number, face) in room.faces.iter().enumerate() {
            self.face(face, set, &format!("{place}.faces[{number}]"))?;
        }
        self.both_shades([&room.indoor_shades, &room.outdoor_shades], set, place)
    }

    fn face(
        &mut self,
        face: &'m Face,
        set: Option<&'m ModifierSet>,
        place: &str,
    ) -> Result<(), LoadError> {
        let is_inside = face.boundary_condition.is_inside();
        let slot = match face.face_type {
            FaceType::Wall => Slot::Wall { is_inside },
            FaceType::Floor => Slot::Floor { is_inside },
            FaceType::RoofCeiling => Slot::RoofCeiling { is_inside },
            FaceType::AirBoundary => Slot::AirBoundary,
        };
        let own = face.properties.get().and_then(|radiance| radiance.modifier.as_ref());
        let modifier = self.modifiers.choose(own, set, slot, place)?;
        let apertures = face.apertures.iter();
        let apertures = apertures.map(|it| SubFace::of_aperture(it, set, face.face_type));
        let doors = face.doors.iter().map(|it| SubFace::of_door(it, set, face.face_type));
        let (apertures, doors): (Vec<_>, Vec<_>) = (apertures.collect(), doors.collect());
        let side = FirstSide { identifier: &face.identifier, modifier, radiance: None };
        if self.is_first_side(side, &face.boundary_condition, place) {
            let material = self.material(modifier)?;
            let sub_faces = apertures.iter().chain(&doors);
            let cut_out = sub_faces.map(|sub_face| sub_face.geometry).collect();
            let shape = Shape::Polygon { outline: &face.geometry, cut_out };
            self.push(&face.identifier, material, shape, place, slot == Slot::AirBoundary);
        }
        for (key, sub_faces) in [("apertures", apertures), ("doors", doors)] {
            for (number, sub_face) in sub_faces.iter().enumerate() {
                self.sub_face(sub_face, &format!("{place}.{key}[{number}]"))?;
            }
        }
        self.both_shades([&face.indoor_shades, &face.outdoor_shades], set, place)
    }

    fn sub_face(&mut self, sub_face: &SubFace<'m>, place: &str) -> Result<(), LoadError> {
        let SubFace { thing, geometry, boundary, indoor_shades, outdoor_shades } = *sub_face;
        let own = thing.radiance.and_then(|radiance| radiance.modifier.as_ref());
        let modifier = self.modifiers.choose(own, thing.set, thing.slot, place)?;
        let side = FirstSide { identifier: thing.name, modifier, radiance: thing.radiance };
        if self.is_first_side(side, boundary, place) {
            let shape = Shape::Polygon { outline: geometry, cut_out: Vec::new() };
            self.add(thing, shape, place)?;
        }
        self.both_shades([indoor_shades, outdoor_shades], thing.set, place)
    }

    /// Whether the other side of this thing was not met before; the first side stands for both.
    fn is_first_side(&mut self, side: FirstSide<'m>, boundary: &'m Boundary, place: &str) -> bool {
        let Some(other) = boundary.neighbour() else { return true };
        match self.written.remove(side.identifier) {
            Some(first) if first.identifier == other => {
                if first.modifier != side.modifier {
                    let note = "the two rooms that it is between have other modifiers for it: \
                                that of the first one counts on both sides";
                    self.findings.note(place, note);
                }
                let has_states = side.radiance.is_some_and(|it| !it.states.is_empty());
                if has_states && first.radiance != side.radiance {
                    let note = "its states are left out: those of its other side, which comes \
                                first, count on both sides";
                    self.findings.note(place, note);
                }
                false
            }
            _ => {
                self.written.insert(other, side);
                true
            }
        }
    }

    fn both_shades(
        &mut self,
        [indoor, outdoor]: [&'m [Shade]; 2],
        set: Option<&'m ModifierSet>,
        place: &str,
    ) -> Result<(), LoadError> {
        let key = |key: &str| format!("{place}.{key}");
        self.shades(indoor, set, Slot::Shade { is_inside: true }, &key("indoor_shades"))?;
        self.shades(outdoor, set, Slot::Shade { is_inside: false }, &key("outdoor_shades"))
    }

    fn shades(
        &mut self,
        shades: &'m [Shade],
        set: Option<&'m ModifierSet>,
        slot: Slot,
        place: &str,
    ) -> Result<(), LoadError> {
        for (number, shade) in shades.iter().enumerate() {
            let radiance = shade.properties.get();
            let thing = Thing { name: &shade.identifier, radiance, set, slot };
            let shape = Shape::Polygon { outline: &shade.geometry, cut_out: Vec::new() };
            self.add(thing, shape, &format!("{place}[{number}]"))?;
        }
        Ok(())
    }

    /// Adds something that may have states.
    fn add(&mut self, thing: Thing<'m>, shape: Shape<'m>, place: &str) -> Result<(), LoadError> {
        let own = thing.radiance.and_then(|radiance| radiance.modifier.as_ref());
        let modifier = self.modifiers.choose(own, thing.set, thing.slot, place)?;
        let material = match thing.radiance {
            Some(radiance) if !radiance.states.is_empty() => {
                self.states(thing, radiance, modifier, place)?
            }
            _ => self.material(modifier)?,
        };
        self.push(thing.name, material, shape, place, false);
        Ok(())
    }

    /// The first modifier in use that says the same by the same name, if it is this one's.
    fn first_like(&mut self, modifier: &'m Modifier) -> &'m Modifier {
        let name = modifier.identifier.as_deref().unwrap_or(UNNAMED);
        let first = *self.firsts.entry(name).or_insert(modifier);
        if std::ptr::eq(first, modifier) || first == modifier { first } else { modifier }
    }

    /// Look of a modifier.
    fn look(&mut self, modifier: &'m Modifier) -> Result<Look, LoadError> {
        let key = std::ptr::from_ref(modifier);
        if let Some(known) = self.looks.get(&key) {
            return Ok(known.clone());
        }
        let mut look = look(self.file, modifier, self.findings)?;
        if let Look::Sheet { name, .. } = &mut look {
            *name = self.sheet_names.new_name(name).into();
        }
        self.looks.insert(key, look.clone());
        Ok(look)
    }

    /// The material of a modifier.
    fn material(&mut self, modifier: &'m Modifier) -> Result<usize, LoadError> {
        let modifier = self.first_like(modifier);
        let key = std::ptr::from_ref(modifier);
        if let Some(&known) = self.number_of.get(&key) {
            return Ok(known);
        }
        let look = self.look(modifier)?;
        let name = modifier.identifier.as_deref().unwrap_or(UNNAMED);
        let number = self.new_material(name, look)?;
        self.number_of.insert(key, number);
        Ok(number)
    }

    fn new_material(&mut self, name: &str, look: Look) -> Result<usize, LoadError> {
        let number = self.found.materials.len();
        if number >= MAX_MATERIALS {
            let message = format!("more than {MAX_MATERIALS} modifiers in use; expected fewer");
            return Err(LoadError::new(self.file, None, message));
        }
        self.found.materials.push((self.names.new_name(name), look));
        Ok(number)
    }

    /// Adds a surface, unless it is open; what is open by itself needs no word.
    fn push(
        &mut self,
        name: &'m str,
        material: usize,
        shape: Shape<'m>,
        place: &str,
        is_usually_open: bool,
    ) {
        let (modifier, look) = &self.found.materials[material];
        if matches!(look, Look::Open) {
            if !is_usually_open {
                let note = format!("surfaces of \"{modifier}\" are left out: light passes");
                self.findings.note(place, note);
            }
            return;
        }
        self.found.surfaces.push(Surface { name, place: place.to_owned(), material, shape });
    }
}
