//! Which points the sun shines on: how many, hour by hour, is what blinds are closed by.

use super::sun_disks::{ShiningSun, SunDisks, SunLight, ask};
use super::year::lit;
use crate::context::Context;
use crate::sensors::targets;
use crate::settings::Settings;
use crate::world::vertex::Vertex;
use crate::world::visibility::{Answer, ShadowQueue};
use glam::DVec3;
use quasilux_scene::{Rgb, Scene, Sensor, SensorPoint};
use quasilux_sky::{SkyPoint, WeatherSky};
use rayon::prelude::*;
use std::ops::Range;

/// Sunlight of two rooms is the same if it differs by no more than this share.
const SAME: f64 = 1e-3;

/// Sunlight that counts.
#[derive(Clone, Copy, Debug)]
pub struct Sunlight<'s> {
    /// More than this many lx straight from the sun.
    pub above_lx: f64,
    /// Of those alone of which another room has not the same: what stands before the sun there and
    /// not here.
    pub differs_from: Option<&'s Scene>,
}

/// How many of these sensor points, numbered through all sensors, have such sunlight, hour by hour.
///
/// Seven rays to each disk say it, the same whatever the seed; over cells they start at the centre.
/// Runs in the rayon pool that the call is made in.
#[must_use]
pub fn sunlit_points(
    scene: &Scene,
    hours: &[WeatherSky],
    settings: &Settings,
    points: Range<usize>,
    sunlight: Sunlight<'_>,
) -> Vec<usize> {
    let none = || vec![0; hours.len()];
    let Some(environment) = &scene.environment else { return none() };
    let room = |scene: &Scene| lit(scene, environment);
    let (here, there) = (room(scene), sunlight.differs_from.map(room));
    let here = Context::<Rgb>::new(&here, settings);
    let there = there.as_ref().map(|scene| Context::<Rgb>::new(scene, settings));
    let sun = |(hour, of)| ShiningSun::new(hour, of, environment);
    let suns: Vec<ShiningSun> = hours.iter().enumerate().filter_map(sun).collect();
    let targets = targets(scene);
    let own = targets.get(points).unwrap_or_default().par_iter();
    let count = |mut counts: Vec<usize>, target| {
        let glance = |context: &Context<'_, Rgb>| {
            let mut all_lx = vec![0.0; hours.len()];
            let disks = SunDisks::new(context, target, &suns, 0);
            disks.glances(&suns).for_each(|SunLight { hour, lx }| all_lx[hour] = f64::from(lx));
            all_lx
        };
        let there = there.as_ref().map(glance);
        for (hour, lx) in glance(&here).into_iter().enumerate() {
            let is_other = |there: &Vec<f64>| (there[hour] - lx).abs() > SAME * lx;
            let counts_here = lx > sunlight.above_lx && there.as_ref().is_none_or(is_other);
            counts[hour] += usize::from(counts_here);
        }
        counts
    };
    let add = |mut all: Vec<usize>, others: Vec<usize>| {
        all.iter_mut().zip(others).for_each(|(count, other)| *count += other);
        all
    };
    own.fold(none, count).reduce(none, add)
}

/// Digest, for each sensor point in their order, of which of these places of the sun it sees the
/// centre of: past surfaces and through clear panes.
///
/// One ray to each decides. Runs in the rayon pool that the call is made in.
#[must_use]
pub fn seen_suns<T: Send>(
    scene: &Scene,
    suns: &[SkyPoint],
    settings: &Settings,
    digest: impl Fn(&[bool]) -> T + Sync,
) -> Vec<T> {
    let Some(environment) = &scene.environment else { return Vec::new() };
    let lit = lit(scene, environment);
    let context = Context::<Rgb>::new(&lit, settings);
    let directions: Vec<DVec3> = suns.iter().map(|sun| environment.towards(*sun)).collect();
    let points: Vec<SensorPoint> = scene.sensors.iter().flat_map(Sensor::points).collect();
    let look = |SensorPoint { position, normal }: &SensorPoint| {
        let from = context.world.ray_origin_of_sensor(*position, *normal);
        let vertex = Vertex::sensor(from, *normal);
        let mut queue = ShadowQueue::default();
        for (sun, direction) in (0..).zip(&directions) {
            ask(&context, &mut queue, sun, &vertex, *direction, normal.dot(*direction));
        }
        let mut is_seen = vec![false; suns.len()];
        queue.answer_all(&context.world, |Answer { who, bounces, .. }: Answer<Rgb>| {
            is_seen[who as usize] = bounces.is_some();
        });
        digest(&is_seen)
    };
    points.par_iter().map(look).collect()
}
