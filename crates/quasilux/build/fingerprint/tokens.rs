//! Token streams of the modules of a crate, without comments, documentation and tests.

use proc_macro2::{Spacing, TokenStream, TokenTree};
use quote::ToTokens;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use syn::{Expr, ExprLit, Item, ItemMod, Lit, Meta};

/// A source file.
#[derive(Debug)]
pub(crate) struct SourceFile {
    /// Where it is.
    pub(crate) path: PathBuf,
    /// Its tokens, one a line.
    pub(crate) tokens: String,
}

/// A module file that is to be read, and the folder of its children.
struct Pending {
    path: PathBuf,
    children: PathBuf,
}

/// The file at the root of a crate and those of all modules below it, but for modules with
/// `#[cfg(test)]`.
///
/// # Errors
/// When a file is missing or no Rust.
pub(crate) fn modules(root: &Path) -> Result<Vec<SourceFile>, Box<dyn Error>> {
    let folder = root.parent().unwrap_or(Path::new(""));
    let mut open = vec![Pending { path: root.to_owned(), children: folder.to_owned() }];
    let mut files = Vec::new();
    while let Some(Pending { path, children }) = open.pop() {
        let told = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let text = fs::read_to_string(&path).map_err(|error| told(&error))?;
        let mut file = syn::parse_file(&text).map_err(|error| told(&error))?;
        remove_tests(&mut file.items);
        declared(&file.items, &path, &children, &mut open).map_err(|error| told(&error))?;
        let mut tokens = String::new();
        write(file.into_token_stream(), &mut tokens);
        files.push(SourceFile { path, tokens });
    }
    Ok(files)
}

/// Removes items with `#[cfg(test)]` from a module, from the modules in it, and from its `impl`
/// blocks and traits.
fn remove_tests(items: &mut Vec<Item>) {
    items.retain(|item| !is_test(item));
    for item in items {
        match item {
            Item::Mod(ItemMod { content: Some((_, items)), .. }) => remove_tests(items),
            Item::Impl(block) => block.items.retain(|item| !is_test(item)),
            Item::Trait(block) => block.items.retain(|item| !is_test(item)),
            _ => {}
        }
    }
}

/// Whether one of the attributes before an item is `#[cfg(test)]` or `#[cfg(all(test, ...))]`.
fn is_test(item: &impl ToTokens) -> bool {
    let mut tokens = item.to_token_stream().into_iter();
    while let (Some(TokenTree::Punct(sign)), Some(TokenTree::Group(group))) =
        (tokens.next(), tokens.next())
    {
        if sign.as_char() != '#' {
            return false;
        }
        let text = group.stream().to_string().replace(' ', "");
        if text == "cfg(test)" || text.starts_with("cfg(all(test,") {
            return true;
        }
    }
    false
}

/// Adds the files of the modules that the module in the file `path` declares.
fn declared(
    items: &[Item],
    path: &Path,
    children: &Path,
    open: &mut Vec<Pending>,
) -> Result<(), String> {
    for item in items {
        let Item::Mod(module) = item else {
            continue;
        };
        let name = module.ident.to_string();
        let folder = children.join(&name);
        match (&module.content, given_path(module)) {
            (Some((_, items)), _) => declared(items, path, &folder, open)?,
            (None, Some(given)) => {
                let file = path.with_file_name(given);
                let children = file.parent().unwrap_or(Path::new("")).to_owned();
                open.push(Pending { path: file, children });
            }
            (None, None) => {
                let candidates = [children.join(format!("{name}.rs")), folder.join("mod.rs")];
                let file = candidates.into_iter().find(|file| file.is_file());
                let file = file.ok_or(format!("no file of the module {name}"))?;
                open.push(Pending { path: file, children: folder });
            }
        }
    }
    Ok(())
}

/// The file that `#[path = "..."]` gives.
fn given_path(module: &ItemMod) -> Option<String> {
    module.attrs.iter().find_map(|attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("path") => match &pair.value {
            Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    })
}

/// Writes tokens, one a line, without `#[doc = "..."]`, which comments of documentation become.
fn write(tokens: TokenStream, into: &mut String) {
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        match token {
            TokenTree::Punct(sign) => {
                let inner = tokens.next_if(|next| {
                    sign.as_char() == '#'
                        && matches!(next, TokenTree::Punct(next) if next.as_char() == '!')
                });
                let documents = |next: &TokenTree| sign.as_char() == '#' && is_documentation(next);
                if tokens.next_if(documents).is_some() {
                    continue;
                }
                into.push(sign.as_char());
                if inner.is_some() {
                    into.push('!');
                }
                // Where two signs are one operator.
                if sign.spacing() == Spacing::Alone {
                    into.push('\n');
                }
            }
            TokenTree::Group(group) => {
                into.push_str(&format!("{:?}\n", group.delimiter()));
                write(group.stream(), into);
                into.push_str("end\n");
            }
            TokenTree::Ident(_) | TokenTree::Literal(_) => {
                into.push_str(&token.to_string());
                into.push('\n');
            }
        }
    }
}

/// Whether it is the group of an attribute `doc`.
fn is_documentation(token: &TokenTree) -> bool {
    let TokenTree::Group(group) = token else {
        return false;
    };
    let mut inside = group.stream().into_iter();
    matches!(inside.next(), Some(TokenTree::Ident(name)) if name == "doc")
        && matches!(inside.next(), Some(TokenTree::Punct(sign)) if sign.as_char() == '=')
}
