//! What the sequence of a run is worth: errors of independent replicates.

use super::shares::{Spread, power};
use super::{FIRST_OF_GAIN, Gain, SampleSource};
use crate::context::Stream;
use crate::settings::Settings;
use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

/// Independent randomisations.
const REPLICATES: u32 = 16;
/// The larger number of samples over the smaller.
const RATIO: u64 = 16;

/// The gain over pseudo-random points, whose error follows from the spread of single samples.
pub(super) fn gain(
    walk: &dyn SampleSource,
    settings: &Settings,
    spread: &Spread<'_>,
    rays: &mut u64,
) -> Option<Gain> {
    let is_random = settings.sequence == Sequence::Independent;
    if !spread.varies() || (settings.randomization == Randomization::None && !is_random) {
        return None;
    }
    let mut variance = |samples: u64| {
        let sequence = |stream: Stream| match stream.sequence(settings.sequence) {
            Sequence::Hammersley { .. } => Sequence::Hammersley { points: samples },
            other => other,
        };
        let means = |replicate: u32| -> Vec<f64> {
            let key =
                |stream: Stream| stream_key(settings.seed, FIRST_OF_GAIN + replicate, stream.id());
            let points =
                |stream| PointSet::new(sequence(stream), settings.randomization, key(stream));
            let pilot = walk.trace(samples, &points);
            *rays += pilot.rays;
            pilot.values.iter().map(|own| own.iter().sum::<f64>() / samples as f64).collect()
        };
        spread.variance_between(&(0..REPLICATES).map(means).collect::<Vec<_>>())
    };
    let samples = walk.samples();
    let [few, all] = [samples / RATIO, samples].map(&mut variance);
    let exponent = power([all, few], [RATIO as f64, 1.0]).map(|power| -0.5 * power)?;
    let factor = (spread.variance() / samples as f64 / all).sqrt();
    // A standard deviation from n values has the relative standard error 1 / sqrt(2 (n - 1)).
    let independent = walk.kind().samples_an_index(spread.targets());
    let degrees = independent as f64 * f64::from(REPLICATES - 1);
    let standard_error = factor / (2.0 * degrees).sqrt();
    Some(Gain { samples, replicates: REPLICATES, factor, standard_error, exponent })
}
