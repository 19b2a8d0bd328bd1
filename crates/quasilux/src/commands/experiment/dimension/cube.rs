//! The coordinates of the paper's cube, counted by the cursor.

use super::Claim;
use super::room::{REFLECTANCE, Room};
use super::walk::{Features, Walk};
use crate::commands::experiment::building::{grey, lamp, points, room};
use glam::DVec3;
use quasilux_sampling::{PointSet, Randomization, SampleCursor, Sequence, stream_key};
use quasilux_transport::{Dimensions, Estimator, Settings, simulate};

/// Coordinates a photon or path, and standard errors of these means.
pub(super) struct Cube {
    /// The program's photons: superposition, the absorbing event counted.
    pub(super) photons: f64,
    /// The same without the one coordinate of the absorbing event.
    pub(super) uncounted: f64,
    /// Without superposition.
    pub(super) separate: f64,
    /// Backward paths that end on the map.
    pub(super) paths: f64,
    /// Photons of each kind.
    pub(super) count: u64,
}

impl Cube {
    pub(super) fn count(photons: u64, seed: u64) -> Self {
        let per_replicate = (photons / 16).max(64);
        let of_program = |estimator| -> Dimensions {
            let mut scene = room(DVec3::splat(10.0), grey(REFLECTANCE));
            lamp(&mut scene, DVec3::splat(5.0), 50_000.0);
            scene.sensors.push(points(&[(DVec3::new(0.0, 5.0, 5.0), DVec3::X)]));
            let settings = Settings {
                estimator,
                max_samples: Some(per_replicate),
                rel_tol: 0.0,
                seed,
                ..Settings::default()
            };
            simulate(&scene, &settings, &mut ()).dimensions
        };
        let photons = of_program(Estimator::Photon).photon.mean();
        let separate = {
            let cube = Room::cube();
            let features = Features { light: false, event: false, inverse: true };
            let walk = Walk { room: &cube, features };
            let points =
                PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(seed, 0, 0));
            let count = 16 * per_replicate;
            let used = |index| {
                let mut cursor = SampleCursor::new(&points, index);
                walk.photon(&mut cursor, &mut |_| ());
                u64::from(cursor.used())
            };
            (0..count).map(used).sum::<u64>() as f64 / count as f64
        };
        let paths = of_program(Estimator::BidirectionalMap).path.mean();
        let count = 16 * per_replicate;
        // Each photon is absorbed once.
        Self { photons, uncounted: photons - 1.0, separate, paths, count }
    }

    /// A photon has n hits with probability a^(n - 1) (1 - a): 3 in the mean, sqrt a / (1 - a) = 2.45 deviation. With two
    /// coordinates a hit, or three without superposition, that is the standard error of random points;
    /// Sobol' points stay within it.
    pub(super) fn claims(&self) -> Vec<Claim> {
        let deviation = libm::sqrt(REFLECTANCE) / (1.0 - REFLECTANCE);
        let error = |each: f64| 4.0 * each * deviation / libm::sqrt(self.count as f64);
        let claim = |what: &str, got: f64, expected: f64, allowed: f64| Claim {
            text: format!(
                "{what}: {got:.3} coordinates, {expected} expected (within {allowed:.3})"
            ),
            holds: (got - expected).abs() <= allowed,
        };
        vec![
            claim(
                "Photons of the cube, absorbing event uncounted",
                self.uncounted,
                6.0,
                error(2.0),
            ),
            claim("Photons of the cube by superposition", self.photons, 7.0, error(2.0)),
            claim("Photons of the cube without superposition", self.separate, 9.0, error(3.0)),
            claim("Backward paths in the paper's form", self.paths, 2.0, 0.0),
        ]
    }
}
