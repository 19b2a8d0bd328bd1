//! Paths from a sensor point that keep what they find outside by its direction.

use crate::context::{Context, Stream};
use crate::lights::{SunWays, Suns};
use crate::path::daylight::{FromOutside, Whence};
use crate::path::end::Rest;
use crate::path::start::{Measurement, Start};
use crate::path::wave::{PathWave, WAVE};
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::stats::targets::Target;
use quasilux_sampling::Sampler;
use rayon::prelude::*;
use std::ops::Range;

/// So many points, each with so many paths, say where the sun shines.
const PILOT_POINTS: usize = 64;
const PILOT_PATHS: u64 = 64;

/// Whose paths they are.
#[derive(Clone, Copy)]
pub(super) struct TargetReplicate<'t> {
    /// The number of the target among all.
    pub(super) number: usize,
    pub(super) target: &'t Target,
    pub(super) replicate: u32,
}

/// Traces paths of a target; returns how many rays they took.
pub(super) fn trace<S: Spectrum>(
    context: &Context<'_, S>,
    suns: &Suns,
    of: TargetReplicate<'_>,
    indices: Range<u64>,
    wave: &mut PathWave<S>,
    mut take: impl FnMut(FromOutside),
) -> u64 {
    let TargetReplicate { number, target, replicate } = of;
    let points = context.points(replicate, Stream::Paths(number as u64));
    let start = |index: u64| {
        let mut sampler = Sampler::new(&points, index);
        let (position, n) = match target {
            Target::Point { position, normal } => (*position, *normal),
            Target::Cell { grid, cell } => {
                let u = context.draw(&mut sampler, Purpose::Cell, Sampler::next_2d);
                (grid.point_in_cell(*cell, u), grid.normal)
            }
        };
        Start {
            from: context.world.ray_origin_of_sensor(position, n),
            measurement: Measurement::Illuminance { n, tests_pointlikes: false },
            rest: &Rest::Path,
            caustics: None,
            partition: None,
            virtual_lights: None,
            pixel: None,
            light_subpath: None,
            suns: Some(suns),
            sampler,
        }
    };
    let mut first = indices.start;
    while first < indices.end {
        let together = first..indices.end.min(first + WAVE);
        first = together.end;
        for mut path in wave.trace(context, together.map(start)) {
            path.end().found.from_outside.into_iter().for_each(&mut take);
        }
    }
    wave.take_rays()
}

/// Where the sun shines, found out by paths of a replicate that counts nowhere, from targets all over
/// the scene.
pub(super) fn sun_ways<S: Spectrum>(
    context: &Context<'_, S>,
    suns: &Suns,
    replicate: u32,
    targets: &[Target],
) -> SunWays {
    let step = targets.len().div_ceil(PILOT_POINTS).max(1);
    let pilots: Vec<usize> = (step / 2..targets.len()).step_by(step).collect();
    let look = |number: usize| {
        let of = TargetReplicate { number, target: &targets[number], replicate };
        let mut ways = SunWays::default();
        trace(context, suns, of, 0..PILOT_PATHS, &mut PathWave::default(), |found| {
            if let Whence::Sun(_, place) = found.whence {
                ways.note(place, found.light > 0.0);
            }
        });
        ways
    };
    pilots.into_par_iter().map(look).reduce(SunWays::default, SunWays::merge)
}
