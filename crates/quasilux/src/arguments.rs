//! What can be said on the command line.

mod bsdf;
mod check;
mod parts;
mod photometry;
mod points;

pub(crate) use bsdf::{BsdfArguments, Incidence};
pub(crate) use check::CheckArguments;
pub(crate) use parts::{
    MergeArguments, PlanArguments, PlannedArguments, ResumeArguments, ShardArguments,
};
pub(crate) use photometry::{DiagramName, PhotometryArguments};
pub(crate) use points::PointsArguments;

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;
use std::time::Duration;

/// How many lux, and how sure: a lighting simulator.
#[derive(Debug, Parser)]
#[command(version, about, arg_required_else_help = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Simulate a project until every sensor point is known to the wanted tolerance
    Run(RunArguments),
    /// Say what was understood of a project and what is probably wrong with it, and draw its plan
    Check(CheckArguments),
    /// Run the cases of validation/ against their closed forms; exit code 1 when one fails
    Validate(ValidateArguments),
    /// Repeat one of the experiments of the paper, or one of our own; exit code 1 when what it
    /// checks fails
    Experiment(ExperimentArguments),
    /// Print or draw points of a sequence, or compare all sequences
    Points(PointsArguments),
    /// Summarise, draw or convert luminaire files
    Photometry(PhotometryArguments),
    /// Summarise or draw measured surfaces
    Bsdf(BsdfArguments),
    /// Write down what a run of a fixed number of samples does, for shards: every point gets them
    /// all, whatever the tolerance
    Plan(PlanArguments),
    /// Compute a part of a project's samples
    Shard(ShardArguments),
    /// Put the parts of a run together
    Merge(MergeArguments),
    /// Go on from a checkpoint
    Resume(ResumeArguments),
}

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// The project file
    pub(crate) project: PathBuf,
    #[command(flatten)]
    pub(crate) simulation: SimulationArguments,
    /// Do what a plan says, in one part: the same bits as its parts put together
    #[arg(long, value_name = "FILE", conflicts_with_all = [
        "rel_tol", "abs_tol", "tolerance_on", "confidence", "time", "samples", "rays",
        "estimator", "sequence",
        "seed", "checkpoint", "explain",
    ])]
    pub(crate) plan: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) keeping: CheckpointArguments,
    /// Also say which coordinates carry the variance, and what the sequence is worth here; takes
    /// some seconds more
    #[arg(long)]
    pub(crate) explain: bool,
    /// Refuse a scene in which something is probably wrong, instead of warning
    #[arg(long)]
    pub(crate) strict: bool,
    #[command(flatten)]
    pub(crate) output: OutputArguments,
}

/// Where results go.
#[derive(Debug, Args)]
pub(crate) struct OutputArguments {
    /// Folder for the results [default: out/NAME, NAME being the project file's]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print the result document on stdout and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Whether a run is kept on disk.
#[derive(Debug, Args)]
pub(crate) struct CheckpointArguments {
    /// Keep the run in this file while it goes, for `resume`
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,
    /// How often, at most
    #[arg(long, value_name = "TIME", value_parser = duration, default_value = "5s")]
    pub(crate) checkpoint_every: Duration,
}

/// Options that go before what the project file says.
#[derive(Debug, Default, Args)]
pub(crate) struct SimulationArguments {
    /// Wanted half-width of the interval over the value, like 1% or 0.01
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub(crate) rel_tol: Option<f64>,
    /// Half-width in lx that is enough whatever the value, like 0.5 or 0.5lx
    #[arg(long, value_name = "LUX", value_parser = illuminance)]
    pub(crate) abs_tol: Option<f64>,
    /// What has to reach the tolerance: points, or summary for the averages alone
    #[arg(long, value_name = "NAME")]
    pub(crate) tolerance_on: Option<String>,
    /// Confidence level of the intervals, like 95% or 0.99
    #[arg(long, value_name = "SHARE", value_parser = level)]
    pub(crate) confidence: Option<f64>,
    /// Stop after this time, like 60s, 5m or 1.5h, at the last completed checkpoint
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) time: Option<Duration>,
    /// Stop after this many indices per replicate: photons, and paths for each sensor point
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1 << 48))]
    pub(crate) samples: Option<u64>,
    /// Stop before more rays are traced, at the last completed checkpoint
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) rays: Option<u64>,
    /// photon, path, bidirectional or bidirectional-map
    #[arg(long, value_name = "NAME")]
    pub(crate) estimator: Option<String>,
    /// sobol, halton, hammersley (with --samples), faure4 or random
    #[arg(long, value_name = "NAME")]
    pub(crate) sequence: Option<String>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Seed of all randomisations
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
}

