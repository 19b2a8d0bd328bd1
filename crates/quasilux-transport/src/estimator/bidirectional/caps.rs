//! The most that one sample can add, by class of paths, and the light that no sample met.
//!
//! For each technique i with `n_i` samples an index there is a cap on `f / p_i` over all paths of a
//! class, and a number `K_i` of samples that a subpath may have; what follows for light that no
//! sample met goes with `K W`, 1 over the sum of `n_i / (K_i cap_i)` over the techniques that can
//! make all of the class (`docs/unseen.md`).

use super::boxes::BoxTree;
use super::engine::Engine;
use super::intensities::IntensityBound;
use super::peaks::Peak;
use super::plan::{FoundBy, Receiver};
use super::samples::{samples_at_emitters, samples_of_subpaths};
use super::sources::{PhotonFluxes, SKY_MARGIN};
use super::supremum::{Bounded, SeenPart, supremum, supremum_over};
use crate::bsdf::Bsdf;
use crate::spectrum::Spectrum;
use crate::stats::targets::Target;
use crate::stats::unseen::UNSEEN_CONFIDENCE;
use crate::world::World;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_1_PI, PI};

/// A choice among lights in proportion to what they give takes one with no less than this part of
/// its share ([`crate::lights::PointLikes::choose`]).
const CHOICE: f64 = 0.9;

/// Bounds of all targets.
pub(super) struct Caps {
    of_targets: Vec<Cap>,
    /// The same of eye paths alone, the same for all targets; infinite where they cannot make all
    /// paths.
    of_eye_lx: f64,
}

/// Of a target, in lx for one index.
#[derive(Clone, Copy)]
struct Cap {
    /// `K W`.
    unseen_lx: f64,
    /// W: the most that a sample of a technique that is used wherever it can be adds.
    sample_lx: f64,
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
    /// Of what comes straight to a target, where that is sampled.
    straight_lx: Option<f64>,
    /// Whether nothing but photons finds what comes over specular surfaces alone.
    is_hidden_by_mirrors: bool,
    is_of_emitters: bool,
    /// Who finds it past narrow surfaces.
    found_by: FoundBy,
}

impl Caps {
    pub(super) fn new<S: Spectrum>(engine: &Engine<'_, '_, S>) -> Self {
        let context = engine.context;
        let world = &context.world;
        let corners = |number: usize| {
            let [a, b, c] = world.facets[number].corners();
            [a.min(b).min(c), a.max(b).max(c)]
        };
        let peaks = Peaks::new(world);
        let scatters =
            (0..world.facets.len()).filter(|it| peaks.at_facet(world, *it as u32).value_sr > 0.0);
        let facets: Vec<usize> = scatters.collect();
        let boxes: Vec<[DVec3; 2]> = facets.iter().map(|it| corners(*it)).collect();
        let lights = &context.lights.pointlikes;
        let pointlikes =
            (0..lights.len()).filter_map(|it| IntensityBound::new(lights.get(it)?)).collect();
        let surfaces = Surfaces { world, peaks, tree: BoxTree::new(&boxes), facets, pointlikes };
        let no_bounce = context.max_bounces == Some(0);
        let samples = samples_of_subpaths(world);
        let kinds = kinds(engine, &surfaces, samples);
        let has_specular = world.has_specular_facets();
        let of_target = |receiver: &Receiver| {
            let joined_sr_m2 = if no_bounce { 0.0 } else { surfaces.joined(receiver) };
            let largest = |kind: &Kind, samples: f64| {
                let class = Class { engine, receiver, kind, joined_sr_m2, samples };
                class.largest(&surfaces, has_specular, no_bounce)
            };
            let none = Cap { unseen_lx: 0.0, sample_lx: 0.0 };
            kinds.iter().fold(none, |cap, kind| Cap {
                unseen_lx: cap.unseen_lx.max(largest(kind, samples)),
                sample_lx: cap.sample_lx.max(largest(&Kind { eye_samples: 1.0, ..*kind }, 1.0)),
            })
        };
        let of_targets: Vec<Cap> = engine.plan.receivers.par_iter().map(of_target).collect();
        let of_eye_lx = if has_specular {
            f64::INFINITY
        } else {
            let straight = |kind: &Kind| kind.straight_lx.unwrap_or(0.0);
            let of_kind = |kind: &Kind| straight(kind).max(kind.eye_samples * kind.eye_lx);
            kinds.iter().map(of_kind).fold(0.0, f64::max)
        };
        Self { of_targets, of_eye_lx }
    }

