//! `quasilux experiment intervals`: kinds of confidence intervals against each other, in rooms with
//! jumps and heavy tails.
//!
//! Of each room the totals of 65,536 independent indices are kept, and means of thousands of
//! scrambled nets. Their mean is what intervals are to hold, exactly, whatever number of them is
//! drawn: so thousands of runs of 4096 indices cost one. What the pools themselves have not met is
//! not judged here; `experiment coverage` judges whole runs, in rooms whose light is known.

mod kinds;

mod picture;
mod pool;
mod report;
mod rooms;
mod runs;
mod stopping;

use crate::outcome::{Options, Outcome};
use kinds::Kind;
use pool::Pool;
use stopping::Rule;

/// Intervals of each kind in each room, unless the command line says otherwise.
const RUNS: u32 = 1000;
/// Runs that are looked at again and again, over those that are not.
const LOOKED_AT: u32 = 5;
/// The probability that an interval may miss with.
const MISS: f64 = 0.05;
/// The default keeps its interval if that covers this much in the mean over rooms, the least that
/// `experiment coverage` lets pass, and none that covers as much is as narrow. Rooms are left out
/// where more light than was found may have been met by no sample: there no interval is believed.
const ENOUGH: f64 = 0.935;

/// What a kind of interval did in a room, or a rule that ends runs.
struct Count {
    room: &'static str,
    kind: &'static str,
    moment: &'static str,
    runs: usize,
    covered: usize,
    /// The truth is below the interval.
    too_high: usize,
    /// Median half-width over the truth; `None` where most have no end.
    half_width: Option<f64>,
    /// Median number of indices.
    samples: u64,
    /// Runs that ended by their tolerance.
    stopped: usize,
}

/// Runs all kinds in all rooms.
pub(super) fn run(arguments: &Options) -> Outcome {
    let runs = arguments.seeds.unwrap_or(RUNS);
    let pools: Vec<Pool> = rooms::all().iter().map(|it| Pool::new(it, arguments.seed)).collect();
    let counts = counts(&pools, runs);
    Outcome {
        csv: report::csv(&counts),
        markdown: report::Judged { counts: &counts, pools: &pools }.markdown(runs),
        svg: picture::svg(&counts, &pools),
        pictures: Vec::new(),
        passed: report::Judged { counts: &counts, pools: &pools }.keeps_student(),
    }
}

fn counts(pools: &[Pool], runs: u32) -> Vec<Count> {
    let of_pool = |pool: &Pool| {
        let fixed = Kind::ALL.map(|kind| runs::fixed(pool, kind, runs));
        let looked_at =
            Rule::ALL.map(|rule| runs::looked_at(pool, rule, (runs / LOOKED_AT).max(2)));
        fixed.into_iter().chain(looked_at).collect::<Vec<Count>>()
    };
    pools.iter().flat_map(of_pool).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In the room with a door: 100 runs know a coverage of 95 % to 2.2 % (a standard error).
    /// Student's t covers 88 % at least; intervals that hold for any number of samples cover more,
    /// and are wider.
    #[test]
    fn certain_intervals_cover_more_and_are_wider() {
        let door = rooms::all().swap_remove(1);
        let pool = Pool::small(&door, 5);
        let of = |kind| runs::fixed(&pool, kind, 100);
        let student = of(Kind::StudentT);
        assert!(student.covered >= 88, "{}", student.covered);
        for kind in [Kind::Bernstein, Kind::BettingOnTrials, Kind::Certified] {
            let own = of(kind);
            assert!(own.covered >= 95, "{}: {}", own.kind, own.covered);
            assert!(own.half_width > student.half_width, "{}", own.kind);
        }
    }
}
