//! Pilots: a few samples at some targets, and the rays of a whole run that they predict.

mod cost;
mod error_target;
mod trial;

pub(crate) use cost::PilotCost;
pub(crate) use error_target::{BY_CHANCE, ErrorTarget, MUCH_MORE};
pub(crate) use trial::{REPLICATES, SAMPLES, Sample, Trial, TrialPaths, trace};

use crate::estimator::exact::Exact;
use crate::settings::Settings;
use crate::stats::tally::Quantum;
use crate::stats::targets::Target;

/// The sensor values that a run is to estimate.
#[derive(Clone, Copy)]
pub(crate) struct Request<'r> {
    pub(crate) settings: &'r Settings,
    pub(crate) replicates: u32,
    pub(crate) targets: &'r [Target],
    /// Direct light of the point-like lights at each target.
    pub(crate) exact: &'r [Exact],
    pub(crate) quantum: Quantum,
}
