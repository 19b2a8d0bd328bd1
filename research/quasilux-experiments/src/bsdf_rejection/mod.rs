//! `quasilux experiment bsdf-rejection`: photons between measured surfaces, their directions by
//! inverse transform and by rejection, each with random and with Sobol' points.
//!
//! Voloboy, Dmitriev and Kopylov (2003) draw directions from the table of a BSDF as from that of a
//! luminaire: two coordinates, by inverse transform. Rejection takes three for each trial. Here all
//! walls of a closed box have one table, of a glossy surface, and a point lights it from within.

mod picture;
mod report;
mod walk;

use super::claim::Claim;
use super::flights::{Effort, Flights, MIN};
use super::significance::{ALIKE, each_of};
use crate::outcome::{Options, Outcome};
use quasilux_report::number::count;
use quasilux_sampling::Sequence;
use walk::{Glossy, Method};

/// Randomisations of each setup, unless the command line says otherwise.
const REPLICATES: u32 = 64;
/// The largest number of photons, unless the command line says otherwise.
const MAX: u64 = 1 << 16;
/// Comparisons in all; the one of likeness has two sides, of which only one can be passed by
/// chance.
const TESTS: usize = 3;
/// What the text says of them.
const TESTED: &str = "significance 1 % for all three comparisons together";

/// Photons with directions of one method and points of one kind.
struct Setup {
    method: Method,
    flights: Flights,
}

/// Traces all setups.
pub(super) fn run(arguments: &Options) -> Outcome {
    let effort = Effort {
        most: arguments.max_n.unwrap_or(MAX).max(MIN),
        replicates: arguments.seeds.unwrap_or(REPLICATES),
        seed: arguments.seed,
    };
    let glossy = Glossy::new();
    let setups = setups(&glossy, effort);
    let claims = claims(&setups);
    let tables = report::markdown(&setups, &glossy, effort.replicates, &claims);
    Outcome::new(report::csv(&setups), tables, picture::svg(&setups), &claims)
}

/// Rejection and inverse transform with random points, then with Sobol' points.
fn setups(glossy: &Glossy, effort: Effort) -> Vec<Setup> {
    let sequences = [Sequence::Independent, Sequence::Sobol];
    let all = sequences.into_iter().flat_map(|sequence| Method::ALL.map(|m| (sequence, m)));
    all.map(|(sequence, method)| {
        let flights = Flights::trace(
            |sampler, landed| glossy.photon(method, sampler, landed),
            sequence,
            effort,
        );
        Setup { method, flights }
    })
    .collect()
}

fn claims(setups: &[Setup]) -> Vec<Claim> {
    let [random_rejection, random_inverse, rejection, inverse] = setups else {
        return Vec::new();
    };
    let [trials, pairs] = [rejection, inverse].map(|setup| setup.flights.dimensions.mean());
    let photons = count(inverse.flights.last().photons);
    let cost = rejection.flights.last().over(inverse.flights.last());
    let apart = random_rejection.flights.last().over(random_inverse.flights.last());
    let gain = random_inverse.flights.last().over(inverse.flights.last());
    let level = each_of(TESTS);
    vec![
        Claim::new(
            format!(
                "Photons take {pairs:.2} coordinates by inverse transform and {trials:.2} by \
                 rejection"
            ),
            [trials, pairs],
            trials > pairs,
        ),
        Claim::new(
            format!(
                "With Sobol' points rejection has {} times the error of inverse transform at N = \
                 {photons}, more than 1 ({TESTED})",
                cost.text()
            ),
            [cost.ratio, cost.t()],
            cost.is_above(1.0, level),
        ),
        Claim::new(
            format!(
                "With random points it has {} times that error, which is within a tenth of 1 (two \
                 one-sided tests; {TESTED})",
                apart.text()
            ),
            [apart.ratio, apart.t()],
            apart.is_within(ALIKE, level),
        ),
        Claim::new(
            format!(
                "By inverse transform Sobol' points divide the error of random ones by {} at N = \
                 {photons}, more than 1 ({TESTED})",
                gain.text()
            ),
            [gain.ratio, gain.t()],
            gain.is_above(1.0, level),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_claimed_holds() {
        let setups = setups(&Glossy::new(), Effort { most: 1 << 12, replicates: 64, seed: 0 });
        let claims = claims(&setups);
        assert_eq!(claims.len(), 4);
        let failed: Vec<&str> =
            claims.iter().filter(|claim| !claim.holds()).map(Claim::text).collect();
        assert!(failed.is_empty(), "{failed:?}");
    }
}
