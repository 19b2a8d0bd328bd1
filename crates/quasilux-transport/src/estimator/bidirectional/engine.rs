//! What all subpaths need: the scene made ready, the shares of its lights, and the numbers of
//! samples of each technique.

use super::plan::Plan;
use super::sources::{Photon, Sources};
use crate::context::Context;
use crate::lights::LightKind;

/// The scene, its lights, and the plan.
pub(super) struct Engine<'l, 'a, S> {
    pub(super) context: &'l Context<'a, S>,
    pub(super) sources: Sources<'l, 'a>,
    pub(super) plan: Plan,
}

impl<S> Engine<'_, '_, S> {
    /// Whether a photon from outside comes from the sun.
    pub(super) fn is_of_sun(&self, photon: &Photon) -> bool {
        let ways = self.context.lights.ways_in();
        let LightKind::WayIn(way) = photon.kind else { return false };
        ways.is_some_and(|(_, ways)| ways.is_sun(way))
    }
}
