//! Options of runs and years as values, with the names of their fields in messages.
//!
//! `None` says nothing: the project file holds then, or else what the command line has as default.
//! Values are checked as on the command line, by `arguments::values`.

use crate::arguments::values::{
    RAYS, SAMPLES, SAMPLES_OF_YEAR, SEEDS, THREADS, duration, duration_of, hours_of, illuminance,
    illuminance_of, level, level_of, name_of, share, share_of, unseen_tolerance,
    unseen_tolerance_of, whole_of,
};
use crate::arguments::{
    ABS_TOL_OF_YEAR, CHECKPOINT_EVERY, CheckpointArguments, OutputArguments, REL_TOL_OF_YEAR,
    ResumeArguments, SimulationArguments, WorkArguments, YearArguments, refused,
};
use crate::exit::CliError;
use quasilux_sampling::Sequence;
use quasilux_transport::{EstimatorKind, IntervalKind, ToleranceOn};
use std::fmt::Display;
use std::ops::{Range, RangeInclusive};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A share as a number, such as 0.01, or as text, such as "1%".
#[derive(Clone, Debug, PartialEq)]
pub enum Share {
    /// As a number.
    Number(f64),
    /// As on the command line.
    Text(String),
}

/// Options of `quasilux run`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunOptions {
    /// Wanted half-width of the interval over the value.
    pub rel_tol: Option<Share>,
    /// Half-width in lx that is enough whatever the value.
    pub abs_tol_lx: Option<f64>,
    /// Wanted bound on light that no sample met over the value; "off" does not wait for it.
    pub unseen_tol: Option<Share>,
    /// Name of what has to reach the tolerance: points, or summary.
    pub tolerance_on: Option<String>,
    /// Name of the intervals that are reported.
    pub interval: Option<String>,
    /// Confidence level of the intervals.
    pub confidence: Option<Share>,
    /// Stop after this many indices in each replicate.
    pub samples: Option<i128>,
    /// Stop before more rays are traced.
    pub rays: Option<i128>,
    /// Stop after this time in s.
    pub time_s: Option<f64>,
    /// Name of the way in which light is followed.
    pub estimator: Option<String>,
    /// Points that drive the simulation.
    pub sequence: Option<String>,
    /// Seed of all randomisations.
    pub seed: Option<i128>,
    /// Number of threads.
    pub threads: Option<i128>,
    /// Whether a scene is refused in which something is probably wrong.
    pub strict: bool,
    /// File in which the run is kept while it goes.
    pub checkpoint: Option<PathBuf>,
    /// Shortest time in s between two times that it is kept.
    pub checkpoint_every_s: Option<f64>,
}

/// Options of `quasilux resume`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResumeOptions {
    /// Stop after this time in s from now on.
    pub time_s: Option<f64>,
    /// Number of threads.
    pub threads: Option<i128>,
    /// Shortest time in s between two times that the run is kept.
    pub checkpoint_every_s: Option<f64>,
}

/// Options of `quasilux annual`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct YearOptions {
    /// Wanted root mean square over hours of half-width over value.
    pub rel_tol: Option<Share>,
    /// Half-width in lx that is enough in any hour.
    pub abs_tol_lx: Option<f64>,
    /// Confidence level of the intervals.
    pub confidence: Option<Share>,
    /// Paths of each sensor point in each replicate, at most.
    pub samples: Option<i128>,
    /// When people are there, in h by the clock of the site.
    pub occupied_h: Option<Range<f64>>,
    /// Seed of all randomisations.
    pub seed: Option<i128>,
    /// Number of threads.
    pub threads: Option<i128>,
}

impl RunOptions {
    /// Arguments of the simulation.
    pub(super) fn simulation(&self) -> Result<SimulationArguments, CliError> {
        let unseen = |it: &Share| it.read(unseen_tolerance, unseen_tolerance_of);
        let (interval, sequence) = (&self.interval, &self.sequence);
        Ok(SimulationArguments {
            rel_tol: taken("rel_tol", &self.rel_tol, |it| it.read(share, share_of))?,
            abs_tol: taken("abs_tol_lx", &self.abs_tol_lx, |lx| illuminance_of(*lx))?,
            unseen_tol: taken("unseen_tol", &self.unseen_tol, unseen)?,
            tolerance_on: taken("tolerance_on", &self.tolerance_on, |it| {
                name_of(it, &ToleranceOn::ALL, ToleranceOn::name)
            })?,
            interval: taken("interval", interval, |it| {
                name_of(it, &IntervalKind::ALL, IntervalKind::name)
            })?,
            confidence: taken("confidence", &self.confidence, |it| it.read(level, level_of))?,
            time: taken("time_s", &self.time_s, |seconds| duration_of(*seconds))?,
            samples: whole("samples", self.samples, &SAMPLES)?,
            rays: whole("rays", self.rays, &RAYS)?,
            estimator: taken("estimator", &self.estimator, |it| {
                name_of(it, &EstimatorKind::ALL, EstimatorKind::name)
            })?,
            sequence: taken("sequence", sequence, |it| {
                name_of(it, &Sequence::all_for(1), Sequence::name)
            })?,
            threads: whole("threads", self.threads, &THREADS)?,
            seed: whole("seed", self.seed, &SEEDS)?,
        })
    }

