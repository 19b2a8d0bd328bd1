//! One file a command.

mod experiment;
mod run;
mod validate;

pub(crate) use experiment::experiment;
pub(crate) use run::run;
pub(crate) use validate::validate;
