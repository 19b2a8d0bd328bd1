//! Tests of the crate from outside: files, closed forms, sampling.

mod analysis;
mod closed_forms;
#[path = "../container/mod.rs"]
mod container;
mod corpus;
mod flux_causes;
mod fluxes;
mod format_pages;
mod gldf;
mod goodness;
mod ldt;
mod ldt_corpus;
mod photometric_types;
mod poles;
mod published;
mod quadrature;
mod reader;
mod sampling;
mod shapes;
mod silhouettes;
mod tables;
mod tilt;
mod tm33;
mod tm33_corpus;
mod writing;
