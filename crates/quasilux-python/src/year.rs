//! Years: begun, and their results as files and arrays.

use crate::arrays::read_only;
use crate::error::from_command_line;
use crate::following::{Failure, follow};
use crate::options::YearOptions;
use crate::progress::{Line, YearReporter};
use crate::scene::Scene;
use numpy::Element;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use quasilux::embedded::{self, FinishedYear, YearOrder};
use quasilux_report::annual::{Calendar, GroupOfYear, Interval};
use quasilux_sky::WeatherSky;
use std::sync::Arc;

/// Adds the function to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(annual, module)?)
}

/// A year that is over, or was stopped.
#[derive(IntoPyObject)]
struct YearEntry<'py> {
    table: String,
    /// The bytes of all files, by name.
    files: Bound<'py, PyDict>,
    /// Arrays over the intervals of the weather file.
    intervals: Bound<'py, PyDict>,
    blinds: Vec<BlindsEntry<'py>>,
}

/// Where a group of blinds is.
#[derive(IntoPyObject)]
struct BlindsEntry<'py> {
    name: String,
    positions: Vec<String>,
    /// The number of its position, by interval; -1 without light.
    position: Bound<'py, PyAny>,
}

/// Simulates a year. `callback` gets every
/// [`YearProgress`](crate::progress::YearProgress) and says whether to stop.
#[pyfunction]
#[pyo3(signature = (scene, options, callback=None))]
fn annual<'py>(
    py: Python<'py>,
    scene: &Bound<'py, Scene>,
    options: YearOptions,
    callback: Option<Py<PyAny>>,
) -> PyResult<YearEntry<'py>> {
    let project = Arc::clone(&scene.get().project);
    let order = YearOrder::new(&options.into()).map_err(|error| from_command_line(&error))?;
    let year = follow(py, callback, move |line: Line| {
        let reporter = YearReporter::new(line);
        let listener = |share: f64| reporter.tell(share);
        embedded::annual(&project, &order, Some(&listener)).map_err(Failure::Refused)
    })?;
    YearEntry::new(py, year)
}

impl<'py> YearEntry<'py> {
    fn new(py: Python<'py>, year: FinishedYear) -> PyResult<Self> {
        let FinishedYear { files: contents, table, calendar, blinds, .. } = year;
        let files = PyDict::new(py);
        for file in contents {
            files.set_item(file.name, PyBytes::new(py, &file.content))?;
        }
        let groups = blinds.map(|blinds| blinds.groups).unwrap_or_default();
        let blinds = groups.into_iter().map(|group| BlindsEntry::new(py, group, &calendar));
        let blinds = blinds.collect();
        Ok(Self { table, files, intervals: intervals(py, &calendar)?, blinds })
    }
}

impl<'py> BlindsEntry<'py> {
    fn new(py: Python<'py>, group: GroupOfYear, calendar: &Calendar) -> Self {
        let of = |sky: Option<usize>| sky.map_or(-1, |sky| group.by_hour[sky] as i64);
        let position = column(py, calendar, |interval| of(interval.sky));
        Self { name: group.name, positions: group.positions, position }
    }
}

/// When intervals are, what counts them, and what shines in them; not a number without light.
fn intervals<'py>(py: Python<'py>, calendar: &Calendar) -> PyResult<Bound<'py, PyDict>> {
    let arrays = PyDict::new(py);
    arrays.set_item("month", column(py, calendar, |it| it.month))?;
    arrays.set_item("day", column(py, calendar, |it| it.day))?;
    arrays.set_item("middle_h", column(py, calendar, |it| it.middle_h))?;
    arrays.set_item("is_known", column(py, calendar, |it| it.is_known))?;
    arrays.set_item("is_occupied", column(py, calendar, |it| it.is_occupied))?;
    arrays.set_item("is_daylit", column(py, calendar, |it| it.is_daylit))?;
    let put = |name: &str, value: fn(&WeatherSky) -> f64| {
        let of = |it: &Interval| it.sky.map_or(f64::NAN, |sky| value(&calendar.skies[sky]));
        arrays.set_item(name, column(py, calendar, of))
    };
    put("sun_altitude_deg", |sky| sky.sun.altitude_deg)?;
    put("sun_azimuth_deg", |sky| sky.sun.azimuth_deg)?;
    put("sky_horizontal_lx", |sky| sky.sky.horizontal_illuminance_lx())?;
    put("sun_normal_lx", |sky| sky.sun_normal_illuminance_lx)?;
    Ok(arrays)
}

/// A number for each interval.
fn column<'py, T: Element>(
    py: Python<'py>,
    calendar: &Calendar,
    value: impl Fn(&Interval) -> T,
) -> Bound<'py, PyAny> {
    let values: Vec<T> = calendar.intervals.iter().map(value).collect();
    let shape = [values.len()];
    read_only(py, values, &shape).into_any()
}
