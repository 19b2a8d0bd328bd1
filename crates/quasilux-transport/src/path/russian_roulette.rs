//! Russian roulette of paths and light subpaths: who goes on, and what the survivors count.

use quasilux_sampling::Sampler;

/// Bounces after which they go on for certain; after later ones by survival.
pub(crate) const CERTAIN_BOUNCES: u32 = 2;

/// The factor on the weight, 0 or the reciprocal of the survival probability.
pub(crate) fn russian_roulette_factor(survival: f64, sampler: &mut Sampler<'_>) -> f64 {
    if sampler.choose_bool(survival) { 1.0 / survival.min(1.0) } else { 0.0 }
}
