//! The floor under the errors of the paper's forms, for elements of several sizes.
//!
//! Were it noise, it would not know the elements; as the bias of a map of finite elements it grows
//! with them.

use super::bias::Bias;
use super::curve::Curve;
use super::setup::{Form, Points, Setup};
use super::task::Task;
use crate::claim::smallest;
use quasilux_sampling::quality::{PowerLaw, fit_power_law};

/// Legs of the elements: 4 to 32 on a side.
pub(super) const ELEMENTS_M: [f64; 4] = [2.5, 1.25, 0.625, 0.3125];

/// What is left of both forms' errors with elements of one size.
pub(super) struct Floor {
    pub(super) element_m: f64,
    pub(super) photons: End,
    pub(super) map: End,
}

/// The end of a run with Halton points.
pub(super) struct End {
    pub(super) n: u64,
    /// Of one replicate.
    pub(super) rms: f64,
    /// Of very many.
    pub(super) bias: Bias,
}

impl Floor {
    /// All sizes, large ones first.
    pub(super) fn all(elements_m: &[f64], photons_per_path: u32, task: &Task) -> Vec<Self> {
        let floor = |&element_m: &f64| Self {
            element_m,
            photons: End::new(Form::Photons { element_m }, task),
            map: End::new(Form::Map { element_m, photons_per_path }, task),
        };
        elements_m.iter().map(floor).collect()
    }

    /// The power of the legs that the floors follow.
    pub(super) fn law(floors: &[Self], of: fn(&Self) -> &End) -> Option<PowerLaw> {
        let points: Vec<[f64; 2]> =
            floors.iter().map(|floor| [floor.element_m, of(floor).bias.norm()]).collect();
        fit_power_law(&points)
    }

    /// By how many standard errors each floor is below the one before, of their squares: the least
    /// of all.
    pub(super) fn least_step(floors: &[Self], of: fn(&Self) -> &End) -> f64 {
        let step = |pair: &[Self]| {
            let [large, small] = [of(&pair[0]).bias, of(&pair[1]).bias];
            let error = libm::hypot(large.standard_error, small.standard_error);
            (large.squared - small.squared) / error
        };
        smallest(floors.windows(2).map(step))
    }
}

impl End {
    fn new(form: Form, task: &Task) -> Self {
        let curve = Curve::run(Setup { form, points: Points::Halton }, task);
        let end = curve.end();
        Self { n: end.n, rms: end.rms(), bias: end.bias }
    }
}
