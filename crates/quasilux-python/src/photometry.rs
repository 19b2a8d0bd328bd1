//! Luminaire files: what they say, intensities and samples as arrays, other formats, diagrams.

mod analysis;
pub(crate) mod arrays;
pub(crate) mod diagram;
pub(crate) mod entries;
mod own;

use crate::error::{at_place, input_error};
use analysis::{AnalysisEntry, GridEntry, PlaneEntry, radians, symmetry_name};
use arrays::{NumberArray, Numbers, per_direction, per_pair, per_row, unit};
use diagram::{DrawingHandle, LuminaireDiagram};
use entries::{FactsEntry, NoteEntry, ShapeEntry, WarningEntry};
use own::{OwnFacts, OwnGrid};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::PyBytes;
use quasilux_drawing::diagram::Diagram;
use quasilux_photometry::analysis::{LuminaireAngles, ZonalFlux};
use quasilux_photometry::{
    Analysis, Angles, Encoded, Format, IesStandard, PhotometricType, Photometry, Standard, Tilt,
    TiltSupport, WarningKind, is_gldf, read_tilt, write_ies, write_ldt,
};
use quasilux_scene::FileKind;
use quasilux_text::Position;
use std::sync::OnceLock;

/// Adds what is here to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("MAX_PHOTOMETRY_BYTES", FileKind::Photometry.max_bytes())?;
    module.add("MAX_TILT_BYTES", FileKind::Tilt.max_bytes())?;
    module.add_class::<Luminaire>()?;
    module.add_class::<DrawingHandle>()?;
    module.add_function(wrap_pyfunction!(read_photometry, module)?)?;
    module.add_function(wrap_pyfunction!(photometry_from_intensities, module)?)
}

/// A luminaire, of a file or of a user's own numbers.
#[pyclass(frozen, module = "quasilux._native")]
struct Luminaire {
    photometry: Photometry,
    /// `None` where there was no file.
    format: Option<Format>,
    /// The format that the file's name promises, where its content is of another one.
    misnamed: Option<Format>,
    warnings: Vec<WarningEntry>,
    analysis: OnceLock<Analysis>,
}

/// The light of a tilted luminaire.
#[derive(IntoPyObject)]
struct TiltFactorEntry {
    factor: f64,
    angle_deg: f64,
    support: &'static str,
}

/// A file that was written.
#[derive(IntoPyObject)]
struct EncodedEntry<'py> {
    data: Bound<'py, PyBytes>,
    notes: Vec<NoteEntry>,
}

/// Reads a file that messages call `file`, in a format, or in the one that its content or its name
/// shows.
#[pyfunction]
fn read_photometry(
    py: Python<'_>,
    data: PyBackedBytes,
    file: &str,
    format: Option<&str>,
) -> PyResult<Luminaire> {
    if is_gldf(file, &data) {
        let message = "found a GLDF container; expected a photometric file: name the container in \
                       the luminaires of a scene, or make a file of one of its lights by \
                       `quasilux photometry --convert`";
        return Err(at_place(py, file, None, message));
    }
    let given: Option<Format> = format.map(|name| name.parse().map_err(input_error)).transpose()?;
    let Some(format) = given.or_else(|| py.detach(|| Format::from_file(file, &data))) else {
        let message = "found no line TILT= and no numbers in lines 3 to 7; expected a luminaire \
                       file, LM-63, EULUMDAT or TM-33";
        return Err(at_place(py, file, Some(Position { line: 1, column: 1 }), message));
    };
    let read = py
        .detach(|| format.read(&data))
        .map_err(|error| at_place(py, file, Some(error.position()), &error.message()))?;
    Ok(Luminaire {
        photometry: read.photometry,
        format: Some(format),
        misnamed: format.misnamed(file),
        warnings: read.warnings.iter().map(|warning| WarningEntry::new(file, warning)).collect(),
        analysis: OnceLock::new(),
    })
}

/// A luminaire of type C from `c_deg.len() * gamma_deg.len()` intensities, plane by plane.
#[pyfunction]
fn photometry_from_intensities(
    c_deg: Numbers<'_>,
    gamma_deg: Numbers<'_>,
    intensity_cd: Numbers<'_>,
    facts: OwnFacts,
) -> PyResult<Luminaire> {
    let grid = OwnGrid {
        c_deg: c_deg.as_slice()?,
        gamma_deg: gamma_deg.as_slice()?,
        intensity_cd: intensity_cd.as_slice()?,
    };
    Ok(Luminaire {
        photometry: own::luminaire(&grid, facts)?,
        format: None,
        misnamed: None,
        warnings: vec![],
        analysis: OnceLock::new(),
    })
}

