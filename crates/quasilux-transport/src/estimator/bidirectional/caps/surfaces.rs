//! What surfaces send on at most: of the light of lamps and of the sun, and to a target.

use crate::context::Context;
use crate::estimator::bidirectional::boxes::BoxTree;
use crate::estimator::bidirectional::engine::Engine;
use crate::estimator::bidirectional::intensities::{Hull, IntensityBound};
use crate::estimator::bidirectional::peaks::Peak;
use crate::estimator::bidirectional::plan::Receiver;
use crate::estimator::bidirectional::supremum::{Bounded, SeenPart, supremum, supremum_over};
use crate::lights::OutsideLight;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::world::World;
use glam::DVec3;
use std::array;
use std::f64::consts::{FRAC_1_PI, PI};

/// A choice among lights in proportion to what they give takes one with no less than this part of
/// its share ([`crate::lights::PointLikes::choose`]).
const CHOICE: f64 = 0.9;

/// Of each material.
pub(super) struct Peaks(pub(super) Vec<Peak>);

impl Peaks {
    pub(super) fn new<S: Spectrum>(world: &World<S>) -> Self {
        Self(world.bsdfs().iter().map(Peak::new).collect())
    }

    fn at_facet<S: Spectrum>(&self, world: &World<S>, facet: u32) -> &Peak {
        &self.0[world.facets[facet as usize].material as usize]
    }
}

/// The facets that scatter.
pub(super) struct Surfaces<'w, S> {
    pub(super) world: &'w World<S>,
    peaks: Peaks,
    tree: BoxTree,
    /// The largest peak in each box of the tree, in sr^-1.
    peaks_in_sr: Vec<f64>,
    /// Whether there are facets in it that are not Lambertian.
    has_narrow_in: Vec<bool>,
    pub(super) facets: Vec<usize>,
    /// The lights without extent.
    pointlikes: Vec<IntensityBound>,
}

impl<'w, S: Spectrum> Surfaces<'w, S> {
    pub(super) fn new(context: &'w Context<'_, S>) -> Self {
        let world = &context.world;
        let peaks = Peaks::new(world);
        let scatters = (0..world.facets.len())
            .filter(|it| peaks.at_facet(world, *it as u32).largest_sr() > 0.0);
        let facets: Vec<usize> = scatters.collect();
        let lights = &context.lights.pointlikes;
        let pointlikes =
            (0..lights.len()).filter_map(|it| IntensityBound::new(lights.get(it)?)).collect();
        let tree = BoxTree::of_facets(world, &facets);
        let peak = |thing: u32| peaks.at_facet(world, facets[thing as usize] as u32);
        let peaks_in_sr = tree.largest_in(|thing| peak(thing).largest_sr());
        let is_narrow = |thing: u32| if peak(thing).is_lambertian { 0.0 } else { 1.0 };
        let has_narrow_in = tree.largest_in(is_narrow).into_iter().map(|it| it > 0.0).collect();
        Self { world, peaks, tree, peaks_in_sr, has_narrow_in, facets, pointlikes }
    }

    fn peak(&self, part: &SeenPart) -> &Peak {
        self.peaks.at_facet(self.world, self.facets[part.facet as usize] as u32)
    }

    /// Whether it asks for light on both of its sides.
    fn asks_both_sides(&self, part: &SeenPart) -> bool {
        let facet = &self.world.facets[self.facets[part.facet as usize]];
        self.world.bsdf_of(facet).transmits()
    }

    /// At least the largest of what a lumen at a light vertex gives to a target that it is joined
    /// to, over the chance of that, in sr^-1 m^-2.
    pub(super) fn joined(&self, receiver: &Receiver) -> f64 {
        let corners = receiver.corners();
        let value = JoinBound { surfaces: self, receiver, corners };
        let at_most = supremum(self.world, &self.tree, &self.facets, &value);
        at_most.max(self.most_sr() / receiver.per_sure_m2)
    }

    /// The most that any of them sends on of a lux, in sr^-1.
    pub(super) fn most_sr(&self) -> f64 {
        self.peaks.0.iter().map(Peak::largest_sr).fold(0.0, f64::max)
    }

