//! The figures as a table for programs and as one for people, with what is seen in them.

use super::trial::{Agreement, FIT_FROM, NamedCourse, Part, Trial, error, mean_lx, slope};
use crate::claim::Claim;
use crate::contrast::Contrast;
use crate::course::Course;
use crate::significance::each_of;
use quasilux_report::number::{count, exact};
use std::fmt::Write;

const COLUMNS: &str = "room,sequence,first_shot,samples,replicates,rms_error_of_photons,\
    rms_error_of_whole,rays_per_replicate,seconds_per_replicate,slope,mean_of_photons_lx,mean_lx,\
    photon_dimension\n";

/// One line for each room, kind of points, switch and number of samples.
pub(super) fn csv(trials: &[Trial]) -> String {
    let mut text = COLUMNS.to_owned();
    for trial in trials {
        for NamedCourse { switch: name, course } in trial.runs() {
            let slope = slope(course, Part::OfPhotons).map(exact).unwrap_or_default();
            for snapshot in &course.snapshots {
                writeln!(
                    text,
                    "{},{},{name},{},{},{},{},{},{},{slope},{},{},{}",
                    trial.room,
                    trial.sequence.name(),
                    snapshot.samples,
                    snapshot.estimates.sensors[0].replicate_lx.len(),
                    exact(error(snapshot, Part::OfPhotons)),
                    exact(error(snapshot, Part::Whole)),
                    exact(snapshot.rays),
                    exact(snapshot.seconds),
                    exact(mean_lx(snapshot, Part::OfPhotons)),
                    exact(mean_lx(snapshot, Part::Whole)),
                    exact(snapshot.estimates.dimensions.photon.mean()),
                )
                .expect("strings grow");
            }
        }
    }
    text
}

/// The tables, and what they say.
pub(super) fn markdown(trials: &[Trial], claims: &[Claim]) -> String {
    let replicates = trials[0].last()[0].estimates.sensors[0].replicate_lx.len();
    let mut text = format!(
        "# Direct light taken out of the integral (first shot)\n\n\
         Illuminance at nine points of two rooms, from paths that end on an illumination map: with \
         photons from the lights (off), and from where their light lands (on). Errors are root \
         mean squares over points and {replicates} replicates, over the mean; they are those of \
         chance, for the bias of the map is the same. They are of light of two bounces and more, \
         which is all that photons bring: paths find the rest by themselves, and first shot does \
         nothing for it. N is photons, and paths for each point; slopes are fitted from N = \
         {FIT_FROM} on. Those of random points are steeper than -1/2, for part of the error is the \
         noise of elements that few paths read, which falls with photons and paths alike.\n"
    );
    for pair in trials.chunks(2) {
        writeln!(text, "\n## {}: {}\n", capitalised(pair[0].room), pair[0].why)
            .expect("strings grow");
        text.push_str(&table(pair));
    }
    text.push_str(&gains(trials));
    text.push_str(&Claim::markdown(claims));
    text
}

/// A row for every second power of two.
fn table(trials: &[Trial]) -> String {
    let columns: Vec<(String, &Course)> = trials
        .iter()
        .flat_map(|trial| {
            let name = trial.sequence.name();
            trial.runs().map(|run| (format!("{name}, {}", run.switch), run.course))
        })
        .collect();
    let header: String = columns.iter().map(|(name, _)| format!(" {name} |")).collect();
    let mut text = format!("| N |{header}\n|---:|{}\n", "---:|".repeat(columns.len()));
    let snapshots = trials[0].off.snapshots.len();
    for k in (0..snapshots).filter(|k| (snapshots - 1 - k).is_multiple_of(2)) {
        let cell = |(_, course): &(String, &Course)| match course.snapshots.get(k) {
            Some(snapshot) => format!(" {:.3} % |", 100.0 * error(snapshot, Part::OfPhotons)),
            None => " |".to_owned(),
        };
        let cells: String = columns.iter().map(cell).collect();
        writeln!(text, "| {} |{cells}", count(trials[0].off.snapshots[k].samples))
            .expect("strings grow");
    }
    let mut row = |name: &str, cell: &dyn Fn(&Course) -> String| {
        let cells: String =
            columns.iter().map(|(_, course)| format!(" {} |", cell(course))).collect();
        writeln!(text, "| {name} |{cells}").expect("strings grow");
    };
    row("slope", &|course| {
        slope(course, Part::OfPhotons).map_or("-".to_owned(), |slope| format!("{slope:.2}"))
    });
    row("error of the whole", &|course| {
        format!("{:.3} %", 100.0 * error(course.last(), Part::Whole))
    });
    row("rays a sample", &|course| {
        let snapshot = course.last();
        format!("{:.1}", snapshot.rays / snapshot.samples as f64)
    });
    row("ms a replicate", &|course| format!("{:.1}", 1e3 * course.last().seconds));
    row("coordinates a photon", &|course| {
        format!("{:.2}", course.last().estimates.dimensions.photon.mean())
    });
    text
}

