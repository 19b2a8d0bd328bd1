//! From a scene to estimates: the loop over checkpoints, which ends when the tolerance or a limit
//! is reached, or the observer stops it.

use crate::codec::{Reader, StateError};
use crate::context::Context;
use crate::control::observer::{Control, Observer};
use crate::control::watch::Watch;
use crate::control::workers::Workers;
use crate::estimator::{Estimator, new_estimator};
use crate::pictures::camera_run::add_pictures;
use crate::prepared::PreparedScene;
use crate::run::cannot_see::cannot_see;
use crate::run::check::{caveats, is_biased};
use crate::run::course::Course;
use crate::settings::{EstimatorKind, Settings};
use crate::spectrum::{Spectrum, is_grey};
use crate::stats::caveat::Caveat;
use crate::stats::decisions::Decisions;
use crate::stats::estimates::Estimates;
use crate::stats::schedule::Schedule;
use crate::stats::sequential::Stopping;
use crate::stats::tolerance::Standing;
use quasilux_bvh::SimdLevel;
use quasilux_scene::{Rgb, Scene};

/// Why a run without workers has a result.
const ALWAYS: &str = "only workers can fail";

/// Simulates light in a scene until every sensor point reaches the wanted tolerance, a limit comes
/// first, or the observer stops it: before the first checkpoint no value is a number then. A point
/// that is done before the others gets no more samples: what it has then is what it would have,
/// were this the end. Then takes the pictures of the cameras.
///
/// The result is a function of scene and settings, whatever the number of threads; an observer that
/// stops a run only picks which checkpoint is the last. Work is shared by the threads of the rayon
/// pool that the call is made in. [`crate::check`] says beforehand whether the settings make
/// sense for the scene.
#[must_use]
pub fn simulate<'a>(
    scene: impl Into<PreparedScene<'a>>,
    settings: &Settings,
    observer: &mut dyn Observer,
) -> Estimates {
    simulate_on(SimdLevel::fastest(), scene, settings, observer)
}

/// Simulates as [`simulate`] does, with a ray kernel of choice.
pub(crate) fn simulate_on<'a>(
    simd: SimdLevel,
    scene: impl Into<PreparedScene<'a>>,
    settings: &Settings,
    observer: &mut dyn Observer,
) -> Estimates {
    let prepared = scene.into();
    let scene = prepared.scene();
    let watch = Watch::new(observer);
    let estimates = if is_grey(scene) {
        run(&Context::<f64>::on(simd, prepared, settings), scene, settings, None, watch)
    } else {
        run(&Context::<Rgb>::on(simd, prepared, settings), scene, settings, None, watch)
    };
    estimates.expect("a run from the start needs no state").expect(ALWAYS)
}

/// Simulates as [`simulate`] does, to the same bits, with `workers` that trace most of the photons
/// and paths; goes on from a state, if there is one. `None` where the workers failed. Surveys,
/// pilots, photons that serve all paths and pictures are traced here, in the rayon pool that the
/// call is made in.
///
/// # Errors
/// When the state is damaged or of another run.
pub fn simulate_with_workers<'a>(
    scene: impl Into<PreparedScene<'a>>,
    settings: &Settings,
    state: Option<&[u8]>,
    observer: &mut dyn Observer,
    workers: &mut dyn Workers,
) -> Result<Option<Estimates>, StateError> {
    let prepared = scene.into();
    let scene = prepared.scene();
    let watch = Watch::new(observer).with_workers(workers);
    if is_grey(scene) {
        run(&Context::<f64>::new(prepared, settings), scene, settings, state, watch)
    } else {
        run(&Context::<Rgb>::new(prepared, settings), scene, settings, state, watch)
    }
}

/// Goes on from a state that an observer of [`simulate`] with the same scene and settings got, and
/// ends as that run would have ended, to the bit.
///
/// # Errors
/// When the state is damaged or of another run.
#[expect(clippy::missing_panics_doc, reason = "only workers can fail")]
pub fn resume<'a>(
    scene: impl Into<PreparedScene<'a>>,
    settings: &Settings,
    state: &[u8],
    observer: &mut dyn Observer,
) -> Result<Estimates, StateError> {
    let prepared = scene.into();
    let scene = prepared.scene();
    let watch = Watch::new(observer);
    let estimates = if is_grey(scene) {
        run(&Context::<f64>::new(prepared, settings), scene, settings, Some(state), watch)
    } else {
        run(&Context::<Rgb>::new(prepared, settings), scene, settings, Some(state), watch)
    };
    estimates.map(|estimates| estimates.expect(ALWAYS))
}

