//! A scene as a whole: surfaces with their materials, luminaires, and light from outside.

use super::collector::{Collector, RawSurface};
use super::data::Data;
use super::definitions::{Definition, Definitions, FilePlace, Link};
use super::document::shown;
use super::findings::Findings;
use super::includes::Includes;
use super::lamps::{Lamp, Source, Tables, distribution_of, groups};
use super::look::{Look, Unusable};
use super::materials::{Reading, is_material, is_pattern, key, look, shines};
use super::outside::{Far, Outside};
use super::pattern::{Arguments, Distribution, Grouping};
use super::shapes::Shape;
use crate::{FileKind, Files, LoadError};
use quasilux_text::Position;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;
use std::sync::Arc;

/// Everything that a scene says.
#[derive(Debug, Default)]
pub(crate) struct Scene {
    pub(crate) surfaces: Vec<Surface>,
    /// The materials by name.
    pub(crate) materials: Vec<(String, Look)>,
    pub(crate) lamps: Vec<Lamp>,
    pub(crate) outside: Outside,
}

/// A surface that light meets.
#[derive(Debug)]
pub(crate) struct Surface {
    pub(crate) name: Arc<str>,
    /// The number of its material.
    pub(crate) material: usize,
    pub(crate) shape: Shape,
    pub(crate) file: Arc<str>,
    pub(crate) at: Position,
}

/// Most luminaires.
const MAX_LAMPS: usize = 20_000;
/// Longest chain of modifiers.
const MAX_CHAIN: usize = 64;

/// Modifiers of a surface.
#[derive(Clone, Debug, Default)]
struct Chain {
    /// Numbers of definitions.
    material: Option<usize>,
    patterns: Vec<usize>,
    is_textured: bool,
}

impl Scene {
    /// Reads the files of a scene, in their order. `described` are materials that the project
    /// describes, and that the scene need not define.
    pub(crate) fn read(
        files: &dyn Files,
        names: &[&str],
        described: &HashSet<&str>,
        findings: &mut Findings,
    ) -> Result<Self, LoadError> {
        let mut collector = Collector::new(Includes::new(files, names));
        for name in names {
            collector.file(name, findings)?;
        }
        let surfaces = std::mem::take(&mut collector.surfaces);
        let mut sorter = Sorter {
            collector,
            findings,
            described,
            scene: Self::default(),
            chains: HashMap::new(),
            sorted: HashMap::new(),
            numbers: HashMap::new(),
            names: HashSet::new(),
            data: HashMap::new(),
            tables: Tables::default(),
        };
        let mut shining: Vec<Shining> = Vec::new();
        let mut group_of: HashMap<usize, usize> = HashMap::new();
        for surface in surfaces {
            if let Some(source) = sorter.surface(&surface)? {
                let at = *group_of.entry(source).or_insert_with(|| {
                    shining.push(Shining { definition: source, surfaces: Vec::new() });
                    shining.len() - 1
                });
                shining[at].surfaces.push(surface);
            }
        }
        for Shining { definition, surfaces } in shining {
            sorter.lamps(definition, surfaces)?;
        }
        Ok(sorter.scene)
    }
}

/// Luminaires of a material.
#[derive(Default)]
struct Made {
    lamps: Vec<Lamp>,
    /// Whether some of them give no light.
    is_dark: bool,
}

/// Surfaces of one material that are luminaires.
struct Shining {
    definition: usize,
    surfaces: Vec<RawSurface>,
}

/// Fate of a surface, by a number of materials or of definitions.
#[derive(Clone, Copy, Debug)]
enum Sorted {
    Kept { material: usize },
    Shines { definition: usize },
}

/// Sorts surfaces by what becomes of them.
struct Sorter<'f, 'n> {
    collector: Collector<'f>,
    findings: &'n mut Findings,
    described: &'n HashSet<&'n str>,
    scene: Scene,
    chains: HashMap<usize, Chain>,
    /// Fates of surfaces, by their first modifiers.
    sorted: HashMap<usize, Sorted>,
    /// Numbers of materials, by all that they depend on.
    numbers: HashMap<String, usize>,
    /// Names of materials.
    names: HashSet<String>,
    tables: Tables,
    /// By their files.
    data: HashMap<String, Result<Rc<Data>, String>>,
}

impl Sorter<'_, '_> {
    fn definitions(&self) -> &Definitions {
        &self.collector.definitions
    }

