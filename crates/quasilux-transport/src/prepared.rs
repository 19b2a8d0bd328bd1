//! A scene with the hierarchy over its triangles: what takes longest to make is made once, for who
//! inspects a scene and who simulates it.

use quasilux_bvh::{SimdLevel, TriangleBvh};
use quasilux_scene::Scene;
use std::sync::Arc;

/// A scene that rays can be traced in. Clones share the hierarchy.
#[derive(Clone)]
pub struct PreparedScene<'a> {
    scene: &'a Scene,
    hierarchy: Arc<TriangleBvh>,
}

impl<'a> PreparedScene<'a> {
    /// Builds the hierarchy, with the threads of the rayon pool that the call is made in.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, hierarchy: Arc::new(build(scene, SimdLevel::fastest())) }
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// The hierarchy over the triangles of its mesh, in their order.
    #[must_use]
    pub fn hierarchy(&self) -> &TriangleBvh {
        &self.hierarchy
    }

    /// The hierarchy for a ray kernel of choice.
    pub(crate) fn hierarchy_for(&self, simd: SimdLevel) -> Arc<TriangleBvh> {
        if simd == SimdLevel::fastest() {
            Arc::clone(&self.hierarchy)
        } else {
            Arc::new(build(self.scene, simd))
        }
    }
}

fn build(scene: &Scene, simd: SimdLevel) -> TriangleBvh {
    let triangles = 0..scene.mesh.triangles.len() as u32;
    TriangleBvh::build_for(triangles.map(|triangle| scene.mesh.corners(triangle)).collect(), simd)
}

impl<'a> From<&'a Scene> for PreparedScene<'a> {
    fn from(scene: &'a Scene) -> Self {
        Self::new(scene)
    }
}
