//! `quasilux experiment periodicity`: table 2 of Voloboy, Dmitriev and Kopylov (2003), and how
//! close together the members of coherent groups are.
//!
//! The radical inverses of i and i + n b^k differ by less than b^-k (the paper's equation 11), so
//! photons whose indices agree modulo the product of b_j^k_j form a group that starts at the same
//! light in nearly the same direction. The same holds of Sobol' points for cosets of indices.
//! Measured is how wide groups are, beside as many consecutive indices.

mod inverse;
mod picture;
mod report;

use super::claim::{Claim, largest};
use crate::outcome::{Options, Outcome};
use inverse::Inverse;
use quasilux_sampling::{CoherentGroups, PointSet, Randomization, Sequence, stream_key};

/// Photons that are grouped, unless the command line says otherwise.
const PHOTONS: u64 = 1 << 16;
/// Coordinates of the light and of the direction: those that a group shares.
const DIMENSIONS: [u32; 3] = [0, 1, 2];

/// How wide the groups of one size are.
struct Width {
    sequence: &'static str,
    randomization: Randomization,
    groups: u64,
    /// What is promised, for each dimension.
    bounds: Vec<f64>,
    /// Largest minus smallest coordinate, mean over groups and dimensions.
    mean: f64,
    /// The largest part of its bound that a group takes.
    of_bound: f64,
    /// The mean of as many groups of consecutive indices.
    consecutive: f64,
}

/// Groups, and counts.
pub(super) fn run(arguments: &Options) -> Outcome {
    let count = arguments.max_n.unwrap_or(PHOTONS);
    let inverse = Inverse::check(count.min(PHOTONS));
    let widths = widths(count, arguments.seed);
    let claims = claims(&inverse, &widths);
    let tables = report::markdown(&inverse, &widths, count, &claims);
    Outcome::new(report::csv(&widths), tables, picture::svg(&widths), &claims)
}

/// For sizes that are powers of four.
fn widths(count: u64, seed: u64) -> Vec<Width> {
    let key = stream_key(seed, 0, 0);
    let sets = [
        ("halton", Sequence::Halton, Randomization::None),
        ("sobol", Sequence::Sobol, Randomization::None),
        ("sobol", Sequence::Sobol, Randomization::Owen),
    ];
    let mut widths = Vec::new();
    for (name, sequence, randomization) in sets {
        let points = PointSet::new(sequence, randomization, key);
        let sizes = std::iter::successors(Some(count / 4), |size| Some(size / 4));
        for size in sizes.take_while(|size| *size >= 16) {
            let groups = CoherentGroups::with_size(&points, count, &DIMENSIONS, size);
            widths.extend(groups.map(|groups| width(name, &points, &groups, count)));
        }
    }
    widths
}

fn width(sequence: &'static str, points: &PointSet, groups: &CoherentGroups, count: u64) -> Width {
    let bounds = groups.bounds();
    let (mut sum, mut of_bound) = (0.0, 0.0_f64);
    for number in 0..groups.len() {
        for (spread, bound) in groups.spreads(points, number).iter().zip(&bounds) {
            sum += spread;
            of_bound = of_bound.max(spread / bound);
        }
    }
    let size = (count / groups.len()).max(1);
    let spread = |first: u64, dimension: u32| {
        let all = (first..first + size).map(|index| points.coordinate(index, dimension));
        let (low, high) = all.fold((1.0_f64, 0.0_f64), |(low, high), u| (low.min(u), high.max(u)));
        high - low
    };
    let runs = || (0..count / size).flat_map(|run| DIMENSIONS.map(|d| (run * size, d)));
    let consecutive: f64 = runs().map(|(first, dimension)| spread(first, dimension)).sum();
    Width {
        sequence,
        randomization: points.randomization(),
        groups: groups.len(),
        mean: sum / (groups.len() as f64 * bounds.len() as f64),
        bounds,
        of_bound,
        consecutive: consecutive / runs().count() as f64,
    }
}

fn claims(inverse: &Inverse, widths: &[Width]) -> Vec<Claim> {
    let most = largest(widths.iter().map(|width| width.of_bound));
    let finest = widths.iter().max_by_key(|width| width.groups);
    let narrower = widths.iter().all(|width| width.mean < width.consecutive);
    let gain = finest.map_or(f64::NAN, |width| width.consecutive / width.mean);
    let groups = finest.map_or(0, |width| width.groups);
    vec![
        Claim::new(
            format!(
                "The radical inverses of i and i + n b^k differ by less than b^-k: {} pairs of \
                 indices in bases 2, 3, 5, 7, 10 and 11, the largest difference {:.6} b^-k",
                inverse.pairs, inverse.largest
            ),
            [inverse.largest],
            inverse.pairs > 0 && inverse.largest < 1.0,
        ),
        Claim::new(
            format!(
                "No group is wider than the bound that its shared digits promise: the widest takes \
                 {most:.6} of it"
            ),
            [most],
            !widths.is_empty() && most < 1.0,
        ),
        Claim::new(
            format!(
                "Groups are narrower than runs of consecutive indices at every size: {gain:.1} \
                 times with {groups} groups"
            ),
            widths.iter().flat_map(|width| [width.mean, width.consecutive]),
            narrower,
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_claimed_holds() {
        let widths = widths(1 << 12, 0);
        assert!(widths.len() >= 9, "{}", widths.len());
        let inverse = Inverse::check(1 << 10);
        assert!(Claim::all_hold(&claims(&inverse, &widths)));
        let wide = Inverse { pairs: inverse.pairs, largest: 1.5 };
        assert!(!Claim::all_hold(&claims(&wide, &widths)));
    }
}
