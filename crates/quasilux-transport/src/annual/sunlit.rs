//! Which points the sun shines on: how many, hour by hour, is what blinds are closed by.

use super::sun_disks::{ShiningSun, SunDisks, ask};
use super::year::lit;
use crate::context::Context;
use crate::settings::Settings;
use crate::stats::targets::targets;
use crate::world::vertex::Vertex;
use crate::world::visibility::{Answer, ShadowQueue};
use glam::DVec3;
use quasilux_scene::{Rgb, Scene, Sensor, SensorPoint};
use quasilux_sky::{SkyPoint, WeatherSky};
use rayon::prelude::*;
use std::ops::Range;

/// How many of these sensor points, numbered through all sensors, get more than an illuminance in
/// lx straight from the sun, hour by hour.
///
/// Seven rays to each disk say it, the same whatever the seed; over cells they start at the centre.
/// Runs in the rayon pool that the call is made in.
#[must_use]
pub fn sunlit_points(
    scene: &Scene,
    hours: &[WeatherSky],
    settings: &Settings,
    points: Range<usize>,
    lx: f64,
) -> Vec<usize> {
    let none = || vec![0; hours.len()];
    let Some(environment) = &scene.environment else { return none() };
    let lit = lit(scene, environment);
    let context = Context::<Rgb>::new(&lit, settings);
    let sun = |(hour, of)| ShiningSun::new(hour, of, environment);
    let suns: Vec<ShiningSun> = hours.iter().enumerate().filter_map(sun).collect();
    let targets = targets(scene);
    let own = targets.get(points).unwrap_or_default().par_iter();
    let count = |mut counts: Vec<usize>, target| {
        let disks = SunDisks::new(&context, target, &suns, 0);
        disks.hours_above(&suns, lx).for_each(|hour| counts[hour] += 1);
        counts
    };
    let add = |mut all: Vec<usize>, others: Vec<usize>| {
        all.iter_mut().zip(others).for_each(|(count, other)| *count += other);
        all
    };
    own.fold(none, count).reduce(none, add)
}

/// What each sensor point, in their order, makes of which of these places of the sun it sees the
/// centre of: past surfaces and through clear panes.
///
/// One ray to each says it. Runs in the rayon pool that the call is made in.
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
