//! What a survey of the scene decides before the first sample: how many copies of light subpaths
//! leave places, and how surfaces and targets see outside.

use super::engine::Engine;
use super::plan::Receiver;
use crate::context::Stream;
use crate::control::watch::{POINTS_AT_ONCE, Watch};
use crate::importance::{Copies, Looked, LookingPlace, OpeningView, OpeningViews, Survey};
use crate::sensors::Target;
use crate::spectrum::Spectrum;

/// Lines through openings from a target at most, and at least where there are many.
const LOOKS: usize = 16;
const MIN_LOOKS: usize = 8;
/// Lines from all targets together, unless each would have less.
const ALL_LOOKS: usize = 1 << 18;

/// Surveys the scene; the number of rays. `None` when the observer stopped it.
pub(super) fn survey<S: Spectrum>(
    engine: &mut Engine<'_, '_, S>,
    targets: &[Target],
    watch: &mut Watch<'_>,
) -> Option<u64> {
    let context = engine.context;
    let survey =
        Survey::new(context, targets, |sampler| engine.sources.pilot(&context.world, sampler));
    let Some(survey) = survey else { return Some(0) };
    if engine.fluxes.sky_lm + engine.fluxes.sun_lm > 0.0 {
        engine.openings = OpeningViews::new(context, &survey);
    }
    engine.copies = Copies::new(context, survey);
    let rays = engine.copies.rays + engine.openings.rays;
    Some(rays + look_from_targets(engine, watch)?)
}

fn look_from_targets<S: Spectrum>(
    engine: &mut Engine<'_, '_, S>,
    watch: &mut Watch<'_>,
) -> Option<u64> {
    if !engine.openings.are_known() {
        return Some(0);
    }
    let context = engine.context;
    let numbered: Vec<(u64, &Receiver)> = (0..).zip(&engine.receivers).collect();
    let looks = (ALL_LOOKS / numbered.len().max(1)).clamp(MIN_LOOKS, LOOKS) as u32;
    let look = |&(number, receiver): &(u64, &Receiver)| {
        let &Receiver { position, n, .. } = receiver;
        let from = context.world.ray_origin_of_sensor(position, n);
        let place_of = |_| LookingPlace { from, n };
        OpeningView::look(context, Stream::Survey(5), number, place_of, looks)
    };
    let views = watch.map_in_parts(&numbered, POINTS_AT_ONCE, look)?;
    let mut all = 0;
    for (receiver, Looked { view, rays }) in engine.receivers.iter_mut().zip(views) {
        receiver.view = view;
        all += rays;
    }
    Some(all)
}
