//! The surfaces of a Honeybee model, with what they are made of.

use super::builder::{MeshBuilder, TriangleError};
use super::cut::HoleCutter;
use super::material_looks;
use crate::honeybee::{Face3D, Mesh3D, Model, Point, Shape, Surface, Surfaces, surfaces};
use crate::project::{Project, UpAxis};
use crate::radiance::Findings;
use crate::{LoadError, Warning};
use glam::DVec3;

/// Coordinates beyond it are far beyond what geometry may have in any unit, and far from overflow.
const MAX_COORDINATE: f64 = 1e15;

/// Reads a model into `builder`, in its own unit.
pub(super) fn read(
    bytes: &[u8],
    project: &Project,
    builder: &mut MeshBuilder,
    warnings: &mut Vec<Warning>,
) -> Result<(), LoadError> {
    let file = builder.file().to_owned();
    let model = Model::parse(&file, bytes)?;
    let mut findings = Findings::default();
    let groups = read_surfaces(&file, &model, builder, &mut findings, warnings)?;
    tell_unused(&model, groups, project, &mut findings);
    warnings.extend(findings.into_warnings(&file));
    Ok(())
}

/// The warnings on the surfaces of a model, for which there is no project to be loaded.
pub(crate) fn look_over(file: &str, model: &Model) -> Result<Vec<Warning>, LoadError> {
    let mut builder = MeshBuilder::new(UpAxis::Z, 1.0);
    let (mut findings, mut warnings) = (Findings::default(), Vec::new());
    builder.start_file(file);
    read_surfaces(file, model, &mut builder, &mut findings, &mut warnings)?;
    builder.finish_file(&mut warnings)?;
    warnings.extend(findings.into_warnings(file));
    Ok(warnings)
}

/// Reads surfaces and materials; the number of groups.
fn read_surfaces(
    file: &str,
    model: &Model,
    builder: &mut MeshBuilder,
    findings: &mut Findings,
    warnings: &mut Vec<Warning>,
) -> Result<usize, LoadError> {
    let Surfaces { surfaces, materials, groups } = surfaces(file, model, findings)?;
    builder.measure_file_in(UpAxis::Z, model.unit().metres());
    let numbers: Vec<u32> = materials.iter().map(|(name, _)| builder.material(name)).collect();
    for (&number, (name, look)) in numbers.iter().zip(materials) {
        material_looks::describe(number, &name, look, builder, warnings);
    }
    let mut reader = Reader { builder, cutter: HoleCutter::new(), findings };
    for surface in &surfaces {
        reader.surface(surface, numbers[surface.material])?;
    }
    Ok(groups.len())
}

/// Tells of what a model has beside surfaces, and the project has nothing of.
fn tell_unused(model: &Model, groups: usize, project: &Project, findings: &mut Findings) {
    let Some(radiance) = model.radiance() else { return };
    let luminaires = radiance.luminaires.iter().filter(|it| !it.instances().is_empty()).count();
    let grids = radiance.sensor_grids.iter().filter(|it| !it.sensors.is_empty()).count();
    let views = radiance.views.iter().filter(|it| it.why_no_camera().is_none()).count();
    let counts = [
        ("luminaires", luminaires, project.luminaires.is_empty()),
        ("sensor grids", grids, project.sensors.is_empty()),
        ("views", views, project.cameras.is_empty()),
    ];
    for (what, count, is_without) in counts {
        if count > 0 && is_without {
            let message = format!(
                "{what} ({count}) are not in the project; `quasilux import` writes one with them"
            );
            findings.note("properties.radiance", message);
        }
    }
    if groups > 0 && project.blinds.is_empty() {
        let message = format!(
            "dynamic groups ({groups}) stay in their first state; `quasilux import --weather` \
             writes a project in which they move"
        );
        findings.note("properties.radiance", message);
    }
}

struct Reader<'r> {
    builder: &'r mut MeshBuilder,
    cutter: HoleCutter,
    findings: &'r mut Findings,
}

impl Reader<'_> {
    fn surface(&mut self, surface: &Surface<'_>, material: u32) -> Result<(), LoadError> {
        let object = self.builder.object(&surface.name.into());
        let triangles = match &surface.shape {
            Shape::Polygon { outline, cut_out } => {
                self.polygon(outline, cut_out, &surface.place)?
            }
            Shape::Mesh(mesh) => facets(mesh, &surface.place)
                .map_err(|message| LoadError::new(self.builder.file(), None, message))?,
        };
        for corners in triangles {
            self.builder.triangle(object, material, corners).map_err(|error| {
                let message = error.message(&surface.place);
                LoadError::new(self.builder.file(), None, message)
            })?;
        }
        Ok(())
    }

    fn polygon(
        &mut self,
        outline: &Face3D,
        cut_out: &[&Face3D],
        place: &str,
    ) -> Result<Vec<[DVec3; 3]>, LoadError> {
        if outline.boundary.len() < 3 {
            self.findings.note(place, "a polygon of fewer than three corners is left out");
            return Ok(Vec::new());
        }
        if cut_out.iter().any(|it| !it.holes.is_empty()) {
            self.findings.note(place, "holes of its apertures and doors are open");
        }
        let holes = outline.holes.iter().chain(cut_out.iter().map(|it| &it.boundary));
        let holes: Vec<Vec<DVec3>> = holes.map(|points| positions(points)).collect();
        let outline = positions(&outline.boundary);
        let refuse = |message: String| LoadError::new(self.builder.file(), None, message);
        let is_far = |corner: &DVec3| corner.abs().max_element() > MAX_COORDINATE;
        if outline.iter().chain(holes.iter().flatten()).any(is_far) {
            return Err(refuse(TriangleError::NotFinite.message(place)));
        }
        let left = self.cutter.cut(&outline, &holes);
        let left = left.map_err(|message| refuse(format!("{place}: {message}")))?;
        if left.area == 0.0 && left.expected_area == 0.0 && holes.is_empty() {
            self.findings.note(place, "a polygon without area is left out");
        }
        if !left.is_as_expected() {
            let note = "its holes, apertures and doors lie over one another or beyond its edges: \
                        what they cover is cut out once";
            self.findings.note(place, note);
        }
        Ok(left.triangles)
    }
}

fn positions(points: &[Point]) -> Vec<DVec3> {
    points.iter().map(|point| point.0).collect()
}

/// The triangles of a mesh; a quadrangle is two.
fn facets(mesh: &Mesh3D, place: &str) -> Result<Vec<[DVec3; 3]>, String> {
    let mut triangles = Vec::new();
    for (number, facet) in mesh.faces.iter().enumerate() {
        let vertex = |&index: &u32| {
            let vertex = mesh.vertices.get(index as usize).map(|point| point.0);
            vertex.ok_or_else(|| {
                format!(
                    "{place}.geometry.faces[{number}] has the vertex {index}; expected numbers \
                     below {}",
                    mesh.vertices.len()
                )
            })
        };
        let corners = facet.corners().iter().map(vertex).collect::<Result<Vec<_>, _>>()?;
        triangles.extend((2..corners.len()).map(|i| [corners[0], corners[i - 1], corners[i]]));
    }
    Ok(triangles)
}
