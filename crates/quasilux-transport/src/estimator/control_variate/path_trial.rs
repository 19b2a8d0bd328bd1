//! Pilot of path tracing nearly without Russian roulette, which records the vertices where paths
//! might have ended.

use super::replay::{PathRecords, RayCounts};
use crate::context::Context;
use crate::estimator::pilot::{REPLICATES, SAMPLES, Sample, Trial, TrialPaths, trace};
use crate::path::sections::Piece;
use crate::spectrum::Spectrum;
use crate::stats::tally::Quantum;
use crate::stats::targets::Target;

/// A trial of paths that go alone, and hardly end.
pub(crate) struct PathTrial<S> {
    pub(crate) trial: Trial,
    pub(crate) records: PathRecords<S>,
    /// Whether at every target most replicates whose paths came to surfaces that reflect found
    /// light that bounced: a spread says nothing of what is hardly ever found.
    pub(crate) finds_light: bool,
}

impl<S: Spectrum> PathTrial<S> {
    pub(crate) fn new(context: &Context<'_, S>, sample: &Sample, quantum: Quantum) -> Self {
        let paths = TrialPaths {
            targets: &sample.targets,
            replicates: REPLICATES.len(),
            is_recorded: true,
            partition: None,
            quantum,
        };
        let traced = trace(context, &paths, PathRecords::add).into_iter();
        let (pieces, records): (Vec<Piece>, Vec<PathRecords<S>>) =
            traced.map(|traced| (traced.piece, traced.records)).unzip();
        let finds_light = pieces.chunks(REPLICATES.len()).all(|of_target| {
            let sums = of_target.iter().map(|piece| &piece.sums[0]);
            let looked = sums.filter(|sums| sums.reflected > 0);
            let (found, all) = looked.fold((0, 0), |(found, all), sums| {
                (found + usize::from(!sums.indirect.is_zero()), all + 1)
            });
            2 * found >= all
        });
        let trial = Trial::from_pieces(pieces.iter(), quantum);
        let at_start: usize =
            sample.targets.iter().map(|target| asked_at_start(context, target)).sum();
        let rays = RayCounts {
            all: trial.rays,
            at_start: at_start as f64 * REPLICATES.len() as f64 * SAMPLES as f64,
            // It still looks for light that the next surface emits.
            at_end: if context.lights.emitters.is_some() { 1.0 } else { 0.0 },
        };
        Self { trial, records: PathRecords::all(records, rays), finds_light }
    }
}

/// Rays by which a path asks lights themselves where it starts, at most.
fn asked_at_start<S: Spectrum>(context: &Context<'_, S>, target: &Target) -> usize {
    let lights = &context.lights;
    let areas = usize::from(lights.emitters.is_some())
        + usize::from(context.images.show_emitters())
        + lights.area_luminaires.asked_at_sensor() as usize;
    match target {
        Target::Point { .. } => areas,
        Target::Cell { .. } => areas + lights.pointlikes.len(),
    }
}
