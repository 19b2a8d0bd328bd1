//! How many points the sun shines on, hour by hour: what blinds are closed by.

use super::sun_disks::{ShiningSun, SunDisks};
use super::year::lit;
use crate::context::Context;
use crate::settings::Settings;
use crate::stats::targets::targets;
use quasilux_scene::{Rgb, Scene};
use quasilux_sky::WeatherSky;
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
