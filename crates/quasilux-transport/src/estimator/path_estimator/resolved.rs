//! Whether a target's replicates can tell its error: paths that met no light, or too little of it,
//! cannot.

use super::PathEstimator;
use crate::context::Context;
use crate::lights::Asking;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::stats::interval::Interval;
use crate::stats::point_status::Evidence;
use crate::stats::schedule::MIN_SAMPLES;

impl<S: Spectrum> PathEstimator<'_, S> {
    /// Whether the paths of each target found light where they came to surfaces that reflect, and
    /// missed none that is rare and bright.
    pub(super) fn evidence(&self, replicate_lx: &[Vec<f64>]) -> Vec<Evidence> {
        let of_target = |target: usize| {
            let values = replicate_lx.iter().map(|row| row[target]);
            if self.hides_a_tail(target, values) {
                Evidence::RareLight
            } else if self.found_light(target) {
                Evidence::Sound
            } else {
                Evidence::Dark
            }
        };
        (0..self.targets.len()).map(of_target).collect()
    }

    /// Whether few paths make the spread of a target's replicates, where half-widths count.
    fn hides_a_tail(
        &self,
        target: usize,
        values: impl ExactSizeIterator<Item = f64> + Clone,
    ) -> bool {
        let standard_error_lx = Interval::of_mean(values, Some(1.0)).half_width;
        let standard_error = standard_error_lx.unwrap_or_default() / self.quantum.reference();
        let scores = self.scores.get(target);
        self.progress.samples_of(target) >= MIN_SAMPLES
            && scores.is_some_and(|it| it.hide_their_tail(self.paths_of(target), standard_error))
    }

    fn found_light(&self, target: usize) -> bool {
        let replicates = self.replicates as usize;
        let own = &self.sums[target * replicates..(target + 1) * replicates];
        let found_direct = own.iter().any(|sums| !sums.direct.is_zero());
        let found_indirect = own.iter().any(|sums| !sums.indirect.is_zero());
        let reflected = own.iter().any(|sums| sums.reflected > 0);
        (found_indirect || !reflected)
            && (found_direct || found_indirect || !self.samples_direct[target])
    }
}

/// Whether light whose direct part is sampled may come straight to a target: not to one with all
/// such luminaires and openings behind it. Of the sky that walls hide behind openings, nothing
/// comes straight, but where walls may be bright themselves, more has to be seen than none of it.
pub(super) fn samples_direct<S: Spectrum>(context: &Context<'_, S>, target: &Target) -> bool {
    let Context { lights, world, max_bounces, .. } = context;
    let may_be_bright = world.keeps_light() && *max_bounces != Some(0);
    let outside = lights.outside.as_ref().filter(|_| may_be_bright);
    match *target {
        _ if lights.emitters.is_some() => true,
        Target::Point { position, normal } => {
            let place = Asking { position, side: Some(normal), own: None };
            lights.area_luminaires.may_light(position, normal)
                || outside.is_some_and(|outside| outside.may_light(place))
        }
        Target::Cell { .. } => !lights.area_luminaires.is_empty() || outside.is_some(),
    }
}