    /// Arguments of what keeps the run.
    pub(super) fn keeping(&self) -> Result<CheckpointArguments, CliError> {
        let checkpoint_every = checkpoint_every(self.checkpoint_every_s)?;
        Ok(CheckpointArguments { checkpoint: self.checkpoint.clone(), checkpoint_every })
    }
}

impl ResumeOptions {
    /// Arguments of a run that goes on.
    pub(super) fn arguments(&self, checkpoint: &Path) -> Result<ResumeArguments, CliError> {
        Ok(ResumeArguments {
            checkpoint: checkpoint.to_owned(),
            project: None,
            time: taken("time_s", &self.time_s, |seconds| duration_of(*seconds))?,
            checkpoint_every: checkpoint_every(self.checkpoint_every_s)?,
            output: OutputArguments::default(),
            work: WorkArguments { threads: whole("threads", self.threads, &THREADS)? },
        })
    }
}

impl YearOptions {
    /// Arguments of the year.
    pub(super) fn arguments(&self) -> Result<YearArguments, CliError> {
        let rel_tol = taken("rel_tol", &self.rel_tol, |it| it.read(share, share_of))?;
        let abs_tol = taken("abs_tol_lx", &self.abs_tol_lx, |lx| illuminance_of(*lx))?;
        Ok(YearArguments {
            rel_tol: or_default(rel_tol, REL_TOL_OF_YEAR, share)?,
            abs_tol: or_default(abs_tol, ABS_TOL_OF_YEAR, illuminance)?,
            confidence: taken("confidence", &self.confidence, |it| it.read(level, level_of))?,
            samples: whole("samples", self.samples, &SAMPLES_OF_YEAR)?,
            occupied: taken("occupied_h", &self.occupied_h, |hours| hours_of(hours.clone()))?,
            threads: whole("threads", self.threads, &THREADS)?,
            seed: whole("seed", self.seed, &SEEDS)?,
        })
    }
}

impl Share {
    /// Its meaning, by the validators of the command line.
    fn read<T>(
        &self,
        of_text: fn(&str) -> Result<T, String>,
        of_number: fn(f64) -> Result<T, String>,
    ) -> Result<T, String> {
        match self {
            Self::Number(number) => of_number(*number),
            Self::Text(text) => of_text(text),
        }
    }
}

fn checkpoint_every(seconds: Option<f64>) -> Result<Duration, CliError> {
    let every = taken("checkpoint_every_s", &seconds, |seconds| duration_of(*seconds))?;
    or_default(every, CHECKPOINT_EVERY, duration)
}

/// A value, or the default of the command line.
fn or_default<T>(
    value: Option<T>,
    default: &str,
    read: fn(&str) -> Result<T, String>,
) -> Result<T, CliError> {
    value.map_or_else(|| read(default).map_err(CliError::new), Ok)
}

/// The meaning of what was said, if anything was; a refusal names the field.
fn taken<S: Shown, T>(
    name: &str,
    said: &Option<S>,
    read: impl FnOnce(&S) -> Result<T, String>,
) -> Result<Option<T>, CliError> {
    let read =
        |said: &S| read(said).map_err(|why| CliError::new(refused(name, &said.shown(), &why)));
    said.as_ref().map(read).transpose()
}

fn whole<T>(
    name: &str,
    said: Option<i128>,
    range: &RangeInclusive<T>,
) -> Result<Option<T>, CliError>
where
    T: TryFrom<i128> + PartialOrd + Display,
{
    taken(name, &said, |number| whole_of(*number, range))
}

/// A value as messages quote it.
trait Shown {
    fn shown(&self) -> String;
}

impl Shown for f64 {
    fn shown(&self) -> String {
        const MAX_WIDTH: usize = 20;
        let plain = self.to_string().to_lowercase();
        if plain.len() > MAX_WIDTH { format!("{self:e}") } else { plain }
    }
}

