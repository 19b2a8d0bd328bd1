//! What the tests of the map share.

use crate::world::{Interaction, World};
use glam::DVec3;
use quasilux_bvh::SimdLevel;
use quasilux_sampling::warp::sample_triangle;
use quasilux_scene::bsdf::Diffuse;
use quasilux_scene::{Bsdf, Material, Mesh, Rgb, Scene};

/// A horizontal rectangle of 2 m by 1 m from the origin, of two triangles.
pub(in crate::photon) fn square() -> World<f64> {
    let bsdf = Bsdf::Diffuse(Diffuse { reflectance: Rgb::grey(0.5) });
    let scene = Scene {
        mesh: Mesh {
            positions: vec![DVec3::ZERO, DVec3::X * 2.0, DVec3::new(2.0, 1.0, 0.0), DVec3::Y],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            material_of: vec![0; 2],
            object_of: vec![0; 2],
            objects: vec!["rectangle".into()],
        },
        materials: vec![Material { name: "grey".to_owned(), bsdf }],
        lights: Vec::new(),
        environment: None,
        weather: None,
        cameras: Vec::new(),
        sensors: Vec::new(),
    };
    World::new(&scene, SimdLevel::fastest())
}

/// A place anywhere on the rectangle, on either side; even in each triangle, which have the same
/// area.
pub(in crate::photon) fn at(world: &World<f64>, numbers: &mut Numbers) -> Interaction {
    let facet = u32::from(numbers.next() < 0.5);
    let barycentric = sample_triangle([numbers.next(), numbers.next()]);
    let front = numbers.next() < 0.5;
    let own = &world.facets[facet as usize];
    let n = if front { own.front_normal } else { -own.front_normal };
    let position = own.point(barycentric);
    Interaction { facet, barycentric, position, n, front, distance_m: 1.0 }
}

/// Numbers in [0, 1) from a counter (Steele, Lea and Flood 2014, SplitMix64).
pub(in crate::photon) struct Numbers(pub(in crate::photon) u64);

impl Numbers {
    pub(in crate::photon) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
