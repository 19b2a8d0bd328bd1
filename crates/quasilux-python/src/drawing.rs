//! The false colours of pictures.

use crate::arrays::read_only;
use numpy::{PyArrayDyn, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use quasilux_drawing::picture::{Cell, FalseColourScale, false_colours};

/// Adds the functions to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(false_colour_map, module)?)?;
    module.add_function(wrap_pyfunction!(false_colour_scale, module)?)?;
    module.add_function(wrap_pyfunction!(luminance_scale, module)?)
}

/// Red, green and blue of this many colours from the lowest value to the highest, in [0, 1].
#[pyfunction]
fn false_colour_map(py: Python<'_>, count: usize) -> Bound<'_, PyArrayDyn<f64>> {
    let colours = false_colours(count);
    let channels = colours.as_flattened().iter().map(|channel| f64::from(*channel) / 255.0);
    read_only(py, channels.collect(), &[count, 3])
}

/// A scale of colours.
#[derive(IntoPyObject)]
struct ScaleEntry {
    low: f64,
    high: f64,
    is_logarithmic: bool,
    levels: Vec<f64>,
    labels: Vec<String>,
}

impl From<FalseColourScale> for ScaleEntry {
    fn from(scale: FalseColourScale) -> Self {
        Self {
            low: scale.low,
            high: scale.high,
            is_logarithmic: scale.is_logarithmic,
            levels: scale.levels.iter().map(|level| level.value).collect(),
            labels: scale.levels.into_iter().map(|level| level.label).collect(),
        }
    }
}

/// The scale of values with half-widths, not a number where there are none.
#[pyfunction]
fn false_colour_scale(
    values: PyReadonlyArrayDyn<'_, f64>,
    half_widths: PyReadonlyArrayDyn<'_, f64>,
) -> ScaleEntry {
    let known = |x: &f64| Some(*x).filter(|x| x.is_finite());
    let (values, half_widths) = (values.as_array(), half_widths.as_array());
    let cells = values.iter().zip(half_widths.iter());
    let cells: Vec<Cell> = cells
        .map(|(value, half_width)| Cell { value: known(value), half_width: known(half_width) })
        .collect();
    FalseColourScale::from_cells(&cells).into()
}

/// The scale of a camera's luminances in cd/m2.
#[pyfunction]
fn luminance_scale(luminances_cd_m2: PyReadonlyArrayDyn<'_, f32>) -> ScaleEntry {
    let luminances: Vec<f32> = luminances_cd_m2.as_array().iter().copied().collect();
    FalseColourScale::from_luminances(&luminances).into()
}
