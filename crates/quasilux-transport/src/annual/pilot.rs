//! Where the sun shines in a scene, found out before the year.

use crate::context::Context;
use crate::lights::{SunWays, Suns};
use crate::path::daylight::{DaylightSearch, OutsideSource};
use crate::path::daylight_paths::{TargetReplicate, trace};
use crate::path::wave::PathWave;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use rayon::prelude::*;

/// Points, each with [`PILOT_PATHS`] paths, that find out where the sun shines.
const PILOT_POINTS: usize = 64;
const PILOT_PATHS: u64 = 64;

/// Where the sun shines, found out by paths of a replicate that counts nowhere, from targets all
/// over the scene.
pub(super) fn sun_ways<S: Spectrum>(
    context: &Context<'_, S>,
    suns: &Suns,
    replicate: u32,
    targets: &[Target],
) -> SunWays {
    let step = targets.len().div_ceil(PILOT_POINTS).max(1);
    let pilots: Vec<usize> = (step / 2..targets.len()).step_by(step).collect();
    let search = DaylightSearch { suns, only_from_beyond: false };
    let look = |number: usize| {
        let of = TargetReplicate { number, target: &targets[number], replicate };
        let mut ways = SunWays::default();
        trace(context, search, of, 0..PILOT_PATHS, &mut PathWave::default(), |found| {
            if let OutsideSource::Sun(_, place) = found.source {
                ways.note(place, found.light > 0.0);
            }
        });
        ways
    };
    pilots.into_par_iter().map(look).reduce(SunWays::default, SunWays::merge)
}
