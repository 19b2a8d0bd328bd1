//! Choice of the photons' source by pilots: lights, or the cells that they light directly.
//!
//! The measure is the work for photons that leave the first surface. With weights w the variance is
//! that of `N s` equal ones, `s = (sum w)^2 / (N sum w^2)` (Kish 1965), of N photons: w is 0 where
//! the photon was absorbed, lost or in the shadow. So rays / (N s) is the work for one good photon,
//! counted in rays, whose number and order say nothing of how evenly photons lie. Those from lit
//! places lie more evenly, and few of their weights are far from the others, next to the lights
//! where it matters to few: see [`EVENNESS`].

use crate::context::{Context, Stream};
use crate::photon::counts::PhotonCounts;
use crate::photon::lit_cells::LitCells;
use crate::photon::receiver::{PhotonReceiver, SeenPhoton};
use crate::photon::trace::{PhotonSetup, Source, trace_photon};
use crate::settings::{Settings, Switch};
use crate::spectrum::Spectrum;
use crate::stats::efficiency::{Performance, WeightSums};
use crate::world::flight::Flight;
use quasilux_sampling::Sampler;

/// Pilot photons of each kind.
const PILOTS: u64 = 1 << 12;
/// Rays that one takes, about.
const RAYS_OF_A_PILOT: u64 = 4;
/// The first shot may take this many times the work that pilots see: in the office of
/// `docs/first-shot.md` they see 1.07 times the work where the squared error is half, on the cube
/// 0.89 times where it is 0.64.
const EVENNESS: f64 = 1.5;

/// Weights of photons that leave the first surface.
#[derive(Default)]
struct FirstWeights(WeightSums);

/// The lit cells that photons leave from where that is asked for, or pays and should not take many
/// more rays than these to find out; adds what it took.
pub(crate) fn decide<S: Spectrum>(
    context: &Context<'_, S>,
    settings: &Settings,
    max_rays: u64,
    counts: &mut PhotonCounts,
) -> Option<LitCells> {
    let is_asked_for = settings.first_shot == Switch::On;
    let max_rays = if is_asked_for { u64::MAX } else { max_rays };
    let of_pilots = 2 * PILOTS * RAYS_OF_A_PILOT;
    if settings.first_shot == Switch::Off || max_rays < of_pilots {
        return None;
    }
    let cells = LitCells::new(context, max_rays - of_pilots)?;
    counts.rays += cells.rays;
    let pays = is_asked_for
        || work(context, Source::LitCells(&cells), counts)
            < EVENNESS * work(context, Source::Lights, counts);
    pays.then_some(cells)
}

/// Rays for one good photon; infinite where none leaves a surface.
fn work<S: Spectrum>(
    context: &Context<'_, S>,
    source: Source<'_>,
    counts: &mut PhotonCounts,
) -> f64 {
    let points = context.points(0, Stream::FirstShotPilots);
    let (mut weights, mut of_pilots) = (FirstWeights::default(), PhotonCounts::default());
    for index in 0..PILOTS {
        let sampler = Sampler::new(&points, index);
        trace_photon(
            context,
            PhotonSetup::by_chance(source, None),
            sampler,
            &mut weights,
            &mut of_pilots,
        );
    }
    counts.rays += of_pilots.rays;
    let variance = weights.0.relative_variance().unwrap_or(f64::INFINITY);
    Performance { rays: of_pilots.rays as f64, variance }.cost_of_error()
}

impl<S: Spectrum> PhotonReceiver<S> for FirstWeights {
    fn flight(&mut self, _flight: &Flight, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, bounces, .. } = photon;
        if bounces == 1 {
            self.0.add(weight.luminance());
        }
    }
}
