//! Point sets and measures of their quality, as arrays: what `quasilux.qmc` stands on.

mod columns;
mod measures;
mod rows;
mod sequences;
mod sobol;

use pyo3::prelude::*;

/// Adds the class and the functions to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    measures::register(module)?;
    module.add_class::<sequences::PyPointSet>()?;
    module.add("SOBOL_DIMENSIONS", sobol::DIMENSIONS)
}
