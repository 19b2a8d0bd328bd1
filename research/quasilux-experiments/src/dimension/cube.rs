//! The coordinates of the paper's cube, counted by the sampler.

use super::Claim;
use super::room::{REFLECTANCE, Room};
use super::walk::{Features, PhotonTracer};
use crate::building::{grey, lamp, points, room};
use glam::DVec3;
use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence, stream_key};
use quasilux_transport::{Dimensions, EstimatorKind, Settings, simulate};

/// Coordinates a photon or path, and standard errors of these means.
pub(super) struct Cube {
    /// The program's photons: superposition, the absorbing event counted.
    pub(super) photons: f64,
    /// This experiment's own walk: what the sampler has handed out when the absorbing event comes.
    pub(super) uncounted: f64,
    /// The same walk without superposition, to its end.
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
        let count = 16 * per_replicate;
        let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(seed, 0, 0));
        let cube = Room::cube();
        // Before the absorbing event, and in all.
        let of_walk = |features: Features| -> [f64; 2] {
            let walk = PhotonTracer { room: &cube, features };
            let mut sums = [0; 2];
            for index in 0..count {
                let mut sampler = Sampler::new(&points, index);
                let before = walk.photon(&mut sampler, &mut |_| ());
                sums[0] += u64::from(before);
                sums[1] += u64::from(sampler.used());
            }
            sums.map(|sum| sum as f64 / count as f64)
        };
        let [uncounted, _] = of_walk(Features::FULL);
        let [_, separate] = of_walk(Features { light: false, event: false, inverse: true });
        let photons = of_program(EstimatorKind::Photon).photon.mean();
        let paths = of_program(EstimatorKind::BidirectionalMap).path.mean();
        Self { photons, uncounted, separate, paths, count }
    }

    /// A photon has n hits with probability a^(n - 1) (1 - a): 3 in the mean, sqrt a / (1 - a) =
    /// 2.45 deviation. With two coordinates a hit, or three without superposition, that is the
    /// standard error of random points; Sobol' points stay within it.
    pub(super) fn claims(&self) -> Vec<Claim> {
        let deviation = libm::sqrt(REFLECTANCE) / (1.0 - REFLECTANCE);
        let error = |each: f64| 4.0 * each * deviation / libm::sqrt(self.count as f64);
        let claim = |what: &str, got: f64, expected: f64, allowed: f64| {
            Claim::new(
                format!(
                    "{what}: {got:.3} coordinates, {expected} expected (within {allowed:.3}, four \
                     standard errors)"
                ),
                [got, allowed],
                (got - expected).abs() <= allowed,
            )
        };
        vec![
            claim(
                "Photons of the cube in this experiment's own walk, before the event that absorbs \
                 them",
                self.uncounted,
                6.0,
                error(2.0),
            ),
            claim("Photons of the cube in the program", self.photons, 7.0, error(2.0)),
            claim(
                "Photons of the cube in the experiment's walk without superposition",
                self.separate,
                9.0,
                error(3.0),
            ),
            claim("Backward paths in the paper's form in the program", self.paths, 2.0, 0.0),
        ]
    }
}
