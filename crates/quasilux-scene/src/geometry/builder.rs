//! Triangles of all files to one mesh with shared vertices.

use super::{FileMaterial, FileScattering, Geometry};
use crate::project::UpAxis;
use crate::{LoadError, Rgb, Warning};
use glam::DVec3;
use std::collections::HashMap;
use std::sync::Arc;

/// Largest coordinate in m that geometry may have.
const MAX_COORDINATE_M: f64 = 1e9;

/// Most triangles of a scene: about 4 GB of mesh. Instances multiply triangles, so that a small
/// file can ask for any number.
pub(super) const MAX_TRIANGLES: usize = 50_000_000;

/// Collects triangles of one file after the other.
pub(crate) struct MeshBuilder {
    pub(super) geometry: Geometry,
    /// Axis and unit of files that do not say theirs.
    usual: Frame,
    /// Of the current file.
    frame: Frame,
    vertex_of: HashMap<[u64; 3], u32>,
    material_of: HashMap<String, u32>,
    file: String,
    /// Triangles of the current file: all, and the degenerate ones that were dropped.
    triangles: u64,
    dropped: u64,
    total: u64,
}

/// How coordinates of a file become those of the scene.
#[derive(Clone, Copy)]
struct Frame {
    up: UpAxis,
    unit_m: f64,
}

/// Why a triangle cannot be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TriangleError {
    NotFinite,
    TooMany,
}

/// Look of a material by a geometry file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    pub(crate) reflectance: Rgb,
    pub(crate) emits: bool,
    /// Whether it lets a part of the light through.
    pub(crate) is_clear: bool,
}

impl MeshBuilder {
    pub(crate) fn new(up: UpAxis, unit_m: f64) -> Self {
        let usual = Frame { up, unit_m };
        Self {
            geometry: Geometry::default(),
            usual,
            frame: usual,
            vertex_of: HashMap::new(),
            material_of: HashMap::new(),
            file: String::new(),
            triangles: 0,
            dropped: 0,
            total: 0,
        }
    }

    pub(super) fn start_file(&mut self, file: &str) {
        file.clone_into(&mut self.file);
        self.frame = self.usual;
        self.triangles = 0;
        self.dropped = 0;
    }

    /// Takes the coordinates of the current file by what it says itself.
    pub(super) fn measure_file_in(&mut self, up: UpAxis, unit_m: f64) {
        self.frame = Frame { up, unit_m };
    }

    pub(super) fn finish_file(&mut self, warnings: &mut Vec<Warning>) -> Result<(), LoadError> {
        if self.dropped == self.triangles {
            let message = match self.triangles {
                0 => "no triangles; expected a file with faces".to_owned(),
                n => format!("all {n} triangles are degenerate; expected some with an area"),
            };
            return Err(LoadError::new(&self.file, None, message));
        }
        if self.dropped > 0 {
            let (dropped, all) = (self.dropped, self.triangles);
            let message = format!("{dropped} of {all} triangles are degenerate: dropped");
            warnings.push(Warning::new(&self.file, None, message));
        }
        Ok(())
    }

    /// The file that is being read.
    pub(crate) fn file(&self) -> &str {
        &self.file
    }

    /// A new object.
    pub(crate) fn object(&mut self, name: &Arc<str>) -> u32 {
        self.geometry.mesh.objects.push(Arc::clone(name));
        (self.geometry.mesh.objects.len() - 1) as u32
    }

    /// The material of that name, new or known.
    pub(crate) fn material(&mut self, name: &str) -> u32 {
        if let Some(&known) = self.material_of.get(name) {
            return known;
        }
        let index = self.geometry.materials.len() as u32;
        self.material_of.insert(name.to_owned(), index);
        self.geometry.materials.push(FileMaterial {
            name: name.to_owned(),
            file: self.file.clone(),
            ..FileMaterial::default()
        });
        index
    }

    /// Notes what the current file says about a material; the first word on a material counts.
    pub(crate) fn describe(&mut self, material: u32, look: Look, warnings: &mut Vec<Warning>) {
        let Look { reflectance, emits, is_clear } = look;
        let known = &mut self.geometry.materials[material as usize];
        known.emits |= emits;
        known.is_clear |= is_clear;
        match known.reflectance {
            None => known.reflectance = Some(reflectance),
            Some(first) if first != reflectance => warnings.push(Warning::new(
                &self.file,
                None,
                format!("material \"{}\" has another reflectance before: kept", known.name),
            )),
            Some(_) => {}
        }
    }

