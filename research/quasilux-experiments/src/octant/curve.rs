//! Errors against the number of samples and time.

use super::Effort;
use super::limit::{LEVELS, Ladder, Part};
use super::paper::TOTAL_LX;
use super::sphere::Octant;
use crate::building::points;
use crate::course::Course;
use quasilux_sampling::quality::fit_power_law;
use quasilux_sampling::{Randomization, Sequence};
use quasilux_transport::{EstimatorKind, Settings, Switch};

/// Photons fly on the finest mesh of the ladder.
const MAP_LEVEL: u32 = LEVELS as u32 - 1;
/// Slopes of photons are fitted from here on, where the element has some ten; those of ours where
/// its pilots are over.
const FITTED_PHOTONS: u64 = 1 << 8;
const FITTED_OURS: u64 = 1 << 6;

/// The paper's photons with points of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PhotonPoints {
    /// Pseudo-random numbers.
    Pseudo,
    /// Halton's points, Owen-scrambled anew in each randomisation; a rotation keeps them nearer to
    /// what they are, and the cube uses one.
    Quasi,
    /// Halton's points as they are: one run, as in the paper.
    QuasiOnce,
}

/// Errors of one setup at the place in the middle.
pub(super) struct Curve {
    pub(super) name: &'static str,
    pub(super) stops: Vec<Stop>,
    /// The order of convergence of the spread: elements and facets are not in it. None for a single
    /// run.
    pub(super) slope: Option<f64>,
}

/// What a setup knows after this many samples.
pub(super) struct Stop {
    /// Photons, or paths of each mesh.
    pub(super) samples: u64,
    /// Of one randomisation.
    pub(super) seconds: f64,
    /// Total illuminance, one value a randomisation, in lx.
    pub(super) lx: Vec<f64>,
}

impl PhotonPoints {
    pub(super) const ALL: [Self; 3] = [Self::Pseudo, Self::Quasi, Self::QuasiOnce];

    fn name(self) -> &'static str {
        match self {
            Self::Pseudo => "photons, pseudo",
            Self::Quasi => "photons, scrambled Halton",
            Self::QuasiOnce => "photons, plain Halton",
        }
    }

    fn sequence(self) -> Sequence {
        match self {
            Self::Pseudo => Sequence::Independent,
            Self::Quasi | Self::QuasiOnce => Sequence::Halton,
        }
    }

    fn randomization(self) -> Randomization {
        match self {
            Self::Quasi => Randomization::Owen,
            Self::Pseudo | Self::QuasiOnce => Randomization::None,
        }
    }
}

impl Curve {
    /// In the paper's form: photons of equal flux, each absorbed or scattered, counted by the
    /// element.
    pub(super) fn of_photons(way: PhotonPoints, effort: &Effort) -> Self {
        let octant = Octant::new(MAP_LEVEL);
        let (mut scene, element) = (octant.scene.clone(), octant.element());
        let facets: Vec<_> = element.iter().map(|facet| (facet.place, facet.normal)).collect();
        scene.sensors = vec![points(&facets)];
        let (sequence, randomization) = (way.sequence(), way.randomization());
        let settings = Settings {
            estimator: EstimatorKind::Photon,
            sequence,
            randomization,
            importance: Switch::Off,
            // No facet is cut: each counts by itself, and the element is all of them.
            map_adaptive: false,
            map_element_m: Some(1.0),
            replicates: effort.randomisations,
            max_samples: Some(effort.photons),
            seed: effort.seed,
            ..Settings::default()
        };
        let area_m2: f64 = element.iter().map(|facet| facet.area_m2).sum();
        let mean_lx = |row: &Vec<f64>| {
            let flux_lm = row.iter().zip(&element).map(|(lx, facet)| lx * facet.area_m2);
            flux_lm.sum::<f64>() / area_m2
        };
        let course = Course::run(&scene, &settings, effort.limit);
        let stops = course.snapshots.iter().map(|snapshot| Stop {
            samples: snapshot.samples,
            seconds: snapshot.seconds,
            lx: snapshot.estimates.sensors[0].replicate_lx.iter().map(mean_lx).collect(),
        });
        Self::new(way.name(), stops.collect(), FITTED_PHOTONS)
    }

    /// Our estimator: the limit of two meshes, the time of both, which is that for all places.
    pub(super) fn of_ladder(ladder: &Ladder) -> Self {
        let middle = ladder.octants[0].middle;
        let stops = (0..ladder.checkpoints()).map(|k| Stop {
            samples: ladder.courses[1].snapshots[k].samples,
            seconds: ladder.courses[1..].iter().map(|course| course.snapshots[k].seconds).sum(),
            lx: ladder.on_sphere_at(k, Part::Total, middle),
        });
        Self::new("bidirectional, Sobol'", stops.collect(), FITTED_OURS)
    }

    fn new(name: &'static str, stops: Vec<Stop>, fit_from: u64) -> Self {
        let fitted = stops.iter().filter(|stop| stop.samples >= fit_from);
        let spreads: Vec<[f64; 2]> =
            fitted.map(|stop| [stop.samples as f64, stop.spread()]).collect();
        Self { name, slope: fit_power_law(&spreads).map(|law| law.exponent), stops }
    }

    pub(super) fn last(&self) -> &Stop {
        self.stops.last().expect("a run has a checkpoint")
    }
}

impl Stop {
    /// Root mean square over the randomisations of the error over the paper's value.
    pub(super) fn error(&self) -> f64 {
        let squares = self.squares();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    /// Error of the mean over the value: what element and mesh leave, and some noise.
    pub(super) fn bias(&self) -> f64 {
        self.lx.iter().sum::<f64>() / self.lx.len() as f64 / TOTAL_LX - 1.0
    }

    /// The share of the error that is chance: standard deviation over the paper's value.
    fn spread(&self) -> f64 {
        let freedom = self.lx.len() as f64 / (self.lx.len() as f64 - 1.0);
        ((self.error() * self.error() - self.bias() * self.bias()).max(0.0) * freedom).sqrt()
    }

    /// Squared errors over the paper's value.
    pub(super) fn squares(&self) -> Vec<f64> {
        let square = |lx: &f64| (lx / TOTAL_LX - 1.0) * (lx / TOTAL_LX - 1.0);
        self.lx.iter().map(square).collect()
    }
}
