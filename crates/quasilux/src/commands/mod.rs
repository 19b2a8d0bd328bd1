//! One file a command.

mod annual;
mod bsdf;
mod check;
mod completions;
mod drawings;
mod experiment;
mod export;
mod import;
mod inputs;
mod keys;
mod man;
mod merge;
mod photometry;
mod plan;
mod points;
mod resume;
mod run;
mod shard;
mod sky;
mod validate;

pub use annual::{FinishedYear, YearFile, YearListener};
pub(crate) use annual::{annual, year_in_memory};
pub(crate) use bsdf::bsdf;
pub(crate) use check::{check, document as check_document, marks, text as check_text};
pub(crate) use completions::completions;
pub(crate) use experiment::experiment;
pub(crate) use export::export;
pub(crate) use import::import;
pub(crate) use keys::keys;
pub(crate) use man::man;
pub(crate) use merge::merge;
pub(crate) use photometry::photometry;
pub(crate) use plan::plan;
pub(crate) use points::points;
pub(crate) use resume::{KeptRun, resume};
pub use run::Finished;
pub(crate) use run::{Folder, Job, count, pool, run, work};
pub(crate) use shard::shard;
pub use sky::CieSky;
pub(crate) use sky::{
    ShownSky, Subject, document as sky_document, drawing as sky_drawing, sky, text as sky_text,
};
pub(crate) use validate::validate;
