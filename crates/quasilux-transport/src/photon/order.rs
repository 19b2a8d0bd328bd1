//! Order of photons: neighbours in their first coordinates are traced together.
//!
//! The first coordinates of a photon choose its light, its place and its direction, so photons
//! whose indices share leading digits of them start at the same light in nearly the same direction
//! (Voloboy, Dmitriev and Kopylov 2003): they meet the same nodes, facets and counters. A range of
//! indices is cut into fields, aligned runs of 2^k indices; in a field groups of neighbours follow
//! each other, near ones after near ones, and a wave takes as many as it holds. Tallies are
//! integers, so the order changes nothing but the time.

use quasilux_sampling::{CoherentGroups, PointSet};
use std::ops::Range;

/// How photons are taken. It changes the time, and nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhotonOrder {
    /// One after the other, by a plain loop: the slow twin.
    OneByOne,
    /// In waves, in the order of their indices.
    Waves,
    /// In waves of photons whose first coordinates are close.
    CoherentWaves,
}

/// Photons of one wave, but for rounding.
const WAVE: u64 = 4096;
/// Most indices of one field: the more, the nearer neighbours are.
const FIELD: u64 = 1 << 18;
/// Most waves of one field.
pub(crate) const WAVES_PER_FIELD: u64 = FIELD / WAVE;
/// Photons of one group: the least that share their digits.
const GROUP: u64 = 64;

/// The waves of a range of indices.
pub(crate) struct Waves {
    runs: Vec<Run>,
    waves: u64,
}

/// Fields of equal size, one after the other.
struct Run {
    first_wave: u64,
    first_index: u64,
    field: u64,
    waves_per_field: u64,
    /// The indices of a field regrouped; `None` leaves them in their order.
    groups: Option<CoherentGroups>,
}

impl Waves {
    /// Cuts a range of indices of these points into waves that are close in the leading
    /// `dimensions`, where the points have digits; with none they keep their order.
    pub(crate) fn new(points: &PointSet, indices: Range<u64>, dimensions: u32) -> Self {
        let dimensions: Vec<u32> = (0..dimensions).collect();
        let (mut runs, mut waves) = (Vec::new(), 0);
        let mut first_index = indices.start;
        while first_index < indices.end {
            let left = indices.end - first_index;
            let field = FIELD.min(lowest_bit(first_index)).min(1 << left.ilog2());
            // All fields of the largest size are one run.
            let fields = if field == FIELD { left / FIELD } else { 1 };
            let groups = (field >= 2 * GROUP && !dimensions.is_empty())
                .then(|| CoherentGroups::with_size(points, field, &dimensions, GROUP))
                .flatten();
            let waves_per_field = field.div_ceil(WAVE);
            runs.push(Run { first_wave: waves, first_index, field, waves_per_field, groups });
            waves += fields * waves_per_field;
            first_index += fields * field;
        }
        Self { runs, waves }
    }

    /// The number of waves.
    pub(crate) fn len(&self) -> u64 {
        self.waves
    }

    /// The last gap between fields at or before the one in front of a wave: the indices before it
    /// cover all directions, whatever their order. A field has at most [`WAVES_PER_FIELD`] waves.
    pub(crate) fn gap_before(&self, wave: u64) -> u64 {
        let run = &self.runs[self.runs.partition_point(|run| run.first_wave <= wave) - 1];
        wave - (wave - run.first_wave) % run.waves_per_field
    }

    /// The indices of one wave.
    pub(crate) fn indices(&self, wave: u64) -> impl Iterator<Item = u64> + '_ {
        let run = &self.runs[self.runs.partition_point(|run| run.first_wave <= wave) - 1];
        let wave = wave - run.first_wave;
        let first = run.first_index + wave / run.waves_per_field * run.field;
        let part = move |of: u64| {
            let wave = wave % run.waves_per_field;
            of * wave / run.waves_per_field..of * (wave + 1) / run.waves_per_field
        };
        let grouped = run
            .groups
            .iter()
            .flat_map(move |groups| part(groups.len()).flat_map(|number| groups.group(number)));
        let plain = part(if run.groups.is_none() { run.field } else { 0 });
        // A field begins at a multiple of its size: its indices are sums without carries.
        grouped.chain(plain).map(move |offset| first | offset)
    }
}

/// The largest power of two that divides a number; of 0 the largest there is.
fn lowest_bit(number: u64) -> u64 {
    1_u64.checked_shl(number.trailing_zeros()).unwrap_or(1 << 63)
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::{Randomization, Sequence};

    fn points(sequence: Sequence) -> PointSet {
        PointSet::new(sequence, Randomization::Owen, 1)
    }

    #[test]
    fn each_index_is_in_one_wave() {
        let hammersley = Sequence::Hammersley { points: 1 << 20 };
        for sequence in [Sequence::Sobol, Sequence::Halton, Sequence::Independent, hammersley] {
            for (range, dimensions) in
                [(0..1, 2), (0..5000, 2), (5..150_000, 4), (131_072..262_144, 2), (7..4000, 0)]
            {
                let waves = Waves::new(&points(sequence), range.clone(), dimensions);
                let mut indices = Vec::new();
                for wave in 0..waves.len() {
                    let of_wave = waves.indices(wave).count() as u64;
                    assert!((1..=2 * WAVE).contains(&of_wave), "{sequence:?}: {of_wave}");
                    indices.extend(waves.indices(wave));
                }
                indices.sort_unstable();
                assert!(indices.into_iter().eq(range.clone()), "{sequence:?}, {range:?}");
                for wave in 0..waves.len() {
                    let gap = waves.gap_before(wave);
                    assert!(gap <= wave && wave - gap < WAVES_PER_FIELD);
                    let mut before: Vec<u64> = (0..gap).flat_map(|w| waves.indices(w)).collect();
                    before.sort_unstable();
                    let whole = range.start..range.start + before.len() as u64;
                    assert!(before.into_iter().eq(whole), "{sequence:?}, {range:?}: {gap}");
                }
            }
        }
    }

    /// From photon to photon it is more than 0.3 of the way across in the order of the indices; in
    /// groups of 64 of 2^18 some 1/64, and little more from group to group.
    #[test]
    fn neighbours_are_close_together() {
        for sequence in [Sequence::Sobol, Sequence::Halton] {
            let points = points(sequence);
            let mean_step = |dimensions| {
                let waves = Waves::new(&points, 0..FIELD, dimensions);
                let order: Vec<u64> =
                    (0..waves.len()).flat_map(|wave| waves.indices(wave)).collect();
                let u = |index| [0, 1].map(|dimension| points.coordinate(index, dimension));
                let steps = order.windows(2).map(|pair| (u(pair[0]), u(pair[1])));
                let length =
                    |(a, b): ([f64; 2], [f64; 2])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
                steps.map(length).sum::<f64>() / FIELD as f64
            };
            let (plain, grouped) = (mean_step(0), mean_step(2));
            assert!(plain > 0.3 && grouped < 0.03, "{sequence:?}: {plain}, {grouped}");
        }
    }
}
