//! What is wrong with a user's files and numbers, as exceptions of Python.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyType;
use quasilux::embedded::CliError;
use quasilux_text::Position;

pyo3::create_exception!(
    quasilux,
    InputError,
    PyValueError,
    "A file or a value that cannot be used.\n\n\
     Attributes: `file` (str or None), `line` and `column` (int, counted from 1, or None) and\n\
     `message` (str), which says what was found and what was expected."
);

/// Adds the exceptions to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let kind: Bound<'_, PyType> = module.py().get_type::<InputError>();
    // What an exception has that Python code raised with a text alone.
    for name in ["file", "line", "column"] {
        kind.setattr(name, module.py().None())?;
    }
    kind.setattr("message", "")?;
    module.add("InputError", kind)
}

/// An error without a place.
pub(crate) fn input_error(message: impl ToString) -> PyErr {
    let message = message.to_string();
    Python::attach(|py| with_parts(py, None, None, &message))
}

/// An error at a place in a file.
pub(crate) fn at_place(
    py: Python<'_>,
    file: &str,
    place: Option<Position>,
    message: &str,
) -> PyErr {
    with_parts(py, Some(file), place, message)
}

/// An error of the command line, with the names that options have in Python.
pub(crate) fn from_command_line(error: &CliError) -> PyErr {
    let message = in_python(error.message());
    Python::attach(|py| with_parts(py, error.file(), error.place(), &message))
}

fn with_parts(py: Python<'_>, file: Option<&str>, place: Option<Position>, message: &str) -> PyErr {
    let text = match (file, place) {
        (Some(file), Some(place)) => format!("{file}:{place}: {message}"),
        (Some(file), None) => format!("{file}: {message}"),
        (None, _) => message.to_owned(),
    };
    let error = InputError::new_err(text);
    let value = error.value(py);
    let put = || -> PyResult<()> {
        value.setattr("file", file)?;
        value.setattr("line", place.map(|place| place.line))?;
        value.setattr("column", place.map(|place| place.column))?;
        value.setattr("message", message)
    };
    match put() {
        Ok(()) => error,
        Err(error) => error,
    }
}

/// Options of the command line that are parameters of another name.
const RENAMED: [[&str; 2]; 5] = [
    ["--abs-tol", "abs_tol_lx"],
    ["--altitude and --azimuth", "sun_deg"],
    ["--occupied", "occupied_h"],
    ["--time", "time_s"],
    ["--checkpoint-every", "checkpoint_every_s"],
];
/// The others, which have underscores instead of dashes.
const OPTIONS: [&str; 12] = [
    "--rel-tol",
    "--unseen-tol",
    "--tolerance-on",
    "--interval",
    "--confidence",
    "--samples",
    "--rays",
    "--estimator",
    "--sequence",
    "--seed",
    "--threads",
    "--checkpoint",
];

/// A message that speaks of parameters where the command line speaks of options.
fn in_python(message: &str) -> String {
    let mut text = message.to_owned();
    for [option, parameter] in RENAMED {
        text = text.replace(option, parameter);
    }
    for option in OPTIONS {
        text = text.replace(option, &option[2..].replace('-', "_"));
    }
    text
}
