//! Ends of a path on an illumination map.

use super::{ContinuationWeights, Path};
use crate::context::Context;
use crate::spectrum::Spectrum;
use crate::world::Interaction;

impl<S: Spectrum> Path<'_, S> {
    /// Ends it on the light that a map keeps here, where there is one that it may end on.
    pub(super) fn end_on_map(
        &mut self,
        context: &Context<'_, S>,
        bounces: u32,
        at: &Interaction,
    ) -> Option<ContinuationWeights> {
        let end = self.maps.end.filter(|_| context.world.bsdf(at).keeps_illuminance())?;
        if context.max_bounces.is_some() && bounces > 0 {
            // The light on the map has more bounces than are left.
            return None;
        }
        let (place, weight) = (end.layout.locate(at), self.weight(context, at));
        self.light.found.indirect += weight * end.map.illuminance_lx(&place);
        if !self.light.found.terms.is_empty() {
            for term in end.map.terms_lx(place, u32::MAX) {
                let bounces = bounces + 1 + term.bounces;
                self.light.found.add_to_term(bounces, weight * term.illuminance_lx);
            }
        }
        // The direction to a light that the next surface emits is part of the direct light here, so
        // it counts in every path; so does that to light from outside, through panes too.
        Some(ContinuationWeights { everything: 0.0, ..ContinuationWeights::ALL })
    }
}
