//! What shines from outside, and where the sun is.

use crate::error::{from_command_line, input_error};
use crate::photometry::arrays::{NumberArray, Numbers, per_row, rows};
use crate::photometry::diagram::DrawingHandle;
use crate::scene::Scene;
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use quasilux::embedded::{CieSky, OutsideSky};
use quasilux_scene::FileKind;
use quasilux_sky::{LocalTime, Site, SkyPoint, SolarPosition};

/// Adds the class and functions to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("MAX_WEATHER_BYTES", FileKind::Weather.max_bytes())?;
    module.add_class::<Sky>()?;
    module.add_function(wrap_pyfunction!(check_site, module)?)?;
    module.add_function(wrap_pyfunction!(sun_positions, module)?)?;
    module.add_function(wrap_pyfunction!(solar_day, module)?)
}

/// A sky, with the sun where its disk shines.
#[pyclass(frozen, module = "quasilux._native")]
struct Sky {
    outside: OutsideSky,
}

#[pymethods]
impl Sky {
    #[staticmethod]
    fn of_scene(scene: &Bound<'_, Scene>) -> PyResult<Self> {
        Self::new(OutsideSky::of_project(&scene.get().project))
    }

    /// Of the bytes of a weather file, and a time as text.
    #[staticmethod]
    fn of_weather(py: Python<'_>, file: &str, data: PyBackedBytes, time: &str) -> PyResult<Self> {
        let time: LocalTime = time.parse().map_err(input_error)?;
        Self::new(py.detach(|| OutsideSky::of_weather(file, &data, &time)))
    }

    /// A CIE sky by its number, altitude and azimuth of its sun in degrees, and what it gives.
    #[staticmethod]
    fn cie(number: u8, sun: Option<[f64; 2]>, lx: f64) -> PyResult<Self> {
        let sun = sun.map(|[altitude_deg, azimuth_deg]| SkyPoint { altitude_deg, azimuth_deg });
        Self::new(OutsideSky::cie(CieSky { number, sun, lx, site: None }))
    }

    /// The document of the command line.
    fn document(&self) -> String {
        self.outside.document()
    }

    /// Text that the command line prints.
    fn text(&self) -> String {
        self.outside.text()
    }

    /// Its luminances in false colours.
    fn drawing(&self, py: Python<'_>) -> DrawingHandle {
        DrawingHandle(py.detach(|| self.outside.drawing()))
    }

    /// The luminance in each direction: rows of altitude and azimuth in degrees.
    fn luminance_cd_m2<'py>(
        &self,
        py: Python<'py>,
        directions_deg: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        per_row(py, &directions_deg, |[altitude_deg, azimuth_deg]: [f64; 2]| {
            let point = SkyPoint { altitude_deg, azimuth_deg };
            let is_direction = altitude_deg.abs() <= 90.0 && azimuth_deg.is_finite();
            is_direction.then(|| [self.outside.luminance_cd_m2(point)])
        })
    }
}

impl Sky {
    fn new(outside: Result<OutsideSky, quasilux::embedded::CliError>) -> PyResult<Self> {
        Ok(Self { outside: outside.map_err(|error| from_command_line(&error))? })
    }
}

/// Degrees north and east, and the hours that the clock is ahead of Greenwich.
fn site([latitude_deg, longitude_deg, time_zone_h]: [f64; 3]) -> PyResult<Site> {
    Site::new(latitude_deg, longitude_deg, time_zone_h).map_err(input_error)
}

/// Refuses what is no site.
#[pyfunction]
fn check_site(place: [f64; 3]) -> PyResult<()> {
    site(place).map(|_| ())
}

/// Altitude and azimuth of the sun in degrees at each time: rows of year, month, day and seconds
/// from midnight.
#[pyfunction]
fn sun_positions<'py>(
    py: Python<'py>,
    place: [f64; 3],
    times: Numbers<'py>,
) -> PyResult<NumberArray<'py>> {
    let site = site(place)?;
    let at = |&[year, month, day, seconds]: &[f64; 4]| {
        let time = LocalTime::new(year as i32, month as u32, day as u32, seconds)?;
        site.sun_at(&time).map(|sun| [sun.altitude_deg, sun.azimuth_deg])
    };
    let rows = rows(&times)?;
    let found: Result<Vec<[f64; 2]>, _> = py.detach(|| rows.iter().map(at).collect());
    Ok(found.map_err(input_error)?.into_flattened().into_pyarray(py))
}

/// The way of the sun on a day.
#[derive(IntoPyObject)]
struct DayEntry {
    /// From when to when it is up, in h from midnight.
    up_h: Vec<[f64; 2]>,
    /// When it is highest, in h from midnight.
    highest_h: f64,
    /// Its altitude and azimuth then.
    highest_deg: [f64; 2],
}

/// When the sun is up on a day, and how high it rises.
#[pyfunction]
fn solar_day(place: [f64; 3], year: i32, month: u32, day: u32) -> PyResult<DayEntry> {
    let day = site(place)?.solar_day(year, month, day).map_err(input_error)?;
    let SolarPosition { time, sun } = day.highest;
    Ok(DayEntry {
        up_h: day.up_s.iter().map(|span| span.map(|seconds| seconds / 3600.0)).collect(),
        highest_h: time.seconds() / 3600.0,
        highest_deg: [sun.altitude_deg, sun.azimuth_deg],
    })
}
