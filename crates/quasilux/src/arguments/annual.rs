//! What can be said to `quasilux annual`.

use super::OutputArguments;
use super::parts::{Slice, slice};
use super::values::{
    SAMPLES_OF_YEAR, SEEDS, THREADS, hours_of_day, illuminance, level, share, whole,
};
use clap::Args;
use std::ops::Range;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct AnnualArguments {
    /// The project file, with [weather], or a Honeybee model (.hbjson), with --weather
    pub(crate) project: PathBuf,
    /// The weather file of a Honeybee model, EPW or WEA
    #[arg(long, value_name = "FILE")]
    pub(crate) weather: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) year: YearArguments,
    /// Keep the year in this file while it goes, for `resume` and `merge`
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,
    /// Simulate part k of n of the sensor points alone, k from 0 to n - 1, and write no results but
    /// the checkpoint, which `merge` puts together with the others
    #[arg(long, value_name = "k/n", value_parser = slice, requires = "checkpoint",
        conflicts_with_all = ["out", "json"])]
    pub(crate) shard: Option<Slice>,
    /// Write the year to this folder, too, as Honeybee's recipe "annual daylight" does, for what
    /// goes on from there (LEED, BREEAM, WELL, EN 17037)
    #[arg(long, value_name = "FOLDER", conflicts_with = "checkpoint")]
    pub(crate) honeybee: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: OutputArguments,
}

/// The tolerance of a year where nothing is said.
pub(crate) const REL_TOL: &str = "2%";
/// The illuminance that is enough in any hour of a year where nothing is said.
pub(crate) const ABS_TOL: &str = "1lx";

/// Options of a year that go before what the project file says.
#[derive(Debug, Args)]
pub(crate) struct YearArguments {
    /// Wanted root mean square over hours of half-width over value, like 1% or 0.01
    #[arg(long, value_name = "SHARE", value_parser = share, default_value = REL_TOL)]
    pub(crate) rel_tol: f64,
    /// Half-width in lx that is enough in any hour, like 0.5 or 0.5lx
    #[arg(long, value_name = "LUX", value_parser = illuminance, default_value = ABS_TOL)]
    pub(crate) abs_tol: f64,
    /// Confidence level of the intervals, like 95% or 0.99
    #[arg(long, value_name = "SHARE", value_parser = level)]
    pub(crate) confidence: Option<f64>,
    /// Paths of each sensor point in each replicate, at most
    #[arg(long, value_name = "N", value_parser = whole(SAMPLES_OF_YEAR))]
    pub(crate) samples: Option<u64>,
    /// When people are there, by the clock of the site [default: the project's, or else 8-18]
    #[arg(long, value_name = "FROM-TO", value_parser = hours_of_day)]
    pub(crate) occupied: Option<Range<f64>>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = whole(THREADS))]
    pub(crate) threads: Option<u16>,
    /// Seed of all randomisations [default: the project's, or else 1]
    #[arg(long, value_name = "N", value_parser = whole(SEEDS))]
    pub(crate) seed: Option<u64>,
}
