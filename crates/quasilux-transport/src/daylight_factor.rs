//! The components of daylight at a sensor point: from the sky alone, externally reflected,
//! internally reflected (CIE 16:1970).
//!
//! Light counts by where it was reflected last: nowhere, beyond an opening, or on this side of it.
//! Sheets that light passes, clear or diffusing, reflect nothing to their other side, and the
//! ground is beyond all openings. Paths that come to a surface within have nothing more to find,
//! so that the first two components take little work; the third is what remains of the
//! illuminance.

use crate::context::Context;
use crate::lights::{SKY_MARGIN, Suns};
use crate::path::daylight::{DaylightSearch, FromOutside, LastReflection, OutsideSource};
use crate::path::daylight_paths::{TargetReplicate, trace};
use crate::path::trace::outside::most_of_a_path_lx;
use crate::path::wave::PathWave;
use crate::prepared::PreparedScene;
use crate::sensors::{Target, targets};
use crate::settings::{EstimatorKind, Settings};
use crate::spectrum::{Spectrum, is_grey};
use crate::stats::interval::{Interval, t_quantile_for};
use crate::stats::schedule::MIN_SAMPLES;
use crate::stats::sequential::Stopping;
use crate::stats::unseen::unseen_lx;
use quasilux_scene::Rgb;
use rayon::prelude::*;
use std::ops::Range;

/// Paths of each replicate at most for each sample that the illuminance took: most are short.
const PER_SAMPLE: u64 = 4;
/// A component may take this share of the tolerance of the illuminance, or of its half-width.
const SHARE_OF_TOLERANCE: f64 = 0.5;

/// An illuminance that a run found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FoundIlluminance {
    /// In lx.
    pub lx: f64,
    /// In lx; `None` where it is unknown.
    pub half_width_lx: Option<f64>,
    /// The samples of each replicate behind it.
    pub samples: u64,
}

/// Components of the daylight at a sensor point beside its illuminance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DaylightComponents {
    /// From the sky, in lx.
    pub sky_lx: Interval,
    /// From surfaces and ground beyond the openings, in lx.
    pub externally_reflected_lx: Interval,
    /// Light in lx of each component that may come by ways on which no path lay, at most, with
    /// [`UNSEEN_CONFIDENCE`](crate::unseen::UNSEEN_CONFIDENCE).
    pub unseen_lx: f64,
}

/// The components at all sensor points, sensor by sensor, of illuminances. They are to be known to
/// half of the tolerance, or half of the half-width where that is larger, with at most four paths
/// for each sample of the illuminance. `None` where the sky does not shine alone, and where there
/// are no openings that make an inside.
///
/// `goes_on` is asked again and again: once it says no, points get no more paths. The result is a
/// function of scene, settings and illuminances else. Runs in the rayon pool that the call is
/// made in.
#[must_use]
pub fn daylight_components<'a>(
    scene: impl Into<PreparedScene<'a>>,
    settings: &Settings,
    illuminances: &[FoundIlluminance],
    goes_on: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<DaylightComponents>> {
    let prepared = scene.into();
    let scene = prepared.scene();
    let environment = scene.environment.as_ref()?;
    if !scene.lights.is_empty() || environment.sun.is_some() {
        return None;
    }
    let settings = &Settings { estimator: EstimatorKind::Path, ..settings.clone() };
    let points = KnownPoints { targets: &targets(scene), settings, illuminances, goes_on };
    if is_grey(scene) {
        of_points(&Context::<f64>::new(prepared, settings), points)
    } else {
        of_points(&Context::<Rgb>::new(prepared, settings), points)
    }
}

#[derive(Clone, Copy)]
struct KnownPoints<'w> {
    targets: &'w [Target],
    settings: &'w Settings,
    /// By target.
    illuminances: &'w [FoundIlluminance],
    goes_on: &'w (dyn Fn() -> bool + Sync),
}

