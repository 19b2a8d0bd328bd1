//! How light moves: photons, paths, illumination maps, replicates.
//!
//! [`simulate`] takes a checked scene and [`Settings`] and returns [`Estimates`]: figures of
//! independent replicates, from which intervals follow. It cannot fail, and reads neither the clock
//! nor files: progress and cancellation go through one [`Observer`].
//!
//! A run can be kept and gone on with ([`resume`]), or cut into parts and put together ([`trace_part`],
//! [`merge`]), to the same bits.
//!
//! Read on at `simulate` for the loop over checkpoints, at `looks` and `lowest` for why its intervals are
//! true, at `convergence` and `memory` for what is foreseen, at `photon` and `path` for the two ways
//! light is followed, at `order` and `photon_wave` for how photons travel together, at
//! `steering` for how they are split on their way, at `first_shot` for when
//! they need not leave a light, at `path_wave` and `shadow` for how paths do, at `map` and `join` for where
//! the two ways meet, at `pixels` for pictures, at `state` for how runs are kept.

mod bsdf;
mod check;
mod choice;
pub mod convergence;
mod correction;
mod counting;
mod endless;
pub mod estimates;
pub mod explain;
mod first_shot;
mod frame;
mod gathered;
mod gathering;
mod grid_plane;
pub mod interval;
mod join;
mod lights;
mod lobes;
mod looks;
mod lowest;
mod map;
mod memory;
pub mod observer;
mod order;
mod panes;
mod parts;
mod path;
mod path_end;
mod path_wave;
mod photon;
mod photon_wave;
mod photons;
mod picture;
mod pixels;
pub mod purpose;
#[cfg(test)]
#[expect(dead_code, reason = "some scenes are for other tests")]
#[path = "../tests/it/scenes.rs"]
mod scenes;
mod schedule;
mod sections;
pub mod settings;
mod shadow;
mod simulate;
mod spectrum;
mod specular;
mod stage;
mod state;
mod steering;
mod tally;
mod targets;
mod tolerance;
pub mod trial;
mod vertex;
mod watch;
mod world;

pub use bsdf::Scattering;
pub use check::{CheckError, check};
pub use convergence::Convergence;
pub use estimates::{Dimensions, Estimates, FluxBalance, SensorEstimates, TermEstimates};
pub use explain::{Explanation, explain};
pub use interval::Interval;
pub use memory::MemoryNeed;
pub use observer::{Control, Observer, Progress, Snapshot};
pub use parts::{MergeError, decide, merge, trace_part};
pub use picture::{CameraEstimates, Pixel};
pub use quasilux_sampling::DimensionHistogram;
pub use settings::{Estimator, Reconstruction, Settings, Switch, ToleranceOn};
pub use simulate::{is_over, resume, simulate};
pub use state::{Decisions, StateError};
