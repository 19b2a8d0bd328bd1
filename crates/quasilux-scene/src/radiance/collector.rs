//! Goes through the files of a scene: what surfaces there are, and which modifiers.

use super::command::{Command, Source};
use super::definitions::{Definitions, FilePlace, Link};
use super::document::{EntryKind, Primitive, shown};
use super::findings::Findings;
use super::includes::{Include, Includes, Missing};
use super::materials::is_modifier;
use super::shapes::{Placement, Shape, is_surface};
use super::xform::{MAX_COPIES, Xform};
use crate::LoadError;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

/// Most primitives of a scene, those in arrays counted each time.
const MAX_PRIMITIVES: u64 = 2_000_000;
/// Most numbers of all of them.
const MAX_REALS: u64 = 40_000_000;
/// Most steps of `xform` for all copies.
const MAX_STEPS: u64 = 20_000_000;
/// Most files, each of which names the next.
const MAX_DEPTH: usize = 32;

/// A surface, and its modifier.
#[derive(Clone, Debug)]
pub(super) struct RawSurface {
    pub(super) name: Arc<str>,
    pub(super) modifier: Link,
    pub(super) shape: Shape,
    pub(super) place: FilePlace,
}

/// An entry, by its file, which is kept, and its number therein.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct EntryKey {
    include: *const Include,
    number: usize,
}

/// Everything that was read so far.
pub(super) struct Collector<'f> {
    pub(super) includes: Includes<'f>,
    pub(super) definitions: Definitions,
    pub(super) surfaces: Vec<RawSurface>,
    primitives_left: u64,
    reals_left: u64,
    steps_left: u64,
    /// Each is read once.
    commands: HashMap<EntryKey, Rc<Command>>,
}

/// How a file is put into the scene.
#[derive(Clone)]
struct Context {
    placement: Placement,
    /// The modifier of all surfaces.
    modifier: Option<Arc<str>>,
    /// In front of the names of surfaces.
    prefix: String,
    depth: usize,
}

impl<'f> Collector<'f> {
    pub(super) fn new(includes: Includes<'f>) -> Self {
        Self {
            includes,
            definitions: Definitions::default(),
            surfaces: Vec::new(),
            primitives_left: MAX_PRIMITIVES,
            reals_left: MAX_REALS,
            steps_left: MAX_STEPS,
            commands: HashMap::new(),
        }
    }

    /// Reads a file that the project names.
    pub(super) fn file(&mut self, name: &str, findings: &mut Findings) -> Result<(), LoadError> {
        let include = self.includes.named(name).map_err(|missing| match missing {
            Missing::Refused(message) => LoadError::new(name, None, message),
            Missing::Wrong(error) => error,
        })?;
        let placement = Placement { frame: super::frame::Frame::default(), is_inverted: false };
        let context = Context { placement, modifier: None, prefix: String::new(), depth: 0 };
        self.entries(&include, &context, findings)
    }

    fn entries(
        &mut self,
        include: &Rc<Include>,
        context: &Context,
        findings: &mut Findings,
    ) -> Result<(), LoadError> {
        let file = &include.path;
        for (number, entry) in include.entries.iter().enumerate() {
            let place = FilePlace { file: Arc::clone(file), at: entry.place };
            let done = match &entry.kind {
                EntryKind::Primitive(primitive) => self.primitive(primitive, context, &place),
                EntryKind::Alias(alias) => {
                    self.count(0).and_then(|()| match self.definitions.alias(alias) {
                        Some(()) => Ok(()),
                        None => Err(Missing::Wrong(self.undefined(&alias.reference, &place))),
                    })
                }
                EntryKind::Command(text) => self
                    .parsed(EntryKey { include: Rc::as_ptr(include), number }, text)
                    .and_then(|command| self.command(&command, context, &place, findings)),
            };
            done.map_err(|missing| match missing {
                Missing::Refused(message) => LoadError::new(file, Some(entry.place), message),
                Missing::Wrong(error) => error,
            })?;
        }
        Ok(())
    }

    fn parsed(&mut self, key: EntryKey, text: &str) -> Result<Rc<Command>, Missing> {
        if let Some(known) = self.commands.get(&key) {
            return Ok(Rc::clone(known));
        }
        let command = Rc::new(Command::parse(text).map_err(Missing::Refused)?);
        self.commands.insert(key, Rc::clone(&command));
        Ok(command)
    }

    /// Takes one primitive off what a scene may have.
    fn count(&mut self, reals: usize) -> Result<(), Missing> {
        self.take(1, reals)
    }

    /// Takes memory of so many numbers off.
    fn charge(&mut self, reals: usize) -> Result<(), Missing> {
        self.take(0, reals)
    }

    fn take(&mut self, primitives: u64, reals: usize) -> Result<(), Missing> {
        let left = self
            .primitives_left
            .checked_sub(primitives)
            .zip(self.reals_left.checked_sub(reals as u64));
        let Some((primitives, reals)) = left else {
            let message = format!(
                "up to here the scene has more than {MAX_PRIMITIVES} primitives, or {MAX_REALS} \
                 numbers and words in them, those in arrays counted each time; expected fewer"
            );
            return Err(Missing::Refused(message));
        };
        (self.primitives_left, self.reals_left) = (primitives, reals);
        Ok(())
    }