    /// Of each target, the most in lx that a sample adds to one index. Nothing is known of samples
    /// where weights take other densities than those of what is sampled
    /// ([`Bsdf::survival_pdf_sr`]).
    pub(super) fn of_samples_lx<S: Spectrum>(&self, world: &World<S>) -> impl Iterator<Item = f64> {
        let is_measured = world.bsdfs().iter().any(|bsdf| matches!(bsdf, Bsdf::Measured(_)));
        let most_lx = move |cap: &Cap| if is_measured { f64::INFINITY } else { cap.sample_lx };
        self.of_targets.iter().map(most_lx)
    }

    /// Light in lx at each target by ways on which no sample lay, at most; `trials` are the indices
    /// of each, of all replicates.
    pub(super) fn unseen_lx(&self, trials: impl Fn(usize) -> f64) -> Vec<f64> {
        let most = -libm::log(1.0 - UNSEEN_CONFIDENCE);
        let of_target = |(target, cap): (usize, &Cap)| {
            let lx = most * cap.unseen_lx / trials(target);
            if lx.is_nan() { f64::INFINITY } else { lx }
        };
        self.of_targets.iter().enumerate().map(of_target).collect()
    }

    /// The same of the average over targets: an eye path of one of m targets adds an m-th.
    pub(super) fn unseen_of_average_lx(&self, point_lx: &[f64], trials: f64) -> f64 {
        let mean = point_lx.iter().sum::<f64>() / point_lx.len().max(1) as f64;
        let most = -libm::log(1.0 - UNSEEN_CONFIDENCE);
        mean.min(most * self.of_eye_lx / trials)
    }
}

/// Paths of one kind of light to one target.
struct Class<'c, 'l, 'a, S> {
    engine: &'c Engine<'l, 'a, S>,
    receiver: &'c Receiver,
    kind: &'c Kind,
    /// The most that a lumen at a light vertex gives where it is joined, over the chance of that,
    /// in sr^-1 m^-2.
    joined_sr_m2: f64,
    /// K of what has a sample at each vertex.
    samples: f64,
}