    /// Takes a surface; the number of its material where it is a part of a luminaire.
    fn surface(&mut self, surface: &RawSurface) -> Result<Option<usize>, LoadError> {
        if let Some(number) = self.described_elsewhere(&surface.modifier) {
            if matches!(surface.shape, Shape::Source { .. }) {
                let place = format!("source \"{}\"", shown(&surface.name));
                let note = "a source whose material the scene does not define is left out";
                self.findings.note(&place, note);
            } else {
                self.keep(surface, number);
            }
            return Ok(None);
        }
        let is_far = matches!(surface.shape, Shape::Source { .. });
        let first = match self.definitions().settled(&surface.modifier) {
            Link::To(first) if !is_far => Some(first),
            _ => None,
        };
        match first.and_then(|first| self.sorted.get(&first)) {
            Some(&Sorted::Kept { material }) => {
                self.keep(surface, material);
                return Ok(None);
            }
            Some(&Sorted::Shines { definition }) => return Ok(Some(definition)),
            None => {}
        }
        let chain = self.chain_of(&surface.modifier, &surface.place)?;
        let Some(material) = chain.material else {
            let place = format!("surface \"{}\"", shown(&surface.name));
            self.findings.note(&place, "a surface without a material is left out");
            return Ok(None);
        };
        if let Shape::Source { direction, angle_deg } = surface.shape {
            let definitions = &self.collector.definitions;
            let far = Far {
                direction,
                angle_deg,
                material: definitions.get(material),
                patterns: chain.patterns.iter().map(|&it| definitions.get(it)).collect(),
                place: format!("source \"{}\"", shown(&surface.name)),
            };
            self.scene.outside.add(&far, self.findings);
            return Ok(None);
        }
        let first = first.expect("a material is a modifier");
        if self.is_lamp(&chain) {
            self.sorted.insert(first, Sorted::Shines { definition: material });
            return Ok(Some(material));
        }
        let material = self.material(&chain, 0)?;
        self.sorted.insert(first, Sorted::Kept { material });
        self.keep(surface, material);
        Ok(None)
    }

    /// The material of a name that the scene does not define, and the project does.
    fn described_elsewhere(&mut self, link: &Link) -> Option<usize> {
        let Link::Open(name) = self.definitions().settled(link) else {
            self.tell_late(link);
            return None;
        };
        if !self.described.contains(&*name) {
            return None;
        }
        Some(self.described(&name, None))
    }

    /// The material of a name that the project describes.
    fn described(&mut self, name: &str, light: Option<Look>) -> usize {
        let key = format!("described {name}");
        match self.numbers.get(&key) {
            Some(&known) => known,
            None => {
                let unknown = || Look::Unknown(format!("no modifier is called {name:?}").into());
                self.names.insert(name.to_owned());
                self.push_material(key, name.to_owned(), light.unwrap_or_else(unknown))
            }
        }
    }

    /// Tells of a modifier that is defined behind what it modifies.
    fn tell_late(&mut self, link: &Link) {
        if let Link::Open(name) = link {
            let place = format!("modifier \"{}\"", shown(name));
            let note = "it is used before it is defined: its first definition counts";
            self.findings.note(&place, note);
        }
    }

    fn keep(&mut self, surface: &RawSurface, material: usize) {
        if matches!(self.scene.materials[material].1, Look::Open) {
            return;
        }
        self.scene.surfaces.push(Surface {
            name: Arc::clone(&surface.name),
            material,
            shape: surface.shape.clone(),
            file: Arc::clone(&surface.place.file),
            at: surface.place.at,
        });
    }

    /// All modifiers from a link on.
    fn chain_of(&mut self, link: &Link, place: &FilePlace) -> Result<Chain, LoadError> {
        let link = self.definitions().settled(link);
        let first = match &link {
            Link::Void => return Ok(Chain::default()),
            Link::Open(name) => return Err(self.collector.undefined(name, place)),
            Link::To(number) => *number,
        };
        if let Some(known) = self.chains.get(&first) {
            return Ok(known.clone());
        }
        let mut chain = Chain::default();
        let mut next = Link::To(first);
        let mut length = 0;
        while let Link::To(number) = next {
            let definition = self.definitions().get(number);
            let kind = &*definition.primitive.kind;
            if is_material(kind) {
                if chain.material.is_none() {
                    chain.material = Some(number);
                }
            } else if is_pattern(kind) {
                chain.patterns.push(number);
            } else {
                chain.is_textured = true;
            }
            let place = definition.place.clone();
            next = self.definitions().settled(&definition.modifier);
            length += 1;
            if let Link::Open(name) = &next {
                return Err(self.collector.undefined(name, &place));
            }
            if length > MAX_CHAIN {
                let message = format!("more than {MAX_CHAIN} modifiers modify each other");
                return Err(LoadError::new(&place.file, Some(place.at), message));
            }
        }
        self.chains.insert(first, chain.clone());
        Ok(chain)
    }