/// Whether a state that an observer got is that of a run whose checkpoints are over. Bytes that are
/// no state are of none.
#[must_use]
pub fn is_over(state: &[u8]) -> bool {
    let mut from = Reader::new(state);
    let digest = Decisions::default().digest;
    from.bytes(digest.len()).is_ok() && Course::is_over(&mut from).is_ok_and(|over| over)
}

fn run<S: Spectrum>(
    context: &Context<'_, S>,
    scene: &Scene,
    settings: &Settings,
    state: Option<&[u8]>,
    mut watch: Watch<'_>,
) -> Result<Option<Estimates>, StateError> {
    watch.limit_rays(settings.max_rays);
    if state.is_none() {
        // Nothing is lost then.
        watch.obey();
    }
    let Some(mut estimator) = new_estimator(context, scene, settings, &mut watch) else {
        let mut estimates = Estimates::nothing(scene, settings);
        add_pictures(context, scene, settings, &mut estimates, &mut watch);
        return Ok(Some(estimates));
    };
    let first = estimator.first_checkpoint();
    // Without sensors there is nothing to wait for.
    let limit = if scene.sensors.is_empty() { Some(1) } else { settings.max_samples };
    let mut course = Course::new(Schedule::new(first, limit));
    let decisions = estimator.decisions();
    watch.expect_decisions(decisions.digest);
    if let Some(state) = state {
        let mut from = Reader::new(state);
        if from.bytes(decisions.digest.len())? != decisions.digest {
            return Err(StateError::Decisions);
        }
        course.read(scene, settings, &mut from)?;
        watch.read(&mut from)?;
        estimator.merge_from(course.schedule.next_checkpoint(), &mut from)?;
        from.end()?;
        if let Some(last) = &course.last {
            watch.begin_at(last, Standing::new(last, settings).largest());
        }
    }
    watch.obey();
    let steps = Steps { context, scene, settings, decisions: &decisions };
    steps.advance_to_the_end(estimator.as_mut(), &mut course, &mut watch);
    drop(estimator);
    if watch.has_failed() {
        return Ok(None);
    }
    let mut estimates = course.last.unwrap_or_else(|| Estimates::nothing(scene, settings));
    // The last checkpoint may have come from a state.
    estimates.decisions = decisions;
    add_pictures(context, scene, settings, &mut estimates, &mut watch);
    Ok(Some(estimates))
}

/// The steps from checkpoint to checkpoint, and what stays the same in them.
struct Steps<'r, 'a, S> {
    context: &'r Context<'a, S>,
    scene: &'r Scene,
    settings: &'r Settings,
    decisions: &'r Decisions,
}

