//! The light of virtual lights at a place, with few rays.
//!
//! Rays that ask for v cost most. Probes near x have asked for all lights: the share v' of them
//! that sees a light is an expectation of v there. All lights together give
//!
//! ```text
//! E = sum_j E_j v'_j + sum_j E_j (v_j - v'_j)
//! ```
//!
//! The first sum needs no ray. Of the second a few terms are drawn, in proportion to what they give
//! in the open and to how little the probes agree; where they agree, it is next to nothing.
//! Whatever the probes say, the mean is right.

use super::{ShadowSegment, Site, VirtualLights};
use crate::spectrum::Spectrum;

/// Probes of a block, one bit each.
pub(crate) const MAX_PROBES: usize = 8;
/// Doubt of what all probes agree on.
const MIN_DOUBT: f64 = 0.15;
/// So many lights are asked that they leave about this share as noise,
const NOISE: f64 = 0.1;
/// but no more than so many.
const MAX_ASKED: f64 = 16.0;

/// A place that wants to know its light.
pub(crate) struct Receiving<'s> {
    pub(crate) site: Site,
    /// Of each light the probes that see it, one bit each.
    pub(crate) seen_by: &'s [u8],
    /// The probes that speak for this place.
    pub(crate) probes: u8,
    /// A coordinate in [0, 1).
    pub(crate) u: f64,
}

/// A light that is to be asked.
pub(crate) struct AskedLight<S> {
    pub(crate) way: ShadowSegment,
    /// Reflections of its light, its own too.
    pub(crate) bounces: u32,
    /// What it adds in lx if nothing stands in the way.
    pub(crate) if_seen_lx: S,
}

/// Working space.
#[derive(Default)]
pub(crate) struct Sums {
    given: Vec<f64>,
    /// Sums of doubts up to each light.
    doubts: Vec<f64>,
}

/// What probes make expect of one light.
#[derive(Clone, Copy)]
struct Expectation {
    /// The share of them that sees it.
    seen: f64,
    /// About the standard deviation of whether a place near them sees it.
    doubt: f64,
}

impl Expectation {
    /// By the number of those among these probes that see a light.
    fn by_count(probes: u8) -> [Self; MAX_PROBES + 1] {
        let count = f64::from(probes.count_ones());
        std::array::from_fn(|seen| {
            let seen = if count > 0.0 { (seen as f64 / count).min(1.0) } else { 0.5 };
            Self { seen, doubt: (seen * (1.0 - seen)).sqrt().max(MIN_DOUBT) }
        })
    }
}

impl<S: Spectrum> VirtualLights<S> {
    /// What the lights give to a place as far as the probes say, in lx; `ask` is given those that
    /// are to be asked, whose terms are taken out before.
    pub(crate) fn illuminance_lx(
        &self,
        place: &Receiving<'_>,
        sums: &mut Sums,
        ask: impl FnMut(AskedLight<S>),
    ) -> S {
        let Sums { given, doubts } = sums;
        given.clear();
        given.extend(self.lights.iter().map(|light| self.bounded(light, &place.site)));
        let expectations = Expectation::by_count(place.probes);
        let (mut expected, mut doubt) = (S::black(), 0.0);
        doubts.clear();
        doubts.extend(self.lights.iter().zip(given).zip(place.seen_by).map(
            |((light, given), seen_by)| {
                let of = expectations[(seen_by & place.probes).count_ones() as usize];
                expected += light.sent_on * (*given * of.seen);
                doubt += light.weight * *given * of.doubt;
                doubt
            },
        ));
        if doubt > 0.0 && doubt.is_finite() {
            let noise = doubt / (NOISE * expected.luminance());
            let count = (noise * noise).ceil().clamp(1.0, MAX_ASKED);
            expected += self.draw(place, doubts, count, ask) * -1.0;
        }
        expected
    }

    /// Draws so many of the lights, evenly spaced over the sums of doubts; one may be drawn several
    /// times. Returns what was expected of them.
    fn draw(
        &self,
        place: &Receiving<'_>,
        doubts: &[f64],
        count: f64,
        mut ask: impl FnMut(AskedLight<S>),
    ) -> S {
        let expectations = Expectation::by_count(place.probes);
        let step = doubts.last().map_or(0.0, |doubt| doubt / count);
        let (mut next, mut number) = (place.u * step, 0);
        let mut expected = S::black();
        loop {
            number += doubts[number..].partition_point(|&sum| sum <= next);
            let Some(light) = self.lights.get(number) else { return expected };
            let times = ((doubts[number] - next) / step).ceil().max(1.0);
            next += times * step;
            let seen_by = place.seen_by[number] & place.probes;
            let Expectation { seen, doubt } = expectations[seen_by.count_ones() as usize];
            let if_seen_lx = light.sent_on * (times * step / (light.weight * doubt));
            expected += if_seen_lx * seen;
            ask(AskedLight { way: light.way(&place.site), bounces: light.bounces, if_seen_lx });
            number += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{FLOOR, light, lights};
    use super::*;

    /// Whatever probes say, the mean over the coordinate is the light of those that are seen.
    #[test]
    fn probes_change_no_mean() {
        let all = lights((0..40).map(|i| light(f64::from(i % 8), f64::from(i / 8), 1.0)).collect());
        let is_seen = |x: f64| x < 4.5;
        let seen = all.lights.iter().filter(|light| is_seen(light.position.x));
        let wanted: f64 = seen.map(|light| light.weight * all.bounded(light, &FLOOR)).sum();
        let mut sums = Sums::default();
        for (seen_by, probes) in
            [(vec![0b0101; 40], 0b1111), (vec![0b1111; 40], 0b1111), (vec![0; 40], 0b11)]
                .into_iter()
                .chain([(vec![0b1; 40], 0), ((0..40).map(|i| i * 3 % 16).collect(), 0b1101)])
        {
            let steps = 1024;
            let mut rays = 0;
            let mean = (0..steps)
                .map(|i| {
                    let u = (f64::from(i) + 0.5) / f64::from(steps);
                    let place = Receiving { site: FLOOR, seen_by: &seen_by, probes, u };
                    let mut asked = 0.0;
                    let expected = all.illuminance_lx(&place, &mut sums, |light| {
                        let ShadowSegment { direction, distance_m, .. } = light.way;
                        rays += 1;
                        if is_seen(direction.x * distance_m) {
                            asked += light.if_seen_lx;
                        }
                    });
                    expected + asked
                })
                .sum::<f64>()
                / f64::from(steps);
            assert!((mean / wanted - 1.0).abs() < 0.01, "{mean}, {wanted}, {probes}");
            assert!(rays >= steps && rays <= steps * 16, "{rays}");
        }
    }

    #[test]
    fn without_lights_there_is_nothing_to_ask() {
        let place = Receiving { site: FLOOR, seen_by: &[], probes: 0, u: 0.5 };
        let none = lights(Vec::new());
        let lx = none.illuminance_lx(&place, &mut Sums::default(), |_| panic!("no light"));
        assert_eq!(lx, 0.0);
    }
}
