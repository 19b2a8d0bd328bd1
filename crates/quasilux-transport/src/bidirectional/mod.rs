//! placeholder
mod boxes;
mod caps;
mod counters;
mod engine;
mod estimator;
mod eye_path;
mod intensities;
mod joins;
mod light_subpath;
mod peaks;
mod plan;
mod progress;
mod sources;
mod sums;
mod supremum;
mod unit;

pub(crate) use estimator::BidirectionalEstimator;