impl<S: Spectrum> Steps<'_, '_, S> {
    /// Goes from checkpoint to checkpoint until the tolerance or a limit is reached, or the
    /// observer stops it.
    fn advance_to_the_end(
        &self,
        estimator: &mut (dyn Estimator + '_),
        course: &mut Course,
        watch: &mut Watch<'_>,
    ) {
        let Self { context, scene, settings, decisions } = *self;
        put_preface(decisions, course, watch);
        // The observer has a state before the first sample, too.
        let _ = watch.keep(|out| estimator.put(out));
        let stopping = Stopping::new(settings);
        while !course.over {
            watch.expect(course.last.as_ref().and_then(|last| expected_rays(last, settings)));
            if !estimator.advance(course.schedule.next_checkpoint(), watch) {
                break;
            }
            let sums = Sums { estimator: &*estimator, before: course.last.as_ref() };
            let Look { mut estimates, standing } =
                look(context, scene, settings, sums, stopping.miss_probability);
            if watch.has_failed() {
                break;
            }
            estimates.decisions = decisions.clone();
            let is_look = stopping.may_end && course.schedule.is_look();
            let is_enough = is_look && standing.may_end;
            if is_look && !is_enough {
                course.is_adaptive = estimator.freeze_converged(&standing.done);
            }
            course.record(&mut estimates, &standing, settings);
            let control = watch.checkpoint(&estimates, standing.largest());
            course.last = Some(estimates);
            course.over = is_enough || !course.schedule.advance();
            put_preface(decisions, course, watch);
            if course.over {
                watch.keep_last(|out| estimator.put(out));
            } else if !watch.keep(|out| estimator.put(out)) || control == Control::Stop {
                break;
            }
        }
    }
}

/// Begins states with all that does not change before the next checkpoint.
fn put_preface(decisions: &Decisions, course: &Course, watch: &mut Watch<'_>) {
    watch.preface(|out| {
        out.bytes(&decisions.digest);
        out.value(course);
    });
}

/// Rays up to the tolerance or a limit: at that on samples, as if all points went on.
fn expected_rays(last: &Estimates, settings: &Settings) -> Option<u64> {
    let share = |most: u64| most as f64 / last.samples.max(1) as f64;
    let at_limit = settings.max_samples.map(|most| (last.rays as f64 * share(most)) as u64);
    [last.convergence.rays, at_limit, settings.max_rays].into_iter().flatten().min()
}

/// Estimates at a checkpoint, and how all targets stand there.
pub(crate) struct Look {
    pub(crate) estimates: Estimates,
    pub(crate) standing: Standing,
}

/// Sums of a run at a checkpoint.
#[derive(Clone, Copy)]
pub(crate) struct Sums<'e> {
    pub(crate) estimator: &'e dyn Estimator,
    /// Estimates of the checkpoint before, if there was one.
    pub(crate) before: Option<&'e Estimates>,
}

/// Looks at the sums of a run, where the interval of each target may miss with this probability.
pub(crate) fn look<S: Spectrum>(
    context: &Context<'_, S>,
    scene: &Scene,
    settings: &Settings,
    sums: Sums<'_>,
    miss_probability: f64,
) -> Look {
    let mut estimates = sums.estimator.estimates();
    if let Some(before) = sums.before {
        let sensors = estimates.sensors.iter_mut().zip(&before.sensors);
        sensors.for_each(|(sensor, before)| sensor.keep_average(before));
    }
    estimates.confidence = settings.confidence;
    estimates.miss_probability = miss_probability;
    estimates.biased |= is_biased(scene, settings);
    estimates.caveats.extend(caveats(scene, settings));
    let luminaires = context.cut_shapes;
    estimates.caveats.extend((luminaires > 0).then_some(Caveat::CutShapes { luminaires }));
    // An estimator with a bound says itself what it cannot make.
    let is_bounded = settings.estimator.is_bounded();
    if !is_bounded {
        estimates.cannot_see = cannot_see(context, scene, settings);
    }
    let sees_hidden = !is_bounded
        && settings.estimator != EstimatorKind::Photon
        && settings.max_bounces != Some(0);
    if sees_hidden && !context.caustic_ways.is_empty() {
        estimates.biased = true;
        estimates.caveats.push(Caveat::Caustics { ways: context.caustic_ways.clone() });
    }
    let standing = Standing::new(&estimates, settings);
    estimates.unresolved_points = standing.unresolved;
    estimates.caveats.extend(caveats_of_checkpoint(&estimates));
    let may_be_done = standing.has_enough(estimates.samples, settings);
    estimates.tolerance_reached = standing.is_reached && may_be_done;
    if standing.is_reached && !may_be_done {
        estimates.caveats.push(Caveat::FewSamples { samples: estimates.samples });
    }
    Look { estimates, standing }
}

/// Warnings about the values of this checkpoint.
fn caveats_of_checkpoint(estimates: &Estimates) -> Vec<Caveat> {
    let contributions = estimates.invalid_contributions;
    let points = estimates.unresolved_points;
    let invalid = (contributions > 0).then_some(Caveat::InvalidContributions { contributions });
    let unresolved = (points > 0).then_some(Caveat::NoInterval { points });
    invalid.into_iter().chain(unresolved).collect()
}
