//! The fixed assignment of coordinates to decisions of Voloboy, Dmitriev and Kopylov (2003), for
//! comparison with handing them out in order.
//!
//! Their coordinate 1 chooses the light, 2 and 3 the direction, 4 the event at the first hit, 5 and
//! 6 the direction after it, 7 the event at the second hit, and so on. Here dimensions count from
//! 0.
//!
//! Each event has a coordinate of its own here. A walk with survival 2/3 takes 9 on average (2 for
//! the direction from the lamp, 3 events, 2 directions of 2), against 7 where events share one.
//! Give these to [`Sampler::skip_to`](crate::Sampler::skip_to):
//!
//! ```
//! use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence, assignment};
//! let points = PointSet::new(Sequence::Halton, Randomization::None, 0);
//! let mut sampler = Sampler::new(&points, 9);
//! sampler.skip_to(assignment::event(1));
//! assert_eq!(sampler.next_1d(), points.coordinate(9, 6));
//! ```

/// The dimension that chooses the light.
pub const LIGHT: u32 = 0;

/// The first of the two dimensions of the direction from the light.
pub const EMISSION: u32 = 1;

/// The dimension of the event at a hit, hits counted from 0.
#[must_use]
pub const fn event(hit: u32) -> u32 {
    3_u32.saturating_add(hit.saturating_mul(3))
}

/// The first of the two dimensions of the direction after a hit, hits counted from 0.
#[must_use]
pub const fn scattering(hit: u32) -> u32 {
    event(hit).saturating_add(1)
}
