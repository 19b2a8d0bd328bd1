//! Files of measured BSDFs, each read once.

use super::photometry::{load_error, passed_on};
use crate::bsdf::Measured;
use crate::geometry::read_file;
use crate::project::Project;
use crate::{FileKind, Files, LoadError, Mesh, Spanned, Warning};
use glam::DVec3;
use quasilux_bsdf::{MeasuredBsdf, read_bsdf_named};
use quasilux_text::Position;
use std::collections::HashMap;
use std::sync::Arc;

/// Facets must lean at least this far, in rad, from being square to where a table points up.
const MIN_LEAN_RAD: f64 = 1e-6;

/// The files of a project, and what was made of them for one of its rooms and serves the others.
pub(super) struct Sources<'f> {
    pub(super) files: &'f dyn Files,
    /// Measured surfaces by the names of their files.
    tables: HashMap<String, Arc<MeasuredBsdf>>,
}

impl<'f> Sources<'f> {
    pub(super) fn new(files: &'f dyn Files) -> Self {
        Self { files, tables: HashMap::new() }
    }
}

/// The files that a project names.
pub(super) struct MeasuredFiles<'a> {
    project: &'a Project,
    files: &'a dyn Files,
    tables: &'a mut HashMap<String, Arc<MeasuredBsdf>>,
}

impl<'a> MeasuredFiles<'a> {
    pub(super) fn new(project: &'a Project, sources: &'a mut Sources<'_>) -> Self {
        Self { project, files: sources.files, tables: &mut sources.tables }
    }

    /// The sheet of a file; passes warnings on when it is read first.
    pub(super) fn read(
        &mut self,
        file: &Spanned<String>,
        up: Option<&Spanned<DVec3>>,
        warnings: &mut Vec<Warning>,
    ) -> Result<Measured, LoadError> {
        let name = file.value.as_str();
        let table = match self.tables.get(name) {
            Some(known) => Arc::clone(known),
            None => {
                let bytes = read_file(self.project, file, self.files, FileKind::Bsdf)?;
                self.table(name, &bytes, warnings)?
            }
        };
        if up.is_none() && !table.is_isotropic() {
            let message = format!(
                "\"{name}\" scatters differently when it is turned in its plane; set up = [x, y, \
                 z] to where the table's upward direction points"
            );
            return Err(self.project.error(file.place, message));
        }
        Ok(Measured::new(table, up.map(|up| up.value)))
    }

    /// The sheet of a text that a geometry file holds, under a name of its own.
    pub(super) fn read_text(
        &mut self,
        name: &str,
        text: &str,
        up: DVec3,
        warnings: &mut Vec<Warning>,
    ) -> Result<Measured, LoadError> {
        let table = match self.tables.get(name) {
            Some(known) => Arc::clone(known),
            None => self.table(name, text.as_bytes(), warnings)?,
        };
        Ok(Measured::new(table, Some(up)))
    }

    fn table(
        &mut self,
        name: &str,
        bytes: &[u8],
        warnings: &mut Vec<Warning>,
    ) -> Result<Arc<MeasuredBsdf>, LoadError> {
        let read = read_bsdf_named(name, bytes).map_err(|error| load_error(name, &error))?;
        warnings.extend(read.warnings.iter().map(|warning| passed_on(name, warning)));
        let table = Arc::new(read.bsdf);
        self.tables.insert(name.to_owned(), Arc::clone(&table));
        Ok(table)
    }

    /// Where the project file names its geometry.
    pub(super) fn scene_place(&self) -> Position {
        self.project.scene_place
    }

    /// Refuses facets of a material that its upward direction stands on.
    pub(super) fn must_lie_across(
        &self,
        up: Option<&Spanned<DVec3>>,
        mesh: &Mesh,
        material: u32,
    ) -> Result<(), LoadError> {
        let Some(up) = up else { return Ok(()) };
        let along = up.value.normalize();
        let stands = |triangle: &u32| {
            mesh.material_of[*triangle as usize] == material
                && mesh.front_normal(*triangle).cross(along).length() < MIN_LEAN_RAD
        };
        match (0..mesh.triangles.len() as u32).find(stands) {
            None => Ok(()),
            Some(triangle) => {
                let [x, y, z] = mesh.corners(triangle)[0].to_array();
                let message = format!(
                    "\"up\" is square to the facet at ({x}, {y}, {z}); give a direction that lies \
                     in all facets of the material, or leans that way"
                );
                Err(self.project.error(up.place, message))
            }
        }
    }
}
