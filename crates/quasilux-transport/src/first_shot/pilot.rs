//! When the first shot is worth it: pilot photons of both kinds tell.
//!
//! What counts are photons that leave the first surface. With weights w the variance is that of
//! `N s` equal ones, `s = (sum w)^2 / (N sum w^2)` (Kish 1965, "Survey Sampling", section 11.2), of N
//! photons: w is 0 where the photon was absorbed, lost or in the shadow. So rays / (N s) is the work for
//! one good photon, counted in rays, and the kind with less of it is taken. That leaves out that
//! quasi-random points make more of one kind than of the other.

use super::{FirstShot, LitCells};
use crate::photon::{Flight, Lead, PhotonCounts, PhotonReceiver, Source, trace_photon};
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stage::{Stage, Stream};
use crate::world::Interaction;
use quasilux_sampling::SampleCursor;

/// Pilot photons of each kind.
const PILOTS: u64 = 1 << 12;

/// Weights of photons that leave the first surface.
#[derive(Default)]
struct Weights {
    sum: f64,
    squares: f64,
}

/// The lit cells that photons leave from where that is asked for, or pays; adds what it took.
pub(crate) fn decide<S: Spectrum>(
    stage: &Stage<'_, S>,
    settings: &Settings,
    counts: &mut PhotonCounts,
) -> Option<LitCells> {
    if settings.first_shot == FirstShot::Off {
        return None;
    }
    let cells = LitCells::new(stage)?;
    counts.rays += cells.rays;
    let pays = settings.first_shot == FirstShot::On
        || work(stage, Source::LitCells(&cells), counts) < work(stage, Source::Lights, counts);
    pays.then_some(cells)
}

/// Rays for one good photon; infinite where none leaves a surface.
fn work<S: Spectrum>(stage: &Stage<'_, S>, source: Source<'_>, counts: &mut PhotonCounts) -> f64 {
    let points = stage.points(0, Stream::PlanPhotons);
    let (mut weights, mut of_pilots) = (Weights::default(), PhotonCounts::default());
    for index in 0..PILOTS {
        let cursor = SampleCursor::new(&points, index);
        trace_photon(stage, Lead { source, windows: None }, cursor, &mut weights, &mut of_pilots);
    }
    counts.rays += of_pilots.rays;
    let Weights { sum, squares } = weights;
    if sum > 0.0 { of_pilots.rays as f64 * squares / (sum * sum) } else { f64::INFINITY }
}

impl<S: Spectrum> PhotonReceiver<S> for Weights {
    fn flight(&mut self, _flight: &Flight, weight: S, bounces: u32) {
        if bounces == 1 {
            self.sum += weight.luminance();
            self.squares += weight.luminance() * weight.luminance();
        }
    }

    fn landing(&mut self, _at: &Interaction, _weight: S, _bounces: u32) {}
}
