//! Pilots: a few samples at some targets, and the rays that a whole run would take by what they find.

mod cost;
mod trial;
mod wanted;

pub(crate) use cost::Promise;
pub(crate) use trial::{PathTrial, REPLICATES, SAMPLES, Sample, Trial, looks};
pub(crate) use wanted::{BY_CHANCE, MUCH_MORE, Wanted};
