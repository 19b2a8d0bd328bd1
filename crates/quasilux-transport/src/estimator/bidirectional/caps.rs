//! The most that one sample can add, by class of paths, and the light that no sample met.
//!
//! For each technique i with `n_i` samples an index there is a cap on `f / p_i` over all paths of a
//! class, and a number `K_i` of samples that a subpath may have; what follows for light that no
//! sample met goes with `K W`, 1 over the sum of `n_i / (K_i cap_i)` over the techniques that can
//! make all of the class (`docs/unseen.md`).

mod of_indices;
mod of_pixels;
#[cfg(test)]
mod search;
mod surfaces;

use super::asked_luminaires::AskedLuminaires;
use super::engine::Engine;
use super::leading::led_at_target;
use super::plan::{FoundBy, Receiver, SUBPATHS};
use super::samples::{crossings_of_discs, samples_at_emitters, samples_of_subpaths};
use super::sources::PhotonFluxes;
use crate::bsdf::Bsdf;
use crate::control::watch::{POINTS_AT_ONCE, Watch};
use crate::lights::SKY_MARGIN;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::stats::unseen::unseen_lx;
use crate::world::{Facet, World};
pub(super) use of_indices::{SamplesOfIndex, index_totals};
pub(super) use of_pixels::PixelCaps;
use std::f64::consts::PI;
use surfaces::Surfaces;

/// By what factor copies make K of light subpaths larger (`samples`).
const RISES: f64 = 2.0;

/// Bounds of all targets.
pub(super) struct Caps {
    of_targets: Vec<Cap>,
    /// Bound `K W` of eye paths alone, the largest of all targets; infinite where they cannot make
    /// all paths.
    of_eye_lx: f64,
}

/// Of a target, in lx for one index.
#[derive(Clone, Copy)]
struct Cap {
    /// `K W`.
    unseen_lx: f64,
    /// W: the most that a sample of a technique that is used wherever it can be adds.
    sample_lx: f64,
    /// The most that a light without extent gives straight to a cell; 0 of points.
    on_cell_lx: f64,
}

/// The most that a sample of what comes straight to a target gives.
#[derive(Clone, Copy, PartialEq)]
enum Straight {
    /// It is computed at points, and asked of all lights on cells.
    Computed,
    /// In lx.
    AtMost(f64),
    /// Depends on the place of a point; of cells nothing is known.
    OfLuminaires,
}

/// The light of one kind of lights.
#[derive(Clone, Copy)]
struct Kind {
    /// The most that a photon stands for, in lm.
    flux_lm: f64,
    /// Cap of eye paths that ask at a surface, or run into the light, in lx.
    eye_lx: f64,
    /// Of those that run into it also past mirrors and glass.
    met_lx: f64,
    /// K of both.
    eye_samples: f64,
    straight: Straight,
    /// Whether nothing but photons finds what comes over specular surfaces alone.
    is_hidden_by_mirrors: bool,
    is_of_area: bool,
    /// Who finds it past narrow surfaces.
    found_by: FoundBy,
}

impl Caps {
    /// `None` when the observer stopped it.
    pub(super) fn new<S: Spectrum>(
        engine: &Engine<'_, '_, S>,
        watch: &mut Watch<'_>,
    ) -> Option<Self> {
        let context = engine.context;
        let world = &context.world;
        let surfaces = Surfaces::new(context);
        let no_bounce = context.max_bounces == Some(0);
        let samples = samples_of_subpaths(world);
        let of_copies = if engine.copies.are_several() { RISES } else { 1.0 };
        let crossings = crossings_of_discs(world);
        let kinds = kinds(engine, &surfaces, samples);
        let has_specular = world.has_specular_facets();
        let luminaires = AskedLuminaires::new(&context.lights.area_luminaires);
        let of_target = |receiver: &Receiver| {
            let joined_sr_m2 = if no_bounce { 0.0 } else { surfaces.joined(receiver) };
            let on_cell_lx = if receiver.is_cell() { surfaces.on_cell(receiver) } else { 0.0 };
            let of_luminaires_lx =
                luminaires.most_lx(receiver.position, receiver.n, receiver.straight_radius_m());
            let largest = |kind: &Kind, samples: f64, crossings: f64| {
                let class = Class {
                    receiver,
                    kind,
                    joined_sr_m2,
                    on_cell_lx,
                    of_luminaires_lx,
                    samples,
                    crossings,
                };
                class.largest(&surfaces, has_specular, no_bounce)
            };
            let none = Cap { unseen_lx: 0.0, sample_lx: 0.0, on_cell_lx };
            kinds.iter().fold(none, |cap, kind| Cap {
                unseen_lx: cap.unseen_lx.max(largest(kind, samples * of_copies, crossings)),
                sample_lx: cap.sample_lx.max(largest(
                    &Kind { eye_samples: 1.0, ..*kind },
                    1.0,
                    1.0,
                )),
                ..cap
            })
        };
        let of_targets = watch.map_in_parts(&engine.receivers, POINTS_AT_ONCE, of_target)?;
        let of_eye_lx = if has_specular {
            f64::INFINITY
        } else {
            of_eye_paths_lx(&kinds, &of_targets, &engine.receivers)
        };
        Some(Self { of_targets, of_eye_lx })
    }

