//! Daylight coefficients of a sensor point: what it gets of 1 cd/m2 at each node of the sky, of 1
//! cd/m2 on the ground, and of a sun of 1 lx at each place of the sun, but for what comes straight
//! from there (P. R. Tregenza and I. M. Waters, "Daylight coefficients", Lighting Research and
//! Technology 15, 1983).

use super::mesh::{Mesh, Share, Spacing};
use super::pilot::sun_ways;
use crate::context::{Context, Stream};
use crate::lights::Suns;
use crate::path::daylight::{DaylightSearch, FromOutside, OutsideSource};
use crate::path::daylight_paths::{TargetReplicate, trace};
use crate::path::wave::PathWave;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::stats::tally::checked_quanta;
use quasilux_sampling::Sampler;
use std::ops::Range;
use std::sync::Arc;

/// Between nodes of the sky: near the horizon luminances change within a degree.
const SKY: Spacing = Spacing { usual: 0.105, at_horizon: 0.026 };
/// Between places of the sun: the light of its patches on surfaces changes little over half a hour.
const SUNS: Spacing = Spacing { usual: 0.131, at_horizon: 0.131 };
/// Quanta of 1 lx; sums have room for 2^31 of it.
const PER_LX: f64 = (1_u64 << 32) as f64;

/// Where the coefficients of one replicate are.
pub(super) struct Meshes {
    pub(super) sky: Mesh,
    suns_mesh: Mesh,
    /// The places of the sun that an hour needs.
    suns: Suns,
    /// The number among them of each node.
    sun_of_node: Vec<Option<u32>>,
    /// One over the solid angle of each place, in sr^-1.
    per_sr: Vec<f64>,
    /// Sums over nodes nearby that stand for the value at each node of the sky, and of the sun's
    /// mesh.
    pub(super) sharpened_sky: Vec<Vec<Share>>,
    sharpened_suns: Vec<Vec<Share>>,
}

/// A place of the sun with its share of another.
pub(super) struct SunShare {
    pub(super) sun: u32,
    pub(super) share: f64,
}

/// Sums over the paths of one point in one replicate, in quanta.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    pub(super) paths: u64,
    sky: Vec<i64>,
    ground: i64,
    suns: Vec<i64>,
    /// Contributions that are not in them.
    pub(super) invalid: u64,
}

/// Their means.
pub(super) struct Coefficients {
    pub(super) sky: Vec<f32>,
    pub(super) ground: f32,
    pub(super) suns: Vec<f32>,
}

