//! Sensor grids as sensors of single points.

use super::Writer;
use super::text::{number, quoted, vector};
use crate::LoadError;
use crate::honeybee::{Mesh3D, Model, SensorGrid};

impl Writer<'_> {
    /// Writes the grids; their number.
    pub(super) fn grids(&mut self, model: &Model) -> Result<usize, LoadError> {
        let Some(radiance) = model.radiance() else { return Ok(0) };
        let mut count = 0;
        for (number, grid) in radiance.sensor_grids.iter().enumerate() {
            let place = format!("properties.radiance.sensor_grids[{number}]");
            if grid.sensors.is_empty() {
                self.findings.note(&place, "a sensor grid without sensors is left out");
                continue;
            }
            self.grid(grid, &place)?;
            count += 1;
        }
        Ok(count)
    }

    fn grid(&mut self, grid: &SensorGrid, place: &str) -> Result<(), LoadError> {
        if let Some(number) = grid.sensors.iter().position(|it| it.dir.0.try_normalize().is_none())
        {
            let message =
                format!("{place}.sensors[{number}].dir has no length; expected a direction");
            return Err(LoadError::new(self.terms.model, None, message));
        }
        if !grid.light_path.is_empty() {
            self.findings.note(place, "its light_path is left out: light comes by all ways");
        }
        let name = self.names.new_name(&grid.identifier, &[""]);
        if name != grid.identifier {
            let note = "its name is taken, or none for a file: results have another one";
            self.findings.note(&format!("{place} \"{}\"", grid.identifier), note);
        }
        self.text.section("[[sensors]]");
        self.text.key("name", &quoted(&name));
        self.text.key("kind", &quoted("points"));
        self.text.list("points", grid.sensors.iter().map(|sensor| vector(sensor.pos.0)));
        self.text.list("normals", grid.sensors.iter().map(|sensor| vector(sensor.dir.0)));
        let Some(mesh) = &grid.mesh else { return Ok(()) };
        match areas(mesh, grid.sensors.len()) {
            None => {
                let note = "its mesh has neither a face nor a vertex with an area for each sensor: \
                            all sensors count alike";
                self.findings.note(place, note);
            }
            Some(areas) if are_alike(&areas) => {}
            Some(areas) => {
                let areas: Vec<String> = areas.into_iter().map(number).collect();
                self.text.key("areas", &format!("[{}]", areas.join(", ")));
            }
        }
        Ok(())
    }
}

/// Areas that differ by less than this share of the largest one are those of equal cells.
const ALIKE: f64 = 1e-6;

fn are_alike(areas: &[f64]) -> bool {
    let most = areas.iter().copied().fold(0.0, f64::max);
    let least = areas.iter().copied().fold(f64::INFINITY, f64::min);
    most - least <= ALIKE * most
}

/// The area that each of so many sensors stands for: a face of the mesh, or what the faces around
/// a vertex give to it, each the same to all its corners.
fn areas(mesh: &Mesh3D, sensors: usize) -> Option<Vec<f64>> {
    let mut of_faces = Vec::new();
    let mut of_vertices = vec![0.0; mesh.vertices.len()];
    for face in &mesh.faces {
        let corners = face.corners();
        let points: Option<Vec<_>> =
            corners.iter().map(|&it| mesh.vertices.get(it as usize).map(|it| it.0)).collect();
        let points = points?;
        let across = |i: usize| (points[i - 1] - points[0]).cross(points[i] - points[0]);
        let area = 0.5 * (2..points.len()).map(across).sum::<glam::DVec3>().length();
        of_faces.push(area);
        for &corner in corners {
            of_vertices[corner as usize] += area / corners.len() as f64;
        }
    }
    let areas = [of_faces, of_vertices].into_iter().find(|areas| areas.len() == sensors)?;
    areas.iter().all(|area| *area > 0.0 && *area <= 1e12).then_some(areas)
}