    /// Whether surfaces of these modifiers are luminaires.
    fn is_lamp(&self, chain: &Chain) -> bool {
        let Some(material) = chain.material else { return false };
        let definition = self.definitions().get(material);
        if self.described.contains(&*definition.name) || definition.alternate.is_some() {
            return false;
        }
        let primitive = &definition.primitive;
        let has_distribution = || {
            chain.patterns.iter().any(|&it| distribution_of(self.definitions().get(it)).is_some())
        };
        match &*primitive.kind {
            "spotlight" => true,
            "light" | "illum" => has_distribution(),
            "glow" => {
                primitive.reals.get(3).is_some_and(|reach| *reach >= 0.0) && has_distribution()
            }
            _ => false,
        }
    }

    /// The number of the material of a chain.
    fn material(&mut self, chain: &Chain, depth: usize) -> Result<usize, LoadError> {
        let number = chain.material.expect("a chain with a material");
        let definition = self.definitions().get(number).clone();
        if let Some(alternate) = definition.alternate.as_ref().filter(|_| depth < MAX_CHAIN) {
            let place = format!("illum \"{}\"", shown(&definition.name));
            let note = "an illum is its alternate material: light comes through that by itself";
            self.findings.note(&place, note);
            let inner = self.chain_of(alternate, &definition.place)?;
            if inner.material.is_some() {
                return self.material(&inner, depth + 1);
            }
        }
        let key = key(&definition, &chain.patterns, chain.is_textured);
        if let Some(&known) = self.numbers.get(&key) {
            return Ok(known);
        }
        let name = self.free_name(&definition.name);
        let is_described = self.described.contains(&*definition.name);
        if is_described && (name == *definition.name || !self.described.contains(name.as_str())) {
            let light = self.plain_light(&definition, chain);
            return Ok(self.described(&definition.name, light));
        }
        let mut found = self.look(&definition, chain);
        if let Look::Unknown(refusal) = &mut found {
            let FilePlace { file, at } = &definition.place;
            refusal.place = Some((Arc::clone(file), *at));
        }
        self.names.insert(name.clone());
        Ok(self.push_material(key, name, found))
    }

    /// The light of a material that the project describes, where it shines.
    fn plain_light(&mut self, definition: &Definition, chain: &Chain) -> Option<Look> {
        let is_plain = shines(&definition.primitive.kind) && chain.patterns.is_empty();
        let look = is_plain.then(|| self.look(definition, chain));
        look.filter(|look| matches!(look, Look::Light(_)))
    }

    /// A name that no other material has: that of a definition, or one with a number behind it.
    fn free_name(&self, name: &str) -> String {
        if !self.names.contains(name) {
            return name.to_owned();
        }
        let numbered = (2_u64..).map(|number| format!("{name} {number}"));
        let mut free =
            numbered.filter(|it| !self.names.contains(it) && !self.definitions().is_defined(it));
        free.next().expect("there are more numbers than names")
    }

    fn push_material(&mut self, key: String, name: String, look: Look) -> usize {
        self.scene.materials.push((name, look));
        let number = self.scene.materials.len() - 1;
        self.numbers.insert(key, number);
        number
    }

    fn look(&mut self, definition: &Definition, chain: &Chain) -> Look {
        let kind = &*definition.primitive.kind;
        let place = format!("{kind} \"{}\"", shown(&definition.name));
        let never_lights =
            kind == "glow" && definition.primitive.reals.get(3).is_some_and(|reach| *reach < 0.0);
        if shines(kind) && !never_lights && !chain.patterns.is_empty() {
            let pattern = self.definitions().get(chain.patterns[0]);
            let (kind, pattern) = (&pattern.primitive.kind, shown(&pattern.name));
            let refusal = format!(
                "{place} shines by the pattern {kind} \"{pattern}\", of which there is nothing \
                 here; expected none, or brightdata with source.cal"
            );
            return Look::Unknown(refusal.into());
        }
        if !chain.patterns.is_empty() {
            self.findings.note(&place, "the pattern that it is modified by is left out");
        }
        if chain.is_textured {
            self.findings.note(&place, "the texture that it is modified by is left out");
        }
        let includes = &mut self.collector.includes;
        look(definition, &mut Reading { includes, findings: self.findings })
    }

