//! Records of path vertices: the light that a path found beyond each.

use crate::spectrum::Spectrum;
use crate::world::Interaction;

/// What a path found beyond a surface.
#[derive(Clone, Debug)]
pub(crate) struct VertexRecord<S> {
    pub(crate) at: Interaction,
    /// What a lux there counts at the start of the path; `None` where no map is.
    pub(crate) weight: Option<S>,
    /// With what probability a path without a map goes on, where this one did for certain.
    pub(crate) alone: f64,
    /// Reflections before it, and rays up to it.
    pub(crate) bounces: u32,
    pub(crate) flights: u32,
    /// What had been found by the next surface: before and with what that emits.
    pub(crate) before: Option<[S; 2]>,
    /// What was found after that: what a path without a map would miss if it ended here, and one
    /// with.
    pub(crate) beyond: [S; 2],
}

impl<S: Spectrum> VertexRecord<S> {
    /// So much was found by the next surface, unless that was said before.
    pub(crate) fn begin(&mut self, found: [S; 2]) {
        self.before.get_or_insert(found);
    }

    /// So much was found later that a map here has not.
    pub(crate) fn add_beside_map(&mut self, found: S) {
        if let Some([_, before]) = &mut self.before {
            *before += found;
        }
    }

    /// This is all that the path found.
    pub(crate) fn end(&mut self, found: S) {
        if let Some(before) = self.before {
            self.beyond = before.map(|before| found + before * -1.0);
        }
    }
}
