//! The command line inside the wheel.

use pyo3::prelude::*;
use std::ffi::OsString;

/// Adds the function to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(command_line, module)?)
}

/// Does what a command line asks for, the program's name first, and returns its exit code.
#[pyfunction]
fn command_line(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| quasilux::command_line(words).code())
}
