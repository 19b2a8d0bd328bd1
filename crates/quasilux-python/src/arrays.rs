//! Values of Rust as arrays of numpy.

use numpy::ndarray::{ArrayD, IxDyn};
use numpy::{Element, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;

/// A read-only array of these values, which are moved into it.
pub(crate) fn read_only<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> Bound<'py, PyArrayDyn<T>> {
    let values = ArrayD::from_shape_vec(IxDyn(shape), values).expect("as many as the shape has");
    let array = PyArrayDyn::from_owned_array(py, values);
    array.readwrite().make_nonwriteable();
    array
}