    /// Of each target, the most in lx that a sample adds to one index. Nothing is known of samples
    /// where weights take other densities than those of what is sampled
    /// ([`Bsdf::survival_pdf_sr`]), and where coated surfaces keep all light: of some of their
    /// directions more goes on than came.
    pub(super) fn of_samples_lx<S: Spectrum>(&self, world: &World<S>) -> impl Iterator<Item = f64> {
        let is_unknown = |facet: &Facet| match world.bsdf_of(facet) {
            Bsdf::Measured(_) => true,
            Bsdf::Conductor(_) | Bsdf::Plastic(_) => world.most_survives_at(facet) >= 1.0,
            _ => false,
        };
        let is_unknown = world.facets.iter().any(is_unknown);
        let most_lx = move |cap: &Cap| if is_unknown { f64::INFINITY } else { cap.sample_lx };
        self.of_targets.iter().map(most_lx)
    }

    /// Light in lx at each target by ways on which no sample lay, at most; `trials` are the indices
    /// of each, of all replicates.
    pub(super) fn unseen_lx(&self, trials: impl Fn(usize) -> f64) -> Vec<f64> {
        let of_target = |(target, cap): (usize, &Cap)| unseen_lx(cap.unseen_lx, trials(target));
        self.of_targets.iter().enumerate().map(of_target).collect()
    }

    /// Light in lx of the average over targets by ways on which no sample lay, at most, where each
    /// has this many trials at least: an eye path of one of m targets adds an m-th.
    pub(super) fn unseen_of_average_lx(&self, point_lx: &[f64], least_trials: f64) -> f64 {
        let m = point_lx.len().max(1) as f64;
        let mean = point_lx.iter().sum::<f64>() / m;
        mean.min(unseen_lx(self.of_eye_lx, m * least_trials))
    }
}

/// Bound `K W` of eye paths alone in lx, the largest of all targets, where they can make all paths.
fn of_eye_paths_lx(kinds: &[Kind], of_targets: &[Cap], receivers: &[Receiver]) -> f64 {
    let straight = |kind: &Kind| match kind.straight {
        Straight::Computed => 0.0,
        Straight::AtMost(lx) => lx,
        Straight::OfLuminaires => f64::INFINITY,
    };
    let of_kind = |kind: &Kind| straight(kind).max(kind.eye_samples * kind.eye_lx);
    let on_cells = of_targets.iter().map(|cap| cap.on_cell_lx).fold(0.0, f64::max);
    let most_more = receivers.iter().map(more_of_others).fold(1.0, f64::max);
    most_more * kinds.iter().map(of_kind).fold(on_cells, f64::max)
}

/// How much more than if none were led eye paths of a target carry that are not.
fn more_of_others(receiver: &Receiver) -> f64 {
    (1.0 - led_at_target(receiver.view)).recip()
}

/// Paths of one kind of light to one target.
struct Class<'c> {
    receiver: &'c Receiver,
    kind: &'c Kind,
    /// The most that a lumen at a light vertex gives where it is joined, over the chance of that,
    /// in sr^-1 m^-2.
    joined_sr_m2: f64,
    on_cell_lx: f64,
    /// The most that a place on a luminaire with an area gives straight to a point.
    of_luminaires_lx: f64,
    /// K of what has a sample at each vertex.
    samples: f64,
    /// K of photons on the disc between two surfaces that scatter.
    crossings: f64,
}