    /// Surfaces of one material to luminaires.
    fn lamps(&mut self, material: usize, surfaces: Vec<RawSurface>) -> Result<(), LoadError> {
        let definition = self.definitions().get(material).clone();
        let place = format!("{} \"{}\"", definition.primitive.kind, shown(&definition.name));
        let chain = self.chain_of(&Link::To(material), &definition.place)?;
        let made = self
            .source(&definition, &chain)
            .and_then(|source| self.lamps_of(&source, &definition, &surfaces));
        let FilePlace { file, at } = &definition.place;
        let mut made = match made {
            Ok(made) => made,
            Err(why) if self.tables.budget.is_spent => {
                return Err(LoadError::new(file, Some(*at), why));
            }
            Err(why) => {
                let message = format!(
                    "the light of {place} is not known: {why}; expected what ies2rad writes"
                );
                let place = Some((Arc::clone(file), *at));
                let name = self.free_name(&definition.name);
                self.names.insert(name.clone());
                let look = Look::Unknown(Unusable { message, place });
                let number = self.push_material(format!("dark {material}"), name, look);
                surfaces.iter().for_each(|surface| self.keep(surface, number));
                return Ok(());
            }
        };
        if made.is_dark {
            self.findings.note(&place, "a luminaire that gives no light is left out");
        }
        self.scene.lamps.append(&mut made.lamps);
        Ok(())
    }

    fn lamps_of(
        &mut self,
        source: &Source<'_>,
        definition: &Definition,
        surfaces: &[RawSurface],
    ) -> Result<Made, String> {
        let shapes: Vec<&Shape> = surfaces.iter().map(|surface| &surface.shape).collect();
        let grouping = source.distribution.as_ref().map_or(Grouping::Apart, Distribution::grouping);
        let mut made = Made::default();
        for group in groups(&shapes, grouping) {
            if self.scene.lamps.len() + made.lamps.len() >= MAX_LAMPS {
                self.tables.budget.is_spent = true;
                return Err(format!("more than {MAX_LAMPS} luminaires; expected fewer"));
            }
            match source.lamp(&definition.name, &shapes[group], &mut self.tables)? {
                Some(lamp) => made.lamps.push(lamp),
                None => made.is_dark = true,
            }
        }
        Ok(made)
    }

    /// The distribution of a material, or why it is not known.
    fn source<'d>(
        &mut self,
        definition: &'d Definition,
        chain: &Chain,
    ) -> Result<Source<'d>, String> {
        let mut source = Source { definition, distribution: None, tilt_factor: 1.0 };
        let place = format!("{} \"{}\"", definition.primitive.kind, shown(&definition.name));
        if definition.primitive.reals.first_chunk()
            != Some(&[definition.primitive.reals.first().copied().unwrap_or(0.0); 3])
        {
            self.findings.note(&place, "the colour of its light is left out");
        }
        for &number in &chain.patterns {
            let pattern = self.definitions().get(number).clone();
            let arguments = Arguments::from_definition(&pattern);
            let arguments = arguments.filter(|it| it.is_of_source() || it.tilt_deg().is_some());
            let Some(arguments) = arguments else {
                let name = shown(&pattern.name);
                let kind = &pattern.primitive.kind;
                return Err(format!("it has the pattern {kind} \"{name}\""));
            };
            let data = self.data(&pattern.place.file, arguments.data_file)?;
            match arguments.tilt_deg() {
                Some(degrees) => source.tilt_factor *= data.value(&[degrees]).clamp(0.0, 1e6),
                None if source.distribution.is_some() => {
                    return Err("it has two distributions".to_owned());
                }
                None => {
                    let reals = &pattern.primitive.reals;
                    source.distribution = Some(arguments.distribution(&data, reals)?);
                }
            }
        }
        Ok(source)
    }

    fn data(&mut self, of: &str, name: &str) -> Result<Rc<Data>, String> {
        let file = self.collector.includes.data(of, name, FileKind::Radiance)?;
        if let Some(known) = self.data.get(&*file.path) {
            return known.clone();
        }
        let read = Data::parse(&file.text).map(Rc::new);
        let read = read.map_err(|what| format!("\"{}\" is no data: {what}", shown(&file.path)));
        self.data.insert(file.path.to_string(), read.clone());
        read
    }
}
