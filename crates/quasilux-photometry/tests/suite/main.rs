//! Tests of the crate from outside: files, closed forms, sampling.

mod closed_forms;
mod corpus;
mod format_pages;
mod ldt;
mod ldt_corpus;
mod mutation;
mod photometric_types;
mod reader;
mod sampling;
mod tables;
mod writing;
