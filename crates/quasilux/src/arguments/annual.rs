//! What can be said to `quasilux annual`.

use super::OutputArguments;
use super::parts::{Slice, slice};
use super::values::{hours_of_day, illuminance, level, share, whole};
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
    /// Wanted root mean square over hours of half-width over value, like 1% or 0.01
    #[arg(long, value_name = "SHARE", value_parser = share, default_value = "2%")]
    pub(crate) rel_tol: f64,
    /// Half-width in lx that is enough in any hour, like 0.5 or 0.5lx
    #[arg(long, value_name = "LUX", value_parser = illuminance, default_value = "1lx")]
    pub(crate) abs_tol: f64,
    /// Confidence level of the intervals, like 95% or 0.99
    #[arg(long, value_name = "SHARE", value_parser = level)]
    pub(crate) confidence: Option<f64>,
    /// Paths of each sensor point in each replicate, at most
    #[arg(long, value_name = "N", value_parser = whole::<u64>(1..=1 << 30))]
    pub(crate) samples: Option<u64>,
    /// When people are there, by the clock of the site [default: the project's, or else 8-18]
    #[arg(long, value_name = "FROM-TO", value_parser = hours_of_day)]
    pub(crate) occupied: Option<Range<f64>>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = whole::<u16>(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Seed of all randomisations [default: the project's, or else 1]
    #[arg(long, value_name = "N", value_parser = whole::<u64>(0..=u64::MAX))]
    pub(crate) seed: Option<u64>,
    /// Keep the year in this file while it goes, for `resume` and `merge`
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,
    /// Simulate part k of n of the sensor points alone, k from 0 to n - 1, and write no results but
    /// the checkpoint, which `merge` puts together with the others
    #[arg(long, value_name = "k/n", value_parser = slice, requires = "checkpoint",
        conflicts_with_all = ["out", "json"])]
    pub(crate) shard: Option<Slice>,
    #[command(flatten)]
    pub(crate) output: OutputArguments,
}
