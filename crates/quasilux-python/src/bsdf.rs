//! Measured surfaces: what their files say, scattering and samples as arrays, figures, diagrams.

mod diagram;
mod entries;

use crate::error::{at_place, input_error};
use crate::photometry::arrays::{NumberArray, Numbers, per_pair, per_row, unit};
use crate::photometry::diagram::DrawingHandle;
use crate::photometry::entries::WarningEntry;
use entries::{BsdfFactsEntry, EnergyEntry, ReciprocityEntry, TableEntry};
use glam::DVec3;
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use quasilux_bsdf::{Distribution, MeasuredBsdf, ScatteringMode, Side, luminance, read_bsdf_named};
use quasilux_photometry::Angles;
use quasilux_scene::FileKind;

/// Adds what is here to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("MAX_BSDF_BYTES", FileKind::Bsdf.max_bytes())?;
    module.add_class::<Surface>()?;
    module.add_function(wrap_pyfunction!(bsdf_directions, module)?)?;
    module.add_function(wrap_pyfunction!(read_bsdf, module)?)
}

/// A measured surface.
#[pyclass(frozen, module = "quasilux._native")]
struct Surface {
    bsdf: MeasuredBsdf,
    warnings: Vec<WarningEntry>,
}

/// Which of the tables of a surface is meant.
#[derive(FromPyObject)]
struct Which(String, String);

/// Reads a file that messages call `file`.
#[pyfunction]
fn read_bsdf(py: Python<'_>, data: PyBackedBytes, file: &str) -> PyResult<Surface> {
    let read = py
        .detach(|| read_bsdf_named(file, &data))
        .map_err(|error| at_place(py, file, Some(error.position()), &error.message()))?;
    let warnings = read.warnings.iter().map(|warning| WarningEntry::new(file, warning)).collect();
    Ok(Surface { bsdf: read.bsdf, warnings })
}

impl Surface {
    /// `None` where the side scatters nothing in that mode.
    fn table(&self, which: &Which) -> PyResult<Option<&Distribution>> {
        let Which(side, mode) = which;
        let side: Side = side.parse().map_err(input_error)?;
        let mode: ScatteringMode = mode.parse().map_err(input_error)?;
        Ok(self.bsdf.scattering(side, mode))
    }
}

#[pymethods]
impl Surface {
    fn facts(&self) -> BsdfFactsEntry {
        BsdfFactsEntry::new(self.bsdf.facts())
    }

    fn warnings(&self) -> Vec<WarningEntry> {
        self.warnings.clone()
    }