impl<S: Spectrum> Class<'_, '_, '_, S> {
    /// K W over all classes.
    fn largest(&self, surfaces: &Surfaces<'_, S>, has_specular: bool, no_bounce: bool) -> f64 {
        let &Self { engine, receiver, kind, samples, .. } = self;
        let plan = &engine.plan;
        // Numbers of samples over K and their caps; light that comes straight is met once.
        let straight_disc = receiver.straight_m2(kind.is_of_emitters) / kind.flux_lm;
        let disc = receiver.area_m2 / kind.flux_lm / samples;
        let all_photons = plan.photons(receiver, true, kind.found_by) / kind.flux_lm;
        let joined = plan.joined as f64 / (kind.flux_lm * self.joined_sr_m2 * samples);
        let [eye, met] = [kind.eye_lx, kind.met_lx].map(|lx| (lx * kind.eye_samples).recip());
        let mut largest = 0.0_f64;
        let mut class = |counts: f64| {
            largest = largest.max(if counts > 0.0 { counts.recip() } else { f64::INFINITY });
        };
        let straight_lx = match receiver.target {
            Target::Cell { .. } => kind.straight_lx.or_else(|| Some(surfaces.on_cell(receiver))),
            Target::Point { .. } => kind.straight_lx,
        };
        if let Some(straight_lx) = straight_lx {
            class(straight_lx.recip() + straight_disc);
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
    let images_hide = context.hides.is_some();
    let lamps = Kind {
        flux_lm: pointlikes_lm,
        eye_lx: surfaces.lit_by_pointlikes(engine),
        met_lx: never,
        eye_samples: samples,
        straight_lx: None,
        is_hidden_by_mirrors: images_hide,
        is_of_emitters: false,
        found_by: FoundBy::Photons,
    };
    let hidden = Kind { is_hidden_by_mirrors: true, ..lamps };
    let luminaires =
        Kind { flux_lm: luminaires_lm, eye_lx: never, straight_lx: Some(never), ..hidden };
    let emitters = Kind {
        flux_lm: emitters_lm,
        eye_lx: largest_lx,
        met_lx: largest_lx,
        // Those that run into it bound what they find.
        eye_samples: samples_at_emitters(&context.world, samples),
        straight_lx: Some(largest_lx),
        is_of_emitters: true,
        found_by: engine.emitters_found_by,
        ..hidden
    };
    let sky = Kind {
        flux_lm: sky_lm,
        eye_lx: sky_lx,
        met_lx: sky_lx,
        // Whoever meets the sky is gone.
        eye_samples: 1.0,
        straight_lx: Some(sky_lx),
        found_by: engine.sky_found_by,
        ..hidden
    };
    let scattered_lx = PI * surfaces.peaks.largest_sr() * sun_lx;
    let sun = Kind { flux_lm: sun_lm, eye_lx: scattered_lx, straight_lx: Some(sun_lx), ..hidden };
    let all = [lamps, luminaires, emitters, sky, sun];
    all.into_iter().filter(|kind| kind.flux_lm > 0.0).collect()
}

/// Of each material.
struct Peaks(Vec<Peak>);

impl Peaks {
    fn new<S: Spectrum>(world: &World<S>) -> Self {
        Self(world.bsdfs().iter().map(Peak::new).collect())
    }

    fn at_facet<S: Spectrum>(&self, world: &World<S>, facet: u32) -> Peak {
        self.0[world.facets[facet as usize].material as usize]
    }

    /// Of values with a cosine.
    fn largest_sr(&self) -> f64 {
        self.0.iter().map(|peak| peak.with_cosine_sr).fold(0.0, f64::max)
    }
}

/// The facets that scatter.
struct Surfaces<'w, S> {
    world: &'w World<S>,
    peaks: Peaks,
    tree: BoxTree,
    facets: Vec<usize>,
    /// The lights without extent.
    pointlikes: Vec<IntensityBound>,
}

impl<S: Spectrum> Surfaces<'_, S> {
    /// At least the largest of what a lumen at a light vertex gives to a target that it is joined
    /// to, over the chance of that, in sr^-1 m^-2.
    fn joined(&self, receiver: &Receiver) -> f64 {
        let corners = receiver.corners();
        let value = JoinBound { surfaces: self, receiver, corners };
        let at_most = supremum(self.world, &self.tree, &self.facets, &value);
        let scattered_sr = self.peaks.0.iter().map(|peak| peak.value_sr).fold(0.0, f64::max);
        at_most.max(scattered_sr * receiver.sure_m2)
    }

    /// At least the largest of what the lights without extent give, times pi and the scattering
    /// function, over the chance of asking; infinite where a table chooses.
    fn lit_by_pointlikes(&self, engine: &Engine<'_, '_, S>) -> f64 {
        if engine.context.lights.pointlikes.are_many() {
            return f64::INFINITY;
        }
        let lights = &self.pointlikes;
        let choice = if lights.len() > 1 { CHOICE } else { 1.0 };
        let value = Lit { surfaces: Some(self), lights };
        supremum(self.world, &self.tree, &self.facets, &value) / choice
    }

    /// At least the most that a light without extent gives on a cell.
    fn on_cell(&self, receiver: &Receiver) -> f64 {
        let [a, b, c, d] = receiver.corners();
        let parts = [[a, b, c], [b, d, c]].map(|corners| SeenPart { corners, facet: 0 });
        let of_light = |lights: &[IntensityBound]| {
            supremum_over(parts.into_iter(), &Lit::<S> { surfaces: None, lights })
        };
        self.pointlikes.chunks(1).map(of_light).fold(0.0, f64::max)
    }
}

