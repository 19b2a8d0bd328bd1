//! GLDF containers: what is chosen, how bright it is, what is told, and what is refused.

mod archives;
mod corpus;
mod findings;
mod fluxes;
mod mutations;
mod selections;

use crate::container::{Zip, photometries, product};
use quasilux_photometry::{
    ContainerWarning, GldfChoice, GldfLuminaire, WarningKind, read_gldf, read_ies, read_ldt,
};

/// A choice by `variant=..`, `emitter=..`, `light_source=..`, `channel=..`, `emergency`.
fn choice(words: &[&str]) -> GldfChoice {
    let mut choice = GldfChoice::default();
    for word in words {
        let (key, value) = word.split_once('=').unwrap_or((word, ""));
        let value = Some(value.to_owned());
        match key {
            "variant" => choice.variant = value,
            "emitter" => choice.emitter = value,
            "light_source" => choice.light_source = value,
            "channel" => choice.channel = value,
            "emergency" => choice.emergency = true,
            other => panic!("{other}"),
        }
    }
    choice
}

fn read(bytes: &[u8], words: &[&str]) -> GldfLuminaire {
    read_gldf(bytes, &choice(words)).unwrap_or_else(|error| panic!("{words:?}: {error}"))
}

fn refused(bytes: &[u8], words: &[&str]) -> String {
    let error = read_gldf(bytes, &choice(words)).expect_err("a refusal").to_string();
    assert!(!error.contains('\n') && error.len() < 1500, "{error}");
    error
}

/// The kinds of all warnings, in their order.
fn kinds(read: &GldfLuminaire) -> Vec<WarningKind> {
    read.warnings.iter().map(|told| told.warning.kind()).collect()
}

fn only(warnings: &[ContainerWarning], kind: WarningKind) -> String {
    let mut found = warnings.iter().filter(|told| told.warning.kind() == kind);
    let first = found.next().unwrap_or_else(|| panic!("no {kind:?} in {warnings:?}"));
    assert!(found.next().is_none(), "{warnings:?}");
    format!("{}:{}", first.part, first.warning)
}

/// A container with `a.ldt` and `b.ies` and these definitions beside them.
fn container(definitions: &str, variants: &str) -> Vec<u8> {
    let definitions = photometries(&["a.ldt", "b.ies"]) + definitions;
    Zip::default()
        .file("product.xml", product(&definitions, variants).as_bytes())
        .file("ldc/a.ldt", crate::container::ldt(1, 1000.0).as_bytes())
        .file("ldc/b.ies", crate::container::ies(2, 500.0).as_bytes())
        .finish()
}

fn ldt_flux_lm(count: i32, flux_lm: f64) -> f64 {
    read_ldt(crate::container::ldt(count, flux_lm).as_bytes()).unwrap().photometry.flux_lm()
}

fn ies_flux_lm(lamps: u32, lumens: f64) -> f64 {
    read_ies(crate::container::ies(lamps, lumens).as_bytes()).unwrap().photometry.flux_lm()
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-9 * b.abs().max(1.0), "{a} is not {b}");
}
