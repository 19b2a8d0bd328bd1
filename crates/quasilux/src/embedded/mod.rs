//! What a program that carries quasilux calls instead of the command line.
//!
//! A [`Project`] is loaded from a file, or from a [`Source`] in memory, and is run by [`simulate`]
//! with the options of `quasilux run`, as [`RunOptions`]: what comes out is to the bit what the
//! command line writes. Nothing is printed, and no signal is listened to: a [`Listener`] follows
//! the run and may stop it. Runs of one project may go side by side on threads of their own.
//! [`annual`] does the same for the hours of a year.

mod annual;
mod blocks;
mod check;
mod kept;
mod options;
mod run;
mod sky;

pub use crate::commands::{CieSky, Finished, FinishedYear, YearFile, YearListener};
pub use crate::exit::{CliError, Exit};
pub use crate::project::Project;
pub use crate::results::ResultFile;
pub use crate::source::{Source, Triangles};
pub use crate::watcher::{Event, Listener, Stopped};
pub use annual::{YearOrder, annual};
pub use blocks::{identify_run, simulate_with_workers, trace_blocks};
pub use check::{Checked, check, plan};
pub use kept::ResumableRun;
pub use options::{ResumeOptions, RunOptions, Share, YearOptions};
pub use run::{Order, files, simulate, write};
pub use sky::OutsideSky;
