//! `quasilux experiment gauntlet`: hard rooms made by a generator, against a brute-force reference.
//!
//! A room follows from its number: the family is the number modulo [`families`], the parameters
//! come from a hash of it. References are from `quasilux-brute`, a program that shares no code with
//! quasilux and is told where to look; they are shipped with the crate ([`references()`]). Each
//! estimator runs each room with several seeds, up to a tolerance or a time limit, and every point
//! that has an interval is held against its reference. An interval that is far off has lied,
//! whatever share of the others covers the truth; a point without an interval was withdrawn, which
//! is honest.

#[cfg(test)]
mod brute;
mod count;
mod dice;
mod families;
mod picture;
mod references;
mod report;
mod room;
mod scene;
mod shell;
mod trial;

pub use dice::Parameter;
pub use references::{Reference, RoomReferences, references};
pub use room::{Face, Lamp, Lookout, Parallelogram, Room, SensorPlace, Shine, Surface};

use crate::outcome::{Options, Outcome};
use dice::Dice;
use quasilux_transport::EstimatorKind;
use std::time::Duration;
use trial::Trial;

/// The estimators that run the gauntlet; the first one is what claims are about.
const ESTIMATORS: [EstimatorKind; 5] = [
    EstimatorKind::Auto,
    EstimatorKind::Path,
    EstimatorKind::Bidirectional,
    EstimatorKind::BidirectionalMap,
    EstimatorKind::Photon,
];
/// Seeds of each room and estimator, unless the command line says otherwise.
const SEEDS: u32 = 2;
/// Time for one run, likewise.
const SECONDS: Duration = Duration::from_secs(10);

/// How much is done.
struct Effort {
    rooms: u64,
    seeds: u32,
    seed: u64,
    limit: Duration,
    max_samples: Option<u64>,
}

/// The room of this number.
#[must_use]
pub fn room(number: u64) -> Room {
    let family = &families::ALL[(number % families::ALL.len() as u64) as usize];
    let mut dice = Dice::new(number);
    let room = (family.make)(&mut dice);
    Room { number, family: family.name, parameters: dice.drawn, ..room }
}

/// How many families there are: rooms from 0 up to it are one of each.
#[must_use]
pub fn families() -> u64 {
    families::ALL.len() as u64
}

/// Runs the first rooms of the cache.
pub(super) fn run(arguments: &Options) -> Outcome {
    let effort = Effort {
        rooms: arguments.max_n.unwrap_or(families()),
        seeds: arguments.seeds.unwrap_or(SEEDS),
        seed: arguments.seed,
        limit: arguments.seconds_per_point.unwrap_or(SECONDS),
        max_samples: None,
    };
    outcome(&effort, references())
}

fn outcome(effort: &Effort, references: Vec<RoomReferences>) -> Outcome {
    let known = references.into_iter().filter(|room| room.number < effort.rooms);
    let (known, refused): (Vec<_>, Vec<_>) = known.partition(|it| it.fit(&room(it.number)));
    let trials = trials(effort, &known);
    let claims = report::claims(&trials);
    let markdown = report::markdown(&trials, &known, &refused, effort, &claims);
    Outcome::new(report::csv(&trials), markdown, picture::svg(&trials), &claims)
}

/// One run after the other: each has all threads to itself while its time counts.
fn trials(effort: &Effort, known: &[RoomReferences]) -> Vec<Trial> {
    let mut trials = Vec::new();
    for references in known {
        let room = room(references.number);
        let scene = room.scene();
        for estimator in ESTIMATORS {
            for seed in 0..u64::from(effort.seeds) {
                let seed = effort.seed + seed;
                let &Effort { limit, max_samples, .. } = effort;
                let ask = trial::Ask { estimator, seed, limit, max_samples };
                trials.push(Trial::run(&room, &scene, references, &ask));
            }
        }
    }
    trials
}

#[cfg(test)]
mod tests;
