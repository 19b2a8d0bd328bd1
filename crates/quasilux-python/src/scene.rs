//! Scenes: loaded from files, or made of text and arrays.

use crate::arrays::read_only;
use crate::error::{from_command_line, input_error};
use numpy::{PyArrayDyn, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::PyBytes;
use quasilux::embedded::{self, Project, Source, Triangles};
use quasilux_photometry::{Format, is_gldf};
use quasilux_report::json;
use quasilux_scene::{Light, Scene as Model, SensorPoint, SensorShape};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// Adds the class and functions to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Scene>()?;
    module.add_function(wrap_pyfunction!(photometry_ending, module)?)
}

/// A loaded scene, which never changes.
#[pyclass(frozen, module = "quasilux._native")]
pub(crate) struct Scene {
    pub(crate) project: Arc<Project>,
}

/// What a scene in memory is made of.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Parts<'py> {
    name: String,
    text: String,
    folder: Option<PathBuf>,
    files: BTreeMap<String, PyBackedBytes>,
    geometry: Vec<Geometry<'py>>,
}

/// Triangles under a name: coordinates of vertices, indices of corners and of materials.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Geometry<'py> {
    name: String,
    vertices: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, u32>,
    material_of: PyReadonlyArray1<'py, u32>,
    materials: Vec<String>,
    object: String,
}

/// What a check found.
#[derive(IntoPyObject)]
struct CheckEntry {
    document: String,
    text: String,
}

#[pymethods]
impl Scene {
    /// Loads a project file, or a bundle.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::new(py.detach(|| Project::open(&path)))
    }

    /// Loads a project in memory.
    #[staticmethod]
    fn from_parts(py: Python<'_>, parts: Parts<'_>) -> PyResult<Self> {
        let mut source = Source::in_memory(&parts.name, parts.text);
        if let Some(folder) = &parts.folder {
            source = source.with_folder(folder);
        }
        for (name, bytes) in parts.files {
            source = source.with_file(&name, bytes.to_vec());
        }
        for geometry in parts.geometry {
            let name = geometry.name.clone();
            source = source.with_triangles(&name, geometry.triangles()?);
        }
        Self::new(py.detach(|| Project::load(source)))
    }

    /// Loads what another process put in bytes.
    #[staticmethod]
    fn from_bundle(py: Python<'_>, bundle: PyBackedBytes) -> PyResult<Self> {
        Self::new(py.detach(|| Project::load(Source::from_bundle(&bundle)?)))
    }

    /// All of the scene in bytes.
    fn to_bundle<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bundle = py.detach(|| self.project.to_bundle());
        Ok(PyBytes::new(py, &bundle.map_err(|error| from_command_line(&error))?))
    }

    #[getter]
    fn name(&self) -> &str {
        self.project.name()
    }

    #[getter]
    fn sha256(&self) -> &str {
        self.project.sha256()
    }

    /// The text of the project file.
    #[getter]
    fn text(&self) -> String {
        String::from_utf8_lossy(self.project.source().text()).into_owned()
    }

    /// The text of each warning of the loaders.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.project.loaded().warnings.iter().map(ToString::to_string).collect()
    }

    /// What is in the scene, as a document in JSON.
    fn contents(&self) -> String {
        json::text(&Contents::new(&self.project))
    }

    /// Coordinates of all vertices in m.
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        let positions = &self.model().mesh.positions;
        let numbers: Vec<f64> = positions.iter().flat_map(|vertex| vertex.to_array()).collect();
        read_only(py, numbers, &[positions.len(), 3])
    }

    /// Indices of the vertices of each triangle.
    fn triangles<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<u32>> {
        let triangles = &self.model().mesh.triangles;
        read_only(py, triangles.as_flattened().to_vec(), &[triangles.len(), 3])
    }

    /// Index of the material of each triangle.
    fn material_of<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<u32>> {
        let material_of = self.model().mesh.material_of.clone();
        let shape = [material_of.len()];
        read_only(py, material_of, &shape)
    }

    /// Positions in m of the points of a sensor, cells of grids in rows.
    fn positions<'py>(&self, py: Python<'py>, sensor: usize) -> Bound<'py, PyArrayDyn<f64>> {
        self.points(py, sensor, |point| point.position.to_array())
    }

    /// Unit normals of the points of a sensor.
    fn normals<'py>(&self, py: Python<'py>, sensor: usize) -> Bound<'py, PyArrayDyn<f64>> {
        self.points(py, sensor, |point| point.normal.to_array())
    }

    /// What `quasilux check` says.
    fn check(&self, py: Python<'_>) -> PyResult<CheckEntry> {
        let checked = py.detach(|| embedded::check(&self.project));
        let checked = checked.map_err(|error| from_command_line(&error))?;
        Ok(CheckEntry { document: checked.document, text: checked.text })
    }

    /// The plan that `quasilux check` draws, as PNG.
    fn plan_png<'py>(&self, py: Python<'py>, px_per_unit: f64) -> PyResult<Bound<'py, PyBytes>> {
        let png = py.detach(|| Ok(self.plan()?.to_png(px_per_unit)));
        png.map(|png| PyBytes::new(py, &png)).map_err(|error| from_command_line(&error))
    }

    /// The same as SVG.
    fn plan_svg(&self, py: Python<'_>) -> PyResult<String> {
        let svg = py.detach(|| Ok(self.plan()?.to_svg()));
        svg.map_err(|error| from_command_line(&error))
    }
}

