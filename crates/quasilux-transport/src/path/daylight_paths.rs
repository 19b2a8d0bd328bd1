//! Paths from a sensor point that keep what they find outside by its direction.

use crate::context::{Context, Stream};
use crate::path::daylight::{DaylightSearch, FromOutside};
use crate::path::start::{Measurement, PathMaps, Start};
use crate::path::wave::{PathWave, WAVE};
use crate::purpose::Purpose;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use quasilux_sampling::Sampler;
use std::ops::Range;

/// Whose paths they are.
#[derive(Clone, Copy)]
pub(crate) struct TargetReplicate<'t> {
    /// The number of the target among all.
    pub(crate) number: usize,
    pub(crate) target: &'t Target,
    pub(crate) replicate: u32,
}

/// Traces paths of a target; returns how many rays they took.
pub(crate) fn trace<S: Spectrum>(
    context: &Context<'_, S>,
    search: DaylightSearch<'_>,
    of: TargetReplicate<'_>,
    indices: Range<u64>,
    wave: &mut PathWave<S>,
    mut take: impl FnMut(FromOutside),
) -> u64 {
    let TargetReplicate { number, target, replicate } = of;
    let stream = if search.only_from_beyond { Stream::DaylightPaths } else { Stream::Paths };
    let points = context.points(replicate, stream(number as u64));
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
            maps: PathMaps { end: None, caustics: None },
            daylight: Some(search),
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
