//! One file a command.

mod experiment;
mod photometry;
mod points;
mod run;
mod validate;

pub(crate) use experiment::experiment;
pub(crate) use photometry::photometry;
pub(crate) use points::points;
pub(crate) use run::run;
pub(crate) use validate::validate;
