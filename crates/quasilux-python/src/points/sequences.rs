//! A randomised sequence as a class of Python: what the engines of `quasilux.qmc` share.

use super::columns::Columns;
use super::rows::Part;
use super::sobol::{DIMENSIONS, Sobol};
use numpy::{PyReadwriteArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use quasilux_sampling::{ParseNameError, PointSet, Randomization, Sequence};

/// The name of a randomization of Sobol' that is none of [`Randomization`].
const LINEAR: &str = "linear";

/// A randomised sequence of some dimensions.
#[pyclass(name = "PointSet", module = "quasilux._native", frozen)]
pub(super) struct PyPointSet {
    arguments: Arguments,
    points: Points,
}

/// What makes a point set.
#[derive(Clone, IntoPyObject)]
struct Arguments(String, String, u64, usize);

enum Points {
    /// In the order of Gray's code, without copies of dimensions.
    Sobol(Box<Sobol>),
    /// In the order of their indices.
    Other(Columns),
}

#[pymethods]
impl PyPointSet {
    #[new]
    fn new(sequence: &str, randomization: &str, key: u64, dimensions: usize) -> PyResult<Self> {
        let arguments = Arguments(sequence.into(), randomization.into(), key, dimensions);
        let sequence: Sequence = sequence.parse().map_err(unknown)?;
        let is_sobol = sequence == Sequence::Sobol;
        if is_sobol && dimensions > DIMENSIONS {
            return Err(PyValueError::new_err(format!("more than {DIMENSIONS} dimensions")));
        }
        let points = if is_sobol && randomization == LINEAR {
            let points = PointSet::new(sequence, Randomization::DigitalShift, key);
            Points::Sobol(Box::new(Sobol::with_linear_scrambling(dimensions, points, key)))
        } else {
            let randomization: Randomization = randomization.parse().map_err(unknown)?;
            let points = PointSet::new(sequence, randomization, key);
            if is_sobol {
                Points::Sobol(Box::new(Sobol::new(dimensions, points)))
            } else {
                Points::Other(Columns { dimensions, points })
            }
        };
        Ok(Self { arguments, points })
    }

    /// For pickles and copies.
    fn __getnewargs__(&self) -> Arguments {
        self.arguments.clone()
    }

    /// Writes the points from `first_index` on into the rows of an array.
    fn fill(
        &self,
        py: Python<'_>,
        mut points: PyReadwriteArray2<'_, f64>,
        first_index: u64,
        workers: usize,
    ) -> PyResult<()> {
        let Arguments(.., dimensions) = self.arguments;
        if points.shape()[1] != dimensions {
            return Err(PyValueError::new_err(format!("not {dimensions} columns")));
        }
        let part = Part { first_index, points: points.as_slice_mut()? };
        py.detach(|| match &self.points {
            Points::Sobol(sobol) => part.fill(&**sobol, dimensions, workers),
            Points::Other(columns) => part.fill(columns, dimensions, workers),
        });
        Ok(())
    }
}

fn unknown(error: ParseNameError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
