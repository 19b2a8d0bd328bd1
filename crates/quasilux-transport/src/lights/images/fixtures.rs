//! Mirrors of tests.

use crate::world::World;
use glam::DVec3;
use quasilux_bvh::SimdLevel;
use quasilux_scene::bsdf::{Diffuse, Mirror};
use quasilux_scene::{Bsdf, Material, Mesh, Rgb, Scene};

/// A scene of mirrors, and of black walls.
pub(super) struct Mirrors(Scene);

impl Mirrors {
    pub(super) fn new(reflectance: f64) -> Self {
        let mirror = Bsdf::Mirror(Mirror { reflectance: Rgb::grey(reflectance) });
        let black = Bsdf::Diffuse(Diffuse { reflectance: Rgb::BLACK });
        let material = |(name, bsdf): (&str, Bsdf)| Material { name: name.to_owned(), bsdf };
        let materials = [("mirror", mirror), ("black", black)].map(material).to_vec();
        let objects = vec!["all".into()];
        Self(Scene { materials, mesh: Mesh { objects, ..Mesh::default() }, ..Scene::default() })
    }

    /// A mirror with these corners, in two triangles.
    pub(super) fn add(&mut self, corners: [DVec3; 4]) {
        self.add_of(0, corners);
    }

    pub(super) fn add_diffuse(&mut self, corners: [DVec3; 4]) {
        self.add_of(1, corners);
    }

    /// A mirror of 20 m around `centre`.
    pub(super) fn add_square(&mut self, centre: DVec3, u: DVec3, v: DVec3) {
        let corner = |(a, b)| centre + u * a + v * b;
        self.add([(-10.0, -10.0), (10.0, -10.0), (10.0, 10.0), (-10.0, 10.0)].map(corner));
    }

    /// Three unit squares on the coordinate planes.
    pub(super) fn add_corner(&mut self) {
        for (u, v) in [(DVec3::X, DVec3::Y), (DVec3::Y, DVec3::Z), (DVec3::Z, DVec3::X)] {
            self.add([DVec3::ZERO, u, u + v, v]);
        }
    }

    pub(super) fn world(&self) -> World<f64> {
        World::new(&self.0, SimdLevel::fastest())
    }

    fn add_of(&mut self, material: u32, corners: [DVec3; 4]) {
        let mesh = &mut self.0.mesh;
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(corners);
        mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        mesh.material_of.extend([material; 2]);
        mesh.object_of.extend([0; 2]);
    }
}
