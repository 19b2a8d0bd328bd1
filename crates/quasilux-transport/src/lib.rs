//! How light moves: photons, paths, illumination maps, replicates.
//!
//! [`simulate`] takes a checked scene and [`Settings`] and returns [`Estimates`]: figures of
//! independent replicates, from which intervals follow. It cannot fail, and reads neither the clock
//! nor files: progress and cancellation go through one [`Observer`].
//!
//! Four things can be done with a run, each with a program in `examples/`:
//!
//! - run it to a tolerance and read its intervals and bounds: [`check`], [`simulate`]
//!   (`illuminance`);
//! - watch it, and stop it for a reason of one's own: [`Observer`], [`Control`] (`stop`);
//! - keep its state and go on from there, to the same bits: [`resume`] (`resume`);
//! - cut it into parts for several machines, to the same bits: [`trace_part`], [`merge`] (`parts`),
//!   or have other processes trace most of it: [`simulate_with_workers`], [`trace_blocks`].
//!
//! Beside them, [`simulate_year`] has the hours of a year, [`daylight_components`] the components
//! of daylight, and [`explain`](fn@explain) says where the variance comes from.
//!
//! The folders depend one way, each on those before it:
//!
//! - `bsdf`: how surfaces scatter
//! - `world`: what rays meet
//! - `lights`: emission and direct light, with the mirror images of point-like lights
//! - `stats`: exact sums, intervals, and when a run may stop
//! - `control`: the observer, limits and checkpoints, other processes
//! - `importance`: where photons are split, ended and sent
//! - `photon`: light tracing, illumination maps and caustics
//! - `path`: path tracing from sensors and cameras
//! - `annual`: the hours of a year
//! - `estimator`: the estimators of sensor values
//! - `explain`: where the variance comes from
//! - `pictures`: pictures of cameras, pass by pass
//! - `run`: a run from start to result, in one piece or in parts
//!
//! Beside them: `codec`, states of a run as bytes; `context`, the scene made ready;
//! `daylight_factor`, the components of daylight; `settings`.

mod annual;
mod bsdf;
mod codec;
mod context;
mod control;
mod cutoff;
mod daylight_factor;
mod estimator;
pub mod explain;
mod importance;
mod lights;
mod path;
mod photon;
mod pictures;
mod prepared;
pub mod purpose;
mod run;
#[cfg(test)]
#[expect(dead_code, reason = "some scenes are for other tests")]
#[path = "../tests/it/scenes.rs"]
mod scenes;
mod sensors;
pub mod settings;
mod spectrum;
mod stats;
mod world;

// A run: what it is asked for, and what it gives.
pub use lights::images::UnshownWay;
pub use prepared::PreparedScene;
pub use run::check::{CheckError, check};
pub use run::memory::MemoryNeed;
pub use run::simulate::{is_over, resume, simulate, simulate_with_workers};
pub use settings::{
    EstimatorKind, IntervalKind, Reconstruction, Settings, Switch, ToleranceOn, UnseenTolerance,
};
pub use stats::caveat::Caveat;
pub use stats::certified::{self, CertifiedInterval, IndexTotals};
pub use stats::estimates::{
    self, Convergence, Dimensions, Estimates, FluxBalance, SensorEstimates, TermEstimates,
};
pub use stats::even_average::EvenAverage;
pub use stats::interval::{self, Interval};
pub use stats::picture::{CameraEstimates, Pixel};
pub use stats::point_status::{Evidence, PointStatus};
pub use stats::unseen::{self, UnseenLight};

// Watching it.
pub use codec::StateError;
pub use control::observer::{self, Control, Observer, PictureProgress, Progress, Snapshot};
pub use stats::convergence;

// Its parts, on other machines and in other processes.
pub use control::workers::{Received, Workers};
pub use run::blocks::{BlockTracer, trace_blocks};
pub use run::parts::{MergeError, decide, merge, trace_part};
pub use stats::decisions::Decisions;

// Daylight.
pub use annual::{
    OtherRoom, PointOfYear, Sunlight, YearHours, YearObserver, YearProgress, YearRun, YearWork,
    seen_suns, simulate_year, sunlit_points,
};
pub use daylight_factor::{DaylightComponents, FoundIlluminance, daylight_components};

// Research.
pub use bsdf::Scattering;
pub use explain::{Explanation, explain};
pub use quasilux_sampling::DimensionHistogram;
pub use run::trial;

/// Tests the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
