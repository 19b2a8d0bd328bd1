//! How half-widths shrank, in the result document.

use quasilux_transport::Convergence;
use serde::Serialize;

/// The object `prediction` of `run`: `slope`, the measured exponent of N in half-widths; the `samples` and
/// `rays` at which the tolerance should be reached, or was; `half_width_ratio`, half-widths over what had
/// been foretold for them two checkpoints before.
#[derive(Serialize)]
pub(super) struct PredictionEntry {
    slope: Option<f64>,
    samples: Option<u64>,
    rays: Option<u64>,
    half_width_ratio: Option<f64>,
}

impl PredictionEntry {
    pub(super) fn of(convergence: Convergence) -> Self {
        let Convergence { slope, samples, rays, against_prediction } = convergence;
        let finite = |x: &f64| x.is_finite();
        Self {
            slope: slope.filter(finite),
            samples,
            rays,
            half_width_ratio: against_prediction.filter(finite),
        }
    }
}
