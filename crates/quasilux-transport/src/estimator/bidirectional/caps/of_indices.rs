//! What bounds the total that an index adds to a target, for certified intervals
//! ([`crate::stats::certified`]).
//!
//! With W the most that a sample adds, the total of an index is a sum of four parts. Of each, what
//! is still to come is B at most on average, whenever a part of it is known; and the B of their sum
//! is the sum of theirs, whatever they have in common (Hölder's inequality). K is the number of
//! vertices that a walk is expected to have from one of them on, itself counted, F the first ones
//! of an eye path, which all go on ([`FAVOURED`]).
//!
//! | part | B / W |
//! |---|---|
//! | asked for, run into | 2 for each kind of light at each of the F + K vertices and at the start, and on cells 1 for each lamp |
//! | joined to the target | 1 + M K: the vertices of all M light subpaths, and 1 for the systematic sampling of them |
//! | photons | K + 1: flights of one subpath; different ones are independent |
//! | joined between | (L + 3) (1 + (F + K) / 4): at a quarter of the eye vertices, to a light subpath of L vertices |
//!
//! The last part is bounded where its light subpath is no longer than L. Others have at most
//! `W (F + K) s^L (L + 3 + 1 / (1 - s)) / 4` of light, with s the largest chance to go on; L is the
//! least with which this is no more than W over the number of indices. Nothing is known where
//! mirrors or glass let walks go on without a vertex, and where the points of indices are not
//! independent.

use super::super::engine::Engine;
use super::super::plan::{CONNECTED, FAVOURED, SUBPATHS};
use super::super::samples::samples_of_subpaths;
use super::kinds;
use super::surfaces::Surfaces;
use crate::spectrum::Spectrum;
use crate::stats::certified::IndexTotals;
use quasilux_sampling::Sequence;

/// Light vertices that are left over where one of this many is chosen, as far as they count: a
/// connection adds what as many candidates would, times a stride.
const ROUNDED_UP: f64 = 3.0;
/// Longer light subpaths are not reckoned with.
const MAX_VERTICES: u32 = 1 << 16;

/// Numbers of samples, over all targets.
#[derive(Clone, Copy, Debug)]
pub(in crate::estimator::bidirectional) struct SamplesOfIndex {
    /// K.
    vertices: f64,
    /// s.
    goes_on: f64,
    kinds: f64,
    lamps: f64,
}

impl SamplesOfIndex {
    /// `None` where nothing is known.
    pub(in crate::estimator::bidirectional) fn new<S: Spectrum>(
        engine: &Engine<'_, '_, S>,
        sequence: Sequence,
    ) -> Option<Self> {
        let world = &engine.context.world;
        if sequence != Sequence::Independent || world.has_specular_facets() {
            return None;
        }
        let vertices = samples_of_subpaths(world);
        let survives = world.facets.iter().map(|facet| world.most_survives_at(facet));
        let goes_on = survives.fold(0.0, f64::max);
        let kinds = kinds(engine, &Surfaces::new(engine.context), vertices).len() as f64;
        let lamps = engine.context.lights.pointlikes.len() as f64;
        (goes_on < 1.0 && vertices.is_finite()).then_some(Self { vertices, goes_on, kinds, lamps })
    }

    /// The sum of the table, and what it leaves out, after this many indices.
    fn most(&self, is_cell: bool, trials: f64) -> Most {
        let &Self { vertices: k, goes_on, kinds, lamps } = self;
        let eye_vertices = FAVOURED as f64 + k;
        let connected = CONNECTED * eye_vertices;
        let beyond_of = |length: u32| {
            let longer = f64::from(length) + ROUNDED_UP + (1.0 - goes_on).recip();
            connected * libm::pow(goes_on, length.into()) * longer
        };
        let is_enough = |length: &u32| beyond_of(*length) * trials <= 1.0;
        let length = (1..MAX_VERTICES).find(is_enough).unwrap_or(MAX_VERTICES);
        let asked = 2.0 * kinds * (eye_vertices + 1.0) + if is_cell { lamps } else { 0.0 };
        let joined = 1.0 + SUBPATHS as f64 * k;
        let photons = k + 1.0;
        let between = (f64::from(length) + ROUNDED_UP) * (1.0 + connected);
        Most { samples: asked + joined + photons + between, beyond: beyond_of(length) }
    }
}

/// Samples to come on average, and those that are left out; in samples.
struct Most {
    samples: f64,
    beyond: f64,
}

/// Of all targets, whose light without samples is given with the indices of all their replicates.
pub(in crate::estimator::bidirectional) fn index_totals<S: Spectrum>(
    engine: &Engine<'_, '_, S>,
    counts: Option<&SamplesOfIndex>,
    computed_lx: Vec<f64>,
    trials: impl Fn(usize) -> f64,
) -> IndexTotals {
    let of_target = |target: usize| {
        let receiver = &engine.receivers[target];
        let Some(counts) = counts else { return [f64::INFINITY, 0.0] };
        let Most { samples, beyond } = counts.most(receiver.is_cell(), trials(target));
        [samples, beyond].map(|samples| samples * receiver.most_lx)
    };
    let all: Vec<[f64; 2]> = (0..computed_lx.len()).map(of_target).collect();
    IndexTotals {
        computed_lx,
        most_lx: all.iter().map(|[most_lx, _]| *most_lx).collect(),
        beyond_lx: all.iter().map(|[_, beyond_lx]| *beyond_lx).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Matt walls that reflect a half, one kind of lamp, 10^6 indices: `2 (2 + 2 + 1)` asked, `1 +
    /// 64` joined, 3 photons, and between, with `L = 25`, the first with `0.5^L (L + 3 + 2) <=
    /// 10^-6`, `28 (1 + 1)`.
    #[test]
    fn the_table_of_a_grey_room() {
        let counts = SamplesOfIndex { vertices: 2.0, goes_on: 0.5, kinds: 1.0, lamps: 5.0 };
        let Most { samples, beyond } = counts.most(false, 1e6);
        assert!((samples - (10.0 + 65.0 + 3.0 + 56.0)).abs() < 1e-9, "{samples}");
        assert!(beyond <= 1e-6, "{beyond}");
        assert!((counts.most(true, 1e6).samples - samples - 5.0).abs() < 1e-9);
    }
}
