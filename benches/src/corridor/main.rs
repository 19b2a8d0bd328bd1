//! cargo run --release -p quasilux-benches --bin corridor [NAME or SECONDS...]
//!
//! Light that is hard to find: the error at the sensors of `examples/corridor` against rays and
//! processor time, for all estimators, with photons steered and left alone, and for a
//! [yardstick](walks) by the name of `walks`.
//!
//! All errors are relative to the reference and weigh every one of the 30 cells equally:
//!
//! - `one`: root mean square over the cells of the standard error of one replicate, from the spread
//!   of 16;
//! - `mean`: the same of their mean, a quarter of it;
//! - `off`: root mean square over the cells of how far the mean is off the reference;
//! - `worst`: the cell that is furthest off, and its number.
//!
//! Cells that hardly any photon reaches are too low together, and their spread does not tell: there
//! `off` is the error. The reference is the result of a photon tracer that shares no code with this
//! project, good to 0.22 % root mean square and 0.5 % at worst: below that `off` means nothing, and
//! `mean` is the error. The last line of each tells when the larger of `mean` and of `off` without
//! the reference's share came below 10 %, 5 %, 2 % and 1 % for good; of the yardstick, whose
//! sensors are points, when `mean` did. It also tells when no cell was off by more than 2 %, for
//! good.

mod walks;

use quasilux_benches::scenes;
use quasilux_foreign::all_processors_seconds;
use quasilux_transport::{
    Control, Estimates, EstimatorKind, Observer, Progress, Settings, Switch, simulate,
};
use walks::Walks;

const REPLICATES: u32 = 16;
/// Each contestant ends at the checkpoint after this, unless told otherwise.
const MAX_SECONDS: f64 = 20.0;
/// Errors that are waited for.
const GOALS: [f64; 4] = [0.1, 0.05, 0.02, 0.01];

/// The same for the cell that is furthest off.
const GOAL_EVERYWHERE: f64 = 0.02;

/// Walks of each replicate before the yardstick is looked at.
const MIN_WALKS: u64 = 1 << 12;

/// One line of the comparison.
struct Contestant {
    name: &'static str,
    estimator: EstimatorKind,
    importance: Switch,
}

const CONTESTANTS: [Contestant; 6] = [
    contestant("path", EstimatorKind::Path, Switch::Off),
    contestant("photon", EstimatorKind::Photon, Switch::Off),
    contestant("photon-steered", EstimatorKind::Photon, Switch::Auto),
    contestant("map", EstimatorKind::BidirectionalMap, Switch::Off),
    contestant("map-steered", EstimatorKind::BidirectionalMap, Switch::Auto),
    contestant("bidirectional", EstimatorKind::Bidirectional, Switch::Off),
];

const fn contestant(
    name: &'static str,
    estimator: EstimatorKind,
    importance: Switch,
) -> Contestant {
    Contestant { name, estimator, importance }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let longest = words.iter().find_map(|word| word.parse().ok()).unwrap_or(MAX_SECONDS);
    let names: Vec<&String> = words.iter().filter(|word| word.parse::<f64>().is_err()).collect();
    let reference = Reference::read();
    println!(
        "{:<22}{:>9}{:>9}{:>9}{:>10}{:>10}{:>10}{:>10}{:>5}",
        "", "samples", "Mrays", "CPU, s", "one, %", "mean, %", "off, %", "worst, %", "at"
    );
    let chosen = |contestant: &&Contestant| {
        names.is_empty() || names.iter().any(|name| *name == contestant.name)
    };
    for contestant in CONTESTANTS.iter().filter(chosen) {
        run(contestant, &reference, longest);
    }
    if names.is_empty() || names.iter().any(|name| *name == "walks") {
        walk(&reference, longest);
    }
}

/// The yardstick.
fn walk(reference: &Reference, longest_seconds: f64) {
    let mut replicates: Vec<Walks> = (0..u64::from(REPLICATES)).map(Walks::new).collect();
    let mut table = Table::new("walks", reference, longest_seconds);
    let mut walks = MIN_WALKS;
    loop {
        Walks::grow(&mut replicates, walks);
        let replicate_lx: Vec<Vec<f64>> = replicates.iter().map(Walks::lx).collect();
        let rays = replicates.iter().map(|replicate| replicate.rays).sum();
        if table.look(walks, rays, &replicate_lx, None) == Control::Stop {
            break;
        }
        walks *= 2;
    }
    table.end();
}

fn run(contestant: &Contestant, reference: &Reference, longest_seconds: f64) {
    let scene = scenes::example("corridor").scene;
    let settings = Settings {
        estimator: contestant.estimator,
        importance: contestant.importance,
        replicates: REPLICATES,
        rel_tol: 0.0,
        ..Settings::default()
    };
    let mut table = Table::new(contestant.name, reference, longest_seconds);
    let _ = simulate(&scene, &settings, &mut table);
    table.end();
}

/// What another program says of the cells.
struct Reference {
    value_lx: Vec<f64>,
    /// Root mean square of its relative standard errors.
    error: f64,
}

