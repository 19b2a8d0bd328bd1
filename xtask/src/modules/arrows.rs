//! Edges of the import graph.

use super::paths;
use super::scope::Scopes;
use super::targets::Target;
use super::tree::ModuleTree;
use std::collections::BTreeMap;

/// One path in the source that leads from a module to another.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Import {
    /// The file that writes it.
    pub file: String,
    /// The line in it.
    pub line: usize,
    /// The path as written.
    pub path: String,
    /// Index of the module that writes it.
    pub from: usize,
    /// Index of the module that defines what it names.
    pub to: usize,
}

/// The modules of a crate and what they import from each other.
pub struct Graph {
    /// The modules.
    pub tree: ModuleTree,
    /// All imports between different modules, sorted by place.
    pub imports: Vec<Import>,
}

/// Imports by the pair of names of the modules that they join.
pub type Pairs<'a> = BTreeMap<Pair, Vec<&'a Import>>;

/// Two modules of one folder, the first of which imports the second.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pair {
    /// The one that imports.
    pub from: String,
    /// The one that defines.
    pub to: String,
}

impl Graph {
    /// Reads a crate.
    ///
    /// # Errors
    /// When a file is missing or is not Rust.
    pub fn read(target: &Target, read: &dyn Fn(&str) -> Option<String>) -> Result<Self, String> {
        let tree = ModuleTree::read(target, read)?;
        let written: Vec<_> = tree.modules.iter().map(|m| paths::in_items(&m.items)).collect();
        let scopes = Scopes::new(&tree, &written);
        let mut imports = Vec::new();
        for (from, paths) in written.iter().enumerate() {
            for path in paths {
                // The root's re-exports are the crate's face, and use nothing themselves.
                if from == 0 && path.is_reexport {
                    continue;
                }
                for to in scopes.defining(from, &path.names) {
                    let file = tree.modules[from].file.clone();
                    let path_text = path.names.join("::");
                    imports.push(Import { file, line: path.line, path: path_text, from, to });
                }
            }
        }
        imports.retain(|import| import.from != import.to);
        imports.sort();
        imports.dedup();
        Ok(Self { tree, imports })
    }

    /// The rooms: names of the root's children.
    pub fn rooms(&self) -> impl Iterator<Item = &str> {
        self.tree.modules[0].children.keys().map(String::as_str)
    }

    /// Imports between rooms. The root's own items are a room of its name.
    #[must_use]
    pub fn between_rooms(&self) -> Pairs<'_> {
        let room = |module: usize| self.tree.child_towards(0, module).unwrap_or(0);
        self.between(room)
    }

    /// Imports between the modules inside the folder `parent`, those of its own items left out.
    #[must_use]
    pub fn between_children(&self, parent: usize) -> Pairs<'_> {
        let mut pairs =
            self.between(|module| self.tree.child_towards(parent, module).unwrap_or(usize::MAX));
        pairs.retain(|pair, _| !pair.from.is_empty() && !pair.to.is_empty());
        pairs
    }

    /// Imports by what `part` makes of their ends, without those inside one part.
    fn between(&self, part: impl Fn(usize) -> usize) -> Pairs<'_> {
        let name = |part: usize| match self.tree.modules.get(part) {
            Some(module) => module.path.last().cloned().unwrap_or_else(|| module.name()),
            None => String::new(),
        };
        let mut pairs = Pairs::new();
        for import in &self.imports {
            let (from, to) = (part(import.from), part(import.to));
            if from != to {
                let pair = Pair { from: name(from), to: name(to) };
                pairs.entry(pair).or_default().push(import);
            }
        }
        pairs
    }
}
