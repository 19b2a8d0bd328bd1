//! Many rays at once: the same answers as one by one, sooner.

use crate::{Hit, Shot, TriangleBvh};

impl TriangleBvh {
    /// [`Self::closest_hit`] of each of `shots`, in their order.
    ///
    /// # Panics
    /// If there are not as many `hits` as `shots`.
    pub fn closest_hits(&self, shots: &[Shot], hits: &mut [Option<Hit>]) {
        assert_eq!(shots.len(), hits.len(), "as many answers as questions");
        for (shot, hit) in shots.iter().zip(hits) {
            *hit = self.closest_hit(&shot.ray, &shot.excluded);
        }
    }

    /// [`Self::is_occluded`] of each of `shots`, in their order.
    ///
    /// # Panics
    /// If there are not as many answers as `shots`.
    pub fn are_occluded(&self, shots: &[Shot], occluded: &mut [bool]) {
        assert_eq!(shots.len(), occluded.len(), "as many answers as questions");
        for (shot, occluded) in shots.iter().zip(occluded) {
            *occluded = self.is_occluded(&shot.ray, &shot.excluded);
        }
    }
}
