//! `quasilux experiment cube`: the diffuse cube of Voloboy, Dmitriev and Kopylov (2003), tables 4
//! and 5.
//!
//! A closed cube of 10 m, reflectance 2/3, one isotropic point light of 50 000 cd in the middle.
//! The error is the L2 norm over 25 places on each of the six walls, over that of the truth, which
//! is computed here (`truth`). The paper's four columns are photons that are counted on a map and
//! paths that end on one, each with random points and with Halton's; ours is the
//! default, with Owen's scrambling of Sobol' points. The paper shows one run of each; here errors
//! are root mean squares over independent randomisations, against N and against time. The floor
//! under the paper's errors is looked for in the size of the map's elements (`floor`).
//!
//! WarningKind: the paper does not tell the size of its elements, nor how many photons come with a
//! path. Direct light is computed, not read from the map, where paths end on it.

mod bias;
mod claims;
mod compare;
mod curve;
mod floor;
mod paper;
mod picture;
mod report;
mod scene;
mod setup;
mod table_5;
mod tables;
mod task;
mod truth;

use crate::outcome::{Options, Outcome};
use compare::{Column, Table};
use curve::{Currency, Curve};
use floor::Floor;
use scene::Places;
use setup::{Form, Points, Setup};
use std::time::Duration;
use task::Task;
use truth::Truth;

/// Randomisations of each setup, unless the command line says otherwise.
const REPLICATES: u32 = 64;
/// The largest N, and the time for all replicates of a column, unless the command line says
/// otherwise: whichever comes first.
const MAX: u64 = 1 << 20;
const SECONDS: Duration = Duration::from_secs(80);
/// N of what is beside the columns, unless the command line asks for less, however long it takes:
/// photons with other sequences, photons of elements of other sizes.
const OTHER_PHOTONS: u64 = 1 << 16;
const FLOOR_PHOTONS: u64 = 1 << 17;
/// Legs of the map's elements: 16 on a side, 3072 elements in all.
const ELEMENT_M: f64 = 0.625;
/// Photons of a map for each path from a place: about twice as many as make the error of pseudo2
/// least for its rays, which costs little and leaves more of the error to the paths.
const PHOTONS_PER_PATH: u32 = 1024;
/// Paths from each place where the floor of our own form is looked for, unless the command line
/// asks for less, however long it takes.
const DEEP: u64 = 1 << 17;

/// All that is measured.
struct Findings {
    replicates: u32,
    truth: Truth,
    /// In the order of [`compare::Column::ALL`].
    columns: [Curve; 5],
    /// The paper's forms with other points than the paper's.
    others: Vec<Curve>,
    /// The paper's forms with Halton's points as they are: one run of each.
    plain: [Curve; 2],
    floors: Vec<Floor>,
    /// Our own form, from one place of each class, with as many paths as take it below all floors.
    deep: Curve,
    table: Table,
}

/// Measures the columns, the sequences and the floors.
pub(super) fn run(arguments: &Options) -> Outcome {
    let truth = Truth::solve();
    let mut task = Task::at(Places::all(), &truth);
    task.replicates = arguments.seeds.unwrap_or(REPLICATES);
    task.seed = arguments.seed;
    task.most = arguments.max_n.unwrap_or(MAX);
    task.limit = Some(arguments.seconds_per_point.unwrap_or(SECONDS));
    let columns = columns(ELEMENT_M, PHOTONS_PER_PATH).map(|setup| (setup, task.clone()));
    let others = other_setups().map(|setup| (setup, beside(&task)));
    let all = columns.into_iter().chain(others);
    let mut columns: Vec<Curve> = all.map(|(setup, task)| Curve::run(setup, &task)).collect();
    Curve::time(&mut columns, &task);
    let others = columns.split_off(Column::ALL.len());
    let Ok(columns) = columns.try_into() else { unreachable!("a curve for each column") };
    let deep = deep(&task, &truth);
    let plain =
        plain_setups().map(|setup| Curve::run(setup, &Task { limit: None, ..task.clone() }));
    let to_floor = Task { most: task.most.min(FLOOR_PHOTONS), limit: None, ..task.clone() };
    let floors = Floor::all(&floor::ELEMENTS_M, PHOTONS_PER_PATH, &to_floor);
    let table = Table::new(&columns, Currency::Seconds);
    let replicates = task.replicates;
    let findings = Findings { replicates, truth, columns, others, plain, floors, deep, table };
    let claims = claims::all(&findings);
    let tables = report::markdown(&findings, &claims);
    Outcome::new(report::csv(&findings), tables, picture::svg(&findings), &claims)
}

