//! The names that a Rust file declares, tests included.

use serde::Deserialize;
use syn::visit::{self, Visit};
use syn::{Field, Ident, ImplItem, Item, PatIdent, Signature, TraitItem, UseRename, Variant};

/// What a name is declared as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A struct, an enum, a union, a trait, or another name of a type.
    Type,
    /// A function or a method.
    Function,
    /// A field with a name.
    Field,
    /// A variant of an enum.
    Variant,
    /// A module.
    Module,
    /// A constant or a static.
    Constant,
    /// An argument, or a variable of a pattern.
    Local,
}

/// A declared name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declaration {
    /// The name.
    pub name: String,
    /// What it is declared as.
    pub kind: Kind,
    /// Its line, from 1.
    pub line: usize,
}

/// The declarations of a Rust file, in the order of the syntax tree.
///
/// # Errors
/// When the text is not Rust.
pub fn of_file(text: &str) -> Result<Vec<Declaration>, String> {
    let file = syn::parse_file(text).map_err(|error| error.to_string())?;
    let mut collector = Collector { found: Vec::new() };
    collector.visit_file(&file);
    Ok(collector.found)
}

struct Collector {
    found: Vec<Declaration>,
}

impl Collector {
    fn add(&mut self, name: &Ident, kind: Kind) {
        let line = name.span().start().line;
        self.found.push(Declaration { name: name.to_string(), kind, line });
    }
}

impl<'ast> Visit<'ast> for Collector {
    fn visit_item(&mut self, item: &'ast Item) {
        match item {
            Item::Enum(item) => self.add(&item.ident, Kind::Type),
            Item::Struct(item) => self.add(&item.ident, Kind::Type),
            Item::Trait(item) => self.add(&item.ident, Kind::Type),
            Item::Type(item) => self.add(&item.ident, Kind::Type),
            Item::Union(item) => self.add(&item.ident, Kind::Type),
            Item::Mod(item) => self.add(&item.ident, Kind::Module),
            Item::Const(item) => self.add(&item.ident, Kind::Constant),
            Item::Static(item) => self.add(&item.ident, Kind::Constant),
            _ => {}
        }
        visit::visit_item(self, item);
    }

    fn visit_impl_item(&mut self, member: &'ast ImplItem) {
        match member {
            ImplItem::Const(member) => self.add(&member.ident, Kind::Constant),
            ImplItem::Type(member) => self.add(&member.ident, Kind::Type),
            _ => {}
        }
        visit::visit_impl_item(self, member);
    }

    fn visit_trait_item(&mut self, member: &'ast TraitItem) {
        match member {
            TraitItem::Const(member) => self.add(&member.ident, Kind::Constant),
            TraitItem::Type(member) => self.add(&member.ident, Kind::Type),
            _ => {}
        }
        visit::visit_trait_item(self, member);
    }

    fn visit_signature(&mut self, signature: &'ast Signature) {
        self.add(&signature.ident, Kind::Function);
        visit::visit_signature(self, signature);
    }

    fn visit_field(&mut self, field: &'ast Field) {
        if let Some(name) = &field.ident {
            self.add(name, Kind::Field);
        }
        visit::visit_field(self, field);
    }

    fn visit_variant(&mut self, variant: &'ast Variant) {
        self.add(&variant.ident, Kind::Variant);
        visit::visit_variant(self, variant);
    }

    fn visit_pat_ident(&mut self, pattern: &'ast PatIdent) {
        self.add(&pattern.ident, Kind::Local);
        visit::visit_pat_ident(self, pattern);
    }

    fn visit_use_rename(&mut self, import: &'ast UseRename) {
        self.add(&import.rename, Kind::Type);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_declaration_is_found_and_no_use() {
        let text = "use a::b as c;\nstruct D { e: F }\nenum G { H(I) }\nmod j { const K: L = 1; }\n\
                    trait M { fn n(o: P); type Q; }\nimpl M for D {\n fn n(o: P) {\n\
                    let (r, _) = s(|t| t.u());\n }\n}\nstatic V: X = W;";
        let found = of_file(text).unwrap();
        let told: Vec<_> = found.iter().map(|it| format!("{} {}", it.line, it.name)).collect();
        let expected = [
            "1 c", "2 D", "2 e", "3 G", "3 H", "4 j", "4 K", "5 M", "5 n", "5 o", "5 Q", "7 n",
            "7 o", "8 r", "8 t", "11 V",
        ];
        assert_eq!(told, expected);
        let kinds: Vec<_> = found.iter().map(|it| it.kind).take(8).collect();
        let (ty, constant) = (Kind::Type, Kind::Constant);
        let expected = [ty, ty, Kind::Field, ty, Kind::Variant, Kind::Module, constant, ty];
        assert_eq!(kinds, expected);
    }
}
