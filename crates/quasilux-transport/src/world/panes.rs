//! Straight connections through flat panes: light in one line loses what each pane on it keeps.

use crate::spectrum::Spectrum;
use crate::world::World;
use quasilux_bvh::{Hit, Shot};

/// What comes of light along a ray that panes alone stand in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passage<S> {
    /// The share that they let through.
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

/// Looks along rays to their ends, in their order; `None` where one meets something else than a pane.
pub(crate) fn look_through<S: Spectrum>(
    world: &World<S>,
    sights: &[Shot],
    passages: &mut Vec<Option<Passage<S>>>,
) {
    passages.clear();
    passages.resize(sights.len(), Some(Passage { transmitted: S::white(), panes: 0 }));
    let mut shots = sights.to_vec();
    let mut numbers: Vec<usize> = (0..sights.len()).collect();
    let mut hits: Vec<Option<Hit>> = Vec::new();
    while !shots.is_empty() {
        world.closest_hit_batch(&shots, &mut hits);
        let mut left = 0;
        for (i, hit) in hits.iter().enumerate() {
            let Some(hit) = hit else { continue };
            let passage = &mut passages[numbers[i]];
            let beyond = world.beyond_pane(&shots[i], hit);
            *passage = passage.zip(beyond).map(|(Passage { transmitted, panes }, beyond)| {
                shots[left] = beyond.shot;
                Passage { transmitted: transmitted * beyond.transmitted, panes: panes + 1 }
            });
            if passage.is_some() {
                numbers[left] = numbers[i];
                left += 1;
            }
        }
        shots.truncate(left);
        numbers.truncate(left);
    }
}
