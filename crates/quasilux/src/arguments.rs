//! What can be said on the command line.

mod annual;
mod bsdf;
mod check;
mod export;
mod import;
mod parts;
mod photometry;
mod points;
mod refusal;
mod sky;
pub(crate) mod values;

pub(crate) use annual::{
    ABS_TOL as ABS_TOL_OF_YEAR, AnnualArguments, REL_TOL as REL_TOL_OF_YEAR, YearArguments,
};
pub(crate) use bsdf::{BsdfArguments, Incidence};
pub(crate) use check::CheckArguments;
pub(crate) use export::ExportArguments;
pub(crate) use import::ImportArguments;
pub(crate) use parts::{
    MergeArguments, PlanArguments, PlannedArguments, ResumeArguments, ShardArguments, WorkArguments,
};
pub(crate) use photometry::{DiagramName, PhotometryArguments};
pub(crate) use points::PointsArguments;
pub(crate) use refusal::{refusal, refused, unknown_command};
pub(crate) use sky::{Days, SkyArguments};

use crate::build::{COMMIT, VERSION};
use crate::kernel;
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use quasilux_experiments::{EXPERIMENTS, Experiment};
use quasilux_sampling::Sequence;
use quasilux_scene::project::{KeyTable, reference};
use quasilux_transport::{EstimatorKind, IntervalKind, ToleranceOn, UnseenTolerance};
use std::path::PathBuf;
use std::sync::LazyLock;
use std::time::Duration;
use values::{
    RAYS, SAMPLES, SEEDS, THREADS, duration, illuminance, level, one_of, share, unseen_tolerance,
    whole,
};

/// How many lux, and how sure: a lighting simulator.
#[derive(Debug, Parser)]
#[command(version, long_version = version(), about, arg_required_else_help = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Simulate a project until every sensor point is known to the wanted tolerance
    Run(RunArguments),
    /// Simulate the daylight of a year, hour by hour, of the weather file of a project
    Annual(AnnualArguments),
    /// Say what was understood of a project and what is probably wrong with it, and draw its plan
    Check(CheckArguments),
    /// Say what shines on a project from outside, draw its sky, and list where the sun is
    Sky(SkyArguments),
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
    /// Continue from a checkpoint
    Resume(ResumeArguments),
    /// Write a project file of a Honeybee model
    Import(ImportArguments),
    /// Write a project as files of another program
    Export(ExportArguments),
    /// Print the keys of the project file, with what they take and what holds without them
    Keys(KeysArguments),
    /// Print the script with which a shell completes commands, options and names
    Completions(CompletionsArguments),
    /// Print a page of the manual in roff, for `man`
    Man(ManArguments),
}

/// The version, the commit, and which kernel traces rays here.
fn version() -> &'static str {
    static TEXT: LazyLock<String> =
        LazyLock::new(|| format!("{VERSION}\ncommit: {COMMIT}\n{}", kernel::text()));
    &TEXT
}

impl Arguments {
    /// The definition of all commands, ready for those who describe it.
    pub(crate) fn definition() -> clap::Command {
        let mut definition = Self::command();
        definition.build();
        definition
    }

    /// The names of all commands, but for the help's.
    pub(crate) fn commands() -> Vec<String> {
        Self::command().get_subcommands().map(|command| command.get_name().to_owned()).collect()
    }
}

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// The project file, or a Honeybee model (.hbjson)
    pub(crate) project: PathBuf,
    #[command(flatten)]
    pub(crate) simulation: SimulationArguments,
    /// Do what a plan says, in one part: the same bits as its parts put together
    #[arg(long, value_name = "FILE", conflicts_with_all = [
        "rel_tol", "abs_tol", "unseen_tol", "tolerance_on", "interval", "confidence", "time",
        "samples", "rays", "estimator", "sequence", "seed", "checkpoint", "explain",
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
#[derive(Debug, Default, Args)]
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

/// How often a run is kept, at most, where nothing is said.
pub(crate) const CHECKPOINT_EVERY: &str = "5s";

/// Whether a run is kept on disk.
#[derive(Debug, Args)]
pub(crate) struct CheckpointArguments {
    /// Keep the run in this file while it goes, for `resume`
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,
    /// How often to keep it, at most
    #[arg(long, value_name = "TIME", value_parser = duration, default_value = CHECKPOINT_EVERY)]
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
    /// Wanted bound on light that no sample met over the value, like 5% or 0.05, for estimators
    /// that have one; never below rel-tol; off does not wait for it [default: the project's, or
    /// else 5%]
    #[arg(long, value_name = "SHARE", value_parser = unseen_tolerance)]
    pub(crate) unseen_tol: Option<UnseenTolerance>,
    /// What has to reach the tolerance: every sensor point, or the average of every sensor
    #[arg(long, value_name = "NAME", value_parser = one_of(&ToleranceOn::ALL, ToleranceOn::name))]
    pub(crate) tolerance_on: Option<String>,
    /// Which intervals are reported: Student's t, or also limits that hold for any number of
    /// samples [default: the project's, or else student-t]
    #[arg(long, value_name = "NAME", value_parser = one_of(&IntervalKind::ALL, IntervalKind::name))]
    pub(crate) interval: Option<String>,
    /// Confidence level of the intervals, like 95% or 0.99
    #[arg(long, value_name = "SHARE", value_parser = level)]
    pub(crate) confidence: Option<f64>,
    /// Stop after this time, like 60s, 5m or 1.5h, at the last completed checkpoint
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) time: Option<Duration>,
    /// Stop after this many indices per replicate: photons, and paths for each sensor point
    #[arg(long, value_name = "N", value_parser = whole(SAMPLES))]
    pub(crate) samples: Option<u64>,
    /// Stop before more rays are traced, at the last completed checkpoint
    #[arg(long, value_name = "N", value_parser = whole(RAYS))]
    pub(crate) rays: Option<u64>,
    /// How light is followed [default: the project's, or else auto]
    #[arg(
        long,
        value_name = "NAME",
        value_parser = one_of(&EstimatorKind::ALL, EstimatorKind::name)
    )]
    pub(crate) estimator: Option<String>,
    /// Points that drive the simulation, hammersley only with --samples [default: the project's, or
    /// else sobol]
    #[arg(long, value_name = "NAME", value_parser = one_of(&Sequence::all_for(1), Sequence::name))]
    pub(crate) sequence: Option<String>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = whole(THREADS))]
    pub(crate) threads: Option<u16>,
    /// Seed of all randomisations [default: the project's, or else 1]
    #[arg(long, value_name = "N", value_parser = whole(SEEDS))]
    pub(crate) seed: Option<u64>,
}

