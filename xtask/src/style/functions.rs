//! The functions of a crate, those of tests left out.

use super::tuples;
use crate::modules::tests_left_out::{
    attributes_of, attributes_of_member, attributes_of_trait_member, is_test,
};
use crate::modules::tree::{Module, ModuleTree};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, Block, ImplItem, Item, ItemFn, Signature, TraitItem, Type};

/// Most lines of a function, from the line of its signature to that of its closing brace.
pub const MAX_LINES: usize = 55;

/// A function or a method with a body, or the signature of one in a trait.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Function {
    /// Its file, from the workspace's root.
    pub file: String,
    /// The line of its signature.
    pub line: usize,
    /// `name`, or `Type::name` for a method.
    pub name: String,
    /// Its lines from signature to closing brace.
    pub lines: usize,
    /// The tuples of unlike types in its arguments and its result, as written.
    pub tuples: Vec<String>,
}

/// All functions of a crate, in the order of the modules.
#[must_use]
pub fn of_crate(tree: &ModuleTree) -> Vec<Function> {
    tree.modules.iter().flat_map(of_module).collect()
}

fn of_module(module: &Module) -> Vec<Function> {
    let mut collector = Collector { file: &module.file, owner: None, found: Vec::new() };
    module.items.iter().for_each(|item| collector.visit_item(item));
    collector.found
}

struct Collector<'a> {
    file: &'a str,
    owner: Option<String>,
    found: Vec<Function>,
}

impl Collector<'_> {
    fn add(&mut self, attributes: &[Attribute], signature: &Signature, block: Option<&Block>) {
        if is_test(attributes) {
            return;
        }
        let start = signature.span().start().line;
        let end = block.map_or_else(|| signature.span(), Spanned::span).end().line;
        let name = signature.ident.to_string();
        self.found.push(Function {
            file: self.file.to_owned(),
            line: start,
            name: self.owner.iter().cloned().chain([name]).collect::<Vec<_>>().join("::"),
            lines: end + 1 - start,
            tuples: tuples::in_signature(signature),
        });
    }

    fn inside(&mut self, owner: Option<String>, visit: impl FnOnce(&mut Self)) {
        let before = std::mem::replace(&mut self.owner, owner);
        visit(self);
        self.owner = before;
    }
}

impl<'ast> Visit<'ast> for Collector<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_test(attributes_of(item)) {
            return;
        }
        let owner = match item {
            Item::Impl(block) => type_name(&block.self_ty),
            Item::Trait(item) => Some(item.ident.to_string()),
            _ => None,
        };
        self.inside(owner, |collector| visit::visit_item(collector, item));
    }

    fn visit_item_fn(&mut self, function: &'ast ItemFn) {
        self.add(&function.attrs, &function.sig, Some(&function.block));
        visit::visit_item_fn(self, function);
    }

    fn visit_impl_item(&mut self, member: &'ast ImplItem) {
        if is_test(attributes_of_member(member)) {
            return;
        }
        if let ImplItem::Fn(function) = member {
            self.add(&function.attrs, &function.sig, Some(&function.block));
        }
        visit::visit_impl_item(self, member);
    }

    fn visit_trait_item(&mut self, member: &'ast TraitItem) {
        if is_test(attributes_of_trait_member(member)) {
            return;
        }
        if let TraitItem::Fn(function) = member {
            self.add(&function.attrs, &function.sig, function.default.as_ref());
        }
        visit::visit_trait_item(self, member);
    }
}

/// The last name of a type, none for one that has no name.
fn type_name(of: &Type) -> Option<String> {
    match of {
        Type::Path(path) => path.path.segments.last().map(|segment| segment.ident.to_string()),
        Type::Reference(reference) => type_name(&reference.elem),
        _ => None,
    }
}

#[cfg(test)]
pub(crate) fn of_text(text: &str) -> Vec<Function> {
    use crate::modules::targets::Target;
    let read = |path: &str| (path == "/lib.rs" || path == "lib.rs").then(|| text.to_owned());
    let target = Target { name: "light".to_owned(), root: "lib.rs".to_owned() };
    of_crate(&ModuleTree::read(&target, &read).unwrap())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_counted_from_the_signature_to_the_closing_brace() {
        let text = "/// Doc.\n#[inline]\npub fn f() {\n    g();\n}\n\
                    struct A;\nimpl A {\n    fn m(\n        &self,\n    ) {\n    }\n}\n\
                    trait B { fn n(&self); fn o() {\n} }\nimpl<T> B for Vec<T> { fn n(&self) {} }";
        let found: Vec<_> = of_text(text).into_iter().map(|f| (f.name, f.line, f.lines)).collect();
        let expected =
            [("f", 3, 3), ("A::m", 8, 4), ("B::n", 13, 1), ("B::o", 13, 2), ("Vec::n", 15, 1)];
        assert_eq!(found, expected.map(|(name, line, lines)| (name.to_owned(), line, lines)));
    }

    #[test]
    fn functions_inside_functions_are_found_and_those_of_tests_are_not() {
        let text = "fn f() { fn g() {} }\n#[cfg(test)]\nmod tests { fn h() {} }\n\
                    #[test]\nfn i() {}\nimpl A { #[cfg(test)] fn j() {} }";
        let found: Vec<_> = of_text(text).into_iter().map(|function| function.name).collect();
        assert_eq!(found, ["f", "g"]);
    }
}
