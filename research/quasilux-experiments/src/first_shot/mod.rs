//! `quasilux experiment first-shot`: photons that leave lit places against photons that leave the
//! lights.
//!
//! Voloboy, Dmitriev and Kopylov (2003), after Kopylov (2002), take the light of point-like sources
//! out of the integral: it is computed where it lands, and photons start there, in proportion to
//! what goes on. A photon then never dies on its first surface, its dimension is lower by a flight,
//! and the jumps of the first flight are gone. Two rooms with and without it, with pseudo-random
//! numbers and with Sobol' points, in the paper's form: paths that end on an illumination map of
//! fixed elements, so that both have the same bias, and the spread of replicates is all the rest.

mod picture;
mod report;
mod rooms;
mod trial;

use crate::outcome::{Options, Outcome};
use quasilux_sampling::Sequence;
use rooms::Room;
use std::time::Duration;
use trial::Trial;

/// Replicates of each setup, unless the command line says otherwise.
const REPLICATES: u32 = 64;
/// Photons, and paths for each point, at most in each of them, unless the command line says
/// otherwise.
const MAX: u64 = 1 << 13;

/// How much is done.
#[derive(Clone, Copy)]
struct Effort {
    replicates: u32,
    samples: u64,
    seed: u64,
    limit: Option<Duration>,
}

/// Runs both rooms.
pub(super) fn run(arguments: &Options) -> Outcome {
    let effort = Effort {
        replicates: arguments.seeds.unwrap_or(REPLICATES),
        samples: arguments.max_n.unwrap_or(MAX),
        seed: arguments.seed,
        limit: arguments.seconds_per_point,
    };
    let rooms = rooms::all();
    let mut trials = trials(&rooms, &trial::SEQUENCES, &effort);
    Trial::time(&mut trials, &rooms, &effort);
    let mut claims = report::claims(&trials);
    claims.extend(report::claims_of_time(&trials));
    let tables = report::markdown(&trials, &claims);
    Outcome::new(report::csv(&trials), tables, picture::svg(&trials), &claims)
}

/// A trial of each room with each kind of points.
fn trials(rooms: &[Room], sequences: &[Sequence], effort: &Effort) -> Vec<Trial> {
    let of_room = |room| sequences.iter().map(move |&of| Trial::new(room, of, effort));
    rooms.iter().flat_map(of_room).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seed 0, Sobol' points, 32 replicates of 2^9 samples: errors are divided by 1.4 or so, known
    /// to a seventh (95 %). Each claim states its significance. Photons from lit places that
    /// carried 20 % too much would be noticed.
    #[test]
    fn first_shot_finds_the_same_light_with_less_noise() {
        let effort = Effort { replicates: 32, samples: 1 << 9, seed: 0, limit: None };
        for claim in report::claims(&trials(&rooms::all(), &[Sequence::Sobol], &effort)) {
            assert!(claim.holds(), "{}", claim.text());
        }
    }
}