impl Scene {
    pub(crate) fn new(loaded: Result<Project, embedded::CliError>) -> PyResult<Self> {
        let project = loaded.map_err(|error| from_command_line(&error))?;
        Ok(Self { project: Arc::new(project) })
    }

    fn model(&self) -> &Model {
        &self.project.loaded().scene
    }

    fn points<'py>(
        &self,
        py: Python<'py>,
        sensor: usize,
        vector: fn(&SensorPoint) -> [f64; 3],
    ) -> Bound<'py, PyArrayDyn<f64>> {
        let sensor = &self.model().sensors[sensor];
        let points = sensor.points();
        let mut shape = match &sensor.shape {
            SensorShape::Grid(grid) => grid.counts.iter().rev().map(|&n| n as usize).collect(),
            SensorShape::Points(points) => vec![points.len()],
        };
        shape.push(3);
        read_only(py, points.iter().flat_map(vector).collect(), &shape)
    }

    fn plan(&self) -> Result<quasilux_drawing::Drawing, embedded::CliError> {
        let findings = embedded::check(&self.project)?.findings;
        Ok(embedded::plan(&self.project, &findings))
    }
}

impl Geometry<'_> {
    fn triangles(self) -> PyResult<Triangles> {
        let in_rows = |_| input_error(format!("\"{}\": expected arrays in rows", self.name));
        Ok(Triangles {
            positions: self.vertices.as_slice().map_err(in_rows)?.as_chunks().0.to_vec(),
            triangles: self.triangles.as_slice().map_err(in_rows)?.as_chunks().0.to_vec(),
            material_of: self.material_of.as_slice().map_err(in_rows)?.to_vec(),
            materials: self.materials,
            object: self.object,
        })
    }
}

/// What is in a scene.
#[derive(Serialize)]
struct Contents<'a> {
    bounds_m: Option<[[f64; 3]; 2]>,
    triangles: usize,
    materials: Vec<MaterialEntry<'a>>,
    lights: Vec<LightEntry>,
    flux_lm: f64,
    maintenance_factor: f64,
    sensors: Vec<SensorEntry<'a>>,
    cameras: Vec<CameraEntry<'a>>,
}

#[derive(Serialize)]
struct MaterialEntry<'a> {
    name: &'a str,
    kind: &'static str,
    reflectance: Option<[f64; 3]>,
}

#[derive(Serialize)]
struct LightEntry {
    kind: &'static str,
    flux_lm: f64,
}

#[derive(Serialize)]
struct SensorEntry<'a> {
    name: &'a str,
    counts: Option<[u32; 2]>,
    points: usize,
    origin_m: Option<[f64; 3]>,
    u_m: Option<[f64; 3]>,
    v_m: Option<[f64; 3]>,
    target_lx: Option<f64>,
}

#[derive(Serialize)]
struct CameraEntry<'a> {
    name: &'a str,
    resolution: [u32; 2],
}

impl<'a> Contents<'a> {
    fn new(project: &'a Project) -> Self {
        let loaded = project.loaded();
        let scene = &loaded.scene;
        let light = |light: &Light| LightEntry {
            kind: match light {
                Light::Luminaire(_) => "luminaire",
                Light::Point(_) => "point",
                Light::Area(_) => "area",
            },
            flux_lm: light.flux_lm(),
        };
        Self {
            bounds_m: scene.mesh.bounds().map(|ends| ends.map(|corner| corner.to_array())),
            triangles: scene.mesh.triangles.len(),
            materials: scene.materials.iter().map(MaterialEntry::new).collect(),
            lights: scene.lights.iter().map(light).collect(),
            flux_lm: scene.flux_lm(),
            maintenance_factor: loaded.maintenance_factor,
            sensors: scene.sensors.iter().map(SensorEntry::new).collect(),
            cameras: scene
                .cameras
                .iter()
                .map(|camera| CameraEntry { name: &camera.name, resolution: camera.resolution })
                .collect(),
        }
    }
}

impl<'a> MaterialEntry<'a> {
    fn new(material: &'a quasilux_scene::Material) -> Self {
        Self {
            name: &material.name,
            kind: material.bsdf.kind(),
            reflectance: material.bsdf.reflectance().map(|reflectance| reflectance.0),
        }
    }
}

impl<'a> SensorEntry<'a> {
    fn new(sensor: &'a quasilux_scene::Sensor) -> Self {
        let grid = match &sensor.shape {
            SensorShape::Grid(grid) => Some(grid),
            SensorShape::Points(_) => None,
        };
        Self {
            name: &sensor.name,
            counts: grid.map(|grid| grid.counts),
            points: sensor.len(),
            origin_m: grid.map(|grid| grid.origin.to_array()),
            u_m: grid.map(|grid| grid.u.to_array()),
            v_m: grid.map(|grid| grid.v.to_array()),
            target_lx: grid.and_then(|grid| grid.target_lx),
        }
    }
}

/// The ending that the name of a luminaire file with this content has.
#[pyfunction]
fn photometry_ending(content: &[u8]) -> &'static str {
    if is_gldf("", content) {
        return "gldf";
    }
    match Format::from_content(content) {
        Some(Format::Eulumdat) => "ldt",
        Some(Format::Tm33) => "xml",
        _ => "ies",
    }
}
