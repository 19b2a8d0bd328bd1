//! Exact sums, confidence intervals, and when a run may stop.
//!
//! [`tally`] holds the sums, [`interval`] and [`minimum`] how intervals are made, [`estimates`]
//! those of sensor values, [`even_average`] those of averages, [`unseen`] what is left open beside
//! them, [`point_status`] what a point waits for, [`caveat`] what else a reader must know,
//! [`certified`] intervals that hold for any number of samples, [`sequential`] what looking several
//! times costs them, [`schedule`] and [`tolerance`] what the decision to stop needs
//! (`run::simulate` takes it), [`convergence`] the prediction of the end, [`efficiency`] what
//! surveys and pilots decide by.

pub(crate) mod caveat;
pub mod certified;
pub mod convergence;
pub(crate) mod decisions;
pub(crate) mod efficiency;
pub mod estimates;
pub(crate) mod even_average;
pub mod interval;
pub(crate) mod minimum;
pub(crate) mod picture;
pub(crate) mod point_status;
pub(crate) mod schedule;
pub(crate) mod scores;
pub(crate) mod sequential;
pub(crate) mod tally;
pub(crate) mod tolerance;
pub mod unseen;
