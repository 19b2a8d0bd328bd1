//! Discrepancies of points in arrays, exchanges that lower them, and normal numbers.

use numpy::{PyReadonlyArray2, PyReadwriteArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use quasilux_sampling::quality::{
    DiscrepancyTerms, Exchange, L2Measure, PointsView, change_by_exchange, discrepancy_terms,
};
use quasilux_sampling::warp::sample_normal;
use std::ops::Range;
use std::thread;

/// The sums over this many points are made as one, whoever makes them: results do not depend on the
/// number of threads.
const BLOCK: usize = 256;

/// Adds the functions to the module.
pub(super) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(discrepancy, module)?)?;
    module.add_function(wrap_pyfunction!(exchange_change, module)?)?;
    module.add_function(wrap_pyfunction!(exchange_coordinates, module)?)?;
    module.add_function(wrap_pyfunction!(to_normal, module)?)
}

/// A discrepancy by SciPy's name of its method: the root for `L2-star`, squares for the others.
///
/// With `iterative` the means are over one point more than there are.
#[pyfunction]
fn discrepancy(
    py: Python<'_>,
    sample: PyReadonlyArray2<'_, f64>,
    method: &str,
    iterative: bool,
    workers: usize,
) -> PyResult<f64> {
    let measure = match method {
        "CD" => L2Measure::Centred,
        "WD" => L2Measure::WrapAround,
        "MD" => L2Measure::Mixture,
        "L2-star" => L2Measure::Star,
        _ => return Err(PyValueError::new_err(format!("unknown discrepancy \"{method}\""))),
    };
    let points = view(sample.as_slice()?, sample.shape()[1])?;
    let mut terms = py.detach(|| sum_of_terms(points, measure, workers));
    let missing = usize::from(iterative);
    if iterative && measure == L2Measure::WrapAround {
        // Its integral over one point is the same for all points, for the missing one too.
        terms.single += terms.whole;
    }
    let squared = terms.squared_discrepancy(points.count() + missing);
    Ok(if measure == L2Measure::Star { squared.max(0.0).sqrt() } else { squared })
}

/// The change of the squared centred discrepancy where two points exchange a coordinate.
#[pyfunction]
fn exchange_change(
    sample: PyReadonlyArray2<'_, f64>,
    first: usize,
    second: usize,
    dimension: usize,
) -> PyResult<f64> {
    let points = view(sample.as_slice()?, sample.shape()[1])?;
    let exchange = Exchange { points: [first, second], dimension };
    check(exchange, points)?;
    Ok(change_by_exchange(points, L2Measure::Centred, exchange))
}

/// Exchanges coordinates of points where it lowers the centred discrepancy.
///
/// `exchanges` has the numbers of a dimension and of two points in each row. Ends after the last of
/// them, or after `patience` of them that followed each other in vain.
#[pyfunction]
fn exchange_coordinates(
    py: Python<'_>,
    mut sample: PyReadwriteArray2<'_, f64>,
    exchanges: PyReadonlyArray2<'_, u64>,
    patience: usize,
) -> PyResult<()> {
    let dimensions = sample.shape()[1];
    let coordinates = sample.as_slice_mut()?;
    let exchanges = exchanges.as_slice()?;
    py.detach(|| {
        let mut in_vain = 0;
        for row in exchanges.as_chunks::<3>().0 {
            let [dimension, first, second] = row.map(|number| number as usize);
            let exchange = Exchange { points: [first, second], dimension };
            let points = view(coordinates, dimensions)?;
            check(exchange, points)?;
            if change_by_exchange(points, L2Measure::Centred, exchange) < 0.0 {
                let [a, b] = exchange.points.map(|point| point * dimensions + dimension);
                coordinates.swap(a, b);
                in_vain = 0;
            } else {
                in_vain += 1;
            }
            if in_vain == patience {
                break;
            }
        }
        Ok(())
    })
}

/// Replaces numbers that are uniform on [0, 1) by standard normal ones, by inversion.
#[pyfunction]
fn to_normal(py: Python<'_>, mut numbers: PyReadwriteArray2<'_, f64>) -> PyResult<()> {
    let numbers = numbers.as_slice_mut()?;
    py.detach(|| numbers.iter_mut().for_each(|number| *number = sample_normal(*number)));
    Ok(())
}

fn view(coordinates: &[f64], dimensions: usize) -> PyResult<PointsView<'_>> {
    PointsView::new(coordinates, dimensions)
        .ok_or_else(|| PyValueError::new_err("expected at least one point of the unit cube"))
}

fn check(exchange: Exchange, points: PointsView<'_>) -> PyResult<()> {
    let there_are = exchange.points.iter().all(|point| *point < points.count());
    if there_are && exchange.dimension < points.dimensions() {
        return Ok(());
    }
    Err(PyValueError::new_err(format!("there is no coordinate for {exchange:?}")))
}

/// The sums over all points, the blocks dealt out to the threads in turn: later ones take longer.
fn sum_of_terms(points: PointsView<'_>, measure: L2Measure, workers: usize) -> DiscrepancyTerms {
    let count = points.count();
    let blocks: Vec<Range<usize>> =
        (0..count).step_by(BLOCK).map(|start| start..count.min(start + BLOCK)).collect();
    let workers = workers.clamp(1, blocks.len());
    let own = |worker: usize| -> Vec<DiscrepancyTerms> {
        let ranges = blocks.iter().skip(worker).step_by(workers).cloned();
        ranges.map(|range| discrepancy_terms(points, measure, range)).collect()
    };
    let by_worker: Vec<Vec<DiscrepancyTerms>> = thread::scope(|scope| {
        let others: Vec<_> = (1..workers).map(|worker| scope.spawn(move || own(worker))).collect();
        let first = own(0);
        let joined = others.into_iter().map(|other| other.join().expect("sums do not panic"));
        std::iter::once(first).chain(joined).collect()
    });
    let of_block = |block: usize| by_worker[block % workers][block / workers];
    (1..blocks.len()).map(of_block).fold(of_block(0), |sum, terms| DiscrepancyTerms {
        single: sum.single + terms.single,
        pairs: sum.pairs + terms.pairs,
        ..sum
    })
}
