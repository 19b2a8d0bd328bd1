//! Modifiers by their names: the last definition before a name is used counts.

use super::document::{Alias, Primitive};
use super::frame::Frame;
use quasilux_text::Position;
use std::collections::HashMap;
use std::sync::Arc;

/// A modifier of something.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Link {
    Void,
    To(usize),
    /// Not defined so far; later definitions may follow.
    Open(Arc<str>),
}

/// A place in one of the files of a scene.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FilePlace {
    pub(super) file: Arc<str>,
    pub(super) at: Position,
}

/// A modifier, with where it was put.
#[derive(Clone, Debug)]
pub(super) struct Definition {
    pub(super) modifier: Link,
    /// Material of an `illum` where it does not shine, as it was defined then.
    pub(super) alternate: Option<Link>,
    pub(super) primitive: Arc<Primitive>,
    /// Name by which surfaces have it; an alias gives another one.
    pub(super) name: Arc<str>,
    pub(super) frame: Frame,
    pub(super) place: FilePlace,
}

/// All modifiers so far.
#[derive(Debug, Default)]
pub(super) struct Definitions {
    all: Vec<Definition>,
    /// The last one of each name; an alias may stand for nothing at all.
    last: HashMap<Arc<str>, Link>,
    /// The first one of each name.
    first: HashMap<Arc<str>, Link>,
}

impl Definitions {
    pub(super) fn get(&self, number: usize) -> &Definition {
        &self.all[number]
    }

    /// The modifier that a name means now.
    pub(super) fn link(&self, name: &Arc<str>) -> Link {
        if &**name == "void" {
            return Link::Void;
        }
        self.last.get(name).cloned().unwrap_or_else(|| Link::Open(Arc::clone(name)))
    }

    fn name(&mut self, name: &Arc<str>, link: Link) {
        self.first.entry(Arc::clone(name)).or_insert_with(|| link.clone());
        self.last.insert(Arc::clone(name), link);
    }

    /// Adds a modifier.
    pub(super) fn add(&mut self, primitive: Arc<Primitive>, frame: Frame, place: FilePlace) {
        let (name, modifier) = (Arc::clone(&primitive.name), self.link(&primitive.modifier));
        let alternate = primitive.strings.first();
        let alternate = alternate.filter(|name| &*primitive.kind == "illum" && &***name != "void");
        let alternate = alternate.map(|name| self.link(name));
        self.push(Definition { modifier, alternate, primitive, name, frame, place });
    }

    fn push(&mut self, definition: Definition) {
        let name = Arc::clone(&definition.name);
        self.all.push(definition);
        self.name(&name, Link::To(self.all.len() - 1));
    }

    /// Adds another name for a modifier, with another modifier of it; `None` where the reference is
    /// not defined.
    pub(super) fn alias(&mut self, alias: &Alias) -> Option<()> {
        match self.link(&alias.reference) {
            Link::Open(_) => return None,
            Link::Void => self.name(&alias.name, Link::Void),
            Link::To(number) => {
                let known = self.get(number).clone();
                let modifier = match &*alias.modifier {
                    "inherit" => known.modifier.clone(),
                    _ => self.link(&alias.modifier),
                };
                self.push(Definition { modifier, name: Arc::clone(&alias.name), ..known });
            }
        }
        Some(())
    }

    /// A link by all definitions: of a name that was used before it was defined, the first one.
    pub(super) fn settled(&self, link: &Link) -> Link {
        match link {
            Link::Open(name) => self.first.get(name).unwrap_or(link).clone(),
            _ => link.clone(),
        }
    }

    pub(super) fn is_defined(&self, name: &str) -> bool {
        self.first.contains_key(name)
    }

    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.last.keys().map(|name| &**name)
    }
}