    /// At least the largest of what the lights without extent give, times pi and the scattering
    /// function, over the chance of asking; infinite where a table chooses.
    pub(super) fn lit_by_pointlikes(&self, engine: &Engine<'_, '_, S>) -> f64 {
        if engine.context.lights.pointlikes.are_many() {
            return f64::INFINITY;
        }
        let lights = &self.pointlikes;
        let choice = if lights.len() > 1 { CHOICE } else { 1.0 };
        let value = Lit { surfaces: Some(self), lights };
        supremum(self.world, &self.tree, &self.facets, &value) / choice
    }

    /// At least the largest of what the sun gives, times pi and the scattering function.
    pub(super) fn lit_by_sun(&self, outside: &OutsideLight<'_>) -> f64 {
        let [cd_m2, lx] = outside.sun_brightness();
        let Some(toward) = outside.sample_sun([0.0; 2]).filter(|_| lx > 0.0) else { return 0.0 };
        // Anywhere on the disk, which a sample lies in.
        let across_rad = 2.0 * (lx / cd_m2 * FRAC_1_PI).sqrt();
        let of_facet = |number: &usize| {
            let cos = self.world.facets[*number].front_normal.dot(toward).abs();
            let least_cos = cos - across_rad;
            self.peaks.at_facet(self.world, *number as u32).largest_above_sr(least_cos)
        };
        PI * lx * self.facets.iter().map(of_facet).fold(0.0, f64::max)
    }

    /// At least the most that a light without extent gives on a cell.
    pub(super) fn on_cell(&self, receiver: &Receiver) -> f64 {
        let [a, b, c, d] = receiver.corners();
        let parts = [[a, b, c], [b, d, c]].map(|corners| SeenPart { corners, facet: 0 });
        let of_light = |lights: &[IntensityBound]| {
            supremum_over(parts.into_iter(), &Lit::<S> { surfaces: None, lights })
        };
        self.pointlikes.chunks(1).map(of_light).fold(0.0, f64::max)
    }
}

/// Illuminance by lights in lx, or pi times what surfaces send on of it.
struct Lit<'s, 'w, S> {
    /// Whose facets they are, and how much they send on; `None` for illuminances alone.
    surfaces: Option<&'s Surfaces<'w, S>>,
    lights: &'s [IntensityBound],
}

impl<S: Spectrum> Lit<'_, '_, S> {
    /// Pi times what the lights give there, by the least and the largest distance of each. Lights
    /// are chosen by illuminance, so what a surface that is not Lambertian sends on of one comes
    /// with the illuminance by all; for both sides together by that without the cosine.
    fn value<'p>(&self, part: &SeenPart, hull_from: impl Fn(DVec3) -> Hull<'p>) -> f64 {
        let [a, b, c] = part.corners;
        let n = (b - a).cross(c - a).normalize_or_zero();
        let peak = self.surfaces.map(|surfaces| surfaces.peak(part));
        let (mut all_lx, mut normal_lx, mut most_cos) = (0.0, 0.0, 0.0_f64);
        let (mut most_sr, mut with_cosine_sr) = (0.0_f64, 0.0_f64);
        for light in self.lights {
            let height_m = n.dot(light.position - a).abs();
            let hull = hull_from(light.position);
            let [near_m, far_m] = hull.distances_m;
            let lx = light.most_lx(&hull);
            normal_lx += lx;
            if height_m == 0.0 || lx == 0.0 {
                continue;
            }
            let cos = (height_m / near_m).min(1.0);
            all_lx += lx * cos;
            most_cos = most_cos.max(cos);
            if let Some(peak) = peak.filter(|peak| !peak.is_lambertian) {
                let least_cos = height_m / far_m;
                let sent_sr = peak.largest_above_sr(least_cos);
                with_cosine_sr = with_cosine_sr.max(sent_sr);
                most_sr = most_sr.max(sent_sr / least_cos);
            }
        }
        let sent_lx = match peak {
            None => all_lx * FRAC_1_PI,
            Some(peak) if peak.is_lambertian => {
                let is_sheet = self.surfaces.is_some_and(|it| it.asks_both_sides(part));
                peak.largest_sr() * if is_sheet { normal_lx * most_cos } else { all_lx }
            }
            Some(_) if self.lights.len() == 1 => normal_lx * with_cosine_sr,
            Some(_) => (all_lx * most_sr).max(normal_lx * with_cosine_sr),
        };
        if sent_lx > 0.0 { PI * sent_lx } else { 0.0 }
    }
}

