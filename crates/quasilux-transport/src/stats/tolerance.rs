//! Which sensor points are known as well as was asked for.

use crate::settings::{Settings, ToleranceOn};
use crate::stats::estimates::Estimates;
use crate::stats::interval::Interval;

/// Paths or photons, all replicates together, that a point where nothing is found gets before a
/// run may end without it.
const MIN_TRIES: f64 = (1 << 14) as f64;
/// The same where rare and bright light was missed, or where a witness found more light: that more
/// paths will meet them is certain.
const MIN_TRIES_OF_MISSED: f64 = (1 << 20) as f64;

/// How all targets stand at a checkpoint, in the order of their sensors.
pub(crate) struct Standing {
    /// Half-width over value; `None` where there is no half-width.
    pub(crate) relative_widths: Vec<Option<f64>>,
    /// Half-width over tolerance of what has to reach it: the point, or the average of its sensor.
    /// `None` where there is no half-width, or nothing to reach.
    pub(crate) excess: Vec<Option<f64>>,
    /// Whether what was found is known as well, be the interval withdrawn or not.
    pub(crate) narrow: Vec<bool>,
    /// Whether more samples are of no use to a target.
    pub(crate) done: Vec<bool>,
    /// Points where nothing was found yet.
    pub(crate) unresolved: u64,
    /// Whether all that has to reach the tolerance has.
    pub(crate) is_reached: bool,
    /// Whether the run need not go on: points where nothing was found hold it up until they had a
    /// fair chance, not for ever.
    pub(crate) may_end: bool,
}

impl Standing {
    pub(crate) fn new(estimates: &Estimates, settings: &Settings) -> Self {
        let replicates = settings.effective_replicates();
        let is_wanted = settings.has_tolerance() && replicates >= 2;
        let tries = estimates.samples as f64 * f64::from(replicates);
        let had_a_chance =
            |missed: bool| tries >= if missed { MIN_TRIES_OF_MISSED } else { MIN_TRIES };
        let mut standing = Self {
            relative_widths: Vec::new(),
            excess: Vec::new(),
            narrow: Vec::new(),
            done: Vec::new(),
            unresolved: 0,
            is_reached: is_wanted,
            may_end: is_wanted,
        };
        let excess_of = |interval: &Interval| excess(interval, settings).filter(|_| is_wanted);
        for (sensor, figures) in estimates.sensors.iter().enumerate() {
            let unresolved = figures.resolved.iter().filter(|resolved| !**resolved).count();
            standing.unresolved += unresolved as u64;
            let points = estimates.point_intervals(sensor);
            standing.relative_widths.extend(points.iter().map(Interval::relative_half_width));
            match settings.tolerance_on {
                ToleranceOn::Points => {
                    let found = estimates.found_point_intervals(sensor);
                    let narrow = found.iter().map(excess_of);
                    let is_narrow =
                        |excess: Option<f64>| excess.is_some_and(|excess| excess <= 1.0);
                    standing.narrow.extend(narrow.map(is_narrow));
                    for (number, point) in points.iter().enumerate() {
                        let excess = excess_of(point);
                        let resolved = figures.resolved[number];
                        let missed = figures.missed[number] || figures.contradicted[number];
                        let done = resolved && excess.is_some_and(|excess| excess <= 1.0);
                        standing.add(excess, done, !resolved && had_a_chance(missed));
                    }
                }
                ToleranceOn::Summary => {
                    let excess = excess_of(&estimates.found_average(sensor));
                    let misses =
                        [&figures.missed, &figures.contradicted].map(|of| of.contains(&true));
                    let done = excess.is_some_and(|excess| excess <= 1.0)
                        && (unresolved == 0 || had_a_chance(misses.contains(&true)));
                    standing.narrow.extend(points.iter().map(|_| done));
                    points.iter().for_each(|_| standing.add(excess, done, false));
                }
            }
        }
        standing.is_reached &= standing.unresolved == 0;
        standing
    }

    /// The largest half-width over value; `None` without any.
    pub(crate) fn largest(&self) -> Option<f64> {
        let widths = self.relative_widths.iter().flatten().copied();
        widths.reduce(|a, b| if a > b { a } else { b })
    }

    fn add(&mut self, excess: Option<f64>, done: bool, is_given_up: bool) {
        self.excess.push(excess);
        self.done.push(done);
        self.is_reached &= done;
        self.may_end &= done || is_given_up;
    }
}

/// Half-width over tolerance; `None` without a half-width.
fn excess(interval: &Interval, settings: &Settings) -> Option<f64> {
    let half_width = interval.half_width?;
    let tolerance_lx = settings.tolerance_lx(interval.value);
    let excess = if half_width == 0.0 { 0.0 } else { half_width / tolerance_lx };
    // What is no number is not known at all.
    Some(if excess.is_nan() { f64::INFINITY } else { excess })
}
