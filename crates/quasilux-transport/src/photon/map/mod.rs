//! The illumination map: elements on the diffuse facets that count photons.
//!
//! Each triangle is cut into n^2 equal triangles, n from its longest edge, and these into four
//! where pilot photons show that the light varies within them, so no parametrisation is needed and
//! no element crosses an edge; the two sides of a facet are kept apart. An element's illuminance is
//! `E = m flux / area`, m photons of equal flux (Voloboy, Dmitriev and Kopylov 2003), or the linear
//! function with the moments that the photons have. Where terms of the Neumann series are listed,
//! photons are counted in layers by their bounces.
//!
//! Read on at `layout` for which element a place belongs to, at `refine` for how elements are
//! split, at `reconstruction` for what photons make of an element, at `tally` for how they are
//! counted.

mod blocks;
#[cfg(test)]
pub(super) mod fixture;
mod layout;
mod reconstruction;
mod refine;
mod tally;

pub(crate) use layout::{COARSE_ELEMENTS_ACROSS, ELEMENTS_ACROSS, MapLayout};
pub(crate) use refine::{MAX_NEW_ELEMENTS, refined};
pub(crate) use tally::{BounceTerm, IlluminationMap, MapReceiver, MapTally, QUANTA_PER_PHOTON};
