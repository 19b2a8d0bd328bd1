//! A run cut into parts by its indices, to be computed anywhere and put together.
//!
//! The number of samples is fixed beforehand: every point gets all of them, whatever the tolerance,
//! for no part knows when the others have enough. There is one checkpoint, and its intervals are
//! those of a single look. A part is a function of scene, settings, the number of samples and its
//! range of indices. Photons that serve all paths, those of maps that grow and those that find
//! hidden light, are not cut: every part traces all of them.

use crate::codec::{Reader, StateError, Writer};
use crate::context::Context;
use crate::control::observer::Observer;
use crate::control::watch::Watch;
use crate::estimator::{Estimator, UNSTOPPED, new_estimator};
use crate::pictures::camera_run::add_pictures;
use crate::prepared::PreparedScene;
use crate::run::simulate::{Look, Sums, look};
use crate::settings::Settings;
use crate::spectrum::{Spectrum, is_grey};
use crate::stats::decisions::Decisions;
use crate::stats::estimates::Estimates;
use quasilux_scene::{Rgb, Scene};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::ops::Range;
use thiserror::Error;

/// Decisions of surveys and pilots for these settings.
#[must_use]
pub fn decide(scene: &Scene, settings: &Settings) -> Decisions {
    fn decide_in<S: Spectrum>(scene: &Scene, settings: &Settings) -> Decisions {
        let context = Context::<S>::new(scene, settings);
        let mut nobody = ();
        new_estimator(&context, scene, settings, &mut Watch::new(&mut nobody))
            .expect(UNSTOPPED)
            .decisions()
    }
    if is_grey(scene) {
        decide_in::<f64>(scene, settings)
    } else {
        decide_in::<Rgb>(scene, settings)
    }
}

/// Traces the indices `part` of a run of this many `samples` in all replicates, for [`merge`];
/// `None` when the observer stopped it.
#[must_use]
pub fn trace_part<'a>(
    scene: impl Into<PreparedScene<'a>>,
    settings: &Settings,
    samples: u64,
    part: Range<u64>,
    observer: &mut dyn Observer,
) -> Option<Vec<u8>> {
    let (prepared, watch) = (scene.into(), &mut Watch::new(observer));
    if is_grey(prepared.scene()) {
        trace::<f64>(prepared, settings, samples, part, watch)
    } else {
        trace::<Rgb>(prepared, settings, samples, part, watch)
    }
}

/// Why parts do not make a run. Parts are numbered from 0 in the order in which they were given.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MergeError {
    /// The bytes of a part are damaged, or pilots decide otherwise here than where it was traced.
    #[error("part {part}: {error}")]
    Part {
        /// Number of the part.
        part: usize,
        /// Why its bytes are refused.
        error: StateError,
    },
    /// A part was traced in another scene, with other settings, or for another number of samples.
    #[error("part {part} belongs to another scene, other settings or another number of samples")]
    Foreign {
        /// Number of the part.
        part: usize,
    },
    /// The indices of a part end before they begin, or behind the last sample of the run.
    #[error(
        "part {part} has the indices from {} to before {}, of {samples}",
        .range.start, .range.end
    )]
    Range {
        /// Number of the part.
        part: usize,
        /// Its indices.
        range: Range<u64>,
        /// Samples of the run.
        samples: u64,
    },
    /// Two parts have indices in common, whose samples would count twice.
    #[error("parts {} and {} overlap: both have index {index}", .parts[0], .parts[1])]
    Overlap {
        /// Numbers of the two parts.
        parts: [usize; 2],
        /// The first index that they share.
        index: u64,
    },
    /// No part has these indices.
    #[error("no part has the indices from {} to before {}", .missing.start, .missing.end)]
    Gap {
        /// The first indices that are missing.
        missing: Range<u64>,
    },
}

/// Puts together what [`trace_part`] made of ranges that follow each other from 0 to `samples`
/// without gaps, in any order; then takes the pictures of the cameras. The result has the bits of a
/// run in one part.
///
/// # Errors
/// When a part is damaged or of another run, when parts overlap, and when indices are missing.
pub fn merge<'a>(
    scene: impl Into<PreparedScene<'a>>,
    settings: &Settings,
    samples: u64,
    parts: &[&[u8]],
    observer: &mut dyn Observer,
) -> Result<Estimates, MergeError> {
    let (prepared, watch) = (scene.into(), &mut Watch::new(observer));
    if is_grey(prepared.scene()) {
        put_together::<f64>(prepared, settings, samples, parts, watch)
    } else {
        put_together::<Rgb>(prepared, settings, samples, parts, watch)
    }
}

fn trace<S: Spectrum>(
    prepared: PreparedScene<'_>,
    settings: &Settings,
    samples: u64,
    part: Range<u64>,
    watch: &mut Watch<'_>,
) -> Option<Vec<u8>> {
    let scene = prepared.scene();
    let context = Context::<S>::new(prepared, settings);
    // There is no checkpoint before the end, and so no result if it is stopped.
    watch.obey();
    let mut estimator = new_estimator(&context, scene, settings, watch)?;
    let mut out = Writer::default();
    out.bytes(&estimator.decisions().digest);
    out.bytes(&fingerprint(scene, settings, samples));
    out.value(&part);
    if !estimator.trace_part(part, samples, watch) {
        return None;
    }
    out.block(|out| estimator.put_shared(out));
    out.block(|out| estimator.put_part(out));
    Some(out.finish())
}

