//! The ways that are compared: how light is followed, with which points.

use quasilux_sampling::{Randomization, Sequence};
use quasilux_transport::{EstimatorKind, Reconstruction, Settings, Switch};
use std::f64::consts::SQRT_2;

/// How light is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Form {
    /// The paper's direct method: photons are counted on the elements of a map, whose legs have
    /// this length, and a place reads its element.
    Photons { element_m: f64 },
    /// The paper's bidirectional method: this many photons for each path from a place, which ends
    /// on the same map.
    Map { element_m: f64, photons_per_path: u32 },
    /// Our own: the default, paths from the places that are connected to light subpaths.
    Own,
}

/// Which points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Points {
    Independent,
    Halton,
    /// As they are: a single run.
    PlainHalton,
    Hammersley,
    Sobol,
    ScrambledSobol,
    Faure4,
}

/// A way that is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Setup {
    pub(super) form: Form,
    pub(super) points: Points,
}

impl Points {
    /// All that are randomised, but the random ones, which are no sequence.
    pub(super) const SEQUENCES: [Self; 5] =
        [Self::Halton, Self::Hammersley, Self::Sobol, Self::ScrambledSobol, Self::Faure4];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Independent => "random",
            Self::Halton => "halton",
            Self::PlainHalton => "plain halton",
            Self::Hammersley => "hammersley",
            Self::Sobol => "sobol",
            Self::ScrambledSobol => "scrambled sobol",
            Self::Faure4 => "faure4",
        }
    }

    /// What makes replicates independent: for the paper's points a rotation, which leaves them what
    /// they are.
    pub(super) fn randomization(self) -> Randomization {
        match self {
            Self::Independent | Self::PlainHalton => Randomization::None,
            Self::Halton | Self::Hammersley => Randomization::CranleyPattersonRotation,
            Self::Sobol => Randomization::DigitalShift,
            Self::ScrambledSobol | Self::Faure4 => Randomization::Owen,
        }
    }

    /// Plain points with low indices are near 0 in all high coordinates, and such photons would
    /// never be absorbed: that of index 0 goes to and fro between two walls. With the reflectance
    /// of the cube (2/3)^21 of the light is left out, 0.02 %.
    pub(super) fn max_bounces(self) -> Option<u32> {
        (self == Self::PlainHalton).then_some(20)
    }

    /// The sequence of a run of this many indices.
    fn sequence(self, samples: u64) -> Sequence {
        match self {
            Self::Independent => Sequence::Independent,
            Self::Halton | Self::PlainHalton => Sequence::Halton,
            Self::Hammersley => Sequence::Hammersley { points: samples },
            Self::Sobol | Self::ScrambledSobol => Sequence::Sobol,
            Self::Faure4 => Sequence::Faure4,
        }
    }
}

impl Form {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Photons { .. } => "photons",
            Self::Map { .. } => "photons and paths",
            Self::Own => "own",
        }
    }

    /// Legs of the map's elements.
    pub(super) fn element_m(self) -> Option<f64> {
        match self {
            Self::Photons { element_m } | Self::Map { element_m, .. } => Some(element_m),
            Self::Own => None,
        }
    }

    /// Photons for each index of a run; one path for each place with it, but where only photons
    /// count.
    fn photons_per_index(self) -> u64 {
        match self {
            Self::Photons { .. } | Self::Own => 1,
            Self::Map { photons_per_path, .. } => u64::from(photons_per_path),
        }
    }

    /// N of a run of this many indices: photons of a replicate; in our own form, paths from a
    /// place.
    pub(super) fn n(self, samples: u64) -> u64 {
        samples * self.photons_per_index()
    }

    /// Paths from each place.
    pub(super) fn paths(self, samples: u64) -> u64 {
        match self {
            Self::Photons { .. } => 0,
            Self::Map { .. } | Self::Own => samples,
        }
    }

    /// Indices of a run up to this N.
    pub(super) fn samples(self, n: u64) -> u64 {
        (n / self.photons_per_index()).max(1)
    }
}

impl Setup {
    /// What the engine is asked for: in the paper's forms nothing that the paper does not have, so
    /// that photons keep equal flux and elements are of one size and hold one number.
    pub(super) fn settings(self, samples: u64, replicates: u32, seed: u64) -> Settings {
        let own = Settings {
            estimator: EstimatorKind::Auto,
            sequence: self.points.sequence(samples),
            randomization: self.points.randomization(),
            rel_tol: 0.0,
            replicates,
            seed,
            max_samples: Some(samples),
            max_bounces: self.points.max_bounces(),
            ..Settings::default()
        };
        let of_paper = |estimator, element_m: f64| Settings {
            estimator,
            first_shot: Switch::Off,
            importance: Switch::Off,
            map_adaptive: false,
            map_reconstruction: Reconstruction::Constant,
            // Walls are two triangles, cut by their longest edge; a little more, lest rounding adds
            // a part.
            map_element_m: Some(element_m * SQRT_2 * (1.0 + 1e-9)),
            ..own.clone()
        };
        match self.form {
            Form::Photons { element_m } => of_paper(EstimatorKind::Photon, element_m),
            Form::Map { element_m, photons_per_path } => Settings {
                map_photons: photons_per_path,
                ..of_paper(EstimatorKind::BidirectionalMap, element_m)
            },
            Form::Own => own,
        }
    }
}
