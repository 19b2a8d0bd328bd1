//! Pilots: a few samples at some targets, and the rays that a whole run would take by what they
//! find.

mod cost;
mod error_target;
mod trial;

pub(crate) use cost::PilotCost;
pub(crate) use error_target::{BY_CHANCE, ErrorTarget, MUCH_MORE};
pub(crate) use trial::{REPLICATES, SAMPLES, Sample, Trial, TrialPaths, short_looks, trace};
