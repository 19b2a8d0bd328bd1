//! Blocks of a run that is controlled elsewhere.

use crate::codec::{Reader, StateError};
use crate::context::Context;
use crate::control::watch::Watch;
use crate::estimator::block::BlockFrame;
use crate::estimator::{UNSTOPPED, new_estimator};
use crate::prepared::PreparedScene;
use crate::settings::Settings;
use crate::spectrum::{Spectrum, is_grey};
use quasilux_scene::Rgb;
use std::ops::Range;

/// Traces blocks for [`crate::simulate_with_workers`] in another process.
pub struct BlockTracer<'t> {
    trace: &'t mut Trace<'t>,
}

/// From a frame and a range to the bytes of its sums.
type Trace<'t> = dyn FnMut(&[u8], Range<u64>) -> Result<Vec<u8>, StateError> + 't;

impl BlockTracer<'_> {
    /// Traces the part `block` of the work in `frame`, with the threads of the rayon pool that the
    /// call is made in; the same bytes whenever and wherever it is done.
    ///
    /// # Errors
    /// When the frame is damaged or of another run, and when maps have grown past it: a new tracer
    /// can do what this one cannot then.
    pub fn trace(&mut self, frame: &[u8], block: Range<u64>) -> Result<Vec<u8>, StateError> {
        (self.trace)(frame, block)
    }
}

/// Makes a scene ready for tracing blocks, surveys and pilots included, and lets `work` do so.
pub fn trace_blocks<'a, T>(
    scene: impl Into<PreparedScene<'a>>,
    settings: &Settings,
    work: impl FnOnce(&mut BlockTracer<'_>) -> T,
) -> T {
    let prepared = scene.into();
    if is_grey(prepared.scene()) {
        serve::<f64, T>(prepared, settings, work)
    } else {
        serve::<Rgb, T>(prepared, settings, work)
    }
}

fn serve<S: Spectrum, T>(
    prepared: PreparedScene<'_>,
    settings: &Settings,
    work: impl FnOnce(&mut BlockTracer<'_>) -> T,
) -> T {
    let scene = prepared.scene();
    let context = Context::<S>::new(prepared, settings);
    let mut nobody = ();
    let watch = &mut Watch::new(&mut nobody);
    let mut estimator = new_estimator(&context, scene, settings, watch).expect(UNSTOPPED);
    let decisions = estimator.decisions().digest;
    let mut trace = |frame: &[u8], block: Range<u64>| {
        let mut from = Reader::new(frame);
        if from.bytes(decisions.len())? != decisions {
            return Err(StateError::Decisions);
        }
        let frame: BlockFrame = from.value()?;
        from.end()?;
        estimator.trace_block(&frame, block)
    };
    work(&mut BlockTracer { trace: &mut trace })
}
