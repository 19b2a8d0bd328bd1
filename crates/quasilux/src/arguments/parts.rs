//! What can be said to `plan`, `shard`, `merge` and `resume`.

use super::values::{THREADS, duration, one_of, whole};
use super::{CHECKPOINT_EVERY, OutputArguments};
use clap::{ArgGroup, Args};
use quasilux_sampling::Sequence;
use quasilux_transport::EstimatorKind;
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

/// Options that go before what the project file says, of a run whose number of samples is fixed.
#[derive(Debug, Args)]
pub(crate) struct PlannedArguments {
    /// Indices per replicate: photons, and paths for each sensor point
    #[arg(long, value_name = "N", value_parser = whole::<u64>(1..=1 << 48))]
    pub(crate) samples: Option<u64>,
    /// How light is followed [default: the project's, or else auto]
    #[arg(
        long,
        value_name = "NAME",
        value_parser = one_of(&EstimatorKind::ALL, EstimatorKind::name)
    )]
    pub(crate) estimator: Option<String>,
    /// Points that drive the simulation [default: the project's, or else sobol]
    #[arg(long, value_name = "NAME", value_parser = one_of(&Sequence::all_for(1), Sequence::name))]
    pub(crate) sequence: Option<String>,
    /// Seed of all randomisations [default: the project's, or else 1]
    #[arg(long, value_name = "N", value_parser = whole::<u64>(0..=u64::MAX))]
    pub(crate) seed: Option<u64>,
}

/// Who works.
#[derive(Debug, Args)]
pub(crate) struct WorkArguments {
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = whole(THREADS))]
    pub(crate) threads: Option<u16>,
}

#[derive(Debug, Args)]
pub(crate) struct PlanArguments {
    /// The project file
    pub(crate) project: PathBuf,
    #[command(flatten)]
    pub(crate) planned: PlannedArguments,
    /// File for the plan [default: stdout]
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
}

#[derive(Debug, Args)]
#[command(group(ArgGroup::new("range").required(true).args(["index_range", "shard"])))]
pub(crate) struct ShardArguments {
    /// The project file
    pub(crate) project: PathBuf,
    /// The plan of the whole run; without it, one is made from --samples
    #[arg(long, value_name = "FILE", required_unless_present = "samples", conflicts_with_all = [
        "samples", "estimator", "sequence", "seed",
    ])]
    pub(crate) plan: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) planned: PlannedArguments,
    /// Indices from A up to B, B left out
    #[arg(long, value_name = "A..B", value_parser = index_range)]
    pub(crate) index_range: Option<Range<u64>>,
    /// Part k of n equal ones, k from 0 to n - 1
    #[arg(long, value_name = "k/n", value_parser = slice)]
    pub(crate) shard: Option<Slice>,
    /// File for the part [default: NAME-A-B.part, NAME being the project file's]
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    /// Print nothing but errors
    #[arg(long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct MergeArguments {
    /// The parts of a run or of a year, in any order
    #[arg(required = true, value_name = "PART")]
    pub(crate) parts: Vec<PathBuf>,
    /// The project file [default: where the plan was made]
    #[arg(long, value_name = "FILE")]
    pub(crate) project: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: OutputArguments,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
}

#[derive(Debug, Args)]
#[command(mut_arg("out", |out| out.help("Folder for the results [default: the run's]")))]
pub(crate) struct ResumeArguments {
    /// The checkpoint of a run or a year, which is kept up to date
    pub(crate) checkpoint: PathBuf,
    /// The project file [default: where the run was started]
    #[arg(long, value_name = "FILE")]
    pub(crate) project: Option<PathBuf>,
    /// Stop after this time from now on, like 60s, 5m or 1.5h, at the last completed checkpoint
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) time: Option<Duration>,
    /// How often to keep the run, at most
    #[arg(long, value_name = "TIME", value_parser = duration, default_value = CHECKPOINT_EVERY)]
    pub(crate) checkpoint_every: Duration,
    #[command(flatten)]
    pub(crate) output: OutputArguments,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
}

/// Part `number` of `of` equal ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slice {
    pub(crate) number: u64,
    pub(crate) of: u64,
}

impl Slice {
    /// Its indices among this many.
    pub(crate) fn indices(self, samples: u64) -> Range<u64> {
        let bound =
            |number: u64| (u128::from(samples) * u128::from(number) / u128::from(self.of)) as u64;
        bound(self.number)..bound(self.number + 1)
    }
}

/// k/n with k from 0 to n - 1, as Slurm's arrays and Kubernetes' indexed jobs count.
pub(super) fn slice(text: &str) -> Result<Slice, String> {
    let numbers = text.split_once('/').and_then(|(number, of)| {
        Some(Slice { number: number.trim().parse().ok()?, of: of.trim().parse().ok()? })
    });
    numbers
        .filter(|slice| slice.number < slice.of)
        .ok_or_else(|| "expected k/n with k from 0 to n - 1, like 0/16 or 15/16".to_owned())
}

fn index_range(text: &str) -> Result<Range<u64>, String> {
    let range = text.split_once("..").and_then(|(start, end)| {
        Some(start.trim().parse::<u64>().ok()?..end.trim().parse::<u64>().ok()?)
    });
    range
        .filter(|range| !range.is_empty())
        .ok_or_else(|| "expected A..B with A below B, like 0..4096".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_and_ranges_are_read() {
        assert_eq!(slice("0/16"), Ok(Slice { number: 0, of: 16 }));
        assert_eq!(slice("15 / 16"), Ok(Slice { number: 15, of: 16 }));
        for bad in ["16/16", "1", "/", "0/0", "-1/4", "a/b", "1/2/3", "", "0/"] {
            assert!(slice(bad).is_err(), "{bad}");
        }
        assert_eq!(index_range("3..7"), Ok(3..7));
        for bad in ["7..3", "3..3", "3", "..", "-1..2", "a..b", "0...5"] {
            assert!(index_range(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn slices_cover_all_indices() {
        for (samples, of) in [(1, 1), (7, 3), (1 << 48, 16), (1000, 999), (3, 7)] {
            let slices = (0..of).map(|number| Slice { number, of }.indices(samples));
            let mut next = 0;
            for slice in slices {
                assert_eq!(slice.start, next);
                next = slice.end;
            }
            assert_eq!(next, samples);
        }
    }
}
