//! Wavefront path tracing: many paths advance together, bounce by bounce.
//!
//! All rays of one bounce are traced together, then all that the paths ask of the lights. Every
//! path takes its coordinates and adds its contributions in the order in which it would alone.

use crate::context::Context;
use crate::cutoff::MAX_EVENTS;
use crate::path::start::Start;
use crate::path::trace::{Path, PathWork};
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::visibility::{Answer, LightRequest};
use quasilux_bvh::{Hit, RayQuery};
use std::mem::take;

/// Number of paths that should travel together: the kernel has rays enough, and what they need fits
/// into a cache of half a megabyte.
pub(crate) const WAVE: u64 = 512;

/// Working space of paths that travel together, used again for the next ones.
#[derive(Default)]
pub(crate) struct PathWave<S: 'static> {
    work: PathWork<S>,
    /// Starts where all point-like lights are tested.
    receivers: Vec<LightRequest<'static, S>>,
    /// Numbers of the paths that are on their way.
    travelling: Vec<u32>,
    queries: Vec<RayQuery>,
    hits: Vec<Option<Hit>>,
    arrivals: Vec<Option<Interaction>>,
    rays: u64,
}

impl<S: Spectrum> PathWave<S> {
    /// Traces paths to their ends, in the order of `starts`.
    pub(crate) fn trace<'p>(
        &mut self,
        context: &Context<'_, S>,
        starts: impl Iterator<Item = Start<'p, S>>,
    ) -> Vec<Path<'p, S>> {
        let starts: Vec<Start<'p, S>> = starts.collect();
        let mut paths = Vec::with_capacity(starts.len());
        self.receivers.clear();
        for (number, start) in (0..).zip(starts) {
            let vertex = start.vertex_that_tests_pointlikes();
            self.receivers.extend(vertex.map(|vertex| LightRequest { who: number, vertex }));
            paths.push(Path::start(context, number, start, &mut self.work));
        }
        self.answer(context, &mut paths);
        self.test_pointlikes(context, &mut paths);
        self.travelling.clear();
        self.travelling.extend(0..paths.len() as u32);
        for bounces in 0..MAX_EVENTS {
            if self.travelling.is_empty() {
                break;
            }
            self.advance(context, bounces, &mut paths);
            self.answer(context, &mut paths);
        }
        self.travelling.iter().for_each(|&number| paths[number as usize].cut());
        paths
    }

    /// How many rays were traced since this was asked last.
    pub(crate) fn take_rays(&mut self) -> u64 {
        take(&mut self.rays) + take(&mut self.work.shadows.rays)
    }

    /// Gives the starts that want it the direct light of the point-like lights.
    fn test_pointlikes(&mut self, context: &Context<'_, S>, paths: &mut [Path<'_, S>]) {
        let receive =
            |who: u32, light: S, panes| paths[who as usize].receive_at_start(light, panes);
        let Context { world, lights, .. } = context;
        self.work.shadows.max_bounces = context.max_bounces.unwrap_or(u32::MAX);
        lights.pointlikes.all(world, &self.receivers, &mut self.work.shadows, receive);
    }

    /// Takes all paths that are on their way to their next vertex.
    fn advance(&mut self, context: &Context<'_, S>, bounces: u32, paths: &mut [Path<'_, S>]) {
        let Self { work, travelling, queries, hits, arrivals, rays, .. } = self;
        queries.clear();
        queries.extend(travelling.iter().map(|&number| paths[number as usize].query()));
        context.world.trace_all(queries, hits, arrivals);
        *rays += queries.len() as u64;
        let mut arrivals = arrivals.iter();
        travelling.retain(|&number| {
            let at = arrivals.next().and_then(Option::as_ref);
            paths[number as usize].arrive(context, bounces, at, work)
        });
    }

    /// Gives the paths the light that they asked for.
    fn answer(&mut self, context: &Context<'_, S>, paths: &mut [Path<'_, S>]) {
        let receive = |answer: Answer<S>| paths[answer.who as usize].on_visibility(&answer);
        self.work.shadows.answer_all(&context.world, receive);
    }
}
