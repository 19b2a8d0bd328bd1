//! What a ray takes in several kinds of runs, each timed by short runs in turn: what else the
//! machine does hits all of them alike.

/// Rounds, each with one run of each kind.
const ROUNDS: usize = 15;

/// Rays of a short run, all replicates together.
pub(super) const SHORT_RAYS: f64 = 1e6;

/// Seconds that a ray of each kind takes. `short_run` makes a run of a kind, by its number, and
/// says what a ray took in it.
///
/// The share of each kind in the mean of a round and these means are medians over the rounds.
pub(super) fn seconds_of_a_ray(kinds: usize, short_run: impl Fn(usize) -> f64) -> Vec<f64> {
    let round = |_| (0..kinds).map(&short_run).collect();
    let rounds: Vec<Vec<f64>> = (0..ROUNDS).map(round).collect();
    let mean = |round: &Vec<f64>| round.iter().sum::<f64>() / round.len() as f64;
    let usual = median(rounds.iter().map(mean).collect());
    let of_kind = |kind: usize| {
        usual * median(rounds.iter().map(|round| round[kind] / mean(round)).collect())
    };
    (0..kinds).map(of_kind).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values[values.len() / 2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// A machine that is three times as slow in every fourth round, and once in the middle of one.
    #[test]
    fn a_busy_machine_changes_no_ratio() {
        let runs = Cell::new(0);
        let seconds = seconds_of_a_ray(2, |kind| {
            let run = runs.replace(runs.get() + 1);
            let is_busy = run / 2 % 4 == 3 || run == 17;
            [1.0, 1.5][kind] * if is_busy { 3.0 } else { 1.0 }
        });
        assert!(
            (seconds[0] - 1.0).abs() < 1e-12 && (seconds[1] - 1.5).abs() < 1e-12,
            "{seconds:?}"
        );
    }
}