impl Meshes {
    /// Meshes of a replicate, for the sun in these directions.
    pub(super) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        replicate: u32,
        sun_directions: impl Iterator<Item = glam::DVec3>,
    ) -> Self {
        let points = context.points(replicate, Stream::Meshes);
        let mut sampler = Sampler::new(&points, 0);
        let sky = Mesh::new(SKY, sampler.next_2d());
        let suns_mesh = Mesh::new(SUNS, sampler.next_2d());
        let sharpened_suns = suns_mesh.sharpened();
        let mut is_needed = vec![false; suns_mesh.len()];
        for direction in sun_directions {
            for (node, _) in suns_mesh.shares(direction) {
                sharpened_suns[node].iter().for_each(|&(node, _)| is_needed[node] = true);
            }
        }
        let mut suns = Suns::default();
        let mut per_sr = Vec::new();
        let mut sun_of_node = vec![None; suns_mesh.len()];
        let nodes = suns_mesh.directions().zip(suns_mesh.solid_angles_sr()).enumerate();
        for (node, (direction, solid_angle_sr)) in nodes.filter(|(node, _)| is_needed[*node]) {
            sun_of_node[node] = Some(suns.len() as u32);
            suns.push(direction);
            per_sr.push(1.0 / solid_angle_sr);
        }
        let sharpened_sky = sky.sharpened();
        Self { sky, suns_mesh, suns, sun_of_node, per_sr, sharpened_sky, sharpened_suns }
    }

    /// Finds out where the sun shines, by paths from these targets that do not count: elsewhere few
    /// places of the sun are asked. All replicates learn the same.
    pub(super) fn learn<S: Spectrum>(
        all: &mut [Self],
        context: &Context<'_, S>,
        targets: &[Target],
    ) {
        let Some(first) = all.first() else { return };
        let ways = Arc::new(sun_ways(context, &first.suns, all.len() as u32, targets));
        all.iter_mut().for_each(|meshes| meshes.suns.use_ways(Arc::clone(&ways)));
    }

    /// The places of the sun that stand for one in a direction.
    pub(super) fn suns_for(&self, direction: glam::DVec3) -> impl Iterator<Item = SunShare> {
        let nodes = self.suns_mesh.shares(direction).into_iter();
        nodes.flat_map(move |(node, share)| {
            let sharpened = self.sharpened_suns[node].iter();
            sharpened.filter_map(move |&(node, part)| {
                Some(SunShare { sun: self.sun_of_node[node]?, share: share * part })
            })
        })
    }

    /// The places of the sun around a direction.
    fn suns_at(&self, direction: glam::DVec3) -> impl Iterator<Item = SunShare> {
        let shares = self.suns_mesh.shares(direction).into_iter();
        let needed =
            |(node, share): Share| self.sun_of_node[node].map(|sun| SunShare { sun, share });
        shares.filter_map(needed)
    }

    /// No path yet.
    pub(super) fn no_sums(&self) -> Sums {
        let suns = vec![0; self.suns.len()];
        Sums { paths: 0, sky: vec![0; self.sky.len()], ground: 0, suns, invalid: 0 }
    }
}

impl Sums {
    /// Traces paths of a target; returns how many rays they took.
    pub(super) fn trace<S: Spectrum>(
        &mut self,
        context: &Context<'_, S>,
        meshes: &Meshes,
        place: TargetReplicate<'_>,
        indices: Range<u64>,
        wave: &mut PathWave<S>,
    ) -> u64 {
        self.paths += indices.end - indices.start;
        let search = DaylightSearch { suns: &meshes.suns, only_from_beyond: false };
        trace(context, search, place, indices, wave, |found| self.add(meshes, found))
    }

    fn add(&mut self, meshes: &Meshes, FromOutside { source, light, .. }: FromOutside) {
        let (direction, is_mirrored) = match source {
            OutsideSource::Sun(sun, _) => {
                return add(&mut self.suns[sun as usize], light, &mut self.invalid);
            }
            OutsideSource::Outside(direction) => (direction, false),
            OutsideSource::Mirrored(direction) => (direction, true),
        };
        if is_mirrored {
            // Nobody can ask for the sun here: its light is found by how much comes from around it.
            for SunShare { sun, share } in meshes.suns_at(direction) {
                let light = light * share * meshes.per_sr[sun as usize];
                add(&mut self.suns[sun as usize], light, &mut self.invalid);
            }
        }
        if direction.z < 0.0 {
            return add(&mut self.ground, light, &mut self.invalid);
        }
        for (node, share) in meshes.sky.shares(direction) {
            add(&mut self.sky[node], light * share, &mut self.invalid);
        }
    }

    /// The means over its paths.
    pub(super) fn coefficients(&self) -> Coefficients {
        let of_quantum = 1.0 / (PER_LX * self.paths.max(1) as f64);
        let mean = |quanta: &i64| (*quanta as f64 * of_quantum) as f32;
        Coefficients {
            sky: self.sky.iter().map(mean).collect(),
            ground: mean(&self.ground),
            suns: self.suns.iter().map(mean).collect(),
        }
    }
}

/// Adds a contribution, or counts it as one that cannot be added.
fn add(sum: &mut i64, light: f64, invalid: &mut u64) {
    match checked_quanta(light, PER_LX).and_then(|quanta| sum.checked_add(quanta)) {
        Some(total) => *sum = total,
        None => *invalid += 1,
    }
}
