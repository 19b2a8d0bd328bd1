//! Checks of closed bodies by what they are made of: glass must be closed, and light must end.

use crate::checks::{MAX_TRIANGLE_TESTS, holds_light};
use crate::project::Project;
use crate::solids::{Solid, solids_among, solids_of};
use crate::{Bsdf, LoadError, Rgb, Scene, Warning};

/// Shares of light this near to 1 are whole.
const WHOLE: f64 = 1.0 - 1e-12;

/// Refuses a closed body around a light in a scene where nothing absorbs: its light would grow for
/// ever. A scene that lets light out some other way is not judged.
pub(crate) fn light_must_end(scene: &Scene, project: &Project) -> Result<(), LoadError> {
    let used = |material: &u32| scene.materials[*material as usize].bsdf.most_kept();
    let least = |a: Rgb, b: Rgb| Rgb(std::array::from_fn(|c| a.0[c].min(b.0[c])));
    let kept = scene.mesh.material_of.iter().map(used).reduce(least);
    if kept.is_none_or(|kept| kept.max_channel() < WHOLE) {
        return Ok(());
    }
    let mesh = &scene.mesh;
    let mut tests_left = MAX_TRIANGLE_TESTS;
    let mut is_around_light = |solid: &Solid| {
        let mut contains = |position| {
            tests_left = tests_left.checked_sub(solid.triangles.len() as u64)?;
            Some(solid.contains(mesh, position))
        };
        !solid.transmits(scene) && holds_light(scene, solid, &mut contains) == Some(true)
    };
    let Some(solid) = solids_of(mesh).into_iter().find(|solid| is_around_light(solid)) else {
        return Ok(());
    };
    let triangle = solid.triangles[0];
    let (object, material) = (mesh.object_of[triangle as usize], scene.material(triangle));
    let message = format!(
        "nothing absorbs light in the closed object \"{}\", so it would grow for ever; give some \
         surface a reflectance below 1",
        mesh.objects[object as usize]
    );
    let entry = project.materials.iter().find(|entry| entry.name.value == material.name);
    let place = entry.map(|entry| entry.name.place);
    Err(LoadError::new(&project.file, place, message))
}

/// Warns of glass whose inside is not known: bodies that are open or inside out.
pub(crate) fn glass_must_be_closed(scene: &Scene, project: &Project, warnings: &mut Vec<Warning>) {
    let is_glass = |&triangle: &u32| matches!(scene.material(triangle).bsdf, Bsdf::Dielectric(_));
    if !scene.materials.iter().any(|material| matches!(material.bsdf, Bsdf::Dielectric(_))) {
        return;
    }
    let mut warn = |count: usize, what: &str| {
        if count > 0 {
            let message = format!("{count} triangles of kind \"dielectric\" {what}");
            warnings.push(Warning::new(&project.file, None, message));
        }
    };
    let glass: Vec<u32> = (0..scene.mesh.triangles.len() as u32).filter(is_glass).collect();
    // Of glass alone, or with others that close it, such as a silvered back. Edges of a wall that
    // it fits into make the whole open.
    let alone = solids_among(&scene.mesh, &glass);
    let with_others = solids_of(&scene.mesh);
    let mut is_closed = vec![false; scene.mesh.triangles.len()];
    let mut is_inside_out = is_closed.clone();
    for solid in alone.iter().chain(&with_others) {
        let faces_inward = solid.volume_m3(&scene.mesh) < 0.0;
        for &triangle in solid.triangles.iter().filter(|triangle| is_glass(triangle)) {
            is_closed[triangle as usize] = true;
            is_inside_out[triangle as usize] = faces_inward;
        }
    }
    let count = |marks: &[bool]| marks.iter().filter(|is_so| **is_so).count();
    let (closed, inside_out) = (count(&is_closed), count(&is_inside_out));
    warn(
        glass.len() - closed,
        "are not part of a closed body, and light that enters there stays inside; set kind = \
         \"pane\" for single sheets",
    );
    warn(inside_out, "face the inside of their body: it is taken for a hollow in glass");
}

impl Solid {
    /// Whether light passes through some of it.
    #[must_use]
    pub fn transmits(&self, scene: &Scene) -> bool {
        self.triangles.iter().any(|&triangle| scene.material(triangle).bsdf.transmits())
    }

    /// Its volume, negative where its triangles face inward (the divergence theorem).
    fn volume_m3(&self, mesh: &crate::Mesh) -> f64 {
        let origin = mesh.corners(self.triangles[0])[0];
        let volume = |&triangle: &u32| {
            let [a, b, c] = mesh.corners(triangle).map(|corner| corner - origin);
            a.dot(b.cross(c)) / 6.0
        };
        self.triangles.iter().map(volume).sum()
    }
}