/// What lights give to surfaces, in lx.
struct Lit<'s, 'w, S> {
    /// Whose facets they are, and how much they send on; `None` for illuminances alone.
    surfaces: Option<&'s Surfaces<'w, S>>,
    lights: &'s [IntensityBound],
}

impl<S: Spectrum> Lit<'_, '_, S> {
    fn peak(&self, part: &SeenPart) -> Peak {
        let value_sr = FRAC_1_PI;
        self.surfaces.map_or(
            Peak { value_sr, with_cosine_sr: value_sr, is_lambertian: true },
            |surfaces| {
                surfaces.peaks.at_facet(surfaces.world, surfaces.facets[part.facet as usize] as u32)
            },
        )
    }

    fn value(&self, part: &SeenPart, lx: impl Fn(&IntensityBound, f64) -> f64) -> f64 {
        let [a, b, c] = part.corners;
        let n = (b - a).cross(c - a).normalize_or_zero();
        let peak = self.peak(part);
        let of_light = |light: &IntensityBound| {
            let height_m = n.dot(light.position - a).abs();
            lx(light, if peak.is_lambertian { height_m } else { f64::INFINITY })
        };
        PI * peak.with_cosine_sr * self.lights.iter().map(of_light).sum::<f64>()
    }
}

impl<S: Spectrum> Bounded for Lit<'_, '_, S> {
    fn over_box(&self, low: DVec3, high: DVec3) -> f64 {
        let (centre, radius_m) = (0.5 * (low + high), 0.5 * (high - low).length());
        let peaks = self.surfaces.map_or(FRAC_1_PI, |surfaces| surfaces.peaks.largest_sr());
        let of_light = |light: &IntensityBound| {
            let distance_m = (light.position - light.position.clamp(low, high)).length();
            let way = centre - light.position;
            most_cd(light, way, radius_m) / (distance_m * distance_m)
        };
        PI * peaks * self.lights.iter().map(of_light).sum::<f64>()
    }

    fn over_part(&self, part: &SeenPart) -> f64 {
        let (centre, radius_m) = (part.centre(), part.radius_m());
        self.value(part, |light, height_m| {
            if height_m == 0.0 {
                return 0.0;
            }
            let distance_m = part.distance_m(light.position);
            let cos = (height_m / distance_m).min(1.0);
            most_cd(light, centre - light.position, radius_m) * cos / (distance_m * distance_m)
        })
    }

    fn at_centre(&self, part: &SeenPart) -> f64 {
        let centre = part.centre();
        self.value(part, |light, height_m| {
            let way = centre - light.position;
            let square_m2 = way.length_squared();
            let cos = (height_m / square_m2.sqrt()).min(1.0);
            let cd = light.most_cd(way.normalize_or_zero(), 0.0);
            if square_m2 > 0.0 { cd * cos / square_m2 } else { 0.0 }
        })
    }
}

/// At least the intensity toward a ball of this radius whose centre is this way.
fn most_cd(light: &IntensityBound, way: DVec3, radius_m: f64) -> f64 {
    let distance_m = way.length();
    let angle_rad = if radius_m < distance_m { libm::asin(radius_m / distance_m) } else { PI };
    light.most_cd(way.normalize_or(DVec3::Z), angle_rad)
}

/// What a lumen at a light vertex gives to a target, in sr^-1 m^-2.
struct JoinBound<'s, 'w, S> {
    surfaces: &'s Surfaces<'w, S>,
    receiver: &'s Receiver,
    /// Of a cell, or four times the point.
    corners: [DVec3; 4],
}

