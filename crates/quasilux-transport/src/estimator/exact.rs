//! Direct light of the point-like lights at sensor points, computed without sampling.

use crate::context::Context;
use crate::control::watch::{POINTS_AT_ONCE, Watch};
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::world::vertex::Vertex;
use crate::world::visibility::{LightRequest, ShadowQueue};

/// Targets whose light from the point-like lights is computed together.
const TARGETS: usize = 256;
/// Chunks of them between two words to the observer.
const AT_ONCE: usize = POINTS_AT_ONCE / TARGETS;

/// Light of point-like lights at a sensor point, computed without sampling, in lx.
#[derive(Clone, Default)]
pub(crate) struct Exact {
    pub(crate) direct_lx: f64,
    /// By mirrors and panes alone.
    pub(super) mirrored_lx: f64,
    /// Both by the number of bounces, the last all from there on; empty where terms are not listed.
    pub(crate) terms_lx: Vec<f64>,
}

impl Exact {
    pub(super) fn new(listed_terms: u32) -> Self {
        let terms = if listed_terms > 0 { listed_terms as usize + 1 } else { 0 };
        Self { terms_lx: vec![0.0; terms], ..Self::default() }
    }

    pub(crate) fn sum_lx(&self) -> f64 {
        self.direct_lx + self.mirrored_lx
    }

    /// Adds light that comes by this many mirrors and panes.
    fn add(&mut self, bounces: u32, lx: f64) {
        *if bounces == 0 { &mut self.direct_lx } else { &mut self.mirrored_lx } += lx;
        if let Some(rest) = self.terms_lx.len().checked_sub(1) {
            self.terms_lx[rest.min(bounces as usize)] += lx;
        }
    }

    /// Leaves out what the results cannot hold, and says how much that was: a light right at a
    /// sensor point has no illuminance to speak of.
    fn drop_invalid(&mut self) -> u64 {
        let Self { direct_lx, mirrored_lx, .. } = self;
        let mut dropped = 0;
        for value_lx in [direct_lx, mirrored_lx] {
            if !value_lx.is_finite() {
                *value_lx = 0.0;
                dropped += 1;
            }
        }
        dropped
    }
}

/// Light at all targets that is computed before the first sample.
pub(crate) struct ComputedLight {
    /// By target, nothing at cells.
    pub(crate) of_targets: Vec<Exact>,
    /// Values that were left out because results cannot hold them.
    pub(crate) invalid: u64,
    pub(crate) rays: u64,
}

/// Light of the point-like lights, straight and by mirrors, at each target that is a point: all of
/// them tested. `None` when the observer stopped it.
pub(crate) fn computed_light<S: Spectrum>(
    context: &Context<'_, S>,
    targets: &[Target],
    watch: &mut Watch<'_>,
) -> Option<ComputedLight> {
    let light = |targets: &&[Target]| {
        let mut exact = vec![Exact::new(context.listed_terms); targets.len()];
        let receiver = |(who, target): (u32, &Target)| match *target {
            Target::Point { position, normal: n } => {
                let from = context.world.ray_origin_of_sensor(position, n);
                Some(LightRequest { who, vertex: Vertex::sensor(from, n) })
            }
            Target::Cell { .. } => None,
        };
        let receivers: Vec<LightRequest<'_, S>> =
            (0..).zip(*targets).filter_map(receiver).collect();
        let mut shadows = ShadowQueue::default();
        shadows.max_bounces = context.max_bounces.unwrap_or(u32::MAX);
        let mut receive =
            |who: u32, lx: S, bounces: u32| exact[who as usize].add(bounces, lx.luminance());
        let pointlikes = &context.lights.pointlikes;
        pointlikes.all(&context.world, &receivers, &mut shadows, &mut receive);
        context.images.all(&context.world, pointlikes, &receivers, &mut shadows, &mut receive);
        (exact, shadows.rays)
    };
    let chunks: Vec<&[Target]> = targets.chunks(TARGETS).collect();
    let mut computed = ComputedLight { of_targets: Vec::new(), invalid: 0, rays: 0 };
    for (exact, rays) in watch.map_in_parts(&chunks, AT_ONCE, light)? {
        computed.of_targets.extend(exact);
        computed.rays += rays;
    }
    computed.invalid = computed.of_targets.iter_mut().map(Exact::drop_invalid).sum();
    Some(computed)
}
