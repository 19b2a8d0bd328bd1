//! The surfaces of a Radiance scene, with what they are made of.

use super::builder::{MeshBuilder, TriangleError};
use super::material_looks;
use super::seams::SeamCutter;
use crate::project::{Project, UpAxis};
use crate::radiance::{Findings, Look, Scene, Shape, Surface, tessellate};
use crate::{Files, LoadError, Warning};
use glam::DVec3;
use std::collections::HashMap;
use std::sync::Arc;

/// Coordinates beyond it are far beyond what geometry may have in any unit, and far from overflow.
const MAX_COORDINATE: f64 = 1e15;

/// Reads the files of a scene into `builder`, in the unit of the project and with z up.
pub(super) fn read(
    names: &[&str],
    project: &Project,
    files: &dyn Files,
    builder: &mut MeshBuilder,
    warnings: &mut Vec<Warning>,
) -> Result<(), LoadError> {
    let mut findings = Findings::default();
    let described = project.materials.iter().map(|entry| entry.name.value.as_str()).collect();
    let scene = Scene::read(files, names, &described, &mut findings)?;
    tell_unused(&scene, project, &mut findings);
    builder.measure_file_in(UpAxis::Z, project.unit.metres());
    add(scene, builder, &mut findings, warnings)?;
    warnings.extend(findings.into_warnings(names[0]));
    Ok(())
}

/// The warnings on the surfaces of a scene, for which there is no project to be loaded.
pub(crate) fn look_over_radiance(
    file: &str,
    scene: Scene,
    findings: &mut Findings,
) -> Result<Vec<Warning>, LoadError> {
    let mut builder = MeshBuilder::new(UpAxis::Z, 1.0);
    let mut warnings = Vec::new();
    builder.start_file(file);
    add(scene, &mut builder, findings, &mut warnings)?;
    builder.finish_file(&mut warnings)?;
    Ok(warnings)
}

fn add(
    scene: Scene,
    builder: &mut MeshBuilder,
    findings: &mut Findings,
    warnings: &mut Vec<Warning>,
) -> Result<(), LoadError> {
    let Scene { surfaces, materials, .. } = scene;
    let numbers: Vec<u32> = materials.iter().map(|(name, _)| builder.material(name)).collect();
    let kinds: Vec<Kind> = materials.iter().map(|(_, look)| Kind::from_look(look)).collect();
    for (&number, (name, look)) in numbers.iter().zip(materials) {
        material_looks::describe(number, &name, look, builder, warnings);
    }
    let mut reader =
        Reader { builder, cutter: SeamCutter::new(), findings, objects: HashMap::new() };
    for surface in &surfaces {
        reader.surface(surface, numbers[surface.material], &kinds[surface.material])?;
    }
    Ok(())
}

/// Properties of a material that matter to its facets.
struct Kind {
    shines: bool,
    /// A measured sheet: Radiance has its back outdoors, where the front of facets is here.
    is_turned: bool,
}

impl Kind {
    fn from_look(look: &Look) -> Self {
        Self {
            shines: matches!(look, Look::Light(_)),
            is_turned: matches!(look, Look::Sheet { .. }),
        }
    }
}

/// Tells of what a scene has beside surfaces, and the project has nothing of.
fn tell_unused(scene: &Scene, project: &Project, findings: &mut Findings) {
    let has_sky = scene.outside.sky.is_some() || scene.outside.sun.is_some();
    let shining = scene.materials.iter().filter(|(_, look)| matches!(look, Look::Light(_)));
    let counts = [
        ("luminaires", scene.lamps.len(), project.luminaires.is_empty()),
        ("materials that shine", shining.count(), project.lights.is_empty()),
        ("sky or sun", usize::from(has_sky), project.outside.is_none()),
    ];
    for (what, count, is_without) in counts {
        if count > 0 && is_without {
            let message = format!(
                "{what} ({count}) are not in the project; `quasilux import` writes one with them"
            );
            findings.note("the scene", message);
        }
    }
}

struct Reader<'r> {
    builder: &'r mut MeshBuilder,
    cutter: SeamCutter,
    findings: &'r mut Findings,
    /// Numbers of objects by their names, which surfaces share.
    objects: HashMap<Arc<str>, u32>,
}

impl Reader<'_> {
    fn surface(&mut self, surface: &Surface, material: u32, kind: &Kind) -> Result<(), LoadError> {
        let place = format!("surface \"{}\"", surface.name.escape_debug());
        let refuse = |message: String| LoadError::new(&surface.file, Some(surface.at), message);
        let triangles = match &surface.shape {
            Shape::Polygon(corners) => {
                let is_far = |corner: &DVec3| corner.abs().max_element() > MAX_COORDINATE;
                if corners.iter().any(is_far) {
                    return Err(refuse(TriangleError::NotFinite.message(&place)));
                }
                let cut = self.cutter.triangles(corners);
                let cut = cut.map_err(|message| refuse(format!("{place}: {message}")))?;
                if cut.has_no_area {
                    self.findings.note(&place, "a polygon without area is left out");
                    return Ok(());
                }
                if !cut.is_simple {
                    let note = "a polygon that crosses itself: its area may be wrong";
                    self.findings.note(&place, note);
                }
                cut.triangles
            }
            round => tessellate(round, kind.shines),
        };
        if triangles.is_empty() {
            self.findings.note(&place, "a surface without area is left out");
            return Ok(());
        }
        let object = match self.objects.get(&surface.name) {
            Some(&known) => known,
            None => {
                let object = self.builder.object(&surface.name);
                self.objects.insert(Arc::clone(&surface.name), object);
                object
            }
        };
        for [a, b, c] in triangles {
            let corners = if kind.is_turned { [a, c, b] } else { [a, b, c] };
            let taken = self.builder.triangle(object, material, corners);
            taken.map_err(|error| refuse(error.message(&place)))?;
        }
        Ok(())
    }
}
