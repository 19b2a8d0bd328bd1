//! `quasilux experiment dimension`: what superposition and inverse transform save in coordinates and in error.
//!
//! Voloboy, Dmitriev and Kopylov (2003) bring the dimension of photons down by two means: one coordinate serves
//! a choice and then what hangs on it (modified superposition), and directions of measured luminaires take
//! two coordinates by inverse transform instead of three for each trial of rejection. Here a room with four measured luminaires is
//! lit by photons with all of it, with each feature turned off by itself, and with none; and the coordinates of the
//! paper's cube are counted.

mod cube;
mod picture;
mod report;
mod room;
mod walk;

use super::Outcome;
use super::claim::Claim;
use super::flights::{Effort, Flights, LEAST};
use crate::arguments::ExperimentArguments;
use cube::Cube;
use quasilux_measure::number::count;
use quasilux_sampling::Sequence;
use room::Room;
use walk::{Features, Walk};

/// Randomisations of each setup, unless the command line says otherwise.
const REPLICATES: u32 = 64;
/// The largest one, unless the command line says otherwise.
const MOST: u64 = 1 << 16;
/// The sequences that are compared, random points last.
const SEQUENCES: [Sequence; 2] = [Sequence::Sobol, Sequence::Random];
/// Standard errors that chance exceeds once in 16 000 comparisons.
const ALIKE: f64 = 4.0;

/// Photons with some features and points of one kind.
struct Setup {
    name: &'static str,
    features: Features,
    flights: Flights,
}

/// Traces all setups, and counts coordinates in the cube.
pub(super) fn run(arguments: &ExperimentArguments) -> Outcome {
    let replicates = arguments.seeds.unwrap_or(REPLICATES).max(2);
    let most = arguments.max_n.unwrap_or(MOST).max(LEAST);
    let setups = setups(Effort { most, replicates, seed: arguments.seed });
    let cube = Cube::count(most, arguments.seed);
    let claims: Vec<Claim> = cube.claims().into_iter().chain(claims(&setups)).collect();
    let tables = report::markdown(&setups, &cube, replicates, &claims);
    Outcome::new(report::csv(&setups, &cube), tables, picture::svg(&setups), &claims)
}

fn setups(effort: Effort) -> Vec<Setup> {
    let room = Room::furnished();
    let all = SEQUENCES.into_iter().flat_map(|s| Features::ALL.map(move |named| (s, named)));
    all.map(|(sequence, (name, features))| {
        let walk = Walk { room: &room, features };
        let flights = Flights::of(|cursor, landed| walk.photon(cursor, landed), sequence, effort);
        Setup { name, features, flights }
    })
    .collect()
}

fn claims(setups: &[Setup]) -> Vec<Claim> {
    let of = |sequence: Sequence| {
        let own: Vec<&Setup> =
            setups.iter().filter(|setup| setup.flights.sequence == sequence).collect();
        own
    };
    let mut claims = Vec::new();
    let sobol = of(Sequence::Sobol);
    let (full, others) = sobol.split_first().expect("all features are the first setup");
    let best = full.flights.last();
    for setup in others {
        let error = setup.flights.last();
        let gain = error.over(best);
        let coordinates = setup.flights.dimensions.mean() - full.flights.dimensions.mean();
        let asked = if setup.features.must_show() {
            ", which is more than 1 at a significance of 1 %"
        } else {
            ", of which nothing is asked"
        };
        claims.push(Claim {
            text: format!(
                "With Sobol' points {} costs {coordinates:.1} coordinates a photon and {} times the error at N = \
                 {} (95 %){asked}",
                setup.name,
                gain.text(),
                count(error.photons),
            ),
            holds: coordinates > 0.0 && (gain.is_sure() || !setup.features.must_show()),
        });
    }
    let random = of(Sequence::Random);
    let plain = random[0].flights.last();
    let off = |setup: &&Setup| setup.flights.last().over(plain).standard_errors().abs();
    let most = random[1..].iter().map(off).fold(0.0, f64::max);
    claims.push(Claim {
        text: format!(
            "Random points do not care: no setup is further than {most:.1} standard errors from the one with all \
             features (4 allowed)"
        ),
        holds: most < ALIKE,
    });
    let gain = plain.over(best);
    claims.push(Claim {
        text: format!(
            "With all features Sobol' points divide the error of random ones by {} (95 %) at N = {}, by more than \
             1 at a significance of 1 %",
            gain.text(),
            count(best.photons),
        ),
        holds: gain.is_sure(),
    });
    claims
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_claimed_holds() {
        let setups = setups(Effort { most: 1 << 12, replicates: 32, seed: 0 });
        let claims: Vec<Claim> =
            Cube::count(1 << 13, 0).claims().into_iter().chain(claims(&setups)).collect();
        assert_eq!(claims.len(), 4 + 4 + 2);
        let failed: Vec<&str> =
            claims.iter().filter(|claim| !claim.holds).map(|claim| claim.text.as_str()).collect();
        assert!(failed.is_empty(), "{failed:?}");
    }
}
