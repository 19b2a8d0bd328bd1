//! The results of a run as arrays and files.

use crate::arrays::read_only;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use quasilux::embedded::{self, Finished, Project, Stopped};
use quasilux_report::{CameraReport, CertifiedFigure, SensorReport, Style, json, number, table};
use quasilux_scene::{Grid, Quantity};
use quasilux_transport::{Estimates, Pixel, PointStatus, SensorEstimates};
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;

/// Adds the class and functions to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Outcome>()?;
    module.add_function(wrap_pyfunction!(figure_text, module)?)
}

/// The bounds of a sensor's points; no numbers where the estimator has none.
pub(crate) fn unseen_lx(estimates: &Estimates, sensor: usize) -> Vec<f64> {
    let SensorEstimates { unseen, direct_lx, .. } = &estimates.sensors[sensor];
    match unseen {
        Some(unseen) => unseen.point_lx.clone(),
        None => vec![f64::NAN; direct_lx.len()],
    }
}

/// A finished run.
#[pyclass(frozen, module = "quasilux._native")]
pub(crate) struct Outcome {
    project: Arc<Project>,
    finished: Finished,
}

impl Outcome {
    pub(crate) fn new(project: Arc<Project>, finished: Finished) -> Self {
        Self { project, finished }
    }

    fn sensor(&self, index: usize) -> &SensorReport {
        &self.finished.report.sensors[index]
    }
}

#[pymethods]
impl Outcome {
    /// The result document, as it stands in `result.json`.
    fn document(&self, py: Python<'_>) -> String {
        py.detach(|| json::json(&self.finished.report))
    }

    /// All settings of the run as a document in JSON.
    fn settings(&self) -> String {
        json::text(&self.finished.report.run.settings)
    }

    /// The rectangle of each sensor as a document in JSON; `null` where it is no grid.
    fn grids(&self) -> String {
        let sensors = self.finished.report.sensors.iter();
        json::text(
            &sensors.map(|sensor| sensor.grid.as_ref().map(GridEntry::new)).collect::<Vec<_>>(),
        )
    }

    /// The table of the terminal.
    fn table(&self) -> String {
        table::table(&self.finished.report, Style::Plain)
    }