    /// As [`Self::describe`], of all that a file says of how a material scatters.
    pub(super) fn describe_scattering(
        &mut self,
        material: u32,
        scattering: FileScattering,
        warnings: &mut Vec<Warning>,
    ) {
        let known = &mut self.geometry.materials[material as usize];
        if known.reflectance.is_none() && known.scattering.is_none() {
            known.scattering = Some(scattering);
        } else if known.scattering.as_ref() != Some(&scattering) {
            warnings.push(Warning::new(
                &self.file,
                None,
                format!("material \"{}\" scatters otherwise before: kept", known.name),
            ));
        }
    }

    /// Takes a triangle of the current file, in the file's own axes; drops it if it has no area.
    pub(crate) fn triangle(
        &mut self,
        object: u32,
        material: u32,
        corners: [DVec3; 3],
    ) -> Result<(), TriangleError> {
        // The largest of some elements need not be one that is not a number.
        let most = DVec3::splat(MAX_COORDINATE_M);
        if !corners.iter().all(|corner| corner.abs().cmple(most).all()) {
            return Err(TriangleError::NotFinite);
        }
        if self.total >= MAX_TRIANGLES as u64 {
            return Err(TriangleError::TooMany);
        }
        self.total += 1;
        self.triangles += 1;
        if is_degenerate(corners) {
            self.dropped += 1;
            return Ok(());
        }
        let triangle = corners.map(|corner| self.vertex(corner));
        let mesh = &mut self.geometry.mesh;
        mesh.triangles.push(triangle);
        mesh.material_of.push(material);
        mesh.object_of.push(object);
        Ok(())
    }

    fn vertex(&mut self, position: DVec3) -> u32 {
        let Frame { up, unit_m } = self.frame;
        let turned = match up {
            UpAxis::Z => position,
            UpAxis::Y => DVec3::new(position.x, -position.z, position.y),
        };
        // Adding zero makes -0 and +0 the same bits.
        let position = turned * unit_m + DVec3::ZERO;
        let positions = &mut self.geometry.mesh.positions;
        *self.vertex_of.entry(position.to_array().map(f64::to_bits)).or_insert_with(|| {
            positions.push(position);
            (positions.len() - 1) as u32
        })
    }
}

impl TriangleError {
    /// Message about it: `what` names the geometry that the triangle belongs to.
    pub(crate) fn message(self, what: &str) -> String {
        match self {
            Self::NotFinite => format!(
                "{what} has a vertex that is not finite or beyond {MAX_COORDINATE_M:e} m; expected \
                 coordinates in metres"
            ),
            Self::TooMany => {
                format!("{what} brings the scene to more than {MAX_TRIANGLES} triangles")
            }
        }
    }
}

/// Whether the height of a triangle is lost in the rounding of its coordinates.
fn is_degenerate([a, b, c]: [DVec3; 3]) -> bool {
    let longest_squared =
        (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    (b - a).cross(c - a).length() <= 1e-14 * longest_squared
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_merge_by_exact_position_and_y_up_is_turned() {
        let mut builder = MeshBuilder::new(UpAxis::Y, 1.0);
        let (object, material) = (builder.object(&"o".into()), builder.material("m"));
        let [a, b, c, d] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(-0.0, -0.0, 1.0)];
        builder.triangle(object, material, [a, b, c]).unwrap();
        builder.triangle(object, material, [-a, d, b]).unwrap();
        let mesh = &builder.geometry.mesh;
        assert_eq!(mesh.positions, [DVec3::ZERO, DVec3::X, DVec3::Z, DVec3::NEG_Y]);
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 3, 1]]);
    }

    #[test]
    fn triangles_without_area_are_counted_not_kept() {
        let mut builder = MeshBuilder::new(UpAxis::Z, 1.0);
        let (object, material) = (builder.object(&"o".into()), builder.material("m"));
        builder.triangle(object, material, [DVec3::ZERO, DVec3::X, DVec3::X * 2.0]).unwrap();
        builder.triangle(object, material, [DVec3::ZERO, DVec3::X, DVec3::X]).unwrap();
        builder.triangle(object, material, [DVec3::ZERO, DVec3::X, DVec3::Y * 1e-9]).unwrap();
        assert_eq!((builder.triangles, builder.dropped), (3, 2));
        for far in [DVec3::NAN, DVec3::new(1.0, f64::NAN, 0.0), DVec3::X * -2e9] {
            let error = builder.triangle(object, material, [DVec3::ZERO, DVec3::X, far]);
            assert_eq!(error, Err(TriangleError::NotFinite));
        }
    }
}
