//! Estimators of sensor values. The settings name one, nothing picks it: `auto` is `bidirectional`,
//! also where documents say `auto` (`run.estimator`); years and daylight factors take `path`.

pub(crate) mod bidirectional;
pub(crate) mod block;
pub(crate) mod exact;
pub(crate) mod path_estimator;
pub(crate) mod photon_estimator;
pub(crate) mod progress;

use crate::codec::{Reader, StateError, Writer};
use crate::context::Context;
use crate::control::watch::Watch;
use crate::estimator::bidirectional::BidirectionalEstimator;
use crate::estimator::block::BlockFrame;
use crate::estimator::path_estimator::PathEstimator;
use crate::estimator::photon_estimator::PhotonEstimator;
use crate::settings::{EstimatorKind, Settings};
use crate::spectrum::Spectrum;
use crate::stats::decisions::Decisions;
use crate::stats::estimates::Estimates;
use quasilux_scene::Scene;
use std::ops::Range;

/// An estimator at work: one variant of [`EstimatorKind`] or several close ones.
pub(crate) trait Estimator {
    /// Adds the indices up to `samples` to all replicates; `false` when the observer stopped it
    /// half-way, which leaves it unusable.
    #[must_use]
    fn advance(&mut self, samples: u64, watch: &mut Watch<'_>) -> bool;

    /// Decisions made before the first sample.
    fn decisions(&self) -> Decisions;

    /// Puts out all that has grown; called between pieces of the work.
    fn put(&self, out: &mut Writer);

    /// Takes in what [`Self::put`] put out, before the first sample, so that [`Self::advance`] to
    /// the checkpoint `coming` does what is left.
    fn merge_from(&mut self, coming: u64, from: &mut Reader<'_>) -> Result<(), StateError>;

    /// Before the first sample: traces the indices of a part of a run of `samples`, and
    /// the photons that all parts share; `false` when the observer stopped it.
    #[must_use]
    fn trace_part(&mut self, part: Range<u64>, samples: u64, watch: &mut Watch<'_>) -> bool;

    /// Puts out what serves all indices, as far as estimates need it: the same in all parts.
    fn put_shared(&self, out: &mut Writer);

    /// Takes in what [`Self::put_shared`] put out, once.
    fn merge_shared(&mut self, from: &mut Reader<'_>) -> Result<(), StateError>;

    /// Puts out what belongs to the indices of a part.
    fn put_part(&self, out: &mut Writer);

    /// Adds what [`Self::put_part`] put out.
    fn merge_part(&mut self, from: &mut Reader<'_>) -> Result<(), StateError>;

    /// Traces a block of the work of another process, for what that adds to its sums; those of
    /// its own mean nothing from here on.
    fn trace_block(&mut self, frame: &BlockFrame, block: Range<u64>)
    -> Result<Vec<u8>, StateError>;

    /// Declares the sums complete up to `samples`.
    fn complete_at(&mut self, samples: u64);

    /// Estimates so far. Settings, intervals and warnings are filled in by the caller.
    fn estimates(&self) -> Estimates;

    /// Stops sampling converged targets;
    /// `false` where samples are for all targets.
    fn freeze_converged(&mut self, _done: &[bool]) -> bool {
        false
    }

    /// Indices per replicate of the first checkpoint: enough to plan by, little work.
    fn first_checkpoint(&self) -> u64;
}

/// Why a trace that no observer can stop has a result.
pub(crate) const UNSTOPPED: &str = "nobody stops it";

/// The estimator of the settings, its plan made; `None` when the observer stopped it before that.
pub(crate) fn new_estimator<'a, S: Spectrum>(
    context: &'a Context<'a, S>,
    scene: &'a Scene,
    settings: &Settings,
    watch: &mut Watch<'_>,
) -> Option<Box<dyn Estimator + 'a>> {
    let estimator: Box<dyn Estimator + 'a> = match settings.estimator {
        EstimatorKind::Photon => Box::new(PhotonEstimator::new(context, scene, settings)),
        EstimatorKind::Auto | EstimatorKind::Bidirectional => {
            Box::new(BidirectionalEstimator::new(context, scene, settings, watch)?)
        }
        EstimatorKind::Path | EstimatorKind::BidirectionalMap => {
            Box::new(PathEstimator::new(context, scene, settings, watch)?)
        }
    };
    // A plan that was stopped half-way is none.
    (!watch.has_stopped()).then_some(estimator)
}
