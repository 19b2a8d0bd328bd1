//! How often light vertices are joined to each target: planned by pilot subpaths, which enter no
//! estimate.
//!
//! The chance of a join is `min(1, c v)`, with v the cosines over squared distance between target
//! and vertex. The constant c of a target is such that each light subpath is joined to it
//! [`JOINS`] times on average, as the vertices of the pilots lie.

use super::engine::Engine;
use super::light_subpath::LightSubpaths;
use super::plan::Receiver;
use crate::context::Stream;
use crate::control::watch::{POINTS_AT_ONCE, Watch};
use crate::spectrum::Spectrum;
use glam::DVec3;
use quasilux_sampling::Sampler;

/// Joins of a light subpath to each target, on average. Of an eighth, a quarter and a half no one
/// is the best in rooms of all kinds; a quarter is near it in each.
const JOINS: f64 = 0.25;
/// Pilot subpaths: of rooms where they have a few hundred vertices the rate is known to 10 %, which
/// is nothing to the error.
const PILOTS: u64 = 128;
/// Steps of Newton's method at most; it comes from below, and ends by itself.
const STEPS: usize = 16;

/// Sets the chances of joins of all targets; the number of rays of the pilots. `None` when the
/// observer stopped it.
pub(super) fn plan_joins<S: Spectrum>(
    engine: &mut Engine<'_, '_, S>,
    watch: &mut Watch<'_>,
) -> Option<u64> {
    if engine.receivers.is_empty() || engine.context.max_bounces == Some(0) {
        return Some(0);
    }
    let pilots = JoinPilots::trace(engine);
    let plan = |receiver: &Receiver| pilots.rate(receiver.position, receiver.n, JOINS);
    let rates = watch.map_in_parts(&engine.receivers, POINTS_AT_ONCE, plan)?;
    for (receiver, rate) in engine.receivers.iter_mut().zip(rates) {
        receiver.per_sure_m2 = rate.unwrap_or(receiver.per_sure_m2);
    }
    Some(pilots.rays())
}

/// Subpaths that enter no estimate.
pub(super) struct JoinPilots<S>(LightSubpaths<S>);

impl<S: Spectrum> JoinPilots<S> {
    pub(super) fn trace(engine: &Engine<'_, '_, S>) -> Self {
        let points = engine.context.points_of_trial(0, Stream::SubpathPilots);
        let samplers = (0..PILOTS).map(|index| Sampler::new(&points, index));
        Self(LightSubpaths::trace(engine, samplers, |_| ()))
    }

    /// The constant of a place with this normal that a light subpath is joined to so often, on
    /// average; `None` where nothing is before it.
    pub(super) fn rate(&self, position: DVec3, n: DVec3, joins: f64) -> Option<f64> {
        let (all, mut per_m2) = (0..self.0.vertices.len(), Vec::new());
        self.0.places.per_m2(all, n, position, &mut per_m2);
        rate(&per_m2, joins * PILOTS as f64)
    }

    pub(super) fn rays(&self) -> u64 {
        self.0.rays
    }
}

/// The c with `sum min(1, c v) = joins`, or a large one where that is never reached; `None` where
/// all v are 0. The sum is concave in c, so Newton's method from below never passes the solution.
fn rate(values: &[f64], joins: f64) -> Option<f64> {
    let mut c = 0.0_f64;
    for _ in 0..STEPS {
        let (mut sure, mut slope) = (0.0, 0.0);
        for v in values {
            match c * v < 1.0 {
                true => slope += v,
                false => sure += 1.0,
            }
        }
        let next = (joins - sure) / slope;
        // Where all are joined for certain, or more than all would have to be.
        if !next.is_finite() || next <= c {
            break;
        }
        c = next;
    }
    (c > 0.0).then_some(c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_are_joined_as_are_wanted() {
        let values: Vec<f64> = (1..=100).map(|it| 1.0 / f64::from(it * it)).collect();
        for joins in [0.01, 1.0, 5.0, 60.0] {
            let c = rate(&values, joins).unwrap();
            let sum: f64 = values.iter().map(|v| (c * v).min(1.0)).sum();
            assert!((sum / joins - 1.0).abs() < 1e-9, "{joins}: {sum}");
        }
    }

    #[test]
    fn what_cannot_be_joined_often_enough_is_joined_always() {
        let c = rate(&[2.0, 0.5, 0.0], 10.0).unwrap();
        assert!(c * 0.5 >= 1.0 && c.is_finite(), "{c}");
        assert_eq!(rate(&[0.0; 4], 1.0), None);
        assert_eq!(rate(&[], 1.0), None);
    }
}
