//! The ways out of a run: what an observer sees and says ([`observer`]), progress, limits and
//! checkpoints ([`watch`]), and other processes that trace a part of the work ([`workers`]).

pub mod observer;
pub(crate) mod watch;
pub(crate) mod workers;
