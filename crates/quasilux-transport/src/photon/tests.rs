//! Invalid photons, from surfaces whose reflectance is not a number, infinite or negative.

use crate::context::{Context, Stream};
use crate::control::watch::Watch;
use crate::photon::batch::{PhotonBatch, trace_photons};
use crate::photon::counts::PhotonCounts;
use crate::photon::order::PhotonOrder;
use crate::photon::receiver::{PhotonReceiver, SeenPhoton};
use crate::photon::trace::{PhotonSetup, Source};
use crate::settings::Settings;
use crate::world::Interaction;
use crate::world::flight::Flight;
use glam::DVec3;
use quasilux_scene::bsdf::Diffuse;
use quasilux_scene::light::PointLight;
use quasilux_scene::{Bsdf, Light, Material, Mesh, Rgb, Scene};

const PHOTONS: u64 = 1000;

/// A lamp above a large floor of this reflectance.
fn floor(reflectance: f64) -> Scene {
    let corners = [(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)];
    let bsdf = Bsdf::Diffuse(Diffuse { reflectance: Rgb::grey(reflectance) });
    Scene {
        mesh: Mesh {
            positions: corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            material_of: vec![0; 2],
            object_of: vec![0; 2],
            objects: vec!["floor".into()],
        },
        materials: vec![Material { name: "odd".to_owned(), bsdf }],
        lights: vec![Light::Point(PointLight { position: DVec3::Z, intensity_cd: 1.0 })],
        ..Scene::default()
    }
}

/// Photons as they pass, none of which may be invalid.
struct Guard;

impl PhotonReceiver<f64> for Guard {
    fn flight(&mut self, _flight: &Flight, photon: &SeenPhoton<f64>) {
        let &SeenPhoton { weight, .. } = photon;
        assert!(weight >= 0.0 && weight.is_finite());
    }

    fn landing(&mut self, _at: &Interaction, photon: &SeenPhoton<f64>) {
        let &SeenPhoton { weight, .. } = photon;
        assert!(weight >= 0.0 && weight.is_finite());
    }
}

fn traced(reflectance: f64, order: PhotonOrder) -> PhotonCounts {
    let (scene, settings) = (floor(reflectance), Settings::default());
    let context = Context::<f64>::new(&scene, &settings);
    let batch = PhotonBatch {
        stream: Stream::Photons,
        replicates: 0..1,
        indices: 0..PHOTONS,
        order,
        setup: PhotonSetup::by_chance(Source::Lights, None),
    };
    trace_photons(&context, &batch, |_| Guard, &mut Watch::new(&mut ())).unwrap()
}

/// All that land are refused, once each, and the flux that they came with is absorbed.
#[test]
fn invalid_photons_end_and_are_counted() {
    for order in [PhotonOrder::OneByOne, PhotonOrder::Waves] {
        let valid = traced(0.5, order);
        assert_eq!(valid.invalid, 0);
        for bad in [f64::NAN, f64::INFINITY, -0.5, 1e300] {
            let counts = traced(bad, order);
            assert!(counts.events > PHOTONS / 4, "{bad}: {} landed", counts.events);
            assert_eq!(counts.invalid, counts.events, "{bad}");
            assert_eq!(counts.rays, PHOTONS, "{bad}");
            assert!((counts.share(counts.absorbed + counts.lost) - 1.0).abs() < 1e-12, "{bad}");
        }
    }
}