fn of_points<S: Spectrum>(
    context: &Context<'_, S>,
    points: KnownPoints<'_>,
) -> Option<Vec<DaylightComponents>> {
    let KnownPoints { targets, settings, illuminances, goes_on } = points;
    let outside = context.lights.outside.as_ref().filter(|outside| outside.has_portals())?;
    let search = DaylightSearch { suns: &Suns::default(), only_from_beyond: true };
    let most_lx = SKY_MARGIN * outside.brightest_cd_m2() * most_of_a_path_lx(outside, &search);
    let stopping = Stopping::new(settings);
    let t = t_quantile_for(settings.effective_replicates() as usize, stopping.miss_probability);
    let point = |(number, target)| {
        let of = |replicate| TargetReplicate { number, target, replicate };
        let found = illuminances.get(number);
        let found = found.copied().unwrap_or_default();
        let mut schedule =
            stopping.looks(found.samples.saturating_mul(PER_SAMPLE).max(MIN_SAMPLES));
        let mut sums = vec![[0.0; 2]; settings.effective_replicates() as usize];
        let mut wave = PathWave::default();
        let mut paths = 0;
        loop {
            let goal = schedule.next_checkpoint();
            for (replicate, sums) in (0..).zip(&mut sums) {
                add(context, of(replicate), paths..goal, &mut wave, sums);
            }
            paths = goal;
            let own = components(&sums, paths, most_lx, t);
            if own.are_known(settings, &found) || !goes_on() || !schedule.advance() {
                return own;
            }
        }
    };
    Some(targets.par_iter().enumerate().map(point).collect())
}

/// Traces paths of a point in one replicate.
fn add<S: Spectrum>(
    context: &Context<'_, S>,
    of: TargetReplicate<'_>,
    paths: Range<u64>,
    wave: &mut PathWave<S>,
    [sky, externally]: &mut [f64; 2],
) {
    let search = DaylightSearch { suns: &Suns::default(), only_from_beyond: true };
    trace(context, search, of, paths, wave, |FromOutside { source, reflection, light }| {
        let is_ground = match source {
            OutsideSource::Outside(direction) | OutsideSource::Mirrored(direction) => {
                direction.z < 0.0
            }
            OutsideSource::Sun(..) => false,
        };
        match reflection {
            _ if !light.is_finite() => {}
            LastReflection::Nowhere if !is_ground => *sky += light,
            LastReflection::Nowhere | LastReflection::Beyond => *externally += light,
            LastReflection::Within => {}
        }
    });
}

/// Components after this many paths of each replicate, each of which finds `most_lx` at most.
fn components(sums: &[[f64; 2]], paths: u64, most_lx: f64, t: Option<f64>) -> DaylightComponents {
    let [sky_lx, externally_reflected_lx] =
        [0, 1].map(|k| Interval::of_mean(sums.iter().map(|sums| sums[k] / paths as f64), t));
    // A path that finds something outside has one sample there.
    let trials = paths as f64 * sums.len() as f64;
    DaylightComponents { sky_lx, externally_reflected_lx, unseen_lx: unseen_lx(most_lx, trials) }
}

impl DaylightComponents {
    /// Whether both are known well enough beside an illuminance. Without a tolerance all
    /// paths are traced.
    fn are_known(&self, settings: &Settings, illuminance: &FoundIlluminance) -> bool {
        let &FoundIlluminance { lx, half_width_lx, .. } = illuminance;
        let enough_lx = settings.tolerance_lx(lx).max(half_width_lx.unwrap_or(0.0));
        let enough_lx = SHARE_OF_TOLERANCE * enough_lx;
        let is_known = |it: Interval| {
            it.or_unseen(self.unseen_lx).half_width.is_some_and(|width| width <= enough_lx)
        };
        settings.has_tolerance()
            && [self.sky_lx, self.externally_reflected_lx].into_iter().all(is_known)
    }
}