fn put_together<'p, S: Spectrum>(
    prepared: PreparedScene<'_>,
    settings: &Settings,
    samples: u64,
    parts: &[&'p [u8]],
    watch: &mut Watch<'_>,
) -> Result<Estimates, MergeError> {
    let scene = prepared.scene();
    let context = Context::<S>::new(prepared, settings);
    let mut estimator = new_estimator(&context, scene, settings, watch).expect(UNSTOPPED);
    let decisions = estimator.decisions();
    let expected = Expected {
        decisions: &decisions.digest,
        fingerprint: fingerprint(scene, settings, samples),
        samples,
    };
    let read = |(number, bytes): (usize, &&'p [u8])| expected.read(number, bytes);
    let read = parts.iter().enumerate().map(read).collect::<Result<Vec<_>, _>>()?;
    expect_all_indices(&read, samples)?;
    let mut shared = None;
    for part in &read {
        add(estimator.as_mut(), part, &mut shared)
            .map_err(|error| MergeError::Part { part: part.number, error })?;
    }
    estimator.complete_at(samples);
    let miss_probability = 1.0 - settings.confidence;
    let sums = Sums { estimator: estimator.as_ref(), before: None };
    let Look { mut estimates, .. } = look(&context, scene, settings, sums, miss_probability);
    estimates.decisions = decisions;
    drop(estimator);
    add_pictures(&context, scene, settings, &mut estimates, watch);
    Ok(estimates)
}

/// A part whose sums are still bytes.
#[derive(Clone, Debug)]
struct Part<'b> {
    number: usize,
    /// Its indices.
    range: Range<u64>,
    /// Sums of the photons that all paths share, equal in all parts of a run.
    shared: &'b [u8],
    /// Sums of its own indices.
    own: &'b [u8],
}

/// Properties that all parts of a run have in common.
struct Expected<'d> {
    decisions: &'d [u8; 32],
    fingerprint: [u8; 32],
    samples: u64,
}

impl Expected<'_> {
    fn read<'b>(&self, number: usize, bytes: &'b [u8]) -> Result<Part<'b>, MergeError> {
        let refuse = |error| MergeError::Part { part: number, error };
        let mut from = Reader::new(bytes);
        let decisions = from.bytes(self.decisions.len()).map_err(refuse)?;
        if from.bytes(self.fingerprint.len()).map_err(refuse)? != self.fingerprint {
            return Err(MergeError::Foreign { part: number });
        }
        if decisions != self.decisions {
            return Err(refuse(StateError::Decisions));
        }
        let mut rest = || -> Result<Part<'b>, StateError> {
            let range = from.value()?;
            let part = Part { number, range, shared: from.block()?, own: from.block()? };
            from.clone().end().map(|()| part)
        };
        let part = rest().map_err(refuse)?;
        let samples = self.samples;
        if part.range.start > part.range.end || part.range.end > samples {
            return Err(MergeError::Range { part: number, range: part.range, samples });
        }
        Ok(part)
    }
}

/// Whether each index from 0 to before `samples` is in one part, and in one alone.
fn expect_all_indices(parts: &[Part<'_>], samples: u64) -> Result<(), MergeError> {
    let mut parts: Vec<&Part<'_>> = parts.iter().filter(|part| !part.range.is_empty()).collect();
    parts.sort_by_key(|part| (part.range.start, part.number));
    let mut end = 0;
    let mut before = 0;
    for Part { number, range, .. } in parts {
        if range.start < end {
            return Err(MergeError::Overlap { parts: [before, *number], index: range.start });
        }
        if range.start > end {
            return Err(MergeError::Gap { missing: end..range.start });
        }
        (end, before) = (range.end, *number);
    }
    if end < samples { Err(MergeError::Gap { missing: end..samples }) } else { Ok(()) }
}

/// Adds the sums of a part; `shared` are the bytes that the parts before it have in common.
fn add<'b>(
    estimator: &mut (dyn Estimator + '_),
    part: &Part<'b>,
    shared: &mut Option<&'b [u8]>,
) -> Result<(), StateError> {
    match *shared {
        None => {
            let mut from = Reader::new(part.shared);
            estimator.merge_shared(&mut from)?;
            from.end()?;
            *shared = Some(part.shared);
        }
        Some(shared) if shared == part.shared => {}
        Some(_) => return Err(StateError::Unfit("what photons for all paths found")),
    }
    let mut from = Reader::new(part.own);
    estimator.merge_part(&mut from)?;
    from.end()
}

/// SHA-256 of all that the sums of a part hang on: the settings, the number of samples and the
/// scene without its cameras.
fn fingerprint(scene: &Scene, settings: &Settings, samples: u64) -> [u8; 32] {
    // Of the weather, the environment has all that is simulated.
    let Scene { mesh, materials, lights, environment, weather: _, sensors, cameras: _ } = scene;
    let mut text = Hashed(Sha256::new());
    for position in &mesh.positions {
        position.to_array().iter().for_each(|x| text.0.update(x.to_bits().to_le_bytes()));
    }
    let numbers = mesh.triangles.iter().flatten().chain(&mesh.material_of);
    numbers.for_each(|number| text.0.update(number.to_le_bytes()));
    let lengths = [mesh.positions.len(), mesh.triangles.len()];
    // Hashing a text cannot fail.
    let _ = write!(
        text,
        "{lengths:?}{materials:?}{lights:?}{environment:?}{sensors:?}{settings:?}{samples}"
    );
    text.0.finalize().into()
}

/// Hashes a text instead of keeping it.
struct Hashed(Sha256);

impl Write for Hashed {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0.update(text);
        Ok(())
    }
}
