//! Directions and coordinates in numpy's arrays.
//!
//! The Python half hands over contiguous arrays with one axis, rows of two or three numbers one
//! after the other, and gives results their shapes. Arrays are read where they lie, and results
//! are moved, not copied. Everything is computed while other threads of Python run.

use crate::error::input_error;
use glam::DVec3;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

/// Numbers that Python handed over.
pub(crate) type Numbers<'py> = PyReadonlyArray1<'py, f64>;

/// Numbers that Python gets.
pub(crate) type NumberArray<'py> = Bound<'py, PyArray1<f64>>;

/// The rows of an array.
pub(crate) fn rows<'a, const WIDTH: usize>(
    numbers: &'a Numbers<'_>,
) -> PyResult<&'a [[f64; WIDTH]]> {
    let (rows, rest) = numbers.as_slice()?.as_chunks();
    if rest.is_empty() {
        return Ok(rows);
    }
    Err(input_error(format!("found {} numbers; expected rows of {WIDTH}", numbers.len()?)))
}

/// The unit vector along a vector of any length; `None` along one that is zero or not finite.
pub(crate) fn unit(row: [f64; 3]) -> Option<DVec3> {
    let direction = DVec3::from_array(row);
    if (direction.length_squared() - 1.0).abs() <= 4.0 * f64::EPSILON {
        return Some(direction);
    }
    let largest = direction.abs().max_element();
    if !(direction.is_finite() && largest > 0.0) {
        return None;
    }
    // The squares of what is scaled neither overflow nor vanish.
    let scaled = direction / largest;
    Some(scaled / scaled.length())
}

/// One number for each direction; NaN where there is none.
pub(crate) fn per_direction<'py>(
    py: Python<'py>,
    directions: &Numbers<'py>,
    value: impl Fn(DVec3) -> f64 + Sync,
) -> PyResult<NumberArray<'py>> {
    let rows = rows(directions)?;
    let of_row = |row: &[f64; 3]| unit(*row).map_or(f64::NAN, &value);
    let values: Vec<f64> = py.detach(|| rows.iter().map(of_row).collect());
    Ok(values.into_pyarray(py))
}

/// A row of numbers for each row; NaN where there is none.
pub(crate) fn per_row<'py, const FROM: usize, const TO: usize>(
    py: Python<'py>,
    numbers: &Numbers<'py>,
    value: impl Fn([f64; FROM]) -> Option<[f64; TO]> + Sync,
) -> PyResult<NumberArray<'py>> {
    let rows = rows(numbers)?;
    let of_row = |row: &[f64; FROM]| value(*row).unwrap_or([f64::NAN; TO]);
    let values: Vec<[f64; TO]> = py.detach(|| rows.iter().map(of_row).collect());
    Ok(values.into_flattened().into_pyarray(py))
}

/// A row of numbers for each pair of rows, NaN where there is none. Of two arrays of different
/// lengths one has a single row, which goes with every one of the other.
pub(crate) fn per_pair<'py, const A: usize, const B: usize, const TO: usize>(
    py: Python<'py>,
    first: &Numbers<'py>,
    second: &Numbers<'py>,
    value: impl Fn([f64; A], [f64; B]) -> Option<[f64; TO]> + Sync,
) -> PyResult<NumberArray<'py>> {
    let (first, second) = (rows(first)?, rows(second)?);
    let count = if first.len() == 1 { second.len() } else { first.len() };
    if second.len() != count && second.len() != 1 {
        let message = format!("found {} and {} rows; expected as many", first.len(), second.len());
        return Err(input_error(message));
    }
    let of_pair = |index: usize| {
        let a = if first.len() == 1 { first[0] } else { first[index] };
        let b = if second.len() == 1 { second[0] } else { second[index] };
        value(a, b).unwrap_or([f64::NAN; TO])
    };
    let values: Vec<[f64; TO]> = py.detach(|| (0..count).map(of_pair).collect());
    Ok(values.into_flattened().into_pyarray(py))
}