#[derive(Debug, Args)]
pub(crate) struct ValidateArguments {
    /// Folder of the cases
    #[arg(default_value = "validation")]
    pub(crate) folder: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct ExperimentArguments {
    /// Name of the experiment
    pub(crate) name: String,
    /// Folder for tables and pictures [default: out/NAME]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Largest number of photons or points compared [default: the experiment's own]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(64..=1 << 30))]
    pub(crate) max_n: Option<u64>,
    /// Runs of each setup, where the experiment has such, 2 or more [default: the experiment's own]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub(crate) seeds: Option<u32>,
    /// Time for one setup at the most, like 60s or 5m, where errors are shown against time
    /// [default: the experiment's own]
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) seconds_per_point: Option<Duration>,
    /// Seed of all randomisations; the first one where there are several
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
}

/// A share in (0, 1], as a number or with a percent sign.
fn share(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let share = match text.strip_suffix('%') {
        Some(percent) => number(percent).map(|percent| percent / 100.0),
        None => number(text),
    };
    share
        .filter(|share| *share > 0.0 && *share <= 1.0)
        .ok_or_else(|| "expected a share above 0 and up to 1, like 1% or 0.01".to_owned())
}

/// A share in (0, 1).
fn level(text: &str) -> Result<f64, String> {
    let below_one = share(text).ok().filter(|level| *level < 1.0);
    below_one.ok_or_else(|| "expected a share between 0 and 1, like 95% or 0.99".to_owned())
}

/// A positive illuminance in lx.
fn illuminance(text: &str) -> Result<f64, String> {
    let number = text.strip_suffix("lx").unwrap_or(text).trim().parse::<f64>();
    number
        .ok()
        .filter(|lx| *lx > 0.0 && lx.is_finite())
        .ok_or_else(|| "expected an illuminance above 0, like 0.5 or 0.5lx".to_owned())
}

/// Thirty years: what is longer cannot be added to a clock.
const MAX_SECONDS: f64 = 1e9;

/// A positive time in seconds, minutes or hours; seconds where no unit is given.
fn duration(text: &str) -> Result<Duration, String> {
    let (number, unit_s) = match text.char_indices().last() {
        Some((end, 's')) => (&text[..end], 1.0),
        Some((end, 'm')) => (&text[..end], 60.0),
        Some((end, 'h')) => (&text[..end], 3600.0),
        _ => (text, 1.0),
    };
    let seconds = number.trim().parse::<f64>().ok().map(|number| number * unit_s);
    seconds
        .filter(|seconds| *seconds > 0.0 && *seconds <= MAX_SECONDS)
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .ok_or_else(|| "expected a time above 0, like 60s, 5m or 1.5h, and at most 1e9s".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_is_consistent() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
    }

    #[test]
    fn shares_and_times_are_read() {
        assert_eq!(share("1%"), Ok(0.01));
        assert_eq!(share("0.5 %"), Ok(0.005));
        assert_eq!(share("0.02"), Ok(0.02));
        for bad in ["0", "-1%", "101%", "x", "", "%", "nan", "inf"] {
            assert!(share(bad).is_err(), "{bad}");
        }
        assert_eq!((level("99%"), illuminance("0.5 lx")), (Ok(0.99), Ok(0.5)));
        assert!(level("1").is_err() && level("100%").is_err());
        for bad in ["0", "-1lx", "lx", "inf", "nan", "1 fc"] {
            assert!(illuminance(bad).is_err(), "{bad}");
        }
        assert_eq!(duration("90"), Ok(Duration::from_secs(90)));
        assert_eq!(duration("1.5h"), Ok(Duration::from_secs(5400)));
        assert_eq!(duration("2m"), Ok(Duration::from_secs(120)));
        for bad in ["0s", "-1", "s", "", "1d", "nan", "1e300", "inf", "ü"] {
            assert!(duration(bad).is_err(), "{bad}");
        }
    }
}
