//! Transmittance of shadow rays through flat panes.

use crate::spectrum::Spectrum;
use crate::world::World;
use quasilux_bvh::{Hit, RayQuery};

/// Transmission along a ray that meets nothing but panes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passage<S> {
    /// Share of the light that the panes let through.
    pub(crate) transmitted: S,
    pub(crate) panes: u32,
}

impl<S: Spectrum> Passage<S> {
    /// Through these, then through others.
    pub(crate) fn and(self, next: Self) -> Self {
        let panes = self.panes.saturating_add(next.panes);
        Self { transmitted: self.transmitted * next.transmitted, panes }
    }
}

/// Looks along rays to their ends, in their order; `None` where one meets something else than a
/// pane.
pub(crate) fn transmittances<S: Spectrum>(
    world: &World<S>,
    shadow_rays: &[RayQuery],
    passages: &mut Vec<Option<Passage<S>>>,
) {
    passages.clear();
    passages.resize(shadow_rays.len(), Some(Passage { transmitted: S::white(), panes: 0 }));
    let mut queries = shadow_rays.to_vec();
    let mut numbers: Vec<usize> = (0..shadow_rays.len()).collect();
    let mut hits: Vec<Option<Hit>> = Vec::new();
    while !queries.is_empty() {
        world.closest_hit_batch(&queries, &mut hits);
        let mut left = 0;
        for (i, hit) in hits.iter().enumerate() {
            let Some(hit) = hit else { continue };
            let RayQuery { ray, excluded } = &queries[i];
            let hit = world.unless_flush(*hit, ray, excluded[0]);
            let passage = &mut passages[numbers[i]];
            let beyond = world.beyond_pane(&queries[i], &hit);
            *passage = passage.zip(beyond).map(|(Passage { transmitted, panes }, beyond)| {
                queries[left] = beyond.query;
                Passage { transmitted: transmitted * beyond.transmitted, panes: panes + 1 }
            });
            if passage.is_some() {
                numbers[left] = numbers[i];
                left += 1;
            }
        }
        queries.truncate(left);
        numbers.truncate(left);
    }
}
