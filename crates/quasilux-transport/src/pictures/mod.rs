//! Pictures of cameras: the passes of one until it is known well enough ([`camera_run`]), one pass
//! over its pixels ([`integrator`]), how many paths a pass takes where ([`pass`]), blocks of pixels
//! ([`raster`]), and their sums ([`pixel_sums`]).

pub(crate) mod camera_run;
pub(crate) mod integrator;
mod pass;
mod pixel_sums;
mod raster;