/// The paper's columns and our own.
fn columns(element_m: f64, photons_per_path: u32) -> [Setup; 5] {
    let photons = Form::Photons { element_m };
    let map = Form::Map { element_m, photons_per_path };
    [
        Setup { form: photons, points: Points::Independent },
        Setup { form: photons, points: Points::Halton },
        Setup { form: map, points: Points::Independent },
        Setup { form: map, points: Points::Halton },
        Setup { form: Form::Own, points: Points::ScrambledSobol },
    ]
}

/// The paper's forms with the sequences that its columns leave out.
fn other_setups() -> impl Iterator<Item = Setup> {
    let forms = [
        Form::Photons { element_m: ELEMENT_M },
        Form::Map { element_m: ELEMENT_M, photons_per_path: PHOTONS_PER_PATH },
    ];
    let others = Points::SEQUENCES.into_iter().filter(|points| *points != Points::Halton);
    forms.into_iter().flat_map(move |form| others.clone().map(move |points| Setup { form, points }))
}

/// The paper's columns of quasi-random points as they are.
fn plain_setups() -> [Setup; 2] {
    let [_, quasi, _, quasi2, _] = columns(ELEMENT_M, PHOTONS_PER_PATH);
    [quasi, quasi2].map(|setup| Setup { points: Points::PlainHalton, ..setup })
}

/// What is beside the columns ends at the same N, however long it takes.
fn beside(task: &Task) -> Task {
    Task { most: task.most.min(OTHER_PHOTONS), limit: None, ..task.clone() }
}

/// Our own form at one place of each class.
fn deep(task: &Task, truth: &Truth) -> Curve {
    let few = Task::at(Places::one_of_each_class(), truth);
    let most = task.most.min(DEEP);
    let task = Task { most, replicates: task.replicates, seed: task.seed, ..few };
    Curve::run(Setup { form: Form::Own, points: Points::ScrambledSobol }, &task)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the claims say, at equal rays instead of equal times, on elements of 1.25 m: seed 0, 32
    /// randomisations, all costs of a duel together at 1 %, and each of six intervals so that all
    /// hold the truth in 99 of 100 cases.
    #[test]
    fn the_claims_hold_in_small() {
        let truth = Truth::solve();
        assert!(claims::truth(&truth).holds());
        let task = Task { most: 1 << 13, ..Task::at(Places::all(), &truth) };
        let photons = Task { most: 1 << 14, ..task.clone() };
        let few = Task { most: 16, ..task.clone() };
        let [pseudo, quasi, pseudo2, quasi2, own] = columns(1.25, 256);
        let curves = [
            Curve::run(pseudo, &photons),
            Curve::run(quasi, &photons),
            Curve::run(pseudo2, &task),
            Curve::run(quasi2, &task),
            Curve::run(own, &few),
        ];
        let table = Table::new(&curves, Currency::Rays);
        let duels = [[Column::Pseudo, Column::Quasi], [Column::Pseudo2, Column::Quasi2]];
        for claim in claims::duels(&table, &duels) {
            assert!(claim.holds() && table.rows.len() == 2, "{}", claim.text());
        }
        let floors = Floor::all(&[2.5, 1.25], 256, &Task { most: 1 << 12, ..task.clone() });
        let deep = deep(&Task { most: 1 << 9, ..task }, &truth);
        for claim in [claims::floors(&floors, 32), claims::places(&deep, &truth, 10.0)] {
            assert!(claim.holds(), "{}", claim.text());
        }
        let below = claims::own_is_below(&deep, 0.007);
        assert!(below.holds() && !claims::own_is_below(&deep, 0.004).holds(), "{}", below.text());
    }
}