    /// Why the run ended before its tolerance, if it did.
    #[getter]
    fn stopped(&self) -> Option<&'static str> {
        if self.finished.report.run.tolerance_reached {
            return None;
        }
        Some(match self.finished.stopped {
            Some(Stopped::Time) => "time",
            Some(Stopped::Listener) => "callback",
            Some(Stopped::Interrupt) => "interrupt",
            None => "limit",
        })
    }

    /// What nobody was told while the run went.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.finished.remarks.clone()
    }

    /// The arrays of a sensor, by name: those of a grid have rows along its second edge.
    fn sensor_arrays<'py>(&self, py: Python<'py>, index: usize) -> PyResult<Bound<'py, PyDict>> {
        let sensor = self.sensor(index);
        let shape = shape(sensor);
        let vectors = [&shape[..], &[3]].concat();
        let points = || sensor.points.iter();
        let arrays = PyDict::new(py);
        let put = |name: &str, values: Vec<f64>, shape: &[usize]| {
            arrays.set_item(name, read_only(py, values, shape))
        };
        let or_nan = |x: Option<f64>| x.unwrap_or(f64::NAN);
        let lx = points().map(|point| or_nan(point.illuminance_lx.value));
        put("illuminance_lx", lx.collect(), &shape)?;
        let lx = points().map(|point| or_nan(point.illuminance_lx.half_width));
        put("half_width_lx", lx.collect(), &shape)?;
        put("direct_lx", points().map(|point| or_nan(point.direct_lx)).collect(), &shape)?;
        put("unseen_lx", unseen_lx(&self.finished.estimates, index), &shape)?;
        let certified = |limit: fn(CertifiedFigure) -> f64| -> Vec<f64> {
            points().map(|point| point.certified_lx.map_or(f64::NAN, limit)).collect()
        };
        put("certified_lower_lx", certified(|it| it.lower), &shape)?;
        put("certified_upper_lx", certified(|it| it.upper.unwrap_or(f64::INFINITY)), &shape)?;
        let lx = points().map(|point| or_nan(point.unseen.merged_lx));
        put("merged_lx", lx.collect(), &shape)?;
        let radii_m = points().map(|point| or_nan(point.unseen.disc_radius_m));
        put("disc_radius_m", radii_m.collect(), &shape)?;
        let positions_m = points().flat_map(|point| point.position_m.to_array());
        put("positions_m", positions_m.collect(), &vectors)?;
        let normals = points().flat_map(|point| point.normal.to_array());
        put("normals", normals.collect(), &vectors)?;
        let rows = &self.finished.estimates.sensors[index].replicate_lx;
        put("replicates_lx", rows.concat(), &[&[rows.len()], &shape[..]].concat())?;
        let samples = points().map(|point| point.samples).collect();
        arrays.set_item("samples", read_only(py, samples, &shape))?;
        Ok(arrays)
    }

    /// What each point of a sensor waits for, or that it is done; `None` without a tolerance.
    fn statuses(&self, index: usize) -> Option<Vec<&'static str>> {
        let points = self.sensor(index).points.iter();
        points.map(|point| point.status.map(PointStatus::name)).collect()
    }

    /// The arrays of a camera, by name, rows from the top; `None` where there is no picture.
    fn camera_arrays<'py>(
        &self,
        py: Python<'py>,
        index: usize,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let camera: &CameraReport = &self.finished.report.cameras[index];
        if camera.pixels.is_empty() {
            return Ok(None);
        }
        let [columns, rows] = camera.resolution.map(|edge| edge as usize);
        let arrays = PyDict::new(py);
        let put = |name: &str, value: &dyn Fn(&Pixel) -> f32| {
            let values: Vec<f32> = camera.pixels.iter().map(value).collect();
            arrays.set_item(name, read_only(py, values, &[rows, columns]))
        };
        put("luminance_cd_m2", &|pixel| pixel.luminance_cd_m2)?;
        put("half_width_cd_m2", &|pixel| pixel.half_width_cd_m2.unwrap_or(f32::NAN))?;
        put("unseen_cd_m2", &|pixel| pixel.unseen_cd_m2.unwrap_or(f32::NAN))?;
        let rgb: Vec<f32> = camera.pixels.iter().flat_map(|pixel| pixel.rgb_cd_m2).collect();
        arrays.set_item("rgb_cd_m2", read_only(py, rgb, &[rows, columns, 3]))?;
        Ok(Some(arrays))
    }

    /// Writes the files of `quasilux run` to a folder.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        py.detach(|| embedded::write(&folder, &self.project, &self.finished))
            .map_err(|error| pyo3::exceptions::PyOSError::new_err(error.to_string()))
    }

    /// The names of these files.
    fn file_names(&self) -> Vec<String> {
        embedded::files(&self.project, &self.finished).map(|file| file.name).collect()
    }

    /// One of these files.
    fn file<'py>(&self, py: Python<'py>, name: &str) -> Option<Bound<'py, PyBytes>> {
        let render = || {
            let mut files = embedded::files(&self.project, &self.finished);
            files.find(|file| file.name == name).map(|file| (file.render)())
        };
        py.detach(render).map(|bytes| PyBytes::new(py, &bytes))
    }
}

/// The rectangle of a grid.
#[derive(Serialize)]
struct GridEntry {
    origin_m: [f64; 3],
    u_m: [f64; 3],
    v_m: [f64; 3],
    counts: [u32; 2],
    quantity: &'static str,
    target_lx: Option<f64>,
}

impl GridEntry {
    fn new(grid: &Grid) -> Self {
        Self {
            origin_m: grid.origin.to_array(),
            u_m: grid.u.to_array(),
            v_m: grid.v.to_array(),
            counts: grid.counts,
            quantity: match grid.quantity {
                Quantity::Centre => "centre",
                Quantity::Mean => "mean",
            },
            target_lx: grid.target_lx,
        }
    }
}

/// Rows and columns of a grid, or a number of points.
fn shape(sensor: &SensorReport) -> Vec<usize> {
    match &sensor.grid {
        Some(grid) => grid.counts.iter().rev().map(|&count| count as usize).collect(),
        None => vec![sensor.points.len()],
    }
}

/// A value with its half-width, as many digits as it has.
#[pyfunction]
fn figure_text(value: Option<f64>, half_width: Option<f64>) -> String {
    number::figure_text(quasilux_report::Figure { value, half_width }).joined()
}
