//! Glass of windows: measured sheets, combined to glazings that light goes straight through.
//!
//! A product file of the International Glazing and Shading Database (IGSDB) is read into a
//! [`GlazingProduct`] (`read.rs`, `json.rs`); [`Glazing`] puts several behind one another and says
//! what becomes of daylight at any angle (`sheet.rs`, `stack.rs`, `photopic.rs`).

mod json;
mod photopic;
mod product;
mod read;
mod sheet;
mod stack;

pub use product::{GlazingProduct, ParsedGlazing};
pub use read::read_glazing;
pub use sheet::SheetShares;
pub use stack::{Glazing, GlazingLayer};