    fn primitive(
        &mut self,
        primitive: &Arc<Primitive>,
        context: &Context,
        place: &FilePlace,
    ) -> Result<(), Missing> {
        self.count(primitive.weight())?;
        if is_modifier(&primitive.kind) {
            let frame = context.placement.frame;
            self.definitions.add(Arc::clone(primitive), frame, place.clone());
            return Ok(());
        }
        if !is_surface(&primitive.kind) {
            let message = format!(
                "{} is no type of primitives; expected one of Radiance 5, such as polygon or \
                 plastic",
                shown(&primitive.kind)
            );
            return Err(Missing::Refused(message));
        }
        let shape =
            Shape::from_primitive(primitive, &context.placement).map_err(Missing::Refused)?;
        let modifier = context.modifier.as_ref().unwrap_or(&primitive.modifier);
        let name: Arc<str> = match context.prefix.as_str() {
            "" => Arc::clone(&primitive.name),
            prefix => {
                self.charge((prefix.len() + primitive.name.len()) / 8)?;
                format!("{prefix}{}", primitive.name).into()
            }
        };
        let modifier = self.definitions.link(modifier);
        self.surfaces.push(RawSurface { name, modifier, shape, place: place.clone() });
        Ok(())
    }

    fn command(
        &mut self,
        command: &Command,
        context: &Context,
        place: &FilePlace,
        findings: &mut Findings,
    ) -> Result<(), Missing> {
        if context.depth >= MAX_DEPTH {
            let message = format!(
                "more than {MAX_DEPTH} files name each other up to here; expected none that names \
                 itself"
            );
            return Err(Missing::Refused(message));
        }
        let copies = |all: u64, piped: &Xform| all.checked_mul(piped.transforms.copies());
        let copies = command.stages.iter().try_fold(1, copies);
        let copies = copies.filter(|&copies| copies <= MAX_COPIES).ok_or_else(|| {
            Missing::Refused(format!("the arrays of a pipeline make more than {MAX_COPIES} copies"))
        })?;
        let steps: u64 = command.stages.iter().map(|piped| piped.transforms.steps()).sum();
        self.steps_left = self.steps_left.checked_sub(copies * steps).ok_or_else(|| {
            Missing::Refused(format!(
                "up to here the copies of xform take more than {MAX_STEPS} steps; expected fewer"
            ))
        })?;
        for copy in 0..copies {
            self.count(0)?;
            let mut inner = Context { depth: context.depth + 1, ..context.clone() };
            let (mut rest, mut left) = (copy, copies);
            // The last program of a pipeline moves what the others have made.
            for piped in command.stages.iter().rev() {
                left /= piped.transforms.copies();
                inner = inside(piped, rest / left, &inner)?;
                rest %= left;
            }
            self.source(&command.source, &inner, place, findings)?;
        }
        Ok(())
    }

    fn source(
        &mut self,
        source: &Source,
        context: &Context,
        place: &FilePlace,
        findings: &mut Findings,
    ) -> Result<(), Missing> {
        match source {
            Source::Generated(generator) => {
                for &remark in generator.remarks() {
                    findings.note(&format!("{}:{}", place.file, place.at.line), remark);
                }
                for primitive in generator.primitives() {
                    self.primitive(&Arc::new(primitive), context, place)?;
                }
            }
            Source::Files(names) => {
                for name in names {
                    let include = self.includes.scene(&place.file, name)?;
                    self.entries(&include, context, findings).map_err(Missing::Wrong)?;
                }
            }
        }
        Ok(())
    }

    /// The refusal of a name that nothing has.
    pub(super) fn undefined(&self, name: &str, place: &FilePlace) -> LoadError {
        let message = format!(
            "no modifier is called \"{}\"; expected one of the scene, or a file with it beside the \
             others",
            shown(name)
        );
        LoadError::new(&place.file, Some(place.at), message).offer(name, self.definitions.names())
    }
}

/// The context within a copy of an `xform`.
fn inside(xform: &Xform, number: u64, outer: &Context) -> Result<Context, Missing> {
    let copy = xform.transforms.copy(number);
    let beyond = || Missing::Refused("xform leads beyond all coordinates".to_owned());
    let copy = copy.ok_or_else(beyond)?;
    let frame = copy.frame.then(&outer.placement.frame);
    if !frame.is_finite() {
        return Err(beyond());
    }
    let is_inverted = outer.placement.is_inverted != xform.is_inverted;
    let modifier = outer.modifier.clone();
    let modifier = modifier.or_else(|| xform.modifier.as_deref().map(Arc::from));
    let name = xform.name.as_deref().map(|name| format!("{name}{}.", copy.suffix));
    let prefix = format!("{}{}", outer.prefix, name.unwrap_or_default());
    if prefix.len() > MAX_PREFIX {
        return Err(Missing::Refused("the names (-n) of xform are too long".to_owned()));
    }
    let placement = Placement { frame, is_inverted };
    Ok(Context { placement, modifier, prefix, depth: outer.depth })
}

/// Longest prefix of a name in bytes.
const MAX_PREFIX: usize = 1000;