impl Class<'_> {
    /// K W over all classes.
    fn largest<S: Spectrum>(
        &self,
        surfaces: &Surfaces<'_, S>,
        has_specular: bool,
        no_bounce: bool,
    ) -> f64 {
        let &Self { receiver, kind, samples, crossings, .. } = self;
        // Numbers of samples over K and their caps; light that comes straight is met once.
        let straight_disc = receiver.straight_m2(kind.is_of_area) / kind.flux_lm;
        let disc = receiver.area_m2 / kind.flux_lm / (samples * crossings);
        let all_photons = receiver.photons(true, kind.found_by) / kind.flux_lm / crossings;
        let joined = SUBPATHS as f64 / (kind.flux_lm * self.joined_sr_m2 * samples);
        let scale = receiver.radiance_scale * more_of_others(receiver);
        let [eye, met] =
            [kind.eye_lx, kind.met_lx].map(|lx| (lx * scale * kind.eye_samples).recip());
        let mut largest = 0.0_f64;
        let mut class = |counts: f64| {
            largest = largest.max(if counts > 0.0 { counts.recip() } else { f64::INFINITY });
        };
        let straight_lx = match (kind.straight, receiver.target) {
            (Straight::Computed, Target::Point { .. }) => None,
            (Straight::Computed, Target::Cell { .. }) => Some(self.on_cell_lx),
            (Straight::AtMost(lx), _) => Some(lx),
            (Straight::OfLuminaires, Target::Point { .. }) => Some(self.of_luminaires_lx),
            (Straight::OfLuminaires, Target::Cell { .. }) => Some(f64::INFINITY),
        };
        if let Some(straight_lx) = straight_lx {
            class((straight_lx * scale).recip() + straight_disc);
        }
        if no_bounce {
            return largest;
        }
        if !surfaces.facets.is_empty() {
            class(eye + joined + disc);
        }
        if has_specular {
            if !surfaces.facets.is_empty() {
                // Specular last, first, and both.
                class(eye + all_photons / samples);
                class(met + joined + disc);
                class(met + all_photons / samples);
            }
            if kind.is_hidden_by_mirrors || receiver.is_cell() {
                class(met + all_photons);
            }
        }
        largest
    }
}

/// All kinds of lights that shine.
fn kinds<S: Spectrum>(
    engine: &Engine<'_, '_, S>,
    surfaces: &Surfaces<'_, S>,
    samples: f64,
) -> Vec<Kind> {
    let context = engine.context;
    let lights = &context.lights;
    let PhotonFluxes { pointlikes_lm, luminaires_lm, emitters_lm, sky_lm, sun_lm } = engine.fluxes;
    let largest_lx = lights.emitters.as_ref().map_or(0.0, |emitters| emitters.largest_lx());
    let outside = lights.outside.as_ref();
    let sky_lx = outside.map_or(0.0, |outside| PI * SKY_MARGIN * outside.brightest_cd_m2());
    let sun_lx = outside.map_or(0.0, |outside| outside.sun_brightness()[1]);
    let never = f64::INFINITY;
    let images_hide = !context.caustic_ways.is_empty();
    let lamps = Kind {
        flux_lm: pointlikes_lm,
        eye_lx: surfaces.lit_by_pointlikes(engine),
        met_lx: never,
        eye_samples: samples,
        straight: Straight::Computed,
        is_hidden_by_mirrors: images_hide,
        is_of_area: false,
        found_by: FoundBy::Photons,
    };
    let hidden = Kind { is_hidden_by_mirrors: true, ..lamps };
    let straight = Straight::OfLuminaires;
    let luminaires =
        Kind { flux_lm: luminaires_lm, eye_lx: never, straight, is_of_area: true, ..hidden };
    let emitters = Kind {
        flux_lm: emitters_lm,
        eye_lx: largest_lx,
        met_lx: largest_lx,
        // Those that run into it bound what they find.
        eye_samples: samples_at_emitters(&context.world, samples),
        straight: Straight::AtMost(largest_lx),
        is_of_area: true,
        found_by: engine.emitters_found_by,
        ..hidden
    };
    let sky = Kind {
        flux_lm: sky_lm,
        eye_lx: sky_lx,
        met_lx: sky_lx,
        // Whoever meets the sky is gone.
        eye_samples: 1.0,
        straight: Straight::AtMost(sky_lx),
        found_by: engine.sky_found_by,
        ..hidden
    };
    let scattered_lx = outside.map_or(0.0, |outside| surfaces.lit_by_sun(outside));
    let straight = Straight::AtMost(sun_lx);
    let sun = Kind { flux_lm: sun_lm, eye_lx: scattered_lx, straight, ..hidden };
    let all = [lamps, luminaires, emitters, sky, sun];
    all.into_iter().filter(|kind| kind.flux_lm > 0.0).collect()
}