impl Reference {
    fn read() -> Self {
        let table = include_str!("../../../examples/corridor/reference.csv");
        let column = |index: usize| {
            let number = move |line: &str| line.split(',').nth(index)?.parse::<f64>().ok();
            table.lines().skip(1).map(move |line| number(line).expect("a table of numbers"))
        };
        let error = root_mean_square(column(2).map(|percent| 0.01 * percent));
        Self { value_lx: column(1).collect(), error }
    }
}

/// Prints a line at each checkpoint.
struct Table<'a> {
    name: &'static str,
    reference: &'a Reference,
    start: f64,
    longest_seconds: f64,
    /// Seconds after which each of [`GOALS`] was reached for good.
    reached: [Option<f64>; GOALS.len()],
    /// The same of [`GOAL_EVERYWHERE`].
    reached_everywhere: Option<f64>,
}

impl<'a> Table<'a> {
    fn new(name: &'static str, reference: &'a Reference, longest_seconds: f64) -> Self {
        let (start, reached) = (all_processors_seconds(), GOALS.map(|_| None));
        Self { name, reference, start, longest_seconds, reached, reached_everywhere: None }
    }

    /// Prints what there is after this many samples of each replicate; `known` is the reference
    /// where it is of the same sensors.
    fn look(
        &mut self,
        samples: u64,
        rays: u64,
        replicate_lx: &[Vec<f64>],
        known: Option<&Reference>,
    ) -> Control {
        let seconds = all_processors_seconds() - self.start;
        let cells = Cells::new(replicate_lx, &self.reference.value_lx);
        let one = root_mean_square(cells.spread.iter().copied());
        let mean = one / f64::from(REPLICATES).sqrt();
        print!(
            "{:<22}{samples:>9}{:>9.2}{seconds:>9.2}{:>10.2}{:>10.2}",
            self.name,
            rays as f64 / 1e6,
            100.0 * one,
            100.0 * mean,
        );
        let mut error = mean;
        if let Some(known) = known {
            let off = root_mean_square(cells.off.iter().copied());
            let worst = (0..cells.off.len())
                .max_by(|&a, &b| cells.off[a].abs().total_cmp(&cells.off[b].abs()))
                .expect("some cells");
            print!("{:>10.2}{:>10.2}{worst:>5}", 100.0 * off, 100.0 * cells.off[worst]);
            let is_near = cells.off[worst].abs() <= GOAL_EVERYWHERE;
            self.reached_everywhere = is_near.then_some(self.reached_everywhere.unwrap_or(seconds));
            // What the reference's own error adds to `off` is not the estimate's.
            error = error.max((off * off - known.error * known.error).max(0.0).sqrt());
        }
        println!();
        for (goal, reached) in GOALS.iter().zip(&mut self.reached) {
            *reached = (error <= *goal).then_some(reached.unwrap_or(seconds));
        }
        if seconds < self.longest_seconds { Control::Continue } else { Control::Stop }
    }

    /// Prints when the goals were reached.
    fn end(&self) {
        let goals = GOALS.iter().zip(self.reached).map(|(goal, seconds)| match seconds {
            Some(seconds) => format!("{:.0} % after {seconds:.2} s", 100.0 * goal),
            None => format!("{:.0} % not reached", 100.0 * goal),
        });
        let everywhere = self.reached_everywhere.map(|seconds| {
            format!("{:.0} % everywhere after {seconds:.2} s", 100.0 * GOAL_EVERYWHERE)
        });
        let ends: Vec<String> = goals.chain(everywhere).collect();
        println!("{:<22}{}", self.name, ends.join(", "));
    }
}

impl Observer for Table<'_> {
    fn progress(&mut self, _progress: &Progress) -> Control {
        Control::Continue
    }

    fn checkpoint(&mut self, estimates: &Estimates) -> Control {
        let Estimates { samples, rays, sensors, .. } = estimates;
        self.look(*samples, *rays, &sensors[0].replicate_lx, Some(self.reference))
    }
}

/// Errors of the cells, relative to the reference.
struct Cells {
    /// Standard deviation of the replicates.
    spread: Vec<f64>,
    /// Mean of the replicates less the reference.
    off: Vec<f64>,
}

impl Cells {
    fn new(replicate_lx: &[Vec<f64>], reference_lx: &[f64]) -> Self {
        let replicates = replicate_lx.len() as f64;
        let cell = |(cell, wanted_lx): (usize, &f64)| {
            let values = replicate_lx.iter().map(|row| row[cell] / wanted_lx);
            let mean = values.clone().sum::<f64>() / replicates;
            let squares: f64 = values.map(|value| (value - mean) * (value - mean)).sum();
            ((squares / (replicates - 1.0)).sqrt(), mean - 1.0)
        };
        let (spread, off) = reference_lx.iter().enumerate().map(cell).unzip();
        Self { spread, off }
    }
}

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(n, sum), value| (n + 1.0, sum + value * value));
    (sum / count).sqrt()
}
