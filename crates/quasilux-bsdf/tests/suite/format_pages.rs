//! The pages of the formats name every kind of warning.

use std::path::Path;

/// The variants of an enum, from its source.
fn variants<'s>(source: &'s str, name: &str) -> Vec<&'s str> {
    let (_, body) = source.split_once(&format!("pub enum {name} {{\n")).unwrap();
    let (body, _) = body.split_once("\n}").unwrap();
    let lines = body.lines().map(str::trim);
    lines.filter(|line| !line.starts_with("//")).map(|line| line.trim_end_matches(',')).collect()
}

/// Variants without a row, or a mention with a row elsewhere: `[`Name`]: crate::...`.
fn missing<'s>(variants: &[&'s str], pages: &str) -> Vec<&'s str> {
    let is_named =
        |name: &&&str| pages.contains(&format!("[`{name}`]: crate::WarningKind::{name}\n"));
    variants.iter().filter(|name| !is_named(name)).copied().collect()
}

#[test]
fn every_kind_of_warning_stands_on_a_page() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let kinds = std::fs::read_to_string(source.join("warning.rs")).unwrap();
    let pages: String = std::fs::read_dir(source.join("formats"))
        .unwrap()
        .map(|entry| std::fs::read_to_string(entry.unwrap().path()).unwrap())
        .collect();
    let variants = variants(&kinds, "WarningKind");
    assert!(variants.len() > 20 && variants.contains(&"Resampled"));
    let missing_here = missing(&variants, &pages);
    assert!(missing_here.is_empty(), "not on a page in src/formats/: {missing_here:?}");
    // A page that has lost a row is found out.
    let lost = pages.replace("[`Foreword`]: crate::WarningKind::Foreword\n", "");
    assert_eq!(missing(&variants, &lost), ["Foreword"]);
}