fn gains(trials: &[Trial]) -> String {
    let mut text = "\n## What first shot gains when N is largest (95 % intervals)\n\n\
        Of what photons bring, and of the whole.\n\n\
        | room | points | error divided by | efficiency by rays | efficiency by time | whole: \
        error divided by | whole: efficiency by time |\n\
        |---|---|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for trial in trials {
        writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} |",
            trial.room,
            trial.sequence.name(),
            trial.gain(Part::OfPhotons).text(),
            trial.gain_by_rays().text(),
            trial.gain_by_time().text(),
            trial.gain(Part::Whole).text(),
            trial.gain_of_part_by_time(Part::Whole).text(),
        )
        .expect("strings grow");
    }
    text.push_str(
        "\nEfficiency is one over squared error times cost. Intervals are of the errors: what a \
         ray takes is the median of short\n\
         runs in turn, and how far that is off by chance is not in them.\n",
    );
    text
}

/// What may lie between means that are found with it and without, whatever their noise: in the
/// published run it is a tenth of this.
const APART: f64 = 0.1;
/// What is compared of each trial: error, efficiency by rays and by time.
const COMPARISONS: usize = 3;

/// What does not depend on the clock.
pub(super) fn claims(trials: &[Trial]) -> Vec<Claim> {
    let agree = trials.iter().map(|trial| agrees(trial, trials.len()));
    let gain = |trial| {
        gains_by(
            trial,
            "divides the error of what photons bring",
            Trial::gain_of_photons,
            trials.len(),
        )
    };
    let rays = |trial| {
        gains_by(
            trial,
            "multiplies the efficiency of what photons bring by rays",
            Trial::gain_by_rays,
            trials.len(),
        )
    };
    agree.chain(trials.iter().map(gain)).chain(trials.iter().map(rays)).collect()
}

/// What does.
pub(super) fn claims_of_time(trials: &[Trial]) -> Vec<Claim> {
    let time = |trial| {
        gains_by(
            trial,
            "multiplies the efficiency of what photons bring by time",
            Trial::gain_by_time,
            trials.len(),
        )
    };
    trials.iter().map(time).collect()
}

fn agrees(trial: &Trial, trials: usize) -> Claim {
    let Agreement { worst, allowed, relative } = trial.agreement(trials);
    Claim::new(
        format!(
            "{}, {}: with and without it the same light is found, at nine points within {:.3} % of \
             each other ({:.0} % allowed), {worst:.2} standard errors at the worst where \
             {allowed:.2} are allowed (significance 1 % for all points of all rooms together)",
            capitalised(trial.room),
            trial.sequence.name(),
            100.0 * relative,
            100.0 * APART,
        ),
        [worst, allowed, relative],
        worst <= allowed && relative <= APART,
    )
}

fn gains_by(trial: &Trial, what: &str, gain: fn(&Trial) -> Contrast, trials: usize) -> Claim {
    let gain = gain(trial);
    let tests = COMPARISONS * trials;
    Claim::new(
        format!(
            "{}, {}: first shot {what} by {} after {} samples, by more than 1 (significance 1 % \
             for all {tests} comparisons together)",
            capitalised(trial.room),
            trial.sequence.name(),
            gain.text(),
            count(trial.last()[0].samples),
        ),
        [gain.ratio, gain.t()],
        gain.is_above(1.0, each_of(tests)),
    )
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
