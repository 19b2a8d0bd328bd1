//! One path, from a sensor point toward the lights.
//!
//! The illuminance at x is `E(x) = integral of L(x, w) cos dw`. A cosine-distributed direction has
//! density cos / pi, so the light that arrives along it counts pi-fold. At each diffuse surface the
//! light that comes there straight from the lights is estimated on the spot (next-event
//! estimation), and the path goes on for the rest. A path may end on an illumination map instead:
//! the map's value stands for the rest. In a few paths, chosen by chance, the rest is also
//! estimated by going on, and the difference to the map, weighted by how few they are, takes the
//! map's error out again: the map is a control variate, and its elements cause no bias.

use crate::map::{IlluminationMap, MapLayout};
use crate::photon::MOST_EVENTS;
use crate::spectrum::Spectrum;
use crate::stage::Stage;
use crate::world::{Interaction, Scattering, Vantage, mirrored, to_world};
use glam::DVec3;
use quasilux_sampling::SampleCursor;
use quasilux_sampling::warp::sample_cosine_hemisphere;
use std::f64::consts::{FRAC_1_PI, PI};

/// Bounces after which a path goes on for certain; after later ones by chance.
const CERTAIN_BOUNCES: u32 = 2;

/// Where the light at the first diffuse surface comes from, but for the direct light.
pub(crate) enum Rest<'m, S> {
    /// From the path itself.
    Path,
    /// From the map.
    Map(MapEnd<'m, S>),
}

/// How paths end on a map.
pub(crate) struct MapEnd<'m, S> {
    pub(crate) layout: &'m MapLayout,
    pub(crate) map: &'m IlluminationMap<S>,
    /// Share of the paths that go on to correct the map; `None` leaves its bias.
    pub(crate) corrected_share: Option<f64>,
}

/// What one path found, in lx.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Gathered {
    /// Straight from area lights and luminaires with an area.
    pub(crate) direct_lx: f64,
    /// After at least one bounce; may be negative where a map is corrected.
    pub(crate) indirect_lx: f64,
    /// Whether the path came to a surface that reflects, so that there may be indirect light.
    pub(crate) reflected: bool,
    /// Whether it was cut after [`MOST_EVENTS`].
    pub(crate) endless: bool,
}

/// Working space and counters of a series of paths.
#[derive(Default)]
pub(crate) struct PathWork {
    pub(crate) rays: u64,
    seen: Vec<f64>,
}

/// How a path goes on from a diffuse surface: factors on what the next surface sends.
struct Onward {
    /// On the light that the next surface emits itself.
    emitted: f64,
    /// On everything else; 0 ends the path there.
    everything: f64,
}

/// Estimates the illuminance on the side `n` of a sensor point by one path, the direct light of
/// point-like lights left out.
pub(crate) fn trace_path<S: Spectrum>(
    stage: &Stage<'_, S>,
    mut from: Vantage,
    n: DVec3,
    rest: &Rest<'_, S>,
    cursor: &mut SampleCursor<'_>,
    work: &mut PathWork,
) -> Gathered {
    let Stage { world, lights, .. } = stage;
    let mut gathered = Gathered::default();
    let first = sample_cosine_hemisphere(cursor.next_2d());
    let mut direction = to_world(n, first);
    // The cosine that the direction was sampled with, for the density; `None` after a mirror.
    let mut cos = Some(first[2]);
    if let Some(emitters) = &lights.emitters {
        gathered.direct_lx += emitters.one(world, from, n, cursor.next_2d(), &mut work.rays);
    }
    gathered.direct_lx += from_area_luminaires(stage, from, n, cursor, work);
    // Factors from radiance along the path to illuminance at its start.
    let mut beta = S::white() * PI;
    let mut beta_emitted = beta;
    let mut is_first_diffuse = true;
    for bounces in 0..MOST_EVENTS {
        work.rays += 1;
        let Some(at) = world.trace(from, direction) else { return gathered };
        let emitted_cd_m2 = world.emitted_cd_m2(&at);
        if let (true, Some(emitters)) = (emitted_cd_m2 > 0.0, &lights.emitters) {
            let shared = |cos| emitters.weight_of_direction(world, &at, direction, cos);
            let found = beta_emitted.luminance() * emitted_cd_m2 * cos.map_or(1.0, shared);
            if bounces == 0 {
                gathered.direct_lx += found;
            } else {
                gathered.indirect_lx += found;
            }
        }
        let reflected = beta * world.facet(&at).scattering.reflectance();
        let reflectance = reflected.max_channel() / beta.max_channel();
        let is_last = stage.max_bounces.is_some_and(|most| bounces >= most);
        if is_last || reflected.max_channel() == 0.0 {
            return gathered;
        }
        gathered.reflected = true;
        from = world.vantage(&at);
        match world.facet(&at).scattering {
            Scattering::Mirror(_) => {
                let factor = survive(cursor, bounces, reflectance).everything;
                if factor == 0.0 {
                    return gathered;
                }
                direction = mirrored(direction, at.n);
                cos = None;
                beta = reflected * factor;
                beta_emitted = beta;
            }
            Scattering::Diffuse(_) => {
                // From illuminance here to illuminance at the start.
                let to_start = reflected * FRAC_1_PI;
                let direct_lx = direct_here(stage, from, at.n, cursor, work);
                gathered.indirect_lx += to_start.luminance() * direct_lx;
                let map_stands = is_first_diffuse && (bounces == 0 || stage.max_bounces.is_none());
                let onward = match rest {
                    Rest::Map(end) if map_stands => {
                        let from_map = (to_start * end.illuminance_lx(&at)).luminance();
                        let onward = end.correct(cursor);
                        gathered.indirect_lx += from_map * (1.0 - onward.everything);
                        onward
                    }
                    _ => survive(cursor, bounces, reflectance),
                };
                let seeks_emitters = onward.emitted != 0.0 && lights.emitters.is_some();
                if onward.everything == 0.0 && !seeks_emitters {
                    return gathered;
                }
                is_first_diffuse = false;
                let local = sample_cosine_hemisphere([cursor.rest_1d(), cursor.next_1d()]);
                direction = to_world(at.n, local);
                cos = Some(local[2]);
                beta = to_start * (PI * onward.everything);
                beta_emitted = to_start * (PI * onward.emitted);
            }
        }
    }
    gathered.endless = true;
    gathered
}

