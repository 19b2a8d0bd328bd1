//! What the figures bear out.

use super::Findings;
use super::compare::{Column, Duel, Round, Table};
use super::curve::{Currency, Curve};
use super::floor::Floor;
use super::paper;
use super::scene::{CLASSES, inset, luminance_cd_m2};
use super::truth::Truth;
use crate::claim::{Claim, largest, smallest};
use crate::significance::{SIGNIFICANCE, each_of};
use quasilux_transport::interval::t_quantile_for;

/// The truth is known to this, in cd/m^2.
const AGREEMENT_CD_M2: f64 = 0.01;
/// What our own form is to get below.
const BELOW: f64 = 0.0005;
/// Which columns are claimed to beat which.
pub(super) const CLAIMED: [[Column; 2]; 3] = [
    [Column::Pseudo2, Column::Quasi2],
    [Column::Pseudo, Column::Quasi],
    [Column::Pseudo, Column::Quasi2],
];
/// How wide intervals may be, to each side, of luminances of 388 to 893 cd/m^2.
const KNOWN_CD_M2: f64 = 0.5;
/// The confidence of all intervals of the six luminances together.
const CONFIDENCE: f64 = 0.99;

/// A luminance with its interval.
pub(super) struct Luminance {
    pub(super) value_cd_m2: f64,
    pub(super) half_width_cd_m2: f64,
    /// At the very place of the sensor.
    pub(super) truth_cd_m2: f64,
}

/// All of them.
pub(super) fn all(findings: &Findings) -> Vec<Claim> {
    let Findings { replicates, truth: solved, floors: all_floors, deep, table, .. } = findings;
    let mut claims = vec![truth(solved)];
    claims.extend(duels(table, &CLAIMED));
    claims.extend([
        floors(all_floors, *replicates),
        own_is_below(deep, BELOW),
        places(deep, solved, KNOWN_CD_M2),
    ]);
    claims
}

/// The luminances at the six classes of places, right at the edges.
pub(super) fn solved_cd_m2(truth: &Truth) -> [f64; 6] {
    CLASSES.map(|at| luminance_cd_m2(truth.illuminance_lx(at.map(|x| x.min(1.0 - 1e-9)))))
}

pub(super) fn truth(truth: &Truth) -> Claim {
    let differences = solved_cd_m2(truth);
    let differences = differences.iter().zip(paper::SOLVED_CD_M2).map(|(a, b)| (a - b).abs());
    let difference = largest(differences);
    Claim::new(
        format!(
            "The solution by collocation agrees with one by radiosity and one by a spectral method \
             to {difference:.3} cd/m2 at all six places, which is within {AGREEMENT_CD_M2} cd/m2"
        ),
        [difference],
        difference < AGREEMENT_CD_M2,
    )
}

/// All duels together at one significance.
pub(super) fn duels(table: &Table, pairs: &[[Column; 2]]) -> Vec<Claim> {
    let duels: Vec<Duel> =
        pairs.iter().map(|[worse, better]| table.duel(*worse, *better)).collect();
    let tests = duels.iter().map(|duel| duel.rounds.len()).sum();
    duels.iter().map(|duel| won(duel, table.currency, tests)).collect()
}

fn won(duel: &Duel, currency: Currency, tests: usize) -> Claim {
    let Duel { worse, better, has_same_floor, rounds } = duel;
    let of = |figure: fn(&Round) -> f64| {
        let all = || rounds.iter().map(figure);
        [smallest(all()), largest(all())]
    };
    let [low, high] = of(|round| round.ratio);
    let [least, most] = of(|round| round.compared.ratio);
    let [least_t, _] = of(|round| round.compared.t());
    let compared = match has_same_floor {
        true => format!("; about the same floor it spreads {least:.2} to {most:.2} times less"),
        false => String::new(),
    };
    let won = duel.won(each_of(tests));
    Claim::new(
        format!(
            "At equal {}, {} beats {} at {won} of {} costs, from the first on: its error is \
             {low:.2} to {high:.2} times smaller{compared}; t = {least_t:.1} or more (significance \
             {} % for all {tests} comparisons of columns together)",
            currency.name(),
            better.name(),
            worse.name(),
            rounds.len(),
            100.0 * SIGNIFICANCE,
        ),
        [low, high, least, most, least_t],
        won == rounds.len() && won > 0,
    )
}

