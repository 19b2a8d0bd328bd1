//! The virtual lights that a block of pixels takes: few that stand for all.
//!
//! Light j is among them with a probability p_j about in proportion to what it gives to the block,
//! and counts 1 / p_j fold, so all of them give about as much. Points evenly spaced over the sums
//! of p_j choose them, along a curve through space: of neighbours, which nearly give the same
//! light, some always are there.

use super::{Site, VirtualLight, VirtualLights};
use crate::spectrum::Spectrum;

/// Lights that a block takes, about.
const COUNT: usize = 64;
/// Share of probabilities that trusts no site, but weights alone.
const DEFENSIVE_SHARE: f64 = 0.2;
/// Rounds in which probabilities above one are looked for.
const ROUNDS: u32 = 16;

impl<S: Spectrum> VirtualLights<S> {
    /// Chooses by what the lights give to these sites, and by a coordinate in [0, 1).
    pub(crate) fn choose(&self, sites: &[Site], u: f64) -> Self {
        let Self { max_per_m2, reach_m, .. } = *self;
        if self.lights.len() <= COUNT {
            return Self { lights: self.lights.clone(), max_per_m2, reach_m };
        }
        let (mut sum, mut next) = (u, 1.0);
        let mut lights = Vec::with_capacity(COUNT + 1);
        for (light, pdf) in self.lights.iter().zip(self.probabilities(sites)) {
            sum += pdf;
            if sum >= next {
                next += 1.0;
                let (sent_on, weight) = (light.sent_on * (1.0 / pdf), light.weight / pdf);
                lights.push(VirtualLight { sent_on, weight, ..*light });
            }
        }
        Self { lights, max_per_m2, reach_m }
    }

    /// The probability with which each light is chosen.
    fn probabilities(&self, sites: &[Site]) -> Vec<f64> {
        let total: f64 = self.lights.iter().map(|light| light.weight).sum();
        let defensive = DEFENSIVE_SHARE * sites.len().max(1) as f64 / total;
        let mut shares: Vec<f64> =
            self.lights.iter().map(|light| light.weight * defensive).collect();
        let mut given = Vec::with_capacity(self.lights.len());
        for site in sites {
            given.clear();
            given.extend(self.lights.iter().map(|light| light.weight * self.bounded(light, site)));
            let total: f64 = given.iter().sum();
            if total > 0.0 {
                shares.iter_mut().zip(&given).for_each(|(share, own)| *share += own / total);
            }
        }
        scale_to(COUNT as f64, &mut shares);
        shares
    }
}

/// Scales shares to probabilities of this sum; none exceeds one.
fn scale_to(sum: f64, shares: &mut [f64]) {
    // From here on 1 stands for certainty.
    let all: f64 = shares.iter().sum();
    shares.iter_mut().for_each(|share| *share = (*share * (sum / all)).min(1.0));
    for _ in 0..ROUNDS {
        let certain = shares.iter().filter(|share| **share >= 1.0).count() as f64;
        let rest: f64 = shares.iter().filter(|share| **share < 1.0).sum();
        let factor = (sum - certain) / rest;
        if !(factor > 1.0 && factor.is_finite()) {
            return;
        }
        let uncertain = shares.iter_mut().filter(|share| **share < 1.0);
        uncertain.for_each(|share| *share = (*share * factor).min(1.0));
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{FLOOR, light, lights};
    use super::*;

    fn many() -> VirtualLights<f64> {
        let weight = |i: u32| if i == 7 { 1000.0 } else { f64::from(1 + i % 5) };
        let place = |i: u32| (f64::from(i % 30) * 0.2, f64::from(i / 30) * 0.2);
        lights((0..600).map(|i| light(place(i).0, place(i).1, weight(i))).collect())
    }

    #[test]
    fn probabilities_are_none_above_one() {
        let all = many();
        for sites in [&[FLOOR][..], &[]] {
            let found = all.probabilities(sites);
            assert!(found.iter().all(|p| (0.0..=1.0).contains(p) && *p > 0.0));
            assert!((found.iter().sum::<f64>() - COUNT as f64).abs() < 1e-6);
            assert!(found[7] == 1.0);
        }
    }

    /// The mean over the coordinate of what is chosen is what there is.
    #[test]
    fn few_stand_for_all() {
        let all = many();
        let given = |of: &VirtualLights<f64>| -> f64 {
            of.lights.iter().map(|light| light.weight * of.bounded(light, &FLOOR)).sum()
        };
        let wanted = given(&all);
        let steps = 4096;
        let mean = (0..steps)
            .map(|i| all.choose(&[FLOOR], (f64::from(i) + 0.5) / f64::from(steps)))
            .inspect(|few| assert!(few.len().abs_diff(COUNT) <= 1))
            .map(|few| given(&few))
            .inspect(|one| assert!((one / wanted - 1.0).abs() < 0.2, "{one}, {wanted}"))
            .sum::<f64>()
            / f64::from(steps);
        assert!((mean / wanted - 1.0).abs() < 1e-3, "{mean}, {wanted}");
    }

    #[test]
    fn where_there_are_few_all_are_taken() {
        let few = lights(vec![light(0.0, 0.0, 1.0), light(1.0, 0.0, 1.0)]);
        assert_eq!(few.choose(&[FLOOR], 0.9).len(), 2);
        assert_eq!(lights(Vec::new()).choose(&[], 0.5).len(), 0);
    }
}
