//! The modules of one crate, parsed.

use super::targets::Target;
use super::tests_left_out::{attributes_of, is_test};
use std::collections::BTreeMap;
use syn::{Expr, ExprLit, Item, ItemMod, Lit, Meta};

/// One module of a crate.
pub struct Module {
    /// Names from the crate's root, none for the root itself.
    pub path: Vec<String>,
    /// The module around it, none for the root.
    pub parent: Option<usize>,
    /// Modules inside, by name.
    pub children: BTreeMap<String, usize>,
    /// The file with its items.
    pub file: String,
    /// Its items, modules inside it and tests left out.
    pub(crate) items: Vec<Item>,
}

impl Module {
    /// Its name in messages: `a::b`, or the name of the root's file for the root.
    #[must_use]
    pub fn name(&self) -> String {
        if self.path.is_empty() { root_name(&self.file).to_owned() } else { self.path.join("::") }
    }
}

/// `lib` or `main`: the name of the room that the root's own items are in.
fn root_name(file: &str) -> &str {
    let name = file.rsplit('/').next().unwrap_or(file);
    name.strip_suffix(".rs").unwrap_or(name)
}

/// The modules of one crate; the first one is the root.
pub struct ModuleTree {
    /// The crate.
    pub crate_name: String,
    /// Root first, then depth first in the order of declaration.
    pub modules: Vec<Module>,
}

impl ModuleTree {
    /// Parses a crate, whose files `read` gives by their path from the workspace's root.
    ///
    /// # Errors
    /// When a file is missing or is not Rust.
    pub fn read(target: &Target, read: &dyn Fn(&str) -> Option<String>) -> Result<Self, String> {
        let mut reader = Reader { read, modules: Vec::new() };
        let folder = folder_of(&target.root).to_owned();
        reader.file(Vec::new(), None, &target.root, &folder)?;
        Ok(Self { crate_name: target.name.clone(), modules: reader.modules })
    }

    /// The child of `ancestor` that `module` is in, none where it is not inside or is `ancestor`.
    #[must_use]
    pub fn child_towards(&self, ancestor: usize, module: usize) -> Option<usize> {
        let mut here = module;
        loop {
            let parent = self.modules[here].parent?;
            if parent == ancestor {
                return Some(here);
            }
            here = parent;
        }
    }
}

struct Reader<'a> {
    read: &'a dyn Fn(&str) -> Option<String>,
    modules: Vec<Module>,
}

impl Reader<'_> {
    /// Reads a module's file; `folder` is where the files of its children are.
    fn file(
        &mut self,
        path: Vec<String>,
        parent: Option<usize>,
        file: &str,
        folder: &str,
    ) -> Result<usize, String> {
        let text = (self.read)(file).ok_or_else(|| format!("{file} is missing"))?;
        let parsed = syn::parse_file(&text)
            .map_err(|error| format!("{file}:{}: {error}", error.span().start().line))?;
        self.module(FilePosition { path, parent, file, folder }, parsed.items)
    }

    fn module(&mut self, place: FilePosition<'_>, items: Vec<Item>) -> Result<usize, String> {
        let me = self.modules.len();
        self.modules.push(Module {
            path: place.path.clone(),
            parent: place.parent,
            children: BTreeMap::new(),
            file: place.file.to_owned(),
            items: Vec::new(),
        });
        for item in items.into_iter().filter(|item| !is_test(attributes_of(item))) {
            match item {
                Item::Mod(child) => {
                    let name = child.ident.to_string();
                    let index = self.child(&place, me, child)?;
                    self.modules[me].children.insert(name, index);
                }
                item => self.modules[me].items.push(item),
            }
        }
        Ok(me)
    }

    fn child(
        &mut self,
        place: &FilePosition<'_>,
        me: usize,
        child: ItemMod,
    ) -> Result<usize, String> {
        let name = child.ident.to_string();
        let mut path = place.path.clone();
        path.push(name.clone());
        let folder = format!("{}/{name}", place.folder);
        let parent = Some(me);
        if let Some((_, items)) = child.content {
            return self
                .module(FilePosition { path, parent, file: place.file, folder: &folder }, items);
        }
        let written = path_attribute(&child.attrs)
            .map(|written| format!("{}/{written}", folder_of(place.file)));
        let candidates = [written, Some(format!("{folder}.rs")), Some(format!("{folder}/mod.rs"))];
        let found =
            candidates.into_iter().flatten().find(|candidate| (self.read)(candidate).is_some());
        let file = found.ok_or_else(|| format!("{}: no file for {name}", place.file))?;
        self.file(path, parent, &file, &folder)
    }
}

/// Where a module stands.
struct FilePosition<'a> {
    path: Vec<String>,
    parent: Option<usize>,
    file: &'a str,
    folder: &'a str,
}

fn folder_of(file: &str) -> &str {
    file.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// The file that `#[path = ".."]` names.
fn path_attribute(attributes: &[syn::Attribute]) -> Option<String> {
    attributes.iter().find_map(|attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("path") => match &pair.value {
            Expr::Lit(ExprLit { lit: Lit::Str(written), .. }) => Some(written.value()),
            _ => None,
        },
        _ => None,
    })
}