impl Luminaire {
    fn figures(&self, py: Python<'_>) -> &Analysis {
        py.detach(|| self.analysis.get_or_init(|| Analysis::new(&self.photometry)))
    }
}

#[pymethods]
impl Luminaire {
    // What the file says, and figures.

    #[getter]
    fn format(&self) -> Option<&'static str> {
        self.format.map(Format::name)
    }

    #[getter]
    fn misnamed(&self) -> Option<&'static str> {
        self.misnamed.map(Format::name)
    }

    #[getter]
    fn photometric_type(&self) -> &'static str {
        self.photometry.facts().photometric_type.name()
    }

    #[getter]
    fn symmetry(&self) -> &'static str {
        symmetry_name(self.photometry.table().symmetry())
    }

    #[getter]
    fn flux_lm(&self) -> f64 {
        self.photometry.flux_lm()
    }

    #[getter]
    fn maximum_cd(&self) -> f64 {
        self.photometry.table().maximum().value
    }

    fn warnings(&self) -> Vec<WarningEntry> {
        self.warnings.clone()
    }

    fn facts(&self) -> FactsEntry {
        FactsEntry::new(self.photometry.facts())
    }

    fn analysis(&self, py: Python<'_>) -> AnalysisEntry {
        AnalysisEntry::new(&self.photometry, self.figures(py))
    }

    fn plane<'py>(&self, py: Python<'py>, c_deg: f64) -> PlaneEntry<'py> {
        PlaneEntry::new(py, &self.photometry, c_deg)
    }

    fn grid<'py>(&self, py: Python<'py>, unfolded: bool) -> GridEntry<'py> {
        GridEntry::new(py, &self.photometry, unfolded)
    }

    fn shape(&self) -> ShapeEntry {
        ShapeEntry::new(&self.photometry.facts().shape())
    }

    /// The luminaire with the tilt factors of another file, and without the warning that they are
    /// missing.
    fn with_tilt(&self, py: Python<'_>, data: PyBackedBytes, file: &str) -> PyResult<Self> {
        let read = py
            .detach(|| read_tilt(&data))
            .map_err(|error| at_place(py, file, Some(error.position()), &error.message()))?;
        let missing = format!("{:?}", WarningKind::TiltFile);
        let own = self.warnings.iter().filter(|warning| !warning.is_of(&missing)).cloned();
        let further = read.warnings.iter().map(|warning| WarningEntry::new(file, warning));
        Ok(Self {
            photometry: self.photometry.clone().with_tilt(read.tilt),
            format: self.format,
            misnamed: self.misnamed,
            warnings: own.chain(further).collect(),
            analysis: OnceLock::new(),
        })
    }

    fn tilt_factor(&self, down: [f64; 3]) -> PyResult<TiltFactorEntry> {
        let Some(down) = unit(down) else {
            return Err(input_error("down has no direction; expected a vector of finite length"));
        };
        let tilt = self.photometry.tilt_factor(down);
        let support = match tilt.support {
            TiltSupport::Listed => "listed",
            TiltSupport::EndHeld => "end held",
            TiltSupport::OtherAxis => "other axis",
            TiltSupport::NotRead => "not read",
        };
        let angle_deg = analysis::degrees(tilt.angle_rad);
        Ok(TiltFactorEntry { factor: tilt.factor, angle_deg, support })
    }

    // Arrays.

    fn intensity_cd<'py>(
        &self,
        py: Python<'py>,
        directions: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        per_direction(py, &directions, |direction| self.photometry.intensity_cd(direction))
    }

    /// NaN where gamma is not within 0 to 180 degrees.
    fn intensity_at_cd<'py>(
        &self,
        py: Python<'py>,
        c_deg: Numbers<'py>,
        gamma_deg: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        let table = self.photometry.table();
        let kind = self.photometry.facts().photometric_type;
        let intensity_cd = |c_rad: f64, gamma_rad: f64| match kind {
            PhotometricType::C => table.value_at(Angles { theta_rad: gamma_rad, phi_rad: c_rad }),
            // H of type A counts the other way around the same poles.
            PhotometricType::A => table.value_at(Angles { theta_rad: gamma_rad, phi_rad: -c_rad }),
            PhotometricType::B => {
                self.photometry.intensity_cd(LuminaireAngles { c_rad, gamma_rad }.direction())
            }
        };
        per_pair(py, &c_deg, &gamma_deg, |[c_deg], [gamma_deg]| {
            let is_angle = c_deg.is_finite() && (0.0..=180.0).contains(&gamma_deg);
            is_angle.then(|| [intensity_cd(radians(c_deg), radians(gamma_deg))])
        })
    }

    fn pdf_sr<'py>(&self, py: Python<'py>, directions: Numbers<'py>) -> PyResult<NumberArray<'py>> {
        per_direction(py, &directions, |direction| self.photometry.pdf_sr(direction))
    }

    fn sample<'py>(&self, py: Python<'py>, u: Numbers<'py>) -> PyResult<NumberArray<'py>> {
        per_row(py, &u, |u| self.photometry.sample_direction(u).map(|wo| wo.to_array()))
    }

    fn invert<'py>(&self, py: Python<'py>, directions: Numbers<'py>) -> PyResult<NumberArray<'py>> {
        per_row(py, &directions, |row| unit(row).map(|wo| self.photometry.invert(wo)))
    }

    /// NaN where gamma is not within 0 to 180 degrees.
    fn flux_below_lm<'py>(
        &self,
        py: Python<'py>,
        gamma_deg: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        let zones = py.detach(|| ZonalFlux::new(&self.photometry));
        per_row(py, &gamma_deg, |[gamma_deg]| {
            let is_angle = (0.0..=180.0).contains(&gamma_deg);
            is_angle.then(|| [zones.below_lm(radians(gamma_deg))])
        })
    }

    fn projected_area_m2<'py>(
        &self,
        py: Python<'py>,
        directions: Numbers<'py>,
    ) -> PyResult<NumberArray<'py>> {
        let shape = self.photometry.facts().shape();
        per_direction(py, &directions, |direction| shape.projected_area_m2(direction))
    }

    // Files and drawings.

    /// In an edition, or in that of the luminaire: 2019 stays 2019, and all others become 2002.
    fn to_ies<'py>(&self, py: Python<'py>, edition: Option<&str>) -> PyResult<EncodedEntry<'py>> {
        let edition = match edition {
            Some(name) => name.parse().map_err(input_error)?,
            None => match self.photometry.facts().standard {
                Standard::Lm63(IesStandard::Lm63Of2019) => IesStandard::Lm63Of2019,
                _ => IesStandard::Lm63Of2002,
            },
        };
        let encoded = py.detach(|| write_ies(&self.photometry, edition));
        Ok(EncodedEntry::new(py, &encoded))
    }

    fn to_ldt<'py>(&self, py: Python<'py>) -> EncodedEntry<'py> {
        EncodedEntry::new(py, &py.detach(|| write_ldt(&self.photometry)))
    }

    fn diagram(
        &self,
        py: Python<'_>,
        kind: &str,
        planes_deg: Vec<f64>,
        in_candela: bool,
        title: &str,
    ) -> PyResult<DrawingHandle> {
        let diagram = match kind {
            "polar" => Diagram::Polar,
            "cartesian" => Diagram::Cartesian,
            "both" => Diagram::Both,
            other => {
                let expected = "expected \"polar\", \"cartesian\" or \"both\"";
                return Err(input_error(format!("kind is {other:?}; {expected}")));
            }
        };
        let figures = self.figures(py);
        let wanted = LuminaireDiagram { title, planes_deg: &planes_deg, diagram, in_candela };
        Ok(DrawingHandle(py.detach(|| wanted.draw(&self.photometry, figures))))
    }

    /// The file of tilt factors that the file names and that was not read.
    #[getter]
    fn tilt_file(&self) -> Option<&str> {
        match &self.photometry.facts().tilt {
            Tilt::File(name) => Some(name),
            Tilt::None | Tilt::Include { .. } => None,
        }
    }
}

impl<'py> EncodedEntry<'py> {
    fn new(py: Python<'py>, encoded: &Encoded) -> Self {
        Self {
            data: PyBytes::new(py, encoded.text.as_bytes()),
            notes: encoded.notes.iter().map(NoteEntry::new).collect(),
        }
    }
}
