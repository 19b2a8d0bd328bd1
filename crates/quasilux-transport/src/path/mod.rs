//! Path tracing from sensors and cameras, with next-event estimation.

pub(crate) mod contribution;
pub(crate) mod daylight;
pub(crate) mod daylight_paths;
pub(crate) mod end;
pub(crate) mod path_batch;
pub(crate) mod pixel_rays;
pub(crate) mod russian_roulette;
pub(crate) mod start;
pub(crate) mod subpath_weights;
pub(crate) mod trace;
pub(crate) mod wave;
