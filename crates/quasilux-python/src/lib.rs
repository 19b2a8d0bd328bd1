//! The native half of the Python package `quasilux`; `python/quasilux/` is the other one, and the
//! one that users see.
//!
//! Here are conversions between Python's and numpy's objects and those of the crates, and nothing
//! that computes light.

mod arrays;
mod blocks;
mod bsdf;
mod command_line;
mod drawing;
mod error;
mod following;
mod options;
mod outcome;
mod photometry;
mod points;
mod progress;
mod scene;
mod simulation;
mod sky;
mod year;

use pyo3::prelude::*;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    error::register(module)?;
    command_line::register(module)?;
    points::register(module)?;
    photometry::register(module)?;
    bsdf::register(module)?;
    scene::register(module)?;
    drawing::register(module)?;
    outcome::register(module)?;
    progress::register(module)?;
    simulation::register(module)?;
    sky::register(module)?;
    year::register(module)?;
    blocks::register(module)
}
