//! One file a command.

mod bsdf;
mod check;
mod completions;
mod drawings;
mod experiment;
mod inputs;
mod man;
mod merge;
mod photometry;
mod plan;
mod points;
mod resume;
mod run;
mod shard;
mod validate;

pub(crate) use bsdf::bsdf;
pub(crate) use check::check;
pub(crate) use completions::completions;
pub(crate) use experiment::experiment;
pub(crate) use man::man;
pub(crate) use merge::merge;
pub(crate) use photometry::photometry;
pub(crate) use plan::plan;
pub(crate) use points::points;
pub(crate) use resume::resume;
pub(crate) use run::run;
pub(crate) use shard::shard;
pub(crate) use validate::validate;
