//! All paths that a module's items write: in `use` trees, in types and expressions, in macros and
//! in attributes.

use super::tests_left_out::{
    attributes_of, attributes_of_member, attributes_of_trait_member, is_test,
};
use proc_macro2::{Spacing, TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, ImplItem, Item, ItemUse, Macro, Meta, Path, TraitItem, UseTree, Visibility};

/// A path, as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct WrittenPath {
    /// Its names; `*` stands last in a glob.
    pub(crate) names: Vec<String>,
    pub(crate) line: usize,
    /// What it is called here, where a `use` brings it in.
    pub(crate) alias: Option<String>,
    /// Whether it is a `pub use` of any visibility beyond the module.
    pub(crate) is_reexport: bool,
}

/// The paths in a module's items, tests left out.
pub(crate) fn in_items(items: &[Item]) -> Vec<WrittenPath> {
    let mut collector = Collector { found: Vec::new() };
    items.iter().for_each(|item| collector.visit_item(item));
    collector.found
}

struct Collector {
    found: Vec<WrittenPath>,
}

impl Collector {
    fn add(&mut self, names: Vec<String>, line: usize) {
        self.found.push(WrittenPath { names, line, alias: None, is_reexport: false });
    }

    fn tree(&mut self, tree: &UseTree, before: &[String], is_reexport: bool) {
        let extended = |name: String| before.iter().cloned().chain([name]).collect::<Vec<_>>();
        let mut leaf = |names: Vec<String>, line: usize, alias: Option<String>| {
            self.found.push(WrittenPath { names, line, alias, is_reexport });
        };
        match tree {
            UseTree::Path(path) => {
                self.tree(&path.tree, &extended(path.ident.to_string()), is_reexport);
            }
            UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.tree(tree, before, is_reexport));
            }
            UseTree::Glob(glob) => {
                leaf(extended("*".to_owned()), glob.star_token.span.start().line, None);
            }
            UseTree::Name(name) if name.ident == "self" => {
                let line = name.ident.span().start().line;
                leaf(before.to_vec(), line, before.last().cloned());
            }
            UseTree::Name(name) => {
                let line = name.ident.span().start().line;
                leaf(extended(name.ident.to_string()), line, Some(name.ident.to_string()));
            }
            UseTree::Rename(rename) => {
                let line = rename.ident.span().start().line;
                let names = match rename.ident.to_string() {
                    word if word == "self" => before.to_vec(),
                    word => extended(word),
                };
                leaf(names, line, Some(rename.rename.to_string()));
            }
        }
    }

    /// Paths in what the parser leaves as tokens: names joined by `::`.
    fn tokens(&mut self, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut i = 0;
        while i < tokens.len() {
            match &tokens[i] {
                TokenTree::Group(group) => self.tokens(group.stream()),
                TokenTree::Literal(literal) => {
                    self.quoted(&literal.to_string(), literal.span().start().line);
                }
                TokenTree::Ident(first) => {
                    let line = first.span().start().line;
                    let mut names = vec![first.to_string()];
                    while let Some(name) = next_name(&tokens[i + 1..]) {
                        names.push(name);
                        i += 3;
                    }
                    if names.len() > 1 {
                        self.add(names, line);
                    }
                }
                TokenTree::Punct(_) => {}
            }
            i += 1;
        }
    }

    /// A path in a literal, as in `#[serde(with = "crate::a")]`.
    fn quoted(&mut self, literal: &str, line: usize) {
        let text = literal.trim_matches('"');
        if ["crate::", "super::", "self::"].iter().any(|start| text.starts_with(start)) {
            self.add(text.split("::").map(str::to_owned).collect(), line);
        }
    }
}

/// The name behind `::` at the start of `tokens`.
fn next_name(tokens: &[TokenTree]) -> Option<String> {
    match tokens {
        [TokenTree::Punct(a), TokenTree::Punct(b), TokenTree::Ident(name), ..]
            if a.as_char() == ':' && a.spacing() == Spacing::Joint && b.as_char() == ':' =>
        {
            Some(name.to_string())
        }
        _ => None,
    }
}

impl<'ast> Visit<'ast> for Collector {
    fn visit_item(&mut self, item: &'ast Item) {
        if !is_test(attributes_of(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item(&mut self, member: &'ast ImplItem) {
        if !is_test(attributes_of_member(member)) {
            visit::visit_impl_item(self, member);
        }
    }

    fn visit_trait_item(&mut self, member: &'ast TraitItem) {
        if !is_test(attributes_of_trait_member(member)) {
            visit::visit_trait_item(self, member);
        }
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        if item.leading_colon.is_none() {
            let is_reexport = !matches!(item.vis, Visibility::Inherited);
            self.tree(&item.tree, &[], is_reexport);
        }
    }

    fn visit_path(&mut self, path: &'ast Path) {
        if path.leading_colon.is_none() {
            let names: Vec<_> = path.segments.iter().map(|s| s.ident.to_string()).collect();
            if let Some(first) = path.segments.first() {
                self.add(names, first.ident.span().start().line);
            }
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, invocation: &'ast Macro) {
        self.visit_path(&invocation.path);
        self.tokens(invocation.tokens.clone());
    }

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        if let Meta::List(list) = &attribute.meta {
            self.tokens(list.tokens.clone());
        }
    }

    fn visit_visibility(&mut self, _: &'ast Visibility) {}
}