    fn tables<'py>(&self, py: Python<'py>) -> Vec<TableEntry<'py>> {
        self.bsdf.distributions().map(|entry| TableEntry::new(py, entry)).collect()
    }

    fn energy(&self) -> Vec<EnergyEntry> {
        self.bsdf.analysis().energy.iter().map(EnergyEntry::new).collect()
    }

    fn reciprocity(&self) -> Vec<ReciprocityEntry> {
        self.bsdf.analysis().reciprocity.iter().map(ReciprocityEntry::new).collect()
    }

    /// Three channels for each direction: 0 below the side, NaN where there is no direction.
    fn albedo_rgb<'py>(
        &self,
        py: Python<'py>,
        which: Which,
        wi: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        let table = self.table(&which)?;
        per_row(py, &wi, |wi| unit(wi).map(|wi| albedo(table, wi)))
    }

    /// The luminance of [`Self::albedo_rgb`].
    fn albedo<'py>(
        &self,
        py: Python<'py>,
        which: Which,
        wi: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        let table = self.table(&which)?;
        per_row(py, &wi, |wi| unit(wi).map(|wi| [luminance(albedo(table, wi))]))
    }

    /// Three channels for each pair of directions.
    fn evaluate_rgb<'py>(
        &self,
        py: Python<'py>,
        which: Which,
        wi: Numbers<'py>,
        wo: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        let table = self.table(&which)?;
        per_pair(py, &wi, &wo, |wi, wo| {
            let (wi, wo) = (unit(wi)?, unit(wo)?);
            Some(table.map_or([0.0; 3], |table| table.evaluate(wi, wo)))
        })
    }

    /// The luminance of [`Self::evaluate_rgb`].
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        which: Which,
        wi: Numbers<'py>,
        wo: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        let table = self.table(&which)?;
        per_pair(py, &wi, &wo, |wi, wo| {
            let (wi, wo) = (unit(wi)?, unit(wo)?);
            Some([table.map_or(0.0, |table| luminance(table.evaluate(wi, wo)))])
        })
    }

    fn pdf_sr<'py>(
        &self,
        py: Python<'py>,
        which: Which,
        wi: Numbers<'py>,
        wo: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        let table = self.table(&which)?;
        per_pair(py, &wi, &wo, |wi, wo| {
            let (wi, wo) = (unit(wi)?, unit(wo)?);
            Some([table.map_or(0.0, |table| table.pdf_sr(wi, wo))])
        })
    }

    /// NaN where nothing is scattered.
    fn sample<'py>(
        &self,
        py: Python<'py>,
        which: Which,
        wi: Numbers<'py>,
        u: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        let table = self.table(&which)?;
        per_pair(py, &wi, &u, |wi, u| {
            let wi = unit(wi).filter(|wi| wi.z >= 0.0)?;
            Some(table?.sample(wi, u)?.wo.to_array())
        })
    }

    /// NaN where the density is zero.
    fn invert<'py>(
        &self,
        py: Python<'py>,
        which: Which,
        wi: Numbers<'py>,
        wo: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        let table = self.table(&which)?;
        per_pair(py, &wi, &wo, |wi, wo| table?.invert(unit(wi)?, unit(wo)?))
    }

    fn diagram(&self, py: Python<'_>, title: &str, incidences_deg: Vec<[f64; 2]>) -> DrawingHandle {
        DrawingHandle(py.detach(|| diagram::draw(&self.bsdf, title, &incidences_deg)))
    }

    /// The lobe of light on a side from one direction: an angle in degrees and f times the cosine,
    /// in turn.
    fn lobe<'py>(
        &self,
        py: Python<'py>,
        side: &str,
        incidence_deg: [f64; 2],
    ) -> PyResult<NumberArray<'py>> {
        let side: Side = side.parse().map_err(input_error)?;
        let points = py.detach(|| diagram::lobe_points(&self.bsdf, side, incidence_deg));
        Ok(points.into_flattened().into_pyarray(py))
    }
}

fn albedo(table: Option<&Distribution>, wi: DVec3) -> [f64; 3] {
    match table {
        Some(table) if wi.z >= 0.0 => table.albedo(wi),
        _ => [0.0; 3],
    }
}

/// The unit direction at a polar angle and an azimuth in degrees.
fn direction([theta_deg, phi_deg]: [f64; 2]) -> DVec3 {
    let angles = Angles { theta_rad: theta_deg.to_radians(), phi_rad: phi_deg.to_radians() };
    angles.direction()
}

/// The same on the side of the surface: rounding must not lead below it.
fn incidence(angles_deg: [f64; 2]) -> DVec3 {
    let direction = direction(angles_deg);
    DVec3::new(direction.x, direction.y, direction.z.max(0.0))
}

/// Three numbers for each pair of a polar angle and an azimuth in degrees; NaN where one is not
/// finite.
#[pyfunction]
fn bsdf_directions<'py>(
    py: Python<'py>,
    theta_deg: Numbers<'py>,
    phi_deg: Numbers<'py>,
) -> PyResult<NumberArray<'py>> {
    per_pair(py, &theta_deg, &phi_deg, |[theta_deg], [phi_deg]| {
        let are_angles = theta_deg.is_finite() && phi_deg.is_finite();
        are_angles.then(|| direction([theta_deg, phi_deg]).to_array())
    })
}
