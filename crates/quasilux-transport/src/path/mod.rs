//! Plain path tracing from sensors and cameras, with next-event estimation: one path in [`trace`],
//! those that travel together in [`wave`], the paths of a target in [`path_batch`], of a sensor
//! that keeps daylight by its direction in [`daylight_paths`].
//!
//! The default estimator traces eye paths of its own, which light subpaths are connected to
//! (`estimator/bidirectional/eye_path.rs`).

pub(crate) mod contribution;
pub(crate) mod daylight;
pub(crate) mod daylight_paths;
pub(crate) mod end;
pub(crate) mod path_batch;
pub(crate) mod pixel_rays;
pub(crate) mod russian_roulette;
pub(crate) mod start;
pub(crate) mod trace;
pub(crate) mod wave;
