//! Names in scope of each module, and the module that defines what a path names.

use super::paths::WrittenPath;
use super::tree::{Module, ModuleTree};
use std::collections::HashMap;
use syn::Item;

/// What a name stands for: a module, or an item of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meaning {
    Module(usize),
    Item(usize),
}

impl Meaning {
    /// The module itself, or the one that defines the item.
    fn module(self) -> usize {
        let (Self::Module(module) | Self::Item(module)) = self;
        module
    }
}

/// A name that is looked up in a module.
struct Lookup {
    module: usize,
    name: String,
}

impl Lookup {
    fn is(&self, module: usize, name: &str) -> bool {
        self.module == module && self.name == name
    }
}

/// The names that one module knows.
#[derive(Default)]
struct Scope {
    /// Items that the module defines.
    defined: Vec<String>,
    /// What `use` brings in: the paths by the name that they get.
    used: HashMap<String, Vec<Vec<String>>>,
    /// Paths whose whole content is brought in.
    globs: Vec<Vec<String>>,
}

/// The scopes of all modules of a crate.
pub(crate) struct Scopes<'a> {
    tree: &'a ModuleTree,
    scopes: Vec<Scope>,
}

impl<'a> Scopes<'a> {
    /// Of a crate, with the paths that each module writes.
    pub(crate) fn new(tree: &'a ModuleTree, written: &[Vec<WrittenPath>]) -> Self {
        let scopes = tree.modules.iter().zip(written).map(|(m, w)| scope(m, w)).collect();
        Self { tree, scopes }
    }

    /// The modules that define what a path in `module` names: none where it leads outside the
    /// crate or is a local name, several where a name is a module and an item.
    pub(crate) fn defining(&self, module: usize, names: &[String]) -> Vec<usize> {
        let names = names.strip_suffix(&["*".to_owned()]).unwrap_or(names);
        let meanings = self.resolve(module, names, &mut Vec::new());
        let mut modules: Vec<usize> = meanings.into_iter().map(Meaning::module).collect();
        modules.sort_unstable();
        modules.dedup();
        modules
    }

    /// `open` holds the lookups that this one serves, so that a name that is made of itself ends.
    fn resolve(&self, module: usize, names: &[String], open: &mut Vec<Lookup>) -> Vec<Meaning> {
        let Some((first, mut rest)) = names.split_first() else {
            return Vec::new();
        };
        let mut meanings = match first.as_str() {
            "crate" => vec![Meaning::Module(0)],
            "self" => vec![Meaning::Module(module)],
            "super" => self.tree.modules[module].parent.map(Meaning::Module).into_iter().collect(),
            name => self.look_up(module, name, open),
        };
        while let Some((name, further)) = rest.split_first() {
            meanings = meanings.into_iter().flat_map(|m| self.step(m, name, open)).collect();
            rest = further;
        }
        meanings
    }

    fn step(&self, at: Meaning, name: &str, open: &mut Vec<Lookup>) -> Vec<Meaning> {
        let Meaning::Module(module) = at else {
            return vec![at];
        };
        if name == "super" {
            return self.tree.modules[module].parent.map(Meaning::Module).into_iter().collect();
        }
        let found = self.look_up(module, name, open);
        // What a macro defines has no name here: it is an item of the module all the same.
        let is_open = open.iter().any(|lookup| lookup.is(module, name));
        if found.is_empty() && !is_open { vec![Meaning::Item(module)] } else { found }
    }

    fn look_up(&self, module: usize, name: &str, open: &mut Vec<Lookup>) -> Vec<Meaning> {
        let scope = &self.scopes[module];
        let mut meanings = Vec::new();
        if scope.defined.iter().any(|defined| defined == name) {
            meanings.push(Meaning::Item(module));
        }
        meanings.extend(self.tree.modules[module].children.get(name).map(|&c| Meaning::Module(c)));
        if open.iter().any(|lookup| lookup.is(module, name)) {
            return meanings;
        }
        open.push(Lookup { module, name: name.to_owned() });
        for path in scope.used.get(name).into_iter().flatten() {
            meanings.extend(self.resolve(module, path, open));
        }
        if meanings.is_empty() {
            for path in &scope.globs {
                for meaning in self.resolve(module, path, open) {
                    if let Meaning::Module(inside) = meaning {
                        meanings.extend(self.look_up(inside, name, open));
                    }
                }
            }
        }
        open.pop();
        meanings
    }
}

fn scope(module: &Module, written: &[WrittenPath]) -> Scope {
    let mut scope = Scope {
        defined: module.items.iter().filter_map(defined_name).collect(),
        ..Scope::default()
    };
    for path in written {
        match &path.alias {
            Some(alias) => {
                scope.used.entry(alias.clone()).or_default().push(path.names.clone());
            }
            None => {
                scope.globs.extend(path.names.strip_suffix(&["*".to_owned()]).map(<[_]>::to_vec));
            }
        }
    }
    scope
}

fn defined_name(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::TraitAlias(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Union(item) => &item.ident,
        _ => return None,
    };
    Some(name.to_string())
}
