//! `quasilux experiment dimension`: what superposition and inverse transform save in coordinates
//! and in error.
//!
//! Voloboy, Dmitriev and Kopylov (2003) bring the dimension of photons down by two means: one
//! coordinate serves a choice and then what hangs on it (modified superposition), and directions of
//! measured luminaires take two coordinates by inverse transform instead of three for each trial of
//! rejection. Here a room with four measured luminaires is lit by photons with all of it, with each
//! feature turned off by itself, and with none; and the coordinates of the paper's cube are
//! counted.

mod cube;
mod picture;
mod report;
mod room;
mod walk;

use super::claim::{Claim, largest, smallest};
use super::contrast::Contrast;
use super::flights::{Effort, Flights, MIN};
use super::significance::{ALIKE, each_of};
use crate::outcome::{Options, Outcome};
use cube::Cube;
use quasilux_report::number::count;
use quasilux_sampling::{Sampler, Sequence};
use room::Room;
use walk::{Features, PhotonTracer};

/// Randomisations of each setup, unless the command line says otherwise.
const REPLICATES: u32 = 64;
/// The largest one, unless the command line says otherwise.
const MAX: u64 = 1 << 16;
/// The sequences that are compared, random points last.
const SEQUENCES: [Sequence; 2] = [Sequence::Sobol, Sequence::Independent];

/// Photons with some features and points of one kind.
struct Setup {
    name: &'static str,
    features: Features,
    flights: Flights,
}

/// Traces all setups, and counts coordinates in the cube.
pub(super) fn run(arguments: &Options) -> Outcome {
    let replicates = arguments.seeds.unwrap_or(REPLICATES);
    let most = arguments.max_n.unwrap_or(MAX).max(MIN);
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
        let walk = PhotonTracer { room: &room, features };
        let photon = |sampler: &mut Sampler<'_>, landed: &mut dyn FnMut(usize)| {
            walk.photon(sampler, landed);
        };
        let flights = Flights::trace(photon, sequence, effort);
        Setup { name, features, flights }
    })
    .collect()
}

/// Those of one kind of points, the one with all features first.
fn with_sequence(setups: &[Setup], sequence: Sequence) -> Vec<&Setup> {
    setups.iter().filter(|setup| setup.flights.sequence == sequence).collect()
}

/// How many times the error of all features another setup has, with the same points.
fn cost(setups: &[Setup], setup: &Setup) -> Contrast {
    setup.flights.last().over(with_sequence(setups, setup.flights.sequence)[0].flights.last())
}

fn claims(setups: &[Setup]) -> Vec<Claim> {
    let [sobol, random] = SEQUENCES.map(|sequence| with_sequence(setups, sequence));
    let must_show: Vec<&Setup> =
        sobol[1..].iter().copied().filter(|setup| setup.features.must_show()).collect();
    // The last one is what Sobol' points gain.
    let tests = must_show.len() + random[1..].len() + 1;
    let level = each_of(tests);
    let tested = format!("significance 1 % for all {tests} comparisons together");
    let photons = count(sobol[0].flights.last().photons);
    let mut claims = Vec::new();
    for setup in must_show {
        let cost = cost(setups, setup);
        claims.push(Claim::new(
            format!(
                "With Sobol' points the setup \"{}\" has {} times the error of the one with all \
                 features at N = {photons}, more than 1 ({tested})",
                setup.name,
                cost.text(),
            ),
            [cost.ratio, cost.t()],
            cost.is_above(1.0, level),
        ));
    }
    let costs: Vec<Contrast> = random[1..].iter().map(|setup| cost(setups, setup)).collect();
    let ratios = || costs.iter().map(|cost| cost.ratio);
    claims.push(Claim::new(
        format!(
            "With random points no setup has another error: {:.2} to {:.2} times that of all \
             features, each within a tenth of 1 (two one-sided tests; {tested})",
            smallest(ratios()),
            largest(ratios()),
        ),
        costs.iter().flat_map(|cost| [cost.ratio, cost.t()]),
        costs.iter().all(|cost| cost.is_within(ALIKE, level)),
    ));
    let gain = random[0].flights.last().over(sobol[0].flights.last());
    claims.push(Claim::new(
        format!(
            "With all features Sobol' points divide the error of random ones by {} at N = \
             {photons}, more than 1 ({tested})",
            gain.text(),
        ),
        [gain.ratio, gain.t()],
        gain.is_above(1.0, level),
    ));
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
        assert_eq!(claims.len(), 4 + 2 + 2);
        let failed: Vec<&str> =
            claims.iter().filter(|claim| !claim.holds()).map(Claim::text).collect();
        assert!(failed.is_empty(), "{failed:?}");
    }
}