/// Light that comes straight from the lights to a surface on the way, in lx: one place on the
/// luminaires with an area, one point-like light, one point on the area lights.
fn direct_here<S: Spectrum>(
    stage: &Stage<'_, S>,
    from: Vantage,
    n: DVec3,
    cursor: &mut SampleCursor<'_>,
    work: &mut PathWork,
) -> f64 {
    let Stage { world, lights, .. } = stage;
    let mut direct_lx = from_area_luminaires(stage, from, n, cursor, work);
    let PathWork { rays, seen } = work;
    if !lights.pointlikes.is_empty() {
        direct_lx += lights.pointlikes.one(world, from, n, cursor.next_1d(), seen, rays);
    }
    if let Some(emitters) = &lights.emitters {
        direct_lx += emitters.one(world, from, n, cursor.next_2d(), rays);
    }
    direct_lx
}

/// Light that comes straight from the luminaires with an area, in lx: one place on one of them.
fn from_area_luminaires<S: Spectrum>(
    stage: &Stage<'_, S>,
    from: Vantage,
    n: DVec3,
    cursor: &mut SampleCursor<'_>,
    work: &mut PathWork,
) -> f64 {
    let Stage { world, lights, .. } = stage;
    let PathWork { rays, seen } = work;
    if lights.area_luminaires.is_empty() {
        return 0.0;
    }
    lights.area_luminaires.one(world, from, n, cursor.next_2d(), seen, rays)
}

/// Russian roulette after the first bounces. `reflectance` is that of the channel that is left
/// strongest, so that the weight of a survivor never grows in it and stays bounded in all.
fn survive(cursor: &mut SampleCursor<'_>, bounces: u32, reflectance: f64) -> Onward {
    if bounces < CERTAIN_BOUNCES {
        return Onward { emitted: 1.0, everything: 1.0 };
    }
    let survives = cursor.choose_bool(reflectance);
    let factor = if survives { 1.0 / reflectance } else { 0.0 };
    Onward { emitted: factor, everything: factor }
}

impl<S: Spectrum> MapEnd<'_, S> {
    fn illuminance_lx(&self, at: &Interaction) -> S {
        self.map.illuminance_lx(self.layout.element(at))
    }

    /// Whether this path corrects the map. The direction to a light that the next surface emits is
    /// part of the direct light here, so it counts in every path.
    fn correct(&self, cursor: &mut SampleCursor<'_>) -> Onward {
        let Some(share) = self.corrected_share else {
            return Onward { emitted: 1.0, everything: 0.0 };
        };
        let corrects = cursor.choose_bool(share);
        Onward { emitted: 1.0, everything: if corrects { 1.0 / share } else { 0.0 } }
    }
}
