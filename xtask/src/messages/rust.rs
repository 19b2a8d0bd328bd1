//! The texts for people in Rust: literals of more than a word, those of `#[error(..)]`, of macros
//! that format, and the help of the command line, which is the documentation of its options.
//!
//! What panics say, reasons of lints, other documentation, and all that tests alone compile is left
//! out.

use super::is_text;
use crate::modules::tests_left_out::{attributes_of, attributes_of_member, is_test};
use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{
    Attribute, Expr, ExprMethodCall, Field, ImplItem, Item, Lit, LitStr, Macro, Meta, Variant,
};

/// Macros whose texts are for those who mend a defect.
const OF_DEFECTS: [&str; 10] = [
    "assert",
    "assert_eq",
    "assert_ne",
    "debug_assert",
    "debug_assert_eq",
    "debug_assert_ne",
    "panic",
    "unreachable",
    "todo",
    "unimplemented",
];

/// Macros whose literals are printed.
const OF_MESSAGES: [&str; 8] =
    ["format", "format_args", "write", "writeln", "print", "println", "eprint", "eprintln"];

/// Derives of clap.
const OF_OPTIONS: [&str; 4] = ["Parser", "Args", "Subcommand", "ValueEnum"];

/// The texts of some items, in their order.
#[must_use]
pub fn of_items(items: &[Item]) -> Vec<String> {
    let mut collector = Collector { has_options: false, found: Vec::new() };
    items.iter().for_each(|item| collector.visit_item(item));
    collector.found
}

struct Collector {
    /// Whether the item is part of the command line.
    has_options: bool,
    found: Vec<String>,
}

impl Collector {
    fn add(&mut self, text: &str, is_message: bool) {
        if is_text(text, is_message) {
            self.found.push(text.to_owned());
        }
    }

    /// All literals among some tokens, but for what `expect` says.
    fn add_tokens(&mut self, tokens: TokenStream, is_message: bool) {
        let mut before = String::new();
        for token in tokens {
            match &token {
                TokenTree::Group(_) if before == "expect" || is_of_defects(&before) => {}
                TokenTree::Group(group) => self.add_tokens(group.stream(), is_message),
                TokenTree::Literal(literal) => {
                    if let Lit::Str(literal) = Lit::new(literal.clone()) {
                        self.add(&literal.value(), is_message);
                    }
                }
                TokenTree::Ident(_) | TokenTree::Punct(_) => {}
            }
            match token {
                TokenTree::Ident(name) => before = name.to_string(),
                TokenTree::Punct(punct) if punct.as_char() == '!' => {}
                _ => before.clear(),
            }
        }
    }

    /// The documentation of an option, which is its help.
    fn add_help(&mut self, attributes: &[Attribute]) {
        let lines = attributes.iter().filter_map(documentation);
        let lines: Vec<String> = lines.map(|line| line.trim().to_owned()).collect();
        for paragraph in lines.split(String::is_empty).filter(|lines| !lines.is_empty()) {
            self.found.push(paragraph.join(" "));
        }
    }
}

fn is_of_defects(name: &str) -> bool {
    OF_DEFECTS.contains(&name)
}

/// The line of documentation that an attribute is.
fn documentation(attribute: &Attribute) -> Option<String> {
    let Meta::NameValue(pair) = &attribute.meta else { return None };
    let Expr::Lit(value) = &pair.value else { return None };
    match &value.lit {
        Lit::Str(line) if pair.path.is_ident("doc") => Some(line.value()),
        _ => None,
    }
}

/// Whether an item derives one of the traits of clap.
fn derives_options(attributes: &[Attribute]) -> bool {
    let derives = attributes.iter().filter_map(|attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("derive") => Some(list.tokens.clone()),
        _ => None,
    });
    derives.flatten().any(|token| match token {
        TokenTree::Ident(name) => OF_OPTIONS.iter().any(|option| name == option),
        _ => false,
    })
}

impl<'ast> Visit<'ast> for Collector {
    fn visit_item(&mut self, item: &'ast Item) {
        let attributes = attributes_of(item);
        if is_test(attributes) {
            return;
        }
        let around = std::mem::replace(&mut self.has_options, derives_options(attributes));
        if self.has_options {
            self.add_help(attributes);
        }
        visit::visit_item(self, item);
        self.has_options = around;
    }

    fn visit_impl_item(&mut self, member: &'ast ImplItem) {
        if !is_test(attributes_of_member(member)) {
            visit::visit_impl_item(self, member);
        }
    }

    fn visit_field(&mut self, field: &'ast Field) {
        if self.has_options {
            self.add_help(&field.attrs);
        }
        visit::visit_field(self, field);
    }

    fn visit_variant(&mut self, variant: &'ast Variant) {
        if self.has_options {
            self.add_help(&variant.attrs);
        }
        visit::visit_variant(self, variant);
    }

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        let Meta::List(list) = &attribute.meta else { return };
        let is_error = list.path.is_ident("error");
        if is_error || ["arg", "command", "value"].iter().any(|name| list.path.is_ident(name)) {
            self.add_tokens(list.tokens.clone(), is_error);
        }
    }

    fn visit_macro(&mut self, call: &'ast Macro) {
        let name = call.path.segments.last().map(|segment| segment.ident.to_string());
        let name = name.unwrap_or_default();
        if !is_of_defects(&name) {
            self.add_tokens(call.tokens.clone(), OF_MESSAGES.contains(&name.as_str()));
        }
    }

    fn visit_expr_method_call(&mut self, call: &'ast ExprMethodCall) {
        if call.method == "expect" {
            self.visit_expr(&call.receiver);
        } else {
            visit::visit_expr_method_call(self, call);
        }
    }

    fn visit_lit_str(&mut self, literal: &'ast LitStr) {
        self.add(&literal.value(), false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<String> {
        of_items(&syn::parse_file(text).unwrap().items)
    }

    #[test]
    fn errors_formats_literals_and_help_are_collected_in_their_order() {
        let text = r#"
            /// No text.
            #[derive(Debug, thiserror::Error)]
            enum Error {
                /// No text.
                #[error("no {0} here", what.unwrap_or("a thing"))]
                Missing(String),
            }
            /// About the program.
            #[derive(Debug, Args)]
            struct Options {
                /// First line
                /// and second
                ///
                /// Then more
                #[arg(long, value_name = "FILE", help = "Other help")]
                file: String,
            }
            fn f() {
                eprintln!("stopped: {error}");
                let cure = if a { "Move it up" } else { "Turn it round" };
                finding.add(Check::A, format!("{} stands there", name(vec!["two words"])), cure);
                writeln!(out, "in {x}").expect("strings grow always");
            }
        "#;
        let expected = [
            "no {0} here",
            "a thing",
            "About the program.",
            "First line and second",
            "Then more",
            "Other help",
            "stopped: {error}",
            "Move it up",
            "Turn it round",
            "{} stands there",
            "two words",
            "in {x}",
        ];
        assert_eq!(found(text), expected);
    }

    #[test]
    fn defects_reasons_documentation_and_tests_are_left_out() {
        let text = r#"
            //! Of no user.
            #[expect(dead_code, reason = "of no user")]
            #[serde(rename = "of no user")]
            fn f() {
                assert!(a, "of no user {x}");
                let a = b.expect("of no user");
                let c = format!("{}", d.expect("of no user"));
                let e = vec![panic!("of no user")];
                unreachable!("of no user");
            }
            #[cfg(test)]
            fn g() { println!("of no user"); }
            impl A {
                #[test]
                fn h() { println!("of no user"); }
            }
        "#;
        assert_eq!(found(text), [""; 0]);
    }
}