impl<S: Spectrum> JoinBound<'_, '_, S> {
    /// The least distance to a place, the largest height of a place over the target, by how far the
    /// target reaches around its centre.
    fn reach_m(&self) -> f64 {
        let centre = self.receiver.position;
        self.corners.iter().map(|corner| corner.distance(centre)).fold(0.0, f64::max)
    }

    /// The largest cosine at the target of something at this distance at least.
    fn cos(&self, places: impl Iterator<Item = DVec3>, distance_m: f64) -> f64 {
        let Receiver { position, n, .. } = *self.receiver;
        let height_m = places.map(|place| n.dot(place - position)).fold(0.0, f64::max);
        (height_m / distance_m).min(1.0)
    }
}

impl<S: Spectrum> Bounded for JoinBound<'_, '_, S> {
    fn over_box(&self, low: DVec3, high: DVec3) -> f64 {
        let position = self.receiver.position;
        let distance_m = (position - position.clamp(low, high)).length() - self.reach_m();
        if distance_m <= 0.0 {
            return f64::INFINITY;
        }
        let corners = (0..8_u32).map(|corner| {
            let pick = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
            DVec3::new(pick(0), pick(1), pick(2))
        });
        let peaks = self.surfaces.peaks.0.iter().map(|peak| peak.value_sr.max(peak.with_cosine_sr));
        let cos = self.cos(corners, distance_m);
        peaks.fold(0.0, f64::max) * cos / (distance_m * distance_m)
    }

    fn over_part(&self, part: &SeenPart) -> f64 {
        let position = self.receiver.position;
        let distance_m = part.distance_m(position) - self.reach_m();
        let cos =
            if distance_m <= 0.0 { 1.0 } else { self.cos(part.corners.into_iter(), distance_m) };
        if cos <= 0.0 {
            return 0.0;
        }
        let peak = self.peak(part);
        let cos_there = self.cos_there(part, &peak, distance_m);
        if cos_there == 0.0 {
            return 0.0;
        }
        if distance_m <= 0.0 {
            return f64::INFINITY;
        }
        peak.with_cosine_sr * cos * cos_there / (distance_m * distance_m)
    }

    fn at_centre(&self, part: &SeenPart) -> f64 {
        let Receiver { position, n, .. } = *self.receiver;
        let way = part.centre() - position;
        let distance_m = way.length();
        let cos = n.dot(way) / distance_m;
        let peak = self.peak(part);
        let value = peak.with_cosine_sr * cos * self.cos_there(part, &peak, distance_m)
            / (distance_m * distance_m);
        if value.is_finite() { value.max(0.0) } else { 0.0 }
    }
}

impl<S: Spectrum> JoinBound<'_, '_, S> {
    fn peak(&self, part: &SeenPart) -> Peak {
        let Surfaces { world, peaks, facets, .. } = self.surfaces;
        peaks.at_facet(world, facets[part.facet as usize] as u32)
    }

    /// The cosine on the facet of something that is at least as far.
    fn cos_there(&self, part: &SeenPart, peak: &Peak, distance_m: f64) -> f64 {
        if !peak.is_lambertian {
            return 1.0;
        }
        let [a, b, c] = part.corners;
        let n = (b - a).cross(c - a).normalize_or_zero();
        let height_m = self.corners.map(|corner| n.dot(corner - a).abs());
        let height_m = height_m.into_iter().fold(0.0, f64::max);
        if height_m == 0.0 { 0.0 } else { (height_m / distance_m.max(0.0)).min(1.0) }
    }
}

impl Receiver {
    /// Of its cell, or four times its point.
    pub(super) fn corners(&self) -> [DVec3; 4] {
        match self.target {
            Target::Point { .. } => [self.position; 4],
            Target::Cell { grid, cell } => [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]
                .map(|u| grid.point_in_cell(cell, u)),
        }
    }
}