/// That each smaller element has a lower floor, in both forms.
pub(super) fn floors(floors: &[Floor], replicates: u32) -> Claim {
    let list = |of: &dyn Fn(&Floor) -> f64| {
        let all: Vec<String> =
            floors.iter().map(|floor| format!("{:.2}", 100.0 * of(floor))).collect();
        all.join(", ")
    };
    let elements: Vec<String> = floors.iter().map(|floor| floor.element_m.to_string()).collect();
    let of_photons = Floor::least_step(floors, |floor| &floor.photons);
    let least = smallest([of_photons, Floor::least_step(floors, |floor| &floor.map)]);
    // One-sided, all steps of both forms together (Bonferroni).
    let steps = 2 * floors.len().saturating_sub(1).max(1);
    let critical = t_quantile_for(replicates as usize, 2.0 * SIGNIFICANCE / steps as f64);
    let critical = critical.unwrap_or(f64::INFINITY);
    Claim::new(
        format!(
            "The floor moves with the elements: with legs of {} m it is at {} % for quasi and {} % \
             for quasi2, each below the one before by {least:.1} standard errors of the square or \
             more ({critical:.1} are significant: all together at {} %)",
            elements.join(", "),
            list(&|floor| floor.photons.bias.norm()),
            list(&|floor| floor.map.bias.norm()),
            100.0 * SIGNIFICANCE,
        ),
        [least, critical],
        least > critical,
    )
}

/// That a replicate's error is below this at the end, beyond chance.
pub(super) fn own_is_below(own: &Curve, below: f64) -> Claim {
    let end = own.end();
    let squares: Vec<f64> = end.errors.iter().map(|error| error * error).collect();
    let n = squares.len() as f64;
    let mean = squares.iter().sum::<f64>() / n;
    let spread: f64 = squares.iter().map(|square| (square - mean) * (square - mean)).sum();
    let t = t_quantile_for(squares.len(), 2.0 * SIGNIFICANCE).unwrap_or(f64::INFINITY);
    let highest = (mean + t * (spread / (n * (n - 1.0))).sqrt()).sqrt();
    Claim::new(
        format!(
            "Our own form goes through the floor: with {} paths from each place its error is {:.4} \
             %, at most {:.4} % at {} %, and below {} %",
            end.paths,
            100.0 * mean.sqrt(),
            100.0 * highest,
            100.0 * (1.0 - SIGNIFICANCE),
            100.0 * below,
        ),
        [mean, highest],
        highest < below,
    )
}

/// That the intervals hold the truth, and are narrow enough to say something.
pub(super) fn places(own: &Curve, truth: &Truth, known_cd_m2: f64) -> Claim {
    let all = luminances(own, truth);
    let held = |place: &&Luminance| {
        (place.value_cd_m2 - place.truth_cd_m2).abs() <= place.half_width_cd_m2
    };
    let held = all.iter().filter(held).count();
    let widest = largest(all.iter().map(|place| place.half_width_cd_m2));
    Claim::new(
        format!(
            "The intervals of our own form, {} % for all six together and {widest:.2} cd/m2 or \
             less to each side, where {known_cd_m2} are allowed, hold {held} of the 6 luminances",
            100.0 * CONFIDENCE,
        ),
        [widest],
        held == all.len() && widest <= known_cd_m2,
    )
}

/// The six luminances by our own form, from one place of each class.
pub(super) fn luminances(own: &Curve, truth: &Truth) -> Vec<Luminance> {
    let mut last = own.last.clone();
    // Sidak (1967); no interval of this run ended it.
    last.miss_probability = 1.0 - libm::pow(CONFIDENCE, 1.0 / CLASSES.len() as f64);
    let intervals = last.point_intervals(0);
    let luminance = |(class, interval): (usize, &quasilux_transport::Interval)| Luminance {
        value_cd_m2: luminance_cd_m2(interval.value),
        half_width_cd_m2: luminance_cd_m2(interval.half_width.unwrap_or(f64::NAN)),
        truth_cd_m2: luminance_cd_m2(truth.illuminance_lx(inset(class))),
    };
    intervals.iter().enumerate().map(luminance).collect()
}