#[derive(Debug, Args)]
pub(crate) struct ValidateArguments {
    /// Folder with the folder `cases`
    #[arg(default_value = "validation")]
    pub(crate) folder: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct ExperimentArguments {
    /// Name of the experiment
    #[arg(value_parser = experiments())]
    pub(crate) name: String,
    /// Folder for tables and pictures [default: out/NAME]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Largest number of photons or points compared [default: the experiment's own]
    #[arg(long, value_name = "N", value_parser = whole::<u64>(64..=1 << 30))]
    pub(crate) max_n: Option<u64>,
    /// Runs of each setup, 2 or more, where the experiment repeats them [default: the experiment's
    /// own]
    #[arg(long, value_name = "N", value_parser = whole::<u32>(2..=1_000_000))]
    pub(crate) seeds: Option<u32>,
    /// Time for one setup at the most, like 60s or 5m, where errors are shown against time
    /// [default: the experiment's own]
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) seconds_per_point: Option<Duration>,
    /// Seed of all randomisations; the first one where there are several
    #[arg(long, value_name = "N", default_value = "0", value_parser = whole(SEEDS))]
    pub(crate) seed: u64,
}

/// The names of all experiments, with what each shows.
fn experiments() -> PossibleValuesParser {
    let name = |it: &Experiment| PossibleValue::new(it.name).help(it.shows);
    PossibleValuesParser::new(EXPERIMENTS.iter().map(name))
}

#[derive(Debug, Args)]
pub(crate) struct KeysArguments {
    /// The section whose keys are wanted, such as sensors [default: all of them]
    #[arg(value_name = "SECTION", value_parser = PossibleValuesParser::new(sections()))]
    pub(crate) section: Option<String>,
    /// Print tables in Markdown
    #[arg(long)]
    pub(crate) markdown: bool,
}

/// The names of all sections that have keys, each once.
fn sections() -> Vec<&'static str> {
    let mut names: Vec<&str> = reference().iter().map(KeyTable::name).collect();
    names.dedup();
    names
}

#[derive(Debug, Args)]
pub(crate) struct CompletionsArguments {
    /// The shell
    pub(crate) shell: Shell,
}

#[derive(Debug, Args)]
pub(crate) struct ManArguments {
    /// The command that the page is about [default: the program]
    #[arg(value_name = "COMMAND", conflicts_with = "out")]
    pub(crate) command: Option<String>,
    /// Write the pages of the program and of all commands to this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_is_consistent() {
        Arguments::command().debug_assert();
    }

    /// Those among them that nobody runs because they take too long.
    #[test]
    fn every_command_in_the_documentation_is_one() {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
        let read = |name: &str| {
            let path = format!("{root}/{name}");
            std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
        };
        let pages = std::fs::read_dir(format!("{root}/docs")).expect("a folder of pages");
        let pages =
            pages.map(|page| page.expect("a page").file_name().into_string().expect("UTF-8"));
        let pages = pages.filter(|name| name.ends_with(".md")).map(|name| format!("docs/{name}"));
        let documents = ["README.md", "CONTRIBUTING.md", "research/experiments.md"];
        let documents = documents.map(str::to_owned);
        let examples = ["cluster", "cornell", "corridor", "cube", "diffuser", "office"];
        let examples = examples.map(|name| format!("examples/{name}/README.md"));
        let own = "crates/quasilux/README.md".to_owned();
        let mut parsed = 0;
        for name in documents.into_iter().chain(pages).chain(examples).chain([own]) {
            let text = read(&name);
            let lines = text.lines().filter_map(|line| line.strip_prefix("    "));
            let calls = ["cargo run --release -- ", "quasilux "];
            for line in lines {
                let Some(arguments) = calls.iter().find_map(|call| line.strip_prefix(call)) else {
                    continue;
                };
                let words = arguments.split_whitespace().take_while(|word| *word != "#");
                let words = std::iter::once("quasilux").chain(words);
                if let Err(error) = Arguments::try_parse_from(words) {
                    panic!("{name}: {line}: {error}");
                }
                parsed += 1;
            }
        }
        assert!(parsed > 25, "only {parsed} commands were found");
    }
}
