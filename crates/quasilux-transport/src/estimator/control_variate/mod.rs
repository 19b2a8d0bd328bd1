//! Control variate for path tracing: paths end on one frozen illumination map, and those that
//! survive Russian roulette correct it.
//!
//! A path may end at every diffuse surface that it comes to. With probability q it goes on instead
//! and takes along the difference between what it finds and what the map said, weighted by 1 / q:
//! the map is a control variate, so its mean is right for any map and any q, as long as neither
//! knows the path's coordinates. What q is best is a matter of variance and rays. A path that ended
//! or went on by chance at a surface where a lux counts w at its start, where the map has M lux and
//! the path would find F, has
//!
//! ```text
//! variance = (1 / q - 1) w^2 (F - M)^2 + (1 / q) variance of what lies beyond
//! rays     = q (rays of what lies beyond)
//! ```
//!
//! so q should grow in proportion to `w |F - M|`, relative to what the path's start wants to know
//! ([`crate::path::frozen_map::survival`]). A trial traces paths that hardly end, and records what
//! they found beyond each surface ([`crate::path::vertex_record`]). By the two lines above each of
//! them predicts what it would have cost with any q, and what it would have cost alone, with
//! nothing in place of M and the albedo in place of q ([`path_record`], [`replay`]). The noise of
//! the map says what more photons would mend. The q and the number of photons are taken that
//! promise the fewest rays in all ([`pilot`]).

mod path_record;
mod path_trial;
mod pilot;
mod replay;
#[cfg(test)]
mod tests;

pub(crate) use path_trial::PathTrial;
pub(crate) use pilot::{MAX_PHOTONS, MapPilot, PathPilot};
pub(crate) use replay::{Outcome, PathRecords};
