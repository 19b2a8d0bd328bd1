//! Direct light of the point-like lights at sensor points, computed without sampling.

use crate::context::Stage;
use crate::spectrum::Spectrum;
use crate::stats::targets::Target;
use crate::world::vertex::Vertex;
use crate::world::visibility::{Asker, Shadows};
use rayon::prelude::*;

/// Targets whose light from the point-like lights is computed together.
const TARGETS: usize = 256;

/// What a sensor point gets of point-like lights, without sampling, in lx.
#[derive(Clone, Default)]
pub(crate) struct Exact {
    pub(super) direct_lx: f64,
    /// By mirrors and panes alone.
    pub(super) mirrored_lx: f64,
    /// Both by the number of bounces, the last all from there on; empty where terms are not listed.
    pub(super) terms_lx: Vec<f64>,
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

    /// What the results cannot hold.
    pub(super) fn invalid(&mut self) -> impl Iterator<Item = &mut f64> {
        let Self { direct_lx, mirrored_lx, .. } = self;
        [direct_lx, mirrored_lx].into_iter().filter(|value_lx| !value_lx.is_finite())
    }
}

/// Light of the point-like lights, straight and by mirrors, at each target that is a point: all of them
/// tested.
pub(crate) fn exact<S: Spectrum>(
    stage: &Stage<'_, S>,
    targets: &[Target],
    rays: &mut u64,
) -> Vec<Exact> {
    let mut exact = vec![Exact::new(stage.listed_terms); targets.len()];
    let light = |(targets, exact): (&[Target], &mut [Exact])| {
        let asker = |(who, target): (u32, &Target)| match *target {
            Target::Point { position, normal: n } => {
                let from = stage.world.vantage_of_sensor(position, n);
                Some(Asker { who, vertex: Vertex::sensor(from, n) })
            }
            Target::Cell { .. } => None,
        };
        let askers: Vec<Asker<'_, S>> = (0..).zip(targets).filter_map(asker).collect();
        let mut shadows = Shadows::default();
        shadows.most_bounces = stage.max_bounces.unwrap_or(u32::MAX);
        let mut receive =
            |who: u32, lx: S, bounces: u32| exact[who as usize].add(bounces, lx.luminance());
        let pointlikes = &stage.lights.pointlikes;
        pointlikes.all(&stage.world, &askers, &mut shadows, &mut receive);
        stage.images.all(&stage.world, pointlikes, &askers, &mut shadows, &mut receive);
        shadows.rays
    };
    let chunks = targets.par_chunks(TARGETS).zip(exact.par_chunks_mut(TARGETS));
    *rays += chunks.map(light).sum::<u64>();
    exact
}
