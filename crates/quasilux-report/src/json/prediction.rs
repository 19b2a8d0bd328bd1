//! The predictions of a run about itself, in the result document.

use crate::Run;
use quasilux_transport::Convergence;
use serde::Serialize;

/// The object `prediction` of `run`: `slope`, the measured exponent of N in half-widths; the
/// `samples`, `rays`, `seconds` and `bytes` of memory at which the tolerance should be reached, or
/// was, whatever limit came first, the whole program on this many threads; `half_width_ratio`,
/// half-widths over what had been predicted for them two checkpoints before, a geometric mean over
/// the run.
#[derive(Serialize)]
pub(super) struct PredictionEntry {
    slope: Option<f64>,
    samples: Option<u64>,
    rays: Option<u64>,
    seconds: Option<f64>,
    bytes: Option<u64>,
    half_width_ratio: Option<f64>,
}

impl PredictionEntry {
    pub(super) fn new(run: &Run) -> Self {
        let Convergence { slope, samples, rays, against_prediction } = run.convergence;
        let finite = |x: &f64| x.is_finite();
        Self {
            slope: slope.filter(finite),
            samples,
            rays,
            seconds: run.expected_seconds(),
            bytes: run.expected_bytes,
            half_width_ratio: against_prediction.filter(finite),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::example;
    use crate::json::json;
    use serde_json::Value;

    #[test]
    fn time_is_predicted_at_the_pace_of_the_run() {
        let mut report = example::office();
        let prediction = |report: &crate::Report| -> Value {
            let document: Value = serde_json::from_str(&json(report)).expect("valid JSON");
            document["run"]["prediction"].clone()
        };
        report.run.convergence.rays = Some(4 * report.run.rays);
        assert_eq!(prediction(&report)["seconds"], 4.0 * report.run.seconds);
        assert_eq!(prediction(&report)["bytes"], 96 << 20);
        report.run.earlier_rays = report.run.rays / 2;
        report.run.earlier_seconds = report.run.seconds;
        report.run.seconds += 1.0;
        assert!((prediction(&report)["seconds"].as_f64().unwrap() - 8.0).abs() < 1e-6);
        report.run.earlier_rays = report.run.rays;
        assert_eq!(prediction(&report)["seconds"], Value::Null);
        report.run.convergence.rays = None;
        report.run.earlier_rays = 0;
        assert_eq!(prediction(&report)["seconds"], Value::Null);
    }
}