impl Shown for i128 {
    fn shown(&self) -> String {
        self.to_string()
    }
}

impl Shown for String {
    fn shown(&self) -> String {
        self.clone()
    }
}

impl Shown for Share {
    fn shown(&self) -> String {
        match self {
            Self::Number(number) => number.shown(),
            Self::Text(text) => text.clone(),
        }
    }
}

impl Shown for Range<f64> {
    fn shown(&self) -> String {
        format!("{}-{}", self.start.shown(), self.end.shown())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arguments::{Arguments, Command};
    use clap::Parser;

    fn parsed(words: &str) -> Command {
        let words = std::iter::once("quasilux").chain(words.split_whitespace());
        Arguments::try_parse_from(words).expect("arguments").command
    }

    #[test]
    fn what_is_not_said_is_as_on_the_command_line() {
        let Command::Run(run) = parsed("run x") else { panic!("a run") };
        let own = RunOptions::default();
        let text = |value: &dyn std::fmt::Debug| format!("{value:?}");
        assert_eq!(text(&own.simulation().unwrap()), text(&run.simulation));
        assert_eq!(text(&own.keeping().unwrap()), text(&run.keeping));
        let Command::Resume(on) = parsed("resume x") else { panic!("a run that goes on") };
        let own = ResumeOptions::default().arguments(Path::new("x")).unwrap();
        assert_eq!(text(&own), text(&on));
        let Command::Annual(annual) = parsed("annual x") else { panic!("a year") };
        assert_eq!(text(&YearOptions::default().arguments().unwrap()), text(&annual.year));
    }

    #[test]
    fn what_is_said_is_as_on_the_command_line() {
        let words = "run x --rel-tol=0.01 --abs-tol=0.5 --unseen-tol=off --tolerance-on=summary \
                     --interval=certified --confidence=99% --time=1.5 --samples=64 --rays=9 \
                     --estimator=path --sequence=halton --threads=3 --seed=18446744073709551615 \
                     --checkpoint=f --checkpoint-every=2";
        let Command::Run(run) = parsed(words) else { panic!("a run") };
        let text = |text: &str| Some(text.to_owned());
        let own = RunOptions {
            rel_tol: Some(Share::Number(0.01)),
            abs_tol_lx: Some(0.5),
            unseen_tol: Some(Share::Text("off".to_owned())),
            tolerance_on: text("summary"),
            interval: text("certified"),
            confidence: Some(Share::Text("99%".to_owned())),
            samples: Some(64),
            rays: Some(9),
            time_s: Some(1.5),
            estimator: text("path"),
            sequence: text("halton"),
            seed: Some(u64::MAX.into()),
            threads: Some(3),
            strict: false,
            checkpoint: Some("f".into()),
            checkpoint_every_s: Some(2.0),
        };
        assert_eq!(format!("{:?}", own.simulation().unwrap()), format!("{:?}", run.simulation));
        assert_eq!(format!("{:?}", own.keeping().unwrap()), format!("{:?}", run.keeping));
    }

    #[test]
    fn refusals_name_the_field_and_quote_the_value() {
        let said = |options: &RunOptions| options.simulation().unwrap_err().to_string();
        let share = |number: f64| Some(Share::Number(number));
        for (rel_tol, wanted) in [
            (share(-0.1), "rel_tol is \"-0.1\"; expected a share above 0"),
            (share(f64::NAN), "rel_tol is \"nan\"; expected a share above 0"),
            (share(1e300), "rel_tol is \"1e300\"; expected a share above 0"),
            (share(2.0), "rel_tol: 2 stands for 200 %: was 2 % meant?"),
            (Some(Share::Text("2".to_owned())), "rel_tol: 2 stands for 200 %: was 2 % meant?"),
        ] {
            let text = said(&RunOptions { rel_tol, ..RunOptions::default() });
            assert!(text.starts_with(wanted), "{text}");
        }
        let estimator = Some("pat".to_owned());
        let text = said(&RunOptions { estimator, ..RunOptions::default() });
        assert!(text.starts_with("estimator is \"pat\"; expected one of auto, "), "{text}");
        assert!(text.ends_with("; did you mean \"path\"?"), "{text}");
        let text = said(&RunOptions { threads: Some(-1), ..RunOptions::default() });
        assert_eq!(text, "threads is \"-1\"; expected a whole number from 1 to 1024");
        let year = YearOptions { occupied_h: Some(18.0..8.0), ..YearOptions::default() };
        let text = year.arguments().unwrap_err().to_string();
        assert_eq!(text, "occupied_h is \"18-8\"; expected hours of a day, like 8-18");
    }
}
