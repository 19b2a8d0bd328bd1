//! `quasilux experiment points`: figures 5 and 6 of Voloboy, Dmitriev and Kopylov (2003), 64
//! pseudo-random and 64 Sobol' points on 8 x 8 cells.
//!
//! Sobol' points put exactly one point into each cell, and into each cell of every other division
//! into 64 rectangles whose sides are powers of two; random points leave a third of the cells
//! empty. The other sequences stand beside them, with their star discrepancies, computed exactly.

mod report;

use super::claim::Claim;
use crate::outcome::{Options, Outcome};
use quasilux_drawing::diagram::{Scatter, scatters};
use quasilux_sampling::quality::{PointsView, cell_counts, star_discrepancy};
use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
use quasilux_transport::interval::t_quantile_for;

/// Points of each set.
const COUNT: u64 = 64;
/// Cells along a side.
const SIDE: usize = 8;
/// log2 of the number of cells.
const LOG_CELLS: u32 = 6;
/// Random sets whose empty cells are counted, unless the command line says otherwise.
const SEEDS: u32 = 1000;

/// A set of points with a name.
struct Set {
    name: &'static str,
    points: Vec<[f64; 2]>,
}

/// What is seen of a set.
struct Seen {
    name: &'static str,
    empty: usize,
    most: u64,
    star_discrepancy: f64,
    /// Divisions of the square into 64 rectangles 2^-a by 2^-(6 - a), and how many of them have
    /// exactly one point in each.
    even_divisions: u32,
}

impl Set {
    fn new(name: &'static str, points: &PointSet) -> Self {
        let point = |index| [0, 1].map(|dimension| points.coordinate(index, dimension));
        Self { name, points: (0..COUNT).map(point).collect() }
    }

    fn random(seed: u64, replicate: u32) -> Self {
        let key = stream_key(seed, replicate, 0);
        Self::new("random", &PointSet::new(Sequence::Independent, Randomization::None, key))
    }

    fn all(seed: u64) -> Vec<Self> {
        let plain = |sequence| PointSet::new(sequence, Randomization::None, 0);
        let owen = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(seed, 0, 0));
        vec![
            Self::random(seed, 0),
            Self::new("sobol", &plain(Sequence::Sobol)),
            Self::new("sobol, owen", &owen),
            Self::new("halton", &plain(Sequence::Halton)),
            Self::new("hammersley", &plain(Sequence::Hammersley { points: COUNT })),
            Self::new("faure4", &plain(Sequence::Faure4)),
        ]
    }

    fn seen(&self) -> Seen {
        let coordinates: Vec<f64> = self.points.iter().flatten().copied().collect();
        let view = PointsView::new(&coordinates, 2).expect("points of the unit square");
        let cells = cell_counts(view, [0, 1], SIDE);
        let is_even = |a: &u32| self.is_even([1 << a, 1 << (LOG_CELLS - a)]);
        Seen {
            name: self.name,
            empty: cells.empty(),
            most: cells.most(),
            star_discrepancy: star_discrepancy(view).unwrap_or(f64::NAN),
            even_divisions: (0..=LOG_CELLS).filter(is_even).count() as u32,
        }
    }

    /// Whether each of this many columns by rows has exactly one point.
    fn is_even(&self, [columns, rows]: [usize; 2]) -> bool {
        let mut is_taken = vec![false; columns * rows];
        self.points.iter().all(|[x, y]| {
            let place = |u: f64, n: usize| (u * n as f64) as usize;
            let cell = place(*y, rows) * columns + place(*x, columns);
            !std::mem::replace(&mut is_taken[cell], true)
        })
    }
}

/// Draws and counts.
pub(super) fn run(arguments: &Options) -> Outcome {
    let sets = Set::all(arguments.seed);
    let seen: Vec<Seen> = sets.iter().map(Set::seen).collect();
    let seeds = arguments.seeds.unwrap_or(SEEDS);
    let empty: Vec<usize> =
        (0..seeds).map(|k| Set::random(arguments.seed, k).seen().empty).collect();
    let claims = claims(&seen, &empty);
    let tables = report::markdown(&seen, &claims);
    Outcome::new(report::csv(&sets, &seen), tables, svg(&sets[..2], &seen), &claims)
}

/// Figures 5 and 6.
fn svg(sets: &[Set], seen: &[Seen]) -> String {
    let subtitles: Vec<String> = seen.iter().map(report::subtitle).collect();
    let scatter = |(set, subtitle)| -> Scatter<'_> {
        let (set, subtitle): (&Set, &String) = (set, subtitle);
        let labels = ["coordinate 0", "coordinate 1"];
        Scatter { title: set.name, subtitle, labels, points: &set.points, cells: SIDE as u32 }
    };
    scatters(&sets.iter().zip(&subtitles).map(scatter).collect::<Vec<_>>()).to_svg()
}

fn claims(seen: &[Seen], empty: &[usize]) -> Vec<Claim> {
    let all_even = |seen: &&Seen| seen.even_divisions == LOG_CELLS + 1;
    let nets = seen.iter().filter(|seen| seen.name.starts_with("sobol"));
    let count = empty.len() as f64;
    let mean = empty.iter().sum::<usize>() as f64 / count;
    let squares = empty.iter().map(|n| (*n as f64 - mean) * (*n as f64 - mean)).sum::<f64>();
    let error = libm::sqrt(squares / ((count - 1.0).max(1.0) * count));
    let allowed = t_quantile_for(empty.len(), 1.0 / 16_000.0).unwrap_or(f64::NAN);
    let cells = COUNT as f64;
    let expected = cells * libm::pow(1.0 - 1.0 / cells, cells);
    vec![
        Claim::new(
            "Sobol' points, scrambled after Owen or not, put one point into each cell of all seven \
             divisions into 64 rectangles of sides 2^-a"
                .to_owned(),
            [],
            nets.clone().count() == 2 && nets.clone().all(|seen| all_even(&seen)),
        ),
        Claim::new(
            format!(
                "Random points leave {mean:.2} of 64 cells empty (mean of {} sets, standard error \
                 {error:.2}), where 64 (1 - 1/64)^64 = {expected:.2} are expected (within \
                 {allowed:.1} standard errors: wrong once in 16 000)",
                empty.len()
            ),
            [mean, error, allowed],
            (mean - expected).abs() <= allowed * error,
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_claimed_holds_and_random_points_are_no_net() {
        let sets = Set::all(0);
        let seen: Vec<Seen> = sets.iter().map(Set::seen).collect();
        let empty: Vec<usize> = (0..200).map(|k| Set::random(0, k).seen().empty).collect();
        assert!(Claim::all_hold(&claims(&seen, &empty)));
        assert!(seen[0].even_divisions == 0 && seen[0].empty > 12);
        let few: Vec<usize> = empty.iter().map(|n| n - 2).collect();
        assert!(!Claim::all_hold(&claims(&seen, &few)), "two cells fewer would be seen");
    }
}