impl<S: Spectrum> Bounded for Lit<'_, '_, S> {
    fn over_box(&self, number: u32, low: DVec3, high: DVec3) -> f64 {
        let (centre, radius_m) = (0.5 * (low + high), 0.5 * (high - low).length());
        let corners = &corners_of_box(low, high);
        let peaks = match self.surfaces {
            None => FRAC_1_PI,
            Some(surfaces) if self.lights.len() > 1 && surfaces.has_narrow_in[number as usize] => {
                return f64::INFINITY;
            }
            Some(surfaces) => surfaces.peaks_in_sr[number as usize],
        };
        let of_light = |light: &IntensityBound| {
            let near_m = (light.position - light.position.clamp(low, high)).length();
            let far_m = light.position.distance(centre) + radius_m;
            let distances_m = [near_m, far_m];
            light.most_lx(&Hull { corners, centre, radius_m, distances_m })
        };
        PI * peaks * self.lights.iter().map(of_light).sum::<f64>()
    }

    fn over_part(&self, part: &SeenPart) -> f64 {
        let (centre, radius_m) = (part.centre(), part.radius_m());
        self.value(part, |place| Hull {
            corners: &part.corners,
            centre,
            radius_m,
            distances_m: [part.distance_m(place), part.farthest_m(place)],
        })
    }

    fn at_centre(&self, part: &SeenPart) -> f64 {
        let centre = part.centre();
        let corners = [centre];
        let found = self.value(part, |place| Hull {
            corners: &corners,
            centre,
            radius_m: 0.0,
            distances_m: [centre.distance(place); 2],
        });
        if found.is_finite() { found } else { 0.0 }
    }
}

fn corners_of_box(low: DVec3, high: DVec3) -> [DVec3; 8] {
    array::from_fn(|corner| {
        let pick = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    })
}

/// Contribution in sr^-1 m^-2 of each lumen at a light vertex to a target.
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
    fn over_box(&self, number: u32, low: DVec3, high: DVec3) -> f64 {
        let position = self.receiver.position;
        let distance_m = (position - position.clamp(low, high)).length() - self.reach_m();
        if distance_m <= 0.0 {
            return f64::INFINITY;
        }
        let cos = self.cos(corners_of_box(low, high).into_iter(), distance_m);
        self.surfaces.peaks_in_sr[number as usize] * cos / (distance_m * distance_m)
    }

    fn over_part(&self, part: &SeenPart) -> f64 {
        let position = self.receiver.position;
        let distance_m = part.distance_m(position) - self.reach_m();
        let cos =
            if distance_m <= 0.0 { 1.0 } else { self.cos(part.corners.into_iter(), distance_m) };
        if cos <= 0.0 {
            return 0.0;
        }
        let far_m = self.corners.map(|corner| part.farthest_m(corner));
        let far_m = far_m.into_iter().fold(0.0, f64::max);
        let sent_sr = self.sent_sr(part, [distance_m.max(0.0), far_m]);
        if sent_sr == 0.0 {
            return 0.0;
        }
        if distance_m <= 0.0 {
            return f64::INFINITY;
        }
        sent_sr * cos / (distance_m * distance_m)
    }

    fn at_centre(&self, part: &SeenPart) -> f64 {
        let Receiver { position, n, .. } = *self.receiver;
        let way = part.centre() - position;
        let distance_m = way.length();
        let cos = n.dot(way) / distance_m;
        let value = self.sent_sr(part, [distance_m; 2]) * cos / (distance_m * distance_m);
        if value.is_finite() { value.max(0.0) } else { 0.0 }
    }
}

impl<S: Spectrum> JoinBound<'_, '_, S> {
    /// The scattering function with the cosine on the facet at most, of something so near and so
    /// far.
    fn sent_sr(&self, part: &SeenPart, [near_m, far_m]: [f64; 2]) -> f64 {
        let peak = self.surfaces.peak(part);
        let [a, b, c] = part.corners;
        let n = (b - a).cross(c - a).normalize_or_zero();
        let heights_m = self.corners.map(|corner| n.dot(corner - a));
        let most_m = heights_m.into_iter().map(f64::abs).fold(0.0, f64::max);
        if most_m == 0.0 {
            return 0.0;
        }
        if peak.is_lambertian {
            return peak.largest_sr() * (most_m / near_m).min(1.0);
        }
        let is_one_side = heights_m.iter().all(|it| it.signum() == heights_m[0].signum());
        let least_m = heights_m.into_iter().map(f64::abs).fold(f64::INFINITY, f64::min);
        peak.largest_above_sr(if is_one_side { least_m / far_m } else { 0.0 })
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
