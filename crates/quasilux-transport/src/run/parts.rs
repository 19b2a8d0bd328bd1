//! A run cut into parts by its indices, to be computed anywhere and put together.
//!
//! The number of samples is fixed beforehand: every point gets all of them, whatever the tolerance, for no part
//! knows when the others have enough. There is one checkpoint, and its intervals are those of a single look. A part is a function of scene, settings, the number of samples and its range of
//! indices. Photons that serve all paths, those of maps that grow and those that find hidden light, are not cut:
//! every part traces all of them.

use crate::codec::{Reader, StateError, Writer};
use crate::context::Stage;
use crate::estimator::{Estimation, estimation};
use crate::run::pixels::add_pictures;
use crate::run::simulate::look;
use crate::settings::Settings;
use crate::spectrum::{Spectrum, is_grey};
use crate::stats::decisions::Decisions;
use crate::stats::estimates::Estimates;
use crate::stats::observer::Observer;
use crate::stats::watch::Watch;
use quasilux_scene::{Rgb, Scene};
use std::ops::Range;
use thiserror::Error;

/// What surveys and pilots decide for these settings.
#[must_use]
pub fn decide(scene: &Scene, settings: &Settings) -> Decisions {
    fn of<S: Spectrum>(scene: &Scene, settings: &Settings) -> Decisions {
        let stage = Stage::<S>::new(scene, settings);
        let mut nobody = ();
        estimation(&stage, scene, settings, &mut Watch::new(&mut nobody)).decisions()
    }
    if is_grey(scene) { of::<f64>(scene, settings) } else { of::<Rgb>(scene, settings) }
}

/// Traces the indices `part` of a run of so many `samples` in all replicates, for [`merge`]; `None` when the
/// observer stopped it.
#[must_use]
pub fn trace_part(
    scene: &Scene,
    settings: &Settings,
    samples: u64,
    part: Range<u64>,
    observer: &mut dyn Observer,
) -> Option<Vec<u8>> {
    let watch = &mut Watch::new(observer);
    if is_grey(scene) {
        trace::<f64>(scene, settings, samples, part, watch)
    } else {
        trace::<Rgb>(scene, settings, samples, part, watch)
    }
}

/// Why parts do not make a run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("part {part}: {error}")]
pub struct MergeError {
    /// Number of the part that is to blame, in the order in which they were given.
    pub part: usize,
    /// What is wrong with it.
    pub error: StateError,
}

/// Puts together what [`trace_part`] made of ranges that follow each other from 0 to `samples` without gaps,
/// in any order; then takes the pictures of the cameras. The result has the bits of a run in one part.
///
/// # Errors
/// When a part is damaged, or of another run.
pub fn merge(
    scene: &Scene,
    settings: &Settings,
    samples: u64,
    parts: &[&[u8]],
    observer: &mut dyn Observer,
) -> Result<Estimates, MergeError> {
    let watch = &mut Watch::new(observer);
    if is_grey(scene) {
        put_together::<f64>(scene, settings, samples, parts, watch)
    } else {
        put_together::<Rgb>(scene, settings, samples, parts, watch)
    }
}

fn trace<S: Spectrum>(
    scene: &Scene,
    settings: &Settings,
    samples: u64,
    part: Range<u64>,
    watch: &mut Watch<'_>,
) -> Option<Vec<u8>> {
    let stage = Stage::<S>::new(scene, settings);
    let mut estimation = estimation(&stage, scene, settings, watch);
    // There is no checkpoint before the end, and so no result if it is stopped.
    watch.obey();
    let mut out = Writer::default();
    out.bytes(&estimation.decisions().digest);
    if !estimation.trace_part(part, samples, watch) {
        return None;
    }
    out.block(|out| estimation.put_served(out));
    out.block(|out| estimation.put_part(out));
    Some(out.finish())
}

fn put_together<S: Spectrum>(
    scene: &Scene,
    settings: &Settings,
    samples: u64,
    parts: &[&[u8]],
    watch: &mut Watch<'_>,
) -> Result<Estimates, MergeError> {
    let stage = Stage::<S>::new(scene, settings);
    let mut estimation = estimation(&stage, scene, settings, watch);
    let decisions = estimation.decisions();
    let mut served = None;
    for (number, part) in parts.iter().enumerate() {
        add(estimation.as_mut(), part, &decisions.digest, &mut served)
            .map_err(|error| MergeError { part: number, error })?;
    }
    estimation.complete_at(samples);
    let (mut estimates, _) =
        look(&stage, scene, settings, estimation.as_ref(), 1.0 - settings.confidence);
    estimates.decisions = decisions;
    drop(estimation);
    add_pictures(&stage, scene, settings, &mut estimates, watch);
    Ok(estimates)
}

/// Adds a part; `served` is what the parts before it have in common.
fn add<'b>(
    estimation: &mut (dyn Estimation + '_),
    part: &'b [u8],
    digest: &[u8; 32],
    served: &mut Option<&'b [u8]>,
) -> Result<(), StateError> {
    let mut from = Reader::new(part);
    if from.bytes(digest.len())? != digest {
        return Err(StateError::Decisions);
    }
    let (own_served, own) = (from.block()?, from.block()?);
    from.end()?;
    match *served {
        None => {
            let mut from = Reader::new(own_served);
            estimation.take_in_served(&mut from)?;
            from.end()?;
            *served = Some(own_served);
        }
        Some(served) if served == own_served => {}
        Some(_) => return Err(StateError::Unfit("what photons for all paths found")),
    }
    let mut from = Reader::new(own);
    estimation.take_in_part(&mut from)?;
    from.end()
}
